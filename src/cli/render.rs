//! `restframe render`: frames that are missing or out of date, then sequences.

use super::{
    FAILURE, Failed, MISTAKE, ProgressMode, RenderArguments, failed, frames, mistaken, misused,
    pool,
};
use crate::progress::{Progress, Results};
use crate::queue::{Force, Job, Output, Run, RunError, Settings, Stop, list_of};
use crate::sequence::{finish_shot, foreseen};
use crate::shot::{self, Shot};
use std::sync::Arc;

/// Renders, and reports how the run ended, also if it was stopped.
pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failed> {
    let results = match (arguments.json, arguments.progress) {
        (true, ProgressMode::OpenJd) => {
            return Err(misused(
                "--json and --progress openjd both write to standard output: choose one",
            ));
        }
        (true, _) => Results::Events,
        (false, _) => Results::Nothing,
    };
    let progress = Arc::new(Progress::on_streams(arguments.progress.into(), results));
    let late = Arc::clone(&progress);
    let stop = Stop::listen(move |status| late.end(status))
        .map_err(|error| failed(&format!("cannot listen to signals: {error}")))?;
    let done = pool(arguments.threads)?.install(|| render(arguments, &progress, &stop));
    let done = match stop.status() {
        Some(status) => Err(Failed(status)),
        None => done,
    };
    progress.end(done.as_ref().map_or_else(|Failed(status)| *status, |()| 0));
    match progress.trouble() {
        Some(error) if done.is_ok() => Err(failed(&format!("standard output: {error}"))),
        _ => done,
    }
}

/// Reads all shots before the first is rendered, so that a mistake in the last one is reported at
/// once. Assembles each shot as soon as its frames are there.
fn render(arguments: &RenderArguments, progress: &Progress<'_>, stop: &Stop) -> Result<(), Failed> {
    let settings = Settings {
        request: arguments.pictures.request(),
        frames: frames(arguments.frames.as_ref()),
        shard: arguments.shard,
        force: match arguments.force {
            true => Force::Yes,
            false => Force::No,
        },
        output: Output::Folder,
        progress,
        stop,
    };
    let (shots, wrong) = load(arguments);
    let mut run = Run::open(&shots, settings).map_err(refused)?;
    if let Some(wrong) = wrong {
        return Err(wrong);
    }
    for job in run.jobs() {
        let (shot, size) = (job.folder.shot(), job.folder.keys.resolution().size);
        if let Some(why) = foreseen(shot, size) {
            let path = shot.path.display();
            progress.warn(&format!("{path}: {why}"));
        }
    }
    let mut finished = Ok(());
    while let Some(job) = run.next_finished() {
        finished = finish_shot(job, progress, stop).and(finished);
    }
    if stop.is_asked() {
        return Ok(());
    }
    if let Some(missing) = missing(run.jobs()) {
        progress.error(&missing);
        return Err(Failed(FAILURE));
    }
    match run.unreadable() {
        [] => finished.map_err(|_| Failed(FAILURE)),
        _ => Err(Failed(FAILURE)),
    }
}

/// The shots that can be read, and the failure if some cannot, which has been printed.
fn load(arguments: &RenderArguments) -> (Vec<Shot>, Option<Failed>) {
    let mut wrong = None;
    let shots = arguments.shots.iter().filter_map(|path| {
        let shot = shot::load(path);
        shot.map_err(|mistakes| wrong = Some(mistaken(&mistakes)))
            .ok()
    });
    (shots.collect(), wrong)
}

/// Prints why a run is not begun: every mistake of every shot.
fn refused(error: RunError) -> Failed {
    match error {
        RunError::Contradiction(error) => misused(&error.to_string()),
        RunError::Mistakes(all) => all
            .iter()
            .fold(Failed(MISTAKE), |_, mistakes| mistaken(mistakes)),
    }
}

/// The frames that are missing, in words.
fn missing(jobs: &[Job]) -> Option<String> {
    let lists = jobs.iter().map(|job| (job, job.missing()));
    let lists: Vec<_> = lists.filter(|(_, frames)| !frames.is_empty()).collect();
    let count: usize = lists.iter().map(|(_, frames)| frames.len()).sum();
    let (s, are) = if count == 1 { ("", "is") } else { ("s", "are") };
    let list = |(job, frames): &(&Job, Vec<u32>)| {
        format!("{} {}", job.folder.shot().path.display(), list_of(frames))
    };
    let list: Vec<String> = lists.iter().map(list).collect();
    (count > 0).then(|| format!("{count} frame{s} {are} missing: {}", list.join("; ")))
}
