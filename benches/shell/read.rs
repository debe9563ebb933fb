//! Shots of benches, read from text.

use restframe::accel::Aggregate;
use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use std::path::PathBuf;

/// A shot, frame 1 of it and its bodies, from text.
pub(crate) fn read(text: &str) -> (Prepared, Scene, Aggregate) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("bench-{}.toml", id(text)));
    std::fs::write(&path, text).expect("the target folder can be written to");
    let prepared = Prepared::read(&path).expect("the shot has no mistake");
    let scene = Scene::resolve(
        &Frame::new(&prepared.shot, 1).expect("it moves"),
        &prepared.library,
        None,
    )
    .expect("it resolves");
    let aggregate = build_aggregate(&scene.geometry, None);
    (prepared, scene, aggregate)
}

/// A name of its own for each text, since benches run side by side.
fn id(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
