//! The HTML overview of a shot's frames, `index.html` beside them.
//!
//! In: the frames of a folder, and their outcomes in a run. Out: one file that loads nothing: small
//! images of all frames are embedded as JPEG, drawings as SVG, and its script only moves what is
//! there. It links to the files beside it, and shows the full image of a frame if that can be read.
//! Without scripts it is a page of thumbnails and a table.
//!
//! Frames that exist or that a run was to make are shown one by one; long runs of others have one
//! line, so that two frames of a million make a page of two. Equal folders and equal runs give
//! equal bytes: its times are those of the manifests.

mod chart;
mod document;
mod frame_row;
mod head;
mod pictures;
mod table;
mod thumbnail;

pub use document::{is_fresh, write};
pub use frame_row::Outcomes;
