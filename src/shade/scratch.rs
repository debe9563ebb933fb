//! Memory that shading reuses from ray to ray.

use super::compare::Shading;
use super::grid::Throughputs;
use super::radiance::Radiance;
use crate::spectrum::Lines;

/// Scratch memory of a [`Shader`](super::Shader), to be kept from ray to ray.
#[derive(Default)]
pub struct ShadeScratch {
    /// Weights of lamps that move with a surface, by emitter, then by lobe.
    pub(super) comoving: Vec<f64>,
    light: Vec<f32>,
    reflected: Vec<f32>,
    pub(super) throughputs: Throughputs,
    pub(super) radiance: Radiance,
    pub(super) lines: Shading<Lines>,
    pub(super) rgb: Shading<[f64; 3]>,
}

impl ShadeScratch {
    /// Two curves over `count` wavelengths, of any value.
    pub(super) fn buffers(&mut self, count: usize) -> [&mut [f32]; 2] {
        self.light.resize(count, 0.0);
        self.reflected.resize(count, 0.0);
        [&mut self.light, &mut self.reflected]
    }
}
