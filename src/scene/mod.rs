//! The scene of one image: bodies, lights, camera and background with everything resolved — no
//! path, option, default or name is left to look up. Positions are those of each thing's own
//! rest frame, in metres; angles are in radians.
//!
//! In: a [`Frame`](crate::frame::Frame), and the [`Library`] of the files that its shot names. Out: a
//! [`Scene`].

pub mod sky;

mod body;
mod camera;
mod library;
mod light;
mod material;
mod projection;
mod resolve;
mod spectra;
mod surfaces;

pub use crate::model::Mesh;
pub use body::{Geometry, Instance, SurfacePoint};
pub use camera::Camera;
pub use library::Library;
pub use light::{Light, LightShape};
pub use material::{Curve, Highlight, Material, Reflectance, Refraction, Thermal};
pub use projection::Projection;
pub use resolve::Scene;
pub use sky::Background;
