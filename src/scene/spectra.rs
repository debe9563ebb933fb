//! Curves from the spectra of a frame.

use super::library::Library;
use crate::color::spaces::XYZ_FROM_RGB;
use crate::frame;
use crate::shot;
use crate::spectrum::luminous_integral;
use crate::spectrum::{
    self, Cardinal, PlanckShape, Spectrum, SpectrumError, Tinted, Uplift, illuminant,
};
use std::sync::Arc;

/// Makes the curves of one image.
pub(super) struct Spectra<'a> {
    pub(super) library: &'a Library,
}

impl Spectra<'_> {
    /// The curve of a spectrum of the shot.
    pub(super) fn curve(&self, value: frame::Spectrum<'_>) -> Result<Arc<Spectrum>, SpectrumError> {
        let curve = match value {
            frame::Spectrum::Constant(value) => Spectrum::Constant(value),
            frame::Spectrum::Points {
                points,
                tension,
                beyond,
            } => {
                let points: Vec<(f64, f64)> =
                    points.iter().map(|&[nm, value]| (nm, value)).collect();
                Spectrum::Cardinal(Cardinal::new(&points, tension, beyond_ends(beyond))?)
            }
            frame::Spectrum::Blackbody {
                temperature_k,
                unit_at_nm,
            } => Spectrum::Planck(PlanckShape::new(temperature_k, unit_at_nm)?),
            frame::Spectrum::Rgb { color, beyond } => {
                Spectrum::Rgb(Uplift::new(color)?.with_beyond(beyond_ends(beyond)))
            }
            frame::Spectrum::Gaussian {
                center_nm,
                width_nm,
            } => Spectrum::gaussian(center_nm, width_nm)?,
            frame::Spectrum::File { path, beyond } => {
                // Not black in its place: a spectrum that is silently missing is seen too late.
                let sampled = self.library.table(path);
                let sampled = sampled.expect("the shot's files are read first");
                Spectrum::Sampled(sampled.clone().with_beyond(beyond_ends(beyond)))
            }
            frame::Spectrum::Illuminant { name, beyond } => match illuminant(name) {
                Some(Spectrum::Sampled(curve)) => {
                    Spectrum::Sampled(curve.with_beyond(beyond_ends(beyond)))
                }
                // Dangling names were refused when the shot was read.
                named => named.unwrap_or(Spectrum::Constant(0.0)),
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
}

/// What lies beyond the ends of a curve.
fn beyond_ends(beyond: shot::Beyond) -> spectrum::Beyond {
    match beyond {
        shot::Beyond::Zero => spectrum::Beyond::Zero,
        shot::Beyond::Hold => spectrum::Beyond::Hold,
    }
}
