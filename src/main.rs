//! Entry point of the program: passes the command line to `cli` and returns its exit code.
#![forbid(unsafe_code)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
