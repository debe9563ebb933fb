//! Celerity u = γβ, the speed measure used throughout, in units of c: unlike β it keeps its digits
//! near the speed of light.

use super::compensated::{cross, dot, scaled_to_one};
use glam::DVec3;

/// The space part of a four-velocity, u = γβ, in units of c. Every component is finite and
/// |u| < [`Celerity::MAX`], so that every value is a speed below c.
///
/// # Example
/// ```
/// use glam::DVec3;
/// use restframe::relativity::{Celerity, CelerityError};
///
/// let probe = Celerity::from_beta(DVec3::new(0.6, 0.0, 0.0))?;
/// assert_eq!(probe.lorentz_factor(), 1.25);
/// // Two such probes that approach each other do so at 1.2/1.36 c, not at 1.2 c.
/// let relative = probe.seen_from(probe.reversed());
/// assert!((relative.beta().x - 1.2 / 1.36).abs() < 1e-15);
/// assert_eq!(
///     Celerity::from_beta(DVec3::new(0.0, 1.0, 0.0)),
///     Err(CelerityError::NotBelowLight(1.0))
/// );
/// # Ok::<(), CelerityError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Celerity(DVec3);

/// Reason why numbers do not describe the velocity of a body.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CelerityError {
    /// |β| is 1 or more.
    #[error("speed {0} c is not below the speed of light")]
    NotBelowLight(f64),
    /// γ is below 1.
    #[error("Lorentz factor {0} is below 1")]
    LorentzFactorBelowOne(f64),
    /// The rapidity is negative.
    #[error("rapidity {0} is negative")]
    NegativeRapidity(f64),
    /// The speed is not zero but the direction is.
    #[error("a moving body needs a direction other than zero")]
    NoDirection,
    /// A value is NaN or infinite, or |u| is not below [`Celerity::MAX`].
    #[error("velocity is not a finite number, or its Lorentz factor is above 1e75")]
    NotFinite,
}

impl Celerity {
    /// At rest.
    pub const REST: Self = Self(DVec3::ZERO);

    /// Bound on |u|. The relative celerity of two such bodies, up to 2·10¹⁵⁰, can still be squared
    /// without overflow.
    pub const MAX: f64 = 1e75;

    /// A celerity from its components u = γβ, in units of c.
    ///
    /// # Errors
    /// [`CelerityError::NotFinite`] unless |u| < [`Celerity::MAX`].
    pub fn new(u: DVec3) -> Result<Self, CelerityError> {
        // max_element first: the square of a component may overflow where the component is fine.
        if u.is_finite() && u.abs().max_element() < Self::MAX {
            Ok(Self(u))
        } else {
            Err(CelerityError::NotFinite)
        }
    }

    /// A celerity from a velocity β in units of c, |β| < 1, by γβ = β/√((1−|β|)(1+|β|)).
    ///
    /// # Errors
    /// [`CelerityError::NotBelowLight`] if |β| is 1 or more, [`CelerityError::NotFinite`] if a
    /// component is not finite.
    pub fn from_beta(beta: DVec3) -> Result<Self, CelerityError> {
        if !beta.is_finite() {
            return Err(CelerityError::NotFinite);
        }
        let speed = length(beta);
        if speed >= 1.0 {
            return Err(CelerityError::NotBelowLight(speed));
        }
        Self::new(beta / ((1.0 - speed) * (1.0 + speed)).sqrt())
    }

    /// A celerity from a Lorentz factor γ ≥ 1 and a direction of any length, by
    /// u = √((γ−1)(γ+1)). β, which cannot tell γ = 10⁸ from c, is never formed. The direction may
    /// be zero only at γ = 1.
    ///
    /// # Errors
    /// If γ is below 1 or not finite, or if a direction is needed and is zero or not finite.
    pub fn from_lorentz_factor(
        lorentz_factor: f64,
        direction: DVec3,
    ) -> Result<Self, CelerityError> {
        if !lorentz_factor.is_finite() {
            return Err(CelerityError::NotFinite);
        }
        if lorentz_factor < 1.0 {
            return Err(CelerityError::LorentzFactorBelowOne(lorentz_factor));
        }
        Self::along(
            direction,
            ((lorentz_factor - 1.0) * (lorentz_factor + 1.0)).sqrt(),
        )
    }

    /// A celerity from a rapidity η ≥ 0 and a direction of any length, by u = sinh η. The direction
    /// may be zero only at η = 0.
    ///
    /// # Errors
    /// If η is negative or not finite, or if a direction is needed and is zero or not finite.
    pub fn from_rapidity(rapidity: f64, direction: DVec3) -> Result<Self, CelerityError> {
        if rapidity < 0.0 {
            return Err(CelerityError::NegativeRapidity(rapidity));
        }
        Self::along(direction, rapidity.sinh())
    }

