//! Hashes of files: every file that a shot reads counts, and each byte of it.

use super::desk::house;
use crate::common::desk::Desk;
use restframe::frame::Digests;

const SHOT: &str = r#"
[[model]]
file = "house.obj"
material = "painted"
[[model]]
file = "parts.gltf"
material = "painted"
[[model]]
file = "whole.glb"
material = "painted"
[[model]]
name = "again"
file = "house.obj"
material = "painted"
[material.painted]
diffuse = { spectrum = { file = "paint.csv" } }
[spectrum.unused]
file = "unused.csv"
[background]
image = "sky.png"
stars = { file = "stars.csv" }
[camera]
position = [0, 0, 5]
"#;

fn desk() -> Desk {
    let desk = house();
    desk.write("unused.csv", "400,0\n500,0.5\n");
    desk.write("sky.png", "no picture, but a file of some bytes");
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"some%20parts.bin"},
        {"byteLength":3,"uri":"data:application/octet-stream;base64,AAAA"}],
        "images":[{"uri":"painting.png"}]}"#;
    desk.write("parts.gltf", json);
    desk.write("some parts.bin", [1, 2, 3]);
    desk.write("painting.png", "a picture that nobody reads");
    desk.write("whole.glb", glb(r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4},{"byteLength":3,"uri":"far.bin"}]} "#));
    desk.write("far.bin", [4, 5, 6]);
    desk
}

