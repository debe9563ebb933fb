//! The end of a shot's rendering: what is assembled of its frames, and the page about them.

use super::{FAILURE, Failed, failed};
use crate::queue::{Claim, Deed, Job, Progress, Reel, SEQUENCE};
use crate::sequence::page::{self, Outcome, RunFacts};
use crate::sequence::{AssembleError, finish};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// Who is told, and who may stop it.
#[derive(Clone, Copy)]
pub(super) struct Finisher<'a> {
    pub(super) progress: &'a Progress,
    pub(super) stop: &'a AtomicBool,
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
        let claim = self.claim(&job.reel).map_err(|error| told(&error))?;
        if claim.is_none() {
            return Ok(());
        }
        let notes = |note: &str| {
            let note = note.strip_prefix("warning: ").unwrap_or(note);
            self.progress.warn(&format!("{shot}: {note}"));
        };
        let (made, done) = match finish(&mut job.reel, &notes) {
            Ok(made) => (made, Ok(())),
            Err(AssembleError::Some { made, failures }) => {
                let done = failures.iter().map(|failure| told(failure)).next_back();
                (made, done.map_or(Ok(()), Err))
            }
            Err(error) => (Vec::new(), Err(told(&error.to_string()))),
        };
        for file in &made {
            self.progress.assembled(file);
        }
        let run = run_facts(job);
        let asked = job.reel.shot().sequence.page;
        if asked && !(made.is_empty() && is_still_right(&job.reel, &run)) {
            match page::write(&job.reel, &run) {
                Ok(page) => self.progress.assembled(&page),
                // Why has been told.
                Err(_) if job.is_halted() => {}
                Err(error) => return Err(told(&error.to_string())),
            }
        }
        done
    }

    /// The claim on the sequence, which another process gives up soon; None if asked to stop.
    fn claim(self, reel: &Reel) -> Result<Option<Claim>, String> {
        const PAUSE: Duration = Duration::from_millis(50);
        while !self.stop.load(Ordering::Relaxed) {
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
pub(super) fn claim(reel: &Reel) -> Result<Claim, Failed> {
    match Claim::take(&reel.folder, &reel.names, SEQUENCE) {
        Ok(Some(claim)) => Ok(claim),
        Ok(None) => Err(failed(&format!(
            "{}: another process is assembling it; wait for that one",
            reel.shot().path.display()
        ))),
        Err(error) => Err(failed(&error.to_string())),
    }
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
        ..RunFacts::default()
    }
}

/// Whether a run that kept everything finds a page that is younger than every record: to write it
/// again would take as long as to read all pictures.
fn is_still_right(reel: &Reel, run: &RunFacts) -> bool {
    let kept = run.outcomes.values().all(|o| *o == Outcome::Kept);
    let Some(page) = written(&reel.folder.join(page::PAGE)) else {
        return false;
    };
    let manifests = fs::read_dir(&reel.folder).into_iter().flatten().flatten();
    let mut manifests =
        manifests.filter(|entry| reel.names.is_manifest(&entry.file_name().to_string_lossy()));
    kept && manifests.all(|entry| written(&entry.path()).is_none_or(|when| when <= page))
}

fn written(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).ok()?.modified().ok()
}
