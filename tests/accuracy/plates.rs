//! The plates, small: the same rays shaded exactly and as they are.

use restframe::color::spaces::D65_XYZ;
use restframe::color::{delta_e_2000, lab_from_xyz};
use restframe::frame::Frame;
use restframe::image::compare::Comparison;
use restframe::render::Prepared;
use restframe::render::{Options, render};
use restframe::scene::Scene;
use restframe::shot::Spectra;
use restframe::trace::build_aggregate;
use std::path::Path;

/// A tenth of their size.
const SIZE: [u32; 2] = [128, 72];

/// CIEDE2000 of the pixels of a plate between exact spectra and the shot as it is, exposed as it
/// is.
fn differences(number: u32) -> Comparison {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("shots/plate-{number:02}.toml"));
    let mut prepared = Prepared::read(&path).unwrap();
    let frame = Frame::new(&prepared.shot, 1).unwrap();
    let stops = prepared.exposure().unwrap().0.stops(&frame);
    let scene = Scene::resolve(&frame, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let options = Options {
        width: SIZE[0],
        height: SIZE[1],
        samples: 1,
        layers: Vec::new(),
    };
    let mut film = |spectra| {
        prepared.shot.accuracy.spectra = spectra;
        let frame = Frame::new(&prepared.shot, 1).unwrap();
        render(&frame, &scene, &aggregate, &options, &|_| ())
    };
    let [exact, grid] = [Spectra::Exact, Spectra::Grid].map(&mut film);
    assert!(
        exact.xyz.iter().any(|xyz| xyz[1] > 0.0),
        "{number} is black"
    );
    let lab = |xyz: &[f32; 3]| {
        // 100 cd/m² is white at exposure 0.
        lab_from_xyz(xyz.map(|v| f64::from(v) / 100.0 * stops.exp2()), D65_XYZ)
    };
    let pixels = exact.xyz.iter().zip(&grid.xyz);
    Comparison::of(pixels.map(|(a, b)| delta_e_2000(lab(a), lab(b))).collect())
}

#[test]
fn every_plate_is_within_a_tenth_of_delta_e_of_exact_spectra() {
    for number in 1..=12 {
        let begun = std::time::Instant::now();
        let found = differences(number);
        println!("plate {number}: {found:?} in {:?}", begun.elapsed());
        assert!(found.p99 < 0.1, "plate {number}: {found:?}");
    }
}
