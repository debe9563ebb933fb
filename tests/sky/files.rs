//! What files of skies say of themselves is heeded: colors, exposure, orientation, layers, shape.
//! Oracles are published matrices, the formats' definitions, and pictures written twice.

use super::{Folder, looking};
use exr::meta::attribute::{Chromaticities, EnvironmentMap, SampleType};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds,
    Layer, LayerAttributes, SmallVec, Vec2, WritableImage, f16,
};
use glam::DVec3;
use restframe::scene::sky::{SkyImage, SkyWarning};
use std::f64::consts::{PI, TAU};
use std::io::Cursor;

const SIZE: [usize; 2] = [8, 4];

/// What the direction of a texel's centre leaves of the texel beside it.
const ROUNDING: f64 = 1e-12;

/// Colors from 0 to 1, all different.
fn colors() -> Vec<[f32; 3]> {
    let part = |i: usize, by: usize| (i * by % 32) as f32 / 31.0;
    (0..32)
        .map(|i| [part(i, 1), part(i, 5), part(i, 11)])
        .collect()
}

/// The colors at the texels' centres, by rows from the top.
fn seen(image: &SkyImage) -> Vec<[f64; 3]> {
    let [width, height] = image.size();
    let texels = (0..width * height).map(|i| {
        let azimuth = ((i % width) as f64 + 0.5) / width as f64 * TAU - PI;
        let elevation = PI / 2.0 - ((i / width) as f64 + 0.5) / height as f64 * PI;
        let across = elevation.cos();
        let [x, z] = [azimuth.sin() * across, -azimuth.cos() * across];
        image.rgb(DVec3::new(x, elevation.sin(), z))
    });
    texels.collect()
}

