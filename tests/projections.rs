//! Panoramas and domes: where they look, against the same view turned there by yaw and pitch, and
//! what they show where they look nowhere. `b9` and `d12` of the hard cases hold whole pictures
//! of them against closed forms.

use crate::common::desk::Desk;
use crate::hard_cases::scene::Set;

/// Between two ways to one direction, which differ by rounding.
const ROUNDING: f64 = 1e-12;

/// A room that glows, about a camera that flies through it.
fn room(image: &str, camera: &str) -> Set {
    Set::new(&format!(
        "[image]\n{image}\n[worldline.ship]\nvelocity = [0.3, -0.2, -0.7]\n\
         [[model]]\nfile = \"box.obj\"\nscale = [3, 4, 5]\nmaterial = \"m\"\n\
         [material.m]\nemission = {{ scale = 1.0, spectrum = 1.0 }}\n\
         [camera]\nworldline = \"ship\"\n{camera}\n"
    ))
}

/// Asserts that a pixel sees what the middle of a perspective view sees that is turned by `yaw`
/// and `pitch`, degrees.
fn sees_as_turned(set: &Set, camera: &str, pixel: [u32; 2], yaw: f64, pitch: f64) {
    let turned = room(
        "size = [3, 3]",
        &format!("{camera}\npan = {yaw:?}\ntilt = {pitch:?}"),
    );
    let (found, expected) = (set.probe(pixel), turned.probe([1, 1]));
    let close = |f: f64, e: f64| (f - e).abs() <= ROUNDING * (1.0 + e.abs());
    let [f, e] = [&found, &expected].map(|p| p.direction.unwrap());
    assert!((0..3).all(|i| close(f[i], e[i])), "{pixel:?} {f:?} {e:?}");
    let [f, e] = [&found, &expected].map(|p| p.hit.as_ref().unwrap());
    assert!(close(f.doppler, e.doppler), "{pixel:?} {f:?} {e:?}");
    assert!(
        (0..3).all(|i| close(f.event.x[i], e.event.x[i])),
        "{pixel:?} {f:?} {e:?}"
    );
    assert!(close(found.xyz[1] / expected.xyz[1], 1.0), "{pixel:?}");
}

#[test]
fn a_panorama_sees_what_a_view_turned_by_yaw_and_pitch_sees() {
    let set = room("size = [40, 10]", "projection = \"equirectangular\"");
    for pixel in [[0, 0], [39, 0], [0, 5], [39, 4], [20, 9], [13, 2], [27, 7]] {
        let yaw = (f64::from(pixel[0]) + 0.5) * 9.0 - 180.0;
        let pitch = 90.0 - (f64::from(pixel[1]) + 0.5) * 18.0;
        sees_as_turned(&set, "", pixel, yaw, pitch);
    }
    // Turned itself, with a part of the sphere: 80 by 40 degrees.
    let turned = "yaw = 200";
    let set = room(
        "size = [40, 20]",
        &format!("{turned}\nvfov = 40\nprojection = \"equirectangular\""),
    );
    for pixel in [[0, 0], [39, 19], [20, 10]] {
        let yaw = f64::from(pixel[0]) * 2.0 - 39.0;
        let pitch = 19.0 - f64::from(pixel[1]) * 2.0;
        sees_as_turned(&set, turned, pixel, yaw, pitch);
    }
}

#[test]
fn a_dome_sees_at_each_distance_from_its_centre_the_angle_in_proportion() {
    // All around, across 121 columns.
    let set = room("size = [121, 61]", "hfov = 360\nprojection = \"fisheye\"");
    let step = 360.0 / 121.0;
    for x in [0, 1, 30, 59, 60, 61, 90, 120] {
        // Along the middle row the angle is yaw.
        let yaw = (f64::from(x) - 60.0) * step;
        sees_as_turned(&set, "", [x, 30], yaw, 0.0);
    }
    for y in [0, 15, 30, 45, 60] {
        // Along the middle column it is pitch, beyond the zenith too.
        let pitch = (30.0 - f64::from(y)) * step;
        sees_as_turned(&set, "", [60, y], 0.0, pitch);
    }
}

