//! `restframe render`.

use super::finish::Finisher;
use super::{FAILURE, Failed, ProgressMode, RenderArguments, failed, mistaken, misused, say};
use crate::queue::{
    Force, Job, Names, Night, Prepared, Progress, Reel, Request, Resolved, Results, Stop,
    choose_shard, list_of,
};
use crate::sequence::foreseen;
use crate::shot::{self, LARGEST_SIDE, Mistakes, Shot};
use indexmap::IndexSet;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Renders, and tells how it ended, also when it was asked to stop.
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
    let progress = Arc::new(Progress::new(arguments.progress.into(), results));
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

/// So many threads; 0 for one a processor.
pub(super) fn pool(threads: u16) -> Result<rayon::ThreadPool, Failed> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .map_err(|error| failed(&error.to_string()))
}

/// Reads all shots before the first is rendered, so that a mistake in the last one shows at once
/// and not in the morning.
fn render(arguments: &RenderArguments, progress: &Progress, stop: &Stop) -> Result<(), Failed> {
    let request = arguments.pictures.request(arguments.frames.as_ref());
    let force = if arguments.force {
        Force::Yes
    } else {
        Force::No
    };
    let (mut jobs, closed) = read(arguments, &request, force, progress)?;
    for job in &mut jobs {
        job.furnish(arguments.shard);
    }
    let night = Night {
        progress,
        stop: stop.asked(),
        force,
    };
    let finisher = Finisher { progress, stop };
    let mut finished = Ok(());
    night.render(&mut jobs, &mut |job| {
        if let Err(failed) = finisher.finish(job) {
            finished = Err(failed);
        }
    });
    let missing = missing(&jobs);
    match missing {
        _ if stop.status().is_some() => Ok(()),
        None if closed == Closed::None => finished,
        None => Err(Failed(FAILURE)),
        Some(missing) => {
            progress.error(&missing);
            Err(Failed(FAILURE))
        }
    }
}

/// The jobs of the call, and whether there are folders that cannot be read. Every mistake of every
/// shot is told.
fn read(
    arguments: &RenderArguments,
    request: &Request,
    force: Force,
    progress: &Progress,
) -> Result<(Vec<Job>, Closed), Failed> {
    let mut wrong = None;
    let loaded = arguments.shots.iter().map(|path| shot::load(path));
    let shots = sound(loaded, &mut wrong);
    if let Some(misused) = same_folder(&shots) {
        return Err(misused);
    }
    let chosen = shots
        .iter()
        .map(|shot| choose(shot, request, progress))
        .collect::<Result<Vec<_>, Failed>>()?;
    let reel = |(shot, frames): (&Shot, Vec<u32>)| Ok((Reel::new(shot, request)?, frames));
    let mut reels = sound(shots.iter().zip(chosen).map(reel), &mut wrong);
    if let Some(shard) = arguments.shard {
        choose_shard(&mut reels, shard);
        if !reels.is_empty() && reels.iter().all(|(_, frames)| frames.is_empty()) {
            let [k, n] = shard.numbers();
            progress.warn(&format!(
                "no frame falls to shard {k}/{n}: there are fewer traces than shards"
            ));
        }
    }
    let all = reels.len();
    let open = |(reel, frames)| open(reel, frames, progress);
    let mut jobs: Vec<Job> = reels.into_iter().filter_map(open).collect();
    let closed = if jobs.len() < all {
        Closed::Some
    } else {
        Closed::None
    };
    for job in &jobs {
        let (shot, size) = (job.reel.shot(), job.reel.keys.resolution().size);
        if let Some(why) = foreseen(shot, size) {
            progress.warn(&format!("{}: {why}", shot.path.display()));
        }
    }
    sound(jobs.iter_mut().map(|job| job.prepare(force)), &mut wrong);
    for prepared in jobs.iter().filter_map(Job::prepared) {
        for warning in warnings(prepared) {
            progress.warn(&warning);
        }
    }
    wrong.map_or(Ok((jobs, closed)), Err)
}

