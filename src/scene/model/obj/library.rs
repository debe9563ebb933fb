//! MTL: the color, the emission and the name of materials; all else of them is a warning.
//!
//! `Ke` is color times strength: radiance as it stands where the library's head says that Blender
//! wrote it; elsewhere 1 is 1 cd/m². A material with a picture (`map_Kd`) has no `Kd` line in
//! Blender's files and is drawn white. Surfaces of OBJ are seen from both sides.

use super::super::{LUMENS_PER_WATT, ModelError, ModelMaterial, Warning};
use crate::shot::{ModelFiles, Opened};
use indexmap::{IndexMap, IndexSet};
use std::path::Path;

/// White, where nothing says otherwise.
const WHITE: [f64; 3] = [1.0; 3];

/// The materials that the libraries define, and white ones for those of `used` that none does.
pub(super) fn read(
    libraries: &IndexSet<String>,
    used: &IndexSet<String>,
    files: &mut ModelFiles,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<ModelMaterial>, ModelError> {
    let mut materials = IndexMap::new();
    for name in libraries {
        for (part, bytes) in open(name, files, warnings)? {
            let text = String::from_utf8_lossy(&bytes);
            let checked = check(&text, Path::new(&part))?;
            let (found, _) =
                tobj::load_mtl_buf(&mut checked.as_bytes()).map_err(|error| ModelError::Obj {
                    file: part.clone().into(),
                    reason: error.to_string(),
                })?;
            let unit = emissive_unit(&text);
            materials.extend(found.into_iter().map(|m| (m.name.clone(), (m, unit))));
        }
    }
    let mut out = Vec::new();
    for name in used {
        let Some((material, unit)) = materials.get(name) else {
            warnings.push(Warning::UndefinedMaterial {
                material: name.clone(),
            });
            let name = name.clone();
            out.push(ModelMaterial {
                name,
                base_color: WHITE,
                emissive: [0.0; 3],
                emissive_unit: 1.0,
                double_sided: true,
            });
            continue;
        };
        warn(material, warnings);
        let plain = ModelMaterial {
            name: name.clone(),
            base_color: material.diffuse.unwrap_or(WHITE),
            emissive: material.emissive.unwrap_or_default(),
            emissive_unit: *unit,
            double_sided: true,
        };
        out.push(plain.checked(&files.model, warnings)?);
    }
    Ok(out)
}

/// The libraries of an `mtllib` line, with their names.
fn open(
    name: &str,
    files: &mut ModelFiles,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<(String, Vec<u8>)>, ModelError> {
    let opened = files.libraries(name)?;
    if opened.is_empty() {
        warnings.push(Warning::MissingLibrary {
            name: name.to_owned(),
        });
    }
    let read = |(name, opened): (String, Opened)| Ok((name, opened.bytes()?));
    opened.into_iter().map(read).collect()
}

/// Luminance of a `Ke` of 1, cd/m²: by the comments that a library begins with.
fn emissive_unit(text: &str) -> f64 {
    let head = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let mut head = head.take_while(|line| line.is_empty() || line.starts_with('#'));
    if head.any(|line| line.starts_with("# Blender")) {
        LUMENS_PER_WATT
    } else {
        1.0
    }
}

/// The lines that are read, each of the form that tobj expects.
fn check(text: &str, file: &Path) -> Result<String, ModelError> {
    let mut out = String::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        let wrong = |expected| ModelError::Line {
            file: file.to_owned(),
            line: index + 1,
            found: line.chars().take(60).collect(),
            expected,
        };
        let values: Option<Vec<f64>> = rest.split_whitespace().map(|w| w.parse().ok()).collect();
        let checked = match (keyword, values.as_deref()) {
            ("newmtl", _) if rest.is_empty() => return Err(wrong("newmtl and a name")),
            ("Kd" | "Ke", Some([r, g, b])) => format!("{r} {g} {b}"),
            ("Kd" | "Ke", Some([v])) => format!("{v} {v} {v}"),
            ("Kd" | "Ke", _) => return Err(wrong("3 numbers: a linear RGB color")),
            ("d", Some([v])) => v.to_string(),
            ("newmtl" | "Tr" | "Pm" | "Pc" | "Ps" | "norm", _) => rest.to_owned(),
            ("map_Kd" | "map_Ke" | "map_d" | "map_Bump" | "map_bump" | "bump", _)
                if !rest.is_empty() =>
            {
                rest.to_owned()
            }
            _ => continue,
        };
        out.push_str(&format!("{keyword} {checked}\n"));
    }
    Ok(out)
}

fn warn(material: &tobj::Material, warnings: &mut Vec<Warning>) {
    let name = || material.name.clone();
    let parameter = |key: &str| {
        material
            .unknown_param
            .get(key)
            .and_then(|v| v.parse::<f64>().ok())
    };
    let mut texture = |is_there: bool, what| {
        if is_there {
            warnings.push(Warning::Texture {
                material: name(),
                what,
            });
        }
    };
    let white = "color texture is not read; it is drawn white unless the shot gives it a spectrum";
    let factor = "color texture is not read; it is drawn in its plain color";
    let is_painted = material.diffuse_texture.is_some();
    texture(is_painted && material.diffuse.is_none(), white);
    texture(is_painted && material.diffuse.is_some(), factor);
    texture(
        material.unknown_param.contains_key("map_Ke"),
        "emission texture is not read; it glows evenly, as strong as its Ke line says",
    );
    texture(
        material.normal_texture.is_some() || material.unknown_param.contains_key("norm"),
        "normal map is not read; its surface is smooth",
    );
    texture(
        material.dissolve_texture.is_some(),
        "opacity texture is not read; it is opaque",
    );
    if !is_painted && material.diffuse.is_none() {
        warnings.push(Warning::NoColor { material: name() });
    }
    let is_clear = material.dissolve.is_some_and(|d| d < 1.0) || parameter("Tr") > Some(0.0);
    if is_clear {
        warnings.push(Warning::Alpha {
            material: name(),
            mode: "is see-through (`d`, `Tr`)",
        });
    }
    if parameter("Pm") > Some(0.0) {
        warnings.push(Warning::Metal { material: name() });
    }
    for (key, effect) in [
        ("Pc", "its clear coat's highlight"),
        ("Ps", "its velvet sheen"),
    ] {
        if parameter(key) > Some(0.0) {
            let extension = format!("`{key}`");
            warnings.push(Warning::MaterialExtension {
                material: name(),
                extension,
                effect,
            });
        }
    }
}
