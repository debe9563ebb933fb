//! G. The program as a whole. G3 waits for spectral EXR files, which are not written yet.

use super::card::Card;
use super::files::Files;
use super::scene::Set;
use super::swept::{GLARE, INSIDE, SCENES};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use restframe::color::cie;
use restframe::film::Film;
use restframe::frame::Frame;
use restframe::render::View;
use restframe::shade::ShadeScratch;
use restframe::spectrum::{Spectrum, planck};
use restframe::trace::{Samples, Scratch, ShadeTrees, build_aggregate};

/// G4's Lorentz factors, as they are written in a shot.
const LORENTZ_FACTORS: [&str; 6] = ["1", "1.000000000001", "2", "10", "1e3", "1e6"];

/// Motions of a body seen by a camera that looks along −z.
const MOTIONS: [(&str, &str); 4] = [
    ("towards", "[0, 0, 1]"),
    ("away", "[0, 0, -1]"),
    ("across", "[1, 0, 0]"),
    ("oblique", "[0.6, -0.3, 0.7]"),
];

fn velocity(lorentz_factor: &str, direction: &str) -> String {
    format!("{{ gamma = {lorentz_factor}, direction = {direction} }}")
}

fn at_speed(scene: &str, lorentz_factor: &str, direction: &str) -> Set {
    Set::new(&scene.replace("VELOCITY", &velocity(lorentz_factor, direction)))
}

/// What is wrong with a film, its layers and its files: nothing, if it is empty. Light may be beyond
/// f32 on the film; in files it is clamped, and counted where that was so and only there.
fn faults(film: &Film) -> Vec<&'static str> {
    let values = film.xyz.as_flattened();
    let files = Files::of(film);
    let layers = &film.layers;
    let [doppler, distance, time, worldline] = [
        &layers.doppler,
        &layers.distance,
        &layers.emission_time,
        &layers.worldline,
    ]
    .map(|layer| layer.as_ref().unwrap());
    let covered = |layer: &[f32], sane: fn(f32) -> bool| {
        layer
            .iter()
            .zip(worldline)
            .all(|(v, w)| *w < 0.0 || (v.is_finite() && sane(*v)))
    };
    [
        ("NaN on the film", !values.iter().any(|v| v.is_nan())),
        (
            "negative XYZ",
            values.iter().all(|v| v.is_nan() || v.is_sign_positive()),
        ),
        (
            "clamped light is not what was counted",
            (files.saturated > 0) == (is_beyond(values) || is_clamped(&files)),
        ),
        (
            "a value not finite in the EXR",
            files.exr_is_finite_and_true(),
        ),
        ("the PNG has lost pixels", files.rgb8.len() == values.len()),
        ("D not above 0", covered(doppler, |d| d > 0.0)),
        ("distance below 0", covered(distance, |d| d >= 0.0)),
        ("emission time not finite", covered(time, |_| true)),
    ]
    .into_iter()
    .filter_map(|(fault, holds)| (!holds).then_some(fault))
    .collect()
}

/// A ball that comes on, and passes through the lab's origin.
const COMING_ON: &str = r#"
[image]
size = [25, 17]
samples = 1
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "ball.obj"
worldline = "moving"
material = "warm"
[material.warm]
thermal = { temperature = 300 }
[camera]
position = [0, 0, 6]
hfov = HFOV
[sensor]
exposure = 0
"#;

/// Looks for faults in every scene at these Lorentz factors and motions, each with their names.
fn swept(
    card: &mut Card,
    (factors, factor_names): (&[&str], &str),
    (motions, motion_names): (&[(&str, &str)], &str),
) {
    for (name, text) in SCENES {
        let runs: Vec<(&str, &str, &str)> = factors
            .iter()
            .flat_map(|factor| {
                motions
                    .iter()
                    .map(|(motion, direction)| (*factor, *motion, *direction))
            })
            .collect();
        let faults: Vec<String> = runs
            .par_iter()
            .map(|(factor, motion, direction)| {
                let faults = faults(&at_speed(text, factor, direction).film());
                if faults.is_empty() {
                    String::new()
                } else {
                    format!(" γ = {factor} {motion}: {}", faults.join(", "))
                }
            })
            .collect();
        card.holds(
            &format!(
                "{name}: at {factor_names}; {motion_names}{}",
                faults.concat()
            ),
            faults.concat().is_empty(),
        );
    }
}

