//! What surfaces do with light, in their rest frame.

use super::spectra::Spectra;
use crate::frame;
use crate::model::ModelMaterial;
use crate::shot::ThermalCurve;
use crate::spectrum::{Spectrum, SpectrumError};
use std::sync::Arc;

/// Exponent of a highlight whose author gave none.
const EXPONENT: f64 = 40.0;
/// Index of refraction where its author gave none: of common glass.
const IOR: f64 = 1.5;

/// A surface: the sum of its terms, each None where it has none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Material {
    /// Name, as the shot or the model file has it.
    pub name: String,
    /// Lambertian: L = ρE/π.
    pub diffuse: Option<Reflectance>,
    /// Blinn–Phong highlight.
    pub highlight: Option<Highlight>,
    /// Ideal reflection.
    pub mirror: Option<Reflectance>,
    /// Ideal refraction.
    pub refraction: Option<Refraction>,
    /// Cold light of its own: spectral radiance scale × spectrum, W·m⁻²·sr⁻¹·nm⁻¹.
    pub emission: Option<Reflectance>,
    /// Thermal light of its own.
    pub thermal: Option<Thermal>,
}

/// weight × spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct Reflectance {
    /// Factor, at least 0.
    pub weight: f64,
    /// Shape.
    pub spectrum: Arc<Spectrum>,
}

impl Reflectance {
    /// The largest share of light that it lets go on, at any wavelength.
    pub fn most(&self) -> f64 {
        (self.weight * self.spectrum.peak()).min(1.0)
    }
}

/// A highlight: weight × spectrum × (n+8)/(8π) × (N·H)ⁿ is added to the BRDF.
#[derive(Debug, Clone, PartialEq)]
pub struct Highlight {
    /// weight × spectrum.
    pub reflectance: Reflectance,
    /// n, at least 0.
    pub exponent: f64,
}

/// Ideal refraction at a boundary: outside, where triangles show their front, is vacuum.
#[derive(Debug, Clone, PartialEq)]
pub struct Refraction {
    /// weight × spectrum, of what passes the boundary.
    pub transmittance: Reflectance,
    /// Index of refraction inside, at least 1.
    pub ior: f64,
}

/// Thermal light: emissivity × a black body's curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Thermal {
    /// Kelvin, above 0.
    pub temperature_k: f64,
    /// Between 0 and 1 at every wavelength.
    pub emissivity: Arc<Spectrum>,
    /// How the curve is scaled.
    pub curve: Curve,
}

/// Scale of a thermal curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// Planck's law.
    Absolute,
    /// Planck's curve scaled so that its peak is this many W·m⁻²·sr⁻¹·nm⁻¹, as the plates of 1990
    /// must have been.
    Peak(f64),
}

/// Why a term of a material is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum MaterialError {
    /// A curve cannot be made.
    #[error("{0}")]
    Spectrum(#[from] SpectrumError),
    /// Neither the shot nor the model file gives the term a spectrum.
    #[error("`{0}` has no spectrum")]
    Unbacked(&'static str),
    /// More light is given back than arrives.
    #[error("`{term}` reaches {value}, more than all light")]
    TooBright {
        /// Key of the term.
        term: &'static str,
        /// weight × spectrum at its highest.
        value: f64,
    },
}

impl MaterialError {
    /// The key below the material's that it concerns, with a dot; empty if it is all of it.
    pub(super) fn key(&self) -> String {
        match self {
            Self::Spectrum(_) => String::new(),
            Self::Unbacked(term) | Self::TooBright { term, .. } => format!(".{term}"),
        }
    }

    /// What to do.
    pub(super) fn help(&self) -> &'static str {
        match self {
            Self::Spectrum(_) => "give the spectrum other numbers",
            Self::Unbacked(_) => "write `spectrum = …` beside it: a name, a number or a table",
            Self::TooBright { .. } => "lower its weight: weight × spectrum is at most 1",
        }
    }
}

impl Material {
    /// A material of a model file: its base colour and its glow.
    pub(super) fn imported(file: &ModelMaterial) -> Result<Self, SpectrumError> {
        let term = |spectrum| Reflectance {
            weight: 1.0,
            spectrum,
        };
        let mut made = Self {
            name: file.name.clone(),
            ..Self::default()
        };
        let is_some = |rgb: [f64; 3]| rgb.iter().any(|&c| c > 0.0);
        if is_some(file.base_color) {
            made.diffuse = Some(term(Spectra::color(file.base_color)?));
        }
        if is_some(file.emissive) {
            // By its hue, so that the curve's shape does not change with its strength.
            let greatest = file.emissive.into_iter().fold(0.0, f64::max);
            let hue = file.emissive.map(|part| part / greatest);
            let (curve, unit) = Spectra::light(hue, file.emissive_unit)?;
            let curve = Spectrum::Tinted(curve.scaled(greatest * unit));
            made.emission = Some(term(Arc::new(curve)));
        }
        Ok(made)
    }

