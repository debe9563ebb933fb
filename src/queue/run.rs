//! A run: the frames of some shots rendered, batch by batch, beside other processes that may render
//! the same shots.

use super::batch::{ClaimedFrame, FrameTask, batches};
use super::job::Job;
use super::jobs::{Contradiction, JobList};
use super::render_batch::{Unrendered, render};
use super::settings::{Force, Settings};
use super::write_batch::write;
use crate::progress::FrameOutcome;
use crate::shot::{Mistakes, Shot};
use crate::store::{Claim, FolderError, sweep};
use std::collections::VecDeque;
use std::thread::sleep;
use std::time::Duration;

/// A run of some jobs. It goes on after a frame that fails, and after a shot that can do no more.
///
/// # Example
/// A shot rendered to memory:
/// ```
/// use restframe::progress::Progress;
/// use restframe::queue::{Output, Run, Settings, Stop};
/// use std::path::Path;
/// use std::sync::Mutex;
///
/// // A ball in front of a gray background, seen by a camera at rest.
/// let text = r#"
/// [image]
/// size = [4, 2]
/// [[model]]
/// file = "assets/sphere.obj"
/// [background]
/// spectrum = 0.001
/// [camera]
/// position = [0, 0, 5]
/// [sensor]
/// exposure = 0
/// "#;
/// let shot = restframe::shot::parse(text, Path::new("gray.toml"))?;
/// let (progress, stop) = (Progress::silent(), Stop::default());
/// let frames = Mutex::new(Vec::new());
/// let keep = |frame| frames.lock().expect("no panic").push(frame);
/// let settings = Settings {
///     output: Output::Memory(&keep),
///     ..Settings::new(&progress, &stop)
/// };
/// let mut run = Run::open(&[shot], settings)?;
/// run.render_all();
/// assert!(run.jobs()[0].missing().is_empty());
/// let (extension, png) = &frames.into_inner()?[0].files[0];
/// assert_eq!((*extension, &png[1..4]), ("png", &b"PNG"[..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run<'a> {
    jobs: Vec<Job>,
    unreadable: Vec<FolderError>,
    settings: Settings<'a>,
    is_begun: bool,
    batches: VecDeque<Vec<FrameTask>>,
    /// Tasks that other processes have claimed, to be checked again.
    held: Vec<FrameTask>,
    /// Number of tasks when `batches` was made.
    pass: usize,
    waits: usize,
}

/// Reason why a run does not begin.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The run contradicts itself or its shots.
    #[error(transparent)]
    Contradiction(#[from] Contradiction),
    /// Mistakes in shots, those of each shot together.
    #[error("{}", joined(.0))]
    Mistakes(Vec<Mistakes>),
}

fn joined(mistakes: &[Mistakes]) -> String {
    let reports = mistakes.iter().map(ToString::to_string);
    reports.collect::<Vec<_>>().join("\n")
}

impl<'a> Run<'a> {
    /// A run of some shots, whose files are read where a frame is to be rendered. Nothing is written
    /// before [`next_finished`](Self::next_finished). A folder that cannot be read keeps no other shot
    /// from being rendered: it is reported, and one of [`unreadable`](Self::unreadable).
    ///
    /// # Errors
    /// What is wrong with any shot: none is rendered then.
    pub fn open(shots: &[Shot], settings: Settings<'a>) -> Result<Self, RunError> {
        let list = JobList::open(shots, &settings)?;
        if !list.mistakes.is_empty() {
            return Err(RunError::Mistakes(list.mistakes));
        }
        Ok(Self {
            jobs: list.jobs,
            unreadable: list.unreadable,
            settings,
            is_begun: false,
            batches: VecDeque::new(),
            pass: usize::MAX,
            held: Vec::new(),
            waits: 0,
        })
    }

    /// Makes folders ready, and reports the frames that are there already.
    fn begin(&mut self) {
        let (jobs, settings) = (&mut self.jobs, &self.settings);
        let progress = settings.progress;
        for job in jobs.iter_mut() {
            match settings.output.is_folder() {
                true => job.prepare_folder(settings.shard),
                false => job.prepare_memory(),
            }
        }
        let mut tasks = Vec::new();
        let mut kept = Vec::new();
        for (number, job) in jobs.iter_mut().enumerate() {
            let (wanted, fresh) = job.take_tasks(number, settings);
            tasks.extend(wanted);
            kept.push(fresh);
        }
        let paths = jobs.iter().map(|job| job.folder.shot().path.clone());
        let paths: Vec<_> = paths.collect();
        let frames = jobs.iter().map(|job| job.frames().len() as u64).sum();
        progress.start(&paths, frames, tasks.iter().map(|task| task.work).sum());
        for (job, kept) in jobs.iter_mut().zip(kept) {
            for frame in kept {
                job.keep(frame, progress);
            }
            if let Some(why) = &job.halted {
                let path = job.folder.shot().path.display();
                progress.error(&format!("{path}: {why}"));
            }
        }
        self.held = tasks;
    }

