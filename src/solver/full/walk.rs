//! Continuation: if a contact does not converge from a cold start, the solver approaches it from a contact that does.
//!
//! The path is straight in (ln M, ln L) with the Moes numbers M and L. It begins at the nearest contact of the same
//! shape in the middle of the map. For a starved inlet it begins at the same contact with a small inlet film
//! thickness. For rough surfaces it begins at the same contact with a high speed or, in the middle of
//! the map, with a small roughness. It depends on the requested contact only. Each step starts from an extrapolation of the last two
//! contacts of the path. The step length is adapted to the number of Newton iterations. Point contacts use coarser
//! grids along X as long as these resolve the film.

use super::newton_space::NewtonSpace;
use super::problem::{Problem, SolveError};
use super::report::{Report, Termination};
use super::solution::Solution;
use super::solver::{Beginning, ColdStart, Solver, formula_film};
use crate::solver::discrete::space::Grid;
use crate::solver::observer::{Observer, WalkStep};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::Roughness;

/// Inlet film thickness, in units of the contact's film formula, that clearly starves the contact.
const THIN: f64 = 0.3;

/// Film thickness of the contact's film formula, in units of σ, at which asperities carry little.
const APART: f64 = 5.0;

/// Length of the first step in ln M; a third of it in ln L.
const FIRST_STRIDE: f64 = 0.7;
/// Longest step in the same measure.
const LONGEST_STRIDE: f64 = 1.4;
/// Shortest step in the same measure, below which the continuation ends.
const SHORTEST_STRIDE: f64 = 2e-3;
/// Newton iterations below which the next step is longer, and above which it is shorter.
const QUICK: usize = 6;
const SLOW: usize = 15;
/// Maximum number of Newton iterations of one step.
const MOST_PER_STEP: usize = 40;

/// Factor between the tolerance along the path and that of the requested contact.
const ALONG_THE_WAY: f64 = 1e3;

/// Returns the maximum number of Newton iterations of a whole continuation on a grid with that many unknowns. The
/// result is 3,000, fewer on large grids, and at least 250.
pub fn most_walked(unknowns: usize) -> usize {
    (12_000_000 / unknowns.max(1)).clamp(250, 3000)
}

/// Contacts between an easy one and the requested one.
enum Path {
    /// Distances in ln M and ln L from the requested contact to the easy one.
    Loads {
        /// ln(M/M requested) of the easy contact.
        m: f64,
        /// ln(L/L requested) of the easy contact.
        l: f64,
    },
    /// ln of the small inlet film thickness over the requested one.
    Supply(f64),
    /// ln of the small roughness over the requested one.
    Roughness(f64),
    /// ln of the high speed over the requested one.
    Speed(f64),
}

impl Path {
    /// Returns the path to a problem. A grid that `continues` beyond its ends would not resolve the middle of the
    /// map, so only L changes there.
    fn to<S: NewtonSpace>(problem: &Problem, continues: bool) -> Self {
        if let Some(supply) = problem.supply {
            return Self::Supply((supply.min(THIN * formula_film(problem)) / supply).ln());
        }
        let (m, l) = (problem.load_as_a_circle(), problem.moes.l);
        if let Some(rough) = problem.rough.filter(|rough| formula_film(problem) < APART * rough.sigma) {
            // Asperities that carry most of the load leave a film that smooth surfaces would not have.
            return match m / S::EASY_M.1 {
                heavier if heavier > 1.0 => Self::Speed(heavier.ln() / problem.point.kind.speed_power()),
                _ => Self::Roughness((formula_film(problem) / (APART * rough.sigma)).ln()),
            };
        }
        let easy_m = if continues { m } else { m.clamp(S::EASY_M.0, S::EASY_M.1) };
        let easy_l = if continues { 0.25 * S::EASY_L } else { S::EASY_L };
        Self::Loads { m: (easy_m / m).ln(), l: if l > easy_l { (easy_l / l).ln() } else { 0.0 } }
    }

    /// Returns its length in ln M.
    fn length(&self) -> f64 {
        match self {
            Self::Loads { m, l } => m.abs() + 3.0 * l.abs(),
            Self::Supply(share) | Self::Roughness(share) => share.abs(),
            Self::Speed(share) => 0.5 * share.abs(),
        }
    }

