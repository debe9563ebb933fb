//! Picture files read back by generic readers, and their bytes written twice.

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels, ReadLayers, Text, Vec2};
use restframe::film::{Channels, Developed, Layers};
use restframe::image::exr::{self as exr_file, Depth};
use restframe::image::{EncodeError, Metadata, SOFTWARE, png as png_file};
use std::io::Cursor;

const WIDTH: u32 = 37;
const HEIGHT: u32 = 21;
const SHOT: &str = "[shot]\ntitle = \"Würfel γ → ∞\"\n";

fn pixels() -> usize {
    (WIDTH * HEIGHT) as usize
}

fn developed() -> Developed {
    let value = |i: usize| i as f32 * 0.37 - 3.0;
    let mut linear: Vec<_> = (0..pixels())
        .map(|i| [value(i), value(i) * 1e-9, value(i) * 1e30])
        .collect();
    linear[0] = [f32::MAX, -f32::MAX, f32::MIN_POSITIVE];
    Developed {
        linear,
        saturated: 0,
    }
}

fn layers() -> Layers {
    let ramp = |scale: f32| Some((0..pixels()).map(|i| i as f32 * scale).collect());
    Layers {
        doppler: ramp(0.01),
        distance: ramp(3.0),
        emission_time: ramp(-3.0),
        worldline: Some(vec![-1.0; pixels()]),
    }
}

fn metadata() -> Metadata {
    let mut camera_from_world = [0.0; 16];
    for index in [0, 5, 10, 15] {
        camera_from_world[index] = 1.0;
    }
    camera_from_world[12..15].copy_from_slice(&[1.0, 2.0, -12.0]);
    Metadata {
        software: Some(SOFTWARE.into()),
        comments: Some("Würfel γ → ∞".into()),
        owner: None,
        frames_per_second: Some(23.976),
        camera_from_world: Some(camera_from_world),
        ndc_from_world: Some(camera_from_world),
        channels: Channels::Xyz,
        window_nm: None,
        exposure_stops: Some(1.0),
        samples_per_pixel: Some(16),
        frame: Some(3),
        beta: Some([0.5, 0.0, -0.25]),
        lorentz_factor: Some(1e6),
        time_s: Some(-11.5),
        worldlines: vec!["lab".into(), "Züge, fast".into()],
        fingerprint: Some("0123abcd".into()),
        shot: Some(SHOT.into()),
    }
}

fn exr_bytes(metadata: &Metadata) -> Vec<u8> {
    exr_bytes_of(Depth::Float, metadata)
}

fn exr_bytes_of(depth: Depth, metadata: &Metadata) -> Vec<u8> {
    exr_file::encode(WIDTH, HEIGHT, &developed(), depth, &layers(), metadata).expect("encodes")
}

/// Names, samples and size of an EXR's channels, read back.
fn exr_channels(bytes: Vec<u8>) -> (Vec<(String, FlatSamples)>, Vec2<usize>) {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .expect("reads");
    let channels = image.layer_data.channel_data.list.into_iter();
    let channels = channels.map(|channel| (channel.name.to_string(), channel.sample_data));
    (channels.collect(), image.layer_data.size)
}

/// What was written to a channel.
fn expected(name: &str) -> Vec<f32> {
    match ["R", "G", "B"].iter().position(|&color| color == name) {
        Some(index) => developed().linear.iter().map(|rgb| rgb[index]).collect(),
        None => layers()
            .named()
            .find(|layer| layer.0 == name)
            .expect("a layer")
            .1
            .to_vec(),
    }
}

fn png_bytes(metadata: &Metadata) -> Vec<u8> {
    let rgb8: Vec<u8> = (0..pixels() * 3).map(|i| (i * 7) as u8).collect();
    png_file::encode(WIDTH, HEIGHT, &rgb8, metadata).expect("encodes")
}

