//! The display of a frame: unchanged, or with its splices side by side.

use super::frame_image::FrameImage;
use crate::frame::Splice;
use crate::shot::{Beaming, Effects, Shot, Switch};
use std::ops::Range;

/// The splices of a shot's frames, from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Splices {
    size: [u32; 2],
    list: Vec<SpliceRows>,
}

/// Rows under the same effects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SpliceRows {
    rows: Range<u32>,
    /// The effects that differ between the parts, in words.
    pub(super) label: String,
}

impl Splices {
    /// The splices of frames of a size; one if they are not to be side by side.
    pub(super) fn new(shot: &Shot, size: [u32; 2]) -> Self {
        let [_, height] = size;
        let whole = SpliceRows {
            rows: 0..height,
            label: String::new(),
        };
        if !shot.sequence.splices {
            let list = vec![whole];
            return Self { size, list };
        }
        let covered: Vec<Range<u32>> = Splice::all(shot)
            .iter()
            .map(|s| s.rows_of(height))
            .collect();
        // The last splice that covers a row wins.
        let owner = |row: u32| covered.iter().rposition(|rows| rows.contains(&row));
        let mut list: Vec<SpliceRows> = Vec::new();
        let mut last = None;
        for row in 0..height {
            let here = owner(row);
            match list.last_mut() {
                Some(part) if last == Some(here) => part.rows.end = row + 1,
                _ => list.push(SpliceRows {
                    rows: row..row + 1,
                    label: label(shot, here),
                }),
            }
            last = Some(here);
        }
        Self { size, list }
    }

    /// The splices in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &SpliceRows> {
        self.list.iter()
    }

    /// Width and height of the displayed image, in pixels.
    pub(super) fn shown_size(&self) -> [u32; 2] {
        let highest = self.list.iter().map(|part| part.rows.len() as u32).max();
        let across = self.size[0].saturating_mul(self.list.len() as u32);
        [across, highest.unwrap_or(self.size[1])]
    }

    /// A frame as it is displayed; splices lower than others are black below.
    pub(super) fn arrange(&self, image: FrameImage) -> FrameImage {
        if self.list.len() == 1 {
            return image;
        }
        let [width, height] = self.shown_size();
        let line = image.width as usize * 3;
        let stride = width as usize * 3;
        let mut rgb8 = vec![0; stride * height as usize];
        for (i, part) in self.list.iter().enumerate() {
            for (to, from) in part.rows.clone().enumerate() {
                let source = &image.rgb8[from as usize * line..][..line];
                rgb8[to * stride + i * line..][..line].copy_from_slice(source);
            }
        }
        FrameImage {
            width,
            height,
            rgb8,
        }
    }
}

/// The effects that some splice changes, with their values in one splice or in the rest.
fn label(shot: &Shot, splice: Option<usize>) -> String {
    let splices = Splice::all(shot);
    let here = splice.and_then(|index| splices.get(index));
    let here = here.map_or(shot.effects, |splice| splice.effects);
    let others: Vec<Words> = splices.iter().map(|s| words(&s.effects)).collect();
    let rest = words(&shot.effects);
    let differs = |(i, _): &(usize, &String)| others.iter().any(|other| other[*i] != rest[*i]);
    let here = words(&here);
    let told: Vec<&str> = here
        .iter()
        .enumerate()
        .filter(differs)
        .map(|(_, word)| word.as_str())
        .collect();
    told.join(", ")
}

type Words = [String; 6];

fn words(effects: &Effects) -> Words {
    let switch = |name: &str, switch: Switch| match switch {
        Switch::Auto => format!("{name} on"),
        Switch::Off => format!("{name} off"),
    };
    let beaming = match effects.beaming {
        Beaming::Full => "full",
        Beaming::Square => "square",
        Beaming::Off => "off",
    };
    [
        switch("geometry", effects.geometry),
        switch("doppler", effects.doppler),
        format!("beaming {beaming}"),
        switch("thermal", effects.thermal),
        switch("shadows", effects.shadows),
        format!("bounces {}", effects.bounces),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::parse;
    use std::path::Path;

    fn splices(splices: &str, size: [u32; 2]) -> Splices {
        let text = format!(
            "{splices}\n[sequence]\nsplices = true\n[effects]\nbeaming = \"off\"\n\
             [[model]]\nfile = \"tests/bad-shots/models/ball.obj\"\n[camera]\n"
        );
        Splices::new(
            &parse(&text, Path::new("a.toml")).expect("no mistakes"),
            size,
        )
    }

    const TWO: &str = "[[splice]]\nrows = [0.5, 1.0]\neffects = { beaming = \"full\" }";

    #[test]
    fn parts_stand_side_by_side_from_the_top_and_black_fills_the_rest() {
        let splices = splices(TWO, [1, 3]);
        assert_eq!(splices.shown_size(), [2, 2]);
        // Row centres at ⅙, ½ and ⅚ of the height: the second belongs to the splice.
        let image = FrameImage {
            width: 1,
            height: 3,
            rgb8: vec![1, 1, 1, 2, 2, 2, 3, 3, 3],
        };
        let shown = splices.arrange(image);
        assert_eq!(shown.rgb8, [1, 1, 1, 2, 2, 2, 0, 0, 0, 3, 3, 3]);
        let labels: Vec<&str> = splices.iter().map(|part| part.label.as_str()).collect();
        assert_eq!(labels, ["beaming off", "beaming full"]);
    }

    #[test]
    fn of_splices_that_overlap_the_last_holds() {
        let three =
            format!("{TWO}\n[[splice]]\nrows = [0.7, 1.0]\neffects = {{ doppler = \"off\" }}");
        let splices = splices(&three, [4, 10]);
        let told: Vec<_> = splices
            .iter()
            .map(|p| (p.rows.clone(), p.label.as_str()))
            .collect();
        assert_eq!(
            told,
            [
                (0..5, "doppler on, beaming off"),
                (5..7, "doppler on, beaming full"),
                (7..10, "doppler off, beaming off"),
            ]
        );
    }

    #[test]
    fn a_picture_without_splices_is_shown_as_it_stands() {
        let splices = splices("", [2, 1]);
        let image = FrameImage {
            width: 2,
            height: 1,
            rgb8: vec![1, 2, 3, 4, 5, 6],
        };
        assert_eq!(splices.arrange(image.clone()), image);
        assert_eq!(splices.shown_size(), [2, 1]);
    }
}
