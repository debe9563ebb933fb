//! Recommendations: the cheapest settings with colors within a limit, ready to be pasted.

use super::head::time_ratio;
use super::measure::number;
use crate::study::results::{Recommendation, Study};
use maud::{Markup, html};

/// The section; empty if nothing was swept.
pub(super) fn section(study: &Study) -> Markup {
    html! {
        section #advice {
            h2 { "What to use" }
            @if study.recommendations.is_empty() {
                p { "Nothing in this shot leaves a choice." }
            } @else {
                p {
                    "For each knob, the cheapest setting whose ΔE2000 stays below a limit in 99 % "
                    "of the pixels. Each knob was measured alone, with the others at the values "
                    "of the shot. Times are relative to the shot as it is."
                }
                div.scroll { table {
                    thead { tr {
                        th { "Knob" } th.n { "ΔE2000 below" } th { "Setting" }
                        th.n { "Time" } th { "To paste into the shot" }
                    } }
                    tbody { @for advice in &study.recommendations { (row(study, advice)) } }
                } }
            }
        }
    }
}

fn row(study: &Study, advice: &Recommendation) -> Markup {
    let first = study.recommendations.iter().find(|r| r.knob == advice.knob);
    let opens = first.is_some_and(|first| std::ptr::eq(first, advice));
    html! {
        tr.opens[opens] {
            td { @if opens { code { (advice.knob) } } }
            td.n { (number(advice.delta_e)) }
            @match &advice.setting {
                None => td colspan="3" { "none of those measured" },
                Some(setting) => {
                    td {
                        (setting)
                        @if is_current(study, advice, setting) { " " em { "– as the shot is" } }
                    }
                    td.n { @if let Some(ratio) = advice.time_ratio { (time_ratio(study, ratio)) } }
                    td { @if let Some(toml) = &advice.toml { pre { (pasted(&advice.knob, toml)) } } }
                }
            }
        }
    }
}

fn is_current(study: &Study, advice: &Recommendation, setting: &str) -> bool {
    let sweeps = study
        .sweeps
        .iter()
        .filter(|sweep| sweep.knob == advice.knob);
    let mut points = sweeps.flat_map(|sweep| &sweep.points);
    points.any(|point| point.current && point.setting == setting)
}

/// Lines of TOML below the header of their table, which is the part of a knob such as
/// "accuracy.spectra" before its last dot.
fn pasted(knob: &str, toml: &str) -> String {
    match knob.rsplit_once('.') {
        Some((table, _)) if !toml.starts_with('[') => format!("[{table}]\n{toml}"),
        _ => toml.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_pasted_has_its_table_once() {
        for (knob, toml, whole) in [
            ("accuracy.spectra", "spectra = 1", "[accuracy]\nspectra = 1"),
            (
                "accuracy.cutoff",
                "[accuracy]\ncutoff = 0",
                "[accuracy]\ncutoff = 0",
            ),
            ("later", "later = 1", "later = 1"),
        ] {
            assert_eq!(pasted(knob, toml), whole);
        }
    }
}
