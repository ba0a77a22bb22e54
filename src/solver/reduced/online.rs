//! The online phase: which window, which start, and back to fields.

use super::calibration::{ErrorEstimate, Features};
use super::model::{ReducedModel, Snapshot, Trust, Window};
use super::operators::{Case, OnlineOutcome, Operators, RowObserver, Stop};
use super::start::{self, Former, Guess, Known, film_number};
use crate::solver::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::full::{
    Mesh, Problem, Report, Scalars, Solution, SolveError, Termination, point_scalars_of, scalars_of,
};
use crate::solver::grid::{ContactGrid, dot};
use crate::solver::lubricant::Lubricant;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Par};
use std::cell::OnceCell;
use std::sync::Arc;

/// Newton steps before another start is tried: good starts need 4, and what needs more than 12 mostly never gets there.
const FIRST_ATTEMPTS: usize = 12;

/// Why a reduced solve gives no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReducedError {
    /// The problem itself is refused.
    #[error(transparent)]
    Problem(#[from] SolveError),
    /// The lubricant is none the reduced equations describe.
    #[error(
        "the reduced model was trained for a lubricant that does not thin under shear; use the full solver, or a model of this lubricant"
    )]
    ShearThinning,
    /// The model is of the other kind of contact.
    #[error("the reduced model is of {} contacts, but the operating point is that of a {} contact", model.name(), given.name())]
    OtherContact {
        /// What the model is of.
        model: ContactKind,
        /// What it was given.
        given: ContactKind,
    },
    /// The model holds no window.
    #[error("the reduced model holds no bases")]
    Empty,
    /// Newton's iteration did not converge.
    #[error(
        "the reduced model did not converge in {iterations} iterations (last step {step:.1e}); use the full solver here"
    )]
    NotConverged {
        /// Steps taken.
        iterations: usize,
        /// Last relative step.
        step: f64,
    },
}

/// From where an online iteration is started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Starts {
    /// The line through the last two solutions where the contact continues it, the last one where it is near, an interpolation between snapshots,
    /// the nearest snapshot, continuation from it.
    #[default]
    Explorer,
    /// The nearest snapshot by (3.20) as it is, and nothing else: the dissertation's.
    Nearest,
}

/// Settings of the online phase; changing them does not retrain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedOptions {
    /// Keep only this many pressure modes.
    pub pressure_modes: Option<usize>,
    /// Use the dissertation's V_δ V_δᵀ K V_p with this many deformation modes instead of the exact K V_p.
    pub deformation_modes: Option<usize>,
    /// Stop on ‖Δp̃‖/‖p̃‖ below this. Newton converges quadratically: the error left is the square of it.
    pub tolerance: f64,
    /// Newton steps at most.
    pub max_newton: usize,
    /// Penalty factor γ̄ of (2.36) in place of the window's own.
    pub penalty: Option<f64>,
    /// From where it starts.
    pub starts: Starts,
}

impl Default for ReducedOptions {
    fn default() -> Self {
        Self {
            pressure_modes: None,
            deformation_modes: None,
            tolerance: 1e-5,
            max_newton: 40,
            penalty: None,
            starts: Starts::Explorer,
        }
    }
}

impl ReducedOptions {
    /// The dissertation's scheme: the state holds δ̃ with all modes that were kept, and starts from the nearest snapshot only.
    pub fn dissertation() -> Self {
        Self { deformation_modes: Some(usize::MAX), starts: Starts::Nearest, ..Self::default() }
    }
}

/// What the online phase returns: small numbers only; fields are reconstructed on request.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedSolution {
    /// The operating point it belongs to.
    pub point: OperatingPoint,
    /// The laws it belongs to.
    pub lubricant: Lubricant,
    /// The window that served it.
    pub window: usize,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    /// Central film H_c.
    pub h_c: f64,
    /// Traction coefficient (3.41) by the window's rule on few nodes; none of a model that does not know sliding.
    pub traction: Option<f64>,
    /// Newton steps.
    pub iterations: usize,
    /// e_f^I, (3.15), in the L2 norm over X restricted to the sampled rows.
    pub residual_estimate: f64,
    /// Calibrated estimate of its errors. None where the model has no calibration, or solved otherwise than it was calibrated: outside
    /// its domain, with fewer modes or other settings.
    pub error: Option<ErrorEstimate>,
    /// Whether the model was trained for the point.
    pub trust: Trust,
}

