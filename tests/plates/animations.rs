//! The plates are frames of their animations, to the last bit.

use super::thumbnail::{film, prepared};
use restframe::frame::Frame;

fn same(animation: &str, frames: &[(u32, u32)]) {
    let prepared_animation = prepared(animation);
    for &(plate, frame) in frames {
        let stem = format!("plate-{plate:02}");
        let exposed = |p: &restframe::render::Prepared| {
            p.exposure()
                .unwrap()
                .0
                .stops(&Frame::new(&p.shot, frame).unwrap())
        };
        let plate = prepared(&stem);
        assert_eq!(exposed(&plate), exposed(&prepared_animation), "{stem}");
        let ours = film(&prepared_animation, frame);
        assert!(
            film(&plate, 1) == ours,
            "{stem} is not frame {frame} of {animation}"
        );
    }
}

#[test]
fn plates_3_5_and_6_are_frames_of_the_pan() {
    same("array-pan", &[(3, 1), (5, 78), (6, 97)]);
}

#[test]
fn plate_4_is_a_frame_of_the_pan_in_its_upper_half() {
    let (plate, pan) = (
        film(&prepared("plate-04"), 1),
        film(&prepared("array-pan"), 37),
    );
    let (upper, lower) = plate.xyz.split_at(plate.xyz.len() / 2);
    let (pan_upper, pan_lower) = pan.xyz.split_at(upper.len());
    assert!(upper == pan_upper);
    assert!(lower != pan_lower);
}

#[test]
fn plates_7_to_12_are_frames_of_the_rows() {
    same(
        "rows",
        &[(7, 1), (8, 25), (9, 29), (10, 30), (11, 35), (12, 49)],
    );
}

#[test]
fn plate_2_is_the_last_frame_of_the_lattice() {
    same("lattice", &[(2, 49)]);
}

#[test]
fn in_absolute_units_surface_color_never_comes_back() {
    let (rows, absolute) = (prepared("rows"), prepared("rows-absolute"));
    let luminance = |prepared: &restframe::render::Prepared, frame: u32| {
        film(prepared, frame)
            .xyz
            .iter()
            .map(|xyz| f64::from(xyz[1]))
            .sum::<f64>()
    };
    let frames = [25, 29, 35, 49, 73];
    let physics = frames.map(|frame| luminance(&absolute, frame));
    // 3.7e5, 1.1e10, 3.7e12, 7.6e13, 2.9e14.
    assert!(
        physics.windows(2).all(|pair| pair[0] < pair[1]),
        "{physics:?}"
    );
    let paper = frames.map(|frame| luminance(&rows, frame));
    // 2.4e5, 5.2e5, 2.1e6, 8.1e5, 3.2e5.
    assert!(paper[2] > paper[3] && paper[3] > paper[4], "{paper:?}");
}
