//! Chart of error over time on two logarithmic axes: a curve for each family of settings, coarse to
//! fine, and rings for the Pareto front and for the shot's own setting.

use super::measure::{Error, Measure};
use super::measure::{number, time, unit_of_time};
use crate::plot::{Axis, Color, Page, Panel, Plot, Remark, Series, Stroke, lay_out, svg};
use crate::study::results::{Point, Sweep};

/// A chart, and notes below it.
#[derive(Debug)]
pub(super) struct Chart {
    /// An `svg` element.
    pub(super) svg: String,
    /// Notes, one sentence each.
    pub(super) notes: Vec<String>,
}

/// The time on the horizontal axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Clock {
    Frame,
    Phase,
}

const PAGE: Page = Page {
    size: [1000.0, 440.0],
    font: 14.0,
};
/// Colors that are distinct in all kinds of color vision, after Okabe & Ito 2008, none too light
/// for white paper.
const COLORS: [Color; 6] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 145, 105],
    [178, 80, 140],
    [120, 100, 20],
    [60, 140, 200],
];
const FRONT: Color = [120, 120, 120];
const CURRENT: Color = [200, 30, 30];
/// Errors below this share of the greatest are drawn on the lower edge, as errors of 0 are.
const DEPTH: f64 = 1e-14;
/// Relative difference below which the times of image and phase are shown once.
const EQUAL_TIMES: f64 = 0.01;

/// The chart over the time of the whole image and, if that differs, over the time of the phase;
/// none if no point has an error and a time. `id` keeps their parts apart from others on the page.
pub(super) fn charts(sweep: &Sweep, id: &str) -> Vec<Chart> {
    let measure = Measure::of(sweep);
    let differs = |point: &Point| {
        let ratio = point.phase.median / point.frame.median;
        ratio > 0.0 && (ratio - 1.0).abs() > EQUAL_TIMES
    };
    let mut clocks = vec![Clock::Frame];
    if sweep.points.iter().any(differs) {
        clocks.push(Clock::Phase);
    }
    let made = clocks.into_iter().enumerate();
    made.filter_map(|(i, clock)| {
        let easel = Easel::new(sweep, measure, clock)?;
        Some(easel.chart(&format!("{id}-chart-{}", i + 1)))
    })
    .collect()
}

/// The families of a sweep, in the order in which they first appear.
pub(super) fn families(sweep: &Sweep) -> Vec<&str> {
    let mut families: Vec<&str> = Vec::new();
    for point in &sweep.points {
        if !families.contains(&point.family.as_str()) {
            families.push(&point.family);
        }
    }
    families
}

/// The color of a family.
pub(super) fn color(sweep: &Sweep, family: &str) -> Color {
    let place = families(sweep).iter().position(|name| *name == family);
    COLORS[place.unwrap_or(0) % COLORS.len()]
}

/// A point on the chart.
struct Dot<'a> {
    point: &'a Point,
    /// Its row in the table, counted from 1.
    row: usize,
    seconds: f64,
    error: Error,
}

struct Easel<'a> {
    sweep: &'a Sweep,
    measure: Measure,
    clock: Clock,
    dots: Vec<Dot<'a>>,
    x: Axis,
    y: Axis,
    /// Seconds per unit of the horizontal axis.
    unit: f64,
}

impl<'a> Easel<'a> {
    fn new(sweep: &'a Sweep, measure: Measure, clock: Clock) -> Option<Self> {
        let dot = |(i, point): (usize, &'a Point)| {
            let seconds = match clock {
                Clock::Frame => point.frame.median,
                Clock::Phase => point.phase.median,
            };
            let error = measure.error(point)?;
            Some(Dot {
                point,
                row: i + 1,
                seconds,
                error,
            })
        };
        let dots: Vec<Dot<'a>> = sweep.points.iter().enumerate().filter_map(dot).collect();
        let times = dots.iter().map(|dot| dot.seconds);
        let [shortest, longest] = extent(times.filter(|s| s.is_finite() && *s > 0.0))?;
        let (unit, name) = unit_of_time(longest);
        let label = match clock {
            Clock::Frame => "time of the whole image".to_owned(),
            Clock::Phase => format!("time of the phase “{}”", sweep.phase),
        };
        Some(Self {
            sweep,
            measure,
            clock,
            x: Axis::around(&label, name, [shortest / unit, longest / unit]),
            y: error_axis(measure, &dots),
            unit,
            dots,
        })
    }

    fn chart(&self, id: &str) -> Chart {
        let against = match self.clock {
            Clock::Frame => "the time of the whole image".to_owned(),
            Clock::Phase => format!("the time of the phase “{}”", self.sweep.phase),
        };
        let plot = Plot {
            caption: vec![format!("{}: error against {against}", self.sweep.knob)],
            panels: vec![Panel {
                title: String::new(),
                x: self.x.clone(),
                y: self.y.clone(),
                tints: Vec::new(),
                series: self.series(),
                note: None,
            }],
        };
        let mut drawing = lay_out(&plot, PAGE);
        for group in &mut drawing.groups {
            group.id = format!("{id}-{}", group.id);
        }
        Chart {
            svg: svg(&drawing),
            notes: self.notes(),
        }
    }

