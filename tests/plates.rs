//! The twelve plates, each claim of the paper about them by name, on thumbnails of 160 × 90.
//!
//! A thumbnail is the picture as `restframe render --scale 0.125 --samples 4` writes it, and what
//! the centre of each of its pixels sees, as `restframe probe` tells it. Colors are judged where a
//! pixel and its neighbors see one material under nearly one Doppler factor, so that edges do not
//! mix into them. D is ω_observed/ω_source; hues are those of the 8-bit picture in degrees.

mod animations;
mod array;
mod lattice;
mod rows;
mod thumbnail;
