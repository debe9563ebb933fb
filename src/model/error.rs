//! Errors of model files. Each message states what is wrong, where, what was expected and what to
//! do.

use crate::shot::FileError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Reason why a model file was not read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The file, or one that it names, could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The extension is not that of a supported format.
    #[error("`{}` is of a kind that is not read: expected a name ending in .obj, .gltf or .glb; export it so", file.display())]
    UnknownKind {
        /// The model file.
        file: PathBuf,
    },
    /// The file has no surface and no lamp.
    #[error("model `{}` is empty: it places no triangle of nonzero area and no lamp; export at least one mesh with faces", file.display())]
    Empty {
        /// The model file.
        file: PathBuf,
    },
    /// The text of the file is not OBJ.
    #[error("`{}` is not an OBJ file: line {line} begins with {found}, expected one of v, vt, vn, f, o, g, s, usemtl, mtllib or #", file.display())]
    NotObj {
        /// The model file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// The text there.
        found: String,
    },
    /// The text is UTF-16.
    #[error("`{}` is text in UTF-16, expected UTF-8: save it as UTF-8", file.display())]
    Utf16 {
        /// The OBJ or MTL file.
        file: PathBuf,
    },
    /// A line of an OBJ or MTL file is not understood.
    #[error("{}:{line}: found `{found}`, expected {expected}", file.display())]
    Line {
        /// The OBJ or MTL file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// The text there.
        found: String,
        /// Expected text.
        expected: &'static str,
    },
    /// A face of an OBJ file refers to a vertex or normal that does not exist.
    #[error("{}:{line}: the face asks for {what} {index}, but there are only {count}: the file is cut short or was edited by hand; export it again", file.display())]
    ObjIndex {
        /// The model file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// "position" or "normal".
        what: &'static str,
        /// The index as written: from 1, or negative from the latest.
        index: i64,
        /// Number of those that exist.
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
    /// The OBJ reader refused the file without a line number.
    #[error("model `{}` cannot be read as OBJ: {reason}", file.display())]
    Obj {
        /// The model file.
        file: PathBuf,
        /// Message of the reader.
        reason: String,
    },
    /// The container of a glb file is broken.
    #[error("`{}` is no valid glb file: at byte {byte} expected {expected}, found {found}; it may be cut short: copy or export it again", file.display())]
    Glb {
        /// The model file.
        file: PathBuf,
        /// Position, in bytes.
        byte: usize,
        /// Expected content.
        expected: String,
        /// Content found.
        found: String,
    },
    /// The JSON of a glTF file does not parse, or is not of glTF's shape.
    #[error("the JSON of `{}` is not glTF: {reason}", file.display())]
    Json {
        /// The model file.
        file: PathBuf,
        /// Message of the parser, with line and column if known.
        reason: String,
    },
    /// The file has another version of glTF.
    #[error("model `{}` {found}, expected 2.0: {remedy}", file.display())]
    Version {
        /// The model file.
        file: PathBuf,
        /// The version that the file has or needs.
        found: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// The file needs an extension that is not supported.
    #[error("model `{}` requires the extension {extension}, which is not supported: {remedy}", file.display())]
    Extension {
        /// The model file.
        file: PathBuf,
        /// The extension's name.
        extension: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// An item of a glTF file refers to another that does not exist.
    #[error("model `{}`: {from} refers to {what} {index}, but there are only {count}: the file is broken; export it again", file.display())]
    Dangling {
        /// The model file.
        file: PathBuf,
        /// The item that refers.
        from: String,
        /// Kind of the item referred to.
        what: &'static str,
        /// Its index.
        index: usize,
        /// Number of those that exist.
        count: usize,
    },
    /// A value of a glTF file violates a rule.
    #[error("model `{}`: {at} {problem}", file.display())]
    Invalid {
        /// The model file.
        file: PathBuf,
        /// The item.
        at: String,
        /// The problem, with found and expected values.
        problem: String,
    },
    /// An index of a mesh exceeds its vertices.
    #[error("model `{}`: {mesh} has a triangle with vertex {index}, but only {count} vertices: the file is broken; export it again", file.display())]
    Index {
        /// The model file.
        file: PathBuf,
        /// The mesh.
        mesh: String,
        /// The index.
        index: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A number is NaN or infinite.
    #[error("model `{}`: {at} is not finite: found {found}, expected numbers below 1e38; look for a broken modifier or scale", file.display())]
    NotFinite {
        /// The model file.
        file: PathBuf,
        /// The number.
        at: String,
        /// Its value.
        found: String,
    },
    /// The nodes do not form a tree.
    #[error("model `{}`: {node} is its own ancestor or the child of two nodes, expected a tree: duplicate it so that each copy has one parent", file.display())]
    NotATree {
        /// The node.
        file: PathBuf,
        /// Which node.
        node: String,
    },
    /// There is more of something than is read.
    #[error("model `{}` holds {count} {what} or more, expected at most {limit}", file.display())]
    TooMany {
        /// The model file.
        file: PathBuf,
        /// Name of the items.
        what: &'static str,
        /// Number found.
        count: u64,
        /// Number allowed.
        limit: u64,
    },
}

impl ModelError {
    /// The error for an invalid part of a file.
    pub(super) fn invalid(file: &Path, at: &str, problem: impl Into<String>) -> Self {
        Self::Invalid {
            file: file.to_owned(),
            at: at.to_owned(),
            problem: problem.into(),
        }
    }
}
