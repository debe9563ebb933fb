//! Light delay as `shots/drive-by.toml` shows it: a lattice that passes at 0.9 c is seen where it
//! was when its light left, worked out here from the light cone alone.
use restframe::frame::Frame;
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::View;
use restframe::scene::{Library, Scene};
use restframe::shot::parse;
use restframe::trace::build_aggregate;
use std::path::{Path, PathBuf};

const BETA: f64 = 0.9;
/// Of an event, m, and of Doppler factors: rounding of f64 in distances up to 600 m, with room.
const ROUNDING: f64 = 1e-9;
/// The shot's image and its camera, which is at rest in the lab.
const WIDTH: f64 = 1280.0;
const HEIGHT: f64 = 720.0;
const EYE: [f64; 3] = [0.0, 0.2, 5.5];
const YAW_DEG: f64 = -10.0;
const HALF_FIELD_DEG: f64 = 50.0;
/// A bar of the cell ends this far from its node; its sides are this far from its axis.
const END: f64 = 0.87;
const SIDE: f64 = 0.05;

fn lorentz_factor() -> f64 {
    1.0 / (1.0 - BETA * BETA).sqrt()
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("shots/drive-by.toml")
}

fn text() -> String {
    std::fs::read_to_string(path()).unwrap()
}

/// The shot with some lines replaced, each of which has to be there.
fn with(lines: &[(&str, &str)]) -> Prepared {
    let mut text = text();
    for (old, new) in lines {
        assert!(text.contains(old), "no {old}");
        text = text.replace(old, new);
    }
    let shot = parse(&text, &path()).unwrap();
    let library = Library::load(&shot).unwrap();
    Prepared { shot, library }
}

