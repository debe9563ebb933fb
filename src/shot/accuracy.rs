//! `[accuracy]`: approximations, and how fine they are. `restframe study` measures time and error of
//! each key; the presets follow from its results.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Accuracy of an image, with a value for every key of `[accuracy]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "AccuracyKeys")]
pub struct Accuracy {
    /// Representation of spectra.
    pub spectra: Spectra,
    /// Number of wavelengths over the sensor's window, in equal ratios.
    pub wavelengths: u32,
    /// Distance of spectral lines, nm.
    pub line_spacing: f64,
    /// Share of mirrored and refracted light below which it is not followed.
    pub cutoff: f64,
}

impl Default for Accuracy {
    fn default() -> Self {
        Preset::Normal.accuracy()
    }
}

/// A set of values for all keys of `[accuracy]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// The cheapest whose colors stay within 0.5 (CIEDE2000) of exact ones, but for rare pixels.
    Draft,
    /// The cheapest whose colors stay within 0.1, but for rare pixels: the defaults.
    #[default]
    Normal,
    /// Exact spectra, and mirrors followed until nothing is left: for checking others.
    Reference,
}

impl Preset {
    /// The values of the preset.
    pub fn accuracy(self) -> Accuracy {
        let normal = Accuracy {
            spectra: Spectra::Grid,
            wavelengths: 84,
            line_spacing: 5.0,
            cutoff: 1e-4,
        };
        match self {
            Self::Draft => Accuracy {
                wavelengths: 42,
                cutoff: 1e-2,
                ..normal
            },
            Self::Normal => normal,
            Self::Reference => Accuracy {
                spectra: Spectra::Exact,
                cutoff: 0.0,
                ..normal
            },
        }
    }
}

/// `[accuracy]` as its author wrote it; the preset gives the keys that are left out.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(rename = "Accuracy")]
pub struct AccuracyKeys {
    /// What the other keys are where they are not given. Default: "normal".
    pub preset: Preset,
    /// How curves are held. Default: "grid".
    pub spectra: Option<Spectra>,
    /// Wavelengths over the sensor's window, in equal ratios, from 8 to 4096: what is finer than their spacing is lost. Default: 84.
    #[schemars(range(min = 8, max = 4096))]
    pub wavelengths: Option<u32>,
    /// Distance of the lines that spectra = "lines" holds from 50 to 5000 nm, nm, from 0.5 to 50. Default: 5.
    #[schemars(range(min = 0.5, max = 50))]
    pub line_spacing: Option<f64>,
    /// Precision of rays and triangles in rest frames: "f64", as of events and boosts. Default: "f64".
    pub tracing: Option<Precision>,
    /// Mirrored and refracted light that reaches the camera with no more than this share (the product of the reflectances on its way) is left out, from 0 to 1. Default: 1e-4.
    #[schemars(range(min = 0, max = 1))]
    pub cutoff: Option<f64>,
}

impl From<AccuracyKeys> for Accuracy {
    fn from(keys: AccuracyKeys) -> Self {
        let preset = keys.preset.accuracy();
        Self {
            spectra: keys.spectra.unwrap_or(preset.spectra),
            wavelengths: keys.wavelengths.unwrap_or(preset.wavelengths),
            line_spacing: keys.line_spacing.unwrap_or(preset.line_spacing),
            cutoff: keys.cutoff.unwrap_or(preset.cutoff),
        }
    }
}

/// How curves are held while rendering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Spectra {
    /// Baked on a grid in ln λ, where a Doppler shift is a translation: fast.
    Grid,
    /// The cardinal spline through the authored points, read anew for every shift: exact at every wavelength, slow.
    Spline,
    /// Samples at equal distances from 50 to 5000 nm, resampled at every shift: as before 1990, slow and coarse; what a shift brings in from beyond is black.
    Lines,
    /// Three numbers, which no shift can reach: for frames that call for no Doppler effect.
    Rgb,
    /// Authored curves and Planck's law summed by adaptive quadrature to 1e-9: what the others are measured against, very slow.
    Exact,
}

/// Precision of rays and triangles in the rest frame of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 64 bits: 16 digits.
    F64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(keys: &str) -> Accuracy {
        toml::from_str(keys).expect("the keys are those of the format")
    }

    #[test]
    fn a_preset_chooses_what_its_author_does_not() {
        assert_eq!(parsed(""), Preset::Normal.accuracy());
        assert_eq!(parsed("preset = \"reference\"").spectra, Spectra::Exact);
        let draft = parsed("preset = \"draft\"\nwavelengths = 100");
        let expected = Accuracy {
            wavelengths: 100,
            ..Preset::Draft.accuracy()
        };
        assert_eq!(draft, expected);
    }
}
