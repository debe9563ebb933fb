//! Measured curves from CSV files: the table, its heading and units, its faults.
//!
//! In: the text of a file. Out: a [`Measured`] curve with its warnings, or one [`TableError`].

mod fault;
mod heading;
mod measured;
mod table;
mod unit;

pub use fault::{NOISE, TableError, TableWarning};
pub use measured::Measured;
pub use table::Table;
pub use unit::Unit;
