//! Finds braces that pair only after macros are expanded and `#if`s are decided.
//!
//! Three standard includes contain `#if(a) merge { #else union { #end` inside a macro, and an author may
//! write `#macro Open() union { #end`. Such braces are left *loose*: each is an item of its own, and is
//! paired during evaluation.
//! **Invariant:** braces are loose only where the text pairs as it would run: a macro's own braces pair on
//! some path through its `#if`s, or the file's pair with its macro calls expanded, or braces that its macros
//! open are closed by other macros. So a forgotten brace is still reported. If that rejects a valid POV-Ray
//! scene, the scene is read again with all of them loose (`road/again.rs`). Takes linear time, except for
//! macros in macros.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::balance::{Opener, Turn, pairs, turn};
use super::token::{Bracket, Head, Mark, Token, TokenKind};

const OPEN: TokenKind = TokenKind::Mark(Mark::Open(Bracket::Brace));
const CLOSE: TokenKind = TokenKind::Mark(Mark::Close(Bracket::Brace));

/// Loosens the braces that pair only after expansion. The body of a macro with other such brackets becomes
/// [`TokenKind::Raw`]. With `all`, every brace without a partner in its own text becomes loose.
pub(super) fn loosen(mut tokens: Vec<Token>, text: &str, all: bool) -> Vec<Token> {
    let macros = macros(&tokens);
    let mut raw: Vec<Range<usize>> = Vec::new();
    let mut done = 0;
    for body in &macros {
        let inside = &tokens[body.clone()];
        if body.start < done || pairs(inside) || !pairs_on_some_path(inside) {
            continue;
        }
        done = body.end;
        match loose_braces(inside) {
            Some(loose) => mark(&mut tokens[body.clone()], &loose),
            // A parenthesis missing in one branch only is an error.
            None if paths(inside)[..2] == [[0; 3]; 2] => raw.push(body.clone()),
            None => {}
        }
    }
    for body in raw.into_iter().rev() {
        let (start, end) = (tokens[body.start - 1].end, tokens[body.end].start);
        tokens.splice(body, [Token { kind: TokenKind::Raw, start, end }]);
    }
    // A brace in a conditional branch may be loose already, and still be the partner of another.
    if !pairs(&tokens)
        && !loosen_across(&mut tokens, text, false)
        && !loosen_across(&mut tokens, text, true)
        && (all || pairs_on_both_paths(&tokens))
        && let Some(loose) = loose_braces(&tokens)
    {
        mark(&mut tokens, &loose);
    }
    tokens
}

/// Returns whether the text outside macros pairs both with all first branches and with all other branches:
/// `#if (A) union { #else merge { #end … }`.
fn pairs_on_both_paths(tokens: &[Token]) -> bool {
    let [mut first, mut otherwise] = [Effect::default(); 2];
    let mut branches = Branches::default();
    for &token in tokens {
        branches.turn(token);
        let effect = match token.kind {
            OPEN => OPENS,
            CLOSE => CLOSES,
            _ => continue,
        };
        if branches.ways().first {
            first.then(effect);
        }
        if branches.ways().otherwise {
            otherwise.then(effect);
        }
    }
    let whole = Effect::default();
    let ends = macros(tokens).iter().all(|body| pairs(&tokens[body.clone()]));
    branches.0.is_empty() && ends && first == whole && otherwise == whole
}

fn mark(tokens: &mut [Token], loose: &[usize]) {
    for &at in loose {
        tokens[at].kind = match tokens[at].kind {
            OPEN => TokenKind::LooseOpen,
            _ => TokenKind::LooseClose,
        };
    }
}

/// Returns the bodies of all macros, sorted by start.
fn macros(tokens: &[Token]) -> Vec<Range<usize>> {
    let mut open = Vec::new();
    let mut bodies = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match turn(token.kind) {
            Some(Turn::Open(Opener::Directive)) => open.push(at),
            Some(Turn::Close(Opener::Directive)) => {
                if let Some(start) = open.pop()
                    && let Some(body) = body_start(tokens, start)
                    && body <= at
                {
                    bodies.push(body..at);
                }
            }
            Some(_) | None => {}
        }
    }
    bodies.sort_unstable_by_key(|body| body.start);
    bodies
}