/// How many folders cannot be read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Closed {
    None,
    Some,
}

/// What has no mistakes; those of the others are told.
fn sound<T>(
    answers: impl Iterator<Item = Result<T, Mistakes>>,
    wrong: &mut Option<Failed>,
) -> Vec<T> {
    answers
        .filter_map(|answer| answer.map_err(|m| *wrong = Some(mistaken(&m))).ok())
        .collect()
}

/// Two shots whose images would have the same names.
fn same_folder(shots: &[Shot]) -> Option<Failed> {
    let mut seen = HashMap::new();
    shots.iter().find_map(|shot| {
        let path = shot.path.display().to_string();
        let other = seen.insert(Names::new(shot).stem, path.clone())?;
        Some(misused(&format!(
            "{other} and {path} would write the same images; rename one, or render them apart with --out"
        )))
    })
}

/// The job of a shot, if its folder can be read.
fn open(reel: Reel, frames: Vec<u32>, progress: &Progress) -> Option<Job> {
    let path = reel.shot().path.display().to_string();
    let job = Job::new(reel, &frames);
    job.map_err(|error| progress.error(&format!("{path}: {error}")))
        .ok()
}

/// The frames asked for that a shot has.
fn choose(shot: &Shot, request: &Request, progress: &Progress) -> Result<Vec<u32>, Failed> {
    let frames = shot.shot.frames;
    let Resolved {
        frames: chosen,
        outside,
    } = request.frames.resolve(frames);
    let path = shot.path.display();
    check_scale(shot, request).map_err(|why| misused(&why))?;
    if chosen.is_empty() {
        return Err(misused(&format!(
            "{path} has frames 1 to {frames}; none was chosen"
        )));
    }
    if outside > 0 {
        progress.warn(&format!(
            "{path} has frames 1 to {frames}; {outside} others are left out"
        ));
    }
    Ok(chosen)
}

/// Says what the shot's files ask for and the picture will not show.
pub(super) fn warn(prepared: &Prepared) {
    for warning in warnings(prepared) {
        say(&format!("warning: {warning}"));
    }
}

/// What the shot's files ask for and the picture will not show, each once, and what its sensor
/// cannot tell apart.
pub(super) fn warnings(prepared: &Prepared) -> Vec<String> {
    let seen: IndexSet<(&Path, String)> = prepared.library.warnings(&prepared.shot).collect();
    let line = |(file, warning): (&Path, String)| format!("{}: {warning}", file.display());
    let of_files = seen.into_iter().map(line);
    let shot = prepared.shot.path.display();
    of_files
        .chain(
            prepared
                .unresolved()
                .iter()
                .map(|pair| format!("{shot}: {pair}")),
        )
        .collect()
}

/// A scale that makes an image larger than any may be.
pub(super) fn check_scale(shot: &Shot, request: &Request) -> Result<(), String> {
    let [width, height] = shot.image.size.map(|side| f64::from(side) * request.scale);
    if width.max(height).round() <= f64::from(LARGEST_SIDE) {
        return Ok(());
    }
    Err(format!(
        "--scale {} makes {width:.0} x {height:.0} pixels of {}; a side has at most {LARGEST_SIDE}",
        request.scale,
        shot.path.display()
    ))
}

/// Which frames are not there.
fn missing(jobs: &[Job]) -> Option<String> {
    let lists = jobs.iter().map(|job| (job, job.missing()));
    let lists: Vec<_> = lists.filter(|(_, frames)| !frames.is_empty()).collect();
    let count: usize = lists.iter().map(|(_, frames)| frames.len()).sum();
    let (s, are) = if count == 1 { ("", "is") } else { ("s", "are") };
    let list = |(job, frames): &(&Job, Vec<u32>)| {
        format!("{} {}", job.reel.shot().path.display(), list_of(frames))
    };
    let list: Vec<String> = lists.iter().map(list).collect();
    (count > 0).then(|| format!("{count} frame{s} {are} missing: {}", list.join("; ")))
}
