//! Writing a batch of films: from development to files and records.

use super::batch::{ClaimedFrame, FrameTask};
use super::job::Job;
use super::memory::most_developed;
use super::render_batch::{RenderedBatch, stops};
use super::settings::{Output, RenderedFrame, Settings};
use crate::accel::Aggregate;
use crate::film::{Film, SILENT};
use crate::frame::{Frame, FrameFingerprint};
use crate::plot::Plot;
use crate::probe;
use crate::progress::FrameOutcome;
use crate::render::{
    InsetTooSmall, Member, PictureInfo, Pictures, Together, encode, left_out_warning,
};
use crate::scene::Scene;
use crate::store::{
    FileRecord, Record, Seconds, host, is_full, now, peak_memory_mib, twice, write_atomically,
};
use rayon::prelude::*;
use std::io;
use std::time::{Duration, Instant};

/// A frame, its scene and its film.
type Rendered<'a> = (ClaimedFrame, &'a Scene, Film);

/// What the picture of a frame shows beside its film, looked up in the same scene and trees.
#[derive(Default)]
struct Probed {
    /// Plots of its insets.
    insets: Vec<Result<Plot, InsetTooSmall>>,
    /// How much of its light was not followed, if that is much.
    left_out: Option<String>,
}

/// Writes films to files, as many at once as threads and memory allow; a frame is settled when it
/// is on the disk.
pub(super) fn write(
    jobs: &mut [Job],
    batch: Vec<ClaimedFrame>,
    rendered: RenderedBatch,
    settings: &Settings<'_>,
) {
    let RenderedBatch {
        first,
        scenes,
        aggregate,
        together,
    } = rendered;
    let Together {
        films,
        prepare,
        trace,
        shade,
    } = together;
    let shared = batch.len();
    let part = |seconds: f64| seconds / shared as f64;
    let frames = batch.into_iter().zip(&scenes).zip(films);
    let mut rest = frames.map(|((claimed, scene), film)| (claimed, scene, film));
    let most = most_developed(jobs[first].options(), rayon::current_num_threads());
    let mut deadline = ShutdownDeadline::default();
    loop {
        let chunk: Vec<Rendered<'_>> = rest.by_ref().take(most).collect();
        if chunk.is_empty() || settings.is_stopped() && deadline.is_over() {
            break;
        }
        // An image for which there is no room need not be made.
        let (lost, chunk): (Vec<_>, Vec<_>) = chunk
            .into_iter()
            .partition(|(claimed, ..)| jobs[claimed.task.job].halted.is_some());
        for (claimed, ..) in lost {
            settings.progress.discard(claimed.task.work);
        }
        let probing = Instant::now();
        let probed = probe(jobs, &chunk, &aggregate, settings);
        let probe_seconds = probing.elapsed().as_secs_f64() / chunk.len() as f64;
        let begun = Instant::now();
        let encoded: Vec<_> = chunk
            .into_par_iter()
            .zip(probed)
            .filter_map(|(rendered, probed)| Some((rendered, probed?)))
            .map(|((claimed, scene, film), probed)| {
                let job = &jobs[claimed.task.job];
                let made = probed.and_then(|probed| encoded(job, &claimed, scene, &film, probed));
                (claimed, made)
            })
            .collect();
        let encode_seconds = begun.elapsed().as_secs_f64() / encoded.len() as f64;
        for (claimed, made) in encoded {
            let job = &mut jobs[claimed.task.job];
            let seconds = Seconds {
                prepare: part(prepare),
                trace: part(trace),
                shade: part(shade) + probe_seconds,
                encode: encode_seconds,
                write: 0.0,
            };
            match made {
                _ if job.halted.is_some() => settings.progress.discard(claimed.task.work),
                Ok((made, record)) => {
                    let record = Record {
                        seconds,
                        shared: u32::try_from(shared).unwrap_or(u32::MAX),
                        ..record
                    };
                    put(job, &claimed.task, made, record, settings);
                }
                Err(error) => job.fail(&claimed.task, &error, settings.progress),
            }
            // Only now may another process look at the frame.
            drop(claimed.claim);
        }
        deadline.last = probing.elapsed();
    }
    drop(rest);
    jobs[first].kept = scenes.into_iter().next().map(|scene| (scene, aggregate));
}

