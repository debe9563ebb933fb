//! Spectra as their author writes them: by name, as a number, or as a table of one of seven kinds.
//! Wavelengths in nanometers, temperatures in kelvins.

use super::Track;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Wherever a spectrum stands: a name, a number, or a table inline.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum SpectrumValue {
    /// The same at every wavelength.
    Number(Track<f64>),
    /// The name of a `[spectrum.NAME]` or of an illuminant.
    Name(String),
    /// A spectrum written where it is used.
    Table(Box<SpectrumTable>),
}

/// `[spectrum.NAME]` or the same inline: exactly one of the kinds, and what belongs to it.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpectrumTable {
    /// Kind: cardinal cubic spline through (nm, value) points, wavelengths above 0 and strictly ascending, values at least 0.
    #[schemars(length(min = 2))]
    pub points: Option<Vec<[f64; 2]>>,
    /// Tension of the spline through `points`, from 0 (Catmull-Rom) to 1 (flat at every point). Default: 0.
    #[schemars(range(min = 0, max = 1))]
    pub tension: Option<f64>,
    /// Kind: the same value, at least 0, at every wavelength.
    #[schemars(extend("minimum" = 0))]
    pub constant: Option<Track<f64>>,
    /// Kind: Planck's curve at this temperature, K, above 0; 1 at 560 nm or at `unit_at`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub blackbody: Option<Track<f64>>,
    /// Wavelength at which `blackbody` is 1, nm, above 0. Default: 560.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub unit_at: Option<f64>,
    /// Kind: a CIE illuminant by name, such as "D65" or "A"; 1 at 560 nm.
    pub illuminant: Option<String>,
    /// Kind: a smooth spectrum of this linear sRGB color, each component from 0 to 1.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub rgb: Option<Track<[f64; 3]>>,
    /// Kind: a bell { center, width } in nm with peak 1.
    pub gaussian: Option<Gaussian>,
    /// Kind: a CSV file of wavelengths (nm, or in the unit that its header names) and values, relative to the shot file.
    pub file: Option<PathBuf>,
    /// What lies beyond the first and last wavelength of `points`, `file`, `rgb` or `illuminant`. Default: "hold".
    pub beyond: Option<Beyond>,
}

/// A bell over the wavelengths: exp(−(λ − center)²/(2 width²)).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gaussian {
    /// Wavelength of the peak, nm, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub center: Track<f64>,
    /// Standard deviation, nm, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub width: Track<f64>,
}

/// What a spectrum is beyond its first and last wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Beyond {
    /// The value at the end goes on.
    Hold,
    /// Zero.
    Zero,
}
