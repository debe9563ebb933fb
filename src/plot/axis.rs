//! An axis: mapping of values to places, and ticks.

/// The horizontal or vertical axis of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity, such as "wavelength".
    pub label: String,
    /// Unit of the quantity; empty if it has none.
    pub unit: String,
    /// Spacing of the values.
    pub scale: Scale,
    /// First and last value: finite, ascending, and above 0 if the scale is logarithmic.
    pub range: [f64; 2],
    /// Distance of the ticks of a linear axis; None for 1, 2 or 5 times a power of ten, as fits.
    pub step: Option<f64>,
}

/// Spacing of the values on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly spaced values.
    Linear,
    /// Evenly spaced logarithms. Values not above the first are placed at the beginning.
    Log,
}

/// A tick of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Place on the axis, from 0, its beginning, to 1.
    pub(super) place: f64,
    /// Label; None for a minor tick.
    pub(super) label: Option<String>,
}

/// Decimal exponents of numbers that f64 holds at full precision.
const EXPONENTS: [i32; 2] = [-300, 308];
/// Exponents of the last value of an axis for which labels are written without a power of ten.
const WRITTEN_OUT: std::ops::RangeInclusive<i32> = -2..=3;
/// Rounding error that does not cause one more tick.
const SLACK: f64 = 1e-9;

impl Axis {
    /// A linear axis from 0 to a round value not below `largest`, which is finite; to 1 if that is
    /// 0.
    pub fn from_zero(label: &str, unit: &str, largest: f64) -> Self {
        let top = if largest > 0.0 {
            let power = power(exponent(largest));
            let step = round_up(largest / power / 4.0);
            ((largest / power / step - SLACK).ceil() * step * power).min(f64::MAX)
        } else {
            1.0
        };
        Self::new(label, unit, Scale::Linear, [0.0, top])
    }

    /// A linear axis from 0 to the next 1, 2 or 5 times a power of ten not below `largest`, which
    /// is finite and above 0. The axis seldom changes while values grow.
    pub fn in_steps(label: &str, unit: &str, largest: f64) -> Self {
        let top = round_up(largest).min(f64::MAX);
        Self::new(label, unit, Scale::Linear, [0.0, top])
    }

    /// A logarithmic axis over whole decades, around values that are finite and above 0.
    pub fn decades(label: &str, unit: &str, [least, largest]: [f64; 2]) -> Self {
        let high = (largest.log10() - SLACK).ceil() as i32;
        let high = high.clamp(EXPONENTS[0] + 1, EXPONENTS[1]);
        let low = (exponent(least)).min(high - 1);
        Self::new(label, unit, Scale::Log, [power(low), power(high)])
    }

    /// A logarithmic axis that ends at 1, 2 or 5 times powers of ten, around values that are
    /// finite and above 0.
    pub fn around(label: &str, unit: &str, [least, largest]: [f64; 2]) -> Self {
        let largest = largest.max(least).clamp(1e-290, 1e290);
        let least = least.clamp(1e-290, largest);
        let high = round_up(largest * 1.05);
        // 1, 2 and 5 are their own inverses up to a power of ten.
        let low = 1.0 / round_up(1.05 / least);
        Self::new(label, unit, Scale::Log, [low.min(high / 2.0), high])
    }

    /// An axis over a given range.
    pub fn new(label: &str, unit: &str, scale: Scale, range: [f64; 2]) -> Self {
        Self {
            label: label.to_owned(),
            unit: unit.to_owned(),
            scale,
            range,
            step: None,
        }
    }

