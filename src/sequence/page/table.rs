//! All frames as a table: what is known of each, and what it is made of.

use super::chart::PHASES;
use super::view::{Contents, Entry, View, beside, span};
use crate::frame::Caption;
use crate::plot::quantity::{NOTHING, bytes, number, time};
use crate::queue::Record;
use crate::relativity::Celerity;
use maud::{Markup, html};

/// A column, which is left out where no frame has anything in it.
struct Column {
    title: &'static str,
    /// Of numbers, which stand at the right.
    class: Option<&'static str>,
    cell: fn(&View<'_>) -> Option<String>,
}

const fn words(title: &'static str, cell: fn(&View<'_>) -> Option<String>) -> Column {
    let class = None;
    Column { title, class, cell }
}

const fn numbers(title: &'static str, cell: fn(&View<'_>) -> Option<String>) -> Column {
    let class = Some("n");
    Column { title, class, cell }
}

const COLUMNS: [Column; 17] = [
    words("State", |view| {
        let because = view.state.because().map(|b| format!(": {b}"));
        Some(format!(
            "{}{}",
            view.state.word(),
            because.unwrap_or_default()
        ))
    }),
    numbers("Time, s", |view| fact(view, |f| f.time_s.map(digits))),
    numbers("β", |view| fact(view, |f| Some(beta(f.fastest)))),
    numbers("γ", |view| {
        fact(view, |f| Some(digits(f.fastest.lorentz_factor())))
    }),
    numbers("Hottest, K", |view| {
        fact(view, |f| f.temperature_k.map(digits))
    }),
    numbers("Exposure, stops", |view| {
        record(view, |r| Some(digits(r.exposure)))
    }),
    numbers("Seconds", |view| {
        record(view, |r| Some(time(r.seconds.total())))
    }),
    numbers("prepare", |view| phase(view, 0)),
    numbers("trace", |view| phase(view, 1)),
    numbers("shade", |view| phase(view, 2)),
    numbers("encode", |view| phase(view, 3)),
    numbers("write", |view| phase(view, 4)),
    numbers("Samples", |view| {
        record(view, |r| Some(r.samples.to_string()))
    }),
    words("Effects", |view| {
        record(view, |r| {
            Some(r.effects.join(", ")).filter(|e| !e.is_empty())
        })
    }),
    words("Trace", |view| {
        record(view, |r| match r.shared {
            0 | 1 => None,
            shared => Some(format!("shared by {shared} frames")),
        })
    }),
    numbers("Light left out, %", |view| {
        record(view, |r| (r.cut > 0.0).then(|| digits(100.0 * r.cut)))
    }),
    words("Warnings", |view| {
        record(view, |r| {
            Some(r.warnings.join("; ")).filter(|w| !w.is_empty())
        })
    }),
];

fn fact(view: &View<'_>, part: impl Fn(&Caption) -> Option<String>) -> Option<String> {
    part(view.facts.as_ref()?)
}

fn record(view: &View<'_>, part: impl Fn(&Record) -> Option<String>) -> Option<String> {
    part(view.record?)
}

fn phase(view: &View<'_>, place: usize) -> Option<String> {
    Some(time((PHASES[place].1)(&view.record?.seconds)))
}

/// The section.
pub(super) fn section(contents: &Contents<'_>) -> Markup {
    let views = &contents.views;
    let has = |column: &&Column| views.iter().any(|view| (column.cell)(view).is_some());
    let columns: Vec<&Column> = COLUMNS.iter().filter(has).collect();
    let common = common_parts(views);
    html! {
        section aria-labelledby="each" {
            h2 #each { "Frame by frame" }
            div.scroll role="region" aria-labelledby="each" tabindex="0" { table #frames {
                thead { tr {
                    th scope="col" { "Frame" }
                    @for column in &columns { th scope="col" class=[column.class] { (column.title) } }
                    th scope="col" { "Made of" }
                } }
                tbody { @for entry in contents.entries() { @match entry {
                    Entry::Frame(view) => (row(view, &columns, &common)),
                    Entry::Gap(run) => tr.gap { td colspan=(columns.len() + 2) {
                        "frames " (span(run)) ": missing"
                    } },
                } } }
            } }
            @if !common.is_empty() { details {
                summary { "What all frames are made of" }
                (list(common.iter().copied()))
            } }
        }
    }
}