    /// Returns the contact at the share t of the path: the easy one at 0, the requested one at 1.
    fn at(&self, problem: &Problem, t: f64) -> Option<Problem> {
        if t >= 1.0 {
            return Some(*problem);
        }
        match self {
            Self::Supply(thin) => {
                Some(Problem { supply: problem.supply.map(|supply| supply * ((1.0 - t) * thin).exp()), ..*problem })
            }
            Self::Roughness(share) => {
                let scaled = |rough: Roughness| Roughness { sigma: rough.sigma * ((1.0 - t) * share).exp(), ..rough };
                let lubricant = Lubricant { roughness: problem.lubricant.roughness.map(scaled), ..problem.lubricant };
                Problem::new(&problem.point, lubricant).ok()
            }
            Self::Speed(share) => {
                let speed_m_per_s = problem.point.speed_m_per_s * ((1.0 - t) * share).exp();
                Problem::new(&OperatingPoint { speed_m_per_s, ..problem.point }, problem.lubricant).ok()
            }
            Self::Loads { m, l } => {
                // Speed and load change at the same α: L grows with the fourth root of the speed.
                let point = &problem.point;
                let (speed, power) = (4.0 * (1.0 - t) * l, problem.point.kind.speed_power());
                let easier = OperatingPoint {
                    speed_m_per_s: point.speed_m_per_s * speed.exp(),
                    load: point.load * ((1.0 - t) * m + power * speed).exp(),
                    ..*point
                };
                Problem::under_sliding(&easier, problem.lubricant, point.sliding).ok()
            }
        }
    }
}

/// Solved contact of the path.
struct Passed {
    t: f64,
    level: usize,
    solution: Solution,
}

/// Returns the initial guess of a step: pressure and central film thickness extrapolated along the path.
fn extrapolated(last: &Passed, before: Option<&Passed>, next: f64) -> (Solution, Option<f64>) {
    let mut start = last.solution.clone();
    let before = before.filter(|before| {
        let former = &before.solution;
        former.mesh == last.solution.mesh && former.scalars.h_c > 0.0 && start.fraction.is_empty()
    });
    let Some(before) = before else { return (start, None) };
    let share = (next - last.t) / (last.t - before.t);
    for (p, former) in start.pressure.iter_mut().zip(&before.solution.pressure) {
        if *p > 0.0 {
            *p = (*p + share * (*p - former.max(0.0))).max(0.0);
        }
    }
    let film = last.solution.scalars.h_c;
    (start, Some(film * (film / before.solution.scalars.h_c).powf(share)))
}

