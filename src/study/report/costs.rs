//! Where the time goes: phases, effects, and the statements of the 1990 paper.

use super::measure::{NOTHING, percent, time};
use crate::study::results::{EffectCost, Study};
use maud::{Markup, html};

/// The phases of the unchanged shot, with bars.
pub(super) fn phases(study: &Study) -> Markup {
    if study.phases.is_empty() {
        return html! {};
    }
    let largest = study.phases.iter().map(|p| p.share).fold(0.0, f64::max);
    let width = |share: f64| {
        let part = share / largest;
        if part.is_finite() {
            100.0 * part.clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    html! {
        section #phases {
            h2 { "Where the time goes" }
            p { "The shot as it is. Times of phases that threads share are divided by their number." }
            div.scroll { table {
                thead { tr {
                    th { "Phase" } th.n { "Time" } th.n { "Share" } th.wide { } th { "What happens in it" }
                } }
                tbody { @for phase in &study.phases { tr {
                    td { (phase.phase) }
                    td.n { (time(phase.seconds)) }
                    td.n { (percent(phase.share)) }
                    td { div.bar style=(format!("width:{:.1}%", width(phase.share))) { } }
                    td.words { (phase.what) }
                } } }
            } }
        }
    }
}

/// The cost of each effect.
pub(super) fn effects(study: &Study) -> Markup {
    if study.effects.is_empty() {
        return html! {};
    }
    html! {
        section #effects {
            h2 { "What each effect costs" }
            p { "The image rendered with and without each effect, alternately: the median of the "
                "ratios, and half of their range without the outer tenth at either end." }
            div.scroll { table {
                thead { tr {
                    th { "Effect" } th { "Called for" } th.n { "With" } th.n { "Without" }
                    th.n { "Cost" } th { } th { "1990 paper" } th { "Why" }
                } }
                tbody { @for effect in &study.effects { tr.off[!effect.called] {
                    td { (effect.effect) }
                    td { @if effect.called { "yes" } @else { "no" } }
                    td.n { (time(effect.on.median)) }
                    td.n { (time(effect.off.median)) }
                    td.n { (percent(effect.cost)) " ± " (percent(effect.spread)) }
                    td.words { (verdict(effect)) }
                    td { (effect.paper.unwrap_or(NOTHING)) }
                    td.words { (effect.why) }
                } } }
            } }
        }
    }
}

/// A cost and its spread in words.
fn verdict(effect: &EffectCost) -> &'static str {
    let hidden = effect.cost.abs() <= effect.spread;
    match (effect.called, hidden) {
        (false, true) => "not called for: 0 % within the spread",
        (false, false) => "not called for, but beyond the spread",
        (true, true) => "0 % within the spread",
        (true, false) => "",
    }
}

/// The results of the 1990 paper beside ours.
pub(super) fn paper(study: &Study) -> Markup {
    if study.paper.is_empty() {
        return html! {};
    }
    html! {
        section #paper {
            h2 { "Comparison with the paper of 1990" }
            p { "Its section 6, on machines of its day; ours is a part of the time of everything "
                "else." }
            div.scroll { table {
                thead { tr { th { "What" } th { "1990" } th.n { "Here" } th { "How it was measured" } } }
                tbody { @for row in &study.paper { tr {
                    td.words { (row.what) }
                    td { (row.paper) }
                    td.n { (row.ours.map_or_else(|| NOTHING.to_owned(), percent)) }
                    td.words { (row.how) }
                } } }
            } }
        }
    }
}
