//! An image to render: its size and quality, who hears of its progress, and who may stop it.

use crate::frame::Frame;
use crate::scene::Scene;
use crate::shot::Layer;
use std::sync::atomic::AtomicBool;

/// Size and quality of an image, as given on the command line or by the shot.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Layers besides the light.
    pub layers: Vec<Layer>,
}

/// Memory of an image's film with its layers, in bytes.
pub fn film_bytes(options: &Options) -> u64 {
    const LAYERS: [Layer; 4] = [
        Layer::Doppler,
        Layer::Distance,
        Layer::EmissionTime,
        Layer::Worldline,
    ];
    let layers = LAYERS.iter().filter(|layer| options.layers.contains(layer));
    let pixel = size_of::<[f32; 3]>() + size_of::<f32>() * layers.count();
    u64::from(options.width) * u64::from(options.height) * pixel as u64
}

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
