//! OBJ and MTL as programs write them: comments, encodings, numbers that are none, names that lead
//! nowhere. What is right is told by the square that every file holds.

use super::bad::write;
use restframe::model::{Model, load};
use std::path::Path;

/// Corners of a square of area 4 whose normal is +z.
const CORNERS: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

/// A model with the files beside it.
fn read(obj: impl AsRef<[u8]>, beside: &[(&str, &str)]) -> Model {
    let folder = tempfile::tempdir().unwrap();
    read_in(folder.path(), obj.as_ref(), beside)
}

fn read_in(folder: &Path, obj: &[u8], beside: &[(&str, &str)]) -> Model {
    for (name, text) in beside {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    load(&write(folder, "model.obj", obj), &[]).unwrap()
}

fn refusal(obj: impl AsRef<[u8]>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "bad.obj", obj.as_ref());
    load(&path, &[]).unwrap_err().to_string()
}

fn told(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}

/// Names and colors of the materials, in the order of the meshes.
fn colors(model: &Model) -> Vec<Option<(&str, [f64; 3])>> {
    let materials = model.meshes.iter().map(|mesh| mesh.material);
    let materials = materials.map(|index| index.map(|index| &model.materials[index]));
    materials
        .map(|material| material.map(|m| (m.name.as_str(), m.base_color)))
        .collect()
}

#[test]
fn a_backslash_at_the_end_of_a_comment_or_a_name_continues_nothing() {
    for between in [
        "# body\\Solid\\\nf 1 2 3\n",
        "#\\\nf 1 2 3\n",
        "f 1 2 3 # front\\\n",
        "f 1 2 3# front \\\n",
        "o part # of body\\\nf 1 2 3\n",
        "g body\\Solid\\\nf 1 2 3\n",
        "usemtl body\\Solid\\\nf 1 2 3\n",
        "s off # smooth\\\nf 1 2 3\n",
        "f 1 2 \\\n3 # front\\\n",
    ] {
        let model = read(format!("{CORNERS}{between}f 1 3 4\n"), &[]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0), "{between:?}");
    }
    let model = read(format!("{CORNERS}g body\\\nf 1 2 3 4"), &[]);
    assert_eq!(model.placements[0].node, "body\\");
}

#[test]
fn a_backslash_continues_numbers_and_names_and_at_the_end_nothing() {
    for face in [
        "f 1 2 \\\n3 4\n",
        "f 1 2 \\\r\n \\\r\n3 4\r\n",
        "f 1 2 3 4\\",
        "f 1 2 3 4 \\\n",
        "f 1 2 3\\\nf 1 3 4\n",
    ] {
        let model = read(format!("{CORNERS}{face}"), &[]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0), "{face:?}");
    }
    let model = read(format!("{CORNERS}g left \\\nside\nf 1 2 3 4\n"), &[]);
    assert_eq!(model.placements[0].node, "left  side");
}

#[test]
fn any_number_of_lines_may_be_continued_in_no_time() {
    let bare = "\\\n".repeat(200_000);
    let begun = std::time::Instant::now();
    for text in [
        format!("{bare}f 1 2 3 4\n"),
        format!("f 1 2 \\\n{bare}3 4\n"),
        format!("f 1 2 3 4\n{}\\\n{bare}", "x".repeat(200_000)),
    ] {
        let model = read(format!("{CORNERS}{text}"), &[]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0));
    }
    // Looking at all that has come at each line took minutes.
    assert!(begun.elapsed().as_secs() < 10);
}

#[test]
fn a_byte_order_mark_is_skipped_in_models_and_libraries() {
    let obj = format!("\u{FEFF}mtllib a.mtl\nusemtl Red\n\u{FEFF}{CORNERS}f 1 2 3 4\n");
    let model = read(obj, &[("a.mtl", "\u{FEFF}newmtl Red\nKd 0.8 0.1 0.1\n")]);
    assert_eq!(model.area(), 4.0);
    assert_eq!(colors(&model), [Some(("Red", [0.8, 0.1, 0.1]))]);
    assert_eq!(told(&model), [""; 0]);
}

