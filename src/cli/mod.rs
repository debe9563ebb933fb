//! The command line: arguments in, messages and an exit code out.
//!
//! Results go to standard output, progress and diagnostics to standard error. Exit status: 0 if
//! everything was done, 1 if something failed while rendering, 2 for a mistake in the shot or in the
//! arguments, 130 if interrupted (Ctrl-C), 143 if terminated.

mod answer;
mod assemble;
mod check;
mod open;
mod plan;
mod probe;
mod render;
mod study;
mod verify;

use crate::progress::Mode;
use crate::queue::{FrameList, Shard};
use crate::render::Prepared;
use crate::shot::{self, Mistakes};
use crate::store::Request;
use clap::{Args, Parser, Subcommand};
use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Render scenes in which things move at nearly the speed of light
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
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
struct RenderArguments {
    /// Shot files, rendered one after the other; images go to DIR/STEM/STEM.0001.png and so on
    #[arg(required = true, value_name = "SHOT")]
    shots: Vec<PathBuf>,
    #[command(flatten)]
    pictures: PictureArguments,
    /// Frames to render, such as 1-10,20 or 1-100:5 (every fifth) or 100- (to the last) [default:
    /// all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    frames: Option<FrameList>,
    /// Number of threads, 0 for one per processor; images do not depend on it
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    threads: u16,
    /// Render only part K of N of the chosen frames, for several machines that share the folder
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    shard: Option<Shard>,
    /// Render all chosen frames, also those that are up to date
    #[arg(long)]
    force: bool,
    /// How progress is shown on standard error: "auto" is a bar on a terminal and one line per frame
    /// elsewhere, "json" one JSON object per line; "openjd" writes Open Job Description messages to
    /// standard output
    #[arg(long, value_name = "MODE", value_enum, default_value = "auto")]
    progress: ProgressMode,
    /// Print events to standard output, one JSON object per line
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum ProgressMode {
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
struct PlanArguments {
    /// Shot file
    shot: PathBuf,
    #[command(flatten)]
    pictures: PictureArguments,
    /// Frames to list, such as 1-10,20 [default: all]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    frames: Option<FrameList>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Arguments of the commands that work on finished frames.
#[derive(Debug, Args)]
struct FinishedArguments {
    /// Shot files
    #[arg(required = true, value_name = "SHOT")]
    shots: Vec<PathBuf>,
    #[command(flatten)]
    pictures: PictureArguments,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Folder, size and samples of a shot's images.
#[derive(Debug, Args)]
struct PictureArguments {
    /// Folder in which each shot has a folder of images
    #[arg(long, value_name = "DIR", default_value = "renders")]
    out: PathBuf,
    /// Factor on the image size, such as 0.5
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = scale, allow_negative_numbers = true)]
    scale: f64,
    /// Samples per pixel, in place of those of the shot
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536), allow_negative_numbers = true)]
    samples: Option<u32>,
}

impl PictureArguments {
    fn request(&self) -> Request {
        Request {
            out: self.out.clone(),
            scale: self.scale,
            samples: self.samples,
        }
    }
}

/// The listed frames, or every frame.
fn frames(list: Option<&FrameList>) -> FrameList {
    list.cloned().unwrap_or_else(FrameList::all)
}

#[derive(Debug, Args)]
struct ProbeArguments {
    /// Shot file
    shot: PathBuf,
    /// Frame number
    #[arg(long, value_name = "N", default_value = "1")]
    frame: u32,
    /// Column and row of the pixel; 0 0 is the upper left
    #[arg(long, num_args = 2, value_names = ["X", "Y"], required = true)]
    pixel: Vec<u32>,
    /// Also write a plot of the pixel's curves to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct StudyArguments {
    /// Shot file
    shot: PathBuf,
    /// Folder for the report: DIR/STEM/study.html, study.csv and study.json
    #[arg(long, value_name = "DIR", default_value = "renders")]
    out: PathBuf,
    /// Frame number [default: the last of those with the most effects]
    #[arg(long, value_name = "N")]
    frame: Option<u32>,
    /// Factor on the image size [default: such that it has at most 640 x 360 pixels]
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_negative_numbers = true)]
    scale: Option<f64>,
    /// Samples per pixel, except where samples are what is varied [default: the shot's, at most 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536), allow_negative_numbers = true)]
    samples: Option<u32>,
    /// How many times each setting is rendered
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000), allow_negative_numbers = true)]
    repeats: u32,
    /// Number of threads, 0 for one per processor
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    threads: u16,
    /// Also print the results as JSON
    #[arg(long)]
    json: bool,
}

/// Parses a factor on the image size: finite and above 0.
fn scale(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err("a scale is a number above 0, such as 0.5".to_owned()),
    }
}

/// Exit status for a mistake in the shot or in the arguments.
const MISTAKE: u8 = 2;
/// Exit status if something failed while rendering.
const FAILURE: u8 = 1;

/// Runs the command line of this process.
pub fn run() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Check { shots, json } => check::run(&shots, json),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Assemble(arguments) => assemble::run(&arguments),
        Command::Probe(arguments) => probe::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Schema => schema(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failed(status)) => ExitCode::from(status),
    }
}

/// Exit status of a command that failed. The message has been printed already.
struct Failed(u8);

fn schema() -> Result<(), Failed> {
    print_json(&shot::schema())
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failed> {
    let text = serde_json::to_string_pretty(value).map_err(|error| failed(&error.to_string()))?;
    print(&text)
}

/// Prints a line to standard output. A closed pipe, as by `| head`, is not a failure.
fn print(text: &str) -> Result<(), Failed> {
    match writeln!(io::stdout().lock(), "{text}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(failed(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints an error that occurred while rendering.
fn failed(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(FAILURE)
}

/// Prints an error in the arguments.
fn misused(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(MISTAKE)
}

/// Prints the mistakes of a shot, each with its place in the file.
fn mistaken(mistakes: &Mistakes) -> Failed {
    say(mistakes.report(color_on_stderr()).trim_end());
    Failed(MISTAKE)
}

/// Prints warnings: content of the shot's files that the image will not show.
fn warn(prepared: &Prepared) {
    for warning in prepared.warnings() {
        say(&format!("warning: {warning}"));
    }
}

/// A pool of this many threads; 0 for one per processor.
fn pool(threads: u16) -> Result<rayon::ThreadPool, Failed> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .map_err(|error| failed(&error.to_string()))
}

/// Prints a line to standard error. A failure to do so is ignored, since there is nowhere to report
/// it.
fn say(line: &str) {
    let _unheard = writeln!(io::stderr().lock(), "{line}");
}

fn color_on_stderr() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    io::stderr().is_terminal() && !set("NO_COLOR") && !dumb
}
