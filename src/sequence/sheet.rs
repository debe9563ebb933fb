//! A contact sheet: all frames small, each with a caption, and a title on top.
//!
//! Rows of cells are written as they fill, so that a sheet of any length takes the memory of one
//! row. A cell is the frame, reduced in linear light to the width in the shot and never enlarged,
//! with its caption below.

use super::frame_image::{FrameImage, reduce};
use super::output::Encoder;
use super::splices::Splices;
use crate::frame::Caption;
use crate::plot::escaped;
use crate::plot::raster;
use crate::shot::{LARGEST_SIDE, MOST_COLUMNS, Shot};
use crate::store::{AtomicFile, AtomicWriter, ShotFolder};
use std::io::{self, Write};
use std::path::PathBuf;

/// Space between and around cells, pixels.
const GAP: u32 = 8;
/// Background: a gray against which black frames are visible.
const GROUND: u8 = 34;
/// Smallest width of a cell that the shot can ask for, pixels.
const NARROWEST: u32 = 16;
/// Width that the caption of a cell needs, pixels, however small its frame is.
const CAPTION: u32 = 200;

/// Positions and sizes on a sheet, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    columns: u32,
    /// Width of a cell, and of the frame in it.
    width: u32,
    picture: [u32; 2],
    /// Sizes of a caption's letters and lines.
    letters: f64,
    line: u32,
    lines: u32,
    title: u32,
    size: [u32; 2],
}

impl Layout {
    fn new(frames: u32, columns: u32, width: u32, shown: [u32; 2], lines: u32) -> Self {
        let columns = columns.min(frames).max(1);
        let [across, down] = shown.map(f64::from);
        let reduced = width.min(shown[0]);
        let width = width.min(reduced.max(CAPTION));
        let height = (down * f64::from(reduced) / across).round().max(1.0) as u32;
        let letters = (f64::from(width) / 22.0).clamp(7.0, 14.0);
        let line = (letters * 1.5).ceil() as u32;
        let title = (letters * 3.0).ceil() as u32;
        let rows = u64::from(frames.div_ceil(columns));
        let cell = u64::from(height + lines * line + GAP);
        let side = |length: u64| u32::try_from(length).unwrap_or(u32::MAX);
        Self {
            columns,
            width,
            picture: [reduced, height.min(shown[1])],
            letters,
            line,
            lines,
            title,
            size: [
                side(u64::from(columns) * u64::from(width + GAP) + u64::from(GAP)),
                side(u64::from(title) + rows * cell),
            ],
        }
    }

    /// The widest layout, up to the width asked for, that does not exceed the limits.
    fn fitting(
        frames: u32,
        columns: u32,
        width: u32,
        shown: [u32; 2],
        lines: u32,
    ) -> Result<Self, String> {
        let layout = |width| Self::new(frames, columns, width, shown, lines);
        let fits = |layout: &Self| layout.size.iter().all(|side| *side <= LARGEST_SIDE);
        let asked = layout(width);
        if fits(&asked) {
            return Ok(asked);
        }
        let found = (NARROWEST..width).rev().map(layout).find(fits);
        let other = |columns| fits(&Self::new(frames, columns, NARROWEST, shown, lines));
        let remedy = || match (1..=MOST_COLUMNS).any(other) {
            true => format!(
                "set sequence.sheet.columns nearer to {}",
                f64::from(frames).sqrt().ceil().min(MOST_COLUMNS.into())
            ),
            false => "so it is in any number of columns: leave out sequence.sheet".to_owned(),
        };
        found.ok_or_else(|| {
            format!(
                "a sheet of {frames} frames in {columns} columns is larger than {LARGEST_SIDE} \
                 pixels a side at any width; {}",
                remedy()
            )
        })
    }
}

