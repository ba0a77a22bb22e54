//! Elastic deformation of the half-space: under line loads ([`mod@line`], (2.27)) and under pressures on a plane ([`mod@point`], (2.25)).

pub mod line;
pub mod point;

pub use line::{Flexibility, Scratch, Toeplitz};
pub use point::{PointFlexibility, PointScratch, rectangle_kernel};

/// Smallest even length ≥ n whose prime factors are 2, 3 and 5.
fn fft_length(n: usize) -> usize {
    let smooth = |mut m: usize| {
        for p in [2, 3, 5] {
            while m.is_multiple_of(p) {
                m /= p;
            }
        }
        m == 1
    };
    (n..).find(|&m| m.is_multiple_of(2) && smooth(m)).unwrap_or(n)
}
