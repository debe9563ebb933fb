//! The steps from a shot file to a [`Shot`], or to all of its mistakes at once.
//!
//! If the TOML itself is broken, syntax errors are reported together with the mistakes on other
//! lines. Missing keys are not reported then: they may be on the broken lines.

use super::check::check;
use super::file_names;
use super::mistake::{Mistake, Mistakes, Places};
use super::walk::{MISSING, Walk, spans};
use crate::shot::Shot;
use crate::shot::text::{SAVE_AS_UTF8, text_of};
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;
use toml::de::DeTable;

/// Size of the largest shot file that is read, in bytes.
pub const MAX_BYTES: u64 = 4 << 20;

/// Reads and checks a shot file.
///
/// # Errors
/// All mistakes in the file, or the one reason why it cannot be read.
///
/// # Example
/// ```
/// use restframe::shot;
/// use std::path::Path;
///
/// let shot = shot::load(Path::new("shots/plate-08.toml"))?;
/// assert_eq!(shot.image.size, [1280, 720]);
/// # Ok::<(), shot::Mistakes>(())
/// ```
pub fn load(path: &Path) -> Result<Shot, Mistakes> {
    if let Some(stem @ ("." | "..")) = path.file_stem().and_then(OsStr::to_str) {
        let message =
            format!("images and their folder are called after the file, and {stem:?} is no name");
        return Err(Mistakes::unreadable(
            path,
            message,
            Some("rename the file".into()),
        ));
    }
    let bytes = read(path).map_err(|error| unreadable(path, &error))?;
    if bytes.len() as u64 > MAX_BYTES {
        let message = format!(
            "the file is larger than {} MiB, the most a shot may have",
            MAX_BYTES >> 20
        );
        let help = "is this a shot? meshes and images stand in files of their own".to_owned();
        return Err(Mistakes::unreadable(path, message, Some(help)));
    }
    let source = text_of(bytes).map_err(|error| {
        Mistakes::unreadable(path, error.to_string(), Some(SAVE_AS_UTF8.to_owned()))
    })?;
    if source.contains('\r') && !source.contains('\n') {
        let message = "its lines end in CR alone, which TOML does not know".to_owned();
        let help = "save the file with LF or CR LF at the ends of lines".to_owned();
        return Err(Mistakes::unreadable(path, message, Some(help)));
    }
    parse(&source, path)
}

/// The bytes of the file, at most one more than [`MAX_BYTES`].
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let mut bytes = Vec::new();
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn unreadable(path: &Path, error: &io::Error) -> Mistakes {
    let (message, help) = match error.kind() {
        io::ErrorKind::NotFound => ("there is no such file".to_owned(), None),
        io::ErrorKind::IsADirectory => (
            "this is a folder".to_owned(),
            Some("name the shot file in it".to_owned()),
        ),
        _ => (format!("the file cannot be read: {error}"), None),
    };
    Mistakes::unreadable(path, message, help)
}

/// Reads and checks the text of a shot. Files that it names are relative to the folder of `path`,
/// which itself need not exist.
///
/// # Errors
/// All mistakes in the text.
///
/// # Example
/// ```
/// use restframe::shot;
/// use std::path::Path;
///
/// let text = "[worldline.fast]\nvelocity = [1.5, 0, 0]\n\
///     [[model]]\nfile = \"assets/sphere.obj\"\nwordline = \"fast\"\n[camera]\n";
/// let mistakes = shot::parse(text, Path::new("quick.toml")).unwrap_err();
/// let keys: Vec<&str> = mistakes.iter().map(|mistake| mistake.key.as_str()).collect();
/// assert_eq!(keys, ["worldline.fast.velocity", "model[0].wordline"]);
/// println!("{mistakes}"); // each with its line, and "did you mean \"worldline\"?"
/// ```
pub fn parse(source: &str, path: &Path) -> Result<Shot, Mistakes> {
    let (tree, errors) = DeTable::parse_recoverable(source);
    let places = Places::new(path, source, || spans(tree.get_ref()));
    let (value, walk) = Walk::shot(tree.get_ref(), &places);
    if !errors.is_empty() {
        let syntax = errors
            .iter()
            .map(|error| syntax_mistake(error, source))
            .collect();
        return Err(Mistakes::new(
            &places,
            with_structure(syntax, walk.mistakes, source),
        ));
    }
    match serde_json::from_value::<Shot>(value) {
        Ok(mut shot) => {
            path.clone_into(&mut shot.path);
            shot.places = places.clone();
            shot.normalize_file_names();
            let mistakes = check(&shot, walk);
            if mistakes.is_empty() {
                Ok(shot)
            } else {
                Err(Mistakes::new(&places, mistakes))
            }
        }
        Err(_) if !walk.mistakes.is_empty() => Err(Mistakes::new(&places, walk.mistakes)),
        Err(error) => {
            let mistake = places.mistake("", format!("the shot cannot be read: {error}"), None);
            Err(Mistakes::new(&places, vec![mistake]))
        }
    }
}

