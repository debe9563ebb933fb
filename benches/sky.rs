//! One look at the sky: an image, unshifted and shifted, and stars, over how many there are; and
//! what is done once for a shot.

use divan::{Bencher, black_box};
use glam::DVec3;
use restframe::frame::{Frame, Sensor};
use restframe::scene::sky::{SkyImage, Star, Stars, random_stars};
use restframe::scene::{Library, Scene};
use restframe::shade::{Settings, ShadeScratch, Shader};
use restframe::shot::{self, RandomStars};
use restframe::spectrum::ColoredLight;
use restframe::trace::{Node, Root, Seen, ShadeTrees};

fn main() {
    // Made once a process, 0.15 s on two cores.
    black_box(ColoredLight::new([0.1, 0.2, 0.3]));
    divan::main();
}

fn keys(count: u32) -> RandomStars {
    RandomStars {
        count,
        seed: 1,
        size: 0.05,
        temperature: [3000.0, 30000.0],
        magnitude: [0.0, 6.0],
    }
}

fn directions() -> Vec<DVec3> {
    random_stars(&keys(4096))
        .iter()
        .map(|star| star.direction)
        .collect()
}

/// The light of 4096 directions of a sky under a Doppler factor.
fn light(bencher: Bencher<'_, '_>, sky: &str, doppler: f64) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("speck.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("written");
    let noise = |x: u32, y: u32| image::Rgb([x * 37, y * 91, x * y].map(|v| (v % 251) as u8));
    let image = image::RgbImage::from_fn(512, 256, noise);
    image.save(path("sky.png")).expect("written");
    let text = format!(
        "[worldline.ship]\nvelocity = [0, 0, -0.5]\n[[model]]\nfile = \"speck.obj\"\nmaterial = \"grey\"\n[material.grey]\ndiffuse = {{ spectrum = 0.5 }}\n[camera]\nworldline = \"ship\"\n\
         [background]\nworldline = \"lab\"\n{sky}\n"
    );
    let shot = shot::parse(&text, &path("shot.toml")).expect("a shot");
    let library = Library::load(&shot).expect("files");
    let scene =
        Scene::resolve(&Frame::new(&shot, 1).expect("it moves"), &library, None).expect("a scene");
    let effects = Frame::new(&shot, 1)
        .expect("it moves")
        .active_effects(&shot.effects);
    let settings = Settings {
        effects: &effects,
        accuracy: &shot.accuracy,
        sensor: &Sensor::new(&shot.sensor),
        reach: 1.0,
        lamp_reach: 0.0,
    };
    let shader = Shader::new(&scene, &settings);
    let root = Root {
        first: 0,
        count: 1,
        cut: 0.0,
    };
    let mut trees = ShadeTrees::default();
    let mut scratch = ShadeScratch::default();
    let directions = directions();
    let counter = divan::counter::ItemsCount::new(directions.len());
    bencher.counter(counter).bench_local(|| {
        for direction in black_box(&directions) {
            trees.nodes.clear();
            trees.nodes.push(Node {
                branch: None,
                doppler,
                seen: Seen::Sky(*direction),
            });
            black_box(shader.xyz(&trees, root, &mut scratch));
        }
    });
}

#[divan::bench]
fn spectrum_shifted(bencher: Bencher<'_, '_>) {
    light(bencher, "spectrum = \"D65\"", 1.2);
}

#[divan::bench]
fn image_unshifted(bencher: Bencher<'_, '_>) {
    light(bencher, "image = \"sky.png\"", 1.0);
}

#[divan::bench]
fn image_shifted(bencher: Bencher<'_, '_>) {
    light(bencher, "image = \"sky.png\"", 1.2);
}

#[divan::bench(args = [2000, 100_000, 1_000_000])]
fn stars_shifted(bencher: Bencher<'_, '_>, count: u32) {
    light(bencher, &format!("stars = {{ count = {count} }}"), 1.2);
}

#[divan::bench(args = [2000, 1_000_000], sample_count = 3)]
fn sky_of_stars_is_made(count: u32) -> Stars {
    let stars: Vec<Star> = random_stars(&keys(count));
    Stars::new(&stars, 0.05)
}

/// 2048 × 1024 pixels.
#[divan::bench(args = ["hdr", "exr", "png"], sample_count = 5)]
fn image_is_read(bencher: Bencher<'_, '_>, form: &str) {
    let noise =
        |x: u32, y: u32| image::Rgb([x * 37, y * 91, x * y].map(|v| (v % 251) as f32 / 250.0));
    let image = image::DynamicImage::ImageRgb32F(image::Rgb32FImage::from_fn(2048, 1024, noise));
    let format = image::ImageFormat::from_extension(form).expect("a form");
    let mut bytes = std::io::Cursor::new(Vec::new());
    match form {
        "png" => image.to_rgb8().write_to(&mut bytes, format),
        _ => image.write_to(&mut bytes, format),
    }
    .expect("written");
    bencher.bench_local(|| SkyImage::decode(bytes.get_ref()).expect("an image"));
}
