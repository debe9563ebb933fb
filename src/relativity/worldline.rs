//! Inertial worldlines, and the Poincaré transforms between their rest frames.

use super::compensated::cross;
use super::{Boost, Celerity, Event, FourVector, SeenLight};
use glam::{DMat3, DQuat, DVec3};

/// An inertial worldline (constant velocity) in the lab frame, and the rest frame that it carries.
///
/// The rest frame has its origin, position 0 at proper time 0, at a given lab event.
///
/// # Example
/// A clock at 0.6 c has gone 0.8 of the lab's time.
/// ```
/// use glam::DVec3;
/// use restframe::relativity::{Celerity, Worldline};
///
/// let ship = Worldline {
///     celerity: Celerity::from_beta(DVec3::new(0.6, 0.0, 0.0))?,
///     ..Worldline::LAB
/// };
/// let clock = DVec3::ZERO; // rest-frame position
/// assert!((ship.event_at_lab_time(clock, 10.0).t - 8.0).abs() < 1e-14);
/// assert!((ship.lab_position(clock, 10.0).x - 6.0).abs() < 1e-14);
/// # Ok::<(), restframe::relativity::CelerityError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worldline {
    /// Celerity u = γβ in the lab.
    pub celerity: Celerity,
    /// Lab event of the rest frame's origin.
    pub origin: Event,
}

impl Worldline {
    /// The lab: at rest at its own origin.
    pub const LAB: Self = Self {
        celerity: Celerity::REST,
        origin: Event::new(0.0, DVec3::ZERO),
    };

    /// The rest-frame event, at lab time `lab_time`, of a point that rests at `position` in the rest
    /// frame: t_lab = t₀ + γτ + u·x gives τ = (t_lab − t₀ − u·x)/γ.
    pub fn event_at_lab_time(&self, position: DVec3, lab_time: f64) -> Event {
        if self.celerity.is_rest() {
            return Event::new(lab_time - self.origin.t, position);
        }
        let along = self.celerity.vector().dot(position);
        let tau = (lab_time - self.origin.t - along) / self.celerity.lorentz_factor();
        Event::new(tau, position)
    }

    /// The lab position, at lab time `lab_time`, of a point that rests at `position` in the rest
    /// frame: the way that the origin has gone, plus `position` contracted along the motion. No
    /// term cancels at any speed.
    pub fn lab_position(&self, position: DVec3, lab_time: f64) -> DVec3 {
        let passed = self.origin.x + self.celerity.beta() * (lab_time - self.origin.t);
        if self.celerity.is_rest() {
            return passed + position;
        }
        let unit = self.celerity.vector() / self.celerity.magnitude();
        let along = unit * unit.dot(position);
        passed + (position - along) + along / self.celerity.lorentz_factor()
    }
}

/// The Poincaré transform `to_from` from the rest frame of one worldline to that of another:
/// x′ = R·B(w)·(x + before) + after.
///
/// It is composed from the relative celerity w and not by way of the lab, so that two worldlines at
/// γ = 10⁶ side by side are as exact as two at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    boost: Boost,
    /// The Wigner rotation R. None if it is the identity: collinear motion, or none.
    turn: Option<DMat3>,
    /// Origin of the `from` frame less that of the `to` frame, in `from` coordinates, if `from` is
    /// the lab; zero otherwise. Far from the lab's origin, the part that an event has in common with
    /// the worldline's origin drops out before γ multiplies its rounding.
    before: FourVector,
    /// The same difference in `to` coordinates if `from` is not the lab; zero otherwise.
    after: FourVector,
}

impl Transform {
    /// The transform that changes nothing.
    pub const IDENTITY: Self = Self {
        boost: Boost::IDENTITY,
        turn: None,
        before: FourVector::ZERO,
        after: FourVector::ZERO,
    };

