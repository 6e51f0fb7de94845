//! The command-line program; each command has its own file.
//!
//! **Architecture invariant:** this is the only module that prints, accesses disks and exits.

mod accuracy;
mod animation;
mod arguments;
mod budget;
mod check;
mod checkpoint;
mod exit;
mod explain;
mod files;
mod fmt;
mod frames;
mod heartbeat;
mod hint;
mod ini;
mod kept;
mod language;
mod manual;
mod merge;
mod messages;
mod output;
mod plan;
mod povray;
mod progress;
mod promise;
mod render;
mod scene;
mod show;
mod stats;
mod stop;
mod text;
mod values;

use std::ffi::OsString;
use std::panic;
use std::path::Path;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use lucarne::diagnostic::suggest::closest;

use arguments::{Arguments, Command};
use exit::{Exit, Failure, Outcome};
use ini::Ini;
use stop::Cause;

/// Parses the command line, runs the command and returns its exit code.
pub fn main() -> ExitCode {
    guarded(|| {
        let words: Vec<OsString> = std::env::args_os().collect();
        if let Some(words) = povray::words(&words) {
            return povray::run(words);
        }
        let exit = parsed(complete(words)).and_then(run).unwrap_or_else(|failure| {
            messages::fail(&failure);
            failure.exit
        });
        exit.into()
    })
}

/// Parses the words, and those that an INI file adds as the file of `render`.
fn parsed(mut words: Vec<OsString>) -> Result<Arguments, Failure> {
    let mut arguments = parsed_alone(&words)?;
    let Command::Render(render) = &arguments.command else { return Ok(arguments) };
    let Some(ini) = Ini::read(&render.file)? else { return Ok(arguments) };
    // Behind the name of the command.
    let more = ini.words(&words);
    words.splice(2..2, more);
    arguments = parsed_alone(&words)?;
    if let Command::Render(render) = &mut arguments.command {
        render.file = ini.scene;
    }
    Ok(arguments)
}

/// Parses words. If they are invalid, fails with clap's answer or a more helpful one.
fn parsed_alone(words: &[OsString]) -> Result<Arguments, Failure> {
    Arguments::try_parse_from(words).map_err(|error| {
        let words: Vec<String> =
            words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
        hint::meant(&words, &error).unwrap_or_else(|| error.exit())
    })
}

fn run(arguments: Arguments) -> Outcome {
    let before_tracing = match arguments.command {
        Command::Render(_) => "interrupted: nothing was written\n",
        _ => "interrupted\n",
    };
    let is_part = |command: &Command| matches!(command, Command::Render(arguments) if arguments.work.shard.is_some());
    // A part is rendered again by whoever divided the picture.
    let interrupted = if is_part(&arguments.command) { Exit::Again } else { Exit::Interrupted };
    stop::hear_interrupts(before_tracing, interrupted as i32);
    if let Command::Render(arguments) = &arguments.command {
        stop::limit(arguments.work.time, arguments.work.memory)?;
    }
    if let Some(scene) = arguments.command.scene() {
        files::exist(&scene.include)?;
    }
    let exit = match arguments.command {
        Command::Render(arguments) => match arguments.animation.range() {
            Some(range) => frames::run(&arguments, &range),
            None => render::run(&arguments),
        },
        Command::Check(arguments) => check::run(&arguments),
        Command::Fmt(arguments) => fmt::run(&arguments),
        Command::Show(arguments) => show::run(&arguments),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Accuracy(arguments) => accuracy::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Completions(arguments) => manual::completions(&arguments),
        Command::Man => manual::man(),
        Command::Explain(arguments) => explain::run(&arguments),
    }?;
    Ok(match (exit, stop::cause()) {
        // The limit was Ctrl-C.
        (Exit::Limit | Exit::Interrupted, Some(Cause::Interrupt)) => interrupted,
        (Exit::Interrupted, Some(Cause::Time(_) | Cause::Memory(_))) => Exit::Limit,
        _ => exit,
    })
}

