//! What a picture file says it is made of, read back; and whether all of it can be read.
//!
//! Files may be anybody's: what cannot be read is no picture, and no more memory is taken than a
//! header or some rows need.

use super::FINGERPRINT;
use ::exr::block::reader::ChunksReader;
use ::exr::meta::MetaData;
use ::exr::meta::attribute::AttributeValue;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The fingerprint in the header of a PNG or EXR file, by the file's extension.
pub fn fingerprint(path: &Path) -> Option<String> {
    if is_exr(path) {
        of_exr(&MetaData::read_from_file(path, false).ok()?)
    } else {
        let file = BufReader::new(File::open(path).ok()?);
        let reader = ::png::Decoder::new(file).read_info().ok()?;
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
    let Ok(file) = File::open(path) else {
        return false;
    };
    let file = BufReader::new(file);
    if is_exr(path) {
        whole_exr(file, size).is_some()
    } else {
        whole_png(file, size).is_some()
    }
}

fn whole_png(file: BufReader<File>, size: [u32; 2]) -> Option<()> {
    let mut reader = ::png::Decoder::new(file).read_info().ok()?;
    if [reader.info().width, reader.info().height] != size {
        return None;
    }
    while reader.next_row().ok()?.is_some() {}
    reader.finish().ok()
}

fn whole_exr(file: BufReader<File>, size: [u32; 2]) -> Option<()> {
    let reader = ::exr::block::read(file, false).ok()?;
    let [header] = reader.headers() else {
        return None;
    };
    let found = (header.layer_size.0, header.layer_size.1);
    if found != (size[0] as usize, size[1] as usize) {
        return None;
    }
    let chunks = reader.all_chunks(false).ok()?;
    chunks.decompress_sequential(false, |_, _| Ok(())).ok()
}

fn is_exr(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "exr")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Developed, Layers, Metadata, exr, png};
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
        let rgb8 = png::to_rgb8(&developed, |x| x);
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
