//! The lines of an OBJ file, each checked, and the text reduced to positions, normals, faces, names
//! and materials.

use super::super::mesh::is_in_range;
use super::super::polygon::MAX_CORNERS;
use super::super::{ModelError, Warning};
use crate::shot::ModelFiles;
use ::glam::DVec3;
use indexmap::IndexSet;
use std::fmt::Write;
use std::path::PathBuf;

/// Keywords of OBJ; a file that begins with something else and has no vertex is none.
const KEYWORDS: [&str; 24] = [
    "v",
    "vt",
    "vn",
    "vp",
    "f",
    "l",
    "p",
    "o",
    "g",
    "s",
    "usemtl",
    "mtllib",
    "mg",
    "lod",
    "usemap",
    "maplib",
    "cstype",
    "deg",
    "curv",
    "curv2",
    "surf",
    "shadow_obj",
    "trace_obj",
    "call",
];

/// Longest part of a line that a message repeats.
const SHOWN: usize = 60;

/// What the lines hold.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// The text that tobj reads.
    pub(super) text: String,
    /// Material libraries, as `mtllib` lines name them.
    pub(super) libraries: IndexSet<String>,
    /// Materials that faces use.
    pub(super) materials: IndexSet<String>,
    /// What is left out.
    pub(super) warnings: Vec<Warning>,
    name: String,
    has_colors: bool,
    positions: i64,
    coordinates: i64,
    normals: i64,
    /// The greatest index met of each kind and its line: a face may come before its vertices.
    greatest: [(i64, usize); 3],
}

/// Checks and reduces the text.
pub(super) fn scan(text: &str, files: &ModelFiles) -> Result<Scan, ModelError> {
    let mut scan = Scan {
        text: String::from("mtllib all\n"),
        ..Scan::default()
    };
    let mut stranger = None;
    let mut joined = String::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if let Some(part) = line.strip_suffix('\\') {
            joined.push_str(part);
            joined.push(' ');
            continue;
        }
        let whole = if joined.is_empty() {
            line
        } else {
            &format!("{joined}{line}")
        };
        let result = scan.line(whole, index + 1, &mut stranger);
        result.map_err(|fault| fault.at(files.model.clone(), index + 1, whole))?;
        joined.clear();
    }
    if let (Some((line, found)), 0) = (stranger, scan.positions) {
        return Err(ModelError::NotObj {
            file: files.model.clone(),
            line,
            found,
        });
    }
    scan.check_greatest(files)?;
    Ok(scan)
}

/// A mistake in a line, its place not yet named.
enum Fault {
    Expected(&'static str),
    Index {
        what: &'static str,
        index: i64,
        count: i64,
    },
    Corners(u64),
}

impl Fault {
    fn at(self, file: PathBuf, line: usize, text: &str) -> ModelError {
        match self {
            Self::Expected(expected) => ModelError::Line {
                file,
                line,
                found: text.chars().take(SHOWN).collect(),
                expected,
            },
            Self::Index { what, index, count } => ModelError::ObjIndex {
                file,
                line,
                what,
                index,
                count,
            },
            Self::Corners(count) => ModelError::TooMany {
                file,
                what: "corners of one face",
                count,
                limit: MAX_CORNERS as u64,
            },
        }
    }
}

impl Scan {
    fn line(
        &mut self,
        line: &str,
        number: usize,
        stranger: &mut Option<(usize, String)>,
    ) -> Result<(), Fault> {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        match keyword {
            "v" => self.position(rest)?,
            "vn" => {
                self.normals += 1;
                numbers(rest)
                    .filter(|v| v.len() == 3)
                    .ok_or(Fault::Expected("vn and 3 numbers"))?;
                self.keep("vn ", rest);
            }
            "vt" => self.coordinates += 1,
            "f" => self.face(rest, number)?,
            "o" | "g" => {
                rest.clone_into(&mut self.name);
                self.keep("o ", rest);
            }
            "usemtl" if rest.is_empty() => return Err(Fault::Expected("usemtl and a name")),
            "usemtl" => {
                self.materials.insert(rest.to_owned());
                self.keep("usemtl ", rest);
            }
            "mtllib" => drop(self.libraries.insert(rest.to_owned())),
            "l" | "p" => self.warn(Warning::PointsOrLines {
                mesh: format!("object `{}`", self.name),
            }),
            "curv" | "curv2" | "surf" => self.warn(Warning::Freeform {
                keyword: keyword.to_owned(),
            }),
            _ => {
                let is_known =
                    keyword.is_empty() || keyword.starts_with('#') || KEYWORDS.contains(&keyword);
                if !is_known && stranger.is_none() {
                    let start: String = keyword.chars().take(12).collect();
                    *stranger = Some((number, format!("{start:?}")));
                }
            }
        }
        Ok(())
    }

