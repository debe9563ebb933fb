//! Curves too narrow for an axis, represented so that none of their light is lost.
//!
//! Whether a sum over an axis' wavelengths sees a feature narrower than their spacing h is chance:
//! a line between two of them is black, a line on one of them many times too bright. A [`Fine`]
//! curve has [`PHASES`] nodes per spacing, δ = h/32 apart in u = ln λ, each with the mean of the
//! curve under a hat,
//!
//! Fᵢ = ∫ f(u) Λ((u − uᵢ)/δ) du/δ,  Λ(x) = max(0, 1 − |x|),
//!
//! integrated piece by piece between nodes and bends of the curve. So Σ δ Fᵢ φ(uᵢ) is ∫ f φ du for
//! every φ that is linear between nodes, however narrow f is: its integral and its center are kept.
//! A [`FineSensor`] has the weights of its channels at the same nodes, and a shift by whole nodes
//! is a shift of indices.
//!
//! The error of a channel is that of straight lines between nodes, δ²/8 of the second derivative of
//! the sensor's weight (times the other curves that the light meets): 2·10⁻⁵ of the weight in the
//! visible with 84 wavelengths. The ends of a window and of bands, where the weight jumps, are
//! sharp to δ.

use super::band::gauss;
use super::log_grid::{Baked, LogAxis, PHASES};
use super::quadrature::{Quadrature, cuts_nm};
use super::{Sensor, Spectrum};

/// Number of nodes that a curve may have, 16 MB of them.
const MOST_NODES: f64 = 2_097_152.0;

/// Share of a curve's greatest mean below which it counts as ended.
const DARK: f64 = 1e-25;

/// Width in spacings from which on a curve's finest feature needs no closer check.
const WIDE: f64 = 2.0;

/// Rise of the weight from one wavelength to the next in the check of a grid: the eye's green and
/// blue rise so on their flanks.
const SLOPE: f64 = 0.15;

/// A curve as means about nodes.
#[derive(Debug, Clone)]
pub struct Fine {
    axis: LogAxis,
    /// Number of the first node, counted from the axis' first wavelength.
    first: i64,
    means: Vec<f64>,
    /// The constant value of the curve before its first node and after its last.
    ends: [f64; 2],
}

impl Fine {
    /// Represents a curve (of the wavelength in nm, finite and at least 0) as far as shifts of |ln
    /// D| up to `reach` bring it to the axis. Beyond `support_nm` it is taken to be constant; it
    /// may bend or be narrow at `cuts_nm`, and is smooth between.
    ///
    /// None if there would be too many nodes.
    pub fn new(
        axis: LogAxis,
        reach: f64,
        support_nm: [f64; 2],
        cuts_nm: &[f64],
        curve: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let phases = PHASES as f64;
        let beyond = 1.0 + reach / axis.spacing();
        let seen = [-beyond, axis.count() as f64 + beyond];
        let node = |nm: f64| axis.place(nm).clamp(seen[0], seen[1]) * phases;
        let [low, high] = support_nm.map(node);
        if !(high - low).is_finite() || high - low > MOST_NODES {
            return None;
        }
        let first = low.floor() as i64 - 1;
        let last = high.ceil() as i64 + 1;
        let at = |place: f64| curve(axis.wavelength_nm(place / phases));
        let mut cuts: Vec<f64> = cuts_nm.iter().map(|nm| axis.place(*nm) * phases).collect();
        cuts.retain(|x| *x > first as f64 && *x < last as f64);
        cuts.extend((first..=last).map(|node| node as f64));
        cuts.sort_by(f64::total_cmp);
        let mut means = vec![0.0; (last - first + 1) as usize];
        for pair in cuts.windows(2) {
            let (from, half) = (pair[0], 0.5 * (pair[1] - pair[0]));
            if half <= 0.0 {
                continue;
            }
            let below = from.floor();
            let index = (below as i64 - first) as usize;
            for (point, share) in gauss() {
                let place = from + half * (1.0 + point);
                let part = share * half * at(place);
                means[index] += part * (1.0 - (place - below));
                means[index + 1] += part * (place - below);
            }
        }
        let peak = means.iter().copied().fold(0.0, f64::max);
        // A Gaussian is cut off where next to nothing is left of it.
        let ends = [first as f64 + 0.5, last as f64 - 0.5]
            .map(at)
            .map(|end| if end > DARK * peak { end } else { 0.0 });
        // Only half of their hats was integrated.
        means[0] += 0.5 * ends[0];
        means[(last - first) as usize] += 0.5 * ends[1];
        Some(Self {
            axis,
            first,
            means,
            ends,
        })
    }

