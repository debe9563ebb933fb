//! Roughness of a curve: the quantities from which bounds on sums are computed.

use super::Spectrum;
use super::log_grid::Smoothing;
use super::quadrature::cuts_nm;

/// Number of samples of a curve at most.
const MOST_SAMPLES: f64 = 1e6;

/// Largest step, in ln λ, in which a curve is sampled: a tenth of the narrowest band of a color.
pub(super) const STEP: f64 = 2e-3;

/// Roughness of a curve over ln λ, relative to its peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Largest |f|, |f′| and |f″|.
    pub(super) largest: [f64; 3],
    /// Total variations of f, f′ and f″.
    pub(super) variation: [f64; 3],
    /// Treatment of the curve before it is tabulated.
    pub(super) smoothing: Smoothing,
    /// ∫ f du.
    pub(super) area: f64,
    /// Whether the curve is represented as [`Fine`](super::Fine) and not baked.
    pub(super) narrow: bool,
}

impl Roughness {
    /// The roughness of a constant.
    pub const CONSTANT: Self = Self {
        largest: [1.0, 0.0, 0.0],
        variation: [0.0; 3],
        smoothing: Smoothing::None,
        area: f64::INFINITY,
        narrow: false,
    };

    /// The roughness of a curve (of the wavelength in nm) that bends where `spectrum` does, over a
    /// range of wavelengths (nm, ascending), in steps of at most `step` in ln λ.
    pub fn of(
        curve: impl Fn(f64) -> f64,
        spectrum: &Spectrum,
        range_nm: [f64; 2],
        step: f64,
    ) -> Self {
        // Beyond these f64 has no wavelengths, however fast a scene is.
        let [from, to] = range_nm.map(|nm| nm.clamp(1e-300, 1e300));
        let mut cuts = vec![from, to];
        cuts_nm(spectrum, 1.0, &mut cuts);
        let knots = spectrum.knots_nm();
        if let (Some(first), Some(last)) = (knots.first(), knots.last()) {
            // Beyond its points a curve may jump.
            cuts.extend([first * (1.0 - 1e-9), last * (1.0 + 1e-9)]);
        }
        cuts.retain(|nm| *nm >= from && *nm <= to);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let step = step.min(STEP).max((to / from).ln() / MOST_SAMPLES);
        let mut samples = vec![(from.ln(), curve(from))];
        for pair in cuts.windows(2) {
            let [low, width] = [pair[0].ln(), (pair[1] / pair[0]).ln()];
            let count = (width / step).ceil().max(8.0) as u32;
            samples.extend((1..=count).map(|i| {
                let part = f64::from(i) / f64::from(count);
                let nm = pair[0] * (width * part).exp();
                (low + width * part, curve(nm.min(pair[1])))
            }));
        }
        Self {
            smoothing: Smoothing::of(spectrum),
            ..Self::sampled(&samples)
        }
    }

    /// The roughness of a curve that is represented finely because sums over the axis would miss
    /// it.
    #[must_use]
    pub fn narrow(self) -> Self {
        Self {
            narrow: true,
            ..self
        }
    }

    /// The roughness of samples (ln λ, value), ascending.
    fn sampled(samples: &[(f64, f64)]) -> Self {
        let peak = samples.iter().map(|s| s.1).fold(0.0, f64::max);
        if peak <= 0.0 {
            return Self::CONSTANT;
        }
        let mut derivative: Vec<(f64, f64)> = samples.iter().map(|s| (s.0, s.1 / peak)).collect();
        let pairs = derivative.windows(2);
        let areas = pairs.map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0));
        let mut own = Self {
            area: areas.sum(),
            ..Self::CONSTANT
        };
        for order in 0..3 {
            own.largest[order] = derivative.iter().map(|s| s.1.abs()).fold(0.0, f64::max);
            let steps = derivative.windows(2);
            own.variation[order] = steps.map(|pair| (pair[1].1 - pair[0].1).abs()).sum();
            derivative = quotients(&derivative);
        }
        own
    }

    /// The roughness of the product of two curves, under any shifts, by Leibniz's rule.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let ([_, la, lla], [_, lb, llb]) = (self.largest, other.largest);
        let ([va, vva, vvva], [vb, vvb, vvvb]) = (self.variation, other.variation);
        // ∫ |a⁽ⁱ⁾ b⁽ʲ⁾|, with either of them at its largest.
        let mixed = |va: f64, lb: f64, vb: f64, la: f64| nothing_of(va, lb).min(nothing_of(vb, la));
        Self {
            largest: [1.0, la + lb, lla + 2.0 * nothing_of(la, lb) + llb],
            variation: [
                va + vb,
                vva + vvb + 2.0 * mixed(va, lb, vb, la),
                vvva + vvvb + 3.0 * (mixed(vva, lb, vb, lla) + mixed(va, llb, vvb, la)),
            ],
            smoothing: Smoothing::None,
            area: self.area.min(other.area),
            narrow: self.narrow || other.narrow,
        }
    }
}

/// A product in which 0 times infinity is 0.
pub(super) fn nothing_of(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// Difference quotients of neighbors, midway between them.
fn quotients(samples: &[(f64, f64)]) -> Vec<(f64, f64)> {
    samples
        .windows(2)
        .map(|pair| {
            let [(a, low), (b, high)] = [pair[0], pair[1]];
            (0.5 * (a + b), (high - low) / (b - a))
        })
        .collect()
}
