//! Bound on the difference between sums over a sensor's axis and integrals, valid under any shifts.
//!
//! The sum's error E(f) = ∫ w f dλ − Σ Wⱼ f(λⱼ) is linear in f, and 0, or nearly so, for constants,
//! lines and parabolas in u = ln λ. By Taylor's formula from the window's lower end t₀ up (Peano
//! 1913; Davis 1975, Interpolation and Approximation, §3.7)
//!
//! E(f) = Σᵢ Kᵢ₊₁(t₀) f⁽ⁱ⁾(t₀) + ∫ Kₘ(t) f⁽ᵐ⁾(t) dt, i < m,  |∫ Kₘ f⁽ᵐ⁾| ≤ max |Kₘ| · V(f⁽ᵐ⁻¹⁾),
//!
//! where Kₘ(t) is E of (u − t)₊ᵐ⁻¹/(m − 1)! and V the total variation. V does not change when f is
//! shifted, so neither does the bound. The best of m = 1, 2 and 3 counts: a jump has m = 1 and an
//! error that falls with the spacing h, a bend m = 2 and h², a smooth curve m = 3 and h³. Kernels
//! come from the sensor's own weights, variations from curves sampled finer than h.
//!
//! By the same reasoning it includes the smoothing of curves through points, linear interpolation
//! between the phases of baked curves, cubic interpolation in tables over ln D, and rounding to
//! f32.
//!
//! Narrow curves have a bound of their own ([`NarrowKernel`]), relative to their area ∫ f du. A
//! narrow curve f is integrated ([`Fine`](super::Fine)); the error is in the rest. For the product
//! w g f of a channel's weight w per unit of u = ln λ, a smooth curve g and f, the sum is ∫ ŵg f du,
//! so the error is at most the area times max |ŵg − w g|. Between wavelengths, g is a cubic
//! (Catmull-Rom; its kernels are 1.13, h/4 and h²/10); between rows of tables over ln D, w and g are
//! lines or cubics.

use super::log_grid::{PHASE_SPACING, Smoothing};
use super::quadrature::Quadrature;
use super::roughness::{Roughness, nothing_of};
use super::sensor::Sensor;
use super::through::Responses;

/// Steps between two wavelengths in which kernels are integrated, to an error below 1 %.
const KERNEL_STEPS: i64 = 128;

/// Factor for the error of sampled variations and kernels, which both converge from below.
const SAFETY: f64 = 1.1;

/// Factor by which smoothing may raise variations and derivatives: the integral of its kernel's
/// absolute value.
const SMOOTHED: f64 = 7.0 / 6.0;

/// Bounds on the error of a sensor's sums.
#[derive(Debug, Clone)]
pub struct GridBound {
    channels: [Kernel; 3],
    spacing: f64,
    wavelengths: f64,
    table_spacing: Option<f64>,
}

/// Kernels of the error of one channel, relative to that channel of an equal-energy white of value
/// 1.
#[derive(Debug, Clone, Copy, Default)]
struct Kernel {
    /// |Kₘ| at the window's lower end.
    ends: [f64; 3],
    /// max |Kₘ|.
    largest: [f64; 3],
    /// Largest and sum of |Wⱼ|.
    weight: f64,
    weights: f64,
    narrow: NarrowKernel,
}

