//! A. Boosts.
//!
//! ε is 2⁻⁵². Each bound is the row's own where it has one; else it says what makes it.

use super::card::Card;
use super::numbers::{Random, angle, columns, determinant, off_metric, product};
use super::pictures::{
    Picture, bits, changed, difference, far_wall, glow, hits, pixels_of_worldlines,
};
use super::poincare::Poincare;
use glam::DVec3;
use restframe::film::Film;
use restframe::relativity::{
    Boost, Celerity, CelerityError, Event, FourVector, Transform, Worldline,
};
use restframe::trace::Spacetime;
use std::path::Path;

const EPSILON: f64 = f64::EPSILON;

/// A direction along no axis, nearly a unit vector.
const OBLIQUE: DVec3 = DVec3::new(0.48, -0.64, 0.6);

fn of_beta(x: f64, y: f64, z: f64) -> Celerity {
    Celerity::from_beta(DVec3::new(x, y, z)).unwrap()
}

fn of_gamma(lorentz_factor: f64, direction: DVec3) -> Celerity {
    Celerity::from_lorentz_factor(lorentz_factor, direction).unwrap()
}

fn through_origin(celerity: Celerity) -> Worldline {
    Worldline {
        celerity,
        ..Worldline::LAB
    }
}

/// What of a picture a motion of the whole scene changes, at each Lorentz factor.
fn moved_pictures(card: &mut Card, what: &str, picture: &Picture) {
    let set = picture.set();
    let scene = set.scene();
    let still = set.film_of(&scene);
    for (seed, lorentz_factor) in [(1, 1.2), (2, 10.0), (3, 1e3)] {
        let moved = set.film_of(&Poincare::at_random(seed, lorentz_factor).scene(&scene));
        card.at_most(
            &format!("{what}, γ = {lorentz_factor}"),
            difference(&still, &moved),
            1e-7,
        );
    }
}

