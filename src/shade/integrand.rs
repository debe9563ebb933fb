//! Light as functions of wavelength, for integrals: spectra as their author wrote them, each read
//! under its own shift.

use super::curve::Curve;
use super::received::finite;
use super::thermal::ReceivedBlackbody;
use crate::spectrum::quadrature::cuts_nm;
use crate::spectrum::{ColoredLight, planck};

/// A curve under a shift.
#[derive(Clone, Copy)]
pub(super) struct Reading<'a> {
    pub(super) curve: &'a Curve,
    /// The curve's wavelength over the received one.
    pub(super) shift: f64,
}

impl Reading<'_> {
    /// The curve's value for a received wavelength, nm.
    pub(super) fn at(&self, nm: f64) -> f64 {
        self.curve.at(self.shift * nm)
    }

    /// Adds the wavelengths between which the curve is smooth.
    pub(super) fn add_cuts(&self, cuts: &mut Vec<f64>) {
        cuts_nm(self.curve.spectrum(), self.shift, cuts);
    }
}

/// Spectral radiance of a source, W·m⁻²·sr⁻¹·nm⁻¹, as the camera would see it directly.
pub(super) enum Source<'a> {
    /// A factor times a curve.
    Curve { factor: f64, reading: Reading<'a> },
    /// A surface's thermal light.
    Thermal(ReceivedBlackbody<'a>),
    /// A star: a factor times a black body.
    BlackBody { factor: f64, kelvin: f64 },
    /// A sky image's colour times D65.
    Image {
        factor: f64,
        light: ColoredLight,
        d65: Reading<'a>,
    },
    /// Lamps of one spectrum and shift, reflected by the lobes of a surface.
    Lamp {
        light: Reading<'a>,
        lobes: Vec<Reflected<'a>>,
    },
}

/// A lobe of a surface under lamps.
pub(super) struct Reflected<'a> {
    pub(super) factor: f64,
    pub(super) reading: Reading<'a>,
}

impl Source<'_> {
    /// The spectral radiance at a received wavelength, nm.
    pub(super) fn at(&self, nm: f64) -> f64 {
        match self {
            Self::Curve { factor, reading } => factor * reading.at(nm),
            Self::Thermal(light) => light.at(nm),
            Self::BlackBody { factor, kelvin } => factor * planck::radiance(nm, *kelvin),
            Self::Image { factor, light, d65 } => {
                finite(factor * d65.at(nm)) * light.at(d65.shift * nm)
            }
            Self::Lamp { light, lobes } => {
                let light = light.at(nm);
                lobes
                    .iter()
                    .map(|lobe| finite(lobe.factor * light) * lobe.reading.at(nm))
                    .sum()
            }
        }
    }

    /// [`Source::at`] over the factor and the curves that the source is a product of.
    pub(super) fn rest_at(&self, nm: f64) -> f64 {
        match self {
            Self::Thermal(light) => light.black_at(nm),
            Self::BlackBody { .. } | Self::Image { .. } => self.at(nm),
            Self::Curve { .. } | Self::Lamp { .. } => 1.0,
        }
    }

    /// Adds the wavelengths between which the light is smooth.
    pub(super) fn add_cuts(&self, cuts: &mut Vec<f64>) {
        match self {
            Self::Curve { reading, .. } => reading.add_cuts(cuts),
            Self::Thermal(light) => cuts_nm(light.emissivity.spectrum(), light.shift, cuts),
            Self::BlackBody { .. } => {}
            Self::Image { d65, .. } => {
                d65.add_cuts(cuts);
                cuts.extend(ColoredLight::SUPPORT_NM.map(|nm| nm / d65.shift));
            }
            Self::Lamp { light, lobes } => {
                light.add_cuts(cuts);
                lobes.iter().for_each(|lobe| lobe.reading.add_cuts(cuts));
            }
        }
    }
}
