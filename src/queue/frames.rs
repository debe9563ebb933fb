//! Frame lists: which frames of a shot to work on, as written on the command line.
//!
//! Comma-separated: `7`, `1-10`, `1..10`, `1-10:3` or `1-10x3` (every third), `100-` (to the end),
//! and with a sign for tools that count frames below 1: `-3`, `-5--1`. Blanks may separate the
//! parts. Order and overlaps do not matter. `:` is the step, as in Open Job Description (2023-09);
//! fileseq gives it another meaning, USD yet another.
//!
//! A list is kept as ranges and only compared with the length of a shot in [`FrameList::resolve`],
//! so `1-4000000000` costs nothing.

use std::collections::BTreeSet;
use std::str::FromStr;

/// A list of frames, independent of any shot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameList {
    ranges: Vec<Range>,
}

/// `first`, `first + step` … up to `last`; to the end of the shot if there is no `last`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Range {
    first: i64,
    last: Option<i64>,
    step: i64,
}

/// The frames of a list that a shot has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Resolved {
    /// Numbers from 1 to the shot's last, ascending, each once.
    pub frames: Vec<u32>,
    /// Number of frames in the list that the shot does not have, counted in each part of the list.
    pub outside: u64,
}

/// A frame list that cannot be read. Every message names the part at fault.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FrameListError {
    /// Empty, or empty between two commas.
    #[error("the frame list {list:?} has an empty part; write frames like 1-10,20")]
    Empty {
        /// The whole list.
        list: String,
    },
    /// A colon in place of a range.
    #[error("{part:?} is no frame range; USD spelling? write {first}-{last}")]
    Colon {
        /// The part as written.
        part: String,
        /// The number before the colon.
        first: i64,
        /// The text after it.
        last: String,
    },
    /// The last frame comes before the first.
    #[error(
        "the frame range {part:?} descends; write {last}-{first}: frames are always rendered in ascending order"
    )]
    Descending {
        /// The part as written.
        part: String,
        /// Its first number.
        first: i64,
        /// Its second number.
        last: i64,
    },
    /// A step of zero or below.
    #[error("the step of {part:?} is {step}; it must be 1 or more")]
    Step {
        /// The part as written.
        part: String,
        /// The step.
        step: i64,
    },
    /// A number with a fraction.
    #[error("{part:?} asks for a part of a frame; frames are whole numbers")]
    SubFrame {
        /// The part as written.
        part: String,
    },
    /// A number beyond 18 digits.
    #[error("a number in {part:?} is too large for a frame")]
    TooLarge {
        /// The part as written.
        part: String,
    },
    /// Anything else.
    #[error(
        "{part:?} is no frame or range of frames; write 7, 1-10, 1-10:3 (every third) or 100- (to the end)"
    )]
    Unknown {
        /// The part as written.
        part: String,
    },
}

impl FrameList {
    /// Every frame of a shot.
    pub fn all() -> Self {
        Self {
            ranges: vec![Range {
                first: 1,
                last: None,
                step: 1,
            }],
        }
    }

    /// Reads a list in the format that the module describes.
    ///
    /// # Errors
    /// The first part that is not a frame or range, with a hint of what was meant.
    pub fn parse(list: &str) -> Result<Self, FrameListError> {
        let part = |part: &str| match part.trim() {
            "" => Err(FrameListError::Empty {
                list: list.to_owned(),
            }),
            part => parse_part(part),
        };
        Ok(Self {
            ranges: list.split(',').map(part).collect::<Result<_, _>>()?,
        })
    }

    /// The frames of this list that a shot of `frames` frames has, numbered from 1.
    pub fn resolve(&self, frames: u32) -> Resolved {
        let mut inside = BTreeSet::new();
        let mut outside = 0_u64;
        for range in &self.ranges {
            let kept = range.within(frames);
            outside = outside.saturating_add(range.count(frames) - kept.clone().count() as u64);
            inside.extend(kept);
        }
        Resolved {
            frames: inside.into_iter().collect(),
            outside,
        }
    }
}

impl FromStr for FrameList {
    type Err = FrameListError;

    fn from_str(list: &str) -> Result<Self, FrameListError> {
        Self::parse(list)
    }
}

