//! Three channels of light of any spectrum by adaptive quadrature: the reference for every other
//! method.
//!
//! The integral over the window is cut wherever the integrand is not smooth: at whole nm, between
//! which the weights of [`cie::xyz_bar`](crate::color::cie::xyz_bar) are linear, at the ends of bands, and
//! where the caller knows the curve to bend or to be narrow ([`cuts_nm`]). Each piece is summed by
//! Gauss's rule of three points and Kronrod's extension of it to seven (Kronrod 1965, Nodes and
//! Weights of Quadrature Formulas), exact for polynomials of degree 5 and 11. Their difference is
//! taken as the error of the better one, and pieces are halved until it is small enough. So a
//! product of splines and polylines is exact except for rounding.

use super::Spectrum;
use crate::color::cie::{EFFICACY, RANGE_NM, xyz_bar};

/// Largest error of a channel, relative to the greatest of the three, unless 16384 halvings are not
/// enough.
pub const TOLERANCE: f64 = 1e-10;

/// Number of halvings in one integral: 20 find a bend at an unknown place to [`TOLERANCE`].
const MOST_HALVINGS: u32 = 1 << 14;

/// Longest piece of a band, in ln λ: no feature of black bodies or colors is narrower than a third
/// of it.
const PIECE: f64 = 0.05;

/// Value to which larger ones are clamped, so that sums stay finite: as in
/// [`Sensor`](super::Sensor).
const LARGEST: f64 = 1e280;

