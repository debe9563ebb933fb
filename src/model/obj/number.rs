//! Numbers of OBJ and MTL files, with the spellings of NaN and infinity that programs use.

use crate::shot::before_comment;

/// The words between a keyword and a comment, each with its value; None if one is not a number.
pub(super) fn numbers<'a>(keyword: &str, rest: &'a str) -> Option<Vec<(&'a str, f64)>> {
    before_comment(keyword, rest)
        .split_whitespace()
        .map(|word| Some((word, number(word)?)))
        .collect()
}

/// A number, or a NaN or infinity as Rust, C, and the Windows runtime (`-1.#IND`, `-nan(ind)`)
/// print it.
fn number(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| {
        let bare = word.strip_prefix(['+', '-']).unwrap_or(word);
        let bare = bare.to_ascii_lowercase();
        let is_word =
            |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_alphanumeric());
        if let Some(kind) = bare.strip_prefix("1.#").filter(|kind| is_word(kind)) {
            let is_infinite = kind.starts_with("inf");
            return Some(if is_infinite { f64::INFINITY } else { f64::NAN });
        }
        let kind = bare.trim_start_matches(['q', 's']).strip_prefix("nan")?;
        let is_payload = kind.starts_with('(') && kind.ends_with(')');
        (matches!(kind, "" | "q" | "s") || is_payload).then_some(f64::NAN)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_known_in_every_spelling() {
        for word in [
            "nan",
            "NaN",
            "-nan",
            "+NAN",
            "-nan(ind)",
            "nan(snan)",
            "nan(0x8000000000000)",
            "-1.#IND",
            "1.#QNAN",
            "1.#SNAN",
            "1.#QNAN0",
            "-1.#IND00",
            "1.#R",
            "NaNQ",
            "NANS",
            "qnan",
            "-sNaN",
        ] {
            assert!(number(word).is_some_and(f64::is_nan), "{word}");
        }
        for word in ["inf", "-Infinity", "1.#INF", "-1.#INF00", "+INF"] {
            assert!(number(word).is_some_and(f64::is_infinite), "{word}");
        }
        for word in [
            "",
            "-",
            "nano",
            "nan(",
            "1.#",
            "1.#-",
            "1,5",
            "x",
            "1.0f",
            "information",
        ] {
            assert_eq!(number(word), None, "{word}");
        }
    }
}
