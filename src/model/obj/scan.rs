//! The lines of an OBJ file, each checked, and the text reduced to positions, normals and faces,
//! with numbers in place of names.

use super::number::numbers;
use crate::model::mesh::is_in_range;
use crate::model::polygon::MAX_CORNERS;
use crate::model::{ModelError, Warning};
use crate::shot::{
    FileError, ModelFiles, OBJ_KEYWORDS, before_comment, each_obj_line, is_utf16, keyword_and_rest,
};
use ::glam::DVec3;
use indexmap::IndexSet;
use std::fmt::Write;
use std::path::PathBuf;

/// Number of characters of a line that a message repeats at most.
const SHOWN: usize = 60;

/// Result of scanning the lines.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// The reduced text for tobj.
    pub(super) text: String,
    /// Material libraries, as `mtllib` lines name them.
    pub(super) libraries: IndexSet<String>,
    /// Materials that faces use, as `usemtl` lines name them; `text` has their numbers.
    pub(super) materials: IndexSet<String>,
    /// Names of objects and groups, the first for those without a name; `text` has their numbers.
    pub(super) objects: IndexSet<String>,
    /// Content that is left out.
    pub(super) warnings: Vec<Warning>,
    /// Index in `objects` of the current object.
    object: usize,
    has_colors: bool,
    has_extra_numbers: bool,
    /// Number of faces of fewer than three corners, and the line of the first.
    few_corners: (usize, usize),
    /// Number of each of [`KINDS`] so far.
    counts: [i64; 3],
    asked: [Asked; 3],
}

/// Indices of one kind that faces refer to.
#[derive(Debug, Clone, Copy, Default)]
struct Asked {
    /// Line of the first; 0 if there is none.
    first: usize,
    /// The greatest index and its line: a face may come before its vertices.
    greatest: (i64, usize),
    /// The first index before the first item: line, index, number of items at that point.
    too_low: Option<(usize, i64, i64)>,
}

/// Checks and reduces the text.
pub(super) fn scan(bytes: &[u8], files: &ModelFiles) -> Result<Scan, ModelError> {
    let file = || files.model.clone();
    if is_utf16(bytes) {
        return Err(ModelError::Utf16 { file: file() });
    }
    let mut scan = Scan {
        text: String::from("mtllib all\no 0\n"),
        objects: IndexSet::from([String::new()]),
        ..Scan::default()
    };
    let mut stranger = None;
    each_obj_line(bytes, |number, line| {
        let result = scan.line(line, number, &mut stranger);
        result.map_err(|fault| fault.at(file(), number, line))
    })
    .map_err(|source| FileError::Read {
        file: file(),
        source,
    })??;
    if let (Some((line, found)), [0, ..]) = (stranger, scan.counts) {
        return Err(ModelError::NotObj {
            file: file(),
            line,
            found,
        });
    }
    scan.check_asked(files)?;
    if let (count @ 1.., line) = scan.few_corners {
        scan.warn(Warning::FewCorners { count, line });
    }
    Ok(scan)
}

/// An error in a line, without its place.
enum Fault {
    Expected(&'static str),
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
        let (keyword, rest) = keyword_and_rest(line);
        match keyword {
            "v" => self.position(rest, number)?,
            "vn" => {
                let values = numbers("vn", rest).filter(|values| values.len() >= 3);
                let values = values.ok_or(Fault::Expected("vn and 3 numbers"))?;
                self.counts[2] += 1;
                self.keep("vn", &values[..3]);
            }
            "vt" => self.counts[1] += 1,
            "f" => self.face(before_comment("f", rest), number)?,
            "o" | "g" => {
                let name = before_comment(keyword, rest).to_owned();
                self.object = self.objects.insert_full(name).0;
                self.text.push_str(&format!("o {}\n", self.object));
            }
            "usemtl" if before_comment("usemtl", rest).is_empty() => {
                self.text.push_str("usemtl none\n");
            }
            "usemtl" => {
                let (material, _) = self.materials.insert_full(rest.to_owned());
                self.text.push_str(&format!("usemtl {material}\n"));
            }
            "mtllib" => drop(self.libraries.insert(rest.to_owned())),
            "l" | "p" => self.warn(Warning::PointsOrLines { mesh: self.mesh() }),
            "curv" | "curv2" | "surf" => self.warn(Warning::Freeform {
                keyword: keyword.to_owned(),
            }),
            _ => {
                let is_known = keyword.is_empty()
                    || keyword.starts_with('#')
                    || OBJ_KEYWORDS.contains(&keyword);
                if !is_known && stranger.is_none() {
                    let start: String = keyword.chars().take(12).collect();
                    *stranger = Some((number, format!("{start:?}")));
                }
            }
        }
        Ok(())
    }

