//! A batch of frames, from scenes to files and records.

use super::batch::Task;
use super::claim::Claim;
use super::deed::Deed;
use super::job::Job;
use super::machine::{now, peak_memory_mib};
use super::manifest::{FileRecord, Record, Seconds};
use super::memory::{check_memory, most_developed};
use super::picture::{Pictures, Taken, pictures};
use super::progress::Progress;
use super::record::{blank, stops, warnings};
use super::shots::{Exposing, Prepared, RenderError};
use super::write::{is_full, twice, write_atomically};
use crate::film::Film;
use crate::frame::{Frame, FrameFingerprint};
use crate::render::{Member, Stopped, Together, Watch, render_together};
use crate::scene::Scene;
use crate::shot::{Mistakes, Shot};
use crate::trace::Stage;
use rayon::prelude::*;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A frame that this process alone works on.
pub(super) struct Ready {
    pub(super) task: Task,
    /// What the frame is made of.
    pub(super) key: FrameFingerprint,
    pub(super) claim: Claim,
}

/// Why a batch gave no films.
enum Undone {
    Stopped,
    /// This frame of the batch; the others may do.
    Failed(usize, RenderError),
}

/// Who is told, and who may stop the work.
#[derive(Clone, Copy)]
pub(super) struct Foreman<'a> {
    pub(super) progress: &'a Progress,
    pub(super) stop: &'a AtomicBool,
}