    /// Represents a curve that bends, and is narrow, where `spectrum` does.
    pub fn of(
        axis: LogAxis,
        reach: f64,
        spectrum: &Spectrum,
        curve: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let mut cuts = Vec::new();
        cuts_nm(spectrum, 1.0, &mut cuts);
        Self::new(axis, reach, spectrum.support_nm()?, &cuts, curve)
    }

    /// Whether a spectrum may have a feature so narrow that sums over the axis could miss it.
    pub fn is_worth_a_look(axis: LogAxis, spectrum: &Spectrum) -> bool {
        Self::finest(spectrum).is_some_and(|finest| finest < WIDE * axis.spacing())
    }

    /// The width in ln λ of a bell, or of the closest points of a curve through points; None for
    /// curves that are smooth by nature.
    pub fn finest(spectrum: &Spectrum) -> Option<f64> {
        match spectrum {
            Spectrum::Gaussian {
                center_nm,
                width_nm,
            } => Some(width_nm / center_nm.abs()),
            Spectrum::Cardinal(_) | Spectrum::Sampled(_) => {
                let gaps = spectrum.knots_nm().windows(2);
                gaps.map(|pair| (pair[1] / pair[0]).ln())
                    .min_by(f64::total_cmp)
            }
            _ => None,
        }
    }

    /// Whether sums over the axis of `baked`, the same curve, are as good. The test: under a weight
    /// that falls to 0 six spacings to either side, and rises by 0.15 per spacing, the sum differs
    /// from that of the curve by no more than the share `noticed`, wherever the weight is.
    pub fn is_served_by(&self, baked: &Baked, noticed: f64) -> bool {
        const REACH: i64 = 6;
        const STRIDE: usize = 8;
        let phases = PHASES as i64;
        let weight = |place: f64| {
            let half_turn = std::f64::consts::PI * place / (2.0 * REACH as f64);
            half_turn.cos().powi(4) * (1.0 + SLOPE * place)
        };
        let fine: Vec<f64> = (-REACH * phases..=REACH * phases)
            .map(|i| weight(i as f64 / phases as f64) / phases as f64)
            .collect();
        let coarse: Vec<f64> = (-REACH..=REACH).map(|i| weight(i as f64)).collect();
        let reach = REACH * phases;
        let sums: Vec<[f64; 2]> = (self.first - reach..=self.last() + reach)
            .step_by(STRIDE)
            .map(|middle| {
                let exact = (middle - reach..=middle + reach)
                    .zip(&fine)
                    .map(|(node, weight)| weight * self.mean(node));
                let sum = (-REACH..=REACH)
                    .zip(&coarse)
                    .map(|(i, weight)| weight * baked.at_node(middle + i * phases));
                [exact.sum(), sum.sum()]
            })
            .collect();
        // Next to a line there is almost no light: what counts is the light about it.
        let about = 2 * reach as usize / STRIDE;
        sums.iter().enumerate().all(|(i, [exact, sum])| {
            let off = (sum - exact).abs();
            let near = &sums[i.saturating_sub(about)..(i + about).min(sums.len())];
            off <= noticed * exact || near.iter().any(|[exact, _]| off <= noticed * exact)
        })
    }

    /// The means.
    pub(super) fn means(&self) -> &[f64] {
        &self.means
    }

    /// Subtracts light, starting at a position among the means.
    pub(super) fn take(&mut self, start: usize, light: &[f64]) {
        for (mean, light) in self.means[start..].iter_mut().zip(light) {
            *mean -= light;
        }
    }

    /// Number of the first mean's node.
    pub(super) fn first(&self) -> i64 {
        self.first
    }

    /// The mean about a node.
    pub(super) fn mean(&self, node: i64) -> f64 {
        if node < self.first {
            self.ends[0]
        } else {
            let index = (node - self.first) as usize;
            self.means.get(index).copied().unwrap_or(self.ends[1])
        }
    }

    /// The mean about the node nearest to a wavelength.
    pub fn near(&self, lambda_nm: f64) -> f64 {
        self.mean((self.axis.place(lambda_nm) * PHASES as f64).round() as i64)
    }

    /// Number of the last mean's node.
    pub(super) fn last(&self) -> i64 {
        self.first + self.means.len() as i64 - 1
    }

