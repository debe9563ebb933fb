//! The settings of a sweep as a table, with the numbers of its charts.

use super::chart::color;
use super::head::time_ratio;
use super::measure::{NOTHING, bytes, mebibytes, number, percent, range, time};
use crate::study::results::{Errors, Percentiles, Point, Study, Sweep};
use maud::{Markup, html};

/// A column of numbers. A column without any value is left out.
struct Column {
    title: &'static str,
    cell: fn(&Context<'_>, &Point) -> Option<Markup>,
}

/// What a cell needs besides its point.
struct Context<'a> {
    study: &'a Study,
    /// Seconds of the unchanged shot.
    current: Option<f64>,
}

const COLUMNS: [Column; 13] = [
    Column {
        title: "Image",
        cell: |_, point| {
            Some(html! {
                (time(point.frame.median))
                @if let Some(range) = range(point.frame) { span.range { (range) } }
            })
        },
    },
    Column {
        title: "Over current",
        cell: |context, point| over_current(context, point),
    },
    Column {
        title: "Phase",
        cell: |_, point| words(time(point.phase.median)),
    },
    Column {
        title: "Memory",
        cell: |_, point| words(mebibytes(point.memory_mib?)),
    },
    Column {
        title: "Files",
        cell: |_, point| words(bytes(point.file_bytes?)),
    },
    Column {
        title: "Error of radiance",
        cell: |_, point| error(point, |e| Some(e.radiance)),
    },
    Column {
        title: "ΔE2000 mean",
        cell: |_, point| error(point, |e| e.delta_e.map(mean)),
    },
    Column {
        title: "ΔE2000 99\u{a0}%",
        cell: |_, point| error(point, |e| e.delta_e.map(p99)),
    },
    Column {
        title: "ΔE2000 worst",
        cell: |_, point| error(point, |e| e.delta_e.map(worst)),
    },
    Column {
        title: "Shift 99\u{a0}%, px",
        cell: |_, point| error(point, |e| e.displacement.map(p99)),
    },
    Column {
        title: "Shift worst, px",
        cell: |_, point| error(point, |e| e.displacement.map(worst)),
    },
    Column {
        title: "Mistaken",
        cell: |_, point| words(percent(point.errors.as_ref()?.mistaken?)),
    },
    Column {
        title: "Stated bound",
        cell: |_, point| error(point, |e| e.bound),
    },
];

fn mean(percentiles: Percentiles) -> f64 {
    percentiles.mean
}

fn p99(percentiles: Percentiles) -> f64 {
    percentiles.p99
}

fn worst(percentiles: Percentiles) -> f64 {
    percentiles.worst
}

fn words(words: String) -> Option<Markup> {
    Some(html! { (words) })
}

fn error(point: &Point, part: impl Fn(&Errors) -> Option<f64>) -> Option<Markup> {
    words(number(part(point.errors.as_ref()?)?))
}

fn over_current(context: &Context<'_>, point: &Point) -> Option<Markup> {
    let current = context.current?;
    let [least, median, greatest] =
        [point.frame.least, point.frame.median, point.frame.greatest].map(|s| s / current);
    Some(html! {
        (time_ratio(context.study, median))
        @if least < greatest { span.range { (number(least)) "–" (number(greatest)) } }
    })
}

/// The table of all points, the current one and those of the Pareto front marked.
pub(super) fn table(study: &Study, sweep: &Sweep) -> Markup {
    let current = sweep.points.iter().find(|point| point.current);
    let context = Context {
        study,
        current: current.map(|p| p.frame.median).filter(|s| *s > 0.0),
    };
    let has = |column: &&Column| {
        sweep
            .points
            .iter()
            .any(|p| (column.cell)(&context, p).is_some())
    };
    let columns: Vec<&Column> = COLUMNS.iter().filter(has).collect();
    html! {
        div.scroll { table.settings {
            thead { tr {
                th.n { "#" } th { "Setting" }
                @for column in &columns { th.n { (column.title) } }
                th { "Pareto" } th { "In the shot" }
            } }
            tbody { @for (i, point) in sweep.points.iter().enumerate() {
                tr.current[point.current].pareto[point.pareto] {
                    td.n { (i + 1) }
                    td.setting {
                        (swatch(sweep, &point.family)) (point.setting)
                        @if point.current { " " em { "– as the shot is" } }
                        @if point.errors.is_none() { " " em { "– the reference" } }
                    }
                    @for column in &columns {
                        td.n { @match (column.cell)(&context, point) {
                            Some(cell) => (cell),
                            None => (NOTHING),
                        } }
                    }
                    td { @if point.pareto { "yes" } @else { (NOTHING) } }
                    td { @match &point.toml { Some(toml) => code { (toml) }, None => (NOTHING) } }
                }
            } }
        } }
    }
}

/// A dot in the colour of a family.
fn swatch(sweep: &Sweep, family: &str) -> Markup {
    let [r, g, b] = color(sweep, family);
    html! { span.swatch title=(family) style=(format!("background:rgb({r},{g},{b})")) { } }
}
