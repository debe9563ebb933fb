//! Sheets, animations and videos of a shot's frames, all in one pass over them.
//!
//! Nothing is made of a sequence in which a frame is missing or wrong. Memory is bounded by one
//! image per thread, a row of the sheet and a palette, however long the sequence is.

use super::apng::Apng;
use super::findings::{Finding, Kind};
use super::frame_image::{self, FrameImage, FrameImageError};
use super::freshness;
use super::gif::{self, Gif};
use super::output::{Encoder, Output};
use super::palette::Palette;
use super::sheet::{self, Sheet};
use super::splices::Splices;
use super::verify::verify_until;
use super::video::{self, Video};
use crate::image::rational_rate;
use crate::queue::Stop;
use crate::shot::Shot;
use crate::store::{AtomicFile, FolderError, ShotFolder, Status};
use rayon::prelude::*;
use std::path::PathBuf;

/// Number of findings that a message quotes.
const QUOTED: usize = 8;

/// Reason why not everything was assembled.
#[derive(Debug, thiserror::Error)]
pub enum AssembleError {
    /// Frames are missing or wrong.
    #[error(
        "nothing is assembled: {}; remove what is broken and render the shot: what is sound is kept",
        quoted(.0)
    )]
    Refused(Vec<Finding>),
    /// A frame cannot be read, although it was sound before.
    #[error("nothing is assembled: {0}")]
    FrameImage(#[from] FrameImageError),
    /// The folder cannot be read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The user asked to stop. Files made until then are complete.
    #[error("stopped")]
    Stopped,
    /// Some files were made and others not.
    #[error("{}", .failures.join("; "))]
    Some {
        /// Files that were made.
        made: Vec<PathBuf>,
        /// Files that were not, each as `FILE: WHY`.
        failures: Vec<String>,
    },
}

fn quoted(findings: &[Finding]) -> String {
    let shown = findings.iter().take(QUOTED).map(ToString::to_string);
    let mut words: Vec<String> = shown.collect();
    if findings.len() > QUOTED {
        let rest = findings[QUOTED..].iter();
        let frames: usize = rest.map(|f| f.frames().map_or(1, Iterator::count)).sum();
        words.push(format!("and {frames} more"));
    }
    words.join("; ")
}

/// Assembles everything that a shot asks for, even if it is there already, and returns the files.
/// `notes` receives warnings. If asked to stop, it ends soon and leaves only complete files.
///
/// # Errors
/// If a frame is missing or wrong, nothing is made; if one file cannot be made, the others are.
pub fn assemble(
    shot_folder: &ShotFolder,
    notes: &dyn Fn(&str),
    stop: &Stop,
) -> Result<Vec<PathBuf>, AssembleError> {
    make(
        shot_folder,
        &Output::of(&shot_folder.shot().sequence),
        notes,
        stop,
    )
}

/// Assembles, at the end of a shot's rendering, the files that are missing or made from other
/// frames. Nothing is made while frames are missing, since other processes may be rendering them.
/// The caller holds the claim on the shot's sequence, so that no two processes do this at once.
///
/// # Errors
/// As [`assemble`].
pub fn finish(
    shot_folder: &mut ShotFolder,
    notes: &dyn Fn(&str),
    stop: &Stop,
) -> Result<Vec<PathBuf>, AssembleError> {
    shot_folder.refresh()?;
    make(shot_folder, &outstanding(shot_folder), notes, stop)
}

/// Whether [`finish`] would find nothing to make.
pub fn is_finished(shot_folder: &ShotFolder) -> bool {
    outstanding(shot_folder).is_empty()
}

/// The files that are asked for, can be made, and are not there.
fn outstanding(shot_folder: &ShotFolder) -> Vec<Output> {
    let mut outputs = Output::of(&shot_folder.shot().sequence);
    outputs.retain(|output| !freshness::is_fresh(shot_folder, *output));
    if !outputs.is_empty() && !is_rendered(shot_folder) {
        outputs.clear();
    }
    outputs
}

/// Whether all frames are there and up to date.
fn is_rendered(shot_folder: &ShotFolder) -> bool {
    let (there, frames) = (shot_folder.there(), shot_folder.shot().shot.frames);
    let fresh =
        |frame: &u32| shot_folder.status(*frame, &shot_folder.keys.frame(*frame)) == Status::Fresh;
    there.len() as u64 == u64::from(frames) && there.par_iter().all(fresh)
}

/// The outputs that a shot asks for but that images of this size cannot give, known before
/// rendering.
pub fn foreseen(shot: &Shot, size: [u32; 2]) -> Option<String> {
    shot.sequence.sheet?;
    let splices = Splices::new(shot, size);
    sheet::layout(shot, &splices).err()
}

fn make(
    shot_folder: &ShotFolder,
    outputs: &[Output],
    notes: &dyn Fn(&str),
    stop: &Stop,
) -> Result<Vec<PathBuf>, AssembleError> {
    if outputs.is_empty() {
        return Ok(Vec::new());
    }
    let report = verify_until(shot_folder, stop).ok_or(AssembleError::Stopped)?;
    let (forbidding, others): (Vec<Finding>, Vec<Finding>) = report
        .findings
        .into_iter()
        .partition(|finding| finding.kind.forbids_assembling());
    if !forbidding.is_empty() {
        return Err(AssembleError::Refused(forbidding));
    }
    for finding in others.iter().filter(|f| f.kind == Kind::Outlier) {
        notes(&format!("warning: {finding}"));
    }
    let making = Making {
        shot_folder,
        splices: Splices::new(shot_folder.shot(), shot_folder.keys.resolution().size),
        notes,
        stop,
    };
    making.run(outputs)
}

