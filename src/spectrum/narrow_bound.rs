//! Bound on the error of sums of narrow curves' light, relative to their area ∫ f du.
//!
//! A narrow curve f is integrated ([`Fine`](super::Fine)); the error is in the rest. For the
//! product w g f of a channel's weight w per unit of u = ln λ, a smooth curve g and f, the sum is ∫
//! ŵg f du, so the error is at most the area times max |ŵg − w g|. Between wavelengths, g is a
//! cubic (Catmull-Rom; its kernels are 1.13, h/4 and h²/10); between rows of tables over ln D, w
//! and g are lines or cubics.

/// Rounding error of an f32 operation.
pub(super) const F32: f64 = 6e-8;

/// A channel's weight per unit of ln λ, relative to the channel of an equal-energy white of value
/// 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NarrowKernel {
    most: f64,
    /// Largest change over a step of tables.
    rise: f64,
    /// Largest distance from the straight line over a step.
    sag: f64,
    /// The axis' spacing, and the step of tables.
    spacing: f64,
    table_step: f64,
}

impl NarrowKernel {
    /// The kernel from the parts of a channel in equal steps of ln λ, each `step` wide; 0 beyond.
    pub(super) fn of(parts: &[f64], step: f64, spacing: f64, table_step: f64) -> Self {
        let half = (table_step / step / 2.0).ceil().max(1.0) as usize;
        let at = |i: usize| {
            let part = i.checked_sub(2 * half).and_then(|i| parts.get(i));
            part.copied().unwrap_or(0.0) / step
        };
        let mut own = Self {
            spacing,
            table_step,
            ..Self::default()
        };
        for i in 0..parts.len() + 2 * half {
            let [low, middle, high] = [at(i), at(i + half), at(i + 2 * half)];
            own.most = own.most.max(low);
            own.rise = own.rise.max((high - low).abs());
            own.sag = own.sag.max((middle - 0.5 * (low + high)).abs());
        }
        own
    }

    /// The error that a smooth curve of peak 1 adds, from the variations of it and its derivatives,
    /// its steepest slope, and the error of its baked form.
    pub(super) fn error(&self, variation: [f64; 3], steepest: f64, baked: f64) -> f64 {
        let [jump, bend, twist] = variation;
        let cubic = (1.13 * jump)
            .min(self.spacing / 4.0 * bend)
            .min(self.spacing * self.spacing / 10.0 * twist);
        let between = jump.min(0.5 * self.table_step * steepest);
        self.most * (cubic + baked + between) + self.rise * between
    }

    /// The largest weight.
    pub(super) fn most(&self) -> f64 {
        self.most
    }

    /// The error without any smooth curve.
    pub(super) fn own(&self) -> f64 {
        // A cubic overshoots a jump by an eighth of it on either side.
        2.5 * self.sag + F32 * 16.0 * self.most
    }
}
