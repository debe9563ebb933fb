//! Colors that a screen cannot show, brought into its gamut at the same hue and luminance.
//!
//! RGB is linear Rec. 709, 0 to 1 what the screen shows. Hue is that of OKLab (Ottosson 2020, "A
//! perceptual color space for image processing"), with the matrices of CSS Color 4. Along a line of
//! constant hue, saturation r = C/L alone decides the chromaticity, for OKLab is homogeneous of
//! degree 1/3: s·(L, a, b) is the color s³·RGB. So s follows from Y in closed form, and the largest
//! r that the screen shows is found by bisection.

use super::spaces::{D65_XYZ, Matrix, RGB_FROM_XYZ, XYZ_FROM_RGB, apply, inverse, product};

/// Cone responses of XYZ (CSS Color 4, § 18, `XYZtoLMS`).
const LMS_FROM_XYZ: Matrix = [
    [
        0.819_022_437_996_703,
        0.361_906_260_052_890_4,
        -0.128_873_781_520_987_9,
    ],
    [
        0.032_983_653_932_388_5,
        0.929_286_861_586_343_4,
        0.036_144_666_350_642_4,
    ],
    [
        0.048_177_189_359_624_2,
        0.264_239_531_752_730_8,
        0.633_547_828_469_430_9,
    ],
];

/// OKLab of the cube roots of cone responses (CSS Color 4, § 18, `LMStoOKLab`).
const LAB_FROM_ROOTS: Matrix = [
    [
        0.210_454_268_309_314,
        0.793_617_774_702_305_4,
        -0.004_072_043_011_619_3,
    ],
    [
        1.977_998_532_431_168_4,
        -2.428_592_242_048_58,
        0.450_593_709_617_411,
    ],
    [
        0.025_904_042_465_547_8,
        0.782_771_712_457_529_6,
        -0.808_675_754_923_077_4,
    ],
];

const LMS_FROM_RGB: Matrix = product(&LMS_FROM_XYZ, &XYZ_FROM_RGB);
const RGB_FROM_LMS: Matrix = product(&RGB_FROM_XYZ, &inverse(LMS_FROM_XYZ));
const ROOTS_FROM_LAB: Matrix = inverse(LAB_FROM_ROOTS);

/// Halvings of the interval of saturations: 2⁻³² of the color's own is far below a step of 16 bits.
const HALVINGS: u32 = 32;

/// The color of the same luminance and OKLab hue that the screen shows, as saturated as it can be.
///
/// A color within the gamut is returned as it is, bit for bit. One as bright as white or brighter is
/// white, one without luminance black. Components are finite; Y is kept within 1e-6, the distance of
/// the matrices' white from D65. 0.6 µs for a color that is brought in.
pub fn compressed(rgb: [f64; 3]) -> [f64; 3] {
    if is_shown(rgb) {
        return rgb;
    }
    let luminance = luminance(rgb);
    // NaN is black as well.
    if luminance.is_nan() || luminance <= 0.0 {
        return [0.0; 3];
    }
    if luminance >= 1.0 {
        return [1.0; 3];
    }
    let [lightness, a, b] = oklab(rgb);
    let gray = [luminance; 3];
    if lightness <= 0.0 {
        return gray;
    }
    let saturated = |r: f64| at_luminance([1.0, r * a / lightness, r * b / lightness], luminance);
    let (mut inside, mut outside) = (0.0, 1.0);
    let mut best = gray;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        match saturated(middle).filter(|&color| is_shown(color)) {
            Some(color) => (inside, best) = (middle, color),
            None => outside = middle,
        }
    }
    best
}

fn is_shown(rgb: [f64; 3]) -> bool {
    rgb.iter().all(|part| (0.0..=1.0).contains(part))
}

/// The color s³·RGB of an OKLab triple that has this luminance; None if the triple has none.
fn at_luminance(lab: [f64; 3], luminance: f64) -> Option<[f64; 3]> {
    let rgb = apply(
        &RGB_FROM_LMS,
        apply(&ROOTS_FROM_LAB, lab).map(|root| root.powi(3)),
    );
    let own = self::luminance(rgb);
    (own > 0.0).then(|| rgb.map(|part| part * (luminance / own)))
}

/// OKLab lightness L, and a and b, of a color.
fn oklab(rgb: [f64; 3]) -> [f64; 3] {
    apply(&LAB_FROM_ROOTS, apply(&LMS_FROM_RGB, rgb).map(f64::cbrt))
}

