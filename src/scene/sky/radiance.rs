//! Skies in Radiance files: their header, exposure, colors and orientation.
//!
//! A file is any `#?` line, header lines up to an empty one, a line with the resolution, and scan
//! lines of shared exponents. Values are divided by the product of all EXPOSURE lines, and of all
//! COLORCORR lines, so that they are the incoming light. Colors are Rec. 709 unless PRIMARIES
//! states otherwise, as all programs except Radiance itself write them; XYZE is CIE XYZ. Source:
//! Ward, Radiance File Formats (radsite.lbl.gov, filefmts.pdf), Picture File Format.

use super::file::{Pixels, SkyImageError, check_size};
use super::primaries::Primaries;

/// Length of the longest header line, bytes.
const LONGEST_LINE: usize = 1 << 16;

/// Lengths of scan lines that may have runs for each component, pixels.
const BY_COMPONENT: std::ops::Range<usize> = 8..32768;

/// Content of a header.
struct Header {
    /// Divisor of the values, for each component.
    divisor: [f64; 3],
    primaries: Option<Primaries>,
    order: Order,
    /// Position at which the pixels begin.
    end: usize,
}

/// The order of the pixels in a file.
struct Order {
    size: [usize; 2],
    /// Whether scan lines are rows, not columns.
    by_rows: bool,
    /// Whether columns and rows are counted from the left and from the top.
    forwards: [bool; 2],
}

/// The image in a file.
pub(super) fn decode(bytes: &[u8]) -> Result<Pixels, SkyImageError> {
    let header = header(bytes)?;
    let Order { size, by_rows, .. } = header.order;
    check_size(size.map(|side| side as u64), 16)?;
    let length = size[usize::from(!by_rows)];
    // Memory is not touched before pixels are written to it, so that a short file with a long
    // header is refused at once.
    let mut pixels = vec![[0; 4]; size[0] * size[1]];
    let mut rest = &bytes[header.end..];
    for line in pixels.chunks_mut(length) {
        scan_line(&mut rest, line)?;
    }
    let texel = |at: usize| {
        let [parts @ .., exponent] = pixels[at];
        let unit = unit(exponent);
        // Without exposure, exactly the values of the file.
        [0, 1, 2].map(|c: usize| (f64::from(parts[c]) * unit / header.divisor[c]) as f32)
    };
    let [width, height] = size;
    let places = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
    Ok(Pixels {
        width,
        texels: places
            .map(|place| texel(header.order.index(place)))
            .collect(),
        primaries: header.primaries,
        warnings: Vec::new(),
    })
}

/// The factor of a mantissa with this exponent: 2^(exponent − 128) / 256.
fn unit(exponent: u8) -> f64 {
    match exponent {
        0 => 0.0,
        exponent => f64::from_bits((1023 - 128 - 8 + u64::from(exponent)) << 52),
    }
}

/// Reads a scan line: each component by itself, in runs, or pixel after pixel.
fn scan_line(rest: &mut &[u8], line: &mut [[u8; 4]]) -> Result<(), SkyImageError> {
    match **rest {
        [2, 2, 0..128, _, ..] if BY_COMPONENT.contains(&line.len()) => {
            take::<4>(rest)?;
            (0..4).try_for_each(|component| by_component(rest, line, component))
        }
        _ => by_pixel(rest, line),
    }
}

/// Reads a component: a count above 128 is of repeats of the next byte, any other of bytes.
fn by_component(
    rest: &mut &[u8],
    line: &mut [[u8; 4]],
    component: usize,
) -> Result<(), SkyImageError> {
    let mut at = 0;
    while at < line.len() {
        let [count] = take(rest)?;
        let is_run = count > 128;
        let pixels = run(
            line,
            &mut at,
            usize::from(if is_run { count - 128 } else { count }),
        )?;
        if is_run {
            let [value] = take(rest)?;
            pixels.iter_mut().for_each(|pixel| pixel[component] = value);
        } else {
            for pixel in pixels {
                [pixel[component]] = take(rest)?;
            }
        }
    }
    Ok(())
}

/// Reads pixels; (1, 1, 1, n) are n repeats of the pixel before, and each such one that follows
/// another counts 256 times as much.
fn by_pixel(rest: &mut &[u8], line: &mut [[u8; 4]]) -> Result<(), SkyImageError> {
    let mut at = 0;
    let mut shift = 0;
    while at < line.len() {
        let mut pixel = take(rest)?;
        let mut count = 1;
        if let [1, 1, 1, repeats] = pixel {
            let before = at.checked_sub(1).map(|before| line[before]);
            pixel = before.ok_or_else(|| SkyImageError::broken("a line begins with a repeat"))?;
            count = usize::from(repeats) << shift;
            // 2¹⁶ are more than a line has.
            shift = 16.min(shift + 8);
        } else {
            shift = 0;
        }
        run(line, &mut at, count)?.fill(pixel);
    }
    Ok(())
}

/// The next pixels of a line.
fn run<'a>(
    line: &'a mut [[u8; 4]],
    at: &mut usize,
    count: usize,
) -> Result<&'a mut [[u8; 4]], SkyImageError> {
    let from = *at;
    *at += count;
    let pixels = line.get_mut(from..*at);
    pixels.ok_or_else(|| SkyImageError::broken("a run goes beyond its line"))
}

