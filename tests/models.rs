//! Model files against the numbers of the program that wrote them, and broken ones against reason.
//!
//! `tests/models/expected.json` holds Blender 4.5.15's own numbers of its evaluated scenes, not of
//! the files. Larger scenes are looked at where the folder `RESTFRAME_SCENES` names is at hand.

mod bad;
mod blender;
mod fuzz;
mod lenient;
mod no_material;
mod obj;
mod shapes;
