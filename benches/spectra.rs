//! Shading of one ray by how its spectra are held, over the number of wavelengths.

mod shell;

use divan::{Bencher, black_box};
use restframe::plan;
use restframe::shade::{Settings, ShadeScratch, Shader};
use restframe::trace::{BodyHit, Lit, Node, Root, Seen, ShadeTrees, Surface};
use shell::shell;

fn main() {
    divan::main();
}

const WAVELENGTHS: [u32; 5] = [21, 42, 84, 168, 336];

/// XYZ of one lit surface at D = 1.2, the lamp at `lamp_doppler` to it.
fn shade(bencher: Bencher<'_, '_>, spectra: &str, wavelengths: u32, lamp_doppler: f64) {
    let accuracy = format!("spectra = \"{spectra}\"\nwavelengths = {wavelengths}");
    let (prepared, scene, _) = shell(0.5, "shell", "", &accuracy);
    let called = plan::called(&prepared.shot, 1, &prepared.shot.effects).expect("it moves");
    let settings = Settings {
        called: &called,
        accuracy: &prepared.shot.accuracy,
        sensor: &prepared.shot.sensor,
        reach: 1.0,
        lamp_reach: 1.0,
    };
    let shader = Shader::new(&scene, &settings);
    let hit = BodyHit {
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
    let lit = Lit {
        light: 0,
        doppler: lamp_doppler,
        diffuse: 0.1,
        highlight: 0.01,
    };
    let trees = ShadeTrees {
        roots: vec![root],
        nodes: vec![node],
        lit: vec![lit],
    };
    let mut scratch = ShadeScratch::default();
    bencher.bench_local(|| shader.xyz(black_box(&trees), root, &mut scratch));
}

#[divan::bench(args = WAVELENGTHS)]
fn grid_lamp_moves_along(bencher: Bencher<'_, '_>, wavelengths: u32) {
    shade(bencher, "grid", wavelengths, 1.0);
}

#[divan::bench(args = WAVELENGTHS)]
fn grid_two_shifts(bencher: Bencher<'_, '_>, wavelengths: u32) {
    shade(bencher, "grid", wavelengths, 0.9);
}

#[divan::bench(args = WAVELENGTHS)]
fn spline_two_shifts(bencher: Bencher<'_, '_>, wavelengths: u32) {
    shade(bencher, "spline", wavelengths, 0.9);
}
