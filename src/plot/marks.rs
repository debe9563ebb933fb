//! Colors and sizes shared by the whole page, and marks for text and strokes.

use super::drawing::{Anchor, Mark, Shape, Text};
use super::{Color, Series, Stroke};

/// The page on which a plot is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// Width and height, pixels.
    pub size: [f64; 2],
    /// Size of the font of labels, pixels.
    pub font: f64,
}

pub(super) const PAPER: Color = [255, 255, 255];
pub(super) const INK: Color = [34, 34, 34];
/// Estimated width of a character, in font sizes.
pub(super) const CHARACTER: f64 = 0.58;

/// Width of the stroke of rings, for a font of [`USUAL_FONT`].
const RING: f64 = 1.8;
/// Font size for which widths of strokes are given, pixels.
pub(super) const USUAL_FONT: f64 = 16.0;

/// The marks of a series through or at points on the page.
pub(super) fn strokes(class: &str, series: &Series, points: &[[f64; 2]], font: f64) -> Vec<Mark> {
    let mark = |shape| Mark::new(class, series.color, shape);
    let scale = font / USUAL_FONT;
    let line = |width: f64, dash: Option<f64>| {
        vec![mark(Shape::Line {
            points: points.to_vec(),
            width: width * scale,
            dash,
        })]
    };
    match series.stroke {
        Stroke::Solid(width) => line(width, None),
        Stroke::Dashed(width) => line(width, Some(width * 2.5 * scale)),
        Stroke::Dots(radius) => points
            .iter()
            .map(|center| {
                mark(Shape::Dot {
                    center: *center,
                    radius: radius * scale,
                })
            })
            .collect(),
        Stroke::Rings(radius) => points
            .iter()
            .map(|center| {
                mark(Shape::Ring {
                    center: *center,
                    radius: radius * scale,
                    width: RING * scale,
                })
            })
            .collect(),
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Rect {
    pub(super) corner: [f64; 2],
    pub(super) size: [f64; 2],
}

pub(super) fn label(class: &str, anchor: Anchor, text: Text) -> Mark {
    Mark::new(class, INK, Shape::Text(Text { anchor, ..text }))
}
