//! Films of images together against those of each alone.

use super::{Changes, Image, options, scene, together};
use restframe::film::Channels;
use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::render::{Options, film_bytes};
use restframe::shot::Layer;

/// What images of one trace may differ in.
const DIFFERING: &[Changes<'_>] = &[
    &[],
    &[("KELVIN", "900")],
    &[
        ("KELVIN", "12000"),
        ("EMISSIVITY", "{ gaussian = { center = 500, width = 60 } }"),
    ],
    &[("KELVIN", "0")],
    &[
        ("WEIGHT", "0.3"),
        (
            "PAINT",
            "{ points = [[400, 0], [500, 0.8], [550, 0.1], [700, 0]] }",
        ),
    ],
    &[("POWER", "50"), ("LAMP", "{ blackbody = 3000 }")],
    &[
        ("EXPOSURE", "4"),
        ("SKY", "spectrum = \"D65\"\nscale = 1e-3"),
    ],
    &[
        ("SENSOR", "window = [300, 1100]\ncolor = \"bands\""),
        ("ACCURACY", "wavelengths = 33"),
    ],
    &[("EFFECTS", "doppler = \"off\"\nbeaming = \"square\"")],
    &[("EFFECTS", "beaming = \"off\"\nthermal = \"off\"")],
    &[("ACCURACY", "spectra = \"spline\"\nwavelengths = 40")],
    &[("ACCURACY", "spectra = \"lines\"\nline_spacing = 20")],
    &[("ACCURACY", "spectra = \"lines\"\nline_spacing = 7")],
    &[
        ("ACCURACY", "spectra = \"rgb\""),
        ("EFFECTS", "doppler = \"off\""),
    ],
    &[("ACCURACY", "wavelengths = 200")],
    &[("ACCURACY", "spectra = \"exact\"")],
];

/// Asserts that images with this in common are together what they are alone, whichever is first.
fn each_is_as_alone(common: Changes<'_>, options: &Options) {
    let images: Vec<Image> = DIFFERING
        .iter()
        .map(|differing| Image::new(&[common, differing], options))
        .collect();
    let brightest = images[0].alone.xyz.iter().map(|xyz| xyz[1]);
    assert!(brightest.fold(0.0, f32::max) > 0.0, "all is black");
    let told_apart = images[1..]
        .iter()
        .filter(|image| image.alone.xyz != images[0].alone.xyz);
    // The exposure is no part of the film.
    assert!(
        told_apart.count() + 1 >= DIFFERING.len() - 1,
        "images are alike"
    );
    for (threads, first) in [(1, 0), (2, 3), (5, 7)] {
        let order = (0..images.len()).map(|i| &images[(i + first) % images.len()]);
        let order: Vec<&Image> = order.collect();
        let members: Vec<_> = order.iter().map(|image| image.member()).collect();
        let (_, aggregate) = scene(&order[0].prepared);
        let films = together(threads, &members, &aggregate, options)
            .unwrap()
            .films;
        assert_eq!(films.len(), images.len());
        for (i, (film, image)) in films.iter().zip(order).enumerate() {
            let number = (i + first) % images.len();
            assert!(
                *film == image.alone,
                "image {number} on {threads} threads, common: {common:?}"
            );
        }
    }
}

#[test]
fn under_lamps_that_cast_shadows() {
    each_is_as_alone(&[], &options(4));
}

#[test]
fn with_no_shadows_and_the_smooth_filter() {
    each_is_as_alone(&[("FILTER", "filter = \"blackman-harris\"")], &options(3));
}

#[test]
fn in_colored_mirrors_and_glass() {
    let passes = "mirror = { weight = 0.8, spectrum = { rgb = [0.9, 0.6, 0.3] } }\n\
                  refraction = { weight = 0.9, spectrum = { rgb = [0.3, 0.8, 0.6] }, ior = 1.4 }";
    each_is_as_alone(&[("PASSES", passes)], &options(2));
}

#[test]
fn before_a_sky_of_stars_seen_by_a_fisheye() {
    // A fisheye has pixels without rays, and such as have some samples without.
    let sky = "spectrum = 1e-3\nstars = { count = 300, seed = 1, size = 3, temperature = [2500, 15000], magnitude = [0, 6] }";
    let camera = "projection = \"fisheye\"\n";
    each_is_as_alone(
        &[
            ("SKY", sky),
            ("hfov = 60", "hfov = 170"),
            ("CAMERA", camera),
        ],
        &options(4),
    );
}

#[test]
fn where_rows_are_spliced_under_effects_that_tracing_reads() {
    let splices = "[[splice]]\nrows = [0.2, 0.5]\neffects = { geometry = \"off\" }\n\
                   [[splice]]\nrows = [0.4, 0.8]\neffects = { shadows = \"off\", thermal = \"off\" }";
    each_is_as_alone(&[("SPLICE", splices)], &options(2));
}

