//! The header of a measured table: units and names of its columns.

use super::fault::TableError;
use super::table::{Parted, Table};
use super::unit::Unit;

/// Number of header lines that are read, starting with the one nearest to the rows.
const MOST_LINES: usize = 2;

/// Names of columns of wavelengths, or of quantities that determine them.
const ABSCISSAE: [&str; 7] = [
    "wave", "lambda", "λ", "wellen", "freq", "energy", "longueur",
];

/// Words in brackets after a wavelength that are not units.
const NO_UNITS: [&str; 8] = [
    "air",
    "in air",
    "vacuum",
    "in vacuum",
    "vac",
    "λ",
    "lambda",
    "measured",
];

/// Words, and beginnings of words, in the names of columns of uncertainties.
const DEVIATIONS: [&str; 4] = ["sd", "err", "unc", "dev"];
const DEVIATIONS_BEGIN: [&str; 6] = ["sigma", "σ", "std", "uncert", "deviat", "error"];

/// Length of a name, in bytes, from which on no more words are joined to it.
const LONGEST_NAME: usize = 200;

/// Beginnings of comments that are not units there: list items, illuminants, instruments.
const NO_UNITS_OF_COMMENTS: [&str; 3] = ["a", "m", "meter"];

/// The columns of a table.
#[derive(Debug, Default)]
pub(super) struct Heading {
    /// Unit of the first column, if stated.
    pub(super) unit: Option<Unit>,
    /// Names of the columns, if stated.
    pub(super) names: Vec<String>,
    /// Meaning of the second column's values, if they are neither fractions of 1 nor per nm.
    pub(super) values: Option<String>,
}

/// A line that names columns.
struct Names {
    line: usize,
    names: Vec<String>,
    is_comment: bool,
}

impl Heading {
    /// Reads the lines before the rows.
    ///
    /// # Errors
    /// An unknown unit, and a wavelength that is not the first column.
    pub(super) fn of(table: &Table<'_>) -> Result<Self, TableError> {
        let lines = lines(table);
        let all = || lines.iter();
        let unit = all().find_map(|line| Unit::of(&line.names[0]));
        let mut headers = all().filter(|line| !line.is_comment && line.names.len() > 1);
        if unit.is_none()
            && let Some(nearest) = headers.next()
        {
            check(nearest)?;
        }
        let second = all().filter_map(|line| line.names.get(1));
        let strange = |name: &&String| name.contains('%') || Unit::divides(name);
        let values = second.into_iter().find(strange).cloned();
        let names = lines.iter().max_by_key(|line| line.names.len());
        Ok(Self {
            unit,
            names: names.map(|line| line.names.clone()).unwrap_or_default(),
            values,
        })
    }

    /// Whether all columns after the second are named as uncertainties.
    pub(super) fn are_deviations(&self, columns: usize) -> bool {
        let names = self.names.get(2..columns);
        names.is_some_and(|names| names.iter().all(|name| is_deviation(name)))
    }
}

/// The lines that name columns, the nearest to the rows first, comments last.
fn lines(table: &Table<'_>) -> Vec<Names> {
    let header = table.header();
    let named = |is_comment: bool| {
        let lines = header
            .iter()
            .rev()
            .filter(move |l| l.is_comment == is_comment);
        let lines = lines.filter_map(|line| {
            let names = match table.names(line.text) {
                (words, Parted::BySpace) => merged(&words),
                (names, Parted::BySign) => names.into_iter().map(str::to_owned).collect(),
            };
            let first = names.first()?;
            let is_value = names
                .get(1)
                .is_some_and(|name| table.number(name).is_some());
            // A comment may be about anything, so more is required of it.
            let bare = first.trim_end_matches(|c: char| !c.is_alphanumeric());
            let is_word = NO_UNITS_OF_COMMENTS.contains(&bare.to_lowercase().as_str());
            let alone = !is_comment || !first.contains(' ') && !is_word;
            let names_column = names_any(first, &ABSCISSAE) || names.len() > 1 && alone;
            (names_column && !is_value).then_some(Names {
                line: line.line,
                names,
                is_comment,
            })
        });
        lines.take(MOST_LINES).collect::<Vec<_>>()
    };
    let mut all = named(false);
    all.extend(named(true));
    all
}

/// Words joined to names: a unit in brackets belongs to the word before.
fn merged(words: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    // Number of brackets open in the last name.
    let mut depth = 0;
    for word in words {
        let belongs = word.starts_with(['(', '[', '/']) || *word == "in";
        let is_unit = |name: &str| {
            let is = *word != "A" && Unit::of(word).is_some() && !names_any(word, &ABSCISSAE);
            is && Unit::of(name).is_none()
        };
        let is_part = |name: &str| {
            let after = name.ends_with(" in") || name.ends_with('/');
            name.len() < LONGEST_NAME && (belongs || after || depth > 0 || is_unit(name))
        };
        match names.last_mut() {
            Some(name) if is_part(name) => {
                name.push(' ');
                name.push_str(word);
            }
            _ => {
                names.push((*word).to_owned());
                depth = 0;
            }
        }
        let count = |signs: [char; 2]| word.matches(signs).count() as i64;
        depth += count(['(', '[']) - count([')', ']']);
    }
    names
}

