//! Reading back the fingerprint of an image file, and checking that the file can be decoded
//! completely.
//!
//! Files may come from anyone: one that cannot be read counts as no image, and takes no more memory
//! than a header, or an image of the expected size, needs.

use super::FINGERPRINT;
use super::decode::{self, MOST_METADATA, read_bytes};
use ::exr::meta::MetaData;
use ::exr::meta::attribute::AttributeValue;
use std::io::{BufReader, Read};
use std::path::Path;

/// The fingerprint in the header of a PNG or EXR file, by the file's extension.
pub fn fingerprint(path: &Path) -> Option<String> {
    let head = decode::open(path).ok()?.take(MOST_METADATA);
    if is_exr(path) {
        of_exr(&MetaData::read_from_unbuffered(head, false).ok()?)
    } else {
        let reader = ::png::Decoder::new(BufReader::new(head));
        let reader = reader.read_info().ok()?;
        let mut texts = reader.info().uncompressed_latin1_text.iter();
        let found = texts.find(|text| text.keyword == FINGERPRINT)?;
        Some(found.text.clone())
    }
}

fn of_exr(meta: &MetaData) -> Option<String> {
    let mut all = meta
        .headers
        .iter()
        .flat_map(|header| &header.own_attributes.other);
    all.find_map(|(name, value)| match value {
        AttributeValue::Text(text) if name.bytes() == FINGERPRINT.as_bytes() => {
            Some(text.to_string())
        }
        _ => None,
    })
}

/// Whether a PNG or EXR file is of this size and can be decoded to its last byte.
pub fn is_whole(path: &Path, size: [u32; 2]) -> bool {
    let decoded = read_bytes(path, size).and_then(|bytes| {
        if is_exr(path) {
            decode::exr(&bytes, size, |linear| linear)
        } else {
            decode::png(&bytes, size)
        }
    });
    decoded.is_ok()
}

fn is_exr(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "exr")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Developed, Layers, to_rgb8};
    use crate::image::{Metadata, exr, png};
    use std::fs;

    const SIZE: [u32; 2] = [40, 30];

    fn files(folder: &Path) -> [std::path::PathBuf; 2] {
        let metadata = Metadata {
            comments: Some("Größe".to_owned()),
            fingerprint: Some("0123abcd".to_owned()),
            ..Metadata::default()
        };
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let value = |i: usize| (i as f32 * 0.37).sin().abs();
        let developed = Developed {
            linear: (0..pixels)
                .map(|i| [0, 1, 2].map(|c| value(3 * i + c)))
                .collect(),
            saturated: 0,
        };
        let rgb8 = to_rgb8(&developed, |x| x);
        let bytes = [
            png::encode(SIZE[0], SIZE[1], &rgb8, &metadata).expect("small"),
            exr::encode(
                SIZE[0],
                SIZE[1],
                &developed,
                exr::Depth::Float,
                &Layers::default(),
                &metadata,
            )
            .expect("small"),
        ];
        let paths = ["a.png", "a.exr"].map(|name| folder.join(name));
        for (path, bytes) in paths.iter().zip(bytes) {
            fs::write(path, bytes).expect("writable");
        }
        paths
    }

    #[test]
    fn a_picture_tells_its_fingerprint_and_is_whole_in_its_size_alone() {
        let folder = tempfile::tempdir().expect("scratch folder");
        for path in files(folder.path()) {
            assert_eq!(fingerprint(&path).as_deref(), Some("0123abcd"), "{path:?}");
            assert!(is_whole(&path, SIZE), "{path:?}");
            assert!(!is_whole(&path, [40, 31]), "{path:?}");
            assert!(!is_whole(&path, [30, 40]), "{path:?}");
        }
    }

    #[test]
    fn a_picture_cut_anywhere_is_not_whole() {
        let folder = tempfile::tempdir().expect("scratch folder");
        for path in files(folder.path()) {
            let bytes = fs::read(&path).expect("readable");
            for cut in (0..bytes.len()).step_by(bytes.len() / 97 + 1) {
                fs::write(&path, &bytes[..cut]).expect("writable");
                assert!(!is_whole(&path, SIZE), "{path:?} cut to {cut}");
                let _ = fingerprint(&path);
            }
            fs::remove_file(&path).expect("there");
            assert!(!is_whole(&path, SIZE));
            assert_eq!(fingerprint(&path), None);
        }
    }
}
