//! The sensor: from spectral radiance at its wavelengths to three channels, XYZ of the CIE's
//! observer or the totals of three bands.

use super::band;
use super::cubic::catmull_rom;
use super::log_grid::{LANES, LogAxis, Shifted};
use crate::color::cie::{EFFICACY, RANGE_NM, xyz_bar};

/// Longest step of the quadrature for the weights of XYZ, nm.
const STEP_NM: f64 = 0.1;

/// Smallest number of steps between two wavelengths: with fewer, narrow windows would have uneven
/// weights.
const LEAST_STEPS: f64 = 16.0;

/// Value to which larger radiance is clamped: otherwise a weight could make it infinite, and a
/// negative one then NaN.
const LARGEST: f64 = 1e280;

/// Three channels as weighted sums over an axis: L (W·m⁻²·sr⁻¹·nm⁻¹) at λ_j has the weight w_j.
///
/// The channels are X, Y and Z in cd/m² ([`Sensor::cie1931`]), or the radiance of the long, middle
/// and short third of the window in W·m⁻²·sr⁻¹ ([`Sensor::bands`]), which methods named after XYZ
/// return then.
#[derive(Debug, Clone)]
pub struct Sensor {
    axis: LogAxis,
    weights: Vec<[f64; 3]>,
    /// The same weights for kernels: the channels of eight wavelengths at a time, zero beyond the
    /// last.
    lanes: Vec<[[f32; LANES]; 3]>,
}

impl Sensor {
    /// The CIE 1931 2° observer over an axis.
    ///
    /// The weight of a wavelength is the integral of the color-matching function over the cubic
    /// (Catmull-Rom in ln λ) that is 1 there and 0 at the others, so that sums are exact for
    /// spectra that are cubics between wavelengths. Some weights at the foot of a function are
    /// therefore below 0; no sum is, since no light's XYZ is. Light outside 360 to 830 nm is black,
    /// and costs nothing.
    pub fn cie1931(axis: LogAxis) -> Self {
        let count = axis.count() as i64;
        let mut weights = vec![[0.0; 3]; axis.count()];
        let ends = [
            axis.wavelength_nm(-0.5),
            axis.wavelength_nm(count as f64 - 0.5),
        ];
        let shortest = axis.spacing() * ends[0].max(RANGE_NM[0]);
        let steps = ((ends[1] - ends[0]) / STEP_NM.min(shortest / LEAST_STEPS)).ceil();
        let step = (ends[1] - ends[0]) / steps;
        // Steps are counted from the window's beginning, but only those in the table's range are
        // taken: a window may be 1e15 nm wide.
        let [first, last] = RANGE_NM.map(|nm| (nm - ends[0]) / step);
        let last = (last.ceil() + 1.0).min(steps);
        for i in (first.floor() - 1.0).max(0.0) as u64..last.max(0.0) as u64 {
            let nm = ends[0] + (i as f64 + 0.5) * step;
            let place = axis.place(nm);
            let bar = xyz_bar(nm);
            for (tap, share) in catmull_rom(place - place.floor()).into_iter().enumerate() {
                let j = (place.floor() as i64 + tap as i64 - 1).clamp(0, count - 1);
                for (weight, bar) in weights[j as usize].iter_mut().zip(bar) {
                    *weight += EFFICACY * bar * share * step;
                }
            }
        }
        Self::new(axis, weights)
    }

    /// The radiance of each third of the window, W·m⁻²·sr⁻¹, the longest wavelengths first.
    ///
    /// Thirds are equal in ln λ, so that a Doppler shift by the cube root of the window's ratio
    /// moves each onto the next; together they are the whole. Sums are exact for parabolas in ln λ;
    /// the error of others falls with the fourth power of the spacing. The axis has at least three
    /// wavelengths.
    pub fn bands(axis: LogAxis) -> Self {
        let third = axis.count() as f64 / 3.0;
        let thirds = [2.0, 1.0, 0.0]
            .map(|i| band::weights(axis, [third * i - 0.5, third * (i + 1.0) - 0.5]));
        let weights = (0..axis.count())
            .map(|j| [0, 1, 2].map(|channel: usize| thirds[channel][j]))
            .collect();
        Self::new(axis, weights)
    }

