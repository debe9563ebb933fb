//! Shading of one ray by how its spectra are held, over the number of wavelengths or the distance
//! of lines.

mod shell;

use divan::{Bencher, black_box};
use restframe::accel::Hit;
use restframe::frame::{Frame, Sensor};
use restframe::shade::{Settings, ShadeScratch, Shader};
use restframe::trace::{DirectLight, Node, Root, Seen, ShadeTrees, Surface};
use shell::shell;

fn main() {
    divan::main();
}

const WAVELENGTHS: [u32; 5] = [21, 42, 84, 168, 336];
const SPLINE_WAVELENGTHS: [u32; 8] = [8, 11, 16, 31, 61, 81, 84, 121];
/// Calls between two looks at the clock, of shadings that take no longer than such a look.
const CALLS: u32 = 256;
/// Distances of lines, nm.
const SPACINGS: [f64; 4] = [10.0, 5.0, 2.5, 1.0];

/// By curves over as many wavelengths.
fn curves(bencher: Bencher<'_, '_>, spectra: &str, wavelengths: u32, lamp_doppler: f64) {
    let accuracy = format!("spectra = \"{spectra}\"\nwavelengths = {wavelengths}");
    shade(bencher, "", &accuracy, lamp_doppler);
}

/// By lines at such distances.
fn lines(bencher: Bencher<'_, '_>, spacing_nm: f64, lamp_doppler: f64) {
    let accuracy = format!("spectra = \"lines\"\nline_spacing = {spacing_nm}");
    shade(bencher, "", &accuracy, lamp_doppler);
}

/// XYZ of one lit surface at D = 1.2, the lamp at `lamp_doppler` to it.
fn shade(bencher: Bencher<'_, '_>, effects: &str, accuracy: &str, lamp_doppler: f64) {
    let (prepared, scene, _) = shell(0.5, "shell", effects, accuracy);
    let effects = Frame::new(&prepared.shot, 1)
        .expect("it moves")
        .active_effects(&prepared.shot.effects);
    let settings = Settings {
        effects: &effects,
        accuracy: &prepared.shot.accuracy,
        sensor: &Sensor::new(&prepared.shot.sensor),
        reach: 1.0,
        lamp_reach: 1.0,
    };
    let shader = Shader::new(&scene, &settings);
    let hit = Hit {
        t: 1.0,
        instance: 0,
        triangle: 0,
        weights: [1.0, 0.0, 0.0],
        front: true,
    };
    let node = Node {
        branch: None,
        doppler: 1.2,
        seen: Seen::Surface(Surface {
            material: 0,
            s: 1.0,
            time: 0.0,
            hit,
            lamps: 1,
            first_lamp: 0,
        }),
    };
    let root = Root {
        first: 0,
        count: 1,
        cut: 0.0,
    };
    let lit = DirectLight {
        light: 0,
        first_weight: 0,
        doppler: lamp_doppler,
    };
    let trees = ShadeTrees {
        roots: vec![root],
        nodes: vec![node],
        direct: vec![lit],
        weights: vec![0.1, 0.01],
    };
    let mut scratch = ShadeScratch::default();
    bencher.bench_local(|| shader.xyz(black_box(&trees), root, &mut scratch));
}

#[divan::bench(args = WAVELENGTHS, sample_size = CALLS)]
fn grid_lamp_moves_along(bencher: Bencher<'_, '_>, wavelengths: u32) {
    curves(bencher, "grid", wavelengths, 1.0);
}

#[divan::bench(args = WAVELENGTHS, sample_size = CALLS)]
fn grid_two_shifts(bencher: Bencher<'_, '_>, wavelengths: u32) {
    curves(bencher, "grid", wavelengths, 0.9);
}

#[divan::bench(args = SPLINE_WAVELENGTHS)]
fn spline_lamp_moves_along(bencher: Bencher<'_, '_>, wavelengths: u32) {
    curves(bencher, "spline", wavelengths, 1.0);
}

#[divan::bench(args = SPLINE_WAVELENGTHS)]
fn spline_two_shifts(bencher: Bencher<'_, '_>, wavelengths: u32) {
    curves(bencher, "spline", wavelengths, 0.9);
}

#[divan::bench(args = SPACINGS)]
fn lines_lamp_moves_along(bencher: Bencher<'_, '_>, spacing_nm: f64) {
    lines(bencher, spacing_nm, 1.0);
}

#[divan::bench(args = SPACINGS)]
fn lines_two_shifts(bencher: Bencher<'_, '_>, spacing_nm: f64) {
    lines(bencher, spacing_nm, 0.9);
}

#[divan::bench(sample_size = CALLS)]
fn rgb_without_shift(bencher: Bencher<'_, '_>) {
    shade(bencher, "doppler = \"off\"", "spectra = \"rgb\"", 0.9);
}
