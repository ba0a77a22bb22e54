//! Online phase of a reduced model. For a contact it selects the local model, runs Newton's method on the sampled
//! equations from several initial guesses, and blends neighbouring local models. Fields are reconstructed on request.

mod attempt;
mod fields;
mod proof;
mod settings;
mod tangent;

pub use settings::{ReducedError, ReducedOptions, Starts};

use super::calibration::{FeatureSet, Features};
use super::domain::Trust;
use super::kriging::Kriging;
use super::model::{ReducedModel, Snapshot, Window};
use super::operators::{Flow, Operators, RowObserver};
use super::reduced_solution::ReducedSolution;
use super::shapes::Shapes;
use super::start::{self, Former, Guess, Known};
use crate::solver::full::Problem;
use crate::solver::observer::Observer;
use crate::solver::parameters::Metric;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::warning::ENDURED_K;
use attempt::{Found, Watch, attempt, walk};
use std::cell::OnceCell;
use std::sync::Arc;

/// Maximum number of Newton steps before another initial guess is tried. Good guesses need 4; iterations with more
/// than 12 rarely converge.
const STEPS_PER_GUESS: usize = 12;

/// Shares of the modes, tried one after the other for a circular contact. With all modes the sampled equations may have
/// no solution, because the last modes hardly appear in any pressure and a shared basis represents them only in part.
/// With fewer modes these contacts converge, with an error of the central film thickness of up to 3.4e-3. For
/// shear-thinning or thermal contacts, shares below 1 are tried last. Line contacts need all modes.
static SHARES: [f64; 5] = [1.0, 0.875, 0.75, 0.625, 0.5];

/// Online solver: reduced model, operators for the selected numbers of modes, and work space.
pub struct Online {
    /// Reduced model.
    pub model: Arc<ReducedModel>,
    options: ReducedOptions,
    /// Operators of each local model, built at first use.
    windows: Vec<OnceCell<Operators>>,
    /// Kriging of the initial guess, one per local model, built at first use. `None` if there are too few solutions.
    /// Used only in local models around an anchor or of rough contacts.
    krigings: Vec<OnceCell<Option<Kriging>>>,
    /// Last converged solutions: initial guesses of the next solve during dragging or along a curve.
    former: Former,
}

impl Online {
    /// Creates a solver for the model. The operators of a local model are built at first use.
    pub fn new(model: Arc<ReducedModel>, options: ReducedOptions) -> Self {
        let windows = model.windows.iter().map(|_| OnceCell::new()).collect();
        let krigings = model.windows.iter().map(|_| OnceCell::new()).collect();
        Self { model, options, windows, krigings, former: Former::default() }
    }

    /// Returns the settings.
    pub fn options(&self) -> &ReducedOptions {
        &self.options
    }

    /// Builds the operators for a contact, so that the next solve does not have to.
    pub fn prepare(&mut self, point: &OperatingPoint) {
        self.prepare_window(self.model.window_for(point));
    }

    /// Builds the operators of a local model.
    fn prepare_window(&mut self, index: usize) {
        if let (Some(window), Some(cell)) = (self.model.windows.get(index), self.windows.get(index)) {
            cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        }
    }

    /// Discards the previous solutions, so that the next solve starts from the snapshots.
    pub fn forget(&mut self) {
        self.former = Former::default();
    }

    /// Solves a contact. Initial guesses are tried in this order:
    ///
    /// 1. kriging, in a local model around an anchor or of rough contacts; with heat it comes after 2;
    /// 2. extrapolation of the last two solutions, or the last solution, if the contact is near. An isothermal contact
    ///    with kriging omits these;
    /// 3. interpolation between the snapshots (training solutions) around the contact;
    /// 4. the nearest snapshot by the distance measure (3.20);
    /// 5. continuation in small steps from that snapshot.
    ///
    /// # Errors
    /// [`ReducedError`] if the point is refused or Newton's method does not converge.
    pub fn solve(&mut self, point: &OperatingPoint, lubricant: Lubricant) -> Result<ReducedSolution, ReducedError> {
        self.solve_watched(point, lubricant, &())
    }

