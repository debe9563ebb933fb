//! The film: what the sensor gathered for each pixel of a picture.

use super::LeftOut;

/// A picture as the sensor gathered it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Film {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// What `xyz` holds.
    pub channels: Channels,
    /// CIE 1931 tristimulus values in cd/m², or the radiance of three bands in W·m⁻²·sr⁻¹, one for
    /// each pixel.
    pub xyz: Vec<[f32; 3]>,
    /// What else is known of each pixel.
    pub layers: Layers,
    /// What of its light was not followed in mirrors and glass.
    pub left_out: LeftOut,
}

/// What the three channels of a film hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Channels {
    /// CIE 1931 tristimulus values, cd/m².
    #[default]
    Xyz,
    /// Radiance in the long, middle and short third of the sensor's window, W·m⁻²·sr⁻¹; shown as
    /// red, green and blue.
    Bands,
}

/// Scene data beside the light, one value for each pixel, of the first surface that its centre
/// sees.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layers {
    /// Doppler factor ω_observed/ω_source, no unit. 0 where the background is seen.
    pub doppler: Option<Vec<f32>>,
    /// Lab length of the light path, m. 0 where the background is seen.
    pub distance: Option<Vec<f32>>,
    /// Lab time of the emission event, in metres of light travel. 0 where the background is seen.
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
