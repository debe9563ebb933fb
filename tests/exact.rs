//! Exact spectra: the quadrature against closed forms and against itself at twice the resolution,
//! and shade trees against sums over thousands of wavelengths.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

mod exact {
    pub(crate) mod integrals;
    pub(crate) mod trees;
}