/// Returns the first token after the head `#macro Name(a, b)` that starts at `start`.
pub(super) fn body_start(tokens: &[Token], start: usize) -> Option<usize> {
    let parameters = start + 2;
    if tokens[start].kind != TokenKind::Directive(Head::Macro)
        || tokens.get(parameters)?.kind != TokenKind::Mark(Mark::Open(Bracket::Round))
    {
        return None;
    }
    let within = |token: &Token| {
        matches!(token.kind, TokenKind::Name | TokenKind::Word(_) | TokenKind::Mark(Mark::Comma))
    };
    let names = tokens[parameters + 1..].iter().take_while(|token| within(token)).count();
    let close = parameters + 1 + names;
    (tokens.get(close)?.kind == TokenKind::Mark(Mark::Close(Bracket::Round))).then_some(close + 1)
}

/// Returns the braces without a partner in their own branch; `None` if other brackets have none, either.
fn loose_braces(tokens: &[Token]) -> Option<Vec<usize>> {
    let mut open: Vec<(Opener, usize)> = Vec::new();
    let mut loose = Vec::new();
    // Everything open since the innermost directive: all braces.
    let leave = |open: &mut Vec<(Opener, usize)>, loose: &mut Vec<usize>| loop {
        match open.last() {
            None | Some((Opener::Directive, _)) => return Some(()),
            Some(&(Opener::Bracket(Bracket::Brace), at)) => {
                loose.push(at);
                open.pop();
            }
            Some(_) => return None,
        }
    };
    for (at, token) in tokens.iter().enumerate() {
        match turn(token.kind) {
            None => {}
            Some(Turn::Open(opener)) => open.push((opener, at)),
            Some(Turn::Divide) => leave(&mut open, &mut loose)?,
            Some(Turn::Close(Opener::Directive)) => {
                leave(&mut open, &mut loose)?;
                open.pop()?;
            }
            Some(Turn::Close(closer)) => match open.last() {
                Some(&(opener, _)) if opener == closer => drop(open.pop()),
                None | Some((Opener::Directive, _)) if token.kind == CLOSE => loose.push(at),
                _ => return None,
            },
        }
    }
    leave(&mut open, &mut loose)?;
    open.is_empty().then_some(loose)
}

/// The paths on which the current branch of an open directive is run.
struct Branch {
    head: Head,
    /// In a `#switch`: the path from its first case to the first `#break`.
    first: bool,
    otherwise: bool,
    /// It contained a `#break`.
    broken: bool,
    /// The paths on which all enclosing directives are run.
    around: Ways,
}

/// Whether all open directives are on their first branch, and whether all are on `#else`.
#[derive(Clone, Copy)]
struct Ways {
    first: bool,
    otherwise: bool,
}

/// The open directives, and the paths through them: always the first branch, or always `#else`.
#[derive(Default)]
struct Branches(Vec<Branch>);

impl Branches {
    fn turn(&mut self, token: Token) {
        match (turn(token.kind), token.kind) {
            (Some(Turn::Open(Opener::Directive)), TokenKind::Directive(head)) => {
                // A loop runs once or never; an inner macro is not run here.
                let first = head != Head::Macro;
                let around = self.ways();
                self.0.push(Branch { head, first, otherwise: false, broken: false, around });
            }
            (Some(Turn::Divide), TokenKind::Directive(head)) => {
                if let Some(branch) = self.0.last_mut() {
                    // A case falls through into the next one up to a `#break`.
                    let of_switch = matches!(branch.head, Head::Switch | Head::Case | Head::Range);
                    let first = of_switch && branch.first && !branch.broken;
                    let otherwise = head == Head::Else;
                    *branch = Branch { head, first, otherwise, ..*branch };
                }
            }
            (Some(Turn::Close(Opener::Directive)), _) => drop(self.0.pop()),
            (None, TokenKind::Directive(Head::Break)) => {
                if let Some(branch) = self.0.last_mut() {
                    branch.broken = true;
                    branch.first &= !matches!(branch.head, Head::Case | Head::Range);
                }
            }
            _ => {}
        }
    }

    fn ways(&self) -> Ways {
        let Some(&Branch { first, otherwise, around, .. }) = self.0.last() else {
            return Ways { first: true, otherwise: true };
        };
        Ways { first: first && around.first, otherwise: otherwise && around.otherwise }
    }
}

fn pairs_on_some_path(tokens: &[Token]) -> bool {
    paths(tokens).contains(&[0; 3])
}

