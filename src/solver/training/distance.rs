//! Distance of two solutions as a function of their parameters alone (3.1.1).
//!
//! s = ωᵀ g_s, (3.3), with weights ω and candidate functions g_s that vanish for equal contacts, (3.4), (3.5). The
//! weights maximise the correlation (3.8) with the distances (3.6) of known solutions under ω ≥ 0, (3.9). With a =
//! ⟨D₂, G_k⟩ and Q = ⟨G_j, G_k⟩ this is the non-negative least-squares problem min ½ωᵀQω − aᵀω, since the correlation
//! does not depend on the length of ω.
//!
//! The distances (3.6) are not squared: |ΔM|/√(M₁² + M₂²), the root of the first term of (3.20), fits them better
//! than its square (`scenes/reduced/distance_measure_*.ron`).

use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// Candidate function g_s,k of two contacts.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Formula, for display.
    pub name: &'static str,
    /// Value: zero for equal contacts, never negative.
    pub value: fn(&OperatingPoint, &OperatingPoint) -> f64,
}

fn logarithms(a: f64, b: f64) -> f64 {
    (a / b).ln().powi(2)
}

/// The two functions of (3.20).
pub const DISSERTATION: [Candidate; 2] = [
    Candidate {
        name: "(ΔM)²/(M₁² + M₂²)",
        value: |a, b| {
            let (a, b) = (a.moes().m, b.moes().m);
            (a - b).powi(2) / (a * a + b * b)
        },
    },
    Candidate { name: "(ΔL)²", value: |a, b| (a.moes().l - b.moes().l).powi(2) },
];

/// Further functions: logarithms of M and L, the roots of those of (3.20), and the parameters themselves.
pub const FURTHER: [Candidate; 8] = [
    Candidate { name: "(Δ ln M)²", value: |a, b| logarithms(a.moes().m, b.moes().m) },
    Candidate { name: "(Δ ln L)²", value: |a, b| logarithms(a.moes().l, b.moes().l) },
    Candidate { name: "|ΔM|/√(M₁² + M₂²)", value: |a, b| (DISSERTATION[0].value)(a, b).sqrt() },
    Candidate { name: "|ΔL|", value: |a, b| (a.moes().l - b.moes().l).abs() },
    Candidate { name: "(Δ ln R)²", value: |a, b| logarithms(a.radius_m, b.radius_m) },
    Candidate { name: "(Δ ln u_m)²", value: |a, b| logarithms(a.speed_m_per_s, b.speed_m_per_s) },
    Candidate { name: "(Δ ln w)²", value: |a, b| logarithms(a.load, b.load) },
    Candidate { name: "(Δ ln α)²", value: |a, b| logarithms(a.alpha_per_pa, b.alpha_per_pa) },
];

/// Weights of a distance measure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// ω, one per candidate, scaled such that s fits the distances themselves.
    pub weights: Vec<f64>,
    /// Correlation δ of (3.8); 1 is perfect.
    pub correlation: f64,
}

/// Fits weights ω ≥ 0 that maximise the correlation (3.8) between s and the distances of the solutions `z`, one per
/// point. `None` if there are fewer than two points, if the numbers of points and solutions differ, or if nothing
/// varies.
pub fn fit(candidates: &[Candidate], points: &[OperatingPoint], z: &[Vec<f64>]) -> Option<Fit> {
    let products = Products::new(candidates, points, z)?;
    let weights = non_negative(&products.q, &products.a);
    let correlation = products.correlation(&weights);
    correlation.is_finite().then_some(Fit { weights, correlation })
}

/// Returns δ of (3.8) for given weights; `None` as for [`fit`].
pub fn correlation(
    candidates: &[Candidate],
    weights: &[f64],
    points: &[OperatingPoint],
    z: &[Vec<f64>],
) -> Option<f64> {
    Some(Products::new(candidates, points, z)?.correlation(weights)).filter(|delta| delta.is_finite())
}

/// Inner products of (3.8) over all pairs of points: ⟨D₂, G_k⟩, ⟨G_j, G_k⟩ and ⟨D₂, D₂⟩.
struct Products {
    a: Vec<f64>,
    q: Vec<Vec<f64>>,
    d2: f64,
}

impl Products {
    fn new(candidates: &[Candidate], points: &[OperatingPoint], z: &[Vec<f64>]) -> Option<Self> {
        if points.len() != z.len() {
            return None;
        }
        let n = candidates.len();
        let mut all = Self { a: vec![0.0; n], q: vec![vec![0.0; n]; n], d2: 0.0 };
        for i in 0..points.len() {
            for j in 0..i {
                let squared: f64 = z[i].iter().zip(&z[j]).map(|(x, y)| (x - y).powi(2)).sum();
                let g: Vec<f64> = candidates.iter().map(|c| (c.value)(&points[i], &points[j])).collect();
                all.d2 += squared;
                for k in 0..n {
                    all.a[k] += squared.sqrt() * g[k];
                    for l in 0..n {
                        all.q[k][l] += g[k] * g[l];
                    }
                }
            }
        }
        Some(all)
    }