    fn along(direction: DVec3, u: f64) -> Result<Self, CelerityError> {
        if u == 0.0 {
            return Ok(Self::REST);
        }
        if !direction.is_finite() || !u.is_finite() {
            return Err(CelerityError::NotFinite);
        }
        let length = length(direction);
        if length == 0.0 {
            return Err(CelerityError::NoDirection);
        }
        Self::new(direction / length * u)
    }

    /// The components of u = γβ, in units of c.
    pub fn vector(self) -> DVec3 {
        self.0
    }

    /// The length |u|, in units of c.
    pub fn magnitude(self) -> f64 {
        length(self.0)
    }

    /// The Lorentz factor γ = √(1 + u²).
    pub fn lorentz_factor(self) -> f64 {
        1f64.hypot(self.magnitude())
    }

    /// The velocity β = u/γ, in units of c. Its length rounds to 1 from about γ = 10⁸ on.
    pub fn beta(self) -> DVec3 {
        self.0 / self.lorentz_factor()
    }

    /// Whether the body is at rest.
    pub fn is_rest(self) -> bool {
        self.0 == DVec3::ZERO
    }

    /// The same speed in the opposite direction.
    pub fn reversed(self) -> Self {
        Self(-self.0)
    }

    /// The celerity w of this body (v) in the rest frame of a body of celerity `u`, whose axes come
    /// from those of the common frame by a pure boost (Møller 1972 §2.7).
    ///
    /// Computed from the difference δ = v − u, so that two bodies at γ = 10⁶ side by side are as
    /// exact as two at rest: w⊥ = δ⊥; w∥ = ((δ·û)(v∥ + u) − |u×δ|²)/(γ_u v∥ + u γ_v) for
    /// v∥ = v·û > 0; and w∥ = γ_u v∥ − u γ_v otherwise, where both terms have the same sign.
    pub fn seen_from(self, u: Celerity) -> Celerity {
        if u.is_rest() {
            return self;
        }
        let v = self.0;
        let axis = scaled_to_one(u.0);
        let (speed, axis_length) = (u.magnitude(), axis.length());
        let unit = axis / axis_length;
        // û×v = û×δ from u and v as given: û is rounded, and near u that would be all there is; δ
        // is rounded where one of the two is far faster, and there u would bring it in.
        let sweep = cross(axis, v) / axis_length;
        let across = sweep.cross(unit);
        let v_along = v.dot(unit);
        let (lorentz_u, lorentz_v) = (u.lorentz_factor(), self.lorentz_factor());
        let along = if v_along > 0.0 {
            let advance = dot(axis, v - u.0) / axis_length;
            let sum = lorentz_u * v_along + speed * lorentz_v;
            let swept = speed * sweep.length();
            advance * ((v_along + speed) / sum) - swept * (swept / sum)
        } else {
            lorentz_u * v_along - speed * lorentz_v
        };
        Self(across + unit * along)
    }
}

/// |v| without under- or overflow on the way.
fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest == 0.0 {
        0.0
    } else {
        (v / largest).length() * largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_at_or_above_light_are_refused() {
        assert_eq!(
            Celerity::from_beta(DVec3::X),
            Err(CelerityError::NotBelowLight(1.0))
        );
        assert!(Celerity::from_beta(DVec3::new(0.8, 0.8, 0.0)).is_err());
        assert!(Celerity::from_beta(DVec3::new(f64::NAN, 0.0, 0.0)).is_err());
        assert!(Celerity::from_lorentz_factor(0.5, DVec3::X).is_err());
        assert!(Celerity::from_rapidity(-1.0, DVec3::X).is_err());
        assert!(Celerity::from_lorentz_factor(2.0, DVec3::ZERO).is_err());
        assert!(Celerity::from_rapidity(1e4, DVec3::X).is_err());
    }

    #[test]
    fn a_direction_may_be_zero_only_at_rest() {
        assert_eq!(
            Celerity::from_lorentz_factor(1.0, DVec3::ZERO),
            Ok(Celerity::REST)
        );
        assert_eq!(
            Celerity::from_rapidity(0.0, DVec3::ZERO),
            Ok(Celerity::REST)
        );
    }

    #[test]
    fn lorentz_factor_of_1e8_survives_though_beta_cannot_hold_it() {
        let u = Celerity::from_lorentz_factor(1e8, DVec3::new(0.0, 0.0, 3.0)).unwrap();
        assert!((u.lorentz_factor() / 1e8 - 1.0).abs() < 4.0 * f64::EPSILON);
        assert_eq!(u.beta().length(), 1.0);
    }

    #[test]
    fn speeds_of_0_6_and_0_6_at_right_angles_compose_to_lorentz_factor_1_5625() {
        let u = Celerity::from_beta(DVec3::new(-0.6, 0.0, 0.0)).unwrap();
        let v = Celerity::from_beta(DVec3::new(0.0, 0.6, 0.0)).unwrap();
        assert!((v.seen_from(u).lorentz_factor() - 1.5625).abs() < 1e-15);
    }
}
