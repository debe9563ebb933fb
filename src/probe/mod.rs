//! What the center of one pixel sees: event, Doppler factor, spectrum, color.

mod inset;
mod pixel;
mod plot;

pub use inset::{inset, insets};
pub use pixel::{Probe, ProbeEvent, ProbeHit, ProbeNode, probe};
pub use plot::{WideBand, plot, wide_band};
