//! Spectra of one frame: names looked up, tracks read, files not yet opened. Wavelengths in
//! nanometers.

use super::at::At;
use super::digests::Digests;
use super::hasher::Hasher;
use crate::shot::{Beyond, Gaussian, SpectrumTable, SpectrumValue};
use std::path::Path;

/// Where a black body's curve is 1 unless its author says otherwise, nm.
const UNIT_AT_NM: f64 = 560.0;

/// Spectra beyond this may make a lamp's sum overflow.
const LARGEST: f64 = 1e200;

/// Below this a black body's curve, 1 at 560 nm, is beyond all numbers at other wavelengths, K.
const COLDEST: f64 = 100.0;

/// A component of a linear color that is surely still above 0 in its curve.
const VISIBLE: f64 = 0.01;

/// A spectrum, of one of the kinds that a shot may write.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spectrum<'a> {
    /// The same at every wavelength.
    Constant(f64),
    /// A cardinal cubic spline.
    Points {
        /// Wavelengths, nm, and values.
        points: &'a [[f64; 2]],
        /// From 0 (Catmull-Rom) to 1.
        tension: f64,
        /// What lies beyond the points.
        beyond: Beyond,
    },
    /// Planck's curve.
    Blackbody {
        /// Temperature, K.
        temperature_k: f64,
        /// Where it is 1, nm.
        unit_at_nm: f64,
    },
    /// A smooth curve.
    Rgb {
        /// Its linear sRGB color.
        color: [f64; 3],
        /// What lies beyond the visible.
        beyond: Beyond,
    },
    /// A bell with peak 1.
    Gaussian {
        /// Wavelength of the peak, nm.
        center_nm: f64,
        /// Standard deviation, nm.
        width_nm: f64,
    },
    /// A table in a file.
    File {
        /// The file, as the shot has it.
        path: &'a Path,
        /// What lies beyond its wavelengths.
        beyond: Beyond,
    },
    /// A CIE illuminant.
    Illuminant {
        /// Its name.
        name: &'a str,
        /// What lies beyond its table.
        beyond: Beyond,
    },
}

impl<'a> Spectrum<'a> {
    /// Daylight, the spectrum of lamps whose author gave none.
    pub const D65: Spectrum<'static> = Spectrum::Illuminant {
        name: "D65",
        beyond: Beyond::Hold,
    };

    pub(super) fn new(value: &'a SpectrumValue, at: At<'a>) -> Self {
        match value {
            SpectrumValue::Number(value) => Self::Constant(at.value(value)),
            SpectrumValue::Table(table) => Self::of_table(table, at),
            SpectrumValue::Name(name) => match at.shot.spectrum.get(name) {
                Some(table) => Self::of_table(table, at),
                None => Self::Illuminant {
                    name,
                    beyond: Beyond::Hold,
                },
            },
        }
    }

    pub(super) fn given(value: &'a Option<SpectrumValue>, at: At<'a>) -> Option<Self> {
        value.as_ref().map(|value| Self::new(value, at))
    }

    fn of_table(table: &'a SpectrumTable, at: At<'a>) -> Self {
        // By all keys: one that is new does not compile until it is placed.
        let SpectrumTable {
            points,
            tension,
            constant,
            blackbody,
            unit_at,
            illuminant,
            rgb,
            gaussian,
            file,
            beyond,
        } = table;
        let beyond = beyond.unwrap_or(Beyond::Hold);
        if let Some(points) = points {
            let tension = tension.unwrap_or(0.0);
            Self::Points {
                points,
                tension,
                beyond,
            }
        } else if let Some(constant) = constant {
            Self::Constant(at.value(constant))
        } else if let Some(kelvin) = blackbody {
            Self::Blackbody {
                temperature_k: at.value(kelvin),
                unit_at_nm: unit_at.unwrap_or(UNIT_AT_NM),
            }
        } else if let Some(rgb) = rgb {
            let color = at.value(rgb);
            Self::Rgb { color, beyond }
        } else if let Some(Gaussian { center, width }) = gaussian {
            Self::Gaussian {
                center_nm: at.value(center),
                width_nm: at.value(width),
            }
        } else if let Some(path) = file {
            Self::File { path, beyond }
        } else {
            let name = illuminant.as_deref().unwrap_or_default();
            Self::Illuminant { name, beyond }
        }
    }

    /// Whether it is 0 at every wavelength, as far as the shot alone tells.
    pub(super) fn is_black(self) -> bool {
        self == Self::Constant(0.0)
    }

    /// Whether it surely is not black.
    pub(super) fn is_surely_lit(self) -> bool {
        match self {
            Self::Constant(value) => value > 0.0,
            Self::Points { points, .. } => points.iter().any(|point| point[1] > 0.0),
            Self::Blackbody { .. } => self.is_tame(),
            Self::Rgb { color, .. } => color.iter().any(|v| *v > VISIBLE),
            Self::Gaussian { .. } | Self::Illuminant { .. } => true,
            Self::File { .. } => false,
        }
    }

    /// Whether a lamp of this spectrum and an ordinary amount surely shines.
    pub(super) fn is_tame(self) -> bool {
        match self {
            Self::Constant(value) => value < LARGEST,
            Self::Points { points, .. } => points.iter().all(|point| point[1] < LARGEST),
            Self::Blackbody {
                temperature_k,
                unit_at_nm,
            } => temperature_k >= COLDEST && unit_at_nm == UNIT_AT_NM,
            Self::Rgb { .. } | Self::Gaussian { .. } | Self::Illuminant { .. } => true,
            Self::File { .. } => false,
        }
    }

    /// Hashes it; of a file its content.
    pub(super) fn hash(self, hasher: &mut Hasher, digests: &Digests) {
        match self {
            Self::Constant(value) => hasher.kind(0).number(value),
            Self::Points {
                points,
                tension,
                beyond,
            } => {
                let hasher = hasher.kind(1).count(points.len());
                points.as_flattened().iter().for_each(|v| {
                    hasher.number(*v);
                });
                hasher.number(tension).kind(beyond as u8)
            }
            Self::Blackbody {
                temperature_k,
                unit_at_nm,
            } => hasher.kind(2).number(temperature_k).number(unit_at_nm),
            Self::Rgb { color, beyond } => hasher.kind(3).vector(color).kind(beyond as u8),
            Self::Gaussian {
                center_nm,
                width_nm,
            } => hasher.kind(4).number(center_nm).number(width_nm),
            Self::File { path, beyond } => {
                hasher.kind(5).texts(&digests.of(path)).kind(beyond as u8)
            }
            Self::Illuminant { name, beyond } => hasher.kind(6).text(name).kind(beyond as u8),
        };
    }
}
