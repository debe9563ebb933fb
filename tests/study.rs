//! `restframe study`: its figures against renders made here, and what must hold in every report.
use crate::common::desk::{Desk, Outcome};
use restframe::frame::Frame;
use restframe::image::compare::relative_rmse;
use restframe::render::Prepared;
use restframe::render::{Options, render};
use restframe::scene::Scene;
use restframe::shot::{Accuracy, Spectra};
use restframe::study::results::{Point, Sweep};
use restframe::study::{Request, Study, study};
use restframe::trace::build_aggregate;
use std::path::{Path, PathBuf};

const OPTIONS: Options = Options {
    width: 32,
    height: 18,
    samples: 1,
    layers: Vec::new(),
};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("study")
        .join(name);
    std::fs::create_dir_all(&folder).expect("the target folder can be written to");
    folder
}

/// A moving red ball and a mirror, written to a file of its own.
fn shot(name: &str, velocity: &str, accuracy: &str) -> PathBuf {
    let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
    let text = format!(
        r#"
[image]
size = [320, 180]
[worldline.ball]
velocity = {velocity}
[[model]]
name = "ball"
file = {sphere:?}
worldline = "ball"
material = "red"
[[model]]
name = "mirror"
file = {sphere:?}
translate = [1.6, 0, -1]
material = "mirror"
[material.red]
diffuse = {{ weight = 0.9, spectrum = {{ gaussian = {{ center = 650, width = 25 }} }} }}
[material.mirror]
mirror = {{ weight = 0.9, spectrum = 1.0 }}
[[light]]
kind = "sun"
direction = [-1, -1, -2]
intensity = 1000
[background]
spectrum = 0.001
[camera]
position = [0, 0, 4]
hfov = 60
[accuracy]
{accuracy}
"#
    );
    let path = folder(name).join(format!("{name}.toml"));
    std::fs::write(&path, text).expect("the target folder can be written to");
    path
}

fn studied(path: &Path) -> (Prepared, Study) {
    let prepared = Prepared::read(path).expect("the shot has no mistake");
    let request = Request {
        frame: 1,
        options: OPTIONS,
        repeats: 2,
        scratch: path.parent().expect("it has a folder").to_owned(),
    };
    let found = study(&prepared, &request, &|_| ()).expect("it can be studied");
    (prepared, found)
}

fn sweep<'a>(study: &'a Study, knob: &str) -> &'a Sweep {
    let found = study.sweeps.iter().find(|sweep| sweep.knob == knob);
    found.unwrap_or_else(|| panic!("no sweep of {knob}"))
}

fn point<'a>(sweep: &'a Sweep, setting: &str) -> &'a Point {
    let found = sweep.points.iter().find(|point| point.setting == setting);
    found.unwrap_or_else(|| panic!("no {setting:?} among {:?}", settings(sweep)))
}

fn settings(sweep: &Sweep) -> Vec<&str> {
    sweep.points.iter().map(|p| p.setting.as_str()).collect()
}

fn film(prepared: &Prepared, accuracy: Accuracy) -> Vec<[f32; 3]> {
    let mut shot = prepared.shot.clone();
    shot.accuracy = accuracy;
    let scene = Scene::resolve(&Frame::new(&shot, 1).unwrap(), &prepared.library, None)
        .expect("it resolves");
    let aggregate = build_aggregate(&scene.geometry, None);
    let film = render(
        &Frame::new(&shot, 1).unwrap(),
        &scene,
        &aggregate,
        &OPTIONS,
        &|_| (),
    );
    film.xyz
}

#[test]
fn errors_are_those_of_renders_made_apart_from_the_study() {
    let (prepared, study) = studied(&shot("apart", "[0.3, 0, 0]", ""));
    let own = prepared.shot.accuracy;
    let exact = film(
        &prepared,
        Accuracy {
            spectra: Spectra::Exact,
            ..own
        },
    );
    let sweep = sweep(&study, "accuracy.spectra");
    for (setting, accuracy) in [
        (
            "grid, 11 wavelengths",
            Accuracy {
                wavelengths: 11,
                ..own
            },
        ),
        ("grid, 84 wavelengths", own),
        (
            "lines, 5 nm",
            Accuracy {
                spectra: Spectra::Lines,
                line_spacing: 5.0,
                ..own
            },
        ),
    ] {
        let expected = relative_rmse(&film(&prepared, accuracy), &exact).expect("equal sizes");
        let found = point(sweep, setting)
            .errors
            .expect("it is compared")
            .radiance;
        assert_eq!(found, expected, "{setting}");
    }
}

