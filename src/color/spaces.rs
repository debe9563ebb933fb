//! Color spaces: CIE XYZ, linear Rec. 709, the sRGB transfer, CIE L*a*b*.
//!
//! RGB is linear, with (1, 1, 1) the D65 white of Y = 1. Matrices act on columns: `RGB_FROM_XYZ ·
//! xyz`.

/// A matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// Chromaticities x, y of Rec. 709's red, green and blue (ITU-R BT.709-6, item 1.3).
pub const PRIMARIES_XY: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// Chromaticity x, y of the D65 white (ITU-R BT.709-6, item 1.4).
pub const D65_XY: [f64; 2] = [0.3127, 0.3290];

/// XYZ of the D65 white at Y = 1.
pub const D65_XYZ: [f64; 3] = xyz_from_xy(D65_XY);

/// XYZ of linear Rec. 709 RGB; (1, 1, 1) gives [`D65_XYZ`].
pub const XYZ_FROM_RGB: Matrix = xyz_from_primaries(PRIMARIES_XY, D65_XY);

/// Linear Rec. 709 RGB of XYZ.
pub const RGB_FROM_XYZ: Matrix = inverse(XYZ_FROM_RGB);

/// Cone responses from XYZ, to be scaled by von Kries' rule (Lam 1985, in Lindbloom, Chromatic
/// Adaptation: the Bradford matrix).
const BRADFORD: Matrix = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// XYZ of a chromaticity, at Y = 1, or at X + Y + Z = 1 if y is 0.
const fn xyz_from_xy([x, y]: [f64; 2]) -> [f64; 3] {
    if y == 0.0 {
        [x, 0.0, 1.0 - x]
    } else {
        [x / y, 1.0, (1.0 - x - y) / y]
    }
}

/// XYZ of the RGB with these primaries and this white (x, y of each): the primaries' XYZ as
/// columns, each scaled so that together they make the white at Y = 1 (SMPTE RP 177-1993). Not
/// finite if the primaries lie on one line, or if the white's y is 0.
pub const fn xyz_from_primaries([r, g, b]: [[f64; 2]; 3], white: [f64; 2]) -> Matrix {
    let columns = transposed([xyz_from_xy(r), xyz_from_xy(g), xyz_from_xy(b)]);
    let amounts = apply(&inverse(columns), xyz_from_xy(white));
    let mut scaled = columns;
    let mut row = 0;
    while row < 3 {
        let mut column = 0;
        while column < 3 {
            scaled[row][column] *= amounts[column];
            column += 1;
        }
        row += 1;
    }
    scaled
}