#[test]
fn an_exr_gives_back_every_float_under_its_channel() {
    let (channels, size) = exr_channels(exr_bytes(&metadata()));
    let names: Vec<&str> = channels.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "B",
            "G",
            "R",
            "distance",
            "doppler",
            "emission_time",
            "worldline"
        ]
    );
    assert_eq!(size, Vec2(WIDTH as usize, HEIGHT as usize));
    for (name, samples) in &channels {
        let found: Vec<f32> = samples.values_as_f32().collect();
        assert_eq!(found, expected(name), "{name}");
    }
}

#[test]
fn a_half_exr_gives_back_colors_to_eleven_bits_and_layers_as_they_are() {
    let (channels, _) = exr_channels(exr_bytes_of(Depth::Half, &metadata()));
    for (name, samples) in channels {
        let found: Vec<f32> = samples.values_as_f32().collect();
        if name.len() > 1 {
            assert!(matches!(samples, FlatSamples::F32(_)), "{name}");
            assert_eq!(found, expected(&name), "{name}");
            continue;
        }
        assert!(matches!(samples, FlatSamples::F16(_)), "{name}");
        for (found, written) in found.into_iter().zip(expected(&name)) {
            // IEEE 754 binary16: 11 bits of significand, nothing finer than 2⁻²⁴, nothing beyond
            // 65504 = 2¹⁶ − 2⁵; rounded to nearest, hence half of the last digit.
            let kept = f64::from(written).clamp(-65504.0, 65504.0);
            let half_a_digit = (kept.abs() * 0.5_f64.powi(11)).max(0.5_f64.powi(25));
            let error = (f64::from(found) - kept).abs();
            assert!(
                error <= half_a_digit,
                "{name}: {written:e} became {found:e}"
            );
        }
    }
}

#[test]
fn what_a_half_cannot_hold_is_clamped_and_counted_once() {
    let rim = [
        65504.0_f32,
        65505.0,
        -65519.9,
        65520.0,
        1e38,
        -65504.0,
        f32::MAX, // clamped and counted when developed
        6e-8,     // 2⁻²⁴ to nearest: the least there is
        -2e-8,    // nearer to 0
    ];
    let developed = Developed {
        linear: vec![
            [rim[0], rim[1], rim[2]],
            [rim[3], rim[4], rim[5]],
            [rim[6], rim[7], rim[8]],
        ],
        saturated: 1,
    };
    assert_eq!(exr_file::clamped(&developed, Depth::Half), 4);
    assert_eq!(exr_file::clamped(&developed, Depth::Float), 0);
    let none = (Layers::default(), Metadata::default());
    let bytes = exr_file::encode(3, 1, &developed, Depth::Half, &none.0, &none.1).expect("encodes");
    let (channels, _) = exr_channels(bytes);
    let found = |pixel: usize, color: usize| {
        let at = 2 - color; // B, G, R
        channels[at].1.value_by_flat_index(pixel).to_f32()
    };
    let found: Vec<f32> = (0..9).map(|i| found(i / 3, i % 3)).collect();
    let (most, least) = (65504.0, 0.5_f32.powi(24));
    assert_eq!(
        found,
        [most, most, -most, most, most, -most, most, least, 0.0]
    );
}

#[test]
fn a_half_exr_is_smaller_and_tells_as_much() {
    let [float, half] = [Depth::Float, Depth::Half].map(|depth| exr_bytes_of(depth, &metadata()));
    assert!(half.len() < float.len(), "{} {}", half.len(), float.len());
    let [float, half] = [float, half].map(|bytes| {
        let read = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), true);
        let read = read.expect("reads");
        let header = &read.headers[0];
        (
            header.own_attributes.clone(),
            header.shared_attributes.clone(),
        )
    });
    assert_eq!(half, float);
}

