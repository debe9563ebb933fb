//! From spectral radiance at the sensor's wavelengths to XYZ.

use super::cie::{EFFICACY, RANGE_NM, xyz_bar};
use super::log_grid::{LogAxis, Shifted};

/// Steps of the quadrature that makes the weights, nm.
const STEP_NM: f64 = 0.1;

/// X, Y and Z in cd/m² as weighted sums over an axis: L (W·m⁻²·sr⁻¹·nm⁻¹) at λ_j counts w_j.
#[derive(Debug, Clone)]
pub struct Sensor {
    axis: LogAxis,
    weights: Vec<[f64; 3]>,
    /// The same for kernels: X, Y and Z of eight wavelengths at a time, zero beyond the last.
    lanes: Vec<[[f32; LANES]; 3]>,
}

impl Sensor {
    /// The CIE 1931 2° observer over an axis. The weight of a wavelength is the integral of the
    /// colour-matching function over the cubic (Catmull–Rom in ln λ) that has value 1 there and 0
    /// at the others, so that sums are exact for spectra that are cubics between wavelengths.
    pub fn cie1931(axis: LogAxis) -> Self {
        let count = axis.count() as i64;
        let mut weights = vec![[0.0; 3]; axis.count()];
        // However wide the axis: where nothing is seen, nothing is to be integrated.
        let ends = [
            axis.wavelength_nm(-0.5).max(RANGE_NM[0] - 1.0),
            axis.wavelength_nm(count as f64 - 0.5)
                .min(RANGE_NM[1] + 1.0),
        ];
        let steps = ((ends[1] - ends[0]) / STEP_NM).ceil() as usize;
        let step = (ends[1] - ends[0]) / steps as f64;
        for i in 0..steps {
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

    /// Whether the j-th wavelength counts for X, Y or Z.
    pub fn sees(&self, j: usize) -> bool {
        self.weights
            .get(j)
            .is_some_and(|weights| *weights != [0.0; 3])
    }

    /// XYZ of spectral radiance at the axis' wavelengths.
    pub fn xyz(&self, radiance: &[f64]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (weight, value) in self.weights.iter().zip(radiance) {
            for (sum, weight) in sum.iter_mut().zip(weight) {
                *sum += weight * value;
            }
        }
        sum
    }

    /// XYZ of a shape: values of order 1, as many as the axis has.
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

    /// XYZ of the product of two shapes, each under its own shift: the kernel of every ray whose
    /// lamp does not move with what it lights.
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

    /// The kernel compiled for eight lanes at once, which halves its time. The result is the same
    /// to the bit: the lanes, and the order in each, are.
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
        if let Some(weights) = self.lanes.get(a.0.len()) {
            let [a, b, c, d] = [a.1, b.1, c.1, d.1].map(padded);
            sums.add(weights, value(a, b, c, d));
        }
        sums.total()
    }
}

/// Sums of X, Y and Z, each in lanes of fixed order.
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
        self.0.map(|lanes| f64::from(lanes.iter().sum::<f32>()))
    }
}

/// The last values of a row, and zeros.
#[inline(always)]
fn padded(rest: &[f32]) -> [f32; LANES] {
    let mut lanes = [0.0; LANES];
    lanes[..rest.len()].copy_from_slice(rest);
    lanes
}

/// Partial sums kept side by side.
const LANES: usize = 8;

/// Weights of the four neighbours of a point a fraction t past the second (Catmull & Rom 1974).
pub fn catmull_rom(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (-t3 + 2.0 * t2 - t),
        0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
        0.5 * (-3.0 * t3 + 4.0 * t2 + t),
        0.5 * (t3 - t2),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie::xyz_of;

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
    fn more_wavelengths_bring_a_narrow_band_closer_to_its_exact_colour() {
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
}
