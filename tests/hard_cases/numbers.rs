//! Numbers that a case needs beside the program's: sums in twice the precision, determinants,
//! angles, chance.

use glam::{DMat4, DVec3, DVec4};
use restframe::relativity::FourVector;

/// The columns of a linear map of four-vectors (t last).
pub(crate) fn columns(map: impl Fn(FourVector) -> FourVector) -> DMat4 {
    let column = |t: f64, x: DVec3| {
        let v = map(FourVector::new(t, x));
        v.x.extend(v.t)
    };
    DMat4::from_cols(
        column(0.0, DVec3::X),
        column(0.0, DVec3::Y),
        column(0.0, DVec3::Z),
        column(1.0, DVec3::ZERO),
    )
}

/// aᵀηb as if summed in twice the precision (Ogita, Rump & Oishi 2005).
pub(crate) fn product(a: DVec4, b: DVec4) -> f64 {
    let (mut sum, mut rest) = (0.0, 0.0);
    for (x, y) in [(a.x, b.x), (a.y, b.y), (a.z, b.z), (-a.w, b.w)] {
        let term: f64 = x * y;
        let grown: f64 = sum + term;
        let shift = grown - sum;
        rest += (sum - (grown - shift)) + (term - shift) + x.mul_add(y, -term);
        sum = grown;
    }
    sum + rest
}

/// The largest entry of |LᵀηL − η|.
pub(crate) fn off_metric(map: &DMat4) -> f64 {
    let eta = |i: usize, j: usize| match (i == j, i) {
        (false, _) => 0.0,
        (true, 3) => -1.0,
        (true, _) => 1.0,
    };
    let entries = (0..16).map(|k| (k / 4, k % 4));
    entries
        .map(|(i, j)| (product(map.col(i), map.col(j)) - eta(i, j)).abs())
        .fold(0.0, f64::max)
}

/// The determinant by elimination with full pivoting: entries of a boost are of the size of γ and
/// their products cancel down to 1, which expansion by minors would not survive.
pub(crate) fn determinant(map: &DMat4) -> f64 {
    let mut m = map.to_cols_array_2d();
    let mut determinant = 1.0;
    for k in 0..4 {
        let places = (k..4).flat_map(|i| (k..4).map(move |j| (i, j)));
        let (row, column) = places
            .max_by(|a, b| m[a.0][a.1].abs().total_cmp(&m[b.0][b.1].abs()))
            .unwrap();
        if row != k {
            m.swap(row, k);
            determinant = -determinant;
        }
        if column != k {
            m.iter_mut().for_each(|r| r.swap(column, k));
            determinant = -determinant;
        }
        let pivot = m[k];
        determinant *= pivot[k];
        for row in m.iter_mut().skip(k + 1) {
            let share = row[k] / pivot[k];
            for (value, above) in row.iter_mut().zip(pivot) {
                *value = (-share).mul_add(above, *value);
            }
        }
    }
    determinant
}

/// Reproducible numbers from 0 to 1 (SplitMix64: Steele, Lea & Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In the cube |x|, |y|, |z| ≤ 1.
    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::from([(); 3].map(|()| 2.0 * self.next() - 1.0))
    }
}

/// The angle between two vectors, also where it is small.
pub(crate) fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