/// A model with the operators of the chosen truncation and all work space.
pub struct Online {
    /// The model.
    pub model: Arc<ReducedModel>,
    options: ReducedOptions,
    /// Operators of each window, made when it is first needed.
    windows: Vec<OnceCell<Operators>>,
    /// The last converged solutions, where the next one starts while somebody drags or follows a curve.
    former: Former,
}

impl Online {
    /// A solver for the model; operators are prepared per window when first needed.
    pub fn new(model: Arc<ReducedModel>, options: ReducedOptions) -> Self {
        let windows = model.windows.iter().map(|_| OnceCell::new()).collect();
        Self { model, options, windows, former: Former::default() }
    }

    /// The settings in force.
    pub fn options(&self) -> &ReducedOptions {
        &self.options
    }

    /// Makes the operators of the window that serves a contact, so that the next solve there does not have to.
    pub fn prepare(&mut self, moes: Moes) {
        let index = self.model.window_for(moes);
        if let (Some(window), Some(cell)) = (self.model.windows.get(index), self.windows.get(index)) {
            cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        }
    }

    /// Forgets the previous solutions, so that the next solve starts from the snapshots.
    pub fn forget(&mut self) {
        self.former = Former::default();
    }

    /// Solves a contact: from the last two solutions of this object where it continues their line, from the last one where that is near, else
    /// from the snapshots around the point, else from the nearest one by (3.20), else by continuation from that one.
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn solve(&mut self, point: &OperatingPoint, lubricant: Lubricant) -> Result<ReducedSolution, ReducedError> {
        self.solve_observed(point, lubricant, None)
    }

    /// [`Online::solve`] showing every iterate's sampled rows, for the training.
    pub(crate) fn solve_observed(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        mut observer: Option<RowObserver<'_>>,
    ) -> Result<ReducedSolution, ReducedError> {
        let model = self.model.contact();
        if point.kind != model {
            return Err(ReducedError::OtherContact { model, given: point.kind });
        }
        let problem = Problem::new(point, lubricant)?;
        if problem.shear.is_some() && self.model.domain.sliding.is_none() {
            return Err(ReducedError::ShearThinning);
        }
        // Its α and its plateau ratio are those that count.
        let point = &problem.point;
        let index = self.model.window_for(problem.moes);
        let model = Arc::clone(&self.model);
        let (Some(window), Some(cell)) = (model.windows.get(index), self.windows.get_mut(index)) else {
            return Err(ReducedError::Empty);
        };
        cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let Some(operators) = cell.get_mut() else { return Err(ReducedError::Empty) };
        if self.options.starts == Starts::Nearest {
            let guess = start::unchanged(window, point).ok_or(ReducedError::Empty)?;
            let found = attempt(window, operators, &problem, &guess, usize::MAX, &self.options, &mut observer)?;
            return Ok(self.keep(&problem, index, found));
        }
        let thinning = self.model.domain.sliding.is_some();
        let mut last = ReducedError::Empty;
        let former = [self.former.continued(index, point), self.former.beside(index, point)];
        let interpolated = std::iter::once_with(|| start::interpolated(window, point, thinning));
        let nearest = std::iter::once_with(|| start::nearest(window, point));
        for guess in former.into_iter().chain(interpolated).chain(nearest).flatten() {
            match attempt(window, operators, &problem, &guess, FIRST_ATTEMPTS, &self.options, &mut observer) {
                Ok(found) => return Ok(self.keep(&problem, index, found)),
                Err(error) => last = error,
            }
        }
        // The last resort: walk from the nearest snapshot's operating point to this one.
        let walked = window
            .nearest(point)
            .and_then(|(snapshot, _)| walk(window, operators, &problem, snapshot, &self.options, &mut observer));
        match walked {
            Some(found) => Ok(self.keep(&problem, index, found)),
            None => {
                self.forget();
                Err(last)
            }
        }
    }

    /// Solves a contact from one snapshot of its window and from nowhere else, showing every iterate, for the training.
    pub(crate) fn solve_from(
        &mut self,
        snapshot: &Snapshot,
        point: &OperatingPoint,
        lubricant: Lubricant,
        observer: RowObserver<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        let problem = Problem::new(point, lubricant)?;
        let index = self.model.window_for(problem.moes);
        let model = Arc::clone(&self.model);
        let window = model.windows.get(index).ok_or(ReducedError::Empty)?;
        self.prepare(problem.moes);
        let operators = self.windows.get_mut(index).and_then(OnceCell::get_mut).ok_or(ReducedError::Empty)?;
        let guess = start::carried(snapshot, point);
        let found = attempt(window, operators, &problem, &guess, usize::MAX, &self.options, &mut Some(observer))?;
        Ok(self.keep(&problem, index, found))
    }

