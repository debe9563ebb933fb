//! Open Job Description messages on standard output: `openjd_progress: 42.0` when the share of the
//! work reaches another percent, `openjd_status: …` for each frame.

use super::event::{Event, Sink};
use super::json::answer;
use super::text::frame_line;
use std::io;
use std::sync::{Mutex, OnceLock, PoisonError};

/// A sink of Open Job Description messages.
#[derive(Default)]
pub(super) struct OpenJd {
    /// The last share that was printed, percent.
    percent: Mutex<f64>,
    trouble: OnceLock<io::Error>,
}

impl Sink for OpenJd {
    fn event(&self, event: &Event<'_>) {
        match event {
            Event::Advance { share } => {
                let now = (share * 100.0).floor();
                let mut percent = self.percent.lock().unwrap_or_else(PoisonError::into_inner);
                if now > *percent {
                    *percent = now;
                    answer(&format!("openjd_progress: {now:.1}"), &self.trouble);
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
                answer(&format!("openjd_status: {line}"), &self.trouble);
            }
            _ => {}
        }
    }

    fn trouble(&self) -> Option<&io::Error> {
        self.trouble.get()
    }
}
