//! What goes to standard output and standard error: long results piece by piece, messages, and the exit
//! code of a failure.

use crate::render::Prepared;
use crate::shot::Mistakes;
use std::io::{self, BufWriter, ErrorKind, IsTerminal, StdoutLock, Write};

/// Exit status for a mistake in the shot or in the arguments.
pub(super) const MISTAKE: u8 = 2;

/// Exit status if something failed while rendering.
pub(super) const FAILURE: u8 = 1;

/// Exit status of a command that failed. The message has been printed already.
pub(super) struct Failed(pub(super) u8);

pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), Failed> {
    let text = serde_json::to_string_pretty(value).map_err(|error| failed(&error.to_string()))?;
    print(&text)
}

/// Prints a line to standard output. A closed pipe, as by `| head`, is not a failure.
pub(super) fn print(text: &str) -> Result<(), Failed> {
    match writeln!(io::stdout().lock(), "{text}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(failed(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints an error that occurred while rendering.
pub(super) fn failed(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(FAILURE)
}

/// Prints an error in the arguments.
pub(super) fn misused(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(MISTAKE)
}

/// Prints the mistakes of a shot, each with its place in the file.
pub(super) fn mistaken(mistakes: &Mistakes) -> Failed {
    say(mistakes.report(color_on_stderr()).trim_end());
    Failed(MISTAKE)
}

/// Prints warnings: content of the shot's files that the image will not show.
pub(super) fn warn(prepared: &Prepared) {
    for warning in prepared.warnings() {
        say(&format!("warning: {warning}"));
    }
}

/// A pool of this many threads; 0 for one per processor.
pub(super) fn pool(threads: u16) -> Result<rayon::ThreadPool, Failed> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .map_err(|error| failed(&error.to_string()))
}

/// Prints a line to standard error. A failure to do so is ignored, since there is nowhere to report
/// it.
pub(super) fn say(line: &str) {
    let _unheard = writeln!(io::stderr().lock(), "{line}");
}

pub(super) fn color_on_stderr() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    io::stderr().is_terminal() && !set("NO_COLOR") && !dumb
}

/// Standard output, until its reader is gone.
pub(super) struct Answer(BufWriter<StdoutLock<'static>>);

/// Whether anybody reads the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reader {
    There,
    Gone,
}

impl Answer {
    pub(super) fn new() -> Self {
        Self(BufWriter::with_capacity(1 << 16, io::stdout().lock()))
    }

    /// Writes text. A closed pipe is not a failure.
    pub(super) fn write(&mut self, text: &str) -> Result<Reader, Failed> {
        told(self.0.write_all(text.as_bytes()))
    }

    /// Writes a value as JSON, serialized piece by piece.
    pub(super) fn json(&mut self, value: &impl serde::Serialize) -> Result<Reader, Failed> {
        told(serde_json::to_writer(&mut self.0, value).map_err(io::Error::from))
    }

    /// Writes the rest of the buffer.
    pub(super) fn end(&mut self) -> Result<(), Failed> {
        told(self.0.flush()).map(|_| ())
    }
}

fn told(written: io::Result<()>) -> Result<Reader, Failed> {
    match written {
        Ok(()) => Ok(Reader::There),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(Reader::Gone),
        Err(error) => Err(failed(&format!("standard output: {error}"))),
    }
}
