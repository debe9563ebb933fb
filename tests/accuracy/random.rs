//! Random surfaces and lamps such as an author would write, by a fixed seed.

use restframe::spectrum::{Beyond, Cardinal, PlanckShape, Spectrum, Uplift, illuminant};

/// Steele, Lea and Flood's generator SplitMix64 (2014, Fast splittable pseudorandom number
/// generators): the same numbers on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform from 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Uniform in its logarithm.
    pub(crate) fn ratio(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// One of the kinds of reflectance.
    pub(crate) fn reflectance(&mut self) -> Spectrum {
        match self.below(3) {
            0 => self.spline(),
            1 => Spectrum::gaussian(self.between(400.0, 700.0), self.between(9.0, 80.0)).unwrap(),
            _ => self.color(),
        }
    }

    /// Through 3 to 12 points over the visible, no closer than 12 nm.
    fn spline(&mut self) -> Spectrum {
        let count = 3 + self.below(10);
        let step = 340.0 / (count - 1) as f64;
        let points: Vec<(f64, f64)> = (0..count)
            .map(|i| {
                let off = self.between(-0.3, 0.3) * step;
                (380.0 + i as f64 * step + off, self.unit())
            })
            .collect();
        Spectrum::Cardinal(Cardinal::new(&points, self.tension(), Beyond::Hold).unwrap())
    }

    fn tension(&mut self) -> f64 {
        [0.0, 0.0, 0.5][self.below(3)]
    }

    /// Any colour, every other one with a component of 0 or 1.
    fn color(&mut self) -> Spectrum {
        let mut rgb = [self.unit(), self.unit(), self.unit()];
        if self.below(2) == 0 {
            rgb[self.below(3)] = self.below(2) as f64;
        }
        Spectrum::Rgb(Uplift::new(rgb).unwrap())
    }

    /// One of the kinds of lamp.
    pub(crate) fn lamp(&mut self) -> Spectrum {
        const NAMES: [&str; 7] = ["A", "C", "D50", "D55", "D65", "D75", "E"];
        match self.below(4) {
            0 => illuminant("D65").unwrap(),
            1 => illuminant(NAMES[self.below(NAMES.len())]).unwrap(),
            // A table of the visible; ends go on where an author says nothing.
            2 => {
                let beyond = [Beyond::Hold, Beyond::Zero][self.below(2)];
                self.diode([380.0, 780.0], beyond)
            }
            _ => self.black_body(2000.0, 20_000.0),
        }
    }

    pub(crate) fn black_body(&mut self, coldest: f64, hottest: f64) -> Spectrum {
        let kelvin = self.ratio(coldest, hottest);
        Spectrum::Planck(PlanckShape::new(kelvin, 560.0).unwrap())
    }

    /// A white diode: a blue band and a broad yellow one, as points each 5 to 10 nm over a range,
    /// and what an author says of it beyond.
    pub(crate) fn diode(&mut self, range_nm: [f64; 2], beyond: Beyond) -> Spectrum {
        let bands = [
            (1.0, self.between(440.0, 465.0), self.between(9.0, 15.0)),
            (
                self.between(0.3, 0.9),
                self.between(540.0, 600.0),
                self.between(40.0, 60.0),
            ),
        ];
        let step = self.between(5.0, 10.0);
        let value = |nm: f64| -> f64 {
            let band = |(peak, center, width): (f64, f64, f64)| {
                peak * (-0.5 * ((nm - center) / width).powi(2)).exp()
            };
            bands.into_iter().map(band).sum()
        };
        let points: Vec<(f64, f64)> = (0..)
            .map(|i| range_nm[0] + step * f64::from(i))
            .take_while(|nm| *nm <= range_nm[1])
            .map(|nm| (nm, value(nm)))
            .collect();
        Spectrum::Cardinal(Cardinal::new(&points, 0.0, beyond).unwrap())
    }
}
