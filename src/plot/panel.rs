//! Layout of a panel on its part of a page: tints, grid, curves, labels of the axes.

use super::axis::Tick;
use super::drawing::{Anchor, Mark, Shape, Text};
use super::marks::{CHARACTER, INK, Rect, USUAL_FONT, label, strokes};
use super::point_labels::place_labels;
use super::polyline::{simplified, visible_runs};
use super::{Color, Panel, Remark, Series};

const GRID: Color = [222, 222, 222];
/// Largest distance of a drawn line from the curve, pixels.
const TOLERANCE: f64 = 0.04;
/// A panel, and its place on the page.
pub(super) struct PanelLayout<'a> {
    pub(super) panel: &'a Panel,
    pub(super) font: f64,
    /// The rectangle between the axes.
    pub(super) area: Rect,
    pub(super) x_ticks: Vec<Tick>,
    pub(super) y_ticks: Vec<Tick>,
}

impl<'a> PanelLayout<'a> {
    /// A panel with room for labels, on a part of a page.
    pub(super) fn new(panel: &'a Panel, place: Rect, font: f64) -> Self {
        let [above, right, below] = [1.9, 1.6, 3.7].map(|share| share * font);
        let height = (place.size[1] - above - below).max(1.0);
        let y_ticks = panel.y.ticks((height / (2.6 * font)) as usize);
        let left = (2.9 + longest(&y_ticks) * CHARACTER) * font;
        let width = (place.size[0] - left - right).max(1.0);
        Self {
            panel,
            font,
            area: Rect {
                corner: [place.corner[0] + left, place.corner[1] + above],
                size: [width, height],
            },
            x_ticks: panel.x.ticks((width / (4.5 * font)) as usize),
            y_ticks,
        }
    }

    fn x(&self, place: f64) -> f64 {
        self.area.corner[0] + place * self.area.size[0]
    }

    fn y(&self, place: f64) -> f64 {
        self.area.corner[1] + (1.0 - place) * self.area.size[1]
    }

    /// The curves between their axes, with titles and labels.
    pub(super) fn labelled(&self) -> Vec<Mark> {
        let drawn = self.curves();
        let beside = place_labels(&self.remarked(), &drawn, self.area, self.font);
        let mut marks = self.between_axes(drawn);
        marks.extend(self.values());
        marks.extend(self.titles());
        marks.extend(beside);
        marks
    }

    /// The curves between their axes.
    pub(super) fn bare(&self) -> Vec<Mark> {
        self.between_axes(self.curves())
    }

    fn curves(&self) -> Vec<Mark> {
        let series = self.panel.series.iter();
        series.flat_map(|series| self.curve(series)).collect()
    }

    fn between_axes(&self, drawn: Vec<Mark>) -> Vec<Mark> {
        let mut marks = self.tints();
        marks.extend(self.grid());
        marks.extend(drawn);
        let corners = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        marks.push(self.line("frame", INK, &corners));
        marks
    }

    /// The tinted background. Tints finer than a pixel are merged with their neighbors. Each
    /// reaches below the next one, so that there are no seams.
    fn tints(&self) -> Vec<Mark> {
        const FINEST: f64 = 1.0;
        let Panel { x, tints, .. } = self.panel;
        let at = |value: f64| self.x(x.place(value));
        let end = at(tints.last().map_or(x.range[0], |tint| tint.range[1]));
        let mut shown: Vec<(f64, Color)> = Vec::new();
        for tint in tints {
            let inside = tint.range[1] > x.range[0] && tint.range[0] < x.range[1];
            let start = at(tint.range[0]);
            if inside && shown.last().is_none_or(|last| start >= last.0 + FINEST) {
                shown.push((start, tint.color));
            }
        }
        let mark = |(i, (start, color)): (usize, &(f64, Color))| {
            let end = shown.get(i + 2).map_or(end, |next| next.0);
            let shape = Shape::Rect {
                corner: [*start, self.area.corner[1]],
                size: [end - start, self.area.size[1]],
            };
            Mark::new("tint", *color, shape)
        };
        shown.iter().enumerate().map(mark).collect()
    }

