//! A scene in which every ray hits: a camera inside a closed shell with a lamp.

use restframe::queue::Prepared;
use restframe::scene::Scene;
use restframe::trace::Stage;
use std::path::{Path, PathBuf};

/// The shot with the shell at `beta` along x, the lamp on worldline `lamp`, and the given lines
/// under `[effects]` and `[accuracy]`.
pub(crate) fn shell(
    beta: f64,
    lamp: &str,
    effects: &str,
    accuracy: &str,
) -> (Prepared, Scene, Stage) {
    let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
    let text = format!(
        r#"
[image]
size = [160, 90]
[worldline.shell]
velocity = [{beta}, 0, 0]
[[model]]
file = {sphere:?}
worldline = "shell"
scale = 10
material = "red"
[material.red]
diffuse = {{ weight = 0.9, spectrum = {{ gaussian = {{ center = 650, width = 25 }} }} }}
highlight = {{ weight = 0.3, spectrum = 1.0, exponent = 40 }}
[[light]]
kind = "point"
worldline = "{lamp}"
position = [0, 3, 1]
intensity = 100000
[camera]
look_at = [0, 0, -1]
[effects]
{effects}
[accuracy]
{accuracy}
[sensor]
exposure = 0
"#
    );
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("shell-{}.toml", id(&text)));
    std::fs::write(&path, text).expect("the target folder can be written to");
    let prepared = Prepared::read(&path).expect("the shot has no mistake");
    let scene = Scene::resolve(&prepared.shot, &prepared.library, 1, None).expect("it resolves");
    let stage = Stage::build(&scene.geometry, None);
    (prepared, scene, stage)
}

/// A name of its own for each text, since benches run side by side.
fn id(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