impl GridBound {
    /// The bounds of a sensor's weights against the quadrature of the same channels. Curves are
    /// baked; if XYZ of curves is tabulated in ln D, `table_spacing` is the step.
    pub fn new(sensor: &Sensor, quadrature: &Quadrature, table_spacing: Option<f64>) -> Self {
        let axis = sensor.axis();
        let step = axis.spacing() / KERNEL_STEPS as f64;
        let [from, to] = axis.window_nm();
        let place = |i: i64| {
            let nm = axis.wavelength_nm(i as f64 / KERNEL_STEPS as f64);
            nm.clamp(from, to)
        };
        let white = quadrature.white([from, to]);
        let mut densities = [const { Vec::new() }; 3];
        let mut now = [[0.0f64; 3]; 3];
        let mut channels = [Kernel::default(); 3];
        for i in (-KERNEL_STEPS..axis.count() as i64 * KERNEL_STEPS).rev() {
            let within = quadrature.white([place(i), place(i + 1)]);
            let node = (i + 1) % KERNEL_STEPS == 0;
            let weights = node
                .then(|| sensor.weights().get(((i + 1) / KERNEL_STEPS) as usize))
                .flatten();
            for c in (0..3).filter(|c| white[*c] > 0.0) {
                let [mut k1, mut k2, mut k3] = now[c];
                let kernel = &mut channels[c];
                kernel.largest[0] = kernel.largest[0].max(k1.abs());
                if let Some(weights) = weights {
                    let weight = weights[c] / white[c];
                    k1 -= weight;
                    kernel.weight = kernel.weight.max(weight.abs());
                    kernel.weights += weight.abs();
                }
                densities[c].push(within[c] / white[c]);
                let before = [k1, k2];
                kernel.largest[0] = kernel.largest[0].max(k1.abs());
                k1 += within[c] / white[c];
                k2 += 0.5 * step * (before[0] + k1);
                k3 += 0.5 * step * (before[1] + k2);
                now[c] = [k1, k2, k3];
                for (largest, k) in kernel.largest.iter_mut().zip(now[c]) {
                    *largest = largest.max(k.abs());
                }
                kernel.ends = now[c].map(f64::abs);
            }
        }
        let table_step = table_spacing
            .unwrap_or(0.0)
            .max(axis.spacing() * Responses::SPACING);
        for (kernel, densities) in channels.iter_mut().zip(&densities) {
            kernel.narrow = NarrowKernel::of(densities, step, axis.spacing(), table_step);
        }
        Self {
            channels,
            spacing: axis.spacing(),
            wavelengths: axis.count() as f64,
            table_spacing,
        }
    }

    /// Steps in ln λ in which a curve has to be sampled for [`Roughness`].
    pub fn step(&self) -> f64 {
        0.25 * self.spacing
    }

    /// The largest error of a channel of the product of curves, each under any shift, relative to
    /// that channel of an equal-energy light as bright as the product of their peaks.
    pub fn relative(&self, factors: &[Roughness]) -> f64 {
        let error = |kernel: &Kernel| self.channel(kernel, factors);
        SAFETY * self.channels.iter().map(error).fold(0.0, f64::max)
    }

    fn channel(&self, kernel: &Kernel, factors: &[Roughness]) -> f64 {
        if factors.iter().any(|f| f.narrow) {
            return self.narrow(kernel, factors);
        }
        let product = factors
            .iter()
            .fold(Roughness::CONSTANT, |product, f| product.times(f));
        let mut taylor = 0.0;
        let mut sum = f64::INFINITY;
        for order in 0..3 {
            taylor += nothing_of(kernel.ends[order], product.largest[order]);
            let rest = nothing_of(kernel.largest[order], product.variation[order]);
            sum = sum.min(taylor + rest);
        }
        let phases: f64 = factors
            .iter()
            .map(|f| SMOOTHED * self.phases(kernel, f) + self.smoothing(kernel, f))
            .sum();
        let tables = self.table_spacing.map_or(0.0, |step| {
            SMOOTHED * SMOOTHED * self.tables(kernel, &product, step)
        });
        // Sums of eight lanes, and a few operations on each value.
        let rounding = F32 * (self.wavelengths / 8.0 + 16.0) * kernel.weights;
        // Cubic taps amplify the errors of their entries by at most 1.25.
        sum + 1.25 * (phases + rounding) + tables
    }

