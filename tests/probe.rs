//! What one pixel sees, against answers derived without restframe (`scripts/probe-oracle`: 60
//! digits, from the null condition, k·u and the shot format alone), and scenes that are awkward
//! for arithmetic, of which only sane answers are asked.
//!
//! The answers are asked of `probe` and of the image's own short cuts, with spectra baked and not.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use restframe::frame::Frame;
use restframe::probe::{Probe, ProbeHit, probe};
use restframe::render::Prepared;
use restframe::render::View;
use restframe::scene::Scene;
use restframe::shade::ShadeScratch;
use restframe::shot::Spectra;
use restframe::trace::{Scratch, ShadeTrees, build_aggregate};
use serde::Deserialize;

/// Of D, relative.
const DOPPLER: f64 = 1e-9;
/// Of events and distances, relative to the distance, or to the sum of all to the camera: what an f32 mesh would just reach.
const EVENT: f64 = 1e-5;
/// Rounding of an event far from the lab's origin, relative to its own coordinates.
const FAR: f64 = 1e-14;
/// Of components of normals.
const NORMAL: f64 = 1e-6;
/// Of what a node's term passes on, and of what is cut off.
const COEFFICIENT: f64 = 1e-9;
/// Of spectral radiance at every wavelength, relative to its peak over the window.
const RADIANCE: f64 = 1e-3;
/// Of X, Y and Z, relative to the greatest of them. Red, green and blue by the same.
const XYZ: f64 = 1e-3;

/// Whose XYZ cannot be had from 84 wavelengths so exactly, as its spectra jump at 420 and 640 nm,
/// somewhere between two of them: [`steps_in_a_spectrum_are_met_by_more_wavelengths`].
const STEPPED: (&str, f64) = ("static-spline-tension", 1e-2);

#[derive(Deserialize)]
struct Expected {
    scene: String,
    #[serde(default = "usual_pixel")]
    pixel: [u32; 2],
    #[serde(default = "first")]
    frame: u32,
    hit: Option<ExpectedHit>,
    /// What is seen in mirrors and through glass.
    #[serde(default)]
    further: Vec<ExpectedNode>,
    /// Share of that which is not followed; None where it is not said what counts.
    #[serde(default = "nothing")]
    cut: Option<f64>,
    peak: f64,
    /// In millionths of the peak.
    radiance: Vec<f64>,
    xyz: [f64; 3],
    rgb: [f64; 3],
}

#[derive(Deserialize)]
struct ExpectedHit {
    material: String,
    doppler: f64,
    #[serde(flatten)]
    place: ExpectedPlace,
}

#[derive(Deserialize)]
struct ExpectedPlace {
    model: String,
    worldline: String,
    t: f64,
    x: [f64; 3],
    /// To what it is seen in, or to the camera.
    distance: f64,
    normal: [f64; 3],
}

#[derive(Deserialize)]
struct ExpectedNode {
    /// A letter for each surface on the way there: m if it is seen in a mirror, r through glass.
    way: String,
    coefficient: f64,
    /// To what it is seen in.
    doppler: f64,
    /// None if it is the background.
    hit: Option<ExpectedPlace>,
}

fn nothing() -> Option<f64> {
    Some(0.0)
}

fn usual_pixel() -> [u32; 2] {
    [6, 1]
}

fn first() -> u32 {
    1
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/probe")
}

