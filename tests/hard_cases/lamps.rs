//! E. Lamps and shadows.

cases! {}
