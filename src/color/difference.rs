//! CIEDE2000: the perceived difference of two colors.
//!
//! G. Sharma, W. Wu, E. N. Dalal, "The CIEDE2000 color-difference formula: implementation notes,
//! supplementary test data, and mathematical observations", Color Res. Appl. 30 (2005) 21–30;
//! equation numbers are theirs. CIELAB: CIE 15:2004, 8.2.1. Angles are in degrees here.

/// A color in CIELAB: L* (0 black to 100 white), a*, b*.
pub type Lab = [f64; 3];

/// Hue angles whose difference is within this of 180° count as exactly opposite, whatever rounding
/// did.
const OPPOSITE_TOLERANCE_DEG: f64 = 1e-9;

/// CIELAB from tristimulus values. `white` is the reference white in the same unit (CIE 15:2004).
pub fn lab_from_xyz(xyz: [f64; 3], white: [f64; 3]) -> Lab {
    const DELTA: f64 = 6.0 / 29.0;
    let response = |index: usize| {
        let ratio = xyz[index] / white[index];
        if ratio > DELTA.powi(3) {
            ratio.cbrt()
        } else {
            ratio / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    };
    let [fx, fy, fz] = [response(0), response(1), response(2)];
    [116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)]
}

/// The color difference ΔE₀₀ with k_L = k_C = k_H = 1 (eq. 22). 1 is just visible; meant for
/// differences up to about 5, only roughly monotonic beyond.
pub fn delta_e_2000(a: Lab, b: Lab) -> f64 {
    let mean_chroma = (a[1].hypot(a[2]) + b[1].hypot(b[2])) / 2.0;
    let stretch = 1.5 - 0.5 * chroma_weight(mean_chroma); // 1 + G, eq. 4–5
    let (chroma_a, hue_a) = polar(stretch * a[1], a[2]);
    let (chroma_b, hue_b) = polar(stretch * b[1], b[2]);
    let gray = chroma_a * chroma_b == 0.0;

    let delta_hue = if gray {
        0.0
    } else {
        hue_difference(hue_a, hue_b)
    };
    let delta_l = b[0] - a[0];
    let delta_c = chroma_b - chroma_a;
    let delta_h = 2.0 * (chroma_a * chroma_b).sqrt() * sin(delta_hue / 2.0); // eq. 11

    let mean_l = (a[0] + b[0]) / 2.0;
    let mean_c = (chroma_a + chroma_b) / 2.0;
    let mean_h = if gray {
        hue_a + hue_b
    } else {
        mean_hue(hue_a, hue_b)
    };

    let t =
        1.0 - 0.17 * cos(mean_h - 30.0) + 0.24 * cos(2.0 * mean_h) + 0.32 * cos(3.0 * mean_h + 6.0)
            - 0.20 * cos(4.0 * mean_h - 63.0); // eq. 15
    let theta = 30.0 * (-((mean_h - 275.0) / 25.0).powi(2)).exp(); // eq. 16
    let off_middle = (mean_l - 50.0).powi(2);
    let s_l = 1.0 + 0.015 * off_middle / (20.0 + off_middle).sqrt(); // eq. 18
    let s_c = 1.0 + 0.045 * mean_c; // eq. 19
    let s_h = 1.0 + 0.015 * mean_c * t; // eq. 20
    let rotation = -2.0 * chroma_weight(mean_c) * sin(2.0 * theta); // R_T, eq. 17, 21

    let [l, c, h] = [delta_l / s_l, delta_c / s_c, delta_h / s_h];
    (l * l + c * c + h * h + rotation * c * h).max(0.0).sqrt()
}

/// √(C⁷ / (C⁷ + 25⁷)), from 0 for grays to 1 (eq. 4, 17).
fn chroma_weight(chroma: f64) -> f64 {
    let seventh = chroma.powi(7);
    (seventh / (seventh + 25_f64.powi(7))).sqrt()
}

/// Chroma and hue angle, 0 to 360; the hue of gray is 0 (eq. 6–7).
fn polar(a: f64, b: f64) -> (f64, f64) {
    let hue = if a == 0.0 && b == 0.0 {
        0.0
    } else {
        b.atan2(a).to_degrees()
    };
    (a.hypot(b), if hue < 0.0 { hue + 360.0 } else { hue })
}

/// Hue difference from `a` to `b` the short way round, −180 to 180 (eq. 10).
fn hue_difference(a: f64, b: f64) -> f64 {
    let direct = b - a;
    if direct.abs() <= 180.0 + OPPOSITE_TOLERANCE_DEG {
        direct
    } else {
        direct - 360.0 * direct.signum()
    }
}

/// Mean of two hues, on the short side (eq. 14).
fn mean_hue(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if (a - b).abs() <= 180.0 + OPPOSITE_TOLERANCE_DEG {
        sum / 2.0
    } else if sum < 360.0 {
        (sum + 360.0) / 2.0
    } else {
        (sum - 360.0) / 2.0
    }
}

fn sin(degrees: f64) -> f64 {
    degrees.to_radians().sin()
}