    /// Remembers a solution as the next start and returns it.
    fn keep(&mut self, problem: &Problem, window: usize, found: Found) -> ReducedSolution {
        let Found { coefficients, h_0, h_c, iterations, residual, traction } = found;
        self.former.remember(Known { window, point: problem.point, coefficients: coefficients.clone(), h_c });
        let trust = self.model.trust(problem);
        let calibration = self.model.windows.get(window).and_then(|w| w.calibration.as_ref());
        let mut error = calibration
            .filter(|_| trust == Trust::Trained && self.options == ReducedOptions::default())
            .map(|c| c.estimate(&Features::new(&problem.point, residual, &coefficients, c.sliding())));
        if let Some(estimate) = error.as_mut().filter(|estimate| estimate.traction.is_some()) {
            // Of a traction that is no physics nothing is promised.
            estimate.traction = estimate.traction.filter(|_| problem.traction_warning().is_none());
        }
        ReducedSolution {
            point: problem.point,
            lubricant: problem.lubricant,
            window,
            coefficients,
            h_0,
            h_c,
            traction,
            iterations,
            residual_estimate: residual,
            error,
            trust,
        }
    }

    /// Fields and scalars of a reduced solution, on the window's grid; `report.newton_iterations` holds the online iterations.
    ///
    /// # Errors
    /// When the solution's point is refused or it belongs to another model.
    pub fn reconstruct(&self, solution: &ReducedSolution) -> Result<Solution, ReducedError> {
        let fields = self.fields(solution)?;
        let scalars = fields.scalars(solution.h_0);
        let Fields { problem, grid, scale, pressure, film } = fields;
        let (mesh, x, y) = match &grid {
            ContactGrid::Line(grid) => (Mesh::Line { spec: grid.spec, scale }, grid.scaled(scale).x, vec![0.0]),
            ContactGrid::Point(grid) => (Mesh::Point(grid.spec), grid.x.clone(), grid.y.clone()),
        };
        Ok(Solution {
            problem,
            mesh,
            scalars,
            x,
            y,
            pressure,
            film,
            report: Report {
                termination: Termination::Converged,
                newton_iterations: solution.iterations,
                linear_iterations: 0,
                attempts: 1,
                residuals: Vec::new(),
                steps: Vec::new(),
                residual_norm: solution.residual_estimate,
            },
        })
    }

    /// Scalars only.
    ///
    /// # Errors
    /// When the solution's point is refused or it belongs to another model.
    pub fn scalars(&self, solution: &ReducedSolution) -> Result<Scalars, ReducedError> {
        Ok(self.fields(solution)?.scalars(solution.h_0))
    }

    fn fields(&self, solution: &ReducedSolution) -> Result<Fields, ReducedError> {
        let problem = Problem::new(&solution.point, solution.lubricant)?;
        let (Some(window), Some(cell)) = (self.model.windows.get(solution.window), self.windows.get(solution.window))
        else {
            return Err(ReducedError::Empty);
        };
        let operators = cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let modes = solution.coefficients.len();
        if modes > window.pressure.modes.ncols() || modes != operators.modes {
            return Err(ReducedError::Empty);
        }
        let scale = window.grid.scale(problem.moes);
        let multiply = |matrix: faer::MatRef<'_, f64>| {
            let mut out = vec![0.0; matrix.nrows()];
            matmul(
                ColMut::from_slice_mut(&mut out).as_mat_mut(),
                Accum::Replace,
                matrix,
                ColRef::from_slice(&solution.coefficients).as_mat(),
                1.0,
                Par::Seq,
            );
            out
        };
        let pressure = multiply(window.pressure.modes.get(.., ..modes));
        let mut film = multiply(operators.deformation(window));
        let offset = solution.h_0 - 0.5 * scale.ln();
        for (node, h) in film.iter_mut().enumerate() {
            let (xi, y) = window.grid.place(node);
            let x = -1.0 + (xi + 1.0) * scale;
            *h = offset + 0.5 * (x * x + y * y) + scale * *h;
        }
        Ok(Fields { problem, grid: window.grid.clone(), scale, pressure, film })
    }
}

/// Reconstructed node arrays.
struct Fields {
    problem: Problem,
    grid: ContactGrid,
    scale: f64,
    pressure: Vec<f64>,
    film: Vec<f64>,
}

