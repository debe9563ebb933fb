//! Drawings as pixels: an SVG text painted at any size, sharp, with the same bytes everywhere.

use resvg::{tiny_skia, usvg};

/// Painted pixels, in front of whatever they are laid over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and opacity, four bytes a pixel, the colours not multiplied by opacity.
    pub rgba8: Vec<u8>,
}

/// Paints an SVG text to fill `width` x `height` pixels. None if it is no SVG or a side is 0.
pub fn paint(svg: &str, width: u32, height: u32) -> Option<Raster> {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).ok()?;
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