impl Foreman<'_> {
    /// Whether the work is to stop.
    pub(super) fn is_stopped(self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Renders and writes a batch; the claims are dropped with it. A frame that fails is told and
    /// left.
    pub(super) fn work(self, jobs: &mut [Job], mut batch: Vec<Ready>) {
        while !batch.is_empty() && !self.is_stopped() {
            match self.shoot(jobs, &batch) {
                Ok(shots) => return self.develop(jobs, batch, shots),
                Err(Undone::Stopped) => return,
                Err(Undone::Failed(index, error)) => {
                    let ready = batch.remove(index);
                    self.failed(&mut jobs[ready.task.job], &ready.task, &error.to_string());
                }
            }
            self.progress.rest();
        }
    }

    /// The batch's scenes, rendered.
    fn shoot(self, jobs: &mut [Job], batch: &[Ready]) -> Result<Shoot, Undone> {
        let begun = Instant::now();
        for (index, ready) in batch.iter().enumerate() {
            self.meter(&mut jobs[ready.task.job])
                .map_err(|m| mistaken(index, m))?;
            check_memory(&jobs[ready.task.job].options)
                .map_err(|error| Undone::Failed(index, error))?;
        }
        let first = batch[0].task.job;
        let kept = jobs[first].kept.take();
        let jobs = &*jobs;
        let frames = frames(jobs, batch)?;
        let scenes = scenes(jobs, batch, &frames, kept.as_ref().map(|(scene, _)| scene))?;
        let stage = stage(kept, &scenes[0], jobs[first].reel.shot());
        let prepare = begun.elapsed().as_secs_f64();
        let members = frames.iter().zip(&scenes);
        let members: Vec<_> = members
            .map(|(frame, scene)| Member { frame, scene })
            .collect();
        let options = &jobs[first].options;
        let rays =
            f64::from(options.width) * f64::from(options.height) * f64::from(options.samples);
        let work: f64 = batch.iter().map(|ready| ready.task.work).sum();
        let work_per_ray = work / (rays * batch.len() as f64);
        let watch = Watch {
            done: &|rays| self.progress.advance(rays as f64 * work_per_ray),
            stop: self.stop,
        };
        let rendered = render_together(&members, &stage, options, watch);
        let mut together = rendered.map_err(|Stopped| Undone::Stopped)?;
        together.prepare += prepare;
        Ok(Shoot {
            first,
            scenes,
            stage,
            together,
        })
    }

    /// Finds a shot's exposure, once.
    fn meter(self, job: &mut Job) -> Result<(), Mistakes> {
        let (None, Some(prepared)) = (&job.exposing, &job.prepared) else {
            return Ok(());
        };
        let (exposing, kept) = prepared.exposure()?;
        if matches!(exposing, Exposing::Black) {
            let path = prepared.shot.path.display();
            self.progress.warn(&format!(
                "{path}: frame 1 is black, so exposure is 0 stops; give sensor.exposure"
            ));
        }
        job.exposing = Some(exposing);
        job.kept = kept;
        Ok(())
    }

    /// Films to files, as many at once as threads and memory allow; a frame is told when it is on the
    /// disk.
    fn develop(self, jobs: &mut [Job], batch: Vec<Ready>, shoot: Shoot) {
        let Shoot {
            first,
            scenes,
            stage,
            together,
        } = shoot;
        let Together {
            films,
            prepare,
            trace,
            shade,
        } = together;
        let shared = batch.len();
        let part = |seconds: f64| seconds / shared as f64;
        let mut rest = batch.into_iter().zip(&scenes).zip(films);
        let most = most_developed(&jobs[first].options, rayon::current_num_threads());
        let mut patience = Patience::default();
        loop {
            let chunk: Vec<((Ready, &Scene), Film)> = rest.by_ref().take(most).collect();
            if chunk.is_empty() || self.is_stopped() && patience.is_out() {
                break;
            }
            // A picture that there is no room for need not be made.
            let (lost, chunk): (Vec<_>, Vec<_>) = chunk
                .into_iter()
                .partition(|((ready, _), _)| jobs[ready.task.job].halted.is_some());
            for ((ready, _), _) in lost {
                self.progress.forgo(ready.task.work);
            }
            let begun = Instant::now();
            let encoded: Vec<_> = chunk
                .into_par_iter()
                .map(|((ready, scene), film)| {
                    let job = &jobs[ready.task.job];
                    let made = encode(job, &ready, scene, &stage, &film);
                    (ready, made)
                })
                .collect();
            let encode = begun.elapsed().as_secs_f64() / encoded.len() as f64;
            for (ready, made) in encoded {
                let job = &mut jobs[ready.task.job];
                let seconds = Seconds {
                    prepare: part(prepare),
                    trace: part(trace),
                    shade: part(shade),
                    encode,
                    write: 0.0,
                };
                match made {
                    _ if job.halted.is_some() => self.progress.forgo(ready.task.work),
                    Ok((record, made)) => {
                        let record = Record {
                            seconds,
                            shared: u32::try_from(shared).unwrap_or(u32::MAX),
                            ..record
                        };
                        self.file(job, &ready, made, record);
                    }
                    Err(error) => self.failed(job, &ready.task, &error.to_string()),
                }
                // Only now may another process look at the frame.
                drop(ready.claim);
            }
            patience.last = begun.elapsed();
        }
        drop(rest);
        jobs[first].kept = scenes.into_iter().next().map(|scene| (scene, stage));
    }

    /// The files of a frame to the disk, then its record.
    fn file(self, job: &mut Job, ready: &Ready, made: Pictures, record: Record) {
        let task = &ready.task;
        let begun = Instant::now();
        let written = self.write(job, task, &made);
        let seconds = Seconds {
            write: begun.elapsed().as_secs_f64(),
            ..record.seconds
        };
        let (Ok(files), Some(ledger)) = (&written, &job.ledger) else {
            return self.unwritten(job, task, written.err());
        };
        let record = Record {
            files: files.clone(),
            warnings: warnings(&made),
            cut: made.cut,
            seconds,
            memory_mib: peak_memory_mib(),
            finished: now(),
            ..record
        };
        if let Err(error) = twice(|| ledger.append(&record)) {
            return self.unwritten(job, task, Some(error));
        }
        for warning in &record.warnings {
            let path = job.reel.shot().path.display();
            self.progress
                .warn(&format!("{path}: frame {}: {warning}", task.frame));
        }
        job.reel.records.insert(task.frame, record);
        let deed = Deed::Rendered {
            because: task.because.clone(),
            seconds: seconds.total(),
            cut: made.cut,
        };
        self.settle(job, task, deed);
    }

    fn write(self, job: &Job, task: &Task, made: &Pictures) -> io::Result<Vec<FileRecord>> {
        let file = |(extension, bytes): &(&str, Vec<u8>)| {
            let name = job.reel.names.frame(task.frame, extension);
            twice(|| write_atomically(&job.reel.folder.join(&name), bytes))?;
            Ok(FileRecord {
                name,
                bytes: bytes.len() as u64,
                blake3: blake3::hash(bytes).to_hex().to_string(),
            })
        };
        made.files.iter().map(file).collect()
    }

    /// A frame is made and cannot be kept; where there is no room, its shot is done with.
    fn unwritten(self, job: &mut Job, task: &Task, error: Option<io::Error>) {
        let error =
            error.unwrap_or_else(|| io::Error::other("there is no manifest to record it in"));
        self.failed(job, task, &error.to_string());
        if is_full(&error) {
            let why = "there is no room for its images";
            let path = job.reel.shot().path.display();
            self.progress
                .error(&format!("{path}: {why}; its other frames are left"));
            job.halted = Some(why.to_owned());
        }
    }

    /// Tells that a frame failed.
    pub(super) fn failed(self, job: &mut Job, task: &Task, because: &str) {
        let path = job.reel.shot().path.display();
        self.progress
            .error(&format!("{path}: frame {}: {because}", task.frame));
        let because = because.to_owned();
        self.settle(job, task, Deed::Failed { because });
    }

    /// Tells what was done about a frame.
    pub(super) fn settle(self, job: &mut Job, task: &Task, deed: Deed) {
        let path = &job.reel.shot().path;
        let files = job.files(task.frame);
        self.progress
            .frame(path, (task.frame, &deed), &files, task.work);
        job.deeds.insert(task.frame, deed);
    }
}

