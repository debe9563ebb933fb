//! restframe: a batch renderer for scenes in which things move at nearly the speed of light.
//!
//! # The house
//! ```text
//!             relativity      spectrum                       leaves: import nothing of ours
//!                  \             /
//!  shot ──> plan ──> scene ──> trace ──> shade ──> film      steps: values, one direction
//!             │                                     │
//!             └────────── render, probe ────────────┘
//!                               │
//!                             queue                          caller
//!                               │
//!                           cli, main
//! ```
//! A step is a function from plain input to plain output, and imports point only up this list
//! (`tests/layout.rs` checks them). One sentence a room, with what always holds there:
//!
//! - [`relativity`]: events, boosts, light. No formula that cancels near the light cone.
//! - [`spectrum`]: curves over wavelength. Finite and non-negative at every wavelength above 0.
//! - [`shot`]: the TOML as its author wrote it. A [`shot::Shot`] that exists has no mistake that
//!   its own text could show.
//! - [`plan`]: the effects that an image calls for. No mesh, no pixel.
//! - [`scene`]: one image's bodies, lamps and camera. Nothing is optional, relative or a name.
//! - [`trace`]: nearest hits over all worldlines, and shade trees. No spectrum.
//! - [`shade`]: shade trees to light. The only place where a Doppler factor meets a spectrum is
//!   [`shade::received`].
//! - [`film`]: sums of XYZ, or of bands, to pictures. Every number in a file is finite.
//! - [`render`] and [`probe`]: all of it on one page, for an image and for a pixel.
//! - [`queue`]: the images of a night, each whole or absent.
//! - [`cli`]: arguments, messages, exit codes.
//!
//! # Precision
//! Events, boosts, Doppler factors, ray parameters and triangles are f64. Only box tests are f32,
//! on boxes widened by a bound of their rounding ([`trace`]). Spectra are authored in f64 and
//! baked in f32 with a stated bound; sums are f64; a film holds f32.

pub mod cli;
pub mod film;
pub mod plan;
pub mod probe;
pub mod queue;
pub mod relativity;
pub mod render;
pub mod scene;
pub mod shade;
pub mod shot;
pub mod spectrum;
pub mod trace;