/// Whether a film has light beyond f32.
fn is_beyond(values: &[f32]) -> bool {
    values.iter().any(|v| v.is_infinite())
}

/// Whether a file has the greatest number of f32, which no light of these scenes happens to be.
fn is_clamped(files: &Files) -> bool {
    files
        .linear
        .as_flattened()
        .iter()
        .any(|v| v.abs() == f32::MAX)
}

/// XYZ that a curve has under a Doppler factor, D⁵ S(Dλ), at four steps a nm.
fn shifted(d: f64, curve: impl Fn(f64) -> f64) -> [f64; 3] {
    cie::xyz_with_substeps(|nm| d.powi(5) * curve(d * nm), 4)
}

/// Three emitters, each on a worldline of its own, so that the layers say who is seen; the first is
/// in the middle of the picture.
const EMITTERS: &str = r#"
[image]
size = [48, 32]
samples = 1
[worldline.hot]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[worldline.line]
velocity = [-0.1, 0.2, -0.1]
passes = [2, 1, -4]
at = -4
[worldline.bulb]
velocity = [0, -0.6, 0]
passes = [-2, -1, -4]
at = -4
[[model]]
file = "ball.obj"
worldline = "hot"
material = "hot"
[[model]]
file = "wall.obj"
worldline = "line"
material = "line"
[[model]]
file = "ball.obj"
worldline = "bulb"
material = "bulb"
[material.hot]
thermal = { temperature = 3000 }
[material.line]
emission = { spectrum = { gaussian = { center = 560, width = 30 } } }
[material.bulb]
emission = { spectrum = { blackbody = 4000 } }
[camera]
hfov = 70
[sensor]
exposure = 0
"#;

