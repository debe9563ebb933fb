//! Mistakes as a compiler shows them: file, line, the span marked, what would be right.

use super::mistake::{Mistake, Mistakes};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};
use serde_json::{Value, json};
use std::fmt;
use std::ops::Range;

/// Most mistakes that a report shows; the rest is counted.
const MAX_SHOWN: usize = 100;
/// Longest line that is shown, in bytes; of a longer one only the place is named.
const MAX_LINE: usize = 240;
/// Columns of a report.
const WIDTH: usize = 100;

impl Mistakes {
    /// All mistakes for people to read, with terminal colors if `color`.
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

    /// All mistakes for programs: a list of objects with file, line and column (from 1, or null
    /// where no place is known), key, message and help.
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

/// One mistake as miette wants it.
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

/// The text as a terminal may have it, byte for byte in the same places.
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

/// Where the lines of a text begin.
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

    /// The index of the line in which a byte stands.
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

    /// How many lines to show around that of a byte: none if they are long; `None` if it is itself.
    fn context(&self, byte: usize) -> Option<usize> {
        let line = self.line(byte);
        let fits = |line: usize| self.range(line).len() <= MAX_LINE;
        let around = (line.saturating_sub(1)..=line + 1).all(fits);
        fits(line).then_some(usize::from(around))
    }

    /// The part of a span that lies in its first line.
    fn first_line_of(&self, span: &Range<usize>) -> Range<usize> {
        let line = self.range(self.line(span.start));
        let start = span.start.min(self.text.len());
        start..span.end.min(line.end).max(start)
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
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