    /// The jobs.
    pub fn jobs(&self) -> &[Job] {
        &self.jobs
    }

    /// Why the folders of other shots could not be read.
    pub fn unreadable(&self) -> &[FolderError] {
        &self.unreadable
    }

    /// Renders until nothing is left to do for one more job, and returns it; each job once. None when
    /// there is no other, or when the run was stopped.
    pub fn next_finished(&mut self) -> Option<&mut Job> {
        if !std::mem::replace(&mut self.is_begun, true) {
            self.begin();
        }
        loop {
            let is_finished = |job: &Job| !job.is_reported && job.is_settled();
            if let Some(number) = self.jobs.iter().position(is_finished) {
                let job = &mut self.jobs[number];
                job.is_reported = true;
                if self.settings.output.is_folder() {
                    sweep(&job.folder.path, &job.folder.names);
                }
                job.release();
                return Some(job);
            }
            if self.settings.is_stopped() || !self.next_batch() {
                return None;
            }
        }
    }

    /// Renders all jobs, unless the run is stopped.
    pub fn render_all(&mut self) {
        while self.next_finished().is_some() {}
    }

    /// Renders the next batch, or waits for other processes; false if nothing is left.
    fn next_batch(&mut self) -> bool {
        if let Some(batch) = self.batches.pop_front() {
            let claimed = self.claim(batch);
            self.work(claimed);
            return true;
        }
        let tasks = std::mem::take(&mut self.held);
        if tasks.is_empty() {
            return false;
        }
        if tasks.len() == self.pass {
            self.wait(tasks.len());
        }
        self.pass = tasks.len();
        let options: Vec<_> = self.jobs.iter().map(Job::options).collect();
        self.batches = batches(tasks, &options).into();
        true
    }

    /// The part of a batch that this process can claim. Frames claimed by others are checked again
    /// later.
    fn claim(&mut self, batch: Vec<FrameTask>) -> Vec<ClaimedFrame> {
        let settings = &self.settings;
        let progress = settings.progress;
        let mut claimed = Vec::new();
        for task in batch {
            let job = &mut self.jobs[task.job];
            if job.halted.is_some() {
                progress.discard(task.work);
                continue;
            }
            let claim = match settings.output.is_folder() {
                true => Claim::frame(&job.folder.path, &job.folder.names, task.frame),
                false => Ok(Some(Claim::none())),
            };
            match claim {
                Ok(Some(claim)) => {
                    let key = job.folder.keys.frame(task.frame);
                    let may_be_there = settings.output.is_folder() && settings.force == Force::No;
                    if may_be_there && job.was_rendered_meanwhile(&task, &key) {
                        let reason = Some("rendered by another process".to_owned());
                        job.settle(&task, FrameOutcome::Kept { reason }, progress);
                    } else {
                        claimed.push(ClaimedFrame { task, key, claim });
                    }
                }
                Ok(None) => self.held.push(task),
                Err(error) => job.fail(&task, &error.to_string(), progress),
            }
        }
        claimed
    }

    /// Renders and writes a batch, whose claims end with it. A frame that fails is reported, and
    /// the others are tried again.
    fn work(&mut self, mut batch: Vec<ClaimedFrame>) {
        let (jobs, settings) = (&mut self.jobs, &self.settings);
        while !batch.is_empty() && !settings.is_stopped() {
            match render(jobs, &batch, settings) {
                Ok(rendered) => return write(jobs, batch, rendered, settings),
                Err(Unrendered::Stopped) => return,
                Err(Unrendered::Failed(index, error)) => {
                    let ClaimedFrame { task, .. } = batch.remove(index);
                    jobs[task.job].fail(&task, &error.to_string(), settings.progress);
                }
            }
            settings.progress.reset_in_flight();
        }
    }

    /// Waits for other processes, and reports that once.
    fn wait(&mut self, frames: usize) {
        const PAUSE: Duration = Duration::from_millis(100);
        if self.waits == 0 {
            let s = if frames == 1 { " is" } else { "s are" };
            self.settings.progress.warn(&format!(
                "{frames} frame{s} being rendered by another process; this one waits for it"
            ));
        }
        self.waits += 1;
        sleep(PAUSE);
    }
}