    /// Solves a contact like [`Online::solve`], but checks for cancellation before each attempt. An attempt takes a
    /// few milliseconds, with heat about ten. Cancellation discards the previous solutions.
    ///
    /// # Errors
    /// As [`Online::solve`], and [`ReducedError::Cancelled`].
    pub fn solve_watched(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        observer: &dyn Observer,
    ) -> Result<ReducedSolution, ReducedError> {
        let solved = self.solved(point, lubricant, Watch::of(observer));
        if observer.cancelled() {
            // A cancellation may have stopped the attempts of one local model only.
            self.forget();
            return Err(ReducedError::Cancelled);
        }
        solved
    }

    /// Solves a contact like [`Online::solve`] and passes the sampled equations of every iterate to `rows`, for the
    /// training.
    pub(crate) fn solve_observed(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        rows: RowObserver<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        self.solved(point, lubricant, Watch { rows: Some(rows), ..Watch::of(&()) })
    }

    /// Solves a contact in its local model and blends in the neighbouring ones. Refuses an implausible solution outside
    /// the trained range.
    fn solved(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        mut watch: Watch<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        let index = self.model.window_for(point);
        let observer = watch.wish;
        let (mut solved, blended) = match self.iterated(index, point, lubricant, &mut watch) {
            Ok(solved) => (solved, self.model.blended(point.moes())),
            // The next local model also covers contacts near the common border. Its errors were not measured there.
            Err(why @ ReducedError::NotConverged { .. }) => {
                let next = self.model.next_anchor(point.moes(), index).ok_or(why.clone())?;
                let solved = self.iterated(next, point, lubricant, &mut Watch::of(observer)).map_err(|_| why)?;
                (ReducedSolution { error: None, by_neighbour: true, ..solved }, Vec::new())
            }
            Err(why) => return Err(why),
        };
        for (share, further) in blended {
            // A local model without a solution is left out of the blend.
            if let Ok(other) = self.iterated(further, point, lubricant, &mut Watch::of(observer)) {
                solved.beside.push((share, other));
            }
        }
        solved.blend();
        let doubt = if solved.trust == Trust::Trained { None } else { self.doubt(&solved)? };
        match doubt {
            None => Ok(solved),
            Some(why) => {
                self.forget();
                Err(ReducedError::Implausible(why))
            }
        }
    }

    /// Returns the reason why a solution outside the trained range is not accepted; `None` for an accepted one.
    fn doubt(&self, solved: &ReducedSolution) -> Result<Option<String>, ReducedError> {
        let window = self.model.windows.get(solved.window).ok_or(ReducedError::Empty)?;
        if let Some(why) = window.residual_doubt(solved.residual_estimate) {
            return Ok(Some(why));
        }
        if window.is_rough() {
            return Ok(None);
        }
        let lowest = self.lowest_film(solved)?;
        Ok((lowest.is_nan() || lowest <= 0.0).then(|| format!("its film thickness falls to H = {lowest:.1e}")))
    }

