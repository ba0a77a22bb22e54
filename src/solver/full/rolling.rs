//! Rolling resistance: the pressure gradient shears the film even without sliding.

use super::solution::Solution;

impl Solution {
    /// Returns the rolling resistance of each body, ½∫h dp: \[N/m\] for a line contact, \[N\] for a point contact. It
    /// is positive, since the film is thicker where the pressure rises than where it falls. It is the same for both
    /// bodies and independent of the sliding.
    pub fn rolling_resistance(&self) -> f64 {
        let point = &self.problem.point;
        let hertz = point.hertz();
        let (ny, fields) = (self.y.len(), self.film_fields());
        // ∫H dP along one line of nodes in X.
        let along = |j: usize| -> f64 {
            let at = |values: &[f64], i: usize| values[i * ny + j];
            let step = |i: usize| {
                let film = at(&fields.thickness, i) + at(&fields.thickness, i - 1);
                0.5 * film * (at(&fields.pressure, i) - at(&fields.pressure, i - 1))
            };
            (self.first() + 1..self.x.len()).map(step).sum()
        };
        let whole: f64 = match ny {
            1 => along(0),
            // Both halves of the width.
            _ => {
                (1..ny).map(|j| (along(j - 1) + along(j)) * (self.y[j] - self.y[j - 1])).sum::<f64>()
                    * hertz.half_length_m
            }
        };
        0.5 * hertz.pressure_pa * point.film_scale_m() * whole
    }
}

#[cfg(test)]
mod tests {
    use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::{Lubricant, ViscosityLaw};

    #[test]
    fn lines_cost_what_the_published_fit_says_within_seven_per_cent() {
        let laws = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        let mut solver = ContactSolver::on(&GridSpec::EXPLORER.build().unwrap());
        for (m, l, independent) in
            [(10.0, 10.0, 1.035), (40.0, 10.0, 1.029), (100.0, 10.0, 0.998), (100.0, 4.0, 1.067), (200.0, 10.0, 0.969)]
        {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            let solution = solver.solve(&point, laws, Start::Cold, &()).unwrap();
            let ratio = solution.rolling_resistance() / point.rolling_resistance_fit().unwrap();
            assert!((ratio - 1.0).abs() < 0.07, "M {m}, L {l}: {ratio}");
            // As an independent program found it.
            assert!((ratio - independent).abs() < 1e-3, "M {m}, L {l}: {ratio}");
        }
    }

    #[test]
    fn rolling_resistance_sums_all_sections_for_any_sliding() {
        let spec = GridSpec::Plane(PointGridSpec::uniform(0.08, 0.2, (-4.0, 2.0, -2.0)));
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 30.0, 5.0)).unwrap();
        let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        // ½∫∫ h ∂p/∂x dx dy = −½∫∫ p ∂h/∂x dx dy, since the pressure vanishes at all ends.
        let (hertz, ny) = (point.hertz(), solution.y.len());
        let film = |i: usize, j: usize| solution.film[i * ny + j];
        let pressure = |i: usize, j: usize| solution.pressure[i * ny + j];
        let mut sum = 0.0;
        for i in 1..solution.x.len() {
            for j in 0..ny {
                let width = if j == 0 || j == ny - 1 { 0.1 } else { 0.2 };
                sum -= 0.5 * (pressure(i, j) + pressure(i - 1, j)) * (film(i, j) - film(i - 1, j)) * width;
            }
        }
        let other = 0.5 * 2.0 * sum * hertz.pressure_pa * hertz.half_width_m * point.film_scale_m();
        assert!((solution.rolling_resistance() / other - 1.0).abs() < 1e-9);
        assert!(other > 0.0);
    }
}
