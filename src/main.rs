//! The program: hands the command line to `cli` and its answer to the system.
#![forbid(unsafe_code)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
