//! One frame large, a slider and a button to play them all; shown by its script alone.

use super::view::Contents;
use crate::queue::Reel;
use maud::{Markup, PreEscaped, html};

/// The section, hidden until the script shows it.
pub(super) fn section(reel: &Reel, contents: &Contents<'_>) -> Markup {
    let [width, height] = reel.keys.resolution().size;
    html! {
        section #player hidden data-fps=(reel.shot().shot.fps) data-frames=(contents.frames) aria-label="Player" {
            div.stage style={ "aspect-ratio:" (width) "/" (height) } {
                img #picture alt="";
                p #absent hidden { }
            }
            div.controls {
                button #play type="button" { "Play" }
                input #scrub type="range" min="1" max=(contents.views.len()) value="1" step="1" aria-label="Frame";
                output #number for="scrub" { "frame 1" }
            }
            dl #facts { }
            p.faint { "← and → step, Home and End go to the ends, Space on the player plays. \
                       The full picture is shown where the player stands still." }
        }
    }
}

/// The script, which goes behind all that it moves.
pub(super) fn script() -> Markup {
    html! { script { (PreEscaped(include_str!("player.js"))) } }
}
