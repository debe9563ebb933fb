//! Skies in OpenEXR files: the choice of channels, and their values.
//!
//! An image is R, G and B (in any case), or Y alone, which is gray; X, Y and Z, if there is no R,
//! are CIE XYZ. Layers are identified by the part of a channel's name before the last dot, and by
//! the names of parts. Plain channels take precedence over a layer with a usual name for images,
//! and that over any other. Pixels of the display window outside of the data window are black.
//! Source: Technical Introduction to OpenEXR and OpenEXR File Layout, openexr.com.

use super::file::{Pixels, SkyImageError, check_memory, check_size};
use super::{SkyWarning, primaries::Primaries};
use ::exr::block::reader::ChunksReader;
use ::exr::block::{self, UncompressedBlock};
use ::exr::error::{Error, Result as ExrResult};
use ::exr::math::Vec2;
use ::exr::meta::attribute::{Chromaticities, EnvironmentMap, SampleType};
use ::exr::meta::header::Header;
use ::exr::prelude::f16;
use std::collections::BTreeMap;
use std::io::Cursor;

/// Usual names of the layer that is the image itself.
const PICTURES: [&str; 8] = [
    "combined",
    "beauty",
    "rgba",
    "rgb",
    "color",
    "composite",
    "image",
    "c",
];

/// Number of characters of the list of channels in a message.
const MOST_NAMES: usize = 400;

/// Channels that make an image.
#[derive(Debug)]
struct Layer {
    /// Name of the part and the layer, by dots; empty for plain channels.
    name: String,
    part: usize,
    /// Index of the channel of each component.
    channels: [usize; 3],
    is_xyz: bool,
    rank: Rank,
}

/// Likelihood that a layer is the image, the likeliest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Plain,
    Named,
    First,
    Other,
}

/// The image in a file.
pub(super) fn decode(bytes: &[u8]) -> Result<Pixels, SkyImageError> {
    let reader = block::read(Cursor::new(bytes), false).map_err(broken)?;
    let (layer, warning) = choose(reader.headers())?;
    let header = &reader.headers()[layer.part];
    let shared = &header.shared_attributes;
    let primaries = if layer.is_xyz {
        Some(Primaries::XYZ)
    } else {
        shared.chromaticities.as_ref().map(primaries)
    };
    let cube = header.own_attributes.environment_map == Some(EnvironmentMap::Cube);
    let mut warnings: Vec<SkyWarning> = warning.into_iter().collect();
    warnings.extend(cube.then_some(SkyWarning::CubeMap));
    let Vec2(width, height) = shared.display_window.size;
    // The image and, until it is complete, nothing else.
    check_size([width as u64, height as u64], 12)?;
    check_blocks(header)?;
    let offset = header.own_attributes.layer_position - shared.display_window.position;
    let mut texels = vec![[0.0; 3]; width * height];
    reader
        .filter_chunks(false, |_, _, block| {
            block.layer == layer.part && block.level == Vec2(0, 0)
        })
        .and_then(|chunks| {
            chunks.decompress_parallel(false, |meta, block| {
                let header = &meta.headers[layer.part];
                put(&block, header, &layer.channels, offset, width, &mut texels)
            })
        })
        .map_err(broken)?;
    Ok(Pixels {
        width,
        texels,
        primaries,
        warnings,
    })
}

/// Checks that the data beyond the display window can be unpacked too.
fn check_blocks(header: &Header) -> Result<(), SkyImageError> {
    let Vec2(width, height) = header.layer_size;
    check_size([width as u64, height as u64], 0).map_err(|error| match error {
        SkyImageError::Size { width, height } => SkyImageError::DataWindow { width, height },
        error => error,
    })?;
    let Vec2(columns, rows) = header.max_block_pixel_size();
    let bytes = columns.checked_mul(rows);
    let bytes = bytes.and_then(|pixels| pixels.checked_mul(header.channels.bytes_per_pixel));
    check_memory(bytes.map_or(u64::MAX, |bytes| bytes as u64))
}

fn broken(error: Error) -> SkyImageError {
    SkyImageError::Broken(error.to_string())
}

fn primaries(found: &Chromaticities) -> Primaries {
    let xy = |Vec2(x, y): Vec2<f32>| [x, y].map(f64::from);
    Primaries {
        rgb: [found.red, found.green, found.blue].map(xy),
        white: xy(found.white),
    }
}

/// Stores the values of a block.
fn put(
    block: &UncompressedBlock,
    header: &Header,
    channels: &[usize; 3],
    Vec2(left, top): Vec2<i32>,
    width: usize,
    texels: &mut [[f32; 3]],
) -> ExrResult<()> {
    let list = &header.channels;
    if block.data.len() != block.index.pixel_size.area() * list.bytes_per_pixel {
        return Err(Error::Invalid("length of a block of pixels".into()));
    }
    for line in block.lines(list) {
        let at = line.location;
        let shown = |component: &usize| channels[*component] == at.channel;
        let shown: Vec<usize> = (0..3).filter(shown).collect();
        let row = at.position.y() as i64 + i64::from(top);
        let row = usize::try_from(row).ok();
        let Some(row) = row.and_then(|row| texels.chunks_mut(width).nth(row)) else {
            continue;
        };
        if shown.is_empty() {
            continue;
        }
        let first = at.position.x() as i64 + i64::from(left);
        let mut write = |i: usize, value: f32| {
            let column = usize::try_from(first + i as i64).ok();
            if let Some(texel) = column.and_then(|column| row.get_mut(column)) {
                shown.iter().for_each(|component| texel[*component] = value);
            }
        };
        match list.list[at.channel].sample_type {
            SampleType::F16 => {
                for (i, value) in line.read_samples::<f16>().enumerate() {
                    write(i, value?.to_f32());
                }
            }
            SampleType::F32 => {
                for (i, value) in line.read_samples::<f32>().enumerate() {
                    write(i, value?);
                }
            }
            SampleType::U32 => {
                for (i, value) in line.read_samples::<u32>().enumerate() {
                    write(i, value? as f32);
                }
            }
        }
    }
    Ok(())
}

