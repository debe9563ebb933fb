//! The walk of a file's TOML tree against the JSON schema: every unknown key, wrong type, wrong word
//! and number out of range, in one pass.
//!
//! In: the tree with spans, the schema. Out: mistakes, and the tree as JSON without the mistaken
//! values, so that the checks that follow see the rest.

mod key_path;
mod keyframes;
mod node;
mod schema_walk;
mod value;

pub(super) use key_path::spans;
pub(super) use schema_walk::{MISSING, Walk};
