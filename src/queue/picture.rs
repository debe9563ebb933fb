//! A film to the files of one frame, as bytes.

use super::inset::Seen;
use crate::film::{self, Film, SILENT, develop};
use crate::frame::{Frame, Sensor};
use crate::image::{EncodeError, Metadata, SOFTWARE, exr, png};
use crate::render::{Enough, Member, development, enough_bounces};
use crate::scene::Scene;
use crate::shot::{Depth, Exposure, Format, Sequence, Track};
use crate::trace::Stage;

/// The files of a frame: extension and content, and how many values had to be clamped.
pub struct Pictures {
    /// Extension and bytes, in the order of the shot's formats.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// Values beyond what a file can hold.
    pub saturated: u64,
    /// Share of the light that was not followed in mirrors and glass.
    pub cut: f64,
    /// What could not be drawn or is not followed, and why.
    pub warnings: Vec<String>,
}

/// How a film was taken, beside what the shot says.
#[derive(Debug, Clone, Copy)]
pub struct Taken<'a> {
    /// Exposure, stops.
    pub exposure_stops: f64,
    /// Samples a pixel.
    pub samples: u32,
    /// [`FrameFingerprint::fingerprint`](crate::frame::FrameFingerprint), for pictures that are to be known again.
    pub fingerprint: Option<&'a str>,
}

/// Develops a film and encodes it in the shot's formats. What insets show is looked up in the
/// `scene` and on the `stage` that the film was rendered with.
///
/// # Errors
/// When an encoder refuses.
pub fn pictures(
    frame: &Frame<'_>,
    scene: &Scene,
    stage: &Stage,
    film: &Film,
    taken: Taken<'_>,
) -> Result<Pictures, EncodeError> {
    let development = development(frame.sensor.color, taken.exposure_stops);
    let developed = develop(film, &development);
    let metadata = Metadata {
        channels: film.channels,
        window_nm: window_nm(frame.sensor),
        ..metadata(frame, scene, taken)
    };
    let (width, height) = (film.width, film.height);
    let mut files = Vec::new();
    let mut saturated = developed.saturated;
    let cut = film.left_out.share();
    let member = Member { frame, scene };
    let mut warnings: Vec<String> = cut_light(member, stage, film).into_iter().collect();
    for format in &frame.output.formats {
        files.push(match format {
            Format::Png => {
                let mut rgb = film::to_rgb8(&developed, development.encode);
                let seen = Seen {
                    frame,
                    scene,
                    stage,
                    exposure: taken.exposure_stops,
                };
                warnings.extend(seen.draw_insets(&mut rgb, [width, height]));
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
        cut,
        warnings,
    })
}

/// Says how much of a picture's light was not followed, and what would do, if that is much.
fn cut_light(member: Member<'_>, stage: &Stage, film: &Film) -> Option<String> {
    let share = film.left_out.share();
    if share <= SILENT {
        return None;
    }
    let enough = enough_bounces(member, stage, [film.width, film.height], &film.left_out);
    let what_would_do = match enough {
        Enough::Bounces(bounces) => {
            let silent = percent(SILENT);
            format!("effects.bounces = {bounces} would leave out less than {silent}")
        }
        Enough::None => format!(
            "no number of effects.bounces would do, as it is too faint for accuracy.cutoff = {} or goes on for ever",
            member.frame.accuracy.cutoff
        ),
    };
    Some(format!(
        "about {} of its light is left out, too deep in mirrors and glass: {what_would_do}",
        percent(share)
    ))
}

/// Two digits: `1.6 %`.
fn percent(share: f64) -> String {
    let value = 100.0 * share;
    let decimals = if value < 9.95 { 1 } else { 0 };
    format!("{value:.decimals$} %")
}

fn exr_depth(depth: Depth) -> exr::Depth {
    match depth {
        Depth::Float => exr::Depth::Float,
        Depth::Half => exr::Depth::Half,
    }
}

fn metadata(frame: &Frame<'_>, scene: &Scene, taken: Taken<'_>) -> Metadata {
    let worldline = &scene.worldlines[scene.camera.worldline];
    let camera = worldline.celerity;
    Metadata {
        software: Some(SOFTWARE.to_owned()),
        comments: frame.title.map(str::to_owned),
        frames_per_second: Some(frame.fps),
        // Camera space is the same for every projection. What describes a perspective alone is not
        // written: no `worldToNDC`, and the screen window that EXR demands stays at its default,
        // which by the standard is that of pictures without such a description.
        camera_from_world: scene
            .camera
            .camera_from_lab(worldline)
            .map(|matrix| matrix.to_cols_array()),
        exposure_stops: Some(taken.exposure_stops),
        samples_per_pixel: Some(taken.samples),
        frame: Some(frame.number),
        beta: Some(camera.beta().to_array()),
        lorentz_factor: Some(camera.lorentz_factor()),
        time_s: Some(frame.time_s),
        worldlines: scene.worldline_names.clone(),
        shot: Some(still(frame, taken)),
        fingerprint: taken.fingerprint.map(str::to_owned),
        ..Metadata::default()
    }
}

/// The shot that this frame alone is rendered again from, beside the original: what moves stands
/// still, what was metered or asked for is written down. The size is the shot's own, as insets name
/// its pixels: a picture of another size is rendered by the `--scale` that gives it.
fn still(frame: &Frame<'_>, taken: Taken<'_>) -> String {
    let mut still = frame.alone();
    still.sensor.exposure = Exposure::Stops(Track::Constant(taken.exposure_stops));
    still.image.samples = taken.samples;
    still.sequence = Sequence::default();
    still.to_toml()
}

/// The window, where a picture is not what an eye would see.
fn window_nm(sensor: Sensor) -> Option<[f64; 2]> {
    let eye = Sensor::default();
    ((sensor.color, sensor.window) != (eye.color, eye.window)).then_some(sensor.window)
}