cases! {
    fn a1_speed_zero_changes_no_bit(card) {
        let still = [
            of_beta(0.0, 0.0, 0.0),
            of_beta(-0.0, 0.0, -0.0),
            of_gamma(1.0, DVec3::ZERO),
            Celerity::from_rapidity(0.0, DVec3::ZERO).unwrap(),
            of_gamma(1.0, OBLIQUE),
        ];
        let v = FourVector::new(0.1, DVec3::new(-0.0, 1e-300, 0.7));
        let n = DVec3::new(0.6, 0.0, -0.8);
        let same = |u: &Celerity| {
            let boost = Boost::into_rest_of(*u);
            let (seen, moved) = (boost.light_of_unit(n), boost.vector(v));
            moved.x.to_array().map(f64::to_bits) == v.x.to_array().map(f64::to_bits)
                && moved.t.to_bits() == v.t.to_bits()
                && seen.direction == n
                && seen.frequency_ratio.to_bits() == 1f64.to_bits()
                && boost.light(n).frequency_ratio.to_bits() == 1f64.to_bits()
        };
        card.holds(
            "β = 0, −0, γ = 1, rapidity 0: events, light and D as given",
            still.iter().all(same),
        );
        let off = "[effects]\ngeometry = \"off\"\ndoppler = \"off\"\nbeaming = \"off\"\n";
        let classical = bits(&Picture::on_one("lab", off).film());
        for velocity in [
            "[0.0, 0.0, 0.0]",
            "[-0.0, 0.0, -0.0]",
            "{ gamma = 1, direction = [0, 0, 0] }",
            "{ rapidity = 0, direction = [0, 0, 0] }",
        ] {
            let tables = format!("[worldline.still]\nvelocity = {velocity}\n");
            let picture = Picture {
                on: ["lab", "still", "still", "still", "still", "lab"],
                ..Picture::on_one("lab", &tables)
            };
            let film = bits(&picture.film());
            card.holds(
                &format!("{velocity}: the picture without relativity, to the bit"),
                film == classical,
            );
        }
    }

    /// x′ = x − βt to 1 ulp; β² underflows at 1e-160. γ − 1 is off the diagonal, where nothing
    /// else is: u along (3, 4, 0)/5 makes y′ = (12/25)(γ − 1)x. At |β| = 5·2⁻⁴², exact, this is
    /// 6·2⁻⁸⁴x but for β² = 1e-24 of it.
    fn a2_the_slowest_motion_is_not_cut_off(card) {
        for beta in [1e-12, 1e-160] {
            let boost = Boost::into_rest_of(of_beta(beta, 0.0, 0.0));
            for (t, x) in [(2.0, 1.0), (1e150, 1e-10), (3.0, 0.0)] {
                let exact = x - beta * t;
                let moved = boost
                    .vector(FourVector::new(t, DVec3::new(x, 0.0, 0.0)))
                    .x
                    .x;
                card.relative(
                    &format!("x − βt at β = {beta:e}, t = {t:e}, x = {x:e}"),
                    exact,
                    moved,
                    EPSILON,
                );
            }
        }
        for (exponent, x) in [(-42, 1.0), (-534, 1e30)] {
            let unit = 2f64.powi(exponent);
            let moved = Boost::into_rest_of(of_beta(3.0 * unit, 4.0 * unit, 0.0))
                .vector(FourVector::new(0.0, DVec3::new(x, 0.0, 0.0)));
            let exact = 0.5 * (5.0 * unit) * (5.0 * unit * x);
            card.relative(
                &format!("(γ − 1)·{x:e} at β = {:e}", 5.0 * unit),
                exact,
                moved.x.y * (25.0 / 12.0),
                4.0 * EPSILON,
            );
        }
        // asin 0.01, and asin 1e-12: the lab direction of what is seen across the motion.
        let seen = |beta: f64| {
            let line = format!("[worldline.car]\nvelocity = [{beta:e}, 0, 0]\n");
            let hit = glow(&line, &far_wall("lab"), "worldline = \"car\"")
                .probe([2, 2])
                .hit
                .unwrap();
            (-hit.event.x[0]).atan2(-hit.event.x[2]).to_degrees()
        };
        card.relative(
            "a star at 90° moves, degrees, at 0.01 c",
            0.5729673448571527,
            seen(0.01),
            8.0 * EPSILON,
        );
        card.relative(
            "and at 1e-12 c",
            1e-12f64.to_degrees(),
            seen(1e-12),
            8.0 * EPSILON,
        );
        card.relative(
            "and at 1e-160 c",
            1e-160f64.to_degrees(),
            seen(1e-160),
            8.0 * EPSILON,
        );
    }

    /// Relative tolerance: four roundings. ln(2e8) is off by 2ε, e^η so by 2ε·η.
    fn a3_lorentz_factors_are_never_expressed_through_beta(card) {
        let head_on = |u: Celerity| 1.0 / Boost::into_rest_of(u).light(DVec3::Z).frequency_ratio;
        card.relative(
            "D head-on at γ = 1e8",
            2e8,
            head_on(of_gamma(1e8, DVec3::Z)),
            4.0 * EPSILON,
        );
        let eta = 19.11382792451231; // ln 2e8 = arcosh 1e8 to 2.5e-17
        let by_rapidity = head_on(Celerity::from_rapidity(eta, DVec3::Z).unwrap());
        card.relative("by rapidity", 2e8, by_rapidity, 2.0 * EPSILON * eta);
        let seen = |velocity: &str| {
            let line = format!("[worldline.fast]\nvelocity = {velocity}\n");
            glow(&line, "worldline = \"fast\"", "position = [0, 0, 1]")
                .probe([2, 2])
                .hit
                .unwrap()
                .doppler
        };
        card.relative(
            "D of a wall, seen",
            2e8,
            seen("{ gamma = 1e8, direction = [0, 0, 1] }"),
            4.0 * EPSILON,
        );
        card.relative(
            "by rapidity",
            2e8,
            seen("{ rapidity = 19.113827924512312, direction = [0, 0, 1] }"),
            2.0 * EPSILON * eta,
        );
        card.relative(
            "receding",
            5e-9,
            seen("{ gamma = 1e8, direction = [0, 0, -1] }"),
            4.0 * EPSILON,
        );
        card.relative(
            "at γ = 1e20",
            2e20,
            seen("{ gamma = 1e20, direction = [0, 0, 1] }"),
            4.0 * EPSILON,
        );
    }

    fn a4_what_is_no_velocity_is_refused_by_name(card) {
        let not_below = |x: f64, y: f64| {
            let refused = Celerity::from_beta(DVec3::new(x, y, 0.0));
            matches!(refused, Err(CelerityError::NotBelowLight(b)) if b >= 1.0)
        };
        card.holds(
            "β = 1, (0.6, 0.8), 1.5: not below light",
            not_below(1.0, 0.0) && not_below(0.6, 0.8) && not_below(1.5, 0.0),
        );
        let nan = [
            Celerity::from_beta(DVec3::new(f64::NAN, 0.0, 0.0)),
            Celerity::from_lorentz_factor(f64::NAN, DVec3::X),
            Celerity::from_rapidity(f64::NAN, DVec3::X),
            Celerity::from_rapidity(1.0, DVec3::NAN),
            Celerity::from_lorentz_factor(f64::INFINITY, DVec3::X),
        ];
        card.holds(
            "NaN and ∞: not finite",
            nan.iter().all(|r| *r == Err(CelerityError::NotFinite)),
        );
        card.holds(
            "rapidity −1: negative",
            Celerity::from_rapidity(-1.0, DVec3::X) == Err(CelerityError::NegativeRapidity(-1.0)),
        );
        let largest = of_beta(1.0 - EPSILON / 2.0, 0.0, 0.0);
        // 1/√(1 − β²) with 1 − β = 2⁻⁵³.
        card.relative(
            "the greatest β below 1 is kept: γ",
            6.710886400000001e7,
            largest.lorentz_factor(),
            4.0 * EPSILON,
        );
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("shot.toml");
        for (velocity, key) in [
            ("[1, 0, 0]", ""),
            ("[0.6, 0.8, 0]", ""),
            ("[-1.5, 0, 0]", ""),
            ("[nan, 0, 0]", "[0]"),
            ("[0, inf, 0]", "[1]"),
            ("{ gamma = 0.5, direction = [1, 0, 0] }", ".gamma"),
            ("{ gamma = nan, direction = [1, 0, 0] }", ".gamma"),
            ("{ gamma = 2, direction = [0, 0, 0] }", ".direction"),
            ("{ rapidity = -1, direction = [1, 0, 0] }", ".rapidity"),
            ("{ rapidity = nan, direction = [1, 0, 0] }", ".rapidity"),
            ("{ rapidity = 1, direction = [1, nan, 0] }", ".direction[1]"),
        ] {
            let text = format!(
                "[worldline.fast]\nvelocity = {velocity}\n[[model]]\nfile = \"assets/sphere.obj\"\n[camera]\n"
            );
            let keys: Vec<String> = restframe::shot::parse(&text, &path).map_or_else(
                |mistakes| mistakes.iter().map(|m| m.key.clone()).collect(),
                |_| Vec::new(),
            );
            let named = format!("worldline.fast.velocity{key}");
            card.holds(
                &format!("{velocity} is a mistake at velocity{key}"),
                keys == [named],
            );
        }
    }

    /// The row's 8εγ² holds for entries. Elimination adds as much as 16 roundings of entries of size
    /// γ, which the inverse, of size γ too, turns into the determinant's.
    fn a5_boosts_preserve_the_metric(card) {
        let axes = [
            DVec3::X,
            DVec3::NEG_Z,
            OBLIQUE,
            DVec3::new(1.0, 2.0, -0.5),
            DVec3::new(1e-9, 1.0, 1e-5),
        ];
        for lorentz_factor in [1.0 + 1e-12, 2.0, 10.0, 1e3, 1e6] {
            let size = EPSILON * lorentz_factor * lorentz_factor;
            let maps = axes.map(|axis| {
                let boost = Boost::into_rest_of(of_gamma(lorentz_factor, axis));
                columns(|v| boost.vector(v))
            });
            let worst = maps.iter().map(off_metric).fold(0.0, f64::max);
            card.at_most(
                &format!("LᵀηL − η at γ = {lorentz_factor}"),
                worst,
                8.0 * size,
            );
            let turn = maps
                .iter()
                .map(|m| (determinant(m) - 1.0).abs())
                .fold(0.0, f64::max);
            card.at_most("det L − 1", turn, 24.0 * size);
            card.holds("L₀₀ ≥ 1", maps.iter().all(|m| m.w_axis.w >= 1.0));
        }
        for (speed, u, v) in [
            (0.6, of_beta(0.6, 0.0, 0.0), of_beta(0.0, 0.6, 0.0)),
            (0.9, of_beta(0.3, -0.8, 0.2), of_beta(-0.5, 0.1, 0.7)),
        ] {
            let between = Transform::between(&through_origin(u), &through_origin(v));
            let map =
                columns(|v| between.event(Event::new(v.t, v.x)) - Event::new(0.0, DVec3::ZERO));
            let size = EPSILON * v.seen_from(u).lorentz_factor().powi(2);
            card.at_most(
                &format!("of a composed transform, about {speed} c each"),
                off_metric(&map),
                8.0 * size,
            );
        }
        let boost = Boost::into_rest_of(of_beta(0.5, 0.0, 0.0));
        let interval = boost
            .vector(FourVector::new(10.0, DVec3::new(1.0, 2.0, 0.0)))
            .interval();
        card.relative(
            "interval of (10, 1, 2, 0) at 0.5 c",
            -95.0,
            interval,
            8.0 * EPSILON,
        );
    }

    fn a6_many_boosts_do_not_drift_off_the_hyperboloid(card) {
        // cosh 10 to 17 digits.
        let exact = 11013.232920103323;
        let step = Celerity::from_rapidity(1e-3, DVec3::NEG_X).unwrap();
        let boost = Boost::into_rest_of(step);
        let (mut vector, mut body) = (FourVector::new(1.0, DVec3::ZERO), Celerity::REST);
        for _ in 0..10_000 {
            vector = boost.vector(vector);
            body = body.seen_from(step);
        }
        card.relative(
            "γ after 10 000 boosts of rapidity 0.001, of a four-vector",
            exact,
            vector.t,
            1e-11,
        );
        card.relative(
            "γ after 10 000 relative velocities",
            exact,
            body.lorentz_factor(),
            1e-11,
        );
        // A random walk in velocity runs away; each step leads part of the way back.
        let mut random = Random(6);
        let (mut u, mut worst, mut fastest) = (Celerity::REST, 0f64, 1f64);
        for _ in 0..1_000_000 {
            let frame = Celerity::new(random.vector() * 2.0 + u.vector() * 0.5).unwrap();
            let four =
                Boost::into_rest_of(frame).vector(FourVector::new(u.lorentz_factor(), u.vector()));
            u = Celerity::new(four.x).unwrap(); // renormalised: only the space part is kept
            let drift = product(
                u.vector().extend(u.lorentz_factor()),
                u.vector().extend(u.lorentz_factor()),
            ) + 1.0;
            worst = worst.max(drift.abs());
            fastest = fastest.max(u.lorentz_factor());
        }
        card.at_most("u·u + 1 in 1 000 000 random boosts", worst, 1e-12);
        card.holds("which reach γ > 5", fastest > 5.0);
    }

    /// Both numbers from 40 digits: 2 atan((9/16)/(1 + 5/4 + 5/4 + 25/16)) and √(1 − 1.5625⁻²).
    fn a7_crosswise_boosts_turn(card) {
        let (u, v) = (of_beta(-0.6, 0.0, 0.0), of_beta(0.0, 0.6, 0.0));
        let w = v.seen_from(u);
        card.relative(
            "γ of 0.6 c and 0.6 c across",
            1.5625,
            w.lorentz_factor(),
            8.0 * EPSILON,
        );
        card.relative("speed", 0.768374908491942, w.beta().length(), 8.0 * EPSILON);
        // A pure boost keeps the direction of its own motion; what it is turned by is the turn.
        let turned = |between: &Transform, w: Celerity| {
            let along = w.vector().normalize();
            angle(along, between.light(along).direction).to_degrees()
        };
        let exact = 12.68038349181982;
        let between = Transform::between(&through_origin(u), &through_origin(v));
        card.near("turn, degrees", exact, turned(&between, w), 1e-13);
        let lines =
            "[worldline.body]\nvelocity = [0, 0.6, 0]\n[worldline.car]\nvelocity = [-0.6, 0, 0]\n";
        let scene = glow(lines, &far_wall("body"), "worldline = \"car\"").scene();
        let along = w.vector().normalize();
        let link = *Spacetime::new(&scene, true).link(1, 2);
        card.near(
            "of a body's axes, in a shot",
            exact,
            angle(along, link.light(along).direction).to_degrees(),
            1e-13,
        );
        let fast = of_beta(0.0, 0.9, 0.0).seen_from(of_beta(-0.9, 0.0, 0.0));
        card.relative(
            "0.9 c and 0.9 c across",
            0.9817840903172143,
            fast.beta().length(),
            8.0 * EPSILON,
        );
        let mut random = Random(7);
        let below = (0..10_000).all(|_| {
            let [u, v] = [(); 2].map(|()| {
                let direction = random.vector();
                Celerity::from_rapidity(40.0 * random.next(), direction).unwrap()
            });
            let w = v.seen_from(u);
            // β rounds to 1 from γ = 1e8 on; what is below light is that γ > |u|.
            w.vector().is_finite() && (w.magnitude() > 1e7 || w.beta().length() < 1.0)
        });
        card.holds("no pair of 10 000 is faster than light", below);
    }

    /// sinh η rounds to ε, so η to ε: 1e-7 of the difference. The exact difference is that of the
    /// two rapidities as f64 hold them. Along (1, −1, 1) all components of a celerity round alike;
    /// elsewhere two celerities that are meant to be parallel are so within ε, which is a relative
    /// velocity of γε across: below 4γε in all.
    fn a8_two_fast_frames_side_by_side_keep_their_digits(card) {
        let (eta, faster) = (14.508657738523969f64, 14.508657738523969 + 1e-9);
        let apart = faster - eta;
        let diagonal = DVec3::new(1.0, -1.0, 1.0);
        let along = |direction: DVec3| {
            [eta, faster].map(|eta| Celerity::from_rapidity(eta, direction).unwrap())
        };
        let [u, v] = along(diagonal);
        card.relative("γ", 1e6, u.lorentz_factor(), 1e-14);
        let w = v.seen_from(u);
        let excess = w.magnitude() * w.magnitude() / (w.lorentz_factor() + 1.0);
        card.relative("γ_rel − 1", apart * apart / 2.0, excess, 1e-5);
        let between = Transform::between(&through_origin(u), &through_origin(v));
        let ratio = |n: DVec3| between.light(n).frequency_ratio;
        card.relative(
            "1 − D along",
            apart,
            1.0 - ratio(diagonal.normalize()),
            1e-5,
        );
        card.relative(
            "D − 1 against",
            apart,
            ratio(-diagonal.normalize()) - 1.0,
            1e-5,
        );
        let [u, v] = along(OBLIQUE);
        card.near(
            "relative speed along (12, −16, 15)",
            apart,
            v.seen_from(u).magnitude(),
            4.0 * 1e6 * EPSILON,
        );
        let line = |name: &str, eta: f64| {
            format!(
                "[worldline.{name}]\nvelocity = {{ rapidity = {eta:?}, direction = [0, 0, -1] }}\n"
            )
        };
        let lines = line("car", eta) + &line("body", faster);
        let seen = glow(&lines, &far_wall("body"), "worldline = \"car\"")
            .probe([2, 2])
            .hit
            .unwrap();
        card.relative(
            "1 − D of a wall that recedes, seen",
            apart,
            1.0 - seen.doppler,
            1e-5,
        );
    }

    fn a9_a_convoy_looks_as_if_it_stood(card) {
        let still = Picture::on_one("lab", "").film();
        for velocity in [
            "{ gamma = 1e4, direction = [0.48, -0.64, 0.6] }",
            "{ gamma = 1e4, direction = [0, 0, -1] }",
        ] {
            let tables =
                format!("[worldline.convoy]\nvelocity = {velocity}\npasses = [3, 4, 5]\nat = 2\n");
            let film = Picture::on_one("convoy", &tables).film();
            card.at_most(
                &format!("difference at {velocity}"),
                difference(&still, &film),
                1e-9,
            );
            let ones = film
                .layers
                .doppler
                .iter()
                .flatten()
                .all(|&d| d == 1.0 || d == 0.0);
            card.holds("D is 1 on every body", ones);
        }
        card.holds("bodies are seen", shows_all(&still, &[0]));
    }

    /// The row's bounds; without the step to unit length |n|² − 1 reached 1.3e-13 at γ = 1 + 1e-12.
    fn a10_light_stays_null_through_100_boosts_there_and_back(card) {
        let starts = [
            DVec3::new(0.3, -0.5, 0.8),
            DVec3::new(-0.7, 0.1, 0.2),
            DVec3::new(0.01, 1.0, -0.6),
            -OBLIQUE,
        ];
        for lorentz_factor in [1.0 + 1e-12, 1.1, 2.0, 10.0, 1e3] {
            let (mut off_null, mut off_course) = (0f64, 0f64);
            for axis in [OBLIQUE, DVec3::new(1.0, 2.0, -0.5), DVec3::Z] {
                let u = of_gamma(lorentz_factor, axis);
                let (there, back) = (Boost::into_rest_of(u), Boost::into_rest_of(u.reversed()));
                for start in starts {
                    let n = start.normalize();
                    let mut seen = n;
                    for _ in 0..100 {
                        seen = back
                            .light_of_unit(there.light_of_unit(seen).direction)
                            .direction;
                    }
                    let four = seen.extend(1.0);
                    off_null = off_null.max(product(four, four).abs());
                    off_course = off_course.max((seen - n).length());
                }
            }
            card.at_most(
                &format!("|n|² − 1 at γ = {lorentz_factor}"),
                off_null,
                1e-14,
            );
            card.at_most(
                "direction",
                off_course,
                1e-14 * lorentz_factor * lorentz_factor,
            );
        }
    }

    /// The row's 1e-7 is 1.7 roundings of a film's f32 at its greatest value. Beside that, origins
    /// of worldlines are rounded in the moved lab, γ times their size, and brought back into rest
    /// frames by another γ: γ²ε·10 m = 2e-9 m at γ = 1e3.
    fn a11_no_motion_of_the_whole_scene_shows(card) {
        let still = Picture::on_one("lab", "");
        moved_pictures(card, "a scene at rest", &still);
        let moving = Picture::on_four(0.0);
        moved_pictures(
            card,
            "ball, block, lamp and camera on four worldlines",
            &moving,
        );
        card.holds(
            "wall, ball and block are seen",
            shows_all(&moving.film(), &[0, 1, 2]),
        );
        let lit = Picture {
            tables: format!("{}[effects]\nshadows = \"off\"\n", moving.tables),
            ..moving.clone()
        };
        let shaded = moving
            .film()
            .xyz
            .iter()
            .zip(&lit.film().xyz)
            .filter(|(a, b)| a[1] < 0.9 * b[1])
            .count();
        card.holds("and their shadows", shaded >= 10);
    }

    /// On an axis by the same numbers, to the bit. Obliquely the camera's event is another sum.
    fn a12_a_moving_camera_sees_what_a_moving_world_shows(card) {
        // The camera's rest frame has its origin at P = (0, 0, 8) in the world at time 0; seen from
        // there the world's has its origin at −B(u)(0, P) = (u·P, −P − u(u·P)/(1 + γ)).
        let world_passes = |u: DVec3| {
            let along = 8.0 * u.z;
            let x = -DVec3::new(0.0, 0.0, 8.0) - u * (along / (1.0 + 1f64.hypot(u.length())));
            format!(
                "passes = [{:?}, {:?}, {:?}]\nat = {:?}\n",
                x.x, x.y, x.z, along
            )
        };
        for (beta, bound) in [
            ([0.6, 0.0, 0.0], 0.0),
            ([0.0, 0.0, -0.6], 0.0),
            ([0.25, -0.5, -0.375], 1e-7),
        ] {
            let u = Celerity::from_beta(beta.into()).unwrap().vector();
            let [x, y, z] = beta;
            let car = format!("[worldline.car]\nvelocity = [{x}, {y}, {z}]\npasses = [0, 0, 8]\n");
            let world = format!(
                "[worldline.world]\nvelocity = [{}, {}, {}]\n{}",
                -x,
                -y,
                -z,
                world_passes(u)
            );
            let moving_camera = Picture {
                on: ["lab", "lab", "lab", "lab", "lab", "car"],
                camera: [0.0; 3],
                ..Picture::on_one("lab", &car)
            };
            let moving_world = Picture {
                on: ["world", "world", "world", "world", "world", "lab"],
                camera: [0.0; 3],
                ..Picture::on_one("lab", &world)
            };
            let (one, other) = (moving_camera.film(), moving_world.film());
            card.at_most(
                &format!("difference at {beta:?} c"),
                difference(&one, &other),
                bound,
            );
            card.holds("bodies are seen", shows_all(&one, &[0]));
        }
    }

    /// At 1e9 m a position in the lab is held to 1.2e-7 m, and a pixel is 0.4 m. The film may change
    /// where a shadow ends: shadow rays start 1e3 roundings of a position off the surface, 2e-4 m.
    fn a13_a_scene_far_away_is_the_same_scene(card) {
        let moving_in_lab = |carried| Picture {
            on: ["lab", "ball", "block", "lamp", "lab", "lab"],
            ..Picture::on_four(carried)
        };
        type Carried = fn(f64) -> Picture;
        let pictures: [(&str, Carried); 3] = [
            ("at rest", Picture::still_and_carried),
            ("three worldlines and a camera in the lab", moving_in_lab),
            ("four worldlines", Picture::on_four),
        ];
        for (what, picture) in pictures {
            let [here, there] = [0.0, 1e9].map(|carried| hits(&picture(carried).set()));
            let (mut moved, mut shifted) = (0f64, 0f64);
            for pair in here.iter().zip(&there) {
                match pair {
                    (Some(one), Some(other)) => {
                        moved = moved.max(one.pixels_from(other));
                        shifted = shifted.max((one.doppler / other.doppler - 1.0).abs());
                    }
                    (None, None) => {}
                    _ => moved = f64::INFINITY,
                }
            }
            card.at_most(&format!("{what}: hits move, pixels"), moved, 1e-6);
            card.at_most("D changes", shifted, 0.0);
            let [near, far] = [0.0, 1e9].map(|carried| picture(carried).film());
            card.at_most(
                "pixels of the film that change by more than 1e-6",
                changed(&near, &far, 1e-6),
                1.0,
            );
        }
    }
}

/// Whether the worldlines of these numbers (lab: 0) have four pixels each.
fn shows_all(film: &Film, worldlines: &[usize]) -> bool {
    let counts = pixels_of_worldlines(film);
    worldlines.iter().all(|&w| counts[w + 1] >= 4)
}
