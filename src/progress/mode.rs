//! The sinks from which a command line chooses.

use super::bar::Bar;
use super::event::Sink;
use super::json::JsonLines;
use super::open_jd::OpenJd;
use super::text::Text;
use std::sync::OnceLock;

/// How progress is shown on standard error.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mode {
    /// A bar on a terminal, plain lines elsewhere.
    #[default]
    Auto,
    /// A bar; plain lines if standard error is not a terminal that could show one.
    Bar,
    /// One line for each frame.
    Plain,
    /// Events on standard error, one JSON object per line.
    Json,
    /// Plain lines, and in addition the lines of Open Job Description on standard output.
    OpenJd,
    /// Nothing but warnings and errors.
    None,
}

/// Use of standard output.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Results {
    /// Nothing.
    #[default]
    Nothing,
    /// Events, one JSON object per line.
    Events,
}

/// The sinks of this process's streams.
pub(super) fn sinks(mode: Mode, results: Results) -> Vec<Box<dyn Sink>> {
    let bar = matches!(mode, Mode::Auto | Mode::Bar).then(Bar::new);
    let mut sinks: Vec<Box<dyn Sink>> = match (mode, bar.flatten()) {
        (_, Some(bar)) => vec![Box::new(Text::Bar(bar))],
        (Mode::Json, _) => vec![Box::new(JsonLines::Stderr)],
        (Mode::None, _) => vec![Box::new(Text::Notes)],
        (Mode::OpenJd, _) => vec![Box::new(Text::Lines), Box::new(OpenJd::default())],
        _ => vec![Box::new(Text::Lines)],
    };
    if results == Results::Events {
        sinks.push(Box::new(JsonLines::Stdout(OnceLock::new())));
    }
    sinks
}
