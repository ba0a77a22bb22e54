//! Newton's method on the half plane of a point contact. There is no line search on the residual: the penalty makes
//! the residual jump at the cavitation boundary, so the steps would become too short. Instead, the changes of
//! pressure and film thickness limit the steps.

use super::preconditioner::PlaneMatrix;
use crate::solver::discrete::grid::{GridSpec, PointGrid, PointGridSpec};
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::mesh::Mesh;
use crate::solver::full::newton_space::{NewtonSpace, ScaledRows, StepControl, Taken, Turn};
use crate::solver::full::problem::{Problem, SolveError};
use crate::solver::full::system::{SolveOptions, System};
use crate::solver::physics::contact::{ContactKind, Ellipse};
use std::sync::Arc;

/// Step control of point contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitedSteps {
    /// Largest change of P in one step.
    pub largest_step: f64,
    /// Largest relative reduction of the film thickness in one step.
    pub film_loss: f64,
    /// Accuracy of the linear solves, relative to the right-hand side.
    pub forcing: f64,
}

impl StepControl for LimitedSteps {
    fn options() -> SolveOptions<Self> {
        SolveOptions {
            tolerance: 1e-6,
            max_newton: 60,
            max_krylov: 60,
            penalty: PENALTY,
            film: FilmTreatment::default(),
            control: Self { largest_step: 0.4, film_loss: 0.8, forcing: 1e-2 },
        }
    }
}

/// Step size below which only the cavitation boundary moves.
const LATE_STEP: f64 = 1e-2;
/// Lower limit of the pressures after each step. Lower pressures are an overshoot of the penalty.
const LOWEST_PRESSURE: f64 = -1e-4;

/// Sizes of the last two steps, and number of detected cycles of the cavitation boundary.
pub struct Cycles {
    recent: [f64; 2],
    count: usize,
}

impl Default for Cycles {
    fn default() -> Self {
        Self { recent: [f64::INFINITY; 2], count: 0 }
    }
}

impl Cycles {
    /// Returns the share of a step of this size that is taken. If the boundary cycles, nodes that would all change
    /// sides at once do so in smaller groups. The golden ratio spreads the shares over 0.035…0.7 and never repeats
    /// them, because a repeated pattern can become part of a cycle.
    fn share(&mut self, size: f64) -> f64 {
        // A late step as large as the second last one: the boundary cycles.
        let cycles = !(size > LATE_STEP || size < 0.9 * self.recent[0]);
        self.recent = [self.recent[1], size];
        if !cycles {
            return 1.0;
        }
        self.count += 1;
        0.7 * 0.05f64.powf((self.count as f64 * 0.618_033_988_749_895).fract())
    }
}

impl NewtonSpace for PlaneSpace {
    type Control = LimitedSteps;
    type Memory = Cycles;
    type Matrix = PlaneMatrix;
    type Spec = PointGridSpec;
    type Reference = Arc<PointGrid>;
    type Form = Ellipse;

    const KIND: ContactKind = ContactKind::Point;
    const WORST_RESIDUAL: f64 = f64::INFINITY;
    const CLIPS: bool = true;
    const FIRST_COLUMN: usize = 0;
    // In units of Hamrock and Dowson's formula.
    const COLD_FILMS: [f64; 3] = [1.2, 0.8, 2.0];
    const EASY_M: (f64, f64) = (60.0, 200.0);
    const EASY_L: f64 = 8.0;
    const COLD_M: (f64, f64) = (600.0, 2500.0);

    fn build(spec: PointGridSpec) -> Result<Arc<PointGrid>, SolveError> {
        Ok(spec.build()?)
    }

    fn unknowns(grid: &Arc<PointGrid>) -> usize {
        grid.unknowns()
    }

    fn coarsening(grid: &Arc<PointGrid>, problem: &Problem) -> usize {
        grid.spec.coarsening_for(&problem.point)
    }

    fn coarser(grid: &Arc<PointGrid>, times: i32) -> Result<Option<Arc<PointGrid>>, SolveError> {
        let spec = PointGridSpec { dx: grid.spec.dx * f64::from(2i32.pow(times as u32)), ..grid.spec };
        Ok(Some(spec.build()?))
    }

    fn form_of(_: &Arc<PointGrid>, problem: &Problem) -> Ellipse {
        problem.point.ellipse()
    }

    fn on(grid: &Arc<PointGrid>, ellipse: Ellipse) -> Result<Self, SolveError> {
        Ok(Self::new(grid.of_ellipse(ellipse)?))
    }

    fn form(&self) -> Ellipse {
        self.grid.ellipse
    }

    fn mesh(&self) -> Mesh {
        Mesh { spec: GridSpec::Plane(self.grid.spec), scale: 1.0 }
    }

    fn forcing(control: &LimitedSteps, _: &mut Cycles, _: f64) -> f64 {
        control.forcing
    }

    /// Takes the step, limited by the changes of pressure and film thickness. Its size is max|ΔP|.
    fn step(
        system: &mut System<Self>,
        problem: &Problem,
        options: &SolveOptions<LimitedSteps>,
        memory: &mut Cycles,
        _: f64,
    ) -> Taken {
        let LimitedSteps { largest_step, film_loss, .. } = options.control;
        let penalised = !system.active.holds();
        system.spread_update();
        let rough = system.longest_rough_step(problem, system.update[system.rows.len()]);
        let System { space, update, step, step_deformation, pressure, film, deformation, active, .. } = system;
        let shift = update[space.grid.unknowns()];
        let size = step.iter().fold(0.0f64, |largest, s| if s.is_nan() { *s } else { largest.max(s.abs()) });
        let mut factor = (largest_step / size).min(if penalised { memory.share(size) } else { 1.0 });
        factor = rough.unwrap_or(factor);
        for (h, d) in film.iter().zip(&*step_deformation) {
            let change = d + shift;
            if rough.is_none() && change < -film_loss * h {
                factor = factor.min(-film_loss * h / change);
            }
        }
        active.add_fractions(factor, update);
        let mut cut = false;
        for (p, s) in pressure.iter_mut().zip(&*step) {
            *p += factor * s;
            if penalised && *p < LOWEST_PRESSURE {
                *p = LOWEST_PRESSURE;
                cut = true;
            }
        }
        if cut {
            system.deform();
        } else {
            for (d, s) in deformation.iter_mut().zip(&*step_deformation) {
                *d += factor * s;
            }
        }
        system.set_h_0(system.h_0 + factor * shift);
        Taken { size, shift, residual: system.evaluate(problem, options.penalty) }
    }

    fn beside_heat(_: LimitedSteps, turn: Turn) -> LimitedSteps {
        let Turn { largest_step, film_loss, last, .. } = turn;
        LimitedSteps { largest_step, film_loss, forcing: if last { 1e-6 } else { 1e-3 } }
    }

    fn assemble(
        &self,
        matrix: &mut PlaneMatrix,
        _: &LimitedSteps,
        rows: &ScaledRows<'_>,
        go_on: impl Fn() -> bool + Sync,
    ) -> bool {
        matrix.build(&self.grid, rows, go_on)
    }
}
