//! How far the work has come, told on standard error, and on standard output to programs that ask.
//!
//! On a terminal a bar with the time that is left. Elsewhere one plain line for each frame, without
//! escapes or carriage returns. Work is counted in expected cost, in whatever unit the caller likes.
//! Trouble with the streams does not end the work; that with standard output, where programs read, is
//! kept until the end ([`Progress::trouble`]).

use super::bar::Bar;
use super::deed::Deed;
use super::event::{Event, Summary};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Instant;

/// How progress is told.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mode {
    /// A bar on a terminal, plain lines elsewhere.
    #[default]
    Auto,
    /// A bar; plain lines where standard error is no terminal that could show one.
    Bar,
    /// One line for each frame.
    Plain,
    /// Events on standard error, one object of JSON a line.
    Json,
    /// Besides plain lines, those on standard output that Open Job Description asks for.
    OpenJd,
    /// Nothing but notes.
    None,
}

/// What standard output is for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Results {
    /// Nothing.
    #[default]
    Nothing,
    /// Events, one object of JSON a line.
    Events,
}

/// Progress of one run. Threads may share it.
pub struct Progress {
    began: Instant,
    told: Told,
    results: Results,
    open_jd: OpenJd,
    tally: Mutex<Tally>,
    /// The first on standard output.
    trouble: OnceLock<io::Error>,
}

/// How standard error is told.
enum Told {
    Bar(Bar),
    Lines,
    Notes,
    Events,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum OpenJd {
    Asked,
    NotAsked,
}

#[derive(Default)]
struct Tally {
    frames: u64,
    summary: Summary,
    /// All work, what is settled of it, and what of frames in work is done.
    work: f64,
    settled: f64,
    in_work: f64,
    /// The last that Open Job Description was told, per cent.
    percent: f64,
    ended: bool,
}

impl Progress {
    /// Begins to tell.
    pub fn new(mode: Mode, results: Results) -> Self {
        let bar = matches!(mode, Mode::Auto | Mode::Bar).then(Bar::new);
        let told = match (mode, bar.flatten()) {
            (_, Some(bar)) => Told::Bar(bar),
            (Mode::Json, _) => Told::Events,
            (Mode::None, _) => Told::Notes,
            _ => Told::Lines,
        };
        Self {
            began: Instant::now(),
            told,
            results,
            open_jd: match mode {
                Mode::OpenJd => OpenJd::Asked,
                _ => OpenJd::NotAsked,
            },
            tally: Mutex::default(),
            trouble: OnceLock::new(),
        }
    }

    /// Tells what there is to do: so many frames of these shots, and the work of those that are to
    /// be rendered.
    pub fn start(&self, shots: &[PathBuf], frames: u64, work: f64) {
        let mut tally = self.tally();
        (tally.frames, tally.work) = (frames, work);
        drop(tally);
        if let Told::Bar(bar) = &self.told {
            bar.begin();
        }
        self.event(&Event::start(shots, frames));
    }

    /// Tells that `work` more is done of the frames in work.
    pub fn advance(&self, work: f64) {
        let mut tally = self.tally();
        tally.in_work += work;
        self.show(&mut tally);
    }

    /// Tells that the frames in work are no longer: what was done of them stands to be done again,
    /// unless they are settled.
    pub fn rest(&self) {
        let mut tally = self.tally();
        tally.in_work = 0.0;
    }

    /// Tells that a frame is settled, which was so much work, and what its files are. The plain line
    /// is `frame 3/49  rendered  1.24 s  name.0003.png  stale because …`, the third of 49 settled.
    pub fn frame(&self, shot: &Path, (frame, deed): (u32, &Deed), files: &[PathBuf], work: f64) {
        let mut tally = self.tally();
        let summary = &mut tally.summary;
        match deed {
            Deed::Kept { .. } => summary.kept += 1,
            Deed::Rendered { .. } => summary.rendered += 1,
            Deed::Failed { .. } => summary.failed += 1,
        }
        let settled = summary.kept + summary.rendered + summary.failed;
        tally.settled += work;
        tally.in_work = (tally.in_work - work).max(0.0);
        let line = line(settled, tally.frames, deed, files);
        self.show(&mut tally);
        drop(tally);
        match &self.told {
            Told::Bar(bar) => bar.say(line.clone()),
            Told::Lines => self.say(&line),
            Told::Notes | Told::Events => {}
        }
        if self.open_jd == OpenJd::Asked {
            self.answer(&format!("openjd_status: {line}"));
        }
        self.event(&Event::frame(shot, frame, deed, files));
    }

    /// Tells that so much work will not be done, or, of frames in work, was done for nothing.
    pub fn forgo(&self, work: f64) {
        let mut tally = self.tally();
        tally.work -= work;
        tally.in_work = (tally.in_work - work).max(0.0);
        self.show(&mut tally);
    }

    /// Tells something that the pictures' viewer should know; in every mode.
    pub fn warn(&self, message: &str) {
        self.note("warning", message);
        self.event(&Event::Warning { message });
    }

    /// Tells what keeps frames from being there; in every mode.
    pub fn error(&self, message: &str) {
        self.note("error", message);
        self.event(&Event::Error { message });
    }

