//! Several images at once: those that share shade trees are traced once and shaded separately.

use super::band::empty_film;
use super::expose::expose;
use super::options::{Member, Stopped, Watch};
use super::profile::Profile;
use super::view::{RelativeMotions, Views};
use super::{Options, channels};
use crate::accel::Aggregate;
use crate::film::Film;
use crate::frame::Frame;
use crate::scene::Scene;
use crate::trace::Samples;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Memory of the shaders of images that are traced together at most, bytes: some MB each for a few
/// dozen lamps and materials, 100 MB for as many as are tabulated. If more is needed, the trace is
/// repeated.
const SHADERS: usize = 256 << 20;

/// Images rendered together, and the time that they took.
#[derive(Debug, Default)]
pub struct Together {
    /// One film for each member.
    pub films: Vec<Film>,
    /// Wall-clock seconds of preparing: curves and links.
    pub prepare: f64,
    /// Wall-clock seconds of tracing.
    pub trace: f64,
    /// Wall-clock seconds of shading all images. The three add up to the whole.
    pub shade: f64,
}

/// Renders images that share shade trees ([`FrameFingerprint::trace`](crate::frame::FrameFingerprint) equal), to the
/// same bytes as each alone.
///
/// Trees are those of the first member. Beside the films ([`film_bytes`](super::film_bytes)) and a
/// bounded part for curves and tables, memory does not grow with the number of members.
///
/// # Errors
/// When asked to stop.
pub fn render_together(
    members: &[Member<'_>],
    aggregate: &Aggregate,
    options: &Options,
    watch: Watch<'_>,
) -> Result<Together, Stopped> {
    render_all(members, aggregate, options, watch, None)
}

/// Renders one image. `done` is called with numbers of finished rays, from any thread.
///
/// # Example
/// From a shot to the bytes of a PNG:
/// ```
/// use restframe::color::spaces;
/// use restframe::film::{develop, to_rgb8};
/// use restframe::frame::Frame;
/// use restframe::image::{Metadata, png};
/// use restframe::render::{Options, development, render};
/// use restframe::scene::{Library, Scene};
/// use restframe::trace::build_aggregate;
/// use std::path::Path;
///
/// let shot = restframe::shot::load(Path::new("shots/plate-08.toml"))?;
/// let frame = Frame::new(&shot, 1)?;
/// let scene = Scene::resolve(&frame, &Library::load(&shot)?, None)?;
/// let bodies = build_aggregate(&scene.geometry, None);
/// let options = Options { width: 16, height: 9, samples: 1, layers: Vec::new() };
/// let film = render(&frame, &scene, &bodies, &options, &|_| ());
///
/// let developed = develop(&film, &development(shot.sensor.color, 0.0));
/// let rgb8 = to_rgb8(&developed, spaces::encode);
/// let bytes = png::encode(16, 9, &rgb8, &Metadata::default())?;
/// assert_eq!(&bytes[1..4], b"PNG");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn render(
    frame: &Frame<'_>,
    scene: &Scene,
    aggregate: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
) -> Film {
    let member = Member { frame, scene };
    render_one(member, aggregate, options, done, None)
}

/// [`render`], with its seconds counted in `profile` if there is one, which takes a little longer.
pub fn render_profiled(
    frame: &Frame<'_>,
    scene: &Scene,
    aggregate: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
    profile: Option<&Profile>,
) -> Film {
    let member = Member { frame, scene };
    render_one(member, aggregate, options, done, profile)
}

/// Renders one image.
fn render_one(
    member: Member<'_>,
    aggregate: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
    profile: Option<&Profile>,
) -> Film {
    let stop = &AtomicBool::new(false);
    let rendered = render_all(&[member], aggregate, options, Watch { done, stop }, profile)
        .expect("nobody else holds what would stop it");
    let film = rendered.films.into_iter().next();
    film.expect("each member has a film")
}

fn render_all(
    members: &[Member<'_>],
    aggregate: &Aggregate,
    options: &Options,
    watch: Watch<'_>,
    profile: Option<&Profile>,
) -> Result<Together, Stopped> {
    let mut together = Together::default();
    let Some(first) = members.first() else {
        return Ok(together);
    };
    let samples = Samples::new(options.samples, first.frame.image.filter);
    let mut rest = members;
    while !rest.is_empty() {
        let begun = Instant::now();
        let group = prepare(rest, aggregate, options, watch.stop)?;
        let (now, later) = rest.split_at(group.len());
        rest = later;
        let film = |member: &Member<'_>| empty_film(options, channels(member.frame.sensor.color));
        let mut films: Vec<Film> = now.iter().map(film).collect();
        let prepared = Instant::now();
        let shares = expose(&group, &samples, options, &mut films, watch, profile)?;
        drop(group);
        let exposing = prepared.elapsed().as_secs_f64();
        let preparing = (prepared - begun).as_secs_f64();
        if let Some(profile) = profile {
            profile.add(|sum| sum.prepare += preparing);
        }
        together.films.extend(films);
        together.prepare += preparing;
        together.trace += exposing * shares.trace;
        together.shade += exposing * shares.shade;
    }
    Ok(together)
}

/// Views of the first member and of as many more as memory allows at once.
fn prepare<'a>(
    members: &[Member<'a>],
    aggregate: &'a Aggregate,
    options: &Options,
    stop: &AtomicBool,
) -> Result<Vec<Views<'a>>, Stopped> {
    let motions = RelativeMotions::default();
    let views = |member: &Member<'a>| {
        if stop.load(Ordering::Relaxed) {
            return Err(Stopped);
        }
        Ok(Views::new(*member, aggregate, options.height, &motions))
    };
    let Some((first, others)) = members.split_first() else {
        return Ok(Vec::new());
    };
    let first = views(first)?;
    let more = (SHADERS / first.bytes().max(1)).min(others.len());
    let others: Vec<Views<'a>> = others[..more]
        .par_iter()
        .map(views)
        .collect::<Result<_, _>>()?;
    Ok(std::iter::once(first).chain(others).collect())
}
