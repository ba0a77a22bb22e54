//! Mean gap between two rough surfaces with Gaussian heights.

use std::f64::consts::PI;

/// Separation beyond which the surfaces do not touch to the last digit.
const APART: f64 = 9.0;
/// Separation below which the continued fraction converges faster than the series.
const DEEP: f64 = -3.5;

/// Returns the mean gap T = l Φ(l) + φ(l) in units of σ and its derivative T′ = Φ(l) at a separation l. φ is the density
/// of the normal distribution and Φ its integral. T is positive for every l, and T = l for a large l.
pub fn mean_gap(separation: f64) -> (f64, f64) {
    let l = separation;
    if l > APART {
        return (l, 1.0);
    }
    let density = (-0.5 * l * l).exp() / (2.0 * PI).sqrt();
    if l < DEEP {
        return deep_gap(-l, density);
    }
    // Φ = 1/2 + φ (l + l³/3 + l⁵/15 + …).
    let (mut term, mut sum, mut odd) = (l, l, 1.0);
    while term.abs() > 1e-17 * sum.abs() {
        odd += 2.0;
        term *= l * l / odd;
        sum += term;
    }
    let share = (0.5 + density * sum).min(1.0);
    (l * share + density, share)
}

/// Returns T and T′ at l = −x. Laplace's continued fraction 1/(x + 1/(x + 2/(x + 3/(x + …)))) is the ratio Φ/φ there.
fn deep_gap(x: f64, density: f64) -> (f64, f64) {
    const TERMS: u32 = 80;
    // The tail t = 1/(x + 2/(x + …)) gives Φ/φ = 1/(x + t) and T/φ = 1 − x/(x + t) without cancellation.
    let tail = (1..=TERMS).rev().fold(0.0, |tail, k| f64::from(k) / (x + tail));
    let ratio = 1.0 / (x + tail);
    (density * tail * ratio, density * ratio)
}

/// Returns the separation l at which the mean gap has a value T > 0, the inverse of [`mean_gap`]. Newton's method for
/// ln T, which is concave, so that it converges from the smaller separation at which it starts.
pub fn separation_of_gap(gap: f64) -> f64 {
    let mut l = if gap > 1.0 { gap } else { -(-2.0 * gap.ln()).sqrt() };
    for _ in 0..60 {
        let (own, slope) = mean_gap(l);
        if own <= 0.0 || own.is_nan() {
            return l;
        }
        let step = own / slope * (gap / own).ln();
        l += step;
        if step.abs() < 1e-13 * (1.0 + l.abs()) {
            break;
        }
    }
    l
}
