//! Stress field below the surface of a body, from the pressure and the shear stress of a solution.

use super::solution::Solution;
use crate::solver::discrete::elasticity::KernelError;
use crate::solver::discrete::half_space::{Stress, StressMeasure, SurfaceLoad, stress_below};
use serde::{Deserialize, Serialize};

/// Spacing along X and across, in units of the half width of the pressure and of the ordinates.
const SPACING: [f64; 2] = [0.01, 0.04];
/// Smallest spacing across in units of a; short ellipses need no finer one.
const LEAST_ACROSS: f64 = 0.02;
/// Surface included on each side along X, and half of it across, in half widths of the pressure.
const SIDES: [f64; 2] = [4.0, 2.0];
/// Drawn abscissae on each side, and depth, in half widths of the pressure.
const DRAWN: f64 = 2.0;
/// Number of depths from the surface down.
const DEPTHS: usize = 81;
/// Periods of the surface for a line and for a plane, in half widths of the pressure.
const PERIODS: (f64, f64) = (80.0, 24.0);

/// (∫P)²/∫P² of a Hertzian profile on −1 < X < 1.
const HERTZIAN_WIDTH: f64 = 1.850_550_825;

/// Stress field in the plane Y = 0 below the surface of body 1.
///
/// The half-space is loaded by the pressure P of the solution, asperities included, and by its shear stress: that of
/// the film at mid-film, and the friction of touching asperities. Both are zero at SRR = 0. The shear stress acts on
/// body 1 in the direction of motion for SRR > 0. On body 2 it acts against it, so that its field is nearly the mirror
/// image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubsurfaceStress {
    /// Abscissae X, in units of a.
    pub x: Vec<f64>,
    /// Depths Z from the surface down, in units of a.
    pub z: Vec<f64>,
    /// Stresses \[Pa\]: those of all abscissae at one depth after the other.
    pub stress: Vec<Stress>,
    /// Poisson's ratio.
    pub poisson: f64,
}

/// Largest magnitude of a measure, with its position.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StressMaximum {
    /// Magnitude \[Pa\].
    pub stress_pa: f64,
    /// Abscissa X in units of a.
    pub x: f64,
    /// Depth Z in units of a.
    pub z: f64,
}

impl SubsurfaceStress {
    /// Returns the stress at an abscissa and a depth by their indices; zero outside.
    pub fn at(&self, column: usize, row: usize) -> Stress {
        self.stress.get(row * self.x.len() + column).copied().unwrap_or_default()
    }

    /// Returns the largest magnitude of a measure. Between two depths the position is that of a parabola.
    pub fn maximum(&self, measure: StressMeasure) -> StressMaximum {
        let size = |stress: &Stress| stress.measure(measure).abs();
        let (mut best, mut largest) = (0, 0.0);
        for (k, stress) in self.stress.iter().enumerate() {
            if size(stress) > largest {
                (best, largest) = (k, size(stress));
            }
        }
        let (row, column) = (best / self.x.len().max(1), best % self.x.len().max(1));
        let step = self.z.get(1).copied().unwrap_or(0.0);
        let (mut stress_pa, mut z) = (largest, step * row as f64);
        if row > 0 && row + 1 < self.z.len() {
            let [above, below] = [row - 1, row + 1].map(|row| size(&self.at(column, row)));
            let bend = above - 2.0 * largest + below;
            if bend < 0.0 {
                let shift = 0.5 * (above - below) / bend;
                z += step * shift;
                stress_pa -= 0.25 * (above - below) * shift;
            }
        }
        StressMaximum { stress_pa, x: self.x.get(column).copied().unwrap_or(0.0), z }
    }
}