/// The layout of a shot's sheet.
///
/// # Errors
/// If it exceeds the limits.
pub(super) fn layout(shot: &Shot, splices: &Splices) -> Result<Layout, String> {
    let asked = shot.sequence.sheet.unwrap_or_default();
    let lines = if splices.iter().count() > 1 { 2 } else { 1 };
    let (columns, width) = (asked.columns, asked.width);
    Layout::fitting(
        shot.shot.frames,
        columns,
        width,
        splices.shown_size(),
        lines,
    )
}

/// A sheet being written.
pub(super) struct Sheet {
    file: AtomicFile,
    writer: png::StreamWriter<'static, AtomicWriter>,
    layout: Layout,
    captions: Vec<Vec<(u32, String)>>,
    /// Reduced frames of the current row.
    row: Vec<FrameImage>,
}

impl Sheet {
    /// Begins the sheet of a shot's frames, displayed by their splices.
    pub(super) fn new(
        file: AtomicFile,
        shot_folder: &ShotFolder,
        splices: &Splices,
        notes: &dyn Fn(&str),
    ) -> Result<Self, String> {
        let shot = shot_folder.shot();
        let asked = shot.sequence.sheet.unwrap_or_default();
        let frames = shot.shot.frames;
        let shown = splices.shown_size();
        let layout = layout(shot, splices)?;
        if layout.picture[0] < asked.width.min(shown[0]) {
            notes(&format!(
                "{}: frames are {} pixels wide, not {}, since a sheet has at most {LARGEST_SIDE} a side",
                shot_folder.names.assembled("sheet.png"),
                layout.picture[0],
                asked.width
            ));
        }
        let captions = (1..=frames).map(|frame| {
            let told = Caption::text_of(shot, frame);
            let step = layout.picture[0] / splices.iter().count().max(1) as u32;
            let labels = splices
                .iter()
                .zip(0..)
                .filter(|(part, _)| !part.label.is_empty());
            let labels = labels.map(|(part, i)| (i * step, part.label.clone()));
            std::iter::once((0, told)).chain(labels).collect()
        });
        let begin = || {
            let [width, height] = layout.size;
            let mut encoder = png::Encoder::new(file.writer(), width, height);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
            encoder.write_header()?.into_stream_writer()
        };
        let writer = begin().map_err(|error: png::EncodingError| error.to_string())?;
        let mut sheet = Self {
            captions: captions.collect(),
            row: Vec::new(),
            writer,
            layout,
            file,
        };
        let title = shot
            .shot
            .title
            .as_deref()
            .unwrap_or(&shot_folder.names.stem);
        sheet.title(title).map_err(|error| error.to_string())?;
        Ok(sheet)
    }

    fn title(&mut self, title: &str) -> io::Result<()> {
        let layout = self.layout;
        let mut band = Band::new(layout.size[0], layout.title);
        let letters = layout.letters * 1.4;
        band.write(letters, &[(GAP, layout.title * 2 / 3, title)])?;
        self.writer.write_all(&band.rgb8)
    }

    /// Writes the current row: frames, captions, a gap.
    fn flush(&mut self, first: usize) -> io::Result<()> {
        let layout = self.layout;
        let below = layout.lines * layout.line + GAP;
        let left = |column: usize| GAP + column as u32 * (layout.width + GAP);
        let mut pictures = Band::new(layout.size[0], layout.picture[1]);
        let mut words = Vec::new();
        for (column, image) in self.row.iter().enumerate() {
            pictures.put(left(column), image);
            for (i, (x, text)) in self.captions[first + column].iter().enumerate() {
                let line = u32::from(i > 0);
                let base = line * layout.line + layout.line * 3 / 4;
                words.push((left(column) + x, base, text.as_str()));
            }
        }
        let mut captions = Band::new(layout.size[0], below);
        captions.write(layout.letters, &words)?;
        self.row.clear();
        self.writer.write_all(&pictures.rgb8)?;
        self.writer.write_all(&captions.rgb8)
    }
}

