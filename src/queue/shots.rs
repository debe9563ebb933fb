//! Shots read, checked and rendered, frame after frame.

use super::frames::FrameList;
use super::picture::pictures;
use super::progress::Progress;
use super::shifts::refuse_shifted_numbers;
use super::write::write_atomically;
use crate::film::EncodeError;
use crate::render::{Options, metered_exposure, render};
use crate::scene::{Library, Scene};
use crate::shot::{self, Exposure, Mistakes, Shot};
use crate::trace::Stage;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A shot without mistakes, and its files.
pub struct Prepared {
    /// The shot.
    pub shot: Shot,
    /// What it reads from other files.
    pub library: Library,
}

/// What is asked of a shot's rendering.
#[derive(Debug, Clone)]
pub struct Request {
    /// Folder of the shots' folders.
    pub out: PathBuf,
    /// Which frames.
    pub frames: FrameList,
    /// Factor on the image's size, above 0.
    pub scale: f64,
    /// Samples a pixel in place of the shot's.
    pub samples: Option<u32>,
}

/// Why a frame is not there.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// Too large for this machine.
    #[error(
        "{width} x {height} pixels need about {needed} MiB of memory and {free} MiB are free; render with a smaller --scale"
    )]
    Memory {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// MiB needed.
        needed: u64,
        /// MiB free.
        free: u64,
    },
    /// The encoder refused.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A folder or file could not be written.
    #[error("{0}")]
    Write(#[from] std::io::Error),
    /// The shot has a mistake that shows in this frame alone.
    #[error("{0}")]
    Mistakes(Box<Mistakes>),
}

impl Prepared {
    /// Reads a shot and everything it names, and resolves every frame.
    ///
    /// # Errors
    /// All its mistakes.
    pub fn read(path: &Path) -> Result<Self, Mistakes> {
        let shot = shot::load(path)?;
        let library = Library::load(&shot)?;
        for frame in 1..=shot.shot.frames {
            Scene::check(&shot, &library, frame)?;
        }
        refuse_shifted_numbers(&shot)?;
        Ok(Self { shot, library })
    }

    /// The name of the shot's folder and files.
    pub fn stem(&self) -> String {
        self.shot
            .path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    }

    /// How the shot's frames are exposed; and frame 1, where metering had to build it.
    ///
    /// # Errors
    /// Mistakes of frame 1.
    pub fn exposure(&self) -> Result<(Exposing, Option<(Scene, Stage)>), Mistakes> {
        match &self.shot.sensor.exposure {
            Exposure::Stops(stops) => Ok((Exposing::Authored(stops.clone()), None)),
            Exposure::Auto(_) => {
                let metered = metered_exposure(&self.shot, &self.library)?;
                let exposing = metered.stops.map_or(Exposing::Black, Exposing::Metered);
                Ok((exposing, Some((metered.scene, metered.stage))))
            }
        }
    }
}

/// How a shot's frames are exposed.
#[derive(Debug, Clone)]
pub enum Exposing {
    /// As its author wrote.
    Authored(shot::Track<f64>),
    /// As metered on frame 1, in stops.
    Metered(f64),
    /// Frame 1 was metered and is all black: 0 stops.
    Black,
}

impl Exposing {
    /// Stops in one frame.
    pub fn stops(&self, frame: u32, frames: u32) -> f64 {
        match self {
            Self::Authored(track) => track.at(frame, frames),
            Self::Metered(stops) => *stops,
            Self::Black => 0.0,
        }
    }
}

/// Size and samples of a shot's images under a request.
pub fn options(shot: &Shot, request: &Request) -> Options {
    let side = |pixels: u32| {
        (f64::from(pixels) * request.scale)
            .round()
            .clamp(1.0, f64::from(shot::LARGEST_SIDE)) as u32
    };
    let [width, height] = shot.image.size.map(side);
    let exr = shot.output.formats.contains(&shot::Format::Exr);
    Options {
        width,
        height,
        samples: request.samples.unwrap_or(shot.image.samples),
        layers: if exr {
            shot.output.layers.clone()
        } else {
            Vec::new()
        },
    }
}

