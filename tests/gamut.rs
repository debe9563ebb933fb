//! Colors that no screen shows, in PNG files of `sensor.gamut` "clip" and "compress".

use crate::common::desk::Desk;
use restframe::color::cie::xyz_bar;
use restframe::color::spaces::{XYZ_FROM_RGB, apply, decode};
use std::io::Cursor;

/// A sky of one spectral line, green at 510 nm, with this luminance over that of the screen's white.
fn line(gamut: &str, luminance: f64) -> String {
    // Of a curve of peak 1 and standard deviation 1 nm: 683 ȳ √(2π) cd/m²; at 0 stops 100 are white.
    let scale = 100.0 * luminance / (683.0 * xyz_bar(510.0)[1] * std::f64::consts::TAU.sqrt());
    format!(
        "[image]\nsize = [2, 2]\nsamples = 1\n[camera]\n\
         [[model]]\nfile = \"sphere.obj\"\ntranslate = [0, 0, 9]\n\
         [background]\nscale = {scale}\nspectrum = {{ gaussian = {{ center = 510, width = 1 }} }}\n\
         [sensor]\nexposure = 0\n{gamut}\n[output]\nformats = [\"png\", \"exr\"]\n"
    )
}

/// The first pixel of a PNG file.
fn pixel(bytes: &[u8]) -> [u8; 3] {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    [pixels[0], pixels[1], pixels[2]]
}

/// Y of a pixel, that of white 1.
fn luminance(pixel: [u8; 3]) -> f64 {
    apply(&XYZ_FROM_RGB, pixel.map(|v| decode(f64::from(v) / 255.0)))[1]
}

fn shown(desk: &Desk, gamut: &str, luminance: f64) -> [u8; 3] {
    desk.write("line.toml", line(gamut, luminance));
    desk.done("render line.toml --force --progress none");
    pixel(&std::fs::read(desk.path("renders/line/line.0001.png")).unwrap())
}

const COMPRESS: &str = "gamut = \"compress\"";

/// A step of eight bits is at most 1 % of the luminances here.
#[test]
fn a_spectral_line_keeps_its_luminance_only_when_it_is_compressed() {
    let desk = Desk::with_sphere();
    for wanted in [0.1, 0.3, 0.5] {
        let error = |pixel| luminance(pixel) / wanted - 1.0;
        let [clipped, compressed] = ["", COMPRESS].map(|gamut| error(shown(&desk, gamut, wanted)));
        assert!(compressed.abs() < 0.01, "{wanted}: {compressed}");
        assert!(clipped > 0.05, "{wanted}: {clipped}");
    }
    assert_eq!(shown(&desk, COMPRESS, 1.5), [255; 3]);
}

#[test]
fn the_gamut_concerns_png_files_alone() {
    let desk = Desk::with_sphere();
    let exr = |gamut| {
        shown(&desk, gamut, 0.3);
        let file = exr::prelude::read_first_rgba_layer_from_file(
            desk.path("renders/line/line.0001.exr"),
            |size, _| vec![[0.0f32; 3]; size.area()],
            |pixels, at, (r, g, b, _): (f32, f32, f32, f32)| pixels[at.0 + 2 * at.1] = [r, g, b],
        );
        file.unwrap().layer_data.channel_data.pixels
    };
    let [clipped, compressed] = ["", COMPRESS].map(exr);
    assert!(clipped[0][0] < 0.0, "{clipped:?}");
    assert_eq!(clipped, compressed);
}

/// Bands are no colors: nothing of them is hue.
#[test]
fn bands_are_clipped_always() {
    let desk = Desk::with_sphere();
    let bands = |gamut: &str| shown(&desk, &format!("color = \"bands\"\n{gamut}"), 2.0);
    assert_eq!(bands(""), bands(COMPRESS));
}
