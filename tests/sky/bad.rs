//! Files that are no skies: each is told at its key, and no damage makes the reader panic.

use super::{Folder, looking};
use restframe::scene::sky::SkyImage;

/// The mistakes that a background brings, as told.
fn told(folder: &Folder, sky: &str) -> String {
    match folder.shot(1, &looking(0.0, 0.0, sky)) {
        Ok(_) => panic!("{sky} is taken"),
        Err(mistakes) => {
            let keys: Vec<&str> = mistakes.iter().map(|m| m.key.as_str()).collect();
            assert!(
                keys.iter().all(|key| key.starts_with("background")),
                "{keys:?}"
            );
            mistakes.iter().map(|m| m.message.clone() + "\n").collect()
        }
    }
}

fn samples(folder: &Folder) -> [Vec<u8>; 3] {
    let color = |x: u32, y: u32| [x as f32 / 7.0, y as f32 / 3.0, 0.3];
    ["sky.hdr", "sky.exr", "sky.png"].map(|name| {
        if name == "sky.png" {
            let byte = |x, y| image::Rgb(color(x, y).map(|v| (200.0 * v) as u8));
            image::RgbImage::from_fn(8, 4, byte)
                .save(folder.path(name))
                .unwrap();
        } else {
            folder.paint(name, [8, 4], color);
        }
        std::fs::read(folder.path(name)).unwrap()
    })
}

#[test]
fn a_broken_image_is_told_at_its_key() {
    let folder = Folder::new();
    let [hdr, exr, png] = samples(&folder);
    // Chunk lengths and sums stand, so that only the size is wrong.
    let mut huge_png = png.clone();
    huge_png[16..24].copy_from_slice(&[0, 0, 0x80, 1, 0, 0, 0x40, 0]);
    let sum = crc(&huge_png[12..29]);
    huge_png[29..33].copy_from_slice(&sum.to_be_bytes());
    let huge_hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n".to_vec();
    for (bytes, message) in [
        (hdr[..hdr.len() - 9].to_vec(), "broken"),
        (exr[..exr.len() / 2].to_vec(), "broken"),
        (png[..png.len() / 2].to_vec(), "broken"),
        (exr[..20].to_vec(), "broken"),
        (png[..9].to_vec(), "broken"),
        (b"#?RADIANCE\n".to_vec(), "broken"),
        (b"#?RGBE\n\n-Y 1 +X 1\n".to_vec(), "broken"),
        (Vec::new(), "an empty file"),
        (
            b"GIF89a".to_vec(),
            "expected Radiance HDR (#?RADIANCE), OpenEXR or PNG",
        ),
        (huge_png, "32769 x 16384 pixels"),
        (huge_hdr, "16384 x 16384 pixels"),
        (
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 4\n".to_vec(),
            "4 x 0 pixels",
        ),
    ] {
        folder.write("bad.hdr", bytes);
        let told = told(&folder, "image = \"bad.hdr\"");
        assert!(told.contains(message), "{told} lacks {message}");
    }
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    assert!(told(&folder, "image = \"folder.png\"").contains("is not a file"));
    assert!(told(&folder, "image = \"none.exr\"").contains("there is no file \"none.exr\""));
}

/// The checksum of PNG chunks (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 * (crc & 1))
        })
    })
}

#[test]
fn a_long_header_before_nothing_is_refused_in_no_time() {
    let text = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n";
    let begun = std::time::Instant::now();
    assert!(SkyImage::decode(text).is_err());
    assert!(begun.elapsed().as_secs_f64() < 2.0, "{:?}", begun.elapsed());
}

#[test]
fn a_bad_catalogue_is_told_at_its_key() {
    let folder = Folder::new();
    for (text, message) in [
        (&b""[..], "there is no star in it"),
        (
            b"azimuth_deg,elevation_deg,temperature_K,magnitude\n1,2,3\n",
            "line 2",
        ),
        (b"1,2,5000,x\n", "the magnitude is `x`"),
        (b"1,2,-5000,1\n", "the temperature is `-5000`"),
        (b"1,2,5000,\xff\n", "UTF-8"),
        (b"a\n1,2,5000,1 # 20 \xb0C\n", "line 2 has the byte 0xB0"),
        (b"\xff\xfe1\0,\x002\0", "is UTF-16 text"),
    ] {
        folder.write("stars.csv", text);
        let told = told(&folder, "stars = { file = \"stars.csv\" }");
        assert!(told.contains(message), "{told} lacks {message}");
    }
    folder.write("stars.csv", "\"az\";el;K;m\r\"1,5\";2;5000;1,25;\r");
    let stars = looking(0.0, 0.0, "stars = { file = \"stars.csv\" }");
    assert!(folder.shot(1, &stars).is_ok());
    let nowhere = told(&folder, "stars = { file = \"none.csv\" }");
    assert!(nowhere.contains("there is no file"));
    for (keys, message) in [
        ("count = 0", "count"),
        ("count = 1000001", "count"),
        ("count = 3, size = 0", "size"),
        ("count = 3, seed = 4294967296", "seed"),
        (
            "count = 3, temperature = [9000, 3000]",
            "begins at 9000 and ends at 3000",
        ),
        ("count = 3, temperature = [10, 3000]", "temperature"),
        ("count = 3, magnitude = [1]", "magnitude"),
        ("count = 3, colour = 1", "colour"),
    ] {
        let told = told(&folder, &format!("stars = {{ {keys} }}"));
        assert!(told.contains(message), "{told} lacks {message}");
    }
}

#[test]
fn texels_that_are_no_light_are_warned_of_once() {
    let folder = Folder::new();
    folder.paint("sky.exr", [4, 2], |x, _| [-0.5, f32::NAN, x as f32]);
    let prepared = folder
        .shot(1, &looking(0.0, 0.0, "image = \"sky.exr\""))
        .unwrap();
    let warnings: Vec<_> = prepared.library.warnings(&prepared.shot).collect();
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].1.starts_with("16 components"), "{warnings:?}");
}

#[test]
fn no_damaged_byte_makes_the_reader_panic() {
    let folder = Folder::new();
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % below
    };
    let mut survived = 0;
    for sample in samples(&folder) {
        for _ in 0..1500 {
            let mut bytes = sample.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                bytes[at] = random(256) as u8;
            }
            bytes.truncate(bytes.len() - random(2) * random(bytes.len()));
            if let Ok(image) = SkyImage::decode(&bytes) {
                let rgb = image.rgb(glam::DVec3::X);
                assert!(rgb.iter().all(|v| v.is_finite() && *v >= 0.0));
                survived += 1;
            }
        }
    }
    println!("{survived} of 4500 were read");
}
