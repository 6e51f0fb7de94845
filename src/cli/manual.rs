//! `lucarne completions` and `lucarne man`: what shells and `man` know of the command line.

use clap::CommandFactory;

use super::arguments::{Arguments, CompletionsArguments};
use super::exit::{Exit, Failure, Outcome};
use super::messages;

pub fn completions(arguments: &CompletionsArguments) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "lucarne", &mut script);
    messages::print_with(&|out| out.write_all(&script))?;
    Ok(Exit::Done)
}

/// Prints one page: that of the program, and those of its commands behind it.
pub fn man() -> Outcome {
    let mut pages = Vec::new();
    let mut program = Arguments::command();
    program.build();
    let commands: Vec<_> = program.get_subcommands().cloned().collect();
    let all = std::iter::once(program.clone()).chain(commands);
    for command in all.filter(|command| command.get_name() != "help") {
        clap_mangen::Man::new(command).render(&mut pages).map_err(Failure::file)?;
    }
    messages::print_with(&|out| out.write_all(&pages))?;
    Ok(Exit::Done)
}
