//! Faults of a measured table, and warnings about its interpretation.

use super::unit::Unit;
use crate::spectrum::{MAX_ROWS, MAX_VALUE};
use std::fmt;

/// Largest amount below 0 of a value, relative to the greatest: instruments have noise of a few
/// hundredths where there is no light.
pub const NOISE: f64 = 0.05;

/// A doubt about the interpretation of a table. Messages continue "FILE: ".
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum TableWarning {
    /// Columns after the second.
    Columns {
        /// Names or numbers of the columns that are left out.
        left_out: String,
    },
    /// Values below 0, as noise has them.
    Negative {
        /// Number of values.
        count: usize,
        /// The least of them.
        least: f64,
    },
    /// A first column that is not in nm.
    Converted {
        /// Its unit.
        unit: Unit,
    },
    /// Values that are neither fractions of 1 nor per nm.
    Values {
        /// Name of their column.
        name: String,
    },
    /// Without a unit, and with no point near the sensor's window.
    Far {
        /// First and last wavelength, as read, nm.
        points: [f64; 2],
        /// The sensor's window, nm.
        window: [f64; 2],
    },
}

impl fmt::Display for TableWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Columns { left_out } => write!(
                f,
                "the first two columns are read, {left_out} not: to read another, save it as the second"
            ),
            Self::Negative { count, least } => write!(
                f,
                "{count} of its values are below 0, the least {least}: they are taken for noise, as 0"
            ),
            Self::Converted { unit } => write!(
                f,
                "its first column is in {unit}, and is converted to nm; its values are left as they are, which is right for reflectances and the like: turn a density per {unit} into one per nm first"
            ),
            Self::Values { name } => write!(
                f,
                "its header calls the values `{name}`, and they are taken as they are, as parts of 1 or per nm: convert them, or let `scale` do it"
            ),
            Self::Far {
                points: [first, last],
                window: [from, to],
            } => write!(
                f,
                "its header names no unit, and its points, from {first} to {last}, are read as nm, far from the sensor's window of {from} to {to} nm: name the unit in the first line, as in `wavelength (µm), value`"
            ),
        }
    }
}

/// Reason why a table is not a curve. Lines are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// There is no row.
    #[error(
        "there is no row of numbers: expected rows of wavelength and value, such as `400, 0.5`"
    )]
    NoRows,
    /// More than [`MAX_ROWS`].
    #[error("there are more than {MAX_ROWS} rows")]
    TooMany,
    /// The unit of the first column is unknown.
    #[error(
        "line {line}: the unit of the first column, `{found}`, is not known: expected nm, µm, Å, mm, m, cm-1, eV, Hz or THz, as in `wavelength (nm), value`"
    )]
    Unit {
        /// Which line.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// The wavelength is not the first column.
    #[error(
        "line {line}: column {column} is `{name}`, and the wavelength must be column 1: save it as the first"
    )]
    Swapped {
        /// Which line.
        line: usize,
        /// Which column, from 1.
        column: usize,
        /// Its name.
        name: String,
    },
    /// A field is not a number.
    #[error(
        "line {line}: expected a number, found `{found}`: leave the line out, or put # before it"
    )]
    Number {
        /// Which line.
        line: usize,
        /// The field.
        found: String,
    },
    /// A row has one field.
    #[error("line {line}: expected two columns, wavelength and value, found {found}")]
    Columns {
        /// Which line.
        line: usize,
        /// How many fields there are.
        found: usize,
    },
    /// Commas may be decimal signs.
    #[error(
        "line {line}: expected two columns, wavelength and value, found {found} of whole numbers: where the comma is the decimal sign, part the columns by semicolons; otherwise name the columns in the first line"
    )]
    DecimalCommas {
        /// Which line.
        line: usize,
        /// How many fields there are.
        found: usize,
    },
    /// A wavelength is not positive and finite.
    #[error("line {line}: the wavelength is {found}: it must be finite and greater than 0")]
    Wavelength {
        /// Which line.
        line: usize,
        /// What stands there.
        found: f64,
    },
    /// A value is NaN, infinite or too large.
    #[error(
        "line {line}: the value is {found}: it must be from 0 to {MAX_VALUE:e}; leave out rows without one"
    )]
    Value {
        /// Which line.
        line: usize,
        /// What stands there.
        found: f64,
    },
    /// A value is too far below 0 to be noise.
    #[error(
        "line {line}: the value is {found}: it must be at least 0; down to {} of the greatest, which is {greatest}, is taken for noise: subtract the dark measurement, or write 0", -NOISE
    )]
    Negative {
        /// Which line.
        line: usize,
        /// What stands there.
        found: f64,
        /// The greatest value.
        greatest: f64,
    },
    /// Wavelengths neither ascend nor descend.
    #[error(
        "line {line}: {found} does not follow {before}: sort the rows by wavelength, each in one row"
    )]
    Order {
        /// Which line.
        line: usize,
        /// What stands there.
        found: f64,
        /// The value in the row before.
        before: f64,
    },
}