#[test]
fn every_sweep_has_the_shot_s_own_setting_once_and_says_what_it_is_compared_with() {
    let (_, study) = studied(&shot("own", "[0.3, 0, 0]", "wavelengths = 50"));
    assert_eq!(study.sweeps.len(), 6);
    for sweep in &study.sweeps {
        let own = sweep.points.iter().filter(|point| point.current).count();
        assert_eq!(own, 1, "{}: {:?}", sweep.knob, settings(sweep));
        assert!(!sweep.reference.is_empty() && !sweep.what.is_empty());
        for point in &sweep.points {
            assert!(point.frame.median > 0.0 && point.frame.least <= point.frame.median);
            assert!(point.frame.median <= point.frame.greatest);
            let errors = point.errors.unwrap_or_default();
            assert!(errors.radiance >= 0.0 && errors.radiance.is_finite());
        }
    }
}

#[test]
fn finer_settings_err_less() {
    let (_, study) = studied(&shot("finer", "[0.3, 0, 0]", ""));
    let light = |knob: &str, setting: &str| {
        let errors = point(sweep(&study, knob), setting).errors;
        errors.expect("it is compared").radiance
    };
    let spectra = |setting| light("accuracy.spectra", setting);
    assert!(spectra("grid, 84 wavelengths") < 1e-3);
    // So few that every curve is narrow for them, and integrated.
    assert!(spectra("grid, 11 wavelengths") < 1e-3);
    assert!(spectra("lines, 1 nm") < spectra("lines, 10 nm"));
    assert!(spectra("rgb, no shift") > 0.1, "a shift of 0.3 c is seen");
    let samples = |setting| light("image.samples", setting);
    assert!(samples("64 samples, box") < samples("1 samples, box"));
    let bounces = |setting| light("effects.bounces", setting);
    assert!(bounces("0 bounces") > 0.0);
    assert_eq!(
        bounces("4 bounces"),
        0.0,
        "one convex mirror has one bounce"
    );
    let files = |setting| light("output.formats", setting);
    assert_eq!(files("exr, float"), 0.0);
    assert!(files("exr, half") > 0.0 && files("exr, half") < 1e-3);
    assert!(files("png, 8 bits") > files("exr, half"));
}

#[test]
fn displacement_falls_with_tessellation() {
    let (_, study) = studied(&shot("displaced", "[0.3, 0, 0]", ""));
    let worst = |knob: &str, setting: &str| {
        let errors = point(sweep(&study, knob), setting).errors;
        let moved = errors.expect("it is compared").displacement;
        moved.expect("geometry is swept").worst
    };
    let triangles = |n: u32| worst("tessellation", &format!("{n} triangles a sphere"));
    assert!(
        triangles(80) > 3.0 * triangles(320),
        "falls about four-fold"
    );
    assert!(triangles(320) > 3.0 * triangles(1280));
}

#[test]
fn what_an_image_does_not_call_for_is_told_and_a_static_one_has_rgb() {
    let (_, study) = studied(&shot("static", "[0, 0, 0]", ""));
    let called = |effect: &str| {
        let found = study.effects.iter().find(|cost| cost.effect == effect);
        found.expect("every effect is listed").called
    };
    for effect in ["geometry", "doppler", "beaming", "thermal"] {
        assert!(!called(effect), "{effect}");
    }
    assert!(called("shadows") && called("mirror") && called("second worldline"));
    let rgb = point(sweep(&study, "accuracy.spectra"), "rgb");
    assert_eq!(rgb.toml.as_deref(), Some("spectra = \"rgb\""));
    assert!(study.paper.iter().all(|row| row.ours.is_none()));
    let share: f64 = study.phases.iter().map(|phase| phase.share).sum();
    assert!((share - 1.0).abs() < 1e-12);
}

#[test]
fn the_command_writes_three_files_and_leaves_nothing_else() {
    let path = shot("command", "[0.3, 0, 0]", "");
    let out = folder("command-out");
    let desk = Desk::new();
    let mut command = desk.command("study --scale 0.05 --samples 1 --repeats 1 --json");
    let done = Outcome::of_call(command.arg(&path).arg("--out").arg(&out));
    assert_eq!(done.status, 0, "{}", done.stderr);
    let printed: serde_json::Value = serde_json::from_str(&done.stdout).expect("JSON alone");
    assert_eq!(printed["size"], serde_json::json!([16, 9]));
    let mut names: Vec<String> = std::fs::read_dir(out.join("command"))
        .expect("the folder is there")
        .map(|entry| {
            entry
                .expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    assert_eq!(names, ["study.csv", "study.html", "study.json"]);
}

#[test]
fn a_frame_that_the_shot_has_not_is_refused() {
    let path = shot("refused", "[0, 0, 0]", "");
    let desk = Desk::new();
    let refused = Outcome::of_call(desk.command("study --frame 2").arg(&path));
    assert_eq!(refused.status, 2);
    let said = refused.stderr;
    assert!(said.contains("the shot has frames 1 to 1, not 2"), "{said}");
}
