//! Images that share a trace: each is to the bit what it is alone, whatever tells them apart and on
//! however many threads; and together they can be stopped, and say where their time went.
mod together;
mod watched;

use restframe::accel::Aggregate;
use restframe::film::Film;
use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::render::{Member, Options, Stopped, Together, Watch, render, render_together};
use restframe::scene::Scene;
use restframe::shot::Layer;
use restframe::trace::build_aggregate;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Balls that move, one of them warm, and a wall; lamps in both frames. What stands in capitals is
/// what images may differ in, and what it is if nobody says.
const SHOT: &str = r#"
[image]
size = [32, 18]
FILTER
[worldline.fast]
velocity = [0.6, 0.1, 0]
passes = [-0.5, 0, 0]
[[model]]
name = "balls"
file = "SPHERE"
worldline = "fast"
array = { count = [3, 2, 1], step = [2.2, 2.4, 0], centered = true }
material = "paint"
[[model]]
name = "wall"
file = "SPHERE"
translate = [0.5, 0, -6]
scale = 3
material = "wall"
[material.paint]
diffuse = { weight = WEIGHT, spectrum = PAINT }
highlight = { weight = 0.2, spectrum = 1.0, exponent = 40 }
emission = { scale = 1e-3, spectrum = { gaussian = { center = 560, width = 30 } } }
thermal = { temperature = KELVIN, emissivity = EMISSIVITY, curve = "peak", strength = 0.01 }
[material.wall]
diffuse = { weight = 0.5, spectrum = { rgb = [0.2, 0.4, 0.9] } }
PASSES
[[light]]
kind = "point"
position = [3, 5, 6]
intensity = POWER
spectrum = LAMP
[[light]]
kind = "spot"
worldline = "fast"
position = [-3, 6, 5]
direction = [0.4, -1, -0.8]
inner = 20
outer = 50
intensity = 3000
[[light]]
kind = "sun"
direction = [-1, -1, -1]
intensity = 20
[background]
worldline = "lab"
SKY
[camera]
position = [0, 0, 9]
hfov = 60
CAMERA
[effects]
EFFECTS
SPLICE
[sensor]
exposure = EXPOSURE
SENSOR
[accuracy]
ACCURACY
"#;

const DEFAULTS: &[(&str, &str)] = &[
    ("FILTER", ""),
    ("WEIGHT", "0.7"),
    ("PAINT", "{ gaussian = { center = 600, width = 30 } }"),
    ("KELVIN", "3000"),
    ("EMISSIVITY", "1.0"),
    ("PASSES", ""),
    ("POWER", "2000"),
    ("LAMP", "1.0"),
    ("SKY", "spectrum = 1e-3"),
    ("CAMERA", ""),
    ("EFFECTS", ""),
    ("SPLICE", ""),
    ("EXPOSURE", "0"),
    ("SENSOR", ""),
    ("ACCURACY", ""),
];

/// An image of a shot, and its film when rendered alone.
struct Image {
    prepared: Prepared,
    scene: Scene,
    alone: Film,
}

/// What stands in place of words in capitals.
type Changes<'a> = &'a [(&'a str, &'a str)];

fn prepared(changes: &[Changes<'_>]) -> Prepared {
    let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
    let mut text = SHOT.replace("SPHERE", sphere.to_str().unwrap());
    for (word, value) in changes.iter().copied().flatten().chain(DEFAULTS) {
        text = text.replace(word, value);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shot.toml");
    std::fs::write(&path, text).unwrap();
    Prepared::read(&path).unwrap()
}

/// Frame 1 of a shot, and its bodies.
fn scene(prepared: &Prepared) -> (Scene, Aggregate) {
    let scene = Scene::resolve(
        &Frame::new(&prepared.shot, 1).unwrap(),
        &prepared.library,
        None,
    )
    .unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    (scene, aggregate)
}

/// Frame 1 of a shot, whose scene stands in for its own. The frame outlives its member, and so is
/// left to the end of the process.
fn member<'a>(prepared: &'a Prepared, scene: &'a Scene) -> Member<'a> {
    let frame = Box::leak(Box::new(Frame::new(&prepared.shot, 1).unwrap()));
    Member { frame, scene }
}

impl Image {
    fn new(changes: &[Changes<'_>], options: &Options) -> Self {
        let prepared = prepared(changes);
        let (scene, aggregate) = scene(&prepared);
        let alone = render(
            &Frame::new(&prepared.shot, 1).unwrap(),
            &scene,
            &aggregate,
            options,
            &|_| (),
        );
        Self {
            prepared,
            scene,
            alone,
        }
    }

    fn member(&self) -> Member<'_> {
        member(&self.prepared, &self.scene)
    }
}

fn options(samples: u32) -> Options {
    Options {
        width: 32,
        height: 18,
        samples,
        layers: vec![
            Layer::Doppler,
            Layer::Distance,
            Layer::EmissionTime,
            Layer::Worldline,
        ],
    }
}

/// Renders images on so many threads.
fn together(
    threads: usize,
    members: &[Member<'_>],
    aggregate: &Aggregate,
    options: &Options,
) -> Result<Together, Stopped> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let stop = &AtomicBool::new(false);
    let watch = Watch {
        done: &|_| (),
        stop,
    };
    pool.install(|| render_together(members, aggregate, options, watch))
}