    /// Grid lines at ticks with labels, short lines at the others.
    fn grid(&self) -> Vec<Mark> {
        const SHORT: f64 = 0.35;
        let style = |tick: &Tick, [across, short]: [&'static str; 2], extent: f64| match tick.label
        {
            Some(_) => (across, GRID, 1.0),
            None => (short, INK, SHORT * self.font / extent),
        };
        let [width, height] = self.area.size;
        let upright = self.x_ticks.iter().map(|tick| {
            let (class, color, end) = style(tick, ["x-tick", "x-minor"], height);
            self.line(class, color, &[[tick.place, 0.0], [tick.place, end]])
        });
        let level = self.y_ticks.iter().map(|tick| {
            let (class, color, end) = style(tick, ["y-tick", "y-minor"], width);
            self.line(class, color, &[[0.0, tick.place], [end, tick.place]])
        });
        upright.chain(level).collect()
    }

    /// A thin line between places on the axes.
    fn line(&self, class: &str, color: Color, places: &[[f64; 2]]) -> Mark {
        let points = places.iter().map(|[x, y]| [self.x(*x), self.y(*y)]);
        let shape = Shape::Line {
            points: points.collect(),
            width: self.font / USUAL_FONT,
            dash: None,
        };
        Mark::new(class, color, shape)
    }

    fn curve(&self, series: &Series) -> Vec<Mark> {
        let class = format!("curve {}", series.name);
        if series.is_dotted() {
            let (dots, remarks): (Vec<_>, Vec<_>) = self.dots(series).unzip();
            let mut marks = strokes(&class, series, &dots, self.font);
            for (mark, remark) in marks.iter_mut().zip(remarks) {
                mark.tip = remark.map(|remark| remark.tip.clone());
            }
            return marks;
        }
        let runs = visible_runs(&series.points, &self.panel.y).into_iter();
        runs.flat_map(|run| {
            let line: Vec<_> = run.iter().map(|p| self.on_page(p)).collect();
            strokes(&class, series, &simplified(&line, TOLERANCE), self.font)
        })
        .collect()
    }

    fn on_page(&self, [x, y]: &[f64; 2]) -> [f64; 2] {
        let Panel {
            x: across, y: up, ..
        } = self.panel;
        [self.x(across.place(*x)), self.y(up.place(*y))]
    }

    /// The dots of a series that its axis shows, each with its label.
    fn dots<'b>(&self, series: &'b Series) -> impl Iterator<Item = ([f64; 2], Option<&'b Remark>)> {
        let remarks = series.remarks.iter().map(Some);
        let points = series
            .points
            .iter()
            .zip(remarks.chain(std::iter::repeat(None)));
        let shown = points.filter(|(point, _)| !self.panel.y.hides(point[1]));
        shown.map(|(point, remark)| (self.on_page(point), remark))
    }

    fn remarked(&self) -> Vec<([f64; 2], &'a Remark)> {
        let panel: &'a Panel = self.panel;
        let dotted = panel.series.iter().filter(|series| series.is_dotted());
        dotted
            .flat_map(|series| self.dots(series))
            .filter_map(|(at, remark)| Some((at, remark?)))
            .collect()
    }

    /// The labels of the ticks.
    pub(super) fn values(&self) -> Vec<Mark> {
        let font = self.font;
        let text =
            |class, at, anchor, words: &str| label(class, anchor, Text::new(at, font, words));
        let (left, bottom) = (self.x(0.0), self.y(0.0));
        let across = labelled(&self.x_ticks).map(|(place, value)| {
            let at = [self.x(place), bottom + 1.25 * font];
            text("x-value", at, Anchor::Middle, value)
        });
        let up = labelled(&self.y_ticks).map(|(place, value)| {
            let at = [left - 0.45 * font, self.y(place) + 0.35 * font];
            text("y-value", at, Anchor::End, value)
        });
        across.chain(up).collect()
    }

    /// The titles of the axes, the panel's title and its note.
    fn titles(&self) -> Vec<Mark> {
        let font = self.font;
        let Panel {
            x, y, title, note, ..
        } = self.panel;
        let (left, bottom) = (self.x(0.0), self.y(0.0));
        let (middle, center) = (self.x(0.5), self.y(0.5));
        let text =
            |class, at, anchor, words: &str| label(class, anchor, Text::new(at, font, words));
        let below = [middle, bottom + 2.8 * font];
        let beside = [
            left - (longest(&self.y_ticks) * CHARACTER + 1.1) * font,
            center,
        ];
        let upwards = Text {
            upwards: true,
            ..Text::new(beside, font, &y.title())
        };
        let above = [left, self.y(1.0) - 0.55 * font];
        let mut marks = vec![
            text("x-label", below, Anchor::Middle, &x.title()),
            label("y-label", Anchor::Middle, upwards),
            text("title", above, Anchor::Start, title),
        ];
        if let Some(note) = note {
            marks.push(text("note", [middle, center], Anchor::Middle, note));
        }
        marks
    }
}

/// Number of characters of the longest label.
pub(super) fn longest(ticks: &[Tick]) -> f64 {
    let lengths = labelled(ticks).map(|(_, label)| label.chars().count());
    lengths.max().unwrap_or(0) as f64
}

fn labelled(ticks: &[Tick]) -> impl Iterator<Item = (f64, &str)> {
    ticks
        .iter()
        .filter_map(|tick| Some((tick.place, tick.label.as_deref()?)))
}
