//! G. The program as a whole.

cases! {}
