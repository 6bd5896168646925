//! The program: reads the command line and says how it ended.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    cli::report(cli::run(cli::Arguments::parse()))
}
