//! Materials: the lobes of a surface and its own light, made from the model file's material with the
//! shot's laid over it. All spectra are those of the surface's rest frame.

use super::bsdf::{Bsdf, Lobe, LobeKind, WeightedSpectrum};
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

/// A surface: what it reflects and transmits, and its own light.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Material {
    /// Name, as the shot or the model file has it.
    pub name: String,
    /// Reflection and transmission.
    pub bsdf: Bsdf,
    /// Cold light of its own: spectral radiance scale × spectrum, W·m⁻²·sr⁻¹·nm⁻¹.
    pub emission: Option<WeightedSpectrum>,
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
        let term = |spectrum| WeightedSpectrum {
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
        over: &frame::Material<'_>,
        spectra: &Spectra<'_>,
    ) -> Result<Self, MaterialError> {
        // By all terms: one that is new does not compile until it is laid over too.
        let frame::Material {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission,
            thermal,
        } = over;
        if let Some(term) = *diffuse {
            let key = LobeKind::Diffuse.key();
            self = self.with(key, term, |_| LobeKind::Diffuse, spectra)?;
        }
        if let Some(term) = *emission {
            self.emission = Some(laid("emission", term, self.emission, spectra)?);
        }
        if let Some(frame::Highlight { term, exponent }) = *highlight {
            let kind = |below| match (exponent, below) {
                (Some(exponent), _) => LobeKind::Highlight { exponent },
                (None, Some(kept)) => kept,
                (None, None) => LobeKind::Highlight { exponent: EXPONENT },
            };
            self = self.with("highlight", term, kind, spectra)?;
        }
        if let Some(term) = *mirror {
            let key = LobeKind::Mirror.key();
            self = self.with(key, term, |_| LobeKind::Mirror, spectra)?;
        }
        if let Some(frame::Refraction { term, ior }) = *refraction {
            let kind = |below| match (ior, below) {
                (Some(ior), _) => LobeKind::Refraction { ior },
                (None, Some(kept)) => kept,
                (None, None) => LobeKind::Refraction { ior: IOR },
            };
            self = self.with("refraction", term, kind, spectra)?;
        }
        if let Some(term) = thermal {
            self.thermal = self::thermal(term, spectra)?;
        }
        Ok(self)
    }

    /// The lobe of a key of the shot over the one that stands there. `kind` makes its geometry of that
    /// one's.
    fn with(
        mut self,
        key: &'static str,
        over: frame::Term<'_>,
        kind: impl FnOnce(Option<LobeKind>) -> LobeKind,
        spectra: &Spectra<'_>,
    ) -> Result<Self, MaterialError> {
        let below = self.bsdf.of_key(key).cloned();
        let kind = kind(below.as_ref().map(|lobe| lobe.kind));
        let reflectance = laid(key, over, below.map(|lobe| lobe.reflectance), spectra)?;
        within_one(key, reflectance.weight, &reflectance.spectrum)?;
        self.bsdf = self.bsdf.with(Lobe { kind, reflectance });
        Ok(self)
    }

    /// The same without lobes and light that contribute nothing.
    pub(super) fn pruned(mut self) -> Self {
        self.bsdf = self.bsdf.pruned();
        self.emission = self.emission.filter(WeightedSpectrum::is_seen);
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

/// A term of the shot laid over what stands there already.
fn laid(
    name: &'static str,
    over: frame::Term<'_>,
    below: Option<WeightedSpectrum>,
    spectra: &Spectra<'_>,
) -> Result<WeightedSpectrum, MaterialError> {
    let (kept, curve) = below.map_or((1.0, None), |b| (b.weight, Some(b.spectrum)));
    let weight = over.weight.unwrap_or(kept);
    let spectrum = match (over.spectrum, curve) {
        (Some(value), _) => spectra.curve(value)?,
        (None, Some(curve)) => curve,
        (None, None) if weight == 0.0 => Arc::new(Spectrum::Constant(0.0)),
        (None, None) => return Err(MaterialError::Unbacked(name)),
    };
    Ok(WeightedSpectrum { weight, spectrum })
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