    fn new(axis: LogAxis, weights: Vec<[f64; 3]>) -> Self {
        let lanes = weights
            .chunks(LANES)
            .map(|chunk| {
                [0, 1, 2]
                    .map(|c| std::array::from_fn(|i| chunk.get(i).map_or(0.0, |w| w[c] as f32)))
            })
            .collect();
        Self {
            axis,
            weights,
            lanes,
        }
    }

    /// The wavelengths.
    pub fn axis(&self) -> LogAxis {
        self.axis
    }

    /// The weights of each wavelength in the channels.
    pub(super) fn weights(&self) -> &[[f64; 3]] {
        &self.weights
    }

    /// Whether the j-th wavelength has a weight in any channel.
    pub fn sees(&self, j: usize) -> bool {
        self.weights
            .get(j)
            .is_some_and(|weights| *weights != [0.0; 3])
    }

    /// XYZ, or band totals, of spectral radiance at the axis' wavelengths.
    pub fn xyz(&self, radiance: &[f64]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (weight, value) in self.weights.iter().zip(radiance) {
            let value = value.min(LARGEST);
            for (sum, weight) in sum.iter_mut().zip(weight) {
                *sum += weight * value;
            }
        }
        sum.map(|v| v.max(0.0))
    }

    /// XYZ, or band totals, of a shape: values of order 1, as many as the axis has.
    pub fn xyz_of_shape(&self, shape: &[f32]) -> [f64; 3] {
        let mut sums = Sums::default();
        let (chunks, rest) = shape.as_chunks::<LANES>();
        for (weights, values) in self.lanes.iter().zip(chunks) {
            sums.add(weights, *values);
        }
        if let Some(weights) = self.lanes.get(chunks.len()) {
            sums.add(weights, padded(rest));
        }
        sums.total()
    }

    /// XYZ, or band totals, of the product of two shapes, each under its own shift: the kernel for
    /// every ray whose lamp moves relative to what it lights.
    #[inline]
    pub fn xyz_of_product(&self, one: &Shifted<'_>, other: &Shifted<'_>) -> [f64; 3] {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            #[expect(
                unsafe_code,
                reason = "the feature it needs was detected on the line above"
            )]
            return unsafe { self.xyz_of_product_avx2(one, other) };
        }
        self.product(one, other)
    }

    /// The kernel compiled for eight lanes at once, which halves its time. Lanes, and the order in
    /// each, are the same, and so is the result to the bit.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn xyz_of_product_avx2(&self, one: &Shifted<'_>, other: &Shifted<'_>) -> [f64; 3] {
        self.product(one, other)
    }

    #[inline(always)]
    fn product(&self, one: &Shifted<'_>, other: &Shifted<'_>) -> [f64; 3] {
        let ([a, b], [keep_one, move_one]) = one.rows();
        let ([c, d], [keep_other, move_other]) = other.rows();
        let value = |a: [f32; LANES], b: [f32; LANES], c: [f32; LANES], d: [f32; LANES]| {
            let mut values = [0.0; LANES];
            for i in 0..LANES {
                values[i] =
                    (a[i] * keep_one + b[i] * move_one) * (c[i] * keep_other + d[i] * move_other);
            }
            values
        };
        let mut sums = Sums::default();
        let [a, b, c, d] = [a, b, c, d].map(|row| row.as_chunks::<LANES>());
        let chunks = a.0.iter().zip(b.0).zip(c.0.iter().zip(d.0));
        for (weights, ((a, b), (c, d))) in self.lanes.iter().zip(chunks) {
            sums.add(weights, value(*a, *b, *c, *d));
        }
        // Rows end at a multiple of the lanes, so nothing is left here; but without this branch the
        // loop above is compiled to half the speed (rustc 1.95; 7 ns a chunk in place of 4).
        if let Some(weights) = self.lanes.get(a.0.len()) {
            let [a, b, c, d] = [a.1, b.1, c.1, d.1].map(padded);
            sums.add(weights, value(a, b, c, d));
        }
        sums.total()
    }
}

/// Sums of the three channels, each in lanes of fixed order.
#[derive(Default)]
struct Sums([[f32; LANES]; 3]);