    /// The curve under a shift (ln D) at a place in nodes of the axis, linear between nodes.
    #[inline]
    pub fn at(&self, ln_doppler: f64, node: f64) -> f64 {
        let place = node + ln_doppler / self.axis.spacing() * PHASES as f64;
        let below = place.floor();
        let share = place - below;
        let below = below as i64;
        self.mean(below) * (1.0 - share) + self.mean(below.saturating_add(1)) * share
    }

    /// Whether the curve is 0 beyond its nodes.
    pub fn ends_dark(&self) -> bool {
        self.ends == [0.0; 2]
    }

    /// Memory of its means, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.means)
    }
}

/// The weights of a sensor's channels at the nodes of its window.
#[derive(Debug, Clone)]
pub struct FineSensor {
    axis: LogAxis,
    /// Number of the first node with a weight.
    first: i64,
    weights: Vec<[f64; 3]>,
    /// Sums of the weights before each node.
    before: Vec<[f64; 3]>,
}

impl FineSensor {
    /// The weights of the channels of a sensor, as integrals.
    pub fn new(sensor: &Sensor, quadrature: &Quadrature) -> Self {
        let axis = sensor.axis();
        let [from, to] = quadrature.seen_nm().unwrap_or([f64::NAN; 2]);
        let node = |nm: f64| axis.place(nm) * PHASES as f64;
        let first = node(from).floor() as i64;
        let last = if from < to {
            node(to).ceil() as i64
        } else {
            -1 + first
        };
        let weights: Vec<[f64; 3]> = (first..=last)
            .map(|i| {
                // The part of the window about the node.
                let ends = [-0.5, 0.5].map(|half| {
                    let nm = axis.wavelength_nm((i as f64 + half) / PHASES as f64);
                    nm.clamp(from, to)
                });
                quadrature.white(ends)
            })
            .collect();
        let mut sum = [0.0; 3];
        let mut before = vec![sum];
        for weight in &weights {
            (0..3).for_each(|c| sum[c] += weight[c]);
            before.push(sum);
        }
        Self {
            axis,
            first,
            weights,
            before,
        }
    }

    /// The axis in whose spacing the nodes are counted.
    pub fn axis(&self) -> LogAxis {
        self.axis
    }

    /// The wavelength of a place in nodes, nm.
    pub fn wavelength_nm(&self, node: f64) -> f64 {
        self.axis.wavelength_nm(node / PHASES as f64)
    }

    /// The nodes, by number, with their weights.
    pub(super) fn nodes(&self) -> impl Iterator<Item = (i64, &[f64; 3])> {
        (self.first..).zip(&self.weights)
    }

    /// The weight of a place between nodes; None where nothing is seen.
    #[inline]
    pub(super) fn weights_at(&self, node: f64) -> Option<[f64; 3]> {
        let place = node - self.first as f64;
        let below = place.floor();
        if !(below >= 0.0 && below < self.weights.len() as f64) {
            return None;
        }
        let low = self.weights[below as usize];
        let high = self.weights.get(below as usize + 1).unwrap_or(&low);
        let share = place - below;
        Some([0, 1, 2].map(|c| low[c] * (1.0 - share) + high[c] * share))
    }

    /// The channels of a curve under a shift: of f(Dλ), given ln D.
    pub fn channels(&self, fine: &Fine, ln_doppler: f64) -> [f64; 3] {
        let nodes = ln_doppler / self.axis.spacing() * PHASES as f64;
        let below = nodes.floor();
        let share = nodes - below;
        let low = self.dot(fine, below as i64);
        if share == 0.0 {
            return low;
        }
        let high = self.dot(fine, below as i64 + 1);
        [0, 1, 2].map(|c| low[c] * (1.0 - share) + high[c] * share)
    }

    /// The channels of a curve shifted by whole nodes.
    fn dot(&self, fine: &Fine, shift: i64) -> [f64; 3] {
        let (own, end) = (self.first, self.first + self.weights.len() as i64);
        let from = (fine.first.saturating_sub(shift)).clamp(own, end);
        let to = ((fine.last() + 1).saturating_sub(shift)).clamp(own, end);
        let [a, b] = [from, to].map(|i| (i - own) as usize);
        let [before, within, all] = [
            self.before[a],
            self.before[b],
            self.before[self.weights.len()],
        ];
        let mut sum =
            [0, 1, 2].map(|c| fine.ends[0] * before[c] + fine.ends[1] * (all[c] - within[c]));
        if a < b {
            let start = (from + shift - fine.first) as usize;
            for (weight, mean) in self.weights[a..b].iter().zip(&fine.means[start..]) {
                (0..3).for_each(|c| sum[c] += weight[c] * mean);
            }
        }
        sum
    }
}
