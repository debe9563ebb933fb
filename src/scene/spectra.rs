//! Curves from the spectra of a shot.

use super::library::Library;
use crate::color::spaces::XYZ_FROM_RGB;
use crate::shot::{self, Shot, SpectrumTable, SpectrumValue};
use crate::spectrum::luminous_integral;
use crate::spectrum::{
    self, Cardinal, PlanckShape, Spectrum, SpectrumError, Tinted, Uplift, illuminant,
};
use std::sync::Arc;

/// Wavelength at which Planck's curve is 1 unless `unit_at` is given, nm.
const UNIT_AT_NM: f64 = 560.0;

/// Makes the curves of one image.
pub(super) struct Spectra<'a> {
    pub(super) shot: &'a Shot,
    pub(super) library: &'a Library,
    pub(super) frame: u32,
}

impl Spectra<'_> {
    /// The curve of a spectrum.
    pub(super) fn curve(&self, value: &SpectrumValue) -> Result<Arc<Spectrum>, SpectrumError> {
        let curve = match value {
            SpectrumValue::Number(track) => Spectrum::Constant(self.at(track)),
            SpectrumValue::Table(table) => self.table(table)?,
            SpectrumValue::Name(name) => match self.shot.spectrum.get(name) {
                Some(table) => self.table(table)?,
                // Unknown names were refused when the shot was read.
                None => illuminant(name).unwrap_or(Spectrum::Constant(0.0)),
            },
        };
        Ok(Arc::new(curve))
    }

    /// The smooth curve of a linear Rec. 709 color.
    pub(super) fn color(rgb: [f64; 3]) -> Result<Arc<Spectrum>, SpectrumError> {
        Ok(Arc::new(Spectrum::Rgb(Uplift::new(rgb)?)))
    }

    /// Light of a linear Rec. 709 color, D65 times its uplift, and the scale that gives it the
    /// luminance of that color if white has `white`: cd/m², and likewise cd and lx.
    pub(super) fn light(rgb: [f64; 3], white: f64) -> Result<(Tinted, f64), SpectrumError> {
        let curve = Tinted::new(rgb)?;
        let lumens = luminous_integral(&Spectrum::Tinted(curve.clone()));
        // Relative to green, since the three shares add up to 1: the result for gray is exact.
        let ([r, g, b], [red, _, blue]) = (rgb, XYZ_FROM_RGB[1]);
        let luminance = g + red * (r - g) + blue * (b - g);
        let scale = if lumens > 0.0 {
            white * luminance / lumens
        } else {
            0.0
        };
        Ok((curve, scale))
    }

    /// A track's value in this image.
    pub(super) fn at(&self, track: &shot::Track<f64>) -> f64 {
        track.at(self.frame, self.shot.shot.frames)
    }

    fn table(&self, table: &SpectrumTable) -> Result<Spectrum, SpectrumError> {
        let beyond = match table.beyond {
            Some(shot::Beyond::Zero) => spectrum::Beyond::Zero,
            Some(shot::Beyond::Hold) | None => spectrum::Beyond::Hold,
        };
        if let Some(points) = &table.points {
            let points: Vec<(f64, f64)> = points.iter().map(|&[nm, value]| (nm, value)).collect();
            let tension = table.tension.unwrap_or(0.0);
            return Ok(Spectrum::Cardinal(Cardinal::new(&points, tension, beyond)?));
        }
        if let Some(constant) = &table.constant {
            return Ok(Spectrum::Constant(self.at(constant)));
        }
        if let Some(kelvin) = &table.blackbody {
            let unit_at = table.unit_at.unwrap_or(UNIT_AT_NM);
            return Ok(Spectrum::Planck(PlanckShape::new(
                self.at(kelvin),
                unit_at,
            )?));
        }
        if let Some(rgb) = &table.rgb {
            let color = Uplift::new(rgb.at(self.frame, self.shot.shot.frames))?;
            return Ok(Spectrum::Rgb(color.with_beyond(beyond)));
        }
        if let Some(gaussian) = &table.gaussian {
            return Spectrum::gaussian(self.at(&gaussian.center), self.at(&gaussian.width));
        }
        if let Some(file) = &table.file {
            // Not replaced by black: a spectrum that is silently missing would be noticed too late.
            let sampled = self
                .library
                .table(file)
                .expect("the shot's files are read first");
            return Ok(Spectrum::Sampled(sampled.clone().with_beyond(beyond)));
        }
        let named = table.illuminant.as_deref().and_then(illuminant);
        Ok(match (named, beyond) {
            (Some(Spectrum::Sampled(curve)), beyond) => {
                Spectrum::Sampled(curve.with_beyond(beyond))
            }
            (named, _) => named.unwrap_or(Spectrum::Constant(0.0)),
        })
    }
}
