//! The parts of the page above and below the results: what was studied, on which machine, and how
//! to read it.

use crate::plot::STYLE;
use crate::study::report::measure::{number, percent, times};
use crate::study::results::Study;
use maud::{Markup, PreEscaped, html};

/// The title, on the page and in the window's frame.
fn title(study: &Study) -> &str {
    study.title.as_deref().unwrap_or(&study.shot)
}

/// The `head` of the page. Its empty elements are closed, so that XML readers can read it.
pub(super) fn head(study: &Study) -> Markup {
    html! {
        head {
            (PreEscaped("<meta charset=\"utf-8\"/>"))
            (PreEscaped("<meta name=\"viewport\" content=\"width=device-width\"/>"))
            title { "Accuracy against time: " (title(study)) }
            style { (PreEscaped(STYLE)) }
        }
    }
}

/// The image, the machine, and how far the times can be trusted.
pub(super) fn opening(study: &Study) -> Markup {
    let [width, height] = study.size;
    let machine = &study.machine;
    html! {
        header {
            p.kicker { "Accuracy against time" }
            h1 { (title(study)) }
            p.facts {
                (study.shot) ".toml, frame " (study.frame) ", " (width) " × " (height)
                " pixels, " (counted(study.samples, "sample")) " a pixel. "
                @if let Some(processor) = &machine.processor { (processor) ", " }
                (counted(machine.threads, "thread")) ", restframe " (machine.version)
                ", each setting rendered "
                @if machine.repeats == 1 { "once" } @else {
                    (machine.repeats) " times, or fewer where that takes long"
                }
                "."
            }
            (noise(study))
        }
    }
}

fn noise(study: &Study) -> Markup {
    let noise = study.noise;
    html! {
        p.noise.warning[noise.too_noisy] {
            "Times of equal work differed by " (percent(noise.spread))
            " (median of some images), and a second copy of the shot as it is took "
            (times(noise.duplicate)) " the time of the first. "
            @if noise.too_noisy {
                strong { "The machine was too busy to tell settings apart that are within 10 % of \
                          each other: their ratios are marked ≈." }
            }
        }
    }
}

fn counted(count: impl std::fmt::Display, noun: &str) -> String {
    let count = count.to_string();
    let plural = if count == "1" { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// Smallest difference from 1 of a ratio of times that a busy machine can still tell.
const NOT_TOLD_APART: f64 = 0.1;

/// A ratio of times, marked if the machine was too busy to tell it from 1.
pub(super) fn time_ratio(study: &Study, ratio: f64) -> Markup {
    let alike = study.noise.too_noisy
        && (1.0 / (1.0 + NOT_TOLD_APART)..=1.0 + NOT_TOLD_APART).contains(&ratio);
    html! {
        @if alike { span.alike title="not told apart on this machine" { (times(ratio)) " ≈" } }
        @else { (times(ratio)) }
    }
}

/// The meaning of the terms.
pub(super) fn legend() -> Markup {
    let delta_e = number(1.0);
    html! {
        section #words {
            h2 { "How to read this" }
            dl {
                dt { "ΔE2000" }
                dd { "The visible difference of two colors (CIEDE2000). Below " (delta_e)
                     " it is visible only side by side, below 0.5 hardly, below 0.1 never. It is "
                     "measured on developed pixels before rounding to 8 bits. “99 %” is the value "
                     "that 99 of 100 pixels do not exceed." }
                dt { "Error of radiance" }
                dd { "Root mean square of the difference of the sensor's channels, as a part of "
                     "that of the reference." }
                dt { "Displacement" }
                dd { "Distance between the place of a surface in the image and its exact place, in "
                     "pixels; “mistaken” is the share of pixels that show another surface." }
                dt { "Pareto front" }
                dd { "Settings that no other beats: none is at least as exact and faster by more "
                     "than times of equal work differ. "
                     "They have rings in the charts, joined by a dashed staircase. All others waste "
                     "time or exactness." }
                dt { "Times" }
                dd { "Wall-clock time of the whole image: preparing, tracing, shading, developing, "
                     "encoding and writing. Times of phases that threads share are divided by the "
                     "number of threads. "
                     "The median of all renders, with the shortest and the longest." }
            }
        }
    }
}
