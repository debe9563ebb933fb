//! Names of files as other systems and people write them: each is read, or answered with what to write.
use crate::common::WALL;
use restframe::render::Prepared;
use restframe::shot::{Mistakes, load};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// é as one letter, and as e with an accent that follows.
const COMPOSED: &str = "caf\u{e9}";
const DECOMPOSED: &str = "cafe\u{301}";

/// The keys that name files, each in a shot of which everything else is sound.
const KEYS: [(&str, &str, &str); 5] = [
    ("model[0].file", "obj", ""),
    ("background.image", "hdr", "[background]\nimage = NAME\n"),
    (
        "background.stars.file",
        "csv",
        "[background]\nstars = { file = NAME }\n",
    ),
    (
        "spectrum.paint.file",
        "csv",
        "[spectrum.paint]\nfile = NAME\n[material.m]\ndiffuse = { spectrum = \"paint\" }\n",
    ),
    (
        "material.m.mirror.spectrum.file",
        "csv",
        "[material.m]\nmirror = { spectrum = { file = NAME } }\n",
    ),
];

/// A folder with files of each kind: `q` in `models`, and `café` as macOS writes it.
fn desk() -> TempDir {
    let desk = tempfile::tempdir().unwrap();
    fs::create_dir(desk.path().join("models")).unwrap();
    for stem in ["wall", "models/q", DECOMPOSED, "new"] {
        let put = |extension: &str, text: &[u8]| {
            fs::write(desk.path().join(format!("{stem}.{extension}")), text).unwrap();
        };
        put("obj", WALL.as_bytes());
        put("csv", b"400,0.5\n700,0.5\n");
        put(
            "hdr",
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x80\x80\x80\x80",
        );
    }
    desk
}

/// The shot with the key's value written as `name`, in whatever quotes.
fn shot(desk: &Path, (key, _, rest): (&str, &str, &str), name: &str) -> Result<(), Mistakes> {
    let model = if key == "model[0].file" {
        name
    } else {
        "\"wall.obj\""
    };
    let text = format!(
        "[[model]]\nfile = {model}\nmaterials = {{ }}\n[camera]\nposition = [0, 0, 3]\n{}",
        rest.replace("NAME", name)
    );
    let path = desk.join("shot.toml");
    fs::write(&path, text).unwrap();
    load(&path).map(drop)
}

/// The one mistake's key, message and help.
fn answer(desk: &Path, key: (&str, &str, &str), name: &str) -> (String, String, String) {
    let mistakes = shot(desk, key, name).unwrap_err();
    assert_eq!(mistakes.len(), 1, "{mistakes}");
    let mistake = mistakes.iter().next().unwrap();
    let help = mistake.help.clone().unwrap_or_default();
    (mistake.key.clone(), mistake.message.clone(), help)
}

#[test]
fn backslashes_lead_to_the_file_that_they_lead_to_on_windows() {
    let desk = desk();
    for key in KEYS {
        let name = format!("'models\\q.{}'", key.1);
        shot(desk.path(), key, &name).unwrap_or_else(|m| panic!("{name}: {m}"));
    }
    let text = "[[model]]\nfile = 'models\\q.obj'\nmaterial = \"m\"\n[material.m]\ndiffuse = { spectrum = { file = 'models\\q.csv' } }\n[camera]\nposition = [0, 0, 3]\n";
    let path = desk.path().join("both.toml");
    fs::write(&path, text).unwrap();
    let prepared = Prepared::read(&path).unwrap();
    assert_eq!(prepared.shot.model[0].file, Path::new("models/q.obj"));
}

#[cfg(unix)]
#[test]
fn a_file_whose_name_has_a_backslash_is_read_as_it_stands() {
    let desk = desk();
    fs::write(desk.path().join("models\\q.obj"), WALL).unwrap();
    let path = desk.path().join("literal.toml");
    let text = "[[model]]\nfile = 'models\\q.obj'\n[camera]\nposition = [0, 0, 3]\n";
    fs::write(&path, text).unwrap();
    assert_eq!(
        load(&path).unwrap().model[0].file,
        Path::new("models\\q.obj")
    );
}

