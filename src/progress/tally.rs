//! Counting of a run's frames and work, which makes the events.
//!
//! Work is counted in expected cost, in any unit, so that cheap frames do not distort the time
//! left.

use super::event::FrameOutcome;
use super::event::{Event, Sink, Summary};
use super::mode::{Mode, Results, sinks};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Progress of one run, as events to its sinks. Threads may share it.
///
/// # Example
/// ```
/// use restframe::progress::{Event, Progress};
/// let progress = Progress::to(|event: &Event<'_>| {
///     if let Event::Frame { frame, outcome, .. } = event {
///         println!("frame {frame}: {}", outcome.word());
///     }
/// });
/// progress.warn("reaches the closure as Event::Warning");
/// ```
pub struct Progress<'a> {
    began: Instant,
    sinks: Vec<Box<dyn Sink + 'a>>,
    tally: Mutex<Tally>,
}

#[derive(Default)]
struct Tally {
    frames: u64,
    summary: Summary,
    /// All work, the settled part of it, and the part done of frames in work.
    work: f64,
    settled: f64,
    in_flight: f64,
    ended: bool,
}

impl<'a> Progress<'a> {
    /// Progress with any number of sinks.
    pub fn new(sinks: Vec<Box<dyn Sink + 'a>>) -> Self {
        Self {
            began: Instant::now(),
            sinks,
            tally: Mutex::default(),
        }
    }

    /// Progress with one sink, such as a closure.
    pub fn to(sink: impl Sink + 'a) -> Self {
        Self::new(vec![Box::new(sink)])
    }

    /// Progress without a sink.
    pub fn silent() -> Self {
        Self::new(Vec::new())
    }

    /// Progress on this process's standard streams.
    pub fn on_streams(mode: Mode, results: Results) -> Self {
        Self::new(sinks(mode, results))
    }

    /// Begins: the number of frames of these shots, and the work of those that are to be rendered.
    pub fn start(&self, shots: &[PathBuf], frames: u64, work: f64) {
        let mut tally = self.tally();
        (tally.frames, tally.work) = (frames, work);
        drop(tally);
        self.event(&Event::Start { shots, frames });
    }

    /// Adds `work` to the part done of the frames in work.
    pub fn advance(&self, work: f64) {
        let share = {
            let mut tally = self.tally();
            tally.in_flight += work;
            tally.share()
        };
        self.event(&Event::Advance { share });
    }

    /// Resets the work in flight to zero, e.g. before a failed batch is tried again.
    pub fn reset_in_flight(&self) {
        self.tally().in_flight = 0.0;
    }

    /// Settles a frame, which was this much work.
    pub fn frame(
        &self,
        shot: &Path,
        (frame, outcome): (u32, &FrameOutcome),
        files: &[PathBuf],
        work: f64,
    ) {
        let (share, settled, frames) = {
            let mut tally = self.tally();
            let summary = &mut tally.summary;
            match outcome {
                FrameOutcome::Kept { .. } => summary.kept += 1,
                FrameOutcome::Rendered { .. } => summary.rendered += 1,
                FrameOutcome::Failed { .. } => summary.failed += 1,
            }
            let settled = summary.kept + summary.rendered + summary.failed;
            tally.settled += work;
            tally.in_flight = (tally.in_flight - work).max(0.0);
            (tally.share(), settled, tally.frames)
        };
        self.event(&Event::Advance { share });
        self.event(&Event::Frame {
            shot,
            frame,
            outcome,
            files,
            settled,
            frames,
        });
    }

    /// Subtracts work from the whole that will not be done, or was done in vain.
    pub fn discard(&self, work: f64) {
        let share = {
            let mut tally = self.tally();
            tally.work -= work;
            tally.in_flight = (tally.in_flight - work).max(0.0);
            tally.share()
        };
        self.event(&Event::Advance { share });
    }

    /// Reports a warning about the images.
    pub fn warn(&self, message: &str) {
        self.event(&Event::Warning(message));
    }

    /// Reports an error that keeps frames from being rendered.
    pub fn error(&self, message: &str) {
        self.event(&Event::Error(message));
    }

    /// Reports a file that was made of finished frames.
    pub fn assembled(&self, file: &Path) {
        self.event(&Event::Assembled(file));
    }

    /// Ends the progress, with the exit status of the run. Only the first call has an effect.
    pub fn end(&self, exit: u8) {
        if let Some(summary) = self.summary(exit) {
            self.event(&Event::End(summary));
        }
    }

    /// Why programs that read a sink's stream do not have every event.
    pub fn trouble(&self) -> Option<&io::Error> {
        self.sinks.iter().find_map(|sink| sink.trouble())
    }

    fn event(&self, event: &Event<'_>) {
        self.sinks.iter().for_each(|sink| sink.event(event));
    }

    /// The summary. Can be taken once.
    fn summary(&self, exit: u8) -> Option<Summary> {
        let mut tally = self.tally();
        if std::mem::replace(&mut tally.ended, true) {
            return None;
        }
        let Summary {
            rendered,
            kept,
            failed,
            ..
        } = tally.summary;
        Some(Summary {
            left: tally.frames.saturating_sub(rendered + kept + failed),
            seconds: self.began.elapsed().as_secs_f64(),
            exit,
            ..tally.summary
        })
    }

    fn tally(&self) -> MutexGuard<'_, Tally> {
        self.tally.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Tally {
    fn share(&self) -> f64 {
        let done = (self.settled + self.in_flight).min(self.work);
        if self.work > 0.0 {
            done / self.work
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_counted_once_and_what_is_discarded_not_at_all() {
        let rendered = FrameOutcome::Rendered {
            reason: None,
            seconds: 1.2449,
            cut: 0.0,
        };
        let told = Mutex::new(Vec::new());
        let progress = Progress::to(|event: &Event<'_>| {
            if let Event::Advance { share } = event {
                told.lock().expect("one thread").push(*share);
            }
        });
        let share = || progress.tally().share();
        progress.start(&[], 3, 10.0);
        progress.advance(2.0);
        assert_eq!(share(), 0.2);
        progress.frame(Path::new("a.toml"), (1, &rendered), &[], 4.0);
        assert_eq!(share(), 0.4);
        progress.advance(3.0);
        progress.reset_in_flight();
        assert_eq!(share(), 0.4);
        progress.discard(2.0);
        assert_eq!(share(), 0.5);
        // Rendered, and then there was no room.
        progress.advance(1.0);
        progress.discard(1.0);
        assert_eq!(share(), 4.0 / 7.0);
        let summary = progress.summary(0).expect("the first time");
        assert_eq!((summary.rendered, summary.left), (1, 2));
        assert!(progress.summary(0).is_none());
        let told = told.lock().expect("one thread").clone();
        assert_eq!(told, [0.2, 0.4, 0.7, 0.5, 5.0 / 8.0, 4.0 / 7.0]);
    }
}