/// Runs `work`, and turns a panic into a message on how to report the bug.
fn guarded(work: impl FnOnce() -> ExitCode + panic::UnwindSafe) -> ExitCode {
    panic::set_hook(Box::new(|info| {
        messages::eprint(&format!(
            "lucarne {}: internal error: {info}\n",
            env!("CARGO_PKG_VERSION")
        ));
    }));
    panic::catch_unwind(work).unwrap_or_else(|_| {
        messages::eprint(
            "This is a bug in lucarne, not in your scene. Please report it with the lines above, \
             the command line\nand the scene (the smaller the better), where you got lucarne from.\n",
        );
        Exit::Panic.into()
    })
}

/// Expands `lucarne FILE` to `lucarne render FILE`, and `--stats json` to `--stats=json`.
fn complete(mut arguments: Vec<OsString>) -> Vec<OsString> {
    let command = Arguments::command();
    let is_command = |word: &str| {
        word == "help" || command.get_subcommands().any(|command| command.get_name() == word)
    };
    let first = arguments.get(1).map(|first| first.to_string_lossy().into_owned());
    let render = first.is_some_and(|first| {
        let names = command.get_subcommands().map(|command| command.get_name());
        // Probably a misspelt subcommand, unless such a file exists.
        let misspelt = !first.contains('.')
            && closest(&first, names).is_some()
            && !Path::new(&first).exists()
            && text::as_scene(Path::new(&first)).is_none();
        let ours = ["-h", "--help", "-V", "--version"].contains(&first.as_str());
        !ours && !is_command(&first) && !misspelt
    });
    if render {
        arguments.insert(1, "render".into());
    }
    // A word that is not a file is a format, possibly an invalid one.
    let is_format = |word: &OsString| {
        let text = word.to_string_lossy();
        !text.is_empty() && text.chars().all(char::is_alphanumeric) && !Path::new(word).exists()
    };
    let options = arguments.split(|word| word == "--").next().unwrap_or_default();
    if let Some(at) = options.windows(2).position(|two| two[0] == "--stats" && is_format(&two[1])) {
        let mut whole = OsString::from("--stats=");
        whole.push(&arguments[at + 1]);
        arguments.splice(at..at + 2, [whole]);
    }
    arguments
}

#[cfg(test)]
mod tests {
    use super::*;

    fn completed(words: &str) -> String {
        let words = words.split(' ').map(OsString::from).collect();
        let words: Vec<String> =
            complete(words).into_iter().filter_map(|word| word.into_string().ok()).collect();
        words.join(" ")
    }

    #[test]
    fn a_file_alone_means_render() {
        assert_eq!(completed("lucarne a.scene"), "lucarne render a.scene");
        assert_eq!(completed("lucarne --size 3x3 a.scene"), "lucarne render --size 3x3 a.scene");
        assert_eq!(completed("lucarne check a.scene"), "lucarne check a.scene");
        assert_eq!(completed("lucarne --help"), "lucarne --help");
        assert_eq!(completed("lucarne chekc a.scene"), "lucarne chekc a.scene");
        assert_eq!(completed("lucarne"), "lucarne");
    }

    #[test]
    fn stats_takes_json_as_its_next_word() {
        assert_eq!(
            completed("lucarne a.scene --stats json"),
            "lucarne render a.scene --stats=json"
        );
        assert_eq!(completed("lucarne a.scene --stats xml"), "lucarne render a.scene --stats=xml");
        assert_eq!(completed("lucarne --stats a.scene"), "lucarne render --stats a.scene");
    }

    #[test]
    fn a_panic_ends_with_seventy() {
        assert_eq!(guarded(|| panic!("a planted fault")), Exit::Panic.into());
        assert_eq!(guarded(|| Exit::Done.into()), Exit::Done.into());
        let _ = panic::take_hook();
    }
}