const fn transposed([a, b, c]: Matrix) -> Matrix {
    [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
}

const fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

const fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

const fn scaled(a: [f64; 3], factor: f64) -> [f64; 3] {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// The inverse of an invertible matrix: cross products of its rows over its determinant.
pub const fn inverse([a, b, c]: Matrix) -> Matrix {
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let over = 1.0 / dot(a, bc);
    transposed([scaled(bc, over), scaled(ca, over), scaled(ab, over)])
}

/// A matrix times a column.
pub const fn apply(matrix: &Matrix, column: [f64; 3]) -> [f64; 3] {
    [
        dot(matrix[0], column),
        dot(matrix[1], column),
        dot(matrix[2], column),
    ]
}

/// The product a·b: `b` is applied first.
pub const fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let [x, y, z] = transposed(*b);
    transposed([apply(a, x), apply(a, y), apply(a, z)])
}

/// XYZ under the D65 white of a color with a given XYZ under another white (x, y), by Bradford's
/// chromatic adaptation: that white becomes D65 at the same Y, and grays stay gray.
pub fn d65_from_white(white: [f64; 2]) -> Matrix {
    let [from, to] = [xyz_from_xy(white), D65_XYZ].map(|xyz| apply(&BRADFORD, xyz));
    let mut scaled_cones = BRADFORD;
    for (i, row) in scaled_cones.iter_mut().enumerate() {
        *row = scaled(*row, to[i] / from[i]);
    }
    product(&inverse(BRADFORD), &scaled_cones)
}

/// The sRGB transfer, linear to encoded (IEC 61966-2-1): a straight piece, then a power of 1/2.4.
/// For 0 to 1; it continues above 1, and as an odd function below 0.
pub fn encode(linear: f64) -> f64 {
    let size = linear.abs();
    let encoded = if size <= 0.003_130_8 {
        12.92 * size
    } else {
        1.055 * size.powf(1.0 / 2.4) - 0.055
    };
    encoded.copysign(linear)
}

/// The sRGB transfer, encoded to linear: the inverse of [`encode`] (to 1e-7 where its pieces meet).
pub fn decode(encoded: f64) -> f64 {
    let size = encoded.abs();
    let linear = if size <= 0.040_45 {
        size / 12.92
    } else {
        ((size + 0.055) / 1.055).powf(2.4)
    };
    linear.copysign(encoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: &Matrix, expected: &Matrix, tolerance: f64) {
        for (row, wanted) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((row - wanted).abs() <= tolerance, "{found:?}");
        }
    }

    /// W3C, CSS Color Module Level 4, sample code for color conversions (same primaries and white).
    #[test]
    fn the_matrix_is_that_of_css_color_4() {
        let published = [
            [3.2409699419045226, -1.537383177570094, -0.4986107602930034],
            [-0.9692436362808796, 1.8759675015077202, 0.04155505740717559],
            [
                0.05563007969699366,
                -0.20397695888897652,
                1.0569715142428786,
            ],
        ];
        assert_near(&RGB_FROM_XYZ, &published, 1e-14);
    }

    /// IEC 61966-2-1 inverts a matrix rounded to four digits; hence its last digits.
    #[test]
    fn the_matrices_are_those_of_iec_61966_to_four_digits() {
        let rgb_from_xyz = [
            [3.2406, -1.5372, -0.4986],
            [-0.9689, 1.8758, 0.0415],
            [0.0557, -0.2040, 1.0570],
        ];
        let xyz_from_rgb = [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ];
        assert_near(&RGB_FROM_XYZ, &rgb_from_xyz, 4e-4);
        assert_near(&XYZ_FROM_RGB, &xyz_from_rgb, 5e-5);
    }

    /// colour-science's and the Academy's matrix from AP1 to Rec. 709 with Bradford (ACES, CTL of
    /// the Academy's 1.0 release; as in OpenColorIO's built-in configs).
    #[test]
    fn the_matrix_of_acescg_is_the_academys() {
        let ap1 = [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]];
        let white = [0.32168, 0.33767];
        let xyz = product(&d65_from_white(white), &xyz_from_primaries(ap1, white));
        let published = [
            [1.70505, -0.62179, -0.08326],
            [-0.13026, 1.14080, -0.01055],
            [-0.02400, -0.12897, 1.15297],
        ];
        assert_near(&product(&RGB_FROM_XYZ, &xyz), &published, 1e-4);
    }

    /// W3C, CSS Color Module Level 4, sample code: D50 to D65 by Bradford, of the same whites.
    #[test]
    fn the_adaptation_from_d50_is_that_of_css_color_4() {
        let published = [
            [
                0.9554734527042182,
                -0.023098536874261423,
                0.0632593086610217,
            ],
            [
                -0.028369706963208136,
                1.0099954580058226,
                0.021041398966943008,
            ],
            [
                0.012314001688319899,
                -0.020507696433477912,
                1.3303659366080753,
            ],
        ];
        assert_near(&d65_from_white([0.3457, 0.3585]), &published, 1e-6);
    }

    #[test]
    fn xyz_are_the_primaries_of_the_unit_matrix() {
        let axes = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_near(&xyz_from_primaries(axes, [1.0 / 3.0; 2]), &unit, 1e-15);
    }

    #[test]
    fn white_goes_to_white_and_back() {
        for (found, expected) in apply(&XYZ_FROM_RGB, [1.0; 3]).iter().zip(D65_XYZ) {
            assert!((found - expected).abs() < 1e-15);
        }
        assert!(
            apply(&RGB_FROM_XYZ, D65_XYZ)
                .iter()
                .all(|part| (part - 1.0).abs() < 2e-15)
        );
    }

    #[test]
    fn the_transfer_is_undone_and_meets_its_fixed_points() {
        assert_eq!((encode(0.0), decode(0.0)), (0.0, 0.0));
        assert!((encode(1.0) - 1.0).abs() < 1e-15 && (decode(1.0) - 1.0).abs() < 1e-15);
        // Code 188 of 255 is about half the light.
        assert!((decode(188.0 / 255.0) - 0.5029).abs() < 1e-4);
        for step in -1000..=2000 {
            let linear = f64::from(step) * 1e-3;
            assert!((decode(encode(linear)) - linear).abs() < 2e-7, "{linear}");
        }
    }
}
