//! The head of a counting loop of another language, as it is written here: `i = 10 downto 1`,
//! `i = 10; i > 0; i -= 2`, `i in 0..<10`, `i in range(10, 0, -1)`.
//!
//! **In:** the text between the loop's word and its body, and the counter's name. **Out:** what stands in the
//! parentheses of a `#for`. **Invariant:** only what is read whole; anything else has no sample.

/// What a `#for` counts, as its author wrote the numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Sample {
    pub text: String,
    /// Whether there is one way only to read it: `0..9` has the 9 here and not there.
    pub certain: bool,
}

/// The numbers of a loop, before it is known in which direction it counts.
struct Counts {
    first: String,
    last: String,
    step: Option<String>,
    /// Counts down, as a word or a comparison says.
    down: bool,
    /// The last number is the first that is not reached.
    exclusive: bool,
    certain: bool,
}

pub(super) fn sample(text: &str, name: &str) -> Option<Sample> {
    let pieces = pieces(text)?;
    if pieces.windows(2).any(calls) {
        return None;
    }
    let pieces: Vec<&str> = pieces
        .into_iter()
        .filter(|piece| !matches!(*piece, "(" | ")" | "[" | "]" | "do" | "const"))
        .filter(|piece| !matches!(*piece, "int" | "let" | "var" | "float" | "double" | "auto"))
        .collect();
    let (&counter, rest) = pieces.split_first()?;
    if counter != name {
        return None;
    }
    let rest = match rest {
        [rest @ .., ":"] => rest,
        rest => rest,
    };
    let counts = if rest.contains(&";") { compared(rest, name) } else { joined(rest) }?;
    counts.sample(name)
}

/// `n(`: what a function gives is not known here.
fn calls(two: &[&str]) -> bool {
    let is_name = two[0].starts_with(|c: char| c.is_alphabetic() || c == '_');
    is_name && two[1] == "(" && !matches!(two[0], "range" | "in")
}

/// `= 10 ; i > 0 ; i -= 2`.
fn compared(rest: &[&str], name: &str) -> Option<Counts> {
    let mut parts = rest.split(|piece| *piece == ";");
    let (start, test, turn) = (parts.next()?, parts.next()?, parts.next()?);
    let first = start.strip_prefix(&["="]).and_then(operand)?;
    let [counter, comparison, last @ ..] = test else { return None };
    let (below, exclusive) = match *comparison {
        "<" => (true, true),
        "<=" => (true, false),
        ">" => (false, true),
        ">=" => (false, false),
        _ => return None,
    };
    let step = match *turn {
        [_, "++"] | ["++", _] => "1".to_owned(),
        [_, "--"] | ["--", _] => "-1".to_owned(),
        [_, "+=", ref by @ ..] | [_, "=", _, "+", ref by @ ..] => operand(by)?,
        [_, "-=", ref by @ ..] | [_, "=", _, "-", ref by @ ..] => format!("-{}", operand(by)?),
        _ => return None,
    };
    // It has to go where the comparison ends it.
    let certain = parts.next().is_none() && *counter == name && below != step.starts_with('-');
    let counts =
        Counts { first, last: operand(last)?, step: Some(step), down: false, exclusive, certain };
    certain.then_some(counts)
}

/// `= 10 downto 1 step 2`, `in 0 ..< 10`, `= 0 : 2 : 10`.
fn joined(rest: &[&str]) -> Option<Counts> {
    let (mut numbers, mut step): (Vec<String>, _) = (Vec::new(), None);
    let (mut down, mut exclusive, mut certain) = (false, false, true);
    let (mut colons, mut steps, mut at) = (0, false, 0);
    while let Some(piece) = rest.get(at) {
        at += 1;
        match *piece {
            "in" | "=" | "to" | "until" | "upto" | "from" | "," | "..=" => {}
            "downto" | "down" => down = true,
            "range" | "..<" => exclusive = true,
            ".." | "..." => certain = false,
            ":" => colons += 1,
            "step" | "by" => steps = true,
            _ => {
                let length = if *piece == "-" { 2 } else { 1 };
                let number = operand(rest.get(at - 1..at - 1 + length)?)?;
                at += length - 1;
                match steps {
                    true => step = Some(number),
                    false => numbers.push(number),
                }
            }
        }
    }
    if colons == 2 && numbers.len() == 3 {
        // The step stands in the middle.
        numbers.swap(1, 2);
    }
    let (first, last, third) = match numbers.as_mut_slice() {
        [last] if exclusive => ("0".to_owned(), last.clone(), None),
        [first, last] => (first.clone(), last.clone(), None),
        [first, last, step] => (first.clone(), last.clone(), Some(step.clone())),
        _ => return None,
    };
    let step = step.or(third);
    Some(Counts { first, last, step, down, exclusive, certain })
}

