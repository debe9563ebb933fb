//! D. Geometry and visibility.

cases! {}
