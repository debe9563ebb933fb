//! What is to be shown: panels, axes, curves and points.

use super::Axis;

/// An sRGB colour of eight bits.
pub type Color = [u8; 3];

/// What is to be shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Lines above everything; the first is the title.
    pub caption: Vec<String>,
    /// Panels, side by side, of equal width. The legend is of all their series.
    pub panels: Vec<Panel>,
}

/// Axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// A line above it; empty for none.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Parts of the background that have a colour, ascending and without gaps.
    pub tints: Vec<Tint>,
    /// Curves, the first lowermost.
    pub series: Vec<Series>,
    /// A remark in the middle.
    pub note: Option<String>,
}

/// A part of a panel's background.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// Where it begins and ends on the horizontal axis.
    pub range: [f64; 2],
    /// Its colour.
    pub color: Color,
}

/// A curve, or points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend, where a name stands once.
    pub name: String,
    /// Its colour.
    pub color: Color,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Values on both axes, in the order in which they are joined.
    pub points: Vec<[f64; 2]>,
    /// What is said of each dot, in the order of the points; empty to say nothing.
    pub remarks: Vec<Remark>,
}

impl Series {
    /// Whether its points are not joined.
    pub(super) fn is_dotted(&self) -> bool {
        matches!(self.stroke, Stroke::Dots(_) | Stroke::Rings(_))
    }
}

/// What is said of a dot.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// Stands beside it where there is room.
    pub label: String,
    /// Stands there instead where there is less.
    pub short: String,
    /// Is told by whoever shows the drawing when the dot is pointed at.
    pub tip: String,
}

/// How a series is drawn. Widths and radii are those of a font of 16 pixels, and scale with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stroke {
    /// A line of this width.
    Solid(f64),
    /// A broken line of this width.
    Dashed(f64),
    /// Dots of this radius, not joined.
    Dots(f64),
    /// Rings of this radius, not joined.
    Rings(f64),
}
