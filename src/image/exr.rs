//! OpenEXR: linear Rec. 709, or the radiance of three bands, with the film's layers and the facts
//! of the frame.
//!
//! One part, ZIP in blocks of 16 rows. Channels R, G, B in floats of a [`Depth`], and one of 32
//! bits for each layer under its plain name: `distance`, `doppler`, `emission_time`, `worldline`
//! (units: [`Layers`]). Text is UTF-8. Sources of the attributes: the OpenEXR standard attributes
//! (openexr.com), `samplesPerPixel` as pbrt writes it, `colorInteropID` of the Color Interop Forum;
//! our own begin with `restframe:`.
//!
//! Equal input gives equal bytes. The encoder keeps free attributes in a hash map and writes them
//! in an order that differs from run to run, so they are sorted by name afterward. Blocks are
//! compressed on the calling thread, because the encoder would otherwise start threads beside those
//! that were asked for.

use super::error::check_length;
use super::{EncodeError, FINGERPRINT, Metadata};
use crate::film::{Channels, Developed, Layers};
use ::exr::meta::attribute::Chromaticities;
use ::exr::prelude::*;
use std::io::Cursor;

/// Rec. ITU-R BT.709-6 (2015), item 1.3 and 1.4: primaries and white, x and y.
const REC709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: D65,
};
const D65: Vec2<f32> = Vec2(0.3127, 0.3290);

/// Number format of the channels R, G, B.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Depth {
    /// 32 bits per value, as developed.
    #[default]
    Float,
    /// 16 bits per value, IEEE 754 binary16: to 2⁻¹¹ of the value from 2⁻¹⁴ to 65504, to 2⁻²⁵
    /// below.
    Half,
}

impl Depth {
    /// The largest value of the format.
    pub fn largest(self) -> f32 {
        match self {
            Self::Float => f32::MAX,
            Self::Half => f16::MAX.to_f32(),
        }
    }
}

/// Number of values of the image beyond the largest of `depth`, to which [`encode`] clamps them.
/// Those at ±`f32::MAX` are not counted: they are in [`Developed::saturated`].
pub fn clamped(developed: &Developed, depth: Depth) -> u64 {
    let beyond = |value: f32| value > depth.largest() && value < f32::MAX;
    let values = developed.linear.iter().flatten();
    values.filter(|value| beyond(value.abs())).count() as u64
}

/// The bytes of an EXR file, with colors rounded to the nearest value of `depth`.
///
/// # Errors
/// If a side is zero, if the image or a layer does not have one value for each pixel, or if the
/// encoder fails.
pub fn encode(
    width: u32,
    height: u32,
    developed: &Developed,
    depth: Depth,
    layers: &Layers,
    metadata: &Metadata,
) -> std::result::Result<Vec<u8>, EncodeError> {
    let mut channels = SmallVec::new();
    check_length("the picture", (width, height), 1, developed.linear.len())?;
    for (index, name) in ["R", "G", "B"].into_iter().enumerate() {
        let plane = developed.linear.iter().map(|rgb| rgb[index]);
        channels.push(AnyChannel::new(name, samples(plane, depth)));
    }
    for (name, values) in layers.named() {
        check_length(name, (width, height), 1, values.len())?;
        channels.push(AnyChannel::new(name, FlatSamples::F32(values.to_vec())));
    }

    let size = Vec2(width as usize, height as usize);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(
        size,
        attributes(metadata),
        encoding,
        AnyChannels::sort(channels),
    );
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = is_color(metadata).then_some(REC709);

    let mut file = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut file)?;
    let mut bytes = file.into_inner();
    sort_attributes(&mut bytes)
        .ok_or_else(|| Error::Invalid("the header just written cannot be read again".into()))?;
    Ok(bytes)
}

fn samples(plane: impl Iterator<Item = f32>, depth: Depth) -> FlatSamples {
    let largest = depth.largest();
    match depth {
        Depth::Float => FlatSamples::F32(plane.collect()),
        Depth::Half => {
            let half = |value: f32| f16::from_f32(value.clamp(-largest, largest));
            FlatSamples::F16(plane.map(half).collect())
        }
    }
}

fn is_color(metadata: &Metadata) -> bool {
    metadata.channels == Channels::Xyz
}

