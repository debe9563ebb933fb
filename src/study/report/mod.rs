//! The report of a study as three texts: a page for people ([`html`]), a table for spreadsheets
//! ([`csv()`]) and everything for programs ([`json`]).
//!
//! The page is one file without scripts and without references to other files; its charts are
//! drawings within it, and it is well-formed XML as well as HTML. The table has one row for each
//! point of each sweep; effects, phases and the paper's results are in the page and the JSON only.
//! Equal studies give equal bytes.

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

use super::results::Study;
use maud::{DOCTYPE, html as markup};

/// The page as a whole HTML file.
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

/// All results as JSON, with the names of [`Study`]'s fields. Numbers that are not finite are
/// written as the greatest f64, since JSON has no word for them; `null` means only that there is no
/// value.
pub fn json(study: &Study) -> String {
    let study = finite::finite(study);
    let mut text =
        serde_json::to_string_pretty(&study).expect("a study has no maps, and nothing to fail");
    text.push('\n');
    text
}
