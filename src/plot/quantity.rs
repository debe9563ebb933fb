//! Quantities as text: three digits, a unit, a true minus sign.

use super::superscript;

/// Text for a value that does not exist or was not measured.
pub const NOTHING: &str = "–";

/// Three digits without trailing zeros, with a power of ten if far from 1: 0.012, 3.2·10⁻⁵.
pub fn number(value: f64) -> String {
    if value.is_nan() {
        return "no number".to_owned();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if size.is_infinite() {
        return format!("{sign}∞");
    }
    // Rounded to three digits first, so that 999.9 becomes 1000 and not 1·10³ or 999.9.
    let rounded = format!("{size:.2e}");
    let (digits, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-3..=4).contains(&exponent) {
        let digits = without_zeros(digits);
        return format!("{sign}{digits}·10{}", superscript(exponent));
    }
    let decimals = usize::try_from(2 - exponent).unwrap_or(0);
    // From the rounded digits, so that numbers of four and five digits end in zeros.
    let rounded: f64 = rounded.parse().unwrap_or(size);
    let text = format!("{rounded:.decimals$}");
    format!("{sign}{}", without_zeros(&text))
}

/// A time in seconds, such as 4.1 ms.
pub fn time(seconds: f64) -> String {
    let (unit, name) = unit_of_time(seconds);
    with_unit(seconds / unit, &format!(" {name}"))
}

/// The unit for a time, in seconds, and its name.
pub fn unit_of_time(seconds: f64) -> (f64, &'static str) {
    match seconds.abs() {
        s if s >= 7200.0 => (3600.0, "h"),
        s if s >= 120.0 => (60.0, "min"),
        s if s >= 1.0 || s == 0.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e-3, "ms"),
        s if s.is_nan() => (1.0, "s"),
        _ => (1e-6, "µs"),
    }
}

/// A share, such as 12 %.
pub fn percent(part: f64) -> String {
    with_unit(part * 100.0, " %")
}

/// A ratio, such as 1.7×.
pub fn times(ratio: f64) -> String {
    with_unit(ratio, "×")
}

/// Memory, such as 120 MiB.
pub fn mebibytes(mib: f64) -> String {
    with_unit(mib, " MiB")
}

/// A file size, in multiples of 1000 bytes.
pub fn bytes(count: u64) -> String {
    let count = count as f64;
    match count {
        count if count >= 1e9 => format!("{} GB", number(count / 1e9)),
        count if count >= 1e6 => format!("{} MB", number(count / 1e6)),
        count if count >= 1e3 => format!("{} kB", number(count / 1e3)),
        count => format!("{count} B"),
    }
}

/// A number with its unit; no unit if it is not a number.
fn with_unit(value: f64, unit: &str) -> String {
    let unit = if value.is_nan() { "" } else { unit };
    number(value) + unit
}

/// Digits without trailing zeros, and without a trailing point.
pub fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        digits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_no_needless_ones() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (4.1, "4.1"),
            (1.704, "1.7"),
            (0.0012345, "0.00123"),
            (3.2e-5, "3.2·10⁻⁵"),
            (999.9, "1000"),
            (12345.0, "12300"),
            (99960.0, "1·10⁵"),
            (123.4, "123"),
            (-0.25, "−0.25"),
            (1e-300, "1·10⁻³⁰⁰"),
            (f64::MAX, "1.8·10³⁰⁸"),
            (f64::INFINITY, "∞"),
            (f64::NEG_INFINITY, "−∞"),
            (f64::NAN, "no number"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn quantities_have_the_unit_that_makes_them_short() {
        for (seconds, text) in [
            (0.0, "0 s"),
            (2.5e-7, "0.25 µs"),
            (0.0041, "4.1 ms"),
            (1.0, "1 s"),
            (90.0, "90 s"),
            (600.0, "10 min"),
            (9000.0, "2.5 h"),
        ] {
            assert_eq!(time(seconds), text);
        }
        assert_eq!((percent(0.12), times(1.7)), ("12 %".into(), "1.7×".into()));
        let sizes = [999, 12_345, 4_000_000, 7_000_000_000].map(bytes);
        assert_eq!(sizes, ["999 B", "12.3 kB", "4 MB", "7 GB"]);
    }
}
