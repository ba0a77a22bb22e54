//! Lobatto points across the film, at which temperatures are stored, and the quadrature rule of the film integrals.

use crate::solver::discrete::reynolds::film_integrals::PRODUCTION_RULE;
use crate::solver::physics::lubricant::GAUSS_6;
use std::sync::LazyLock;

/// Number of temperatures across the film, including both surfaces. Compared with 13 points, the central film
/// thickness H_c agrees within 1e-4 and the traction within 2e-3.
pub const POINTS: usize = 9;

/// Number of points of the quadrature rule for the moments.
pub const RULE: usize = PRODUCTION_RULE.len();

/// Values at the points across the film, from ζ = z/h = 0 to 1.
pub type Profile = [f64; POINTS];

/// Matrix that acts on profiles.
pub type Operator = [Profile; POINTS];

/// Lobatto points on 0 ≤ ζ ≤ 1, with the matrices that differentiate, integrate and interpolate profiles.
#[derive(Clone, Debug)]
pub struct AcrossFilm {
    /// Heights ζ of the points.
    pub points: Profile,
    /// Quadrature weights. They are also the widths of the cells around the points.
    pub weights: Profile,
    /// d/dζ.
    pub slope: Operator,
    /// d²/dζ².
    pub curvature: Operator,
    /// ∫₀^ζ.
    pub primitive: Operator,
    /// ∫_ζ¹.
    pub rest: Operator,
    /// Interpolation to the points of the quadrature rule.
    pub to_rule: [Profile; RULE],
    /// ∫_ζ¹ at the points of the quadrature rule, for values given at these points.
    pub rest_on_rule: [[f64; RULE]; RULE],
}

/// Points that the whole program uses.
pub static ACROSS: LazyLock<AcrossFilm> = LazyLock::new(AcrossFilm::new);

/// Returns the product of a matrix and a vector.
#[inline]
pub fn apply<const N: usize, const M: usize>(matrix: &[[f64; N]; M], v: &[f64; N]) -> [f64; M] {
    matrix.map(|row| inner(&row, v))
}

/// Returns the inner product of two vectors.
#[inline]
pub fn inner<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the Legendre polynomial P_n(x) and its derivative P_n′(x), for |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut last, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (last, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * last) / k);
    }
    (value, n as f64 * (last - x * value) / (1.0 - x * x))
}

/// Returns the values at x of the Lagrange polynomials of the points.
fn lagrange<const N: usize>(points: &[f64; N], x: f64) -> [f64; N] {
    std::array::from_fn(|k| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != k);
        others.map(|(_, other)| (x - other) / (points[k] - other)).product()
    })
}

/// Returns the value of a profile at a height 0 ≤ ζ ≤ 1.
pub fn interpolated_across(profile: &Profile, zeta: f64) -> f64 {
    inner(profile, &lagrange(&ACROSS.points, zeta))
}

/// Returns the integrals of the Lagrange polynomials from `from` to `to`.
fn integrals<const N: usize>(points: &[f64; N], (from, to): (f64, f64)) -> [f64; N] {
    const PANELS: usize = 4;
    let mut out = [0.0; N];
    let width = (to - from) / PANELS as f64;
    for panel in 0..PANELS {
        for (at, weight) in GAUSS_6 {
            let values = lagrange(points, from + width * (panel as f64 + 0.5 + at));
            for (sum, value) in out.iter_mut().zip(values) {
                *sum += width * weight * value;
            }
        }
    }
    out
}

impl AcrossFilm {
    fn new() -> Self {
        let n = POINTS - 1;
        let points: Profile = std::array::from_fn(|j| match j {
            0 => 0.0,
            j if j == n => 1.0,
            j => {
                // The inner points are the roots of P_n′. Newton's method starts at Chebyshev's points; P_n″ follows
                // from Legendre's equation.
                let mut x = -(std::f64::consts::PI * j as f64 / n as f64).cos();
                for _ in 0..20 {
                    let (value, slope) = legendre(n, x);
                    let bend = (2.0 * x * slope - (n * (n + 1)) as f64 * value) / (1.0 - x * x);
                    x -= slope / bend;
                }
                0.5 * (1.0 + x)
            }
        });
        let slope: Operator = std::array::from_fn(|i| {
            let product =
                |j: usize| -> f64 { (0..POINTS).filter(|&k| k != j).map(|k| points[j] - points[k]).product() };
            let mut row: Profile =
                std::array::from_fn(|j| if i == j { 0.0 } else { product(i) / product(j) / (points[i] - points[j]) });
            row[i] = -row.iter().sum::<f64>();
            row
        });
        let curvature =
            std::array::from_fn(|i| std::array::from_fn(|j| (0..POINTS).map(|k| slope[i][k] * slope[k][j]).sum()));
        let rule: [f64; RULE] = std::array::from_fn(|g| PRODUCTION_RULE[g].0 + 0.5);
        Self {
            points,
            weights: integrals(&points, (0.0, 1.0)),
            slope,
            curvature,
            primitive: points.map(|zeta| integrals(&points, (0.0, zeta))),
            rest: points.map(|zeta| integrals(&points, (zeta, 1.0))),
            to_rule: rule.map(|zeta| lagrange(&points, zeta)),
            rest_on_rule: rule.map(|zeta| integrals(&rule, (zeta, 1.0))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_are_exact_for_polynomials() {
        let a = &*ACROSS;
        for degree in 0..POINTS as i32 {
            let power = |x: f64, k: i32| if k < 0 { 0.0 } else { x.powi(k) };
            let values = a.points.map(|x| x.powi(degree));
            let d = f64::from(degree);
            let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-10, "{degree}: {got} {want}");
            close(inner(&a.weights, &values), 1.0 / (d + 1.0));
            for (i, &x) in a.points.iter().enumerate() {
                close(apply(&a.slope, &values)[i], d * power(x, degree - 1));
                close(apply(&a.curvature, &values)[i], d * (d - 1.0) * power(x, degree - 2));
                close(apply(&a.primitive, &values)[i], x.powi(degree + 1) / (d + 1.0));
                close(apply(&a.rest, &values)[i], (1.0 - x.powi(degree + 1)) / (d + 1.0));
            }
            let on_rule = apply(&a.to_rule, &values);
            let rest = apply(&a.rest_on_rule, &on_rule);
            for (g, (c, _)) in PRODUCTION_RULE.iter().enumerate() {
                close(on_rule[g], (c + 0.5).powi(degree));
                close(rest[g], (1.0 - (c + 0.5).powi(degree + 1)) / (d + 1.0));
            }
        }
    }

    #[test]
    fn the_points_are_symmetric_and_known() {
        let a = &*ACROSS;
        // Abramowitz & Stegun, table 25.6, n = 9.
        assert!((2.0 * a.points[7] - 1.0 - 0.899_757_995_411_460).abs() < 1e-14);
        assert!((2.0 * a.weights[4] - 0.371_519_274_376_417).abs() < 1e-14);
        for k in 0..POINTS {
            assert!((a.points[k] + a.points[POINTS - 1 - k] - 1.0).abs() < 1e-15);
        }
    }
}
