//! Suggests what was meant by an invalid command line: an option of another command or of POV-Ray, an
//! option after `--`, or a size in another form.
//!
//! **In:** the words, and clap's error. **Out:** a more helpful [`Failure`], or nothing.

mod size;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory};

use lucarne::accuracy::KNOBS;

use super::arguments::Arguments;
use super::exit::Failure;

/// POV-Ray's switches, without sign and value, and their equivalents here.
const POVRAY: &[(&str, &str)] = &[
    ("w", "`--size 640x480` is what `+W640 +H480` says there: width and height at once"),
    ("h", "`--size 640x480` is what `+W640 +H480` says there: width and height at once"),
    ("i", "the scene is the word without a sign: `lucarne FILE`"),
    ("o", "`-o FILE` chooses where to write, and its extension the format"),
    ("f", "the extension of `-o FILE` chooses the format"),
    ("a", "`--antialias` says how fine: `off`, `3` or `adaptive:0.02:8`"),
    ("am", "`--antialias` says how fine: `off`, `3` or `adaptive:0.02:8`"),
    ("r", "`--antialias 3` sends 3×3 rays a pixel"),
    ("l", "`-I DIR` searches a folder for includes"),
    ("wt", "`--threads N` sets how many"),
    ("sc", "`--region X,Y,W,H` traces a part"),
    ("sr", "`--region X,Y,W,H` traces a part"),
    ("ec", "`--region X,Y,W,H` traces a part"),
    ("er", "`--region X,Y,W,H` traces a part"),
    ("k", "`-D clock=0.5` sets the clock"),
    ("d", "no window is opened: the picture is a file"),
    ("p", "no window is opened: the picture is a file"),
];

/// Returns a more helpful answer than `error`, if there is one.
pub fn meant(words: &[String], error: &clap::Error) -> Option<Failure> {
    let program = Arguments::command();
    let command = words.get(1)?;
    let word = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(word)) => word.split(['=', ' ']).next().unwrap_or(word),
        _ => "",
    };
    match error.kind() {
        ErrorKind::UnknownArgument => behind_dashes(words, word)
            .or_else(|| of_size(&program, words, word))
            .or_else(|| of(&program, command, word)),
        ErrorKind::ValueValidation if word == "--size" => of_size(&program, words, word),
        // `-h240` begins as the flag for help does.
        ErrorKind::DisplayHelp => {
            let height = words.iter().find(|word| word.starts_with("-h") && word.len() > 2)?;
            of_size(&program, words, height)
        }
        _ => None,
    }
}

/// Explains that a word after `--` is a file name even if it looks like an option.
fn behind_dashes(words: &[String], word: &str) -> Option<Failure> {
    let at = words.iter().position(|word| word == "--")?;
    let (before, behind) = (&words[1..at], &words[at + 1..]);
    let is_it = |other: &String| other.split('=').next() == Some(word);
    let command = before.first().filter(|command| *command != "explain")?;
    if before.iter().any(is_it) || !behind.iter().any(is_it) {
        return None;
    }
    let failure = Failure::usage(format!(
        "`{word}` stands behind `--`, where every word is a file name: `lucarne {command}` takes one"
    ));
    let (file, options) = behind.split_first()?;
    if !word.starts_with(['-', '+']) || options.is_empty() {
        return Some(failure);
    }
    let line = [before, options, &["--".to_owned(), file.clone()]].concat();
    Some(failure.help(format!("options go before it: `lucarne {}`", line.join(" "))))
}

/// Suggests `--size 320x240` for a size given in another form.
fn of_size(program: &Command, words: &[String], word: &str) -> Option<Failure> {
    let command = program.find_subcommand(words.get(1)?)?;
    let takes_one = command.get_arguments().any(|argument| argument.get_long() == Some("size"));
    let is_parted = size::is_parted(words);
    let is_one = word == "--size" || size::is_size(word) || is_parted;
    let size::Meant { typed, width, height } =
        (takes_one && is_one).then(|| size::meant(words)).flatten()?;
    let sentence = match word {
        _ if word == "--size" || is_parted => {
            format!("`{typed}` is no WIDTHxHEIGHT in pixels")
        }
        "--width" | "--height" => format!("there is no option `{word}`"),
        _ => format!("`{word}` is an option of POV-Ray's"),
    };
    Some(Failure::usage(sentence).help(format!("did you mean `--size {width}x{height}`?")))
}