    /// All light of a product with a narrow curve: the largest possible error if another curve is
    /// narrow too and both are not integrated together.
    pub fn all_light(&self, factors: &[Roughness]) -> f64 {
        let window = self.spacing * self.wavelengths;
        let area = factors.iter().map(|f| f.area).fold(window, f64::min);
        let most = |kernel: &Kernel| kernel.narrow.most();
        SAFETY * area * self.channels.iter().map(most).fold(0.0, f64::max)
    }

    /// The error if a curve is narrow. Two narrow curves count as integrated together.
    fn narrow(&self, kernel: &Kernel, factors: &[Roughness]) -> f64 {
        let narrow = factors.iter().filter(|f| f.narrow);
        let area = narrow.map(|f| f.area).fold(f64::INFINITY, f64::min);
        let smooth = factors.iter().filter(|f| !f.narrow);
        let errors = smooth.map(|f| {
            let baked = self.smoothing(kernel, f) / kernel.weight.max(f64::MIN_POSITIVE);
            kernel.narrow.error(f.variation, f.largest[1], baked)
        });
        area.min(self.spacing * self.wavelengths) * (errors.sum::<f64>() + kernel.narrow.own())
    }

    /// The error of linear interpolation between the phases of a baked curve: |f − If| ≤ V, δ/4
    /// V(f′), δ²/8 max |f″|. The pieces that different wavelengths read do not overlap.
    fn phases(&self, kernel: &Kernel, f: &Roughness) -> f64 {
        let step = self.spacing * PHASE_SPACING;
        let [jump, bend, _] = f.variation;
        (kernel.weight * jump)
            .min(kernel.weight * step / 4.0 * bend)
            .min(kernel.weights * step * step / 8.0 * f.largest[2])
    }

    /// The error of smoothing: the sum of |f̃ − f|, each at the largest weight.
    fn smoothing(&self, kernel: &Kernel, f: &Roughness) -> f64 {
        if f.smoothing == Smoothing::None {
            return 0.0;
        }
        let mut spacing = 1.0;
        let mut least = f64::INFINITY;
        for (reach, variation) in Smoothing::REACH.into_iter().zip(f.variation) {
            least = least.min(reach * spacing * variation);
            spacing *= self.spacing;
        }
        kernel.weight * least
    }

    /// The error of the Catmull-Rom cubic between the entries of a table: its kernels are at most
    /// 1.13, δ/4 and δ²/10. The three steps that it spans overlap for wavelengths that are closer.
    fn tables(&self, kernel: &Kernel, product: &Roughness, step: f64) -> f64 {
        let overlap = (3.0 * step / self.spacing).floor() + 1.0;
        let [jump, bend, twist] = product.variation;
        let least = (1.13 * jump)
            .min(step / 4.0 * bend)
            .min(step * step / 10.0 * twist);
        kernel.weight * overlap * least
    }
}

/// Rounding error of an f32 operation.
pub(super) const F32: f64 = 6e-8;

/// A channel's weight per unit of ln λ, relative to the channel of an equal-energy white of value
/// 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NarrowKernel {
    most: f64,
    /// Largest change over a step of tables.
    rise: f64,
    /// Largest distance from the straight line over a step.
    sag: f64,
    /// The axis' spacing, and the step of tables.
    spacing: f64,
    table_step: f64,
}

impl NarrowKernel {
    /// The kernel from the parts of a channel in equal steps of ln λ, each `step` wide; 0 beyond.
    pub(super) fn of(parts: &[f64], step: f64, spacing: f64, table_step: f64) -> Self {
        let half = (table_step / step / 2.0).ceil().max(1.0) as usize;
        let at = |i: usize| {
            let part = i.checked_sub(2 * half).and_then(|i| parts.get(i));
            part.copied().unwrap_or(0.0) / step
        };
        let mut own = Self {
            spacing,
            table_step,
            ..Self::default()
        };
        for i in 0..parts.len() + 2 * half {
            let [low, middle, high] = [at(i), at(i + half), at(i + 2 * half)];
            own.most = own.most.max(low);
            own.rise = own.rise.max((high - low).abs());
            own.sag = own.sag.max((middle - 0.5 * (low + high)).abs());
        }
        own
    }

