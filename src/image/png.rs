//! PNG: eight bits per channel, sRGB, with the facts of the frame as text chunks.
//!
//! Plain ASCII text goes into tEXt chunks, other text into iTXt. pHYs states square pixels of no
//! particular size.

use super::error::check_length;
use super::{EncodeError, FINGERPRINT, Metadata};
use crate::film::Channels;

/// The bytes of a PNG file.
///
/// # Errors
/// If a side is zero, if `rgb8` is not three bytes for each pixel, or if the encoder fails (a text
/// of 2 GiB, for example).
pub fn encode(
    width: u32,
    height: u32,
    rgb8: &[u8],
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    check_length("the picture", (width, height), 3, rgb8.len())?;
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.set_pixel_dims(Some(::png::PixelDimensions {
        xppu: 1,
        yppu: 1,
        unit: ::png::Unit::Unspecified,
    }));
    for (keyword, text) in texts(metadata) {
        // NUL ends a text in both kinds of chunk.
        let text = text.replace('\0', "\u{fffd}");
        if text.is_ascii() {
            encoder.add_text_chunk(keyword.to_owned(), text)?;
        } else {
            encoder.add_itxt_chunk(keyword.to_owned(), text)?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb8)?;
    writer.finish()?;
    Ok(bytes)
}

/// Keywords and texts, in a fixed order.
fn texts(metadata: &Metadata) -> impl Iterator<Item = (&'static str, String)> {
    let Metadata {
        software,
        comments,
        owner,
        worldlines,
        fingerprint,
        shot,
        ..
    } = metadata;
    let number = |value: Option<f64>| value.map(|value| value.to_string());
    let window = metadata.window_nm.map(|[from, to]| format!("{from} {to}"));
    let bands = (metadata.channels == Channels::Bands).then(|| "bands".to_owned());
    let beta = metadata.beta.map(|[x, y, z]| format!("{x} {y} {z}"));
    let names = (!worldlines.is_empty()).then(|| serde_json::json!(worldlines).to_string());
    [
        ("Software", software.clone()),
        ("Comment", comments.clone()),
        ("Author", owner.clone()),
        (
            "restframe:frame",
            metadata.frame.map(|frame| frame.to_string()),
        ),
        ("restframe:time", number(metadata.time_s)),
        ("restframe:beta", beta),
        ("restframe:gamma", number(metadata.lorentz_factor)),
        ("restframe:color", bands),
        ("restframe:window", window),
        ("restframe:exposure", number(metadata.exposure_stops)),
        (
            "restframe:samples",
            metadata
                .samples_per_pixel
                .map(|samples| samples.to_string()),
        ),
        ("restframe:worldlines", names),
        (FINGERPRINT, fingerprint.clone()),
        ("restframe:shot", shot.clone()),
    ]
    .into_iter()
    .filter_map(|(keyword, text)| text.map(|text| (keyword, text)))
}
