//! The quadrature by itself.

use restframe::color::cie::{EFFICACY, xyz_bar, xyz_with_substeps};
use restframe::spectrum::quadrature::cuts_nm;
use restframe::spectrum::{
    Beyond, Cardinal, PlanckShape, Quadrature, Sampled, Spectrum, Uplift, illuminant, planck,
};

/// What is claimed of a channel, over the greatest.
const CLAIM: f64 = 1e-9;

const VISIBLE: [f64; 2] = [360.0, 830.0];

fn assert_near(found: [f64; 3], exact: [f64; 3], what: &str) {
    let greatest = exact.into_iter().fold(0.0, f64::max);
    for (found, exact) in found.into_iter().zip(exact) {
        let error = (found - exact).abs() / greatest;
        assert!(error < CLAIM, "{what}: {found:e}, not {exact:e}: {error:e}");
    }
}

/// XYZ of a product of curves, each under its shift.
fn xyz(factors: &[(&Spectrum, f64)]) -> [f64; 3] {
    let mut cuts = Vec::new();
    for (spectrum, shift) in factors {
        cuts_nm(spectrum, *shift, &mut cuts);
    }
    Quadrature::cie1931(VISIBLE).channels(&mut cuts, |nm| product(factors, nm))
}

fn product(factors: &[(&Spectrum, f64)], nm: f64) -> f64 {
    factors.iter().map(|(s, shift)| s.at(shift * nm)).product()
}

/// Romberg's extrapolation of the trapezoidal rule from two, twice and four times `per_nm` steps a
/// nm: bends must stand at whole steps.
fn romberg(curve: impl Fn(f64) -> f64, per_nm: u32) -> [f64; 3] {
    let [coarse, middle, fine] = [1, 2, 4].map(|times| xyz_with_substeps(&curve, times * per_nm));
    [0, 1, 2].map(|c| {
        let [first, second] = [(coarse, middle), (middle, fine)]
            .map(|(a, b): ([f64; 3], [f64; 3])| (4.0 * b[c] - a[c]) / 3.0);
        (16.0 * second - first) / 15.0
    })
}

/// The oracle is good to a tenth of the claim: twice as many steps do not change it by more.
fn assert_is_romberg(factors: &[(&Spectrum, f64)], what: &str) {
    let [once, twice] = [8, 16].map(|per_nm| romberg(|nm| product(factors, nm), per_nm));
    let greatest = twice.into_iter().fold(0.0, f64::max);
    for c in 0..3 {
        assert!(
            (once[c] - twice[c]).abs() < 0.1 * CLAIM * greatest,
            "{what}"
        );
    }
    assert_near(xyz(factors), twice, what);
}

#[test]
fn powers_of_the_wavelength_have_their_closed_forms_in_bands() {
    for window in [VISIBLE, [1e-9, 1e-3], [1e7, 1e9], [589.0, 589.001]] {
        let [a, b] = window;
        let ends = [0.0, 1.0, 2.0, 3.0].map(|i: f64| a * (b / a).powf(i / 3.0));
        for power in [-5, -1, 0, 1, 2, 3, 5] {
            // Over the window's middle, lest 1e9⁵ be clamped to a whole other curve.
            let unit = (a * b).sqrt();
            let area = |from: f64, to: f64| match power {
                -1 => unit * (to / from).ln(),
                p => {
                    let p = f64::from(p);
                    unit.powf(-p) * (to.powf(p + 1.0) - from.powf(p + 1.0)) / (p + 1.0)
                }
            };
            let found =
                Quadrature::bands(window).channels(&mut Vec::new(), |nm| (nm / unit).powi(power));
            if b / a > 1.001 {
                let exact = [2, 1, 0].map(|i: usize| area(ends[i], ends[i + 1]));
                assert_near(found, exact, &format!("{window:?} {power}"));
            } else {
                // Differences of powers cancel there; the curve is 1 within 5e-6 of 1e-6.
                let third = [2, 1, 0].map(|i: usize| ends[i + 1] - ends[i]);
                for (found, third) in found.into_iter().zip(third) {
                    assert!((found / third - 1.0).abs() < 1e-5);
                }
            }
        }
    }
}

#[test]
fn smooth_curves_and_polylines_match_extrapolated_sums() {
    let spline = |tension| {
        let points = [(380.0, 0.3), (450.5, 0.9), (540.25, 0.2), (700.0, 0.7)];
        Spectrum::Cardinal(Cardinal::new(&points, tension, Beyond::Hold).unwrap())
    };
    let [taut, loose] = [0.5, 0.0].map(spline);
    let [d65, a, f11] = ["D65", "A", "F11"].map(|name| illuminant(name).unwrap());
    let broad = Spectrum::gaussian(560.3, 9.0).unwrap();
    let line = Spectrum::gaussian(471.77, 1.5).unwrap();
    let paint = Spectrum::Rgb(Uplift::new([0.8, 0.0, 0.3]).unwrap());
    let body = Spectrum::Planck(PlanckShape::new(900.0, 560.0).unwrap());
    for (number, factors) in [
        &[(&Spectrum::Constant(0.7), 1.0)][..],
        &[(&taut, 1.0)],
        &[(&loose, 1.0), (&d65, 1.0)],
        &[(&d65, 0.5), (&broad, 1.0)],
        &[(&f11, 1.0), (&a, 1.0), (&paint, 1.0)],
        &[(&line, 1.0), (&body, 0.3)],
        &[(&broad, 1.2)],
        &[(&paint, 0.625), (&body, 3.0)],
    ]
    .into_iter()
    .enumerate()
    {
        assert_is_romberg(factors, &format!("case {number}"));
    }
}