/// The next bytes.
fn take<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], SkyImageError> {
    let (taken, left) = rest
        .split_first_chunk()
        .ok_or_else(|| SkyImageError::broken("its pixels have no end"))?;
    *rest = left;
    Ok(*taken)
}

impl Order {
    /// The index in the file of the pixel at a column and row from the upper left.
    fn index(&self, place: [usize; 2]) -> usize {
        let from = |axis: usize| match self.forwards[axis] {
            true => place[axis],
            false => self.size[axis] - 1 - place[axis],
        };
        let [column, row] = [from(0), from(1)];
        if self.by_rows {
            row * self.size[0] + column
        } else {
            column * self.size[1] + row
        }
    }

    /// Reads a line such as `-Y 512 +X 1024`. The first axis goes from one scan line to the next; Y
    /// is counted upward.
    fn read(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let [first, lines, second, length] = words[..] else {
            return None;
        };
        let by_rows = match [first, second].map(|axis| axis.get(1..)) {
            [Some("Y"), Some("X")] => true,
            [Some("X"), Some("Y")] => false,
            _ => return None,
        };
        let forwards = |axis: &str| match axis.get(..1) {
            Some("+") => Some(true),
            Some("-") => Some(false),
            _ => None,
        };
        let mut size = [lines.parse().ok()?, length.parse().ok()?];
        let mut forwards = [forwards(first)?, forwards(second)?];
        if by_rows {
            size.reverse();
            forwards.reverse();
        }
        Some(Self {
            size,
            by_rows,
            forwards: [forwards[0], !forwards[1]],
        })
    }
}

/// Reads up to the line of the resolution.
fn header(bytes: &[u8]) -> Result<Header, SkyImageError> {
    let mut lines = Lines { bytes, at: 0 };
    let mut found = Header {
        divisor: [1.0; 3],
        primaries: None,
        order: Order {
            size: [0; 2],
            by_rows: true,
            forwards: [true; 2],
        },
        end: 0,
    };
    // The signature: the text after `#?` is the name of a program.
    lines.next()?;
    loop {
        let line = lines.next()?;
        if line.is_empty() {
            break;
        }
        found.take(&line)?;
    }
    let line = lines.next()?;
    let expected = "two axes and their lengths, such as `-Y 512 +X 1024`";
    found.order = Order::read(&line).ok_or_else(|| unlike(&line, expected))?;
    found.end = lines.at;
    Ok(found)
}

impl Header {
    /// Evaluates a line. A line with another beginning, such as a tab, is a note of some program.
    fn take(&mut self, line: &str) -> Result<(), SkyImageError> {
        let Some((key, value)) = line.split_once('=') else {
            return Ok(());
        };
        match key {
            "FORMAT" => match value.trim() {
                "32-bit_rle_rgbe" => {}
                "32-bit_rle_xyze" => self.primaries = Some(Primaries::XYZ),
                _ => return Err(unlike(line, "`32-bit_rle_rgbe` or `32-bit_rle_xyze`")),
            },
            "EXPOSURE" => {
                let [factor] = factors(value).ok_or_else(|| unlike(line, "a number above 0"))?;
                self.divisor = self.divisor.map(|divisor| divisor * factor);
            }
            "COLORCORR" => {
                let [r, g, b] = factors(value).ok_or_else(|| unlike(line, "3 numbers above 0"))?;
                let divisor = self.divisor;
                self.divisor = [divisor[0] * r, divisor[1] * g, divisor[2] * b];
            }
            // The primaries of XYZE are known.
            "PRIMARIES" if self.primaries != Some(Primaries::XYZ) => {
                let expected = "8 numbers, x and y of red, green, blue and white";
                let [rx, ry, gx, gy, bx, by, wx, wy] =
                    numbers(value).ok_or_else(|| unlike(line, expected))?;
                self.primaries = Some(Primaries {
                    rgb: [[rx, ry], [gx, gy], [bx, by]],
                    white: [wx, wy],
                });
            }
            _ => {}
        }
        Ok(())
    }
}

fn unlike(line: &str, expected: &'static str) -> SkyImageError {
    SkyImageError::Header {
        line: line.chars().take(80).collect(),
        expected,
    }
}

/// Exactly as many numbers as expected.
fn numbers<const N: usize>(value: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = value.split_whitespace().map(|n| n.parse().ok()).collect();
    numbers?.try_into().ok()
}

/// Numbers to divide by.
fn factors<const N: usize>(value: &str) -> Option<[f64; N]> {
    numbers(value).filter(|all| all.iter().all(|v| v.is_finite() && *v > 0.0))
}

/// The lines of a header, ending in LF or CR LF.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Lines<'_> {
    fn next(&mut self) -> Result<String, SkyImageError> {
        let rest = &self.bytes[self.at..];
        let line = rest.iter().take(LONGEST_LINE).position(|b| *b == b'\n');
        let Some(length) = line else {
            return Err(SkyImageError::broken("its header has no end"));
        };
        self.at += length + 1;
        let line = &rest[..length];
        Ok(String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)).into_owned())
    }
}
