//! The command line: arguments in, messages and an exit code out.
//!
//! Results go to standard output, progress and diagnostics to standard error. Exit status: 0 if
//! everything was done, 1 if something failed while rendering, 2 for a mistake in the shot or in the
//! arguments, 130 if interrupted (Ctrl-C), 143 if terminated.

mod arguments;
mod assemble;
mod check;
mod messages;
mod open;
mod plan;
mod probe;
mod render;
mod run;
mod study;
mod verify;

use arguments::{
    FinishedArguments, PictureArguments, PlanArguments, ProbeArguments, ProgressMode,
    RenderArguments, StudyArguments, frames,
};
use messages::{
    FAILURE, Failed, MISTAKE, failed, mistaken, misused, pool, print, print_json, say, warn,
};

pub use run::run;