/// Returns how many more brackets of each kind a text opens than it closes: with all first branches run, with
/// all other branches run, and as written.
fn paths(tokens: &[Token]) -> [[i32; 3]; 3] {
    let [mut first, mut otherwise, mut all] = [[0_i32; 3]; 3];
    let mut branches = Branches::default();
    for &token in tokens {
        branches.turn(token);
        let (bracket, change) = match turn(token.kind) {
            Some(Turn::Open(Opener::Bracket(bracket))) => (bracket as usize, 1),
            Some(Turn::Close(Opener::Bracket(bracket))) => (bracket as usize, -1),
            _ => continue,
        };
        all[bracket] += change;
        let ways = branches.ways();
        first[bracket] += if ways.first { change } else { 0 };
        otherwise[bracket] += if ways.otherwise { change } else { 0 };
    }
    [first, otherwise, all]
}

/// The effect of a text on the braces around it: it closes some, then opens some.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct Effect {
    closes: u64,
    opens: u64,
}

const OPENS: Effect = Effect { closes: 0, opens: 1 };
const CLOSES: Effect = Effect { closes: 1, opens: 0 };

impl Effect {
    fn then(&mut self, next: Self) {
        let within = self.opens.min(next.closes);
        // A macro that calls another twice may open twice as many, and so on.
        self.closes = self.closes.saturating_add(next.closes - within);
        self.opens = (self.opens - within).saturating_add(next.opens);
    }

    fn surplus(self) -> i128 {
        i128::from(self.opens) - i128::from(self.closes)
    }
}

/// A text that runs as a unit: the file's own, or a macro's body.
#[derive(Default)]
struct Run<'t> {
    name: &'t str,
    /// The start of its body, which is the end of its head.
    body: usize,
    effect: Effect,
    branches: Branches,
}

/// Loosens braces that one macro opens and another, or the calling text, closes; with the braces that are
/// loose already, or without them. Returns `false` if they do not pair.
fn loosen_across(tokens: &mut [Token], text: &str, with_loose: bool) -> bool {
    let slice = |token: Token| text.get(token.start as usize..token.end as usize).unwrap_or("");
    let mut effects: HashMap<&str, Effect> = HashMap::new();
    let mut called: HashSet<&str> = HashSet::new();
    let mut unpaired: Vec<Range<usize>> = Vec::new();
    let mut outer: Vec<Run> = Vec::new();
    let mut run = Run::default();
    for (at, &token) in tokens.iter().enumerate() {
        if at < run.body {
            continue;
        }
        if let Some(body) = body_start(tokens, at) {
            let inner = Run { name: slice(tokens[at + 1]), body, ..Run::default() };
            outer.push(std::mem::replace(&mut run, inner));
            continue;
        }
        let ends = turn(token.kind) == Some(Turn::Close(Opener::Directive));
        if ends && run.branches.0.is_empty() {
            let Some(caller) = outer.pop() else { return false };
            let Run { name, body, effect, .. } = std::mem::replace(&mut run, caller);
            if effect == Effect::default() {
                effects.remove(name);
            } else {
                effects.insert(name, effect);
                unpaired.push(body..at);
            }
            continue;
        }
        run.branches.turn(token);
        if !run.branches.ways().first {
            continue;
        }
        match token.kind {
            OPEN => run.effect.then(OPENS),
            CLOSE => run.effect.then(CLOSES),
            TokenKind::LooseOpen if with_loose => run.effect.then(OPENS),
            TokenKind::LooseClose if with_loose => run.effect.then(CLOSES),
            TokenKind::Name => {
                let calls = tokens
                    .get(at + 1)
                    .is_some_and(|next| next.kind == TokenKind::Mark(Mark::Open(Bracket::Round)));
                if let Some((&name, &effect)) = effects.get_key_value(slice(token))
                    && calls
                {
                    called.insert(name);
                    run.effect.then(effect);
                }
            }
            _ => {}
        }
    }
    let surplus = |counts: &dyn Fn(&str) -> bool| -> i128 {
        effects.iter().filter(|(name, _)| counts(name)).map(|(_, effect)| effect.surplus()).sum()
    };
    let file_pairs = outer.is_empty() && run.effect == Effect::default();
    let among_all = surplus(&|_| true) == 0;
    let among_uncalled = surplus(&|name| !called.contains(name)) == 0;
    let whole = file_pairs && !called.is_empty() && (among_all || among_uncalled);
    if !whole && !among_all {
        return false;
    }
    if whole {
        unpaired.clear();
        unpaired.push(0..tokens.len());
    }
    for part in unpaired {
        if let Some(loose) = loose_braces(&tokens[part.clone()]) {
            mark(&mut tokens[part], &loose);
        }
    }
    pairs(tokens)
}
