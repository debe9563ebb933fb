//! Pure boosts: events, four-vectors and light seen from the rest frame of a moving body.

use super::compensated::{cross, scaled_to_one};
use super::{Celerity, Event, FourVector};
use glam::DVec3;

/// The pure boost `rest_from_lab` into the rest frame of a body of celerity u.
///
/// "Lab" stands for the frame in which u is given. What does not depend on the ray is computed
/// once, in [`Boost::into_rest_of`], because one boost serves millions of rays.
///
/// # Example
/// A star straight ahead of a ship at 0.6 c: its light is received at twice its frequency.
/// ```
/// use glam::DVec3;
/// use restframe::relativity::{Boost, Celerity};
///
/// let ship = Celerity::from_beta(DVec3::new(0.0, 0.0, 0.6))?;
/// let starlight = DVec3::NEG_Z; // direction of travel: from the star towards the ship
/// let seen = Boost::into_rest_of(ship).light(starlight);
/// assert!((seen.frequency_ratio - 2.0).abs() < 1e-15);
/// assert_eq!(seen.direction, DVec3::NEG_Z);
/// # Ok::<(), restframe::relativity::CelerityError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boost {
    /// u as given, times a power of two that brings its length near 1, so that nothing is rounded
    /// and cross products with it neither underflow nor overflow. Zero at rest.
    axis: DVec3,
    /// |axis|.
    axis_length: f64,
    /// |u|.
    speed: f64,
    lorentz_factor: f64,
}

/// A ray of light as a boosted frame sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenLight {
    /// Unit direction of travel in the boosted frame.
    pub direction: DVec3,
    /// ω_rest / ω_lab. For light that a body of this celerity emits this is 1/D; for light that
    /// it receives, D.
    pub frequency_ratio: f64,
}

impl Boost {
    /// The boost that changes nothing.
    pub const IDENTITY: Self = Self {
        axis: DVec3::ZERO,
        axis_length: 0.0,
        speed: 0.0,
        lorentz_factor: 1.0,
    };

    /// The boost into the rest frame of a body of celerity `u`.
    pub fn into_rest_of(u: Celerity) -> Self {
        if u.is_rest() {
            return Self::IDENTITY;
        }
        let axis = scaled_to_one(u.vector());
        Self {
            axis,
            axis_length: axis.length(),
            speed: u.magnitude(),
            lorentz_factor: u.lorentz_factor(),
        }
    }

    /// Whether the boost changes nothing. Events and directions then keep every bit.
    pub fn is_identity(&self) -> bool {
        self.speed == 0.0
    }

    /// The four-vector `v` in the rest frame: t′ = γt − u·x, x′ = x + u((u·x)/(γ+1) − t)
    /// (Møller 1972 §2.4).
    ///
    /// From γ = 2 on the form used is t′ = u(t − x∥) + t/(γ + u), x∥′ = x∥/(γ + u) − u(t − x∥),
    /// by γ − u = 1/(γ + u): it does not cancel for vectors near the light cone that point along
    /// the motion.
    pub fn vector(&self, v: FourVector) -> FourVector {
        if self.is_identity() {
            return v;
        }
        let unit = self.axis / self.axis_length;
        let along = unit.dot(v.x);
        if self.lorentz_factor < 2.0 {
            let along = self.speed * along;
            return FourVector {
                t: self.lorentz_factor * v.t - along,
                x: v.x + unit * (self.speed * (along / (self.lorentz_factor + 1.0) - v.t)),
            };
        }
        let lead = self.speed * (v.t - along);
        let rapid = self.lorentz_factor + self.speed; // e^η
        FourVector {
            t: lead + v.t / rapid,
            x: (v.x - unit * along) + unit * (along / rapid - lead),
        }
    }

    /// The event `e` in the rest frame. The origins of both frames are the same event.
    pub fn event(&self, e: Event) -> Event {
        let v = self.vector(FourVector::new(e.t, e.x));
        Event::new(v.t, v.x)
    }

    /// Light that travels along `d`, seen from the rest frame. `d` may have any finite length other
    /// than zero; one that is not normalized loses no digit of its direction.
    pub fn light(&self, d: DVec3) -> SeenLight {
        let d = scaled_to_one(d);
        let length = d.length();
        if self.is_identity() {
            return SeenLight {
                direction: d / length,
                frequency_ratio: 1.0,
            };
        }
        self.light_of_length(d, length)
    }

    /// Light that travels along the unit vector `n`, seen from the rest frame: the fast form, for
    /// many rays. Rounding `n` to f64 leaves the frequency ratio a relative error of γε where `n`
    /// is within 1/γ of the motion.
    #[inline(always)]
    pub fn light_of_unit(&self, n: DVec3) -> SeenLight {
        if self.is_identity() {
            return SeenLight {
                direction: n,
                frequency_ratio: 1.0,
            };
        }
        self.light_of_length(n, 1.0)
    }

