//! The phases of an image, each over the knob that it depends on: lamps, samples and filters,
//! bounces and cutoffs, and what becomes of a film. Read them as ratios of one run; boosts are in
//! `boost.rs`, spectra in `spectra.rs`.

#[path = "shell/read.rs"]
mod read;

use divan::{Bencher, black_box, counter::ItemsCount};
use read::read;
use restframe::accel::Aggregate;
use restframe::film::{Development, Film, develop};
use restframe::frame::Frame;
use restframe::image::exr::{self, Depth};
use restframe::image::{Metadata, png};
use restframe::render::Prepared;
use restframe::render::{Options, development, render};
use restframe::scene::Scene;
use std::path::Path;

fn main() {
    divan::main();
}

/// Balls in rows before the camera, at rest.
const BALLS: &str = r#"
[[model]]
file = "SPHERE"
array = { count = [9, 5, 2], step = [2.2, 2.2, 3], centered = true }
material = "paint"
[material.paint]
diffuse = { weight = 0.9, spectrum = { gaussian = { center = 600, width = 50 } } }
[camera]
position = [0, 0, 14]
[sensor]
exposure = 0
"#;

/// A scene and how large its picture is to be; `filter` is apart, since the smooth one
/// takes a time of its own.
struct Picture {
    scene: String,
    filter: &'static str,
    width: u32,
    height: u32,
    samples: u32,
}

impl Picture {
    /// Times one thread at it.
    fn time(&self, bencher: Bencher<'_, '_>) {
        let Self { width, height, .. } = *self;
        let (prepared, scene, aggregate) = self.read();
        let options = self.options();
        let rays = width * height * self.samples;
        let one_thread = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .expect("a thread can be had");
        bencher.counter(ItemsCount::new(rays)).bench_local(|| {
            one_thread.install(|| {
                render(
                    &Frame::new(&prepared.shot, 1).expect("it moves"),
                    &scene,
                    &aggregate,
                    &options,
                    &|_| (),
                )
            })
        });
    }

    fn read(&self) -> (Prepared, Scene, Aggregate) {
        let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
        let sphere = sphere.to_str().expect("a path in UTF-8");
        let scene = self.scene.replace("SPHERE", sphere);
        read(&format!("[image]\nfilter = {:?}\n{scene}", self.filter))
    }

    fn options(&self) -> Options {
        Options {
            width: self.width,
            height: self.height,
            samples: self.samples,
            layers: Vec::new(),
        }
    }
}

/// `count` lamps of equal light, strewn over the half space of the camera.
fn lamps(count: u32) -> String {
    let lamp = |i: u32| {
        // The golden angle spreads them evenly for any count.
        let (turn, radius) = (f64::from(i) * 2.4, 2.0 + f64::from(i));
        let [x, y] = [radius * turn.cos(), radius * turn.sin()];
        format!("[[light]]\nkind = \"point\"\nposition = [{x}, {y}, 10]\nintensity = 1e5\n")
    };
    (0..count).map(lamp).collect()
}

#[divan::bench(args = [0, 1, 4, 16], sample_count = 20, max_time = 2)]
fn shadow_rays_over_lamps(bencher: Bencher<'_, '_>, count: u32) {
    let picture = Picture {
        scene: BALLS.to_owned() + &lamps(count),
        filter: "box",
        width: 160,
        height: 90,
        samples: 4,
    };
    picture.time(bencher);
}

fn sampled(bencher: Bencher<'_, '_>, filter: &'static str, samples: u32) {
    let picture = Picture {
        scene: BALLS.to_owned() + &lamps(1),
        filter,
        width: 96,
        height: 54,
        samples,
    };
    picture.time(bencher);
}

#[divan::bench(args = [1, 4, 16, 64], sample_count = 20, max_time = 2)]
fn samples_through_a_box(bencher: Bencher<'_, '_>, samples: u32) {
    sampled(bencher, "box", samples);
}

#[divan::bench(args = [1, 4, 16, 64], sample_count = 20, max_time = 2)]
fn samples_through_blackman_harris(bencher: Bencher<'_, '_>, samples: u32) {
    sampled(bencher, "blackman-harris", samples);
}

/// Bounces, each with every cutoff.
fn depths() -> impl Iterator<Item = (u32, &'static str)> {
    let cutoffs = ["1e-2", "1e-4", "0.0"];
    let bounces = [0, 1, 2, 4, 8].into_iter();
    bounces.flat_map(move |bounces| cutoffs.map(|cutoff| (bounces, cutoff)))
}

/// Rows of glass balls between two facing mirrors, of which one is behind the camera: light
/// branches at every ball, and there is always another.
#[divan::bench(args = depths(), sample_count = 20, max_time = 1)]
fn bounces_and_cutoff_between_mirrors(bencher: Bencher<'_, '_>, (bounces, cutoff): (u32, &str)) {
    let wall = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench-wall.obj");
    let square = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n";
    std::fs::write(&wall, square).expect("the target folder can be written to");
    let mirror = |z: f64| {
        format!("[[model]]\nfile = {wall:?}\nmaterial = \"mirror\"\ntranslate = [0, 0, {z}]\n")
    };
    let (front, back, lamp) = (mirror(-6.0), mirror(16.0), lamps(1));
    let scene = format!(
        r#"
{BALLS}
{front}
{back}
{lamp}
[[model]]
name = "glass"
file = "SPHERE"
array = {{ count = [8, 4, 1], step = [2.2, 2.2, 3], centered = true }}
translate = [0, 0, 5]
material = "glass"
[material.glass]
mirror = {{ spectrum = 1.0 }}
refraction = {{ spectrum = 1.0 }}
[material.mirror]
mirror = {{ weight = 0.9, spectrum = 1.0 }}
[effects]
bounces = {bounces}
[accuracy]
cutoff = {cutoff}
"#
    );
    let picture = Picture {
        scene,
        filter: "box",
        width: 96,
        height: 54,
        samples: 1,
    };
    picture.time(bencher);
}

/// The balls as a film of 640 × 360, and how it is developed.
fn film() -> (Film, Development) {
    let picture = Picture {
        scene: BALLS.to_owned() + &lamps(1),
        filter: "box",
        width: 640,
        height: 360,
        samples: 1,
    };
    let (prepared, scene, aggregate) = picture.read();
    let film = render(
        &Frame::new(&prepared.shot, 1).expect("it moves"),
        &scene,
        &aggregate,
        &picture.options(),
        &|_| (),
    );
    (film, development(prepared.shot.sensor.color, 0.0))
}

#[divan::bench(sample_count = 50, max_time = 2)]
fn film_is_developed(bencher: Bencher<'_, '_>) {
    let (film, development) = film();
    bencher.bench_local(|| develop(black_box(&film), &development));
}

#[divan::bench(sample_count = 50, max_time = 2)]
fn film_is_written_as_png(bencher: Bencher<'_, '_>) {
    let (film, development) = film();
    let developed = develop(&film, &development);
    bencher.bench_local(|| {
        let rgb8 = restframe::film::to_rgb8(black_box(&developed), development.encode);
        png::encode(film.width, film.height, &rgb8, &Metadata::default())
    });
}

#[divan::bench(args = [Depth::Float, Depth::Half], sample_count = 50, max_time = 2)]
fn film_is_written_as_exr(bencher: Bencher<'_, '_>, depth: Depth) {
    let (film, development) = film();
    let developed = develop(&film, &development);
    let (width, height) = (film.width, film.height);
    let metadata = Metadata::default();
    bencher.bench_local(|| {
        let developed = black_box(&developed);
        exr::encode(width, height, developed, depth, &film.layers, &metadata)
    });
}