/// A pass over the frames.
struct Making<'a> {
    shot_folder: &'a ShotFolder,
    splices: Splices,
    notes: &'a dyn Fn(&str),
    stop: &'a Stop,
}

type Begun = (Output, Result<Box<dyn Encoder>, String>);

impl Making<'_> {
    fn run(&self, outputs: &[Output]) -> Result<Vec<PathBuf>, AssembleError> {
        let gif = outputs.contains(&Output::Gif);
        let mut palette = gif.then(|| self.palette()).transpose()?;
        let mut begun: Vec<Begun> = outputs
            .iter()
            .map(|output| (*output, self.begin(*output, &mut palette)))
            .collect();
        self.feed(&mut begun)?;
        let mut made = Vec::new();
        let mut failures = Vec::new();
        for (output, target) in begun {
            let finished = target.and_then(Encoder::finish);
            // A stop is not a failure.
            self.go_on()?;
            match finished {
                Ok(path) => {
                    made.push(path);
                    if let Err(error) = freshness::remember_output(self.shot_folder, output) {
                        (self.notes)(&format!(
                            "warning: {} will be made again: {error}",
                            self.name(output)
                        ));
                    }
                }
                Err(why) => failures.push(format!("{}: {why}", self.name(output))),
            }
        }
        if failures.is_empty() {
            Ok(made)
        } else {
            Err(AssembleError::Some { made, failures })
        }
    }

    fn go_on(&self) -> Result<(), AssembleError> {
        if self.stop.is_asked() {
            return Err(AssembleError::Stopped);
        }
        Ok(())
    }

    fn name(&self, output: Output) -> String {
        self.shot_folder.names.assembled(output.suffix())
    }

    /// Begins one file.
    fn begin(
        &self,
        output: Output,
        palette: &mut Option<Palette>,
    ) -> Result<Box<dyn Encoder>, String> {
        let shot = self.shot_folder.shot();
        let (frames, fps) = (shot.shot.frames, shot.shot.fps);
        let size = self.splices.shown_size();
        let name = self.name(output);
        let file = AtomicFile::create(&self.shot_folder.path.join(&name))
            .map_err(|error| error.to_string())?;
        let rate = || {
            let found = rational_rate(fps);
            found.ok_or_else(|| format!("shot.fps is {fps}; give one from 0.001 to 1000"))
        };
        Ok(match output {
            Output::Sheet => Box::new(Sheet::new(
                file,
                self.shot_folder,
                &self.splices,
                self.notes,
            )?),
            Output::Gif => {
                if fps > gif::FASTEST {
                    (self.notes)(&format!(
                        "warning: {name} has {fps} frames a second; viewers show at most 50 of a GIF"
                    ));
                }
                let palette = palette.take().unwrap_or_else(|| Palette::new([]));
                Box::new(Gif::new(file, size, fps, palette)?)
            }
            Output::Apng => Box::new(Apng::new(file, size, frames, rate()?)?),
            Output::Video(kind) => {
                let [width, height] = video::even(size);
                if [width, height] != size {
                    (self.notes)(&format!(
                        "{name} is padded to {width} x {height} pixels: videos have even sides"
                    ));
                }
                Box::new(Video::new(file, kind, size, frames, rate()?, self.stop)?)
            }
        })
    }

    /// The colors of the sequence, from some of its frames.
    fn palette(&self) -> Result<Palette, AssembleError> {
        let frames = self.shot_folder.shot().shot.frames;
        let step = frames.div_ceil(gif::SAMPLED_FRAMES).max(1);
        let mut samples = Vec::new();
        for frame in (1..=frames).step_by(step as usize) {
            self.go_on()?;
            let image = self
                .splices
                .arrange(frame_image::read(self.shot_folder, frame)?);
            samples.extend(gif::sample(&image, frames));
        }
        Ok(Palette::new(samples))
    }

    /// Passes every frame to every file that has not failed.
    fn feed(&self, begun: &mut [Begun]) -> Result<(), AssembleError> {
        let numbers: Vec<u32> = (1..=self.shot_folder.shot().shot.frames).collect();
        let (shot_folder, splices) = (self.shot_folder, &self.splices);
        for some in numbers.chunks(rayon::current_num_threads().max(1)) {
            self.go_on()?;
            if begun.iter().all(|(_, target)| target.is_err()) {
                break;
            }
            let images: Vec<Result<FrameImage, FrameImageError>> = some
                .par_iter()
                .map(|frame| Ok(splices.arrange(frame_image::read(shot_folder, *frame)?)))
                .collect();
            for (frame, image) in some.iter().zip(images) {
                let image = image?;
                for (_, target) in begun.iter_mut() {
                    let taken = target.as_mut().map(|target| target.add(*frame, &image));
                    if let Ok(Err(why)) = taken {
                        *target = Err(why);
                    }
                }
            }
        }
        Ok(())
    }
}