impl Range {
    /// Its last number in a shot of `frames` frames; an open range contains at least its first.
    fn last(&self, frames: u32) -> i64 {
        self.last
            .unwrap_or_else(|| i64::from(frames).max(self.first))
    }

    /// Number of frames in it.
    fn count(&self, frames: u32) -> u64 {
        // Numbers have at most 18 digits, so the difference fits.
        ((self.last(frames) - self.first) / self.step) as u64 + 1
    }

    /// Its numbers from 1 to `frames`.
    fn within(&self, frames: u32) -> impl Iterator<Item = u32> + Clone + use<> {
        let skipped = if self.first < 1 {
            (1 - self.first).div_euclid(self.step)
        } else {
            0
        };
        let mut start = self.first + skipped * self.step;
        if start < 1 {
            start += self.step;
        }
        let end = self.last(frames).min(i64::from(frames));
        // A step beyond `usize` or the end leaves only the first number, as it should.
        let step = usize::try_from(self.step).unwrap_or(usize::MAX);
        (start..=end)
            .step_by(step)
            .filter_map(|frame| u32::try_from(frame).ok())
    }
}

/// Writes ascending frames as a list that can be read: `1-3,7`.
pub fn list_of(frames: &[u32]) -> String {
    let runs = frames.chunk_by(|a, b| a + 1 == *b);
    let run = |run: &[u32]| match run {
        [first, .., last] => format!("{first}-{last}"),
        _ => run.first().map_or_else(String::new, u32::to_string),
    };
    runs.map(run).collect::<Vec<_>>().join(",")
}

/// Reads `FIRST`, `FIRST-`, `FIRST-LAST` or `FIRST..LAST`, the ranges with a step or without.
fn parse_part(part: &str) -> Result<Range, FrameListError> {
    let unknown = || FrameListError::Unknown {
        part: part.to_owned(),
    };
    if has_fraction(part) {
        return Err(FrameListError::SubFrame {
            part: part.to_owned(),
        });
    }
    let (first, rest) = number(part, part)?.ok_or_else(unknown)?;
    if rest.is_empty() {
        return Ok(Range {
            first,
            last: Some(first),
            step: 1,
        });
    }
    if let Some(last) = rest.strip_prefix(':') {
        return Err(FrameListError::Colon {
            part: part.to_owned(),
            first,
            last: last.trim().to_owned(),
        });
    }
    let rest = rest
        .strip_prefix('-')
        .or_else(|| rest.strip_prefix(".."))
        .ok_or_else(unknown)?;
    let (last, rest) = match number(rest, part)? {
        Some((last, rest)) => (Some(last), rest),
        None => (None, rest.trim_start()),
    };
    let step = match rest.strip_prefix([':', 'x']) {
        None if rest.is_empty() => 1,
        None => return Err(unknown()),
        Some(rest) => match number(rest, part)?.ok_or_else(unknown)? {
            (step, "") => step,
            _ => return Err(unknown()),
        },
    };
    match last {
        _ if step < 1 => Err(FrameListError::Step {
            part: part.to_owned(),
            step,
        }),
        Some(last) if last < first => Err(FrameListError::Descending {
            part: part.to_owned(),
            first,
            last,
        }),
        last => Ok(Range { first, last, step }),
    }
}

/// The number at the beginning of `text` and the text after it, without blanks around it.
fn number<'a>(text: &'a str, part: &str) -> Result<Option<(i64, &'a str)>, FrameListError> {
    const MAX_DIGITS: usize = 18;
    let text = text.trim_start();
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text),
    };
    let length = digits
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(digits.len());
    let (digits, rest) = digits.split_at(length);
    if digits.is_empty() {
        return Ok(None);
    }
    let significant = digits.trim_start_matches('0');
    if significant.len() > MAX_DIGITS {
        return Err(FrameListError::TooLarge {
            part: part.to_owned(),
        });
    }
    let value = significant
        .bytes()
        .fold(0, |value, digit| value * 10 + i64::from(digit - b'0'));
    Ok(Some((sign * value, rest.trim_start())))
}

/// Whether there is a point that does not belong to `..`.
fn has_fraction(part: &str) -> bool {
    part.split("..").any(|side| side.contains('.'))
}