    fn correlation(&self, weights: &[f64]) -> f64 {
        let covered: f64 = weights.iter().zip(&self.a).map(|(w, a)| w * a).sum();
        let length: f64 = weights
            .iter()
            .zip(&self.q)
            .map(|(w, row)| w * row.iter().zip(weights).map(|(q, v)| q * v).sum::<f64>())
            .sum();
        covered * covered / (self.d2 * length)
    }
}

/// Solves min ½ωᵀQω − aᵀω under ω ≥ 0 by coordinate descent.
fn non_negative(q: &[Vec<f64>], a: &[f64]) -> Vec<f64> {
    let n = a.len();
    let mut omega = vec![0.0f64; n];
    for _ in 0..200_000 {
        let mut moved = 0.0f64;
        for k in (0..n).filter(|&k| q[k][k] > 0.0) {
            let rest: f64 = (0..n).filter(|&l| l != k).map(|l| q[k][l] * omega[l]).sum();
            let next = ((a[k] - rest) / q[k][k]).max(0.0);
            // Relative to the contribution of the candidate, independent of its scale.
            moved = moved.max((next - omega[k]).abs() * q[k][k] / a[k].max(f64::MIN_POSITIVE));
            omega[k] = next;
        }
        if moved < 1e-13 {
            break;
        }
    }
    omega
}

#[cfg(test)]
mod tests {
    use super::super::random_points;
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::{FullSolver, Start};
    use crate::solver::parameters::ParameterSpace;
    use crate::solver::physics::contact::ContactKind;
    use crate::solver::physics::lubricant::Lubricant;

    fn points() -> Vec<OperatingPoint> {
        random_points(&ParameterSpace::table_3_1(), ContactKind::Line, 40, 5)
    }

    #[test]
    fn candidates_vanish_for_equal_contacts_only() {
        let p = points();
        for c in DISSERTATION.iter().chain(&FURTHER) {
            assert!((c.value)(&p[0], &p[0]) == 0.0 && (c.value)(&p[0], &p[1]) > 0.0, "{}", c.name);
        }
    }

    #[test]
    fn a_solution_linear_in_l_weights_only_its_difference() {
        let p = points();
        // ‖z_i − z_j‖ = 3 |ΔL| exactly.
        let z: Vec<Vec<f64>> = p.iter().map(|p| vec![3.0 * p.moes().l]).collect();
        let fit = fit(&FURTHER, &p, &z).unwrap();
        assert!((fit.correlation - 1.0).abs() < 1e-9);
        for (c, w) in FURTHER.iter().zip(&fit.weights) {
            let wanted = if c.name == "|ΔL|" { 3.0 } else { 0.0 };
            assert!((w - wanted).abs() < 1e-4, "{}: {w}", c.name);
        }
    }

    #[test]
    fn weights_are_never_negative_and_beat_any_single_candidate() {
        let p = points();
        let z: Vec<Vec<f64>> = p.iter().map(|p| vec![p.moes().m.ln(), 0.05 * p.moes().l]).collect();
        let all = fit(&FURTHER, &p, &z).unwrap();
        assert!(all.weights.iter().all(|w| *w >= 0.0));
        for c in FURTHER {
            assert!(fit(&[c], &p, &z).unwrap().correlation <= all.correlation + 1e-12);
        }
    }

    #[test]
    fn the_dissertations_weights_come_out_for_table_3_1() {
        let grid = GridSpec::Graded { nodes: 200, domain: (-8.0, 2.5), registered: true };
        let mut solver = FullSolver::new(grid).unwrap();
        let (mut kept, mut z) = (Vec::new(), Vec::new());
        for point in points() {
            let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
            if solution.converged() {
                kept.push(point);
                z.push(solution.pressure);
            }
        }
        assert!(kept.len() > 30);
        let fit = fit(&DISSERTATION, &kept, &z).unwrap();
        let ratio = fit.weights[1] / fit.weights[0];
        assert!((3e-4..3e-3).contains(&ratio) && fit.correlation > 0.7, "1 : {ratio}, {}", fit.correlation);
        let own = correlation(&DISSERTATION, &fit.weights, &kept, &z).unwrap();
        let printed = correlation(&DISSERTATION, &[1.0, 0.001], &kept, &z).unwrap();
        assert!((own - fit.correlation).abs() < 1e-12 && printed <= own && printed > 0.9 * own, "{printed} {own}");
    }

    #[test]
    fn nothing_to_compare_gives_no_fit() {
        assert!(fit(&DISSERTATION, &[], &[]).is_none());
        assert!(fit(&DISSERTATION, &points()[..1], &[vec![1.0]]).is_none());
    }
}
