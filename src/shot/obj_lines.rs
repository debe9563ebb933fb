//! The lines of OBJ and MTL files, for whoever reads a model and whoever only hashes it.
//!
//! A line ends in LF, CR LF or CR alone. A byte order mark before a line is skipped: files are put
//! together from others. A backslash at the end of a line continues it, unless a comment has begun
//! or the next line begins with a keyword: then it is the last letter of a name.

use std::io::{self, BufRead};

/// Keywords of OBJ; a file that begins with something else and has no vertex is none.
pub const OBJ_KEYWORDS: [&str; 24] = [
    "v",
    "vt",
    "vn",
    "vp",
    "f",
    "l",
    "p",
    "o",
    "g",
    "s",
    "usemtl",
    "mtllib",
    "mg",
    "lod",
    "usemap",
    "maplib",
    "cstype",
    "deg",
    "curv",
    "curv2",
    "surf",
    "shadow_obj",
    "trace_obj",
    "call",
];

/// Keywords that numbers follow, of those that are read; names may follow the others.
const BEFORE_NUMBERS: [&str; 10] = ["v", "vn", "f", "Kd", "Ke", "d", "Tr", "Pm", "Pc", "Ps"];

/// Whether the bytes are text of two bytes a letter, with a byte order mark or without.
pub fn is_utf16(bytes: &[u8]) -> bool {
    matches!(
        bytes,
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] | [0, 1..=255, ..] | [1..=255, 0, ..]
    )
}

/// Keyword and rest of a line.
pub fn keyword_and_rest(line: &str) -> (&str, &str) {
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    (keyword, rest.trim())
}

/// What stands between a keyword and a comment.
///
/// Where numbers are due, `#` begins a comment but in `-1.#IND` and its like. In names it does so
/// at the front of a word: not in `Red#2`, nor before a digit, `Material #25`, nor where the name
/// begins with it, `#ff0000`.
pub fn before_comment<'a>(keyword: &str, rest: &'a str) -> &'a str {
    let are_numbers = BEFORE_NUMBERS.contains(&keyword);
    let begins = |&(at, _): &(usize, &str)| {
        let (before, after) = (&rest[..at], &rest[at + 1..]);
        if are_numbers {
            !(before.ends_with("1.") && after.starts_with(|c: char| c.is_ascii_alphabetic()))
        } else {
            let is_alone = after.is_empty() || after.starts_with(char::is_whitespace);
            let is_inside = !before.is_empty() && !after.starts_with(|c: char| c.is_ascii_digit());
            (before.is_empty() || before.ends_with(char::is_whitespace)) && (is_alone || is_inside)
        }
    };
    let comment = rest.match_indices('#').find(begins);
    comment.map_or(rest, |(at, _)| rest[..at].trim_end())
}

/// Calls `each` with every line, trimmed, and its number from 1.
///
/// # Errors
/// Outside, what the system says; inside, the first error of `each`.
pub fn each_line<E>(
    mut reader: impl BufRead,
    mut each: impl FnMut(usize, &str) -> Result<(), E>,
) -> io::Result<Result<(), E>> {
    let mut number = 0;
    let mut bytes = Vec::new();
    while reader.read_until(b'\n', &mut bytes)? > 0 {
        let ends = |b: &u8| matches!(b, b'\n' | b'\r');
        let length = bytes
            .iter()
            .rposition(|b| !ends(b))
            .map_or(0, |last| last + 1);
        for line in bytes[..length].split(|b| *b == b'\r') {
            number += 1;
            let line = String::from_utf8_lossy(line);
            if let Err(error) = each(number, line.trim_start_matches('\u{FEFF}').trim()) {
                return Ok(Err(error));
            }
        }
        bytes.clear();
    }
    Ok(Ok(()))
}

/// [`each_line`] of an OBJ file, those that a backslash continues put together; the number is that
/// of the last.
///
/// # Errors
/// As [`each_line`].
pub fn each_obj_line<E>(
    reader: impl BufRead,
    mut each: impl FnMut(usize, &str) -> Result<(), E>,
) -> io::Result<Result<(), E>> {
    let (mut begun, mut keyword, mut last) = (String::new(), String::new(), 0);
    let done = each_line(reader, |number, line| {
        if !begun.is_empty() && OBJ_KEYWORDS.contains(&keyword_and_rest(line).0) {
            each(last, uncontinued(&begun))?;
            begun.clear();
        }
        last = number;
        let is_first = begun.is_empty();
        let goes_on = line.ends_with('\\') && {
            // Of the first part that holds anything.
            if begun.len() < 2 {
                keyword.clear();
                keyword.push_str(keyword_and_rest(line).0.trim_end_matches('\\'));
            }
            !keyword.starts_with('#') && before_comment(&keyword, line) == line
        };
        if is_first && !goes_on {
            return each(number, line);
        }
        begun.pop();
        let parts_meet = !begun.is_empty() && !matches!(line, "" | "\\");
        begun.push_str(if parts_meet { " " } else { "" });
        begun.push_str(line);
        if !goes_on {
            each(number, &begun)?;
            begun.clear();
        }
        Ok(())
    })?;
    Ok(done.and_then(|()| match begun.as_str() {
        "" => Ok(()),
        begun => each(last, uncontinued(begun)),
    }))
}

/// A line that ends in a backslash and goes on nowhere: only a name keeps it.
fn uncontinued(line: &str) -> &str {
    let are_numbers = BEFORE_NUMBERS.contains(&keyword_and_rest(line).0);
    line.strip_suffix('\\')
        .filter(|_| are_numbers)
        .unwrap_or(line)
}