    /// Tells that a file was made of finished frames.
    pub fn assembled(&self, file: &Path) {
        if matches!(self.told, Told::Bar(_) | Told::Lines) {
            self.say(&format!("assembled  {}", file.display()));
        }
        self.event(&Event::assembled(file));
    }

    /// Tells how it ended, with the exit status of the run; what more is told comes too late.
    pub fn end(&self, exit: u8) {
        let Some(summary) = self.summary(exit) else {
            return;
        };
        if let Told::Bar(bar) = &self.told {
            bar.end();
        }
        let Summary {
            rendered,
            kept,
            failed,
            left,
            ..
        } = summary;
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
        } else if matches!(self.told, Told::Bar(_)) && exit < 2 {
            self.say(&format!(
                "{rendered} rendered, {kept} kept, {} missing",
                left + failed
            ));
        }
        self.event(&Event::Summary(summary));
    }

    /// Why standard output does not have all that was told, if it was read.
    pub fn trouble(&self) -> Option<&io::Error> {
        self.trouble.get()
    }

    /// How it ended; once.
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

    fn show(&self, tally: &mut Tally) {
        let share = tally.share();
        if let Told::Bar(bar) = &self.told {
            bar.show(share);
        }
        let percent = (share * 100.0).floor();
        if self.open_jd == OpenJd::Asked && percent > tally.percent {
            tally.percent = percent;
            self.answer(&format!("openjd_progress: {percent:.1}"));
        }
    }

    /// A line of its own, with its kind before it where it is read by people.
    fn note(&self, kind: &str, message: &str) {
        if !matches!(self.told, Told::Events) {
            self.say(&format!("{kind}: {message}"));
        }
    }

    fn say(&self, line: &str) {
        let write = || drop(write_line(&mut io::stderr().lock(), line));
        match &self.told {
            Told::Bar(bar) => bar.aside(write),
            _ => write(),
        }
    }

    /// A line on standard output. A reader who has gone away is no trouble.
    fn answer(&self, line: &str) {
        if let Err(error) = write_line(&mut io::stdout().lock(), line)
            && error.kind() != ErrorKind::BrokenPipe
        {
            let _ = self.trouble.set(error);
        }
    }

    fn event(&self, event: &Event<'_>) {
        let (err, out) = (
            matches!(self.told, Told::Events),
            self.results == Results::Events,
        );
        if err || out {
            let line = event.line();
            if err {
                let _ = write_line(&mut io::stderr().lock(), &line);
            }
            if out {
                self.answer(&line);
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Told::Bar(bar) = &self.told {
            bar.end();
        }
    }
}

impl Tally {
    fn share(&self) -> f64 {
        let done = (self.settled + self.in_work).min(self.work);
        if self.work > 0.0 {
            done / self.work
        } else {
            1.0
        }
    }
}

fn line(settled: u64, frames: u64, deed: &Deed, files: &[PathBuf]) -> String {
    let mut line = format!("frame {settled}/{frames}  {}", deed.word());
    if let Deed::Rendered { seconds, .. } = deed {
        line += &format!("  {seconds:.2} s");
    }
    let name = files.first().and_then(|file| file.file_name());
    line += &format!("  {}", name.unwrap_or_default().display());
    match deed {
        // An error of its own says so.
        Deed::Failed { .. } => {}
        deed => line.extend(deed.because().map(|because| format!("  {because}"))),
    }
    line
}

/// The whole line in one call, so that lines of other processes do not come between.
fn write_line(out: &mut impl Write, line: &str) -> io::Result<()> {
    out.write_all(format!("{line}\n").as_bytes())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rendered(because: Option<&str>) -> Deed {
        Deed::Rendered {
            because: because.map(str::to_owned),
            seconds: 1.2449,
            cut: 0.0,
        }
    }

    #[test]
    fn the_plain_line_tells_the_deed_and_why() {
        let files = [PathBuf::from("out/name/name.0003.png")];
        assert_eq!(
            line(3, 49, &rendered(None), &files),
            "frame 3/49  rendered  1.24 s  name.0003.png"
        );
        assert_eq!(
            line(
                3,
                49,
                &rendered(Some("stale because a is 2, was 1")),
                &files
            ),
            "frame 3/49  rendered  1.24 s  name.0003.png  stale because a is 2, was 1"
        );
        assert_eq!(
            line(1, 1, &Deed::Kept { because: None }, &files),
            "frame 1/1  kept  name.0003.png"
        );
    }

    #[test]
    fn work_is_counted_once_and_what_is_forgone_not_at_all() {
        let progress = Progress::new(Mode::None, Results::Nothing);
        let share = || progress.tally().share();
        progress.start(&[], 3, 10.0);
        progress.advance(2.0);
        assert_eq!(share(), 0.2);
        progress.frame(Path::new("a.toml"), (1, &rendered(None)), &[], 4.0);
        assert_eq!(share(), 0.4);
        progress.advance(3.0);
        progress.rest();
        assert_eq!(share(), 0.4);
        progress.forgo(2.0);
        assert_eq!(share(), 0.5);
        // Rendered, and then there was no room.
        progress.advance(1.0);
        progress.forgo(1.0);
        assert_eq!(share(), 4.0 / 7.0);
        let summary = progress.summary(0).expect("the first time");
        assert_eq!((summary.rendered, summary.left), (1, 2));
        assert!(progress.summary(0).is_none());
    }
}