/// A film's pixels one by one from the last to the first, each traced and shaded alone.
fn backwards(set: &Set) -> Vec<[f32; 3]> {
    let shot = &set.prepared.shot;
    let scene = set.scene();
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(
        &Frame::new(shot, 1).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    let [width, height] = shot.image.size;
    let samples = Samples::new(shot.image.samples, shot.image.filter);
    let (mut scratch, mut shading) = (Scratch::default(), ShadeScratch::default());
    let mut pixel = |x: u32, y: u32| {
        let mut sum = [0.0; 3];
        for index in 0..samples.count() {
            let [dx, dy] = samples.position(x, y, index);
            let point = [
                (f64::from(x) + dx) / f64::from(width),
                (f64::from(y) + dy) / f64::from(height),
            ];
            let mut trees = ShadeTrees::default();
            view.tracer().trace(
                &[scene.camera.looks_along(point).unwrap()],
                &mut scratch,
                &mut trees,
            );
            let xyz = view.shader().xyz(&trees, trees.roots[0], &mut shading);
            sum = [0, 1, 2].map(|i| sum[i] + xyz[i]);
        }
        sum.map(|v: f64| (v / f64::from(samples.count())) as f32)
    };
    let order = (0..width * height).rev();
    let mut film: Vec<_> = order.map(|i| pixel(i % width, i / width)).collect();
    film.reverse();
    film
}

cases! {
    /// The layers hold D in f32, half an ulp off: that is 6e-8 of λ and T, which counts up to 20
    /// times (D⁵, and the slope of Planck's curve at D·T > 1500 K), 1.2e-6. The sum over the image's
    /// 84 wavelengths, against four steps a nm, is measured: 2.5e-6 for the black body, 1.8e-5 for
    /// the line of σ = 30 nm, narrower by D, and 7e-7 for the bulb, of the greatest of X, Y and Z.
    fn g1_the_picture_follows_from_its_layers(card) {
        let set = Set::new(&EMITTERS.replace("VELOCITY", "[0.3, -0.2, 0.5]"));
        let names = set.scene().worldline_names;
        let film = set.film();
        let layers = &film.layers;
        let [doppler, distance, time, worldline] = [
            &layers.doppler,
            &layers.distance,
            &layers.emission_time,
            &layers.worldline,
        ]
        .map(|l| l.as_ref().unwrap());
        let line = Spectrum::gaussian(560.0, 30.0).unwrap();
        let mut seen = [0; 3];
        let (mut off, mut late, mut sky) = ([0f64; 3], 0f64, true);
        for (i, xyz) in film.xyz.iter().enumerate() {
            if worldline[i] < 0.0 {
                sky &= *xyz == [0.0; 3] && [doppler[i], distance[i], time[i]] == [0.0; 3];
                continue;
            }
            let d = f64::from(doppler[i]);
            let (emitter, exact) = match names[worldline[i] as usize].as_str() {
                "hot" => (0, cie::xyz_of(|nm| planck::radiance(nm, d * 3000.0))),
                "line" => (1, shifted(d, |nm| line.at(nm))),
                _ => (
                    2,
                    shifted(d, |nm| {
                        planck::radiance(nm, 4000.0) / planck::radiance(560.0, 4000.0)
                    }),
                ),
            };
            seen[emitter] += 1;
            let size = exact.iter().fold(0.0, |m: f64, v| m.max(*v));
            let apart = (0..3)
                .map(|c| (f64::from(xyz[c]) - exact[c]).abs() / size)
                .fold(0.0, f64::max);
            off[emitter] = off[emitter].max(apart);
            late = late.max(f64::from((time[i] + distance[i]).abs() / distance[i]));
        }
        card.holds(
            "each emitter covers a hundred pixels",
            seen.iter().all(|count| *count > 100),
        );
        card.at_most("a black body's XYZ from D and its T", off[0], 1e-5);
        card.at_most("a line's from D", off[1], 3e-5);
        card.at_most("a bulb's from D", off[2], 1e-5);
        card.at_most(
            "emission time against the exposure less the distance",
            late,
            f64::from(f32::EPSILON),
        );
        card.holds("where nothing is seen the layers are 0", sky);
        let sane = LORENTZ_FACTORS.iter().all(|factor| {
            MOTIONS.iter().all(|(_, direction)| {
                faults(&at_speed(EMITTERS, factor, direction).film()).is_empty()
            })
        });
        card.holds("layers finite and D > 0 at every γ of G4", sane);
    }

    /// Runs that are stopped and go on are held by tests/cli.rs and tests/sequence.rs.
    fn g2_the_bytes_do_not_depend_on_threads_or_order(card) {
        // Six bands of eight rows.
        let text = INSIDE.replace("size = [24, 16]", "size = [32, 48]");
        let set = at_speed(&text, "2", MOTIONS[3].1);
        let with_threads = |count: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(count).build().unwrap();
            let film = pool.install(|| set.film());
            (Files::of(&film).bytes, film)
        };
        let (one, film) = with_threads(1);
        for count in [2, 3, 16] {
            card.holds(
                &format!("EXR and PNG by {count} threads, as by one"),
                with_threads(count).0 == one,
            );
        }
        card.holds(
            "pixels traced one by one from the last to the first",
            backwards(&set) == film.xyz,
        );
    }

    /// See [`faults`] for what is looked for: in the film, its layers, the picture and its files.
    fn g4_no_speed_brings_a_nan_an_infinity_or_less_than_nothing(card) {
        swept(
            card,
            (&LORENTZ_FACTORS, "γ 1, 1 + 1e-12, 2, 10, 1e3, 1e6"),
            (&MOTIONS, "towards, away, across, oblique"),
        );
        let saturated = |factor: &str, direction: &str| {
            Files::of(&at_speed(GLARE, factor, direction).film()).saturated
        };
        card.holds(
            "light beyond f32 is counted at γ = 1e6 towards, and none at 1e3 or away",
            saturated("1e6", MOTIONS[0].1) > 0
                && saturated("1e3", MOTIONS[0].1) == 0
                && saturated("1e6", MOTIONS[1].1) == 0,
        );
    }

    /// γ = 10⁷⁴ is near the greatest that a shot may have. Bodies that come on along an axis are met,
    /// for rounding keeps off the axes across; others are lost where rounding exceeds their size.
    fn g4_nor_do_the_greatest_lorentz_factors(card) {
        let motions = [MOTIONS[0], MOTIONS[3]];
        swept(card, (&["1e74"], "γ 1e74"), (&motions, "towards, oblique"));
    }

    /// A ball passes the lab's origin at the exposure, r = 6 before the camera, which sees it
    /// r/(1 − β) = rγ(γ + u) away, and at this field of view always alike. In the ball's frame the
    /// way is rγ less its radius. Bound: eight roundings, and how far facets are within the sphere.
    fn g4_a_ball_comes_on_alike_at_any_lorentz_factor(card) {
        const FACETS: f64 = 0.01;
        let ball = |factor: &str, direction: &str| {
            let gamma: f64 = factor.parse().unwrap();
            let hfov = (4.0 / 12.0 / gamma / gamma).to_degrees();
            at_speed(&COMING_ON.replace("HFOV", &format!("{hfov:e}")), factor, direction)
        };
        let film = ball("1e3", "[0, 0, 1]").film();
        let seen = film.layers.worldline.as_ref().unwrap();
        let count = seen.iter().filter(|line| **line > 0.0).count();
        card.holds("at 1e3 it fills 110 to 130 of 425 pixels", (110..130).contains(&count));
        for factor in ["1e10", "1e15", "1e16", "1e20", "1e25", "1e40", "1e74"] {
            let set = ball(factor, "[0, 0, 1]");
            let other = set.film().layers.worldline;
            card.holds(&format!("the same pixels at {factor}"), other == film.layers.worldline);
            let hit = set.probe([12, 8]).hit;
            let gamma: f64 = factor.parse().unwrap();
            let (doppler, distance) = hit.map_or((0.0, 0.0), |hit| (hit.doppler, hit.distance));
            card.relative("D in the middle", 2.0 * gamma, doppler, 8.0 * f64::EPSILON);
            let exact = (6.0 * gamma - 1.0) * (2.0 * gamma);
            let bound = 8.0 * f64::EPSILON + FACETS / (6.0 * gamma);
            card.relative("distance, m", exact, distance, bound);
        }
        let oblique = ["1e25", "1e74"].map(|factor| ball(factor, "[0.6, -0.3, 0.7]").film());
        let is_sky = |film: &Film| film.layers.worldline.iter().flatten().all(|line| *line < 0.0);
        card.holds("obliquely at 1e25 and 1e74 it is lost", oblique.iter().all(is_sky));
    }

    /// The ray meets the motion head-on, from behind or at a right angle: D = γ ± √((γ − 1)(γ + 1)),
    /// or 1/γ, to a few roundings, γ being read the same way here.
    fn g4_what_is_monotone_in_the_lorentz_factor_stays_so(card) {
        for (motion, direction) in &MOTIONS[..3] {
            let probes: Vec<_> = LORENTZ_FACTORS
                .iter()
                .map(|factor| {
                    let middle = EMITTERS.replace("size = [48, 32]", "size = [1, 1]");
                    at_speed(&middle, factor, direction).probe([0, 0])
                })
                .collect();
            let doppler: Vec<f64> = probes
                .iter()
                .map(|probe| probe.hit.as_ref().unwrap().doppler)
                .collect();
            let mut off = 0f64;
            for (factor, d) in LORENTZ_FACTORS.iter().zip(&doppler) {
                let factor: f64 = factor.parse().unwrap();
                let root = ((factor - 1.0) * (factor + 1.0)).sqrt();
                let exact = match *motion {
                    "towards" => factor + root,
                    "away" => 1.0 / (factor + root),
                    _ => 1.0 / factor,
                };
                off = off.max((d / exact - 1.0).abs());
            }
            card.at_most(
                &format!("D of what moves {motion}, relative"),
                off,
                16.0 * f64::EPSILON,
            );
            let rises = *motion == "towards";
            let ordered = |values: &[f64]| {
                values.windows(2).all(|pair| {
                    (pair[0] < pair[1]) == rises && pair[0] != pair[1] || pair[1] == 0.0
                })
            };
            card.holds(
                &format!(
                    "D of what moves {motion} {} with γ",
                    if rises { "rises" } else { "falls" }
                ),
                ordered(&doppler),
            );
            let luminance: Vec<f64> = probes.iter().map(|probe| probe.xyz[1]).collect();
            card.holds(
                "and so does the luminance of a black body",
                ordered(&luminance),
            );
        }
    }
}
