//! Spectral radiance along a ray: thermal light, and all other.

/// Spectral radiance (W·m⁻²·sr⁻¹·nm⁻¹) at the sensor's wavelengths.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Radiance {
    /// Reflected light, cold light of surfaces, and the background.
    pub surface: Vec<f64>,
    /// Thermal light.
    pub thermal: Vec<f64>,
}

impl Radiance {
    /// Zero at `count` wavelengths.
    pub fn new(count: usize) -> Self {
        let mut dark = Self::default();
        dark.clear(count);
        dark
    }

    /// Makes it zero at `count` wavelengths, keeping the memory.
    pub(super) fn clear(&mut self, count: usize) {
        for part in self.parts_mut() {
            part.clear();
            part.resize(count, 0.0);
        }
    }

    /// Both parts, the thermal one last.
    pub(super) fn parts_mut(&mut self) -> [&mut Vec<f64>; 2] {
        [&mut self.surface, &mut self.thermal]
    }

    /// Both together; finite.
    pub fn total(&self) -> Vec<f64> {
        let parts = self.surface.iter().zip(&self.thermal);
        parts.map(|(a, b)| (a + b).min(f64::MAX)).collect()
    }
}