    /// The error that a smooth curve of peak 1 adds, from the variations of it and its derivatives,
    /// its steepest slope, and the error of its baked form.
    pub(super) fn error(&self, variation: [f64; 3], steepest: f64, baked: f64) -> f64 {
        let [jump, bend, twist] = variation;
        let cubic = (1.13 * jump)
            .min(self.spacing / 4.0 * bend)
            .min(self.spacing * self.spacing / 10.0 * twist);
        let between = jump.min(0.5 * self.table_step * steepest);
        self.most * (cubic + baked + between) + self.rise * between
    }

    /// The largest weight.
    pub(super) fn most(&self) -> f64 {
        self.most
    }

    /// The error without any smooth curve.
    pub(super) fn own(&self) -> f64 {
        // A cubic overshoots a jump by an eighth of it on either side.
        2.5 * self.sag + F32 * 16.0 * self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::roughness::STEP;
    use crate::spectrum::{LogAxis, Spectrum};

    fn bound(count: usize) -> GridBound {
        let window = [360.0, 830.0];
        let sensor = Sensor::cie1931(LogAxis::new(window, count));
        GridBound::new(&sensor, &Quadrature::cie1931(window), None)
    }

    fn line(width_nm: f64) -> Roughness {
        let line = Spectrum::gaussian(560.0, width_nm).unwrap();
        Roughness::of(|nm| line.at(nm), &line, [100.0, 3000.0], STEP)
    }

    #[test]
    fn variations_of_a_gaussian_are_those_of_its_derivatives() {
        // Up and down; e^(−½) to either side of the slope, there and back; 1 and 2e^(−3/2) of bend.
        let sigma = 5.0 / 560.0;
        let expected = [
            2.0,
            4.0 * (-0.5f64).exp() / sigma,
            (2.0 + 8.0 * (-1.5f64).exp()) / (sigma * sigma),
        ];
        for (found, expected) in line(5.0).variation.into_iter().zip(expected) {
            // ln λ is not quite linear over the line.
            assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        }
    }

    #[test]
    fn the_bound_falls_with_the_power_that_smoothness_allows() {
        let [coarse, fine] = [84, 168].map(bound);
        let ratio = |factors: &[Roughness]| coarse.relative(factors) / fine.relative(factors);
        let smooth = ratio(&[line(25.0)]);
        assert!(smooth > 5.5, "{smooth}");
        let bent = Spectrum::Sampled(
            crate::spectrum::Sampled::new(
                &[(500.0, 0.0), (520.0, 1.0), (540.0, 0.0)],
                crate::spectrum::Beyond::Hold,
            )
            .unwrap(),
        );
        let bent = Roughness::of(|nm| bent.at(nm), &bent, [100.0, 3000.0], 1e-4);
        assert!((3.0..5.0).contains(&ratio(&[bent])), "{}", ratio(&[bent]));
        let narrow = ratio(&[line(0.01)]);
        assert!((1.5..2.5).contains(&narrow), "{narrow}");
    }

    #[test]
    fn it_is_finite_in_any_window_and_within_any_reach() {
        for window in [[1e-9, 1e15], [589.0, 589.001], [1e7, 1e9]] {
            let sensor = Sensor::bands(LogAxis::new(window, 84));
            let bound = GridBound::new(&sensor, &Quadrature::bands(window), Some(1e-3));
            let line = Spectrum::gaussian(589.0, 1.0).unwrap();
            let rough = Roughness::of(|nm| line.at(nm), &line, [0.0, f64::INFINITY], bound.step());
            let found = bound.relative(&[rough, rough]);
            assert!(found.is_finite() && found > 0.0, "{window:?}: {found:e}");
        }
    }

    #[test]
    fn a_constant_is_off_by_rounding_alone() {
        assert!(bound(84).relative(&[Roughness::CONSTANT]) < 3e-6);
    }
}