/// Nodes of the seven points from the middle outward, in half-widths, with their weights in
/// Kronrod's and in Gauss's rule.
const NODES: [(f64, f64, f64); 4] = [
    (0.0, 0.450_916_538_658_474_14, 8.0 / 9.0),
    (0.434_243_749_346_802_56, 0.401_397_414_775_962_2, 0.0),
    (0.774_596_669_241_483_4, 0.268_488_089_868_333_46, 5.0 / 9.0),
    (0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
];

/// Three channels as integrals over a window.
#[derive(Debug, Clone)]
pub struct Quadrature {
    /// Wavelengths at which the weights are not smooth, and both ends, ascending, nm; fewer than
    /// two if nothing is seen.
    cuts_nm: Vec<f64>,
    weights: Weights,
}

#[derive(Debug, Clone, Copy)]
enum Weights {
    Cie,
    /// Ends of the middle third, nm.
    Thirds([f64; 2]),
}

impl Quadrature {
    /// XYZ in cd/m² of spectral radiance (W·m⁻²·sr⁻¹·nm⁻¹) within a window, nm.
    pub fn cie1931(window_nm: [f64; 2]) -> Self {
        let [from, to] = [window_nm[0].max(RANGE_NM[0]), window_nm[1].min(RANGE_NM[1])];
        let mut cuts_nm = Vec::new();
        if from < to {
            let whole = (from.ceil() as u32..=to.floor() as u32).map(f64::from);
            cuts_nm.push(from);
            cuts_nm.extend(whole.filter(|nm| (from..to).contains(nm) && *nm > from));
            cuts_nm.push(to);
        }
        Self {
            cuts_nm,
            weights: Weights::Cie,
        }
    }

    /// Totals in W·m⁻²·sr⁻¹ of the long, middle and short third of a window (nm, ascending), equal
    /// in ln λ, as of [`Sensor::bands`](super::Sensor::bands).
    pub fn bands(window_nm: [f64; 2]) -> Self {
        let ln_width = (window_nm[1] / window_nm[0]).ln();
        let each = (ln_width / 3.0 / PIECE).ceil().max(1.0) as u32;
        let at = |i: u32| window_nm[0] * (ln_width * f64::from(i) / f64::from(3 * each)).exp();
        let mut cuts_nm: Vec<f64> = (0..3 * each).map(at).collect();
        cuts_nm.push(window_nm[1]);
        Self {
            cuts_nm,
            weights: Weights::Thirds([at(each), at(2 * each)]),
        }
    }

    /// The range of wavelengths that is seen at all, nm; None if it is empty.
    pub fn seen_nm(&self) -> Option<[f64; 2]> {
        Some([*self.cuts_nm.first()?, *self.cuts_nm.last()?])
    }

    /// The channels of an equal-energy light of value 1 between two wavelengths, nm.
    pub(super) fn white(&self, [from, to]: [f64; 2]) -> [f64; 3] {
        let first = self.cuts_nm.partition_point(|cut| *cut <= from);
        let mut sum = [0.0; 3];
        for pair in self.cuts_nm[first.saturating_sub(1)..].windows(2) {
            if pair[0] >= to {
                break;
            }
            let ends = [pair[0].max(from), pair[1].min(to)];
            if ends[0] < ends[1] {
                self.piece(ends, &|_| 1.0).add_to(&mut sum);
            }
        }
        sum
    }

    /// The channels of a curve (of the wavelength in nm, at least 0) within [`TOLERANCE`] of the
    /// greatest. `cuts_nm` are the wavelengths at which the curve is not smooth, in any order.
    ///
    /// XYZ of the whole visible range takes 7 evaluations per nm, and as many for each cut.
    pub fn channels(&self, cuts_nm: &mut Vec<f64>, curve: impl Fn(f64) -> f64) -> [f64; 3] {
        match self.seen_nm() {
            Some(seen_nm) => self.channels_within(seen_nm, cuts_nm, curve),
            None => [0.0; 3],
        }
    }

    /// The channels of the part of a curve in a range (nm, ascending).
    pub fn channels_within(
        &self,
        [from, to]: [f64; 2],
        cuts_nm: &mut Vec<f64>,
        curve: impl Fn(f64) -> f64,
    ) -> [f64; 3] {
        cuts_nm.retain(|nm| *nm > from && *nm < to);
        let within = |nm: &&f64| **nm > from && **nm < to;
        let first = self.cuts_nm.partition_point(|cut| *cut <= from);
        cuts_nm.extend(self.cuts_nm[first..].iter().take_while(within));
        cuts_nm.extend([from, to]);
        cuts_nm.sort_by(f64::total_cmp);
        cuts_nm.dedup();
        let pieces: Vec<Piece> = cuts_nm
            .windows(2)
            .map(|ends| self.piece([ends[0], ends[1]], &curve))
            .collect();
        let mut sum = [0.0; 3];
        pieces.iter().for_each(|piece| piece.add_to(&mut sum));
        let allowed = TOLERANCE * sum.into_iter().fold(0.0, f64::max);
        if pieces.iter().map(|piece| piece.error).sum::<f64>() <= allowed {
            return sum;
        }
        self.refined(pieces, allowed, &curve)
    }

    /// The sum over pieces. A piece whose error exceeds its share of `allowed` is halved.
    fn refined(&self, pieces: Vec<Piece>, allowed: f64, curve: &impl Fn(f64) -> f64) -> [f64; 3] {
        let part = allowed / pieces.len() as f64;
        let mut sum = [0.0; 3];
        let mut halvings = 0;
        let mut open: Vec<(Piece, f64)> = pieces.into_iter().map(|piece| (piece, part)).collect();
        while let Some((piece, allowed)) = open.pop() {
            let [from, to] = piece.ends_nm;
            let middle = 0.5 * (from + to);
            let whole = piece.error <= allowed || halvings >= MOST_HALVINGS;
            if whole || middle <= from || middle >= to {
                piece.add_to(&mut sum);
                continue;
            }
            halvings += 1;
            for ends_nm in [[from, middle], [middle, to]] {
                open.push((self.piece(ends_nm, curve), 0.5 * allowed));
            }
        }
        sum
    }

    /// Both rules over a piece on which the weights are smooth.
    fn piece(&self, ends_nm: [f64; 2], curve: &impl Fn(f64) -> f64) -> Piece {
        let [from, to] = ends_nm;
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut kronrod, mut gauss) = ([0.0; 3], [0.0; 3]);
        let mut add = |nm: f64, better: f64, worse: f64| {
            let value = curve(nm);
            // NaN counts as 0.
            let value = if value > 0.0 { value.min(LARGEST) } else { 0.0 };
            for (c, weight) in (0..).zip(self.weights(nm, middle)) {
                kronrod[c] += better * weight * value;
                gauss[c] += worse * weight * value;
            }
        };
        for (node, better, worse) in NODES {
            add(middle + half * node, better, worse);
            if node > 0.0 {
                add(middle - half * node, better, worse);
            }
        }
        let error = |c: usize| half * (kronrod[c] - gauss[c]).abs();
        Piece {
            ends_nm,
            sums: kronrod.map(|value| half * value),
            error: error(0).max(error(1)).max(error(2)),
        }
    }

    /// The weight of a wavelength, in a piece around `middle`.
    fn weights(&self, nm: f64, middle: f64) -> [f64; 3] {
        match self.weights {
            Weights::Cie => xyz_bar(nm).map(|bar| EFFICACY * bar),
            Weights::Thirds([short, _]) if middle < short => [0.0, 0.0, 1.0],
            Weights::Thirds([_, long]) if middle < long => [0.0, 1.0, 0.0],
            Weights::Thirds(_) => [1.0, 0.0, 0.0],
        }
    }
}