/// What pixels of a frame see.
fn probes(prepared: &Prepared, frame: u32, pixels: &[[u32; 2]]) -> Vec<Probe> {
    let shot = &prepared.shot;
    let scene = Scene::resolve(&Frame::new(shot, frame).unwrap(), &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(
        &Frame::new(shot, frame).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    let look = |pixel: &[u32; 2]| {
        probe(
            &Frame::new(shot, frame).unwrap(),
            *pixel,
            &view,
            &scene,
            0.0,
        )
    };
    pixels.iter().map(look).collect()
}

fn lab_time(frame: u32) -> f64 {
    0.8 + (16.2 - 0.8) * f64::from(frame - 1) / 71.0
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// When and where a point of the lattice, given in its rest frame, sent the light that is at `eye`
/// at the time `now`: of x = x′/γ + βt and now − t = |x − eye| the earlier solution.
fn retarded(point: [f64; 3], eye: [f64; 3], now: f64) -> (f64, [f64; 3]) {
    let ahead = point[0] / lorentz_factor() + BETA * now - eye[0];
    let aside = (point[1] - eye[1]).hypot(point[2] - eye[2]);
    // With d = now − t: (ahead − βd)² + aside² = d².
    let one = 1.0 - BETA * BETA;
    let d = (-BETA * ahead + (ahead * ahead + one * aside * aside).sqrt()) / one;
    let t = now - d;
    let x = point[0] / lorentz_factor() + BETA * t;
    (t, [x, point[1], point[2]])
}

/// Where a point is in the image, pixels, by a pinhole turned about y.
fn projected(point: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = minus(point, EYE);
    let (sin, cos) = YAW_DEG.to_radians().sin_cos();
    let depth = x * sin - z * cos;
    let focal = WIDTH / 2.0 / HALF_FIELD_DEG.to_radians().tan();
    [
        WIDTH / 2.0 + focal * (x * cos + z * sin) / depth,
        HEIGHT / 2.0 - focal * y / depth,
    ]
}

/// Where the centre of a pixel looks in the lab, a unit vector.
fn direction([column, row]: [u32; 2]) -> [f64; 3] {
    let focal = WIDTH / 2.0 / HALF_FIELD_DEG.to_radians().tan();
    let right = (f64::from(column) + 0.5 - WIDTH / 2.0) / focal;
    let up = (HEIGHT / 2.0 - f64::from(row) - 0.5) / focal;
    let (sin, cos) = YAW_DEG.to_radians().sin_cos();
    let [x, y, z] = [sin + right * cos, up, -cos + right * sin];
    let norm = length([x, y, z]);
    [x / norm, y / norm, z / norm]
}

/// Of the foremost of the upper bars that point to the camera, the free end's upper corner ahead:
/// nothing is before it.
const CORNER: [f64; 3] = [SIDE, 1.0 + SIDE, 1.0 + END];
/// One in which the corner comes, one in which it goes.
const FRAMES: [u32; 2] = [3, 30];

/// Where in the image the corner is seen.
fn corner(frame: u32) -> [f64; 2] {
    projected(retarded(CORNER, EYE, lab_time(frame)).1)
}

#[test]
fn a_corner_of_the_head_is_seen_where_its_light_left_it() {
    let prepared = with(&[]);
    for frame in FRAMES {
        let [x, y] = corner(frame);
        let at = |dx: f64, dy: f64| [(x + dx) as u32, (y + dy) as u32];
        // Centres of pixels are at most half a pixel from where these look; the end of the bar is
        // some 10 pixels high, and its edges slope by less than 1/4.
        let pixels = [at(-1.0, 2.0), at(-1.0, -1.5), at(1.0, 2.0)];
        let ends: Vec<bool> = probes(&prepared, frame, &pixels)
            .into_iter()
            .map(|probe| {
                probe
                    .hit
                    .is_some_and(|hit| hit.model == "train" && on_end(hit.event.x))
            })
            .collect();
        assert_eq!(
            ends,
            [true, false, false],
            "frame {frame}: on, above, beyond"
        );
        // Were it seen where it is, it would be far from here.
        let now = CORNER[0] / lorentz_factor() + BETA * lab_time(frame);
        let shift = projected([now, CORNER[1], CORNER[2]])[0] - x;
        assert!(shift > 200.0, "frame {frame}: {shift} pixels");
    }
}

/// Whether a point lies on the free end of a bar that points to the camera.
fn on_end(point: [f64; 3]) -> bool {
    (point[2] - CORNER[2]).abs() < ROUNDING
}

#[test]
fn emission_and_doppler_factor_are_those_of_the_light_cone() {
    let prepared = with(&[]);
    for frame in FRAMES {
        let [x, y] = corner(frame);
        let pixel = [(x - 1.0) as u32, (y + 2.0) as u32];
        let probe = probes(&prepared, frame, &[pixel]).remove(0);
        let hit = probe.hit.unwrap();
        // The end of the bar is in the plane z = 1.87 in every rest frame that moves along x.
        let look = direction(pixel);
        let distance = (CORNER[2] - EYE[2]) / look[2];
        let t = lab_time(frame) - distance;
        let x = [0, 1, 2].map(|i| EYE[i] + distance * look[i]);
        assert!((hit.event.t - t).abs() < ROUNDING, "frame {frame}: {hit:?}");
        assert!(length(minus(hit.event.x, x)) < ROUNDING, "frame {frame}");
        // It is on the bar, which is 0.1 wide, a pixel or two behind the corner.
        let rest = lorentz_factor() * (x[0] - BETA * t);
        assert!((-SIDE..SIDE).contains(&rest), "frame {frame}: {rest}");
        // Light travels against the look.
        let doppler = 1.0 / (lorentz_factor() * (1.0 + BETA * look[0]));
        assert!((hit.doppler - doppler).abs() < ROUNDING, "frame {frame}");
        assert_eq!(doppler > 1.0, frame == FRAMES[0]);
    }
}

/// Apparent positions along the motion of the first and the last layer of bars, seen from `eye`
/// nearly along the motion, when the first is at 0.
fn ends(eye: f64, yaw: &str) -> [f64; 2] {
    let position = format!("position = [{eye}, 0.45, 0.45]");
    let prepared = with(&[
        ("time   = { from = 0.8, to = 16.2 }", "time = 60"),
        ("position = [0, 0.2, 5.5]", &position),
        ("yaw      = -10", yaw),
        ("hfov     = 100", "hfov = 4"),
    ]);
    let eye = [eye, 0.45, 0.45];
    // Across bars that stand upright.
    let pixels: Vec<[u32; 2]> = (0..1280).map(|x| [x, 330]).collect();
    let mut layers = [None; 12];
    for probe in probes(&prepared, 1, &pixels) {
        let Some(hit) = probe.hit.filter(|hit| hit.model == "train") else {
            continue;
        };
        let along = hit.normal[0];
        if along.abs() < 1.0 - ROUNDING {
            continue; // Not a side of a bar that faces the eye.
        }
        // Sides stand at whole numbers and a twentieth; which one, the emission itself must tell.
        for layer in 0..12 {
            let side = -f64::from(layer) + SIDE.copysign(along);
            let point = [side, hit.event.x[1], hit.event.x[2]];
            let (t, x) = retarded(point, eye, 60.0);
            if (hit.event.t - t).abs() < ROUNDING * 100.0 {
                assert!(length(minus(hit.event.x, x)) < ROUNDING * 100.0);
                layers[layer as usize] = Some(hit.event.x[0]);
            }
        }
    }
    [layers[0].unwrap(), layers[11].unwrap()]
}

#[test]
fn what_comes_is_longer_than_what_goes_by_one_plus_beta_over_one_minus_beta() {
    let [coming, going] = [(60.0, "yaw = -90"), (-60.0, "yaw = 90")].map(|(eye, yaw)| {
        let [first, last] = ends(eye, yaw);
        first - last
    });
    let one_way = lorentz_factor() * (1.0 + BETA);
    // What is seen s = 1.5 m aside at r = 60 m is off the motion by s/r: as 1 − β magnifies it,
    // lengths differ by (s/r)²/2 · γ²(1 + β) = 0.3 %, and where they end by as much again.
    let tolerance = 0.01;
    assert!(
        (coming / 11.0 / one_way - 1.0).abs() < tolerance,
        "{coming}"
    );
    assert!((going / 11.0 * one_way - 1.0).abs() < tolerance, "{going}");
    let ratio = (1.0 + BETA) / (1.0 - BETA);
    assert!(
        (coming / going / ratio - 1.0).abs() < 2.0 * tolerance,
        "{coming} / {going}"
    );
}