#[test]
fn lines_may_end_in_carriage_returns_alone() {
    let (obj, mtl) = (
        format!("mtllib a.mtl\n# old\\\nusemtl Red\n{CORNERS}f 1 2 \\\n3 4\n"),
        "newmtl Red\nKd 0.8 0.1 0.1\n",
    );
    for end in ["\r", "\r\n", "\r\r\n"] {
        let mtl = mtl.replace('\n', end);
        let model = read(obj.replace('\n', end), &[("a.mtl", &mtl)]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0), "{end:?}");
        assert_eq!(colors(&model), [Some(("Red", [0.8, 0.1, 0.1]))], "{end:?}");
        let message = refusal(format!("{CORNERS}f 1 2 9\n").replace('\n', end));
        assert!(message.contains("bad.obj:5: "), "{end:?}: {message}");
    }
}

#[test]
fn text_in_utf_16_is_named_and_what_to_do() {
    let text = format!("{CORNERS}f 1 2 3 4\n");
    let units = || text.encode_utf16();
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    for bytes in [
        [&[0xFF, 0xFE], &little[..]].concat(),
        [&[0xFE, 0xFF], &big[..]].concat(),
        little,
        big,
    ] {
        let message = refusal(bytes.clone());
        assert!(
            message.contains("bad.obj` is text in UTF-16") && message.contains("save it as UTF-8"),
            "{message}"
        );
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "a.mtl", &bytes);
        let path = write(folder.path(), "m.obj", b"mtllib a.mtl\n");
        let message = load(&path, &[]).unwrap_err().to_string();
        assert!(message.contains("`a.mtl` is text in UTF-16"), "{message}");
    }
}

#[test]
fn faces_of_fewer_than_three_corners_are_left_out_and_counted() {
    let model = read(
        format!("{CORNERS}f 1 2 3 4\nf 1 2\nf 3\nf\nf # none\n"),
        &[],
    );
    assert_eq!((model.triangles(), model.area()), (2, 4.0));
    assert_eq!(
        told(&model),
        ["faces of fewer than 3 corners have no area and are left out: 4, the first in line 6"]
    );
}

#[test]
fn normals_that_are_no_numbers_give_way_to_the_triangles_own() {
    for word in [
        "nan",
        "-nan(ind)",
        "-1.#IND",
        "1.#QNAN",
        "1.#INF",
        "-1.#INF00",
        "inf",
        "nan(0x8000)",
        "NaN",
    ] {
        let normals = format!("vn {word} {word} {word} # {word}\n");
        let model = read(format!("{CORNERS}{normals}f 1//1 2//1 3//1 4//1\n"), &[]);
        let found: Vec<_> = model.meshes[0].normals.iter().flatten().collect();
        assert_eq!(found.len(), 4, "{word}");
        assert!(found.iter().all(|n| n.to_array() == [0.0, 0.0, 1.0]));
        assert_eq!(
            told(&model),
            ["the mesh: some normals are zero or not finite; the triangles' own are used there"]
        );
        let message = refusal(format!("v 0 0 {word}\n"));
        assert!(message.contains("bad.obj:1: found `v 0 0 "), "{message}");
    }
}

#[test]
fn comments_stand_behind_anything() {
    let mtl = "newmtl Red # paint\nKd 0.8 0.1 0.1 # of reflectance\nKe 1 2 3# of emission\n\
               d 0.5 # half\nPm 1 #metal\nmap_d # none\n";
    let obj = "mtllib my #1.mtl # the paints\nv -1 -1 0 # lower left\nv 1 -1 0# lower right\n\
               v 1 1 0 1 #weight\nv -1 1 0 1 0 0 # color\nvt 0 0 # corner\nvn 0 0 1 # up\n\
               o Wall # the only one\nusemtl Red # front\nf 1/1/1 2/1/1 3/1/1 4/1/1 # front\n\
               usemtl Red #back\nf 4/1/1 3/1/1 2/1/1 1/1/1# back\n";
    let model = read(obj, &[("my #1.mtl", mtl)]);
    assert_eq!((model.triangles(), model.area()), (4, 8.0));
    assert_eq!(model.placements[0].node, "Wall");
    assert_eq!(colors(&model), [Some(("Red", [0.8, 0.1, 0.1]))]);
    assert_eq!(model.materials[0].emissive, [1.0, 2.0, 3.0]);
    assert_eq!(
        told(&model),
        [
            "the mesh: colors at vertices are not read; it has the color of its material alone",
            "material `Red`: is see-through (`d`, `Tr`); it is drawn opaque, nothing shows through",
            "material `Red`: is a metal; it is drawn as matt paint of the same color, without reflections",
        ]
    );
}