/// Y of a color, that of the screen's white 1.
fn luminance(rgb: [f64; 3]) -> f64 {
    apply(&XYZ_FROM_RGB, rgb)[1] / D65_XYZ[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie;
    use proptest::prelude::*;

    /// Table of XYZ and OKLab in Ottosson 2020, three decimals.
    #[test]
    fn oklab_is_that_of_its_author() {
        for (xyz, published) in [
            ([0.950, 1.0, 1.089], [1.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [0.450, 1.236, -0.019]),
            ([0.0, 1.0, 0.0], [0.922, -0.671, 0.263]),
            ([0.0, 0.0, 1.0], [0.153, -1.415, -0.449]),
        ] {
            let found = oklab(apply(&RGB_FROM_XYZ, xyz));
            let near = |(f, p): (f64, f64)| (f - p).abs() < 1e-3;
            assert!(
                found.into_iter().zip(published).all(near),
                "{xyz:?} {found:?}"
            );
        }
    }

    #[test]
    fn white_light_has_no_chroma() {
        let [lightness, a, b] = oklab([1.0; 3]);
        assert!(
            (lightness - 1.0).abs() < 1e-6 && a.hypot(b) < 1e-6,
            "{lightness} {a} {b}"
        );
    }

    /// Angle between the hues of two colors.
    fn hue_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
        let [[_, x, y], [_, u, v]] = [a, b].map(oklab);
        (x * v - y * u).atan2(x * u + y * v).abs()
    }

    fn assert_compressed(rgb: [f64; 3]) {
        let shown = compressed(rgb);
        assert!(is_shown(shown), "{rgb:?} {shown:?}");
        let given = luminance(rgb);
        assert!(
            (luminance(shown) - given.clamp(0.0, 1.0)).abs() < 1e-6,
            "{rgb:?} {shown:?}"
        );
        assert_eq!(compressed(shown), shown);
        if (0.0..1.0).contains(&given) && !is_shown(rgb) {
            let [_, a, b] = oklab(shown);
            assert!(
                a.hypot(b) < 1e-4 || hue_difference(rgb, shown) < 1e-4,
                "{rgb:?} {shown:?}"
            );
            // As saturated as the screen goes: at a face of the cube.
            let edge = |part: &f64| part.min(1.0 - part) < 1e-6;
            assert!(shown.iter().any(edge), "{rgb:?} {shown:?}");
        }
    }

    /// Lines of the spectrum are the most saturated colors that there are.
    #[test]
    fn lines_of_the_spectrum_keep_hue_and_luminance() {
        for nm in (380..=700).step_by(5) {
            for brightness in [1e-6, 0.01, 0.3, 0.9, 3.0] {
                let xyz = cie::xyz_bar(f64::from(nm));
                let total: f64 = xyz.iter().sum();
                assert_compressed(apply(&RGB_FROM_XYZ, xyz.map(|v| v / total * brightness)));
            }
        }
    }

    #[test]
    fn colors_of_the_screen_stay_bit_for_bit() {
        for rgb in [[0.0; 3], [1.0; 3], [1.0, 0.0, 0.0], [0.2, 0.999, 1e-300]] {
            assert_eq!(compressed(rgb), rgb);
        }
    }

    #[test]
    fn beyond_white_is_white_and_without_light_black() {
        assert_eq!(compressed([2.0, 2.0, 2.0]), [1.0; 3]);
        assert_eq!(compressed([f64::MAX, 0.0, 0.0]), [1.0; 3]);
        assert_eq!(compressed([-1.0, 0.0, -1e-9]), [0.0; 3]);
        assert_eq!(compressed([f64::NAN, 0.0, 0.0]), [0.0; 3]);
    }

    proptest! {
        /// Real colors: mixtures of three lines.
        #[test]
        fn mixtures_keep_hue_and_luminance(
            lines in prop::array::uniform3((380.0..700.0f64, 0.0..1.0f64)),
        ) {
            let mut xyz = [0.0; 3];
            for (nm, power) in lines {
                let line = cie::xyz_bar(nm);
                (0..3).for_each(|i| xyz[i] += power * line[i]);
            }
            assert_compressed(apply(&RGB_FROM_XYZ, xyz));
        }

        /// No hard edges: neighbors stay neighbors, in Y and in chromaticity.
        #[test]
        fn a_color_at_the_edge_of_the_screen_moves_little(
            [r, g] in prop::array::uniform2(0.05..0.6f64), out in 1e-9..1e-4f64,
        ) {
            let shown = compressed([r, g, -out]);
            let moved = [r - shown[0], g - shown[1], shown[2]];
            prop_assert!(moved.iter().all(|part| part.abs() < 30.0 * out), "{moved:?}");
        }
    }
}