/// A glb file of this JSON and four more bytes.
fn glb(json: &str) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\x00\x00\x00".to_vec();
    bytes.extend((12 + 8 + json.len() as u32 + 8 + 4).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(4_u32.to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend([7, 8, 9, 10]);
    bytes
}

fn digests(desk: &Desk) -> Digests {
    Digests::read(&desk.shot(SHOT)).unwrap()
}

#[test]
fn hashes_are_blake3_of_whole_files_and_each_file_has_one() {
    let desk = desk();
    let digests = digests(&desk);
    let found: Vec<(String, &str)> = digests.iter().collect();
    let mut names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    names.sort_unstable();
    // A spectrum that nothing uses reaches no pixel.
    let expected = [
        "far.bin",
        "house.obj",
        "paint.csv",
        "paints.mtl",
        "parts.gltf",
        "sky.png",
        "some%20parts.bin",
        "stars.csv",
        "whole.glb",
    ];
    assert_eq!(names, expected);
    for (name, hash) in found {
        let bytes = std::fs::read(desk.path(&name.replace("%20", " "))).unwrap();
        assert_eq!(hash, blake3::hash(&bytes).to_hex().as_str(), "{name}");
    }
}

#[test]
fn one_byte_of_any_file_changes_its_hash_alone() {
    let desk = desk();
    let before = digests(&desk);
    for (name, _) in before.iter() {
        let path = desk.path(&name.replace("%20", " "));
        let bytes = std::fs::read(&path).unwrap();
        let mut changed = bytes.clone();
        // Of what names others, a byte that is no part of a name: of the version, or the last.
        let version = bytes.windows(3).position(|three| three == b"2.0");
        changed[version.map_or(bytes.len() - 1, |at| at + 2)] ^= 1;
        std::fs::write(&path, &changed).unwrap();
        let after = digests(&desk);
        let differ = before.iter().zip(after.iter()).filter(|(a, b)| a != b);
        let names: Vec<String> = differ.map(|((name, _), _)| name).collect();
        assert_eq!(names, [name]);
        std::fs::write(&path, &bytes).unwrap();
    }
    // What nobody reads does not count.
    desk.write("painting.png", "another");
    assert_eq!(digests(&desk), before);
}

#[test]
fn material_libraries_are_found_as_the_loader_finds_them() {
    for (line, expected) in [
        ("mtllib paints.mtl", 1),
        ("  mtllib\tpaints.mtl  \r", 1),
        ("mtllib paints.mtl more.mtl none.mtl", 2),
        ("mtllib my paints.mtl", 1),
        ("mtllib \\\npaints.mtl", 1),
        ("mtllib none.mtl", 0),
        ("# mtllib paints.mtl", 0),
        ("mtllib", 0),
        ("\u{FEFF}mtllib paints.mtl", 1),
        ("# a folder\\\nmtllib paints.mtl", 1),
        ("# old\rmtllib paints.mtl\r", 1),
        ("mtllib paints.mtl # and no more", 1),
        ("mtllib C:\\lib\\PAINTS.MTL", 1),
    ] {
        let desk = house();
        desk.write("more.mtl", "newmtl x\n");
        desk.write("my paints.mtl", "newmtl y\n");
        desk.write(
            "house.obj",
            format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3"),
        );
        let shot = desk.shot("[[model]]\nfile = \"house.obj\"\n[camera]\n");
        let digests = Digests::read(&shot).unwrap();
        assert_eq!(digests.iter().count(), 1 + expected, "{line:?}");
    }
}

#[test]
fn a_part_that_is_not_there_or_not_allowed_has_no_hash() {
    // Whether it is used, and so missed, is the loader's to say.
    for uri in [
        "none.bin",
        "../secret.bin",
        "/etc/hostname",
        "https://example.org/x.bin",
    ] {
        let desk = desk();
        desk.write(
            "parts.gltf",
            format!(r#"{{"buffers":[{{"byteLength":3,"uri":"{uri}"}}]}}"#),
        );
        let names = |digests: &Digests| digests.iter().map(|(name, _)| name).collect::<Vec<_>>();
        let before = digests(&desk);
        assert!(!names(&before).contains(&uri.to_owned()), "{uri}");
        desk.write("none.bin", [1, 2, 3]);
        let counts = uri == "none.bin";
        assert_eq!(digests(&desk) != before, counts, "{uri}");
    }
}

#[test]
fn parts_of_a_text_that_is_mended_count() {
    for text in [
        &b"{\"asset\":{\"generator\":\"T\xFCr\"},\"buffers\":[{\"uri\":\"far.bin\"}]}"[..],
        b"{\"buffers\":[{\"uri\":\"far.bin\"}]}\0\0\0",
        b"{\"buffers\":[{\"uri\":\"./x\\\\..\\\\far.bin\",\"byteLength\":3.0}]}",
    ] {
        let desk = desk();
        std::fs::create_dir(desk.path("x")).unwrap();
        desk.write("parts.gltf", text);
        let before = digests(&desk);
        desk.write("far.bin", [9, 9, 9]);
        let after = digests(&desk);
        let differ = before.iter().zip(after.iter()).filter(|(a, b)| a != b);
        // That of the other model that names it, and this one's.
        assert_eq!(differ.count(), 2);
    }
}

#[test]
fn broken_models_have_hashes_all_the_same() {
    let desk = desk();
    for bytes in [
        &b"glTF"[..],
        b"",
        b"glTF\x02\0\0\0\0\0\0\0\xff\xff\xff\xffJSON{",
        b"{\"buffers\":3}",
    ] {
        desk.write("whole.glb", bytes);
        let digests = digests(&desk);
        let hash = blake3::hash(bytes).to_hex();
        assert!(
            digests
                .iter()
                .any(|(name, own)| name == "whole.glb" && own == hash.as_str())
        );
    }
}

/// A shot of one model, and the glTF file of it that names these buffers.
fn of_buffers(desk: &Desk, uris: impl Iterator<Item = String>) -> Digests {
    let buffers: Vec<String> = uris
        .map(|uri| format!(r#"{{"byteLength":1,"uri":"{uri}"}}"#))
        .collect();
    let json = format!(r#"{{"buffers":[{}]}}"#, buffers.join(","));
    // Of a known length, so that it is known how many bytes are left.
    desk.write("m.gltf", format!("{json:60000}"));
    Digests::read(&desk.shot("[[model]]\nfile = \"m.gltf\"\n[camera]\n")).unwrap()
}

#[test]
fn a_part_counts_behind_others_that_together_exceed_what_is_read() {
    const NAMES: u64 = 32;
    let desk = house();
    let zeros = std::fs::File::create(desk.path("zeros.bin")).unwrap();
    // One file under as many names that fewer bytes are left than the last has.
    zeros.set_len(((2 << 30) - 60_000) / NAMES).unwrap();
    let uris = || {
        let names = (0..NAMES as usize).map(|i| format!("{}zeros.bin", "./".repeat(i)));
        names.chain(["used.bin".to_owned()])
    };
    desk.write("used.bin", [1; 42]);
    let before = of_buffers(&desk, uris());
    assert_eq!(before.iter().count() as u64, 1 + NAMES + 1);
    let mut changed = [1; 42];
    changed[41] = 2;
    desk.write("used.bin", changed);
    assert_ne!(of_buffers(&desk, uris()), before);
}

#[test]
fn a_part_that_alone_exceeds_what_is_read_has_no_hash_and_the_next_has() {
    let desk = house();
    let huge = std::fs::File::create(desk.path("huge.bin")).unwrap();
    huge.set_len((2 << 30) - 1).unwrap();
    desk.write("used.bin", [1]);
    let digests = of_buffers(
        &desk,
        ["huge.bin", "used.bin"].map(str::to_owned).into_iter(),
    );
    let names: Vec<String> = digests.iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["m.gltf", "used.bin"]);
}

#[test]
fn a_part_counts_behind_more_than_may_be_open_at_once() {
    let desk = house();
    let uris = || (0..1200).map(|i| format!("{i}.bin"));
    for uri in uris() {
        desk.write(&uri, [1]);
    }
    let before = of_buffers(&desk, uris());
    assert_eq!(before.iter().count(), 1 + 1200);
    desk.write("1199.bin", [2]);
    assert_ne!(of_buffers(&desk, uris()), before);
}
