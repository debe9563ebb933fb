//! A measured curve: straight lines through (nm, value) pairs, from code or from a CSV file.

use super::{Beyond, SpectrumError};

/// Most rows that a file may have.
pub const MAX_ROWS: usize = 1_000_000;

/// Greatest value of a point: sums and differences of a few stay finite.
pub const MAX_VALUE: f64 = 1e300;

/// A piecewise linear curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    nm: Vec<f64>,
    values: Vec<f64>,
    beyond: Beyond,
}

impl Sampled {
    /// The polyline through (nm, value) `points`, strictly ascending in nm, values from 0 to
    /// [`MAX_VALUE`].
    pub fn new(points: &[(f64, f64)], beyond: Beyond) -> Result<Self, SpectrumError> {
        check_points(points)?;
        let (nm, values) = points.iter().copied().unzip();
        Ok(Self { nm, values, beyond })
    }

    /// Reads a table of two columns, wavelength in nm and value; holds beyond its ends.
    ///
    /// Its [`rows`] are at most [`MAX_ROWS`]. Errors carry the line's number, from 1.
    pub fn from_csv(text: &str) -> Result<Self, SpectrumError> {
        let mut points = Vec::new();
        for (line, fields) in rows(text) {
            let at_line = |error| SpectrumError::at_line(line, error);
            let point = parse_row(&fields).map_err(at_line)?;
            check_next(points.len(), points.last().copied(), point).map_err(at_line)?;
            points.push(point);
        }
        Self::new(&points, Beyond::Hold)
    }

    /// The same curve with another course beyond its ends.
    #[must_use]
    pub fn with_beyond(self, beyond: Beyond) -> Self {
        Self { beyond, ..self }
    }

    /// The curve at a wavelength.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let last = self.nm.len() - 1;
        let inside = (self.nm[0]..=self.nm[last]).contains(&lambda_nm);
        if !inside && self.beyond == Beyond::Zero {
            return 0.0;
        }
        let right = self.nm.partition_point(|&nm| nm <= lambda_nm);
        if right == 0 || right > last {
            return self.values[right.min(last)];
        }
        let (from, to) = (self.nm[right - 1], self.nm[right]);
        let (low, high) = (self.values[right - 1], self.values[right]);
        (low + (high - low) * ((lambda_nm - from) / (to - from))).max(0.0)
    }

    /// The points' wavelengths, nm.
    pub fn knots_nm(&self) -> &[f64] {
        &self.nm
    }

    /// The curve's greatest value.
    pub fn peak(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }
}

/// The rows of a table of numbers: the line's number, from 1, and its fields.
///
/// Columns are parted by comma, semicolon, tab or spaces; the decimal sign is the point. `#`
/// begins a comment. The first row may be a header: one whose first field does not begin like a
/// number.
pub fn rows(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut header_allowed = true;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let content = line.split('#').next().unwrap_or_default().trim();
        if content.is_empty() || (std::mem::take(&mut header_allowed) && is_header(content)) {
            return None;
        }
        Some((index + 1, fields(content).collect()))
    })
}

/// Whether a row begins unlike a number.
fn is_header(content: &str) -> bool {
    let word = fields(content).next().unwrap_or_default();
    !word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        && word.parse::<f64>().is_err()
}

/// The fields of a row: parted by one comma or semicolon, or by white space alone.
fn fields(content: &str) -> impl Iterator<Item = &str> {
    let sign = [';', ',', '\t']
        .into_iter()
        .find(|&sign| content.contains(sign));
    let parts: Vec<&str> = match sign {
        Some(sign) => content.split(sign).map(str::trim).collect(),
        None => content.split_whitespace().collect(),
    };
    parts.into_iter()
}

fn parse_row(fields: &[&str]) -> Result<(f64, f64), SpectrumError> {
    let numbers: Vec<f64> = fields
        .iter()
        .map(|field| {
            field.parse().map_err(|_| SpectrumError::Number {
                found: field.chars().take(40).collect(),
            })
        })
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [nm, value] => Ok((nm, value)),
        _ => Err(SpectrumError::Columns {
            found: numbers.len(),
        }),
    }
}

/// That points can carry a curve: some, not too many, ascending, each in range.
pub(super) fn check_points(points: &[(f64, f64)]) -> Result<(), SpectrumError> {
    if points.is_empty() {
        return Err(SpectrumError::NoPoints);
    }
    let mut previous = None;
    for (index, &point) in points.iter().enumerate() {
        check_next(index, previous, point)?;
        previous = Some(point);
    }
    Ok(())
}

