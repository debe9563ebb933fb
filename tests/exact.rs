//! Exact spectra: the quadrature against closed forms and against itself at twice the resolution,
//! and shade trees against sums over thousands of wavelengths.
mod integrals;
mod trees;