    /// The transform from the rest frame of `from` to that of `to`.
    ///
    /// B(v)·B(u)⁻¹ = R·B(w), w the celerity of `to` in `from`'s frame and R the Wigner rotation,
    /// a turn about u×v by −ε with tan(ε/2) = |u×v|/(1 + γ_u + γ_v + γ_w) (Macfarlane 1962).
    pub fn between(from: &Worldline, to: &Worldline) -> Self {
        let (u, v) = (from.celerity, to.celerity);
        let w = v.seen_from(u);
        let gap = from.origin - to.origin;
        let (before, after) = if u.is_rest() {
            (gap, FourVector::ZERO)
        } else {
            (FourVector::ZERO, Boost::into_rest_of(v).vector(gap))
        };
        Self {
            boost: Boost::into_rest_of(w),
            turn: wigner_turn(u, v, w),
            before,
            after,
        }
    }

    /// The transform for `effects.geometry = false`, as if light were infinitely fast: bodies stand
    /// where they are at one lab time, uncontracted, and all rest frames have the same axes.
    /// `from_at` and `to_at` are the lab positions of the two origins at that time.
    pub fn snapshot(from_at: DVec3, to_at: DVec3) -> Self {
        Self {
            after: FourVector::new(0.0, from_at - to_at),
            ..Self::IDENTITY
        }
    }

    /// Whether directions and frequencies are the same in both frames.
    pub fn is_translation(&self) -> bool {
        self.boost.is_identity()
    }

    /// The event `e` in `to` coordinates.
    #[inline]
    pub fn event(&self, e: Event) -> Event {
        let v = self.vector(FourVector::new(e.t, e.x) + self.before);
        Event::new(v.t, v.x) + self.after
    }

    /// The difference of events `v` in `to` coordinates.
    #[inline]
    pub fn vector(&self, v: FourVector) -> FourVector {
        if self.boost.is_identity() {
            return v; // nor is there a turn
        }
        let v = self.boost.vector(v);
        FourVector::new(v.t, self.turned(v.x))
    }

    /// Light that travels along the unit vector `n`, seen from the `to` frame.
    #[inline(always)]
    pub fn light(&self, n: DVec3) -> SeenLight {
        let light = self.boost.light_of_unit(n);
        SeenLight {
            direction: self.turned(light.direction),
            ..light
        }
    }

    #[inline(always)]
    fn turned(&self, x: DVec3) -> DVec3 {
        match self.turn {
            Some(turn) => turn * x,
            None => x,
        }
    }
}

