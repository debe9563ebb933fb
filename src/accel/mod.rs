//! Nearest hits and occlusion among bodies that rest in their worldlines' frames.
//!
//! In: meshes and where their [`Instance`]s rest, once an image; then batches of rays
//! ([`RayBatch`]) in the rest frame of one worldline. Out: a [`Hit`] or nothing for each ray, or
//! whether something stands on its way. This room knows boxes, triangles and null lines: no
//! material, no lamp and no second reference frame.
//!
//! Three levels: an [`Aggregate`] of worldlines, for each worldline a tree over its instances, and
//! for each mesh a tree over its triangles, which its instances share. Events, rays and triangles
//! are f64; only boxes are tested in f32, widened so that they never miss what f64 would hit.

mod aggregate;
mod bounding_sphere;
mod bvh;
mod instance;
mod instance_bvh;
mod mesh_bvh;
mod ray;
mod triangle;

pub use aggregate::Aggregate;
pub use instance::Instance;
pub use ray::{Hit, Ray, RayBatch, every_instance};
