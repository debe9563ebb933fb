//! Warnings: content of a model file that the image will not show.

use std::fmt;

/// Number of names that one warning lists at most.
const MOST_NAMES: usize = 3;

/// Content of a model file that was left out or replaced, and the effect on the image.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Warning {
    /// A texture, of which only the factor is used.
    Texture {
        /// The material.
        material: String,
        /// The texture, and its effect.
        what: &'static str,
    },
    /// A material that lets the background through.
    Alpha {
        /// The material.
        material: String,
        /// The mode of transparency in the file.
        mode: &'static str,
    },
    /// A metal.
    Metal {
        /// The material.
        material: String,
    },
    /// A material extension.
    MaterialExtension {
        /// The material.
        material: String,
        /// The extension.
        extension: String,
        /// The effect that the image lacks.
        effect: &'static str,
    },
    /// A color outside the range of reflectance, clamped.
    Clamped {
        /// The material.
        material: String,
    },
    /// A material with no color of its own.
    NoColor {
        /// The material.
        material: String,
    },
    /// A material that faces refer to and no library defines.
    UndefinedMaterial {
        /// The material.
        material: String,
    },
    /// A material library that does not exist.
    MissingLibrary {
        /// Its file name.
        name: String,
        /// The file that was perhaps meant.
        near: Option<String>,
    },
    /// A material library named by an absolute path, which is valid on the author's machine only.
    AbsoluteLibrary {
        /// The path.
        path: String,
        /// The name that is tried beside the model.
        beside: String,
    },
    /// A material of a library that has no name.
    NamelessMaterial {
        /// The library and the line.
        at: String,
    },
    /// Faces of an OBJ file with fewer than three corners.
    FewCorners {
        /// Number of faces.
        count: usize,
        /// Line of the first.
        line: usize,
    },
    /// Faces of an OBJ file that refer to normals or texture coordinates in a file without any.
    NamesNone {
        /// "normal" or "texture coordinate".
        what: &'static str,
        /// Line of the first.
        line: usize,
    },
    /// A face of an OBJ file that refers to a texture coordinate that does not exist.
    Coordinate {
        /// Its line.
        line: usize,
        /// The index as written: from 1, or negative from the latest.
        index: i64,
        /// Number of those that exist.
        count: i64,
    },
    /// Numbers of a vertex in an OBJ file that are neither position nor color.
    ExtraNumbers {
        /// Line of the first.
        line: usize,
    },
    /// Colors at vertices.
    VertexColors {
        /// The mesh.
        mesh: String,
    },
    /// Points and lines.
    PointsOrLines {
        /// The mesh.
        mesh: String,
    },
    /// Curves and curved surfaces.
    Freeform {
        /// The keyword.
        keyword: String,
    },
    /// Triangles of zero area.
    Degenerate {
        /// The mesh.
        mesh: String,
        /// Number of triangles.
        count: usize,
    },
    /// Normals of zero length, replaced by those of the triangles.
    Normals {
        /// The mesh.
        mesh: String,
    },
    /// Normals at some corners and none at others.
    SomeNormals {
        /// The mesh.
        mesh: String,
    },
    /// A mesh bent by a skeleton.
    Skin {
        /// The node.
        node: String,
    },
    /// A mesh with shape keys.
    ShapeKeys {
        /// The mesh.
        mesh: String,
    },
    /// Animation clips.
    Animations {
        /// Number of clips.
        count: usize,
    },
    /// An instance scaled to a line or a point.
    Squashed {
        /// The node.
        node: String,
    },
    /// A lamp whose light ends at a distance.
    LampRange {
        /// The lamp.
        lamp: String,
    },
    /// A node that was probably a lamp before export.
    LostLamp {
        /// The node.
        node: String,
    },
    /// Scenes besides the one that is shown.
    OtherScenes {
        /// Number of scenes.
        count: usize,
    },
    /// Surfaces to which the file gives no material.
    NoMaterial {
        /// Names of their nodes, or of their objects or groups.
        nodes: Vec<String>,
    },
    /// Text that is not UTF-8.
    NotUtf8 {
        /// Line of the first letter that is not, from 1.
        line: usize,
    },
    /// Raw line breaks and the like within the text of a JSON file.
    ControlCharacters,
    /// A number in place of the text "2.0".
    VersionNumber,
    /// An optional extension that is ignored.
    Extension {
        /// Its name.
        extension: String,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Texture { material, what } => {
                write!(f, "material `{material}`: its {what}")
            }
            Self::Alpha { material, mode } => {
                write!(
                    f,
                    "material `{material}`: {mode}; it is drawn opaque, nothing shows through"
                )
            }
            Self::Metal { material } => write!(
                f,
                "material `{material}`: is a metal; it is drawn as matt paint of the same color, without reflections"
            ),
            Self::MaterialExtension {
                material,
                extension,
                effect,
            } => {
                write!(
                    f,
                    "material `{material}`: {extension} is not drawn: {effect}"
                )
            }
            Self::Clamped { material } => write!(
                f,
                "material `{material}`: its color lies outside 0 to 1 and is clamped to it"
            ),
            Self::NoColor { material } => {
                write!(
                    f,
                    "material `{material}`: no color is given; it is drawn white"
                )
            }
            Self::UndefinedMaterial { material } => write!(
                f,
                "material `{material}`: faces use it but no material library defines it; it is drawn white unless the shot gives it a material"
            ),
            Self::MissingLibrary { name, near } => {
                write!(
                    f,
                    "material library `{name}` does not exist; its materials are drawn white unless the shot gives them"
                )?;
                near.iter()
                    .try_for_each(|near| write!(f, "; did you mean `{near}`?"))
            }
            Self::AbsoluteLibrary { path, beside } => write!(
                f,
                "material library `{path}` is an absolute path, which no model may read; `{beside}` beside the model is taken for it"
            ),
            Self::NamelessMaterial { at } => {
                write!(f, "{at}: a material without a name is left out")
            }
            Self::FewCorners { count, line } => write!(
                f,
                "faces of fewer than 3 corners have no area and are left out: {count}, the first in line {line}"
            ),
            Self::NamesNone { what, line } => write!(
                f,
                "faces name {what}s, the first in line {line}, but the file has none; they are left out"
            ),
            Self::Coordinate { line, index, count } => write!(
                f,
                "line {line}: the face asks for texture coordinate {index}, but there are only {count}; coordinates are not read"
            ),
            Self::ExtraNumbers { line } => write!(
                f,
                "vertices have numbers after x y z that are neither weight nor color, the first in line {line}; they are not read"
            ),
            Self::VertexColors { mesh } => write!(
                f,
                "{mesh}: colors at vertices are not read; it has the color of its material alone"
            ),
            Self::PointsOrLines { mesh } => {
                write!(
                    f,
                    "{mesh}: points and lines have no surface and are left out"
                )
            }
            Self::Freeform { keyword } => write!(
                f,
                "`{keyword}`: curved surfaces are left out; convert them to a mesh before export"
            ),
            Self::Degenerate { mesh, count } => {
                write!(f, "{mesh}: {count} triangles of zero area are left out")
            }
            Self::Normals { mesh } => write!(
                f,
                "{mesh}: some normals are zero or not finite; the triangles' own are used there"
            ),
            Self::SomeNormals { mesh } => write!(
                f,
                "{mesh}: some faces have normals and some have none; all are drawn flat"
            ),
            Self::Skin { node } => write!(
                f,
                "{node}: its skeleton is not applied; it stands in its rest pose"
            ),
            Self::ShapeKeys { mesh } => {
                write!(
                    f,
                    "{mesh}: its shape keys are not applied; it has its basic shape"
                )
            }
            Self::Animations { count } => write!(
                f,
                "{count} animations are not played; everything stands as the nodes of the file do"
            ),
            Self::Squashed { node } => write!(
                f,
                "{node}: its scale squashes it to nothing (a scale of 0?); it is left out"
            ),
            Self::LampRange { lamp } => write!(
                f,
                "lamp `{lamp}`: its range is ignored; its light reaches any distance"
            ),
            Self::LostLamp { node } => write!(
                f,
                "{node}: holds nothing; if it was an area light, glTF has none: use a glowing plane"
            ),
            Self::OtherScenes { count } => write!(
                f,
                "{count} other scenes are left out; only the file's default scene is shown, or the first where none is"
            ),
            Self::NoMaterial { nodes } => {
                let shown = nodes.iter().take(MOST_NAMES);
                let shown: Vec<String> = shown.map(|node| called(node)).collect();
                let more = match nodes.len() - shown.len() {
                    0 => String::new(),
                    more => format!(" and {more} more"),
                };
                write!(
                    f,
                    "{}{more}: the file gives these surfaces no material; they are drawn white; in the shot, materials = {{ \"\" = \"NAME\" }} gives them one",
                    shown.join(", ")
                )
            }
            Self::NotUtf8 { line } => write!(
                f,
                "line {line}: its text is not UTF-8; letters that cannot be read are \u{FFFD} in names: save it as UTF-8"
            ),
            Self::ControlCharacters => write!(
                f,
                "its JSON has raw line breaks or tabs within quotes; they are read as blanks"
            ),
            Self::VersionNumber => write!(
                f,
                "its asset.version is a number where text is expected; it is read as glTF 2.0"
            ),
            Self::Extension { extension } => {
                write!(
                    f,
                    "extension {extension} is ignored; what it adds is not in the picture"
                )
            }
        }
    }
}

/// The name of a node or object, for messages.
fn called(name: &str) -> String {
    match name {
        "" => "the mesh".to_owned(),
        _ => format!("`{name}`"),
    }
}