/// Renders the given frames of a shot into `DIR/STEM/STEM.NNNN.*`; goes on after a frame that
/// fails. Trees are taken over from image to image, first from `kept`. Returns the failures.
pub fn render_shot(
    prepared: &Prepared,
    exposing: &Exposing,
    request: &Request,
    frames: &[u32],
    mut kept: Option<(Scene, Stage)>,
    progress: &Progress,
) -> Vec<(u32, RenderError)> {
    let mut failures = Vec::new();
    for &frame in frames {
        let begun = Instant::now();
        match render_frame(prepared, exposing, request, frame, &mut kept, progress) {
            Ok(name) => progress.frame_finished(begun.elapsed(), &name),
            Err(error) => failures.push((frame, error)),
        }
    }
    failures
}

/// Renders and writes one frame; returns the name of its first file.
fn render_frame(
    prepared: &Prepared,
    exposing: &Exposing,
    request: &Request,
    frame: u32,
    kept: &mut Option<(Scene, Stage)>,
    progress: &Progress,
) -> Result<String, RenderError> {
    let shot = &prepared.shot;
    let options = options(shot, request);
    check_memory(&options)?;
    let stem = prepared.stem();
    let folder = request.out.join(&stem);
    std::fs::create_dir_all(&folder).map_err(|error| {
        std::io::Error::new(
            error.kind(),
            format!(
                "cannot make {}: {error}; name another folder with --out",
                folder.display()
            ),
        )
    })?;
    let mistakes = |m| RenderError::Mistakes(Box::new(m));
    let earlier = kept.take();
    let scene = Scene::resolve(
        shot,
        &prepared.library,
        frame,
        earlier.as_ref().map(|(s, _)| s),
    )
    .map_err(mistakes)?;
    let stage = match earlier {
        Some((old, stage)) if std::sync::Arc::ptr_eq(&old.geometry, &scene.geometry) => stage,
        other => Stage::with_precision(
            &scene.geometry,
            other.as_ref().map(|(_, stage)| stage),
            shot.accuracy.tracing,
        ),
    };
    let advance = |rays| progress.advance(rays);
    let film = render(shot, frame, &scene, &stage, &options, &advance)
        .map_err(|error| mistakes(crate::render::motion_mistake(shot, &error)))?;
    let stops = exposing.stops(frame, shot.shot.frames);
    let pictures = pictures(shot, frame, &scene, &stage, &film, stops, options.samples)?;
    if pictures.saturated > 0 {
        progress.note(&format!(
            "warning: frame {frame}: {} values beyond what a file can hold were clamped",
            pictures.saturated
        ));
    }
    for warning in &pictures.warnings {
        progress.note(&format!("warning: frame {frame}: {warning}"));
    }
    let digits = shot.shot.frames.to_string().len().max(4);
    let mut first = None;
    for (extension, bytes) in &pictures.files {
        let name = format!("{stem}.{frame:0digits$}.{extension}");
        write_atomically(&folder.join(&name), bytes)?;
        first.get_or_insert(name);
    }
    *kept = Some((scene, stage));
    Ok(first.unwrap_or_default())
}

/// Refuses an image that this machine surely cannot hold, rather than be killed half-way.
fn check_memory(options: &Options) -> Result<(), RenderError> {
    // The film, developed values, bytes of a picture and the encoder's copy of them.
    let bytes = 12 + 12 + 3 + 16 + 8 * options.layers.len() as u64;
    let needed = (u64::from(options.width) * u64::from(options.height) * bytes) >> 20;
    match free_memory() {
        Some(free) if needed > free => Err(RenderError::Memory {
            width: options.width,
            height: options.height,
            needed,
            free,
        }),
        _ => Ok(()),
    }
}

/// MiB of memory that can be had, where the system says.
fn free_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.split_whitespace()
        .next()?
        .parse::<u64>()
        .ok()
        .map(|kib| kib >> 10)
}
