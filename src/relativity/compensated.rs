//! Vector products that keep their digits where their terms cancel: near the light cone the
//! cancellation is by γ² and plain arithmetic has nothing left.

use glam::DVec3;

/// `v` times the power of two that brings its largest component into [1, 2); zero stays zero.
///
/// Multiplying by a power of two rounds nothing, so the direction of `v` keeps every digit while
/// its squares and products can neither underflow nor overflow.
pub(super) fn scaled_to_one(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest == 0.0 {
        return v;
    }
    // 2^±1022 cannot be left by one factor, so subnormal vectors are lifted in two steps.
    let lifted = if largest < f64::MIN_POSITIVE {
        v * 2f64.powi(60)
    } else {
        v
    };
    let exponent = lifted.abs().max_element().to_bits() >> 52;
    let half = |e: i64| f64::from_bits(((1023 + e) as u64) << 52);
    let by = 1023 - exponent as i64;
    lifted * half(by / 2) * half(by - by / 2)
}

/// a × b, each component to 1.5 ulp however much its two products cancel.
///
/// The plain form loses the direction of light along a motion to γ²ε; this one keeps it to ε.
#[inline(always)]
pub(super) fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// a·b − c·d to 1.5 ulp: Kahan's difference of products by fused multiply-add (Jeannerod, Louvet &
/// Muller 2013, algorithm 1).
#[inline(always)]
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    a.mul_add(b, -cd) + (-c).mul_add(d, cd)
}

/// a·b, rounded as if summed in twice the precision (Ogita, Rump & Oishi 2005, algorithm Dot2).
pub(super) fn dot(a: DVec3, b: DVec3) -> f64 {
    let (mut sum, mut rest) = (0.0, 0.0);
    for (x, y) in [(a.x, b.x), (a.y, b.y), (a.z, b.z)] {
        let product = x * y;
        let grown = sum + product;
        let shift = grown - sum;
        rest += (sum - (grown - shift)) + (product - shift) + x.mul_add(y, -product);
        sum = grown;
    }
    sum + rest
}