/// Refuses a header whose unit is unknown, because ignoring it could shift the spectrum.
fn check(line: &Names) -> Result<(), TableError> {
    let first = &line.names[0];
    let strange = |found: &str| TableError::Unit {
        line: line.line,
        found: found.chars().take(40).collect(),
    };
    if let Some(unit) = bracketed(first) {
        return Err(strange(unit));
    }
    if names_any(first, &["freq", "energy"]) {
        return Err(strange(first));
    }
    let begins = |name: &String| {
        let lower = name.to_lowercase();
        ABSCISSAE.iter().any(|word| lower.starts_with(word))
    };
    let later = line.names.iter().skip(1).position(begins);
    match later {
        Some(index) if !names_any(first, &ABSCISSAE) => Err(TableError::Swapped {
            line: line.line,
            column: index + 2,
            name: line.names[index + 1].chars().take(40).collect(),
        }),
        _ => Ok(()),
    }
}

/// The part in brackets, or behind a slash, that looks like a unit.
fn bracketed(name: &str) -> Option<&str> {
    let open = name.find(['(', '[', '/'])?;
    let inside = name[open + 1..].split([')', ']']).next()?.trim();
    let letters = inside.chars().any(char::is_alphabetic);
    let known = NO_UNITS.contains(&inside.to_lowercase().as_str());
    (letters && !known).then_some(inside)
}

/// Whether the name of a column is that of an uncertainty.
fn is_deviation(name: &str) -> bool {
    let lower = name.to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphabetic());
    let is = |word: &str| {
        DEVIATIONS.contains(&word) || DEVIATIONS_BEGIN.iter().any(|begin| word.starts_with(begin))
    };
    lower.contains('±') || words.any(is)
}

fn names_any(name: &str, words: &[&str]) -> bool {
    let lower = name.to_lowercase();
    words.iter().any(|word| lower.contains(word))
}

#[cfg(test)]
mod tests {
    use crate::spectrum::Beyond;
    use crate::spectrum::Sampled;
    use crate::spectrum::csv::{Measured, TableWarning};

    fn read(text: &str) -> Measured {
        Measured::from_csv(text).unwrap_or_else(|e| panic!("{text:?}: {e}"))
    }

    #[test]
    fn columns_of_uncertainties_are_known_by_whole_words() {
        for name in [
            "std. dev.",
            "SD",
            "R_err",
            "±",
            "stddev",
            "2σ",
            "Uncertainty (%)",
            "sigmaR",
            "errors",
        ] {
            let read = read(&format!("nm,R,{name}\n400,1,0\n"));
            assert_eq!(read.warnings([360.0, 830.0]), [], "{name}");
        }
        for name in ["uncoated", "device", "function", "USD", "inverse", "terra"] {
            let read = read(&format!("nm,R,{name}\n400,1,0\n"));
            let left_out = format!("`{name}`");
            assert_eq!(
                read.warnings([360.0, 830.0]),
                [TableWarning::Columns { left_out }],
                "{name}"
            );
        }
    }

    #[test]
    fn the_first_word_of_a_comment_is_no_angstrom() {
        let points = [(400.0, 0.25), (500.0, 0.5)];
        let expected = Sampled::new(&points, Beyond::Hold).unwrap();
        for comment in [
            "# A,CIE standard illuminant",
            "# A CIE standard illuminant",
            "# A: tungsten, 2856 K",
            "# a) first, b) second",
            "# Meter: X-Rite i1",
        ] {
            let read = read(&format!("{comment}\n400,0.25\n500,0.5\n"));
            assert_eq!(read.curve, expected, "{comment}");
            assert_eq!(read.warnings([360.0, 830.0]), [], "{comment}");
        }
        for header in ["A,R", "# [A],R", "# Å,R"] {
            let read = read(&format!("{header}\n4000,0.25\n5000,0.5\n"));
            assert_eq!(read.curve, expected, "{header}");
        }
    }

    #[test]
    fn a_bracket_left_open_in_a_long_line_takes_no_time() {
        for words in [" a", " in nm", " / 10 nm"] {
            let text = format!("({}\n400 0.25\n500 0.5\n", words.repeat(100_000));
            let begun = std::time::Instant::now();
            let _ = Measured::from_csv(&text);
            assert!(
                begun.elapsed().as_secs_f64() < 5.0,
                "{words}: {:?}",
                begun.elapsed()
            );
        }
    }
}
