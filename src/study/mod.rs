//! Accuracy against time: one image rendered at many settings of one knob at a time, by the same
//! [`render`](crate::render) as everyone calls.
//!
//! In: a shot without mistakes. Out: a [`Study`].

pub mod findings;
pub mod report;

pub use findings::Study;
