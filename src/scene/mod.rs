//! The scene of one image: bodies, lights, camera and background with everything resolved. No path,
//! option, default or name is left to look up.
//!
//! In: a [`Frame`](crate::frame::Frame), and the [`Library`] of the files that its shot names. Out: a
//! [`Scene`]. Positions are in the rest frame of each thing's worldline, in meters; angles are in
//! radians.

pub mod sky;

mod body;
mod bsdf;
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
pub use bsdf::{Bsdf, Lobe, LobeKind, WeightedSpectrum};
pub use camera::Camera;
pub use library::Library;
pub use light::{Light, LightShape};
pub use material::{Curve, Material, Thermal};
pub use projection::Projection;
pub use resolve::Scene;
pub use sky::Background;