    /// The shot's material laid over this one: keys that it gives replace, the rest stays.
    pub(super) fn overlaid(
        mut self,
        over: &frame::Material<'_>,
        spectra: &Spectra<'_>,
    ) -> Result<Self, MaterialError> {
        let reflectance = |name, term: frame::Term<'_>, below| {
            let made = laid(name, term, below, spectra)?;
            within_one(name, made.weight, &made.spectrum)?;
            Ok::<_, MaterialError>(made)
        };
        if let Some(term) = over.diffuse {
            self.diffuse = Some(reflectance("diffuse", term, self.diffuse)?);
        }
        if let Some(term) = over.emission {
            self.emission = Some(laid("emission", term, self.emission, spectra)?);
        }
        if let Some(frame::Highlight { term, exponent }) = over.highlight {
            let below = self.highlight.take();
            let kept = below.as_ref().map_or(EXPONENT, |h| h.exponent);
            let below = below.map(|h| h.reflectance);
            self.highlight = Some(Highlight {
                reflectance: reflectance("highlight", term, below)?,
                exponent: exponent.unwrap_or(kept),
            });
        }
        if let Some(term) = over.mirror {
            self.mirror = Some(reflectance("mirror", term, self.mirror)?);
        }
        if let Some(frame::Refraction { term, ior }) = over.refraction {
            let below = self.refraction.take();
            let kept = below.as_ref().map_or(IOR, |r| r.ior);
            let below = below.map(|r| r.transmittance);
            self.refraction = Some(Refraction {
                transmittance: reflectance("refraction", term, below)?,
                ior: ior.unwrap_or(kept),
            });
        }
        if let Some(term) = &over.thermal {
            self.thermal = thermal(term, spectra)?;
        }
        Ok(self)
    }

    /// The same without terms that contribute nothing.
    pub(super) fn pruned(mut self) -> Self {
        let seen = |r: &Reflectance| r.weight > 0.0 && *r.spectrum != Spectrum::Constant(0.0);
        self.diffuse = self.diffuse.filter(seen);
        self.emission = self.emission.filter(seen);
        self.highlight = self.highlight.filter(|h| seen(&h.reflectance));
        self.mirror = self.mirror.filter(seen);
        // Without transmittance it is still a boundary, which gives a mirror its share.
        self.refraction = self
            .refraction
            .filter(|r| self.mirror.is_some() || seen(&r.transmittance));
        self
    }

    /// Whether lamps show on it.
    pub fn takes_lamps(&self) -> bool {
        self.diffuse.is_some() || self.highlight.is_some()
    }

    /// Whether other things are seen in it.
    pub fn passes_light_on(&self) -> bool {
        self.mirror.is_some() || self.refraction.is_some()
    }
}

/// A term of the shot laid over what stands there already.
fn laid(
    name: &'static str,
    over: frame::Term<'_>,
    below: Option<Reflectance>,
    spectra: &Spectra<'_>,
) -> Result<Reflectance, MaterialError> {
    let (kept, curve) = below.map_or((1.0, None), |b| (b.weight, Some(b.spectrum)));
    let weight = over.weight.unwrap_or(kept);
    let spectrum = match (over.spectrum, curve) {
        (Some(value), _) => spectra.curve(value)?,
        (None, Some(curve)) => curve,
        (None, None) if weight == 0.0 => Arc::new(Spectrum::Constant(0.0)),
        (None, None) => return Err(MaterialError::Unbacked(name)),
    };
    Ok(Reflectance { weight, spectrum })
}

/// Rounding that a product of authored numbers may carry above 1.
const ROUNDING: f64 = 1e-9;

/// Refuses a share above 1. What a spline overshoots between its points is clamped instead, and
/// its points were checked when the shot was read.
fn within_one(term: &'static str, weight: f64, spectrum: &Spectrum) -> Result<(), MaterialError> {
    let value = weight * spectrum.peak();
    if matches!(spectrum, Spectrum::Cardinal(_)) || value <= 1.0 + ROUNDING {
        Ok(())
    } else {
        Err(MaterialError::TooBright { term, value })
    }
}

/// A thermal term, or None at 0 K.
fn thermal(
    term: &frame::Thermal<'_>,
    spectra: &Spectra<'_>,
) -> Result<Option<Thermal>, MaterialError> {
    let emissivity = spectra.curve(term.emissivity)?;
    within_one("thermal.emissivity", 1.0, &emissivity)?;
    let curve = match term.curve {
        ThermalCurve::Peak => Curve::Peak(term.strength),
        ThermalCurve::Absolute => Curve::Absolute,
    };
    let temperature_k = term.temperature_k;
    Ok((temperature_k > 0.0).then_some(Thermal {
        temperature_k,
        emissivity,
        curve,
    }))
}
