//! Materials of one frame: the terms that the shot gives, to be laid over those of a model file.
//!
//! What a term leaves out stays as the file has it, and a term of weight 0 takes the file's away; so
//! both are told apart here, and terms are dropped by `scene`, which knows the files.

use super::at::At;
use super::spectrum::Spectrum;
use crate::shot::{self, SpectrumValue, ThermalCurve, Track};

/// The terms of a material that the shot gives.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Material<'a> {
    /// Lambertian reflection.
    pub diffuse: Option<Term<'a>>,
    /// Blurred reflection of lights.
    pub highlight: Option<Highlight<'a>>,
    /// Ideal reflection.
    pub mirror: Option<Term<'a>>,
    /// Ideal refraction.
    pub refraction: Option<Refraction<'a>>,
    /// Cold light, W·m⁻²·sr⁻¹·nm⁻¹.
    pub emission: Option<Term<'a>>,
    /// Thermal light.
    pub thermal: Option<Thermal<'a>>,
}

/// weight × spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term<'a> {
    /// Factor, at least 0; None where that of the file stays, 1 without a file's.
    pub weight: Option<f64>,
    /// Shape; None where that of the file stays.
    pub spectrum: Option<Spectrum<'a>>,
}

/// A blurred reflection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Highlight<'a> {
    /// Reflectance.
    pub term: Term<'a>,
    /// Exponent, at least 0; None where its author gave none.
    pub exponent: Option<f64>,
}

/// Ideal refraction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refraction<'a> {
    /// Transmittance.
    pub term: Term<'a>,
    /// Index of refraction, at least 1; None where its author gave none.
    pub ior: Option<f64>,
}

/// Thermal light: emissivity × Planck's curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thermal<'a> {
    /// Temperature, K, at least 0.
    pub temperature_k: f64,
    /// Emissivity, from 0 to 1.
    pub emissivity: Spectrum<'a>,
    /// Whether the radiance is Planck's or scaled by its peak.
    pub curve: ThermalCurve,
    /// Peak spectral radiance of a scaled curve, W·m⁻²·sr⁻¹·nm⁻¹.
    pub strength: f64,
}

/// What is known of a term without the model file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Presence {
    /// It contributes nothing, whatever the file has.
    Gone = 0,
    /// It is there.
    There = 1,
    /// It is there if the model file has a spectrum for it.
    AsInTheFile = 2,
}

impl Term<'_> {
    /// Whether it is there.
    pub(super) fn presence(self) -> Presence {
        match (self.weight, self.spectrum) {
            (Some(weight), _) if weight <= 0.0 => Presence::Gone,
            (_, Some(spectrum)) if spectrum.is_black() => Presence::Gone,
            (_, Some(_)) => Presence::There,
            (_, None) => Presence::AsInTheFile,
        }
    }

    /// Whether its weight lets any light through; one that is not given does.
    pub(super) fn has_weight(self) -> bool {
        self.weight.is_none_or(|weight| weight > 0.0)
    }
}

impl<'a> Material<'a> {
    pub(super) fn new(material: &'a shot::Material, at: At<'a>) -> Self {
        let term = |weight: &Option<Track<f64>>, spectrum: &'a Option<SpectrumValue>| Term {
            weight: at.given(weight),
            spectrum: Spectrum::given(spectrum, at),
        };
        let shot::Material {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission,
            thermal,
        } = material;
        Self {
            diffuse: diffuse.as_ref().map(|d| term(&d.weight, &d.spectrum)),
            highlight: highlight.as_ref().map(|h| Highlight {
                term: term(&h.weight, &h.spectrum),
                exponent: at.given(&h.exponent),
            }),
            mirror: mirror.as_ref().map(|m| term(&m.weight, &m.spectrum)),
            refraction: refraction.as_ref().map(|r| Refraction {
                term: term(&r.weight, &r.spectrum),
                ior: at.given(&r.ior),
            }),
            emission: emission.as_ref().map(|e| term(&e.scale, &e.spectrum)),
            thermal: thermal.as_ref().map(|t| Thermal {
                temperature_k: at.given(&t.temperature).unwrap_or(0.0),
                emissivity: Spectrum::given(&t.emissivity, at).unwrap_or(Spectrum::Constant(1.0)),
                curve: t.curve.unwrap_or(ThermalCurve::Absolute),
                strength: at.given(&t.strength).unwrap_or(1.0),
            }),
        }
    }
}
