//! What lights one frame: lamps of the shot, and the sky. Meters, degrees, nanometers, in the rest
//! frame of the worldline that each rides on.

use super::at::At;
use super::spectrum::Spectrum;
use crate::shot::{self, LightKind, Stars};
use glam::DVec3;
use std::borrow::Cow;
use std::path::Path;

/// A lamp of the shot. One that is dark at this frame is listed too: `scene` refuses a spectrum that
/// cannot be, whether it is seen or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Light<'a> {
    /// The shot's name for it, or "light" and its number.
    pub name: Cow<'a, str>,
    /// What kind of lamp it is.
    pub kind: LightKind,
    /// Place of its worldline in [`Frame::worldlines`](super::Frame).
    pub worldline: usize,
    /// Position, m; read of points and spots.
    pub position: DVec3,
    /// Direction of travel of its light, of any length but zero; read of spots and suns.
    pub direction: DVec3,
    /// Half-angle of a spot's fully lit cone, degrees.
    pub inner_deg: f64,
    /// Half-angle beyond which a spot is dark, degrees.
    pub outer_deg: f64,
    /// How much light it gives.
    pub amount: Amount,
    /// Shape of its spectrum.
    pub spectrum: Spectrum<'a>,
}

/// How much light a lamp gives, at least 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// Luminous intensity, cd, of a sun illuminance, lx.
    Photometric(f64),
    /// amount × spectrum is W·sr⁻¹·nm⁻¹, of a sun W·m⁻²·nm⁻¹.
    Spectral(f64),
}

/// What is known of a lamp without its spectrum's numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shines {
    /// It is dark.
    Never,
    /// It shines.
    Surely,
    /// It may be lost in rounding.
    Perhaps(Amount),
}

/// Lamps of fewer candela or lux may be lost in rounding.
const FAINTEST: f64 = 1e-6;

impl<'a> Light<'a> {
    pub(super) fn new(place: usize, light: &'a shot::Light, at: At<'a>) -> Self {
        let shot::Light {
            kind,
            name,
            worldline,
            position,
            direction,
            inner,
            outer,
            intensity,
            scale,
            spectrum,
        } = light;
        let numbered = || Cow::Owned(format!("light {}", place + 1));
        Self {
            name: name.as_deref().map_or_else(numbered, Cow::Borrowed),
            kind: *kind,
            worldline: at.worldline(worldline, "lab"),
            position: at.vector(position),
            direction: at.vector(direction),
            inner_deg: at.given(inner).unwrap_or(0.0),
            outer_deg: at.given(outer).unwrap_or(45.0),
            amount: match scale {
                Some(scale) => Amount::Spectral(at.value(scale)),
                None => Amount::Photometric(at.given(intensity).unwrap_or(0.0)),
            },
            spectrum: Spectrum::given(spectrum, at).unwrap_or(Spectrum::D65),
        }
    }

    /// Whether it shines, as far as the shot alone tells.
    pub(super) fn shines(&self) -> Shines {
        match self.amount {
            Amount::Photometric(amount) | Amount::Spectral(amount) if amount <= 0.0 => {
                Shines::Never
            }
            Amount::Spectral(_) => Shines::Surely,
            Amount::Photometric(amount) if amount >= FAINTEST && self.spectrum.is_tame() => {
                Shines::Surely
            }
            amount @ Amount::Photometric(_) => Shines::Perhaps(amount),
        }
    }
}

/// The sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background<'a> {
    /// Place of its worldline in [`Frame::worldlines`](super::Frame).
    pub worldline: usize,
    /// Spectral radiance at scale 1, W·m⁻²·sr⁻¹·nm⁻¹.
    pub spectrum: Option<Spectrum<'a>>,
    /// Image file in its place, as the shot has it.
    pub image: Option<&'a Path>,
    /// Factor on `spectrum` or `image`, at least 0.
    pub scale: f64,
    /// Stars, which no factor changes.
    pub stars: Option<&'a Stars>,
}

impl<'a> Background<'a> {
    pub(super) fn new(at: At<'a>) -> Self {
        let shot::Background {
            worldline,
            spectrum,
            image,
            scale,
            stars,
        } = &at.shot.background;
        Self {
            worldline: at.worldline(worldline, "camera"),
            spectrum: Spectrum::given(spectrum, at),
            image: image.as_deref(),
            scale: at.given(scale).unwrap_or(1.0),
            stars: stars.as_ref(),
        }
    }

    /// Whether no light comes from it, as far as the shot alone tells.
    pub fn is_black(&self) -> bool {
        let dark = self.spectrum.is_none_or(Spectrum::is_black) && self.image.is_none();
        self.stars.is_none() && (dark || self.scale <= 0.0)
    }
}
