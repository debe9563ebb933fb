//! `restframe plan`.

use super::{Failed, PlanArguments, failed};

/// Runs the command.
pub(super) fn run(arguments: &PlanArguments) -> Result<(), Failed> {
    Err(failed(&format!("{arguments:?}")))
}