#[test]
fn a_sharp_within_a_name_is_part_of_it() {
    let names = [
        "Red#2",
        "Material #25",
        "Material #26",
        "#ff0000",
        "wood # 1",
        "wood # 2",
    ];
    let (mut obj, mut mtl) = (format!("mtllib a.mtl\n{CORNERS}"), String::new());
    for (i, name) in names.iter().enumerate() {
        obj += &format!("usemtl {name}\nf 1 2 3 4\n");
        mtl += &format!("newmtl {name}\nKd 0.{i} 0 0\n");
    }
    let model = read(obj, &[("a.mtl", &mtl)]);
    let expected: Vec<_> = (0..names.len())
        .map(|i| Some((names[i], [i as f64 / 10.0, 0.0, 0.0])))
        .collect();
    assert_eq!(colors(&model), expected);
}

#[test]
fn numbers_beyond_those_of_a_line_are_left_out() {
    for (extra, warned) in [
        ("", None),
        (" 1", None),
        (" 1 0 0", Some("colors at vertices")),
        (" 1 0 0 1", Some("colors at vertices")),
        (
            " 7 7",
            Some("neither weight nor color, the first in line 1"),
        ),
        (
            " 7 7 7 7 7",
            Some("neither weight nor color, the first in line 1"),
        ),
    ] {
        let corners = CORNERS.replace('\n', &format!("{extra}\n"));
        let model = read(format!("{corners}vn 0 0 1 0\nf 1//1 2//1 3//1 4//1\n"), &[]);
        assert_eq!(model.area(), 4.0, "{extra:?}");
        assert_eq!(told(&model).len(), usize::from(warned.is_some()));
        let said = told(&model).join("");
        assert!(said.contains(warned.unwrap_or("")), "{extra:?}: {said}");
    }
    // A weight divides: half the square's side, a quarter of its area.
    let model = read(format!("{}f 1 2 3 4\n", CORNERS.replace('\n', " 2\n")), &[]);
    assert_eq!(model.area(), 1.0);
    let model = read(
        format!("mtllib a.mtl\nusemtl Red\n{CORNERS}f 1 2 3 4\n"),
        &[(
            "a.mtl",
            "newmtl Red\nKd 0.8 0.1 0.1 1\nKe 1 2 3 4 # watts\n",
        )],
    );
    assert_eq!(colors(&model), [Some(("Red", [0.8, 0.1, 0.1]))]);
    assert_eq!(model.materials[0].emissive, [1.0, 2.0, 3.0]);
}

#[test]
fn the_first_of_several_libraries_goes_before_the_others() {
    let beside = [
        ("1.mtl", "newmtl Red\nKd 0.8 0.1 0.1\n"),
        ("2.mtl", "newmtl Red\nKd 0 0 1\nnewmtl Green\nKd 0 1 0\n"),
    ];
    for lines in ["mtllib 1.mtl 2.mtl\n", "mtllib 1.mtl\nmtllib 2.mtl\n"] {
        let faces = "usemtl Red\nf 1 2 3\nusemtl Green\nf 1 3 4\n";
        let model = read(format!("{lines}{CORNERS}{faces}"), &beside);
        let expected = [("Red", [0.8, 0.1, 0.1]), ("Green", [0.0, 1.0, 0.0])];
        assert_eq!(colors(&model), expected.map(Some), "{lines:?}");
    }
}