impl Solution {
    /// Returns the stress field below the surface of body 1 with this Poisson's ratio, 0…0.5. The depth reaches two
    /// half widths of the pressure, or of the shorter semi-axis of an ellipse.
    ///
    /// # Errors
    /// [`KernelError`] if a Fourier transform fails.
    pub fn subsurface_stress(&self, poisson: f64) -> Result<SubsurfaceStress, KernelError> {
        let point = &self.problem.point;
        let (kappa, line) = (point.ellipse().kappa, point.kind.is_line());
        let width = self.pressure_width().max(1.0);
        let (first, last) = (self.x.get(self.first()).copied().unwrap_or(0.0), self.x.last().copied().unwrap_or(0.0));
        let dx = SPACING[0] * width;
        let sides = (SIDES[0] * width / dx).round() as isize;
        let x: Vec<f64> = (-sides..=sides).map(|k| dx * k as f64).filter(|x| *x >= first && *x <= last).collect();
        let dy = (SPACING[1] * width * kappa).max(LEAST_ACROSS * width);
        let y: Vec<f64> = match self.y.first() {
            Some(edge) if !line => {
                let reach = (-edge * kappa).min(SIDES[1] * width * kappa);
                (0..=(reach / dy).floor() as usize).map(|j| dy * j as f64 / kappa).collect()
            }
            _ => vec![0.0],
        };
        let hertz_pressure = point.hertz().pressure_pa;
        let shear = self.surface_shear();
        let far = PERIODS.1 * width;
        let load = SurfaceLoad {
            columns: x.len(),
            spacing: [dx, dy],
            pressure: self.on_uniform_nodes(&self.pressure, (&x, &y)),
            traction: shear.map(|shear| self.on_uniform_nodes(&shear, (&x, &y))).unwrap_or_default(),
            // A long ellipse is like a line in the middle of its length.
            period: if line { [PERIODS.0 * width, dy] } else { [far * kappa.clamp(1.0, 3.0), far * kappa.max(1.0)] },
        };
        let deepest = DRAWN * width * kappa.min(1.0);
        let z: Vec<f64> = (0..DEPTHS).map(|k| deepest * k as f64 / (DEPTHS - 1) as f64).collect();
        let field = stress_below(&load, &z, poisson)?;
        let drawn: Vec<usize> = (0..x.len()).filter(|k| x[*k].abs() <= DRAWN * width + 0.5 * dx).collect();
        let stress = field.iter().flat_map(|row| drawn.iter().filter_map(|k| row.get(*k)));
        Ok(SubsurfaceStress {
            stress: stress.map(|stress| stress.scaled(hertz_pressure)).collect(),
            x: drawn.iter().map(|k| x[*k]).collect(),
            z,
            poisson,
        })
    }

    /// Returns the half width of the pressure on the axis in units of a: that of the Hertzian profile with the same
    /// (∫P)²/∫P². It exceeds 1 in lightly loaded contacts.
    fn pressure_width(&self) -> f64 {
        let profile: Vec<(f64, f64)> = self.profile().map(|(x, p, _)| (x, p.max(0.0))).collect();
        let integral = |value: &dyn Fn(f64) -> f64| -> f64 {
            profile.windows(2).map(|w| 0.5 * (value(w[0].1) + value(w[1].1)) * (w[1].0 - w[0].0)).sum()
        };
        integral(&|p| p).powi(2) / (HERTZIAN_WIDTH * integral(&|p| p * p))
    }

    /// Returns the shear stress on body 1 in units of p_H at every node of the arrays; `None` at SRR = 0.
    fn surface_shear(&self) -> Option<Vec<f64>> {
        let sliding = self.problem.point.sliding.slide_to_roll_ratio;
        if sliding == 0.0 {
            return None;
        }
        let scale = 1.0 / self.problem.point.hertz().pressure_pa;
        let friction = self.problem.rough.map_or(0.0, |rough| rough.roughness.boundary_friction * sliding.signum());
        let mut shear = self.mid_film_stress();
        for (k, shear) in shear.iter_mut().enumerate() {
            let filled = self.fraction.get(k).copied().unwrap_or(1.0);
            let carried = self.asperity_pressure.get(k).copied().unwrap_or(0.0);
            *shear = filled * scale * *shear + friction * carried;
        }
        Some(shear)
    }

    /// Interpolates a node array linearly to abscissae X inside the domain and to ordinates −Y. Negative pressures of
    /// the penalty method are part of the load balance and are kept.
    fn on_uniform_nodes(&self, values: &[f64], (x, y): (&[f64], &[f64])) -> Vec<f64> {
        let ny = self.y.len();
        let columns: Vec<(usize, f64)> = x.iter().map(|x| between(&self.x, *x)).collect();
        let mut out = Vec::with_capacity(x.len() * y.len());
        for y in y {
            let (j, t) = between(&self.y, -y);
            let next = (j + 1).min(ny - 1);
            let at = |i: usize| {
                let value = |j: usize| values.get(i * ny + j).copied().unwrap_or(0.0);
                (1.0 - t) * value(j) + t * value(next)
            };
            let last = self.x.len().saturating_sub(1);
            out.extend(columns.iter().map(|(i, s)| (1.0 - s) * at(*i) + s * at((i + 1).min(last))));
        }
        out
    }
}