impl Encoder for Sheet {
    fn add(&mut self, frame: u32, image: &FrameImage) -> Result<(), String> {
        let [width, height] = self.layout.picture;
        self.row.push(reduce(image, width, height));
        let full = self.row.len() == self.layout.columns as usize;
        if full || frame as usize == self.captions.len() {
            let first = frame as usize - self.row.len();
            self.flush(first).map_err(|error| error.to_string())?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, String> {
        self.writer.finish().map_err(|error| error.to_string())?;
        self.file.keep().map_err(|error| error.to_string())
    }
}

/// Some rows of the sheet.
struct Band {
    width: u32,
    height: u32,
    rgb8: Vec<u8>,
}

impl Band {
    fn new(width: u32, height: u32) -> Self {
        let rgb8 = vec![GROUND; width as usize * height as usize * 3];
        Self {
            width,
            height,
            rgb8,
        }
    }

    /// Places an image `left` pixels from the left.
    fn put(&mut self, left: u32, image: &FrameImage) {
        let line = image.width as usize * 3;
        let rows = self.rgb8.chunks_exact_mut(self.width as usize * 3);
        for (row, source) in rows.zip(image.rgb8.chunks_exact(line)) {
            row[left as usize * 3..][..line].copy_from_slice(source);
        }
    }

    /// Writes texts with their baselines at points, in letters of a size.
    fn write(&mut self, letters: f64, texts: &[(u32, u32, &str)]) -> io::Result<()> {
        let (width, height) = (self.width, self.height);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, 'Liberation Sans', \
             sans-serif\" font-size=\"{letters}\" fill=\"#e6e6e6\">"
        );
        for (x, y, text) in texts {
            // Non-breaking spaces.
            let text = escaped(text).replace(' ', "\u{a0}");
            svg += &format!("<text x=\"{x}\" y=\"{y}\">{text}</text>");
        }
        svg += "</svg>";
        let painted = raster::paint(&svg, width, height).ok_or_else(|| {
            io::Error::other("its words cannot be painted; set sequence.sheet.columns to fewer")
        })?;
        painted.lay_over(&mut self.rgb8, width, [0, 0]);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_that_would_be_too_large_has_narrower_frames_or_says_what_to_do() {
        let usual = Layout::fitting(49, 6, 320, [1280, 720], 1).expect("fits");
        assert_eq!((usual.width, usual.picture), (320, [320, 180]));
        let long = Layout::fitting(2000, 6, 320, [1280, 720], 1).expect("fits narrower");
        assert!(long.width < 320 && long.size[1] <= LARGEST_SIDE, "{long:?}");
        let wider = Layout::new(2000, 6, long.width + 1, [1280, 720], 1);
        assert!(wider.size[1] > LARGEST_SIDE);
        let why = Layout::fitting(100_000, 1, 320, [1280, 720], 1).expect_err("cannot");
        assert!(
            why.contains("sequence.sheet.columns nearer to 100"),
            "{why}"
        );
        Layout::fitting(100_000, 100, 320, [1280, 720], 1).expect("as it says");
        // 100 columns of cells 28 pixels high are 280 000 pixels high.
        let why = Layout::fitting(1_000_000, 1, 320, [1280, 720], 1).expect_err("cannot");
        assert!(why.contains("leave out sequence.sheet"), "{why}");
    }

    #[test]
    fn a_small_frame_is_not_enlarged() {
        let layout = Layout::new(4, 6, 320, [64, 48], 1);
        assert_eq!((layout.picture, layout.columns), ([64, 48], 4));
    }

    #[test]
    fn words_of_a_title_are_painted_whatever_they_hold() {
        let words = "a < b & \"c\" > d\u{1}\u{fffe}</text></svg>";
        let mut band = Band::new(400, 20);
        band.write(12.0, &[(2, 14, words)]).expect("painted");
        let ink = |band: &Band| band.rgb8.iter().filter(|byte| **byte != GROUND).count();
        let mut plain = Band::new(400, 20);
        plain.write(12.0, &[(2, 14, "a")]).expect("painted");
        // More letters than one.
        assert!(ink(&plain) > 0 && ink(&band) > 5 * ink(&plain));
    }
}
