//! E. Lamps, mirrors, glass.

cases! {}
