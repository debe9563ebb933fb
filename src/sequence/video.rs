//! A video by ffmpeg, which receives pixels through a pipe and never file names: with names, it
//! would skip missing files and stop silently at empty ones.
//!
//! Rec. 709 as players expect it: limited range, 4:2:0, tagged; the transfer is that of the pixels,
//! sRGB. H.264 at a constant rate factor of 18, AV1 at 20 with 10 bits.

use super::child_process::ChildProcess;
use super::frame_image::FrameImage;
use super::output::Encoder;
use crate::queue::Stop;
use crate::shot::Video as Kind;
use crate::store::AtomicFile;
use std::ffi::OsString;
use std::io::{self, Read};
use std::path::PathBuf;
use std::process::Command;

/// Smallest side of an image for the AV1 encoder (SVT-AV1 1.4), pixels.
const LEAST_AV1: u32 = 64;

/// A video being written.
pub(super) struct Video {
    file: AtomicFile,
    ffmpeg: ChildProcess,
    stop: Stop,
    frames: u32,
    size: [u32; 2],
}

/// A size with even sides, one column or row more if needed.
pub(super) fn even(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.next_multiple_of(2))
}

impl Video {
    /// Begins a video of this many frames of a size, `rate` of them per second as a fraction.
    pub(super) fn new(
        file: AtomicFile,
        kind: Kind,
        size: [u32; 2],
        frames: u32,
        rate: (i32, u32),
        stop: &Stop,
    ) -> Result<Self, String> {
        let [width, height] = size;
        if kind == Kind::Av1 && width.min(height) < LEAST_AV1 {
            return Err(format!(
                "an AV1 video has at least {LEAST_AV1} pixels a side, not {width} x {height}; \
                 ask for video = \"mp4\""
            ));
        }
        let mut command = Command::new("ffmpeg");
        command
            .args(arguments(kind, even(size), rate))
            .arg(file.temporary());
        let ffmpeg =
            ChildProcess::start(&mut command, stop).map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => "videos are made by ffmpeg, which is not to be found: \
                install it (apt install ffmpeg), or leave out sequence.video"
                    .to_owned(),
                _ => format!("ffmpeg does not start: {error}"),
            })?;
        Ok(Self {
            file,
            ffmpeg,
            stop: stop.clone(),
            frames,
            size,
        })
    }
}

/// All arguments of ffmpeg except the file name.
fn arguments(kind: Kind, [width, height]: [u32; 2], (n, d): (i32, u32)) -> Vec<OsString> {
    let (format, codec) = match kind {
        Kind::Mp4 => ("yuv420p", "-c:v libx264 -crf 18 -preset slow"),
        Kind::Av1 => ("yuv420p10le", "-c:v libsvtav1 -crf 20 -preset 6"),
    };
    let line = format!(
        "-v error -xerror -nostdin -y -f rawvideo -pix_fmt rgb24 -s {width}x{height} -r {n}/{d} -i - \
         -vf scale=in_range=full:out_range=tv:out_color_matrix=bt709,format={format} {codec} \
         -color_range tv -colorspace bt709 -color_primaries bt709 -color_trc iec61966-2-1 \
         -movflags +faststart -f mp4"
    );
    line.split_whitespace().map(OsString::from).collect()
}

impl Encoder for Video {
    fn add(&mut self, _: u32, image: &FrameImage) -> Result<(), String> {
        let padded = pad(image, even(self.size));
        let pixels = padded.as_ref().unwrap_or(&image.rgb8);
        let written = self.ffmpeg.write(pixels);
        // It has ended: its output says more than the broken pipe.
        written.map_err(|error| match self.ffmpeg.end() {
            Err(why) => failed(&why),
            Ok(()) => error.to_string(),
        })
    }

    fn finish(mut self: Box<Self>) -> Result<PathBuf, String> {
        self.ffmpeg.end().map_err(|why| failed(&why))?;
        match count(&self.file, &self.stop)? {
            Some(found) if found != self.frames => Err(format!(
                "ffmpeg made a video of {found} frames from {}; try another build of it",
                self.frames
            )),
            _ => self.file.keep().map_err(|error| error.to_string()),
        }
    }
}

fn failed(why: &str) -> String {
    format!("ffmpeg failed {why}")
}

/// The pixels with their last column and row repeated if sides are odd.
fn pad(image: &FrameImage, [width, height]: [u32; 2]) -> Option<Vec<u8>> {
    if [width, height] == [image.width, image.height] {
        return None;
    }
    let stride = image.width as usize * 3;
    let mut padded = Vec::with_capacity(width as usize * height as usize * 3);
    for y in 0..height {
        let row = y.min(image.height - 1) as usize;
        let bytes = &image.rgb8[row * stride..][..stride];
        padded.extend_from_slice(bytes);
        if width > image.width {
            padded.extend_from_slice(&bytes[stride - 3..]);
        }
    }
    Some(padded)
}

/// Number of frames of a video; None if there is no ffprobe. ffmpeg (5.1) succeeds even if the end
/// of the file could not be written: a video that ffprobe cannot read is incomplete.
fn count(file: &AtomicFile, stop: &Stop) -> Result<Option<u32>, String> {
    let words = "-v error -select_streams v:0 -count_frames -show_entries stream=nb_read_frames \
                 -of csv=p=0";
    let mut command = Command::new("ffprobe");
    command.args(words.split_whitespace()).arg(file.temporary());
    let mut ffprobe = match ChildProcess::start(&mut command, stop) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        started => started.map_err(|error| format!("ffprobe does not start: {error}"))?,
    };
    let mut text = String::new();
    let read = ffprobe
        .stdout()
        .map_or(Ok(0), |mut pipe| pipe.read_to_string(&mut text));
    let torn = |why: String| {
        format!("ffmpeg left a video that ffprobe cannot read {why}; see that the disk has room")
    };
    ffprobe.end().map_err(torn)?;
    read.map_err(|error| torn(format!("({error})")))?;
    let count = text.trim().trim_end_matches(',').parse();
    count
        .map(Some)
        .map_err(|_| torn(format!("(it counts {:?} frames)", text.trim())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_sides_repeat_their_last_line() {
        let image = FrameImage {
            width: 1,
            height: 1,
            rgb8: vec![1, 2, 3],
        };
        assert_eq!(even([1, 1]), [2, 2]);
        assert_eq!(pad(&image, [2, 2]), Some([1, 2, 3].repeat(4)));
        assert_eq!(pad(&image, [1, 1]), None);
    }
}
