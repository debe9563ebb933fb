//! Plots: curves over axes, with ticks, a legend and a caption.
//!
//! In: a [`Plot`], which is data alone. [`lay_out`] places it on a page of any size as a
//! [`Drawing`], a list of rectangles, lines, dots and texts; [`svg`] writes that down. Whoever
//! wants pixels paints the same list. What the axes measure, and in which colours, is the
//! caller's.
//!
//! Lengths on the page are pixels, x to the right and y downwards. Equal input gives equal bytes,
//! and every number that is written is finite.

mod axis;
mod data;
mod drawing;
mod heading;
mod inset;
mod layout;
mod line;
mod marks;
pub mod quantity;
pub mod raster;
mod remarks;
mod sheet;
mod svg;

pub use axis::{Axis, Scale, round_up, superscript};
pub use data::{Color, Panel, Plot, Remark, Series, Stroke, Tint};
pub use drawing::{Anchor, Drawing, Group, Mark, Shape, Text};
pub use inset::{LEAST_INSET, lay_out_inset};
pub use layout::lay_out;
pub use marks::Page;
pub use svg::{escaped, svg};

/// The look of a page of text, tables and drawings, CSS.
pub const STYLE: &str = include_str!("page.css");
