//! How far the grid of wavelengths is from exact spectra, by eye: a thousand random shadings, and
//! the plates. Exact is `accuracy.spectra = "exact"`, which tests/exact.rs checks by itself.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

mod accuracy {
    pub(crate) mod plates;
    pub(crate) mod random;
    pub(crate) mod shadings;
}
