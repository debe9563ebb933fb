//! What each effect costs where it is called for, and that it costs nothing elsewhere: frames of
//! the same balls before the camera, as ratios of one run to `plain`.
//!
//! `named_only` names every effect and calls for none: a mirror and glass of weight 0, a body at
//! 0 K, a second worldline at rest, a black background.

#[path = "shell/read.rs"]
mod read;

use divan::Bencher;
use read::read;
use restframe::frame::Frame;
use restframe::render::{Options, render};
use std::path::Path;

fn main() {
    divan::main();
}

/// What a variant changes.
#[derive(Default)]
struct Scene {
    /// Terms of the one ball that is not paint alone.
    special: &'static str,
    /// Velocity of that ball.
    velocity: &'static str,
    background: &'static str,
    effects: &'static str,
}

fn frame(bencher: Bencher<'_, '_>, scene: Scene) {
    let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
    let velocity = if scene.velocity.is_empty() {
        "[0, 0, 0]"
    } else {
        scene.velocity
    };
    let Scene {
        special,
        background,
        effects,
        ..
    } = scene;
    let (prepared, resolved, aggregate) = read(&format!(
        r#"
[image]
size = [320, 180]
[worldline.other]
velocity = {velocity}
[[model]]
name = "balls"
file = {sphere:?}
array = {{ count = [9, 5, 1], step = [2, 2, 2], centered = true }}
translate = [0, 0, -4]
material = "paint"
[[model]]
name = "special"
file = {sphere:?}
worldline = "other"
scale = 2.5
material = "special"
[material.paint]
diffuse = {{ weight = 0.9, spectrum = {{ gaussian = {{ center = 600, width = 25 }} }} }}
[material.special]
diffuse = {{ weight = 0.2, spectrum = {{ gaussian = {{ center = 500, width = 25 }} }} }}
{special}
[[light]]
kind = "sun"
direction = [-1, -1, -2]
intensity = 1000
[background]
{background}
[camera]
position = [0, 0, 7]
[effects]
{effects}
[sensor]
exposure = 0
"#
    ));
    let options = Options {
        width: 320,
        height: 180,
        samples: 4,
        layers: Vec::new(),
    };
    let one_thread = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread can be had");
    bencher.bench_local(|| {
        one_thread.install(|| {
            render(
                &Frame::new(&prepared.shot, 1).expect("it moves"),
                &resolved,
                &aggregate,
                &options,
                &|_| (),
            )
        })
    });
}

#[divan::bench(sample_count = 25)]
fn plain(bencher: Bencher<'_, '_>) {
    frame(bencher, Scene::default());
}

#[divan::bench(sample_count = 25)]
fn named_only(bencher: Bencher<'_, '_>) {
    frame(
        bencher,
        Scene {
            special: "mirror = { weight = 0, spectrum = 1.0 }\nrefraction = { weight = 0, spectrum = 1.0 }\nthermal = { temperature = 0 }",
            velocity: "{ from = [0, 0, 0], to = [0.5, 0, 0] }",
            background: "spectrum = 0.0",
            effects: "bounces = 64",
        },
    );
}

#[divan::bench(sample_count = 25)]
fn mirror(bencher: Bencher<'_, '_>) {
    let special = "mirror = { weight = 0.8, spectrum = 1.0 }";
    frame(
        bencher,
        Scene {
            special,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn mirror_of_a_color(bencher: Bencher<'_, '_>) {
    let special =
        "mirror = { weight = 0.8, spectrum = { gaussian = { center = 600, width = 50 } } }";
    frame(
        bencher,
        Scene {
            special,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn glass(bencher: Bencher<'_, '_>) {
    let special = "mirror = { spectrum = 1.0 }\nrefraction = { spectrum = 1.0 }";
    frame(
        bencher,
        Scene {
            special,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn second_worldline(bencher: Bencher<'_, '_>) {
    let velocity = "[0.5, 0, 0]";
    frame(
        bencher,
        Scene {
            velocity,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn moving_mirror(bencher: Bencher<'_, '_>) {
    frame(
        bencher,
        Scene {
            special: "mirror = { weight = 0.8, spectrum = 1.0 }",
            velocity: "[0.5, 0, 0]",
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn thermal(bencher: Bencher<'_, '_>) {
    let special = "thermal = { temperature = 3000 }";
    frame(
        bencher,
        Scene {
            special,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn background(bencher: Bencher<'_, '_>) {
    let background = "spectrum = \"D65\"";
    frame(
        bencher,
        Scene {
            background,
            ..Scene::default()
        },
    );
}

#[divan::bench(sample_count = 25)]
fn without_shadows(bencher: Bencher<'_, '_>) {
    let effects = "shadows = \"off\"";
    frame(
        bencher,
        Scene {
            effects,
            ..Scene::default()
        },
    );
}
