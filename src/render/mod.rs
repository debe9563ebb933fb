//! The renderer on one page: frame, scene, trace, shade, film.
//!
//! In: a [`Frame`](crate::frame::Frame), its [`Scene`](crate::scene::Scene) and the bodies' trees.
//! Out: a [`Film`](crate::film::Film) ([`render`], [`render_together`] for frames that share a
//! trace), metered exposure, and the frame's files as bytes ([`encode`]).

mod band;
mod development;
mod encode;
mod expose;
mod lab_path;
mod left_out;
mod options;
mod paint;
mod prepared;
mod profile;
mod together;
mod view;

pub use development::{channels, development};
pub use encode::{InsetTooSmall, PictureInfo, Pictures, encode};
pub use lab_path::LabPath;
pub use left_out::{Enough, enough_bounces, left_out_warning};
pub(crate) use left_out::{deeper, least};
pub use options::{Member, Options, Stopped, Watch, film_bytes};
pub use prepared::{Metered, Prepared, ShotExposure, metered_exposure};
pub use profile::{Profile, Seconds};
pub use together::{Together, render, render_profiled, render_together};
pub use view::View;
