//! Model files against the numbers of the program that wrote them, and broken ones against reason.
//!
//! `tests/models/expected.json` holds Blender 4.5.15's own numbers of its evaluated scenes, not of
//! the files. Larger scenes are looked at where the folder `RESTFRAME_SCENES` names is at hand.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

mod models {
    pub(crate) mod bad;
    pub(crate) mod blender;
    pub(crate) mod fuzz;
    pub(crate) mod lenient;
    pub(crate) mod no_material;
    pub(crate) mod obj;
    pub(crate) mod shapes;
}