#[test]
fn an_exr_tells_everything_that_was_decided_about_the_frame() {
    let bytes = exr_bytes(&metadata());
    let read = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), true).expect("reads");
    let header = &read.headers[0];
    let own = &header.own_attributes;
    let text = |text: &Option<Text>| text.as_ref().map(|text| text.bytes().to_vec());
    assert_eq!(text(&own.software_name), Some(SOFTWARE.into()));
    assert_eq!(text(&own.comments), Some("Würfel γ → ∞".into()));
    assert_eq!(own.owner, None);
    assert_eq!(own.frames_per_second, Some((24_000, 1001)));
    assert_eq!(
        own.world_to_camera.map(|matrix| matrix[12..15].to_vec()),
        Some(vec![1., 2., -12.])
    );
    assert!(own.world_to_normalized_device.is_some());
    assert_eq!(own.white_luminance, Some(50.0));
    assert_eq!(own.adopted_neutral, Some(Vec2(0.3127, 0.329)));
    assert!(header.shared_attributes.chromaticities.is_some());
    let free = |name: &str| own.other.get(name.as_bytes()).cloned();
    let string = |text: &str| AttributeValue::Text(Text::from_slice_unchecked(text.as_bytes()));
    for (name, expected) in [
        ("colorInteropID", string("lin_rec709_scene")),
        ("samplesPerPixel", AttributeValue::I32(16)),
        ("restframe:frame", AttributeValue::I32(3)),
        ("restframe:time", AttributeValue::F64(-11.5)),
        (
            "restframe:beta",
            AttributeValue::FloatVec3((0.5, 0.0, -0.25)),
        ),
        ("restframe:gamma", AttributeValue::F64(1e6)),
        ("restframe:exposure", AttributeValue::F64(1.0)),
        ("restframe:fingerprint", string("0123abcd")),
        ("restframe:shot", string(SHOT)),
    ] {
        assert_eq!(free(name), Some(expected), "{name}");
    }
    let Some(AttributeValue::TextVector(names)) = free("restframe:worldlines") else {
        panic!("no list of worldlines");
    };
    let names: Vec<_> = names.iter().map(|name| name.bytes()).collect();
    assert_eq!(names, ["lab".as_bytes(), "Züge, fast".as_bytes()]);
}

#[test]
fn files_of_bands_claim_no_color() {
    let metadata = Metadata {
        channels: Channels::Bands,
        window_nm: Some([4000.0, 14000.5]),
        ..metadata()
    };
    let bytes = exr_bytes(&metadata);
    let read = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), true).expect("reads");
    let header = &read.headers[0];
    let own = &header.own_attributes;
    assert!(header.shared_attributes.chromaticities.is_none());
    assert_eq!((own.white_luminance, own.adopted_neutral), (None, None));
    let free = |name: &str| own.other.get(name.as_bytes()).cloned();
    let string = |text: &str| {
        Some(AttributeValue::Text(Text::from_slice_unchecked(
            text.as_bytes(),
        )))
    };
    assert_eq!(free("colorInteropID"), string("data"));
    assert_eq!(free("restframe:color"), string("bands"));
    let window = AttributeValue::FloatVec2(Vec2(4000.0, 14000.5));
    assert_eq!(free("restframe:window"), Some(window));
    assert_eq!(free("restframe:exposure"), Some(AttributeValue::F64(1.0)));

    let reader = png::Decoder::new(Cursor::new(png_bytes(&metadata)));
    let info = reader.read_info().expect("reads").info().clone();
    let text = |keyword: &str| {
        let mut texts = info.uncompressed_latin1_text.iter();
        texts
            .find(|chunk| chunk.keyword == keyword)
            .map(|chunk| chunk.text.clone())
    };
    assert_eq!(text("restframe:color").as_deref(), Some("bands"));
    assert_eq!(text("restframe:window").as_deref(), Some("4000 14000.5"));
}

#[test]
fn what_is_not_given_is_not_written() {
    let bytes = exr_bytes(&Metadata::default());
    let read = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), true).expect("reads");
    let other = &read.headers[0].own_attributes.other;
    assert_eq!(other.len(), 1, "{other:?}");
    let reader = png::Decoder::new(Cursor::new(png_bytes(&Metadata::default())));
    let info = reader.read_info().expect("reads").info().clone();
    assert!(info.uncompressed_latin1_text.is_empty() && info.utf8_text.is_empty());
}

