//! A measured curve as read from a file, and the warnings about it.

use super::fault::{NOISE, TableError, TableWarning};
use super::heading::Heading;
use super::table::Table;
use crate::spectrum::{Beyond, MAX_ROWS, MAX_VALUE, Sampled};

/// Ratio to the sensor's window within which points without a stated unit are believed.
const NEAR: f64 = 2.0;

/// A measured curve, and facts about its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The curve; it is constant beyond its ends.
    pub curve: Sampled,
    names_unit: bool,
    warnings: Vec<TableWarning>,
}

/// The numbers of a row.
struct Row {
    line: usize,
    /// The first number as written.
    number: f64,
    nm: f64,
    value: f64,
}

impl Measured {
    /// Reads a [`Table`] whose first column is the wavelength in nm, or in the unit of the header,
    /// or a quantity that determines it; its second column is the value. Rows ascend or descend.
    ///
    /// # Errors
    /// The first fault.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        let table = Table::new(text);
        let heading = Heading::of(&table)?;
        let (mut rows, columns) = rows(&table, &heading)?;
        order(&mut rows)?;
        let mut warnings = Vec::new();
        if columns > 2 && !heading.are_deviations(columns) {
            let left_out = match heading.names.get(2..columns) {
                Some(names) => format!("`{}`", names.join("`, `")),
                None if columns == 3 => "column 3".to_owned(),
                None => format!("columns 3 to {columns}"),
            };
            warnings.push(TableWarning::Columns { left_out });
        }
        warnings.extend(lift(&mut rows)?);
        let unit = heading.unit.filter(|unit| !unit.is_nm());
        warnings.extend(unit.map(|unit| TableWarning::Converted { unit }));
        warnings.extend(heading.values.map(|name| TableWarning::Values { name }));
        Ok(Self {
            curve: Sampled {
                nm: rows.iter().map(|row| row.nm).collect(),
                values: rows.iter().map(|row| row.value).collect(),
                beyond: Beyond::Hold,
            },
            names_unit: heading.unit.is_some(),
            warnings,
        })
    }

    /// Warnings about the interpretation of the file, given a sensor's window in nm.
    pub fn warnings(&self, window: [f64; 2]) -> Vec<TableWarning> {
        let nm = self.curve.knots_nm();
        let points = [nm[0], nm[nm.len() - 1]];
        let far = points[1] * NEAR < window[0] || points[0] > window[1] * NEAR;
        let far = (far && !self.names_unit).then_some(TableWarning::Far { points, window });
        self.warnings.iter().cloned().chain(far).collect()
    }
}

/// All rows, with the largest number of columns.
fn rows(table: &Table<'_>, heading: &Heading) -> Result<(Vec<Row>, usize), TableError> {
    let mut rows = Vec::new();
    let mut columns = 0;
    for (line, fields) in table.rows() {
        if rows.len() == MAX_ROWS {
            return Err(TableError::TooMany);
        }
        let found = fields.len();
        let whole = fields
            .iter()
            .all(|field| !field.contains(|c: char| c.is_alphabetic()));
        if table.may_have_decimal_commas() && found > 2 && found > heading.names.len() && whole {
            return Err(TableError::DecimalCommas { line, found });
        }
        rows.push(row(table, heading, line, &fields)?);
        columns = columns.max(found);
    }
    if rows.is_empty() {
        return Err(TableError::NoRows);
    }
    Ok((rows, columns))
}

fn row(
    table: &Table<'_>,
    heading: &Heading,
    line: usize,
    fields: &[&str],
) -> Result<Row, TableError> {
    let number = |field: &str| {
        table.number(field).ok_or_else(|| TableError::Number {
            line,
            found: field.chars().take(40).collect(),
        })
    };
    // Some instruments write the unit into every row.
    let is_nm = heading.unit.is_none_or(|unit| unit.is_nm());
    let bare = fields[0].strip_suffix("nm").map(str::trim_end);
    let bare = bare.filter(|bare| is_nm && bare.ends_with(|c: char| c.is_ascii_digit()));
    let first = number(bare.unwrap_or(fields[0]))?;
    let Some(second) = fields.get(1) else {
        let found = fields.len();
        return Err(TableError::Columns { line, found });
    };
    let nm = heading.unit.map_or(first, |unit| unit.nm(first));
    if !(first > 0.0 && nm > 0.0 && first.is_finite() && nm.is_finite()) {
        return Err(TableError::Wavelength { line, found: first });
    }
    let value = number(second)?;
    if value.is_nan() || value.abs() > MAX_VALUE {
        return Err(TableError::Value { line, found: value });
    }
    Ok(Row {
        line,
        number: first,
        nm,
        value,
    })
}

/// Reverses descending rows.
fn order(rows: &mut [Row]) -> Result<(), TableError> {
    let descends = |rows: &[Row]| rows.first().map(|row| row.nm) > rows.last().map(|row| row.nm);
    let sign = if descends(rows) { -1.0 } else { 1.0 };
    let wrong = rows
        .windows(2)
        .find(|pair| sign * (pair[1].nm - pair[0].nm) <= 0.0);
    if let Some([before, row]) = wrong {
        return Err(TableError::Order {
            line: row.line,
            found: row.number,
            before: before.number,
        });
    }
    if sign < 0.0 {
        rows.reverse();
    }
    Ok(())
}

