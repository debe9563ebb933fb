//! Encoding and writing of a batch: films to files and records. Nothing is traced here.

use super::batch::{ClaimedFrame, FrameTask};
use super::job::Job;
use super::memory::most_developed;
use super::record::{new_record, warnings};
use super::render_batch::{Probed, RenderedBatch, stops};
use super::settings::{Output, RenderedFrame, Settings};
use crate::film::Film;
use crate::frame::Frame;
use crate::plot::Plot;
use crate::progress::FrameOutcome;
use crate::render::{PictureInfo, Pictures, Together, encode};
use crate::scene::Scene;
use crate::store::{FileRecord, Record, Seconds, is_full, now, twice, write_atomically};
use rayon::prelude::*;
use std::io;
use std::time::{Duration, Instant};

/// A frame, its scene, its film, and what its picture shows beside that.
type Rendered<'a> = (ClaimedFrame, &'a Scene, Film, Probed);

/// Encodes and writes a batch, as many films at once as threads and memory allow; a frame is settled
/// when its record is on the disk.
pub(super) fn write(
    jobs: &mut [Job],
    batch: Vec<ClaimedFrame>,
    rendered: RenderedBatch,
    settings: &Settings<'_>,
) {
    let RenderedBatch {
        first,
        scenes,
        stage,
        together,
        probed,
    } = rendered;
    let Together {
        films,
        prepare,
        trace,
        shade,
    } = together;
    let shared = batch.len();
    let part = |seconds: f64| seconds / shared as f64;
    let frames = batch.into_iter().zip(&scenes).zip(films).zip(probed);
    let mut rest = frames.filter_map(|(((claimed, scene), film), probed)| {
        probed.map(|probed| (claimed, scene, film, probed))
    });
    let most = most_developed(jobs[first].options(), rayon::current_num_threads());
    let mut deadline = ShutdownDeadline::default();
    loop {
        let chunk: Vec<Rendered<'_>> = rest.by_ref().take(most).collect();
        if chunk.is_empty() || settings.is_stopped() && deadline.is_over() {
            break;
        }
        // A picture that cannot be stored is not encoded.
        let (lost, chunk): (Vec<_>, Vec<_>) = chunk
            .into_iter()
            .partition(|(claimed, ..)| jobs[claimed.task.job].halted.is_some());
        for (claimed, ..) in lost {
            settings.progress.discard(claimed.task.work);
        }
        let begun = Instant::now();
        let encoded: Vec<_> = chunk
            .into_par_iter()
            .map(|(claimed, scene, film, probed)| {
                let Probed { insets, left_out } = probed;
                let made = encoded(&jobs[claimed.task.job], &claimed, scene, &film, &insets);
                (claimed, made, film.left_out.share(), left_out)
            })
            .collect();
        let encode_seconds = begun.elapsed().as_secs_f64() / encoded.len() as f64;
        for (claimed, made, cut, left_out) in encoded {
            let job = &mut jobs[claimed.task.job];
            let seconds = Seconds {
                prepare: part(prepare),
                trace: part(trace),
                shade: part(shade),
                encode: encode_seconds,
                write: 0.0,
            };
            match made {
                _ if job.halted.is_some() => settings.progress.discard(claimed.task.work),
                Ok((made, record)) => {
                    let record = Record {
                        warnings: warnings(&made, left_out),
                        cut,
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
        deadline.last = begun.elapsed();
    }
    drop(rest);
    jobs[first].kept = scenes.into_iter().next().map(|scene| (scene, stage));
}

/// A film as files, and their record but for its files, times and warnings.
///
/// # Errors
/// When an encoder refuses.
fn encoded(
    job: &Job,
    claimed: &ClaimedFrame,
    scene: &Scene,
    film: &Film,
    insets: &[Option<Plot>],
) -> Result<(Pictures, Record), String> {
    let frame = Frame::new(job.folder.shot(), claimed.task.frame).map_err(|m| m.to_string())?;
    let info = PictureInfo {
        exposure_stops: stops(job, &frame),
        samples: job.options().samples,
        fingerprint: Some(&claimed.key.fingerprint),
    };
    let made = encode(&frame, scene, film, insets, info).map_err(|error| error.to_string())?;
    Ok((made, new_record(job, &frame, &claimed.key)))
}

/// The files of a frame to where they go, then its record.
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

/// Fails a frame that cannot be written; where the disk is full, halts its job.
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
    /// When the signal was first seen.
    since: Option<Instant>,
    /// What the last films took, as many as threads.
    last: Duration,
}

impl ShutdownDeadline {
    fn is_over(&mut self) -> bool {
        const PATIENCE: Duration = Duration::from_secs(1);
        let since = *self.since.get_or_insert_with(Instant::now);
        since.elapsed() + self.last > PATIENCE
    }
}
