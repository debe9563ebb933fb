//! Data of a plot: panels, axes, curves and points.

use super::Axis;

/// An sRGB color of eight bits per channel.
pub type Color = [u8; 3];

/// A plot: caption and panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Lines above the panels; the first is the title.
    pub caption: Vec<String>,
    /// Panels side by side, of equal width. The legend lists the series of all of them.
    pub panels: Vec<Panel>,
}

/// Two axes, and the series between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Line above the panel; empty for none.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Colored parts of the background, ascending and without gaps.
    pub tints: Vec<Tint>,
    /// Series, drawn in this order.
    pub series: Vec<Series>,
    /// A note in the middle of the panel.
    pub note: Option<String>,
}

/// A colored part of a panel's background.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// Its beginning and end on the horizontal axis.
    pub range: [f64; 2],
    /// Its color.
    pub color: Color,
}

/// A curve, or a set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend. A name that occurs twice is listed once.
    pub name: String,
    /// Its color.
    pub color: Color,
    /// How the series is drawn.
    pub stroke: Stroke,
    /// Values on both axes, in the order in which they are connected.
    pub points: Vec<[f64; 2]>,
    /// Labels of the dots, in the order of the points; empty for none.
    pub remarks: Vec<Remark>,
}

impl Series {
    /// Whether the points are not connected.
    pub(super) fn is_dotted(&self) -> bool {
        matches!(self.stroke, Stroke::Dots(_) | Stroke::Rings(_))
    }
}

/// The label of a dot.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// Text beside the dot.
    pub label: String,
    /// Shorter text, used if there is no room for the other.
    pub short: String,
    /// Tooltip, shown by a viewer when the pointer is on the dot.
    pub tip: String,
}

/// Stroke of a series. Widths and radii are for a font of 16 pixels, and scale with the font.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stroke {
    /// A line of this width.
    Solid(f64),
    /// A dashed line of this width.
    Dashed(f64),
    /// Dots of this radius, not connected.
    Dots(f64),
    /// Rings of this radius, not connected.
    Rings(f64),
}