    /// Place of a value, from 0 to 1; values beyond an end are placed at that end.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let place = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log if value > low => {
                (value.log10() - low.log10()) / (high.log10() - low.log10())
            }
            Scale::Log => 0.0,
        };
        if place.is_nan() {
            return 0.0;
        }
        place.clamp(0.0, 1.0)
    }

    /// Whether a value is too small to be visible on the axis.
    pub(super) fn hides(&self, value: f64) -> bool {
        self.scale == Scale::Log && value <= self.range[0]
    }

    /// Title of the axis: its name, and the unit with the power of ten that the labels leave out.
    pub(super) fn title(&self) -> String {
        match self.measure().as_str() {
            "" => self.label.clone(),
            unit => format!("{} ({unit})", self.label),
        }
    }

    /// The unit, with the power of ten that the labels leave out.
    pub(super) fn measure(&self) -> String {
        let factor = match (self.scale, self.factor()) {
            (Scale::Log, _) | (_, 0) => String::new(),
            (_, exponent) => format!("10{} ", superscript(exponent)),
        };
        format!("{factor}{}", self.unit).trim().to_owned()
    }

    /// Ticks, of which about `most` have labels.
    pub(super) fn ticks(&self, most: usize) -> Vec<Tick> {
        let most = most.max(2);
        let ticks = match self.scale {
            Scale::Linear => self.linear_ticks(most),
            Scale::Log => self.log_ticks(most),
        };
        let tick = |(value, label): (f64, Option<String>)| Tick {
            place: self.place(value),
            label,
        };
        ticks.into_iter().map(tick).collect()
    }

    /// Exponent of the power of ten that the labels of a linear axis leave out.
    fn factor(&self) -> i32 {
        let exponent = exponent(self.range[0].abs().max(self.range[1].abs()));
        if WRITTEN_OUT.contains(&exponent) {
            0
        } else {
            exponent
        }
    }

    fn linear_ticks(&self, most: usize) -> Vec<(f64, Option<String>)> {
        let power = power(self.factor());
        let [low, high] = self.range.map(|value| value / power);
        let step = self
            .step
            .filter(|step| *step > 0.0)
            .map_or_else(|| round_up((high - low) / most as f64), |step| step / power);
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let first = (low / step - SLACK).ceil() as i64;
        let last = (high / step + SLACK).floor() as i64;
        (first..=last)
            .map(|i| {
                let value = i as f64 * step;
                let label = format!("{value:.decimals$}").replace('-', "−");
                (value * power, Some(label))
            })
            .collect()
    }

    fn log_ticks(&self, most: usize) -> Vec<(f64, Option<String>)> {
        let [low, high] = self.range;
        let inside = |value: f64| value >= low * (1.0 - SLACK) && value <= high * (1.0 + SLACK);
        let decades = exponent(low)..=exponent(high);
        let span = high.log10() - low.log10();
        // Within half a decade 1, 2 and 5 are too few labels, and the logarithm is nearly linear.
        if span < 0.5 && self.factor() == 0 {
            return self.linear_ticks(most);
        }
        let written = low >= 0.9e-3 && high <= 1.1e5;
        let finely = span * 3.0 <= most as f64;
        let stride = (span / most as f64).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for exponent in decades {
            for digit in 1..=9 {
                let value = f64::from(digit) * power(exponent);
                let labelled = match digit {
                    1 => exponent % stride == 0,
                    2 | 5 => finely,
                    _ => false,
                };
                let label = labelled.then(|| {
                    if written {
                        // By way of text, because 3 · 10⁻² has no exact f64.
                        let decimals = (-exponent).max(0) as usize;
                        format!("{value:.decimals$}")
                    } else {
                        power_label(digit, exponent)
                    }
                });
                if inside(value) && (label.is_some() || stride == 1) {
                    ticks.push((value, label));
                }
            }
        }
        ticks
    }
}

fn power_label(digit: i32, exponent: i32) -> String {
    let power = format!("10{}", superscript(exponent));
    if digit == 1 {
        power
    } else {
        format!("{digit}·{power}")
    }
}

/// ⌊log₁₀ |value|⌋, limited to [`EXPONENTS`].
fn exponent(value: f64) -> i32 {
    let exponent = (value.abs().max(f64::MIN_POSITIVE).log10() + SLACK).floor() as i32;
    exponent.clamp(EXPONENTS[0], EXPONENTS[1])
}

