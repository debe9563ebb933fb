//! Accuracy against time: one image rendered at many settings of one knob at a time, by the same
//! [`render`](crate::render) as everyone calls.
//!
//! In: a shot without mistakes. Out: a [`Study`].

pub mod displacement;
pub mod findings;
pub mod spheres;

pub use findings::Study;
