//! A knob on the page: its charts, its settings, and the price of a smaller error.

use super::chart::charts;
use super::head::time_ratio;
use super::measure::percent;
use super::settings;
use crate::study::results::{Halving, Study, Sweep};
use maud::{Markup, PreEscaped, html};

/// The section of a sweep, number `place` of the page, counted from 1.
pub(super) fn section(study: &Study, sweep: &Sweep, place: usize) -> Markup {
    let id = format!("sweep-{place}");
    html! {
        section id=(id) {
            h2 { code { (sweep.knob) } }
            p {
                (sentence(&sweep.what)) " It touches the phase “" (sweep.phase) "”."
                @if !sweep.points.is_empty() {
                    " Errors are measured against " (sweep.reference) "."
                }
            }
            @if let Some(note) = &sweep.note { p.note { (sentence(note)) } }
            @if !sweep.points.is_empty() {
                @for chart in charts(sweep, &id) {
                    figure {
                        (PreEscaped(chart.svg))
                        @if !chart.notes.is_empty() { figcaption { (chart.notes.join(" ")) } }
                    }
                }
                (settings::table(study, sweep))
            }
            @if !sweep.halving.is_empty() { (prices(study, &sweep.halving)) }
        }
    }
}

/// The words as a sentence, with capital letter and full stop.
fn sentence(words: &str) -> String {
    let words = words.trim();
    let mut rest = words.chars();
    let capital: String = rest
        .next()
        .into_iter()
        .flat_map(char::to_uppercase)
        .collect();
    let stop = if words.ends_with(['.', '!', '?']) || words.is_empty() {
        ""
    } else {
        "."
    };
    format!("{capital}{}{stop}", rest.as_str())
}

/// The table of prices for halving the error, between neighbors of a family.
fn prices(study: &Study, halving: &[Halving]) -> Markup {
    html! {
        h3 { "To halve the error, pay this" }
        div.scroll { table.prices {
            thead { tr {
                th { "Family" } th { "From" } th { "To" } th.n { "Error falls to" }
                th.n { "Time of the image" } th.n { "Time for every halving" }
            } }
            tbody { @for step in halving { tr {
                td { (step.family) }
                td { (step.from) }
                td { (step.to) }
                td.n { (percent(1.0 / step.error_ratio)) }
                td.n { (time_ratio(study, step.time_ratio)) }
                @match step.per_halving {
                    Some(ratio) => td.n { (time_ratio(study, ratio)) },
                    None => td.n { "the error does not fall" },
                }
            } } }
        } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_begin_with_a_capital_and_have_one_full_stop() {
        for (words, whole) in [
            ("how curves are held", "How curves are held."),
            ("Nothing to sweep.", "Nothing to sweep."),
            ("", ""),
        ] {
            assert_eq!(sentence(words), whole);
        }
    }
}
