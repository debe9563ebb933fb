//! What mirrors and glass leave of light on its way to the camera.
//!
//! Each surface's reflectance is read under the shift between that surface and the camera, and
//! they are multiplied wavelength by wavelength. While all of them are the same everywhere, as
//! those of plain mirrors are, the product is one number.

use super::curve::Curve;
use super::received::finite;
use crate::trace::Branch;

/// The ways of a tree's nodes, in their order.
#[derive(Default)]
pub(super) struct Passages {
    entries: Vec<Passage>,
    /// Shapes of those that are not the same at all wavelengths, one after the other.
    shapes: Vec<f32>,
    /// Wavelengths of each.
    count: usize,
}

#[derive(Clone, Copy)]
struct Passage {
    factor: f64,
    /// Where its shape starts; None where it is 1 everywhere.
    shape: Option<usize>,
}

impl Passages {
    pub(super) fn new(count: usize) -> Self {
        Self {
            count,
            ..Self::default()
        }
    }

    pub(super) fn clear(&mut self, count: usize) {
        self.entries.clear();
        self.shapes.clear();
        self.count = count;
    }

    /// The way of what the camera sees directly.
    pub(super) fn start(&mut self) {
        self.entries.push(Passage {
            factor: 1.0,
            shape: None,
        });
    }

    /// The way of what is seen by a branch, through a surface of reflectance `curve` that is
    /// shifted by `shift`.
    pub(super) fn go_on(&mut self, branch: &Branch, curve: Option<&Curve>, shift: f64) {
        let before = self.entries[branch.parent as usize];
        let Some(curve) = curve else {
            return self.entries.push(Passage {
                factor: 0.0,
                shape: None,
            });
        };
        let factor = before.factor * branch.share;
        if let Some(grey) = curve.constant() {
            return self.entries.push(Passage {
                factor: factor * grey,
                ..before
            });
        }
        let start = self.shapes.len();
        self.shapes.resize(start + self.count, 0.0);
        let (earlier, own) = self.shapes.split_at_mut(start);
        let peak = curve.read(shift, own);
        if let Some(shape) = before.shape {
            for (own, earlier) in own.iter_mut().zip(&earlier[shape..]) {
                *own *= earlier;
            }
        }
        self.entries.push(Passage {
            factor: factor * peak,
            shape: Some(start),
        });
    }

    /// What the last way leaves of any light, if it is the same at all wavelengths.
    pub(super) fn last_grey(&self) -> Option<f64> {
        let last = self.entries.last()?;
        last.shape.is_none().then_some(last.factor)
    }

    /// Weighs spectral radiance by the last way; held finite first, as nothing of infinitely much
    /// would be no number.
    pub(super) fn weigh_last(&self, radiance: &mut [f64]) {
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
        let mut passages = Passages::new(1);
        passages.start();
        let branch = Branch {
            parent: 0,
            lobe: 0,
            share: 1.0,
            doppler: 1.0,
        };
        passages.go_on(&branch, None, 1.0);
        let mut light = [f64::INFINITY];
        passages.weigh_last(&mut light);
        assert_eq!(light, [0.0]);
    }
}
