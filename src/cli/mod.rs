//! The command line: arguments in, messages and an exit code out.
//!
//! Results go to standard output, progress and diagnostics to standard error. Exit status: 0
//! done, 1 something failed while rendering, 2 a mistake in the shot or the call, 130 interrupted,
//! 143 terminated.

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

/// Renders scenes in which things move at nearly the speed of light
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Renders shots to images, DIR/STEM/STEM.0001.png and so on
    Render(RenderArguments),
    /// Reads shots and everything they name, and renders nothing
    Check {
        /// Shot files
        #[arg(required = true, value_name = "SHOT")]
        shots: Vec<PathBuf>,
        /// Report as JSON on standard output
        #[arg(long)]
        json: bool,
    },
    /// Tells what each frame calls for and why, which frames share a trace, and what they will take
    Plan(PlanArguments),
    /// Tells which frames are missing, stale, broken or suspicious
    Verify(FinishedArguments),
    /// Makes sheets, animations, videos and the page of finished frames
    Assemble(FinishedArguments),
    /// Tells what the centre of one pixel sees: event, Doppler factor, spectrum, colour
    Probe(ProbeArguments),
    /// Measures what accuracy costs in time: a report of one image at many settings of every knob
    Study(StudyArguments),
    /// Prints the JSON schema of the shot format, for editors
    Schema,
}

#[derive(Debug, Args)]
struct RenderArguments {
    /// Shot files, rendered one after the other
    #[arg(required = true, value_name = "SHOT")]
    shots: Vec<PathBuf>,
    #[command(flatten)]
    pictures: PictureArguments,
    /// Frames, such as 1-10,20 or 1-100:5 (":" steps, "100-" goes to the end); default all
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    frames: Option<FrameList>,
    /// Threads; 0 takes every processor. The images are the same for any number
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    threads: u16,
    /// The K-th of N parts of the frames chosen, the same parts on every machine
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    shard: Option<Shard>,
    /// Render finished frames too, whose inputs have not changed
    #[arg(long)]
    force: bool,
    /// How progress is shown on standard error: auto is a bar on a terminal and lines elsewhere,
    /// json one object a line; openjd tells Open Job Description on standard output
    #[arg(long, value_name = "MODE", value_enum, default_value = "auto")]
    progress: ProgressMode,
    /// Tell what happens on standard output, one JSON object a line
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
    /// Frames, such as 1-10,20; default all
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    frames: Option<FrameList>,
    /// Answer as JSON
    #[arg(long)]
    json: bool,
}

/// What to do with finished frames.
#[derive(Debug, Args)]
struct FinishedArguments {
    /// Shot files
    #[arg(required = true, value_name = "SHOT")]
    shots: Vec<PathBuf>,
    #[command(flatten)]
    pictures: PictureArguments,
    /// Answer as JSON
    #[arg(long)]
    json: bool,
}

/// Which pictures of a shot, and where they are.
#[derive(Debug, Args)]
struct PictureArguments {
    /// Folder that has a folder of images for each shot
    #[arg(long, value_name = "DIR", default_value = "renders")]
    out: PathBuf,
    /// Factor on the size of the images
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = scale, allow_negative_numbers = true)]
    scale: f64,
    /// Samples a pixel, in place of the shot's
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

/// Every frame, where no list is given.
fn frames(list: Option<&FrameList>) -> FrameList {
    list.cloned().unwrap_or_else(FrameList::all)
}

#[derive(Debug, Args)]
struct ProbeArguments {
    /// Shot file
    shot: PathBuf,
    /// Number of the frame
    #[arg(long, value_name = "N", default_value = "1")]
    frame: u32,
    /// The pixel; 0 0 is the upper left one
    #[arg(long, num_args = 2, value_names = ["X", "Y"], required = true)]
    pixel: Vec<u32>,
    /// SVG file that gets a plot of the pixel's curves
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Answer as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct StudyArguments {
    /// Shot file
    shot: PathBuf,
    /// Folder that gets a folder with study.html, study.csv and study.json
    #[arg(long, value_name = "DIR", default_value = "renders")]
    out: PathBuf,
    /// Number of the frame; default the last of those that call for most effects
    #[arg(long, value_name = "N")]
    frame: Option<u32>,
    /// Factor on the size of the image; default such that it has at most 640 x 360 pixels
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_negative_numbers = true)]
    scale: Option<f64>,
    /// Samples a pixel where they are not what is swept; default the shot's, at most 4
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536), allow_negative_numbers = true)]
    samples: Option<u32>,
    /// How often every setting is rendered
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000), allow_negative_numbers = true)]
    repeats: u32,
    /// Threads; 0 takes every processor
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u16).range(0..=1024), allow_negative_numbers = true)]
    threads: u16,
    /// Print the study as JSON on standard output too
    #[arg(long)]
    json: bool,
}

/// A factor on the size: above 0, finite.
fn scale(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err("a scale is a number above 0, such as 0.5".to_owned()),
    }
}

/// Exit status of a mistake in the shot or the call.
const MISTAKE: u8 = 2;
/// Exit status of something that failed while rendering.
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

/// The exit status of a command that has already said what is wrong.
struct Failed(u8);

fn schema() -> Result<(), Failed> {
    print_json(&shot::schema())
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failed> {
    let text = serde_json::to_string_pretty(value).map_err(|error| failed(&error.to_string()))?;
    print(&text)
}

/// Prints a line on standard output. A reader who has gone away is no failure.
fn print(text: &str) -> Result<(), Failed> {
    match writeln!(io::stdout().lock(), "{text}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(failed(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Says what failed while rendering.
fn failed(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(FAILURE)
}

/// Says what is wrong with the call.
fn misused(message: &str) -> Failed {
    say(&format!("error: {message}"));
    Failed(MISTAKE)
}

/// Shows mistakes of a shot.
fn mistaken(mistakes: &Mistakes) -> Failed {
    say(mistakes.report(color_on_stderr()).trim_end());
    Failed(MISTAKE)
}

/// Says what the shot's files ask for and the picture will not show.
fn warn(prepared: &Prepared) {
    for warning in prepared.warnings() {
        say(&format!("warning: {warning}"));
    }
}

/// So many threads; 0 for one a processor.
fn pool(threads: u16) -> Result<rayon::ThreadPool, Failed> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .map_err(|error| failed(&error.to_string()))
}

/// A line on standard error; trouble with it is passed over.
fn say(line: &str) {
    let _unheard = writeln!(io::stderr().lock(), "{line}");
}

fn color_on_stderr() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    io::stderr().is_terminal() && !set("NO_COLOR") && !dumb
}
