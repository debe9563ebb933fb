//! Whole shade trees: through mirrors and glass, and black bodies that move.

use glam::DVec3;
use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::render::View;
use restframe::scene::Scene;
use restframe::shade::ShadeScratch;
use restframe::shot::{Accuracy, SensorColor, Spectra};
use restframe::trace::{Scratch, ShadeTrees, build_aggregate};
use std::path::Path;

/// What the centres of all pixels of a shot see, in the sensor's channels.
fn seen(prepared: &mut Prepared, accuracy: Accuracy) -> Vec<[f64; 3]> {
    prepared.shot.accuracy = accuracy;
    let shot = &prepared.shot;
    let frame = Frame::new(shot, 1).unwrap();
    let scene = Scene::resolve(&frame, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(&frame, &shot.effects, &scene, &aggregate);
    let [width, height] = shot.image.size;
    let centers = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let directions: Vec<DVec3> = centers
        .filter_map(|[x, y]| {
            let point = [
                (f64::from(x) + 0.5) / f64::from(width),
                (f64::from(y) + 0.5) / f64::from(height),
            ];
            scene.camera.looks_along(point)
        })
        .collect();
    let mut trees = ShadeTrees::default();
    view.tracer()
        .trace(&directions, &mut Scratch::default(), &mut trees);
    let mut scratch = ShadeScratch::default();
    let mut shade = |root| view.shader().xyz(&trees, root, &mut scratch);
    trees.roots.iter().map(|root| shade(*root)).collect()
}

fn accuracy(spectra: Spectra, wavelengths: u32) -> Accuracy {
    Accuracy {
        spectra,
        wavelengths,
        ..Accuracy::default()
    }
}

/// Largest difference of a channel over the image's greatest.
fn difference(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let greatest = b.as_flattened().iter().fold(0.0f64, |m, v| m.max(*v));
    assert!(greatest > 0.0, "black");
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / greatest
}

/// Measured 3e-7, of the f32 weights and of the steps of 0.1 nm that make them.
const SPLINE: f64 = 2e-6;

#[test]
fn mirrors_and_glass_match_the_sum_over_4096_wavelengths() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/probe");
    for name in [
        "mirror-coloured-spline",
        "mirror-coloured-gaussian",
        "mirror-closing-0.99c",
        "mirrors-two-fast",
        "mirror-sky-half-c",
        "mirror-highlight-point",
        "glass-silvered-half-c",
        "glass-tinted-0.4c",
        "glass-mirrors-0.4c",
        "three-worldlines-fast",
        "thermal-peak-moving",
        "effects-beaming-square",
        "effects-doppler-off",
    ] {
        let path = folder.join(format!("{name}.toml"));
        let mut prepared = Prepared::read(&path).unwrap_or_else(|m| panic!("{name}: {m}"));
        for color in [SensorColor::Cie1931, SensorColor::Bands] {
            prepared.shot.sensor.color = color;
            let exact = seen(&mut prepared, accuracy(Spectra::Exact, 84));
            let spline = seen(&mut prepared, accuracy(Spectra::Spline, 4096));
            let off = difference(&spline, &exact);
            println!("{name} {color:?}: {off:e}");
            assert!(off < SPLINE, "{name} {color:?}: {off:e}");
        }
    }
}

/// One pixel that sees a wall at `kelvin` come on at β = 0.6: D = 2.
fn glowing(kelvin: f64, beta: f64, emissivity: &str, sensor: &str) -> [f64; 3] {
    let folder = tempfile::tempdir().unwrap();
    let wall = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
    std::fs::write(folder.path().join("wall.obj"), wall).unwrap();
    let text = format!(
        "[image]\nsize = [1, 1]\n[worldline.fast]\nvelocity = [0, 0, {beta}]\n\
         [[model]]\nfile = \"wall.obj\"\nworldline = \"fast\"\nmaterial = \"wall\"\n\
         [material.wall]\nthermal = {{ temperature = {kelvin}, emissivity = {emissivity} }}\n\
         [camera]\nposition = [0, 0, 3]\nhfov = 1e-6\n[sensor]\n{sensor}\n"
    );
    let path = folder.path().join("case.toml");
    std::fs::write(&path, text).unwrap();
    let mut prepared = Prepared::read(&path).unwrap_or_else(|m| panic!("{m}"));
    seen(&mut prepared, accuracy(Spectra::Exact, 84))[0]
}

#[test]
fn a_moving_black_body_is_one_at_its_shifted_temperature_to_a_billionth() {
    for sensor in [
        "exposure = 0",
        "color = \"bands\"\nwindow = [4e3, 14e3]",
        "color = \"bands\"\nwindow = [1e-2, 1e9]",
    ] {
        for kelvin in [40.0, 300.0, 2500.0, 1e5] {
            for emissivity in ["1.0", "0.3"] {
                let moving = glowing(kelvin, 0.6, emissivity, sensor);
                let still = glowing(2.0 * kelvin, 0.0, emissivity, sensor);
                let greatest = still.into_iter().fold(f64::MIN_POSITIVE, f64::max);
                for (moving, still) in moving.into_iter().zip(still) {
                    // x = hc/λkT makes of rounding in D what it is times.
                    let off = (moving - still).abs() / greatest;
                    assert!(off < 1e-9, "{kelvin} K, {sensor}: {moving:e} {still:e}");
                }
            }
        }
    }
}
