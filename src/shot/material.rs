//! Materials: how a surface reflects, transmits and emits. Temperatures in kelvins, spectral radiance
//! in W·m⁻²·sr⁻¹·nm⁻¹ in the rest frame of the surface.
//!
//! Every key of a term is optional. If the model file has a material of the same name, the given keys
//! replace those of the file and the rest stays; otherwise the defaults hold.

use super::{SpectrumValue, Track};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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

/// The spectra of a material's terms with their keys, borrowed shared or mutably. Destructuring
/// without `..` makes a new term a compile error here.
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
    /// The spectra of all terms, each with its key below that of the material, such as
    /// `diffuse.spectrum`. A spectrum that is missing here would have its file neither read nor
    /// fingerprinted.
    pub fn spectra(&self) -> impl Iterator<Item = (&'static str, &Option<SpectrumValue>)> {
        of_terms!(self, as_ref, &)
    }

    /// The same spectra, mutable.
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
