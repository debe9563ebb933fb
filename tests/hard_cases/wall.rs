//! One wall in one pixel, for what concerns light alone.

use super::scene::Set;

/// A wall that fills the one pixel, comes on at `beta`, and is lit from the front by `sun`
/// (W·m⁻²·nm⁻¹ at all wavelengths).
pub(crate) fn wall(sensor: &str, material: &str, beta: f64, sun: f64) -> Set {
    Set::new(&format!(
        r#"
[image]
size = [1, 1]
samples = 1
[worldline.fast]
velocity = [0, 0, {beta}]
[[model]]
file = "wall.obj"
worldline = "fast"
material = "wall"
[material.wall]
{material}
[[light]]
kind = "sun"
direction = [0, 0, -1]
scale = {sun}
spectrum = 1.0
[camera]
position = [0, 0, 3]
hfov = 1e-6
{sensor}
"#
    ))
}
