//! How much of a source's light is received under a Doppler factor, and where its curve is read.
//!
//! L_λ/ν⁵-invariance: L(λ) = D⁵ L′(Dλ); a lamp's irradiance is D³ I′(Dλ)/r′² with r′ in the lamp's
//! rest frame (Rybicki & Lightman 1979 §4.9; Hsiung et al. 1990 §2.5 scale by D² alone).

use crate::frame::ActiveEffects;
use crate::shot::Beaming;

/// The powers of D and the shift that an image is rendered with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Received {
    beaming: Beaming,
    doppler: bool,
}

impl Received {
    /// As the image calls for.
    pub fn new(called: &ActiveEffects) -> Self {
        Self {
            beaming: called.beaming,
            doppler: called.doppler,
        }
    }

    /// Factor on spectral radiance: D⁵, D² or 1; finite.
    #[inline(always)]
    pub fn radiance(self, d: f64) -> f64 {
        match self.beaming {
            Beaming::Full => finite((d * d) * (d * d) * d),
            Beaming::Square => finite(d * d),
            Beaming::Off => 1.0,
        }
    }

    /// Factor on a black body of temperature D·T, which is what one of temperature T becomes
    /// under D⁵ (B(λ, DT) = D⁵ B(Dλ, T)); on one of temperature T where curves do not shift.
    #[inline(always)]
    pub fn black_body(self, d: f64) -> f64 {
        match (self.doppler, self.beaming) {
            (false, _) => self.radiance(d),
            (true, Beaming::Full) => 1.0,
            (true, Beaming::Square) => finite(1.0 / (d * d * d)),
            (true, Beaming::Off) => finite(1.0 / ((d * d) * (d * d) * d)),
        }
    }

    /// Factor on a lamp's spectral irradiance: D³, D² or 1.
    #[inline(always)]
    pub fn irradiance(self, d: f64) -> f64 {
        match self.beaming {
            Beaming::Full => finite(d * d * d),
            Beaming::Square => finite(d * d),
            Beaming::Off => 1.0,
        }
    }

    /// Whether curves shift.
    pub(super) fn shifts(self) -> bool {
        self.doppler
    }

    /// The factor by which wavelengths are read at the source: D, or 1 where curves do not shift.
    #[inline(always)]
    pub fn shift(self, d: f64) -> f64 {
        if self.doppler { d } else { 1.0 }
    }
}

/// Held to the largest number: infinitely much of nothing would be no number.
#[inline(always)]
pub(super) fn finite(value: f64) -> f64 {
    value.min(f64::MAX)
}
