//! The page about a shot's frames, `index.html` beside them: what the morning finds.
//!
//! One file that asks for nothing else: small pictures of all frames stand in it as JPEG, drawings as
//! SVG, and its script only moves what is there. It links to what lies beside it, and shows the
//! full picture of a frame where that can be read. Without scripts it is a page of thumbnails and a
//! table. Equal folders and equal runs give equal bytes: the times on it are the manifests'.

mod chart;
mod grid;
mod head;
mod player;
mod run;
mod table;
mod thumbnail;
mod view;

pub use run::{Outcome, RunFacts};

use crate::queue::{Reel, write_atomically};
use maud::{DOCTYPE, html};
use std::io;
use std::path::PathBuf;
use view::View;

/// The page's file name.
pub const PAGE: &str = "index.html";

/// Writes the page of a reel whose records have been read since the last frame was finished, and
/// returns where it is.
///
/// # Errors
/// When it cannot be written. What is wrong with frames stands on the page.
pub fn write(reel: &Reel, run: &RunFacts) -> io::Result<PathBuf> {
    let path = reel.folder.join(PAGE);
    write_atomically(&path, text(reel, run).as_bytes())?;
    Ok(path)
}

/// The whole HTML file.
fn text(reel: &Reel, run: &RunFacts) -> String {
    let views = View::all(reel, run);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head::head(reel))
            body {
                main {
                    (head::opening(reel, run, &views))
                    (player::section(reel, &views))
                    (grid::section(&views))
                    (chart::section(&views))
                    (table::section(&views))
                }
                (player::script())
            }
        }
    };
    page.into_string()
}
