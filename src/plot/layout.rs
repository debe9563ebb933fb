//! Layout of a plot on a page, as a list of marks.
//!
//! The width of text is estimated, [`CHARACTER`] of its size per character, because viewers use
//! fonts of their own. There is room for a wide one.

use super::Plot;
use super::drawing::{Drawing, Group};
use super::legend::{caption, legend};
use super::marks::{PAPER, Page, Rect};
use super::panel::PanelLayout;

/// Lays out a plot on a page.
pub fn lay_out(plot: &Plot, page: Page) -> Drawing {
    let [width, height] = page.size;
    let font = page.font;
    let (caption, below) = caption(plot, page);
    let (legend, legend_base) = legend(plot, [font, below + 1.7 * font], page);
    let mut groups = vec![caption, legend];
    let top = legend_base + 0.7 * font;
    let share = width / plot.panels.len().max(1) as f64;
    for (i, panel) in plot.panels.iter().enumerate() {
        let place = Rect {
            corner: [share * i as f64, top],
            size: [share, height - top],
        };
        groups.push(Group {
            id: format!("panel-{}", i + 1),
            marks: PanelLayout::new(panel, place, font).labelled(),
        });
    }
    Drawing {
        size: page.size,
        paper: PAPER,
        opacity: 1.0,
        title: plot.caption.first().cloned().unwrap_or_default(),
        groups,
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawing::{Anchor, Shape};
    use super::super::{Axis, Panel, Scale, Series, Stroke};
    use super::*;

    #[test]
    fn a_plot_fits_pages_of_any_size() {
        let curve = |name: &str, factor: f64| Series {
            name: name.to_owned(),
            color: [0, 0, 0],
            stroke: Stroke::Solid(2.0),
            points: (1..100)
                .map(|i| [f64::from(i), factor * f64::from(i)])
                .collect(),
            remarks: Vec::new(),
        };
        let panel = |x: Axis, y: Axis| Panel {
            title: "a panel".to_owned(),
            x,
            y,
            tints: Vec::new(),
            series: vec![curve("one", 1e-9), curve("two", 2e-9)],
            note: None,
        };
        let linear = Axis::new("x", "nm", Scale::Linear, [0.0, 100.0]);
        let log = Axis::new("x", "nm", Scale::Log, [1.0, 100.0]);
        let plot = Plot {
            caption: vec!["A caption that is too long for a narrow page, and is cut".to_owned()],
            panels: vec![
                panel(linear, Axis::from_zero("y", "cd", 2e-7)),
                panel(log, Axis::decades("y", "cd", [1e-9, 2e-7])),
            ],
        };
        for (size, font) in [
            ([300.0, 120.0], 8.0),
            ([640.0, 360.0], 12.0),
            ([4000.0, 2000.0], 40.0),
        ] {
            let drawing = lay_out(&plot, Page { size, font });
            for mark in drawing.groups.iter().flat_map(|group| &group.marks) {
                let Shape::Text(text) = &mark.shape else {
                    continue;
                };
                // An average letter is some 0.55 of a font's size wide.
                let length = text.words.chars().count() as f64 * 0.55 * text.size;
                let before = match text.anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => length / 2.0,
                    Anchor::End => length,
                };
                let axis = usize::from(text.upwards);
                let begin = if text.upwards {
                    text.at[axis] - length + before
                } else {
                    text.at[axis] - before
                };
                let fits = begin >= 0.0 && begin + length <= size[axis];
                assert!(fits, "{size:?}: {} {begin} {length}", text.words);
            }
        }
    }
}
