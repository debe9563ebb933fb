//! The report of a study as three texts: a page for people ([`html`]), a table for spreadsheets
//! ([`csv()`]) and everything for programs ([`json`]).
//!
//! The page is one file without scripts that asks for nothing else, its charts are drawings within
//! it, and it is well-formed XML as well as HTML. The table has one row for each point of each
//! sweep; effects, phases and the paper's findings are in the page and the JSON only. Equal studies
//! give equal bytes.

mod advice;
mod chart;
mod costs;
mod finite;
mod head;
mod measure;
mod quantity;
mod settings;
mod spreadsheet;
mod sweep;

pub use spreadsheet::csv;

use super::findings::Study;
use maud::{DOCTYPE, html as markup};

/// The page, a whole HTML file.
pub fn html(study: &Study) -> String {
    let page = markup! {
        (DOCTYPE)
        html lang="en" {
            (head::head(study))
            body {
                main {
                    (head::opening(study))
                    (advice::section(study))
                    (costs::phases(study))
                    @for (i, sweep) in study.sweeps.iter().enumerate() {
                        (sweep::section(study, sweep, i + 1))
                    }
                    (costs::effects(study))
                    (costs::paper(study))
                    (head::legend())
                }
            }
        }
    };
    page.into_string()
}

/// Everything, with the names of [`Study`]'s fields. What is no number there, or beyond all
/// numbers, is the greatest that f64 holds, since JSON has no word for it; `null` stands only for
/// what does not exist.
pub fn json(study: &Study) -> String {
    let study = finite::finite(study);
    let mut text =
        serde_json::to_string_pretty(&study).expect("a study has no maps, and nothing to fail");
    text.push('\n');
    text
}
