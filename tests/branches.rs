//! Mirrors and glass as an author sets them: how deep, how faint, what is left out, and that short
//! cuts change nothing.
use crate::common::WALL;
use base64::prelude::{BASE64_STANDARD, Engine};
use restframe::accel::Aggregate;
use restframe::film::{Film, SILENT};
use restframe::frame::Frame;
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::{Enough, Member, Options, View, enough_bounces, render};
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use std::path::Path;

/// What a pixel of a 9 x 9 image sees; `text` is the rest of the shot.
fn sees(text: &str, pixel: [u32; 2]) -> Probe {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wall.obj"), WALL).unwrap();
    std::fs::write(folder.path().join("ball.gltf"), one_sided_ball()).unwrap();
    std::fs::write(folder.path().join("ramp.csv"), "300,0.1\n900,0.7\n").unwrap();
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    std::fs::copy(assets.join("sphere.obj"), folder.path().join("ball.obj")).unwrap();
    std::fs::write(folder.path().join("paint.csv"), "400,0\n500,0.5\n600,1\n").unwrap();
    let path = folder.path().join("shot.toml");
    std::fs::write(
        &path,
        format!("[image]\nsize = [9, 9]\n[sensor]\nexposure = 0\n{text}"),
    )
    .unwrap();
    let prepared = Prepared::read(&path).unwrap();
    let shot = &prepared.shot;
    let frame = Frame::new(shot, 1).unwrap();
    let scene = Scene::resolve(&frame, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let effects = frame.effects_at(pixel[1]);
    let view = View::new(&frame, &effects, &scene, &aggregate);
    probe(&frame, pixel, &view, &scene, 0.0)
}

/// An octahedron of which only the front is there, as Blender exports with backface culling.
fn one_sided_ball() -> String {
    let mut bytes = Vec::new();
    let corners: [[f32; 3]; 6] = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    corners
        .iter()
        .flatten()
        .for_each(|x| bytes.extend(x.to_le_bytes()));
    let faces: [[u16; 3]; 8] = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    faces
        .iter()
        .flatten()
        .for_each(|i| bytes.extend(i.to_le_bytes()));
    let data = BASE64_STANDARD.encode(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],
        "materials":[{{"name":"glass","doubleSided":false}}],
        "buffers":[{{"byteLength":120,"uri":"data:application/octet-stream;base64,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":72}},{{"buffer":0,"byteOffset":72,"byteLength":48}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]}},
        {{"bufferView":1,"componentType":5123,"count":24,"type":"SCALAR"}}]}}"#
    )
}

/// A glass ball in a sky of radiance 1.
fn furnace(cutoff: f64, bounces: u32) -> String {
    format!(
        "[accuracy]\ncutoff = {cutoff:e}\n[effects]\nbounces = {bounces}\n\
         [[model]]\nfile = \"ball.obj\"\nmaterial = \"glass\"\n\
         [material.glass]\nmirror = {{ spectrum = 1.0 }}\nrefraction = {{ spectrum = 1.0 }}\n\
         [background]\nspectrum = 1.0\n[camera]\nposition = [0, 0, 3]\nhfov = 30\n"
    )
}

#[test]
fn what_is_left_out_is_what_the_answer_says() {
    for (cutoff, bounces) in [
        (1e-1, 64),
        (1e-2, 64),
        (1e-3, 64),
        (1e-4, 64),
        (1e-4, 1),
        (1e-4, 3),
    ] {
        let mut most: f64 = 0.0;
        for x in 0..9 {
            let seen = sees(&furnace(cutoff, bounces), [x, 3]);
            for value in &seen.radiance {
                // f32 spectra: 6e-8 a factor, of which a path has 64 at most.
                assert!(
                    (value + seen.cut - 1.0).abs() < 4e-6,
                    "{cutoff} {bounces} {x}: {value} {}",
                    seen.cut
                );
            }
            most = most.max(seen.cut);
        }
        assert!(most > 0.0, "{cutoff} {bounces}");
    }
}

