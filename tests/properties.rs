//! What must hold for any input: invariances of the algebra, and bounds of what is interpolated
//! or sampled.
//!
//! The generators lean to the extremes: celerities from 1e-300 to 1e12, light along, against,
//! across and at a grazing angle to the motion, worldlines side by side at γ = 10⁶. Each tolerance
//! is a multiple of ε times the condition of the map, derived where it is used.

use glam::DVec3;
use proptest::prelude::*;
use restframe::frame::Splice;
use restframe::relativity::{
    Boost, Celerity, Event, FourVector, Transform, Worldline, light_arriving,
};
use restframe::shot::{Ease, Effects, Filter, Track};
use restframe::spectrum::{Beyond, Cardinal, planck};
use restframe::trace::Samples;

const EPSILON: f64 = f64::EPSILON;

/// Roundings that one boost, of light or of a vector, accumulates: see the operations in
/// `relativity::Boost`, and twice that for the vectors handed in.
const ROUNDINGS: f64 = 24.0;

/// A unit vector, all directions alike, some of them along an axis.
fn direction() -> impl Strategy<Value = DVec3> {
    let any = (-1.0..=1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, turn)| {
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    });
    let axes = [
        DVec3::X,
        DVec3::NEG_X,
        DVec3::Y,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    prop_oneof![4 => any, 1 => prop::sample::select(axes.to_vec())]
}

/// |u|: some everyday, some extreme, some none.
fn speed(largest_exponent: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        2 => (-300.0..-9.0_f64).prop_map(|e| 10_f64.powf(e)),
        3 => (-9.0..0.0_f64).prop_map(|e| 10_f64.powf(e)),
        4 => (0.0..largest_exponent).prop_map(|e| 10_f64.powf(e)),
    ]
}

fn celerity_to(largest_exponent: f64) -> impl Strategy<Value = Celerity> {
    (direction(), speed(largest_exponent))
        .prop_map(|(direction, speed)| Celerity::new(direction * speed).expect("finite"))
}

fn celerity() -> impl Strategy<Value = Celerity> {
    celerity_to(12.0)
}

/// A motion, and light that travels along it, against it, across it or at a grazing angle to
/// either, or anywhere.
fn motion_and_light() -> impl Strategy<Value = (Celerity, DVec3)> {
    (
        celerity(),
        direction(),
        direction(),
        -16.0..0.0_f64,
        0..6_u8,
    )
        .prop_map(|(u, n, other, exponent, kind)| {
            let axis = u.vector().try_normalize().unwrap_or(DVec3::Z);
            let across = axis
                .cross(other)
                .try_normalize()
                .unwrap_or(axis.any_orthonormal_vector());
            let tilt = 10_f64.powf(exponent);
            let n = match kind {
                0 => axis,
                1 => -axis,
                2 => across,
                3 => axis + across * tilt,
                4 => across - axis * tilt,
                _ => n,
            };
            (u, n.normalize())
        })
}

/// An event some light-metres away.
fn event() -> impl Strategy<Value = Event> {
    let coordinate = || prop_oneof![Just(0.0), -10.0..10.0_f64, -1e-3..1e-3_f64];
    (coordinate(), coordinate(), coordinate(), coordinate())
        .prop_map(|(t, x, y, z)| Event::new(t, DVec3::new(x, y, z)))
}

fn size(v: FourVector) -> f64 {
    v.t.abs() + v.x.length()
}

fn as_vector(e: Event) -> FourVector {
    FourVector::new(e.t, e.x)
}

/// Two worldlines that may be far apart in velocity, or side by side at any speed.
fn pair_of_celerities() -> impl Strategy<Value = (Celerity, Celerity)> {
    prop_oneof![
        (celerity_to(6.0), celerity_to(6.0)),
        (celerity_to(6.0), celerity_to(0.5)).prop_map(|(u, w)| (u, beside(u, w))),
    ]
}

/// A celerity near u: u plus w, which is of the order of 1 or less.
fn beside(u: Celerity, w: Celerity) -> Celerity {
    Celerity::new(u.vector() + w.vector()).expect("finite")
}

