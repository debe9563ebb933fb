//! The background of a scene.

use super::{SkyImage, Stars};
use crate::spectrum::Spectrum;
use glam::DMat3;
use std::sync::Arc;

/// The background of a scene.
#[derive(Debug, Clone)]
pub struct Background {
    /// Index into the scene's worldlines.
    pub worldline: usize,
    /// Rest-frame axes from the sky's own axes: a rotation.
    pub axes: DMat3,
    /// Factor on `spectrum` or `image`, at least 0.
    pub scale: f64,
    /// Spectral radiance, W·m⁻²·sr⁻¹·nm⁻¹, in its rest frame; None if it is black.
    pub spectrum: Option<Arc<Spectrum>>,
    /// Image in place of `spectrum`: colors of relative light, with (1, 1, 1) as D65 of 1
    /// W·m⁻²·sr⁻¹·nm⁻¹ at 560 nm.
    pub image: Option<Arc<SkyImage>>,
    /// Stars, whose light is added.
    pub stars: Option<Arc<Stars>>,
}

impl Background {
    /// Whether it emits no light.
    pub fn is_black(&self) -> bool {
        let lit = self.spectrum.is_some() || self.image.is_some();
        self.stars.is_none() && !(lit && self.scale > 0.0)
    }
}
