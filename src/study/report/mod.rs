//! The report of a study as three texts: a page for people ([`html`]), a table for spreadsheets
//! ([`csv()`]) and everything for programs ([`json`]).
//!
//! The page is one file without scripts and without references to other files; its charts are
//! drawings within it, and it is well-formed XML as well as HTML. The table has one row for each
//! point of each sweep; effects, phases and the paper's results are in the page and the JSON only.
//! Equal studies give equal bytes.

mod advice;
mod chart;
mod costs;
mod head;
mod measure;
mod page;
mod settings;
mod spreadsheet;
mod sweep;

pub use page::{html, json};
pub use spreadsheet::csv;
