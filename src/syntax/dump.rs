//! Prints a tree line by line, for reading and for tests.
//!
//! **Out:** one line for each item, children indented. A value is in prefix form: `(+ 1 (* 2 @A))`; names
//! have an `@`, keywords do not. **Invariant:** no spans, so that two texts with the same tree print the same
//! lines; no recursion.

use super::ast::{
    Argument, Arguments, Ast, Body, Callee, CaseKind, Component, DirectiveId, DirectiveKind,
    ExpressionId, ExpressionKind, Item, ItemKind, Items, NameId, Target, Test,
};
use crate::source::{Source, Span};

/// Returns the lines of a whole tree.
pub fn dump(ast: &Ast, source: &Source) -> String {
    let mut dump = Dump { ast, source, out: String::new(), tasks: Vec::new() };
    dump.tasks.push(Task::Items(ast.root, Some(0)));
    while let Some(task) = dump.tasks.pop() {
        dump.perform(task);
    }
    dump.out
}

enum Task<'a> {
    Text(String),
    Name(&'a str),
    Expression(ExpressionId),
    Argument(Argument),
    /// One line each at this depth, or inline.
    Items(Items, Option<usize>),
    Item(Item, Option<usize>),
    Line(usize),
}

struct Dump<'a> {
    ast: &'a Ast,
    source: &'a Source,
    out: String,
    tasks: Vec<Task<'a>>,
}

impl<'a> Dump<'a> {
    /// Pushes tasks so that the first is performed first.
    fn push(&mut self, tasks: impl IntoIterator<Item = Task<'a>, IntoIter: DoubleEndedIterator>) {
        self.tasks.extend(tasks.into_iter().rev());
    }

    fn perform(&mut self, task: Task<'a>) {
        match task {
            Task::Text(text) => self.out += &text,
            Task::Name(text) => {
                self.out.push('@');
                self.out += text;
            }
            Task::Line(depth) => self.out += &"  ".repeat(depth),
            Task::Expression(id) => self.expression(id),
            Task::Argument(Argument::Expression(id)) => self.expression(id),
            Task::Argument(Argument::Items(items)) => self.push(inline(items)),
            Task::Item(item, depth) => self.item(item, depth),
            Task::Items(items, depth) => {
                let ast = self.ast;
                let mut tasks = Vec::new();
                for (n, &item) in ast.items(items).iter().enumerate() {
                    match depth {
                        Some(depth) => tasks.push(Task::Line(depth)),
                        None if n > 0 => tasks.push(text("; ")),
                        None => {}
                    }
                    tasks.push(Task::Item(item, depth));
                }
                self.push(tasks);
            }
        }
    }

    fn slice(&self, span: Span) -> String {
        self.source.text.get(span.range()).unwrap_or("").replace('\n', "\\n")
    }

