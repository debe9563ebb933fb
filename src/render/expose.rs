//! Exposure of films, a band of rows per thread: each piece of a row is traced once, and shaded for
//! every image.

use super::band::{BAND, bands};
use super::options::{Stopped, Watch};
use super::paint::{Painter, Row};
use super::profile::PhaseTimes;
use super::view::{View, Views};
use super::{Options, Profile};
use crate::film::{Film, LeftOut};
use crate::trace::Samples;
use rayon::prelude::*;

/// Shares of the time, which add up to 1.
pub(super) struct Shares {
    pub(super) trace: f64,
    pub(super) shade: f64,
}

/// Result of a band.
struct Exposed {
    /// Seconds of tracing and of shading.
    seconds: [f64; 2],
    /// For each image, its light that was not followed.
    left_out: Vec<LeftOut>,
}

/// Exposes a film for each of the images, which all use the trees of the first.
pub(super) fn expose(
    images: &[Views<'_>],
    samples: &Samples,
    options: &Options,
    films: &mut [Film],
    watch: Watch<'_>,
    profile: Option<&Profile>,
) -> Result<Shares, Stopped> {
    let bands: Vec<Exposed> = bands(films)
        .into_par_iter()
        .enumerate()
        .map_init(Painter::default, |painter, (band, mut parts)| {
            painter.phase_times = profile.map(|_| PhaseTimes::default());
            painter.seconds = [0.0; 2];
            let first = (band * BAND) as u32;
            let last = (first + BAND as u32).min(options.height);
            for number in first..last {
                let views = of_row(images, number);
                let row = Row {
                    number,
                    in_band: (number - first) as usize,
                    options,
                    samples,
                };
                painter.paint(&views, &row, &mut parts, watch)?;
            }
            if let Some((lead, others)) = parts.split_first_mut() {
                others.iter_mut().for_each(|part| part.copy_layers(lead));
            }
            if let (Some(profile), Some(phase_times)) = (profile, &painter.phase_times) {
                phase_times.report(profile);
            }
            Ok(Exposed {
                seconds: painter.seconds,
                left_out: parts.iter().map(|part| part.left_out).collect(),
            })
        })
        .collect::<Result<_, Stopped>>()?;
    let [mut trace, mut shade] = [0.0; 2];
    // Band by band, so that the sums are the same on any number of threads.
    for Exposed { seconds, left_out } in &bands {
        trace += seconds[0];
        shade += seconds[1];
        for (film, part) in films.iter_mut().zip(left_out) {
            film.left_out.add(part);
        }
    }
    let whole = (trace + shade).max(f64::MIN_POSITIVE);
    Ok(Shares {
        trace: trace / whole,
        shade: 1.0 - trace / whole,
    })
}

/// The views of a row. The first one traces.
fn of_row<'a, 'b>(images: &'a [Views<'b>], row: u32) -> Vec<&'a View<'b>> {
    let views: Vec<&View<'_>> = images.iter().map(|image| image.of_row(row)).collect();
    debug_assert!(
        views.iter().all(|view| view.traces_like(views[0])),
        "images that share a trace agree on what it reads"
    );
    views
}
