//! The report as a page and as JSON.

use super::{advice, costs, finite, head, sweep};
use crate::study::results::Study;
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
