//! Errors of an image against its reference, in radiance and in color.

use super::results::{Errors, Percentiles};
use super::timed_render::StudyError;
use crate::color::spaces::{D65_XYZ, XYZ_FROM_RGB, apply};
use crate::color::{delta_e_2000, lab_from_xyz};
use crate::film::{Channels, Developed, Film, develop};
use crate::image::compare::{Comparison, relative_rmse};
use crate::render::development;
use crate::shot::Shot;
use rayon::prelude::*;

/// Errors of a film against another of the same size, both developed at `stops`.
pub(super) fn errors(
    shot: &Shot,
    film: &Film,
    reference: &Film,
    stops: f64,
) -> Result<Errors, StudyError> {
    let development = development(shot.sensor.color, stops);
    let color = film.channels == Channels::Xyz;
    let [one, other] = [film, reference].map(|film| develop(film, &development));
    Ok(Errors {
        radiance: relative_rmse(&film.xyz, &reference.xyz)?,
        delta_e: color.then(|| color_differences(&one, &other)),
        ..Errors::default()
    })
}

/// CIEDE2000 of the pixels of two developed films as a display shows them: values beyond its range
/// are clipped, nothing is rounded.
pub(super) fn color_differences(one: &Developed, other: &Developed) -> Percentiles {
    let lab = |rgb: &[f32; 3]| {
        let shown = rgb.map(|value| f64::from(value).clamp(0.0, 1.0));
        lab_from_xyz(apply(&XYZ_FROM_RGB, shown), D65_XYZ)
    };
    let differences = one
        .linear
        .par_iter()
        .zip(&other.linear)
        .map(|(a, b)| {
            if a == b {
                0.0
            } else {
                delta_e_2000(lab(a), lab(b))
            }
        })
        .collect();
    percentiles(differences)
}

/// Mean, percentile and maximum over all pixels.
pub(super) fn percentiles(values: Vec<f64>) -> Percentiles {
    let Comparison { mean, p99, worst } = Comparison::of(values);
    Percentiles { mean, p99, worst }
}
