//! The number of bounces beyond which almost none of an image's light is missing.

use super::view::{RelativeMotions, Views};
use super::{Member, View, channels};
use crate::accel::Aggregate;
use crate::film::{Channels, Film, LeftOut, SILENT};
use crate::shade::ShadeScratch;
use crate::shot::MOST_BOUNCES;
use crate::trace::{Root, Scratch, ShadeTrees, Tracer};
use rayon::prelude::*;

/// Rays on a side of the sample by which deeper images are judged; and of a second, finer one, for
/// images in which the first misses what was cut.
const SIDES: [u32; 2] = [64, 256];

/// Share of [`SILENT`] that an image judged by a sample of its rays may be missing.
const MARGIN: f64 = 0.8;

/// Depth to which an image has to be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Enough {
    /// This many bounces miss no more than [`SILENT`] of its light.
    Bounces(u32),
    /// Not even the largest number is enough: the missing light is too faint, or branches too
    /// often.
    None,
}

/// The least bounces with which an image of `size` pixels would leave out no more than [`SILENT`],
/// being one of which `left_out` was left out. Found by a sample of its rays, followed deeper.
pub fn enough_bounces(
    member: Member<'_>,
    aggregate: &Aggregate,
    size: [u32; 2],
    left_out: &LeftOut,
) -> Enough {
    let views = Views::new(member, aggregate, size[1], &RelativeMotions::default());
    let own = member.frame.effects.bounces;
    for side in SIDES {
        let sample = Sample {
            views: &views,
            channels: channels(member.frame.sensor.color),
            size,
            side,
        };
        let here = sample.share(own);
        if here > 0.0 {
            let most = here * (SILENT * MARGIN / left_out.share()).min(1.0);
            return least(own, |bounces| sample.share(bounces) <= most);
        }
    }
    Enough::None
}

/// How much of an image's light was not followed, and how many bounces would do; None if it is little.
pub fn left_out_warning(member: Member<'_>, aggregate: &Aggregate, film: &Film) -> Option<String> {
    let share = film.left_out.share();
    if share <= SILENT {
        return None;
    }
    let enough = enough_bounces(member, aggregate, [film.width, film.height], &film.left_out);
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

/// A share with two digits, such as `1.6 %`.
fn percent(share: f64) -> String {
    let value = 100.0 * share;
    let decimals = if value < 9.95 { 1 } else { 0 };
    format!("{value:.decimals$} %")
}

/// The least sufficient number above `own`; every larger number is sufficient too.
pub(crate) fn least(own: u32, will_do: impl Fn(u32) -> bool) -> Enough {
    let (mut fewer, mut step) = (own, 1);
    // Deep trees take long, so the search starts with slightly deeper ones.
    let mut enough = loop {
        let more = (fewer + step).min(MOST_BOUNCES);
        if more <= fewer {
            return Enough::None;
        }
        if will_do(more) {
            break more;
        }
        (fewer, step) = (more, 2 * step);
    };
    while enough > fewer + 1 {
        let middle = fewer.midpoint(enough);
        if will_do(middle) {
            enough = middle;
        } else {
            fewer = middle;
        }
    }
    Enough::Bounces(enough)
}

/// Light of a ray by its channels, as [`LeftOut`] counts it.
#[inline(always)]
pub(super) fn light(channels: Channels, values: [f64; 3]) -> f64 {
    match channels {
        Channels::Xyz => values[1],
        Channels::Bands => values.iter().sum(),
    }
}

/// A sample of an image's rays: those through the centers of pixels on a grid.
struct Sample<'a> {
    views: &'a Views<'a>,
    channels: Channels,
    size: [u32; 2],
    side: u32,
}

impl Sample<'_> {
    /// Share of its light that this many bounces miss.
    fn share(&self, bounces: u32) -> f64 {
        let [columns, rows] = self.size.map(|pixels| self.side.min(pixels));
        let row = |row: u32| {
            let y = middle(row, rows, self.size[1]);
            let view = self.views.of_row(y);
            let mut memory = Memory::default();
            let mut sums = LeftOut::default();
            for column in 0..columns {
                let x = middle(column, columns, self.size[0]);
                let (light, cut) = self.look(view, [x, y], bounces, &mut memory);
                sums.add_rays(1, light);
                sums.add_cut(cut, light);
            }
            sums
        };
        let rows: Vec<LeftOut> = (0..rows).into_par_iter().map(row).collect();
        let mut sums = LeftOut::default();
        rows.iter().for_each(|row| sums.add(row));
        sums.share()
    }

    /// Light of a ray, and the share of it that was cut.
    fn look(
        &self,
        view: &View<'_>,
        pixel: [u32; 2],
        bounces: u32,
        memory: &mut Memory,
    ) -> (f64, f64) {
        let point = [0, 1].map(|i| (f64::from(pixel[i]) + 0.5) / f64::from(self.size[i]));
        let Some(direction) = view.scene().camera.looks_along(point) else {
            return (0.0, 0.0);
        };
        memory.trees.clear();
        deeper(view, bounces).trace(&[direction], &mut memory.tracing, &mut memory.trees);
        let Root { cut, .. } = memory.trees.roots[0];
        let root = memory.trees.roots[0];
        let values = view.shader().xyz(&memory.trees, root, &mut memory.shading);
        let cut = if view.branches() { cut } else { 0.0 };
        (light(self.channels, values), cut)
    }
}

#[derive(Default)]
struct Memory {
    trees: ShadeTrees,
    tracing: Scratch,
    shading: ShadeScratch,
}

/// A tracer with at least this depth; unchanged if mirrors and glass are off.
pub(crate) fn deeper<'a>(view: &'a View<'_>, bounces: u32) -> Tracer<'a> {
    let tracer = view.tracer();
    Tracer {
        bounces: match tracer.bounces {
            0 => 0,
            own => own.max(bounces),
        },
        ..tracer
    }
}

/// The pixel in the middle of one of this many equal parts.
fn middle(part: u32, parts: u32, pixels: u32) -> u32 {
    let [part, parts, pixels] = [part, parts, pixels].map(u64::from);
    ((2 * part + 1) * pixels / (2 * parts)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_number_is_found_wherever_it_lies() {
        for own in [1, 4, 8, 63] {
            for needed in own + 1..=MOST_BOUNCES {
                assert_eq!(least(own, |n| n >= needed), Enough::Bounces(needed));
            }
            assert_eq!(least(own, |_| false), Enough::None);
        }
        assert_eq!(least(MOST_BOUNCES, |_| true), Enough::None);
    }

    #[test]
    fn samples_lie_in_the_middles_of_equal_parts() {
        assert_eq!([0, 1, 2].map(|i| middle(i, 3, 9)), [1, 4, 7]);
        assert_eq!([0, 4].map(|i| middle(i, 5, 5)), [0, 4]);
        assert_eq!(middle(63, 64, 32768), 32512);
    }
}
