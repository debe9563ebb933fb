//! The curve of colored light: any linear RGB, in nanoseconds.
//!
//! Light of a color has no upper bound, and its spectrum should not change with its amount. So the
//! color is split into its greatest component and its hue, the components relative to that. Half
//! the hue, which leaves room above for a smooth curve, is met by the sigmoid of
//! [`Uplift`](super::Uplift), and twice the greatest component times that sigmoid is the curve (as
//! for the illuminants of Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition,
//! 4.6.6). Times D65 it has the given color; grays are constant; beyond 360 to 830 nm the curve is
//! constant. It is continuous in the color.
//!
//! Coefficients come from a table over hues, cubic between its entries, made on first use (0.2 s on
//! one core). Each entry is fitted by itself: the same on any number of threads.

use super::fit::fit;
use super::fit::{HALF_NM, MIDDLE_NM, quadratic, sigmoid, variable};
use crate::color::cie::RANGE_NM;
use crate::spectrum::cubic::catmull_rom;
use rayon::prelude::*;
use std::sync::LazyLock;

/// Largest error of a component of the color, relative to the greatest, that the table adds to that
/// of f32.
pub const HUE_ERROR: f64 = 3e-4;

/// Entries along each side of a table.
const SIDE: usize = 33;

/// Coefficients for each of the components that can be the greatest, by the next component over the
/// greatest (rows) and the one after (columns). Entry i is at (i/(SIDE − 1))²: dark components
/// change the curve most.
static TABLE: LazyLock<Vec<[f32; 3]>> = LazyLock::new(|| {
    (0..3 * SIDE * SIDE)
        .into_par_iter()
        .map(|index| {
            let place = |i: usize| {
                let root = i as f64 / (SIDE - 1) as f64;
                0.5 * root * root
            };
            let mut target = [0.5; 3];
            let greatest = index / (SIDE * SIDE);
            target[(greatest + 1) % 3] = place(index / SIDE % SIDE);
            target[(greatest + 2) % 3] = place(index % SIDE);
            fit(target).map(|c| c as f32)
        })
        .collect()
});

/// A curve, relative to D65, of the light of some color.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColoredLight {
    /// Twice the greatest component.
    factor: f64,
    /// Of u², u and 1 in x.
    coefficients: [f32; 3],
}

impl ColoredLight {
    /// Range of the color's curve, nm; outside it is constant.
    pub const SUPPORT_NM: [f64; 2] = RANGE_NM;

    /// The curve of a linear Rec. 709 color, each component finite and at least 0.
    pub fn new(rgb: [f64; 3]) -> Self {
        let greatest = (0..3).fold(0, |g, i| if rgb[i] > rgb[g] { i } else { g });
        if rgb[greatest] <= 0.0 {
            return Self {
                factor: 0.0,
                coefficients: [0.0; 3],
            };
        }
        let hue = |next: usize| rgb[(greatest + next) % 3] / rgb[greatest];
        Self {
            factor: 2.0 * rgb[greatest],
            coefficients: coefficients(greatest, hue(1), hue(2)),
        }
    }

    /// The factor of the shape.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// The curve at a wavelength, nm.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let coefficients = self.coefficients.map(f64::from);
        self.factor * sigmoid(quadratic(coefficients, variable(lambda_nm)))
    }

    /// Multiplies `out` by the shape, which is from 0 to 1, at `shift` × the wavelengths (nm).
    #[inline]
    pub fn multiply(&self, shift: f64, wavelengths_nm: &[f32], out: &mut [f32]) {
        let [a, b, c] = self.coefficients;
        let (slope, middle) = ((shift / HALF_NM) as f32, (MIDDLE_NM / HALF_NM) as f32);
        for (out, nm) in out.iter_mut().zip(wavelengths_nm) {
            let u = (nm * slope - middle).clamp(-1.0, 1.0);
            let x = c + u * (b + u * a);
            // Rounding may lead below 0.
            *out *= (0.5 + 0.5 * x / (1.0 + x * x).sqrt()).max(0.0);
        }
    }
}

/// Coefficients of a hue, by the Catmull-Rom cubic in the roots of its lesser components.
fn coefficients(greatest: usize, next: f64, last: f64) -> [f32; 3] {
    let cell = |value: f64| {
        let place = value.min(1.0).sqrt() * (SIDE - 1) as f64;
        let below = (place as usize).min(SIDE - 2);
        (
            below,
            catmull_rom(place - below as f64).map(|tap| tap as f32),
        )
    };
    let ((row, row_taps), (column, column_taps)) = (cell(next), cell(last));
    let table = &TABLE[greatest * SIDE * SIDE..];
    let across = |row: usize| {
        let entries = &table[row * SIDE..(row + 1) * SIDE];
        cubic(column, column_taps, |column| entries[column])
    };
    cubic(row, row_taps, across)
}

