//! Words and names in messages: quoted, shortened, and with the name that was perhaps meant.

/// Number of characters of the author's text that a message repeats at most.
const MAX_QUOTED: usize = 60;
/// Number of names that are compared with a misspelled one.
const MAX_COMPARED: usize = 1000;
/// Number of names that a message lists if none is near.
const MAX_LISTED: usize = 16;
/// Jaro-Winkler similarity above which a name counts as perhaps meant.
const SIMILAR: f64 = 0.78;

/// The author's text, cut to a length that fits a message, with control characters escaped.
pub(super) fn short(text: &str) -> String {
    let mut cut: String = text.chars().take(MAX_QUOTED).flat_map(visible).collect();
    if text.chars().nth(MAX_QUOTED).is_some() {
        cut.push('…');
    }
    cut
}

fn visible(c: char) -> impl Iterator<Item = char> {
    let escaped = c.is_control().then(|| c.escape_default());
    let plain = (!c.is_control()).then_some(c);
    plain.into_iter().chain(escaped.into_iter().flatten())
}

/// The name among `known` that `word` was perhaps meant to be.
pub(super) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > MAX_QUOTED {
        return None;
    }
    let lower = word.to_lowercase();
    known
        .take(MAX_COMPARED)
        .map(|name| (strsim::jaro_winkler(&lower, &name.to_lowercase()), name))
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Remedy for an unknown name: "did you mean …?", or the names to choose from after `what`.
pub(super) fn did_you_mean<'a>(
    word: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    what: &str,
) -> Option<String> {
    if let Some(name) = nearest(word, known.clone()) {
        return Some(format!("did you mean {:?}?", short(name)));
    }
    let mut listed: Vec<String> = known
        .clone()
        .take(MAX_LISTED)
        .map(|name| format!("{:?}", short(name)))
        .collect();
    if known.clone().nth(MAX_LISTED).is_some() {
        listed.push("…".into());
    }
    (!listed.is_empty()).then(|| format!("{what}: {}", listed.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_finds_its_neighbour() {
        let known = ["velocity", "passes", "at"];
        assert_eq!(nearest("velocty", known.into_iter()), Some("velocity"));
        assert_eq!(nearest("Velocity", known.into_iter()), Some("velocity"));
        assert_eq!(nearest("mass", ["velocity", "at"].into_iter()), None);
    }

    #[test]
    fn long_text_is_cut_and_control_characters_are_escaped() {
        assert_eq!(short("a\u{1b}[31m"), "a\\u{1b}[31m");
        assert_eq!(short(&"x".repeat(1000)).chars().count(), MAX_QUOTED + 1);
    }
}
