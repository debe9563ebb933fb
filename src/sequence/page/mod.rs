//! The page about a shot's frames, `index.html` beside them: what the morning finds.
//!
//! It tells of what is there, and of what a run was to make: of long runs of frames that nobody made it
//! has a line, so that two frames of a million make a page of two.
//!
//! One file that asks for nothing else: small pictures of all frames stand in it as JPEG, drawings as
//! SVG, and its script only moves what is there. It links to what lies beside it, and shows the
//! full picture of a frame where that can be read. Without scripts it is a page of thumbnails and a
//! table. Equal folders and equal runs give equal bytes: the times on it are the manifests'.

mod chart;
mod grid;
mod head;
mod key;
mod player;
mod run;
mod table;
mod thumbnail;
mod view;

pub use run::{Outcome, RunFacts};

use super::ledger;
use crate::queue::{Reel, Stop, write_atomically};
use maud::{DOCTYPE, html};
use std::io;
use std::path::PathBuf;
use view::{Contents, find};

/// The page's file name.
pub const PAGE: &str = "index.html";

/// Writes the page of a reel whose records have been read since the last frame was finished, and
/// returns where it is; none if it was asked to stop before.
///
/// # Errors
/// When it cannot be written. What is wrong with frames stands on the page.
pub fn write(reel: &Reel, run: &RunFacts, stop: &Stop) -> io::Result<Option<PathBuf>> {
    let found = find(reel, run);
    let key = key::key(reel, run, &found);
    let Some(contents) = Contents::new(reel, run, found, stop) else {
        return Ok(None);
    };
    let path = reel.folder.join(PAGE);
    write_atomically(&path, text(reel, &contents).as_bytes())?;
    // A page that is not remembered is only written again.
    let _unremembered = ledger::remember(reel, PAGE, key);
    Ok(Some(path))
}

/// Whether the page is there and would tell no more if a run that did this wrote it again: which
/// takes as long as to read all pictures. That frames which it calls rendered have been kept since
/// is nothing new.
pub fn is_fresh(reel: &Reel, run: &RunFacts) -> bool {
    let kept = run.outcomes.values().all(|o| *o == Outcome::Kept);
    kept && ledger::holds(reel, PAGE, || key::key(reel, run, &find(reel, run)))
}

/// The whole HTML file.
fn text(reel: &Reel, contents: &Contents<'_>) -> String {
    let views = &contents.views;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head::head(reel))
            body {
                main {
                    (head::opening(reel, contents))
                    @if !views.is_empty() { (player::section(reel, contents)) }
                    (grid::section(contents))
                    (chart::section(views))
                    (table::section(contents))
                }
                @if !views.is_empty() { (player::script()) }
            }
        }
    };
    page.into_string()
}
