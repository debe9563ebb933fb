//! The contact sheet's pixels.

use super::desk::{Desk, SMALL, open};
use std::process::Command;

/// Linear light of an 8-bit value, by IEC 61966-2-1.
fn linear(byte: u8) -> f64 {
    let code = f64::from(byte) / 255.0;
    if code <= 0.04045 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }
}

#[test]
fn each_cell_of_a_sheet_is_its_frame_reduced_in_linear_light() {
    let desk = Desk::small("sheet = { columns = 4, width = 32 }");
    let told = desk.assemble();
    assert_eq!(told.status, 0, "{}", told.stderr);
    let sheet = open(&desk.file("passing.sheet.png"));
    // Four columns of 32 with gaps of 8; letters of 7 make a title of 21 and captions of 11.
    assert_eq!(sheet.width(), 4 * (32 + 8) + 8);
    assert_eq!(sheet.height(), 21 + 3 * (32 + 11 + 8));
    for frame in 1..=10 {
        let (column, row) = ((frame - 1) % 4, (frame - 1) / 4);
        let (left, top) = (8 + column * 40, 21 + row * 51);
        let whole = desk.frame(frame);
        for (x, y) in (0..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
            for channel in 0..3 {
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
                let light =
                    four.map(|(i, j)| linear(whole.get_pixel(2 * x + i, 2 * y + j)[channel]));
                let mean = light.iter().sum::<f64>() / 4.0;
                let found = linear(sheet.get_pixel(left + x, top + y)[channel]);
                // Half a level of the code, at its steepest 1.055 · 2.4 / 255 of linear light, and
                // sums of 32 bits.
                assert!(
                    (found - mean).abs() < 0.5 * 2.54 / 255.0 + 1e-5,
                    "{frame}: {x}, {y}"
                );
            }
        }
    }
}

#[test]
fn frames_below_the_width_asked_for_stand_on_the_sheet_as_they_are() {
    let desk = Desk::small("sheet = { columns = 100 }");
    assert_eq!(desk.assemble().status, 0);
    let sheet = open(&desk.file("passing.sheet.png"));
    // As wide as a caption needs, in letters of 200/22 pixels.
    assert_eq!(sheet.width(), 10 * (200 + 8) + 8);
    let title = sheet.height() - 64 - 14 - 8;
    for frame in 1..=10 {
        let whole = desk.frame(frame);
        for (x, y, pixel) in whole.enumerate_pixels() {
            let found = sheet.get_pixel(8 + (frame - 1) * 208 + x, title + y);
            assert_eq!(found, pixel, "{frame}: {x}, {y}");
        }
    }
}

#[test]
fn a_sheet_of_spliced_parts_has_them_side_by_side_in_each_cell() {
    let splice = "[[splice]]\nrows = [0.5, 1.0]\neffects = { doppler = \"off\" }";
    let sequence = "[sequence]\nsplices = true\nsheet = { columns = 5, width = 128 }";
    let desk = Desk::new(SMALL, &format!("{splice}\n{sequence}"));
    assert_eq!(desk.assemble().status, 0);
    let sheet = open(&desk.file("passing.sheet.png"));
    let frame = desk.frame(1);
    for (x, y, pixel) in frame.enumerate_pixels() {
        let (x, y) = if y < 32 { (x, y) } else { (x + 64, y - 32) };
        assert_eq!(sheet.get_pixel(8 + x, 21 + y), pixel, "{x}, {y}");
    }
}

#[cfg(unix)]
#[test]
fn a_sheet_that_cannot_be_written_to_its_end_is_not_kept() {
    let desk = Desk::small("page = false\nsheet = { columns = 4, width = 64 }");
    assert_eq!(desk.assemble().status, 0);
    let sheet = desk.file("passing.sheet.png");
    let bytes = std::fs::metadata(&sheet).unwrap().len();
    std::fs::remove_file(&sheet).unwrap();
    // Blocks of 512 bytes: the last of the sheet's is one too many, so that only its end is lost.
    let blocks = (bytes - 1) / 512;
    let told = Command::new("sh")
        .args([
            "-c",
            "ulimit -f $1; exec \"$2\" assemble passing.toml",
            "sh",
        ])
        .arg(blocks.to_string())
        .arg(env!("CARGO_BIN_EXE_restframe"))
        .current_dir(desk.path(""))
        .output()
        .unwrap();
    assert_eq!(told.status.code(), Some(1));
    let said = String::from_utf8(told.stderr).unwrap();
    assert!(said.contains("raise the limit on file sizes"), "{said}");
    assert!(!sheet.exists());
    assert_eq!(desk.names(".tmp"), [""; 0]);
}
