//! Long results on standard output, written piece by piece.

use super::{Failed, failed};
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};

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
