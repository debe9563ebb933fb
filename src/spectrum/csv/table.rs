//! Tables of numbers in text, as programs and instruments write them.
//!
//! Lines end in LF, CR LF or CR. `#` begins a comment. The lines before the first that begins like
//! a number are the header. Columns are separated by semicolon, comma, tab or spaces, whichever
//! makes numbers of the first row; fields may be quoted. The decimal sign is the point or, if the
//! rows have none, a comma that does not separate columns.

/// Separators of columns; None is any white space.
const SIGNS: [Option<char>; 4] = [Some(';'), Some(','), Some('\t'), None];

/// A table in a text.
#[derive(Debug)]
pub struct Table<'a> {
    text: &'a str,
    sign: Option<char>,
    has_points: bool,
    /// Line of the first row, from 1.
    first: usize,
}

/// A line before the rows.
#[derive(Debug)]
pub(super) struct HeaderLine<'a> {
    /// Line number, from 1.
    pub(super) line: usize,
    pub(super) text: &'a str,
    pub(super) is_comment: bool,
}

/// The separator of the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Parted {
    BySign,
    BySpace,
}

impl<'a> Table<'a> {
    /// A table, with its separator and decimal sign determined from the text.
    pub fn new(text: &'a str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let begins = |&(_, line): &(usize, &str)| begins_like_a_number(content(line));
        let first = lines(text).find(begins);
        let (first, row) = first.map_or((usize::MAX, ""), |(number, line)| (number, content(line)));
        let rows = lines(text).skip(first.saturating_sub(1));
        let has_points = rows
            .into_iter()
            .any(|(_, line)| content(line).contains('.'));
        let mut table = Self {
            text,
            sign: None,
            has_points,
            first,
        };
        let numbers = |sign: &Option<char>| {
            let fields = fields(row, *sign);
            let both = fields.get(..2);
            both.is_some_and(|both| both.iter().all(|field| table.number(field).is_some()))
        };
        let present = |sign: &Option<char>| sign.is_some_and(|sign| row.contains(sign));
        let found = SIGNS.into_iter().find(numbers);
        table.sign = found.unwrap_or_else(|| SIGNS.into_iter().find(present).flatten());
        table
    }

    /// The rows, each with its line number, from 1, and its fields. Empty fields at the end are
    /// left out.
    pub fn rows(&self) -> impl Iterator<Item = (usize, Vec<&'a str>)> {
        let sign = self.sign;
        let rows = lines(self.text).skip(self.first.saturating_sub(1));
        let rows = rows.map(move |(number, line)| (number, fields(content(line), sign)));
        rows.filter(|(_, fields)| !fields.is_empty())
    }

    /// The number in a field.
    pub fn number(&self, field: &str) -> Option<f64> {
        if !self.has_points && field.matches(',').count() == 1 {
            return field.replace(',', ".").parse().ok();
        }
        field.parse().ok()
    }

    /// Whether commas separate columns and no number has a decimal sign.
    pub(super) fn may_have_decimal_commas(&self) -> bool {
        self.sign == Some(',') && !self.has_points
    }

    /// The lines before the rows; comments without their sign.
    pub(super) fn header(&self) -> Vec<HeaderLine<'a>> {
        let before = lines(self.text).take(self.first.saturating_sub(1));
        let line = |(line, text): (usize, &'a str)| {
            let comment = text.trim_start().strip_prefix('#');
            HeaderLine {
                line,
                text: comment
                    .unwrap_or(content(text))
                    .trim_matches(['#', ' ', '\t']),
                is_comment: comment.is_some(),
            }
        };
        before
            .map(line)
            .filter(|line| !line.text.is_empty())
            .collect()
    }

    /// The fields of a header line, which may have another separator than the rows.
    pub(super) fn names(&self, line: &'a str) -> (Vec<&'a str>, Parted) {
        let mut signs = [self.sign].into_iter().chain(SIGNS).flatten();
        let sign = signs.find(|sign| line.contains(*sign));
        let parted = sign.map_or(Parted::BySpace, |_| Parted::BySign);
        (fields(line, sign), parted)
    }
}

/// Lines with their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let by_lf = text.split('\n');
    let lines = by_lf.flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
    lines.enumerate().map(|(index, line)| (index + 1, line))
}

/// A line without its comment.
fn content(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// Whether a row begins like a number.
fn begins_like_a_number(content: &str) -> bool {
    let content = content.trim_start_matches(QUOTES);
    let digits = content.trim_start_matches(['+', '-', '.']);
    let word = content.split([';', ',', '\t', ' ', '"']).next();
    digits.starts_with(|c: char| c.is_ascii_digit())
        || word.is_some_and(|word| word.parse::<f64>().is_ok())
}

const QUOTES: [char; 3] = ['"', '\'', ' '];

/// The fields of a row, without quotes, separated by one sign or by white space. A sign within
/// double quotes does not separate.
fn fields(content: &str, sign: Option<char>) -> Vec<&str> {
    let mut quoted = false;
    let parts = move |c: char| {
        quoted ^= c == '"';
        !quoted && sign.map_or(c.is_whitespace(), |sign| c == sign)
    };
    let fields = content.split(parts);
    let fields = fields.map(|field| field.trim_matches(|c| QUOTES.contains(&c) || c == '\t'));
    let mut fields: Vec<&str> = match sign {
        Some(_) => fields.collect(),
        None => fields.filter(|field| !field.is_empty()).collect(),
    };
    while fields.last().is_some_and(|field| field.is_empty()) {
        fields.pop();
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<Vec<f64>> {
        let table = Table::new(text);
        let number = |field: &str| table.number(field).unwrap_or(f64::NAN);
        let rows = table.rows();
        rows.map(|(_, fields)| fields.into_iter().map(number).collect())
            .collect()
    }

    #[test]
    fn columns_are_parted_by_what_makes_numbers_of_the_first_row() {
        let expected = vec![vec![400.0, 0.25], vec![500.5, 1.5]];
        for text in [
            "400,0.25\n500.5,1.5",
            "400;0,25\n500,5;1,5",
            "400\t0,25\n500,5\t1,5",
            "400 0,25\n500,5   1,5",
            "400,\t0.25\n500.5,\t1.5",
            "\"400\",\"0.25\"\n\"500.5\",\"1.5\"",
            "\"400\",\"0,25\"\n\"500,5\",\"1,5\"",
            "400\t\t0.25\n500.5\t\t1.5",
            "400;0.25;;\n500.5;1.5;;\n;;;\n",
            "400,0.25\r500.5,1.5\r",
            "\u{feff}\"nm\",\"a, b\"\r\n400,0.25\r\n500.5,1.5\r\n",
        ] {
            assert_eq!(read(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_comma_beside_points_is_no_decimal_sign() {
        assert!(read("400.5;1,234\n")[0][1].is_nan());
    }

    #[test]
    fn lines_are_counted_however_they_end() {
        for text in [
            "nm,v\r\r400,1\r",
            "nm,v\n\n400,1\n",
            "nm,v\r\n\r\n400,1\r\n",
        ] {
            let table = Table::new(text);
            assert_eq!(table.rows().next(), Some((3, vec!["400", "1"])), "{text:?}");
        }
    }
}
