//! A plot small enough to stand in a picture: one panel, with as much around its curves as can be
//! read at that size.
//!
//! No type is smaller than [`LEAST_TYPE`]. Where an inset is less than so many lines of type high,
//! it first loses its legend and the names of the axes, then its caption, and last its ticks. Units
//! stay as long as ticks do.

use super::drawing::{Anchor, Drawing, Group, Mark, Shape, Text};
use super::heading::legend;
use super::layout::{CHARACTER, PAPER, Page};
use super::sheet::{Rect, Sheet, label, longest};
use super::{Panel, Plot};

/// Height below which not even bare curves can be told apart, pixels.
pub const LEAST_INSET: f64 = 60.0;
/// Size of the smallest type, pixels.
const LEAST_TYPE: f64 = 9.5;
/// Heights of an inset in lines of its type, where that is not the smallest.
const LINES: f64 = 23.0;
/// Least height in lines for all that an inset can have, for a caption, and for ticks.
const WITH: [f64; 3] = [19.0, 13.5, 9.0];
/// How far its margins hide the picture.
const OPACITY: f64 = 0.88;

/// Places the first panel of a plot, and the caption's first line, on a page of `size` pixels.
pub fn lay_out_inset(plot: &Plot, size: [f64; 2]) -> Drawing {
    let font = (size[1] / LINES).max(LEAST_TYPE);
    let [all, caption, ticks] = WITH.map(|lines| size[1] >= lines * font);
    let title = plot.caption.first().cloned().unwrap_or_default();
    let mut groups = Vec::new();
    let mut base = 0.1 * font;
    if caption {
        base += 1.35 * font;
        let bold = Text {
            bold: true,
            ..Text::new([0.7 * font, base], font, &title)
        };
        groups.push(group(
            "caption",
            vec![label("caption", Anchor::Start, bold)],
        ));
    }
    if all {
        base += 1.55 * font;
        let (legend, end) = legend(plot, [0.7 * font, base], Page { size, font });
        groups.push(legend);
        base = end;
    }
    if let Some(panel) = plot.panels.first() {
        let marks = match (all, ticks) {
            (true, _) => with_names(panel, size, base, font),
            (false, true) => with_units(panel, size, base, font),
            (false, false) => bare(panel, size, font),
        };
        groups.push(group("panel-1", marks));
    }
    Drawing {
        size,
        paper: PAPER,
        opacity: OPACITY,
        title,
        groups,
    }
}

fn group(id: &str, marks: Vec<Mark>) -> Group {
    let id = id.to_owned();
    Group { id, marks }
}

/// The names of the axes stand level, above the one and below the other: an inset is too low for a
/// name that runs upwards.
fn with_names(panel: &Panel, size: [f64; 2], base: f64, font: f64) -> Vec<Mark> {
    let base = base + 1.5 * font;
    let sheet = sheet(panel, size, base, 3.15, font);
    let mut marks = behind(&sheet);
    let name = Text::new([0.7 * font, base], font, &panel.y.title());
    marks.push(label("y-label", Anchor::Start, name));
    let below = [
        sheet.area.corner[0] + sheet.area.size[0] / 2.0,
        size[1] - 0.5 * font,
    ];
    let name = Text::new(below, font, &panel.x.title());
    marks.push(label("x-label", Anchor::Middle, name));
    marks
}

/// The unit of the horizontal axis stands at its end, in place of labels there.
fn with_units(panel: &Panel, size: [f64; 2], base: f64, font: f64) -> Vec<Mark> {
    let base = base + 1.35 * font;
    let mut sheet = sheet(panel, size, base, 1.65, font);
    let [width, _] = sheet.area.size;
    let unit = panel.x.measure();
    let taken = (unit.chars().count() as f64 + 3.0) * CHARACTER * font / width;
    for tick in &mut sheet.x_ticks {
        if tick.place > 1.0 - taken {
            tick.label = None;
        }
    }
    let mut marks = behind(&sheet);
    let name = Text::new([0.5 * font, base], font, &panel.y.measure());
    marks.push(label("y-label", Anchor::Start, name));
    let end = [sheet.area.corner[0] + width, size[1] - 0.4 * font];
    marks.push(label("x-label", Anchor::End, Text::new(end, font, &unit)));
    marks
}

fn bare(panel: &Panel, size: [f64; 2], font: f64) -> Vec<Mark> {
    let margin = 0.5 * font;
    let sheet = Sheet {
        panel,
        font,
        area: Rect {
            corner: [margin; 2],
            size: size.map(|side| (side - 2.0 * margin).max(1.0)),
        },
        x_ticks: Vec::new(),
        y_ticks: Vec::new(),
    };
    let mut marks = vec![ground(&sheet)];
    marks.extend(sheet.bare());
    marks
}

/// A panel below the line `base`, with `below` lines of type under it.
fn sheet(panel: &Panel, size: [f64; 2], base: f64, below: f64, font: f64) -> Sheet<'_> {
    let top = base + 0.75 * font;
    let height = (size[1] - top - below * font).max(1.0);
    let y_ticks = panel.y.ticks((height / (2.0 * font)) as usize);
    // The same for nearly all labels, so that axes do not jump from frame to frame.
    let left = (1.0 + longest(&y_ticks).max(4.0) * CHARACTER) * font;
    let width = (size[0] - left - 1.6 * font).max(1.0);
    Sheet {
        panel,
        font,
        area: Rect {
            corner: [left, top],
            size: [width, height],
        },
        x_ticks: panel.x.ticks((width / (3.4 * font)) as usize),
        y_ticks,
    }
}

/// The curves between labelled ticks.
fn behind(sheet: &Sheet<'_>) -> Vec<Mark> {
    let mut marks = vec![ground(sheet)];
    marks.extend(sheet.bare());
    marks.extend(sheet.values());
    marks
}

/// Between the axes no picture shines through: what is read there is the curves' alone.
fn ground(sheet: &Sheet<'_>) -> Mark {
    let Rect { corner, size } = sheet.area;
    Mark::new("ground", PAPER, Shape::Rect { corner, size })
}
