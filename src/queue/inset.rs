//! Plots of single pixels, drawn into a frame's picture.

use crate::frame::Frame;
use crate::plot::raster;
use crate::plot::{LEAST_INSET, lay_out_inset, svg};
use crate::probe;
use crate::render::View;
use crate::scene::Scene;
use crate::shot::Inset;
use crate::trace::Stage;

/// A frame whose pixels are looked at.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a> {
    pub(super) frame: &'a Frame<'a>,
    pub(super) scene: &'a Scene,
    pub(super) stage: &'a Stage,
    /// Stops.
    pub(super) exposure: f64,
}

impl Seen<'_> {
    /// Draws the shot's insets into a picture of three bytes a pixel. Returns why some are not there.
    pub(super) fn draw_insets(self, rgb8: &mut [u8], size: [u32; 2]) -> Vec<String> {
        let insets = self.frame.insets.iter();
        insets
            .filter_map(|inset| self.draw(inset, rgb8, size).err())
            .collect()
    }

    fn draw(self, inset: &Inset, rgb8: &mut [u8], size: [u32; 2]) -> Result<(), String> {
        let pixel = inset.pixel_of(self.frame.image.size);
        let [x, y] = pixel;
        let (corner, [width, height]) = inset.place_in(size);
        if f64::from(height) < LEAST_INSET {
            return Err(format!(
                "the inset of pixel {x} {y} is left out: it would be {height} pixels high, and needs {LEAST_INSET} to be read; render a larger image, or raise its `size`"
            ));
        }
        let effects = self.frame.effects_at(y);
        let view = View::new(self.frame, &effects, self.scene, self.stage);
        let plot = probe::inset(self.frame, pixel, &view, self.scene, self.exposure);
        let drawing = lay_out_inset(&plot, [width, height].map(f64::from));
        let drawn = raster::paint(&svg(&drawing), width, height).ok_or_else(|| {
            format!("the inset of pixel {x} {y} is too large to be painted; lower its `size`")
        })?;
        drawn.lay_over(rgb8, size[0], corner);
        Ok(())
    }
}
