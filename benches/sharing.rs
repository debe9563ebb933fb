//! Images that share a trace, k of them together and k alone: read them as ratios of one run.
//!
//! With `RESTFRAME_RAMP=100` it is timed once instead how long a ramp of so many temperatures takes
//! at 1280 × 720 and 16 samples, together and one by one, files encoded but not written.

mod shell;

use divan::Bencher;
use rayon::prelude::*;
use restframe::accel::Aggregate;
use restframe::film::Film;
use restframe::frame::Frame;
use restframe::render::Prepared;
use restframe::render::{
    Member, Options, PictureInfo, Watch, encode, film_bytes, render, render_together,
};
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use shell::shell;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

fn main() {
    match std::env::var("RESTFRAME_RAMP").map(|frames| frames.parse()) {
        Ok(Ok(frames)) => time_ramp(frames),
        _ => divan::main(),
    }
}

/// Images of a scene in which every ray hits, on one thread.
struct Images {
    prepared: Prepared,
    scene: Scene,
    aggregate: Aggregate,
    options: Options,
    pool: rayon::ThreadPool,
}

impl Images {
    /// Most time goes into shadow rays.
    fn slow_to_trace() -> Self {
        Self::new("shell", "", "", [160, 90])
    }

    /// Most time goes into spectra: the lamp's shift is not that of the shell.
    fn slow_to_shade() -> Self {
        let (effects, accuracy) = ("shadows = \"off\"", "spectra = \"spline\"");
        Self::new("lab", effects, accuracy, [32, 18])
    }

    fn new(lamp: &str, effects: &str, accuracy: &str, [width, height]: [u32; 2]) -> Self {
        let (prepared, scene, aggregate) = shell(0.5, lamp, effects, accuracy);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        Self {
            prepared,
            scene,
            aggregate,
            options: Options {
                width,
                height,
                samples: 16,
                layers: Vec::new(),
            },
            pool: pool.expect("a thread can be had"),
        }
    }

    fn together(&self, count: usize) -> Vec<Film> {
        let frame = &Frame::new(&self.prepared.shot, 1).expect("it moves");
        let scene = &self.scene;
        let member = Member { frame, scene };
        let members = vec![member; count];
        films(&self.pool, &members, &self.aggregate, &self.options)
    }

    fn alone(&self, count: usize) -> Vec<Film> {
        let (shot, scene, aggregate) = (&self.prepared.shot, &self.scene, &self.aggregate);
        let one = |_| {
            render(
                &Frame::new(shot, 1).expect("it moves"),
                scene,
                aggregate,
                &self.options,
                &|_| (),
            )
        };
        self.pool.install(|| (0..count).map(one).collect())
    }
}

fn films(
    pool: &rayon::ThreadPool,
    members: &[Member<'_>],
    aggregate: &Aggregate,
    options: &Options,
) -> Vec<Film> {
    let stop = &AtomicBool::new(false);
    let watch = Watch {
        done: &|_| (),
        stop,
    };
    let rendered = pool.install(|| render_together(members, aggregate, options, watch));
    rendered.expect("nothing keeps it from rendering").films
}

#[divan::bench(args = [1, 4, 16], sample_count = 5)]
fn slow_to_trace_together(bencher: Bencher<'_, '_>, count: usize) {
    let images = Images::slow_to_trace();
    bencher.bench_local(|| images.together(count));
}

#[divan::bench(args = [1, 4, 16], sample_count = 5)]
fn slow_to_trace_alone(bencher: Bencher<'_, '_>, count: usize) {
    let images = Images::slow_to_trace();
    bencher.bench_local(|| images.alone(count));
}

#[divan::bench(args = [1, 4, 16], sample_count = 5)]
fn slow_to_shade_together(bencher: Bencher<'_, '_>, count: usize) {
    let images = Images::slow_to_shade();
    bencher.bench_local(|| images.together(count));
}

#[divan::bench(args = [1, 4, 16], sample_count = 5)]
fn slow_to_shade_alone(bencher: Bencher<'_, '_>, count: usize) {
    let images = Images::slow_to_shade();
    bencher.bench_local(|| images.alone(count));
}

/// The rows of spheres of shots/rows.toml at 0.5 c, ever hotter.
fn ramp(frames: u32) -> Prepared {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("shots/rows.toml")).expect("the shot is there");
    let line = |line: &str| {
        let key = line.split('=').next().unwrap_or_default().trim();
        match key {
            "frames" => format!("frames = {frames}"),
            "velocity" => "velocity = [-0.5, 0, 0]".to_owned(),
            "temperature" => "temperature = { from = 1000, to = 20000 }".to_owned(),
            _ => line.replace("../assets", &root.join("assets").display().to_string()),
        }
    };
    let text: Vec<String> = text.lines().map(line).collect();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench-ramp.toml");
    std::fs::write(&path, text.join("\n")).expect("the target folder can be written to");
    Prepared::read(&path).expect("the shot has no mistake")
}

fn time_ramp(frames: u32) {
    /// As many films at once as a batch holds.
    const HELD: u64 = 512 << 20;
    let Prepared { shot, library } = ramp(frames);
    let options = Options {
        width: 1280,
        height: 720,
        samples: 16,
        layers: Vec::new(),
    };
    let pool = rayon::ThreadPoolBuilder::new().build();
    let pool = pool.expect("threads can be had");
    let frame = |number| Frame::new(&shot, number).expect("it moves");
    let resolve = |frame: &Frame<'_>, earlier: Option<&Scene>| {
        Scene::resolve(frame, &library, earlier).expect("it resolves")
    };
    let first = resolve(&frame(1), None);
    let aggregate = build_aggregate(&first.geometry, None);
    let encode = |frame: &Frame<'_>, scene: &Scene, film: &Film| {
        let taken = PictureInfo {
            exposure_stops: -9.3,
            samples: 16,
            fingerprint: None,
        };
        let files = encode(frame, scene, film, &[], taken);
        files.expect("it can be encoded").files[0].1.len()
    };

    let begun = Instant::now();
    let mut together = Vec::new();
    let held = (HELD / film_bytes(&options)) as usize;
    let numbers: Vec<u32> = (1..=frames).collect();
    for batch in numbers.chunks(held) {
        let frames: Vec<Frame<'_>> = batch.iter().map(|number| frame(*number)).collect();
        let scenes: Vec<Scene> = frames.iter().map(|f| resolve(f, Some(&first))).collect();
        let member = |(frame, scene)| Member { frame, scene };
        let members: Vec<_> = frames.iter().zip(&scenes).map(member).collect();
        let films = films(&pool, &members, &aggregate, &options);
        let sizes: Vec<usize> = pool.install(|| {
            let all = members.par_iter().zip(&films);
            all.map(|(m, film)| encode(m.frame, m.scene, film))
                .collect()
        });
        together.extend(sizes);
    }
    let shared = begun.elapsed().as_secs_f64();

    let begun = Instant::now();
    let mut alone = Vec::new();
    for number in 1..=frames {
        let frame = frame(number);
        let scene = resolve(&frame, Some(&first));
        let film = pool.install(|| render(&frame, &scene, &aggregate, &options, &|_| ()));
        alone.push(pool.install(|| encode(&frame, &scene, &film)));
    }
    let apart = begun.elapsed().as_secs_f64();
    assert_eq!(together, alone, "the files are the same");
    let ratio = shared / apart;
    println!("{frames} frames: {shared:.2} s together, {apart:.2} s one by one, ratio {ratio:.3}");
}
