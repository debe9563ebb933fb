//! Color: tables of the CIE, color spaces, and color differences.
//!
//! In and out: plain numbers; wavelengths in nm, XYZ in any unit that the caller chooses. The room
//! imports no other. Curves, and integrals of curves over these tables, are in
//! [`spectrum`](crate::spectrum).

pub mod cie;
mod difference;
mod gamut;
pub mod spaces;
pub(crate) mod tables;

pub use difference::{Lab, delta_e_2000, lab_from_xyz};
pub use gamut::compressed;
