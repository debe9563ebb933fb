//! Boosts and Doppler factors: one by one, and many at a time as a renderer needs them.

use divan::{Bencher, black_box, counter::ItemsCount};
use glam::DVec3;
use restframe::relativity::{Boost, Celerity, Transform, Worldline};
use restframe::trace::{Link, boost_directions};

fn main() {
    divan::main();
}

/// Speeds from slow to γ = 10⁶: cost should not depend on them.
const LORENTZ_FACTORS: [f64; 5] = [1.000_000_1, 1.1547, 10.0, 100.0, 1e6];

fn directions() -> Vec<DVec3> {
    (0..2048)
        .map(|i| {
            let (x, y) = (
                f64::from(i % 64) / 32.0 - 1.0,
                f64::from(i / 64) / 32.0 - 0.5,
            );
            DVec3::new(x, y, -1.0).normalize()
        })
        .collect()
}

fn celerity(lorentz_factor: f64) -> Celerity {
    Celerity::from_lorentz_factor(lorentz_factor, DVec3::new(1.0, 0.3, -0.2)).expect("above 1")
}

#[divan::bench(args = LORENTZ_FACTORS)]
fn doppler_and_aberration_of_any_vector(bencher: Bencher<'_, '_>, lorentz_factor: f64) {
    let boost = Boost::into_rest_of(celerity(lorentz_factor));
    let directions = directions();
    bencher
        .counter(ItemsCount::new(directions.len()))
        .bench(|| {
            directions
                .iter()
                .map(|&d| boost.light(black_box(d)).frequency_ratio)
                .sum::<f64>()
        });
}

#[divan::bench(args = LORENTZ_FACTORS)]
fn rays_many_at_a_time(bencher: Bencher<'_, '_>, lorentz_factor: f64) {
    let moving = Worldline {
        celerity: celerity(lorentz_factor),
        ..Worldline::LAB
    };
    let link = Link::Finite(Transform::between(&Worldline::LAB, &moving));
    let directions = directions();
    let (mut boosted, mut ratios) = (Vec::new(), Vec::new());
    bencher
        .counter(ItemsCount::new(directions.len()))
        .bench_local(|| {
            boost_directions(&link, black_box(&directions), &mut boosted, &mut ratios);
        });
}

#[divan::bench]
fn rays_of_a_camera_that_moves_along(bencher: Bencher<'_, '_>) {
    let link = Link::Finite(Transform::IDENTITY);
    let directions = directions();
    let (mut boosted, mut ratios) = (Vec::new(), Vec::new());
    bencher
        .counter(ItemsCount::new(directions.len()))
        .bench_local(|| {
            boost_directions(&link, black_box(&directions), &mut boosted, &mut ratios);
        });
}
