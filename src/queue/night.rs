//! The work of a night: what is to be rendered, in which order, and what others are at work on.

use super::batch::{Task, batches};
use super::claim::Claim;
use super::deed::Deed;
use super::job::{End, Force, Job};
use super::progress::Progress;
use super::work::{Foreman, Ready};
use std::sync::atomic::AtomicBool;
use std::thread::sleep;
use std::time::Duration;

/// How the jobs of a call are done.
#[derive(Clone, Copy)]
pub struct Night<'a> {
    /// Told of everything.
    pub progress: &'a Progress,
    /// Once true, the work ends within two seconds.
    pub stop: &'a AtomicBool,
    /// Which frames are rendered.
    pub force: Force,
}

impl Night<'_> {
    /// Renders what is to be rendered of jobs that are furnished. Goes on after a frame that fails,
    /// and after a shot that can do no more. `ended` is told of each job that nothing is left to do
    /// for, unless it was stopped before.
    pub fn render(self, jobs: &mut [Job], ended: &mut dyn FnMut(&mut Job)) {
        let Self {
            progress,
            stop,
            force,
        } = self;
        let foreman = Foreman { progress, stop };
        let numbered = jobs.iter().enumerate();
        let mut tasks: Vec<Task> = numbered.flat_map(|(n, job)| job.tasks(n, force)).collect();
        let paths: Vec<_> = jobs
            .iter()
            .map(|job| job.reel.shot().path.clone())
            .collect();
        let frames = jobs.iter().map(|job| job.len() as u64).sum();
        progress.start(&paths, frames, tasks.iter().map(|task| task.work).sum());
        for job in jobs.iter_mut() {
            keep(job, force, progress);
            if let Some(why) = &job.halted {
                progress.error(&format!("{}: {why}", job.reel.shot().path.display()));
            }
        }
        end_all(jobs, ended);
        let mut waits = 0_usize;
        while !tasks.is_empty() && !foreman.is_stopped() {
            let all = tasks.len();
            let mut held = Vec::new();
            for batch in batches(std::mem::take(&mut tasks), jobs) {
                if foreman.is_stopped() {
                    return;
                }
                let ready = self.claim(jobs, batch, &mut held);
                foreman.work(jobs, ready);
                end_all(jobs, ended);
            }
            tasks = held;
            if tasks.len() == all {
                wait(waits, all, progress);
                waits += 1;
            }
        }
    }

    /// What of a batch is this process's to render. What others are at work on is held over.
    fn claim(self, jobs: &mut [Job], batch: Vec<Task>, held: &mut Vec<Task>) -> Vec<Ready> {
        let Self {
            progress,
            stop,
            force,
        } = self;
        let foreman = Foreman { progress, stop };
        let mut ready = Vec::new();
        for task in batch {
            let job = &mut jobs[task.job];
            if job.halted.is_some() {
                progress.forgo(task.work);
                continue;
            }
            match Claim::frame(&job.reel.folder, &job.reel.names, task.frame) {
                Ok(Some(claim)) => {
                    let key = job.reel.keys.frame(task.frame);
                    if force == Force::No && job.came_true(&task, &key) {
                        let because = Some("rendered by another process".to_owned());
                        foreman.settle(job, &task, Deed::Kept { because });
                    } else {
                        ready.push(Ready { task, key, claim });
                    }
                }
                Ok(None) => held.push(task),
                Err(error) => foreman.failed(job, &task, &error.to_string()),
            }
        }
        ready
    }
}

/// Tells of the frames that are there already.
fn keep(job: &mut Job, force: Force, progress: &Progress) {
    let deed = Deed::Kept { because: None };
    for frame in job.fresh(force) {
        let (path, files) = (&job.reel.shot().path, job.files(frame));
        progress.frame(path, (frame, &deed), &files, 0.0);
        job.deeds.insert(frame, deed.clone());
    }
}

fn end_all(jobs: &mut [Job], ended: &mut dyn FnMut(&mut Job)) {
    for job in jobs {
        if job.end == End::Ahead && job.is_settled() {
            job.end = End::Told;
            job.release();
            ended(job);
        }
    }
}

/// Waits for the others, and says so once.
fn wait(waits: usize, frames: usize, progress: &Progress) {
    const PAUSE: Duration = Duration::from_millis(100);
    if waits == 0 {
        let s = if frames == 1 { " is" } else { "s are" };
        progress.warn(&format!(
            "{frames} frame{s} being rendered by another process; this one waits for it"
        ));
    }
    sleep(PAUSE);
}
