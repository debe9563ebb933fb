//! Pixels by which it shows whether the renderer still makes the pictures that fingerprints of its
//! epoch stand for.

#![cfg(target_arch = "x86_64")]

use super::desk::house;
use crate::common::desk::Desk;
use restframe::film::develop;
use restframe::film::to_rgb8;
use restframe::frame::{EPOCH, Frame};
use restframe::render::{Options, development, render};
use restframe::scene::{Library, Scene};
use restframe::trace::build_aggregate;

const COMMON: &str = r#"
[shot]
time = 0.2
[image]
size = [32, 24]
samples = 4
[sensor]
exposure = 0
[camera]
position = [0.4, 0.3, 4]
look_at = [0, 0, 0]
hfov = 50
[[light]]
kind = "point"
position = [1.5, 2, 3]
intensity = 900
[[light]]
kind = "spot"
worldline = "w"
position = [-1, 3, 1]
direction = [0.3, -1, -0.3]
intensity = 600
spectrum = "A"
[worldline.w]
velocity = [0.4, 0.1, 0]
[[model]]
name = "floor"
file = "wall.obj"
rotate = [-80, 0, 0]
translate = [0, -0.8, 0]
scale = 3
material = "floor"
[material.floor]
diffuse = { spectrum = 0.6 }
"#;

/// What stands before the floor.
const SUBJECTS: [(&str, &str); 4] = [
    (
        "lit",
        "[[model]]\nfile = \"house.obj\"\nworldline = \"w\"\nrotate = [0, 30, 0]\n\
         [material.roof]\nhighlight = { weight = 0.4, spectrum = 1.0, exponent = 20 }\n",
    ),
    (
        "thermal",
        "[[model]]\nfile = \"house.obj\"\nworldline = \"w\"\nmaterial = \"hot\"\n\
         [material.hot]\nthermal = { temperature = 2400, curve = \"peak\", strength = 0.02 }\n\
         [background]\nspectrum = { rgb = [0.1, 0.2, 0.6] }\nworldline = \"lab\"\nscale = 0.01\n\
         stars = { count = 400, size = 1.0 }\n",
    ),
    (
        "mirror",
        "[[model]]\nfile = \"wall.obj\"\ntranslate = [0, 0, -1]\nmaterial = \"mirror\"\n\
         [[model]]\nfile = \"house.obj\"\nworldline = \"w\"\nscale = 0.5\n\
         [material.mirror]\nmirror = { weight = 0.9, spectrum = \"gold\" }\n\
         [spectrum.gold]\npoints = [[400, 0.3], [500, 0.4], [600, 0.9], [700, 1.0]]\n",
    ),
    (
        "glass",
        "[[model]]\nfile = \"house.obj\"\ntranslate = [0, 0, -1]\n\
         [[model]]\nname = \"pane\"\nfile = \"wall.obj\"\nworldline = \"w\"\nrotate = [5, 25, 0]\n\
         scale = 0.8\nmaterial = \"glass\"\n[material.glass]\n\
         mirror = { spectrum = 1.0 }\nrefraction = { spectrum = 0.95, ior = 1.5 }\n",
    ),
];

/// Of the pixels of the subjects, in their order, at [`EPOCH`] 2.
const PIXELS: [&str; 4] = [
    "524a0462266a9857",
    "5d05b962ae4d5612",
    "b8e1fc4e4d3771a2",
    "44bde8a924001e90",
];

/// The 8-bit pixels of one subject.
fn pixels(desk: &Desk, subject: &str) -> Vec<u8> {
    let shot = desk.shot(&format!("{COMMON}{subject}"));
    let library = Library::load(&shot).unwrap();
    let frame = Frame::new(&shot, 1).unwrap();
    let scene = Scene::resolve(&frame, &library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let options = Options {
        width: shot.image.size[0],
        height: shot.image.size[1],
        samples: shot.image.samples,
        layers: Vec::new(),
    };
    let film = render(&frame, &scene, &aggregate, &options, &|_| ());
    let development = development(shot.sensor.color, 0.0);
    to_rgb8(&develop(&film, &development), development.encode)
}

#[test]
fn pixels_change_only_with_the_epoch() {
    let desk = house();
    desk.write(
        "wall.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl none\nf 1 2 3 4\n",
    );
    let mut found = Vec::new();
    for (name, subject) in SUBJECTS {
        let pixels = pixels(&desk, subject);
        let lit = pixels.iter().filter(|value| **value > 10).count();
        let different = pixels
            .iter()
            .collect::<std::collections::HashSet<_>>()
            .len();
        assert!(
            lit > 500 && different > 60,
            "{name} shows too little: {lit} {different}"
        );
        found.push(blake3::hash(&pixels).to_hex()[..16].to_owned());
    }
    assert_eq!(
        EPOCH, 2,
        "write the pixels of the new epoch here: {found:?}"
    );
    assert_eq!(
        found, PIXELS,
        "the same shots give other pixels than before. If that is meant, raise EPOCH in \
         src/frame/fingerprint/fingerprints.rs, so that finished frames are rendered anew, and write these hashes here"
    );
}
