//! Errors of numbers that do not make a curve, and the limits of those that do.

/// Number of rows that a file may have.
pub const MAX_ROWS: usize = 1_000_000;

/// Greatest value of a point: sums and differences of a few stay finite.
pub const MAX_VALUE: f64 = 1e300;

/// Reason why numbers do not make a curve. Points are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// The list or file is empty.
    #[error("there are no points: a curve needs at least one")]
    NoPoints,
    /// There are more than [`MAX_ROWS`] points.
    #[error("there are more than {} points", MAX_ROWS)]
    TooMany,
    /// A point's wavelength is not positive and finite.
    #[error("the wavelength of point {point} is {found} nm: it must be finite and greater than 0")]
    Wavelength {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        found: f64,
    },
    /// A point's value is negative, NaN or too large.
    #[error(
        "the value of point {point} (at {nm} nm) is {found}: it must be from 0 to {:e}",
        MAX_VALUE
    )]
    Value {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        nm: f64,
        /// Its value.
        found: f64,
    },
    /// Wavelengths do not ascend.
    #[error(
        "point {point} is at {found} nm, the one before at {before} nm: wavelengths must ascend"
    )]
    Order {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        found: f64,
        /// The previous point's, nm.
        before: f64,
    },
    /// A spline's tension is out of range.
    #[error("the tension is {found}: it must be from 0 to 1")]
    Tension {
        /// The value given.
        found: f64,
    },
    /// A temperature is negative or not finite.
    #[error("the temperature is {found} K: it must be finite and at least 0")]
    Temperature {
        /// The value given, K.
        found: f64,
    },
    /// The wavelength at which a black body's curve is to be 1 is not positive and finite.
    #[error(
        "a black body's curve cannot be 1 at {found} nm: the wavelength must be greater than 0"
    )]
    UnitAt {
        /// The value given, nm.
        found: f64,
    },
    /// A gaussian's center is not finite.
    #[error("the center is {found} nm: it must be finite")]
    Center {
        /// The value given, nm.
        found: f64,
    },
    /// A gaussian's width is not positive and finite.
    #[error("the width is {found} nm: it must be finite and greater than 0")]
    Width {
        /// The value given, nm.
        found: f64,
    },
    /// A color's component is negative, NaN or too large.
    #[error(
        "the {channel} component is {found}: it must be from 0 to {:e}",
        MAX_VALUE
    )]
    Component {
        /// "red", "green" or "blue".
        channel: &'static str,
        /// The value given.
        found: f64,
    },
}