    /// Lines below dots below rings.
    fn series(&self) -> Vec<Series> {
        let families = families(self.sweep);
        let mut series = Vec::new();
        if self.clock == Clock::Frame {
            series.push(self.front());
        }
        let lines = families.iter().map(|family| self.line(family));
        series.extend(lines.filter(|line| line.points.len() > 1));
        series.extend(families.iter().map(|family| self.family_dots(family)));
        series.push(self.rings("Pareto front", 8.0, FRONT, |point| point.pareto));
        series.push(self.rings("as the shot is", 12.0, CURRENT, |point| point.current));
        series.retain(|series| !series.points.is_empty());
        series
    }

    /// A line only through errors that have a logarithm: one to the lower edge would be misleading.
    fn line(&self, family: &str) -> Series {
        self.drawn(family, Stroke::Solid(1.8), |dot| {
            dot.point.family == family && matches!(dot.error, Error::Measured(_))
        })
    }

    fn family_dots(&self, family: &str) -> Series {
        let ours = self.dots.iter().filter(|dot| dot.point.family == family);
        Series {
            remarks: ours.map(|dot| self.remark(dot)).collect(),
            ..self.drawn(family, Stroke::Dots(5.0), |dot| dot.point.family == family)
        }
    }

    fn rings(&self, name: &str, radius: f64, color: Color, some: fn(&Point) -> bool) -> Series {
        Series {
            color,
            ..self.drawn(name, Stroke::Rings(radius), |dot| some(dot.point))
        }
    }

    /// Some of the dots, joined in the order of the table, in the colour of the family `name`.
    fn drawn(&self, name: &str, stroke: Stroke, some: impl Fn(&Dot<'_>) -> bool) -> Series {
        let dots = self.dots.iter().filter(|dot| some(dot));
        Series {
            name: name.to_owned(),
            color: color(self.sweep, name),
            stroke,
            points: dots.map(|dot| self.at(dot)).collect(),
            remarks: Vec::new(),
        }
    }

    /// The staircase of the Pareto front; no setting is below it.
    fn front(&self) -> Series {
        let best = self.dots.iter().filter(|dot| dot.point.pareto);
        let mut front: Vec<[f64; 2]> = best.map(|dot| self.at(dot)).collect();
        let mut corners: Vec<[f64; 2]> = Vec::new();
        front.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for [x, y] in front {
            if let Some([_, before]) = corners.last() {
                corners.push([x, *before]);
            }
            corners.push([x, y]);
        }
        Series {
            name: "Pareto front".to_owned(),
            color: FRONT,
            stroke: Stroke::Dashed(1.4),
            points: corners,
            remarks: Vec::new(),
        }
    }

    /// Position of a dot, in values of the axes.
    fn at(&self, dot: &Dot<'_>) -> [f64; 2] {
        // Slightly above the first value, because the axis hides values at its beginning.
        let floor = self.y.range[0] * (1.0 + 1e-6);
        let error = match dot.error {
            Error::Measured(value) => value.max(floor),
            Error::None => floor,
            Error::Beyond => self.y.range[1],
        };
        [dot.seconds / self.unit, error]
    }

    fn remark(&self, dot: &Dot<'_>) -> Remark {
        let error = match dot.error {
            Error::Measured(value) => format!("error {} {}", number(value), self.measure.unit),
            Error::None if dot.point.errors.is_none() => "the reference".to_owned(),
            Error::None => "no error".to_owned(),
            Error::Beyond => "an infinite error".to_owned(),
        };
        Remark {
            label: dot.point.setting.clone(),
            short: dot.row.to_string(),
            tip: format!(
                "{}. {}: {}, {}",
                dot.row,
                dot.point.setting,
                time(dot.seconds),
                error.trim_end()
            ),
        }
    }

    fn notes(&self) -> Vec<String> {
        let floored = |dot: &Dot<'_>| match dot.error {
            Error::Measured(value) => value <= self.y.range[0],
            other => other == Error::None,
        };
        let mut notes = Vec::new();
        if self.dots.iter().any(floored) {
            notes.push(
                "Points at the lower edge of the chart have no error, or one too small to show."
                    .to_owned(),
            );
        }
        if self.dots.iter().any(|dot| dot.error == Error::Beyond) {
            notes.push("Points at its upper edge have an infinite error.".to_owned());
        }
        let lacking = self.sweep.points.len() - self.dots.len();
        if lacking > 0 {
            notes.push(format!(
                "Settings without this error, found in the table only: {lacking}."
            ));
        }
        notes
    }
}

/// The axis of errors: from one decade below the measured values, if a dot is at the lower edge, to
/// one above, if a dot is at the upper edge.
fn error_axis(measure: Measure, dots: &[Dot<'_>]) -> Axis {
    let has = |error: Error| dots.iter().any(|dot| dot.error == error);
    let measured = dots.iter().filter_map(|dot| match dot.error {
        Error::Measured(value) => Some(value),
        _ => None,
    });
    let [least, greatest] = extent(measured).unwrap_or([1e-3, 1.0]);
    let least = least.max(greatest * DEPTH);
    let low = if has(Error::None) {
        least / 10.0
    } else {
        least
    };
    let high = if has(Error::Beyond) {
        greatest * 10.0
    } else {
        greatest
    };
    // A dot at the very end of a decade would be cut by the frame.
    let high = (high * 1.2).min(f64::MAX);
    Axis::decades(measure.label, measure.unit, [low / 1.2, high])
}

fn extent(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |known: Option<[f64; 2]>, value| {
        let [least, greatest] = known.unwrap_or([value, value]);
        Some([least.min(value), greatest.max(value)])
    })
}