/// How long films that are rendered may still be written after a signal: two seconds are promised
/// until the end, and to throw away a night's trace would be a pity.
#[derive(Default)]
struct Patience {
    /// When a signal was first seen.
    since: Option<Instant>,
    /// What the last films took, as many as threads.
    last: Duration,
}

impl Patience {
    fn is_out(&mut self) -> bool {
        const PATIENCE: Duration = Duration::from_secs(1);
        let since = *self.since.get_or_insert_with(Instant::now);
        since.elapsed() + self.last > PATIENCE
    }
}

/// A batch that has been rendered.
struct Shoot {
    /// Number of the first frame's job.
    first: usize,
    /// One for each frame.
    scenes: Vec<Scene>,
    stage: Stage,
    together: Together,
}

/// The frames of a batch.
fn frames<'a>(jobs: &'a [Job], batch: &[Ready]) -> Result<Vec<Frame<'a>>, Undone> {
    let frame = |(index, ready): (usize, &Ready)| {
        let task = &ready.task;
        let frame = Frame::new(jobs[task.job].reel.shot(), task.frame);
        frame.map_err(|m| mistaken(index, m))
    };
    batch.iter().enumerate().map(frame).collect()
}

/// The files of a frame, and its record but for its files, times and warnings.
fn encode(
    job: &Job,
    ready: &Ready,
    scene: &Scene,
    stage: &Stage,
    film: &Film,
) -> Result<(Record, Pictures), RenderError> {
    let frame = Frame::new(job.reel.shot(), ready.task.frame)
        .map_err(|mistakes| RenderError::Mistakes(Box::new(mistakes)))?;
    let taken = Taken {
        exposure_stops: stops(job, &frame),
        samples: job.options.samples,
        fingerprint: Some(&ready.key.fingerprint),
    };
    let made = pictures(&frame, scene, stage, film, taken)?;
    Ok((blank(job, &frame, &ready.key), made))
}

/// The scenes of a batch; bodies are taken over from the last one of the same shot, first from
/// `kept`, which is of the first frame's.
fn scenes(
    jobs: &[Job],
    batch: &[Ready],
    frames: &[Frame<'_>],
    kept: Option<&Scene>,
) -> Result<Vec<Scene>, Undone> {
    let mut scenes: Vec<Scene> = Vec::with_capacity(batch.len());
    for (index, ready) in batch.iter().enumerate() {
        let number = ready.task.job;
        let prepared = prepared(&jobs[number]);
        let last = (0..index).rev().find(|&i| batch[i].task.job == number);
        let kept = kept.filter(|_| number == batch[0].task.job);
        let earlier = last.map(|last| &scenes[last]).or(kept);
        let scene = Scene::resolve(&frames[index], &prepared.library, earlier);
        scenes.push(scene.map_err(|m| mistaken(index, m))?);
    }
    Ok(scenes)
}

/// Bodies taken over from the last image where they stand as they stood, trees where they can be.
fn stage(kept: Option<(Scene, Stage)>, scene: &Scene, shot: &Shot) -> Stage {
    match kept {
        Some((old, stage)) if Arc::ptr_eq(&old.geometry, &scene.geometry) => stage,
        other => Stage::with_precision(
            &scene.geometry,
            other.as_ref().map(|(_, stage)| stage),
            shot.accuracy.tracing,
        ),
    }
}

fn mistaken(index: usize, mistakes: Mistakes) -> Undone {
    Undone::Failed(index, RenderError::Mistakes(Box::new(mistakes)))
}

fn prepared(job: &Job) -> &Prepared {
    let prepared = job.prepared.as_ref();
    prepared.expect("a shot with frames to be rendered is prepared first")
}
