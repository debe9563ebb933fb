//! The CIE's tables of power as curves. D65 is the white of colors.

use super::{Beyond, Sampled};
use crate::color::tables::{self, Uniform};

/// Wavelength at which every illuminant is 1, nm.
pub const UNIT_AT_NM: f64 = 560.0;

/// D65, daylight of 6504 K: the white of sRGB.
pub(super) fn d65() -> Sampled {
    relative(&tables::D65)
}

/// A table as a curve that is 1 at [`UNIT_AT_NM`].
pub(super) fn relative(table: &Uniform) -> Sampled {
    let unit = table.values[((UNIT_AT_NM - table.start_nm) / table.step_nm) as usize];
    let point = |(index, value): (usize, &f64)| {
        (table.start_nm + index as f64 * table.step_nm, value / unit)
    };
    let points: Vec<_> = table.values.iter().enumerate().map(point).collect();
    Sampled::new(&points, Beyond::Hold).expect("the tables ascend and hold no negative value")
}