/// Returns a more helpful answer than that `command` does not know `word`.
fn of(program: &Command, command: &str, word: &str) -> Option<Failure> {
    let elsewhere = having(program, word);
    if elsewhere.is_empty() {
        return povray(word);
    }
    let list = |commands: &[String]| match commands {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        commands => commands.concat(),
    };
    let sentence =
        format!("`lucarne {command}` has no `{word}`: it is an option of {}", list(&elsewhere));
    let name = word.trim_start_matches('-');
    let help = match (command, name) {
        ("accuracy", name) if KNOBS.iter().any(|knob| knob.name == name) => {
            Some(format!("it tries settings of {name} by itself; `--knobs {name}` tries no others"))
        }
        ("accuracy", "o" | "output") => Some("`--svg OUT.svg` draws the diagram".to_owned()),
        ("accuracy", "time-budget") => Some("`--budget` is how long it may take".to_owned()),
        ("render", "budget") => Some("`--time-budget` is how long it may take".to_owned()),
        _ => None,
    };
    let failure = Failure::usage(sentence);
    Some(match help {
        Some(help) => failure.help(help),
        None => failure,
    })
}

/// Returns the commands that have an option with this name.
fn having(program: &Command, word: &str) -> Vec<String> {
    let is_it = |argument: &clap::Arg| match word.strip_prefix("--") {
        Some(long) => argument.get_long() == Some(long),
        None => argument.get_short().is_some_and(|short| word == format!("-{short}")),
    };
    let has = |command: &&Command| command.get_arguments().any(is_it);
    let named = |command: &Command| format!("`lucarne {}`", command.get_name());
    program.get_subcommands().filter(has).map(named).collect()
}

fn povray(word: &str) -> Option<Failure> {
    let switch = word.strip_prefix(['+', '-'])?.to_ascii_lowercase();
    let fits = |name: &&(&str, &str)| {
        let rest = switch.strip_prefix(name.0);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_alphabetic()))
    };
    let (_, help) = POVRAY.iter().find(fits).or_else(|| {
        // Of files the value is letters, too.
        POVRAY.iter().find(|(name, _)| ["i", "o", "l"].contains(name) && switch.starts_with(name))
    })?;
    Some(Failure::usage(format!("`{word}` is an option of POV-Ray's")).help(help))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(command: &str, word: &str) -> Option<(String, Option<String>)> {
        of(&Arguments::command(), command, word).map(|failure| (failure.sentence, failure.help))
    }

    #[test]
    fn an_option_of_another_command_is_told_with_its_command() {
        let (sentence, help) = said("accuracy", "--antialias").expect("known");
        assert!(
            sentence.contains("`lucarne render`") && sentence.contains("`lucarne accuracy` has no")
        );
        assert!(help.is_some_and(|help| help.contains("`--knobs antialias`")));
        let (sentence, _) = said("plan", "--time-budget").expect("known");
        assert!(sentence.ends_with("it is an option of `lucarne render`"), "{sentence}");
        assert!(said("accuracy", "-o").is_some_and(|(_, help)| help.is_some()));
        assert_eq!(said("render", "--nothing"), None);
    }

    #[test]
    fn a_switch_of_povrays_is_told_what_does_the_same() {
        for (word, flag) in [
            ("+W320", "--size"),
            ("-h240", "--size"),
            ("-w", "--size"),
            ("+A0.1", "--antialias"),
            ("+Iscene.pov", "FILE"),
            ("+Oout.png", "-o FILE"),
            ("+WT4", "--threads"),
            ("-D", "window"),
            ("+K0.5", "clock"),
        ] {
            let help = povray(word).and_then(|failure| failure.help).expect("known");
            assert!(help.contains(flag), "{word}: {help}");
        }
        assert!(povray("+zzz").is_none() && povray("--size").is_none() && povray("w320").is_none());
    }
}
