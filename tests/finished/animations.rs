//! GIF and APNG, read back.

use super::desk::{Desk, FRAMES, SMALL, apart};
use image::AnimationDecoder;
use std::fs::{self, File};
use std::io::{BufReader, Cursor};
use std::process::{Command, Stdio};

/// The frames of an APNG by the `png` crate, and the delay of each as a fraction.
fn read_apng(desk: &Desk) -> Vec<(Vec<u8>, [u16; 2])> {
    let file = BufReader::new(File::open(desk.file("passing.apng")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = reader.info().animation_control.unwrap();
    assert_eq!(control.num_plays, 0, "it plays forever");
    let mut frames = Vec::new();
    for _ in 0..control.num_frames {
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        let control = reader.info().frame_control.unwrap();
        frames.push((bytes, [control.delay_num, control.delay_den]));
    }
    frames
}

#[test]
fn an_apng_has_every_frame_to_the_bit() {
    let desk = Desk::small("apng = true");
    let told = desk.assemble();
    assert_eq!(told.status, 0, "{}", told.stderr);
    assert!(told.stdout.contains("passing.apng\n"), "{}", told.stdout);
    let frames = read_apng(&desk);
    assert_eq!(frames.len(), FRAMES as usize);
    for (number, (bytes, delay)) in (1..).zip(frames) {
        assert!(bytes == desk.frame(number).into_raw(), "frame {number}");
        assert_eq!(delay, [1, 24]);
    }
}

#[test]
fn frames_in_exr_alone_are_as_bright_as_their_pngs() {
    let shown = Desk::small("apng = true");
    let linear = Desk::new(
        SMALL,
        "[output]\nformats = [\"exr\"]\n[sequence]\napng = true",
    );
    assert_eq!(linear.names(".png"), [""; 0]);
    assert_eq!(shown.assemble().status, 0);
    assert_eq!(linear.assemble().status, 0);
    assert!(read_apng(&shown) == read_apng(&linear));
}

/// The frames of a GIF, each with its milliseconds.
fn read_gif(desk: &Desk) -> Vec<(Vec<u8>, u32)> {
    let bytes = fs::read(desk.file("passing.gif")).unwrap();
    assert!(bytes.windows(11).any(|w| w == b"NETSCAPE2.0"), "it loops");
    let decoder = image::codecs::gif::GifDecoder::new(Cursor::new(bytes)).unwrap();
    let frames = decoder.into_frames().collect_frames().unwrap();
    let read = |frame: image::Frame| {
        let (numerator, denominator) = frame.delay().numer_denom_ms();
        let rgb = image::DynamicImage::ImageRgba8(frame.into_buffer()).into_rgb8();
        (rgb.into_raw(), numerator / denominator)
    };
    frames.into_iter().map(read).collect()
}

#[test]
fn a_gif_has_all_frames_and_their_time_and_few_colors_as_they_are() {
    let desk = Desk::small("gif = true");
    let told = desk.assemble();
    assert_eq!(told.status, 0, "{}", told.stderr);
    let frames = read_gif(&desk);
    assert_eq!(frames.len(), FRAMES as usize);
    // Ten frames at 24 a second, in hundredths.
    assert_eq!(frames.iter().map(|(_, ms)| ms).sum::<u32>(), 420);
    for (number, (shown, _)) in (1..).zip(frames) {
        assert!(shown == desk.frame(number).into_raw(), "frame {number}");
    }
}

#[test]
fn many_colors_are_near_in_a_gif_and_what_stands_still_does_not_flicker() {
    let desk = Desk::small("gif = true");
    // Below, the same in every frame; above, moving on.
    for frame in 1..=FRAMES {
        let color = |x: u32, y: u32| {
            let moved = if y < 32 { x + frame } else { x };
            image::Rgb([moved * 3, y * 4, 128].map(|value| value as u8))
        };
        desk.put_png(frame, &image::RgbImage::from_fn(64, 64, color));
    }
    desk.record();
    assert_eq!(desk.assemble().status, 0);
    let frames = read_gif(&desk);
    for (number, (shown, _)) in (1..).zip(&frames) {
        assert!(
            shown[32 * 192..] == frames[0].0[32 * 192..],
            "frame {number}"
        );
        // 256 colours on a plane of 222 by 252 levels stand 15 apart, so that they are off by
        // 15/√12 in two channels of three, 3.5, and dithered by √2 of it and the pattern's width. Measured 4.3.
        let apart = apart(shown, &desk.frame(number).into_raw());
        assert!(apart < 8.0, "frame {number}: {apart}");
        assert!(apart > 1.0, "the colours are too few to test anything");
    }
}

#[test]
fn a_second_pass_makes_what_is_not_there_or_of_other_frames() {
    let desk = Desk::small("apng = true\ngif = true");
    // But for the page, at the end of rendering.
    let finished = || {
        let told = desk.call(&["render", "passing.toml", "--frames", "1", "--json"]);
        assert_eq!(told.status, 0, "{}", told.stderr);
        let is_assembled = |event: &serde_json::Value| {
            let file = event["file"].as_str().unwrap_or_default();
            event["event"] == "assembled" && !file.ends_with(".html")
        };
        told.events()
            .iter()
            .filter(|event| is_assembled(event))
            .count()
    };
    assert_eq!(finished(), 2);
    assert_eq!(finished(), 0);
    fs::remove_file(desk.file("passing.gif")).unwrap();
    assert_eq!(finished(), 1);
    fs::write(desk.file("passing.apng"), "another").unwrap();
    assert_eq!(finished(), 1);
    // Always all of it when asked for by name, and the page.
    assert_eq!(desk.assemble().stdout.lines().count(), 3);
    // Others may still be at work on what is missing.
    fs::remove_file(desk.file("passing.0007.png")).unwrap();
    fs::remove_file(desk.file("passing.gif")).unwrap();
    assert_eq!(finished(), 0);
    assert_eq!(desk.names(".gif"), [""; 0]);
}

#[test]
fn parts_of_a_splice_stand_side_by_side() {
    let splice = "[[splice]]\nrows = [0.25, 1.0]\neffects = { doppler = \"off\" }";
    let desk = Desk::new(
        SMALL,
        &format!("{splice}\n[sequence]\napng = true\nsplices = true"),
    );
    assert_eq!(desk.assemble().status, 0);
    let (shown, _) = read_apng(&desk).swap_remove(4);
    let shown = image::RgbImage::from_raw(128, 48, shown).unwrap();
    let frame = desk.frame(5);
    for (x, y, pixel) in shown.enumerate_pixels() {
        let expected = match (x < 64, y) {
            (true, 0..16) => *frame.get_pixel(x, y),
            (true, _) => image::Rgb([0; 3]),
            (false, _) => *frame.get_pixel(x - 64, y + 16),
        };
        assert_eq!(*pixel, expected, "{x}, {y}");
    }
}

/// The largest memory that assembling took, KiB, by what the system says of the process.
fn peak_kib(desk: &Desk) -> u64 {
    let mut child = Command::new(env!("CARGO_BIN_EXE_restframe"))
        .current_dir(desk.path(""))
        .args(["assemble", "passing.toml"])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    loop {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        peak = peak.max(kib.unwrap_or(0));
        if let Some(ended) = child.try_wait().unwrap() {
            assert!(ended.success());
            return peak;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn two_hundred_frames_take_no_more_memory_than_twenty() {
    const SIDE: u32 = 256;
    let peak = |frames: u32| {
        let desk = Desk::small("gif = true\nsheet = { columns = 5, width = 96 }");
        let size = format!("[image]\nsize = [{SIDE}, {SIDE}]");
        desk.write_shot(
            &size,
            "[sequence]\ngif = true\nsheet = { columns = 5, width = 96 }",
        );
        let text = fs::read_to_string(desk.path("passing.toml")).unwrap();
        let text = text.replace("frames = 10", &format!("frames = {frames}"));
        fs::write(desk.path("passing.toml"), text).unwrap();
        for frame in 1..=frames {
            // Some thousand colours, so that few are looked for in the palette.
            let color = |x: u32, y: u32| {
                image::Rgb([x + frame, y, x ^ y].map(|value| (value & 0xf0) as u8))
            };
            desk.put_png(frame, &image::RgbImage::from_fn(SIDE, SIDE, color));
        }
        desk.record();
        peak_kib(&desk)
    };
    let (few, many) = (peak(20), peak(200));
    // The 180 frames more have 34 MiB of pixels; what may grow is what is known of each frame, and
    // the palette's samples from 20 to 32 frames (1 MiB).
    assert!(many < few + (12 << 10), "{few} KiB, then {many} KiB");
}
