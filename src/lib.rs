//! restframe: a batch renderer for scenes in which things move at nearly the speed of light.
//!
//! # The rooms
//! ```text
//!  relativity   color ─> spectrum                                  leaves
//!      │                    │
//!  shot ─> model ─> frame ─> scene ─> accel ─> trace ─> shade ─> film     steps: values, one direction
//!                     │                                           │
//!                     └───────────── render, probe ───────────────┘
//!                                          │
//!                  image, plot             │                        images: plain values to files
//!                            ╲             │
//!                  store, progress ─> queue                         batch
//!                                          │
//!                             sequence, study, cli, main            callers
//! ```
//! A step is a function from plain input to plain output. Imports point only backwards along the
//! arrows, and no two files of a room import each other in a circle (`tests/layout.rs`). One sentence
//! for each room, with what always holds there:
//!
//! - [`relativity`]: events, boosts, light. No formula that cancels near the light cone.
//! - [`color`]: the CIE's tables, color spaces, color differences. Numbers alone.
//! - [`spectrum`]: curves over wavelength. Finite and non-negative at every wavelength above 0.
//! - [`shot`]: the TOML as its author wrote it. A [`shot::Shot`] has no mistake that its own text
//!   could show.
//! - [`model`]: OBJ and glTF files to plain values. Every index is checked, every number finite.
//! - [`frame`]: the shot at one frame. Every track is a number, every name resolved; which effects it
//!   needs and why; the fingerprint and the trace key that `store` and `queue` judge by. No mesh.
//! - [`scene`]: bodies, materials as lobes, lamps, camera, sky. Nothing is optional, relative or a name.
//! - [`accel`]: batches of rays to hits. Boxes, triangles and null lines; no material, no lamp.
//! - [`trace`]: camera rays to shade trees: geometry, visibility, Doppler factors. No spectrum.
//! - [`shade`]: shade trees to light. The only place where a Doppler factor meets a spectrum is
//!   [`shade::received`].
//! - [`film`]: sums of XYZ, or of bands; metering, exposure, development.
//! - [`render`] and [`probe`]: all of it on one page, for an image and for a pixel.
//! - [`image`] and [`plot`]: file formats written, read back and compared; drawings. Every number in a
//!   file is finite, and equal input gives equal bytes.
//! - [`store`]: files on the disk, their records and claims; whether a frame must be rendered. A file is
//!   complete or absent.
//! - [`progress`]: events of a run, and their sinks.
//! - [`queue`]: a run: which frames, in which batches, on how many machines. Images do not depend on it.
//! - [`sequence`]: finished frames verified, and assembled to sheets, animations, videos and a page.
//! - [`study`]: accuracy against time, by rendering the same image at many settings.
//! - [`cli`]: arguments, messages, exit codes.
//!
//! # Precision
//! Where it is needed and only there. What each claim rests on is in the doc of the item named.
//!
//! **f64**: celerities, events, boosts, directions, Doppler factors, ray parameters, triangles and
//! normals; spectra as authored, Planck's law, the weights of the sensor, sums over samples and over
//! the nodes of a shade tree. Speeds are held as u = γβ, which keeps its digits at any Lorentz
//! factor; β itself holds none beyond γ = 10⁸ ([`relativity::Celerity`]).
//!
//! **Compensated**, since their terms cancel: the cross products of motion and light (Kahan's
//! difference of products by fused multiply-add: without it the direction of light along the motion
//! is lost to γ²ε, with it to ε), relative celerities from the difference of two, and the edge
//! functions of triangles where their sign is in doubt (so that meshes leak nothing). All other
//! differences near the light cone are rewritten as sums ([`relativity::Boost`]).
//!
//! **f32**, each with its bound: boxes of the trees, in coordinates in which the tree fits the unit
//! sphere, widened by 2·10⁻⁶ of it (they decide what is tested, never what is hit); baked curves and
//! the sums over them (6·10⁻⁸ a value, shapes scaled to a peak of 1, so that only what is 10⁻³⁰ of
//! the peak is lost); colours of sky images; the film and its files (6·10⁻⁸; what is beyond is
//! clamped and counted).
//!
//! **What limits the rest**: coordinates. A worldline's origin that is rounded in the lab is off by
//! γε of its distance in its own frame, and a rounded direction by γε within 1/γ of the motion; so
//! links between frames are composed from relative celerities and never by way of the lab
//! ([`relativity::Transform`]). docs/hard-cases.md is the measured card of all this.

pub mod accel;
pub mod cli;
pub mod color;
pub mod film;
pub mod frame;
pub mod image;
pub mod model;
pub mod plot;
pub mod probe;
pub mod progress;
pub mod queue;
pub mod relativity;
pub mod render;
pub mod scene;
pub mod sequence;
pub mod shade;
pub mod shot;
pub mod spectrum;
pub mod store;
pub mod study;
pub mod trace;