    fn name(&self, id: NameId) -> Task<'a> {
        Task::Name(self.ast.name(id))
    }

    /// Writes a complete line, or inline text.
    fn leaf(&mut self, depth: Option<usize>, words: String) {
        self.out += &words;
        if depth.is_some() {
            self.out.push('\n');
        }
    }

    fn item(&mut self, item: Item, depth: Option<usize>) {
        match item.kind {
            ItemKind::Word(word) => self.leaf(depth, format!("word {}", word.name())),
            ItemKind::Comma => self.leaf(depth, "comma".to_owned()),
            ItemKind::Semicolon => self.leaf(depth, "semicolon".to_owned()),
            ItemKind::Expression(id) => {
                let end = if depth.is_some() { "\n" } else { "" };
                self.push([text("value "), Task::Expression(id), text(end)]);
            }
            ItemKind::Block(items) => self.push(children(text("block"), items, depth)),
            ItemKind::Entry(items) => self.push(children(text("entry"), items, depth)),
            ItemKind::Open => self.leaf(depth, "open".to_owned()),
            ItemKind::Close => self.leaf(depth, "close".to_owned()),
            ItemKind::Numbers { start, count, width } => {
                let all = start as usize..(start + count * width) as usize;
                let numbers = self.ast.numbers.get(all).unwrap_or(&[]);
                let shown: String = numbers.iter().take(12).map(|n| format!(" {n}")).collect();
                let more = if numbers.len() > 12 { " …" } else { "" };
                self.leaf(depth, format!("numbers {count} of {width}:{shown}{more}"));
            }
            ItemKind::Directive(id) => self.directive(id, depth),
        }
    }

    fn expression(&mut self, id: ExpressionId) {
        let node = self.ast.expression(id);
        match node.kind {
            ExpressionKind::Number(number) => self.out += &number.to_string(),
            ExpressionKind::String => self.out += &self.slice(node.span),
            ExpressionKind::Name(name) => self.push([self.name(name)]),
            ExpressionKind::Word(word) => self.out += word.name(),
            ExpressionKind::Unary(operator, of) => {
                let sign = format!("({} ", operator.symbol());
                self.push([text(&sign), Task::Expression(of), text(")")]);
            }
            ExpressionKind::Binary(operator, first, second) => {
                let sign = format!("({} ", operator.symbol());
                let parts = [Task::Expression(first), text(" "), Task::Expression(second)];
                self.push([text(&sign)].into_iter().chain(parts).chain([text(")")]));
            }
            ExpressionKind::Conditional(condition, first, second) => self.push([
                text("(? "),
                Task::Expression(condition),
                text(" "),
                Task::Expression(first),
                text(" "),
                Task::Expression(second),
                text(")"),
            ]),
            ExpressionKind::Vector(components) => {
                let tasks = self.list("<", components, ">");
                self.push(tasks);
            }
            ExpressionKind::Triple(triple) => {
                let numbers =
                    self.ast.triple(triple).map(|number| match number.is_sign_negative() {
                        true => format!("(- {})", -number),
                        false => number.to_string(),
                    });
                self.out += &format!("<{}>", numbers.join(", "));
            }
            ExpressionKind::Call(callee, arguments) => {
                let callee = match callee {
                    Callee::Word(word, _) => text(word.name()),
                    Callee::Name(name, _) => self.name(name),
                    Callee::Element(id) => Task::Expression(id),
                };
                let list = self.list("(", arguments, ")");
                self.push([callee].into_iter().chain(list));
            }
            ExpressionKind::Index(of, index) => {
                self.push([Task::Expression(of), text("["), Task::Expression(index), text("]")]);
            }
            ExpressionKind::Component(of, component) => {
                let component = match component {
                    Component::Word(word, _) => word.name(),
                    Component::Name(name, _) => self.ast.name(name),
                };
                self.push([Task::Expression(of), text("."), text(component)]);
            }
            ExpressionKind::Group(of) => {
                self.push([text("group("), Task::Expression(of), text(")")]);
            }
            ExpressionKind::GroupItems(items) => {
                self.push([text("group")].into_iter().chain(inline(items)));
            }
            ExpressionKind::Joint => self.out += "before",
            ExpressionKind::Missing => self.out += "missing",
        }
    }

    fn list(&self, open: &str, arguments: Arguments, close: &str) -> Vec<Task<'a>> {
        let mut tasks = vec![text(open)];
        for (n, &argument) in self.ast.arguments(arguments).iter().enumerate() {
            if n > 0 {
                tasks.push(text(", "));
            }
            tasks.push(Task::Argument(argument));
        }
        tasks.push(text(close));
        tasks
    }

    fn target(&self, target: &Target) -> Vec<Task<'a>> {
        let mut tasks = vec![self.name(target.name)];
        for &index in &target.indices {
            tasks.extend([text("["), Task::Expression(index), text("]")]);
        }
        tasks
    }

    fn directive(&mut self, id: DirectiveId, depth: Option<usize>) {
        let ast = self.ast;
        let mut head = Vec::new();
        let mut bodies: Vec<(Vec<Task>, Items)> = Vec::new();
        let mut say = |words: &str, tasks: Vec<Task<'a>>| {
            head.push(text(words));
            head.extend(tasks);
        };
        let value = |id: ExpressionId| vec![Task::Expression(id)];
        match &ast.directive(id).kind {
            DirectiveKind::Declare { local: false, target } => {
                say("#declare ", self.target(target))
            }
            DirectiveKind::Declare { local: true, target } => say("#local ", self.target(target)),
            DirectiveKind::Undef(target) => say("#undef ", self.target(target)),
            DirectiveKind::If { test, then, otherwise } => {
                match test {
                    Test::Condition(condition) => say("#if ", value(*condition)),
                    Test::Defined(target) => say("#ifdef ", self.target(target)),
                    Test::NotDefined(target) => say("#ifndef ", self.target(target)),
                }
                bodies.push((Vec::new(), *then));
                if !otherwise.is_empty() {
                    bodies.push((vec![text("#else")], *otherwise));
                }
            }
            DirectiveKind::While { condition, body } => {
                say("#while ", value(*condition));
                bodies.push((Vec::new(), *body));
            }
            DirectiveKind::For { name, from, to, step, body, .. } => {
                say("#for ", vec![self.name(*name)]);
                for part in [Some(from), Some(to), step.as_ref()].into_iter().flatten() {
                    say(", ", value(*part));
                }
                bodies.push((Vec::new(), *body));
            }
            DirectiveKind::Switch { value: of, lead, cases } => {
                say("#switch ", value(*of));
                if !lead.is_empty() {
                    bodies.push((Vec::new(), *lead));
                }
                for case in cases {
                    let label = match case.kind {
                        CaseKind::Value(of) => vec![text("#case "), Task::Expression(of)],
                        CaseKind::Range(from, to) => vec![
                            text("#range "),
                            Task::Expression(from),
                            text(", "),
                            Task::Expression(to),
                        ],
                        CaseKind::Otherwise => vec![text("#else")],
                    };
                    bodies.push((label, case.body));
                }
            }
            DirectiveKind::Break => say("#break", Vec::new()),
            DirectiveKind::Macro { name, parameters, body, .. } => {
                say("#macro ", vec![self.name(*name)]);
                for parameter in parameters {
                    let optional = if parameter.optional { " optional " } else { " " };
                    say(optional, vec![self.name(parameter.name)]);
                }
                match body {
                    Body::Items(items) => bodies.push((Vec::new(), *items)),
                    Body::Raw(span) => {
                        say(" raw ", vec![text(&format!("{:?}", self.slice(*span)))])
                    }
                }
            }
            DirectiveKind::Include(of) => say("#include ", value(*of)),
            DirectiveKind::Default(items) => {
                say("#default", Vec::new());
                bodies.push((Vec::new(), *items));
            }
            DirectiveKind::Version(of) => say("#version ", value(*of)),
            DirectiveKind::Debug(of) => say("#debug ", value(*of)),
            DirectiveKind::Warning(of) => say("#warning ", value(*of)),
            DirectiveKind::Error(of) => say("#error ", value(*of)),
            DirectiveKind::Fopen { name, file, mode, .. } => {
                say("#fopen ", vec![self.name(*name), text(" "), Task::Expression(*file)]);
                say(" ", mode.iter().map(|mode| text(mode.name())).collect());
            }
            DirectiveKind::Fclose { name, .. } => say("#fclose ", vec![self.name(*name)]),
            DirectiveKind::Read { name, targets, .. } => {
                say("#read ", vec![self.name(*name)]);
                for target in targets {
                    say(", ", self.target(target));
                }
            }
            DirectiveKind::Write { name, arguments, .. } => {
                say("#write ", vec![self.name(*name)]);
                say(" ", self.list("(", *arguments, ")"));
            }
            DirectiveKind::OldStream(of) => say("#render ", value(*of)),
            DirectiveKind::Unread => say("#unread", Vec::new()),
            DirectiveKind::Malformed => say("#malformed", Vec::new()),
        }
        let line = |tasks: &mut Vec<Task<'a>>| {
            if depth.is_some() {
                tasks.push(text("\n"));
            }
        };
        line(&mut head);
        for (label, items) in bodies {
            if !label.is_empty() {
                head.extend(depth.map(Task::Line));
                head.extend(label);
                line(&mut head);
            }
            match depth {
                Some(depth) => head.push(Task::Items(items, Some(depth + 1))),
                None => head.extend(inline(items)),
            }
        }
        self.push(head);
    }
}

fn text<'a>(text: &str) -> Task<'a> {
    Task::Text(text.to_owned())
}

fn inline<'a>(items: Items) -> [Task<'a>; 3] {
    [text("{"), Task::Items(items, None), text("}")]
}

/// Returns the tasks for a line and its children below it, or for both inline.
fn children<'a>(head: Task<'a>, items: Items, depth: Option<usize>) -> Vec<Task<'a>> {
    match depth {
        Some(depth) => vec![head, text("\n"), Task::Items(items, Some(depth + 1))],
        None => [head].into_iter().chain(inline(items)).collect(),
    }
}