#[test]
fn outside_of_a_domes_circle_there_is_no_light_and_no_layer() {
    const SIZE: [u32; 2] = [96, 64];
    const RADIUS: f64 = 32.0;
    let set = room(
        "size = [96, 64]\nsamples = 64\nfilter = \"box\"",
        "projection = \"fisheye\"",
    );
    let film = set.film();
    let layers = &film.layers;
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let at = (y * SIZE[0] + x) as usize;
            let off = (f64::from(x) - 47.5).hypot(f64::from(y) - 31.5) - RADIUS;
            let worldline = layers.worldline.as_ref().unwrap()[at];
            let doppler = layers.doppler.as_ref().unwrap()[at];
            let covered = worldline >= 0.0;
            assert_eq!(covered, doppler > 0.0, "{x} {y}");
            // The layers describe the sample nearest to the pixel's centre.
            if off.abs() > 0.2 {
                assert_eq!(covered, off < 0.0, "{x} {y}");
            }
            if off.abs() > 0.71 {
                assert_eq!(film.xyz[at][1] > 0.0, off < 0.0, "{x} {y}");
            }
        }
    }
}

#[test]
fn a_pixel_on_the_circle_is_as_bright_as_the_part_of_it_that_is_inside() {
    // All of the sky is equally bright, so the picture's sum is the circle's area. The ball is
    // behind the camera.
    let set = Set::new(
        "[image]\nsize = [96, 64]\nsamples = 64\nfilter = \"box\"\n\
         [background]\nspectrum = 1.0\n\
         [[model]]\nfile = \"ball.obj\"\ntranslate = [0, 0, 50]\nmaterial = \"m\"\n\
         [material.m]\ndiffuse = { weight = 0.5, spectrum = 1.0 }\n\
         [camera]\nprojection = \"fisheye\"\n",
    );
    let film = set.film();
    let luminance = |x: usize, y: usize| f64::from(film.xyz[y * 96 + x][1]);
    let sky = luminance(48, 32);
    let sum: f64 = film.xyz.iter().map(|xyz| f64::from(xyz[1]) / sky).sum();
    let area = std::f64::consts::PI * 32.0 * 32.0;
    // 64 stratified samples in each of the some 250 pixels on the circle are off by far less.
    assert!((sum / area - 1.0).abs() < 5e-4, "{sum} {area}");
    // Where the circle cuts the row next to its upper end: from there on all is outside.
    assert_eq!(luminance(0, 0), 0.0);
    assert!(luminance(44, 0) > 0.0 && luminance(44, 0) < sky);
}

#[test]
fn probe_says_where_nothing_is_seen() {
    let desk = Desk::with_sphere();
    let text = "[image]\nsize = [40, 20]\n[background]\nspectrum = 1.0\n\
                [[model]]\nfile = \"sphere.obj\"\nmaterial = \"m\"\n\
                [material.m]\ndiffuse = { weight = 0.5, spectrum = 1.0 }\n\
                [camera]\nposition = [0, 0, 9]\nprojection = \"fisheye\"\n";
    desk.write("dome.toml", text);
    let probed = |pixel: &str| {
        let call = format!("probe dome.toml --frame 1 --pixel {pixel}");
        desk.done(&call).stdout
    };
    let text = probed("9 10");
    assert!(
        text.contains("sees nothing: it lies outside of the fisheye's circle"),
        "{text}"
    );
    assert!(probed("11 10").contains("sees the background"));
    assert!(probed("20 10").contains("sees model"));
    let json = |pixel: &str| -> serde_json::Value {
        serde_json::from_str(&probed(&format!("{pixel} --json"))).unwrap()
    };
    let nothing = json("9 10");
    assert!(nothing["hit"].is_null());
    let radiance = nothing["radiance"].as_array().unwrap();
    assert_eq!(
        radiance.len(),
        nothing["wavelengths"].as_array().unwrap().len()
    );
    assert!(radiance.iter().all(|value| value.as_f64() == Some(0.0)));
    let sky = json("11 10");
    assert!(sky["hit"].is_null());
    assert!(sky["xyz"][1].as_f64().unwrap() > 0.0);
}
