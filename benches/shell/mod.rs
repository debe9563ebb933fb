//! A scene in which every ray hits: a camera inside a closed shell with a lamp.

mod read;

use restframe::accel::Aggregate;
use restframe::render::Prepared;
use restframe::scene::Scene;
use std::path::Path;

/// The shot with the shell at `beta` along x, the lamp on worldline `lamp`, and the given lines
/// under `[effects]` and `[accuracy]`.
pub(crate) fn shell(
    beta: f64,
    lamp: &str,
    effects: &str,
    accuracy: &str,
) -> (Prepared, Scene, Aggregate) {
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
    read::read(&text)
}