impl Counts {
    fn sample(self, name: &str) -> Option<Sample> {
        let Self { first, mut last, step, down, exclusive, certain } = self;
        let whole = |text: &str| text.parse::<i64>().ok();
        let falls = matches!((whole(&first), whole(&last)), (Some(a), Some(b)) if a > b);
        let step = match step {
            Some(step) if down && !step.starts_with('-') => format!("-{step}"),
            Some(step) => step,
            None if down || (falls && !exclusive) => "-1".to_owned(),
            None => "1".to_owned(),
        };
        if exclusive {
            // The one before it, where the loop counts whole numbers.
            whole(&step)?;
            let back = step.starts_with('-');
            last = match whole(&last) {
                Some(last) => last.checked_add(if back { 1 } else { -1 })?.to_string(),
                None if last.contains('.') => return None,
                None => format!("{last} {} 1", if back { '+' } else { '-' }),
            };
        }
        let step = if step == "1" { String::new() } else { format!(", {step}") };
        Some(Sample { text: format!("({name}, {first}, {last}{step})"), certain })
    }
}

/// A number or a name, with or without a sign.
fn operand(pieces: &[&str]) -> Option<String> {
    let value = |piece: &str| piece.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
    match *pieces {
        [one] if value(one) => Some(one.to_owned()),
        ["-", one] if value(one) => Some(format!("-{one}")),
        _ => None,
    }
}

/// Numbers, names and signs; `0..9` is two numbers.
fn pieces(text: &str) -> Option<Vec<&str>> {
    const SIGNS: &[&str] =
        &["..<", "..=", "...", "..", "<=", ">=", "++", "--", "+=", "-=", "<", ">", "=", ":"];
    let (mut pieces, mut rest) = (Vec::new(), text.trim_start());
    while let Some(first) = rest.chars().next() {
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let length = if first.is_ascii_digit() {
            let whole = digits(rest);
            match rest[whole..].strip_prefix('.').map(digits) {
                Some(fraction @ 1..) => whole + 1 + fraction,
                _ => whole,
            }
        } else if first.is_ascii_alphabetic() || first == '_' {
            rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len())
        } else if let Some(sign) = SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
            sign.len()
        } else if matches!(first, ';' | ',' | '(' | ')' | '[' | ']' | '+' | '-') {
            1
        } else {
            return None;
        };
        pieces.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    Some(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Option<String> {
        sample(text, "i").map(|sample| sample.text)
    }

    #[test]
    fn loops_that_count_down_or_by_steps_are_read() {
        for (theirs, ours) in [
            ("i = 10 downto 1", "(i, 10, 1, -1)"),
            ("i = 10 downto 1 step 2", "(i, 10, 1, -2)"),
            ("(i = 10; i > 0; i--)", "(i, 10, 1, -1)"),
            ("int i = 10; i >= 0; i -= 2", "(i, 10, 0, -2)"),
            ("i=0;i<9;i+=2", "(i, 0, 8, 2)"),
            ("i in 0..<10", "(i, 0, 9)"),
            ("i in 0..=10", "(i, 0, 10)"),
            ("i in range(0, 10, 2):", "(i, 0, 9, 2)"),
            ("i in range(N, 0, -1):", "(i, N, 1, -1)"),
            ("i = 0:2:10", "(i, 0, 10, 2)"),
            ("i = 0 to 1 step 0.25", "(i, 0, 1, 0.25)"),
            ("i = 10 to 1", "(i, 10, 1, -1)"),
        ] {
            assert_eq!(of(theirs).as_deref(), Some(ours), "{theirs}");
        }
    }

    #[test]
    fn a_loop_that_is_not_understood_whole_has_no_sample() {
        for theirs in ["i = 0; i < n(); i++", "x in list", "i = 0; i > 9; i++", "i in a*2..3", "i"]
        {
            assert_eq!(of(theirs), None, "{theirs}");
        }
    }

    #[test]
    fn whether_two_dots_reach_the_end_is_not_certain() {
        let sample = sample("i in 0..9", "i");
        assert_eq!(sample, Some(Sample { text: "(i, 0, 9)".to_owned(), certain: false }));
    }
}
