//! All frames as a table: facts and inputs of each.

use super::chart::PHASES;
use super::frame_row::{Contents, Entry, FrameRow, beside, span};
use crate::frame::Caption;
use crate::plot::quantity::{NOTHING, bytes, number, time};
use crate::relativity::Celerity;
use crate::store::Record;
use maud::{Markup, html};

/// A column, which is left out if it is empty in all rows.
struct Column {
    title: &'static str,
    /// CSS class of columns of numbers, which are aligned right.
    class: Option<&'static str>,
    cell: fn(&FrameRow<'_>) -> Option<String>,
}

const fn words(title: &'static str, cell: fn(&FrameRow<'_>) -> Option<String>) -> Column {
    let class = None;
    Column { title, class, cell }
}

const fn numbers(title: &'static str, cell: fn(&FrameRow<'_>) -> Option<String>) -> Column {
    let class = Some("n");
    Column { title, class, cell }
}

const COLUMNS: [Column; 17] = [
    words("State", |row| {
        let reason = row.state.reason().map(|b| format!(": {b}"));
        Some(format!(
            "{}{}",
            row.state.word(),
            reason.unwrap_or_default()
        ))
    }),
    numbers("Time, s", |row| fact(row, |f| f.time_s.map(digits))),
    numbers("β", |row| fact(row, |f| Some(beta(f.fastest)))),
    numbers("γ", |row| {
        fact(row, |f| Some(digits(f.fastest.lorentz_factor())))
    }),
    numbers("Hottest, K", |row| {
        fact(row, |f| f.temperature_k.map(digits))
    }),
    numbers("Exposure, stops", |row| {
        record(row, |r| Some(digits(r.exposure)))
    }),
    numbers("Seconds", |row| {
        record(row, |r| Some(time(r.seconds.total())))
    }),
    numbers("prepare", |row| phase(row, 0)),
    numbers("trace", |row| phase(row, 1)),
    numbers("shade", |row| phase(row, 2)),
    numbers("encode", |row| phase(row, 3)),
    numbers("write", |row| phase(row, 4)),
    numbers("Samples", |row| {
        record(row, |r| Some(r.samples.to_string()))
    }),
    words("Effects", |row| {
        record(row, |r| {
            Some(r.effects.join(", ")).filter(|e| !e.is_empty())
        })
    }),
    words("Trace", |row| {
        record(row, |r| match r.shared {
            0 | 1 => None,
            shared => Some(format!("shared by {shared} frames")),
        })
    }),
    numbers("Light left out, %", |row| {
        record(row, |r| (r.cut > 0.0).then(|| digits(100.0 * r.cut)))
    }),
    words("Warnings", |row| {
        record(row, |r| {
            Some(r.warnings.join("; ")).filter(|w| !w.is_empty())
        })
    }),
];

fn fact(row: &FrameRow<'_>, part: impl Fn(&Caption) -> Option<String>) -> Option<String> {
    part(row.caption.as_ref()?)
}

fn record(row: &FrameRow<'_>, part: impl Fn(&Record) -> Option<String>) -> Option<String> {
    part(row.record?)
}

fn phase(row: &FrameRow<'_>, place: usize) -> Option<String> {
    Some(time((PHASES[place].1)(&row.record?.seconds)))
}

/// The section.
pub(super) fn section(contents: &Contents<'_>) -> Markup {
    let rows = &contents.rows;
    let has = |column: &&Column| rows.iter().any(|row| (column.cell)(row).is_some());
    let columns: Vec<&Column> = COLUMNS.iter().filter(has).collect();
    let common = common_parts(rows);
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
                    Entry::Frame(row) => (table_row(row, &columns, &common)),
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

fn table_row(row: &FrameRow<'_>, columns: &[&Column], common: &[(&str, &str)]) -> Markup {
    html! {
        tr id={ "frame-" (row.frame) } {
            th scope="row" { @match &row.full {
                Some(full) => a href=(full) { (row.frame) },
                None => (row.frame),
            } }
            @for column in columns {
                td class=[column.class] { ((column.cell)(row).as_deref().unwrap_or(NOTHING)) }
            }
            td data-short=(NOTHING) { @match row.record {
                Some(record) => (made_of(record, common)),
                None => (NOTHING),
            } }
        }
    }
}

/// Inputs of a frame that it does not share with all others, and its files.
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

/// Inputs that all frames with a record share, listed once.
fn common_parts<'a>(rows: &[FrameRow<'a>]) -> Vec<(&'a str, &'a str)> {
    let mut records = rows.iter().filter_map(|row| row.record);
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

/// β, or 1 − β if that is small.
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

/// Up to four decimals and six digits, without trailing zeros; three digits and a power of ten if
/// far from 1.
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
