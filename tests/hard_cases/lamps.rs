//! E. Lamps and shadows.

use super::eye::{Eye, sphere};
use super::scene::Set;
use glam::DVec3;
use restframe::probe::Probe;
use restframe::relativity::Celerity;

const HEAD: &str =
    "[sensor]\nexposure = 0\n[material.paper]\ndiffuse = { weight = 0.5, spectrum = 1.0 }\n";

/// Whether light comes from a pixel.
fn is_lit(probe: &Probe) -> bool {
    probe.xyz[1] > 0.0
}

/// Where and when, in the lab, what a pixel sees was.
fn place(probe: &Probe) -> (f64, DVec3) {
    let event = &probe.hit.as_ref().unwrap().event;
    (event.t, DVec3::from(event.x))
}

/// The rapidities along x of what E3 moves, and the lab events that it passes.
const LAMP: (f64, [f64; 2]) = (-0.5, [-17.0, 0.0]);
const SCREEN: (f64, [f64; 2]) = (1.2, [-14.0, 0.5]);
const SLIDING: (f64, [f64; 2]) = (-0.9, [-15.0, -0.5]);

/// A floor, a lamp 5 above it, a screen across its motion and one that slides in its own plane, all
/// seen from above, and all in a frame in which they move with a further rapidity along x: the
/// axes of rest frames that move along one line are those of the lab.
fn shadows(rapidity: f64) -> Vec<Probe> {
    let moving = |name: &str, (own, [t, x]): (f64, [f64; 2])| {
        let (sum, (sinh, cosh)) = (own + rapidity, (rapidity.sinh(), rapidity.cosh()));
        let (at, passes) = (cosh * t + sinh * x, cosh * x + sinh * t);
        format!(
            "[worldline.{name}]\nvelocity = {{ rapidity = {:?}, direction = [{:?}, 0, 0] }}\n\
             at = {at:?}\npasses = [{passes:?}, 0, 0]\n",
            sum.abs(),
            sum.signum()
        )
    };
    let set = Set::new(&format!(
        "[image]\nsize = [64, 64]\n{HEAD}{}{}{}{}\
         [[model]]\nname = \"floor\"\nfile = \"wall.obj\"\nmaterial = \"paper\"\nworldline = \"room\"\n\
         rotate = [-90, 0, 0]\nscale = 10\n\
         [[model]]\nname = \"screen\"\nfile = \"wall.obj\"\nmaterial = \"paper\"\nworldline = \"screen\"\n\
         rotate = [0, 90, 0]\ntranslate = [0, 2, 0]\n\
         [[model]]\nname = \"sliding\"\nfile = \"wall.obj\"\nmaterial = \"paper\"\nworldline = \"sliding\"\n\
         translate = [0, 3, -1]\n\
         [[light]]\nkind = \"point\"\nworldline = \"lamp\"\nposition = [0, 5, 0]\nscale = 1.0\nspectrum = 1.0\n\
         [camera]\nworldline = \"room\"\nposition = [0, 12, 0.01]\nlook_at = [0, 0, 0]\nhfov = 75\n",
        moving("room", (0.0, [0.0, 0.0])),
        moving("lamp", LAMP),
        moving("screen", SCREEN),
        moving("sliding", SLIDING)
    ));
    Eye::new(&set).probes()
}

