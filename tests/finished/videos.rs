//! Videos, read back by ffprobe and ffmpeg; and what happens without a working ffmpeg.

use super::desk::{Desk, FRAMES, apart};
use std::fs;
use std::process::Command;

/// Width, height, frame rate, frames and tags of a video, by ffprobe.
fn probe(desk: &Desk, name: &str) -> Vec<String> {
    let entries = "stream=width,height,r_frame_rate,nb_read_frames,pix_fmt,color_space,color_range";
    let told = Command::new("ffprobe")
        .args(["-v", "error", "-count_frames", "-show_entries", entries])
        .args(["-of", "default=noprint_wrappers=1"])
        .arg(desk.file(name))
        .output()
        .unwrap();
    let text = String::from_utf8(told.stdout).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines.sort();
    lines
}

/// The pixels of a video's frames, by ffmpeg, each of so many bytes.
fn decode(desk: &Desk, name: &str, bytes: usize) -> Vec<Vec<u8>> {
    let told = Command::new("ffmpeg")
        .args(["-v", "error", "-i"])
        .arg(desk.file(name))
        .args([
            "-vf",
            "scale=in_color_matrix=bt709:in_range=tv:out_range=full,format=rgb24",
        ])
        .args(["-f", "rawvideo", "-"])
        .output()
        .unwrap();
    assert!(told.status.success());
    told.stdout.chunks(bytes).map(<[u8]>::to_vec).collect()
}

#[test]
fn videos_have_every_frame_in_its_colors() {
    for (word, name, format) in [
        ("mp4", "passing.mp4", "yuv420p"),
        ("av1", "passing.av1.mp4", "yuv420p10le"),
    ] {
        let desk = Desk::small(&format!("video = \"{word}\""));
        let told = desk.assemble();
        assert_eq!(told.status, 0, "{}", told.stderr);
        assert_eq!(
            probe(&desk, name),
            [
                "color_range=tv".to_owned(),
                "color_space=bt709".to_owned(),
                "height=64".to_owned(),
                format!("nb_read_frames={FRAMES}"),
                format!("pix_fmt={format}"),
                "r_frame_rate=24/1".to_owned(),
                "width=64".to_owned(),
            ]
        );
        let frames = decode(&desk, name, 64 * 64 * 3);
        assert_eq!(frames.len(), FRAMES as usize);
        for (number, frame) in (1..).zip(frames) {
            // On the ground above the square 8 bits of limited range round by a level or two
            // (measured 1 and 1.6); edges, where colour has half the resolution, and the constant
            // rate factor add to that (measured 3.0 and 3.3). A wrong range is off by 10 and more.
            let ground: Vec<u8> = frame[..64 * 3 * 8].to_vec();
            let whole = desk.frame(number).into_raw();
            let (flat, all) = (apart(&ground, &whole[..64 * 3 * 8]), apart(&frame, &whole));
            assert!(flat < 3.0, "{name}, frame {number}: {flat}");
            assert!(all < 6.0, "{name}, frame {number}: {all}");
        }
        assert_eq!(desk.names(".tmp"), [""; 0]);
    }
}

#[test]
fn odd_sides_are_padded_by_a_line_and_that_is_said() {
    let desk = Desk::new(
        "[image]\nsize = [65, 67]\nsamples = 1",
        "[sequence]\nvideo = \"mp4\"",
    );
    let told = desk.assemble();
    assert_eq!(told.status, 0, "{}", told.stderr);
    assert!(
        told.stderr.contains("padded to 66 x 68 pixels"),
        "{}",
        told.stderr
    );
    let told = probe(&desk, "passing.mp4");
    assert!(told.contains(&"width=66".to_owned()) && told.contains(&"height=68".to_owned()));
}

#[test]
fn an_av1_video_of_less_than_64_rows_is_refused_by_name() {
    let desk = Desk::new(
        "[image]\nsize = [64, 62]\nsamples = 1",
        "[sequence]\nvideo = \"av1\"",
    );
    let told = desk.assemble();
    assert_eq!(told.status, 1);
    assert!(
        told.stderr
            .contains("passing.av1.mp4: an AV1 video has at least 64"),
        "{}",
        told.stderr
    );
}

#[test]
fn without_ffmpeg_the_rest_is_made_and_its_package_is_named() {
    let desk = Desk::small("video = \"mp4\"\ngif = true");
    fs::create_dir(desk.path("empty")).unwrap();
    let empty = desk.path("empty");
    let told = desk.call_with_path(&["assemble", "passing.toml"], empty.to_str().unwrap());
    assert_eq!(told.status, 1);
    assert!(
        told.stderr.contains("apt install ffmpeg"),
        "{}",
        told.stderr
    );
    assert!(told.stdout.contains("passing.gif\n"), "{}", told.stdout);
    assert_eq!(desk.names(".mp4"), [""; 0]);
    assert_eq!(desk.names(".tmp"), [""; 0]);
}

#[cfg(unix)]
#[test]
fn an_ffmpeg_that_fails_leaves_no_file_and_its_last_words_are_quoted() {
    let desk = Desk::small("video = \"mp4\"\napng = true");
    for script in [
        "#!/bin/sh\nhead -c 20000 > /dev/null\necho 'disk on fire' >&2\nexit 1\n",
        "#!/bin/sh\ncat > /dev/null\necho 'disk on fire' >&2\nexit 1\n",
        "#!/bin/sh\necho 'disk on fire' >&2\nkill -9 $$\n",
    ] {
        let path = desk.with_ffmpeg(script);
        let told = desk.call_with_path(&["assemble", "passing.toml"], &path);
        assert_eq!(told.status, 1, "{script}");
        assert!(
            told.stderr.contains("passing.mp4: ffmpeg failed"),
            "{}",
            told.stderr
        );
        assert!(told.stderr.contains("disk on fire"), "{}", told.stderr);
        assert_eq!(desk.names(".mp4"), [""; 0]);
        assert_eq!(desk.names(".tmp"), [""; 0]);
        assert_eq!(desk.names(".apng").len(), 1);
    }
}

#[cfg(unix)]
#[test]
fn a_video_with_fewer_frames_than_went_in_is_not_kept() {
    let desk = Desk::small("video = \"mp4\"");
    // It encodes the first five frames and says nothing.
    let script = "#!/bin/sh\nhead -c 61440 | /usr/bin/env -i PATH=/usr/bin:/bin ffmpeg \"$@\"\n\
                  cat > /dev/null\nexit 0\n";
    let path = desk.with_ffmpeg(script);
    let told = desk.call_with_path(&["assemble", "passing.toml"], &path);
    assert_eq!(told.status, 1);
    assert!(
        told.stderr.contains("a video of 5 frames from 10"),
        "{}",
        told.stderr
    );
    assert_eq!(desk.names(".mp4"), [""; 0]);
}

#[cfg(unix)]
#[test]
fn a_torn_video_of_an_ffmpeg_that_ends_well_is_not_kept() {
    let desk = Desk::small("video = \"mp4\"");
    // The file is its last argument.
    let script = "#!/bin/sh\ncat > /dev/null\nfor file; do :; done\nprintf torn > \"$file\"\n";
    let path = desk.with_ffmpeg(script);
    let told = desk.call_with_path(&["assemble", "passing.toml"], &path);
    assert_eq!(told.status, 1);
    let why = "passing.mp4: ffmpeg left a video that ffprobe cannot read";
    assert!(told.stderr.contains(why), "{}", told.stderr);
    assert_eq!(desk.names(".mp4"), [""; 0]);
    assert_eq!(desk.names(".tmp"), [""; 0]);
}