/// An OpenEXR file of these channels, by rows of 8.
struct Exr {
    channels: Vec<(&'static str, Vec<f32>)>,
    chromaticities: Option<Chromaticities>,
    cube: bool,
    sample_type: SampleType,
    encoding: Encoding,
    /// Where the values begin in a picture of the usual size; None if they are all of it.
    at: Option<[i32; 2]>,
}

impl Exr {
    fn new(channels: Vec<(&'static str, Vec<f32>)>) -> Self {
        Self {
            channels,
            chromaticities: None,
            cube: false,
            sample_type: SampleType::F32,
            encoding: Encoding::FAST_LOSSLESS,
            at: None,
        }
    }

    fn rgb(texels: &[[f32; 3]]) -> Self {
        Self::new(named(["R", "G", "B"], texels))
    }

    fn bytes(self) -> Vec<u8> {
        parts(vec![("", self)])
    }

    /// The display window.
    fn window(&self) -> IntegerBounds {
        let rows = self.channels[0].1.len() / SIZE[0];
        let size = self.at.map_or([SIZE[0], rows], |_| SIZE);
        IntegerBounds::new((0, 0), (size[0], size[1]))
    }

    fn layer(self, name: &str) -> Layer<AnyChannels<FlatSamples>> {
        let [left, top] = self.at.unwrap_or_default();
        let width = SIZE[0] - left as usize;
        let size = Vec2(width, self.channels[0].1.len() / width);
        let own = LayerAttributes {
            layer_name: (!name.is_empty()).then(|| name.into()),
            layer_position: Vec2(left, top),
            environment_map: self.cube.then_some(EnvironmentMap::Cube),
            ..LayerAttributes::default()
        };
        let samples = |values: Vec<f32>| match self.sample_type {
            SampleType::F16 => FlatSamples::F16(values.into_iter().map(f16::from_f32).collect()),
            SampleType::F32 => FlatSamples::F32(values),
            SampleType::U32 => FlatSamples::U32(values.into_iter().map(|v| v as u32).collect()),
        };
        let channels = self.channels.into_iter();
        let channels = channels.map(|(name, values)| AnyChannel::new(name, samples(values)));
        let channels = AnyChannels::sort(channels.collect());
        Layer::new(size, own, self.encoding, channels)
    }
}

/// A file of these parts.
fn parts(parts: Vec<(&str, Exr)>) -> Vec<u8> {
    let shared = ImageAttributes {
        chromaticities: parts[0].1.chromaticities,
        ..ImageAttributes::new(parts[0].1.window())
    };
    let layers = parts.into_iter().map(|(name, part)| part.layer(name));
    let image = Image::from_layers(shared, layers.collect::<SmallVec<[_; 2]>>());
    let mut file = Cursor::new(Vec::new());
    let write = image.write().non_parallel();
    write.to_buffered(&mut file).unwrap();
    file.into_inner()
}

fn named(names: [&'static str; 3], texels: &[[f32; 3]]) -> Vec<(&'static str, Vec<f32>)> {
    let channel = |c: usize| texels.iter().map(|texel| texel[c]).collect();
    (0..3).map(|c| (names[c], channel(c))).collect()
}

/// A Radiance file of flat pixels: mantissas and a common exponent.
fn hdr(header: &str, resolution: &str, pixels: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = format!("{header}\n{resolution}\n").into_bytes();
    bytes.extend(pixels.iter().flatten());
    bytes
}

/// 32 pixels that no reader takes for a run: value / 128 is the color.
fn pixels() -> Vec<[u8; 4]> {
    (0..32).map(|i| [128 + i, 3 * i, 200, 129]).collect()
}

/// What [`pixels`] are, divided.
fn light(over: [f64; 3]) -> Vec<[f64; 3]> {
    let color = |p: &[u8; 4]| [0, 1, 2].map(|c| f64::from(p[c]) / 128.0 / over[c]);
    pixels().iter().map(color).collect()
}

fn apart(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    pairs.map(|(f, e)| (f - e).abs()).fold(0.0, f64::max)
}

fn decoded(bytes: &[u8]) -> SkyImage {
    SkyImage::decode(bytes).unwrap_or_else(|e| panic!("{e}"))
}

/// Warnings, in words.
fn said(image: &SkyImage) -> String {
    let warnings = image.warnings().iter();
    warnings.map(|warning| warning.to_string() + "\n").collect()
}

fn chromaticities(xy: [[f32; 2]; 4]) -> Option<Chromaticities> {
    let [red, green, blue, white] = xy.map(|[x, y]| Vec2(x, y));
    Some(Chromaticities {
        red,
        green,
        blue,
        white,
    })
}

/// A color space: chromaticities, and the matrix from linear Rec. 709.
struct Space {
    name: &'static str,
    xy: [[f32; 2]; 4],
    from_709: [[f64; 3]; 3],
}

/// Published matrices from linear Rec. 709: ITU-R BT.2087 (Rec. 2020), W3C CSS Color 4 (Display
/// P3), the Academy's with Bradford (AP1, AP0, as in colour-science), IEC 61966-2-1 (XYZ).
const SPACES: [Space; 5] = [
    Space {
        name: "Rec. 2020",
        xy: [
            [0.708, 0.292],
            [0.170, 0.797],
            [0.131, 0.046],
            [0.3127, 0.3290],
        ],
        from_709: [
            [0.6274, 0.3293, 0.0433],
            [0.0691, 0.9195, 0.0114],
            [0.0164, 0.0880, 0.8956],
        ],
    },
    Space {
        name: "Display P3",
        xy: [
            [0.680, 0.320],
            [0.265, 0.690],
            [0.150, 0.060],
            [0.3127, 0.3290],
        ],
        from_709: [
            [0.8225, 0.1774, 0.0],
            [0.0332, 0.9669, 0.0],
            [0.0171, 0.0724, 0.9108],
        ],
    },
    Space {
        name: "ACEScg",
        xy: [
            [0.713, 0.293],
            [0.165, 0.830],
            [0.128, 0.044],
            [0.32168, 0.33767],
        ],
        from_709: [
            [0.6131, 0.3395, 0.0474],
            [0.0702, 0.9164, 0.0135],
            [0.0206, 0.1096, 0.8698],
        ],
    },
    Space {
        name: "ACES AP0",
        xy: [
            [0.7347, 0.2653],
            [0.0, 1.0],
            [0.0001, -0.077],
            [0.32168, 0.33767],
        ],
        from_709: [
            [0.4396, 0.3830, 0.1774],
            [0.0898, 0.8134, 0.0968],
            [0.0175, 0.1115, 0.8709],
        ],
    },
    Space {
        name: "XYZ",
        xy: [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]],
        from_709: [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ],
    },
];

fn times(matrix: &[[f64; 3]; 3], color: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| (0..3).map(|c| row[c] * f64::from(color[c])).sum::<f64>() as f32)
}

#[test]
fn chromaticities_of_an_exr_are_converted_to_rec_709() {
    let expected: Vec<[f64; 3]> = colors().iter().map(|c| c.map(f64::from)).collect();
    for Space { name, xy, from_709 } in SPACES {
        let texels: Vec<[f32; 3]> = colors().iter().map(|c| times(&from_709, *c)).collect();
        let mut file = Exr::rgb(&texels);
        file.chromaticities = chromaticities(xy);
        let image = decoded(&file.bytes());
        let off = apart(&seen(&image), &expected);
        // Four digits, times what the inverse matrices make of them.
        assert!(off < 5e-4, "{name}: {off}");
        assert_eq!(said(&image), "", "{name}");
    }
    let mut same = Exr::rgb(&colors());
    same.chromaticities = chromaticities([[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]]);
    assert_eq!(
        decoded(&same.bytes()),
        decoded(&Exr::rgb(&colors()).bytes())
    );
}

#[test]
fn the_white_of_a_file_is_seen_white() {
    let whites = [[1.0; 3]; 32];
    let [rec709, e] = [
        [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]],
        [[0.7347, 0.2653], [0.2738, 0.7174], [0.1666, 0.0089]],
    ];
    for ([r, g, b], white) in [
        (rec709, [0.3457, 0.3585]),
        (rec709, [1.0 / 3.0; 2]),
        (e, [1.0 / 3.0; 2]),
    ] {
        let mut file = Exr::rgb(&whites);
        file.chromaticities = chromaticities([r, g, b, white]);
        let off = apart(&seen(&decoded(&file.bytes())), &[[1.0; 3]; 32]);
        assert!(off < 1e-6, "{white:?}: {off}");
    }
}