/// Whether a screen of [`shadows`] at rapidity 0 stands on the light path to an event of the floor,
/// all in coordinates of that frame.
fn shaded(t: f64, x: DVec3) -> bool {
    let at =
        |(rapidity, [at, passes]): (f64, [f64; 2]), t: f64| passes + rapidity.tanh() * (t - at);
    // |x − L(t − r)| = r, L moving along x: (1−β²)r² − 2βar − (a² + b²) = 0 with a = x − L(t).
    let beta = LAMP.0.tanh();
    let (a, b2) = (x.x - at(LAMP, t), (x.y - 5.0).powi(2) + x.z * x.z);
    let q = 1.0 - beta * beta;
    let r = (beta * a + (beta * beta * a * a + q * (a * a + b2)).sqrt()) / q;
    let lamp = DVec3::new(at(LAMP, t - r), 5.0, 0.0);
    let path = |share: f64| (t - r * share, x + (lamp - x) * share);
    // The screen's plane: x + share·Δx = x_screen(t − share·r).
    let step = lamp.x - x.x + SCREEN.0.tanh() * r;
    let share = (at(SCREEN, t) - x.x) / step;
    let on_screen = path(share).1;
    let by_screen = (on_screen.y - 2.0).abs() < 1.0 && on_screen.z.abs() < 1.0;
    let second = (-1.0 - x.z) / (lamp.z - x.z);
    let (then, on_sliding) = path(second);
    let by_sliding = (on_sliding.y - 3.0).abs() < 1.0
        && (on_sliding.x - at(SLIDING, then)).abs() < 1.0 / SLIDING.0.cosh();
    let within = |share: f64| share > 0.0 && share < 1.0;
    (within(share) && by_screen) || (within(second) && by_sliding)
}

/// Light of direction n as it travels in the rest frame of a body of celerity u, as textbooks have it.
fn aberrated(u: Celerity, n: DVec3) -> DVec3 {
    let (lorentz_factor, u) = (u.lorentz_factor(), u.vector());
    (n + u * (u.dot(n) / (lorentz_factor + 1.0) - 1.0)) / (lorentz_factor - u.dot(n))
}