fn power(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `value`, which is above 0.
pub fn round_up(value: f64) -> f64 {
    let power = power(exponent(value));
    let digit = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|digit| digit * power >= value * (1.0 - SLACK));
    digit.unwrap_or(10.0) * power
}

/// An exponent in superscript, such as ⁻¹² for −12.
pub fn superscript(exponent: i32) -> String {
    let raised = |sign: char| match sign {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        // The other superscript digits are consecutive in Unicode.
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, most: usize) -> Vec<String> {
        let ticks = axis.ticks(most);
        ticks.into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn a_linear_axis_ends_at_a_round_value_and_has_round_labels() {
        let axis = Axis::from_zero("light", "cd", 0.0173);
        assert_eq!(axis.range[1], 0.02);
        assert_eq!(
            labels(&axis, 4),
            ["0.000", "0.005", "0.010", "0.015", "0.020"]
        );
        assert_eq!(axis.title(), "light (cd)");
    }

    #[test]
    fn labels_far_from_one_lack_a_power_of_ten_that_the_title_has() {
        let axis = Axis::from_zero("light", "cd", 3.1e-9);
        assert_eq!(labels(&axis, 4), ["0", "1", "2", "3", "4"]);
        assert_eq!(axis.title(), "light (10⁻⁹ cd)");
    }

    #[test]
    fn logarithmic_axes_label_decades_and_few_of_them_more_finely() {
        let wide = Axis::new("wavelength", "nm", Scale::Log, [50.0, 5e4]);
        assert_eq!(labels(&wide, 6), ["100", "1000", "10000"]);
        let deep = Axis::decades("light", "", [3e-17, 0.7]);
        assert_eq!(deep.range, [1e-17, 1.0]);
        assert_eq!(
            labels(&deep, 6),
            ["10⁻¹⁵", "10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]
        );
        let factor = Axis::new("D", "", Scale::Log, [0.05, 20.0]);
        let expected = ["0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10", "20"];
        assert_eq!(labels(&factor, 12), expected);
    }

    #[test]
    fn an_axis_around_values_has_labels_at_both_ends() {
        for (range, ends) in [
            ([1.1, 1.9], [1.0, 2.0]),
            ([3.0, 3.0], [2.0, 5.0]),
            ([0.04, 7.0], [0.02, 10.0]),
            ([0.9, 0.99], [0.5, 2.0]),
        ] {
            let axis = Axis::around("time", "s", range);
            let near = |i: usize| (axis.range[i] / ends[i] - 1.0).abs() < 1e-12;
            assert!(near(0) && near(1), "{range:?}: {:?}", axis.range);
            assert!(labels(&axis, 12).len() >= 2);
        }
        let narrow = Axis::around("time", "ms", [110.0, 180.0]);
        let expected = ["100", "120", "140", "160", "180", "200"];
        assert_eq!(labels(&narrow, 6), expected);
    }

    #[test]
    fn the_largest_and_the_smallest_numbers_have_axes() {
        for value in [
            f64::MAX,
            1e308,
            1e-290,
            1e-308,
            f64::MIN_POSITIVE,
            5e-324,
            0.0,
        ] {
            let mut axes = vec![Axis::from_zero("", "", value)];
            if value > 0.0 {
                axes.push(Axis::in_steps("", "", value));
                axes.push(Axis::decades("", "", [value * 1e-6, value]));
                axes.push(Axis::around("", "", [value * 0.5, value]));
            }
            for axis in axes {
                assert!(axis.range[0] < axis.range[1] && axis.range[1].is_finite());
                let place = axis.place(value);
                assert!((0.0..=1.0).contains(&place), "{value:e}: {axis:?} {place}");
                let labels = labels(&axis, 5);
                assert!((2..12).contains(&labels.len()), "{value:e}: {labels:?}");
                assert!(!labels.concat().contains("inf"), "{labels:?}");
            }
        }
    }
}
