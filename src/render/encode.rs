//! From a film to the files of one frame, as bytes: development, insets, encoding.

use super::development;
use crate::film::{Channels, Film, compress_gamut, develop, to_rgb8};
use crate::frame::{Frame, Sensor};
use crate::image::{EncodeError, Metadata, SOFTWARE, exr, png};
use crate::plot::{LEAST_INSET, Plot, lay_out_inset, raster, svg};
use crate::scene::Scene;
use crate::shot::{Depth, Exposure, Format, Gamut, Inset, Sequence, Track};

/// The files of a frame, and what could not be represented in them.
pub struct Pictures {
    /// Extension and bytes, in the order of the shot's formats.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// Number of values beyond what a file can hold, which were clamped.
    pub saturated: u64,
    /// Insets that could not be drawn, with reasons.
    pub warnings: Vec<String>,
}

/// Facts on how a film was exposed that are not in the shot.
#[derive(Debug, Clone, Copy)]
pub struct PictureInfo<'a> {
    /// Exposure, stops.
    pub exposure_stops: f64,
    /// Samples per pixel.
    pub samples: u32,
    /// [`FrameFingerprint::fingerprint`](crate::frame::FrameFingerprint), for pictures that are to be known again.
    pub fingerprint: Option<&'a str>,
}

/// An inset that would be too small to be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "the inset of pixel {} {} is left out: it would be {height} pixels high, and needs {least} to be read; render a larger image, or raise its `size`",
    .pixel[0], .pixel[1], least = LEAST_INSET
)]
pub struct InsetTooSmall {
    /// Its pixel in the shot's image.
    pub pixel: [u32; 2],
    /// Rows of the image that it would take.
    pub height: u32,
}

/// Develops a film and encodes it in the shot's formats. `insets` are what the shot's insets show, in
/// their order. Nothing is traced here.
///
/// # Errors
/// When an encoder refuses.
pub fn encode(
    frame: &Frame<'_>,
    scene: &Scene,
    film: &Film,
    insets: &[Result<Plot, InsetTooSmall>],
    info: PictureInfo<'_>,
) -> Result<Pictures, EncodeError> {
    let development = development(frame.sensor.color, info.exposure_stops);
    let developed = develop(film, &development);
    let metadata = Metadata {
        channels: film.channels,
        window_nm: window_nm(frame.sensor),
        ..metadata(frame, scene, info)
    };
    let (width, height) = (film.width, film.height);
    let mut files = Vec::new();
    let mut saturated = developed.saturated;
    let mut warnings = Vec::new();
    for format in &frame.output.formats {
        files.push(match format {
            Format::Png => {
                let compressed = compresses(film, frame.sensor).then(|| compress_gamut(&developed));
                let shown = compressed.as_ref().unwrap_or(&developed);
                let mut rgb = to_rgb8(shown, development.encode);
                let drawn = frame.insets.iter().zip(insets).map(|(inset, plot)| {
                    draw(frame, inset, plot.as_ref(), &mut rgb, [width, height])
                });
                warnings.extend(drawn.filter_map(Result::err));
                ("png", png::encode(width, height, &rgb, &metadata)?)
            }
            Format::Exr => {
                let depth = exr_depth(frame.output.depth);
                saturated += exr::clamped(&developed, depth);
                let layers = &film.layers;
                (
                    "exr",
                    exr::encode(width, height, &developed, depth, layers, &metadata)?,
                )
            }
        });
    }
    Ok(Pictures {
        files,
        saturated,
        warnings,
    })
}

/// Whether colors beyond the screen's are brought into its gamut; bands are no colors.
fn compresses(film: &Film, sensor: Sensor) -> bool {
    sensor.gamut == Gamut::Compress && film.channels == Channels::Xyz
}

/// Draws an inset into an image of three bytes per pixel.
///
/// # Errors
/// The reason why it is left out.
fn draw(
    frame: &Frame<'_>,
    inset: &Inset,
    plot: Result<&Plot, &InsetTooSmall>,
    rgb8: &mut [u8],
    size: [u32; 2],
) -> Result<(), String> {
    let [x, y] = inset.pixel_of(frame.image.size);
    let (corner, [width, height]) = inset.place_in(size);
    let plot = plot.map_err(ToString::to_string)?;
    let drawing = lay_out_inset(plot, [width, height].map(f64::from));
    let drawn = raster::paint(&svg(&drawing), width, height).ok_or_else(|| {
        format!("the inset of pixel {x} {y} is too large to be painted; lower its `size`")
    })?;
    drawn.lay_over(rgb8, size[0], corner);
    Ok(())
}

fn exr_depth(depth: Depth) -> exr::Depth {
    match depth {
        Depth::Float => exr::Depth::Float,
        Depth::Half => exr::Depth::Half,
    }
}

fn metadata(frame: &Frame<'_>, scene: &Scene, info: PictureInfo<'_>) -> Metadata {
    let worldline = &scene.worldlines[scene.camera.worldline];
    let camera = worldline.celerity;
    Metadata {
        software: Some(SOFTWARE.to_owned()),
        comments: frame.title.map(str::to_owned),
        frames_per_second: Some(frame.fps),
        // Camera space is the same for every projection. What describes a perspective alone is not
        // written: no `worldToNDC`, and the screen window that EXR demands has its default value,
        // as the standard prescribes for images without such a description.
        camera_from_world: scene
            .camera
            .camera_from_lab(worldline)
            .map(|matrix| matrix.to_cols_array()),
        exposure_stops: Some(info.exposure_stops),
        samples_per_pixel: Some(info.samples),
        frame: Some(frame.number),
        beta: Some(camera.beta().to_array()),
        lorentz_factor: Some(camera.lorentz_factor()),
        time_s: Some(frame.time_s),
        worldlines: scene.worldline_names.clone(),
        shot: Some(still(frame, info)),
        fingerprint: info.fingerprint.map(str::to_owned),
        ..Metadata::default()
    }
}

/// The shot from which this frame alone can be rendered again, saved beside the original: moving
/// values are fixed, and metered or requested values are written down. The size is the shot's own,
/// because insets name its pixels; an image of another size is rendered by the `--scale` that gives
/// it.
fn still(frame: &Frame<'_>, info: PictureInfo<'_>) -> String {
    let mut still = frame.alone();
    still.sensor.exposure = Exposure::Stops(Track::Constant(info.exposure_stops));
    still.image.samples = info.samples;
    still.sequence = Sequence::default();
    still.to_toml()
}

/// The window, if the image is not what an eye would see.
fn window_nm(sensor: Sensor) -> Option<[f64; 2]> {
    let eye = Sensor::default();
    ((sensor.color, sensor.window) != (eye.color, eye.window)).then_some(sensor.window)
}
