//! The film: light gathered by the sensor for each pixel of an image.

use super::LeftOut;

/// An image as the sensor gathered it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Film {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// The meaning of `xyz`.
    pub channels: Channels,
    /// CIE 1931 tristimulus values in cd/m², or the radiance of three bands in W·m⁻²·sr⁻¹, one
    /// triple per pixel.
    pub xyz: Vec<[f32; 3]>,
    /// Scene data for each pixel.
    pub layers: Layers,
    /// Light that was not followed in mirrors and glass.
    pub left_out: LeftOut,
}

/// The meaning of the three channels of a film.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Channels {
    /// CIE 1931 tristimulus values, cd/m².
    #[default]
    Xyz,
    /// Radiance in the long, middle and short third of the sensor's window, W·m⁻²·sr⁻¹; shown as
    /// red, green and blue.
    Bands,
}

/// Scene data of the first surface seen through the center of each pixel, one value per pixel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layers {
    /// Doppler factor ω_observed/ω_source, no unit. 0 where the background is seen.
    pub doppler: Option<Vec<f32>>,
    /// Lab length of the light path, m. 0 where the background is seen.
    pub distance: Option<Vec<f32>>,
    /// Lab time of the emission event, in meters of light travel. 0 where the background is seen.
    pub emission_time: Option<Vec<f32>>,
    /// Index of the worldline that carries the surface. −1 where the background is seen.
    pub worldline: Option<Vec<f32>>,
}

impl Layers {
    /// The layers that exist, with the names they have in files, in the order of those names.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &[f32])> {
        [
            ("distance", &self.distance),
            ("doppler", &self.doppler),
            ("emission_time", &self.emission_time),
            ("worldline", &self.worldline),
        ]
        .into_iter()
        .filter_map(|(name, layer)| layer.as_deref().map(|values| (name, values)))
    }
}
