//! Pictures made smaller, in linear light: each pixel is the mean over the area that it covers.

use super::still::Still;
use crate::color::spaces;

/// A still at another size, no side of it larger than before. A picture of that size stays as it
/// is.
pub(super) fn reduce(still: &Still, width: u32, height: u32) -> Still {
    if [width, height] == [still.width, still.height] {
        return still.clone();
    }
    let linear: Vec<f32> = (0..=255_u8)
        .map(|byte| spaces::decode(f64::from(byte) / 255.0) as f32)
        .collect();
    let stride = still.width as usize * 3;
    let mut rgb8 = Vec::with_capacity(width as usize * height as usize * 3);
    for y in 0..height {
        // Rows first, then columns of their mean.
        let mut mean = vec![0.0_f32; stride];
        for (row, weight) in shares(y, height, still.height) {
            let bytes = &still.rgb8[row as usize * stride..][..stride];
            for (sum, byte) in mean.iter_mut().zip(bytes) {
                *sum += weight * linear[usize::from(*byte)];
            }
        }
        for x in 0..width {
            let mut sum = [0.0_f32; 3];
            for (column, weight) in shares(x, width, still.width) {
                for (sum, value) in sum.iter_mut().zip(&mean[column as usize * 3..]) {
                    *sum += weight * value;
                }
            }
            let encode = |linear: f32| spaces::encode(f64::from(linear)) * 255.0;
            rgb8.extend(sum.map(|linear| encode(linear).round().clamp(0.0, 255.0) as u8));
        }
    }
    Still {
        width,
        height,
        rgb8,
    }
}

/// The old pixels that new pixel `index` of `new` covers of `old`, with the shares that they have in
/// it; these add up to 1.
fn shares(index: u32, new: u32, old: u32) -> impl Iterator<Item = (u32, f32)> {
    let scale = f64::from(old) / f64::from(new);
    let (from, to) = (f64::from(index) * scale, f64::from(index + 1) * scale);
    let last = (to.ceil() as u32).min(old);
    (from as u32..last).map(move |pixel| {
        let low = from.max(f64::from(pixel));
        let high = to.min(f64::from(pixel + 1));
        (pixel, ((high - low).max(0.0) / scale) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_and_white_mix_to_half_the_light() {
        let still = Still {
            width: 2,
            height: 2,
            rgb8: vec![0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0],
        };
        // Half the light is 0.735 of the code, not half of it.
        assert_eq!(reduce(&still, 1, 1).rgb8, [188, 188, 188]);
    }

    #[test]
    fn shares_cover_each_old_pixel_once() {
        for (old, new) in [(7, 3), (1280, 320), (37, 36), (5, 5), (1000, 1)] {
            let mut covered = vec![0.0; old as usize];
            for index in 0..new {
                let mut sum = 0.0;
                for (pixel, share) in shares(index, new, old) {
                    covered[pixel as usize] += f64::from(share);
                    sum += f64::from(share);
                }
                // Shares of 32 bits.
                assert!((sum - 1.0).abs() < 1e-4, "{old} to {new}: {sum}");
            }
            let each = f64::from(new) / f64::from(old);
            assert!(covered.iter().all(|share| (share - each).abs() < 1e-5));
        }
    }
}
