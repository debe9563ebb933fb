//! What a study found out: the content of its report, its JSON and its CSV.
//!
//! Times are seconds of wall clock; those of phases that threads share are divided by their number. Spectral radiance is compared as the sensor's channels of it.

use serde::Serialize;

/// A study of one image.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Study {
    /// Version of this layout.
    pub schema_version: u32,
    /// Name of the shot's file without extension.
    pub shot: String,
    /// The shot's title, if it has one.
    pub title: Option<String>,
    /// Which frame was studied.
    pub frame: u32,
    /// Width and height of the pictures, pixels.
    pub size: [u32; 2],
    /// Samples a pixel, where they are not what is swept.
    pub samples: u32,
    /// What it ran on.
    pub machine: Machine,
    /// How much equal work differed in time.
    pub noise: Noise,
    /// Where the time of the shot as it is goes.
    pub phases: Vec<PhaseTime>,
    /// One knob each, the others as the shot has them.
    pub sweeps: Vec<Sweep>,
    /// What each effect costs.
    pub effects: Vec<EffectCost>,
    /// The findings of the 1990 paper (§6) beside these.
    pub paper: Vec<PaperRow>,
    /// The cheapest settings within a difference of color.
    pub recommendations: Vec<Recommendation>,
}

/// The machine and the program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor, where the system tells.
    pub processor: Option<String>,
    /// Threads that rendered.
    pub threads: usize,
    /// The program's version.
    pub version: &'static str,
    /// Renders of each point; fewer of those that take long.
    pub repeats: u32,
}

/// How much equal work differed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Noise {
    /// Median over points of (greatest − least)/median of their repeats.
    pub spread: f64,
    /// Median time of a second copy of the shot as it is over that of the first: 1 but for noise.
    pub duplicate: f64,
    /// Whether times differ too much to tell settings apart that are within 10 % of each other.
    pub too_noisy: bool,
}

impl Noise {
    /// Part of a time within which settings cannot be told apart.
    pub fn tolerance(&self) -> f64 {
        /// Medians of five differ by about half of what single times do.
        const OF_MEDIANS: f64 = 0.5;
        const LEAST: f64 = 0.02;
        /// With more noise, a study says that it cannot tell.
        const MOST: f64 = 0.1;
        (OF_MEDIANS * self.spread)
            .max((self.duplicate - 1.0).abs())
            .clamp(LEAST, MOST)
    }
}

/// Time of a phase.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhaseTime {
    /// "prepare", "aim", "boost", "traverse", "shadow", "surfaces", "shade", "develop", "write".
    pub phase: &'static str,
    /// Seconds of wall clock, about.
    pub seconds: f64,
    /// Part of the sum of all phases.
    pub share: f64,
    /// What happens in it.
    pub what: &'static str,
}

/// A knob and what its settings cost and bring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sweep {
    /// The key of the shot, such as "accuracy.spectra".
    pub knob: String,
    /// What the knob is, a sentence without full stop.
    pub what: String,
    /// The phase that it touches.
    pub phase: &'static str,
    /// What errors are measured against, a sentence without full stop.
    pub reference: String,
    /// Its settings; none where the shot leaves nothing to sweep.
    pub points: Vec<Point>,
    /// Why there are none, or what else should be known.
    pub note: Option<String>,
    /// To halve the error, pay this: between neighbours of a family, coarse to fine.
    pub halving: Vec<Halving>,
}

/// One setting of a knob.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// In words, such as "lines, 5 nm".
    pub setting: String,
    /// Those that lie on one curve of a chart, such as "lines".
    pub family: String,
    /// What to write into the shot, such as `spectra = "lines"`; None where no key says it.
    pub toml: Option<String>,
    /// Whether it is what the shot has.
    pub current: bool,
    /// Whole image: prepared, traced, shaded, developed, encoded, written.
    pub frame: Timing,
    /// The phase that the knob touches.
    pub phase: Timing,
    /// Greatest memory of the process meanwhile, MiB, where the system tells; bodies of all settings
    /// of the knob are in it.
    pub memory_mib: Option<f64>,
    /// Bytes of the files that it makes, where the knob touches them.
    pub file_bytes: Option<u64>,
    /// Against the sweep's reference; None for the reference itself.
    pub errors: Option<Errors>,
    /// No other setting is at least as exact and faster by more than [`Noise::tolerance`].
    pub pareto: bool,
}

/// Times of equal renders, seconds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timing {
    /// The middle one.
    pub median: f64,
    /// The shortest.
    pub least: f64,
    /// The longest.
    pub greatest: f64,
}

/// Differences of two pictures.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Root mean square of the difference of the channels over that of the reference.
    pub radiance: f64,
    /// CIEDE2000 of developed pixels before they are rounded to 8 bits; None for false colors.
    pub delta_e: Option<Percentiles>,
    /// How far surfaces stand from where they should, pixels, where geometry is what is swept.
    pub displacement: Option<Percentiles>,
    /// Part of the pixels that see another surface than they should.
    pub mistaken: Option<f64>,
    /// What the program states, before it renders, that no light seen without mirrors, glass, sky
    /// images and stars can err by: of a channel, over
    /// that of an equal-energy light as bright as the product of the peaks of the spectra in reach.
    pub bound: Option<f64>,
}

/// Values of all pixels in three numbers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Percentiles {
    /// Their mean.
    pub mean: f64,
    /// What 99 % do not exceed.
    pub p99: f64,
    /// The greatest.
    pub worst: f64,
}

/// The price of a smaller error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Halving {
    /// The family.
    pub family: String,
    /// From this setting …
    pub from: String,
    /// … to this.
    pub to: String,
    /// By how much the error falls: error before over after.
    pub error_ratio: f64,
    /// Time of the whole image after over before.
    pub time_ratio: f64,
    /// Time ratio for every halving of the error, if it went on like this; None where the error
    /// does not fall.
    pub per_halving: Option<f64>,
}

/// What an effect costs in this image.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EffectCost {
    /// "geometry", "doppler", "beaming", "thermal", "shadows", "mirror" (with glass), "second worldline".
    pub effect: &'static str,
    /// Whether the image calls for it.
    pub called: bool,
    /// Why, a sentence without full stop.
    pub why: String,
    /// Image with it.
    pub on: Timing,
    /// Image without.
    pub off: Timing,
    /// Median over repeats of on/off − 1 of neighbouring renders: 0.02 is 2 %.
    pub cost: f64,
    /// Half of the range in which those ratios lie, without a tenth of them at either end.
    pub spread: f64,
    /// What the 1990 paper says, such as "under 5 %".
    pub paper: Option<&'static str>,
}

/// A finding of the 1990 paper and ours.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperRow {
    /// What is compared.
    pub what: String,
    /// The paper's figure, as it says it.
    pub paper: String,
    /// Ours, as a part of the time of everything else: 0.02 is 2 %; None where the shot has no such thing.
    pub ours: Option<f64>,
    /// How it was measured.
    pub how: String,
}

/// The cheapest setting within a difference of color.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Recommendation {
    /// Of which knob.
    pub knob: String,
    /// CIEDE2000 that 99 % of the pixels do not exceed.
    pub delta_e: f64,
    /// The setting, if any of those measured is within it.
    pub setting: Option<String>,
    /// What to write into the shot.
    pub toml: Option<String>,
    /// Time of its image over that of the shot as it is.
    pub time_ratio: Option<f64>,
}
