//! Size and quality of an image.

use crate::shot::Layer;

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
