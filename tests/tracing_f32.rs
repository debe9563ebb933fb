//! Rays and triangles in f32 (`accuracy.tracing = "f32"`): as exact as f32 is where it can be, and
//! wrong where a renderer in f32 is wrong, which f64 is not. Displacements are in pixels.

use crate::hard_cases::eye::{Dice, triangles};
use crate::hard_cases::scene::Set;
use glam::DVec3;
use restframe::film::Film;
use restframe::render::{Options, View, render};
use restframe::scene::Geometry;
use restframe::shot::Precision::{self, F32, F64};
use restframe::study::displacement::{Displacement, displacement};
use restframe::trace::{BodyHit, RestRay, Stage};
use std::process::Command;

/// Half of the distance of two numbers at 1.
const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;

const PAINT: &str = "[material.paint]\ndiffuse = { weight = 0.4, spectrum = 1.0 }\n";

/// A ball and a box before a wall, of paint that has `more` terms.
fn room(more: &str) -> String {
    format!(
        "{PAINT}{more}[sensor]\nexposure = 0\n\
         [[light]]\nkind = \"point\"\nposition = [1, 2, 3]\nintensity = 1000\nspectrum = 1.0\n\
         [[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\n\
         [[model]]\nfile = \"box.obj\"\nmaterial = \"paint\"\n\
         translate = [2.5, -0.7, 0.3]\nrotate = [10, 20, 30]\nscale = 0.6\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\nscale = 8\ntranslate = [0, 0, -3]\n\
         [camera]\nposition = [0.3, 0.4, 6]\nhfov = 60\n"
    )
}

fn film(set: &Set, precision: Precision) -> Film {
    let shot = &set.prepared.shot;
    let scene = set.scene();
    let stage = Stage::with_precision(&scene.geometry, None, precision);
    let [width, height] = shot.image.size;
    let options = Options {
        width,
        height,
        samples: shot.image.samples,
        layers: Vec::new(),
    };
    render(shot, 1, &scene, &stage, &options, &|_| ()).unwrap()
}

/// How far what is traced in either precision stands from where f64 has it.
fn displaced(set: &Set) -> [Displacement; 2] {
    let shot = &set.prepared.shot;
    let scene = set.scene();
    let stages = [F64, F32].map(|p| Stage::with_precision(&scene.geometry, None, p));
    let view = |stage| View::new(shot, 1, &shot.effects, &scene, stage).unwrap();
    let views = [view(&stages[0]), view(&stages[1])];
    [0, 1].map(|i| displacement(&views[0], &views[i], shot.image.size))
}

/// Points on the triangles of all bodies.
fn targets(geometry: &Geometry) -> Vec<DVec3> {
    let of = |i: &restframe::scene::Instance| {
        let place = i.rest_from_mesh;
        triangles(&geometry.meshes[i.mesh as usize])
            .flat_map(move |[a, b, c]| {
                [a, (a + b) / 2.0, (a + b + c) / 3.0].map(|p| place.transform_point3(p))
            })
            .collect::<Vec<_>>()
    };
    geometry.instances.iter().flat_map(of).collect()
}

#[test]
fn near_the_origin_hits_are_those_of_f64_within_roundings_of_the_sizes() {
    let set = Set::new(&room(""));
    let scene = set.scene();
    let [exact, stage] = [F64, F32].map(|p| Stage::with_precision(&scene.geometry, None, p));
    let targets = targets(&scene.geometry);
    let mut dice = Dice(7);
    let (mut hits, mut others) = (0, 0);
    for _ in 0..100_000 {
        let origin = dice.direction() * (2.0 + 8.0 * dice.unit());
        let target = targets[(dice.unit() * targets.len() as f64) as usize] + dice.point() * 0.01;
        let direction = (target - origin).normalize();
        let ray = RestRay { origin, direction };
        let found = stage.nearest(0, &ray, f64::INFINITY);
        // Trees lose nothing in f32 either.
        assert_eq!(found, stage.nearest_of_all(0, &ray, f64::INFINITY));
        match (exact.nearest(0, &ray, f64::INFINITY), found) {
            (None, None) => {}
            (Some(a), Some(b)) if a.instance == b.instance => {
                hits += 1;
                let point = |h: BodyHit| {
                    let geometry = &scene.geometry;
                    geometry.surface_point(h.instance, h.triangle, h.weights)
                };
                // A ray that grazes a plane meets it the farther off.
                let cos = point(a).flat_normal.dot(direction).abs();
                let off = (point(b).position - point(a).position).length();
                // 4.7 at most were measured.
                let bound = 10.0 * ROUNDING * (origin.length() + a.t) / cos;
                assert!(off.max((a.t - b.t).abs()) < bound, "{a:?} {b:?}");
            }
            _ => others += 1,
        }
    }
    assert!(hits > 90_000 && others < 10, "{hits} {others}");
}

