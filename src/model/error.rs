//! What can be wrong with a model file: each message says what, where, what was expected, what to do.

use crate::shot::FileError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a model file was not read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The file, or one that it names, could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The extension names no form that is read.
    #[error("`{}` is of a kind that is not read: expected a name ending in .obj, .gltf or .glb; export it so", file.display())]
    UnknownKind {
        /// The model file.
        file: PathBuf,
    },
    /// The file holds no surface and no lamp.
    #[error("model `{}` is empty: it places no triangle of nonzero area and no lamp; export at least one mesh with faces", file.display())]
    Empty {
        /// The model file.
        file: PathBuf,
    },
    /// The file's text is not OBJ at all.
    #[error("`{}` is not an OBJ file: line {line} begins with {found}, expected one of v, vt, vn, f, o, g, s, usemtl, mtllib or #", file.display())]
    NotObj {
        /// The model file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// Text of two bytes a letter.
    #[error("`{}` is text in UTF-16, expected UTF-8: save it as UTF-8", file.display())]
    Utf16 {
        /// The OBJ or MTL file.
        file: PathBuf,
    },
    /// A line of an OBJ or MTL file that cannot be understood.
    #[error("{}:{line}: found `{found}`, expected {expected}", file.display())]
    Line {
        /// The OBJ or MTL file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What should.
        expected: &'static str,
    },
    /// A face of an OBJ file refers to something that is not there.
    #[error("{}:{line}: the face asks for {what} {index}, but there are only {count}: the file is cut short or was edited by hand; export it again", file.display())]
    ObjIndex {
        /// The model file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// "position" or "normal".
        what: &'static str,
        /// As written: from 1, or negative from the latest.
        index: i64,
        /// How many there are.
        count: i64,
    },
    /// A face of an OBJ file counts from 0.
    #[error("{}:{line}: the face asks for {what} 0, but indices begin at 1: export the model again from a program that counts so", file.display())]
    ObjIndexZero {
        /// The model file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// "position" or "normal".
        what: &'static str,
    },
    /// The OBJ reader refused the file, and it is not known where.
    #[error("model `{}` cannot be read as OBJ: {reason}", file.display())]
    Obj {
        /// The model file.
        file: PathBuf,
        /// What it said.
        reason: String,
    },
    /// The container of a glb file is broken.
    #[error("`{}` is no valid glb file: at byte {byte} expected {expected}, found {found}; it may be cut short: copy or export it again", file.display())]
    Glb {
        /// The model file.
        file: PathBuf,
        /// Where.
        byte: usize,
        /// What should stand there.
        expected: String,
        /// What does.
        found: String,
    },
    /// The JSON of a glTF file does not parse, or is not of glTF's shape.
    #[error("the JSON of `{}` is not glTF: {reason}", file.display())]
    Json {
        /// The model file.
        file: PathBuf,
        /// What the parser said, with line and column where it knows them.
        reason: String,
    },
    /// The file is of another version of glTF.
    #[error("model `{}` {found}, expected 2.0: {remedy}", file.display())]
    Version {
        /// The model file.
        file: PathBuf,
        /// Which version it is of, or needs.
        found: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// The file needs an extension that is not supported.
    #[error("model `{}` requires the extension {extension}, which is not supported: {remedy}", file.display())]
    Extension {
        /// The model file.
        file: PathBuf,
        /// The extension's name.
        extension: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// An item of a glTF file refers to another that is not there.
    #[error("model `{}`: {from} refers to {what} {index}, but there are only {count}: the file is broken; export it again", file.display())]
    Dangling {
        /// The model file.
        file: PathBuf,
        /// The item that refers.
        from: String,
        /// What it refers to.
        what: &'static str,
        /// By which index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A value of a glTF file that breaks a rule.
    #[error("model `{}`: {at} {problem}", file.display())]
    Invalid {
        /// The model file.
        file: PathBuf,
        /// Which item.
        at: String,
        /// What is wrong with it, found and expected.
        problem: String,
    },
    /// An index of a mesh beyond its vertices.
    #[error("model `{}`: {mesh} has a triangle with vertex {index}, but only {count} vertices: the file is broken; export it again", file.display())]
    Index {
        /// The model file.
        file: PathBuf,
        /// Which mesh.
        mesh: String,
        /// The index.
        index: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// A number that is NaN or infinite.
    #[error("model `{}`: {at} is not finite: found {found}, expected numbers below 1e38; look for a broken modifier or scale", file.display())]
    NotFinite {
        /// The model file.
        file: PathBuf,
        /// Which number.
        at: String,
        /// Its value.
        found: String,
    },
    /// The nodes do not form a tree.
    #[error("model `{}`: {node} is its own ancestor or the child of two nodes, expected a tree: duplicate it so that each copy has one parent", file.display())]
    NotATree {
        /// The model file.
        file: PathBuf,
        /// Which node.
        node: String,
    },
    /// More of something than is read.
    #[error("model `{}` holds {count} {what} or more, expected at most {limit}", file.display())]
    TooMany {
        /// The model file.
        file: PathBuf,
        /// Of what.
        what: &'static str,
        /// How many were counted.
        count: u64,
        /// How many are allowed.
        limit: u64,
    },
}

impl ModelError {
    /// What is wrong with a part of a file.
    pub(super) fn invalid(file: &Path, at: &str, problem: impl Into<String>) -> Self {
        Self::Invalid {
            file: file.to_owned(),
            at: at.to_owned(),
            problem: problem.into(),
        }
    }
}
