//! Doppler factors meet spectra here: how much of a source's light is received under a Doppler
//! factor D, and at which wavelength of the source its spectrum is read.
//!
//! Spectral radiance: L(λ) = D⁵ L′(Dλ), because L_λ/ν⁵ is invariant. Spectral irradiance of a lamp:
//! D³ I′(Dλ)/r′², r′ in the lamp's rest frame (Rybicki & Lightman 1979 §4.9; Hsiung et al. 1990
//! §2.5 scale by D² alone). `effects.beaming` replaces the powers, `effects.doppler` the shift.

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
    pub fn new(effects: &ActiveEffects) -> Self {
        Self {
            beaming: effects.beaming,
            doppler: effects.doppler,
        }
    }

    /// Whether spectra shift.
    pub(super) fn shifts(self) -> bool {
        self.doppler
    }

    /// Light under the Doppler factor `d`, the frequency received over that sent; above 0.
    #[inline(always)]
    pub fn under(self, d: f64) -> Doppler {
        Doppler { d, received: self }
    }
}

/// A Doppler factor with the powers and the shift that the image makes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doppler {
    d: f64,
    received: Received,
}

impl Doppler {
    /// Factor on spectral radiance: D⁵, D² or 1; finite.
    #[inline(always)]
    pub fn radiance(self) -> f64 {
        let d = self.d;
        match self.received.beaming {
            Beaming::Full => finite((d * d) * (d * d) * d),
            Beaming::Square => finite(d * d),
            Beaming::Off => 1.0,
        }
    }

    /// Factor on the spectrum of a black body at D·T, which stands for one at T under D⁵:
    /// B(λ, DT) = D⁵ B(Dλ, T). Where spectra do not shift, factor on that of one at T.
    #[inline(always)]
    pub fn black_body(self) -> f64 {
        let d = self.d;
        match (self.received.doppler, self.received.beaming) {
            (false, _) => self.radiance(),
            (true, Beaming::Full) => 1.0,
            (true, Beaming::Square) => finite(1.0 / (d * d * d)),
            (true, Beaming::Off) => finite(1.0 / ((d * d) * (d * d) * d)),
        }
    }

    /// Factor on a lamp's spectral irradiance: D³, D² or 1; finite.
    #[inline(always)]
    pub fn irradiance(self) -> f64 {
        let d = self.d;
        match self.received.beaming {
            Beaming::Full => finite(d * d * d),
            Beaming::Square => finite(d * d),
            Beaming::Off => 1.0,
        }
    }

    /// The source's wavelength over the received one: D, or 1 where spectra do not shift.
    #[inline(always)]
    pub fn shift(self) -> f64 {
        if self.received.doppler { self.d } else { 1.0 }
    }
}

/// At most the largest number: an infinite radiance times 0 would not be a number.
#[inline(always)]
pub(super) fn finite(value: f64) -> f64 {
    value.min(f64::MAX)
}
