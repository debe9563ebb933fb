//! Text from the bytes of a file: UTF-8, and a name for what else they are.

/// What to do about a file that is none.
pub const SAVE_AS_UTF8: &str = "save the file as UTF-8";

/// Why bytes are no text that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TextError {
    /// UTF-16, by its byte order mark or the zero bytes of its letters.
    #[error("the file is UTF-16 text, not UTF-8")]
    Utf16,
    /// Zero bytes.
    #[error("the file is not text: line {line} has zero bytes")]
    Zeros {
        /// Which line, from 1.
        line: usize,
    },
    /// Bytes of some other encoding.
    #[error(
        "the file is not UTF-8 text: line {line} has the byte 0x{byte:02X}, which in Latin-1 is `{}`", char::from(*.byte)
    )]
    Other {
        /// Which line, from 1.
        line: usize,
        /// The first of those bytes.
        byte: u8,
    },
}

/// The text that the bytes of a file are.
///
/// # Errors
/// What they are instead.
pub fn text_of(bytes: Vec<u8>) -> Result<String, TextError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(TextError::Utf16);
    }
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        // Without a mark, every second byte of plain letters is zero.
        let start = &bytes[..bytes.len().min(64)];
        let zeros = |first| start.iter().skip(first).step_by(2).all(|byte| *byte == 0);
        let wide = start.len() > 1 && zeros(0) != zeros(1);
        return Err(if wide {
            TextError::Utf16
        } else {
            let line = line_of(&bytes[..at]);
            TextError::Zeros { line }
        });
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = line_of(&error.as_bytes()[..at]);
        let byte = error.as_bytes()[at];
        TextError::Other { line, byte }
    })
}

/// The line that comes after these bytes, from 1; lines end in LF, CR LF or CR.
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
