//! The results of Hsiung et al. 1990, §6, beside those of a study: the time of each effect as a
//! share of the time of everything else.

use super::interleaved_timing::Measured;
use super::results::PaperRow;
use super::timed_render::phase;

/// The renders from which the rows are computed.
pub(super) struct Compared<'a> {
    /// The shot unchanged.
    pub(super) current: &'a Measured,
    /// Without shift, by RGB.
    pub(super) rgb: &'a Measured,
    /// With shift, by lines of 5 nm, splines of 81 wavelengths, the grid of 84.
    pub(super) lines: &'a Measured,
    pub(super) spline: &'a Measured,
    pub(super) grid: &'a Measured,
    /// Whether the sensor's window contains any line of 5 nm spacing.
    pub(super) lines_seen: bool,
    /// Whether the image needs geometry, and shifts.
    pub(super) geometry: bool,
    pub(super) doppler: bool,
}

impl Compared<'_> {
    /// The table.
    pub(super) fn rows(&self) -> Vec<PaperRow> {
        let over_rgb = |held: &Measured| {
            let rest = self.rgb.frame().median;
            self.doppler.then(|| held.frame().median / rest - 1.0)
        };
        let row = |what: &str, paper: &str, ours: Option<f64>, how: String| PaperRow {
            what: what.to_owned(),
            paper: paper.to_owned(),
            ours,
            how,
        };
        let shade = |held: &Measured| held.phase(phase("shade")).median;
        let over_grid = |held: &Measured| shade(held) / shade(self.grid);
        let image = "whole image over that of three numbers without shift";
        vec![
            row(
                "Boosts of camera rays, as for finite light speed",
                "under 5 %",
                self.geometry.then(|| self.boosts()),
                "seconds of boosts over those of all other phases".to_owned(),
            ),
            row(
                "Doppler effect by lines of 5 nm, resampled at every shift",
                "over 100 %",
                over_rgb(self.lines).filter(|_| self.lines_seen),
                format!(
                    "{image}; shading alone takes {:.0} times that of the grid of 84",
                    over_grid(self.lines)
                ),
            ),
            row(
                "Doppler effect by splines, 81 wavelengths",
                "about 2 %",
                over_rgb(self.spline),
                format!(
                    "{image}; shading alone takes {:.0} times that of the grid of 84",
                    over_grid(self.spline)
                ),
            ),
            row(
                "Doppler effect by the grid, 84 wavelengths",
                "",
                over_rgb(self.grid),
                image.to_owned(),
            ),
        ]
    }

    fn boosts(&self) -> f64 {
        let boosts = self.current.phase(phase("boost")).median;
        let all: f64 = (0..super::timed_render::PHASES.len())
            .map(|i| self.current.phase(i).median)
            .sum();
        boosts / (all - boosts)
    }
}