fn expected() -> Vec<Expected> {
    let text = std::fs::read_to_string(folder().join("expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// [`answers`] of one pixel.
fn answer(prepared: &Prepared, frame: u32, pixel: [u32; 2]) -> (Probe, [f64; 3]) {
    answers(prepared, frame, &[pixel]).remove(0)
}

/// Probes, each with XYZ of the same ray as images have it.
fn answers(prepared: &Prepared, frame: u32, pixels: &[[u32; 2]]) -> Vec<(Probe, [f64; 3])> {
    let shot = &prepared.shot;
    let values = Frame::new(shot, frame).unwrap();
    let scene = Scene::resolve(&values, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(&values, &shot.effects, &scene, &aggregate);
    let stops = prepared.exposure().unwrap().0.stops(&values);
    let answer = |&pixel: &[u32; 2]| {
        let point = [0, 1].map(|i| (f64::from(pixel[i]) + 0.5) / f64::from(shot.image.size[i]));
        let mut trees = ShadeTrees::default();
        let direction = scene.camera.looks_along(point).unwrap();
        view.tracer()
            .trace(&[direction], &mut Scratch::default(), &mut trees);
        let imaged = view
            .shader()
            .xyz(&trees, trees.roots[0], &mut ShadeScratch::default());
        (probe(&values, pixel, &view, &scene, stops), imaged)
    };
    pixels.iter().map(answer).collect()
}

/// The largest difference of components.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    // Not f64::max, which would pass over NaN: here one NaN makes the answer NaN.
    found
        .iter()
        .zip(expected)
        .map(|(f, e)| (f - e).abs())
        .fold(0.0, |worst, off| {
            if worst.is_nan() || off <= worst {
                worst
            } else {
                off
            }
        })
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |top, v| v.abs().max(top))
}

/// A quantity, its error, and what is allowed.
type Errors = Vec<(&'static str, f64, f64)>;

/// Adds the errors of a surface at the end of a way that is `length` long.
fn place_errors(errors: &mut Errors, expected: &ExpectedPlace, found: &ProbeHit, length: f64) {
    let same = expected.model == found.model && expected.worldline == found.worldline;
    errors.push(("name", f64::from(u8::from(!same)), 0.0));
    let [x, y, z] = expected.x;
    let coordinates = [expected.t, x, y, z];
    let off = (found.distance - expected.distance).abs();
    errors.push(("distance", off / length, EVENT));
    let [x, y, z] = found.event.x;
    let off = apart(&[found.event.t, x, y, z], &coordinates);
    let far = FAR * greatest(&coordinates) / length;
    errors.push(("event", off / length, EVENT + far));
    let normal = apart(&found.normal, &expected.normal);
    errors.push(("normal", normal, NORMAL));
}

/// Adds the errors of all that is seen in the first surface, in whatever order it was followed.
fn chain_errors(errors: &mut Errors, expected: &Expected, found: &Probe) {
    if let Some(cut) = expected.cut {
        let off = (found.cut - cut).abs();
        errors.push(("share that is cut off", off, COEFFICIENT));
    }
    let first = expected.hit.as_ref();
    let mut ways: Vec<(String, f64, f64)> = Vec::new();
    let mut unseen = expected.further.len();
    for node in &found.chain {
        let Some(parent) = node.parent else {
            let e = first.map_or((1.0, 0.0), |e| (e.doppler, e.place.distance));
            ways.push((String::new(), e.0, e.1));
            continue;
        };
        let (before, doppler, length) = &ways[parent as usize];
        let letter = match node.by {
            Some("mirror") => "m",
            Some("refraction") => "r",
            other => panic!("{}: by {other:?}", expected.scene),
        };
        let way = format!("{before}{letter}");
        let Some(e) = expected.further.iter().find(|e| e.way == way) else {
            errors.push(("what is seen on a way", f64::INFINITY, 0.0));
            return;
        };
        unseen -= 1;
        let off = (node.coefficient / e.coefficient - 1.0).abs();
        errors.push(("coefficient", off, COEFFICIENT));
        let off = (node.doppler / e.doppler - 1.0).abs();
        errors.push(("doppler on a way", off, DOPPLER));
        let doppler = doppler * e.doppler;
        let mut length = *length;
        match (&e.hit, &node.hit) {
            (None, None) => {}
            (Some(e), Some(f)) => {
                length += e.distance;
                let off = (f.doppler / doppler - 1.0).abs();
                errors.push(("doppler of a way", off, DOPPLER));
                place_errors(errors, e, f, length);
            }
            _ => errors.push(("whether a surface is seen", f64::INFINITY, 0.0)),
        }
        ways.push((way, doppler, length));
    }
    errors.push(("ways that are not seen", unseen as f64, 0.0));
}

/// Errors over what is allowed, by quantity; or what is plainly wrong.
fn errors(expected: &Expected, found: &Probe, imaged: [f64; 3]) -> Errors {
    let mut errors = Vec::new();
    match (&expected.hit, &found.hit) {
        (None, None) => {}
        (Some(e), Some(f)) => {
            let same = e.material == f.material;
            errors.push(("name", f64::from(u8::from(!same)), 0.0));
            errors.push(("doppler", (f.doppler / e.doppler - 1.0).abs(), DOPPLER));
            place_errors(&mut errors, &e.place, f, e.place.distance);
        }
        _ => errors.push(("whether a surface is seen", f64::INFINITY, 0.0)),
    }
    chain_errors(&mut errors, expected, found);
    let axis: Vec<f64> = (0..84)
        .map(|j| 360.0 * (830.0_f64 / 360.0).powf((f64::from(j) + 0.5) / 84.0))
        .collect();
    errors.push(("wavelengths", apart(&found.wavelengths, &axis), 1e-9));
    let of_peak = |unit: f64| {
        if expected.peak > 0.0 {
            unit / expected.peak
        } else {
            unit
        }
    };
    let radiance: Vec<f64> = found.radiance.iter().map(|v| of_peak(*v)).collect();
    let curve: Vec<f64> = expected.radiance.iter().map(|v| v * 1e-6).collect();
    errors.push(("radiance", apart(&radiance, &curve), RADIANCE));
    let top = greatest(&expected.xyz);
    let of_top = |off: f64, top: f64| if top > 0.0 { off / top } else { off };
    let allowed = if expected.scene == STEPPED.0 {
        STEPPED.1
    } else {
        XYZ
    };
    errors.push((
        "xyz",
        of_top(apart(&found.xyz, &expected.xyz), top),
        allowed,
    ));
    errors.push((
        "xyz of an image",
        of_top(apart(&imaged, &expected.xyz), top),
        allowed,
    ));
    errors.push((
        "rgb",
        of_top(apart(&found.rgb, &expected.rgb), greatest(&expected.rgb)),
        3.0 * allowed,
    ));
    errors
}

fn check_all(spectra: Spectra) {
    let results: Vec<_> = expected()
        .par_iter()
        .map(|expected| {
            let path = folder().join(format!("{}.toml", expected.scene));
            let mut prepared = Prepared::read(&path).unwrap_or_else(|mistakes| {
                panic!("{}: {mistakes}", expected.scene);
            });
            prepared.shot.accuracy.spectra = spectra;
            let (found, imaged) = answer(&prepared, expected.frame, expected.pixel);
            (expected.scene.clone(), errors(expected, &found, imaged))
        })
        .collect();
    assert!(results.len() >= 40, "only {} scenes", results.len());
    let mut wrong = Vec::new();
    let mut worst: Vec<(&str, f64, &str)> = Vec::new();
    for (scene, errors) in &results {
        for &(quantity, error, allowed) in errors {
            if error.is_nan() || error > allowed {
                wrong.push(format!(
                    "{scene}: {quantity} is off by {error:.2e}, allowed {allowed:.0e}"
                ));
            }
            match worst.iter_mut().find(|(q, ..)| *q == quantity) {
                Some(entry) if entry.1 >= error => {}
                Some(entry) => *entry = (quantity, error, scene),
                None => worst.push((quantity, error, scene)),
            }
        }
    }
    for (quantity, error, scene) in worst {
        println!("{quantity}: at most {error:.2e}, in {scene}");
    }
    assert!(
        wrong.is_empty(),
        "{} wrong answers:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn pixels_see_what_was_derived_with_baked_spectra() {
    check_all(Spectra::Grid);
}

#[test]
fn pixels_see_what_was_derived_with_splines() {
    check_all(Spectra::Spline);
}

#[test]
fn steps_in_a_spectrum_are_met_by_more_wavelengths() {
    let expected: Vec<_> = expected()
        .into_iter()
        .filter(|e| e.scene == STEPPED.0)
        .collect();
    let path = folder().join(format!("{}.toml", STEPPED.0));
    let mut prepared = Prepared::read(&path).unwrap();
    prepared.shot.accuracy.wavelengths = 4096;
    let (found, _) = answer(&prepared, 1, expected[0].pixel);
    let off = apart(&found.xyz, &expected[0].xyz) / greatest(&expected[0].xyz);
    assert!(off < 1e-3, "off by {off:e}");
}

/// Scenes of one mesh, a wall or a box, written to a folder of their own.
struct Awkward {
    folder: tempfile::TempDir,
}

impl Awkward {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let wall = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
        std::fs::write(folder.path().join("wall.obj"), wall).unwrap();
        let corner = |i: u32, bit: u32| if i & bit == 0 { -1 } else { 1 };
        let mut cube: String = (0..8)
            .map(|i| format!("v {} {} {}\n", corner(i, 1), corner(i, 2), corner(i, 4)))
            .collect();
        for f in [
            "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
        ] {
            cube += &format!("f {f}\n");
        }
        std::fs::write(folder.path().join("cube.obj"), cube).unwrap();
        Self { folder }
    }

    /// What a 5 x 5 image's pixel sees of `rest`, a shot's tables but for image and material.
    fn sees(&self, name: &str, rest: &str, pixel: [u32; 2]) -> Probe {
        self.sees_at(name, rest, &[pixel]).remove(0)
    }

    /// All pixels of the image.
    fn sees_everywhere(&self, name: &str, rest: &str) -> Vec<Probe> {
        let pixels: Vec<[u32; 2]> = (0..25).map(|i| [i % 5, i / 5]).collect();
        self.sees_at(name, rest, &pixels)
    }

    fn sees_at(&self, name: &str, rest: &str, pixels: &[[u32; 2]]) -> Vec<Probe> {
        let path = self.folder.path().join(format!("{name}.toml"));
        let text = format!(
            "[image]\nsize = [5, 5]\n[sensor]\nexposure = 0\n\
             [material.paint]\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\nemission = {{ scale = 0.1, spectrum = 1.0 }}\n\
             highlight = {{ spectrum = 1.0, weight = 0.1, exponent = 30 }}\nthermal = {{ temperature = 3000 }}\n{rest}"
        );
        std::fs::write(&path, text).unwrap();
        let prepared =
            Prepared::read(&path).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        let answers = answers(&prepared, 1, pixels);
        for (probe, imaged) in &answers {
            is_sane(name, probe, *imaged);
        }
        answers.into_iter().map(|(probe, _)| probe).collect()
    }
}

/// Asserts that nothing in an answer is beyond all numbers or below 0.
fn is_sane(name: &str, probe: &Probe, imaged: [f64; 3]) {
    let pixel = probe.pixel;
    let curves = probe.radiance.iter().chain(&probe.xyz).chain(&imaged);
    for value in curves {
        assert!(
            value.is_finite() && *value >= 0.0,
            "{name} {pixel:?}: {probe:?}"
        );
    }
    assert!(
        probe.rgb.iter().all(|v| v.is_finite()),
        "{name} {pixel:?}: {:?}",
        probe.rgb
    );
    if let Some(hit) = &probe.hit {
        let [t, d, s] = [hit.event.t, hit.doppler, hit.distance];
        assert!(
            t.is_finite() && d.is_finite() && s.is_finite(),
            "{name} {pixel:?}: {hit:?}"
        );
        assert!(d > 0.0 && s >= 0.0, "{name} {pixel:?}: {hit:?}");
        let length = hit.normal.iter().map(|n| n * n).sum::<f64>();
        assert!(
            (length - 1.0).abs() < 1e-9,
            "{name} {pixel:?}: normal {:?}",
            hit.normal
        );
        assert!(
            hit.event.x.iter().all(|x| x.is_finite()),
            "{name} {pixel:?}: {hit:?}"
        );
    }
}

const WALL: &str = "[[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\n";
const CUBE: &str = "[[model]]\nfile = \"cube.obj\"\nmaterial = \"paint\"\n";

fn lamp(position: &str) -> String {
    format!("[[light]]\nkind = \"point\"\nposition = {position}\nscale = 1.0\nspectrum = 1.0\n")
}

/// E = I cos θ/r² is beyond all numbers within 1e-154 m of a point of light: held, and where it is more
/// than a picture holds, that is counted. Exactly at the surface, the lamp is on neither side of it.
#[test]
fn lamps_at_a_surface_are_finite_at_any_distance() {
    let awkward = Awkward::new();
    let cases = [
        ("grid", 1.0),
        ("spline", 1.0),
        ("exact", 1.0),
        ("lines", 1.0),
    ];
    for (spectra, scale) in cases.into_iter().chain([("grid", 1e300)]) {
        let sees = |z: f64| {
            let rest = format!(
                "[accuracy]\nspectra = \"{spectra}\"\n{WALL}[[light]]\nkind = \"point\"\n\
                 position = [0, 0, {z:e}]\nscale = {scale:e}\nspectrum = 1.0\n\
                 [camera]\nposition = [0, 0, 3]\nhfov = 20\n"
            );
            awkward.sees(&format!("at-{spectra}"), &rest, [2, 2])
        };
        let [dark, near, usual] = [0.0, 1e-9, 1e-3].map(&sees);
        assert!(usual.radiance[40] > dark.radiance[40]);
        if scale == 1.0 && spectra != "lines" {
            // A million times nearer, and the rest of what is seen is nothing beside it.
            let lit = |probe: &Probe| probe.radiance[40] - dark.radiance[40];
            let ratio = lit(&near) / lit(&usual);
            assert!((ratio / 1e12 - 1.0).abs() < 1e-6, "{spectra}: {ratio:e}");
        }
        let mut before = near.xyz[1];
        for z in [1e-20, 1e-35, 1e-100, 1e-153, 1e-160, 1e-200, 1e-320] {
            let here = sees(z).xyz[1];
            assert!(here >= before, "{spectra} {z:e}: {here:e} {before:e}");
            before = here;
        }
    }
}

#[test]
fn a_camera_on_a_surface_sees_none_of_it_and_no_nan() {
    let awkward = Awkward::new();
    let camera = "[camera]\nposition = [0.3, 0.2, 0]\n";
    for yaw in [0.0, 90.0, 180.0, 45.0] {
        let rest = format!("{WALL}{}{camera}yaw = {yaw}\n", lamp("[0, 0, 3]"));
        for probe in awkward.sees_everywhere(&format!("on-{yaw}"), &rest) {
            assert!(probe.hit.is_none(), "{probe:?}");
        }
    }
}

#[test]
fn a_lamp_on_a_surface_gives_sane_light() {
    let awkward = Awkward::new();
    let camera = "[camera]\nposition = [0, 0, 2]\nhfov = 40\n";
    // At a corner, on the diagonal, at the very point that the middle pixel sees.
    for (i, place) in ["[1, 1, 0]", "[0.3, 0.3, 0]", "[0, 0, 0]", "[0.4, -0.1, 0]"]
        .iter()
        .enumerate()
    {
        awkward.sees_everywhere(
            &format!("lamp-{i}"),
            &format!("{WALL}{}{camera}", lamp(place)),
        );
    }
}

#[test]
fn a_shared_edge_is_seen_and_lit_like_its_neighbourhood() {
    let awkward = Awkward::new();
    // The middle pixel looks at the diagonal x = y, whatever of it has come there.
    let velocities = [
        "[0, 0, 0]",
        "[0.5, 0.5, 0]",
        "[-0.6, -0.6, 0.3]",
        "[0, 0, 0.9]",
        "[0, 0, -0.9]",
    ];
    for (i, velocity) in velocities.iter().enumerate() {
        let look = |x: f64| {
            let rest = format!(
                "[worldline.fast]\nvelocity = {velocity}\n{WALL}scale = 8\nworldline = \"fast\"\n{}[camera]\n\
                 position = [{x}, 0, 2]\nhfov = 40\n",
                lamp("[0, 0, 3]")
            );
            awkward.sees(&format!("edge-{i}"), &rest, [2, 2])
        };
        let (on, beside) = (look(0.0), look(1e-4));
        assert!(
            on.hit.is_some(),
            "the wall leaks at its diagonal at {velocity}"
        );
        let off = (on.xyz[1] / beside.xyz[1] - 1.0).abs();
        assert!(off < 2e-3, "the diagonal differs by {off:e} at {velocity}");
    }
}

#[test]
fn a_closed_box_does_not_leak_at_any_speed() {
    let awkward = Awkward::new();
    let velocities = [
        "[0.0, 0.0, 0.0]",
        "[0.5, 0.3, -0.2]",
        "{ gamma = 1e3, direction = [1, 2, 3] }",
        "{ gamma = 1e6, direction = [0, 0, -1] }",
        "{ gamma = 1e6, direction = [0, 0, 1] }",
    ];
    for (i, velocity) in velocities.iter().enumerate() {
        for yaw in [0, 30, 90, 180] {
            let rest = format!(
                "[worldline.fast]\nvelocity = {velocity}\n{CUBE}worldline = \"fast\"\n{}worldline = \"fast\"\n\
                 [camera]\nyaw = {yaw}\nhfov = 120\n",
                lamp("[0.5, 0.25, -0.5]")
            );
            for probe in awkward.sees_everywhere(&format!("box-{i}-{yaw}"), &rest) {
                assert!(
                    probe.hit.is_some(),
                    "leaks at {velocity}, {:?}",
                    probe.pixel
                );
                assert!(
                    probe.radiance[40] > 0.0,
                    "black at {velocity}, {:?}",
                    probe.pixel
                );
            }
        }
    }
}

#[test]
fn walls_edge_on_and_lamps_in_their_plane_or_behind_them_are_sane() {
    let awkward = Awkward::new();
    let edge_on = "[camera]\nposition = [3, 0, 0]\nlook_at = [0, 0, 0]\nhfov = 40\n";
    awkward.sees_everywhere("edge-on", &format!("{WALL}{}{edge_on}", lamp("[0, 0, 3]")));
    let square = "[camera]\nposition = [0.1, 0.2, 3]\nhfov = 20\n";
    for (i, place) in ["[3, 0, 0]", "[0, 0, -1]"].iter().enumerate() {
        let lit = format!("{WALL}{}{square}", lamp(place));
        let dark = format!("{WALL}{square}");
        let [lit, dark] =
            [lit, dark].map(|rest| awkward.sees(&format!("behind-{i}"), &rest, [2, 2]));
        assert_eq!(
            lit.radiance, dark.radiance,
            "a lamp at {place} lights the wall's front"
        );
    }
}

#[test]
fn the_fastest_motions_long_ago_and_far_ahead_are_sane() {
    let awkward = Awkward::new();
    for direction in ["[0, 0, 1]", "[0, 0, -1]", "[1, 0, 0]", "[0.3, -0.5, 0.7]"] {
        for gamma in ["1e6", "1e9", "1e30"] {
            for time in ["0", "1e9", "-1e9"] {
                let rest = format!(
                    "[shot]\ntime = {time}\n[worldline.fast]\nvelocity = {{ gamma = {gamma}, direction = {direction} }}\n\
                     {CUBE}worldline = \"fast\"\nscale = 100\n{}[camera]\nposition = [1, 2, 3]\n",
                    lamp("[0.5, 0.25, -0.5]")
                );
                awkward.sees("fast", &rest, [1, 3]);
                awkward.sees("fast-middle", &rest, [2, 2]);
            }
        }
    }
}

#[test]
fn light_takes_its_time_also_where_nothing_moves() {
    // The first fault that the derived answers found: with nothing in relative motion, emission was
    // told as simultaneous with the exposure, and worldlines of one velocity stood apart as in the
    // lab. `convoy-gamma-1e5` and `comoving-apart` hold the rest of it.
    let rest = format!("{WALL}[camera]\nposition = [0, 0, 2]\nhfov = 1\n");
    let hit = Awkward::new().sees("still", &rest, [2, 2]).hit.unwrap();
    assert_eq!(hit.event.t, -2.0);
    assert_eq!(hit.distance, 2.0);
}