/// Looks up what pictures show beside their films, of as many frames as are about to be encoded; None
/// of one of which that takes time, when the run is stopped.
fn probe(
    jobs: &[Job],
    chunk: &[Rendered<'_>],
    aggregate: &Aggregate,
    settings: &Settings<'_>,
) -> Vec<Option<Result<Probed, String>>> {
    let probed = chunk.par_iter().map(|(claimed, scene, film)| {
        let job = &jobs[claimed.task.job];
        let shot = job.folder.shot();
        if shot.inset.is_empty() && film.left_out.share() <= SILENT {
            return Some(Ok(Probed::default()));
        }
        if settings.is_stopped() {
            return None;
        }
        let frame = match Frame::new(shot, claimed.task.frame) {
            Ok(frame) => frame,
            Err(mistakes) => return Some(Err(mistakes.to_string())),
        };
        let frame = &frame;
        let member = Member { frame, scene };
        let size = [film.width, film.height];
        Some(Ok(Probed {
            insets: probe::insets(member, aggregate, stops(job, frame), size),
            left_out: left_out_warning(member, aggregate, film),
        }))
    });
    probed.collect()
}

/// A film as files, and their record but for its files and times.
///
/// # Errors
/// When an encoder refuses.
fn encoded(
    job: &Job,
    claimed: &ClaimedFrame,
    scene: &Scene,
    film: &Film,
    probed: Probed,
) -> Result<(Pictures, Record), String> {
    let Probed { insets, left_out } = probed;
    let frame = Frame::new(job.folder.shot(), claimed.task.frame).map_err(|m| m.to_string())?;
    let info = PictureInfo {
        exposure_stops: stops(job, &frame),
        samples: job.options().samples,
        fingerprint: Some(&claimed.key.fingerprint),
    };
    let made = encode(&frame, scene, film, &insets, info).map_err(|error| error.to_string())?;
    let record = Record {
        warnings: warnings(&made, left_out),
        cut: film.left_out.share(),
        ..new_record(job, &frame, &claimed.key)
    };
    Ok((made, record))
}

/// Delivers the files of a frame to their destination, then its record.
fn put(
    job: &mut Job,
    task: &FrameTask,
    made: Pictures,
    mut record: Record,
    settings: &Settings<'_>,
) {
    let progress = settings.progress;
    record.files = made
        .files
        .iter()
        .map(|file| file_record(job, task, file))
        .collect();
    if settings.output.is_folder()
        && let Err(error) = write_files(job, task, &made, &mut record)
    {
        return unwritten(job, task, &error, settings);
    }
    let path = &job.folder.shot().path;
    for warning in &record.warnings {
        progress.warn(&format!(
            "{}: frame {}: {warning}",
            path.display(),
            task.frame
        ));
    }
    if let Output::Memory(take) = settings.output {
        take(RenderedFrame {
            shot: path.clone(),
            frame: task.frame,
            files: made.files,
            record: record.clone(),
        });
    }
    let outcome = FrameOutcome::Rendered {
        reason: task.reason(),
        seconds: record.seconds.total(),
        cut: record.cut,
    };
    job.folder.records.insert(task.frame, record);
    job.settle(task, outcome, progress);
}

fn file_record(job: &Job, task: &FrameTask, (extension, bytes): &(&str, Vec<u8>)) -> FileRecord {
    FileRecord {
        name: job.folder.names.frame(task.frame, extension),
        bytes: bytes.len() as u64,
        blake3: blake3::hash(bytes).to_hex().to_string(),
    }
}

/// Writes the files of a frame, and appends its record with the seconds that this took.
fn write_files(
    job: &Job,
    task: &FrameTask,
    made: &Pictures,
    record: &mut Record,
) -> io::Result<()> {
    let begun = Instant::now();
    for (extension, bytes) in &made.files {
        let name = job.folder.names.frame(task.frame, extension);
        twice(|| write_atomically(&job.folder.path.join(&name), bytes))?;
    }
    record.seconds.write = begun.elapsed().as_secs_f64();
    record.finished = now();
    let manifest = job.manifest.as_ref();
    let missing = || io::Error::other("there is no manifest to record it in");
    let manifest = manifest.ok_or_else(missing)?;
    twice(|| manifest.append(record))
}

/// Settles a frame that was made but cannot be written; if there is no room, its shot is halted.
fn unwritten(job: &mut Job, task: &FrameTask, error: &io::Error, settings: &Settings<'_>) {
    job.fail(task, &error.to_string(), settings.progress);
    if is_full(error) {
        let why = "there is no room for its images";
        let path = job.folder.shot().path.display();
        settings
            .progress
            .error(&format!("{path}: {why}; its other frames are left"));
        job.halted = Some(why.to_owned());
    }
}

/// After a stop signal, rendered films are still written for up to 1 s, so that their trace is not
/// lost; the run must end within 2 s.
#[derive(Default)]
struct ShutdownDeadline {
    /// Time when the signal was first seen.
    since: Option<Instant>,
    /// Time that the last films took, as many as threads.
    last: Duration,
}

impl ShutdownDeadline {
    fn is_over(&mut self) -> bool {
        const PATIENCE: Duration = Duration::from_secs(1);
        let since = *self.since.get_or_insert_with(Instant::now);
        since.elapsed() + self.last > PATIENCE
    }
}

/// Warnings about a frame's image.
pub(super) fn warnings(made: &Pictures, left_out: Option<String>) -> Vec<String> {
    let saturated = (made.saturated > 0).then(|| {
        let values = made.saturated;
        format!("{values} values beyond what a file can hold were clamped")
    });
    let seen = saturated.into_iter().chain(left_out);
    seen.chain(made.warnings.clone()).collect()
}

/// The record of a frame, except its files, times and warnings.
pub(super) fn new_record(job: &Job, frame: &Frame<'_>, key: &FrameFingerprint) -> Record {
    let options = job.options();
    Record {
        frame: frame.number,
        fingerprint: key.fingerprint.clone(),
        parts: key.inputs.clone(),
        files: Vec::new(),
        size: [options.width, options.height],
        samples: options.samples,
        effects: frame.active_names(),
        trace: key.trace.clone(),
        shared: 1,
        exposure: stops(job, frame),
        seconds: Seconds::default(),
        warnings: Vec::new(),
        cut: 0.0,
        memory_mib: peak_memory_mib().map(|mib| mib as u64),
        threads: u32::try_from(rayon::current_num_threads()).unwrap_or(u32::MAX),
        host: host(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        finished: now(),
    }
}
