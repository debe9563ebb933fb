//! Journals: files of JSON lines that are appended and never rewritten.
//!
//! A line is complete or absent, whatever else appends and however the run ends: a killed run loses
//! at most the line that it was writing, and the next line does not continue it.

use super::claim::knows_no_locks;
use super::plain_file::open_plain;
use super::write_error::explain;
use serde::Serialize;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Length of the longest line that is read, bytes. Ours have a few KiB.
const LONGEST_LINE: u64 = 1 << 20;

/// Bytes at the end of a journal that [`each_last_line`] reads: some thousand lines.
const TAIL: u64 = 1 << 20;

/// A journal to append to, created with its first line.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    /// The first line of a new journal, if it has one.
    opening: Option<String>,
}

impl Journal {
    /// The journal at `path`, which begins with the line `opening` if there is one.
    pub(crate) fn new(path: PathBuf, opening: Option<String>) -> Self {
        Self { path, opening }
    }

    /// Appends a line for each entry and flushes them to the disk; without entries, creates the
    /// file.
    ///
    /// # Errors
    /// Of the kind that the system reported, with the path and a remedy; the journal then contains
    /// no part of the lines, if the system can truncate it.
    pub(crate) fn append<T: Serialize>(&self, entries: &[T]) -> io::Result<()> {
        let lines = entries.iter().map(serde_json::to_string);
        let lines = lines.collect::<Result<Vec<_>, _>>()?;
        self.append_lines(&lines)
            .map_err(|error| explain(&self.path, &error))
    }

    fn append_lines(&self, lines: &[String]) -> io::Result<()> {
        let mut options = OpenOptions::new();
        options.read(true).append(true).create(true);
        let mut file = open_plain(&self.path, &options)?;
        match file.lock() {
            Err(error) if !knows_no_locks(&error) => return Err(error),
            _ => {}
        }
        let length = file.seek(SeekFrom::End(0))?;
        let mut text = match length {
            0 => self
                .opening
                .as_ref()
                .map_or_else(String::new, |line| format!("{line}\n")),
            _ if ends_a_line(&mut file)? => String::new(),
            // A killed run left an incomplete line.
            _ => "\n".to_owned(),
        };
        for line in lines {
            text.push_str(line);
            text.push('\n');
        }
        if text.is_empty() {
            return Ok(());
        }
        let written = file
            .write_all(text.as_bytes())
            .and_then(|()| file.sync_all());
        if written.is_err() {
            // The first error is the one to report.
            let _ = file.set_len(length);
        }
        written
    }
}

fn ends_a_line(file: &mut File) -> io::Result<bool> {
    let mut last = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut last)?;
    Ok(last == *b"\n")
}

/// Calls `each` with the lines of the journal at `path`.
///
/// # Errors
/// A file that does not exist, is not a plain file, or cannot be read.
pub(crate) fn each_line(path: &Path, each: impl FnMut(&[u8])) -> io::Result<()> {
    let file = open_plain(path, OpenOptions::new().read(true))?;
    lines_of(BufReader::new(file), each)
}

/// Calls `each` with the lines in the last MiB of the journal at `path`: of a journal of which old
/// lines do not matter, however long it has become. A line that begins before is passed over.
///
/// # Errors
/// As [`each_line`].
pub(crate) fn each_last_line(path: &Path, each: impl FnMut(&[u8])) -> io::Result<()> {
    let mut file = open_plain(path, OpenOptions::new().read(true))?;
    let length = file.metadata()?.len();
    let mut tail = BufReader::new(&mut file);
    if let Some(start) = length.checked_sub(TAIL).filter(|start| *start > 0) {
        // From the byte before, which may end a line.
        tail.seek(SeekFrom::Start(start - 1))?;
        tail.skip_until(b'\n')?;
    }
    lines_of(tail, each)
}

/// Journals may come from anyone: a line longer than any of ours is skipped, and takes no memory.
fn lines_of(mut journal: impl BufRead, mut each: impl FnMut(&[u8])) -> io::Result<()> {
    let mut line = Vec::new();
    loop {
        line.clear();
        let mut start = journal.by_ref().take(LONGEST_LINE);
        let length = start.read_until(b'\n', &mut line)?;
        match line.last() {
            None => return Ok(()),
            Some(b'\n') => each(&line),
            Some(_) if length as u64 == LONGEST_LINE => {
                journal.skip_until(b'\n')?;
            }
            Some(_) => each(&line),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_told_one_by_one_and_those_longer_than_any_of_ours_are_not() {
        let longest = LONGEST_LINE as usize;
        let fits = "f".repeat(longest - 1);
        let text = format!(
            "first\n\n{fits}\n{}\n{}\nlast",
            "t".repeat(longest),
            "u".repeat(3 * longest)
        );
        let mut lines = Vec::new();
        lines_of(text.as_bytes(), |line| {
            lines.push(line.trim_ascii().to_vec())
        })
        .expect("in memory");
        assert_eq!(lines, [&b"first"[..], b"", fits.as_bytes(), b"last"]);
    }

    #[test]
    fn of_a_long_journal_the_last_lines_are_told_whole() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("a.jsonl");
        let told = |length: usize| {
            // Lines of eight bytes.
            let text: String = (0..length).map(|i| format!("{i:07}\n")).collect();
            std::fs::write(&path, text).expect("writable");
            let mut lines: Vec<String> = Vec::new();
            let each = |line: &[u8]| lines.push(String::from_utf8_lossy(line).into_owned());
            each_last_line(&path, each).expect("readable");
            assert!(lines.iter().all(|line| line.len() == 8));
            [lines.len().to_string(), lines[0].clone()]
        };
        let fits = TAIL as usize / 8;
        assert_eq!(told(3), ["3".to_owned(), "0000000\n".to_owned()]);
        assert_eq!(told(fits), [fits.to_string(), "0000000\n".to_owned()]);
        assert_eq!(told(fits + 5), [fits.to_string(), "0000005\n".to_owned()]);
    }
}
