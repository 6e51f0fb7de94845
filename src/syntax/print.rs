//! Prints a tree as source text.
//!
//! **Invariant:** parsing the printed text gives the same tree, except for spans and comments (for a tree
//! without errors). No recursion.

use super::ast::{
    Argument, Arguments, Ast, Body, Callee, CaseKind, Component, DirectiveId, DirectiveKind,
    ExpressionId, ExpressionKind, Item, ItemKind, Items, Target, Test,
};
use crate::source::{Source, Span};

/// Returns the text of a tree, an item a line, blocks indented by two.
pub fn print(ast: &Ast, source: &Source) -> String {
    let mut print = Print { ast, source, out: String::new(), depth: 0, tasks: Vec::new() };
    print.tasks.push(Task::Items(ast.root));
    while let Some(task) = print.tasks.pop() {
        print.perform(task);
    }
    print.out.trim_start().to_owned()
}

enum Task {
    Text(&'static str),
    Source(Span),
    Name(String),
    Expression(ExpressionId),
    Items(Items),
    Item(Item),
    Line,
    Indent,
    Outdent,
}

struct Print<'a> {
    ast: &'a Ast,
    source: &'a Source,
    out: String,
    depth: usize,
    tasks: Vec<Task>,
}

impl Print<'_> {
    /// Pushes tasks so that the first is performed first.
    fn push(&mut self, tasks: impl IntoIterator<Item = Task, IntoIter: DoubleEndedIterator>) {
        self.tasks.extend(tasks.into_iter().rev());
    }

    fn perform(&mut self, task: Task) {
        match task {
            Task::Text(text) => self.out += text,
            Task::Name(name) => self.out += &name,
            Task::Source(span) => self.out += self.source.text.get(span.range()).unwrap_or(""),
            Task::Expression(id) => self.expression(id),
            Task::Item(item) => self.item(item),
            Task::Items(items) => {
                let tasks: Vec<Task> = self
                    .ast
                    .items(items)
                    .iter()
                    .flat_map(|&item| match item.kind {
                        ItemKind::Comma | ItemKind::Semicolon => [Task::Text(""), Task::Item(item)],
                        _ => [Task::Line, Task::Item(item)],
                    })
                    .collect();
                self.push(tasks);
            }
            Task::Line => {
                self.out.push('\n');
                self.out += &"  ".repeat(self.depth);
            }
            Task::Indent => self.depth += 1,
            Task::Outdent => self.depth -= 1,
        }
    }

    fn item(&mut self, item: Item) {
        match item.kind {
            ItemKind::Word(word) => self.out += word.name(),
            ItemKind::Open => self.out.push('{'),
            ItemKind::Close => self.out.push('}'),
            ItemKind::Comma => self.out.push(','),
            ItemKind::Semicolon => self.out.push(';'),
            ItemKind::Expression(id) => self.expression(id),
            ItemKind::Block(items) => self.push(block("{", items, "}")),
            ItemKind::Entry(items) => {
                let inside = self.inside(items);
                let brackets = [[Task::Text("[")].into(), inside, [Task::Text("]")].into()];
                self.push(brackets.into_iter().flatten().collect::<Vec<_>>());
            }
            ItemKind::Numbers { start, count, width } => {
                let all = start as usize..(start + count * width) as usize;
                let numbers = self.ast.numbers.get(all).unwrap_or(&[]);
                for vector in numbers.chunks(width.max(1) as usize) {
                    let parts: Vec<String> = vector.iter().map(|n| format!("{n:?}")).collect();
                    let parts = parts.join(", ");
                    self.out += &if width == 1 { parts + ", " } else { format!("<{parts}>, ") };
                }
            }
            ItemKind::Directive(id) => self.directive(id),
        }
    }

    fn expression(&mut self, id: ExpressionId) {
        let node = self.ast.expression(id);
        match node.kind {
            // As it was written: `0.10` stays `0.10`.
            ExpressionKind::Number(_) | ExpressionKind::String => {
                self.push([Task::Source(node.span)]);
            }
            ExpressionKind::Name(name) => self.out += self.ast.name(name),
            ExpressionKind::Word(word) => self.out += word.name(),
            ExpressionKind::Unary(operator, of) => {
                self.push([Task::Text(operator.symbol()), Task::Expression(of)]);
            }
            ExpressionKind::Binary(operator, first, second) => self.push([
                Task::Expression(first),
                Task::Text(" "),
                Task::Text(operator.symbol()),
                Task::Text(" "),
                Task::Expression(second),
            ]),
            ExpressionKind::Conditional(condition, first, second) => self.push([
                Task::Expression(condition),
                Task::Text(" ? "),
                Task::Expression(first),
                Task::Text(" : "),
                Task::Expression(second),
            ]),
            ExpressionKind::Vector(components) => {
                let list = self.list("<", components, ">");
                self.push(list);
            }
            ExpressionKind::Triple(triple) => {
                let [x, y, z] = triple.spans(node.span).map(Task::Source);
                let comma = || Task::Text(", ");
                self.push([Task::Text("<"), x, comma(), y, comma(), z, Task::Text(">")]);
            }
            ExpressionKind::Call(callee, arguments) => {
                let callee = match callee {
                    Callee::Word(word, _) => Task::Text(word.name()),
                    Callee::Name(name, _) => Task::Name(self.ast.name(name).to_owned()),
                    Callee::Element(id) => Task::Expression(id),
                };
                let list = self.list("(", arguments, ")");
                self.push([callee].into_iter().chain(list));
            }
            ExpressionKind::Index(of, index) => self.push([
                Task::Expression(of),
                Task::Text("["),
                Task::Expression(index),
                Task::Text("]"),
            ]),
            ExpressionKind::Component(of, component) => {
                let component = match component {
                    Component::Word(word, _) => word.name(),
                    Component::Name(name, _) => self.ast.name(name),
                };
                self.push([
                    Task::Expression(of),
                    Task::Text("."),
                    Task::Name(component.to_owned()),
                ]);
            }
            ExpressionKind::Group(of) => {
                self.push([Task::Text("("), Task::Expression(of), Task::Text(")")]);
            }
            ExpressionKind::GroupItems(items) => {
                let inside = self.inside(items);
                let parentheses = [[Task::Text("(")].into(), inside, [Task::Text(")")].into()];
                self.push(parentheses.into_iter().flatten().collect::<Vec<_>>());
            }
            ExpressionKind::Joint | ExpressionKind::Missing => {}
        }
    }

    /// Returns the content of parentheses, or of an entry's brackets. A line that ends with a `;` would end
    /// the statement.
    fn inside(&self, items: Items) -> Vec<Task> {
        let all = self.ast.items(items);
        match all.iter().any(|item| item.kind == ItemKind::Semicolon) {
            true => all.iter().flat_map(|&item| [Task::Item(item), Task::Text(" ")]).collect(),
            false => vec![Task::Indent, Task::Items(items), Task::Outdent, Task::Line],
        }
    }

    fn list(
        &self,
        open: &'static str,
        arguments: Arguments,
        close: &'static str,
    ) -> impl IntoIterator<Item = Task, IntoIter: DoubleEndedIterator> + use<> {
        let mut tasks = vec![Task::Text(open)];
        for (n, argument) in self.ast.arguments(arguments).iter().enumerate() {
            if n > 0 {
                tasks.push(Task::Text(", "));
            }
            match *argument {
                Argument::Expression(id) => tasks.push(Task::Expression(id)),
                Argument::Items(items) => tasks.extend(self.inside(items)),
            }
        }
        tasks.push(Task::Text(close));
        tasks
    }

    fn name(&self, id: super::ast::NameId) -> Task {
        Task::Name(self.ast.name(id).to_owned())
    }

    fn target(&self, target: &Target) -> Vec<Task> {
        let mut tasks = vec![self.name(target.name)];
        for &index in &target.indices {
            tasks.extend([Task::Text("["), Task::Expression(index), Task::Text("]")]);
        }
        tasks
    }

    fn directive(&mut self, id: DirectiveId) {
        let ast = self.ast;
        let mut tasks = Vec::new();
        let value =
            |head: &'static str, id: ExpressionId| vec![Task::Text(head), Task::Expression(id)];
        let paren = |head: &'static str, id: ExpressionId| {
            vec![Task::Text(head), Task::Text(" ("), Task::Expression(id), Task::Text(")")]
        };
        let end = || [Task::Line, Task::Text("#end")];
        match &ast.directive(id).kind {
            DirectiveKind::Declare { local, target } => {
                tasks.push(Task::Text(if *local { "#local " } else { "#declare " }));
                tasks.extend(self.target(target));
                tasks.push(Task::Text(" ="));
            }
            DirectiveKind::Undef(target) => {
                tasks.push(Task::Text("#undef "));
                tasks.extend(self.target(target));
            }
            DirectiveKind::If { test, then, otherwise } => {
                match test {
                    Test::Condition(condition) => tasks.extend(paren("#if", *condition)),
                    Test::Defined(target) | Test::NotDefined(target) => {
                        let defined = matches!(test, Test::Defined(_));
                        tasks.push(Task::Text(if defined { "#ifdef (" } else { "#ifndef (" }));
                        tasks.extend(self.target(target));
                        tasks.push(Task::Text(")"));
                    }
                }
                tasks.extend(body(*then));
                if !otherwise.is_empty() {
                    tasks.extend([Task::Line, Task::Text("#else")]);
                    tasks.extend(body(*otherwise));
                }
                tasks.extend(end());
            }
            DirectiveKind::While { condition, body: items } => {
                tasks.extend(paren("#while", *condition));
                tasks.extend(body(*items));
                tasks.extend(end());
            }
            DirectiveKind::For { name, from, to, step, body: items, .. } => {
                tasks.extend([Task::Text("#for ("), self.name(*name)]);
                for part in [Some(from), Some(to), step.as_ref()].into_iter().flatten() {
                    tasks.extend(value(", ", *part));
                }
                tasks.push(Task::Text(")"));
                tasks.extend(body(*items));
                tasks.extend(end());
            }
            DirectiveKind::Switch { value: of, lead, cases } => {
                tasks.extend(paren("#switch", *of));
                tasks.extend(body(*lead));
                for case in cases {
                    tasks.push(Task::Line);
                    match case.kind {
                        CaseKind::Value(of) => tasks.extend(paren("#case", of)),
                        CaseKind::Range(from, to) => {
                            tasks.extend(value("#range (", from));
                            tasks.extend(value(", ", to));
                            tasks.push(Task::Text(")"));
                        }
                        CaseKind::Otherwise => tasks.push(Task::Text("#else")),
                    }
                    tasks.extend(body(case.body));
                }
                tasks.extend(end());
            }
            DirectiveKind::Break => tasks.push(Task::Text("#break")),
            DirectiveKind::Macro { name, parameters, body: inside, .. } => {
                tasks.extend([Task::Text("#macro "), self.name(*name), Task::Text("(")]);
                for (n, parameter) in parameters.iter().enumerate() {
                    tasks.push(Task::Text(if n > 0 { ", " } else { "" }));
                    tasks.push(Task::Text(if parameter.optional { "optional " } else { "" }));
                    tasks.push(self.name(parameter.name));
                }
                tasks.push(Task::Text(")"));
                match inside {
                    Body::Items(items) => {
                        tasks.extend(body(*items));
                        tasks.extend(end());
                    }
                    Body::Raw(span) => tasks.extend([Task::Source(*span), Task::Text("#end")]),
                }
            }
            DirectiveKind::Include(of) => tasks.extend(value("#include ", *of)),
            DirectiveKind::Default(items) => tasks.extend(block("#default {", *items, "}")),
            DirectiveKind::Version(of) => tasks.extend(value("#version ", *of)),
            DirectiveKind::Debug(of) => tasks.extend(value("#debug ", *of)),
            DirectiveKind::Warning(of) => tasks.extend(value("#warning ", *of)),
            DirectiveKind::Error(of) => tasks.extend(value("#error ", *of)),
            DirectiveKind::Fopen { name, file, mode, .. } => {
                tasks.extend([Task::Text("#fopen "), self.name(*name)]);
                tasks.extend(value(" ", *file));
                tasks.extend(
                    mode.iter().flat_map(|mode| [Task::Text(" "), Task::Text(mode.name())]),
                );
            }
            DirectiveKind::Fclose { name, .. } => {
                tasks.extend([Task::Text("#fclose "), self.name(*name)])
            }
            DirectiveKind::Read { name, targets, .. } => {
                tasks.extend([Task::Text("#read ("), self.name(*name)]);
                for target in targets {
                    tasks.push(Task::Text(", "));
                    tasks.extend(self.target(target));
                }
                tasks.push(Task::Text(")"));
            }
            DirectiveKind::Write { name, arguments, .. } => {
                tasks.extend([Task::Text("#write ("), self.name(*name)]);
                tasks.extend(self.list(", ", *arguments, ")"));
            }
            DirectiveKind::OldStream(of) => tasks.extend(value("#render ", *of)),
            DirectiveKind::Unread => tasks.push(Task::Source(self.ast.directive(id).head)),
            DirectiveKind::Malformed => {}
        }
        self.push(tasks);
    }
}

/// Returns items inside brackets, a line each.
fn block(open: &'static str, items: Items, close: &'static str) -> Vec<Task> {
    let [indent, inside, outdent] = body(items);
    vec![Task::Text(open), indent, inside, outdent, Task::Line, Task::Text(close)]
}

fn body(items: Items) -> [Task; 3] {
    [Task::Indent, Task::Items(items), Task::Outdent]
}