    /// Aberration and frequency ratio, in a form without cancellation:
    /// - ratio = (1 + u²|û×n|²)/(γ + u·n) for u·n > 0, else γ − u·n;
    /// - k∥ = (n∥² − u²|û×n|²)/(γ n∥ + u) for n∥ > 0, else γ n∥ − u;
    /// - k⊥ = (û×n)×û, and the direction is k/|k| with |k| = ratio.
    ///
    /// û×n comes from the vectors as given, before either is normalized. One Newton step brings the
    /// direction to unit length, because the rounding of û would otherwise add up over many boosts
    /// there and back.
    #[inline(always)]
    fn light_of_length(&self, d: DVec3, length: f64) -> SeenLight {
        let scale = 1.0 / (self.axis_length * length);
        let normal = cross(self.axis, d); // |axis| |d| û×n
        let n_along = self.axis.dot(d) * scale;
        let sweep = self.speed * scale;
        let sweep2 = (sweep * normal.x) * (sweep * normal.x)
            + (sweep * normal.y) * (sweep * normal.y)
            + (sweep * normal.z) * (sweep * normal.z);
        let (ratio, along) = if n_along > 0.0 {
            (
                (1.0 + sweep2) / (self.lorentz_factor + self.speed * n_along),
                (n_along * n_along - sweep2) / (self.lorentz_factor * n_along + self.speed),
            )
        } else {
            (
                self.lorentz_factor - self.speed * n_along,
                self.lorentz_factor * n_along - self.speed,
            )
        };
        let across = normal.cross(self.axis) * (scale / self.axis_length);
        let direction = (across + self.axis * (along / self.axis_length)) / ratio;
        // Newton's step for 1/√x at x = 1.
        let excess = direction.length_squared() - 1.0;
        SeenLight {
            direction: direction - direction * (0.5 * excess),
            frequency_ratio: ratio,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boost(beta: DVec3) -> Boost {
        Boost::into_rest_of(Celerity::from_beta(beta).unwrap())
    }

    #[test]
    fn rest_changes_no_bit() {
        let n = DVec3::new(0.1, -0.7, 0.3);
        assert_eq!(Boost::IDENTITY.light_of_unit(n).direction, n);
        let still = Boost::into_rest_of(Celerity::from_beta(DVec3::new(-0.0, 0.0, -0.0)).unwrap());
        assert_eq!(still, Boost::IDENTITY);
        let e = Event::new(3.0, n);
        assert_eq!(still.event(e), e);
    }

    #[test]
    fn receding_and_approaching_sources_follow_the_longitudinal_doppler_formula() {
        // Light travels along +z to the observer; the source moves along ±z at 0.5 c.
        let root3 = 1.7320508075688772;
        let d = |z: f64| 1.0 / boost(DVec3::Z * z).light(DVec3::Z).frequency_ratio;
        assert!((d(0.5) - root3).abs() < 4e-16 * 4.0);
        assert!((d(-0.5) - 1.0 / root3).abs() < 4e-16 * 4.0);
        assert!((d(0.99) / 14.106735979665884 - 1.0).abs() < 1e-15 * 4.0);
    }

    #[test]
    fn light_across_the_motion_is_red_by_the_lorentz_factor_in_the_observers_frame() {
        let across = boost(DVec3::X * 0.6).light(DVec3::Y);
        assert!((1.0 / across.frequency_ratio - 0.8).abs() < 1e-15);
    }

    #[test]
    fn a_slow_star_at_90_degrees_moves_by_its_speed() {
        let seen = boost(DVec3::X * 0.01).light(-DVec3::Y);
        let angle = (-seen.direction.x).asin().to_degrees();
        assert!((angle - 0.5729673449).abs() < 1e-9, "{angle}");
    }

    #[test]
    fn the_interval_of_10_1_2_0_at_half_light_speed_stays_minus_95() {
        let v = boost(DVec3::X * 0.5).vector(FourVector::new(10.0, DVec3::new(1.0, 2.0, 0.0)));
        assert!((v.interval() + 95.0).abs() < 1e-12);
    }

    #[test]
    fn events_on_the_light_cone_ahead_keep_their_digits() {
        // t = x = 3: t′ = x′ = 3/(γ + u).
        for lorentz_factor in [1.0 + 1e-12, 2.0, 1e3, 1e6, 1e8, 1e74] {
            let u = Celerity::from_lorentz_factor(lorentz_factor, DVec3::Z).unwrap();
            let seen = Boost::into_rest_of(u).event(Event::new(3.0, DVec3::Z * 3.0));
            let exact = 3.0 / (u.lorentz_factor() + u.magnitude());
            assert!((seen.t / exact - 1.0).abs() < 4.0 * f64::EPSILON);
            assert!((seen.x.z / exact - 1.0).abs() < 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn tiny_speeds_are_galilean_to_the_last_bit() {
        for beta in [1e-12, 1e-160, 1e-300] {
            let e = boost(DVec3::X * beta).event(Event::new(2.0, DVec3::new(1.0, 0.0, 0.0)));
            assert!((e.x.x - (1.0 - 2.0 * beta)).abs() <= f64::EPSILON);
        }
    }

    #[test]
    fn ten_thousand_boosts_of_a_thousandth_give_rapidity_ten() {
        let step = Boost::into_rest_of(Celerity::from_rapidity(1e-3, DVec3::NEG_X).unwrap());
        let mut v = FourVector::new(1.0, DVec3::ZERO);
        for _ in 0..10_000 {
            v = step.vector(v);
        }
        assert!((v.t / 11013.232920103324 - 1.0).abs() < 1e-11);
    }

    #[test]
    fn boosting_there_and_back_keeps_light_null_and_its_direction() {
        let u = Celerity::from_lorentz_factor(10.0, DVec3::new(1.0, 2.0, -0.5)).unwrap();
        let (there, back) = (Boost::into_rest_of(u), Boost::into_rest_of(u.reversed()));
        let n = DVec3::new(0.3, -0.5, 0.8).normalize();
        let mut seen = n;
        for _ in 0..100 {
            seen = back
                .light_of_unit(there.light_of_unit(seen).direction)
                .direction;
        }
        assert!((seen.length_squared() - 1.0).abs() < 1e-15);
        assert!((seen - n).length() < 1e-14 * 100.0);
    }
}
