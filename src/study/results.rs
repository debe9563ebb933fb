//! Results of a study: the content of its report, its JSON and its CSV.
//!
//! Times are seconds of wall clock; those of phases that threads share are divided by the number of
//! threads. Spectral radiance is compared by the sensor's channels.

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
    /// Frame number.
    pub frame: u32,
    /// Width and height of the images, pixels.
    pub size: [u32; 2],
    /// Samples per pixel, except where samples are what is varied.
    pub samples: u32,
    /// The machine and program.
    pub machine: Machine,
    /// Scatter of times of equal work.
    pub noise: Noise,
    /// Times of the phases, for the shot unchanged.
    pub phases: Vec<PhaseTime>,
    /// Sweeps, each over one knob while the others keep the values of the shot.
    pub sweeps: Vec<Sweep>,
    /// Cost of each effect.
    pub effects: Vec<EffectCost>,
    /// The results of the 1990 paper (§6) beside these.
    pub paper: Vec<PaperRow>,
    /// The cheapest settings within limits of color difference.
    pub recommendations: Vec<Recommendation>,
}

/// The machine and the program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor, if the system states it.
    pub processor: Option<String>,
    /// Number of threads that rendered.
    pub threads: usize,
    /// Version of the program.
    pub version: &'static str,
    /// Renders of each point; fewer for those that take long.
    pub repeats: u32,
}

/// Scatter of times of equal work.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Noise {
    /// Median over points of (greatest − least)/median of their repeats.
    pub spread: f64,
    /// Median time of a second copy of the unchanged shot over that of the first: 1 except for
    /// noise.
    pub duplicate: f64,
    /// Whether times scatter too much to tell settings apart that are within 10 % of each other.
    pub too_noisy: bool,
}

impl Noise {
    /// Relative difference of times within which settings cannot be told apart.
    pub fn tolerance(&self) -> f64 {
        /// Medians of five scatter by about half as much as single times.
        const OF_MEDIANS: f64 = 0.5;
        const LEAST: f64 = 0.02;
        /// Noise above which a study states that it cannot tell settings apart.
        const MOST: f64 = 0.1;
        (OF_MEDIANS * self.spread)
            .max((self.duplicate - 1.0).abs())
            .clamp(LEAST, MOST)
    }
}

/// Time of a phase.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhaseTime {
    /// Name: "prepare", "aim", "boost", "traverse", "shadow", "surfaces", "shade", "develop" or
    /// "write".
    pub phase: &'static str,
    /// Approximate seconds of wall clock.
    pub seconds: f64,
    /// Share of the sum of all phases.
    pub share: f64,
    /// What happens in the phase.
    pub what: &'static str,
}

/// A knob, with cost and error of its settings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sweep {
    /// The key of the shot, such as "accuracy.spectra".
    pub knob: String,
    /// Description of the knob, a sentence without full stop.
    pub what: String,
    /// The phase that the knob affects.
    pub phase: &'static str,
    /// The reference of its errors, a sentence without full stop.
    pub reference: String,
    /// Its settings; empty if the shot leaves nothing to choose.
    pub points: Vec<Point>,
    /// Why there are no settings, or what else should be known.
    pub note: Option<String>,
    /// Prices of halving the error, between neighbors of a family, coarse to fine.
    pub halving: Vec<Halving>,
}

/// One setting of a knob.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Point {
    /// Description, such as "lines, 5 nm".
    pub setting: String,
    /// Family: settings on one curve of a chart, such as "lines".
    pub family: String,
    /// The text to write into the shot, such as `spectra = "lines"`; None if there is no such key.
    pub toml: Option<String>,
    /// Whether it is the shot's own setting.
    pub current: bool,
    /// Times of the whole image: prepare, trace, shade, develop, encode, write.
    pub frame: Timing,
    /// Times of the phase that the knob affects.
    pub phase: Timing,
    /// Peak memory of the process meanwhile, MiB, if the system states it; the bodies of all
    /// settings of the knob are included.
    pub memory_mib: Option<f64>,
    /// Size of its files in bytes, if the knob affects them.
    pub file_bytes: Option<u64>,
    /// Errors against the sweep's reference; None for the reference itself.
    pub errors: Option<Errors>,
    /// Whether no other setting is at least as exact and faster by more than [`Noise::tolerance`].
    pub pareto: bool,
}

/// Times of equal renders, seconds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timing {
    /// The median.
    pub median: f64,
    /// The shortest.
    pub least: f64,
    /// The longest.
    pub greatest: f64,
}

/// Differences of two images.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Root mean square of the difference of the channels over that of the reference.
    pub radiance: f64,
    /// CIEDE2000 of developed pixels before rounding to 8 bits; None for false colors.
    pub delta_e: Option<Percentiles>,
    /// Displacement of surfaces, pixels, if geometry is what is varied.
    pub displacement: Option<Percentiles>,
    /// Share of pixels that show another surface than the reference.
    pub mistaken: Option<f64>,
    /// Bound on the error of light seen without mirrors, glass, sky images and stars, as the
    /// program states it before rendering: of a channel, relative to that of an equal-energy light
    /// as bright as the product of the peaks of the spectra in reach.
    pub bound: Option<f64>,
}

/// Three numbers on the values of all pixels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Percentiles {
    /// The mean.
    pub mean: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The greatest.
    pub worst: f64,
}

/// The price of a smaller error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Halving {
    /// Its family.
    pub family: String,
    /// The coarser setting.
    pub from: String,
    /// The finer setting.
    pub to: String,
    /// Ratio of the errors, before over after.
    pub error_ratio: f64,
    /// Ratio of the times of the whole image, after over before.
    pub time_ratio: f64,
    /// Time ratio for each halving of the error at this rate; None if the error does not fall.
    pub per_halving: Option<f64>,
}

/// Cost of an effect in this image.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EffectCost {
    /// "geometry", "doppler", "beaming", "thermal", "shadows", "mirror" (with glass), "second worldline".
    pub effect: &'static str,
    /// Whether the image needs it.
    pub called: bool,
    /// Why, a sentence without full stop.
    pub why: String,
    /// Times of the image with it.
    pub on: Timing,
    /// Times of the image without it.
    pub off: Timing,
    /// Median over repeats of on/off − 1 of neighboring renders: 0.02 is 2 %.
    pub cost: f64,
    /// Half of the range of those ratios, without a tenth of them at either end.
    pub spread: f64,
    /// Statement of the 1990 paper, such as "under 5 %".
    pub paper: Option<&'static str>,
}

/// A result of the 1990 paper, and ours.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperRow {
    /// What is compared.
    pub what: String,
    /// The paper's figure, in its words.
    pub paper: String,
    /// Our figure, as a share of the time of everything else: 0.02 is 2 %; None if the shot has no
    /// such thing.
    pub ours: Option<f64>,
    /// How it was measured.
    pub how: String,
}

/// The cheapest setting within a limit of color difference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Recommendation {
    /// The knob.
    pub knob: String,
    /// The limit: CIEDE2000 at the 99th percentile of the pixels.
    pub delta_e: f64,
    /// The setting, if one of those measured is within the limit.
    pub setting: Option<String>,
    /// The text to write into the shot.
    pub toml: Option<String>,
    /// Time of its image relative to that of the unchanged shot.
    pub time_ratio: Option<f64>,
}
