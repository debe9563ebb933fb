//! Plots: curves over axes, with ticks, a legend and a caption.
//!
//! In: a [`Plot`], plain data. [`lay_out`] places it on a page of any size as a [`Drawing`], a list
//! of rectangles, lines, dots and texts; [`svg`] writes that as text, and `raster` paints the text
//! as pixels. The caller chooses quantities and colors.
//!
//! Lengths on the page are in pixels, x to the right and y downward. Equal input gives equal bytes,
//! and every number written is finite.

mod axis;
mod compact;
mod data;
mod drawing;
mod layout;
mod legend;
mod marks;
mod panel;
mod point_labels;
mod polyline;
pub mod quantity;
pub mod raster;
mod svg;

pub use axis::{Axis, Scale, round_up, superscript};
pub use compact::{LEAST_INSET, lay_out_inset};
pub use data::{Color, Panel, Plot, Remark, Series, Stroke, Tint};
pub use drawing::{Anchor, Drawing, Group, Mark, Shape, Text};
pub use layout::lay_out;
pub use marks::Page;
pub use svg::{escaped, svg};

/// CSS of pages with text, tables and drawings.
pub const STYLE: &str = include_str!("page.css");
