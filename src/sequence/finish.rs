//! The end of a shot's rendering: files assembled from its frames, and the page about them, by one
//! process at a time.

use super::assemble::{AssembleError, assemble, finish, is_finished};
use super::page::{self, Outcomes};
use crate::progress::{FrameOutcome, Progress};
use crate::queue::{Job, Stop};
use crate::store::{Claim, SEQUENCE, ShotFolder, sweep};
use std::path::PathBuf;
use std::thread::sleep;
use std::time::Duration;

/// Some output of a shot could not be made. The reason has been reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unfinished;

/// Assembles what a finished job asks for, if all its frames are there, and writes its page;
/// whatever is up to date is left. Ends soon if asked to stop.
///
/// # Errors
/// If something cannot be made.
pub fn finish_shot(job: &mut Job, progress: &Progress<'_>, stop: &Stop) -> Result<(), Unfinished> {
    if !job.folder.path.is_dir() {
        return Ok(());
    }
    let shot = job.folder.shot().path.display().to_string();
    let report = |why: &str| {
        progress.error(&format!("{shot}: {why}"));
        Unfinished
    };
    job.folder
        .refresh()
        .map_err(|error| report(&error.to_string()))?;
    let has_page =
        |job: &Job| !job.folder.shot().sequence.page || page::is_fresh(&job.folder, &job.outcomes);
    // Checked before the claim, which needs a writable disk.
    if is_finished(&job.folder) && has_page(job) || job.is_halted() {
        return Ok(());
    }
    let claim = match wait_for_claim(&job.folder, stop) {
        // The run would only write the same facts to another page.
        Err(error) if is_finished(&job.folder) && kept_all(&job.outcomes) => {
            progress.warn(&format!("{shot}: the page is not renewed: {error}"));
            return Ok(());
        }
        claim => claim.map_err(|error| report(&error))?,
    };
    if claim.is_none() {
        return Ok(());
    }
    let notes = |note: &str| {
        let note = note.strip_prefix("warning: ").unwrap_or(note);
        progress.warn(&format!("{shot}: {note}"));
    };
    let (made, done) = match finish(&mut job.folder, &notes, stop) {
        Ok(made) => (made, Ok(())),
        Err(AssembleError::Stopped) => return Ok(()),
        Err(AssembleError::Some { made, failures }) => {
            let mut done = Ok(());
            for failure in &failures {
                done = Err(report(failure));
            }
            (made, done)
        }
        Err(error) => (Vec::new(), Err(report(&error.to_string()))),
    };
    for file in &made {
        progress.assembled(file);
    }
    if !has_page(job) {
        let page = page::write(&job.folder, &job.outcomes, stop);
        let page = page.map_err(|error| report(&error.to_string()))?;
        page.iter().for_each(|page| progress.assembled(page));
    }
    done
}

/// Files that could be assembled, and reasons for the others.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Assembled {
    /// Files that were made.
    pub made: Vec<PathBuf>,
    /// Reasons why others were not.
    pub failures: Vec<String>,
}

/// Assembles everything that a shot asks for, and its page, even if it is there already. `notes`
/// receives warnings. If asked to stop, it ends soon and leaves only complete files.
///
/// # Errors
/// If the shot cannot be claimed, for example since another process is assembling it.
pub fn assemble_all(
    folder: &ShotFolder,
    notes: &dyn Fn(&str),
    stop: &Stop,
) -> Result<Assembled, String> {
    if !folder.path.is_dir() {
        let path = folder.path.display();
        return Ok(Assembled {
            failures: vec![format!("there is no folder {path}; render the shot first")],
            ..Assembled::default()
        });
    }
    // Leftovers of a killed process.
    sweep(&folder.path, &folder.names);
    let claim = Claim::take(&folder.path, &folder.names, SEQUENCE);
    match claim.map_err(|error| error.to_string())? {
        Some(_claim) => Ok(make_all(folder, notes, stop)),
        None => Err(format!(
            "{}: another process is assembling it; wait for that one",
            folder.shot().path.display()
        )),
    }
}

fn make_all(folder: &ShotFolder, notes: &dyn Fn(&str), stop: &Stop) -> Assembled {
    let mut all = match assemble(folder, notes, stop) {
        Ok(made) => Assembled {
            made,
            ..Assembled::default()
        },
        Err(AssembleError::Some { made, failures }) => Assembled { made, failures },
        Err(AssembleError::Stopped) => return Assembled::default(),
        Err(error) => {
            return Assembled {
                failures: vec![error.to_string()],
                ..Assembled::default()
            };
        }
    };
    if folder.shot().sequence.page {
        match page::write(folder, &Outcomes::new(), stop) {
            Ok(page) => all.made.extend(page),
            Err(error) => all.failures.push(error.to_string()),
        }
    }
    all
}

/// Waits for the claim on the sequence; None if the run was stopped.
fn wait_for_claim(folder: &ShotFolder, stop: &Stop) -> Result<Option<Claim>, String> {
    const PAUSE: Duration = Duration::from_millis(50);
    while !stop.is_asked() {
        let claim = Claim::take(&folder.path, &folder.names, SEQUENCE);
        match claim.map_err(|error| error.to_string())? {
            Some(claim) => return Ok(Some(claim)),
            None => sleep(PAUSE),
        }
    }
    Ok(None)
}

fn kept_all(outcomes: &Outcomes) -> bool {
    let is_kept = |outcome: &FrameOutcome| matches!(outcome, FrameOutcome::Kept { .. });
    outcomes.values().all(is_kept)
}
