//! Drawings as pixels: SVG text painted at any size, with the same bytes everywhere.
//!
//! Text is set in the font that the program carries, `src/plot/font/` (ASCII, Latin-1 and
//! mathematical characters of DejaVu Sans, regular and bold; written by `scripts/make-font`),
//! whatever family the SVG names, and no file is opened. A character that the font lacks becomes an
//! empty box. Painting runs on one thread, and its instructions are chosen at compile time, not by
//! the processor at hand.

use resvg::{tiny_skia, usvg};
use std::sync::{Arc, LazyLock};
use usvg::fontdb::{Database, Weight};

/// Largest number of pixels of a raster: 2²⁷, a sheet of 8192 x 16384.
pub const MOST_PIXELS: u64 = 1 << 27;

const FACES: [&[u8]; 2] = [
    include_bytes!("font/regular.ttf"),
    include_bytes!("font/bold.ttf"),
];

/// The font, parsed once.
static FONT: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut database = Database::new();
    for face in FACES {
        database.load_font_data(face.to_vec());
    }
    Arc::new(database)
});

/// Painted pixels with opacity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue and opacity, four bytes per pixel; colors are not multiplied by opacity.
    pub rgba8: Vec<u8>,
}

impl Raster {
    /// Blends the raster over an image of three bytes per pixel and `width` pixels per row, with
    /// its upper left pixel at `corner` (column, row). Parts outside the image are dropped. Display
    /// values are mixed, as browsers do.
    pub fn lay_over(&self, rgb8: &mut [u8], width: u32, corner: [u32; 2]) {
        let [left, top] = corner.map(|pixels| pixels as usize);
        let width = width as usize;
        let shown = (self.width as usize).min(width.saturating_sub(left));
        let rows = rgb8.chunks_exact_mut(3 * width.max(1)).skip(top);
        for (under, over) in rows.zip(self.rgba8.chunks_exact(4 * self.width.max(1) as usize)) {
            let pixels = under.chunks_exact_mut(3).skip(left).take(shown);
            for (under, over) in pixels.zip(over.chunks_exact(4)) {
                let opacity = u32::from(over[3]);
                for (under, over) in under.iter_mut().zip(over) {
                    let sum = u32::from(*over) * opacity + u32::from(*under) * (255 - opacity);
                    *under = ((sum + 127) / 255) as u8;
                }
            }
        }
    }
}

/// Paints SVG text to fill `width` x `height` pixels. None if it is not SVG, if a side is 0, or if
/// there are more than [`MOST_PIXELS`].
pub fn paint(svg: &str, width: u32, height: u32) -> Option<Raster> {
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return None;
    }
    let tree = usvg::Tree::from_str(svg, &options()).ok()?;
    let mut pixels = tiny_skia::Pixmap::new(width, height)?;
    let size = tree.size();
    let scale = tiny_skia::Transform::from_scale(
        width as f32 / size.width(),
        height as f32 / size.height(),
    );
    resvg::render(&tree, scale, &mut pixels.as_mut());
    let rgba8 = pixels
        .pixels()
        .iter()
        .flat_map(|pixel| {
            let color = pixel.demultiply();
            [color.red(), color.green(), color.blue(), color.alpha()]
        })
        .collect();
    Some(Raster {
        width,
        height,
        rgba8,
    })
}

/// Options of the SVG parser: only the weight of a font family counts, and images that a text names
/// are not opened.
fn options() -> usvg::Options<'static> {
    usvg::Options {
        fontdb: FONT.clone(),
        font_resolver: usvg::FontResolver {
            select_font: Box::new(|font, fonts| {
                let bold = Weight(font.weight()) >= Weight::SEMIBOLD;
                let fits = |weight: Weight| (weight >= Weight::SEMIBOLD) == bold;
                fonts.faces().find(|face| fits(face.weight)).map(|f| f.id)
            }),
            select_fallback: Box::new(|_, _, _| None),
        },
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    }
}

