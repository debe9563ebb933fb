//! B. Doppler factor and aberration.

cases! {}