/// A part of an integral.
struct Piece {
    ends_nm: [f64; 2],
    sums: [f64; 3],
    /// Difference between the two rules, in the channel where it is largest.
    error: f64,
}

impl Piece {
    fn add_to(&self, sum: &mut [f64; 3]) {
        for (sum, own) in sum.iter_mut().zip(self.sums) {
            *sum += own;
        }
    }
}

/// Standard deviations from a Gaussian's center at which it is cut: from one to the next the rules
/// above are good to 1e-12 of it.
const GAUSSIAN_CUTS: std::ops::RangeInclusive<i32> = -12..=12;

/// Adds the wavelengths (nm) at which a curve that is read at `shift`·λ is not smooth, or between
/// which it might be missed: its points, the ends of its support, a Gaussian's deviations.
pub fn cuts_nm(spectrum: &Spectrum, shift: f64, cuts_nm: &mut Vec<f64>) {
    match spectrum {
        Spectrum::Constant(_) | Spectrum::Planck(_) => {}
        Spectrum::Gaussian {
            center_nm,
            width_nm,
        } => cuts_nm.extend(GAUSSIAN_CUTS.map(|i| (center_nm + f64::from(i) * width_nm) / shift)),
        Spectrum::Rgb(color) => {
            cuts_nm.extend(
                color
                    .support_nm()
                    .into_iter()
                    .flatten()
                    .map(|nm| nm / shift),
            );
        }
        Spectrum::Cardinal(_) | Spectrum::Sampled(_) | Spectrum::Tinted(_) => {
            cuts_nm.extend(spectrum.knots_nm().iter().map(|nm| nm / shift));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kronrod's weights are those that make seven points exact to degree 11, Gauss's to 5.
    #[test]
    fn the_rules_are_exact_to_their_degrees() {
        for (degree, most) in (0..=12).map(|d| (d, 1e-15)) {
            let sum = |weight: fn(&(f64, f64, f64)) -> f64| -> f64 {
                let both = |n: &(f64, f64, f64)| {
                    let times = if n.0 > 0.0 && degree % 2 == 0 {
                        2.0
                    } else {
                        1.0
                    };
                    let odd = if degree % 2 == 1 { 0.0 } else { 1.0 };
                    odd * times * weight(n) * n.0.powi(degree)
                };
                NODES.iter().map(both).sum()
            };
            let exact = if degree % 2 == 0 {
                2.0 / f64::from(degree + 1)
            } else {
                0.0
            };
            let [kronrod, gauss] = [sum(|n| n.1), sum(|n| n.2)];
            assert_eq!(
                (kronrod - exact).abs() < most,
                degree <= 11,
                "{degree}: {kronrod}"
            );
            assert_eq!((gauss - exact).abs() < most, degree <= 5 || degree % 2 == 1);
        }
    }

    #[test]
    fn nothing_is_seen_of_a_window_beyond_the_visible() {
        for window in [[1e-9, 300.0], [900.0, 1e15]] {
            let quadrature = Quadrature::cie1931(window);
            assert_eq!(quadrature.channels(&mut Vec::new(), |_| 1.0), [0.0; 3]);
        }
    }

    #[test]
    fn what_is_no_number_or_no_amount_ends_in_a_bounded_sum() {
        for value in [f64::NAN, f64::INFINITY, f64::MAX, -1.0] {
            for quadrature in [
                Quadrature::cie1931([360.0, 830.0]),
                Quadrature::bands([1e-9, 1e15]),
            ] {
                let mut cuts = vec![f64::NAN, f64::INFINITY, 0.0, -1.0, 500.0, 500.0];
                let sum = quadrature.channels(&mut cuts, |_| value);
                assert!(sum.iter().all(|v| v.is_finite() && *v >= 0.0), "{sum:?}");
            }
        }
    }
}
