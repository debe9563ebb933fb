//! Small scenes, written to a folder of their own: shots of one wall, box or ball.

use restframe::film::Film;
use restframe::frame::Frame;
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::{Options, View, render};
use restframe::scene::Scene;
use restframe::trace::build_aggregate;

/// A sky of 4 × 3 texels as a Radiance file, in letters: three of mantissa and an exponent of 127
/// make m/512.
const CLOUDS: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n\
    abz\u{7f}zAa\u{7f}0Zz\u{7f}zzz\u{7f}9aZ\u{7f}z00\u{7f}Aa9\u{7f}ZZ0\u{7f}azA\u{7f}0z9\u{7f}99z\u{7f}a0Z\u{7f}";

/// A shot read from text. `wall.obj` is the square |x|, |y| ≤ 1 at z = 0 facing +z, `box.obj` the
/// cube of half-edge 1, `ball.obj` a unit sphere of flat facets with vertex normals, `sky.hdr` an
/// image of the whole sky.
pub(crate) struct Set {
    pub(crate) prepared: Prepared,
    _folder: tempfile::TempDir,
}

impl Set {
    /// Reads `text`, the whole of a shot.
    pub(crate) fn new(text: &str) -> Self {
        Self::with(&[], text)
    }

    /// A shot that has further `files`, by name and content.
    pub(crate) fn with(files: &[(&str, &str)], text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let write =
            |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        write(
            "wall.obj",
            "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n",
        );
        write("box.obj", &cube());
        write("sky.hdr", CLOUDS);
        write(
            "ball.obj",
            &std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sphere.obj"))
                .unwrap(),
        );
        for (name, content) in files {
            write(name, content);
        }
        let path = folder.path().join("case.toml");
        write("case.toml", text);
        let prepared =
            Prepared::read(&path).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes}"));
        Self {
            prepared,
            _folder: folder,
        }
    }

    /// What the centre of a pixel sees in frame 1.
    pub(crate) fn probe(&self, pixel: [u32; 2]) -> Probe {
        let shot = &self.prepared.shot;
        let scene = self.scene();
        let aggregate = build_aggregate(&scene.geometry, None);
        let frame = Frame::new(shot, 1).unwrap();
        let view = View::new(&frame, &shot.effects, &scene, &aggregate);
        let stops = self.prepared.exposure().unwrap().0.stops(&frame);
        probe(&frame, pixel, &view, &scene, stops)
    }

    /// Frame 1, resolved.
    pub(crate) fn scene(&self) -> Scene {
        Scene::resolve(
            &Frame::new(&self.prepared.shot, 1).unwrap(),
            &self.prepared.library,
            None,
        )
        .unwrap()
    }

    /// Frame 1 as the film has it, with all layers.
    pub(crate) fn film(&self) -> Film {
        self.film_of(&self.scene())
    }

    /// A scene that stands in for frame 1's own.
    pub(crate) fn film_of(&self, scene: &Scene) -> Film {
        use restframe::shot::Layer::{Distance, Doppler, EmissionTime, Worldline};
        let shot = &self.prepared.shot;
        let aggregate = build_aggregate(&scene.geometry, None);
        let [width, height] = shot.image.size;
        let options = Options {
            width,
            height,
            samples: shot.image.samples,
            layers: vec![Distance, Doppler, EmissionTime, Worldline],
        };
        render(
            &Frame::new(shot, 1).unwrap(),
            scene,
            &aggregate,
            &options,
            &|_| (),
        )
    }
}

fn cube() -> String {
    let corner = |i: u32, bit: u32| if i & bit == 0 { -1 } else { 1 };
    let mut cube: String = (0..8)
        .map(|i| format!("v {} {} {}\n", corner(i, 1), corner(i, 2), corner(i, 4)))
        .collect();
    for f in [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ] {
        cube += &format!("f {f}\n");
    }
    cube
}
