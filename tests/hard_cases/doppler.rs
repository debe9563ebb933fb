//! B. Doppler factor and aberration.
//!
//! ε is 2⁻⁵². n is the direction in which light travels, towards the camera; D = ω_observed/ω_source.

use super::numbers::{Random, product};
use super::pictures::{Picture, far_wall, glow};
use super::scene::Set;
use glam::DVec3;
use restframe::probe::{Probe, ProbeHit};
use restframe::relativity::{Boost, Celerity, SeenLight, Transform, Worldline};
use restframe::trace::Spacetime;

const EPSILON: f64 = f64::EPSILON;

fn along_z(beta: f64) -> Celerity {
    Celerity::from_beta(DVec3::Z * beta).unwrap()
}

fn of_gamma(lorentz_factor: f64, direction: DVec3) -> Celerity {
    Celerity::from_lorentz_factor(lorentz_factor, direction).unwrap()
}

/// Light of direction `n` in the lab as a body of celerity `u` sees it.
fn seen(u: Celerity, n: DVec3) -> SeenLight {
    Boost::into_rest_of(u).light(n)
}

/// D of light of direction `n` in the lab from a source of celerity `u`.
fn from_source(u: Celerity, n: DVec3) -> f64 {
    1.0 / seen(u, n).frequency_ratio
}

fn between(u: Celerity, v: Celerity) -> Transform {
    let line = |celerity| Worldline {
        celerity,
        ..Worldline::LAB
    };
    Transform::between(&line(u), &line(v))
}

/// What the middle pixel meets.
fn met(set: &Set) -> ProbeHit {
    set.probe([2, 2]).hit.unwrap()
}

fn fast(velocity: &str) -> String {
    format!("[worldline.fast]\nvelocity = {velocity}\n")
}

/// A wall that moves like this, met from 1 m in front of it.
fn wall_head_on(velocity: &str) -> ProbeHit {
    met(&glow(
        &fast(velocity),
        "worldline = \"fast\"",
        "position = [0, 0, 1]",
    ))
}

/// The resting wall at z = −1000, met by a camera that moves like this and is turned by `yaw`, degrees.
fn from_a_car(velocity: &str, yaw: f64) -> ProbeHit {
    let camera = format!("worldline = \"fast\"\nyaw = {yaw:?}");
    met(&glow(&fast(velocity), &far_wall("lab"), &camera))
}

/// tan θ/2 of a direction's angle to +z, without cancellation.
fn tan_half(n: DVec3) -> f64 {
    let across = n.x.hypot(n.y);
    if n.z > 0.0 {
        across / (1.0 + n.z)
    } else {
        (1.0 - n.z) / across
    }
}

/// A wall that slides by at γ = 1.25 under a sun, both seen from above, and the same at rest.
fn slid_and_still() -> [Probe; 2] {
    ["[0.6, 0, 0]", "[0, 0, 0]"].map(|velocity| {
        Set::new(&format!(
            "[image]\nsize = [5, 5]\n[sensor]\nexposure = 0\n[accuracy]\nspectra = \"spline\"\n{}\
             [material.chalk]\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\n\
             [[model]]\nfile = \"wall.obj\"\nmaterial = \"chalk\"\nscale = 100\nworldline = \"fast\"\n\
             [[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\nscale = 1.0\nspectrum = {{ gaussian = {{ center = 560, width = 30 }} }}\n\
             [camera]\nposition = [0, 0, 1]\n",
            fast(velocity)
        ))
        .probe([2, 2])
    })
}

