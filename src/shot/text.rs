//! Text from the bytes of a file: UTF-8 or a named error, and its lines. A line ends in LF, CR LF or
//! CR alone.

use std::io::{self, BufRead};

/// Remedy for a file that is not UTF-8 text.
pub const SAVE_AS_UTF8: &str = "save the file as UTF-8";

/// Reason why bytes cannot be read as text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TextError {
    /// UTF-16, recognized by [`is_utf16`].
    #[error("the file is UTF-16 text, not UTF-8")]
    Utf16,
    /// Zero bytes.
    #[error("the file is not text: line {line} has zero bytes")]
    Zeros {
        /// Line number, from 1.
        line: usize,
    },
    /// Bytes in some other encoding.
    #[error(
        "the file is not UTF-8 text: line {line} has the byte 0x{byte:02X}, which in Latin-1 is `{}`", char::from(*.byte)
    )]
    Other {
        /// Line number, from 1.
        line: usize,
        /// The first of those bytes.
        byte: u8,
    },
}

/// The bytes of a file as UTF-8 text.
///
/// # Errors
/// What the bytes are instead.
pub fn text_of(bytes: Vec<u8>) -> Result<String, TextError> {
    if is_utf16(&bytes) {
        return Err(TextError::Utf16);
    }
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        let line = line_of(&bytes[..at]);
        return Err(TextError::Zeros { line });
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = line_of(&error.as_bytes()[..at]);
        let byte = error.as_bytes()[at];
        TextError::Other { line, byte }
    })
}

/// Whether bytes are UTF-16 text: by the byte order mark or, without one, because one byte of the
/// first letter is zero and the other is not.
pub fn is_utf16(bytes: &[u8]) -> bool {
    matches!(
        bytes,
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] | [0, 1..=255, ..] | [1..=255, 0, ..]
    )
}

/// Calls `each` with the number, from 1, and the trimmed text of every line. Bytes that are not UTF-8
/// are replaced. A byte order mark at the front of any line is skipped: files are concatenated.
///
/// # Errors
/// The outer error is that of reading, the inner one the first of `each`.
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

/// The number, from 1, of the line in which the byte after `before` is.
fn line_of(before: &[u8]) -> usize {
    let ends = |i: &usize| match before[*i] {
        b'\n' => true,
        b'\r' => before.get(i + 1) != Some(&b'\n'),
        _ => false,
    };
    1 + (0..before.len()).filter(ends).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_16_is_named_with_and_without_a_mark() {
        let wide = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            text.encode_utf16().flat_map(bytes).collect()
        };
        for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
            for text in ["[image]\nsize = [1, 1]\n", "\u{feff}nm;R\n400;0,5\n"] {
                assert_eq!(text_of(wide(text, bytes)), Err(TextError::Utf16), "{text}");
            }
        }
    }

    #[test]
    fn other_bytes_are_told_by_line_and_letter() {
        for (bytes, line, byte) in [
            (&b"nm\n\xb5m"[..], 2, 0xb5),
            (b"a\rb\r\xb0", 3, 0xb0),
            (b"a\r\nb \xc5", 2, 0xc5),
        ] {
            let error = text_of(bytes.to_vec()).unwrap_err();
            assert_eq!(error, TextError::Other { line, byte });
        }
        let message = text_of(b"\xb5".to_vec()).unwrap_err().to_string();
        assert!(
            message.contains("line 1 has the byte 0xB5") && message.contains("`µ`"),
            "{message}"
        );
        assert_eq!(
            text_of(b"a\nb\0c".to_vec()),
            Err(TextError::Zeros { line: 2 })
        );
        assert_eq!(text_of(b"\xc2\xb5".to_vec()), Ok("µ".to_owned()));
    }
}