fn attributes(metadata: &Metadata) -> LayerAttributes {
    let mut attributes = LayerAttributes {
        software_name: metadata.software.as_deref().map(text),
        comments: metadata.comments.as_deref().map(text),
        owner: metadata.owner.as_deref().map(text),
        frames_per_second: metadata.frame_rate(),
        world_to_camera: metadata
            .camera_from_world
            .map(|matrix| matrix.map(|x| x as f32)),
        world_to_normalized_device: metadata
            .ndc_from_world
            .map(|matrix| matrix.map(|x| x as f32)),
        white_luminance: metadata.white_luminance(),
        adopted_neutral: is_color(metadata).then_some(D65),
        ..LayerAttributes::default()
    };
    let free = free_attributes(metadata).into_iter();
    attributes.other = free
        .filter_map(|(name, value)| Some((text(name), value?)))
        .collect();
    attributes
}

/// Attributes for which OpenEXR has no field.
fn free_attributes(metadata: &Metadata) -> [(&'static str, Option<AttributeValue>); 12] {
    use AttributeValue::{F64, FloatVec2, FloatVec3, I32, Text, TextVector};
    let whole = |value: u32| I32(i32::try_from(value).unwrap_or(i32::MAX));
    let vector = |[x, y, z]: [f64; 3]| FloatVec3((x as f32, y as f32, z as f32));
    let names = || TextVector(metadata.worldlines.iter().map(|name| text(name)).collect());
    let window = |nm: [f64; 2]| FloatVec2(Vec2(nm[0] as f32, nm[1] as f32));
    let (interop, color) = match metadata.channels {
        Channels::Xyz => ("lin_rec709_scene", None),
        Channels::Bands => ("data", Some("bands")),
    };
    [
        ("colorInteropID", Some(Text(text(interop)))),
        ("restframe:color", color.map(|color| Text(text(color)))),
        ("restframe:window", metadata.window_nm.map(window)),
        ("samplesPerPixel", metadata.samples_per_pixel.map(whole)),
        ("restframe:frame", metadata.frame.map(whole)),
        ("restframe:time", metadata.time_s.map(F64)),
        ("restframe:beta", metadata.beta.map(vector)),
        ("restframe:gamma", metadata.lorentz_factor.map(F64)),
        ("restframe:exposure", metadata.exposure_stops.map(F64)),
        (
            "restframe:worldlines",
            (!metadata.worldlines.is_empty()).then(names),
        ),
        (
            FINGERPRINT,
            metadata.fingerprint.as_deref().map(|hash| Text(text(hash))),
        ),
        (
            "restframe:shot",
            metadata.shot.as_deref().map(|shot| Text(text(shot))),
        ),
    ]
}

/// UTF-8 text unchanged: the crate's own conversion knows Latin-1 only and refuses the rest.
fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

/// Sorts the header's attributes by name, in place: their total length stays, and so does every
/// offset in the file. None if the bytes are not a header.
///
/// A file begins with four bytes of magic and four of version; an attribute is name, NUL, type,
/// NUL, length (little-endian, 4 bytes), value; an empty name ends the header.
fn sort_attributes(file: &mut [u8]) -> Option<()> {
    const PREAMBLE: usize = 8;
    let header = file.get(PREAMBLE..)?;
    let mut attributes: Vec<&[u8]> = Vec::new();
    let mut rest = header;
    while *rest.first()? != 0 {
        let name = rest.iter().position(|&byte| byte == 0)? + 1;
        let kind = rest.get(name..)?.iter().position(|&byte| byte == 0)? + 1;
        let (size, _) = rest.get(name + kind..)?.split_first_chunk::<4>()?;
        let length = name + kind + 4 + u32::from_le_bytes(*size) as usize;
        let (attribute, after) = rest.split_at_checked(length)?;
        attributes.push(attribute);
        rest = after;
    }
    // Names differ and end with NUL, so comparing whole attributes compares names.
    attributes.sort_unstable();
    let sorted = attributes.concat();
    file.get_mut(PREAMBLE..PREAMBLE + sorted.len())?
        .copy_from_slice(&sorted);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_are_sorted_in_place_and_the_rest_is_left() {
        let header = |names: [&str; 3]| {
            let mut bytes = b"magiversion".to_vec();
            bytes.truncate(8);
            for name in names {
                bytes.extend(name.bytes());
                bytes.extend(b"\0int\0\x04\0\0\0");
                bytes.extend(7_i32.to_le_bytes());
            }
            bytes.extend(b"\0pixels");
            bytes
        };
        let mut file = header(["b", "ab", "a"]);
        assert!(sort_attributes(&mut file).is_some());
        assert_eq!(file, header(["a", "ab", "b"]));
    }

    #[test]
    fn a_cut_header_is_noticed() {
        for cut in [
            "",
            "magi",
            "magivers",
            "magiversname",
            "magiversname\0int\0\u{1}\0\0\0",
        ] {
            assert!(
                sort_attributes(&mut cut.as_bytes().to_vec()).is_none(),
                "{cut:?}"
            );
        }
    }
}
