//! Work that is watched: stopped, counted, and timed.

use super::{Changes, member, options, prepared, scene, together};
use restframe::accel::Aggregate;
use restframe::frame::Frame;
use restframe::render::{Member, Options, Stopped, Watch, render_together};
use restframe::shot::{Track, Velocity};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// From being told to having returned: some milliseconds, and what a busy machine adds.
const PROMPT: Duration = Duration::from_millis(500);

/// How long it takes to stop images in their midst; and the rays that were finished before.
fn stopped(members: &[Member<'_>], aggregate: &Aggregate, options: &Options) -> (Duration, u64) {
    let (stop, rays) = (AtomicBool::new(false), AtomicU64::new(0));
    let done = |more: u64| {
        rays.fetch_add(more, Ordering::Relaxed);
    };
    let watch = Watch {
        done: &done,
        stop: &stop,
    };
    // Its own: other tests keep the threads of the common one busy.
    let pool = rayon::ThreadPoolBuilder::new().build().unwrap();
    let (told, returned) = std::thread::scope(|threads| {
        let work = threads.spawn(|| {
            let result = pool.install(|| render_together(members, aggregate, options, watch));
            (result, Instant::now())
        });
        while rays.load(Ordering::Relaxed) == 0 {
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(50));
        let told = Instant::now();
        stop.store(true, Ordering::Relaxed);
        let (result, returned) = work.join().unwrap();
        assert!(matches!(result, Err(Stopped)));
        (told, returned)
    });
    (returned - told, rays.load(Ordering::Relaxed))
}

#[test]
fn a_stop_in_mid_render_is_prompt_at_heavy_sampling() {
    let changes: [Changes<'_>; 4] = [
        &[],
        &[("ACCURACY", "spectra = \"exact\"")],
        &[("ACCURACY", "spectra = \"lines\"\nline_spacing = 1")],
        &[(
            "PASSES",
            "mirror = { weight = 0.9, spectrum = 1.0 }\nrefraction = { weight = 1.0, spectrum = 1.0 }",
        )],
    ];
    for change in changes {
        let prepared = prepared(&[change]);
        let (scene, aggregate) = scene(&prepared);
        let members = [member(&prepared, &scene); 16];
        let options = Options {
            width: 640,
            height: 360,
            ..options(65536)
        };
        let (time, rays) = stopped(&members, &aggregate, &options);
        println!("{change:?}: {time:?} after {rays} rays");
        assert!(time < PROMPT, "{change:?}: {time:?}");
    }
}

#[test]
fn a_stop_is_prompt_under_thousands_of_lamps() {
    let lamp = |i: u32| {
        let x = f64::from(i % 50) / 5.0 - 5.0;
        let y = f64::from(i / 50) / 5.0 - 5.0;
        format!("[[light]]\nkind = \"point\"\nposition = [{x}, {y}, 8]\nintensity = 1\n")
    };
    let lamps: String = (0..2500).map(lamp).collect();
    let prepared = prepared(&[&[("PASSES", &lamps)]]);
    let (scene, aggregate) = scene(&prepared);
    let members = [member(&prepared, &scene); 4];
    let (time, _) = stopped(&members, &aggregate, &options(4096));
    println!("{time:?}");
    assert!(time < PROMPT, "{time:?}");
}

#[test]
fn who_is_to_stop_before_the_start_renders_nothing() {
    let prepared = prepared(&[]);
    let (scene, aggregate) = scene(&prepared);
    let stop = AtomicBool::new(true);
    let watch = Watch {
        done: &|_| unreachable!("no ray is traced"),
        stop: &stop,
    };
    let members = [member(&prepared, &scene); 2];
    let result = render_together(&members, &aggregate, &options(4), watch);
    assert!(matches!(result, Err(Stopped)));
}

#[test]
fn every_ray_is_counted_once_for_each_image() {
    let prepared = prepared(&[]);
    let (scene, aggregate) = scene(&prepared);
    let members = [member(&prepared, &scene); 3];
    for samples in [3, 2500] {
        let options = Options {
            width: 5,
            height: 9,
            ..options(samples)
        };
        let rays = AtomicU64::new(0);
        let done = |more: u64| {
            rays.fetch_add(more, Ordering::Relaxed);
        };
        let stop = &AtomicBool::new(false);
        let watch = Watch { done: &done, stop };
        render_together(&members, &aggregate, &options, watch).unwrap();
        assert_eq!(rays.into_inner(), 5 * 9 * 3 * u64::from(samples));
    }
}

/// The three leave out what is done once around them: films made and put together.
#[test]
fn seconds_add_up_to_those_of_the_clock_on_the_wall() {
    const LEFT_OUT: f64 = 0.05;
    let prepared = prepared(&[]);
    let (scene, aggregate) = scene(&prepared);
    let members = [member(&prepared, &scene); 8];
    let options = Options {
        width: 160,
        height: 90,
        ..options(16)
    };
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let stop = &AtomicBool::new(false);
        let watch = Watch {
            done: &|_| (),
            stop,
        };
        let (told, whole) = pool.unwrap().install(|| {
            let begun = Instant::now();
            let told = render_together(&members, &aggregate, &options, watch).unwrap();
            (told, begun.elapsed().as_secs_f64())
        });
        let sum = told.prepare + told.trace + told.shade;
        println!(
            "{:.3} + {:.3} + {:.3} of {whole:.3} s",
            told.prepare, told.trace, told.shade
        );
        assert!((sum / whole - 1.0).abs() < LEFT_OUT, "{sum} s of {whole}");
        assert!(told.prepare > 0.0 && told.trace > 0.0 && told.shade > 0.0);
    }
}

#[test]
fn tracing_is_not_repeated_for_every_image() {
    let prepared = prepared(&[]);
    let (scene, aggregate) = scene(&prepared);
    let options = Options {
        width: 160,
        height: 90,
        ..options(16)
    };
    let traces = [1, 12].map(|count| {
        let members = vec![member(&prepared, &scene); count];
        together(1, &members, &aggregate, &options).unwrap().trace
    });
    println!("{traces:?} s");
    // Twelve times as long, if it were; other work on the machine may double either.
    assert!(traces[1] < 5.0 * traces[0], "{traces:?}");
}

#[test]
fn a_frame_whose_velocity_fails_is_refused_and_named() {
    let mut failing = prepared(&[]).shot;
    // No shot that can be read has it.
    failing.worldline["fast"].velocity = Velocity::Beta(Track::Constant([0.0, 1.5, 0.0]));
    let mistakes = Frame::new(&failing, 1).expect_err("nothing is so fast");
    let mistake = mistakes.iter().next().unwrap();
    assert_eq!(mistake.key, "worldline.fast.velocity");
    let message = "worldline \"fast\" has no velocity in frame 1: ";
    assert!(mistake.message.starts_with(message), "{mistake:?}");
}