fn cos(degrees: f64) -> f64 {
    degrees.to_radians().cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::spaces::{D65_XYZ, XYZ_FROM_RGB};

    /// Table 1 of Sharma, Wu, Dalal (2005), rounded there to four places:
    /// two colours and their ΔE₀₀.
    const PUBLISHED: [(Lab, Lab, f64); 34] = [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
        ([50.0, 2.8361, -74.0200], [50.0, 0.0, -82.7485], 3.4412),
        ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, -1.1848, -84.8006], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, -0.9009, -85.5211], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
        ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.3669),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0010], 7.1792),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0011], 7.2195),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0012], 7.2195),
        ([50.0, -0.001, 2.49], [50.0, 0.0009, -2.49], 4.8045),
        ([50.0, -0.001, 2.49], [50.0, 0.0010, -2.49], 4.8045),
        ([50.0, -0.001, 2.49], [50.0, 0.0011, -2.49], 4.7461),
        ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
        ([50.0, 2.5, 0.0], [56.0, -27.0, -3.0], 31.9030),
        ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
        ([50.0, 2.5, 0.0], [50.0, 3.1736, 0.5854], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 3.2972, 0.0], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 1.8634, 0.5757], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 3.2592, 0.3350], 1.0),
        (
            [60.2574, -34.0099, 36.2677],
            [60.4626, -34.1751, 39.4387],
            1.2644,
        ),
        (
            [63.0109, -31.0961, -5.8663],
            [62.8187, -29.7946, -4.0864],
            1.2630,
        ),
        (
            [61.2901, 3.7196, -5.3901],
            [61.4292, 2.2480, -4.9620],
            1.8731,
        ),
        (
            [35.0831, -44.1164, 3.7933],
            [35.0232, -40.0716, 1.5901],
            1.8645,
        ),
        (
            [22.7233, 20.0904, -46.6940],
            [23.0331, 14.9730, -42.5619],
            2.0373,
        ),
        (
            [36.4612, 47.8580, 18.3852],
            [36.2715, 50.5065, 21.2231],
            1.4146,
        ),
        (
            [90.8027, -2.0831, 1.4410],
            [91.1528, -1.6435, 0.0447],
            1.4441,
        ),
        (
            [90.9257, -0.5406, -0.9208],
            [88.6381, -0.8985, -0.7239],
            1.5381,
        ),
        (
            [6.7747, -0.2908, -2.4247],
            [5.8714, -0.0985, -2.2286],
            0.6377,
        ),
        (
            [2.0776, 0.0795, -1.1350],
            [0.9033, -0.0636, -0.5514],
            0.9082,
        ),
    ];
    /// Half a unit of the table's last place, and a hair for rounding.
    const TABLE_TOLERANCE: f64 = 0.50001e-4;

    #[test]
    fn the_published_pairs_have_their_published_difference_both_ways() {
        for (index, (a, b, expected)) in PUBLISHED.into_iter().enumerate() {
            for found in [delta_e_2000(a, b), delta_e_2000(b, a)] {
                let error = (found - expected).abs();
                assert!(
                    error < TABLE_TOLERANCE,
                    "pair {}: {found} for {expected}",
                    index + 1
                );
            }
        }
    }

    #[test]
    fn equal_colors_do_not_differ() {
        for (a, b, _) in PUBLISHED {
            assert_eq!(delta_e_2000(a, a), 0.0);
            assert_eq!(delta_e_2000(b, b), 0.0);
        }
    }

    #[test]
    fn the_reference_white_is_100_and_black_0() {
        let white = [0.95, 1.0, 1.09];
        assert_eq!(lab_from_xyz([0.0; 3], white), [0.0; 3]);
        assert_eq!(lab_from_xyz(white, white), [100.0, 0.0, 0.0]);
    }

    #[test]
    fn lightness_is_continuous_where_the_cube_root_begins() {
        let lightness = |y: f64| lab_from_xyz([0.0, y, 0.0], [1.0; 3])[0];
        let edge = (6.0_f64 / 29.0).powi(3);
        assert!((lightness(edge * (1.0 + 1e-12)) - lightness(edge)).abs() < 1e-9);
        assert!((lightness(edge) - 8.0).abs() < 1e-9);
    }

    #[test]
    fn lab_of_white_and_of_a_published_color() {
        assert_eq!(lab_from_xyz(D65_XYZ, D65_XYZ), [100.0, 0.0, 0.0]);
        assert_eq!(lab_from_xyz([0.0; 3], D65_XYZ), [0.0, 0.0, 0.0]);
        // sRGB red: L* 53.24, a* 80.09, b* 67.20 (Lindbloom's calculator, D65).
        let [l, a, b] = lab_from_xyz(
            crate::color::spaces::apply(&XYZ_FROM_RGB, [1.0, 0.0, 0.0]),
            D65_XYZ,
        );
        assert!((l - 53.24).abs() < 0.01 && (a - 80.09).abs() < 0.02 && (b - 67.20).abs() < 0.02);
    }
}