#[test]
fn colors_beyond_rec_709_keep_their_luminance_and_are_counted() {
    let mut texels = [[0.5; 3]; 32];
    texels[9] = [0.0, 1.0, 0.0];
    let mut file = Exr::rgb(&texels);
    file.chromaticities = chromaticities(SPACES[0].xy);
    let image = decoded(&file.bytes());
    let green = seen(&image)[9];
    // ITU-R BT.2020-2: Y of its green is 0.6780.
    let luminance = 0.2126 * green[0] + 0.7152 * green[1] + 0.0722 * green[2];
    assert!((luminance - 0.6780).abs() < 1e-3, "{green:?}");
    assert!(green[0] < 1e-6 && green[2] > 0.0, "{green:?}");
    assert_eq!(image.warnings(), [SkyWarning::Gamut { count: 1 }]);
}

#[test]
fn an_infinite_texel_is_the_greatest_finite_in_any_color_space() {
    for Space { name, xy, .. } in SPACES {
        let image = |sun: f32, hole: f32| {
            let mut texels = colors();
            texels[3][1] = 60000.0;
            texels[9] = [sun; 3];
            texels[20][2] = hole;
            let mut file = Exr::rgb(&texels);
            file.chromaticities = chromaticities(xy);
            decoded(&file.bytes())
        };
        let [found, expected] = [image(f32::INFINITY, f32::NAN), image(60000.0, 0.0)];
        assert_eq!(seen(&found), seen(&expected), "{name}");
        assert!(seen(&found)[9].iter().all(|v| *v > 1e4), "{name}");
        assert_eq!(found.warnings()[0], SkyWarning::Clamped { count: 4 });
        assert_eq!(found.warnings()[1..], *expected.warnings(), "{name}");
    }
}

