//! A film's picture files, and what the readers of other people find in them.

use exr::prelude::{ReadChannels, ReadLayers};
use restframe::color::spaces::{RGB_FROM_XYZ, encode};
use restframe::film::{Development, Film, develop};
use restframe::image::{Metadata, exr as exr_file, png as png_file};
use std::io::Cursor;

/// What became of a film at 0 stops.
pub(crate) struct Files {
    /// Linear light before it was encoded.
    pub(crate) linear: Vec<[f32; 3]>,
    /// Values that were clamped.
    pub(crate) saturated: u64,
    /// Bytes of the EXR and of the PNG.
    pub(crate) bytes: [Vec<u8>; 2],
    /// Names and values of the EXR's channels, read back.
    pub(crate) channels: Vec<(String, Vec<f32>)>,
    /// The PNG's values, read back.
    pub(crate) rgb8: Vec<u8>,
}

impl Files {
    /// Develops `film`, encodes it, and decodes what was encoded.
    pub(crate) fn of(film: &Film) -> Self {
        let (width, height) = (film.width, film.height);
        let developed = develop(
            film,
            &Development {
                rgb_from_xyz: RGB_FROM_XYZ,
                exposure_stops: 0.0,
                encode,
            },
        );
        let none = Metadata::default();
        let float = exr_file::Depth::Float;
        let exr = exr_file::encode(width, height, &developed, float, &film.layers, &none).unwrap();
        let rgb8 = restframe::film::to_rgb8(&developed, encode);
        let png = png_file::encode(width, height, &rgb8, &none).unwrap();
        Self {
            channels: channels(&exr),
            rgb8: decoded(&png),
            bytes: [exr, png],
            linear: developed.linear,
            saturated: developed.saturated,
        }
    }

    /// Whether the EXR holds finite numbers alone, and the linear light that it was given.
    pub(crate) fn exr_is_finite_and_true(&self) -> bool {
        ["R", "G", "B"].iter().enumerate().all(|(index, color)| {
            let channel = self.channels.iter().find(|(name, _)| name == color);
            let given = self.linear.iter().map(|rgb| rgb[index]);
            channel.is_some_and(|(_, values)| values.iter().copied().eq(given))
        }) && self
            .channels
            .iter()
            .all(|(_, values)| values.iter().all(|v| v.is_finite()))
    }
}

fn channels(exr: &[u8]) -> Vec<(String, Vec<f32>)> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(exr))
        .unwrap();
    let channels = image.layer_data.channel_data.list;
    channels
        .iter()
        .map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect()))
        .collect()
}

fn decoded(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().unwrap();
    let mut rgb8 = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb8).unwrap();
    rgb8
}
