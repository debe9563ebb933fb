//! How far the grid of wavelengths is from exact spectra, by eye: a thousand random shadings, and
//! the plates. Exact is `accuracy.spectra = "exact"`, which tests/exact.rs checks by itself.
mod plates;
mod random;
mod shadings;
