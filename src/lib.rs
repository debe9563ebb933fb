//! restframe: a batch renderer for scenes in which things move at nearly the speed of light.

pub mod film;
pub mod plan;
pub mod relativity;
pub mod scene;
pub mod shade;
pub mod shot;
pub mod spectrum;
pub mod trace;