#[test]
fn a_pixel_of_more_samples_than_are_traced_at_once() {
    // Two thousand rays are, or 256 where there are mirrors.
    let mirror = "mirror = { weight = 0.8, spectrum = 1.0 }";
    let options = Options {
        width: 3,
        height: 2,
        ..options(700)
    };
    each_is_as_alone(&[("PASSES", mirror)], &options);
    let options = Options {
        samples: 5000,
        ..options
    };
    let images =
        [[].as_slice(), &[("KELVIN", "900")]].map(|differing| Image::new(&[differing], &options));
    let members = images.each_ref().map(Image::member);
    let (_, aggregate) = scene(&images[0].prepared);
    let films = together(2, &members, &aggregate, &options).unwrap().films;
    assert!(films[0] == images[0].alone && films[1] == images[1].alone);
}

/// Splices of one member that shading alone reads need not be the others'.
#[test]
fn members_may_be_spliced_in_different_rows() {
    let options = options(2);
    let splice =
        |rows: &str| format!("[[splice]]\nrows = {rows}\neffects = {{ doppler = \"off\" }}");
    let [upper, lower] = ["[0.0, 0.4]", "[0.3, 1.0]"].map(splice);
    let changes: [Changes<'_>; 3] = [&[], &[("SPLICE", &upper)], &[("SPLICE", &lower)]];
    let images = changes.map(|change| Image::new(&[change], &options));
    let members = images.each_ref().map(Image::member);
    let (_, aggregate) = scene(&images[0].prepared);
    let films = together(2, &members, &aggregate, &options).unwrap().films;
    assert!(
        films
            .iter()
            .zip(&images)
            .all(|(film, image)| *film == image.alone)
    );
    assert!(films[1] != films[0] && films[2] != films[0] && films[1] != films[2]);
}

/// The sum of a pixel's samples, one by one: an oracle that knows of no pieces.
#[test]
fn a_film_holds_the_means_of_its_samples_in_their_order() {
    use restframe::render::View;
    use restframe::shade::ShadeScratch;
    use restframe::trace::{Samples, Scratch, ShadeTrees};
    let options = Options {
        width: 2,
        height: 2,
        ..options(2500)
    };
    let image = Image::new(&[], &options);
    let (scene, aggregate) = scene(&image.prepared);
    let shot = &image.prepared.shot;
    let view = View::new(
        &Frame::new(shot, 1).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    let samples = Samples::new(options.samples, shot.image.filter);
    for (pixel, xyz) in image.alone.xyz.iter().enumerate() {
        let [x, y] = [pixel as u32 % 2, pixel as u32 / 2];
        let mut sum = [0.0; 3];
        for index in 0..options.samples {
            let [dx, dy] = samples.position(x, y, index);
            let point = [(f64::from(x) + dx) / 2.0, (f64::from(y) + dy) / 2.0];
            let direction = scene.camera.looks_along(point).unwrap();
            let mut trees = ShadeTrees::default();
            view.tracer()
                .trace(&[direction], &mut Scratch::default(), &mut trees);
            let light = view
                .shader()
                .xyz(&trees, trees.roots[0], &mut ShadeScratch::default());
            sum.iter_mut()
                .zip(light)
                .for_each(|(sum, light)| *sum += light);
        }
        assert_eq!(*xyz, sum.map(|v| (v / f64::from(options.samples)) as f32));
    }
}

#[test]
fn members_have_the_channels_of_their_own_sensors() {
    let options = options(1);
    let changes: [Changes<'_>; 2] = [&[], &[("SENSOR", "color = \"bands\"")]];
    let images = changes.map(|change| Image::new(&[change], &options));
    let members = images.each_ref().map(Image::member);
    let (_, aggregate) = scene(&images[0].prepared);
    let films = together(1, &members, &aggregate, &options).unwrap().films;
    let channels: Vec<Channels> = films.iter().map(|film| film.channels).collect();
    assert_eq!(channels, [Channels::Xyz, Channels::Bands]);
}

#[test]
fn no_members_have_no_films() {
    let prepared: Prepared = super::prepared(&[]);
    let (_, aggregate) = scene(&prepared);
    assert!(
        together(1, &[], &aggregate, &options(1))
            .unwrap()
            .films
            .is_empty()
    );
}

#[test]
fn the_memory_of_a_film_is_told_before_it_is_rendered() {
    for layers in [vec![], vec![Layer::Distance], options(1).layers] {
        let options = Options {
            layers,
            ..options(1)
        };
        let film = Image::new(&[], &options).alone;
        let held = size_of_val(&*film.xyz)
            + film
                .layers
                .named()
                .map(|(_, values)| size_of_val(values))
                .sum::<usize>();
        assert_eq!(film_bytes(&options), held as u64);
    }
}
