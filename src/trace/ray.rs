//! Camera rays into the rest frame of a worldline, many at a time.

use super::spacetime::Link;
use glam::DVec3;

/// Each camera ray direction (unit, away from the camera) in another rest frame, with the ratio of
/// light's frequency there to that in the camera's frame.
///
/// Where both frames move together nothing is computed.
pub fn boost_directions(link: &Link, directions: &[DVec3], out: &mut Vec<(DVec3, f64)>) {
    out.clear();
    if link.is_translation() {
        out.extend(directions.iter().map(|&d| (d, 1.0)));
        return;
    }
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        #[expect(
            unsafe_code,
            reason = "the features it needs were detected on the line above"
        )]
        unsafe {
            boost_with_fma(link, directions, out);
        }
        return;
    }
    boost_each(link, directions, out);
}

/// [`boost_each`] compiled for processors with a fused multiply-add instruction, which the cross
/// products are made of: without it each is a call of the C library (six a ray, three times the
/// whole boost). The result is the same to the bit, since both round once.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn boost_with_fma(link: &Link, directions: &[DVec3], out: &mut Vec<(DVec3, f64)>) {
    boost_each(link, directions, out);
}

#[inline(always)]
fn boost_each(link: &Link, directions: &[DVec3], out: &mut Vec<(DVec3, f64)>) {
    out.extend(directions.iter().map(|&d| {
        // Light travels against the ray.
        let light = link.light(-d);
        (-light.direction, light.frequency_ratio)
    }));
}