/// The cubic through four entries; beyond the ends the table continues linearly.
#[inline(always)]
fn cubic(below: usize, taps: [f32; 4], entry: impl Fn(usize) -> [f32; 3]) -> [f32; 3] {
    let [from, to] = [entry(below), entry(below + 1)];
    let on = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|i| 2.0 * a[i] - b[i]);
    let before = if below == 0 {
        on(from, to)
    } else {
        entry(below - 1)
    };
    let after = if below + 2 < SIDE {
        entry(below + 2)
    } else {
        on(to, from)
    };
    [0, 1, 2]
        .map(|i| taps[0] * before[i] + taps[1] * from[i] + taps[2] * to[i] + taps[3] * after[i])
}

#[cfg(test)]
mod tests {
    use super::super::fit::WEIGHTS;
    use super::*;
    use crate::spectrum::Uplift;
    use proptest::prelude::*;

    fn color(curve: &ColoredLight) -> [f64; 3] {
        let mut rgb = [0.0; 3];
        for (index, (_, weight)) in WEIGHTS.iter().enumerate() {
            let value = curve.at(360.0 + index as f64);
            (0..3).for_each(|i| rgb[i] += weight[i] * value);
        }
        rgb
    }

    fn error(rgb: [f64; 3]) -> f64 {
        let found = color(&ColoredLight::new(rgb));
        let greatest = rgb.into_iter().fold(0.0, f64::max);
        (0..3)
            .map(|i| (found[i] - rgb[i]).abs())
            .fold(0.0, f64::max)
            / greatest
    }

    #[test]
    fn every_hue_is_met_within_the_stated_error() {
        let begun = std::time::Instant::now();
        let _ = TABLE.len();
        println!("table in {:?}", begun.elapsed());
        let mut worst = (0.0, [0.0; 3]);
        let steps = 150;
        for greatest in 0..3 {
            for i in 0..=steps {
                for j in 0..=steps {
                    let mut rgb = [1.0; 3];
                    let part = |k: i32| (f64::from(k) / f64::from(steps)).powi(2);
                    rgb[(greatest + 1) % 3] = part(i);
                    rgb[(greatest + 2) % 3] = part(j);
                    let error = error(rgb);
                    if error > worst.0 {
                        worst = (error, rgb);
                    }
                }
            }
        }
        println!(
            "{worst:?} {:?}",
            TABLE.iter().flatten().fold(0f32, |m, c| m.max(c.abs()))
        );
        assert!(worst.0 < HUE_ERROR, "{worst:?}");
    }

    #[test]
    fn it_is_twice_the_uplift_of_half_the_color_whatever_its_amount() {
        for rgb in [[1.0, 0.25, 0.5], [0.0, 1.0, 0.3], [0.9, 0.8, 1.0]] {
            let uplift = Uplift::new(rgb.map(|c| 0.5 * c)).unwrap();
            for amount in [1e-30, 0.1, 1.0, 1e30] {
                let light = ColoredLight::new(rgb.map(|c| c * amount));
                for nm in [1e-9, 360.0, 450.0, 555.5, 700.0, 830.0, 1e9] {
                    let off = (light.at(nm) / amount - 2.0 * uplift.at(nm)).abs();
                    assert!(off < 2e-3, "{rgb:?} {nm} {off}");
                }
            }
        }
    }

    #[test]
    fn grays_are_constant_and_black_is_none() {
        for gray in [0.0, 1e-300, 0.18, 1.0, 4e37] {
            let light = ColoredLight::new([gray; 3]);
            assert!(
                [1e-300, 360.0, 1e300]
                    .iter()
                    .all(|&nm| light.at(nm) == gray)
            );
        }
    }

    proptest! {
        #[test]
        fn any_color_is_met_and_the_curve_is_continuous_finite_and_not_negative(
            rgb in prop::array::uniform3(prop_oneof![Just(0.0), Just(1.0), 0.0..1.0, 0.0..1e-3]),
            step in prop::array::uniform3(-1e-6..1e-6),
            shift in -60.0..60.0_f64,
        ) {
            prop_assume!(rgb.iter().any(|part| *part > 0.01));
            prop_assert!(error(rgb) < HUE_ERROR);
            let light = ColoredLight::new(rgb);
            let near = ColoredLight::new([0, 1, 2].map(|i: usize| f64::max(rgb[i] + step[i], 0.0)));
            let nm = [360.0f32, 420.0, 555.0, 620.0, 830.0];
            let mut shape = [1.0; 5];
            light.multiply(shift.exp(), &nm, &mut shape);
            for (nm, shape) in nm.into_iter().zip(shape) {
                let exact = light.at(f64::from(nm) * shift.exp());
                prop_assert!((f64::from(shape) * light.factor() - exact).abs() < 1e-4);
                prop_assert!(shape >= 0.0 && shape.is_finite());
                let step = (light.at(f64::from(nm)) - near.at(f64::from(nm))).abs();
                prop_assert!(step < 0.02, "{step}");
            }
        }
    }
}