cases! {
    /// √3, 1/√3 and e^artanh 0.99 to 17 digits. γβ of β takes five roundings, D two more; 0.99 as f64
    /// hold it is off by 9e-18, D so by γ² times that, 2ε.
    fn b1_head_on_the_factor_is_the_exponential_of_rapidity(card) {
        for (beta, exact) in [
            (0.5, 1.7320508075688773),
            (-0.5, 0.5773502691896258),
            (0.99, 14.106735979665884),
        ] {
            card.relative(
                &format!("D at {beta} c"),
                exact,
                from_source(along_z(beta), DVec3::Z),
                8.0 * EPSILON,
            );
            let hit = wall_head_on(&format!("[0, 0, {beta:?}]"));
            card.relative("of a wall, seen", exact, hit.doppler, 8.0 * EPSILON);
        }
        for eta in [1e-9f64, 1.0, 20.0, 100.0] {
            let u = Celerity::from_rapidity(eta, DVec3::Z).unwrap();
            card.relative(
                &format!("D at rapidity {eta}"),
                eta.exp(),
                from_source(u, DVec3::Z),
                8.0 * EPSILON,
            );
        }
    }

    /// Seen from a car, light across the source's frame arrives from asin 0.6 ahead, a yaw of
    /// 36.87°; D varies with it by 0.94 a radian.
    fn b2_transverse_light_has_two_meanings(card) {
        let u = Celerity::from_beta(DVec3::X * 0.6).unwrap();
        card.relative(
            "across in the observer's frame, 0.6 c",
            0.8,
            from_source(u, DVec3::Z),
            8.0 * EPSILON,
        );
        card.relative(
            "across in the source's frame",
            1.25,
            seen(u, DVec3::Z).frequency_ratio,
            8.0 * EPSILON,
        );
        let slid = glow(&fast("[0.6, 0, 0]"), &far_wall("fast"), "yaw = 0");
        // Seen 1000 m away, the wall has slid by 600 m.
        card.relative(
            "of a wall that slides by, seen",
            0.8,
            met(&slid).doppler,
            8.0 * EPSILON,
        );
        let passed = from_a_car("[0.6, 0, 0]", 36.86989764584402);
        card.relative(
            "of a resting wall, seen from a car",
            1.25,
            passed.doppler,
            8.0 * EPSILON,
        );
        card.near(
            "across which its light travels",
            0.0,
            passed.event.x[0],
            1000.0 * 8.0 * EPSILON,
        );
        for lorentz_factor in [1e3, 1e8] {
            let u = of_gamma(lorentz_factor, DVec3::X);
            card.relative(
                &format!("across in the observer's frame, γ = {lorentz_factor}"),
                1.0 / lorentz_factor,
                from_source(u, DVec3::Z),
                8.0 * EPSILON,
            );
            card.relative(
                "across in the source's frame",
                lorentz_factor,
                seen(u, DVec3::Z).frequency_ratio,
                8.0 * EPSILON,
            );
        }
    }

    /// acos tanh η/2 to 17 digits. The factor turns by D²γβ sin θ a radian, 0.26 at the least, so
    /// that D to 4ε fixes the angle to 4e-15 rad; rounding of cosines 2e-16/sin θ more.
    fn b3_at_the_crossover_angle_nothing_shifts(card) {
        let looks = [
            (0.25, 82.70277005246166, -7.297229947538344),
            (0.5, 74.45773177662285, -15.542268223377151),
            (0.99, 29.818063846299613, -60.18193615370039),
        ];
        for (beta, degrees, yaw) in looks {
            let u = along_z(beta);
            let light = |degrees: f64| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                from_source(u, DVec3::new(sin, 0.0, cos))
            };
            let (mut blue, mut red) = (0.0, 90.0);
            for _ in 0..60 {
                let middle = 0.5 * (blue + red);
                if light(middle) > 1.0 {
                    blue = middle
                } else {
                    red = middle
                }
            }
            card.near(
                &format!("angle at which D passes 1, {beta} c, degrees"),
                degrees,
                red,
                1e-12,
            );
            let camera = format!("yaw = {yaw:?}");
            let hit = met(&glow(
                &fast(&format!("[{beta:?}, 0, 0]")),
                &far_wall("fast"),
                &camera,
            ));
            card.near(
                "D of a wall at that angle, seen",
                1.0,
                hit.doppler,
                8.0 * EPSILON * 7.02,
            );
        }
        // D = 1 where light leaves as far behind as it arrives ahead: n′∥ = −n∥ = −tanh η/2. At
        // β = 1e-9 that is 5e-10, though D itself stays 1 within 1e-18 all about.
        let slow = Celerity::from_beta(DVec3::X * 1e-9).unwrap();
        let across = DVec3::new(5e-10, 0.0, 1.0);
        card.relative(
            "1e-9 c: cosine in the source's frame of light at cosine 5e-10",
            -5e-10,
            seen(slow, across).direction.x,
            4.0 * EPSILON,
        );
        let scene = glow(&fast("[1e-9, 0, 0]"), &far_wall("fast"), "").scene();
        let link = *Spacetime::new(&scene, true).link(1, 0);
        card.relative(
            "the same in a shot",
            -5e-10,
            link.light(across).direction.x,
            4.0 * EPSILON,
        );
        card.near("its D", 1.0, link.light(across).frequency_ratio, EPSILON);
    }

    /// With tan θ = 1/γ, D = γ(1 + 1/(2γ²) + …).
    fn b4_light_just_off_the_motion_is_not_taken_for_forward(card) {
        for lorentz_factor in [1e8, 1e9, 1e12] {
            let u = of_gamma(lorentz_factor, DVec3::Z);
            let n = DVec3::new(1.0 / lorentz_factor, 0.0, 1.0);
            card.relative(
                &format!("D at θ = 1/γ, γ = {lorentz_factor:e}"),
                lorentz_factor,
                from_source(u, n),
                8.0 * EPSILON,
            );
            // Half of what is ahead: D = 2γ/(1 + γ²θ²).
            let n = DVec3::new(0.0, 3.0 / lorentz_factor, 1.0);
            card.relative(
                "at θ = 3/γ",
                lorentz_factor / 5.0,
                from_source(u, n),
                8.0 * EPSILON,
            );
        }
        // In the wall's frame that light travels across the motion, from a wall on the left. The
        // camera turns left by 1e-8.
        let left =
            "worldline = \"fast\"\ntranslate = [-5, 0, 0]\nrotate = [0, 90, 0]\nscale = 1000";
        let hit = met(&glow(
            &fast("{ gamma = 1e8, direction = [0, 0, 1] }"),
            left,
            "yaw = -5.7295779513082320877e-7",
        ));
        card.relative(
            "D of a wall at θ = 1/γ, γ = 1e8, seen",
            1e8,
            hit.doppler,
            8.0 * EPSILON,
        );
    }

    /// There and back the direction between is rounded by ε, which |u sin θ′| turns into the factor's:
    /// none along the motion, below ε at speeds like those of the first line.
    fn b5_the_way_back_undoes_the_factor(card) {
        let mut random = Random(5);
        let mut worst = 0f64;
        for _ in 0..10_000 {
            let u =
                Celerity::from_beta(random.vector().normalize() * (0.6 * random.next())).unwrap();
            let there = seen(u, random.vector());
            worst = worst.max(
                (there.frequency_ratio * seen(u.reversed(), there.direction).frequency_ratio - 1.0)
                    .abs(),
            );
        }
        card.at_most(
            "D there · D back − 1 in 10 000 directions up to 0.6 c",
            worst,
            4.0 * EPSILON,
        );
        for lorentz_factor in [2.0, 1e3, 1e8] {
            let u = of_gamma(lorentz_factor, DVec3::new(1.0, -2.0, 0.5));
            let ways = [u.vector(), -u.vector()].map(|n| {
                let there = seen(u, n);
                (there.frequency_ratio * seen(u.reversed(), n).frequency_ratio - 1.0).abs()
            });
            card.at_most(
                &format!("along and against the motion, γ = {lorentz_factor:e}"),
                ways[0].max(ways[1]),
                4.0 * EPSILON,
            );
        }
        // The sun's light reaches the wall by D = γ and the camera by 1/γ, in all by 1; in the wall's
        // frame it falls at cosine 1/γ. So the curve returns times D³·D⁵/γ = γ³γ⁻⁵γ⁻¹ = 1.25⁻³.
        let [slid, still] = slid_and_still();
        let top = still.radiance.iter().copied().fold(0.0, f64::max);
        let off = slid
            .radiance
            .iter()
            .zip(&still.radiance)
            .map(|(slid, still)| (slid * 1.953125 - still).abs() / top);
        card.relative(
            "D of a wall lit from above, seen from above",
            0.8,
            slid.hit.unwrap().doppler,
            8.0 * EPSILON,
        );
        // Curves are held in f32: two of them, 6e-8 each.
        card.at_most(
            "its spectrum, shifted by 1.25 and by 0.8, over the peak",
            off.fold(0.0, f64::max),
            2e-7,
        );
    }

    /// Each link rounds its direction and so the next factor, by |w| sin θ of ε.
    fn b6_factors_through_any_frame_between_multiply(card) {
        let mut random = Random(6);
        for fastest in [1.0, 3.0, 7.0] {
            let mut worst = 0f64;
            for _ in 0..2000 {
                let [a, b, c] = [(); 3].map(|()| {
                    let direction = random.vector();
                    Celerity::from_rapidity(fastest * random.next(), direction).unwrap()
                });
                let n = random.vector().normalize();
                let direct = between(a, c).light(n);
                let first = between(a, b).light(n);
                let second = between(b, c).light(first.direction);
                let product = first.frequency_ratio * second.frequency_ratio;
                let size = [(a, b), (b, c), (a, c)].map(|(u, v)| v.seen_from(u).magnitude());
                let bound = 8.0 + 4.0 * size.iter().sum::<f64>();
                worst =
                    worst.max((product / direct.frequency_ratio - 1.0).abs() / (bound * EPSILON));
                // The directions too, with the turns of each step: aberration stretches by 1/D.
                let stretch = bound * (1.0 + 1.0 / second.frequency_ratio);
                worst =
                    worst.max((second.direction - direct.direction).length() / (stretch * EPSILON));
            }
            card.at_most(
                &format!(
                    "2000 chains up to rapidity {fastest}: D and direction, over (8 + 4 Σ|w|)ε"
                ),
                worst,
                1.0,
            );
        }
        let scene = Picture::on_four(0.0).set().scene();
        let spacetime = Spacetime::new(&scene, true);
        let count = scene.worldlines.len();
        let n = DVec3::new(-0.36, 0.48, 0.8);
        let mut worst = 0f64;
        for chain in 0..count * count * count {
            let [a, b, c] = [chain % count, chain / count % count, chain / count / count];
            let first = spacetime.link(b, a).light(n);
            let product =
                first.frequency_ratio * spacetime.link(c, b).light(first.direction).frequency_ratio;
            worst =
                worst.max((product / spacetime.link(c, a).light(n).frequency_ratio - 1.0).abs());
        }
        card.at_most(
            "all chains of three of a shot's five worldlines, 0.3 to 0.9 c",
            worst,
            16.0 * EPSILON,
        );
    }

    /// 2 ulp of 1 are 2ε. θ′ by tan θ′/2 = e^η tan θ/2, e^η = γ + u; where a body's frame is the primed.
    fn b7_aberration_holds_at_every_angle(card) {
        for beta in [0.01, 0.6, 0.99] {
            let n = seen(Celerity::from_beta(DVec3::Z * beta).unwrap(), DVec3::NEG_X).direction;
            card.relative(
                &format!("sin of the transverse star's angle at {beta} c"),
                beta,
                -n.z,
                8.0 * EPSILON,
            );
            let u = beta / ((1.0 - beta) * (1.0 + beta)).sqrt();
            card.relative("tan", u, n.z / n.x, 8.0 * EPSILON);
        }
        let ahead = from_a_car("[0.6, 0, 0]", 36.86989764584402);
        card.near(
            "a star seen at asin 0.6 from across a car's way stands across it",
            0.0,
            ahead.event.x[0] / ahead.distance,
            8.0 * EPSILON,
        );
        let mut random = Random(77);
        let mut off_unit = 0f64;
        for _ in 0..20_000 {
            let direction = random.vector();
            let u = Celerity::from_rapidity(30.0 * random.next(), direction).unwrap();
            let n = seen(u, random.vector()).direction;
            off_unit = off_unit.max(product(n.extend(1.0), n.extend(1.0)).abs() / 2.0);
        }
        card.at_most(
            "|n′| − 1 in 20 000 directions up to γ = 5e12",
            off_unit,
            2.0 * EPSILON,
        );
        for lorentz_factor in [1.25, 1e3, 1e6] {
            let u = of_gamma(lorentz_factor, DVec3::Z);
            let stretch = lorentz_factor + ((lorentz_factor - 1.0) * (lorentz_factor + 1.0)).sqrt();
            // tan(0.5e-9), tan(π/2 − 0.5e-9) = 2e9 but for 1e-19.
            for (name, n, tan) in [
                ("1e-9", DVec3::new(1e-9, 0.0, 1.0), 0.5e-9),
                ("π − 1e-9", DVec3::new(1e-9, 0.0, -1.0), 2e9),
                ("π/2", DVec3::X, 1.0),
            ] {
                let found = tan_half(seen(u, n).direction);
                card.relative(
                    &format!("tan θ′/2 at θ = {name}, γ = {lorentz_factor}"),
                    stretch * tan,
                    found,
                    8.0 * EPSILON,
                );
            }
        }
        // From a car at 0.6 c along −z, e^η = 2: what is seen 1e-9 off the way ahead stands 2e-9 off.
        let ahead = from_a_car("[0, 0, -0.6]", 5.729577951308232e-8);
        card.relative(
            "seen 1e-9 off the way ahead: stands off it by",
            2e-9,
            ahead.event.x[0] / ahead.distance,
            8.0 * EPSILON,
        );
        let behind = from_a_car("[0, 0, 0.6]", 5.729577951308232e-8);
        card.relative(
            "seen 1e-9 off the way behind",
            0.5e-9,
            behind.event.x[0] / behind.distance,
            8.0 * EPSILON,
        );
    }

    /// To the bit along an axis. Along any other a direction has no exact unit vector: there within
    /// 2ε of it, with no component across.
    fn b8_the_poles_stay_where_they_are(card) {
        let axes = [
            DVec3::X,
            DVec3::NEG_X,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::Z,
            DVec3::NEG_Z,
        ];
        for lorentz_factor in [1.0 + 1e-12, 2.0, 1e3, 1e8] {
            let fixed = axes.iter().all(|&axis| {
                [axis, -axis]
                    .iter()
                    .all(|&n| seen(of_gamma(lorentz_factor, axis), n).direction == n)
            });
            card.holds(
                &format!("six axes at γ = {lorentz_factor}: to the bit"),
                fixed,
            );
        }
        let mut random = Random(8);
        let (mut off, mut sane) = (0f64, true);
        for _ in 0..10_000 {
            let direction = random.vector();
            let u = Celerity::from_rapidity(25.0 * random.next(), direction).unwrap();
            let v = Celerity::from_rapidity(25.0 * random.next(), direction).unwrap();
            for n in [u.vector(), -u.vector()] {
                let unit = n.normalize();
                off = off.max((seen(u, n).direction - unit).abs().max_element());
                let other = between(u, v).light(unit);
                sane &= other.direction.is_finite() && other.frequency_ratio > 0.0;
                sane &= between(u, u.reversed()).light(unit).direction.is_finite();
            }
        }
        card.at_most("10 000 oblique poles move by", off, 2.0 * EPSILON);
        card.holds("no NaN between parallel and opposite motions", sane);
        for (velocity, d) in [("[0, 0, -0.6]", 2.0), ("[0, 0, 0.6]", 0.5)] {
            let hit = from_a_car(velocity, 0.0);
            card.same(
                &format!("pole of a car at {velocity}: x of the event"),
                0.0,
                hit.event.x[0].abs(),
            );
            card.relative("D", d, hit.doppler, 8.0 * EPSILON);
        }
    }
}