#[test]
fn near_the_origin_nothing_is_displaced_that_one_could_see() {
    let [exact, rounded] = displaced(&Set::new(&room("")));
    // Rounded directions are off by 6e-8 rad, a pixel is 1e-3: 2.3e-4 at most were measured.
    assert!(exact.pixels.worst < 1e-11, "{exact:?}");
    assert!((1e-6..1e-3).contains(&rounded.pixels.worst), "{rounded:?}");
    assert!(rounded.mistaken < 1e-4, "{rounded:?}");
}

#[test]
fn f32_leaks_nothing_at_edges_and_vertices() {
    let set = Set::new(&room(""));
    let scene = set.scene();
    let stage = Stage::with_precision(&scene.geometry, None, F32);
    let ball = targets(&scene.geometry).into_iter();
    for (i, target) in ball.filter(|p| p.length() < 1.01).enumerate() {
        let mut dice = Dice(i as u64);
        for _ in 0..20 {
            let origin = dice.direction() * 0.9;
            let direction = (target - origin).normalize();
            let hit = stage.nearest(0, &RestRay { origin, direction }, f64::INFINITY);
            let reach = hit.unwrap().t;
            assert!(
                reach < 1.001 * (target - origin).length(),
                "{origin} {target}"
            );
        }
    }
}

#[test]
fn far_from_the_origin_f32_displaces_and_f64_does_not() {
    // Numbers of f32 are 0.06 m apart at 10^6 m; the ball is 4 m away, a pixel there 0.01 m.
    let far = DVec3::new(1e6 + 0.27, -1e6 - 0.41, 1e6 + 0.13);
    let eye = far + DVec3::new(3.9, 0.4, 0.7);
    let set = Set::new(&format!(
        "[image]\nsize = [320, 180]\n{PAINT}[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\n\
         translate = {:?}\n[camera]\nposition = {:?}\nlook_at = {:?}\nhfov = 40\n",
        far.to_array(),
        eye.to_array(),
        far.to_array(),
    ));
    let [exact, rounded] = displaced(&set);
    assert!(
        exact.pixels.worst < 1e-6 && exact.mistaken == 0.0,
        "{exact:?}"
    );
    // 5.4 pixels were measured, and 1.4e-8 in f64.
    assert!((1.0..10.0).contains(&rounded.pixels.mean), "{rounded:?}");
    assert!(rounded.mistaken > 0.0, "{rounded:?}");
}

#[test]
fn a_large_lorentz_factor_displaces_f32_in_proportion_unless_along_an_axis() {
    let within = |gamma: f64, direction: &str| {
        displaced(&Set::new(&format!(
            "[image]\nsize = [320, 180]\n{PAINT}\
             [worldline.fast]\nvelocity = {{ gamma = {gamma}, direction = {direction} }}\n\
             [[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\nscale = 10\n\
             [camera]\nhfov = 60\n",
        )))
    };
    for gamma in [1e2, 1e4, 1e6] {
        let [exact, rounded] = within(gamma, "[1, 2, -3]");
        // 6e-8 rad in the rest frame, γ times that before the camera, 277 pixels a radian. Measured:
        // 0.0018, 0.18 and 17 pixels at γ = 10², 10⁴ and 10⁶, in f64 5·10⁻⁸ at the most.
        let mean = rounded.pixels.mean / (gamma * ROUNDING * 277.0);
        assert!((0.3..3.0).contains(&mean), "{gamma} {rounded:?}");
        assert!(exact.pixels.worst < 1e-12 * gamma, "{gamma} {exact:?}");
        // Along an axis what is rounded is the length of directions alone.
        let [_, rounded] = within(gamma, "[0, 0, -1]");
        assert!(rounded.pixels.worst < 1e-3, "{gamma} {rounded:?}");
    }
}

