//! Where in a pixel its samples lie: stratified, deterministic, and distributed as the
//! reconstruction filter weighs them, so that every sample counts the same and belongs to one
//! pixel.

use crate::shot::Filter;
use std::sync::LazyLock;

/// The samples of one image.
#[derive(Debug, Clone)]
pub struct Samples {
    count: u32,
    filter: Filter,
    inverse: &'static [f64],
}

/// Half the width of the Blackman–Harris filter, in pixels: Blender's default.
const BLACKMAN_HARRIS_RADIUS: f64 = 0.75;

/// Points of the tabulated inverse distribution; linear between them it is within 1e-6 pixel but
/// for the last ones, where the filter's weight is below 1e-4 of its peak.
const INVERSE_POINTS: usize = 4096;

/// Made once: it takes as long as a thousand pixels.
static INVERSE_BLACKMAN_HARRIS: LazyLock<Vec<f64>> = LazyLock::new(inverse_blackman_harris);

impl Samples {
    /// `count` samples a pixel; one sample stands at the pixel's center.
    pub fn new(count: u32, filter: Filter) -> Self {
        let inverse: &[f64] = match filter {
            Filter::Box => &[],
            Filter::BlackmanHarris => INVERSE_BLACKMAN_HARRIS.as_slice(),
        };
        Self {
            count,
            filter,
            inverse,
        }
    }

    /// Samples a pixel.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Position of sample `index` of pixel (x, y) relative to the pixel's upper left corner, in
    /// pixels; it may lie outside the pixel, as far as the filter reaches.
    ///
    /// The points are the first of Sobol's two-dimensional sequence, digitally shifted by a hash
    /// of the pixel: every power of two of them is stratified in all elementary intervals.
    pub fn position(&self, x: u32, y: u32, index: u32) -> [f64; 2] {
        if self.count == 1 {
            return [0.5, 0.5];
        }
        let shift = hash(x, y);
        let u = index.reverse_bits() ^ shift as u32;
        let v = sobol_second(index) ^ (shift >> 32) as u32;
        [u, v].map(|bits| 0.5 + self.offset((f64::from(bits) + 0.5) / 4294967296.0))
    }

    fn offset(&self, u: f64) -> f64 {
        match self.filter {
            Filter::Box => u - 0.5,
            Filter::BlackmanHarris => filter_offset(self.inverse, u),
        }
    }
}

/// The inverse distribution tabulated in `inverse`, at 0 < u < 1.
pub fn filter_offset(inverse: &[f64], u: f64) -> f64 {
    let at = u * (inverse.len() - 1) as f64;
    let below = (at as usize).min(inverse.len() - 2);
    let t = at - below as f64;
    inverse[below] * (1.0 - t) + inverse[below + 1] * t
}

/// Inverse of the distribution function of the Blackman–Harris window (Harris 1978, minimum
/// 4-term), tabulated by bisection.
fn inverse_blackman_harris() -> Vec<f64> {
    let tau = std::f64::consts::TAU;
    let a = [0.35875, 0.48829, 0.14128, 0.01168];
    // Integral of the window over 0..x, x in 0..1, over the whole.
    let distribution = |x: f64| {
        let sines: f64 = (1..4)
            .map(|k| {
                let k = f64::from(k);
                let sign = if k == 2.0 { 1.0 } else { -1.0 };
                sign * a[k as usize] * (tau * k * x).sin() / (tau * k)
            })
            .sum();
        (a[0] * x + sines) / a[0]
    };
    let solve = |u: f64| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if distribution(middle) < u {
                low = middle
            } else {
                high = middle
            }
        }
        (low + high - 1.0) * BLACKMAN_HARRIS_RADIUS
    };
    (0..INVERSE_POINTS)
        .map(|i| solve(i as f64 / (INVERSE_POINTS - 1) as f64))
        .collect()
}

/// Second coordinate of Sobol's sequence (Sobol 1967), 32 bits.
fn sobol_second(index: u32) -> u32 {
    let (mut result, mut direction, mut rest) = (0, 1u32 << 31, index);
    while rest != 0 {
        if rest & 1 == 1 {
            result ^= direction;
        }
        direction ^= direction >> 1;
        rest >>= 1;
    }
    result
}

/// 64 mixed bits of a pixel's place (SplitMix64: Steele, Lea & Flood 2014).
fn hash(x: u32, y: u32) -> u64 {
    let mut z = (u64::from(x) << 32 | u64::from(y)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_samples_of_a_box_fill_every_cell_of_every_elementary_grid() {
        let samples = Samples::new(16, Filter::Box);
        for (columns, rows) in [(16, 1), (8, 2), (4, 4), (2, 8), (1, 16)] {
            let mut cells = vec![0; 16];
            for i in 0..16 {
                let [x, y] = samples.position(5, 9, i);
                let cell = (x * columns as f64) as usize + columns * (y * rows as f64) as usize;
                cells[cell] += 1;
            }
            assert!(cells.iter().all(|&c| c == 1), "{columns}x{rows}: {cells:?}");
        }
    }

    #[test]
    fn blackman_harris_offsets_have_the_variance_of_the_window() {
        // Closed form of the window's second moment: r² (1/3 + 4/(2π)²·Σ…), here by quadrature
        // of the window itself, not of its inverse.
        let samples = Samples::new(4096, Filter::BlackmanHarris);
        let (mut mean, mut variance) = (0.0, 0.0);
        for i in 0..4096 {
            let [x, _] = samples.position(3, 4, i);
            mean += (x - 0.5) / 4096.0;
            variance += (x - 0.5).powi(2) / 4096.0;
        }
        let (mut weight, mut second) = (0.0, 0.0);
        for i in 0..100_000 {
            let x = (f64::from(i) + 0.5) / 1e5;
            let phase = std::f64::consts::TAU * x;
            let w = 0.35875 - 0.48829 * phase.cos() + 0.14128 * (2.0 * phase).cos()
                - 0.01168 * (3.0 * phase).cos();
            weight += w;
            second += w * ((2.0 * x - 1.0) * BLACKMAN_HARRIS_RADIUS).powi(2);
        }
        assert!(mean.abs() < 1e-4, "{mean}");
        assert!((variance / (second / weight) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn one_sample_stands_at_the_center() {
        assert_eq!(
            Samples::new(1, Filter::BlackmanHarris).position(7, 8, 0),
            [0.5, 0.5]
        );
    }
}