#[test]
fn a_png_gives_back_every_byte_and_says_what_they_mean() {
    let mut reader = png::Decoder::new(Cursor::new(png_bytes(&metadata())))
        .read_info()
        .expect("reads");
    let mut rgb8 = vec![0; reader.output_buffer_size().expect("small")];
    let frame = reader.next_frame(&mut rgb8).expect("reads");
    assert_eq!((frame.width, frame.height), (WIDTH, HEIGHT));
    assert_eq!(
        (frame.color_type, frame.bit_depth),
        (png::ColorType::Rgb, png::BitDepth::Eight)
    );
    assert!(
        rgb8.iter()
            .enumerate()
            .all(|(i, &byte)| byte == (i * 7) as u8)
    );

    let info = reader.info();
    assert!(info.srgb.is_some());
    assert_eq!(
        info.pixel_dims.map(|dims| (dims.xppu, dims.yppu)),
        Some((1, 1))
    );
    let plain = info.uncompressed_latin1_text.iter();
    let plain = plain.map(|chunk| (chunk.keyword.clone(), chunk.text.clone()));
    let wide = info.utf8_text.iter();
    let wide = wide.map(|chunk| (chunk.keyword.clone(), chunk.get_text().expect("plain")));
    let texts: Vec<_> = plain.chain(wide).collect();
    for (keyword, text) in [
        ("Software", SOFTWARE),
        ("Comment", "Würfel γ → ∞"),
        ("restframe:frame", "3"),
        ("restframe:time", "-11.5"),
        ("restframe:beta", "0.5 0 -0.25"),
        ("restframe:gamma", "1000000"),
        ("restframe:exposure", "1"),
        ("restframe:samples", "16"),
        ("restframe:worldlines", "[\"lab\",\"Züge, fast\"]"),
        ("restframe:fingerprint", "0123abcd"),
        ("restframe:shot", SHOT),
    ] {
        assert!(
            texts.contains(&(keyword.into(), text.into())),
            "{keyword}: {texts:?}"
        );
    }
}

#[test]
fn equal_pictures_give_equal_bytes_for_any_number_of_threads() {
    let all = || {
        let exr = [Depth::Float, Depth::Half].map(|depth| exr_bytes_of(depth, &metadata()));
        (exr, png_bytes(&metadata()))
    };
    let expected = all();
    for threads in [1, 2, 2, 1] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        assert!(pool.install(all) == expected, "{threads} threads");
    }
}

#[test]
fn sizes_that_do_not_fit_are_refused() {
    let metadata = Metadata::default();
    let none = Layers::default();
    for (width, height) in [(0, 0), (0, 5), (5, 0), (6, 5), (u32::MAX, u32::MAX)] {
        assert!(png_file::encode(width, height, &[0; 75], &metadata).is_err());
        assert!(
            exr_file::encode(width, height, &developed(), Depth::Half, &none, &metadata).is_err()
        );
    }
    let short = Layers {
        doppler: Some(vec![0.0; 3]),
        ..Layers::default()
    };
    let error = exr_file::encode(WIDTH, HEIGHT, &developed(), Depth::Float, &short, &metadata);
    assert!(matches!(
        error,
        Err(EncodeError::Length {
            what: "doppler",
            found: 3,
            ..
        })
    ));
}

#[test]
fn a_nul_in_a_text_does_not_end_it() {
    let metadata = Metadata {
        comments: Some("a\0b".into()),
        ..Metadata::default()
    };
    let reader = png::Decoder::new(Cursor::new(png_bytes(&metadata)))
        .read_info()
        .expect("reads");
    assert_eq!(
        reader.info().utf8_text[0].get_text().expect("plain"),
        "a\u{fffd}b"
    );
    assert!(!exr_bytes(&metadata).is_empty());
}
