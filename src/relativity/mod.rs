//! Special relativity: events, celerities, boosts, light and worldlines. Plain numbers flow in and
//! out; the room imports no other.
//!
//! # Conventions
//! - c = 1: times are in metres of light travel, so an [`Event`] has four coordinates of one unit.
//! - Signature (−, +, +, +); a time coordinate is `t`, a proper time `tau`, the parameter along a
//!   ray `s`.
//! - The motion of a body is its [`Celerity`] u = γβ, the space part of its four-velocity. It is
//!   finite for every speed below c and keeps its digits near c, where β loses them.
//! - A direction of light `n` is its direction of *travel*, a unit vector, in the frame named.
//! - The Doppler factor is D = ω_observed / ω_source: above 1 is a blue shift, and the wavelength
//!   at the source is D · λ_observed.
//! - The axes of every rest frame come from those of the lab by a pure boost. A transform is named
//!   `to_from`: `rest_from_lab` takes lab coordinates and gives those of the rest frame.
//!
//! # Effects, formulas, sources
//! | effect | formula | where | source |
//! |---|---|---|---|
//! | time dilation, length contraction | t′ = γt − u·x, x′ = x + u((u·x)/(γ+1) − t) | [`Boost::event`] | Møller 1972 §2.4, with (γ−1)/β² written as γ²/(γ+1) |
//! | Doppler shift | 1/D = γ − u·n, u the source's celerity | [`Boost::light`] | Hsiung et al. 1990 eq. 1, n = −e |
//! | aberration | n′ = D (n⊥ + û(γ n∥ − u)) | [`Boost::light`] | Møller 1972 §2.11 |
//! | relative velocity | w = the space part of B(u) (γ_v, v) | [`Celerity::seen_from`] | Møller 1972 §2.7 |
//! | Wigner rotation | tan(ε/2) = \|u×v\| / (1 + γ_u + γ_v + γ_w) | [`Transform::between`] | Macfarlane 1962 |
//! | retardation | t_e = t − \|x − x_e\| in the source's rest frame | [`light_arriving`] | Møller 1972 §2.6 |
//!
//! # Precision
//! All numbers are f64. Differences that would cancel near the light cone are rewritten as sums (each
//! function says how), so results hold to a few ulp for every celerity from 1e-300 to 1e75.

mod boost;
mod celerity;
mod compensated;
mod four_vector;
mod light_cone;
mod worldline;

pub use boost::{Boost, SeenLight};
pub use celerity::{Celerity, CelerityError};
pub use four_vector::{Event, FourVector};
pub use light_cone::{Arrival, light_arriving};
pub use worldline::{Transform, Worldline};

pub(crate) use compensated::difference_of_products;