#[test]
fn absurd_chromaticities_are_told_and_taken_for_rec_709() {
    let plain = seen(&decoded(&Exr::rgb(&colors()).bytes()));
    for xy in [
        [[0.0; 2]; 4],
        [[f32::NAN, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]],
        [[0.64, 0.33], [0.3, 0.6], [0.47, 0.465], [0.3127, 0.329]],
        [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.7, 0.2]],
        [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.0]],
    ] {
        let mut file = Exr::rgb(&colors());
        file.chromaticities = chromaticities(xy);
        let image = decoded(&file.bytes());
        assert_eq!(seen(&image), plain, "{xy:?}");
        assert!(said(&image).contains("taken for Rec. 709"), "{xy:?}");
    }
}

#[test]
fn the_picture_of_a_layered_exr_is_found() {
    let plain = seen(&decoded(&Exr::rgb(&colors()).bytes()));
    let other = [[0.1, 0.2, 0.3]; 32];
    let depth = || vec![("ViewLayer.Depth.Z", vec![5.0; 32])];
    let normal = || {
        named(
            [
                "ViewLayer.Normal.X",
                "ViewLayer.Normal.Y",
                "ViewLayer.Normal.Z",
            ],
            &other,
        )
    };
    let diffuse = || {
        named(
            [
                "ViewLayer.DiffCol.R",
                "ViewLayer.DiffCol.G",
                "ViewLayer.DiffCol.B",
            ],
            &other,
        )
    };
    let combined = || {
        named(
            [
                "ViewLayer.Combined.R",
                "ViewLayer.Combined.G",
                "ViewLayer.Combined.B",
            ],
            &colors(),
        )
    };
    for (channels, warning) in [
        ([combined(), depth(), normal(), diffuse()].concat(), ""),
        ([named(["R", "G", "B"], &colors()), diffuse()].concat(), ""),
        (named(["rgba.r", "rgba.g", "rgba.b"], &colors()), ""),
        (named(["red", "green", "blue"], &colors()), ""),
        (named(["lamp.R", "lamp.G", "lamp.B"], &colors()), "`lamp`"),
        (
            [
                combined(),
                named(["Z.Combined.R", "Z.Combined.G", "Z.Combined.B"], &other),
            ]
            .concat(),
            "`Z.Combined` could be too",
        ),
    ] {
        let names: Vec<&str> = channels.iter().map(|(name, _)| *name).collect();
        let image = decoded(&Exr::new(channels.clone()).bytes());
        assert_eq!(seen(&image), plain, "{names:?}");
        let said = said(&image);
        assert!(
            said.contains(warning) && said.is_empty() == warning.is_empty(),
            "{names:?}: {said}"
        );
    }
    for (channels, words) in [
        (
            [depth(), normal()].concat(),
            "ViewLayer.Depth.Z, ViewLayer.Normal.X",
        ),
        (
            [diffuse(), named(["b.R", "b.G", "b.B"], &other)].concat(),
            "several layers of colors, of which any could be the sky: ViewLayer.DiffCol, b",
        ),
        (
            vec![
                ("Y", vec![0.5; 32]),
                ("RY", vec![0.0; 32]),
                ("BY", vec![0.0; 32]),
            ],
            "luminance and chroma",
        ),
    ] {
        let error = SkyImage::decode(&Exr::new(channels).bytes()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert!(error.remedy().contains("R, G and B"), "{error}");
    }
}

#[test]
fn the_picture_of_an_exr_of_parts_is_found() {
    let plain = seen(&decoded(&Exr::rgb(&colors()).bytes()));
    let depth = || Exr::new(vec![("Z", vec![5.0; 32])]);
    let other = || Exr::rgb(&[[0.5; 3]; 32]);
    for (file, warning) in [
        (
            parts(vec![("depth", depth()), ("beauty", Exr::rgb(&colors()))]),
            "",
        ),
        (
            parts(vec![
                ("diffuse", other()),
                ("Combined", Exr::rgb(&colors())),
            ]),
            "",
        ),
        (
            parts(vec![("main", Exr::rgb(&colors())), ("diffuse", other())]),
            "`main`",
        ),
    ] {
        let image = decoded(&file);
        assert_eq!(seen(&image), plain);
        let said = said(&image);
        assert!(
            said.contains(warning) && said.is_empty() == warning.is_empty(),
            "{said}"
        );
    }
}

#[test]
fn tiles_are_put_together_and_what_the_data_window_leaves_out_is_black() {
    let plain = seen(&decoded(&Exr::rgb(&colors()).bytes()));
    let mut tiled = Exr::rgb(&colors());
    tiled.encoding.blocks = Blocks::Tiles(Vec2(3, 3));
    assert_eq!(seen(&decoded(&tiled.bytes())), plain);
    let mut window = Exr::rgb(&[[0.5; 3]; 12]);
    window.at = Some([2, 1]);
    let image = decoded(&window.bytes());
    assert_eq!(image.size(), SIZE);
    let inside = |i: usize| i % 8 >= 2 && (1..3).contains(&(i / 8));
    let expected: Vec<[f64; 3]> = (0..32)
        .map(|i| [if inside(i) { 0.5 } else { 0.0 }; 3])
        .collect();
    assert!(apart(&seen(&image), &expected) < ROUNDING);
}

/// An attribute's number, behind its name and type, is changed in a file.
fn patched(mut bytes: Vec<u8>, attribute: &[u8], at: usize, [from, to]: [u32; 2]) -> Vec<u8> {
    let found = bytes.windows(attribute.len()).position(|w| w == attribute);
    let place = found.unwrap() + attribute.len() + at;
    assert_eq!(bytes[place..place + 4], from.to_le_bytes());
    bytes[place..place + 4].copy_from_slice(&to.to_le_bytes());
    bytes
}

#[test]
fn a_data_window_or_tiles_too_large_to_unpack_are_refused_before() {
    let file = |blocks: Blocks| {
        let mut file = Exr::rgb(&colors());
        file.encoding = Encoding {
            blocks,
            ..Encoding::SMALL_LOSSLESS
        };
        file.bytes()
    };
    let told = |bytes: &[u8]| SkyImage::decode(bytes).unwrap_err().to_string();
    // The display window is 8 x 4 still.
    let window = b"dataWindow\0box2i\0";
    let wide = patched(file(Blocks::ScanLines), window, 12, [7, (1 << 29) - 1]);
    assert_eq!(
        told(&wide),
        "the image's data window is of 536870912 x 4 pixels: expected at most 32768 x 16384 and 134217728 in all"
    );
    let tiles = b"tiles\0tiledesc\0";
    let mut vast = file(Blocks::Tiles(Vec2(8, 4)));
    for (at, side) in [(4, 8), (8, 4)] {
        vast = patched(vast, tiles, at, [side, 1 << 29]);
    }
    assert!(told(&vast).contains("bytes of memory"), "{}", told(&vast));
}

#[test]
fn a_grey_exr_is_grey_and_one_of_xyz_is_xyz() {
    let values: Vec<f32> = (0..32).map(|i| i as f32 / 8.0).collect();
    for sample_type in [SampleType::F16, SampleType::F32] {
        let mut file = Exr::new(vec![("Y", values.clone()), ("A", vec![1.0; 32])]);
        file.sample_type = sample_type;
        let grey: Vec<[f64; 3]> = values.iter().map(|v| [f64::from(*v); 3]).collect();
        assert!(apart(&seen(&decoded(&file.bytes())), &grey) < ROUNDING);
    }
    let xyz_from_709 = SPACES[4].from_709;
    let texels: Vec<[f32; 3]> = colors().iter().map(|c| times(&xyz_from_709, *c)).collect();
    let image = decoded(&Exr::new(named(["X", "Y", "Z"], &texels)).bytes());
    let expected: Vec<[f64; 3]> = colors().iter().map(|c| c.map(f64::from)).collect();
    assert!(apart(&seen(&image), &expected) < 5e-4);
}

#[test]
fn a_radiance_file_may_begin_with_any_program() {
    for signature in ["#?RADIANCE", "#?RGBE", "#?AUTOPANO", "#?"] {
        let header = format!("{signature}\nFORMAT=32-bit_rle_rgbe\n");
        let bytes = hdr(&header, "-Y 4 +X 8", &pixels());
        let off = apart(&seen(&decoded(&bytes)), &light([1.0; 3]));
        assert!(off < ROUNDING, "{signature}: {off}");
        let crlf = bytes[..bytes.len() - 128].to_vec();
        let crlf = String::from_utf8(crlf).unwrap().replace('\n', "\r\n");
        let crlf = [crlf.as_bytes(), &bytes[bytes.len() - 128..]].concat();
        assert_eq!(decoded(&crlf), decoded(&bytes), "{signature}");
    }
}

#[test]
fn runs_of_radiance_files_of_either_kind_are_read() {
    let header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
    let [a, b] = [[128, 64, 32, 129], [3, 200, 1, 120]];
    let line = |first: usize, width: usize| [vec![a; first], vec![b; width - first]].concat();
    let by_component = |p: [u8; 4], q: [u8; 4]| -> Vec<u8> {
        // Three repeats, then five bytes.
        let component = |c: usize| [131, p[c], 5, q[c], q[c], q[c], q[c], q[c]];
        let runs = (0..4).flat_map(component);
        [2, 2, 0, 8].into_iter().chain(runs).collect()
    };
    let long: Vec<[u8; 4]> = vec![a, [1, 1, 1, 2], [1, 1, 1, 1], b, [1, 1, 1, 4]];
    let idle = [&[a][..], &[[1, 1, 1, 0]; 9], &[b, [1, 1, 1, 6]]].concat();
    for (bytes, expected) in [
        (by_component(a, b), line(3, 8)),
        (long.concat(), line(259, 264)),
        (idle.concat(), line(1, 8)),
    ] {
        let resolution = format!("-Y 1 +X {}", expected.len());
        let mut runs = hdr(header, &resolution, &[]);
        runs.extend(bytes);
        let flat = decoded(&hdr(header, &resolution, &expected));
        assert_eq!(decoded(&runs), flat, "{resolution}");
    }
    // Lines of fewer pixels than 8 have no runs by component.
    let narrow = hdr(header, "-Y 1 +X 1", &[[2, 2, 2, 129]]);
    assert_eq!(seen(&decoded(&narrow)), [[2.0 / 128.0; 3]]);
}

#[test]
fn exposure_and_color_correction_are_divided_out() {
    for (lines, over) in [
        ("EXPOSURE=2\n", [2.0; 3]),
        ("EXPOSURE= 2.0e0 \nEXPOSURE=0.25\n", [0.5; 3]),
        ("COLORCORR=1 2 4\nEXPOSURE=2\n", [2.0, 4.0, 8.0]),
        ("COLORCORR= 2 2 2\nCOLORCORR=1 2 4\n", [2.0, 4.0, 8.0]),
        (
            "\tEXPOSURE=2\n# EXPOSURE=4\nSOFTWARE=EXPOSURE=3\n",
            [1.0; 3],
        ),
    ] {
        let header = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{lines}");
        let image = decoded(&hdr(&header, "-Y 4 +X 8", &pixels()));
        assert!(apart(&seen(&image), &light(over)) < 1e-6, "{lines}");
    }
    for line in [
        "EXPOSURE=0",
        "EXPOSURE=two",
        "COLORCORR=1 2",
        "PRIMARIES=0.6 0.3",
        "FORMAT=rgbe",
    ] {
        let header = format!("#?RADIANCE\n{line}\n");
        let error = SkyImage::decode(&hdr(&header, "-Y 4 +X 8", &pixels())).unwrap_err();
        let message = error.to_string();
        assert!(
            message.contains(&format!("says `{line}`: expected")),
            "{message}"
        );
    }
}

/// Each file has the pixels in its own order, as the format's description has it: the first axis
/// goes from scan line to scan line, Y is up, X to the right.
#[test]
fn all_eight_orientations_show_the_same_sky() {
    let upright = |column: usize, row: usize| pixels()[row * 8 + column];
    for (resolution, place) in [
        ("-Y 4 +X 8", (|i| [i % 8, i / 8]) as fn(usize) -> [usize; 2]),
        ("-Y 4 -X 8", |i| [7 - i % 8, i / 8]),
        ("+Y 4 +X 8", |i| [i % 8, 3 - i / 8]),
        ("+Y 4 -X 8", |i| [7 - i % 8, 3 - i / 8]),
        ("+X 8 -Y 4", |i| [i / 4, i % 4]),
        ("-X 8 -Y 4", |i| [7 - i / 4, i % 4]),
        ("+X 8 +Y 4", |i| [i / 4, 3 - i % 4]),
        ("-X 8 +Y 4", |i| [7 - i / 4, 3 - i % 4]),
    ] {
        let in_order: Vec<[u8; 4]> = (0..32).map(|i| upright(place(i)[0], place(i)[1])).collect();
        let image = decoded(&hdr(
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n",
            resolution,
            &in_order,
        ));
        assert_eq!(image.size(), [8, 4], "{resolution}");
        let off = apart(&seen(&image), &light([1.0; 3]));
        assert!(off < ROUNDING, "{resolution}: {off}");
    }
    for resolution in ["Y 4 X 8", "-Y 4", "-Y 4 +Y 8", "-Y four +X 8"] {
        let error = SkyImage::decode(&hdr("#?RADIANCE\n", resolution, &pixels())).unwrap_err();
        assert!(error.to_string().contains("expected two axes"), "{error}");
    }
}

/// D65 is X 0.95047, Y 1, Z 1.08883 (ASTM E308); P3's matrix is that of SMPTE RP 431-2 with D65.
#[test]
fn the_colors_of_a_radiance_file_are_those_that_it_says() {
    let image = decoded(&hdr(
        "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n",
        "-Y 4 +X 8",
        &[[122, 128, 139, 129]; 32],
    ));
    assert!(
        apart(&seen(&image), &[[1.0; 3]; 32]) < 0.02,
        "{:?}",
        seen(&image)[0]
    );
    let p3 = "PRIMARIES=0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.329\n";
    let header = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{p3}");
    let image = decoded(&hdr(&header, "-Y 4 +X 8", &[[128, 64, 64, 129]; 32]));
    // sRGB from P3 (CSS Color 4): rows 1.2249 -0.2247 0, -0.0420 1.0419 0, -0.0197 -0.0786 1.0979.
    let expected = [1.1125, 0.4789, 0.4899];
    assert!(
        apart(&seen(&image), &[expected; 32]) < 2e-3,
        "{:?}",
        seen(&image)[0]
    );
}

#[test]
fn a_picture_that_is_not_twice_as_wide_as_high_is_told() {
    for (rows, words) in [
        (4, ""),
        (8, "light probes"),
        (6, "crosses of cube maps"),
        (48, "faces of cube maps"),
        (5, "8 x 5 pixels"),
    ] {
        let texels = vec![[0.5; 3]; 8 * rows];
        let image = decoded(&Exr::rgb(&texels).bytes());
        let said = said(&image);
        assert!(
            said.contains(words) && said.is_empty() == words.is_empty(),
            "{rows}: {said}"
        );
    }
    let mut cube = Exr::rgb(&colors());
    cube.cube = true;
    assert!(said(&decoded(&cube.bytes())).contains("cube map (envmap)"));
}

#[test]
fn what_is_to_be_said_of_a_sky_is_said_of_the_shot() {
    let folder = Folder::new();
    folder.paint("square.png.exr", [4, 4], |_, _| [0.5; 3]);
    let prepared = folder
        .shot(1, &looking(0.0, 0.0, "image = \"square.png.exr\""))
        .unwrap();
    let warnings: Vec<_> = prepared.library.warnings(&prepared.shot).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].1.contains("4 x 4 pixels"), "{warnings:?}");
}
