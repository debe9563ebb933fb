//! The algebra against tables computed elsewhere, at 60 digits.
//!
//! One test for each table. They are read from the folder that the environment variable
//! `RESTFRAME_REFERENCE` names, or else from `tests/reference`.

use std::path::PathBuf;

use glam::DVec3;
use restframe::relativity::{Boost, Celerity};
use restframe::spectrum::planck;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// The rows of a table.
#[expect(
    clippy::panic,
    reason = "a table that cannot be read fails the test, and says which"
)]
fn table<Row: DeserializeOwned>(name: &str) -> Vec<Row> {
    let default = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/reference");
    let folder = std::env::var_os("RESTFRAME_REFERENCE").map_or_else(default, PathBuf::from);
    let path = folder.join(name);
    let fail = |error: &dyn std::fmt::Display| -> ! { panic!("{}: {error}", path.display()) };
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| fail(&error));
    let rows: Vec<Row> = serde_json::from_str(&text).unwrap_or_else(|error| fail(&error));
    assert!(!rows.is_empty(), "{} has no rows", path.display());
    rows
}

/// Spectral radiance, W·m⁻²·sr⁻¹·nm⁻¹, within 4ε·max(x, 4): what [`planck::radiance`] promises.
#[test]
fn planck() {
    #[derive(Deserialize)]
    struct Row {
        nm: f64,
        #[serde(rename = "T")]
        temperature_k: f64,
        radiance: f64,
    }
    for Row {
        nm,
        temperature_k,
        radiance,
    } in table("planck.json")
    {
        let found = planck::radiance(nm, temperature_k);
        let x = planck::C2 / (nm * temperature_k);
        // A subnormal number has no ε: there the last place is the bound.
        let bound = 4.0 * f64::EPSILON * x.max(4.0) * radiance + 5e-324;
        assert!(
            (found - radiance).abs() <= bound,
            "at {nm} nm, {temperature_k} K: {found:e}, expected {radiance:e}, off by {:.1} ε·max(x, 4)",
            (found / radiance - 1.0).abs() / f64::EPSILON / x.max(4.0)
        );
    }
}

/// Relative, of Doppler factors and boosted directions, for |u| up to 1e12.
const BOOST_TOLERANCE: f64 = 4e-15;

/// Relative, of relative celerities: they take one division and one square root more.
const RELATIVE_TOLERANCE: f64 = 2e-14;

fn boost(u: [f64; 3]) -> Boost {
    Boost::into_rest_of(Celerity::new(u.into()).expect("a celerity"))
}

fn relative_error(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// D of light along d from a source of celerity u.
#[test]
fn doppler() {
    #[derive(Deserialize)]
    struct Row {
        u: [f64; 3],
        d: [f64; 3],
        kind: String,
        doppler: f64,
    }
    for Row {
        u,
        d,
        kind,
        doppler,
    } in table("doppler.json")
    {
        let found = 1.0 / boost(u).light(d.into()).frequency_ratio;
        assert!(
            relative_error(found, doppler) <= BOOST_TOLERANCE,
            "{kind}: u = {u:?}, d = {d:?}: {found:e}, expected {doppler:e}"
        );
    }
}

/// Direction and frequency ratio of light along d, seen from a frame of celerity u.
#[test]
fn boosted_light() {
    #[derive(Deserialize)]
    struct Row {
        u: [f64; 3],
        d: [f64; 3],
        kind: String,
        direction: [f64; 3],
        frequency: f64,
    }
    for Row {
        u,
        d,
        kind,
        direction,
        frequency,
    } in table("boost.json")
    {
        let found = boost(u).light(d.into());
        let off = (found.direction - DVec3::from(direction)).length();
        assert!(
            off <= BOOST_TOLERANCE
                && relative_error(found.frequency_ratio, frequency) <= BOOST_TOLERANCE,
            "{kind}: u = {u:?}, d = {d:?}: {found:?}, expected {direction:?}, {frequency:e}"
        );
    }
}

/// Celerity of v in the rest frame of u, and its Lorentz factor.
#[test]
fn relative() {
    #[derive(Deserialize)]
    struct Row {
        u: [f64; 3],
        v: [f64; 3],
        relative: [f64; 3],
        gamma: f64,
    }
    for Row {
        u,
        v,
        relative,
        gamma,
    } in table("relative.json")
    {
        let celerity = |u: [f64; 3]| Celerity::new(u.into()).expect("a celerity");
        let found = celerity(v).seen_from(celerity(u));
        let expected = DVec3::from(relative);
        let off = (found.vector() - expected).length();
        assert!(
            off <= RELATIVE_TOLERANCE * expected.length()
                && relative_error(found.lorentz_factor(), gamma) <= RELATIVE_TOLERANCE,
            "u = {u:?}, v = {v:?}: {found:?}, expected {expected:?}, {gamma:e}"
        );
    }
}
