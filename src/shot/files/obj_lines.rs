//! The lines of OBJ and MTL files: continuation, keywords, comments.
//!
//! A backslash at the end of a line continues it, unless a comment has begun or the next line begins
//! with a keyword: then the backslash is the last letter of a name.

use crate::shot::text::each_line;
use std::io::{self, BufRead};

/// Keywords of OBJ. A file that begins with something else and has no vertex is not an OBJ file.
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

/// Those of the keywords read that are followed by numbers; others may be followed by names.
const BEFORE_NUMBERS: [&str; 10] = ["v", "vn", "f", "Kd", "Ke", "d", "Tr", "Pm", "Pc", "Ps"];

/// Keyword and remainder of a line.
pub fn keyword_and_rest(line: &str) -> (&str, &str) {
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    (keyword, rest.trim())
}

/// The part of `rest` before a comment.
///
/// Among numbers, `#` begins a comment, except in `-1.#IND` and the like. In names it does so only
/// at the front of a word: not in `Red#2`, nor before a digit (`Material #25`), nor at the beginning
/// of the name (`#ff0000`).
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

/// Calls `each` with every line of an OBJ file, like [`each_line`]. Lines continued by a backslash are
/// joined; their number is that of the last.
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
            // The keyword is in the first part that is not blank.
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

/// A line whose final backslash continues nothing: only a name keeps the backslash.
fn uncontinued(line: &str) -> &str {
    let are_numbers = BEFORE_NUMBERS.contains(&keyword_and_rest(line).0);
    line.strip_suffix('\\')
        .filter(|_| are_numbers)
        .unwrap_or(line)
}
