//! A drawing: the marks of a plot on a page, to be written as SVG or painted.

use super::Color;

/// A plot as marks.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height, pixels.
    pub size: [f64; 2],
    /// Color of the page.
    pub paper: Color,
    /// Opacity of the page over what is below it, up to 1.
    pub opacity: f64,
    /// Title: one line on what the drawing shows.
    pub title: String,
    /// Marks in groups, drawn in this order.
    pub groups: Vec<Group>,
}

/// Marks that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// "caption", "legend", or "panel-1", "panel-2" and so on.
    pub id: String,
    /// Marks, drawn in this order.
    pub marks: Vec<Mark>,
}

/// One element of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// What the mark represents: "curve NAME", "x-label" and the like.
    pub class: String,
    /// Its color.
    pub color: Color,
    /// Its shape.
    pub shape: Shape,
    /// Tooltip, if it has one.
    pub tip: Option<String>,
}

impl Mark {
    /// A mark without a tooltip.
    pub(super) fn new(class: &str, color: Color, shape: Shape) -> Self {
        Self {
            class: class.to_owned(),
            color,
            shape,
            tip: None,
        }
    }
}

/// The shape of a mark, in pixels.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A filled rectangle.
    Rect {
        /// Upper left corner.
        corner: [f64; 2],
        /// Width and height.
        size: [f64; 2],
    },
    /// Straight lines between consecutive points.
    Line {
        /// The points.
        points: Vec<[f64; 2]>,
        /// Width of the stroke.
        width: f64,
        /// Length of dashes and gaps; None for a solid line.
        dash: Option<f64>,
    },
    /// A filled circle.
    Dot {
        /// Its center.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
    /// An unfilled circle.
    Ring {
        /// Its center.
        center: [f64; 2],
        /// Its radius, to the middle of the stroke.
        radius: f64,
        /// Width of the stroke.
        width: f64,
    },
    /// A line of text.
    Text(Text),
}

/// A line of text on the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// A point of its baseline, pixels.
    pub at: [f64; 2],
    /// The part of the text that is at that point.
    pub anchor: Anchor,
    /// Whether the text runs upward.
    pub upwards: bool,
    /// Size of the font, pixels.
    pub size: f64,
    /// Whether it is bold.
    pub bold: bool,
    /// The text.
    pub words: String,
}

impl Text {
    /// Text that begins at `at`.
    pub(super) fn new(at: [f64; 2], size: f64, words: &str) -> Self {
        Self {
            at,
            anchor: Anchor::Start,
            upwards: false,
            size,
            bold: false,
            words: words.to_owned(),
        }
    }
}

/// The part of a text that is at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}
