//! From the text of a shot file to a [`Shot`](super::Shot), or to all of its mistakes at once.
//!
//! Three steps: TOML to a tree with the span of every value; the walk of that tree against the JSON
//! schema (`walk/`), which finds what is wrong with single keys; and the checks that involve more
//! than one key, the author's names or the disk (`check/`).

mod check;
mod diagnostics;
mod file_names;
mod mistake;
mod parse;
mod schema;
mod unsupported;
mod walk;

pub use check::{ILLUMINANTS, MAX_INSTANCES};
pub use mistake::{Mistake, Mistakes, Places};
pub use parse::{MAX_BYTES, load, parse};
pub use schema::schema;

pub(super) use file_names::with_slashes;
