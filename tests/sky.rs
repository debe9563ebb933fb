//! Skies: images, stars, and what motion makes of them. Oracles are the formulas of aberration
//! and of Planck's law, the images' own pixels, and the definition of magnitude.

mod bad;
mod files;
mod image;
mod motion;
mod stars;

use ::image::{DynamicImage, Rgb, Rgb32FImage};
use glam::DVec3;
use restframe::film::Film;
use restframe::frame::{Frame, Sensor};
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::{Options, View, render};
use restframe::scene::Scene;
use restframe::shade::{Settings, ShadeScratch, Shader};
use restframe::trace::{Node, Root, Scratch, Seen, ShadeTrees, build_aggregate};
use std::path::PathBuf;

/// A folder with a model far off and whatever files a sky needs.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let speck = "v 0 9000 0\nv 1 9000 0\nv 0 9000 1\nf 1 2 3\n";
        std::fs::write(folder.path().join("speck.obj"), speck).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).unwrap();
    }

    /// Writes an image of `width` columns; the form is the name's extension.
    fn paint(&self, name: &str, [width, height]: [u32; 2], rgb: impl Fn(u32, u32) -> [f32; 3]) {
        let image = Rgb32FImage::from_fn(width, height, |x, y| Rgb(rgb(x, y)));
        let image = DynamicImage::ImageRgb32F(image);
        image.save(self.path(name)).unwrap();
    }

    /// A shot of one pixel, or of more, with these tables beside its model.
    fn shot(&self, size: u32, rest: &str) -> Result<Prepared, restframe::shot::Mistakes> {
        let path = self.path("shot.toml");
        let text = format!(
            "[image]\nsize = [{size}, {size}]\n[sensor]\nexposure = 0\n\
             [[model]]\nfile = \"speck.obj\"\nmaterial = \"grey\"\n\
             [material.grey]\ndiffuse = {{ spectrum = 0.5 }}\n{rest}"
        );
        std::fs::write(&path, text).unwrap();
        Prepared::read(&path)
    }

    /// What the camera sees straight ahead: by the curve, and XYZ as images have it.
    fn sees(&self, rest: &str) -> (Probe, [f64; 3]) {
        let prepared = self.shot(1, rest).unwrap_or_else(|m| panic!("{m}"));
        let shot = &prepared.shot;
        let frame = Frame::new(shot, 1).unwrap();
        let scene = Scene::resolve(&frame, &prepared.library, None).unwrap();
        let aggregate = build_aggregate(&scene.geometry, None);
        let view = View::new(&frame, &shot.effects, &scene, &aggregate);
        let mut trees = ShadeTrees::default();
        let direction = scene.camera.looks_along([0.5, 0.5]).unwrap();
        view.tracer()
            .trace(&[direction], &mut Scratch::default(), &mut trees);
        let shader = view.shader();
        let imaged = shader.xyz(&trees, trees.roots[0], &mut ShadeScratch::default());
        (probe(&frame, [0, 0], &view, &scene, 0.0), imaged)
    }

    /// An image of `size` × `size` pixels, one sample each.
    fn film(&self, size: u32, rest: &str) -> Film {
        let prepared = self.shot(size, rest).unwrap_or_else(|m| panic!("{m}"));
        let frame = Frame::new(&prepared.shot, 1).unwrap();
        let scene = Scene::resolve(&frame, &prepared.library, None).unwrap();
        let aggregate = build_aggregate(&scene.geometry, None);
        let options = Options {
            width: size,
            height: size,
            samples: 1,
            layers: Vec::new(),
        };
        render(&frame, &scene, &aggregate, &options, &|_| ())
    }
}

/// A camera that looks along a yaw and a pitch in degrees, with one more table.
fn looking(yaw: f64, pitch: f64, background: &str) -> String {
    format!("[camera]\nyaw = {yaw}\npitch = {pitch}\nhfov = 1\n[background]\n{background}\n")
}

/// The same on a camera that moves ahead, along −z, at `beta` through a sky at rest in the lab.
fn moving(beta: f64, yaw: f64, background: &str) -> String {
    format!(
        "[worldline.ship]\nvelocity = [0, 0, {}]\n[camera]\nworldline = \"ship\"\nyaw = {yaw}\nhfov = 1\n\
         [background]\nworldline = \"lab\"\n{background}\n",
        -beta
    )
}

/// A shader of a shot's sky for any Doppler factor.
fn shader(prepared: &Prepared) -> Shader {
    let shot = &prepared.shot;
    let scene = Scene::resolve(&Frame::new(shot, 1).unwrap(), &prepared.library, None).unwrap();
    let effects = Frame::new(shot, 1).unwrap().active_effects(&shot.effects);
    let settings = Settings {
        effects: &effects,
        accuracy: &shot.accuracy,
        sensor: &Sensor::new(&shot.sensor),
        reach: 175.0,
        lamp_reach: 1.0,
    };
    Shader::new(&scene, &settings)
}

/// XYZ of the sky by the image's way and by the curve's.
fn both(shader: &Shader, doppler: f64, direction: DVec3) -> [[f64; 3]; 2] {
    let root = Root {
        first: 0,
        count: 1,
        cut: 0.0,
    };
    let trees = ShadeTrees {
        nodes: vec![Node {
            branch: None,
            doppler,
            seen: Seen::Sky(direction),
        }],
        ..ShadeTrees::default()
    };
    let radiance = shader.radiance(&trees, root).total();
    assert!(radiance.iter().all(|v| v.is_finite() && *v >= 0.0));
    [
        shader.xyz(&trees, root, &mut ShadeScratch::default()),
        shader.xyz_of(&radiance),
    ]
}

/// The largest difference of components, over the greatest expected.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let top = expected
        .iter()
        .fold(f64::MIN_POSITIVE, |t, v| v.abs().max(t));
    let apart = found.iter().zip(expected).map(|(f, e)| (f - e).abs() / top);
    apart.fold(0.0, |worst, off| if off <= worst { worst } else { off })
}
