//! Reports of mistakes: for people as a compiler shows them (file, line, marked span, remedy), and for
//! programs as JSON.

use super::mistake::{Mistake, Mistakes};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};
use serde_json::{Value, json};
use std::fmt;
use std::ops::Range;

/// Number of mistakes that a report shows; the rest is counted.
const MAX_SHOWN: usize = 100;
/// Length of the longest line that is shown, in bytes; of a longer one only the place is named.
const MAX_LINE: usize = 240;
/// Width of a report, in columns.
const WIDTH: usize = 100;

impl Mistakes {
    /// The mistakes as text for people, with terminal colors if `color`.
    pub fn report(&self, color: bool) -> String {
        let name = self.path().display().to_string();
        let source = NamedSource::new(name, printable(self.text()));
        let lines = Lines::new(self.text());
        let mut report = String::new();
        for mistake in self.iter().take(MAX_SHOWN) {
            report.push_str(&rendered(mistake, &source, &lines, color));
        }
        if let Some(more) = self.len().checked_sub(MAX_SHOWN).filter(|more| *more > 0) {
            report.push_str(&format!("and {more} more mistakes\n"));
        }
        report
    }

    /// The mistakes as JSON for programs: a list of objects with file, line and column (from 1; null
    /// if no place is known), key, message and help.
    pub fn json(&self) -> Value {
        let lines = Lines::new(self.text());
        let file = self.path().display().to_string();
        let object = |mistake: &Mistake| {
            let place = mistake.span.as_ref().map(|span| lines.place(span.start));
            json!({
                "file": file,
                "line": place.map(|(line, _)| line),
                "column": place.map(|(_, column)| column),
                "key": mistake.key,
                "message": mistake.message,
                "help": mistake.help,
            })
        };
        self.iter().map(object).collect()
    }
}

fn rendered(
    mistake: &Mistake,
    source: &NamedSource<String>,
    lines: &Lines<'_>,
    color: bool,
) -> String {
    let theme = if color {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let span = mistake.span.as_ref().filter(|_| !lines.text.is_empty());
    let context = span.and_then(|span| lines.context(span.start));
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(WIDTH)
        .with_links(false)
        .with_context_lines(context.unwrap_or(0));
    let message = match (span, context) {
        (Some(_), Some(_)) => mistake.message.clone(),
        (Some(span), None) => {
            let (line, column) = lines.place(span.start);
            format!("{}:{line}:{column}: {}", source.name(), mistake.message)
        }
        (None, _) => format!("{}: {}", source.name(), mistake.message),
    };
    let marked = span
        .filter(|_| context.is_some())
        .map(|span| lines.first_line_of(span));
    let diagnostic = Diagnostic {
        message,
        mistake,
        source,
        marked,
    };
    let mut text = String::new();
    match handler.render_report(&mut text, &diagnostic) {
        Ok(()) => text,
        Err(fmt::Error) => format!("{}\n", diagnostic.message),
    }
}

/// One mistake in the form that miette prints.
#[derive(Debug)]
struct Diagnostic<'a> {
    message: String,
    mistake: &'a Mistake,
    source: &'a NamedSource<String>,
    marked: Option<Range<usize>>,
}

impl fmt::Display for Diagnostic<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Diagnostic<'_> {}

impl miette::Diagnostic for Diagnostic<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.mistake
            .help
            .as_ref()
            .map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.marked.as_ref().map(|_| self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let marked = self.marked.clone()?;
        let label = Some(self.mistake.label.clone()).filter(|label| !label.is_empty());
        let span = LabeledSpan::new_with_span(label, marked);
        Some(Box::new(std::iter::once(span)))
    }
}

/// The text with control characters replaced, so that it is safe on a terminal. Byte positions stay.
fn printable(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() && !matches!(c, '\n' | '\r' | '\t') {
            safe.extend(std::iter::repeat_n('?', c.len_utf8()));
        } else {
            safe.push(c);
        }
    }
    safe
}

/// The positions at which the lines of a text begin.
struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let starts = std::iter::once(0)
            .chain(breaks.map(|(at, _)| at + 1))
            .collect();
        Lines { text, starts }
    }

    /// The index of the line that contains a byte.
    fn line(&self, byte: usize) -> usize {
        self.starts
            .partition_point(|start| *start <= byte)
            .saturating_sub(1)
    }

    fn range(&self, line: usize) -> Range<usize> {
        let start = self.starts.get(line).copied().unwrap_or(self.text.len());
        start
            ..self
                .starts
                .get(line + 1)
                .map_or(self.text.len(), |next| next - 1)
    }

    /// Line and column, in characters, from 1.
    fn place(&self, byte: usize) -> (usize, usize) {
        let line = self.line(byte);
        let start = self.range(line).start;
        let before = self
            .text
            .as_bytes()
            .get(start..byte.min(self.text.len()))
            .unwrap_or_default();
        // Bytes 10xxxxxx continue a character of UTF-8.
        (
            line + 1,
            1 + before.iter().filter(|byte| **byte & 0xc0 != 0x80).count(),
        )
    }

    /// Number of lines to show around that of a byte: 0 if the neighbors are too long; None if the line
    /// itself is.
    fn context(&self, byte: usize) -> Option<usize> {
        let line = self.line(byte);
        let fits = |line: usize| self.range(line).len() <= MAX_LINE;
        let around = (line.saturating_sub(1)..=line + 1).all(fits);
        fits(line).then_some(usize::from(around))
    }

    /// The part of a span in its first line.
    fn first_line_of(&self, span: &Range<usize>) -> Range<usize> {
        let line = self.range(self.line(span.start));
        let start = span.start.min(self.text.len());
        start..span.end.min(line.end).max(start)
    }
}

#[cfg(test)]
mod tests {
    use crate::shot::parse;
    use std::path::Path;

    #[test]
    fn json_has_line_and_column_of_each_mistake() {
        let mistakes = parse("[shot]\nframes = 0\n", Path::new("a.toml")).unwrap_err();
        let json = mistakes.json();
        let frames = json
            .as_array()
            .unwrap()
            .iter()
            .find(|m| m["key"] == "shot.frames")
            .unwrap();
        assert_eq!(
            (&frames["line"], &frames["column"]),
            (&2.into(), &10.into())
        );
        assert_eq!(frames["file"], "a.toml");
    }

    #[test]
    fn a_line_too_long_to_show_is_named() {
        let source = format!(
            "[shot]\ntitle = \"{}\"\nframes = 0{}\n",
            "x",
            " ".repeat(5000)
        );
        let report = parse(&source, Path::new("a.toml"))
            .unwrap_err()
            .report(false);
        assert!(report.contains("a.toml:3:10: `shot.frames`"), "{report}");
        assert!(report.len() < 4000);
    }

    #[test]
    fn plain_reports_have_no_escape_and_colored_ones_do() {
        let mistakes = parse("[shot]\nframes = 0 # \u{85}\n", Path::new("a.toml")).unwrap_err();
        assert!(
            !mistakes
                .report(false)
                .chars()
                .any(|c| c.is_control() && c != '\n')
        );
        assert!(mistakes.report(true).contains('\u{1b}'));
    }
}
