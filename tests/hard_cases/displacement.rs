//! How far from its pixel a ray meets its surface, in pixels: rays and triangles are f64.

use super::scene::Set;
use glam::DVec3;
use restframe::frame::Frame;
use restframe::render::View;
use restframe::study::displacement::{Displacement, displacement};
use restframe::trace::build_aggregate;

const PAINT: &str = "[image]\nsize = [320, 180]\n\
    [material.paint]\ndiffuse = { weight = 0.4, spectrum = 1.0 }\n";

fn displaced(text: &str) -> Displacement {
    let set = Set::new(&format!("{PAINT}{text}"));
    let shot = &set.prepared.shot;
    let frame = Frame::new(shot, 1).unwrap();
    let scene = set.scene();
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(&frame, &shot.effects, &scene, &aggregate);
    displacement(&view, &view, shot.image.size)
}

#[test]
fn near_the_origin_nothing_is_displaced() {
    let found = displaced(
        "[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\n\
         [[model]]\nfile = \"box.obj\"\nmaterial = \"paint\"\n\
         translate = [2.5, -0.7, 0.3]\nrotate = [10, 20, 30]\nscale = 0.6\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\nscale = 8\ntranslate = [0, 0, -3]\n\
         [camera]\nposition = [0.3, 0.4, 6]\nhfov = 60\n",
    );
    assert!(found.pixels.worst < 1e-11, "{found:?}");
}

#[test]
fn a_million_meters_from_the_origin_next_to_nothing_is_displaced() {
    let far = DVec3::new(1e6 + 0.27, -1e6 - 0.41, 1e6 + 0.13);
    let eye = far + DVec3::new(3.9, 0.4, 0.7);
    let found = displaced(&format!(
        "[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\ntranslate = {:?}\n\
         [camera]\nposition = {:?}\nlook_at = {:?}\nhfov = 40\n",
        far.to_array(),
        eye.to_array(),
        far.to_array(),
    ));
    // 1.4e-8 was measured.
    assert!(
        found.pixels.worst < 1e-6 && found.mistaken == 0.0,
        "{found:?}"
    );
}

#[test]
fn at_large_lorentz_factors_displacement_stays_within_the_rounding_of_directions() {
    for gamma in [1e2, 1e4, 1e6] {
        let found = displaced(&format!(
            "[worldline.fast]\nvelocity = {{ gamma = {gamma}, direction = [1, 2, -3] }}\n\
             [[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\nscale = 10\n\
             [camera]\nhfov = 60\n",
        ));
        assert!(found.pixels.worst < 1e-12 * gamma, "{gamma} {found:?}");
    }
}

#[test]
fn bodies_of_any_size_are_seen() {
    for scale in [1e-30, 1e-12, 1e12, 1e30] {
        let found = displaced(&format!(
            "[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\nscale = {scale:e}\n\
             [camera]\nposition = [0, 0, {:e}]\n",
            3.0 * scale
        ));
        assert!(found.mistaken == 0.0 && found.pixels.worst > 0.0, "{scale}");
    }
}
