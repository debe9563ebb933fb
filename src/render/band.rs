//! Bands of rows, in which threads write to films.

use super::Options;
use crate::film::{Channels, Film, Layers, LeftOut};
use crate::shot::Layer;

/// Rows of pixels in a band, which one thread takes at a time.
pub(super) const BAND: usize = 8;

/// The part of an image's film that belongs to one band.
pub(super) struct Part<'a> {
    pub(super) xyz: &'a mut [[f32; 3]],
    pub(super) layers: Vec<(Layer, &'a mut [f32])>,
    pub(super) channels: Channels,
    pub(super) left_out: LeftOut,
}

impl Part<'_> {
    /// Copies the layers from an image with the same trees.
    pub(super) fn copy_layers(&mut self, from: &Part<'_>) {
        for ((_, values), (_, from)) in self.layers.iter_mut().zip(&from.layers) {
            values.copy_from_slice(from);
        }
    }
}

/// A film without light.
pub(super) fn empty_film(options: &Options, channels: Channels) -> Film {
    let pixels = options.width as usize * options.height as usize;
    let layer = |which: Layer, background: f32| {
        options
            .layers
            .contains(&which)
            .then(|| vec![background; pixels])
    };
    Film {
        width: options.width,
        height: options.height,
        channels,
        xyz: vec![[0.0; 3]; pixels],
        layers: Layers {
            doppler: layer(Layer::Doppler, 0.0),
            distance: layer(Layer::Distance, 0.0),
            emission_time: layer(Layer::EmissionTime, 0.0),
            worldline: layer(Layer::Worldline, -1.0),
        },
        left_out: LeftOut::default(),
    }
}

/// For each band of rows, its part of every film.
pub(super) fn bands(films: &mut [Film]) -> Vec<Vec<Part<'_>>> {
    let mut bands: Vec<Vec<Part<'_>>> = Vec::new();
    for film in films {
        let parts = split_bands(film);
        bands.resize_with(parts.len(), Vec::new);
        for (band, part) in bands.iter_mut().zip(parts) {
            band.push(part);
        }
    }
    bands
}

fn split_bands(film: &mut Film) -> Vec<Part<'_>> {
    let size = film.width as usize * BAND;
    let channels = film.channels;
    let mut parts: Vec<Part<'_>> = film
        .xyz
        .chunks_mut(size)
        .map(|xyz| Part {
            xyz,
            layers: Vec::new(),
            channels,
            left_out: LeftOut::default(),
        })
        .collect();
    let layers = &mut film.layers;
    for (which, layer) in [
        (Layer::Doppler, &mut layers.doppler),
        (Layer::Distance, &mut layers.distance),
        (Layer::EmissionTime, &mut layers.emission_time),
        (Layer::Worldline, &mut layers.worldline),
    ] {
        for (part, values) in parts
            .iter_mut()
            .zip(layer.iter_mut().flat_map(|l| l.chunks_mut(size)))
        {
            part.layers.push((which, values));
        }
    }
    parts
}
