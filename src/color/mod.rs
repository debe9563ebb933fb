//! Color: the CIE's tables, color spaces, and differences of colors.
//!
//! In and out: plain numbers; wavelengths in nm, XYZ of whatever unit its caller scales it to. A leaf: imports
//! nothing of ours. Curves and what integrates them over these tables are in
//! [`spectrum`](crate::spectrum).

pub mod cie;
mod difference;
pub mod spaces;
pub(crate) mod tables;

pub use difference::{Lab, delta_e_2000, lab_from_xyz};
