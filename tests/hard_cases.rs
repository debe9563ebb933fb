//! The hard cases: everything that must stay numerically stable, each with an exact result or an
//! invariant, under the row's number (A1, B4, …). A row's name is `a1_…`, and what it checks is a
//! line of the report card in docs/hard-cases.md, which `scripts/hard-cases` prints.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a case that cannot be set up has failed"
)]

#[macro_use]
#[path = "hard_cases/card.rs"]
mod card;

#[path = "hard_cases/boosts.rs"]
mod boosts;
#[path = "hard_cases/displacement.rs"]
mod displacement;
#[path = "hard_cases/doppler.rs"]
mod doppler;
#[path = "hard_cases/eye.rs"]
mod eye;
#[path = "hard_cases/file_lamps.rs"]
mod file_lamps;
#[path = "hard_cases/files.rs"]
mod files;
#[path = "hard_cases/geometry.rs"]
mod geometry;
#[path = "hard_cases/invariance.rs"]
mod invariance;
#[path = "hard_cases/lamps.rs"]
mod lamps;
#[path = "hard_cases/light.rs"]
mod light;
#[path = "hard_cases/mirrors.rs"]
mod mirrors;
#[path = "hard_cases/moving_lamps.rs"]
mod moving_lamps;
#[path = "hard_cases/narrow.rs"]
mod narrow;
#[path = "hard_cases/numbers.rs"]
mod numbers;
#[path = "hard_cases/panoramas.rs"]
mod panoramas;
#[path = "hard_cases/pictures.rs"]
mod pictures;
#[path = "hard_cases/pipeline.rs"]
mod pipeline;
#[path = "hard_cases/poincare.rs"]
mod poincare;
#[path = "hard_cases/scene.rs"]
mod scene;
#[path = "hard_cases/swept.rs"]
mod swept;
#[path = "hard_cases/visibility.rs"]
mod visibility;
#[path = "hard_cases/wall.rs"]
mod wall;
#[path = "hard_cases/windows.rs"]
mod windows;

/// Every case, in the order of the card.
fn sections() -> Vec<(&'static str, &'static [card::Case])> {
    vec![
        ("A. Boosts", boosts::CASES),
        ("A. The whole scene moved", invariance::CASES),
        ("B. Doppler factor and aberration", doppler::CASES),
        ("C. Radiometry and spectra", light::CASES),
        ("C. Lines and narrow filters", narrow::CASES),
        ("C. Windows of the sensor", windows::CASES),
        ("B, D. The whole sky at once", panoramas::CASES),
        ("D. Geometry", geometry::CASES),
        ("D. Visibility", visibility::CASES),
        ("E. Moving lamps", moving_lamps::CASES),
        ("E. Shadows", lamps::CASES),
        ("E. Lamps of model files", file_lamps::CASES),
        ("E. Mirrors and glass", mirrors::CASES),
        ("G. The program as a whole", pipeline::CASES),
    ]
}

#[test]
fn the_report_card_is_current() {
    card::compare(&sections());
}
