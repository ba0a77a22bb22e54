//! Whether the parts of a window belong together: at its own snapshots it must give what they hold.

use super::attempt::attempt;
use super::settings::ReducedOptions;
use crate::solver::full::Problem;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::operators::Operators;
use crate::solver::reduced::start;

/// How far H_c of a snapshot may lie from the one it was trained from, relative to it. Models differ there by less than
/// one in a hundred; a window with parts of another one does not come near.
const WITHIN: f64 = 0.1;

impl Window {
    /// Solves the contacts of its first and its last snapshot from these; `sliding` for lubricants that thin under shear.
    pub fn reproduces_snapshots(&self, lubricant: Lubricant, sliding: bool) -> bool {
        let options = ReducedOptions::default();
        let mut operators = Operators::new(self, usize::MAX, options.deformation_modes, sliding);
        self.snapshots.iter().take(1).chain(self.snapshots.iter().skip(1).last()).all(|snapshot| {
            let Ok(problem) = Problem::new(&snapshot.point, lubricant) else { return false };
            let guess = start::carried(snapshot, &problem.point);
            attempt(self, &mut operators, &problem, &guess, usize::MAX, &options, &mut None)
                .is_ok_and(|found| (found.h_c - snapshot.h_c).abs() <= WITHIN * snapshot.h_c.abs())
        })
    }
}
