//! Braces that pair only once macros are expanded and their `#if`s decided.
//!
//! Three standard includes write `#if(a) merge { #else union { #end` inside a macro, and an author may write
//! `#macro Open() union { #end`. Such braces are left *loose*: each an item of its own, to pair while the
//! text is evaluated.
//! **Invariant:** braces are loose only where the text pairs as it would run: a macro's own braces do on
//! some way through its `#if`s, or the file's do with the calls of its macros expanded, or what its
//! macros open others of them close. So a forgotten brace is still told. Where that refuses a scene
//! of POV-Ray's, it is read again with all of them loose (`road/again.rs`). Linear, but for macros in macros.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::balance::{Opener, Turn, pairs, turn};
use super::token::{Bracket, Head, Mark, Token, TokenKind};

const OPEN: TokenKind = TokenKind::Mark(Mark::Open(Bracket::Brace));
const CLOSE: TokenKind = TokenKind::Mark(Mark::Close(Bracket::Brace));

/// Loosens what pairs only after expansion. The body of a macro whose other brackets do so, too, becomes
/// [`TokenKind::Raw`]. `all`: so does every brace that has no partner where it is written.
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
            // A parenthesis that one branch alone lacks is a mistake.
            None if paths(inside)[..2] == [[0; 3]; 2] => raw.push(body.clone()),
            None => {}
        }
    }
    for body in raw.into_iter().rev() {
        let (start, end) = (tokens[body.start - 1].end, tokens[body.end].start);
        tokens.splice(body, [Token { kind: TokenKind::Raw, start, end }]);
    }
    // A brace in a branch that need not be run may be loose already, and still be what another waits for.
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

/// Whether the text outside of macros pairs where all first branches are run and where all others are:
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

/// The bodies of all macros, by their starts.
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

/// The first token after the head `#macro Name(a, b)` that starts at `start`.
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

/// The braces that have no partner in their own branch; `None` when other brackets have none, either.
fn loose_braces(tokens: &[Token]) -> Option<Vec<usize>> {
    let mut open: Vec<(Opener, usize)> = Vec::new();
    let mut loose = Vec::new();
    // What is open since the innermost directive, all braces.
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

/// Which way each open directive's present branch is on.
struct Branch {
    head: Head,
    /// Of a `#switch`: the way from its first case to the first `#break`.
    first: bool,
    otherwise: bool,
    /// A `#break` stood in it.
    broken: bool,
    /// Whether those around it are all on these ways.
    around: Ways,
}

/// Whether all that is open is on its first branch, and whether all is on its `#else`.
#[derive(Clone, Copy)]
struct Ways {
    first: bool,
    otherwise: bool,
}

/// The directives that are open, and the ways through them: always the first branch, or always `#else`.
#[derive(Default)]
struct Branches(Vec<Branch>);

impl Branches {
    fn turn(&mut self, token: Token) {
        match (turn(token.kind), token.kind) {
            (Some(Turn::Open(Opener::Directive)), TokenKind::Directive(head)) => {
                // Loops turn once or not at all; an inner macro is not run here.
                let first = head != Head::Macro;
                let around = self.ways();
                self.0.push(Branch { head, first, otherwise: false, broken: false, around });
            }
            (Some(Turn::Divide), TokenKind::Directive(head)) => {
                if let Some(branch) = self.0.last_mut() {
                    // A case runs on into the next one up to a `#break`.
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

/// How many more brackets of each kind a text opens than it closes, where all first branches are run, where all
/// others are, and as it is written.
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

/// What running a text does to the braces around it: closes some, then opens some.
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
        // A macro that calls another twice may open twice as much, and so on.
        self.closes = self.closes.saturating_add(next.closes - within);
        self.opens = (self.opens - within).saturating_add(next.opens);
    }

    fn surplus(self) -> i128 {
        i128::from(self.opens) - i128::from(self.closes)
    }
}

/// A text that runs at once: the file's own, or a macro's body.
#[derive(Default)]
struct Run<'t> {
    name: &'t str,
    /// Where its body starts and its head ends.
    body: usize,
    effect: Effect,
    branches: Branches,
}

/// Loosens what one macro opens and another, or the text that calls it, closes; with the braces that are
/// loose already, or without them. `false` when that does not pair.
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