fn syntax_mistake(error: &toml::de::Error, source: &str) -> Mistake {
    Mistake {
        key: String::new(),
        span: error.span().filter(|span| span.start <= source.len()),
        message: error.message().lines().collect::<Vec<_>>().join(", "),
        label: String::new(),
        help: escape_help(error, source),
    }
}

/// Remedy for a path with `\` in double quotes, if that is the cause of the syntax error.
fn escape_help(error: &toml::de::Error, source: &str) -> Option<String> {
    const OF_ESCAPES: [&str; 3] = [
        "missing escaped value",
        "too few unicode value digits",
        "invalid value, expected unicode",
    ];
    let span = error.span()?;
    let is_path = source.get(whole_lines(&span, source))?.contains('\\');
    let message = error.message().lines().collect::<Vec<_>>().join(", ");
    let of_escape = OF_ESCAPES.iter().any(|begin| message.starts_with(begin));
    (is_path && of_escape).then(|| file_names::ESCAPES.to_owned())
}

/// Syntax errors, and those other mistakes that cannot be a consequence of them.
fn with_structure(mut syntax: Vec<Mistake>, others: Vec<Mistake>, source: &str) -> Vec<Mistake> {
    let broken: Vec<Range<usize>> = syntax
        .iter()
        .filter_map(|mistake| mistake.span.as_ref())
        .map(|span| whole_lines(span, source))
        .collect();
    let apart = |span: &Range<usize>| {
        let lines = whole_lines(span, source);
        span.end > span.start
            && broken
                .iter()
                .all(|broken| lines.end <= broken.start || broken.end <= lines.start)
    };
    let needed = |mistake: &Mistake| mistake.label == MISSING;
    syntax.extend(
        others
            .into_iter()
            .filter(|m| !needed(m) && m.span.as_ref().is_some_and(apart)),
    );
    syntax
}

/// The span extended to whole lines.
fn whole_lines(span: &Range<usize>, source: &str) -> Range<usize> {
    let bytes = source.as_bytes();
    let before = &bytes[..span.start.min(bytes.len())];
    let start = before
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |at| at + 1);
    let last = span.end.min(bytes.len());
    let end = bytes[last..]
        .iter()
        .position(|byte| *byte == b'\n')
        .map_or(bytes.len(), |at| last + at);
    start..end
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::{Exposure, Format, Track, Velocity};

    const SHOT: &str = "[worldline.zeta]\nvelocity = { gamma = 3, direction = [1, 0, 0] }\n\
        [worldline.alpha]\nvelocity = { from = [0, 0, 0], to = [0.5, 0, 0] }\n\
        [[model]]\nfile = \"tests/bad-shots/models/ball.obj\"\n[camera]\n";

    #[test]
    fn what_the_author_left_out_has_its_default() {
        let shot = parse(SHOT, Path::new("a.toml")).unwrap();
        assert_eq!(
            (shot.shot.frames, shot.shot.fps, shot.shot.light_speed),
            (1, 24.0, 1.0)
        );
        assert_eq!((shot.image.size, shot.image.samples), ([1280, 720], 16));
        assert_eq!((shot.effects.bounces, shot.accuracy.wavelengths), (8, 84));
        assert_eq!(shot.output.formats, [Format::Png]);
        assert!(matches!(shot.sensor.exposure, Exposure::Auto(_)));
        assert_eq!(shot.worldline["alpha"].at, Track::Constant(0.0));
    }

    #[test]
    fn worldlines_keep_their_author_s_order_and_measure() {
        let shot = parse(SHOT, Path::new("a.toml")).unwrap();
        assert_eq!(shot.worldline.keys().collect::<Vec<_>>(), ["zeta", "alpha"]);
        assert!(matches!(
            shot.worldline["zeta"].velocity,
            Velocity::Gamma(_)
        ));
        assert!(matches!(
            shot.worldline["alpha"].velocity,
            Velocity::Beta(Track::Ramp { .. })
        ));
    }

    #[test]
    fn a_later_check_can_mark_a_key_or_what_holds_it() {
        let shot = parse(SHOT, Path::new("a.toml")).unwrap();
        let marked = |key| {
            let span = shot.places.mistake(key, "the mesh is empty", None).span;
            SHOT.get(span.unwrap()).unwrap()
        };
        assert_eq!(
            marked("model[0].file"),
            "\"tests/bad-shots/models/ball.obj\""
        );
        assert_eq!(marked("model[0].materials.Hot Mat"), "[[model]]");
    }

    #[test]
    fn a_syntax_error_does_not_hide_mistakes_on_other_lines() {
        let source = format!("[image]\nsamples = 0\n[shot]\nframes =\n{SHOT}");
        let mistakes = parse(&source, Path::new("a.toml")).unwrap_err();
        let keys: Vec<&str> = mistakes
            .iter()
            .map(|mistake| mistake.key.as_str())
            .collect();
        assert_eq!(keys, ["image.samples", ""]);
    }
}
