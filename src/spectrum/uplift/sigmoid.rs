//! The sigmoid of a quadratic over 360 to 830 nm, and its contributions to R, G and B under D65.

use crate::color::cie::{RANGE_NM, xyz_bar};
use crate::color::spaces::{RGB_FROM_XYZ, apply};
use crate::spectrum::daylight::d65;
use std::sync::LazyLock;

/// Middle and half-width of the range, nm: the quadratic's variable is u = (λ − middle)/half.
pub(super) const MIDDLE_NM: f64 = 0.5 * (RANGE_NM[0] + RANGE_NM[1]);
pub(super) const HALF_NM: f64 = 0.5 * (RANGE_NM[1] - RANGE_NM[0]);

/// u of a wavelength: −1 at 360 nm, 1 at 830 nm and beyond.
pub(super) fn variable(lambda_nm: f64) -> f64 {
    ((lambda_nm - MIDDLE_NM) / HALF_NM).clamp(-1.0, 1.0)
}

pub(super) fn quadratic([a, b, c]: [f64; 3], u: f64) -> f64 {
    c + u * (b + u * a)
}

/// ½ + x/(2√(1 + x²)), without its cancellation at large negative x.
pub(super) fn sigmoid(x: f64) -> f64 {
    let root = (1.0 + x * x).sqrt();
    let small = 0.5 / (root * (root + x.abs()));
    if x < 0.0 { small } else { 1.0 - small }
}

/// The sigmoid mixed with white: 1 − tint·(1 − S(x)), and 1 − S(x) = S(−x).
pub(super) fn tinted(tint: f64, x: f64) -> f64 {
    if tint == 1.0 {
        sigmoid(x)
    } else {
        1.0 - tint * sigmoid(-x)
    }
}

/// For each nm: u, and the contribution of a unit of S there to R, G and B.
pub(super) static WEIGHTS: LazyLock<Vec<(f64, [f64; 3])>> = LazyLock::new(|| {
    let d65 = d65();
    let mut rows: Vec<(f64, [f64; 3])> = (360..=830)
        .map(|nm| {
            let lambda_nm = f64::from(nm);
            let rgb = apply(&RGB_FROM_XYZ, xyz_bar(lambda_nm));
            (
                variable(lambda_nm),
                rgb.map(|part| part * d65.at(lambda_nm)),
            )
        })
        .collect();
    let white: [f64; 3] = std::array::from_fn(|i| rows.iter().map(|row| row.1[i]).sum());
    rows.iter_mut()
        .for_each(|row| (0..3).for_each(|i| row.1[i] /= white[i]));
    rows
});