#[test]
fn names_that_are_not_there_name_nothing() {
    let mtl = "newmtl Red\nKd 0.8 0.1 0.1\nnewmtl\nKd 0 0 1\nnewmtl # none\nKd 0 0 1\n";
    let obj = format!(
        "mtllib\nmtllib \nmtllib # none\nmtllib a.mtl\no\n{CORNERS}usemtl Red\nf 1 2 3\n\
         usemtl \nf 1 3 4\no wall\nf 1 2 3\nusemtl # none\nf 1 3 4\nusemtl Red\nf 4 3 1\n"
    );
    let model = read(obj, &[("a.mtl", mtl)]);
    let red = Some(("Red", [0.8, 0.1, 0.1]));
    assert_eq!(colors(&model), [red, None, None, red]);
    let nodes: Vec<_> = model.placements.iter().map(|p| p.node.as_str()).collect();
    assert_eq!(nodes, ["", "", "wall", "wall"]);
    assert_eq!(
        told(&model),
        [
            "a.mtl:3: a material without a name is left out",
            "a.mtl:5: a material without a name is left out",
        ]
    );
}

#[test]
fn faces_may_name_normals_and_coordinates_of_a_file_that_has_none() {
    for (face, expected) in [
        ("f 1/1 2/2 3/3 4/4\n", &["texture coordinates"][..]),
        ("f 1/-4 2/-3 3/-2 4/-1\n", &["texture coordinates"]),
        ("f 1//1 2//1 3//1 4//1\n", &["normals"]),
        ("f 1//-1 2//-1 3//-1 4//-1\n", &["normals"]),
        (
            "f 1/0/0 2/0/0 3/0/0 4/0/0\n",
            &["texture coordinates", "normals"],
        ),
    ] {
        let model = read(format!("{CORNERS}{face}"), &[]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0), "{face:?}");
        assert_eq!(model.meshes[0].normals, None);
        let sentence = |what: &&str| {
            format!(
                "faces name {what}, the first in line 5, but the file has none; they are left out"
            )
        };
        let expected: Vec<_> = expected.iter().map(sentence).collect();
        assert_eq!(told(&model), expected, "{face:?}");
    }
    // With some of the kind, the one that is missing was lost.
    for (face, expected) in [
        (
            "vn 0 0 1\nf 1//1 2//2 3//1\n",
            "normal 2, but there are only 1",
        ),
        (
            "f 1//-1 2//-1 3//-1\nvn 0 0 1\n",
            "normal -1, but there are only 0",
        ),
    ] {
        let message = refusal(format!("{CORNERS}{face}"));
        assert!(message.contains(expected), "{face:?}: {message}");
    }
}

#[test]
fn coordinates_that_are_not_there_are_told_and_cost_nothing() {
    for (face, index) in [
        ("f 1/1 2/2 3/3 4/4\n", 4),
        ("f 1/-2 2/1 3/1 4/1\n", -2),
        ("f 1/0 2/1 3/1 4/1\n", 0),
        ("f 1/-9223372036854775808 2/1 3/1 4/1\n", i64::MIN),
        ("f 1/9223372036854775807 2/1 3/1 4/1\n", i64::MAX),
    ] {
        let model = read(format!("{CORNERS}vt 0 0\n{face}"), &[]);
        assert_eq!((model.triangles(), model.area()), (2, 4.0), "{face:?}");
        let expected = format!(
            "line 6: the face asks for texture coordinate {index}, but there are only 1; coordinates are not read"
        );
        assert_eq!(told(&model), [expected], "{face:?}");
    }
}

#[test]
fn index_0_is_told_where_indices_begin() {
    for (face, what) in [
        ("f 0 1 2\n", "position"),
        ("f 1 2 0\n", "position"),
        ("vn 0 0 1\nf 1//1 2//0 3//1\n", "normal"),
    ] {
        let message = refusal(format!("{CORNERS}{face}"));
        let expected = format!("asks for {what} 0, but indices begin at 1");
        assert!(message.contains(&expected), "{face:?}: {message}");
    }
}

