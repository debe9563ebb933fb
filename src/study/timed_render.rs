//! One timed render of an image, in the same way as every image is rendered, with seconds by phase.

use crate::accel::Aggregate;
use crate::film::{Film, develop};
use crate::frame::Frame;
use crate::image::EncodeError;
use crate::image::compare::CompareError;
use crate::probe;
use crate::render::{
    Member, Options, PictureInfo, Pictures, Profile, ShotExposure, View, development, encode,
    render_profiled,
};
use crate::scene::Scene;
use crate::shot::{Mistakes, Shot};
use crate::store::{forget_peak, peak_memory_mib, write_atomically};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// A scene and its trees, ready for rays.
pub(super) struct Bodies {
    pub(super) scene: Scene,
    pub(super) aggregate: Aggregate,
}

/// The image whose variants are rendered.
pub(super) struct Subject {
    /// Number of the frame.
    pub(super) frame: u32,
    /// Exposure, stops.
    pub(super) stops: f64,
    /// Scratch folder; its files are written only to time writing.
    pub(super) scratch: PathBuf,
}

impl Subject {
    /// The subject of a shot.
    pub(super) fn new(frame: &Frame<'_>, shot_exposure: &ShotExposure, scratch: PathBuf) -> Self {
        Self {
            frame: frame.number,
            stops: shot_exposure.stops(frame),
            scratch,
        }
    }
}

/// The image at one setting of one knob.
#[derive(Clone)]
pub(super) struct Variant {
    /// Description of the setting.
    pub(super) setting: String,
    /// Family of settings on one curve.
    pub(super) family: String,
    /// The text to write into the shot.
    pub(super) toml: Option<String>,
    /// Whether it is the shot's own setting.
    pub(super) current: bool,
    pub(super) shot: Shot,
    pub(super) bodies: Arc<Bodies>,
    pub(super) options: Options,
}

/// Phases of an image in the order in which they happen, each with a description.
pub(super) const PHASES: [(&str, &str); 9] = [
    (
        "prepare",
        "curves, tables and links between worldlines, once an image",
    ),
    ("aim", "directions of the samples' rays in the camera"),
    ("boost", "camera rays to the rest frame of each worldline"),
    ("traverse", "camera rays through the bodies there"),
    ("shadow", "rays from surfaces to lamps, with their boosts"),
    (
        "surfaces",
        "surface events, lamps as seen from there, mirrors and glass",
    ),
    (
        "shade",
        "spectra shifted, multiplied and summed to color, and the pixel's mean",
    ),
    ("develop", "exposure and color"),
    ("write", "files encoded and written to the disk"),
];

/// Index of a phase in [`PHASES`].
pub(super) fn phase(name: &str) -> usize {
    let place = PHASES.iter().position(|(phase, _)| *phase == name);
    place.expect("only phases of the list are asked for")
}

/// One render of a variant.
pub(super) struct Run {
    /// Seconds of wall clock for the whole image.
    pub(super) seconds: f64,
    /// Seconds by [`PHASES`]; those that threads share are divided by the number of threads.
    pub(super) phases: [f64; 9],
    pub(super) memory_mib: Option<f64>,
    pub(super) film: Film,
    /// Extension and content of its files.
    pub(super) files: Vec<(&'static str, Vec<u8>)>,
}

impl Variant {
    /// The image, ready for rays.
    pub(super) fn view(&self, subject: &Subject) -> Result<View<'_>, StudyError> {
        let (scene, aggregate) = (&self.bodies.scene, &self.bodies.aggregate);
        let frame = Frame::new(&self.shot, subject.frame)?;
        Ok(View::new(&frame, &frame.effects, scene, aggregate))
    }

    /// Renders the variant once.
    pub(super) fn run(&self, subject: &Subject) -> Result<Run, StudyError> {
        let counts = forget_peak();
        let profile = Profile::default();
        let (scene, aggregate) = (&self.bodies.scene, &self.bodies.aggregate);
        let begun = Instant::now();
        let frame = &Frame::new(&self.shot, subject.frame)?;
        let film = render_profiled(
            frame,
            scene,
            aggregate,
            &self.options,
            &|_| (),
            Some(&profile),
        );
        let rendered = Instant::now();
        let member = Member { frame, scene };
        let size = [film.width, film.height];
        let insets = probe::insets(member, aggregate, subject.stops, size);
        let Pictures { files, .. } = encode(
            frame,
            scene,
            &film,
            &insets,
            PictureInfo {
                exposure_stops: subject.stops,
                samples: self.options.samples,
                fingerprint: None,
            },
        )?;
        for (extension, bytes) in &files {
            let name = subject.scratch.join("image").with_extension(extension);
            write_atomically(&name, bytes)?;
        }
        let ended = Instant::now();
        let memory_mib = peak_memory_mib().filter(|_| counts);
        let seconds = profile.seconds();
        let threads = rayon::current_num_threads() as f64;
        // Repeated to time it alone, since it is part of making the files.
        let again = Instant::now();
        let developed = develop(&film, &development(frame.sensor.color, subject.stops));
        let developing = again.elapsed().as_secs_f64();
        drop(developed);
        let writing = (ended - rendered).as_secs_f64() - developing;
        Ok(Run {
            seconds: (ended - begun).as_secs_f64(),
            phases: [
                seconds.prepare,
                seconds.aim / threads,
                seconds.boost / threads,
                seconds.traverse / threads,
                seconds.shadow / threads,
                seconds.surfaces / threads,
                seconds.shade / threads,
                developing,
                writing.max(0.0),
            ],
            memory_mib,
            film,
            files,
        })
    }
}

/// Reason why a study failed.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The shot has a mistake that shows in this frame.
    #[error("the shot has mistakes")]
    Mistakes(#[from] Mistakes),
    /// An image could not be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file could not be written.
    #[error("{0}")]
    Write(#[from] std::io::Error),
    /// A file that was written could not be read back.
    #[error("a picture just written cannot be read: {0}")]
    Read(#[from] image::ImageError),
    /// Two images could not be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
}
