//! The command line as a function: one command, one exit code.

use super::arguments::{Arguments, Command};
use super::messages::{Failed, print_json};
use super::{assemble, check, plan, probe, render, study, verify};
use crate::shot;
use clap::Parser;
use std::process::ExitCode;

/// Runs the command line of this process.
pub fn run() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Check { shots, json } => check::run(&shots, json),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Assemble(arguments) => assemble::run(&arguments),
        Command::Probe(arguments) => probe::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Schema => schema(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failed(status)) => ExitCode::from(status),
    }
}

fn schema() -> Result<(), Failed> {
    print_json(&shot::schema())
}
