//! `[sequence]`, what is assembled from finished frames, and `[[inset]]`, plots drawn into them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `[sequence]`: what is assembled from the finished frames. Changing it renders no frame anew.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sequence {
    /// A contact sheet of all frames with captions, STEM.sheet.png. Default: none.
    pub sheet: Option<Sheet>,
    /// An animation of 256 colors, STEM.gif. Default: false.
    pub gif: bool,
    /// An animation of all colors, STEM.apng. Default: false.
    pub apng: bool,
    /// A video by ffmpeg. Default: none.
    pub video: Option<Video>,
    /// Whether the parts of a spliced image stand side by side, not one above the other. Default: false.
    pub splices: bool,
    /// A page about the frames, index.html. Default: true.
    pub page: bool,
}

impl Default for Sequence {
    fn default() -> Self {
        Self {
            sheet: None,
            gif: false,
            apng: false,
            video: None,
            splices: false,
            page: true,
        }
    }
}

/// Largest number of frames in a row of a contact sheet.
pub const MOST_COLUMNS: u32 = 100;

/// A contact sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sheet {
    /// Frames in a row, from 1 to 100. Default: 6.
    #[schemars(range(min = 1, max = MOST_COLUMNS))]
    pub columns: u32,
    /// Width of a frame on the sheet, pixels, from 16 to 4096. Default: 320.
    #[schemars(range(min = 16, max = 4096))]
    pub width: u32,
}

impl Default for Sheet {
    fn default() -> Self {
        Self {
            columns: 6,
            width: 320,
        }
    }
}

/// A kind of video.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Video {
    /// H.264 in STEM.mp4: plays everywhere.
    Mp4,
    /// AV1 in STEM.av1.mp4: half the size.
    Av1,
}

/// `[[inset]]`: a plot of one pixel's curves, drawn into the PNG.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Inset {
    /// "center", or [x, y] in an image of the full size. Default: "center".
    #[serde(default)]
    pub pixel: InsetPixel,
    /// The corner that it stands in. Default: "lower-left".
    #[serde(default)]
    pub place: Corner,
    /// Its height as a share of the image's, from 0.1 to 1. Default: 0.4.
    #[serde(default = "usual_size")]
    #[schemars(range(min = 0.1, max = 1.0))]
    pub size: f64,
}

/// Ratio of width to height of an inset.
const ASPECT: f64 = 4.0 / 3.0;
/// Distance of an inset from the image's edges, as a share of the image's height.
const MARGIN: f64 = 0.02;

impl Inset {
    /// The pixel whose curves are plotted, in an image of this size.
    pub fn pixel_of(&self, size: [u32; 2]) -> [u32; 2] {
        match self.pixel {
            InsetPixel::At(pixel) => pixel,
            InsetPixel::Named(PixelName::Center) => size.map(|side| side / 2),
        }
    }

    /// Upper left pixel and size of the inset in an image of this size. The ratio of its sides is 4:3;
    /// it is smaller than `size` if the image has no room for it.
    pub fn place_in(&self, [width, height]: [u32; 2]) -> ([u32; 2], [u32; 2]) {
        let margin = (MARGIN * f64::from(height)).round();
        let margin = margin.min(f64::from(width.min(height) / 2));
        let room = [width, height].map(|side| (f64::from(side) - 2.0 * margin).max(0.0));
        let own_height = (self.size * f64::from(height))
            .min(room[1])
            .min(room[0] / ASPECT);
        let own_height = own_height.floor();
        let own = [(own_height * ASPECT).floor(), own_height].map(|side| side as u32);
        let margin = margin as u32;
        let right = width.saturating_sub(margin + own[0]);
        let low = height.saturating_sub(margin + own[1]);
        let corner = match self.place {
            Corner::UpperLeft => [margin, margin],
            Corner::UpperRight => [right, margin],
            Corner::LowerLeft => [margin, low],
            Corner::LowerRight => [right, low],
        };
        (corner, own)
    }
}

fn usual_size() -> f64 {
    0.4
}

/// The pixel of an inset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum InsetPixel {
    /// Column and row; [0, 0] is the upper left one.
    At([u32; 2]),
    /// By a word.
    Named(PixelName),
}

impl Default for InsetPixel {
    fn default() -> Self {
        Self::Named(PixelName::Center)
    }
}

/// A pixel by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PixelName {
    /// The one in the middle, right and below of it where sides are even.
    Center,
}

/// A corner of the image.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Corner {
    /// Upper left.
    UpperLeft,
    /// Upper right.
    UpperRight,
    /// Lower left.
    #[default]
    LowerLeft,
    /// Lower right.
    LowerRight,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inset(place: Corner, size: f64) -> Inset {
        Inset {
            pixel: InsetPixel::default(),
            place,
            size,
        }
    }

    #[test]
    fn insets_stand_within_the_image_whatever_its_size() {
        use Corner::{LowerLeft, LowerRight, UpperLeft, UpperRight};
        for size in [
            [1, 1],
            [1, 32768],
            [32768, 1],
            [7, 5],
            [90, 1600],
            [1280, 720],
        ] {
            for place in [UpperLeft, UpperRight, LowerLeft, LowerRight] {
                for share in [0.1, 0.4, 1.0] {
                    let (corner, own) = inset(place, share).place_in(size);
                    for axis in 0..2 {
                        assert!(corner[axis] + own[axis] <= size[axis], "{size:?} {place:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn an_inset_is_so_much_of_the_height_and_stands_off_the_edges() {
        let lower = inset(Corner::LowerRight, 0.4).place_in([1280, 720]);
        // 14 pixels, 2 % of the height, from the right and the lower edge.
        assert_eq!(lower, ([1280 - 384 - 14, 720 - 288 - 14], [384, 288]));
        let upper = inset(Corner::UpperLeft, 0.4).place_in([1280, 720]);
        assert_eq!(upper, ([14, 14], [384, 288]));
        assert_eq!(
            inset(Corner::UpperLeft, 0.4).pixel_of([1280, 721]),
            [640, 360]
        );
    }
}
