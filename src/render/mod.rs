//! The renderer: from a scene to a film, and from a film to the bytes of image files.
//!
//! In: a [`Frame`](crate::frame::Frame), its [`Scene`](crate::scene::Scene) and the
//! [`Aggregate`](crate::accel::Aggregate) of its bodies. Out: a [`Film`](crate::film::Film)
//! ([`render`], or [`render_together`] for images that share a trace), and encoded files
//! ([`encode`]). [`Prepared`] reads a shot with its files. Rows are rendered in bands by all threads;
//! the bytes do not depend on their number.

mod band;
mod encode;
mod expose;
mod lab_path;
mod left_out;
mod meter;
mod options;
mod paint;
mod prepared;
mod profile;
mod render_image;
mod together;
mod view;
mod watch;

pub use encode::{PictureInfo, Pictures, encode};
pub use lab_path::LabPath;
pub use left_out::{Enough, enough_bounces, left_out_warning};
pub use meter::{Metered, metered_exposure};
pub use options::{Options, channels, development, film_bytes};
pub use prepared::{Exposing, Prepared};
pub use profile::{Profile, Seconds};
pub use render_image::{render, render_profiled};
pub use together::{Together, render_together};
pub use view::View;
pub use watch::{Member, Stopped, Watch};

pub(crate) use left_out::{deeper, least};