#[test]
fn what_toml_says_of_backslashes_comes_with_what_to_write() {
    let desk = desk();
    for name in [
        r#""models\q.obj""#,
        r#""models\sphere.obj""#,
        r#""C:\users\me\q.obj""#,
        r#""\xyz\q.obj""#,
        r#""models\new.obj""#,
        r#""models\test.obj""#,
    ] {
        let mistakes = shot(desk.path(), KEYS[0], name).unwrap_err();
        let helps: Vec<&str> = mistakes.iter().filter_map(|m| m.help.as_deref()).collect();
        assert!(
            helps.iter().any(|help| help.contains("write / in paths")),
            "{name}: {mistakes}"
        );
    }
}

#[test]
fn another_case_blanks_and_slips_are_asked_about() {
    let desk = desk();
    for key in KEYS {
        let extension = key.1;
        let upper = extension.to_uppercase();
        for name in [
            format!("\"models/Q.{upper}\""),
            format!("\"Models/q.{extension}\""),
            format!("\"models/q.{extension} \""),
            format!("\" models/q.{extension}\""),
            format!("\"model/q.{extension}\""),
            format!("'MODELS\\Q.{upper}'"),
            format!("\"/home/somebody/models/q.{extension}\""),
            format!("'C:\\work\\models\\q.{extension}'"),
        ] {
            let (at, message, help) = answer(desk.path(), key, &name);
            assert_eq!(at, key.0, "{name}");
            assert!(message.starts_with("there is no file"), "{name}: {message}");
            let meant = format!("did you mean \"models/q.{extension}\"?");
            assert!(help.contains(&meant), "{name}: {help}");
        }
    }
}

#[test]
fn accents_that_are_composed_otherwise_are_told_as_such() {
    let desk = desk();
    for key in KEYS {
        let name = format!("\"{COMPOSED}.{}\"", key.1);
        // Where the system tells them not apart, there is nothing to ask.
        if shot(desk.path(), key, &name).is_ok() {
            continue;
        }
        let (_, _, help) = answer(desk.path(), key, &name);
        assert!(
            help.contains("did you mean") && help.contains("Unicode"),
            "{help}"
        );
        shot(desk.path(), key, &format!("\"{DECOMPOSED}.{}\"", key.1)).unwrap();
    }
}

#[test]
fn urls_are_answered_with_a_path() {
    let desk = desk();
    for key in KEYS {
        let extension = key.1;
        for (url, words) in [
            (
                "file:///somewhere/my%20things/zebra",
                "a path, not a URL: \"/somewhere/my things/zebra",
            ),
            (
                "file://localhost/home/models/q",
                "a path, not a URL: \"models/q",
            ),
            ("file:models/q", "did you mean \"models/q"),
            ("https://example.org/q", "a file of this machine, not a URL"),
        ] {
            let (_, _, help) = answer(desk.path(), key, &format!("\"{url}.{extension}\""));
            assert!(help.contains(words), "{url}: {help}");
        }
    }
}

#[test]
fn of_files_only_those_of_the_same_kind_are_meant() {
    let desk = desk();
    fs::write(desk.path().join("lamp.mtl"), "").unwrap();
    let (_, _, help) = answer(desk.path(), KEYS[0], "\"lamp.obj\"");
    assert_eq!(help, "paths are relative to the shot file");
}

#[test]
fn a_path_of_any_length_is_answered_in_no_time() {
    let desk = desk();
    let begun = std::time::Instant::now();
    let name = format!("\"{}models/q.obj\"", "a/".repeat(20_000));
    let (_, _, help) = answer(desk.path(), KEYS[0], &name);
    assert!(help.contains("did you mean \"models/q.obj\"?"), "{help}");
    // Trying each of its ends took minutes.
    assert!(begun.elapsed().as_secs() < 10);
}
