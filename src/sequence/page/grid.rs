//! The frames side by side.

use super::view::{Contents, Entry, View, span};
use maud::{Markup, html};

/// The section. Each picture leads to its row of the table, and with scripts to the player.
pub(super) fn section(contents: &Contents<'_>) -> Markup {
    html! {
        section aria-labelledby="all" {
            h2 #all { "All frames" }
            ol #grid {
                @for entry in contents.entries() { @match entry {
                    Entry::Frame(view) => (thumbnail(view)),
                    Entry::Gap(run) => li.gap { "frames " (span(run)) ": missing" },
                } }
            }
        }
    }
}

fn thumbnail(view: &View<'_>) -> Markup {
    let word = view.state.word();
    html! {
        li {
            a href={ "#frame-" (view.frame) } data-frame=(view.frame) data-full=[&view.full] class=[view.state.is_amiss().then_some("amiss")] {
                @match &view.picture {
                    Some(picture) => img src=(picture.url) width=(picture.size[0]) height=(picture.size[1]) decoding="async" alt="";,
                    None => span.nothing { "no picture" },
                }
                span.label { "frame " (view.frame) }
                " " span class={ "state " (word) } { (word) }
            }
        }
    }
}
