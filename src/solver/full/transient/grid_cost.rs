//! Discretisation error of a full march, estimated from steady contacts under the inputs of selected times.

use super::frame::Conditions;
use super::march::Marching;
use super::system::FullMarch;
use super::trajectory::{Moment, Trajectory};
use crate::solver::full::{GridCost, Problem, SolveOptions};
use crate::solver::observer::Observer;

impl Trajectory {
    /// Estimates the discretisation error of the central film thickness for steady contacts under the inputs of the
    /// start, of the thinnest and of the thickest film. Thin films need fine grids, thick films long domains. Returns
    /// the largest error and its time; `None` if no steady solve converges.
    pub fn grid_cost(&self, model: &mut FullMarch, observer: &dyn Observer) -> Option<(f64, GridCost)> {
        let by_film = |a: &&Moment, b: &&Moment| a.h_c.total_cmp(&b.h_c);
        let [start, thinnest, thickest] =
            [self.moments.first(), self.moments.iter().min_by(by_film), self.moments.iter().max_by(by_film)];
        let mut moments: Vec<&Moment> = [start, thinnest, thickest].into_iter().flatten().collect();
        moments.dedup_by_key(|moment| moment.input);
        let judged = moments.into_iter().filter_map(|moment| {
            let at = self.transient.frame.conditions(&self.problem, moment.time, moment.input).ok()?;
            Some((moment.time, model.grid_cost(&at, observer)?))
        });
        judged.max_by(|a, b| a.1.total().total_cmp(&b.1.total()))
    }
}

impl FullMarch {
    /// Estimates the discretisation error of a steady contact. The current state is lost.
    fn grid_cost(&mut self, at: &Conditions, observer: &dyn Observer) -> Option<GridCost> {
        self.rest(at, observer).ok()?;
        // A steady contact at another speed equals one with another λ̄.
        let problem = Problem { inverse_lambda: at.problem.inverse_lambda / at.speed, ..at.problem };
        let space = &mut self.system.space;
        space.rows.copy_from_slice(&space.grid.rows);
        Some(self.system.grid_cost(&problem, &SolveOptions::default()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::transient::{Frame, Inputs, Signal, Transient, march};
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;

    /// In a frame that follows the contact, its grid is that of a steady solve at the same inputs.
    #[test]
    fn a_march_costs_what_its_worst_contact_at_rest_costs() {
        let spec = GridSpec::Uniform { dx: 0.03, domain: (-4.0, 2.0) };
        let point = OperatingPoint::TABLE_2_1;
        let speed = Signal::Harmonic { amplitude: 0.5, period: 4.0 };
        let transient = Transient {
            frame: Frame::ArbitraryLagrangianEulerian,
            ..Transient::new(point, Inputs { speed, ..Inputs::default() }, 4.0, 0.05)
        };
        let mut model = FullMarch::new(spec.line().unwrap(), &transient).unwrap();
        let trajectory = march(&mut model, &transient, &()).unwrap();
        let (time, told) = trajectory.grid_cost(&mut model, &()).unwrap();
        let thinnest = trajectory.moments.iter().min_by(|a, b| a.h_c.total_cmp(&b.h_c)).unwrap();
        assert_eq!(time, thinnest.time);
        let slow = OperatingPoint { speed_m_per_s: point.speed_m_per_s * thinnest.input.speed, ..point };
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let solution = solver.solve(&slow, Lubricant::default(), Start::Cold, &()).unwrap();
        let wanted = solver.judged(solution).grid_cost.unwrap();
        assert!(wanted.total() > 0.02, "{wanted:?}");
        assert!((told.total() / wanted.total() - 1.0).abs() < 1e-2, "{told:?} against {wanted:?}");
        // In the fixed frame it is the same contact on the same grid.
        let fixed = Transient { frame: Frame::Fixed, ..transient };
        let mut model = FullMarch::new(spec.line().unwrap(), &fixed).unwrap();
        let trajectory = march(&mut model, &fixed, &()).unwrap();
        let (_, told) = trajectory.grid_cost(&mut model, &()).unwrap();
        assert!((told.total() / wanted.total() - 1.0).abs() < 0.1, "{told:?} against {wanted:?}");
    }
}
