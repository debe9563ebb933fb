//! Weights of an axis' wavelengths in the integral over a part of its window.
//!
//! Between wavelengths a curve is taken to be the cubic of [`catmull_rom`] in ln λ; in the half bin
//! at either end of the window, the parabola through the three wavelengths there. Integrals over λ
//! of parabolas in ln λ, and of constants above all, are then exact. The error of others falls with
//! the fourth power of the spacing (`tests/window.rs`): 84 wavelengths in the visible leave 3e-8 of
//! a black body's band; spread over three decades 3e-4, in Wien's part 2e-3.

use super::cubic::catmull_rom;
use super::log_grid::LogAxis;

/// Longest piece, in ln λ, for one set of [`gauss`] nodes: the integrand is a cubic times e^(ln λ),
/// and the error of the rule is its tenth derivative, below 1e-15 there.
const PIECE: f64 = 0.1;

/// Weights, nm, of an axis' wavelengths in the integral over λ between two places of its window
/// (ascending, in units of the spacing from the first wavelength). The axis has at least three
/// wavelengths.
pub(super) fn weights(axis: LogAxis, [from, to]: [f64; 2]) -> Vec<f64> {
    let mut weights = vec![0.0; axis.count()];
    for cell in from.floor() as i64..to.ceil() as i64 {
        let (start, end) = (from.max(cell as f64), to.min(cell as f64 + 1.0));
        let pieces = ((end - start) * axis.spacing() / PIECE).ceil().max(1.0);
        let half = 0.5 * (end - start) / pieces;
        for piece in 0..pieces as u32 {
            let middle = start + f64::from(2 * piece + 1) * half;
            for (node, share) in gauss() {
                let place = middle + half * node;
                // dλ = h λ d(place)
                let nm = share * half * axis.spacing() * axis.wavelength_nm(place);
                let taps = catmull_rom(place - cell as f64);
                for (tap, part) in (cell - 1..).zip(taps) {
                    add(&mut weights, tap, part * nm);
                }
            }
        }
    }
    weights
}

/// Adds to the weight of a wavelength or, if that lies beyond the ends, to the weights of the
/// parabola that continues the curve there.
fn add(weights: &mut [f64], j: i64, weight: f64) {
    let last = weights.len() as i64 - 1;
    debug_assert!(last >= 2, "a parabola goes through three points");
    let (end, inward, beyond) = if j < 0 {
        (0, 1, -j as f64)
    } else if j > last {
        (last, -1, (j - last) as f64)
    } else {
        weights[j as usize] += weight;
        return;
    };
    // Lagrange's polynomials of nodes 0, 1 and 2, counted inward, at −beyond.
    let parts = [
        (beyond + 1.0) * (beyond + 2.0) / 2.0,
        -beyond * (beyond + 2.0),
        beyond * (beyond + 1.0) / 2.0,
    ];
    for (step, part) in (0..).zip(parts) {
        weights[(end + step * inward) as usize] += weight * part;
    }
}

/// Nodes and weights of the Gauss-Legendre rule of five points on −1 to 1 (Abramowitz & Stegun
/// 1964, 25.4.30).
pub(super) fn gauss() -> [(f64, f64); 5] {
    let node = |sign: f64| (5.0 + sign * 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let share = |sign: f64| (322.0 - sign * 13.0 * 70.0_f64.sqrt()) / 900.0;
    [
        (-node(1.0), share(1.0)),
        (-node(-1.0), share(-1.0)),
        (0.0, 128.0 / 225.0),
        (node(-1.0), share(-1.0)),
        (node(1.0), share(1.0)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ λ^p dλ over the window, and what the weights make of λ^p.
    fn power(axis: LogAxis, p: i32) -> (f64, f64) {
        let [a, b] = axis.window_nm();
        let q = f64::from(p + 1);
        let exact = if p == -1 {
            (b / a).ln()
        } else {
            (b.powf(q) - a.powf(q)) / q
        };
        let whole = [-0.5, axis.count() as f64 - 0.5];
        let sum = axis
            .wavelengths_nm()
            .iter()
            .zip(weights(axis, whole))
            .map(|(nm, weight)| nm.powi(p) * weight)
            .sum();
        (exact, sum)
    }

    #[test]
    fn a_constant_is_integrated_exactly_however_wide_or_narrow_the_window() {
        for window in [
            [360.0, 830.0],
            [589.0, 589.001],
            [1e-9, 1e15],
            [1e-9, 1e-3],
            [1e7, 1e9],
        ] {
            for count in [8, 84, 100, 4096] {
                let (exact, sum) = power(LogAxis::new(window, count), 0);
                // The axis' own rounding: that of e^(count × spacing), and of narrow windows.
                let tolerance = 1e-13 + 1e-15 / (window[1] / window[0]).ln();
                assert!(
                    (sum / exact - 1.0).abs() < tolerance,
                    "{window:?} {count}: {:e}",
                    sum / exact - 1.0
                );
            }
        }
    }

    #[test]
    fn a_parabola_in_ln_lambda_is_integrated_exactly() {
        let axis = LogAxis::new([2.0, 32.0], 9);
        let whole = [-0.5, 8.5];
        let sum: f64 = axis
            .wavelengths_nm()
            .iter()
            .zip(weights(axis, whole))
            .map(|(nm, weight)| nm.ln().powi(2) * weight)
            .sum();
        // ∫ ln² λ dλ = λ (ln² λ − 2 ln λ + 2)
        let primitive = |nm: f64| nm * (nm.ln().powi(2) - 2.0 * nm.ln() + 2.0);
        let exact = primitive(32.0) - primitive(2.0);
        assert!((sum / exact - 1.0).abs() < 1e-14, "{sum} {exact}");
    }

    #[test]
    fn the_error_falls_with_the_fourth_power_of_the_spacing() {
        for p in [-5, -4, -1, 3] {
            let error = |count| {
                let (exact, sum) = power(LogAxis::new([1e7, 1e9], count), p);
                (sum / exact - 1.0).abs()
            };
            let errors = [84, 168, 336].map(error);
            assert!(errors[0] < 2e-3, "{p}: {errors:?}");
            assert!(errors[1] < errors[0] / 12.0 && errors[2] < errors[1] / 12.0);
        }
    }
}
