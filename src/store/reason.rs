//! Reasons in words: the differences between the inputs of a frame as rendered and as they are now.

use crate::frame::FrameFingerprint;
use indexmap::IndexMap;

type Parts = IndexMap<String, String>;

/// Number of differences that are listed one by one.
const TOLD: usize = 3;
/// The input that changes with the renderer.
const EPOCH: &str = "epoch";

/// Continues "stale because ". `version` is that of the program which made the frame of `was`.
pub(super) fn difference(was: &Parts, key: &FrameFingerprint, version: &str) -> String {
    let is = &key.inputs;
    if was.get(EPOCH) != is.get(EPOCH) {
        return format!("it is by restframe {version}, and pixels have changed since");
    }
    let changed = is.iter().filter_map(|(name, value)| match was.get(name) {
        Some(old) if old == value => None,
        Some(old) if is_hash(old) || is_hash(value) => Some(format!("{name} changed")),
        Some(old) => Some(format!("{name} is {value}, was {old}")),
        None if is_hash(value) => Some(format!("{name} is new")),
        None => Some(format!("{name} is {value}, was not given")),
    });
    let gone = was.iter().filter(|(name, _)| !is.contains_key(*name));
    let gone = gone.map(|(name, old)| match is_hash(old) {
        true => format!("{name} is gone"),
        false => format!("{name} is not given, was {old}"),
    });
    let all: Vec<String> = changed.chain(gone).collect();
    match all.len() {
        // The inputs are equal, so that the method of the fingerprint has changed.
        0 => "its fingerprint is of another kind".to_owned(),
        n if n > TOLD => format!("{} and {} more", all[..TOLD].join(", "), n - TOLD),
        _ => all.join(", "),
    }
}

/// Whether an input is shown as a hash, which says nothing to a reader: `#` and hexadecimal digits,
/// or at least sixteen of them alone.
fn is_hash(value: &str) -> bool {
    const SHORTEST: usize = 16;
    let value = value.trim_matches('"');
    let digits = value.strip_prefix('#').unwrap_or(value);
    digits.len() >= SHORTEST && digits.bytes().all(|byte| byte.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(list: &[(&str, &str)]) -> Parts {
        let owned = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
        list.iter().map(owned).collect()
    }

    fn told(was: &[(&str, &str)], is: &[(&str, &str)]) -> String {
        let key = FrameFingerprint {
            fingerprint: String::new(),
            inputs: parts(is),
            trace: String::new(),
        };
        difference(&parts(was), &key, "0.1.0")
    }

    #[test]
    fn values_are_quoted_and_hashes_are_not() {
        let hash = |last: &str| format!("#0123456789abcde{last}");
        assert_eq!(
            told(
                &[("camera.pan", "12"), ("rest", "1")],
                &[("camera.pan", "12.5"), ("rest", "1")]
            ),
            "camera.pan is 12.5, was 12"
        );
        assert_eq!(
            told(&[("a.obj", &hash("1"))], &[("a.obj", &hash("2"))]),
            "a.obj changed"
        );
        assert_eq!(
            told(&[("spectrum", "1")], &[("spectrum", &hash("2"))]),
            "spectrum changed"
        );
        assert_eq!(
            told(&[], &[("a.obj", &hash("1")), ("image.filter", "\"box\"")]),
            "a.obj is new, image.filter is \"box\", was not given"
        );
        assert_eq!(
            told(&[("a.obj", &hash("1")), ("camera.tilt", "3")], &[]),
            "a.obj is gone, camera.tilt is not given, was 3"
        );
    }

    #[test]
    fn of_many_differences_three_are_told_and_the_rest_counted() {
        let keys = ["a", "b", "c", "d", "e"];
        let was: Vec<_> = keys.iter().map(|key| (*key, "1")).collect();
        let is: Vec<_> = keys.iter().map(|key| (*key, "2")).collect();
        assert_eq!(
            told(&was, &is),
            "a is 2, was 1, b is 2, was 1, c is 2, was 1 and 2 more"
        );
        assert_eq!(
            told(&was[..3], &is[..3]),
            "a is 2, was 1, b is 2, was 1, c is 2, was 1"
        );
    }

    #[test]
    fn a_new_renderer_is_the_only_reason_told() {
        assert_eq!(
            told(&[("epoch", "1"), ("a", "1")], &[("epoch", "2"), ("a", "2")]),
            "it is by restframe 0.1.0, and pixels have changed since"
        );
    }
}