/// The color of the square whose file has this `mtllib` line, and what is told.
fn of_library(line: &str, beside: &[(&str, &str)]) -> ([f64; 3], Vec<String>) {
    let obj = format!("mtllib {line}\nusemtl Red\n{CORNERS}f 1 2 3 4\n");
    let model = read(obj, beside);
    (model.materials[0].base_color, told(&model))
}

const RED: &str = "newmtl Red\nKd 0.8 0.1 0.1\n";

#[test]
fn a_library_is_found_under_the_names_of_other_systems() {
    for (line, name) in [
        (".\\lib\\a.mtl", "lib/a.mtl"),
        ("lib\\a.mtl", "lib/a.mtl"),
        ("Lib\\A.MTL", "lib/a.mtl"),
        ("A.MTL", "a.mtl"),
        ("a.mtl", "A.MTL"),
        ("\"a.mtl\"", "a.mtl"),
        ("'a.mtl'", "a.mtl"),
        ("\"my paints.mtl\"", "my paints.mtl"),
        ("my paints.mtl", "My Paints.mtl"),
        ("\"lib\\my paints.mtl\" # paints", "lib/my paints.mtl"),
        ("gone.mtl \"my paints.mtl\"", "my paints.mtl"),
    ] {
        let (color, told) = of_library(line, &[(name, RED)]);
        assert_eq!(color, [0.8, 0.1, 0.1], "{line} {told:?}");
        let missing = usize::from(line.starts_with("gone"));
        assert_eq!(told.len(), missing, "{line}: {told:?}");
    }
    // As it is written goes before the rest, and of two that differ in case neither is chosen.
    let blue = "newmtl Red\nKd 0 0 1\n";
    let (color, _) = of_library("a.mtl", &[("A.mtl", blue), ("a.mtl", RED)]);
    assert_eq!(color, [0.8, 0.1, 0.1]);
    let (color, told) = of_library("A.MTL", &[("A.mtl", blue), ("a.mtl", RED)]);
    assert_eq!(color, [1.0; 3]);
    assert!(told[0].ends_with("did you mean `a.mtl`?"), "{told:?}");
}

#[test]
fn a_library_that_is_not_there_is_named_with_the_one_perhaps_meant() {
    for (line, name, near) in [
        ("paint.mtl", "paints.mtl", Some("paints.mtl")),
        ("lib/paint.mtl", "lib/paints.mtl", Some("lib/paints.mtl")),
        ("lib\\paints.mtl", "paints.mtl", Some("paints.mtl")),
        ("untitled.mtl", "model.mtl", Some("model.mtl")),
        ("untitled.mtl", "others.mtl", None),
        ("paint.mtl", "paints.txt", None),
    ] {
        let (color, told) = of_library(line, &[(name, RED)]);
        assert_eq!(color, [1.0; 3]);
        let end = near.map_or("the shot gives them".into(), |near| {
            format!("; did you mean `{near}`?")
        });
        assert!(told[0].starts_with(&format!("material library `{line}` ")));
        assert!(told[0].ends_with(&end), "{line}: {told:?}");
    }
}

#[test]
fn of_an_absolute_path_the_file_of_that_name_beside_the_model_is_read() {
    for line in [
        "/home/ann/a.mtl",
        "C:\\Users\\ann\\a.mtl",
        "C:/Users/ann b/A.MTL",
        "\\\\server\\share\\a.mtl",
        "file:///home/ann/a.mtl",
        "\"C:\\my files\\a.mtl\"",
        "C:\\my files\\a.mtl",
    ] {
        let (color, told) = of_library(line, &[("a.mtl", RED)]);
        assert_eq!(color, [0.8, 0.1, 0.1], "{line}");
        assert_eq!(told.len(), 1, "{line}: {told:?}");
        assert!(told[0].contains("is an absolute path"), "{told:?}");
        let (color, told) = of_library(line, &[]);
        assert_eq!(color, [1.0; 3], "{line}");
        assert!(told[0].contains("is an absolute path"), "{told:?}");
        assert!(told[1].contains("does not exist"), "{told:?}");
    }
    let (color, _) = of_library("/b/2.mtl /b/1.mtl", &[("1.mtl", ""), ("2.mtl", RED)]);
    assert_eq!(color, [0.8, 0.1, 0.1]);
}