/// That a point may follow `previous` as number `index`, from 0.
fn check_next(
    index: usize,
    previous: Option<(f64, f64)>,
    (nm, value): (f64, f64),
) -> Result<(), SpectrumError> {
    let point = index + 1;
    if index >= MAX_ROWS {
        return Err(SpectrumError::TooMany);
    }
    if !nm.is_finite() || nm <= 0.0 {
        return Err(SpectrumError::Wavelength { point, found: nm });
    }
    if !(0.0..=MAX_VALUE).contains(&value) {
        return Err(SpectrumError::Value {
            point,
            nm,
            found: value,
        });
    }
    match previous {
        Some((before, _)) if nm <= before => Err(SpectrumError::Order {
            point,
            found: nm,
            before,
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_common_way_to_write_two_columns_is_read() {
        let expected =
            Sampled::new(&[(400.0, 0.25), (500.0, 0.5), (600.5, 1e-3)], Beyond::Hold).unwrap();
        for text in [
            "400,0.25\n500,0.5\n600.5,1e-3",
            "\u{feff}wavelength (nm), reflectance\r\n400, 0.25\r\n500 , 0.5\r\n600.5,1e-3\r\n",
            "# measured\n\nnm;R\n400;0.25 # first\n500;0.5\n600.5;0.001\n\n",
            "400\t0.25\n500\t0.5\n600.5\t0.001",
            "  400   0.25\n500 0.5\n600.5    1E-3\n",
        ] {
            assert_eq!(Sampled::from_csv(text).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn a_broken_row_is_named_by_its_line() {
        for (text, line, word) in [
            ("nm,v\n400,0.5\n400,0.6", "line 3", "400"),
            ("400,0.5\n500,NaN", "line 2", "NaN"),
            ("400,inf", "line 1", "inf"),
            ("inf,1", "line 1", "inf"),
            ("# c\n0,0.5", "line 2", "greater than 0"),
            ("400,-1", "line 1", "-1"),
            ("400,1\n410", "line 2", "two columns"),
            ("400,1,2", "line 1", "two columns"),
            ("4OO 1", "line 1", "4OO"),
            ("nm v\nnm v", "line 2", "nm"),
        ] {
            let message = Sampled::from_csv(text).unwrap_err().to_string();
            assert!(
                message.contains(line) && message.contains(word),
                "{text:?}: {message}"
            );
        }
        assert_eq!(
            Sampled::from_csv("nm,v\n").unwrap_err(),
            SpectrumError::NoPoints
        );
    }

    #[test]
    fn too_many_rows_are_refused() {
        use std::fmt::Write as _;
        let mut text = String::new();
        for nm in 1..=MAX_ROWS + 1 {
            writeln!(text, "{nm} 1").unwrap();
        }
        assert!(
            Sampled::from_csv(&text)
                .unwrap_err()
                .to_string()
                .contains("1000000")
        );
    }

    #[test]
    fn between_points_it_is_linear_and_beyond_them_constant_or_zero() {
        let curve = Sampled::new(&[(400.0, 1.0), (500.0, 3.0)], Beyond::Hold).unwrap();
        let read = |curve: &Sampled| [1e-300, 400.0, 425.0, 500.0, 1e300].map(|nm| curve.at(nm));
        assert_eq!(read(&curve), [1.0, 1.0, 1.5, 3.0, 3.0]);
        assert_eq!(
            read(&curve.with_beyond(Beyond::Zero)),
            [0.0, 1.0, 1.5, 3.0, 0.0]
        );
    }

    proptest! {
        #[test]
        fn no_text_makes_the_reader_panic(text in "[0-9a-z#,;\t\n\r .+-]{0,80}") {
            let _ = Sampled::from_csv(&text);
        }

        #[test]
        fn a_written_table_reads_back_the_same(
            values in prop::collection::vec(prop_oneof![0.0..1.0, 0.0..1e300, Just(5e-324)], 1..30),
        ) {
            let points: Vec<_> =
                values.iter().enumerate().map(|(i, &v)| (300.1 + i as f64, v)).collect();
            let text: String = points.iter().map(|(nm, v)| format!("{nm:?};{v:?}\n")).collect();
            prop_assert_eq!(Sampled::from_csv(&text), Sampled::new(&points, Beyond::Hold));
        }
    }
}
