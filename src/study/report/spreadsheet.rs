//! The points of a study as CSV (RFC 4180, with a header): one row for each setting of each sweep.
//!
//! Times are in seconds, memory in MiB, displacements in pixels; errors and bounds are relative.
//! Flags are "true" or "false"; an empty field means that there is no value. Effects and phases are
//! in the JSON only.

use super::page::finite;
use crate::study::results::{Percentiles, Point, Study, Sweep};

/// The header, in the order of [`fields`].
const HEADER: [&str; 24] = [
    "knob",
    "setting",
    "family",
    "toml",
    "current",
    "pareto",
    "frame_median_s",
    "frame_least_s",
    "frame_greatest_s",
    "phase",
    "phase_median_s",
    "phase_least_s",
    "phase_greatest_s",
    "memory_mib",
    "file_bytes",
    "error_radiance",
    "delta_e_mean",
    "delta_e_p99",
    "delta_e_worst",
    "displacement_p99_px",
    "displacement_worst_px",
    "mistaken",
    "bound",
    "reference",
];

/// The table. Numbers can be read back to the last bit; one that is not finite is written as the
/// greatest f64.
pub fn csv(study: &Study) -> String {
    let study = finite(study);
    let mut writer = csv::Writer::from_writer(Vec::new());
    let sweeps = study.sweeps.iter();
    let points = sweeps.flat_map(|sweep| sweep.points.iter().map(move |p| fields(sweep, p)));
    for row in std::iter::once(HEADER.map(str::to_owned)).chain(points) {
        writer
            .write_record(&row)
            .expect("rows of one length, in memory");
    }
    let bytes = writer.into_inner().expect("memory takes what is left");
    String::from_utf8(bytes).expect("made of strings")
}

fn fields(sweep: &Sweep, point: &Point) -> [String; HEADER.len()] {
    let errors = point.errors;
    let delta_e = |part: fn(Percentiles) -> f64| optional(errors.and_then(|e| e.delta_e).map(part));
    let displacement =
        |part: fn(Percentiles) -> f64| optional(errors.and_then(|e| e.displacement).map(part));
    [
        sweep.knob.clone(),
        point.setting.clone(),
        point.family.clone(),
        point.toml.clone().unwrap_or_default(),
        point.current.to_string(),
        point.pareto.to_string(),
        point.frame.median.to_string(),
        point.frame.least.to_string(),
        point.frame.greatest.to_string(),
        sweep.phase.to_owned(),
        point.phase.median.to_string(),
        point.phase.least.to_string(),
        point.phase.greatest.to_string(),
        optional(point.memory_mib),
        optional(point.file_bytes),
        optional(errors.map(|e| e.radiance)),
        delta_e(|p| p.mean),
        delta_e(|p| p.p99),
        delta_e(|p| p.worst),
        displacement(|p| p.p99),
        displacement(|p| p.worst),
        optional(errors.and_then(|e| e.mistaken)),
        optional(errors.and_then(|e| e.bound)),
        sweep.reference.clone(),
    ]
}

fn optional(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}
