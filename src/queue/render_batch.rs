//! Rendering a batch of frames, from scenes to films. All tracing is done here.

use super::batch::ClaimedFrame;
use super::job::Job;
use super::memory::{TooLarge, check_memory};
use super::settings::Settings;
use crate::accel::Aggregate;
use crate::frame::Frame;
use crate::progress::Progress;
use crate::render::{Member, Prepared, ShotExposure, Stopped, Together, Watch, render_together};
use crate::scene::Scene;
use crate::shot::Mistakes;
use crate::trace::build_aggregate;
use std::sync::Arc;
use std::time::Instant;

/// A batch that has been rendered.
pub(super) struct RenderedBatch {
    /// Index of the first frame's job.
    pub(super) first: usize,
    /// One for each frame.
    pub(super) scenes: Vec<Scene>,
    pub(super) aggregate: Aggregate,
    pub(super) together: Together,
}

/// Reason why a batch gave no films.
pub(super) enum Unrendered {
    Stopped,
    /// This frame of the batch failed; the others may succeed.
    Failed(usize, RenderError),
}

/// Reason why a frame cannot be rendered.
#[derive(Debug, thiserror::Error)]
pub(super) enum RenderError {
    /// Too large for this machine.
    #[error(transparent)]
    Memory(#[from] TooLarge),
    /// The shot has a mistake that shows in this frame alone.
    #[error("{0}")]
    Mistakes(Box<Mistakes>),
}

/// Renders a batch, which is not empty. Bodies and trees are taken over from the image that the
/// first frame's job rendered last.
pub(super) fn render(
    jobs: &mut [Job],
    batch: &[ClaimedFrame],
    settings: &Settings<'_>,
) -> Result<RenderedBatch, Unrendered> {
    let begun = Instant::now();
    for (index, ClaimedFrame { task, .. }) in batch.iter().enumerate() {
        let job = &mut jobs[task.job];
        meter(job, settings.progress).map_err(|m| mistaken(index, m))?;
        check_memory(job.options()).map_err(|error| Unrendered::Failed(index, error.into()))?;
    }
    let first = batch[0].task.job;
    let kept = jobs[first].kept.take();
    let jobs = &*jobs;
    let frames = frames(jobs, batch)?;
    let scenes = scenes(jobs, batch, &frames, kept.as_ref().map(|(scene, _)| scene))?;
    let aggregate = aggregate(kept, &scenes[0]);
    let prepare = begun.elapsed().as_secs_f64();
    let member = |(frame, scene)| Member { frame, scene };
    let members: Vec<Member<'_>> = frames.iter().zip(&scenes).map(member).collect();
    let options = jobs[first].options();
    let rays = f64::from(options.width) * f64::from(options.height) * f64::from(options.samples);
    let work: f64 = batch.iter().map(|claimed| claimed.task.work).sum();
    let work_per_ray = work / (rays * batch.len() as f64);
    let watch = Watch {
        done: &|rays| settings.progress.advance(rays as f64 * work_per_ray),
        stop: settings.stop.asked(),
    };
    let rendered = render_together(&members, &aggregate, options, watch);
    let mut together = rendered.map_err(|Stopped| Unrendered::Stopped)?;
    together.prepare += prepare;
    Ok(RenderedBatch {
        first,
        scenes,
        aggregate,
        together,
    })
}

/// Exposure of a frame, stops.
pub(super) fn stops(job: &Job, frame: &Frame<'_>) -> f64 {
    let shot_exposure = job.shot_exposure.as_ref();
    shot_exposure.map_or(0.0, |shot_exposure| shot_exposure.stops(frame))
}

/// Determines a shot's exposure, once.
fn meter(job: &mut Job, progress: &Progress<'_>) -> Result<(), Mistakes> {
    let (None, Some(prepared)) = (&job.shot_exposure, &job.prepared) else {
        return Ok(());
    };
    let (shot_exposure, kept) = prepared.exposure()?;
    if matches!(shot_exposure, ShotExposure::Black) {
        let path = prepared.shot.path.display();
        progress.warn(&format!(
            "{path}: frame 1 is black, so exposure is 0 stops; give sensor.exposure"
        ));
    }
    job.shot_exposure = Some(shot_exposure);
    job.kept = kept;
    Ok(())
}

/// The frames of a batch.
fn frames<'a>(jobs: &'a [Job], batch: &[ClaimedFrame]) -> Result<Vec<Frame<'a>>, Unrendered> {
    let frame = |(index, ClaimedFrame { task, .. }): (usize, &ClaimedFrame)| {
        let frame = Frame::new(jobs[task.job].folder.shot(), task.frame);
        frame.map_err(|m| mistaken(index, m))
    };
    batch.iter().enumerate().map(frame).collect()
}

/// The scenes of a batch; bodies are taken over from the last one of the same shot, first from
/// `kept`, which belongs to the first frame's job.
fn scenes(
    jobs: &[Job],
    batch: &[ClaimedFrame],
    frames: &[Frame<'_>],
    kept: Option<&Scene>,
) -> Result<Vec<Scene>, Unrendered> {
    let mut scenes: Vec<Scene> = Vec::with_capacity(batch.len());
    for (index, claimed) in batch.iter().enumerate() {
        let number = claimed.task.job;
        let prepared = prepared(&jobs[number]);
        let last = (0..index).rev().find(|&i| batch[i].task.job == number);
        let kept = kept.filter(|_| number == batch[0].task.job);
        let earlier = last.map(|last| &scenes[last]).or(kept);
        let scene = Scene::resolve(&frames[index], &prepared.library, earlier);
        scenes.push(scene.map_err(|m| mistaken(index, m))?);
    }
    Ok(scenes)
}

/// Bodies taken over from the last image if they have not moved, trees if possible.
fn aggregate(kept: Option<(Scene, Aggregate)>, scene: &Scene) -> Aggregate {
    match kept {
        Some((old, aggregate)) if Arc::ptr_eq(&old.geometry, &scene.geometry) => aggregate,
        other => {
            let earlier = other.as_ref().map(|(_, aggregate)| aggregate);
            build_aggregate(&scene.geometry, earlier)
        }
    }
}

fn mistaken(index: usize, mistakes: Mistakes) -> Unrendered {
    Unrendered::Failed(index, RenderError::Mistakes(Box::new(mistakes)))
}

fn prepared(job: &Job) -> &Prepared {
    let prepared = job.prepared.as_ref();
    prepared.expect("a shot with frames to be rendered is prepared first")
}
