//! Images: where their pixels are, and that an unshifted one shows its own colours.

use super::{Folder, looking, off};
use restframe::color::spaces::decode;
use restframe::spectrum::illuminant;
use restframe::spectrum::luminous_integral;

/// `scale` under which a white pixel is 1 at exposure 0.
fn unit_scale() -> f64 {
    100.0 / luminous_integral(&illuminant("D65").unwrap())
}

/// White ahead, red to the right, blue behind, yellow to the left, green above, magenta below.
fn marks(x: u32, y: u32) -> [f32; 3] {
    match (x, y) {
        (_, 0..=1) => [0.0, 1.0, 0.0],
        (_, 14..=15) => [1.0, 0.0, 1.0],
        (14..=17, 6..=9) => [1.0, 1.0, 1.0],
        (22..=25, 6..=9) => [1.0, 0.0, 0.0],
        (30..=31 | 0..=1, 6..=9) => [0.0, 0.0, 1.0],
        (6..=9, 6..=9) => [1.0, 1.0, 0.0],
        _ => [0.0; 3],
    }
}

#[test]
fn marks_are_seen_where_they_were_painted_in_every_format() {
    let folder = Folder::new();
    folder.paint("sky.hdr", [32, 16], marks);
    folder.paint("sky.exr", [32, 16], marks);
    let bytes = |x, y| image::Rgb(marks(x, y).map(|v| (255.0 * v) as u8));
    image::RgbImage::from_fn(32, 16, bytes)
        .save(folder.path("sky.png"))
        .unwrap();
    for file in ["sky.hdr", "sky.exr", "sky.png"] {
        for (yaw, pitch, expected) in [
            (0.0, 0.0, [1.0, 1.0, 1.0]),
            (15.0, -10.0, [1.0, 1.0, 1.0]),
            (90.0, 0.0, [1.0, 0.0, 0.0]),
            (180.0, 0.0, [0.0, 0.0, 1.0]),
            (-90.0, 0.0, [1.0, 1.0, 0.0]),
            (45.0, 0.0, [0.0, 0.0, 0.0]),
            (0.0, 90.0, [0.0, 1.0, 0.0]),
            (123.0, 80.0, [0.0, 1.0, 0.0]),
            (0.0, -90.0, [1.0, 0.0, 1.0]),
        ] {
            let sky = format!("image = \"{file}\"\nscale = {}", unit_scale());
            let (probe, _) = folder.sees(&looking(yaw, pitch, &sky));
            let apart = (0..3).map(|c| (probe.rgb[c] - expected[c]).abs());
            let apart = apart.fold(0.0, f64::max);
            assert!(apart < 1e-3, "{file} {yaw} {pitch}: {:?}", probe.rgb);
        }
    }
}

#[test]
fn an_unshifted_image_shows_its_own_colours() {
    let folder = Folder::new();
    let colors: [[f32; 3]; 12] = [
        [1.0, 1.0, 1.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.2, 0.7, 0.4],
        [0.03, 0.02, 0.9],
        [1e-6, 3e-6, 2e-6],
        [50.0, 3000.0, 400.0],
        [0.9, 0.5, 0.1],
        [0.0, 0.02, 0.02],
        [0.7, 0.0, 0.71],
        [1e6, 1e6, 0.0],
    ];
    for color in colors {
        folder.paint("sky.exr", [2, 1], |_, _| color);
        let sky = format!("image = \"sky.exr\"\nscale = {}", unit_scale());
        let (probe, imaged) = folder.sees(&looking(33.0, 5.0, &sky));
        let wanted = color.map(f64::from);
        assert!(
            off(&probe.rgb, &wanted) < 1e-3,
            "{color:?}: {:?}",
            probe.rgb
        );
        assert!(off(&imaged, &probe.xyz) < 1e-3, "{color:?}: {imaged:?}");
    }
}

#[test]
fn a_png_is_srgb_of_8_or_16_bits_grey_or_with_alpha() {
    use image::{GrayImage, ImageBuffer, Luma, Rgb, Rgba, RgbaImage};
    let folder = Folder::new();
    let half = decode(0.5);
    let deep = ImageBuffer::<Rgb<u16>, _>::from_pixel(2, 1, Rgb([65535, 32768, 0]));
    deep.save(folder.path("deep.png")).unwrap();
    GrayImage::from_pixel(2, 1, Luma([128]))
        .save(folder.path("grey.png"))
        .unwrap();
    RgbaImage::from_pixel(2, 1, Rgba([255, 128, 0, 7]))
        .save(folder.path("alpha.png"))
        .unwrap();
    let eighth = decode(128.0 / 255.0);
    for (file, wanted) in [
        ("deep.png", [1.0, half, 0.0]),
        ("grey.png", [eighth; 3]),
        ("alpha.png", [1.0, eighth, 0.0]),
    ] {
        let sky = format!("image = \"{file}\"\nscale = {}", unit_scale());
        let (probe, _) = folder.sees(&looking(0.0, 0.0, &sky));
        assert!(off(&probe.rgb, &wanted) < 1e-3, "{file}: {:?}", probe.rgb);
    }
}

#[test]
fn a_grey_image_is_the_spectrum_d65_times_scale() {
    let folder = Folder::new();
    folder.paint("sky.exr", [2, 1], |_, _| [1.0; 3]);
    for scale in [0.5, 3.0] {
        let image = format!("image = \"sky.exr\"\nscale = {scale}");
        let spectrum = format!("spectrum = \"D65\"\nscale = {scale}");
        let [image, spectrum] = [image, spectrum].map(|sky| {
            [looking(0.0, 0.0, &sky), super::moving(0.8, 40.0, &sky)].map(|s| folder.sees(&s))
        });
        for (image, spectrum) in image.iter().zip(&spectrum) {
            assert!(off(&image.0.radiance, &spectrum.0.radiance) < 1e-6);
            assert!(off(&image.1, &spectrum.1) < 1e-3);
        }
    }
}

#[test]
fn a_scale_may_move_and_darkens_no_stars() {
    let folder = Folder::new();
    folder.paint("sky.hdr", [2, 1], |_, _| [0.5, 0.25, 0.125]);
    folder.write("stars.csv", "0, 0, 5000, 1\n");
    let dark = "image = \"sky.hdr\"\nscale = { from = 0, to = 1 }";
    let (probe, _) = folder.sees(&looking(0.0, 0.0, dark));
    assert_eq!(probe.xyz, [0.0; 3]);
    let stars = "stars = { file = \"stars.csv\", size = 0.1 }";
    let (alone, _) = folder.sees(&looking(0.0, 0.0, stars));
    let (with, _) = folder.sees(&looking(0.0, 0.0, &format!("{dark}\n{stars}")));
    assert!(alone.xyz[1] > 0.0);
    assert_eq!(alone.xyz, with.xyz);
    let lit = format!("image = \"sky.hdr\"\n{stars}");
    let (both, _) = folder.sees(&looking(0.0, 0.0, &lit));
    let (image, _) = folder.sees(&looking(0.0, 0.0, "image = \"sky.hdr\""));
    let sum = [0, 1, 2].map(|c| alone.xyz[c] + image.xyz[c]);
    assert!(off(&both.xyz, &sum) < 1e-12);
}