impl<S: NewtonSpace> Solver<S> {
    /// Follows the path from an easier contact to the requested one.
    pub(super) fn walk(
        &mut self,
        problem: &Problem,
        observer: &dyn Observer,
        report: &mut Report,
    ) -> Result<(), SolveError> {
        let system = self.system_for(problem)?;
        let path = Path::to::<S>(problem, system.space.grid().continues());
        self.system = Some(system);
        let length = path.length();
        let Some(first) = path.at(problem, 0.0) else { return Ok(()) };
        let most = report.newton_iterations + most_walked(S::unknowns(&self.reference));
        let mut levels: Vec<Self> = Vec::new();
        let mut begun = None;
        let level = self.coarsening(&mut levels, &first)?;
        for beginning in ColdStart::all(S::COLD_FILMS).map(Beginning::Cold) {
            begun = self.step((&mut levels, level, length > 0.0), &first, beginning, most, observer, report)?;
            if begun.is_some() || report.termination == Termination::Cancelled {
                break;
            }
        }
        let Some(solution) = begun else { return Ok(()) };
        let mut last = Passed { t: if length > 0.0 { 0.0 } else { 1.0 }, level, solution };
        let mut before: Option<Passed> = None;
        let longest = if length > 0.0 { LONGEST_STRIDE / length } else { 1.0 };
        let mut stride = FIRST_STRIDE / LONGEST_STRIDE * longest;
        let shortest = SHORTEST_STRIDE / length.max(SHORTEST_STRIDE);
        // Coarsest level that still converges along the path.
        let mut coarsest = usize::MAX;
        while last.t < 1.0 || last.level > 0 {
            let refines = last.t >= 1.0;
            let next = if last.t + 1.2 * stride >= 1.0 { 1.0 } else { last.t + stride };
            let at = |passed: &Passed| passed.solution.problem.moes;
            observer.walk_step(&WalkStep { wanted: problem.moes, reached: at(&last) });
            let Some(wanted) = path.at(problem, next) else { break };
            let level = match refines {
                true => last.level - 1,
                false => self.coarsening(&mut levels, &wanted)?.min(coarsest),
            };
            let (start, film) = extrapolated(&last, before.as_ref(), next);
            let spent = report.newton_iterations;
            let along = !(level == 0 && next >= 1.0);
            match self.step(
                (&mut levels, level, along),
                &wanted,
                Beginning::Along(&start, film),
                most,
                observer,
                report,
            )? {
                Some(solution) => {
                    let passed = std::mem::replace(&mut last, Passed { t: next, level, solution });
                    if !refines {
                        before = Some(passed);
                    }
                    stride *= match report.newton_iterations - spent {
                        ..QUICK => 1.5,
                        QUICK..=SLOW => 1.0,
                        _ => 0.5,
                    };
                    stride = stride.min(longest);
                }
                None if matches!(report.termination, Termination::Cancelled | Termination::Effort) => break,
                // The film on the coarser grid is too far from that on the finer one: return to the last contact
                // before the requested one, and continue on finer grids.
                None if refines => {
                    let Some(passed) = before.take() else { break };
                    coarsest = level;
                    stride = 0.5 * (1.0 - passed.t);
                    last = passed;
                }
                None => stride = 0.5 * stride.min(next - last.t),
            }
            if stride < shortest {
                break;
            }
        }
        if last.t < 1.0 || last.level > 0 {
            report.reached = Some(last.solution.problem.moes);
            if report.termination == Termination::Converged {
                report.termination = Termination::IterationLimit;
            }
        }
        Ok(())
    }

    /// Returns the coarsest level of grids that resolves a contact of the path, and builds the grids up to it. Level 0
    /// is the solver's grid, and each level doubles the spacing.
    fn coarsening(&self, levels: &mut Vec<Self>, problem: &Problem) -> Result<usize, SolveError> {
        let wanted = S::coarsening(&self.reference, problem);
        while levels.len() < wanted {
            let Some(coarser) = S::coarser(&self.reference, levels.len() as i32 + 1)? else { break };
            levels.push(Self { options: self.options, ..Self::on(coarser) });
        }
        Ok(wanted.min(levels.len()))
    }

    /// Solves one contact of the path on the grid of a level, with a lower accuracy if `along` the path.
    fn step(
        &mut self,
        (levels, level, along): (&mut [Self], usize, bool),
        problem: &Problem,
        beginning: Beginning<'_>,
        most: usize,
        observer: &dyn Observer,
        report: &mut Report,
    ) -> Result<Option<Solution>, SolveError> {
        let solver = match level {
            0 => self,
            level => &mut levels[level - 1],
        };
        let options = solver.options;
        solver.options.max_newton = options.max_newton.min(MOST_PER_STEP);
        if along {
            solver.options.tolerance *= ALONG_THE_WAY;
        }
        let ended = solver.attempt(problem, beginning, most, observer, report);
        solver.options = options;
        ended?;
        if report.termination != Termination::Converged {
            return Ok(None);
        }
        solver.solution(*problem, Report::empty()).map(Some)
    }
}

impl Problem {
    /// Returns M of a line contact or a circular contact. For an elliptical contact it is that of the circular
    /// contact with the same λ̄, (2.23).
    pub(super) fn load_as_a_circle(&self) -> f64 {
        if self.point.is_elliptic() {
            // λ̄ of a circular contact is 4π/(M ∛(3M/2)).
            return (4.0 * std::f64::consts::PI * self.inverse_lambda / 1.5f64.cbrt()).powf(0.75);
        }
        self.moes.m
    }
}