    /// Runs Newton's method in one local model, from one initial guess after the other until it converges.
    fn iterated(
        &mut self,
        index: usize,
        point: &OperatingPoint,
        lubricant: Lubricant,
        watch: &mut Watch<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        let model = self.model.contact();
        if point.kind != model {
            return Err(ReducedError::OtherContact { model, given: point.kind });
        }
        let problem = Problem::new(point, lubricant)?;
        if problem.heat.is_some() && !self.model.domain.heats() {
            return Err(ReducedError::Heat);
        }
        let rough = problem.rough.is_some();
        if rough != self.model.domain.is_rough() {
            return Err(ReducedError::Roughness { rough });
        }
        if problem.shear.is_some() && !self.model.slides() {
            return Err(ReducedError::ShearThinning);
        }
        // `own` is the problem whose equations are solved, with the contact's own α and plateau ratio. `point` selects
        // the initial guesses: it is the equivalent contact with the trained Eyring stress or roughness.
        let model = Arc::clone(&self.model);
        let point = &model.domain.as_trained(&problem.point, &problem.lubricant);
        let own = model.domain.as_solved(&problem)?;
        let kriged = self.kriged(index, point);
        // An isothermal kriging prediction depends on the contact alone. If it comes first, the result does not depend
        // on previous solutions.
        let former_first = kriged.is_none() || problem.heat.is_some();
        let (Some(window), Some(cell)) = (model.windows.get(index), self.windows.get_mut(index)) else {
            return Err(ReducedError::Empty);
        };
        Shapes::check(window.shapes.as_ref(), point, &model.domain.space)?;
        cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let Some(operators) = cell.get_mut() else { return Err(ReducedError::Empty) };
        if self.options.starts == Starts::Nearest {
            let guess = start::unchanged(window, point).ok_or(ReducedError::Empty)?;
            let found = attempt(window, operators, &own, &guess, usize::MAX, &self.options, watch)?;
            return Ok(self.keep(&problem, index, found));
        }
        let thinning = self.model.slides();
        let mut last = ReducedError::Empty;
        let former = [self.former.continued(index, point), self.former.beside(index, point)];
        let former = former.into_iter().filter(|_| former_first).flatten();
        let interpolated = std::iter::once_with(|| start::interpolated(window, point, thinning));
        let nearest = std::iter::once_with(|| start::nearest(window, point));
        let (at_once, at_last) = if watch.rows.is_none() { model.shares_of_modes() } else { all_modes() };
        let with = |shares: &'static [f64]| {
            kriged.iter().flat_map(move |guess| shares.iter().map(|share| guess.with_modes(*share)))
        };
        for guess in former.chain(with(at_once)).chain(interpolated.chain(nearest).flatten()) {
            match attempt(window, operators, &own, &guess, STEPS_PER_GUESS, &self.options, watch) {
                Ok(found) => return Ok(self.keep(&problem, index, found)),
                Err(error) => last = error,
            }
        }
        // If all guesses fail, fewer modes are tried, then continuation from the nearest snapshot. The latter comes
        // last, because with heat a failed continuation takes seconds.
        let fewer = with(at_last)
            .find_map(|guess| attempt(window, operators, &own, &guess, STEPS_PER_GUESS, &self.options, watch).ok());
        let found = fewer.or_else(|| {
            let (snapshot, _) = window.nearest(point)?;
            walk(window, operators, &own, snapshot, &self.options, watch)
        });
        match found {
            Some(found) => Ok(self.keep(&problem, index, found)),
            None => {
                self.forget();
                Err(last)
            }
        }
    }

    /// Returns the kriging prediction of the initial guess; `None` if the local model has no kriging.
    fn kriged(&self, index: usize, point: &OperatingPoint) -> Option<Guess> {
        let by_kriging = |window: &&Window| window.anchor.is_some() || window.is_rough();
        let window = self.model.windows.get(index).filter(by_kriging)?;
        self.krigings
            .get(index)?
            .get_or_init(|| Kriging::of(window, Metric::of_starts(&self.model.domain.space)))
            .as_ref()?
            .start(window, point)
    }

    /// Solves a contact with one snapshot of its local model as the only initial guess, for the training. Passes every
    /// iterate to `observer`.
    pub(crate) fn solve_from(
        &mut self,
        snapshot: &Snapshot,
        point: &OperatingPoint,
        lubricant: Lubricant,
        observer: RowObserver<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        let problem = Problem::new(point, lubricant)?;
        let index = self.model.window_for(&problem.point);
        let model = Arc::clone(&self.model);
        let window = model.windows.get(index).ok_or(ReducedError::Empty)?;
        self.prepare(&problem.point);
        let operators = self.windows.get_mut(index).and_then(OnceCell::get_mut).ok_or(ReducedError::Empty)?;
        let guess = start::carried(window, snapshot, point);
        let watch = &mut Watch { rows: Some(observer), ..Watch::of(&()) };
        let found = attempt(window, operators, &problem, &guess, usize::MAX, &self.options, watch)?;
        Ok(self.keep(&problem, index, found))
    }

    /// Stores a solution as the next initial guess and returns it.
    fn keep(&mut self, problem: &Problem, window: usize, found: Found) -> ReducedSolution {
        let theta = found.theta().to_vec();
        let point = self.model.domain.as_trained(&problem.point, &problem.lubricant);
        let (coefficients, fronts) = (found.coefficients.clone(), found.fronts.clone());
        self.former.remember(Known { window, point, coefficients, h_c: found.h_c, fronts, theta });
        self.solution_of(problem, window, found)
    }

    /// Returns a converged iteration as a solution, with its trust and its error estimate.
    fn solution_of(&self, problem: &Problem, window: usize, found: Found) -> ReducedSolution {
        let Found { coefficients, h_0, h_c, iterations, residual, traction, fronts, heat } = found;
        let domain = &self.model.domain;
        let point = domain.as_trained(&problem.point, &problem.lubricant);
        let knows_traction = domain.knows_traction(problem);
        let trust = self.model.trust(problem);
        let as_measured = trust == Trust::Trained && self.options == ReducedOptions::default();
        let mut solved = ReducedSolution {
            point: problem.point,
            lubricant: problem.lubricant,
            window,
            by_neighbour: false,
            coefficients,
            fronts,
            beside: Vec::new(),
            h_0,
            h_c,
            traction: traction.filter(|_| knows_traction).map(|traction| traction.coefficient),
            cut: traction.and_then(|traction| traction.cut),
            heat,
            iterations,
            residual_estimate: residual,
            error: None,
            trust,
        };
        let own = self.model.windows.get(window).filter(|_| as_measured && !solved.is_too_hot());
        solved.error = own.and_then(|window| {
            let features = Features::of(&solved, &point, &FeatureSet::of(domain));
            window.likely_error(&features, &problem.point, problem.lubricant.cavitation)
        });
        if let Some(estimate) = solved.error.as_mut().filter(|estimate| estimate.traction.is_some()) {
            // The error is not known for an unphysical traction, or for a limiting stress that was not trained. For
            // rough contacts it was measured with a limiting stress.
            let measured = problem.traction_warning().is_none()
                && (problem.rough.is_none() || problem.lubricant.limiting_stress.is_some())
                && (knows_traction || !(domain.is_shear_thinning() && domain.space.varies_lubricant()));
            estimate.traction = estimate.traction.filter(|_| measured);
        }
        solved
    }
}

