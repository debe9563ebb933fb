//! Images on the page: all frames side by side, and one large in a player.

use super::frame_row::{Contents, Entry, FrameRow, span};
use crate::store::ShotFolder;
use maud::{Markup, PreEscaped, html};

/// All frames side by side. Each image links to its row of the table and, with scripts, to the
/// player.
pub(super) fn grid(contents: &Contents<'_>) -> Markup {
    html! {
        section aria-labelledby="all" {
            h2 #all { "All frames" }
            ol #grid {
                @for entry in contents.entries() { @match entry {
                    Entry::Frame(row) => (cell(row)),
                    Entry::Gap(run) => li.gap { "frames " (span(run)) ": missing" },
                } }
            }
        }
    }
}

fn cell(row: &FrameRow<'_>) -> Markup {
    let word = row.state.word();
    html! {
        li {
            a href={ "#frame-" (row.frame) } data-frame=(row.frame) data-full=[&row.full] class=[row.state.is_amiss().then_some("amiss")] {
                @match &row.picture {
                    Some(picture) => img src=(picture.url) width=(picture.size[0]) height=(picture.size[1]) decoding="async" alt="";,
                    None => span.nothing { "no picture" },
                }
                span.label { "frame " (row.frame) }
                " " span class={ "state " (word) } { (word) }
            }
        }
    }
}

/// One frame large, with a slider and a play button; hidden until the script shows it.
pub(super) fn player(shot_folder: &ShotFolder, contents: &Contents<'_>) -> Markup {
    let [width, height] = shot_folder.keys.resolution().size;
    html! {
        section #player hidden data-fps=(shot_folder.shot().shot.fps) data-frames=(contents.frames) aria-label="Player" {
            div.stage style={ "aspect-ratio:" (width) "/" (height) } {
                img #picture alt="";
                p #absent hidden { }
            }
            div.controls {
                button #play type="button" { "Play" }
                input #scrub type="range" min="1" max=(contents.rows.len()) value="1" step="1" aria-label="Frame";
                output #number for="scrub" { "frame 1" }
            }
            dl #facts { }
            p.faint { "← and → step, Home and End go to the ends, Space on the player plays. \
                       The full picture is shown where the player stands still." }
        }
    }
}

/// The player's script, after everything that it moves.
pub(super) fn script() -> Markup {
    html! { script { (PreEscaped(include_str!("player.js"))) } }
}
