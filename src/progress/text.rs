//! Events for people, on standard error: a bar with the time left on a terminal, elsewhere one
//! plain line for each frame, without escapes or carriage returns.

use super::bar::Bar;
use super::event::FrameOutcome;
use super::event::{Event, Sink, Summary};
use std::io::{self, Write};
use std::path::PathBuf;

/// Which events are shown. Failures to write are ignored.
pub(super) enum Text {
    /// A bar, with the last frame beside it.
    Bar(Bar),
    /// A line for each frame.
    Lines,
    /// Warnings and errors only.
    Notes,
}

impl Sink for Text {
    fn event(&self, event: &Event<'_>) {
        match event {
            Event::Start { .. } => {
                if let Self::Bar(bar) = self {
                    bar.begin();
                }
            }
            Event::Advance { share } => {
                if let Self::Bar(bar) = self {
                    bar.show(*share);
                }
            }
            Event::Frame {
                outcome,
                files,
                settled,
                frames,
                ..
            } => {
                let line = frame_line([*settled, *frames], outcome, files);
                match self {
                    Self::Bar(bar) => bar.label(line),
                    Self::Lines => self.print(&line),
                    Self::Notes => {}
                }
            }
            Event::Warning(message) => self.note("warning", message),
            Event::Error(message) => self.note("error", message),
            Event::Assembled(file) => {
                if !matches!(self, Self::Notes) {
                    self.print(&format!("assembled  {}", file.display()));
                }
            }
            Event::End(summary) => self.end(summary),
        }
    }
}

impl Text {
    fn end(&self, summary: &Summary) {
        if let Self::Bar(bar) = self {
            bar.end();
        }
        let Summary {
            rendered,
            kept,
            failed,
            left,
            exit,
            ..
        } = *summary;
        if exit > 2 && rendered + kept + failed + left == 0 {
            self.note("stopped", "no frame was begun");
        } else if exit > 2 {
            let s = if rendered + kept == 1 { "" } else { "s" };
            self.note(
                "stopped",
                &format!(
                    "{} frame{s} finished, {} left; the same call goes on from there",
                    rendered + kept,
                    left + failed
                ),
            );
        } else if matches!(self, Self::Bar(_)) && exit < 2 {
            self.print(&format!(
                "{rendered} rendered, {kept} kept, {} missing",
                left + failed
            ));
        }
    }

    /// A line with its kind before it.
    fn note(&self, kind: &str, message: &str) {
        self.print(&format!("{kind}: {message}"));
    }

    fn print(&self, line: &str) {
        let write = || drop(write_line(&mut io::stderr().lock(), line));
        match self {
            Self::Bar(bar) => bar.suspend(write),
            _ => write(),
        }
    }
}

impl Drop for Text {
    fn drop(&mut self) {
        if let Self::Bar(bar) = self {
            bar.end();
        }
    }
}

/// `frame 3/49  rendered  1.24 s  name.0003.png  stale because …`, the third of 49 settled.
pub(super) fn frame_line(
    [settled, frames]: [u64; 2],
    outcome: &FrameOutcome,
    files: &[PathBuf],
) -> String {
    let mut line = format!("frame {settled}/{frames}  {}", outcome.word());
    if let FrameOutcome::Rendered { seconds, .. } = outcome {
        line += &format!("  {seconds:.2} s");
    }
    let name = files.first().and_then(|file| file.file_name());
    line += &format!("  {}", name.unwrap_or_default().display());
    match outcome {
        // A failure has an error message of its own.
        FrameOutcome::Failed { .. } => {}
        outcome => line.extend(outcome.reason().map(|reason| format!("  {reason}"))),
    }
    line
}

/// Writes the whole line in one call, so that lines of other processes do not interleave.
pub(super) fn write_line(out: &mut impl Write, line: &str) -> io::Result<()> {
    out.write_all(format!("{line}\n").as_bytes())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rendered(reason: Option<&str>) -> FrameOutcome {
        FrameOutcome::Rendered {
            reason: reason.map(str::to_owned),
            seconds: 1.2449,
            cut: 0.0,
        }
    }

    #[test]
    fn the_plain_line_tells_the_outcome_and_why() {
        let files = [PathBuf::from("out/name/name.0003.png")];
        assert_eq!(
            frame_line([3, 49], &rendered(None), &files),
            "frame 3/49  rendered  1.24 s  name.0003.png"
        );
        assert_eq!(
            frame_line(
                [3, 49],
                &rendered(Some("stale because a is 2, was 1")),
                &files
            ),
            "frame 3/49  rendered  1.24 s  name.0003.png  stale because a is 2, was 1"
        );
        assert_eq!(
            frame_line([1, 1], &FrameOutcome::Kept { reason: None }, &files),
            "frame 1/1  kept  name.0003.png"
        );
    }
}
