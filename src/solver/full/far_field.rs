//! Pressure beyond the ends of a domain, where a lightly loaded point contact carries much of its load.
//!
//! Far from the contact the bodies are rigid and the viscosity is the ambient one. There P = −λ̄X/(3 + 2R_x/R_y)/H²
//! solves the Reynolds equation exactly for H = H₀ + (X² + g_y Y²)/2 (Kapitza 1955, with the half-Sommerfeld
//! condition). P is the pressure, H the film thickness, H₀ the rigid-body separation, λ̄ the speed parameter of
//! (2.23) and g_y the curvature of the gap across. Any disturbance from the contact adds a field that falls with the
//! sixth power of the distance.
//!
//! Behind the cavitation boundary of a circular contact, ∂P/∂n vanishes as well. Along rays from the contact, P ∝ cos
//! φ + B cosh 3φ solves the same equation, where φ is the angle from the inlet. B is such that P and ∂P/∂φ vanish at
//! the same angle.
//!
//! A grid that [continues](Grid::continues) has this pressure at its ends, and the load of this pressure is included.

use super::problem::Problem;
use crate::solver::discrete::space::Grid;
use crate::solver::physics::contact::FilmShape;

/// Angle φ of the cavitation boundary far from a circular contact, where tan φ = −3 tanh 3φ.
const BOUNDARY: f64 = 1.892553905;
/// B = −cos φ/cosh 3φ at that angle.
const SIDEWAYS: f64 = 2.163998272e-03;

/// Returns P at a position where the film thickness is H.
pub(super) fn pressure(problem: &Problem, (x, y): (f64, f64), film: f64) -> f64 {
    let shape = FilmShape::of(&problem.point);
    let distance = if shape != FilmShape::CIRCLE {
        (-x).max(0.0)
    } else {
        let angle = y.abs().atan2(-x);
        if angle >= BOUNDARY { 0.0 } else { x.hypot(y) * (angle.cos() + SIDEWAYS * (3.0 * angle).cosh()) }
    };
    distance / (shape.far_field_factor() * problem.inverse_lambda * film * film)
}

/// Writes the pressure at the ends of a domain. The other entries of the node array are unchanged.
pub(super) fn write_ends(grid: &impl Grid, problem: &Problem, film: &[f64], pressures: &mut [f64]) {
    let (x, y) = grid.abscissae();
    let mut write = |i: usize, j: usize| {
        let node = i * y.len() + j;
        pressures[node] = pressure(problem, (x[i], y[j]), film[node]);
    };
    for j in 0..y.len() {
        write(0, j);
        write(x.len() - 1, j);
    }
    (0..x.len()).for_each(|i| write(i, 0));
}

/// Returns the load of the pressure beyond the domain, for both halves of a point contact; the total load is 2π/3.
/// The pressure falls with the third power of the distance, so its integral is that of P x·n over the ends. The outer
/// halves of the cells at the ends have no quadrature weight and are added.
pub(super) fn load(grid: &impl Grid, pressures: &[f64]) -> f64 {
    let (x, y) = grid.abscissae();
    let (columns, lines) = (x.len(), y.len());
    let along_end = |nodes: &[f64], at: &dyn Fn(usize) -> f64| -> f64 {
        (1..nodes.len()).map(|k| 0.5 * (at(k) + at(k - 1)) * (nodes[k] - nodes[k - 1])).sum()
    };
    let inlet = along_end(y, &|j| pressures[j]) * (-x[0] + 0.5 * (x[1] - x[0]));
    let outlet = along_end(y, &|j| pressures[(columns - 1) * lines + j]) * x[columns - 1];
    let side = along_end(x, &|i| pressures[i * lines]) * (-y[0] + 0.5 * (y[1] - y[0]));
    2.0 * (inlet + outlet + side)
}

/// Largest outlet distance for which the usual penalty is sufficient.
const USUAL_OUTLET: f64 = 200.0;

/// Returns the factor by which the penalty exceeds the usual one if the film cavitates far behind the contact. The
/// pressure behind the boundary is about −X/γ with the penalty factor γ. Over a long outlet, and at the side of a
/// circular contact, it would take away a part of the load.
pub(super) fn stiffening(grid: &impl Grid) -> f64 {
    let (x, y) = grid.abscissae();
    let outlet = x.last().copied().unwrap_or(0.0);
    match y {
        [_] if outlet > USUAL_OUTLET => 0.01 * outlet * outlet,
        [edge, _, ..] if grid.continues() => (0.1 * edge.abs().powi(3)).max(1.0),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressure_and_its_slope_vanish_at_the_cavitation_boundary() {
        let field = |angle: f64| angle.cos() + SIDEWAYS * (3.0 * angle).cosh();
        let slope = |angle: f64| -angle.sin() + 3.0 * SIDEWAYS * (3.0 * angle).sinh();
        assert!(field(BOUNDARY).abs() < 1e-4 && slope(BOUNDARY).abs() < 1e-3);
    }
}
