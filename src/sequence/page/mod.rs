//! The HTML overview of a shot's frames, `index.html` beside them.
//!
//! In: the frames of a folder, and what a run did about them. Out: one file that asks for nothing else:
//! small pictures of all frames stand in it as JPEG, drawings as SVG, and its script only moves what is
//! there. It links to what lies beside it, and shows the full picture of a frame where that can be
//! read. Without scripts it is a page of thumbnails and a table.
//!
//! Frames that are there or that a run was to make are shown one by one; long runs of others have a
//! line, so that two frames of a million make a page of two. Equal folders and equal runs give equal
//! bytes: the times on it are the manifests'.

mod chart;
mod document;
mod frame_row;
mod head;
mod pictures;
mod table;
mod thumbnail;

pub use document::{is_fresh, write};
pub use frame_row::Outcomes;