/// The spline dips below 0 at places that no one tells the quadrature, and is clamped there; a
/// reflectance is clamped at 1.
#[test]
fn bends_at_unknown_places_are_found() {
    let points = [0.0, 0.0, 1.0, 0.0, 0.3, 1.0, 1.0, 0.2];
    let points: Vec<_> = (0..)
        .map(|i| 400.0 + 50.0 * f64::from(i))
        .zip(points)
        .collect();
    let spline = Cardinal::new(&points, 0.0, Beyond::Hold).unwrap();
    let curve = |nm: f64| spline.at(nm).min(1.0);
    let mut cuts = spline.knots_nm().to_vec();
    let found = Quadrature::cie1931(VISIBLE).channels(&mut cuts, curve);
    // A step that holds a bend of slope J errs by J/8 of its square: 4e-12 here, at 1/2048 nm.
    let exact = xyz_with_substeps(curve, 2048);
    assert_near(found, exact, "clamped spline");
}

/// The area of a gaussian times the weight where it is: between two whole nm the weight is linear.
#[test]
fn a_line_of_a_hundredth_nm_is_found_wherever_it_stands() {
    for (center, shift) in [(589.4321, 1.0), (450.5, 1.0), (100.13, 0.2), (1e4, 17.77)] {
        let width = 0.01 * shift;
        let line = Spectrum::gaussian(center, width).unwrap();
        let area = 0.01 * std::f64::consts::TAU.sqrt();
        let exact = xyz_bar(center / shift).map(|bar| EFFICACY * area * bar);
        assert_near(xyz(&[(&line, shift)]), exact, &format!("{center} {shift}"));
        let mut cuts = Vec::new();
        cuts_nm(&line, shift, &mut cuts);
        let widest = Quadrature::bands([1e-9, 1e15]);
        let bands = widest.channels(&mut cuts, |nm| line.at(shift * nm));
        assert_near(
            bands,
            [0.0, area, 0.0],
            "in the middle of the widest window",
        );
    }
}

#[test]
fn a_polyline_that_jumps_at_its_ends_is_cut_there() {
    let step = Sampled::new(&[(500.3, 1.0), (500.7, 1.0)], Beyond::Zero).unwrap();
    let step = Spectrum::Sampled(step);
    for shift in [1.0, 0.9, 1.3] {
        // The weights are linear over each nm: a middle and a width do for each.
        let ends = [500.3 / shift, 500.7 / shift];
        let mut edges = vec![ends[0], ends[1]];
        edges.extend(
            (360..=830)
                .map(f64::from)
                .filter(|nm| *nm > ends[0] && *nm < ends[1]),
        );
        edges.sort_by(f64::total_cmp);
        let mut exact = [0.0; 3];
        for pair in edges.windows(2) {
            let bar = xyz_bar(0.5 * (pair[0] + pair[1]));
            (0..3).for_each(|c| exact[c] += EFFICACY * bar[c] * (pair[1] - pair[0]));
        }
        assert_near(xyz(&[(&step, shift)]), exact, &format!("{shift}"));
    }
}

/// Stefan and Boltzmann, and parts of it by Planck's series Σ e⁻ⁿˣ (x³/n + 3x²/n² + 6x/n³ + 6/n⁴).
#[test]
fn black_bodies_have_their_totals_in_the_widest_windows() {
    for kelvin in [3.0, 300.0, 5800.0, 1e7] {
        let all = Quadrature::bands([1e-9, 1e15])
            .channels(&mut Vec::new(), |nm| planck::radiance(nm, kelvin));
        let sum: f64 = all.iter().sum();
        assert!(
            (sum / planck::total(kelvin) - 1.0).abs() < CLAIM,
            "{kelvin}: {sum:e}"
        );
        let above = |nm: f64| -> f64 {
            let x = planck::C2 / nm / kelvin;
            let term = |n: f64| {
                let powers = x.powi(3) / n + 3.0 * x * x / n.powi(2) + 6.0 * x / n.powi(3);
                (-n * x).exp() * (powers + 6.0 / n.powi(4))
            };
            (1..80).map(|n| term(f64::from(n))).sum()
        };
        // In Wien's part and about the peak.
        let window = [0.1, 3.0].map(|part| part * planck::peak_nm(kelvin));
        let end = |i: f64| window[0] * 30f64.powf(i / 3.0);
        let scale = planck::C1 * (kelvin / planck::C2).powi(4);
        let exact = [2.0, 1.0, 0.0].map(|i| scale * (above(end(i + 1.0)) - above(end(i))));
        let found =
            Quadrature::bands(window).channels(&mut Vec::new(), |nm| planck::radiance(nm, kelvin));
        assert_near(found, exact, &format!("{kelvin} K"));
    }
}
