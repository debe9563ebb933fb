//! The end of a shot's rendering: what is assembled of its frames, and the page about them.

use super::verify::Unopened;
use super::{FAILURE, Failed};
use crate::queue::{Claim, Deed, Job, Progress, Reel, SEQUENCE, Stop};
use crate::sequence::page::{self, Outcome, RunFacts};
use crate::sequence::{AssembleError, finish, is_finished};
use std::sync::atomic::Ordering;
use std::thread::sleep;
use std::time::Duration;

/// Who is told, and who may stop it.
#[derive(Clone, Copy)]
pub(super) struct Finisher<'a> {
    pub(super) progress: &'a Progress,
    pub(super) stop: &'a Stop,
}

impl Finisher<'_> {
    /// Assembles what a shot asks for, if all its frames are there, and writes its page.
    ///
    /// # Errors
    /// When something cannot be made; what, has been told.
    pub(super) fn finish(self, job: &mut Job) -> Result<(), Failed> {
        if !job.reel.folder.is_dir() {
            return Ok(());
        }
        let shot = job.reel.shot().path.display().to_string();
        let told = |why: &str| {
            self.progress.error(&format!("{shot}: {why}"));
            Failed(FAILURE)
        };
        job.reel
            .refresh()
            .map_err(|error| told(&error.to_string()))?;
        let run = run_facts(job);
        let is_told = |reel: &Reel| !reel.shot().sequence.page || page::is_fresh(reel, &run);
        // Before the claim, for which a disk must be writable.
        if is_finished(&job.reel) && is_told(&job.reel) {
            return Ok(());
        }
        if job.is_halted() {
            return Ok(());
        }
        let claim = match self.claim(&job.reel) {
            // All that this run would do is tell the same on another page.
            Err(error) if is_finished(&job.reel) && kept_all(&run) => {
                self.progress
                    .warn(&format!("{shot}: the page is not renewed: {error}"));
                return Ok(());
            }
            claim => claim.map_err(|error| told(&error))?,
        };
        if claim.is_none() {
            return Ok(());
        }
        let notes = |note: &str| {
            let note = note.strip_prefix("warning: ").unwrap_or(note);
            self.progress.warn(&format!("{shot}: {note}"));
        };
        let (made, done) = match finish(&mut job.reel, &notes, self.stop) {
            Ok(made) => (made, Ok(())),
            Err(AssembleError::Stopped) => return Ok(()),
            Err(AssembleError::Some { made, failures }) => {
                let mut done = Ok(());
                for failure in &failures {
                    done = Err(told(failure));
                }
                (made, done)
            }
            Err(error) => (Vec::new(), Err(told(&error.to_string()))),
        };
        for file in &made {
            self.progress.assembled(file);
        }
        if !is_told(&job.reel) {
            match page::write(&job.reel, &run, self.stop) {
                Ok(page) => page.iter().for_each(|page| self.progress.assembled(page)),
                Err(error) => return Err(told(&error.to_string())),
            }
        }
        done
    }

    /// The claim on the sequence, which another process gives up soon; None if asked to stop.
    fn claim(self, reel: &Reel) -> Result<Option<Claim>, String> {
        const PAUSE: Duration = Duration::from_millis(50);
        while !self.stop.asked().load(Ordering::Relaxed) {
            let claim = Claim::take(&reel.folder, &reel.names, SEQUENCE);
            match claim.map_err(|error| error.to_string())? {
                Some(claim) => return Ok(Some(claim)),
                None => sleep(PAUSE),
            }
        }
        Ok(None)
    }
}

/// The claim of whoever assembles by hand.
pub(super) fn claim(reel: &Reel) -> Result<Claim, Unopened> {
    match Claim::take(&reel.folder, &reel.names, SEQUENCE) {
        Ok(Some(claim)) => Ok(claim),
        Ok(None) => Err(Unopened::say(&format!(
            "{}: another process is assembling it; wait for that one",
            reel.shot().path.display()
        ))),
        Err(error) => Err(Unopened::say(&error.to_string())),
    }
}

fn kept_all(run: &RunFacts) -> bool {
    run.outcomes.values().all(|o| *o == Outcome::Kept)
}

fn run_facts(job: &Job) -> RunFacts {
    let outcome = |deed: &Deed| match deed {
        Deed::Kept { .. } => Outcome::Kept,
        Deed::Rendered { because, .. } => Outcome::Rendered {
            because: because.clone().unwrap_or_default(),
        },
        Deed::Failed { because } => Outcome::Failed {
            because: because.clone(),
        },
    };
    let outcomes = job.deeds.iter();
    RunFacts {
        outcomes: outcomes
            .map(|(frame, deed)| (*frame, outcome(deed)))
            .collect(),
    }
}