    fn position(&mut self, rest: &str, number: usize) -> Result<(), Fault> {
        const EXPECTED: Fault =
            Fault::Expected("v and 3 finite numbers, perhaps a weight other than 0 or a color");
        let values = numbers("v", rest).ok_or(EXPECTED)?;
        let [(_, x), (_, y), (_, z), more @ ..] = values.as_slice() else {
            return Err(EXPECTED);
        };
        let w = if let [(_, w)] = more { *w } else { 1.0 };
        if w == 0.0 || !is_in_range(DVec3::new(*x, *y, *z) / w) {
            return Err(EXPECTED);
        }
        self.counts[0] += 1;
        let kept = if more.len() == 1 { 4 } else { 3 };
        self.keep("v", &values[..kept]);
        match more.len() {
            0 | 1 => {}
            3 | 4 if !self.has_colors => {
                self.has_colors = true;
                self.warn(Warning::VertexColors { mesh: self.mesh() });
            }
            2 | 5.. if !self.has_extra_numbers => {
                self.has_extra_numbers = true;
                self.warn(Warning::ExtraNumbers { line: number });
            }
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, rest: &str, number: usize) -> Result<(), Fault> {
        let start = self.text.len();
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
            0..3 => {
                self.text.truncate(start);
                let (count, first) = self.few_corners;
                self.few_corners = (count + 1, if count == 0 { number } else { first });
                Ok(())
            }
            3..=MAX_CORNERS => Ok(()),
            _ => Err(Fault::Corners(corners as u64)),
        }
    }

    /// The indices of one corner from 1; 0 if missing.
    fn corner(&mut self, word: &str, number: usize) -> Result<[i64; 3], Fault> {
        const EXPECTED: Fault = Fault::Expected("corners such as 1, 1/2, 1//3 or 1/2/3");
        let mut indices = [0; 3];
        for (kind, part) in word.split('/').enumerate() {
            let slot = indices.get_mut(kind).ok_or(EXPECTED)?;
            if part.is_empty() && kind > 0 {
                continue;
            }
            let index: i64 = part.parse().map_err(|_| EXPECTED)?;
            let count = self.counts[kind];
            let from_start = if index < 0 {
                index.saturating_add(count + 1)
            } else {
                index
            };
            let asked = &mut self.asked[kind];
            if asked.first == 0 {
                asked.first = number;
            }
            if from_start < 1 {
                asked.too_low = asked.too_low.or(Some((number, index, count)));
                continue;
            }
            *slot = from_start;
            if from_start > asked.greatest.0 {
                asked.greatest = (from_start, number);
            }
        }
        Ok(indices)
    }

    /// Refuses indices of items that do not exist, unless the shape does not need them: texture
    /// coordinates are not read, and a mesh without normals is flat.
    fn check_asked(&mut self, files: &ModelFiles) -> Result<(), ModelError> {
        for (kind, asked) in self.asked.into_iter().enumerate() {
            let (what, count) = (KINDS[kind], self.counts[kind]);
            if asked.first > 0 && count == 0 && kind > 0 {
                self.warn(Warning::NamesNone {
                    what,
                    line: asked.first,
                });
                continue;
            }
            let (greatest, line) = asked.greatest;
            let too_great = (greatest > count).then_some((line, greatest, count));
            let Some((line, index, count)) = asked.too_low.or(too_great) else {
                continue;
            };
            if kind == 1 {
                self.warn(Warning::Coordinate { line, index, count });
                continue;
            }
            let file = files.model.clone();
            return Err(match index {
                0 => ModelError::ObjIndexZero { file, line, what },
                _ => ModelError::ObjIndex {
                    file,
                    line,
                    what,
                    index,
                    count,
                },
            });
        }
        Ok(())
    }

    /// The current object, for messages.
    fn mesh(&self) -> String {
        called(&self.objects[self.object])
    }

    /// Writes numbers for tobj, which does not know all spellings of NaN and infinity.
    fn keep(&mut self, keyword: &str, values: &[(&str, f64)]) {
        self.text.push_str(keyword);
        for (word, value) in values {
            self.text.push(' ');
            self.text
                .push_str(if value.is_finite() { word } else { "nan" });
        }
        self.text.push('\n');
    }

    fn warn(&mut self, warning: Warning) {
        if self.warnings.last() != Some(&warning) {
            self.warnings.push(warning);
        }
    }
}

/// The kinds of items that the three parts of a corner refer to.
const KINDS: [&str; 3] = ["position", "texture coordinate", "normal"];

/// An object or group, for messages.
pub(super) fn called(name: &str) -> String {
    match name {
        "" => "the mesh".to_owned(),
        _ => format!("object `{name}`"),
    }
}