/// R of [`Transform::between`]; None where u and v are collinear, since it is the identity there.
fn wigner_turn(u: Celerity, v: Celerity, w: Celerity) -> Option<DMat3> {
    let normal = cross(u.vector(), v.vector());
    if normal == DVec3::ZERO {
        return None;
    }
    let tan_half = normal / (1.0 + u.lorentz_factor() + v.lorentz_factor() + w.lorentz_factor());
    let turn = DQuat::from_xyzw(-tan_half.x, -tan_half.y, -tan_half.z, 1.0).normalize();
    Some(DMat3::from_quat(turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worldline(beta: [f64; 3], t: f64, x: [f64; 3]) -> Worldline {
        Worldline {
            celerity: Celerity::from_beta(DVec3::from(beta)).unwrap(),
            origin: Event::new(t, DVec3::from(x)),
        }
    }

    /// The long way: back to the lab and out again.
    fn through_the_lab(from: &Worldline, to: &Worldline, e: Event) -> Event {
        let lab = Boost::into_rest_of(from.celerity.reversed()).event(e)
            + (from.origin - Event::new(0.0, DVec3::ZERO));
        let gap = lab - to.origin;
        let v = Boost::into_rest_of(to.celerity).vector(gap);
        Event::new(v.t, v.x)
    }

    #[test]
    fn composed_transforms_agree_with_the_way_through_the_lab() {
        let cases = [
            ([0.6, 0.0, 0.0], [0.0, 0.6, 0.0]),
            ([0.5, -0.3, 0.2], [-0.1, 0.4, 0.8]),
            ([0.0, 0.0, 0.9], [0.0, 0.0, -0.9]),
            ([0.0, 0.0, 0.0], [0.3, 0.0, 0.4]),
            ([0.3, 0.0, 0.4], [0.0, 0.0, 0.0]),
        ];
        for (a, b) in cases {
            let from = worldline(a, 0.5, [1.0, -2.0, 0.25]);
            let to = worldline(b, -3.0, [0.0, 4.0, 1.5]);
            let e = Event::new(1.25, DVec3::new(-0.5, 2.0, 7.0));
            let direct = Transform::between(&from, &to).event(e);
            let long = through_the_lab(&from, &to, e);
            assert!((direct.t - long.t).abs() < 1e-13, "{a:?} {b:?}");
            assert!((direct.x - long.x).length() < 1e-13, "{a:?} {b:?}");
        }
    }

    #[test]
    fn wigner_rotation_of_0_6_and_0_6_is_12_68_degrees() {
        let (from, to) = (
            worldline([-0.6, 0.0, 0.0], 0.0, [0.0; 3]),
            worldline([0.0, 0.6, 0.0], 0.0, [0.0; 3]),
        );
        let turn = Transform::between(&from, &to).turn.unwrap();
        let (_, angle) = DQuat::from_mat3(&turn).to_axis_angle();
        assert!((angle.to_degrees() - 12.680383491820).abs() < 1e-10);
    }

    #[test]
    fn a_shared_celerity_leaves_a_pure_translation() {
        let a = worldline([0.3, 0.2, -0.5], 0.0, [0.0; 3]);
        let b = worldline([0.3, 0.2, -0.5], 1.0, [1.0, 0.0, 0.0]);
        assert!(Transform::between(&a, &b).is_translation());
        assert_eq!(Transform::between(&a, &a), Transform::IDENTITY);
    }

    #[test]
    fn a_lab_event_far_away_is_as_exact_beside_a_worldline_as_at_the_origin() {
        let far = FourVector::new(1e9, DVec3::new(1e9, -1e9, 1e9));
        let near = worldline([0.3, 0.2, -0.8], 0.5, [1.0, -2.0, 0.25]);
        let line = Worldline {
            origin: near.origin + far,
            ..near
        };
        let e = Event::new(1.25, DVec3::new(-0.5, 2.0, 7.0));
        let here = Transform::between(&Worldline::LAB, &near).event(e);
        let there = Transform::between(&Worldline::LAB, &line).event(e + far);
        assert_eq!(here, there);
    }

    #[test]
    fn light_keeps_its_own_worldline_under_the_transform() {
        // A light ray's two events, transformed, are joined by the transformed direction.
        let from = worldline([0.5, -0.3, 0.2], 0.5, [1.0, -2.0, 0.25]);
        let to = worldline([-0.1, 0.4, 0.8], -3.0, [0.0, 4.0, 1.5]);
        let transform = Transform::between(&from, &to);
        let n = DVec3::new(0.2, -0.9, 0.4).normalize();
        let a = Event::new(0.0, DVec3::new(1.0, 1.0, 1.0));
        let b = a + FourVector::new(3.0, n * 3.0);
        let step = transform.event(b) - transform.event(a);
        let light = transform.light(n);
        assert!((step.t - 3.0 * light.frequency_ratio).abs() < 1e-13);
        assert!((step.x - light.direction * step.t).length() < 1e-13);
    }

    #[test]
    fn a_point_is_in_the_lab_where_its_event_is() {
        let w = worldline([0.3, 0.2, -0.8], 1.5, [4.0, 5.0, 6.0]);
        let position = DVec3::new(1.0, 2.0, 3.0);
        let lab = Transform::between(&w, &Worldline::LAB).event(w.event_at_lab_time(position, 7.0));
        assert!((w.lab_position(position, 7.0) - lab.x).length() < 1e-14);
    }

    #[test]
    fn an_event_at_a_lab_time_has_that_lab_time() {
        let w = worldline([0.3, 0.2, -0.8], 1.5, [4.0, 5.0, 6.0]);
        let e = w.event_at_lab_time(DVec3::new(1.0, 2.0, 3.0), 7.0);
        let lab = Transform::between(&w, &Worldline::LAB).event(e);
        assert!((lab.t - 7.0).abs() < 1e-14);
    }
}
