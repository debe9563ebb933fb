//! MTL: color, emission and name of materials; everything else in them is a warning.
//!
//! `Ke` is color times strength: radiance as it is if the head of the library names Blender as its
//! author; otherwise 1 is 1 cd/m². A material with an image (`map_Kd`) has no `Kd` line in
//! Blender's files and is drawn white. Surfaces of OBJ are visible from both sides.

use super::number::numbers;
use crate::model::{LUMENS_PER_WATT, ModelError, ModelMaterial, Warning};
use crate::shot::{
    FileError, ModelFile, ModelFiles, before_comment, each_line, is_utf16, keyword_and_rest,
};
use indexmap::{IndexMap, IndexSet};
use std::collections::HashMap;
use std::path::Path;

/// A material of a library, and the luminance of an emission of 1 there, cd/m².
type Defined = (tobj::Material, f64);

/// White, the default.
const WHITE: [f64; 3] = [1.0; 3];

/// The materials that faces use, white if no library defines them, and for each name in `used` the
/// index of its material: a name may have a comment behind it.
pub(super) fn read(
    libraries: &IndexSet<String>,
    used: &IndexSet<String>,
    files: &mut ModelFiles,
    warnings: &mut Vec<Warning>,
) -> Result<(Vec<ModelMaterial>, Vec<usize>), ModelError> {
    let mut defined = IndexMap::new();
    for line in libraries {
        for (name, opened) in open(line, files, warnings)? {
            // A library takes precedence over those named after it; within a library the last
            // material of a name holds.
            for (material, values) in materials(&name, opened, warnings)? {
                defined.entry(material).or_insert(values);
            }
        }
    }
    let bare = |name| before_comment("usemtl", name);
    let by_bare_name: HashMap<&str, &Defined> = defined
        .iter()
        .rev()
        .map(|(name, m)| (bare(name), m))
        .collect();
    let mut made = IndexMap::new();
    let mut of_used = Vec::new();
    for written in used {
        let (name, material) = match defined.get(written) {
            Some(material) => (written.as_str(), Some(material)),
            None => (bare(written), by_bare_name.get(bare(written)).copied()),
        };
        let entry = made.entry(name);
        of_used.push(entry.index());
        if let indexmap::map::Entry::Vacant(free) = entry {
            free.insert(plain(name, material, warnings).checked(&files.model, warnings)?);
        }
    }
    Ok((made.into_values().collect(), of_used))
}

/// The drawn part of a material.
fn plain(name: &str, defined: Option<&Defined>, warnings: &mut Vec<Warning>) -> ModelMaterial {
    let name = name.to_owned();
    let material = defined.map(|(material, _)| material);
    match material {
        Some(material) => warn(&name, material, warnings),
        None => warnings.push(Warning::UndefinedMaterial {
            material: name.clone(),
        }),
    }
    ModelMaterial {
        name,
        base_color: material.and_then(|m| m.diffuse).unwrap_or(WHITE),
        emissive: material.and_then(|m| m.emissive).unwrap_or_default(),
        emissive_unit: defined.map_or(1.0, |(_, unit)| *unit),
        double_sided: true,
    }
}

/// The libraries of an `mtllib` line, with their names.
fn open(
    line: &str,
    files: &mut ModelFiles,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<(String, ModelFile)>, ModelError> {
    let mut opened = Vec::new();
    for library in files.libraries(line)? {
        if let Some(beside) = &library.beside {
            warnings.push(Warning::AbsoluteLibrary {
                path: library.asked.clone(),
                beside: beside.clone(),
            });
        }
        match library.found {
            Some(found) => opened.push(found),
            None => warnings.push(Warning::MissingLibrary {
                name: library.beside.unwrap_or(library.asked),
                near: library.near,
            }),
        }
    }
    Ok(opened)
}

/// The materials of a library by their names.
fn materials(
    name: &str,
    opened: ModelFile,
    warnings: &mut Vec<Warning>,
) -> Result<IndexMap<String, Defined>, ModelError> {
    let bytes = opened.bytes()?;
    let checked = check(&bytes, Path::new(name), warnings)?;
    let (found, _) =
        tobj::load_mtl_buf(&mut checked.as_bytes()).map_err(|error| ModelError::Obj {
            file: name.into(),
            reason: error.to_string(),
        })?;
    let unit = emissive_unit(&String::from_utf8_lossy(&bytes));
    let defined = found.into_iter().map(|m| (m.name.clone(), (m, unit)));
    Ok(defined.collect())
}

/// Luminance of a `Ke` of 1, cd/m², from the comments at the beginning of a library.
fn emissive_unit(text: &str) -> f64 {
    let head = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let mut head = head.take_while(|line| line.is_empty() || line.starts_with('#'));
    if head.any(|line| line.starts_with("# Blender")) {
        LUMENS_PER_WATT
    } else {
        1.0
    }
}

/// The lines that are read, each in the form that tobj expects.
fn check(bytes: &[u8], file: &Path, warnings: &mut Vec<Warning>) -> Result<String, ModelError> {
    if is_utf16(bytes) {
        let file = file.to_owned();
        return Err(ModelError::Utf16 { file });
    }
    let mut out = String::new();
    let mut has_name = true;
    each_line(bytes, |number, line| -> Result<(), ModelError> {
        let (keyword, rest) = keyword_and_rest(line);
        let bare = before_comment(keyword, rest);
        if keyword == "newmtl" {
            has_name = !bare.is_empty();
            if !has_name {
                let at = format!("{}:{number}", file.display());
                warnings.push(Warning::NamelessMaterial { at });
            }
        }
        if has_name {
            let checked = value(keyword, rest, bare).map_err(|expected| ModelError::Line {
                file: file.to_owned(),
                line: number,
                found: line.chars().take(60).collect(),
                expected,
            })?;
            if let Some(checked) = checked {
                out.push_str(&format!("{keyword} {checked}\n"));
            }
        }
        Ok(())
    })
    .map_err(|source| FileError::Read {
        file: file.to_owned(),
        source,
    })??;
    Ok(out)
}

/// The text for tobj behind a keyword; None if the line is not read. The error is what was
/// expected.
fn value(keyword: &str, rest: &str, bare: &str) -> Result<Option<String>, &'static str> {
    let values = || -> Option<Vec<f64>> {
        let values = numbers(keyword, rest)?.into_iter();
        Some(values.map(|(_, value)| value).collect())
    };
    Ok(match keyword {
        // A comment may be part of the name; only its users show.
        "newmtl" => Some(rest.to_owned()),
        "Kd" | "Ke" => match values().as_deref() {
            Some([r, g, b, ..]) => Some(format!("{r} {g} {b}")),
            Some([v]) => Some(format!("{v} {v} {v}")),
            _ => return Err("3 numbers: a linear RGB color"),
        },
        "d" | "Tr" | "Pm" | "Pc" | "Ps" => {
            values().and_then(|values| Some(values.first()?.to_string()))
        }
        "map_Kd" | "map_Ke" | "map_d" | "map_Bump" | "map_bump" | "bump" | "norm" => {
            (!bare.is_empty()).then(|| bare.to_owned())
        }
        _ => None,
    })
}

fn warn(name: &str, material: &tobj::Material, warnings: &mut Vec<Warning>) {
    let name = || name.to_owned();
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
