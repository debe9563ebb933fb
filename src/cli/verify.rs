//! `restframe verify`.

use super::{Failed, FinishedArguments, failed};

/// Runs the command.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    Err(failed(&format!("{arguments:?}")))
}
