//! A drawing: what a plot looks like, for whoever writes or paints it.

use super::Color;

/// A plot as marks.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height, pixels.
    pub size: [f64; 2],
    /// Colour of the page.
    pub paper: Color,
    /// How far the page hides what it is laid on, up to 1.
    pub opacity: f64,
    /// What it shows, in a line.
    pub title: String,
    /// Marks, the first lowermost.
    pub groups: Vec<Group>,
}

/// Marks that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// "caption", "legend" or, counted from 1, "panel-1" and so on.
    pub id: String,
    /// The first is lowermost.
    pub marks: Vec<Mark>,
}

/// One thing to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// What it stands for: "curve NAME", "x-label" and the like.
    pub class: String,
    /// Its colour.
    pub color: Color,
    /// Its shape.
    pub shape: Shape,
    /// What is told when it is pointed at.
    pub tip: Option<String>,
}

impl Mark {
    /// A mark of which nothing is told.
    pub(super) fn new(class: &str, color: Color, shape: Shape) -> Self {
        Self {
            class: class.to_owned(),
            color,
            shape,
            tip: None,
        }
    }
}

/// The shape of a mark, pixels.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A filled rectangle.
    Rect {
        /// Upper left corner.
        corner: [f64; 2],
        /// Width and height.
        size: [f64; 2],
    },
    /// Straight lines from point to point.
    Line {
        /// The points.
        points: Vec<[f64; 2]>,
        /// Width of the stroke.
        width: f64,
        /// Length of dashes and gaps, if it is broken.
        dash: Option<f64>,
    },
    /// A filled circle.
    Dot {
        /// Its center.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
    /// A circle.
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
    /// A point of its base line, pixels.
    pub at: [f64; 2],
    /// Which part of the text is there.
    pub anchor: Anchor,
    /// Whether it runs upwards.
    pub upwards: bool,
    /// Size of the font, pixels.
    pub size: f64,
    /// Whether it is bold.
    pub bold: bool,
    /// What it says.
    pub words: String,
}

impl Text {
    /// Text that begins at a point.
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

/// Which part of a text is at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}
