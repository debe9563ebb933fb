//! One image: trace, shade, film.

use super::options::Options;
use super::profile::Profile;
use super::together::render_one;
use super::watch::Member;
use crate::accel::Aggregate;
use crate::film::Film;
use crate::frame::Frame;
use crate::scene::Scene;

/// Renders one image. `done` is told of finished rays, from any thread.
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
