//! Camera rays to shade trees: geometry, visibility and Doppler factors, no spectrum.
//!
//! In: a [`Scene`](crate::scene::Scene), the [`Aggregate`](crate::accel::Aggregate) of its bodies
//! ([`build_aggregate`]), the [`Spacetime`] of the image and the directions of some camera rays. Out:
//! [`ShadeTrees`], one for each ray, in flat arrays.
//!
//! Rays are traced in waves, so that bodies always meet batches of rays: camera rays, what they meet
//! over all worldlines, the shadow rays of all surfaces met, direct light; then one branch of each
//! tree, until none has any left.
//!
//! A camera ray is an event and a past-pointing null vector k whose frequency is 1 in the
//! camera's rest frame. Boosts are linear, so a point x + s·k has the same s in every rest frame:
//! hits on different worldlines compare by s alone, with no time test. In a body's frame |k| is
//! the frequency ratio, so s is the length there over that ratio, and 1 over it is the Doppler
//! factor.

mod branches;
mod clock;
mod direct;
mod growth;
mod interaction;
mod link;
mod nearest;
mod optics;
mod sampler;
mod secondary_ray;
mod spacetime;
mod tracer;
mod tree;
mod waves;

pub use clock::{Clock, Phase};
pub use link::{Link, boost_directions};
pub use sampler::{Samples, filter_offset};
pub use spacetime::Spacetime;
pub use tracer::{Tracer, build_aggregate};
pub use tree::{Branch, DirectLight, Node, Root, Seen, ShadeTrees, Surface};
pub use waves::Scratch;