#[test]
fn lit_surfaces_mirrors_and_glass_do_not_shade_or_see_themselves() {
    let mirror = "mirror = { weight = 0.5, spectrum = 1.0 }\n";
    let glass = "refraction = { weight = 0.5, spectrum = 1.0, ior = 1.5 }\n";
    for (name, more) in [("paint", ""), ("mirror", mirror), ("glass", glass)] {
        let set = Set::new(&format!(
            "[image]\nsize = [320, 180]\nsamples = 1\n{}",
            room(more)
        ));
        let [exact, rounded] = [F64, F32].map(|p| film(&set, p).xyz);
        let differ = |[a, b]: [&[f32; 3]; 2]| (a[1] - b[1]).abs() > 1e-3 * a[1];
        let count = exact
            .iter()
            .zip(&rounded)
            .filter(|(a, b)| differ([a, b]))
            .count();
        // Those whose ray ends at an edge: 1, 1 and 37 were measured.
        assert!(count < 60, "{name}: {count} of {} pixels", exact.len());
    }
}

#[test]
fn the_film_is_the_same_on_any_number_of_threads() {
    let set = Set::new(&format!(
        "[image]\nsize = [120, 90]\nsamples = 4\n{}",
        room("")
    ));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| film(&set, F32)).xyz
    };
    let first = on(1);
    assert!(first == on(3) && first == on(4));
}

#[test]
fn trees_of_another_precision_are_not_taken_over() {
    let set = Set::new(&room(""));
    let scene = set.scene();
    let fresh = Stage::with_precision(&scene.geometry, None, F32);
    let after_f64 = Stage::with_precision(
        &scene.geometry,
        Some(&Stage::build(&scene.geometry, None)),
        F32,
    );
    let again = Stage::with_precision(&scene.geometry, Some(&fresh), F32);
    let mut dice = Dice(1);
    for _ in 0..1000 {
        let ray = RestRay {
            origin: DVec3::new(0.3, 0.4, 6.0),
            direction: (DVec3::new(0.0, 0.0, -8.0) + 4.0 * dice.point()).normalize(),
        };
        let hit = |stage: &Stage| stage.nearest(0, &ray, f64::INFINITY);
        assert_eq!(hit(&fresh), hit(&after_f64));
        assert_eq!(hit(&fresh), hit(&again));
    }
}

#[test]
fn what_leaves_the_range_of_f32_is_not_seen_and_does_no_harm() {
    for (scale, seen) in [(1e-30, false), (1e-12, true), (1e12, true), (1e30, false)] {
        let set = Set::new(&format!(
            "[image]\nsize = [40, 30]\n{PAINT}[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\n\
             scale = {scale:e}\n[camera]\nposition = [0, 0, {:e}]\n",
            3.0 * scale
        ));
        let [exact, rounded] = displaced(&set);
        assert_eq!(exact.mistaken, 0.0);
        assert_eq!(rounded.mistaken == 0.0, seen, "{scale:e} {rounded:?}");
    }
}

#[test]
fn the_shots_key_says_in_what_precision_it_is_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = ["f64", "f32", "f32"].map(|precision| {
        let far = "translate = [1000000.27, 0, 0]";
        std::fs::write(
            folder.path().join("wall.obj"),
            "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n",
        )
        .unwrap();
        let shot = folder.path().join("far.toml");
        let text = format!(
            "[image]\nsize = [60, 40]\n[sensor]\nexposure = 0\n[accuracy]\ntracing = \"{precision}\"\n\
             [material.paint]\nemission = {{ scale = 1, spectrum = 1.0 }}\n\
             [[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\n{far}\n\
             [camera]\nposition = [1000000.41, 0, 3]\n",
        );
        std::fs::write(&shot, text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_restframe"));
        command.arg("render").arg(&shot).arg("--out").arg(folder.path());
        assert!(command.status().unwrap().success());
        let bytes = std::fs::read(folder.path().join("far/far.0001.png")).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    });
    assert_ne!(pictures[0], pictures[1]);
    assert_eq!(pictures[1], pictures[2]);
}