/// The layer that is the image, with a warning if that is a guess.
fn choose(headers: &[Header]) -> Result<(Layer, Option<SkyWarning>), SkyImageError> {
    let mut layers = Vec::new();
    for part in 0..headers.len() {
        layers.extend(layers_of(headers, part));
    }
    // Stable: among equals the first.
    layers.sort_by_key(|layer| layer.rank);
    let best = layers.first().map(|layer| layer.rank);
    let equals = layers.iter().filter(|layer| Some(layer.rank) == best);
    let names: Vec<String> = equals.map(|layer| layer.name.clone()).collect();
    if best == Some(Rank::Other) && names.len() > 1 {
        return Err(SkyImageError::Layers(names.join(", ")));
    }
    if layers.is_empty() {
        return Err(no_picture(headers));
    }
    let layer = layers.swap_remove(0);
    let header = &headers[layer.part];
    if header
        .channels
        .list
        .iter()
        .any(|c| c.sampling != Vec2(1, 1))
    {
        return Err(SkyImageError::Subsampled(names_of(headers)));
    }
    let sure = layer.rank == Rank::Plain || layer.rank == Rank::Named && names.len() == 1;
    let warning = (!sure).then(|| SkyWarning::Layer {
        taken: layer.name.clone(),
        others: names[1..].to_vec(),
    });
    Ok((layer, warning))
}

/// The reason why the channels contain no image.
fn no_picture(headers: &[Header]) -> SkyImageError {
    let chroma = |name: &str| matches!(last_word(name).as_str(), "ry" | "by");
    let mut channels = headers.iter().flat_map(|header| &header.channels.list);
    if channels.any(|channel| chroma(&channel.name.to_string())) {
        SkyImageError::Subsampled(names_of(headers))
    } else {
        SkyImageError::NoPicture(names_of(headers))
    }
}

/// The images among a part's channels, by name.
fn layers_of(headers: &[Header], part: usize) -> Vec<Layer> {
    let header = &headers[part];
    let part_name = header.own_attributes.layer_name.as_ref();
    let part_name = part_name.filter(|_| headers.len() > 1);
    let part_name = part_name.map(ToString::to_string).unwrap_or_default();
    let mut by_layer: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for (index, channel) in header.channels.list.iter().enumerate() {
        let name = channel.name.to_string();
        let layer = name.rsplit_once('.').map_or("", |(layer, _)| layer);
        let words = by_layer.entry(layer.to_owned()).or_default();
        words.insert(last_word(&name), index);
    }
    let layer = |(own, words): (String, BTreeMap<String, usize>)| {
        let all = |names: [&str; 3]| {
            let [a, b, c] = names.map(|name| words.get(name).copied());
            Some([a?, b?, c?])
        };
        let colors = all(["r", "g", "b"]).or_else(|| all(["red", "green", "blue"]));
        let has = |name| words.contains_key(name);
        // Vectors and normals have X, Y and Z too.
        let xyz = all(["x", "y", "z"]).filter(|_| own.is_empty());
        let gray = all(["y"; 3]).filter(|_| !["x", "z", "ry", "by"].into_iter().any(has));
        let named = [part_name.as_str(), own.as_str()];
        let name = named.into_iter().filter(|name| !name.is_empty());
        let name = name.collect::<Vec<_>>().join(".");
        let rank = if name.is_empty() {
            Rank::Plain
        } else if name
            .split('.')
            .any(|word| PICTURES.contains(&word.to_lowercase().as_str()))
        {
            Rank::Named
        } else if own.is_empty() && part == 0 {
            Rank::First
        } else {
            Rank::Other
        };
        Some(Layer {
            name,
            part,
            channels: colors.or(xyz).or(gray)?,
            is_xyz: colors.is_none() && xyz.is_some(),
            rank,
        })
    };
    by_layer.into_iter().filter_map(layer).collect()
}

/// The name of a channel within its layer, in lower case.
fn last_word(name: &str) -> String {
    let word = name.rsplit_once('.').map_or(name, |(_, word)| word);
    word.to_lowercase()
}

/// All channels, as many as a message has room for.
fn names_of(headers: &[Header]) -> String {
    let mut names = String::new();
    for channel in headers.iter().flat_map(|header| &header.channels.list) {
        if names.len() > MOST_NAMES {
            return names + ", …";
        }
        if !names.is_empty() {
            names += ", ";
        }
        names += &channel.name.to_string();
    }
    names
}
