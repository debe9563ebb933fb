//! How far the work has come, told on standard error.
//!
//! On a terminal a bar with the time that is left, measured in units of work (the caller's:
//! pixels times their expected cost, say), so that cheap frames do not fool it. Elsewhere one
//! plain line for each finished frame, without escapes or carriage returns.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How progress is told.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mode {
    /// A bar on a terminal, plain lines elsewhere.
    #[default]
    Auto,
    /// A bar; plain lines where standard error is no terminal that could show one.
    Bar,
    /// One line for each finished frame.
    Plain,
    /// Nothing but notes.
    None,
}

/// Progress of one run. Threads may share it. Trouble with standard error is passed over: news
/// of the work must not end the work.
pub struct Progress {
    frames: u64,
    finished: AtomicU64,
    sink: Sink,
}

enum Sink {
    Bar(ProgressBar),
    Lines {
        out: Mutex<Box<dyn Write + Send>>,
        frames: bool,
    },
}

impl Progress {
    /// Begins to tell of `frames` frames that are `work` units of work together.
    pub fn new(mode: Mode, work: u64, frames: u64) -> Self {
        let bar = matches!(mode, Mode::Auto | Mode::Bar) && bar_can_be_shown();
        let sink = if bar {
            Sink::Bar(new_bar(work))
        } else {
            lines(Box::new(io::stderr()), mode != Mode::None)
        };
        Self {
            frames,
            finished: AtomicU64::new(0),
            sink,
        }
    }

    /// Tells that `work` more units are done.
    pub fn advance(&self, work: u64) {
        if let Sink::Bar(bar) = &self.sink {
            bar.inc(work);
        }
    }

    /// Tells that a frame is finished: what it took and the name of its file. The plain line is
    /// `frame 3/49  1.24 s  name.0003.png`, the third of 49 to be finished.
    pub fn frame_finished(&self, took: Duration, name: &str) {
        let finished = self.finished.fetch_add(1, Ordering::Relaxed) + 1;
        let count = format!("frame {finished}/{}", self.frames);
        match &self.sink {
            Sink::Bar(bar) => bar.set_message(format!("{count}  {name}")),
            Sink::Lines { frames: true, .. } => {
                self.note(&format!("{count}  {:.2} s  {name}", took.as_secs_f64()));
            }
            Sink::Lines { .. } => {}
        }
    }

    /// Writes a line of its own (a warning, say), above the bar if there is one; in every mode.
    pub fn note(&self, line: &str) {
        match &self.sink {
            Sink::Bar(bar) => bar.suspend(|| write_line(&mut io::stderr(), line)),
            Sink::Lines { out, .. } => {
                write_line(
                    &mut *out.lock().unwrap_or_else(PoisonError::into_inner),
                    line,
                );
            }
        }
    }

    /// Takes the bar off the screen.
    pub fn finish(self) {}
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Sink::Bar(bar) = &self.sink {
            bar.finish_and_clear();
        }
    }
}

fn lines(out: Box<dyn Write + Send>, frames: bool) -> Sink {
    Sink::Lines {
        out: Mutex::new(out),
        frames,
    }
}

/// The whole line in one call, so that lines of other processes do not come between.
fn write_line(out: &mut impl Write, line: &str) {
    let _ = out.write_all(format!("{line}\n").as_bytes());
}

fn bar_can_be_shown() -> bool {
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    io::stderr().is_terminal() && !dumb
}

fn new_bar(work: u64) -> ProgressBar {
    const TEMPLATE: &str = "{elapsed} [{wide_bar}] {percent:>3} %  {eta} left  {msg}";
    const REDRAW: Duration = Duration::from_millis(500);
    let bar = ProgressBar::with_draw_target(Some(work), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(TEMPLATE);
    bar.set_style(
        style
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .progress_chars("=> "),
    );
    bar.enable_steady_tick(REDRAW);
    bar
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[derive(Clone, Default)]
    struct Page(Arc<Mutex<Vec<u8>>>);

    impl Write for Page {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.lock().expect("one thread").extend(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn told(frames: bool) -> String {
        let page = Page::default();
        let sink = lines(Box::new(page.clone()), frames);
        let progress = Progress {
            frames: 49,
            finished: AtomicU64::new(0),
            sink,
        };
        progress.advance(7);
        progress.frame_finished(Duration::from_millis(1240), "name.0001.png");
        progress.note("warning: all is black");
        progress.frame_finished(Duration::from_secs(0), "name.0002.png");
        progress.finish();
        let bytes = page.0.lock().expect("one thread").clone();
        String::from_utf8(bytes).expect("text")
    }

    #[test]
    fn plain_progress_is_one_line_for_each_frame() {
        let expected = "frame 1/49  1.24 s  name.0001.png\n\
                        warning: all is black\n\
                        frame 2/49  0.00 s  name.0002.png\n";
        assert_eq!(told(true), expected);
    }

    #[test]
    fn quiet_progress_keeps_the_notes() {
        assert_eq!(told(false), "warning: all is black\n");
    }

    #[test]
    fn the_template_of_the_bar_is_understood() {
        let bar = new_bar(10);
        bar.inc(3);
        assert_eq!((bar.position(), bar.length()), (3, Some(10)));
        bar.finish_and_clear();
    }
}