#[test]
fn no_spelling_of_a_name_leads_out_of_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "secret.mtl", RED.as_bytes());
    let models = folder.path().join("models");
    std::fs::create_dir(&models).unwrap();
    let obj = |line: &str| format!("mtllib {line}\nusemtl Red\n{CORNERS}f 1 2 3 4\n");
    for line in [
        "../secret.mtl",
        "..\\secret.mtl",
        "\"../SECRET.mtl\"",
        "x.mtl ../secret.mtl",
    ] {
        let path = write(&models, "m.obj", obj(line).as_bytes());
        let message = load(&path, &[]).unwrap_err().to_string();
        assert!(message.contains("outside the folders"), "{line}: {message}");
        // A shot one folder up may have it.
        let model = load(&path, &[folder.path()]).unwrap();
        assert_eq!(model.materials[0].base_color, [0.8, 0.1, 0.1], "{line}");
    }
    let absolute = folder.path().join("secret.mtl").display().to_string();
    let model = read_in(&models, obj(&absolute).as_bytes(), &[]);
    assert_eq!(model.materials[0].base_color, [1.0; 3]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("..", models.join("up")).unwrap();
        std::os::unix::fs::symlink("../secret.mtl", models.join("link.mtl")).unwrap();
        for line in ["up/secret.mtl", "/home/ann/link.mtl", "LINK.mtl"] {
            let path = write(&models, "m.obj", obj(line).as_bytes());
            let message = load(&path, &[]).unwrap_err().to_string();
            assert!(message.contains("outside the folders"), "{line}: {message}");
        }
        // Nor is it told what stands there.
        for line in ["up/SECRET.mtl", "up/secrets.mtl"] {
            let model = read_in(&models, obj(line).as_bytes(), &[]);
            assert_eq!(model.materials[0].base_color, [1.0; 3]);
            assert!(!told(&model).join("").contains("`up/secret.mtl`"), "{line}");
        }
    }
}

#[test]
fn what_has_no_name_is_called_the_mesh() {
    for name in ["", "o\n", "g # none\n"] {
        let text = format!("{name}{CORNERS}l 1 2\nf 1 2 3 4\nf 1 2 2\n");
        assert_eq!(
            told(&read(text, &[])),
            [
                "the mesh: points and lines have no surface and are left out",
                "the mesh: 1 triangles of zero area are left out",
            ]
        );
    }
    let text = format!("o wall\n{CORNERS}f 1 2 3 4\nf 1 2 2\n");
    assert_eq!(
        told(&read(text, &[])),
        ["object `wall`: 1 triangles of zero area are left out"]
    );
}

#[test]
fn beyond_a_thousand_libraries_a_file_is_refused_with_the_way_out() {
    let face = format!("{CORNERS}f 1 2 3 4\n");
    let lines = |count: usize| (0..count).map(|i| format!("mtllib {i}\n"));
    let words = |count: usize| (0..count).map(|i| format!("{i} "));
    let model = read(face.clone() + &lines(1000).collect::<String>(), &[]);
    assert_eq!(model.area(), 4.0);
    for text in [
        lines(1001).collect::<String>(),
        format!("mtllib {}\n", words(1001).collect::<String>()),
    ] {
        let message = refusal(face.clone() + &text);
        assert!(
            message.contains("more material libraries than the 1000")
                && message.contains("into one .mtl file"),
            "{message}"
        );
    }
}

#[test]
fn names_in_messages_show_their_control_characters() {
    let message = refusal(format!("mtllib ../../\u{1b}[31m.mtl\n{CORNERS}f 1 2 3\n"));
    assert!(
        message.contains("\\u{1b}[31m") && !message.contains('\u{1b}'),
        "{message}"
    );
}
