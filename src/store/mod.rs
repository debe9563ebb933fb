//! The store: a shot's files on the disk, their names, and records of them.
//!
//! In: bytes of images and lines of manifests. Out: files that are complete or absent
//! ([`write_atomically`], [`AtomicFile`]), a line of the manifest for each finished frame
//! ([`Record`]), and whether a frame must be rendered ([`ShotFolder::status`]). Several processes
//! may work in one folder: a frame belongs to the one that holds its [`Claim`].
//!
//! Files in a folder may come from anyone: links, pipes and broken lines are ignored or refused.

mod atomic;
mod claim;
mod journal;
mod machine;
mod manifest;
mod names;
mod plain_file;
mod reason;
mod request;
mod shot_folder;
mod write_error;

pub use atomic::{AtomicFile, AtomicWriter, write_atomically};
pub use claim::{Claim, sweep};
pub use manifest::{FileRecord, Record, Seconds, read_records};
pub use names::{ASSEMBLED, Names, PAGE, SEQUENCE};
pub use request::Request;
pub use shot_folder::{FileStamps, FolderError, ShotFolder, Status};
pub use write_error::explain;

pub(crate) use atomic::check_writable;
pub(crate) use claim::refuse_link;
pub(crate) use journal::{Journal, each_line};
pub(crate) use machine::{forget_peak, free_memory_mib, host, now, peak_memory_mib};
pub(crate) use manifest::{Found, ManifestWriter};
pub(crate) use write_error::{is_full, twice};
