//! The outputs that can be assembled from a shot's frames, and the encoders that make them.

use super::frame_image::FrameImage;
use crate::shot::{Sequence, Video};
use std::path::PathBuf;

/// An output, which is one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// Contact sheet.
    Sheet,
    /// Animation of 256 colors.
    Gif,
    /// Animation of all colors.
    Apng,
    /// Video by ffmpeg.
    Video(Video),
}

/// All outputs.
pub(super) const OUTPUTS: [Output; 5] = [
    Output::Sheet,
    Output::Gif,
    Output::Apng,
    Output::Video(Video::Mp4),
    Output::Video(Video::Av1),
];

impl Output {
    /// The outputs that a shot asks for.
    pub(super) fn of(sequence: &Sequence) -> Vec<Self> {
        let sheet = sequence.sheet.map(|_| Self::Sheet);
        let gif = sequence.gif.then_some(Self::Gif);
        let apng = sequence.apng.then_some(Self::Apng);
        let video = sequence.video.map(Self::Video);
        [sheet, gif, apng, video].into_iter().flatten().collect()
    }

    /// End of its file name.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::Sheet => "sheet.png",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::Video(Video::Mp4) => "mp4",
            Self::Video(Video::Av1) => "av1.mp4",
        }
    }

    /// Its name on the page.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Sheet => "contact sheet",
            Self::Gif => "GIF",
            Self::Apng => "APNG",
            Self::Video(Video::Mp4) => "video",
            Self::Video(Video::Av1) => "AV1 video",
        }
    }

    /// Its name in the shot.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Sheet => "sheet",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::Video(Video::Mp4) => "video = \"mp4\"",
            Self::Video(Video::Av1) => "video = \"av1\"",
        }
    }
}

/// An encoder of one file, which takes frames in order. If dropped before its end, it leaves no
/// file. Errors continue "FILE: ".
pub(super) trait Encoder {
    /// Takes the next frame, which has this number.
    fn add(&mut self, frame: u32, image: &FrameImage) -> Result<(), String>;

    /// Gives the file its name and returns its path.
    fn finish(self: Box<Self>) -> Result<PathBuf, String>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::ASSEMBLED;

    /// Else what a killed run leaves of it is not swept.
    #[test]
    fn the_queue_knows_the_names_of_all_there_are() {
        assert_eq!(OUTPUTS.map(Output::suffix), ASSEMBLED);
    }
}