/// The characters of `text` that the font lacks, found by comparing them with its box.
#[cfg(test)]
pub(super) fn missing(text: &str) -> Vec<char> {
    const SIDE: u32 = 40;
    let painted = |character: char| {
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{SIDE}' height='{SIDE}'>\
             <text x='5' y='30' font-size='30'>&#{};</text></svg>",
            u32::from(character)
        );
        paint(&svg, SIDE, SIDE)
    };
    // A private-use character, which the font does not have.
    let boxed = painted('\u{e000}');
    text.chars().filter(|c| painted(*c) == boxed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(family: &str, weight: &str, words: &str) -> String {
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='120' height='30'><text x='5' y='20' \
             font-family='{family}' font-weight='{weight}' font-size='14'>{words}</text></svg>"
        )
    }

    /// Opaque parts of pixels, in pixels.
    fn ink(svg: &str) -> f64 {
        let raster = paint(svg, 120, 30).expect("it is an SVG");
        let opacities = raster
            .rgba8
            .chunks_exact(4)
            .map(|pixel| f64::from(pixel[3]));
        opacities.sum::<f64>() / 255.0
    }

    #[test]
    fn text_is_set_in_our_font_whatever_family_is_named() {
        let plain = paint(&words("DejaVu Sans", "normal", "D = 1.34 λ"), 120, 30);
        for family in ["Helvetica", "serif", "monospace", "No Such Font", ""] {
            assert_eq!(
                paint(&words(family, "normal", "D = 1.34 λ"), 120, 30),
                plain
            );
        }
        // Stems of the bold face are half as wide again.
        let [plain, bold] = ["normal", "bold"].map(|weight| ink(&words("x", weight, "nm")));
        assert!(plain > 20.0 && bold > 1.3 * plain, "{plain} {bold}");
    }

    #[test]
    fn a_character_that_the_font_lacks_is_a_box_and_is_told_of() {
        assert!(
            missing("λ = 550 nm, 10⁻³ W·m⁻²·sr⁻¹·nm⁻¹; Kügelchen … – 25 °C ± ½ µm → γβ").is_empty()
        );
        assert_eq!(missing("a字b"), ['字']);
        assert!(ink(&words("x", "normal", "字")) > 5.0);
        assert_eq!(ink(&words("x", "normal", " ")), 0.0);
    }

    #[test]
    fn equal_texts_give_equal_bytes_on_any_thread() {
        let svg = words("x", "bold", "T = 1663 K");
        let alone = paint(&svg, 480, 120);
        let threads: Vec<_> = (0..4)
            .map(|_| {
                let svg = svg.clone();
                std::thread::spawn(move || paint(&svg, 480, 120))
            })
            .collect();
        for thread in threads {
            assert_eq!(thread.join().expect("it paints"), alone);
        }
    }

    #[test]
    fn what_cannot_be_painted_is_none_and_no_panic() {
        let svg = words("x", "normal", "a");
        assert!(paint(&svg, 0, 30).is_none() && paint(&svg, 30, 0).is_none());
        assert!(paint(&svg, u32::MAX, u32::MAX).is_none());
        assert!(paint(&svg, 1, 1).is_some());
        for text in [
            "",
            "svg",
            "<svg/>",
            "<svg xmlns='http://www.w3.org/2000/svg' width='-1'/>",
        ] {
            if let Some(raster) = paint(text, 9, 9) {
                assert_eq!(raster.rgba8, [0; 4 * 81], "{text}");
            }
        }
        // Cut and bent anywhere, in whole characters.
        for (end, _) in svg.char_indices() {
            let _ = paint(&svg[..end], 9, 9);
            let bent: String = svg
                .char_indices()
                .map(|(i, c)| if i == end { '9' } else { c })
                .collect();
            let _ = paint(&bent, 9, 9);
        }
    }

    #[test]
    fn a_file_that_a_text_names_is_not_opened() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let file = folder.path().join("dot.svg");
        let dot = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'>\
                   <rect width='9' height='9'/></svg>";
        std::fs::write(&file, dot).expect("it can be written");
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><image href='{}' \
             width='9' height='9'/></svg>",
            file.display()
        );
        let tree = |options| usvg::Tree::from_str(&svg, &options).expect("it is an SVG");
        assert!(tree(usvg::Options::default()).root().has_children());
        assert!(!tree(options()).root().has_children());
    }

    #[test]
    fn what_is_laid_over_a_picture_hides_it_as_far_as_it_is_opaque() {
        let raster = Raster {
            width: 2,
            height: 2,
            rgba8: [
                [255, 0, 0, 255],
                [0, 0, 0, 0],
                [200, 100, 0, 51],
                [9, 9, 9, 255],
            ]
            .concat(),
        };
        let mut rgb8 = vec![100; 3 * 9];
        raster.lay_over(&mut rgb8, 3, [1, 1]);
        let mut expected = vec![100; 3 * 9];
        expected[12..15].copy_from_slice(&[255, 0, 0]);
        // A fifth of it and four fifths of what is below.
        expected[21..24].copy_from_slice(&[120, 100, 80]);
        expected[24..27].copy_from_slice(&[9, 9, 9]);
        assert_eq!(rgb8, expected);
        let mut corner = vec![100; 3 * 9];
        raster.lay_over(&mut corner, 3, [2, 2]);
        expected = vec![100; 3 * 9];
        expected[24..27].copy_from_slice(&[255, 0, 0]);
        assert_eq!(corner, expected);
        raster.lay_over(&mut corner, 3, [7, 1]);
        assert_eq!(corner, expected);
    }
}
