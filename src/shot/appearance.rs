//! What surfaces look like: materials and spectra. Wavelengths in nanometres, temperatures in
//! kelvins, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹ in the rest frame of what emits or reflects.
//!
//! In every term each key is optional: where the file has a material of this name, given keys
//! replace and the rest stays; otherwise the defaults hold.

use super::Track;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[material.NAME]`: the terms of a material. A term that is not named is not there.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Material {
    /// Lambertian reflection. Default: none.
    pub diffuse: Option<Diffuse>,
    /// Blurred reflection of lights. Default: none.
    pub highlight: Option<Highlight>,
    /// Ideal reflection. Default: none.
    pub mirror: Option<Mirror>,
    /// Ideal refraction. Default: none.
    pub refraction: Option<Refraction>,
    /// Cold light of its own. Default: none.
    pub emission: Option<Emission>,
    /// Thermal light. Default: none.
    pub thermal: Option<Thermal>,
}

/// The spectra of a material's terms, with their keys, borrowed one way or the other.
macro_rules! of_terms {
    ($material:ident, $borrowed:ident, $($by:tt)+) => {{
        let Self {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission,
            thermal,
        } = $material;
        [
            ("diffuse.spectrum", diffuse.$borrowed().map(|t| $($by)+ t.spectrum)),
            ("highlight.spectrum", highlight.$borrowed().map(|t| $($by)+ t.spectrum)),
            ("mirror.spectrum", mirror.$borrowed().map(|t| $($by)+ t.spectrum)),
            ("refraction.spectrum", refraction.$borrowed().map(|t| $($by)+ t.spectrum)),
            ("emission.spectrum", emission.$borrowed().map(|t| $($by)+ t.spectrum)),
            ("thermal.emissivity", thermal.$borrowed().map(|t| $($by)+ t.emissivity)),
        ]
        .into_iter()
        .filter_map(|(key, value)| Some((key, value?)))
    }};
}

impl Material {
    /// The spectra of its terms, each with its key below the material's; all that there are, or
    /// a file that one names would not be read.
    pub fn spectra(&self) -> impl Iterator<Item = (&'static str, &Option<SpectrumValue>)> {
        of_terms!(self, as_ref, &)
    }

    /// The same, to be changed.
    pub(super) fn spectra_mut(
        &mut self,
    ) -> impl Iterator<Item = (&'static str, &mut Option<SpectrumValue>)> {
        of_terms!(self, as_mut, &mut)
    }
}

/// Lambertian reflection: L = ρE/π with the reflectance ρ = weight × spectrum.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Diffuse {
    /// Factor on `spectrum`, at least 0; weight × spectrum is a reflectance, at most 1. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub weight: Option<Track<f64>>,
    /// Reflectance at weight 1, from 0 to 1. Required, unless the model file's material has one.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
}

/// Blurred reflection of lights: adds weight × spectrum × (n + 8)/(8π) × (N·H)ⁿ to the BRDF.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Highlight {
    /// Factor on `spectrum`, at least 0; weight × spectrum is a reflectance, at most 1. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub weight: Option<Track<f64>>,
    /// Reflectance at weight 1, from 0 to 1. Required, unless the model file's material has one.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
    /// The exponent n, at least 0: the larger, the sharper. Default: 40.
    #[schemars(extend("minimum" = 0, "maximum" = 1e9))]
    pub exponent: Option<Track<f64>>,
}

/// Ideal reflection.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mirror {
    /// Factor on `spectrum`, at least 0; weight × spectrum is a reflectance, at most 1. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub weight: Option<Track<f64>>,
    /// Reflectance at weight 1, from 0 to 1. Required, unless the model file's material has one.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
}

/// Ideal refraction.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Refraction {
    /// Factor on `spectrum`, at least 0; weight × spectrum is a transmittance, at most 1. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub weight: Option<Track<f64>>,
    /// Transmittance at weight 1, from 0 to 1. Required.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
    /// Index of refraction, at least 1. Default: 1.5.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub ior: Option<Track<f64>>,
}

/// Cold light: scale × spectrum is the spectral radiance, W·m⁻²·sr⁻¹·nm⁻¹.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Emission {
    /// Factor on `spectrum`, at least 0. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub scale: Option<Track<f64>>,
    /// Spectral radiance at scale 1, W·m⁻²·sr⁻¹·nm⁻¹, at least 0. Required, unless the model file's
    /// material has one.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
}

/// Thermal light: Planck's curve times the emissivity.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Thermal {
    /// Temperature, K, at least 0. Default: 0.
    #[schemars(extend("minimum" = 0))]
    pub temperature: Option<Track<f64>>,
    /// Emissivity, from 0 to 1. Default: 1.0.
    #[schemars(extend("minimum" = 0))]
    pub emissivity: Option<SpectrumValue>,
    /// Whether the radiance is Planck's or scaled by its peak. Default: "absolute".
    pub curve: Option<ThermalCurve>,
    /// Peak spectral radiance with curve = "peak", W·m⁻²·sr⁻¹·nm⁻¹, at least 0. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub strength: Option<Track<f64>>,
}

/// How strong thermal light is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ThermalCurve {
    /// As Planck's law has it.
    Absolute,
    /// Planck's curve scaled so that its peak is `strength`.
    Peak,
}

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
