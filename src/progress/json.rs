//! Events for programs: one JSON object a line, each with its kind as `event`.

use super::event::{Event, Sink, Summary};
use super::text::write_line;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, ErrorKind};
use std::path::PathBuf;
use std::sync::OnceLock;

/// Version of what the lines say.
const SCHEMA_VERSION: u32 = 1;

/// A stream that gets a line for each event.
pub(super) enum JsonLines {
    /// Standard error: what cannot be written is passed over.
    Stderr,
    /// Standard output, and the first error of it.
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

/// A line on standard output; the first error is kept. A reader who has gone away is no trouble.
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

/// The object on one line; none for shares of work, which are too many.
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