cases! {
    /// A verdict turns where a path passes an edge by less than rounding; none of these does.
    fn e3_a_shadow_is_the_same_in_every_frame(card) {
        let at_rest = shadows(0.0);
        let on_floor = |probe: &Probe| probe.hit.as_ref().is_some_and(|hit| hit.model == "floor");
        let verdicts: Vec<Option<bool>> = at_rest.iter()
            .map(|probe| on_floor(probe).then(|| { let (t, x) = place(probe); !shaded(t, x) }))
            .collect();
        let dark = verdicts.iter().filter(|lit| **lit == Some(false)).count();
        card.holds("there is a shadow, and light", dark > 200 && dark < 2000);
        for rapidity in [0.0, 1.0, -3.0, 7.6_f64] {
            let seen = shadows(rapidity);
            let wrong = seen.iter().zip(&verdicts)
                .filter(|(probe, lit)| lit.map_or(on_floor(probe), |lit| !on_floor(probe) || is_lit(probe) != lit))
                .count();
            let what = format!("verdicts that differ of 4096, all at γ = {:.1}", rapidity.cosh());
            card.same(&what, 0.0, wrong as f64);
        }
    }

    /// A ray of shadow starts 1e3 roundings off the surface and is as long as from it, so it ends
    /// within 1e-11 m of the lamp here.
    fn e4_what_is_beyond_a_lamp_casts_no_shadow(card) {
        for (lamp, screen) in [
            ("[0, 0, 0]", "[0, 0, 0]"), ("[0.6, 0, 0.3]", "[-0.8, 0, 0]"),
            ("{ gamma = 1e3, direction = [1, 0, 0] }", "[0, 0, 0]"),
            ("{ gamma = 1e3, direction = [1, 0, 0] }", "{ gamma = 10, direction = [-1, 0, 1] }"),
            ("[0, 0, 0]", "{ gamma = 1e3, direction = [1, 0, 0] }"),
        ] {
            let light = |height: Option<f64>| {
                let sheet = height.map(|height| format!(
                    "[[model]]\nname = \"sheet\"\nfile = \"wall.obj\"\nmaterial = \"paper\"\nworldline = \"sheet\"\n\
                     rotate = [-90, 0, 0]\nscale = 100000\ntranslate = [0, {height:?}, 0]\n"
                )).unwrap_or_default();
                let set = Set::new(&format!(
                    "[image]\nsize = [16, 16]\n{HEAD}[worldline.lamp]\nvelocity = {lamp}\nat = -8\n\
                     [worldline.sheet]\nvelocity = {screen}\nat = -8\n[[model]]\nname = \"floor\"\nfile = \"wall.obj\"\n\
                     material = \"paper\"\nrotate = [-90, 0, 0]\nscale = 10\n{sheet}\
                     [[light]]\nkind = \"point\"\nworldline = \"lamp\"\nposition = [0, 5, 0]\nscale = 1.0\nspectrum = 1.0\n\
                     [camera]\nposition = [0, 2, 0]\npitch = -90\n"
                ));
                let probes = Eye::new(&set).probes();
                assert!(probes.iter().all(|p| p.hit.as_ref().is_some_and(|hit| hit.model == "floor")));
                probes.iter().map(|p| p.radiance.clone()).collect::<Vec<_>>()
            };
            let free = light(None);
            let case = format!("lamp at {lamp}, screen at {screen}");
            card.holds(&format!("lit, {case}"), free.iter().flatten().all(|v| *v > 0.0));
            card.holds(&format!("as much with the screen 1e-9 beyond, {case}"), light(Some(5.0 + 1e-9)) == free);
            let before = light(Some(5.0 - 1e-9));
            card.holds(&format!("dark with it 1e-9 before, {case}"), before.iter().flatten().all(|v| *v == 0.0));
        }
    }

    /// Convex bodies under a sun, which in their own frame shines along (0.5, −1, 0.3). Where a
    /// surface turns to it, it is lit; elsewhere not; and a camera that rides along sees the same
    /// pixels lit whatever speed and size. At γ = 1e3 the textbook's aberration is rounded to 1e-9.
    fn e5_convex_bodies_do_not_shade_themselves(card) {
        let in_rest = DVec3::new(0.5, -1.0, 0.3).normalize();
        let fast = Celerity::from_lorentz_factor(1e3, DVec3::new(1.0, 2.0, 2.0)).unwrap();
        let in_lab = aberrated(fast.reversed(), in_rest);
        let see = |body: &str, size: f64, speed: f64, sun: &str, camera: &str| {
            let direction = if sun == "lab" { in_lab } else { in_rest };
            let set = Set::with(&[("round.obj", &sphere(16, 32))], &format!(
                "[image]\nsize = [64, 64]\n{HEAD}[worldline.fast]\nvelocity = {{ gamma = {speed}, direction = [1, 2, 2] }}\n\
                 at = {:?}\n[[model]]\nfile = \"{body}\"\nmaterial = \"paper\"\nworldline = \"fast\"\nscale = {size:?}\n\
                 rotate = [40, 20, 10]\n[[light]]\nkind = \"sun\"\nworldline = \"{sun}\"\ndirection = [{:?}, {:?}, {:?}]\n\
                 scale = 1.0\nspectrum = 1.0\n[camera]\nworldline = \"{camera}\"\nposition = [0, 0, {:?}]\nhfov = 50\n",
                if camera == "lab" { -5.0 * size } else { 0.0 }, direction.x, direction.y, direction.z, 5.0 * size
            ));
            Eye::new(&set).probes()
        };
        let acne = |probes: &[Probe]| probes.iter().filter(|probe| {
            let cos = probe.hit.as_ref().map_or(-1.0, |hit| -DVec3::from(hit.normal).dot(in_rest));
            cos.abs() > 1e-9 && is_lit(probe) != (cos > 0.0)
        }).count() as f64;
        for body in ["ball.obj", "round.obj", "box.obj"] {
            let at_rest = see(body, 1.0, 1.0, "fast", "fast");
            let lit: Vec<bool> = at_rest.iter().map(is_lit).collect();
            let seen = at_rest.iter().filter(|probe| probe.hit.is_some()).count();
            let count = lit.iter().filter(|lit| **lit).count();
            card.holds(&format!("{body}: lit in part, at rest"), count > 100 && count + 100 < seen);
            for (speed, sun, camera) in [
                (1.0, "fast", "fast"), (1e3, "fast", "fast"), (1e3, "lab", "fast"), (1e3, "lab", "lab"),
            ] {
                let sizes = [1.0, 1e6, 1e-6].map(|size| see(body, size, speed, sun, camera));
                let case = format!("{body} of 1 m, 1e6 m, 1e-6 m, γ = {speed}, sun of {sun}, camera of {camera}");
                card.same(&format!("{case}: pixels lit amiss"), 0.0, sizes.iter().map(|probes| acne(probes)).sum());
                if camera == "fast" {
                    let same = sizes.iter().all(|probes| probes.iter().map(is_lit).eq(lit.iter().copied()));
                    card.holds("lit where they are at rest", same);
                } else {
                    let hits = |probes: &Vec<Probe>| probes.iter().filter(|probe| probe.hit.is_some()).count();
                    card.holds("all are seen", sizes.iter().all(|probes| hits(probes) > 200));
                }
            }
        }
    }

    /// The line's middle by the sum of λ·L over that of L, on a grid of ln λ: of a Gauss curve of 20
    /// nm sampled every 0.6 nm that is exact, so the error is that of the program's curves.
    fn e10_diffuse_light_is_shifted_by_both_angles(card) {
        let (lamp, camera) = (DVec3::new(-4.0, 3.0, 2.0), DVec3::new(1.0, 0.0, 5.0));
        for velocity in [[0.3, -0.2, 0.25], [0.6, 0.0, 0.0], [-0.25, 0.1, -0.3], [0.0, 0.0, 0.3_f64]] {
            let of_line = |center: f64, width: f64| Set::new(&format!(
                "[image]\nsize = [3, 3]\n{HEAD}[accuracy]\nwavelengths = 400\n[worldline.wall]\nvelocity = {velocity:?}\n\
                 at = -5\n[[model]]\nfile = \"wall.obj\"\nmaterial = \"paper\"\nworldline = \"wall\"\nscale = 10\n\
                 [[light]]\nkind = \"point\"\nposition = [-4, 3, 2]\nscale = 1.0\n\
                 spectrum = {{ gaussian = {{ center = {center:?}, width = {width:?} }} }}\n\
                 [camera]\nposition = [1, 0, 5]\nhfov = 20\n"
            ));
            let beta = DVec3::from(velocity);
            let by_angles = |probe: &Probe| {
                let (_, x) = place(probe);
                let (n_in, n_out) = ((x - lamp).normalize(), (camera - x).normalize());
                (n_in, (1.0 - beta.dot(n_in)) / (1.0 - beta.dot(n_out)))
            };
            // A line that is seen in the middle of the sensor's window.
            let set = of_line(550.0, 20.0);
            let ahead = by_angles(&Eye::new(&set).probes()[4]).1;
            let set = of_line(580.0 * ahead, 20.0 * ahead);
            let eye = Eye::new(&set);
            let (mut by_rays, mut by_curves) = (0.0_f64, 0.0_f64);
            for probe in eye.probes() {
                let (n_in, ratio) = by_angles(&probe);
                let received = eye.view().spacetime().link(1, 0).light(n_in).frequency_ratio;
                by_rays = by_rays.max((received * probe.hit.as_ref().unwrap().doppler / ratio - 1.0).abs());
                let weighted = |power: i32| -> f64 {
                    probe.wavelengths.iter().zip(&probe.radiance).map(|(l, v)| v * l.powi(power)).sum()
                };
                // On the grid of ln λ a step is λ long.
                let middle = weighted(2) / weighted(1);
                by_curves = by_curves.max((580.0 * ahead / middle / ratio - 1.0).abs());
            }
            card.at_most(&format!("ν_out/ν_lamp, {ahead:.3} straight ahead, wall at {velocity:?} c"), by_rays, 1e-14);
            card.at_most("and by the middle of a line", by_curves, 1e-6);
        }
    }
}
