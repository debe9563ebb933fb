//! Materials: the lobes of a surface and its own light, made from the model file's material with the
//! shot's laid over it. All spectra are those of the surface's rest frame.

use super::bsdf::{Bsdf, Lobe, LobeKind, Reflectance};
use super::spectra::Spectra;
use crate::model::ModelMaterial;
use crate::shot;
use crate::spectrum::{Spectrum, SpectrumError};
use std::sync::Arc;

/// Exponent of a highlight whose author gave none.
const EXPONENT: f64 = 40.0;
/// Index of refraction where its author gave none: of common glass.
const IOR: f64 = 1.5;

/// A surface: what it reflects and transmits, and its own light.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Material {
    /// Name, as the shot or the model file has it.
    pub name: String,
    /// Reflection and transmission.
    pub bsdf: Bsdf,
    /// Cold light of its own: spectral radiance scale × spectrum, W·m⁻²·sr⁻¹·nm⁻¹.
    pub emission: Option<Reflectance>,
    /// Thermal light of its own.
    pub thermal: Option<Thermal>,
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
            made.bsdf = Bsdf::new(vec![Lobe {
                kind: LobeKind::Diffuse,
                reflectance: term(Spectra::color(file.base_color)?),
            }]);
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
        shot: &shot::Material,
        spectra: &Spectra<'_>,
    ) -> Result<Self, MaterialError> {
        if let Some(term) = &shot.diffuse {
            let over = Over {
                term: LobeKind::Diffuse.key(),
                weight: &term.weight,
                spectrum: &term.spectrum,
            };
            self = self.with(over, |_| LobeKind::Diffuse, spectra)?;
        }
        if let Some(term) = &shot.emission {
            let over = Over {
                term: "emission",
                weight: &term.scale,
                spectrum: &term.spectrum,
            };
            self.emission = Some(over.lay(self.emission, spectra)?);
        }
        if let Some(term) = &shot.highlight {
            let over = Over {
                term: "highlight",
                weight: &term.weight,
                spectrum: &term.spectrum,
            };
            let kind = |below| match (&term.exponent, below) {
                (Some(exponent), _) => LobeKind::Highlight {
                    exponent: spectra.at(exponent),
                },
                (None, Some(kept)) => kept,
                (None, None) => LobeKind::Highlight { exponent: EXPONENT },
            };
            self = self.with(over, kind, spectra)?;
        }
        if let Some(term) = &shot.mirror {
            let over = Over {
                term: LobeKind::Mirror.key(),
                weight: &term.weight,
                spectrum: &term.spectrum,
            };
            self = self.with(over, |_| LobeKind::Mirror, spectra)?;
        }
        if let Some(term) = &shot.refraction {
            let over = Over {
                term: "refraction",
                weight: &term.weight,
                spectrum: &term.spectrum,
            };
            let kind = |below| match (&term.ior, below) {
                (Some(ior), _) => LobeKind::Refraction {
                    ior: spectra.at(ior),
                },
                (None, Some(kept)) => kept,
                (None, None) => LobeKind::Refraction { ior: IOR },
            };
            self = self.with(over, kind, spectra)?;
        }
        if let Some(term) = &shot.thermal {
            self.thermal = thermal(term, spectra)?;
        }
        Ok(self)
    }

    /// The lobe of a key of the shot over the one that stands there. `kind` makes its geometry of that
    /// one's.
    fn with(
        mut self,
        over: Over<'_>,
        kind: impl FnOnce(Option<LobeKind>) -> LobeKind,
        spectra: &Spectra<'_>,
    ) -> Result<Self, MaterialError> {
        let below = self.bsdf.of_key(over.term).cloned();
        let kind = kind(below.as_ref().map(|lobe| lobe.kind));
        let reflectance = over.reflectance(below.map(|lobe| lobe.reflectance), spectra)?;
        self.bsdf = self.bsdf.with(Lobe { kind, reflectance });
        Ok(self)
    }

    /// The same without lobes and light that contribute nothing.
    pub(super) fn pruned(mut self) -> Self {
        self.bsdf = self.bsdf.pruned();
        self.emission = self.emission.filter(Reflectance::is_seen);
        self
    }

    /// Whether lamps show on it.
    pub fn takes_lamps(&self) -> bool {
        !self.bsdf.non_specular().is_empty()
    }

    /// Whether other things are seen in it.
    pub fn passes_light_on(&self) -> bool {
        self.bsdf.non_specular().len() < self.bsdf.lobes().len()
    }
}

/// Keys of a term that are laid over what stands there already.
struct Over<'a> {
    term: &'static str,
    weight: &'a Option<shot::Track<f64>>,
    spectrum: &'a Option<shot::SpectrumValue>,
}

impl Over<'_> {
    fn lay(
        &self,
        below: Option<Reflectance>,
        spectra: &Spectra<'_>,
    ) -> Result<Reflectance, MaterialError> {
        let (kept, curve) = below.map_or((1.0, None), |b| (b.weight, Some(b.spectrum)));
        let weight = self.weight.as_ref().map_or(kept, |w| spectra.at(w));
        let spectrum = match (self.spectrum, curve) {
            (Some(value), _) => spectra.curve(value)?,
            (None, Some(curve)) => curve,
            (None, None) if weight == 0.0 => Arc::new(Spectrum::Constant(0.0)),
            (None, None) => return Err(MaterialError::Unbacked(self.term)),
        };
        Ok(Reflectance { weight, spectrum })
    }

    fn reflectance(
        &self,
        below: Option<Reflectance>,
        spectra: &Spectra<'_>,
    ) -> Result<Reflectance, MaterialError> {
        let made = self.lay(below, spectra)?;
        within_one(self.term, made.weight, &made.spectrum)?;
        Ok(made)
    }
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
fn thermal(term: &shot::Thermal, spectra: &Spectra<'_>) -> Result<Option<Thermal>, MaterialError> {
    let temperature_k = term.temperature.as_ref().map_or(0.0, |t| spectra.at(t));
    let emissivity = match &term.emissivity {
        Some(value) => spectra.curve(value)?,
        None => Arc::new(Spectrum::Constant(1.0)),
    };
    within_one("thermal.emissivity", 1.0, &emissivity)?;
    let curve = match term.curve {
        Some(shot::ThermalCurve::Peak) => {
            Curve::Peak(term.strength.as_ref().map_or(1.0, |s| spectra.at(s)))
        }
        Some(shot::ThermalCurve::Absolute) | None => Curve::Absolute,
    };
    Ok((temperature_k > 0.0).then_some(Thermal {
        temperature_k,
        emissivity,
        curve,
    }))
}
