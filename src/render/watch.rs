//! An image to render, who hears of its progress, and who may stop it.

use crate::frame::Frame;
use crate::scene::Scene;
use std::sync::atomic::AtomicBool;

/// One of the images that share a trace. They may be of different shots.
#[derive(Clone, Copy)]
pub struct Member<'a> {
    /// The frame.
    pub frame: &'a Frame<'a>,
    /// Its scene: as the other members', but for what shading alone reads.
    pub scene: &'a Scene,
}

/// Observer of the work: receives progress, and can stop it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Called with the number of finished rays, each counted once for every image, from any thread.
    pub done: &'a (dyn Fn(u64) + Sync),
    /// If it becomes true, the work ends within milliseconds.
    pub stop: &'a AtomicBool,
}

/// Rendering was asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped")]
pub struct Stopped;
