//! The arguments of every command.

use crate::progress::Mode;
use crate::queue::{FrameList, Shard};
use crate::store::Request;
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// Render scenes in which things move at nearly the speed of light
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true, max_term_width = 100)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render the frames that are missing or out of date, then assemble sheets, animations and videos
    Render(RenderArguments),
    /// Find all mistakes in shots and in the files that they name, without rendering
    Check {
        /// Shot files
        #[arg(required = true, value_name = "SHOT")]
        shots: Vec<PathBuf>,
        /// Print the result as JSON
        #[arg(long)]
        json: bool,
    },
    /// List the effects of each frame, what is out of date and why, and the time it will take
    Plan(PlanArguments),
    /// Check finished frames: report missing, stale, broken and suspicious ones
    Verify(FinishedArguments),
    /// Make the contact sheet, animations, video and HTML page of finished frames
    Assemble(FinishedArguments),
    /// Report what the center of one pixel sees: event, Doppler factor, spectrum, color
    Probe(ProbeArguments),
    /// Measure what accuracy costs: render one image at many settings, report time and error of each
    Study(StudyArguments),
    /// Print the JSON schema of the shot format, for editors
    Schema,
}

#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    /// Shot files, rendered one after the other; images go to DIR/STEM/STEM.0001.png and so on
    #[arg(required = true, value_name = "SHOT")]
    pub(super) shots: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) pictures: PictureArguments,
    /// Frames to render, such as 1-10,20 or 1-100:5 (every fifth) or 100- (to the last) [default:
    /// all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub(super) frames: Option<FrameList>,
    /// Number of threads, 0 for one per processor; images do not depend on it
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    pub(super) threads: u16,
    /// Render only part K of N of the chosen frames, for several machines that share the folder
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    pub(super) shard: Option<Shard>,
    /// Render all chosen frames, also those that are up to date
    #[arg(long)]
    pub(super) force: bool,
    /// How progress is shown on standard error: "auto" is a bar on a terminal and one line per frame
    /// elsewhere, "json" one JSON object per line; "openjd" writes Open Job Description messages to
    /// standard output
    #[arg(long, value_name = "MODE", value_enum, default_value = "auto")]
    pub(super) progress: ProgressMode,
    /// Print events to standard output, one JSON object per line
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(super) enum ProgressMode {
    Auto,
    Bar,
    Plain,
    Json,
    #[value(name = "openjd")]
    OpenJd,
    None,
}

impl From<ProgressMode> for Mode {
    fn from(mode: ProgressMode) -> Self {
        match mode {
            ProgressMode::Auto => Self::Auto,
            ProgressMode::Bar => Self::Bar,
            ProgressMode::Plain => Self::Plain,
            ProgressMode::Json => Self::Json,
            ProgressMode::OpenJd => Self::OpenJd,
            ProgressMode::None => Self::None,
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct PlanArguments {
    /// Shot file
    pub(super) shot: PathBuf,
    #[command(flatten)]
    pub(super) pictures: PictureArguments,
    /// Frames to list, such as 1-10,20 [default: all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub(super) frames: Option<FrameList>,
    /// Print the result as JSON
    #[arg(long)]
    pub(super) json: bool,
}

/// Arguments of the commands that work on finished frames.
#[derive(Debug, Args)]
pub(super) struct FinishedArguments {
    /// Shot files
    #[arg(required = true, value_name = "SHOT")]
    pub(super) shots: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) pictures: PictureArguments,
    /// Print the result as JSON
    #[arg(long)]
    pub(super) json: bool,
}

/// Folder, size and samples of a shot's images.
#[derive(Debug, Args)]
pub(super) struct PictureArguments {
    /// Folder in which each shot has a folder of images
    #[arg(long, value_name = "DIR", default_value = "renders")]
    pub(super) out: PathBuf,
    /// Factor on the image size, such as 0.5
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = scale, allow_negative_numbers = true)]
    pub(super) scale: f64,
    /// Samples per pixel, in place of those of the shot
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536), allow_negative_numbers = true)]
    pub(super) samples: Option<u32>,
}

impl PictureArguments {
    pub(super) fn request(&self) -> Request {
        Request {
            out: self.out.clone(),
            scale: self.scale,
            samples: self.samples,
        }
    }
}

/// The listed frames, or every frame.
pub(super) fn frames(list: Option<&FrameList>) -> FrameList {
    list.cloned().unwrap_or_else(FrameList::all)
}

#[derive(Debug, Args)]
pub(super) struct ProbeArguments {
    /// Shot file
    pub(super) shot: PathBuf,
    /// Frame number
    #[arg(long, value_name = "N", default_value = "1")]
    pub(super) frame: u32,
    /// Column and row of the pixel; 0 0 is the upper left
    #[arg(long, num_args = 2, value_names = ["X", "Y"], required = true)]
    pub(super) pixel: Vec<u32>,
    /// Also write a plot of the pixel's curves to this SVG file
    #[arg(long, value_name = "FILE")]
    pub(super) plot: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(super) struct StudyArguments {
    /// Shot file
    pub(super) shot: PathBuf,
    /// Folder for the report: DIR/STEM/study.html, study.csv and study.json
    #[arg(long, value_name = "DIR", default_value = "renders")]
    pub(super) out: PathBuf,
    /// Frame number [default: the last of those with the most effects]
    #[arg(long, value_name = "N")]
    pub(super) frame: Option<u32>,
    /// Factor on the image size [default: such that it has at most 640 x 360 pixels]
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_negative_numbers = true)]
    pub(super) scale: Option<f64>,
    /// Samples per pixel, except where samples are what is varied [default: the shot's, at most 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536), allow_negative_numbers = true)]
    pub(super) samples: Option<u32>,
    /// How many times each setting is rendered
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000), allow_negative_numbers = true)]
    pub(super) repeats: u32,
    /// Number of threads, 0 for one per processor
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    pub(super) threads: u16,
    /// Also print the results as JSON
    #[arg(long)]
    pub(super) json: bool,
}

/// Parses a factor on the image size: finite and above 0.
pub(super) fn scale(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err("a scale is a number above 0, such as 0.5".to_owned()),
    }
}
