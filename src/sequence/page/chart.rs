//! Chart of seconds per frame, stacked by phase, whose bars link to the frames.
//!
//! The drawing contains only bars and is stretched to the page's width, so that there is room for
//! 1000 frames; labels beside it are text of the page, which keeps its size.

use super::frame_row::FrameRow;
use crate::plot::quantity::{number, time, unit_of_time};
use crate::store::Seconds;
use maud::{Markup, html};

/// The name of a phase, and its share of a frame's seconds.
type Phase = (&'static str, fn(&Seconds) -> f64);

/// The phases of a frame, stacked from below in this order.
pub(super) const PHASES: [Phase; 5] = [
    ("prepare", |s| s.prepare),
    ("trace", |s| s.trace),
    ("shade", |s| s.shade),
    ("encode", |s| s.encode),
    ("write", |s| s.write),
];

/// Height of the drawing in its own units, in which a frame is [`PITCH`] wide.
const HEIGHT: f64 = 1000.0;
const PITCH: f64 = 10.0;
/// Space between bars.
const GAP: f64 = 1.0;

/// The section; empty if no frame has a record.
pub(super) fn section(rows: &[FrameRow<'_>]) -> Markup {
    let longest = rows
        .iter()
        .filter_map(|row| row.record)
        .map(|record| record.seconds.total())
        .filter(|seconds| seconds.is_finite())
        .fold(0.0, f64::max);
    html! {
        @if longest > 0.0 {
            section aria-labelledby="took" {
                h2 #took { "Seconds a frame" }
                ul.legend { @for (i, (phase, _)) in PHASES.iter().enumerate() {
                    li { span class={ "swatch p" (i + 1) } { } (phase) }
                } }
                (drawing(rows, &Scale::to(longest)))
            }
        }
    }
}

/// The vertical axis, from 0.
struct Scale {
    top: f64,
    step: f64,
    unit: f64,
    unit_name: &'static str,
}

impl Scale {
    /// Ends at the first tick at or above `longest`; ticks are 1, 2 or 5 times powers of ten of a
    /// unit, and at most five.
    fn to(longest: f64) -> Self {
        let (unit, unit_name) = unit_of_time(longest);
        let value = longest / unit;
        let power = 10_f64.powf((value / 5.0).log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|digit| digit * power)
            .into_iter()
            .find(|step| value <= 5.0 * step)
            .unwrap_or(10.0 * power);
        Self {
            top: (value / step).ceil() * step * unit,
            step,
            unit,
            unit_name,
        }
    }

    /// Values in the unit, from below.
    fn ticks(&self) -> impl Iterator<Item = f64> {
        let count = (self.top / self.unit / self.step).round() as u32;
        (0..=count).map(|i| f64::from(i) * self.step)
    }

    /// Height in the drawing.
    fn height(&self, seconds: f64) -> f64 {
        let height = seconds / self.top * HEIGHT;
        if height.is_finite() {
            height.clamp(0.0, HEIGHT)
        } else {
            0.0
        }
    }
}

fn drawing(rows: &[FrameRow<'_>], scale: &Scale) -> Markup {
    let width = PITCH * rows.len() as f64;
    html! {
        figure.seconds {
            div.scale aria-hidden="true" { @for tick in scale.ticks() {
                span style={ "bottom:" (hundredths(scale.height(tick * scale.unit) / HEIGHT * 100.0)) "%" } {
                    (number(tick)) " " (scale.unit_name)
                }
            } }
            svg #bars viewBox={ "0 0 " (width) " " (HEIGHT) } preserveAspectRatio="none" role="img" aria-label="Seconds a frame, phase upon phase; the numbers are in the table" {
                @for tick in scale.ticks().skip(1) {
                    @let y = hundredths(HEIGHT - scale.height(tick * scale.unit));
                    line x1="0" x2=(width) y1=(y) y2=(y) { }
                }
                @for (place, row) in rows.iter().enumerate() { (bar(place, row, scale)) }
            }
            div.axis aria-hidden="true" {
                @for place in labels(rows.len()) {
                    span style={ "left:" (hundredths((place as f64 - 0.5) / rows.len() as f64 * 100.0)) "%" } { (rows[place - 1].frame) }
                }
            }
            figcaption { "Frames, first to last. A bar leads to its frame." }
        }
    }
}

fn bar(place: usize, row: &FrameRow<'_>, scale: &Scale) -> Markup {
    let x = place as f64 * PITCH;
    html! {
        a href={ "#frame-" (row.frame) } data-frame=(row.frame) tabindex="-1" {
            title { (tip(row)) }
            @if let Some(record) = row.record {
                @for (i, low, high) in stacked(&record.seconds, scale) {
                    rect class={ "p" (i + 1) } x=(x) y=(hundredths(HEIGHT - high)) width=(PITCH - GAP) height=(hundredths(high - low)) { }
                }
            }
            rect.whole x=(x) y="0" width=(PITCH) height=(HEIGHT) { }
        }
    }
}

/// For each phase its lower and upper end, without those too small to be drawn.
fn stacked(seconds: &Seconds, scale: &Scale) -> Vec<(usize, f64, f64)> {
    let mut below = 0.0;
    let mut parts = Vec::new();
    for (i, (_, part)) in PHASES.iter().enumerate() {
        let low = scale.height(below);
        below += part(seconds).max(0.0);
        let high = scale.height(below);
        if high - low >= 0.01 {
            parts.push((i, low, high));
        }
    }
    parts
}

fn tip(row: &FrameRow<'_>) -> String {
    let frame = row.frame;
    match row.record {
        None => format!("frame {frame}: {}", row.state.word()),
        Some(record) => {
            let part = |(name, part): &Phase| format!("{name} {}", time(part(&record.seconds)));
            let parts: Vec<String> = PHASES.iter().map(part).collect();
            let total = time(record.seconds.total());
            format!("frame {frame}: {total} ({})", parts.join(", "))
        }
    }
}

/// Bars with labels, from 1: the first, and the multiples of 1, 2 or 5 times a power of ten, of
/// which there are at most ten.
fn labels(frames: usize) -> Vec<usize> {
    let steps = (0..).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_usize.pow(power)));
    let step = steps
        .into_iter()
        .find(|step| frames / step <= 10)
        .unwrap_or(1);
    let mut labels: Vec<usize> = (1..=frames / step).map(|i| i * step).collect();
    if step > 1 {
        labels.insert(0, 1);
    }
    labels
}

fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_ends_at_a_round_value_above_the_longest() {
        for (longest, top, ticks) in [
            (0.31, 0.4, 5),
            (1.0, 1.0, 6),
            (7.2, 8.0, 5),
            (0.0041, 0.005, 6),
            (90.0, 100.0, 6),
            (7300.0, 9000.0, 6),
        ] {
            let scale = Scale::to(longest);
            assert!(
                (scale.top - top).abs() < 1e-9 * top,
                "{longest}: {}",
                scale.top
            );
            assert_eq!(scale.ticks().count(), ticks, "{longest}");
        }
    }

    #[test]
    fn phases_stand_upon_each_other_and_reach_the_total() {
        let seconds = Seconds {
            prepare: 0.1,
            trace: 0.4,
            shade: 0.0,
            encode: 0.2,
            write: 0.3,
        };
        let parts = stacked(&seconds, &Scale::to(1.0));
        let ends: Vec<(usize, f64)> = parts
            .iter()
            .map(|(i, _, high)| (*i, high.round()))
            .collect();
        assert_eq!(ends, [(0, 100.0), (1, 500.0), (3, 700.0), (4, 1000.0)]);
        assert!(parts.windows(2).all(|w| w[0].2 == w[1].1));
    }

    #[test]
    fn labels_are_round_numbers_and_few() {
        assert_eq!(labels(1), [1]);
        assert_eq!(labels(3), [1, 2, 3]);
        assert_eq!(labels(49), [1, 5, 10, 15, 20, 25, 30, 35, 40, 45]);
        assert_eq!(labels(1000).len(), 11);
        for frames in 1..2000 {
            let labels = labels(frames);
            assert!(labels.len() <= 11 && labels.is_sorted() && labels[0] == 1);
        }
    }
}
