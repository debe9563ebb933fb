//! What stands above and below the findings: what was studied, on what, and how to read it.

use crate::plot::STYLE;
use crate::study::findings::Study;
use crate::study::report::quantity::{number, percent, times};
use maud::{Markup, PreEscaped, html};

/// The title, as it stands on the page and in the window's frame.
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

/// What was studied, on what, and how far times can be trusted.
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
            "Equal work differed in time by " (percent(noise.spread))
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

/// How far a ratio of times is from 1 where a busy machine cannot tell it from 1.
const NOT_TOLD_APART: f64 = 0.1;

/// A ratio of times, marked where the machine was too busy to tell it from 1.
pub(super) fn time_ratio(study: &Study, ratio: f64) -> Markup {
    let alike = study.noise.too_noisy
        && (1.0 / (1.0 + NOT_TOLD_APART)..=1.0 + NOT_TOLD_APART).contains(&ratio);
    html! {
        @if alike { span.alike title="not told apart on this machine" { (times(ratio)) " ≈" } }
        @else { (times(ratio)) }
    }
}

/// What the words mean.
pub(super) fn legend() -> Markup {
    let delta_e = number(1.0);
    html! {
        section #words {
            h2 { "How to read this" }
            dl {
                dt { "ΔE2000" }
                dd { "The difference of two colors as people see it (CIEDE2000). Below " (delta_e)
                     " it is seen only side by side, below 0.5 hardly, below 0.1 never. It is of "
                     "developed pixels before they are rounded to 8 bits. “99 %” is what 99 of "
                     "100 pixels do not exceed." }
                dt { "Error of radiance" }
                dd { "Root mean square of the difference of the sensor's channels, as a part of "
                     "that of the reference." }
                dt { "Displacement" }
                dd { "How far a surface is seen from where it should be, pixels; “mistaken” are "
                     "pixels that see another surface." }
                dt { "Pareto front" }
                dd { "Settings that no other beats: none is at least as exact and faster by more "
                     "than times of equal work differ. "
                     "Ringed in the charts; the dashed staircase joins them. All others waste "
                     "time or exactness." }
                dt { "Times" }
                dd { "Of the whole image, prepared, traced, shaded, developed, encoded and "
                     "written, by the clock on the wall; those of phases that threads share are divided by their number. "
                     "The median of all renders, with the shortest and the longest." }
            }
        }
    }
}