impl Sums {
    #[inline(always)]
    fn add(&mut self, weights: &[[f32; LANES]; 3], values: [f32; LANES]) {
        for (sum, weights) in self.0.iter_mut().zip(weights) {
            for i in 0..LANES {
                sum[i] += weights[i] * values[i];
            }
        }
    }

    #[inline(always)]
    fn total(&self) -> [f64; 3] {
        self.0
            .map(|lanes| f64::from(lanes.iter().sum::<f32>()).max(0.0))
    }
}

/// The last values of a row, padded with zeros.
#[inline(always)]
fn padded(rest: &[f32]) -> [f32; LANES] {
    let mut lanes = [0.0; LANES];
    lanes[..rest.len()].copy_from_slice(rest);
    lanes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie::{xyz_of, xyz_with_substeps};

    #[test]
    fn weights_are_not_negative_and_sum_to_the_equal_energy_white() {
        let sensor = Sensor::cie1931(LogAxis::new([360.0, 830.0], 84));
        let least = sensor
            .weights
            .iter()
            .flatten()
            .fold(f64::INFINITY, |m, w| m.min(*w));
        assert!(least > -1e-6 * EFFICACY, "{least}");
        let flat = sensor.xyz(&[1.0; 84]);
        let exact = xyz_of(|_| 1.0);
        for c in 0..3 {
            assert!(
                (flat[c] / exact[c] - 1.0).abs() < 1e-5,
                "{flat:?} {exact:?}"
            );
        }
    }

    /// A line at the foot of a colour-matching function lies on weights below 0.
    #[test]
    fn no_light_has_a_tristimulus_value_below_zero() {
        for count in [8, 20, 84] {
            let sensor = Sensor::cie1931(LogAxis::new([360.0, 830.0], count));
            for j in 0..count {
                let mut line = vec![0.0f32; count];
                line[j] = 1.0;
                let exact: Vec<f64> = line.iter().map(|v| f64::from(*v)).collect();
                let sums = [sensor.xyz(&exact), sensor.xyz_of_shape(&line)];
                assert!(sums.as_flattened().iter().all(|v| *v >= 0.0), "{count} {j}");
            }
        }
    }

    #[test]
    fn on_a_very_wide_axis_only_the_visible_counts() {
        let axis = LogAxis::new([1e-9, 1e15], 60_000);
        let sensor = Sensor::cie1931(axis);
        let flat = sensor.xyz(&vec![1.0; axis.count()]);
        let exact = xyz_of(|_| 1.0);
        for c in 0..3 {
            let error = flat[c] / exact[c] - 1.0;
            assert!(error.abs() < 1e-5, "{flat:?} {exact:?}");
        }
        for (j, nm) in axis.wavelengths_nm().into_iter().enumerate() {
            assert!(!sensor.sees(j) || (350.0..850.0).contains(&nm), "{nm}");
            assert!(sensor.sees(j) || !(380.0..780.0).contains(&nm), "{nm}");
        }
        let radio = Sensor::cie1931(LogAxis::new([1e6, 1e9], 84));
        assert_eq!(radio.xyz(&[1.0; 84]), [0.0; 3]);
    }

    #[test]
    fn more_wavelengths_bring_a_narrow_band_closer_to_its_exact_color() {
        let band = |nm: f64| (-0.5 * ((nm - 571.3) / 4.0).powi(2)).exp();
        let exact = xyz_of(band);
        let mut before = f64::INFINITY;
        for count in [42, 84, 168] {
            let sensor = Sensor::cie1931(LogAxis::new([360.0, 830.0], count));
            let radiance: Vec<f64> = sensor
                .axis()
                .wavelengths_nm()
                .into_iter()
                .map(band)
                .collect();
            let error = (sensor.xyz(&radiance)[1] / exact[1] - 1.0).abs();
            assert!(error < before, "{count}: {error}");
            before = error;
        }
        assert!(before < 1e-4);
    }

    /// What makes 1 of a spectral radiance that is 1 everywhere.
    fn white(sensor: &Sensor) -> [f64; 3] {
        sensor.xyz(&vec![1.0; sensor.axis().count()])
    }

    #[test]
    fn the_eye_sees_of_a_window_what_lies_in_its_range() {
        let part = |window: [f64; 2]| {
            let seen = move |nm: f64| f64::from(u8::from((window[0]..=window[1]).contains(&nm)));
            (
                xyz_with_substeps(seen, 1000),
                white(&Sensor::cie1931(LogAxis::new(window, 84))),
            )
        };
        for window in [
            [360.0, 830.0],
            [10.0, 1e5],
            [1e-9, 1e15],
            [200.0, 500.0],
            [555.0, 2500.0],
            [587.0, 592.0],
            [588.5, 589.5],
        ] {
            let (exact, found) = part(window);
            for (exact, found) in exact.into_iter().zip(found) {
                let size = exact.max(1e-3);
                assert!(
                    (found - exact).abs() < 1e-2 * size,
                    "{window:?}: {found} {exact}"
                );
            }
        }
        for window in [[1e-9, 1e-3], [100.0, 359.9], [831.0, 1e4], [1e7, 1e15]] {
            assert_eq!(part(window).1, [0.0; 3], "{window:?}");
        }
    }

    /// A window far wider than the table costs no more than the table, and its weights are the
    /// same: these are the wavelengths 384 to 468 of the wider axis.
    #[test]
    fn weights_do_not_depend_on_what_the_window_holds_beyond_the_eyes_range() {
        let ratio: f64 = 830.0 / 360.0;
        let narrow = Sensor::cie1931(LogAxis::new([360.0, 830.0], 84));
        let wide = [360.0 / ratio.powi(4), 830.0 * ratio.powi(4)];
        let wide = Sensor::cie1931(LogAxis::new(wide, 9 * 84));
        // But for its ends, which stand for what is missing there.
        let pairs = narrow.weights.iter().zip(&wide.weights[4 * 84..]);
        for (one, other) in pairs.skip(2).take(80) {
            for (one, other) in one.iter().zip(other) {
                assert!((one - other).abs() < 1e-4 * EFFICACY, "{one} {other}");
            }
        }
    }

    #[test]
    fn bands_are_thirds_of_the_window_from_long_to_short() {
        for (window, count) in [([4e3, 32e3], 84), ([4e3, 32e3], 100), ([4e3, 32e3], 8)] {
            let found = white(&Sensor::bands(LogAxis::new(window, count)));
            for (found, exact) in found.into_iter().zip([16e3, 8e3, 4e3]) {
                // What the lobes of the cubics lose on one side of an end they gain on the other.
                assert!((found / exact - 1.0).abs() < 1e-13, "{found} {exact}");
            }
        }
    }

    #[test]
    fn a_doppler_shift_by_a_third_of_the_window_moves_each_band_onto_the_next() {
        // 30 wavelengths a third, and a line of σ = 3 of them.
        let sensor = Sensor::bands(LogAxis::new([1.0, 8.0], 90));
        let line = |center: f64| {
            let radiance: Vec<f64> = (0..90)
                .map(|j| (-0.5 * ((f64::from(j) - center) / 3.0).powi(2)).exp())
                .collect();
            sensor.xyz(&radiance)
        };
        let [red, green] = [line(70.0), line(40.0)];
        assert!((red[0] / green[1] / 2.0 - 1.0).abs() < 1e-8);
        assert!((red[1] / green[2] / 2.0 - 1.0).abs() < 1e-8);
    }

    #[test]
    fn the_three_bands_add_up_to_the_window() {
        for count in [8, 84, 85, 86, 512] {
            let axis = LogAxis::new([0.01, 10.0], count);
            let sensor = Sensor::bands(axis);
            let whole = band::weights(axis, [-0.5, count as f64 - 0.5]);
            for (bands, whole) in sensor.weights.iter().zip(whole) {
                let sum: f64 = bands.iter().sum();
                assert!((sum - whole).abs() < 1e-14 * (whole + 10.0), "{count}");
                // Lobes of the cubics beyond a band's end, at most 0.08 of a wavelength's width.
                assert!(count < 84 || bands.iter().all(|w| *w > -0.08 * whole));
            }
        }
    }
}