impl ReducedSolution {
    /// Returns true if the film is hotter than lubricants endure, `ENDURED_K`. Such a solution has no error estimate.
    pub fn is_too_hot(&self) -> bool {
        let inlet_k = self.lubricant.heat.map_or(f64::NAN, |heat| heat.inlet_temperature);
        self.heat.as_ref().is_some_and(|heat| heat.hottest_k(inlet_k) > ENDURED_K)
    }
}

impl ReducedModel {
    /// Returns two lists of shares of the modes for a kriging prediction: those tried at once, and those tried after
    /// all other guesses have failed.
    fn shares_of_modes(&self) -> (&'static [f64], &'static [f64]) {
        match (self.contact(), self.slides()) {
            (ContactKind::Point, false) => (&SHARES, &[]),
            (ContactKind::Point, true) => SHARES.split_at(1),
            _ => all_modes(),
        }
    }
}

/// Returns the same lists for iterations with all modes only. Iterations for a training use all modes.
fn all_modes() -> (&'static [f64], &'static [f64]) {
    (SHARES.split_at(1).0, &[])
}

/// Builds the operators of a local model for the numbers of modes in `options`.
fn operators_of(model: &ReducedModel, window: &Window, options: &ReducedOptions) -> Operators {
    let modes = options.pressure_modes.unwrap_or(usize::MAX);
    let flow = match &model.domain {
        domain if domain.heats() => Flow::Thermal,
        domain if domain.is_shear_thinning() => Flow::Thinning,
        domain if domain.is_rough() => Flow::Rough,
        _ => Flow::Newtonian,
    };
    Operators::new(window, modes, options.deformation_modes, flow)
}
