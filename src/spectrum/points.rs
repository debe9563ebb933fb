//! Checks of the points of a curve, and its course beyond them.

use super::error::{MAX_ROWS, MAX_VALUE, SpectrumError};

/// The course of a curve outside its first and last point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Beyond {
    /// Constant, with the value at the end.
    #[default]
    Hold,
    /// Zero.
    Zero,
}

/// Checks that points can define a curve: at least one, not too many, ascending, each in range.
pub(super) fn check_points(points: &[(f64, f64)]) -> Result<(), SpectrumError> {
    if points.is_empty() {
        return Err(SpectrumError::NoPoints);
    }
    let mut previous = None;
    for (index, &point) in points.iter().enumerate() {
        check_next(index, previous, point)?;
        previous = Some(point);
    }
    Ok(())
}

/// Checks that a point may follow `previous` as number `index`, from 0.
fn check_next(
    index: usize,
    previous: Option<(f64, f64)>,
    (nm, value): (f64, f64),
) -> Result<(), SpectrumError> {
    let point = index + 1;
    if index >= MAX_ROWS {
        return Err(SpectrumError::TooMany);
    }
    if !nm.is_finite() || nm <= 0.0 {
        return Err(SpectrumError::Wavelength { point, found: nm });
    }
    if !(0.0..=MAX_VALUE).contains(&value) {
        return Err(SpectrumError::Value {
            point,
            nm,
            found: value,
        });
    }
    match previous {
        Some((before, _)) if nm <= before => Err(SpectrumError::Order {
            point,
            found: nm,
            before,
        }),
        _ => Ok(()),
    }
}
