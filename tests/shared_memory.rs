//! Memory of images that share a trace: beside the films and the shaders' tables it does not grow
//! with their number. The test reads the greatest memory of its process and so runs in one of its own:
//! this binary once more.

use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::render::{Member, Options, View, Watch, film_bytes, render_together};
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

/// Balls before each other's mirrors, so that trees are large.
const SHOT: &str = r#"
[worldline.fast]
velocity = [0.5, 0, 0]
[[model]]
file = "SPHERE"
worldline = "fast"
array = { count = [5, 3, 2], step = [2.2, 2.2, 3], centered = true }
material = "chrome"
[material.chrome]
diffuse = { weight = 0.3, spectrum = { gaussian = { center = 600, width = 30 } } }
mirror = { weight = 0.6, spectrum = 1.0 }
[[light]]
kind = "point"
position = [3, 5, 6]
intensity = 2000
[background]
spectrum = 1e-3
[camera]
position = [0, 0, 9]
[sensor]
exposure = 0
"#;

fn prepared(text: &str) -> Prepared {
    let sphere = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sphere.obj");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shot.toml");
    std::fs::write(&path, text.replace("SPHERE", sphere.to_str().unwrap())).unwrap();
    Prepared::read(&path).unwrap()
}

/// Greatest memory of rendering so many images at once, bytes (proc(5): `clear_refs`, `VmHWM`).
fn peak(count: usize, prepared: &Prepared, options: &Options) -> u64 {
    let values = Frame::new(&prepared.shot, 1).unwrap();
    let scene = Scene::resolve(&values, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let frame = &values;
    let scene = &scene;
    let member = Member { frame, scene };
    let stop = &AtomicBool::new(false);
    let watch = Watch {
        done: &|_| (),
        stop,
    };
    std::fs::write("/proc/self/clear_refs", "5").unwrap();
    let rendered = render_together(&vec![member; count], &aggregate, options, watch).unwrap();
    assert_eq!(rendered.films.len(), count);
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))
        .unwrap();
    line.split_whitespace()
        .next()
        .unwrap()
        .parse::<u64>()
        .unwrap()
        << 10
}

/// Bytes of the shader of an image.
fn shader(prepared: &Prepared) -> u64 {
    let scene = Scene::resolve(
        &Frame::new(&prepared.shot, 1).unwrap(),
        &prepared.library,
        None,
    )
    .unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let shot = &prepared.shot;
    let view = View::new(
        &Frame::new(shot, 1).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    view.shader().bytes() as u64
}

/// Set where the process is the test's own.
const ALONE: &str = "RESTFRAME_TEST_ALONE";

#[test]
fn memory_grows_by_films_and_no_more_tables_than_are_allowed() {
    if std::env::var_os(ALONE).is_none() {
        let name = "shared_memory::memory_grows_by_films_and_no_more_tables_than_are_allowed";
        let alone = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", name, "--nocapture"])
            .env(ALONE, "1")
            // What one thread frees another can take: a shader more or less was chance.
            .env("MALLOC_ARENA_MAX", "1")
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        let (said, failed) = (text(alone.stdout), text(alone.stderr));
        println!("{said}");
        assert!(said.contains("1 passed"), "{said}{failed}");
        return;
    }
    /// What the allocator keeps, and a member's few words.
    const SLACK: u64 = 8 << 20;
    let options = Options {
        width: 160,
        height: 90,
        samples: 4,
        layers: Vec::new(),
    };
    let few = prepared(SHOT);
    // Once before, so that what is made once a process is there.
    peak(1, &few, &options);
    let peaks = [8, 64].map(|count| peak(count, &few, &options));
    let allowed = 56 * (film_bytes(&options) + shader(&few));
    println!("{peaks:?}, {allowed} allowed");
    assert!(
        peaks[1] < peaks[0] + allowed + SLACK,
        "{peaks:?}, {allowed}"
    );

    // Where shaders are large fewer of them are held, at most 256 MiB at once.
    let surface = |i: u32| {
        let center = 400 + 5 * i;
        let paint = format!("{{ gaussian = {{ center = {center}, width = 30 }} }}");
        format!(
            "[material.m{i}]\ndiffuse = {{ weight = 0.5, spectrum = {paint} }}\n\
             [[model]]\nfile = \"SPHERE\"\nname = \"n{i}\"\ntranslate = [{i}, 5, 0]\nmaterial = \"m{i}\"\n\
             [[light]]\nkind = \"point\"\nposition = [{i}, 9, 9]\nintensity = 100\nspectrum = {paint}\n"
        )
    };
    // Few wavelengths, for tables that are quick to make for their size.
    let accuracy = "[accuracy]\nwavelengths = 16\n";
    let many = prepared(&(SHOT.to_owned() + accuracy + &(0..30).map(surface).collect::<String>()));
    let shader = shader(&many);
    let before = peak(1, &many, &options);
    let count = (256 << 20) / shader as usize * 5 / 2;
    let together = peak(count, &many, &options);
    let films = count as u64 * film_bytes(&options);
    println!("{shader} a shader, {count} images: {before}, {together}");
    assert!(
        together < before + films + (256 << 20) + 4 * SLACK,
        "{before}, {together}"
    );
    assert!(count as u64 * shader > 512 << 20, "too few to tell");
}