impl Fields {
    fn scalars(&self, h_0: f64) -> Scalars {
        let Self { problem, grid, scale, pressure, film } = self;
        match grid {
            ContactGrid::Line(grid) => scalars_of(&grid.scaled(*scale), problem, pressure, film, h_0),
            ContactGrid::Point(grid) => point_scalars_of(grid, problem, pressure, film, h_0),
        }
    }
}

fn operators_of(model: &ReducedModel, window: &Window, options: &ReducedOptions) -> Operators {
    let modes = options.pressure_modes.unwrap_or(usize::MAX);
    Operators::new(window, modes, options.deformation_modes, model.domain.sliding.is_some())
}

/// A converged online iteration.
struct Found {
    coefficients: Vec<f64>,
    h_0: f64,
    h_c: f64,
    iterations: usize,
    residual: f64,
    traction: Option<f64>,
}

/// Newton from a guess, within `limit` steps and the options' own limit.
fn attempt(
    window: &Window,
    operators: &mut Operators,
    problem: &Problem,
    start: &Guess,
    limit: usize,
    options: &ReducedOptions,
    observer: &mut Option<RowObserver<'_>>,
) -> Result<Found, ReducedError> {
    let scale = window.grid.scale(problem.moes);
    let zero = window.grid.at_zero(scale);
    let mut coefficients = start.coefficients[..operators.modes].to_vec();
    operators.carry_load(problem, scale, &mut coefficients);
    // H(0) = H₀ − ½ ln s + s δ(0).
    let deformation = operators.deformation(window);
    let at_zero = |k: usize| scale * zero.iter().map(|(node, w)| w * deformation[(*node, k)]).sum::<f64>();
    let lift: Vec<f64> = (0..operators.modes).map(at_zero).collect();
    let offset = -0.5 * scale.ln();
    let mut h_0 = start.h_c - (dot(&lift, &coefficients) + offset);
    let watch = observer.as_mut().map(|o| &mut **o as RowObserver<'_>);
    let case = Case { problem, scale, curvature: 1.0, penalty: options.penalty.unwrap_or(window.penalty), lift: &lift };
    let stop = Stop { tolerance: options.tolerance, max_newton: options.max_newton.min(limit) };
    let outcome = operators.newton(&case, &mut coefficients, &mut h_0, stop, watch);
    let h_c = h_0 + (dot(&lift, &coefficients) + offset);
    if outcome.converged && h_c > 0.0 {
        let OnlineOutcome { iterations, residual, .. } = outcome;
        let traction = operators.traction(problem, scale);
        Ok(Found { coefficients, h_0, h_c, iterations, residual, traction })
    } else {
        Err(ReducedError::NotConverged { iterations: outcome.iterations, step: outcome.step })
    }
}

/// Continuation in the logarithms of the SI quantities from a snapshot's point, with steps that shrink on failure.
fn walk(
    window: &Window,
    operators: &mut Operators,
    target: &Problem,
    snapshot: &Snapshot,
    options: &ReducedOptions,
    observer: &mut Option<RowObserver<'_>>,
) -> Option<Found> {
    let (from, to) = (snapshot.point.quantities(), target.point.quantities());
    let at = |t: f64| {
        let q: [f64; 6] = std::array::from_fn(|i| from[i] * (to[i] / from[i]).powf(t));
        let sliding = snapshot.point.sliding.towards(target.point.sliding, t);
        let point = OperatingPoint::from_quantities(target.point.kind, q, sliding);
        Problem::new(&point, target.lubricant).ok()
    };
    let (mut t, mut stride) = (0.0, 0.25);
    let mut guess = Guess { coefficients: snapshot.coefficients.clone(), h_c: snapshot.h_c };
    let mut from_point = snapshot.point;
    let mut iterations = 0;
    while stride > 0.01 {
        let next = f64::min(t + stride, 1.0);
        let problem = if next >= 1.0 { *target } else { at(next)? };
        let h_c = guess.h_c * film_number(&problem.point) / film_number(&from_point);
        let start = Guess { h_c, ..guess.clone() };
        match attempt(window, operators, &problem, &start, usize::MAX, options, observer) {
            Ok(found) => {
                iterations += found.iterations;
                if next >= 1.0 {
                    return Some(Found { iterations, ..found });
                }
                (t, stride) = (next, 1.5 * stride);
                guess = Guess { coefficients: found.coefficients, h_c: found.h_c };
                from_point = problem.point;
            }
            Err(_) => stride *= 0.4,
        }
    }
    None
}
