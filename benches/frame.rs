//! Whole frames in which every ray hits, by what they call for. Read them as ratios of one run:
//! moving over rest is the price of boosts, Doppler over none that of spectra.

mod shell;

use divan::Bencher;
use restframe::frame::Frame;
use restframe::render::{Options, render};
use shell::shell;

fn main() {
    divan::main();
}

fn frame(bencher: Bencher<'_, '_>, beta: f64, lamp: &str, effects: &str, accuracy: &str) {
    let (prepared, scene, aggregate) = shell(beta, lamp, effects, accuracy);
    let options = Options {
        width: 320,
        height: 180,
        samples: 16,
        layers: Vec::new(),
    };
    let one_thread = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread can be had");
    bencher.bench_local(|| {
        one_thread.install(|| {
            render(
                &Frame::new(&prepared.shot, 1).expect("it moves"),
                &scene,
                &aggregate,
                &options,
                &|_| (),
            )
        })
    });
}

#[divan::bench(sample_count = 15)]
fn at_rest(bencher: Bencher<'_, '_>) {
    frame(bencher, 0.0, "shell", "", "");
}

#[divan::bench(sample_count = 15)]
fn moving(bencher: Bencher<'_, '_>) {
    frame(bencher, 0.5, "shell", "", "");
}

#[divan::bench(sample_count = 15)]
fn moving_doppler_off(bencher: Bencher<'_, '_>) {
    frame(
        bencher,
        0.5,
        "shell",
        "doppler = \"off\"\nbeaming = \"off\"",
        "",
    );
}

#[divan::bench(sample_count = 15)]
fn lamp_in_another_frame(bencher: Bencher<'_, '_>) {
    frame(bencher, 0.5, "lab", "", "");
}

#[divan::bench(sample_count = 15)]
fn lamp_in_another_frame_doppler_off(bencher: Bencher<'_, '_>) {
    frame(
        bencher,
        0.5,
        "lab",
        "doppler = \"off\"\nbeaming = \"off\"",
        "",
    );
}

#[divan::bench(sample_count = 5)]
fn lamp_in_another_frame_spline(bencher: Bencher<'_, '_>) {
    frame(bencher, 0.5, "lab", "", "spectra = \"spline\"");
}