fn row(view: &View<'_>, columns: &[&Column], common: &[(&str, &str)]) -> Markup {
    html! {
        tr id={ "frame-" (view.frame) } {
            th scope="row" { @match &view.full {
                Some(full) => a href=(full) { (view.frame) },
                None => (view.frame),
            } }
            @for column in columns {
                td class=[column.class] { ((column.cell)(view).as_deref().unwrap_or(NOTHING)) }
            }
            td data-short=(NOTHING) { @match view.record {
                Some(record) => (made_of(record, common)),
                None => (NOTHING),
            } }
        }
    }
}

/// What a frame does not share with all others, and its files.
fn made_of(record: &Record, common: &[(&str, &str)]) -> Markup {
    let own = record
        .parts
        .iter()
        .map(|(key, value)| (key.as_str(), value.as_str()))
        .filter(|part| !common.contains(part));
    html! {
        details {
            summary { (record.fingerprint.chars().take(12).collect::<String>()) }
            (list(own))
            p.parts { @for file in &record.files {
                a href=(beside(&file.name)) { (file.name) } " " (bytes(file.bytes)) " "
            } "finished " (record.finished) }
        }
    }
}

fn list<'a>(parts: impl Iterator<Item = (&'a str, &'a str)>) -> Markup {
    html! {
        dl.parts { @for (key, value) in parts {
            div { dt { (key) } " " dd { (value) } }
        } }
    }
}

/// What the frames with a record are all made of, so that it is said once.
fn common_parts<'a>(views: &[View<'a>]) -> Vec<(&'a str, &'a str)> {
    let mut records = views.iter().filter_map(|view| view.record);
    let Some(first) = records.next() else {
        return Vec::new();
    };
    let mut common: Vec<(&str, &str)> = first
        .parts
        .iter()
        .map(|(key, value)| (key.as_str(), value.as_str()))
        .collect();
    for record in records {
        common.retain(|(key, value)| record.parts.get(*key).is_some_and(|v| v == value));
    }
    common
}

/// β, or what it lacks to 1 where that is little.
fn beta(w: Celerity) -> String {
    let beta = w.beta().length();
    let lorentz_factor = w.lorentz_factor();
    // 1 − β = 1 / (γ² (1 + β)), which does not cancel.
    let lack = 1.0 / (lorentz_factor * lorentz_factor * (1.0 + beta));
    if lack < 1e-3 {
        format!("1 − {}", number(lack))
    } else {
        digits(beta)
    }
}

/// Up to four decimals and six digits, without zeros at the end; three digits and a power of ten far
/// from 1.
fn digits(value: f64) -> String {
    let decimals = match value.abs() {
        0.0 => 0,
        1e-3..10.0 => 4,
        10.0..100.0 => 3,
        100.0..1e3 => 2,
        1e3..1e4 => 1,
        1e4..1e6 => 0,
        _ => return number(value),
    };
    let text = format!("{value:.decimals$}");
    let text = if decimals > 0 {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn numbers_keep_what_tells_frames_apart() {
        for (value, text) in [
            (0.0, "0"),
            (0.9, "0.9"),
            (-6.4, "−6.4"),
            (2.294_157, "2.2942"),
            (3_142.857, "3142.9"),
            (13650.0, "13650"),
            (100_000.0, "100000"),
            (1.5e-7, "1.5·10⁻⁷"),
            (f64::INFINITY, "∞"),
        ] {
            assert_eq!(digits(value), text);
        }
    }

    #[test]
    fn near_the_speed_of_light_it_is_told_what_is_lacking() {
        let told = |lorentz_factor: f64| {
            beta(Celerity::from_lorentz_factor(lorentz_factor, DVec3::X).expect("a celerity"))
        };
        assert_eq!(told(1.25), "0.6");
        // 1 − β is 1/(2γ²) there.
        assert_eq!(told(1e6), "1 − 5·10⁻¹³");
    }
}
