//! What is seen where no surface is: a spectrum or an image all around, and stars before it.
//!
//! Directions are unit vectors away from the observer, in the sky's own axes: −z in the middle of
//! an image, +y up, columns to the right and azimuths grow to the right.

mod catalogue;
mod decode;
mod image;
mod openexr;
mod primaries;
mod radiance;
mod random;
mod stars;
mod warning;

use crate::spectrum::Spectrum;
use glam::DMat3;
use std::sync::Arc;

pub use catalogue::{CatalogueError, Star};
pub use decode::SkyImageError;
pub use image::{MOST_PIXELS, MOST_SIDES, SkyImage};
pub use random::random_stars;
pub use stars::{StarLight, Stars};
pub use warning::SkyWarning;

/// The sky.
#[derive(Debug, Clone)]
pub struct Background {
    /// Index into the scene's worldlines.
    pub worldline: usize,
    /// From the sky's own axes to those of its rest frame: a rotation.
    pub axes: DMat3,
    /// Factor on `spectrum` or `image`, at least 0.
    pub scale: f64,
    /// Spectral radiance, W·m⁻²·sr⁻¹·nm⁻¹, in its rest frame; None where it is black.
    pub spectrum: Option<Arc<Spectrum>>,
    /// In place of `spectrum`: colors of relative light, (1, 1, 1) being D65 that is
    /// 1 W·m⁻²·sr⁻¹·nm⁻¹ at 560 nm.
    pub image: Option<Arc<SkyImage>>,
    /// Stars, whose light is added.
    pub stars: Option<Arc<Stars>>,
}

impl Background {
    /// Whether no light comes from it.
    pub fn is_black(&self) -> bool {
        let lit = self.spectrum.is_some() || self.image.is_some();
        self.stars.is_none() && !(lit && self.scale > 0.0)
    }
}
