//! The `restframe` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    restframe::cli::run()
}
