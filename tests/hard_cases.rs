//! The hard cases: everything that must stay numerically stable, each with an exact result or an
//! invariant, under the row's number (A1, B4, …). A row's name is `a1_…`, and what it checks is a
//! line of the report card in docs/hard-cases.md, which `scripts/hard-cases` prints.

#[macro_use]
pub(crate) mod card;

mod boosts;
mod displacement;
mod doppler;
pub(crate) mod eye;
mod file_lamps;
mod files;
mod geometry;
mod invariance;
mod lamps;
mod light;
mod mirrors;
mod moving_lamps;
mod narrow;
pub(crate) mod numbers;
mod panoramas;
mod pictures;
mod pipeline;
mod poincare;
pub(crate) mod scene;
mod swept;
mod visibility;
pub(crate) mod wall;
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
