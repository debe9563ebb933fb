//! The share of a node's light that mirrors and glass leave on its way to the camera.
//!
//! Each surface's reflectance is read under the shift between that surface and the camera; they are
//! multiplied wavelength by wavelength. While all of them are the same at every wavelength, as those
//! of plain mirrors are, the product is one number.

use crate::shade::curve::Curve;
use crate::shade::received::finite;
use crate::shade::walk::Passage;

/// Throughputs of a tree's nodes, in their order.
#[derive(Default)]
pub(crate) struct Throughputs {
    entries: Vec<Throughput>,
    /// Shapes of those that are not the same at all wavelengths, one after the other.
    shapes: Vec<f32>,
    /// Wavelengths of each.
    count: usize,
}

#[derive(Clone, Copy)]
struct Throughput {
    factor: f64,
    /// Where its shape starts; None where it is 1 everywhere.
    shape: Option<usize>,
}

impl Throughputs {
    /// None yet, over `count` wavelengths.
    pub(super) fn new(count: usize) -> Self {
        Self {
            count,
            ..Self::default()
        }
    }

    /// The same, keeping the memory.
    pub(super) fn clear(&mut self, count: usize) {
        self.entries.clear();
        self.shapes.clear();
        self.count = count;
    }

    /// Adds that of a node which the camera sees directly.
    pub(super) fn push_direct(&mut self) {
        self.entries.push(Throughput {
            factor: 1.0,
            shape: None,
        });
    }

    /// Adds that of a node which is seen in a surface of reflectance `curve`.
    pub(super) fn push(&mut self, passage: &Passage, curve: &Curve) {
        let before = self.entries[passage.parent];
        let factor = before.factor * passage.share;
        if let Some(gray) = curve.constant() {
            return self.entries.push(Throughput {
                factor: factor * gray,
                ..before
            });
        }
        let start = self.shapes.len();
        self.shapes.resize(start + self.count, 0.0);
        let (earlier, own) = self.shapes.split_at_mut(start);
        let peak = curve.read(passage.doppler.shift(), own);
        if let Some(shape) = before.shape {
            for (own, earlier) in own.iter_mut().zip(&earlier[shape..]) {
                *own *= earlier;
            }
        }
        self.entries.push(Throughput {
            factor: factor * peak,
            shape: Some(start),
        });
    }

    /// The last one, if it is the same at all wavelengths.
    pub(super) fn last_gray(&self) -> Option<f64> {
        let last = self.entries.last()?;
        last.shape.is_none().then_some(last.factor)
    }

    /// Multiplies spectral radiance by the last one. The radiance is made finite first: infinitely
    /// much times 0 would not be a number.
    pub(super) fn weigh_by_last(&self, radiance: &mut [f64]) {
        let Some(last) = self.entries.last() else {
            return;
        };
        match last.shape {
            None => radiance
                .iter_mut()
                .for_each(|value| *value = finite(*value) * last.factor),
            Some(start) => {
                let shape = &self.shapes[start..start + self.count];
                for (value, shape) in radiance.iter_mut().zip(shape) {
                    *value = finite(*value) * (last.factor * f64::from(*shape));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_infinitely_much_light_is_nothing() {
        let mut throughputs = Throughputs::new(1);
        throughputs.entries.push(Throughput {
            factor: 0.0,
            shape: None,
        });
        let mut light = [f64::INFINITY];
        throughputs.weigh_by_last(&mut light);
        assert_eq!(light, [0.0]);
    }
}
