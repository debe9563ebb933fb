//! Single pixels: what the ray through a pixel's center sees, in numbers and as curves.
//!
//! In: a [`View`](crate::render::View) of a frame and its scene. Out: a [`Probe`] (events, Doppler
//! factors, radiance, color), and plots of its curves: a large one ([`plot`]) for
//! `restframe probe --plot`, and a compact one ([`inset`]) for the image itself.

mod inset;
mod pixel;
mod plot;

pub use inset::{inset, insets};
pub use pixel::{Probe, ProbeEvent, ProbeHit, ProbeNode, probe};
pub use plot::{WideBand, plot, wide_band};