/// Returns the index of the node before a position among increasing nodes, and the share of the way to the next one.
fn between(nodes: &[f64], at: f64) -> (usize, f64) {
    let right = nodes.partition_point(|node| *node <= at).clamp(1, nodes.len().max(2) - 1);
    match (nodes.get(right - 1), nodes.get(right)) {
        (Some(left), Some(next)) => (right - 1, ((at - left) / (next - left)).clamp(0.0, 1.0)),
        _ => (0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
    use crate::solver::physics::engineering::largest_shear;
    use crate::solver::physics::lubricant::{LimitingStress, Lubricant};

    fn solved(kind: ContactKind, (m, l): (f64, f64), srr: f64, laws: Lubricant) -> Solution {
        let point = si_from_moes(&MoesRequest::new(kind, m, l)).unwrap();
        let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
        let grid = match kind {
            ContactKind::Line => GridSpec::EXPLORER.build(),
            ContactKind::Point => GridSpec::Plane(PointGridSpec::EXPLORER).build(),
        };
        let grid = grid.unwrap();
        let mut solver = ContactSolver::on(&grid);
        let solution = solver.solve(&OperatingPoint { sliding, ..point }, laws, Start::Cold, &()).unwrap();
        assert!(solution.converged());
        solution
    }

    #[test]
    fn heavy_contacts_have_nearly_the_stress_of_dry_ones() {
        for (kind, numbers) in [(ContactKind::Line, (200.0, 5.0)), (ContactKind::Point, (2000.0, 5.0))] {
            let solution = solved(kind, numbers, 0.0, Lubricant::default());
            let field = solution.subsurface_stress(0.3).unwrap();
            let (own, point) = (field.maximum(StressMeasure::MaximumShear), &solution.problem.point);
            let dry = largest_shear(point, 0.3);
            let ratio = own.stress_pa / point.hertz().pressure_pa / dry.over_hertz_pressure;
            assert!((ratio - 1.0).abs() < 0.03, "{kind:?}: {ratio}");
            assert!((own.z - dry.depth_over_half_width).abs() < 0.06, "{kind:?}: {own:?}");
        }
    }

    #[test]
    fn the_field_carries_the_load_and_the_friction() {
        let limit = LimitingStress { ambient: 5e6, slope: 0.06, eyring: None };
        let laws = Lubricant { limiting_stress: Some(limit), ..Lubricant::default() };
        let solution = solved(ContactKind::Line, (50.0, 10.0), 0.5, laws);
        let field = solution.subsurface_stress(0.3).unwrap();
        let hertz_pressure = solution.problem.point.hertz().pressure_pa;
        let columns = field.x.len();
        let force = |row: usize, of: fn(&Stress) -> f64| {
            let stresses = field.stress.iter().skip(row * columns).take(columns);
            stresses.map(of).sum::<f64>() * (field.x[1] - field.x[0]) / hertz_pressure
        };
        // The shear stress spreads far along X with the depth, so that its force is taken at the surface.
        let (normal, tangential) = (force(4, |stress| -stress.z), force(0, |stress| -stress.xz));
        assert!((normal / (0.5 * std::f64::consts::PI) - 1.0).abs() < 0.01, "{normal}");
        let friction = solution.traction_coefficient();
        assert!((tangential / normal / friction - 1.0).abs() < 0.02, "{} {friction}", tangential / normal);
        assert!(friction > 0.03);
    }

    #[test]
    fn light_contacts_have_a_deeper_stress_maximum() {
        let solution = solved(ContactKind::Line, (2.0, 1.0), 0.0, Lubricant::default());
        let field = solution.subsurface_stress(0.3).unwrap();
        let own = field.maximum(StressMeasure::MaximumShear);
        assert!(own.z > 0.1 * field.z[80] && own.z < 0.9 * field.z[80], "{own:?}, {:?}", field.z[80]);
        assert!(field.x.iter().all(|x| x.is_finite()) && field.stress.iter().all(|s| s.von_mises().is_finite()));
    }
}
