//! C. Radiometry and spectra.

cases! {}