/// Sets negative noise to 0.
fn lift(rows: &mut [Row]) -> Result<Option<TableWarning>, TableError> {
    let greatest = rows.iter().map(|row| row.value).fold(0.0, f64::max);
    let noise = -NOISE * greatest;
    if let Some(row) = rows
        .iter()
        .filter(|row| row.value < noise)
        .min_by_key(|row| row.line)
    {
        return Err(TableError::Negative {
            line: row.line,
            found: row.value,
            greatest,
        });
    }
    let least = rows.iter().map(|row| row.value).fold(0.0, f64::min);
    let mut count = 0;
    for row in rows.iter_mut().filter(|row| row.value < 0.0) {
        row.value = 0.0;
        count += 1;
    }
    Ok((count > 0).then_some(TableWarning::Negative { count, least }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WINDOW: [f64; 2] = [360.0, 830.0];

    /// The curve and what is said of it.
    fn read(text: &str) -> (Sampled, Vec<TableWarning>) {
        let read = Measured::from_csv(text).unwrap_or_else(|e| panic!("{text:?}: {e}"));
        let warnings = read.warnings(WINDOW);
        (read.curve, warnings)
    }

    fn curve(points: &[(f64, f64)]) -> Sampled {
        Sampled::new(points, Beyond::Hold).unwrap()
    }

    fn told(text: &str) -> String {
        Measured::from_csv(text).unwrap_err().to_string()
    }

    #[test]
    fn every_common_way_to_write_two_columns_is_read() {
        let expected = curve(&[(400.0, 0.25), (500.0, 0.5), (600.5, 1e-3)]);
        for text in [
            "400,0.25\n500,0.5\n600.5,1e-3",
            "\u{feff}wavelength (nm), reflectance\r\n400, 0.25\r\n500 , 0.5\r\n600.5,1e-3\r\n",
            "# measured\n\nnm;R\n400;0.25 # first\n500;0.5\n600.5;0.001\n\n",
            "400\t0.25\n500\t0.5\n600.5\t0.001",
            "  400   0.25\n500 0.5\n600.5    1E-3\n",
            "600.5,1e-3\n500,0.5\n400,0.25\n",
            "wavelength,reflectance\nnm,1\n400,0.25\n500,0.5\n600.5,0.001\n",
            "Device,X-Rite\nDate,2020-01-01\nLux,500\n\nWavelength;Value\n400;0,25\n500;0,5\n600,5;0,001\n",
            "\"Wavelength, nm\",\"R\"\n\"400\",\"0.25\"\n\"500\",\"0.5\"\n\"600.5\",\"0.001\"\n",
            "400,0.25,,\n500,0.5,,\n600.5,0.001,,\n,,,\n",
            "nm,R\r400,0.25\r500,0.5\r600.5,0.001\r",
            "Model\tA\nLUX\t400\n400nm\t0.25\n500nm\t0.5\n600.5 nm\t0.001\n",
            "nm R sigma\n400 0.25 0.1\n500 0.5 0.1\n600.5 0.001 0.1\n",
            "# wavelength (nm), R\n400,0.25\n500,0.5\n600.5,0.001\n",
        ] {
            let (found, warnings) = read(text);
            let pairs = found.nm.iter().zip(&expected.nm);
            assert!(
                pairs.into_iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-15),
                "{text}"
            );
            assert_eq!(found.values, expected.values, "{text}");
            assert_eq!(warnings, [], "{text}");
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
            ("nm v\nnm v\n400 1\nnm v", "line 4", "nm"),
            ("400 1\n500 1\n450 1", "line 3", "sort"),
            ("400,0,25\n410,0,31\n", "line 1", "semicolons"),
            ("nm,v\n400,0,25\n410,1,00\n", "line 2", "semicolons"),
        ] {
            let message = told(text);
            assert!(
                message.contains(line) && message.contains(word),
                "{text:?}: {message}"
            );
        }
        assert_eq!(Measured::from_csv("nm,v\n"), Err(TableError::NoRows));
    }

    #[test]
    fn the_unit_in_the_header_is_understood_or_refused() {
        let at = |text: &str| read(text).0.at(500.0);
        for text in [
            "wavelength (um), R\n0.4,0\n0.6,1\n",
            "wavelength (um) R\n0.4 0\n0.6 1\n",
            "Wavelength nm Reflectance\n400 0\n600 1\n",
            "wavelength [Å];R\n4000;0\n6000;1\n",
            "wavelength,R\nmicrons,parts\n0.4,0\n0.6,1\n",
            "# wavelength (um), R\n0.4,0\n0.6,1\n",
        ] {
            assert!((at(text) - 0.5).abs() < 1e-12, "{text}");
        }
        let (_, warnings) = read("wavelength (um), R\n0.4,0\n0.6,1\n");
        assert_eq!(
            warnings[0].to_string(),
            "its first column is in µm, and is converted to nm; its values are left as they are, which is right for reflectances and the like: turn a density per µm into one per nm first"
        );
        for (text, word) in [
            ("wavelength (furlongs),R\n400,1\n", "`furlongs`"),
            ("wavelength / lines,R\n400,1\n", "`lines`"),
            ("frequency,R\n400,1\n", "`frequency`"),
            ("R,wavelength (nm)\n0.4,400\n", "column 2"),
        ] {
            let message = told(text);
            assert!(
                message.starts_with("line 1: ") && message.contains(word),
                "{message}"
            );
        }
        assert_eq!(at("wavelength (air),R\n400,1\n"), 1.0);
    }

    /// 20000 cm⁻¹ are 500 nm, 2 eV are 619.921 nm.
    #[test]
    fn wavenumbers_and_energies_are_turned_around_with_a_warning() {
        let (found, warnings) = read("wavenumber (cm-1),R\n12500,0.1\n20000,0.5\n25000,0.9\n");
        assert_eq!(found, curve(&[(400.0, 0.9), (500.0, 0.5), (800.0, 0.1)]));
        assert!(matches!(warnings[..], [TableWarning::Converted { .. }]));
        let said = warnings[0].to_string();
        assert!(said.contains("per cm⁻¹"), "{said}");
        let (found, _) = read("E (eV);R\n2;0,5\n3;0,25\n");
        assert!((found.nm[1] - 619.920_992).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn points_in_no_stated_unit_far_from_the_window_are_warned_of() {
        let said = |text: &str| -> String {
            let warnings = read(text).1.into_iter();
            warnings.map(|w| w.to_string()).collect()
        };
        for text in ["0.4,1\n0.7,1\n", "wavelength,R\n4000,1\n7000,1\n"] {
            assert!(said(text).contains("names no unit"), "{text}");
        }
        for text in [
            "nm,R\n0.4,1\n0.7,1\n",
            "400,1\n",
            "800,1\n2500,1\n",
            "10,1\n9000,1\n",
        ] {
            assert_eq!(said(text), "", "{text}");
        }
        let radio = Measured::from_csv("2e8,1\n3e8,1\n").unwrap();
        assert_eq!(radio.warnings([1e8, 1e9]), []);
    }

    #[test]
    fn noise_below_zero_is_lifted_and_more_is_refused() {
        let (found, warnings) = read("400,-0.02\n500,1\n600,-0.05\n");
        assert_eq!(found, curve(&[(400.0, 0.0), (500.0, 1.0), (600.0, 0.0)]));
        let expected = TableWarning::Negative {
            count: 2,
            least: -0.05,
        };
        assert_eq!(warnings, [expected]);
        let message = told("400,1\n500,-0.06\n");
        assert!(
            message.starts_with("line 2: the value is -0.06"),
            "{message}"
        );
    }

    #[test]
    fn columns_that_are_not_read_are_named() {
        let said = |text: &str| {
            read(text)
                .1
                .iter()
                .map(ToString::to_string)
                .collect::<String>()
        };
        assert!(said("nm,red,green,blue\n400,1,2,3\n").contains("`green`, `blue`"));
        assert!(said("400 0.5 0.1\n").contains("column 3"));
        assert!(said(&format!("400{}\n", " 0.5".repeat(29))).contains("columns 3 to 30 not"));
    }

    #[test]
    fn values_in_another_unit_are_warned_of() {
        for name in ["Reflectance (%)", "radiance (W/m2/sr/um)"] {
            let (_, warnings) = read(&format!("wavelength (nm),{name}\n400,50\n"));
            let name = name.to_owned();
            assert_eq!(warnings, [TableWarning::Values { name }]);
        }
        assert_eq!(
            read("wavelength (nm),radiance (W/m2/sr/nm)\n400,50\n").1,
            []
        );
    }

    #[test]
    fn too_many_rows_are_refused() {
        use std::fmt::Write as _;
        let mut text = String::new();
        for nm in 1..=MAX_ROWS + 1 {
            writeln!(text, "{nm} 1").unwrap();
        }
        assert!(told(&text).contains("1000000"));
    }

    proptest! {
        #[test]
        fn no_text_makes_the_reader_panic(text in "[0-9a-zµÅλ#,;\t\n\r \"'()/.+-]{0,80}") {
            let _ = Measured::from_csv(&text).map(|read| read.warnings(WINDOW));
        }

        #[test]
        fn a_written_table_reads_back_the_same(
            values in prop::collection::vec(prop_oneof![0.0..1.0, 0.0..1e300, Just(5e-324)], 1..30),
        ) {
            let points: Vec<_> =
                values.iter().enumerate().map(|(i, &v)| (300.1 + i as f64, v)).collect();
            let text: String = points.iter().map(|(nm, v)| format!("{nm:?};{v:?}\n")).collect();
            prop_assert_eq!(read(&text).0, curve(&points));
        }
    }
}