/// A film of [`furnace`] and the member it is of, handed to `look`.
fn film_of<T>(bounces: u32, look: impl FnOnce(Member<'_>, &Aggregate, &Film) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    std::fs::copy(assets.join("sphere.obj"), folder.path().join("ball.obj")).unwrap();
    let path = folder.path().join("shot.toml");
    let head = "[image]\nsize = [96, 96]\nsamples = 4\n[sensor]\nexposure = 0\n";
    std::fs::write(&path, format!("{head}{}", furnace(1e-4, bounces))).unwrap();
    let prepared = Prepared::read(&path).unwrap();
    let shot = &prepared.shot;
    let values = Frame::new(shot, 1).unwrap();
    let scene = Scene::resolve(&values, &prepared.library, None).unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let options = Options {
        width: 96,
        height: 96,
        samples: 4,
        layers: Vec::new(),
    };
    let film = render(&values, &scene, &aggregate, &options, &|_| ());
    let frame = &values;
    let scene = &scene;
    let member = Member { frame, scene };
    look(member, &aggregate, &film)
}

/// Everything that a ball of glass in an even sky shows is the sky: what is lacking was left out.
#[test]
fn of_glass_in_an_even_sky_what_is_left_out_is_what_is_lacking() {
    let sky = 683.0 * 106.856_895; // lm/W times the sum of the CIE's ȳ over 360 to 830 nm.
    for bounces in [1, 2, 4, 8, 12] {
        film_of(bounces, |member, aggregate, film| {
            let seen: f64 = film.xyz.iter().map(|xyz| f64::from(xyz[1])).sum();
            let lacking = 1.0 - seen / sky / film.xyz.len() as f64;
            let share = film.left_out.share();
            // What a grid of 84 wavelengths and f32 spectra come to.
            assert!(
                (share - lacking).abs() < 1e-4,
                "{bounces}: {share} {lacking}"
            );
            assert!(share > 0.0, "{bounces}");
            let size = [film.width, film.height];
            let enough = enough_bounces(member, aggregate, size, &film.left_out);
            if share <= SILENT {
                return;
            }
            let Enough::Bounces(enough) = enough else {
                panic!("{bounces}: no number would do");
            };
            assert!(enough > bounces);
            let left = |n| film_of(n, |_, _, film| film.left_out.share());
            assert!(left(enough) <= SILENT, "{enough} leave {}", left(enough));
            // And not many more than needed.
            assert!(enough < bounces + 2 || left(enough - 2) > SILENT / 2.0);
        });
    }
    // One of the five is the default, and it will do; of one bounce it is told.
    assert!(film_of(1, |_, _, film| film.left_out.share()) > SILENT);
    assert!(film_of(8, |_, _, film| film.left_out.share()) < SILENT);
}

#[test]
fn what_is_left_out_is_the_same_on_any_number_of_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| {
            film_of(1, |member, aggregate, film| {
                let enough = enough_bounces(member, aggregate, [96, 96], &film.left_out);
                (film.left_out, enough)
            })
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_probe_tells_how_many_bounces_would_do() {
    let seen = sees(&furnace(1e-4, 1), [1, 4]);
    let enough = seen.enough_bounces.unwrap();
    assert!(seen.cut > SILENT);
    let [fewer, more] = [enough - 1, enough].map(|n| sees(&furnace(1e-4, n), [1, 4]));
    assert!(more.cut <= SILENT && fewer.cut > SILENT);
    assert_eq!(more.enough_bounces, None);
    // What is too faint no number of bounces brings back.
    let faint = sees(&furnace(0.3, 1), [1, 4]);
    assert!(faint.cut > SILENT);
    assert_eq!(faint.enough_bounces, None);
}

#[test]
fn where_mirrors_are_off_nothing_is_left_out() {
    film_of(0, |_, _, film| assert_eq!(film.left_out.share(), 0.0));
    assert_eq!(sees(&furnace(1e-4, 0), [4, 4]).enough_bounces, None);
}

#[test]
fn a_smaller_cutoff_leaves_out_less() {
    let cut = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5].map(|cutoff| sees(&furnace(cutoff, 64), [6, 3]).cut);
    assert!(cut.windows(2).all(|pair| pair[1] <= pair[0]), "{cut:?}");
    assert!(cut[4] < 1e-4 * cut[0], "{cut:?}");
}

/// Two facing mirrors, one of them half glass, and a camera between them.
fn hall(bounces: &str) -> String {
    format!(
        "{bounces}\n[accuracy]\ncutoff = 0\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"both\"\nscale = 9\ntranslate = [0, 0, -2]\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"both\"\nscale = 9\ntranslate = [0, 0, 2]\n\
         [material.both]\nmirror = {{ spectrum = 1.0 }}\nrefraction = {{ spectrum = 1.0, ior = 3 }}\n\
         [background]\nspectrum = 1.0\n[camera]\n"
    )
}

#[test]
fn a_tree_stays_within_its_size_however_it_branches() {
    let seen = sees(&hall("[effects]\nbounces = 64"), [4, 4]);
    assert!(seen.chain.len() <= 1000, "{}", seen.chain.len());
    assert!(seen.cut < 1e-3, "{}", seen.cut);
}

#[test]
fn bounces_count_the_surfaces_on_the_way_and_none_means_off() {
    let mirror = "[effects]\nbounces = BOUNCES\n\
         [[model]]\nname = \"one\"\nfile = \"wall.obj\"\nmaterial = \"mirror\"\nscale = 9\ntranslate = [0, 0, -2]\n\
         [[model]]\nname = \"two\"\nfile = \"wall.obj\"\nmaterial = \"mirror\"\nscale = 9\ntranslate = [0, 0, 2]\n\
         [material.mirror]\nmirror = { weight = 0.5, spectrum = 1.0 }\nemission = { scale = 1.0, spectrum = 1.0 }\n[camera]\n";
    for (bounces, radiance, cut) in [(0, 1.0, 0.5), (1, 1.5, 0.25), (3, 1.875, 0.0625)] {
        let seen = sees(&mirror.replace("BOUNCES", &bounces.to_string()), [4, 4]);
        assert_eq!(seen.chain.len(), bounces + 1);
        assert_eq!(seen.cut, cut, "{bounces}");
        assert!((seen.radiance[40] - radiance).abs() < 1e-6, "{bounces}");
    }
    let spliced = format!("[[splice]]\nrows = [0.5, 1.0]\neffects = {{ bounces = 1 }}\n{mirror}");
    let spliced = spliced.replace("BOUNCES", "3");
    assert_eq!(
        [3, 5].map(|row| sees(&spliced, [4, row]).chain.len()),
        [4, 2]
    );
}

#[test]
fn a_mirror_of_one_value_is_the_same_whether_it_is_called_constant_or_not() {
    let mirror = "[worldline.w]\nvelocity = [0.1, 0, -0.3]\n\
         [[model]]\nfile = \"wall.obj\"\nworldline = \"w\"\nmaterial = \"mirror\"\nscale = 9\ntranslate = [0, 0, -2]\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"wall\"\nscale = 9\ntranslate = [0, 0, 2]\n\
         [material.mirror]\nmirror = { weight = 0.8, spectrum = SPECTRUM }\n\
         [material.wall]\ndiffuse = { spectrum = { gaussian = { center = 500, width = 40 } } }\n\
         emission = { scale = 0.01, spectrum = { gaussian = { center = 450, width = 20 } } }\nthermal = { temperature = 3000 }\n\
         [[light]]\nkind = \"sun\"\ndirection = [0, 0, 1]\nintensity = 100\n[camera]\n";
    let constant = sees(&mirror.replace("SPECTRUM", "0.5"), [5, 3]);
    let curve = sees(
        &mirror.replace("SPECTRUM", "{ points = [[400, 0.5], [700, 0.5]] }"),
        [5, 3],
    );
    let top = constant.xyz.iter().fold(0.0, |top: f64, v| top.max(*v));
    assert!(top > 1.0);
    for (one, other) in constant.xyz.iter().zip(&curve.xyz) {
        assert!((one - other).abs() < 1e-6 * top, "{constant:?} {curve:?}");
    }
}

#[test]
fn mirrors_and_glass_read_files_that_are_named_in_place() {
    let wall = "[[model]]\nfile = \"wall.obj\"\nmaterial = \"wall\"\ntranslate = [0, 0, -2]\n\
         [material.wall]\nTERM = { spectrum = SPECTRUM }\n[background]\nspectrum = 1.0\n[camera]\n";
    for term in ["mirror", "refraction"] {
        let shot = |spectrum| wall.replace("TERM", term).replace("SPECTRUM", spectrum);
        let in_place = sees(&shot("{ file = \"paint.csv\" }"), [4, 4]);
        let named = "[spectrum.paint]\nfile = \"paint.csv\"\n";
        let by_name = sees(&format!("{named}{}", shot("\"paint\"")), [4, 4]);
        assert!(by_name.xyz[1] > 1.0, "{term}: {by_name:?}");
        assert_eq!(in_place, by_name, "{term}");
    }
}

#[test]
fn glass_has_two_sides_even_where_its_file_says_one() {
    let ball =
        "[[model]]\nfile = \"ball.gltf\"\nMATERIAL[camera]\nposition = [0.1, 0.1, 3]\nhfov = 1\n";
    let glass = "[material.glass]\nrefraction = { spectrum = 1.0 }\n";
    let seen = sees(&ball.replace("MATERIAL", glass), [4, 4]);
    assert_eq!(seen.chain.len(), 2, "it comes out again: {:?}", seen.chain);
    let opaque = sees(&ball.replace("MATERIAL", "").replace("3]", "0]"), [4, 4]);
    assert!(
        opaque.hit.is_none(),
        "from within, the file's own material is not there"
    );
}

#[test]
fn a_headlight_shines_from_the_cameras_own_frame() {
    let shot = |velocity: &str, lamp: &str| {
        format!(
            "[worldline.ship]\nvelocity = {velocity}\n\
             [[model]]\nfile = \"wall.obj\"\nworldline = \"ship\"\nmaterial = \"wall\"\ntranslate = [0, 0, -2]\n\
             [material.wall]\ndiffuse = {{ spectrum = 0.5 }}\n\
             [[light]]\nkind = \"spot\"\nworldline = \"{lamp}\"\nposition = [0, 1, 0]\ndirection = [0, -0.4, -1]\nintensity = 100\n\
             [camera]\nworldline = \"ship\"\n"
        )
    };
    let at_rest = sees(&shot("[0, 0, 0]", "camera"), [4, 4]);
    let moving = sees(
        &shot("{ gamma = 50, direction = [1, 2, 3] }", "camera"),
        [4, 4],
    );
    let named = sees(
        &shot("{ gamma = 50, direction = [1, 2, 3] }", "ship"),
        [4, 4],
    );
    assert!(at_rest.xyz[1] > 0.1);
    assert_eq!(
        (&at_rest.radiance, &at_rest.xyz),
        (&moving.radiance, &moving.xyz)
    );
    assert_eq!(moving, named);
    let left_behind = sees(&shot("[0, 0, 0.9]", "lab"), [4, 4]);
    assert!(left_behind.xyz[1] != at_rest.xyz[1]);
}

#[test]
fn mirrors_and_glass_read_their_spectra_from_files_too() {
    for term in ["mirror", "refraction"] {
        let shot = |spectrum: &str| {
            format!(
                "[[model]]\nfile = \"wall.obj\"\nmaterial = \"m\"\ntranslate = [0, 0, -2]\n\
                 [material.m]\n{term} = {{ weight = 0.9, spectrum = {spectrum} }}\n\
                 [background]\nspectrum = 1.0\n[camera]\n"
            )
        };
        let file = sees(&shot("{ file = \"ramp.csv\" }"), [4, 4]);
        let points = sees(
            &shot("{ points = [[300, 0.1], [900, 0.7]], tension = 0 }"),
            [4, 4],
        );
        assert!(points.xyz[1] > 1.0, "{term}");
        for (file, points) in file.radiance.iter().zip(&points.radiance) {
            assert!((file - points).abs() < 1e-3, "{term}: {file} {points}");
        }
    }
}
