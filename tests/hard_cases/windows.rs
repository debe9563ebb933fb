//! C. Windows of the sensor.

use super::scene::Set;
use super::wall::wall;

cases! {
    /// β = 0.6 head-on is D = 2. Relative tolerances: 1e-13 for spectral radiance, whose
    /// exponential has x up to 40; 1e-6 for the film, which holds f32 and black bodies from a table.
    fn c14_a_window_sees_of_a_moving_body_what_its_shift_brings_into_it(card) {
        const VISIBLE: &str = "";
        let thermal = |kelvin: f64| format!("thermal = {{ temperature = {kelvin} }}");
        let [moving, warmer] = [(thermal(3000.0), 0.6), (thermal(6000.0), 0.0)]
            .map(|(light, beta)| glowing(VISIBLE, &light, beta));
        card.at_most("3000 K at D = 2 and 6000 K at rest: curves", apart(&moving, &warmer, 1.0), 1e-13);
        let [moving, warmer] = [moving, warmer].map(|set| set.film().xyz[0].map(f64::from));
        for (name, (moving, warmer)) in ["X", "Y", "Z"].iter().zip(moving.into_iter().zip(warmer)) {
            card.relative(&format!("{name} of the frames, cd/m²"), warmer, moving, 1e-6);
        }

        // D⁵ B(Dλ, T)/B(560, T) = B(λ, DT)/B(560, DT) · B(560, DT)/B(560, T)
        let step = (1.438_776_877_503_933_8e7 / 560.0 / 3000.0_f64).exp_m1()
            / (1.438_776_877_503_933_8e7 / 560.0 / 6000.0_f64).exp_m1();
        let cold = |kelvin: f64, scale: f64| {
            format!("emission = {{ scale = {scale}, spectrum = {{ blackbody = {kelvin} }} }}")
        };
        let moving = glowing(VISIBLE, &cold(3000.0, 1.0), 0.6);
        let warmer = glowing(VISIBLE, &cold(6000.0, step), 0.0);
        card.at_most("emission alike: curves", apart(&moving, &warmer, 1.0), 3e-6);

        let light = format!("{}\n{}", thermal(3000.0), cold(4000.0, 0.01));
        let sensor = |window: [f64; 2]| format!("window = {window:?}\ncolor = \"bands\"");
        let moving = glowing(&sensor([180.0, 415.0]), &light, 0.6);
        let resting = glowing(&sensor([360.0, 830.0]), &light, 0.0);
        card.at_most("half the window at D = 2, spectral radiance over 2⁵", apart(&moving, &resting, 32.0), 1e-6);
        let [moving, resting] = [moving, resting].map(|set| set.film().xyz[0].map(f64::from));
        for (name, (moving, resting)) in ["long", "middle", "short"].iter().zip(moving.into_iter().zip(resting)) {
            card.relative(&format!("{name} third over 2⁴, W/m²/sr"), resting, moving / 16.0, 1e-6);
        }
    }
}

/// A wall that glows.
fn glowing(sensor: &str, light: &str, beta: f64) -> Set {
    wall(
        &format!("[sensor]\nexposure = 0\n{sensor}"),
        light,
        beta,
        0.0,
    )
}

/// Largest relative difference of two curves of radiance, the first over `factor`.
fn apart(one: &Set, other: &Set, factor: f64) -> f64 {
    let [one, other] = [one, other].map(|set| set.probe([0, 0]).radiance);
    let pairs = one.into_iter().zip(other);
    pairs
        .map(|(one, other)| (one / factor / other - 1.0).abs())
        .fold(0.0, f64::max)
}
