//! The numbers that triangles are met in: f64, or f32 as most renderers have.
//!
//! The code of balls, trees and triangles is written once and compiled for each of the two, so that
//! neither pays for the other.

use crate::relativity::difference_of_products;
use glam::{DMat3, DVec3, Mat3, Vec3, Vec3A};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A floating-point number with its vectors.
pub(super) trait Real:
    Copy
    + PartialOrd
    + Send
    + Sync
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// Three of them.
    type Vector: Copy
        + Send
        + Sync
        + Add<Output = Self::Vector>
        + Sub<Output = Self::Vector>
        + Mul<Self, Output = Self::Vector>
        + Div<Self, Output = Self::Vector>;
    /// A linear map.
    type Matrix: Copy + Send + Sync + Mul<Self::Vector, Output = Self::Vector>;

    /// Distance of the next number above 1.
    const EPSILON: Self;
    /// Bodies that together reach over more metres than this, or less than one over it, are not
    /// seen: squares of lengths would leave the range.
    const WIDEST: f64;

    fn of(x: f64) -> Self;
    fn to_f64(self) -> f64;
    fn to_f32(self) -> f32;
    fn vector(v: DVec3) -> Self::Vector;
    fn matrix(m: DMat3) -> Self::Matrix;
    fn from_array(a: [Self; 3]) -> Self::Vector;
    fn to_array(v: Self::Vector) -> [Self; 3];
    fn dot(a: Self::Vector, b: Self::Vector) -> Self;
    fn cross(a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn abs(self) -> Self;
    fn sqrt(self) -> Self;
    fn max(self, other: Self) -> Self;
    fn is_finite(self) -> bool;
    /// a·b − c·d, its sign exact.
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self;

    #[inline(always)]
    fn to_vec3a(v: Self::Vector) -> Vec3A {
        Self::to_array(v).map(Self::to_f32).into()
    }
}

/// What the two have in common, by the names of their glam types.
macro_rules! real {
    ($real:ident, $vector:ident, $matrix:ident, $as_vector:ident, $as_matrix:ident,
     $widest:expr, $difference:expr) => {
        impl Real for $real {
            type Vector = $vector;
            type Matrix = $matrix;

            const EPSILON: Self = $real::EPSILON;
            const WIDEST: f64 = $widest;

            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $real
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }
            #[inline(always)]
            fn to_f32(self) -> f32 {
                self as f32
            }
            #[inline(always)]
            fn vector(v: DVec3) -> Self::Vector {
                v.$as_vector()
            }
            #[inline(always)]
            fn matrix(m: DMat3) -> Self::Matrix {
                m.$as_matrix()
            }
            #[inline(always)]
            fn from_array(a: [Self; 3]) -> Self::Vector {
                a.into()
            }
            #[inline(always)]
            fn to_array(v: Self::Vector) -> [Self; 3] {
                v.to_array()
            }
            #[inline(always)]
            fn dot(a: Self::Vector, b: Self::Vector) -> Self {
                a.dot(b)
            }
            #[inline(always)]
            fn cross(a: Self::Vector, b: Self::Vector) -> Self::Vector {
                a.cross(b)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.max(other)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            #[inline(always)]
            fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
                let difference: fn(Self, Self, Self, Self) -> Self = $difference;
                difference(a, b, c, d)
            }
        }
    };
}

real!(
    f64,
    DVec3,
    DMat3,
    clone,
    clone,
    f64::INFINITY,
    difference_of_products
);
// The products of two f32 are exact in f64.
real!(f32, Vec3, Mat3, as_vec3, as_mat3, 1e18, |a, b, c, d| {
    let [a, b, c, d] = [a, b, c, d].map(f64::from);
    (a * b - c * d) as f32
});
