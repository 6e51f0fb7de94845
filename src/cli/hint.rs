//! What is meant by an option that a command does not have: one that another has, or POV-Ray's.
//!
//! **In:** the description of the arguments, the command, the word that it does not know. **Out:** a
//! [`Failure`] that says where such an option is, or nothing.

use clap::Command;

use lucarne::accuracy::KNOBS;

use super::exit::Failure;

/// POV-Ray's switches, without their sign and value, and what does the same here.
const POVRAY: &[(&str, &str)] = &[
    ("w", "`--size 640x480` is what `+W640 +H480` says there: width and height at once"),
    ("h", "`--size 640x480` is what `+W640 +H480` says there: width and height at once"),
    ("i", "the scene is the word without a sign: `lucarne FILE`"),
    ("o", "`-o FILE` chooses where to write, and its extension the format"),
    ("f", "the extension of `-o FILE` chooses the format"),
    ("a", "`--antialias` says how fine: `off`, `3` or `adaptive:0.02:6`"),
    ("am", "`--antialias` says how fine: `off`, `3` or `adaptive:0.02:6`"),
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

/// A better answer than that `command` does not know `word`.
pub fn of(program: &Command, command: &str, word: &str) -> Option<Failure> {
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

/// The commands that have an option of this name.
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
    use clap::CommandFactory;

    use super::super::arguments::Arguments;
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