    fn position(&mut self, rest: &str) -> Result<(), Fault> {
        const EXPECTED: Fault =
            Fault::Expected("v and 3 finite numbers, perhaps a weight other than 0 or a color");
        let values = numbers(rest).ok_or(EXPECTED)?;
        let w = if values.len() == 4 { values[3] } else { 1.0 };
        let has_color = values.len() == 6;
        let is_point = |v: &[f64]| is_in_range(DVec3::new(v[0], v[1], v[2]) / w);
        if !(has_color || [3, 4].contains(&values.len())) || w == 0.0 || !is_point(&values) {
            return Err(EXPECTED);
        }
        self.positions += 1;
        if has_color && !self.has_colors {
            self.has_colors = true;
            self.warn(Warning::VertexColors {
                mesh: format!("object `{}`", self.name),
            });
        }
        if has_color {
            let end = rest
                .split_whitespace()
                .nth(3)
                .map_or(rest.len(), |w| offset(rest, w));
            self.keep("v ", rest[..end].trim_end());
        } else {
            self.keep("v ", rest);
        }
        Ok(())
    }

    fn face(&mut self, rest: &str, number: usize) -> Result<(), Fault> {
        self.text.push('f');
        let mut corners = 0;
        for word in rest.split_whitespace() {
            let [position, _, normal] = self.corner(word, number)?;
            corners += 1;
            let written = match normal {
                0 => write!(self.text, " {position}"),
                _ => write!(self.text, " {position}//{normal}"),
            };
            debug_assert!(written.is_ok(), "a string takes any text");
        }
        self.text.push('\n');
        match corners {
            0..3 => Err(Fault::Expected("f and at least 3 corners")),
            3..=MAX_CORNERS => Ok(()),
            _ => Err(Fault::Corners(corners as u64)),
        }
    }

    /// The indices of one corner from 1, 0 where there is none.
    fn corner(&mut self, word: &str, number: usize) -> Result<[i64; 3], Fault> {
        const EXPECTED: Fault = Fault::Expected("corners such as 1, 1/2, 1//3 or 1/2/3");
        let mut indices = [0; 3];
        let counts = [self.positions, self.coordinates, self.normals];
        for (kind, part) in word.split('/').enumerate() {
            let slot = indices.get_mut(kind).ok_or(EXPECTED)?;
            if part.is_empty() && kind > 0 {
                continue;
            }
            let index: i64 = part.parse().map_err(|_| EXPECTED)?;
            let count = counts[kind];
            let from_start = if index < 0 {
                index.saturating_add(count + 1)
            } else {
                index
            };
            if from_start < 1 {
                return Err(Fault::Index {
                    what: KINDS[kind],
                    index,
                    count,
                });
            }
            *slot = from_start;
            if from_start > self.greatest[kind].0 {
                self.greatest[kind] = (from_start, number);
            }
        }
        Ok(indices)
    }

    fn check_greatest(&self, files: &ModelFiles) -> Result<(), ModelError> {
        let counts = [self.positions, self.coordinates, self.normals];
        for (kind, (&(index, line), count)) in self.greatest.iter().zip(counts).enumerate() {
            if index > count {
                let file = files.model.clone();
                return Err(ModelError::ObjIndex {
                    file,
                    line,
                    what: KINDS[kind],
                    index,
                    count,
                });
            }
        }
        Ok(())
    }

    fn keep(&mut self, keyword: &str, rest: &str) {
        self.text.push_str(keyword);
        self.text.push_str(rest);
        self.text.push('\n');
    }

    fn warn(&mut self, warning: Warning) {
        if self.warnings.last() != Some(&warning) {
            self.warnings.push(warning);
        }
    }
}

/// What the three parts of a corner refer to.
const KINDS: [&str; 3] = ["position", "texture coordinate", "normal"];

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

/// Where in `text` its part `word` begins.
fn offset(text: &str, word: &str) -> usize {
    word.as_ptr() as usize - text.as_ptr() as usize
}
