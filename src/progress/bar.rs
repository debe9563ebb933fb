//! The bar on a terminal: share of the work done, and time left.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write as _;
use std::io::{self, IsTerminal};
use std::time::Duration;

/// The whole work, in units of the bar.
const WHOLE: u64 = 1_000_000;

/// A bar on standard error.
pub(super) struct Bar(ProgressBar);

impl Bar {
    /// A bar, if standard error can show one.
    pub(super) fn new() -> Option<Self> {
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        (io::stderr().is_terminal() && !dumb).then(|| Self(new_bar()))
    }

    /// Starts measuring time.
    pub(super) fn begin(&self) {
        self.0.reset_elapsed();
    }

    /// Shows how much is done, as a share of the whole.
    pub(super) fn show(&self, share: f64) {
        self.0.set_position((share * WHOLE as f64) as u64);
    }

    /// Shows a short text beside it.
    pub(super) fn label(&self, words: String) {
        self.0.set_message(words);
    }

    /// Runs `act` while the bar is off the screen.
    pub(super) fn suspend(&self, act: impl FnOnce()) {
        self.0.suspend(act);
    }

    /// Removes it from the screen.
    pub(super) fn end(&self) {
        self.0.finish_and_clear();
    }
}

fn new_bar() -> ProgressBar {
    const TEMPLATE: &str = "{elapsed} [{wide_bar}] {percent:>3} %  {left} left  {msg}";
    const REDRAW: Duration = Duration::from_millis(500);
    let bar = ProgressBar::with_draw_target(Some(WHOLE), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(TEMPLATE);
    bar.set_style(
        style
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key(
                "left",
                |state: &ProgressState, out: &mut dyn std::fmt::Write| {
                    let done = state.pos() as f64 / WHOLE as f64;
                    let _ = out.write_str(&left(done, state.elapsed()));
                },
            )
            .progress_chars("=> "),
    );
    bar.enable_steady_tick(REDRAW);
    bar
}

/// The time left: remaining work over the rate so far. Work is counted in expected cost, so that
/// cheap frames do not distort it.
fn left(done: f64, elapsed: Duration) -> String {
    if done <= 0.0 {
        return "?".to_owned();
    }
    let seconds = elapsed.as_secs_f64() * (1.0 - done).max(0.0) / done;
    let seconds = seconds.round() as u64;
    let mut text = String::new();
    if seconds >= 3600 {
        let _ = write!(text, "{}:", seconds / 3600);
        let _ = write!(text, "{:02}:", seconds / 60 % 60);
    } else {
        let _ = write!(text, "{}:", seconds / 60);
    }
    let _ = write!(text, "{:02}", seconds % 60);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_of_the_bar_is_understood() {
        let bar = Bar(new_bar());
        bar.show(0.3);
        assert_eq!((bar.0.position(), bar.0.length()), (300_000, Some(WHOLE)));
        bar.end();
    }

    #[test]
    fn the_time_left_is_the_rest_at_the_speed_so_far() {
        let minute = Duration::from_secs(60);
        assert_eq!(left(0.0, minute), "?");
        assert_eq!(left(0.5, minute), "1:00");
        assert_eq!(left(0.25, minute), "3:00");
        assert_eq!(left(0.01, minute), "1:39:00");
        assert_eq!(left(1.0, minute), "0:00");
    }
}
