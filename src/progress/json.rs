//! Events for programs: one JSON object per line, with its kind as `event`.

use super::event::{Event, Sink, Summary};
use super::text::write_line;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, ErrorKind};
use std::path::PathBuf;
use std::sync::OnceLock;

/// Version of the format of the lines.
const SCHEMA_VERSION: u32 = 1;

/// A stream that receives a line for each event.
pub(super) enum JsonLines {
    /// Standard error: failures to write are ignored.
    Stderr,
    /// Standard output, and its first error.
    Stdout(OnceLock<io::Error>),
}

impl Sink for JsonLines {
    fn event(&self, event: &Event<'_>) {
        let Some(line) = line(event) else {
            return;
        };
        match self {
            Self::Stderr => drop(write_line(&mut io::stderr().lock(), &line)),
            Self::Stdout(trouble) => answer(&line, trouble),
        }
    }

    fn trouble(&self) -> Option<&io::Error> {
        match self {
            Self::Stderr => None,
            Self::Stdout(trouble) => trouble.get(),
        }
    }
}

/// Writes a line to standard output; the first error is kept. A closed pipe is not an error.
pub(super) fn answer(line: &str, trouble: &OnceLock<io::Error>) {
    if let Err(error) = write_line(&mut io::stdout().lock(), line)
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = trouble.set(error);
    }
}

/// An event as programs read it.
#[derive(Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
enum Line<'a> {
    Start {
        schema_version: u32,
        shots: Vec<Cow<'a, str>>,
        frames: u64,
    },
    Frame {
        shot: Cow<'a, str>,
        frame: u32,
        status: &'static str,
        because: Option<&'a str>,
        seconds: f64,
        cut: f64,
        files: Vec<Cow<'a, str>>,
    },
    Warning {
        message: &'a str,
    },
    Error {
        message: &'a str,
    },
    Assembled {
        file: Cow<'a, str>,
    },
    Summary(Summary),
}

/// The object on one line; None for shares of work, which are too many.
fn line(event: &Event<'_>) -> Option<String> {
    let line = match event {
        Event::Advance { .. } => return None,
        Event::Start { shots, frames } => Line::Start {
            schema_version: SCHEMA_VERSION,
            shots: texts(shots),
            frames: *frames,
        },
        Event::Frame {
            shot,
            frame,
            outcome,
            files,
            ..
        } => Line::Frame {
            shot: shot.to_string_lossy(),
            frame: *frame,
            status: outcome.word(),
            because: outcome.reason(),
            seconds: outcome.seconds(),
            cut: outcome.cut(),
            files: texts(files),
        },
        Event::Warning(message) => Line::Warning { message },
        Event::Error(message) => Line::Error { message },
        Event::Assembled(file) => Line::Assembled {
            file: file.to_string_lossy(),
        },
        Event::End(summary) => Line::Summary(*summary),
    };
    Some(serde_json::to_string(&line).expect("texts and numbers have JSON"))
}

/// Paths as UTF-8 strings (lossy).
fn texts(paths: &[PathBuf]) -> Vec<Cow<'_, str>> {
    paths.iter().map(|path| path.to_string_lossy()).collect()
}