fn through_one_event(celerity: Celerity) -> Worldline {
    Worldline {
        celerity,
        ..Worldline::LAB
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    /// Also D(u, n)·D(−u, n′) = 1. The direction n′ is rounded, by ε. Its frequency ratio r′ has
    /// |∂ ln r′/∂θ′| = |u sin θ′|/r′ ≤ |u|, and going back stretches angles by r.
    #[test]
    fn light_boosted_there_and_back_is_the_same_light((u, n) in motion_and_light()) {
        let there = Boost::into_rest_of(u).light(n);
        let back = Boost::into_rest_of(u.reversed()).light(there.direction);
        let ratio = there.frequency_ratio * back.frequency_ratio;
        let speed = u.magnitude();
        prop_assert!((ratio - 1.0).abs() <= ROUNDINGS * EPSILON * (1.0 + speed), "{ratio}");
        let off = (back.direction - n).length();
        prop_assert!(off <= ROUNDINGS * EPSILON * (1.0 + speed + there.frequency_ratio), "{off}");
    }

    /// Light exactly along the motion stays so, and then nothing cancels: √((1−β)/(1+β)).
    #[test]
    fn light_along_the_motion_has_the_longitudinal_doppler_factor(u in celerity()) {
        prop_assume!(!u.is_rest());
        let along = Boost::into_rest_of(u).light(u.vector()).frequency_ratio;
        let against = Boost::into_rest_of(u).light(-u.vector()).frequency_ratio;
        let expected = u.lorentz_factor() + u.magnitude();
        prop_assert!((against / expected - 1.0).abs() <= 8.0 * EPSILON);
        prop_assert!((along * against - 1.0).abs() <= 8.0 * EPSILON);
    }

    #[test]
    fn boosted_light_stays_null_and_its_frequency_positive((u, n) in motion_and_light()) {
        let light = Boost::into_rest_of(u).light(n);
        prop_assert!((light.direction.length() - 1.0).abs() <= ROUNDINGS * EPSILON, "{light:?}");
        let largest = (u.lorentz_factor() + u.magnitude()) * (1.0 + ROUNDINGS * EPSILON);
        prop_assert!(light.frequency_ratio >= 1.0 / largest && light.frequency_ratio <= largest);
    }

    /// The boost of light is the boost of its null vector, where that does not cancel.
    #[test]
    fn light_is_boosted_like_its_four_vector((u, n) in motion_and_light()) {
        let boost = Boost::into_rest_of(u);
        let light = boost.light(n);
        let vector = boost.vector(FourVector::new(1.0, n));
        let bound = ROUNDINGS * EPSILON * (u.lorentz_factor() + u.magnitude());
        prop_assert!((vector.t - light.frequency_ratio).abs() <= bound);
        prop_assert!((vector.x - light.direction * light.frequency_ratio).length() <= bound);
    }

    /// Both forms of the ratio meet where light travels across the motion.
    #[test]
    fn the_doppler_factor_is_continuous_across_the_motion(
        (u, other) in (celerity(), direction()), exponent in -16.0..-8.0_f64,
    ) {
        prop_assume!(!u.is_rest());
        let axis = u.vector().normalize();
        let Some(across) = axis.cross(other).try_normalize() else { return Ok(()) };
        let tilt = 10_f64.powf(exponent);
        let ratio = |n: DVec3| Boost::into_rest_of(u).light(n).frequency_ratio;
        let (before, after) = (ratio(across - axis * tilt), ratio(across + axis * tilt));
        // γ ± u·tilt, and ε of `across` not being quite so.
        let gamma = u.lorentz_factor();
        let bound = u.magnitude() * (2.0 * tilt + ROUNDINGS * EPSILON) + ROUNDINGS * EPSILON * gamma;
        prop_assert!((before - after).abs() <= bound, "{before} {after}");
        prop_assert!((before - gamma).abs() <= bound && (after - gamma).abs() <= bound);
    }

    #[test]
    fn the_doppler_factor_is_continuous_at_rest(
        (axis, n) in (direction(), direction()), exponent in -300.0..-3.0_f64,
    ) {
        let u = Celerity::new(axis * 10_f64.powf(exponent)).expect("finite");
        let light = Boost::into_rest_of(u).light(n);
        let bound = u.magnitude() * (1.0 + u.magnitude()) + ROUNDINGS * EPSILON;
        prop_assert!((light.frequency_ratio - 1.0).abs() <= bound);
        prop_assert!((light.direction - n).length() <= 2.0 * bound);
    }

    /// Every component is right within ε(γ + |u|)(|t| + |x|), which is E; (d − t)(d + t) then
    /// within 2E(|t′| + |x′|), and ε of the interval itself.
    #[test]
    fn the_interval_is_invariant(u in celerity(), e in event()) {
        let v = as_vector(e);
        let boosted = Boost::into_rest_of(u).vector(v);
        let component = ROUNDINGS * EPSILON * (u.lorentz_factor() + u.magnitude()) * size(v);
        let bound = 2.0 * component * (size(boosted) + component) + 8.0 * EPSILON * size(v).powi(2);
        prop_assert!((boosted.interval() - v.interval()).abs() <= bound);
    }

    /// Between worldlines side by side the relative speed alone sets the bound, however fast both
    /// are: the lab is not on the way.
    #[test]
    fn the_interval_is_invariant_between_any_two_worldlines(
        (u, v) in pair_of_celerities(), e in event(),
    ) {
        let transform = Transform::between(&through_one_event(u), &through_one_event(v));
        let there = as_vector(transform.event(e));
        let w = v.seen_from(u);
        let component = ROUNDINGS * EPSILON * (w.lorentz_factor() + w.magnitude()) * size(as_vector(e));
        let bound = 2.0 * component * (size(there) + component)
            + 8.0 * EPSILON * size(as_vector(e)).powi(2);
        prop_assert!((there.interval() - as_vector(e).interval()).abs() <= bound);
    }

    /// B(v)·B(u)⁻¹ composed once against going through the lab, whose error is γ_v of the vector
    /// in the lab, itself up to 2γ_u of the event.
    #[test]
    fn a_composed_transform_is_the_way_through_the_lab(
        (u, v) in pair_of_celerities(), e in event(), (from, to) in (event(), event()),
    ) {
        let from = Worldline { celerity: u, origin: from };
        let to = Worldline { celerity: v, origin: to };
        let direct = Transform::between(&from, &to).event(e);
        let in_lab = Boost::into_rest_of(u.reversed()).event(e)
            + (from.origin - Event::new(0.0, DVec3::ZERO));
        let long = Boost::into_rest_of(v).vector(in_lab - to.origin);
        let through = 2.0 * u.lorentz_factor() * size(as_vector(e))
            + size(as_vector(from.origin)) + size(as_vector(to.origin));
        let bound = ROUNDINGS * EPSILON * 2.0 * v.lorentz_factor() * through;
        prop_assert!((direct.t - long.t).abs() <= bound, "{direct:?} {long:?}");
        prop_assert!((direct.x - long.x).length() <= bound, "{direct:?} {long:?}");
    }

    /// a to c is a to b, then b to c, with the Wigner rotations that these need. Relative speeds
    /// set the bound, also where all three move at γ = 10⁶.
    #[test]
    fn transforms_compose(
        u in celerity_to(6.0), (v, w) in (celerity_to(0.5), celerity_to(0.5)), e in event(),
    ) {
        let [a, b, c] = [u, beside(u, v), beside(u, w)].map(through_one_event);
        let direct = Transform::between(&a, &c).event(e);
        let via = Transform::between(&b, &c).event(Transform::between(&a, &b).event(e));
        let stretch = |from: &Worldline, to: &Worldline| {
            let w = to.celerity.seen_from(from.celerity);
            w.lorentz_factor() + w.magnitude()
        };
        let bound = 4.0 * ROUNDINGS * EPSILON
            * (stretch(&a, &b) * stretch(&b, &c) + stretch(&a, &c)) * size(as_vector(e));
        prop_assert!((direct.t - via.t).abs() <= bound, "{direct:?} {via:?}");
        prop_assert!((direct.x - via.x).length() <= bound, "{direct:?} {via:?}");
    }

    #[test]
    fn two_bodies_see_each_other_equally_fast((u, v) in pair_of_celerities()) {
        let (there, back) = (v.seen_from(u).magnitude(), u.seen_from(v).magnitude());
        prop_assert!((there - back).abs() <= 2.0 * 2e-14 * there.max(back), "{there:e} {back:e}");
        prop_assert_eq!(u.seen_from(u), Celerity::REST);
    }

    /// γ_w = γ_u γ_v − u·v, which cancels: within ε of its terms.
    #[test]
    fn the_relative_lorentz_factor_is_the_product_of_four_velocities((u, v) in pair_of_celerities()) {
        let product = u.lorentz_factor() * v.lorentz_factor();
        let expected = product - u.vector().dot(v.vector());
        let found = v.seen_from(u).lorentz_factor();
        prop_assert!((found - expected).abs() <= ROUNDINGS * EPSILON * product + 4e-14 * found);
    }

    #[test]
    fn an_event_of_a_worldline_has_the_lab_time_asked_for(
        u in celerity_to(6.0), position in event(), origin in event(), time in -10.0..10.0_f64,
    ) {
        let worldline = Worldline { celerity: u, origin };
        let e = worldline.event_at_lab_time(position.x, time);
        let lab = Transform::between(&worldline, &Worldline::LAB).event(e);
        let reach = (u.lorentz_factor() + u.magnitude())
            * (size(as_vector(e)) + position.x.length()) + size(as_vector(origin));
        prop_assert!((lab.t - time).abs() <= ROUNDINGS * EPSILON * (reach + time.abs()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    /// Seen at a place X from where the point is now, its light left R ago: |X + βR| = R, and
    /// R = γ(u·X) + γ√((u·X)² + X²), a sum or, where u·X < 0, γX² over the difference. The dot
    /// product is rounded by ε|u||X|; on the way through the point's frame its direction is, by ε,
    /// which is γε of a factor near the light cone.
    #[test]
    fn light_left_a_moving_point_when_the_quadratic_says(
        u in celerity_to(6.0), (n, log_distance) in (direction(), -6.0..6.0_f64), now in -10.0..10.0_f64,
    ) {
        let x = n * 10_f64.powf(log_distance);
        let line = Worldline { celerity: u, origin: Event::new(now, DVec3::ZERO) };
        let seen_at = Transform::between(&Worldline::LAB, &line).event(Event::new(now, x));
        let arrival = light_arriving(seen_at, DVec3::ZERO).expect("not at the point itself");
        let light = Transform::between(&line, &Worldline::LAB).light(arrival.direction);
        let found = arrival.distance * light.frequency_ratio;
        let (gamma, along) = (u.lorentz_factor(), u.vector().dot(x));
        let root = along.hypot(x.length());
        let expected = if along >= 0.0 {
            gamma * (along + root)
        } else {
            gamma * x.length_squared() / (root - along)
        };
        let bound = ROUNDINGS * EPSILON * (1.0 + 2.0 * gamma);
        prop_assert!((found / expected - 1.0).abs() <= bound, "{found:e} {expected:e}");
        let from = x + u.beta() * found;
        prop_assert!((light.direction * found - from).length() <= bound * found);
        prop_assert!(arrival.emission.t < seen_at.t && arrival.emission.x == DVec3::ZERO);
    }

    /// By another form, 1/(eˣ − 1) = e^(−x/2)/(2 sinh x/2), where neither over- nor underflows; the
    /// oracle loses as much as the law itself.
    #[test]
    fn plancks_law_holds_in_the_form_of_the_hyperbolic_sine(
        log_nm in -3.0..12.0_f64, log_x in -12.0..2.8_f64,
    ) {
        let nm = 10_f64.powf(log_nm);
        let temperature_k = planck::C2 / nm / 10_f64.powf(log_x);
        let x = planck::C2 / (nm * temperature_k);
        let expected = planck::C1 / nm.powi(5) * ((-0.5 * x).exp() / (2.0 * (0.5 * x).sinh()));
        let found = planck::radiance(nm, temperature_k);
        let bound = 2.0 * 4.0 * EPSILON * x.max(4.0);
        prop_assert!((found / expected - 1.0).abs() <= bound, "{found:e} {expected:e}");
        let ln = planck::ln_radiance(nm, temperature_k);
        let ln_bound = 4.0 * EPSILON * (5.0 * nm.ln().abs() + 2.0 * x + 40.0);
        prop_assert!((ln - expected.ln()).abs() <= ln_bound, "{ln} {}", expected.ln());
    }

    /// λT alone decides, but for λ⁻⁵: by powers of two this is exact to the bit. By any factor, a
    /// moving black body is one of temperature D·T; λ·D and D·T are rounded, which costs ε·x each.
    #[test]
    fn a_shifted_black_body_is_a_black_body(
        (log_nm, log_x) in (-3.0..12.0_f64, -9.0..2.5_f64), octaves in -20..20_i32, log_d in -9.0..9.0_f64,
    ) {
        let nm = 10_f64.powf(log_nm);
        let temperature_k = planck::C2 / nm / 10_f64.powf(log_x);
        let here = planck::radiance(nm, temperature_k);
        let by = 2_f64.powi(octaves);
        prop_assert_eq!(planck::radiance(nm / by, temperature_k * by), here * by.powi(5));
        let d = 10_f64.powf(log_d);
        let moving = planck::ln_radiance(nm / d, temperature_k * d);
        let expected = planck::ln_radiance(nm, temperature_k) + 5.0 * d.ln();
        let size = 5.0 * (nm.ln().abs() + d.ln().abs()) + 4.0 * 10_f64.powf(log_x) + 80.0;
        prop_assert!((moving - expected).abs() <= 4.0 * EPSILON * size, "{moving} {expected}");
    }

    /// Each piece by de Casteljau's construction from its four control points, which knows no
    /// powers: both round by some ε of the largest of them.
    #[test]
    fn a_cardinal_spline_is_its_bezier_curve(
        knots in prop::collection::vec((-3.0..3.0_f64, spline_value()), 2..8), tension in 0.0..=1.0_f64,
        (piece, share) in (0..7_usize, 0.0..1.0_f64),
    ) {
        let mut nm = 300.0;
        let points: Vec<(f64, f64)> = knots
            .iter()
            .map(|&(log_width, value)| {
                nm += 10_f64.powf(log_width);
                (nm, value)
            })
            .collect();
        let curve = Cardinal::new(&points, tension, Beyond::Hold).expect("ascending and positive");
        for &(nm, value) in &points {
            prop_assert_eq!(curve.unclamped(nm), value);
        }
        let last = points.len() - 1;
        let left = piece % last;
        let slope = |i: usize| {
            let (a, b) = (points[i.saturating_sub(1)], points[(i + 1).min(last)]);
            (1.0 - tension) * (b.1 - a.1) / (b.0 - a.0)
        };
        let (p, q) = (points[left], points[left + 1]);
        let lambda_nm = p.0 + share * (q.0 - p.0);
        let third = (q.0 - p.0) / 3.0;
        let control = [p.1, p.1 + slope(left) * third, q.1 - slope(left + 1) * third, q.1];
        let t = (lambda_nm - p.0) / (q.0 - p.0);
        let mut hull = control;
        for count in (1..4).rev() {
            for i in 0..count {
                hull[i] = (1.0 - t) * hull[i] + t * hull[i + 1];
            }
        }
        let size = control.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
        let found = curve.unclamped(lambda_nm);
        prop_assert!((found - hull[0]).abs() <= 2.0 * ROUNDINGS * EPSILON * size, "{found} {}", hull[0]);
        prop_assert!(curve.at(lambda_nm) >= 0.0 && found <= curve.peak() * (1.0 + 4.0 * EPSILON) + 4.0 * EPSILON * size);
    }
}

/// A spline's value: none, everyday, or of any size.
fn spline_value() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        3 => 0.0..1.0_f64,
        2 => (-290.0..290.0_f64).prop_map(|e| 10_f64.powf(e)),
    ]
}

/// Keys at ascending frames, with values of any size, or a few ulps apart: there rounding shows.
fn keys() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let value = prop_oneof![-1.0..1.0_f64, -1e300..1e300_f64, Just(0.0)];
    let any = prop::collection::vec((1_u32..40, value), 1..6);
    let ulps = prop::collection::vec((1_u32..40, 0..5_u64), 1..6);
    let close = (0.1..1.0_f64, ulps).prop_map(|(base, keys)| {
        let beside = |ulps: u64| f64::from_bits(base.to_bits() + ulps);
        keys.into_iter()
            .map(|(frame, ulps)| (frame, beside(ulps)))
            .collect()
    });
    prop_oneof![any, close].prop_map(|mut keys: Vec<(u32, f64)>| {
        keys.sort_by_key(|(frame, _)| *frame);
        keys.dedup_by_key(|(frame, _)| *frame);
        keys.into_iter()
            .map(|(frame, value)| (f64::from(frame), value))
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn a_track_never_leaves_the_two_keys_that_it_moves_between(
        keys in keys(), ease in prop::sample::select(vec![Ease::Linear, Ease::Smooth, Ease::Hold]),
        frame in 1_u32..40,
    ) {
        let at = f64::from(frame);
        let before = keys.iter().rfind(|(key, _)| *key <= at).unwrap_or(&keys[0]).1;
        let after = keys.iter().find(|(key, _)| *key >= at).unwrap_or(&keys[keys.len() - 1]).1;
        let value = Track::Keys { keys, ease }.at(frame, 40);
        prop_assert!(value >= before.min(after) && value <= before.max(after), "{before} {value} {after}");
    }

    #[test]
    fn a_ramp_stays_between_its_ends_and_reaches_both(
        from in -1e300..1e300_f64, to in -1e300..1e300_f64, frames in 2_u32..500, share in 0.0..1.0_f64,
    ) {
        let ramp = Track::Ramp { from, to };
        let frame = 1 + (f64::from(frames - 1) * share) as u32;
        let value = ramp.at(frame, frames);
        prop_assert!(value >= from.min(to) && value <= from.max(to));
        prop_assert_eq!((ramp.at(1, frames), ramp.at(frames, frames)), (from, to));
    }

    /// In every grid of 2^a by 2^b cells with a + b = n, whatever the pixel.
    #[test]
    fn two_to_the_n_samples_fill_every_elementary_grid(
        x in any::<u32>(), y in any::<u32>(), n in 1_u32..9, columns in 0_u32..9,
    ) {
        let columns = columns.min(n);
        let (width, height) = (1_usize << columns, 1_usize << (n - columns));
        let samples = Samples::new(1 << n, Filter::Box);
        let mut filled = vec![false; width * height];
        for index in 0..1 << n {
            let [u, v] = samples.position(x, y, index);
            let cell = (u * width as f64) as usize + width * (v * height as f64) as usize;
            prop_assert!(!filled[cell], "sample {index} at {u}, {v}");
            filled[cell] = true;
        }
    }

    /// So that parts given with the same fractions leave no row out and take none twice.
    #[test]
    fn splices_that_meet_share_no_row_and_leave_none_out(
        cut in prop_oneof![0.0..=1.0_f64, (0_u32..=64).prop_map(|n| f64::from(n) / 64.0)],
        height in 1_u32..5000,
    ) {
        let rows_of = |rows_: [f64; 2]| Splice { rows: rows_, effects: Effects::default() }.rows_of(height);
        let (upper, lower) = (rows_of([0.0, cut]), rows_of([cut, 1.0]));
        prop_assert_eq!((upper.start, upper.end, lower.end), (0, lower.start, height));
    }
}

proptest! {
    // Few: each tabulates the filter anew.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]

    #[test]
    fn samples_stay_within_the_filters_reach_of_their_pixel(
        x in any::<u32>(), y in any::<u32>(), count in 1_u32..300, index in 0_u32..300,
    ) {
        for (filter, reach) in [(Filter::Box, 0.5), (Filter::BlackmanHarris, 0.75)] {
            let samples = Samples::new(count, filter);
            let position = samples.position(x, y, index % count);
            prop_assert!(position.iter().all(|p| (p - 0.5).abs() <= reach), "{position:?}");
            prop_assert_eq!(position, Samples::new(count, filter).position(x, y, index % count));
        }
    }
}
