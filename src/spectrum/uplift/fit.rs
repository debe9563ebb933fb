//! The sigmoid of a quadratic over 360 to 830 nm, its contributions to R, G and B under D65, and the
//! fit of its coefficients to a color by the Levenberg-Marquardt method.

use crate::color::cie::{RANGE_NM, xyz_bar};
use crate::color::spaces::{Matrix, RGB_FROM_XYZ, apply, inverse};
use crate::spectrum::daylight::d65;
use std::sync::LazyLock;

/// Weighted error below which a fit ends.
const GOOD_ENOUGH: f64 = 1e-10;

/// Number of steps of a fit at most.
const MAX_STEPS: usize = 200;

/// RGB of the sigmoid curve of given coefficients, and its derivatives by them (row: channel).
fn color_of(coefficients: [f64; 3]) -> ([f64; 3], Matrix) {
    let (mut rgb, mut slopes) = ([0.0; 3], [[0.0; 3]; 3]);
    for &(u, weight) in WEIGHTS.iter() {
        let x = quadratic(coefficients, u);
        let value = sigmoid(x);
        let slope = 0.5 / ((1.0 + x * x) * (1.0 + x * x).sqrt());
        for channel in 0..3 {
            rgb[channel] += weight[channel] * value;
            let part = weight[channel] * slope;
            slopes[channel][0] += part * u * u;
            slopes[channel][1] += part * u;
            slopes[channel][2] += part;
        }
    }
    (rgb, slopes)
}

/// Coefficients, and the difference of their color from the target.
#[derive(Clone, Copy)]
struct Guess {
    coefficients: [f64; 3],
    /// Errors of R, G and B, weighted.
    errors: [f64; 3],
    /// Their derivatives by the coefficients (row: channel).
    slopes: Matrix,
}

impl Guess {
    /// The weights make errors count about as the sRGB transfer shows them, so that dark colors are
    /// fitted as well as light ones.
    fn new(coefficients: [f64; 3], target: [f64; 3]) -> Self {
        let (rgb, mut slopes) = color_of(coefficients);
        let weights = target.map(|part| (part + 0.01).powf(-0.6));
        for (row, weight) in slopes.iter_mut().zip(weights) {
            row.iter_mut().for_each(|slope| *slope *= weight);
        }
        let errors = std::array::from_fn(|i| weights[i] * (rgb[i] - target[i]));
        Self {
            coefficients,
            errors,
            slopes,
        }
    }

    fn largest_error(&self) -> f64 {
        self.errors
            .iter()
            .fold(0.0, |most, error| most.max(error.abs()))
    }

    fn squares(&self) -> f64 {
        self.errors.iter().map(|error| error * error).sum()
    }

    /// The coefficients after one step of Levenberg and Marquardt (Marquardt 1963).
    fn stepped(&self, damping: f64) -> [f64; 3] {
        let column = |k: usize| self.slopes.map(|row| row[k]);
        let product = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
        let mut normal: Matrix =
            std::array::from_fn(|j| std::array::from_fn(|k| product(column(j), column(k))));
        (0..3).for_each(|k| normal[k][k] *= 1.0 + damping);
        let downhill = std::array::from_fn(|k| -product(column(k), self.errors));
        let step = apply(&inverse(normal), downhill);
        std::array::from_fn(|k| self.coefficients[k] + step[k])
    }
}

/// The coefficients whose color is nearest to `target`, each component from 0 to 1.
pub(super) fn fit(target: [f64; 3]) -> [f64; 3] {
    let mut best = Guess::new(start(target), target);
    let mut damping = 1e-3;
    for _ in 0..MAX_STEPS {
        if best.largest_error() < GOOD_ENOUGH || damping > 1e12 {
            break;
        }
        let trial = Guess::new(best.stepped(damping), target);
        if trial.squares() < best.squares() {
            best = trial;
            damping *= 0.2;
        } else {
            damping *= 5.0;
        }
    }
    best.coefficients
}

/// The starting point: the constant curve of the color's mean.
fn start(target: [f64; 3]) -> [f64; 3] {
    let mean = (target.iter().sum::<f64>() / 3.0).clamp(1e-6, 1.0 - 1e-6);
    [0.0, 0.0, (mean - 0.5) / (mean * (1.0 - mean)).sqrt()]
}

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
