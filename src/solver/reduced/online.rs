//! The online phase: which window, which start, and back to fields.

mod attempt;
mod fields;
mod proof;
mod settings;

pub use settings::{ReducedError, ReducedOptions, Starts};

use super::calibration::{FeatureSet, Features};
use super::domain::Trust;
use super::kriging::Kriging;
use super::model::{ReducedModel, Snapshot, Window};
use super::operators::{Flow, Operators, RowObserver};
use super::reduced_solution::ReducedSolution;
use super::start::{self, Former, Guess, Known};
use crate::solver::full::Problem;
use crate::solver::observer::Observer;
use crate::solver::parameters::Metric;
use crate::solver::physics::contact::{ContactKind, Ellipse, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::warning::ENDURED_K;
use attempt::{Found, Watch, attempt, walk};
use std::cell::OnceCell;
use std::sync::Arc;

/// Newton steps before another start is tried: good starts need 4, and what needs more than 12 mostly never gets there.
const FIRST_ATTEMPTS: usize = 12;

/// Shares of the modes with which an iteration for a circle is tried. Where it gets nowhere with all, sampled rows
/// may have no solution: the last modes hardly appear in any pressure, and a basis that windows share knows them only
/// in part. Without these all seven converged that had not among 60,000 contacts of three trainings, H_c off by 3.4e-3 at
/// most; from other starts films were off by up to 5e-2. Circles that thin under shear or have heat find their solutions from
/// other starts, all but five of 20,000 and two of 5,000, which are tried with fewer modes at last. Of lines all modes count.
static SHARES: [f64; 5] = [1.0, 0.875, 0.75, 0.625, 0.5];

/// A model with the operators of the chosen truncation and all work space.
pub struct Online {
    /// The model.
    pub model: Arc<ReducedModel>,
    options: ReducedOptions,
    /// Operators of each window, made when it is first needed.
    windows: Vec<OnceCell<Operators>>,
    /// The start in each window around an anchor, made likewise; none where its solutions are too few.
    krigings: Vec<OnceCell<Option<Kriging>>>,
    /// The last converged solutions, where the next one starts while somebody drags or follows a curve.
    former: Former,
}

impl Online {
    /// A solver for the model; operators are prepared per window when first needed.
    pub fn new(model: Arc<ReducedModel>, options: ReducedOptions) -> Self {
        let windows = model.windows.iter().map(|_| OnceCell::new()).collect();
        let krigings = model.windows.iter().map(|_| OnceCell::new()).collect();
        Self { model, options, windows, krigings, former: Former::default() }
    }

    /// The settings in force.
    pub fn options(&self) -> &ReducedOptions {
        &self.options
    }

    /// Makes the operators of the window that serves a contact, so that the next solve there does not have to.
    pub fn prepare(&mut self, point: &OperatingPoint) {
        let index = self.model.window_for(point);
        if let (Some(window), Some(cell)) = (self.model.windows.get(index), self.windows.get(index)) {
            cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        }
    }

    /// Forgets the previous solutions, so that the next solve starts from the snapshots.
    pub fn forget(&mut self) {
        self.former = Former::default();
    }

    /// Solves a contact: from the last two solutions of this object where it continues their line, from the last one
    /// where that is near, else from the snapshots around the point, else from the nearest one by (3.20), else by
    /// continuation from that one.
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn solve(&mut self, point: &OperatingPoint, lubricant: Lubricant) -> Result<ReducedSolution, ReducedError> {
        self.solve_watched(point, lubricant, &())
    }

    /// [`Online::solve`] for someone who may no longer want it: asked before each attempt, which is a few milliseconds of
    /// work, with heat some ten. What was remembered is then forgotten.
    ///
    /// # Errors
    /// As there, and when it was stopped.
    pub fn solve_watched(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        wish: &dyn Observer,
    ) -> Result<ReducedSolution, ReducedError> {
        let solved = self.solved(point, lubricant, Watch::of(wish));
        if wish.cancelled() {
            // A wish in between may have been heard at one window's attempts only.
            self.forget();
            return Err(ReducedError::Cancelled);
        }
        solved
    }

    /// [`Online::solve`] showing every iterate's sampled rows, for the training.
    pub(crate) fn solve_observed(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        rows: RowObserver<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        self.solved(point, lubricant, Watch { rows: Some(rows), wish: &() })
    }

    fn solved(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        mut watch: Watch<'_>,
    ) -> Result<ReducedSolution, ReducedError> {
        let index = self.model.window_for(point);
        let wish = watch.wish;
        let (mut solved, blended) = match self.iterated(index, point, lubricant, &mut watch) {
            Ok(solved) => (solved, self.model.blended(point.moes())),
            // The next window knows contacts of this one near their border; what it is wrong by here was not measured.
            Err(why @ ReducedError::NotConverged { .. }) => {
                let next = self.model.next_anchor(point.moes(), index).ok_or(why.clone())?;
                let solved = self.iterated(next, point, lubricant, &mut Watch::of(wish)).map_err(|_| why)?;
                (ReducedSolution { error: None, stands_in: true, ..solved }, Vec::new())
            }
            Err(why) => return Err(why),
        };
        for (share, further) in blended {
            // Where the one beside has no solution, the own one serves alone.
            if let Ok(other) = self.iterated(further, point, lubricant, &mut Watch::of(wish)) {
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

    /// Why a solution outside the model's range cannot be one.
    fn doubt(&self, solved: &ReducedSolution) -> Result<Option<String>, ReducedError> {
        let window = self.model.windows.get(solved.window).ok_or(ReducedError::Empty)?;
        if let Some(why) = window.residual_doubt(solved.residual_estimate) {
            return Ok(Some(why));
        }
        let lowest = self.lowest_film(solved)?;
        Ok((lowest.is_nan() || lowest <= 0.0).then(|| format!("its film falls to H = {lowest:.1e}")))
    }

    /// Newton's iteration from one start after the other.
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
        if problem.shear.is_some() && !self.model.slides() {
            return Err(ReducedError::ShearThinning);
        }
        // Its α and its plateau ratio are those that count; starts are those of a contact with the trained stress.
        let model = Arc::clone(&self.model);
        let point = &model.domain.as_trained(&problem.point, &problem.lubricant);
        let kriged = self.kriged(index, point);
        // Without heat a start by kriging follows from the contact alone, so that nothing jumps with what was solved before.
        let former_first = kriged.is_none() || problem.heat.is_some();
        let (Some(window), Some(cell)) = (model.windows.get(index), self.windows.get_mut(index)) else {
            return Err(ReducedError::Empty);
        };
        let (ellipse, known) = (point.ellipse(), model.domain.space.radius_ratio());
        if window.shapes.as_ref().map_or(ellipse != Ellipse::CIRCLE, |shapes| !shapes.hold_for(&ellipse)) {
            return Err(ReducedError::Ellipse { given: ellipse.radius_ratio, known });
        }
        cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let Some(operators) = cell.get_mut() else { return Err(ReducedError::Empty) };
        if self.options.starts == Starts::Nearest {
            let guess = start::unchanged(window, point).ok_or(ReducedError::Empty)?;
            let found = attempt(window, operators, &problem, &guess, usize::MAX, &self.options, watch)?;
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
            match attempt(window, operators, &problem, &guess, FIRST_ATTEMPTS, &self.options, watch) {
                Ok(found) => return Ok(self.keep(&problem, index, found)),
                Err(error) => last = error,
            }
        }
        // The last resorts: do with fewer modes, and walk from the nearest snapshot's operating point to this one. With heat a
        // walk that leads nowhere takes seconds.
        let fewer = with(at_last)
            .find_map(|guess| attempt(window, operators, &problem, &guess, FIRST_ATTEMPTS, &self.options, watch).ok());
        let found = fewer.or_else(|| {
            let (snapshot, _) = window.nearest(point)?;
            walk(window, operators, &problem, snapshot, &self.options, watch)
        });
        match found {
            Some(found) => Ok(self.keep(&problem, index, found)),
            None => {
                self.forget();
                Err(last)
            }
        }
    }

    /// The start by kriging in a window around an anchor.
    fn kriged(&self, index: usize, point: &OperatingPoint) -> Option<Guess> {
        let window = self.model.windows.get(index).filter(|window| window.anchor.is_some())?;
        self.krigings
            .get(index)?
            .get_or_init(|| Kriging::of(window, Metric::of_starts(&self.model.domain.space)))
            .as_ref()?
            .start(point)
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
        let index = self.model.window_for(&problem.point);
        let model = Arc::clone(&self.model);
        let window = model.windows.get(index).ok_or(ReducedError::Empty)?;
        self.prepare(&problem.point);
        let operators = self.windows.get_mut(index).and_then(OnceCell::get_mut).ok_or(ReducedError::Empty)?;
        let guess = start::carried(snapshot, point);
        let watch = &mut Watch { rows: Some(observer), wish: &() };
        let found = attempt(window, operators, &problem, &guess, usize::MAX, &self.options, watch)?;
        Ok(self.keep(&problem, index, found))
    }

    /// Remembers a solution as the next start and returns it.
    fn keep(&mut self, problem: &Problem, window: usize, found: Found) -> ReducedSolution {
        let theta = found.theta().to_vec();
        let Found { coefficients, h_0, h_c, iterations, residual, traction, fronts, heat } = found;
        let domain = &self.model.domain;
        let (point, known) = (domain.as_trained(&problem.point, &problem.lubricant), coefficients.clone());
        let knows_traction = domain.knows_traction(problem);
        self.former.remember(Known { window, point, coefficients: known, h_c, fronts: fronts.clone(), theta });
        let trust = self.model.trust(problem);
        let as_measured = trust == Trust::Trained && self.options == ReducedOptions::default();
        let mut solved = ReducedSolution {
            point: problem.point,
            lubricant: problem.lubricant,
            window,
            stands_in: false,
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
            // Of a traction that is no physics nothing is promised, nor of one that is cut as none was.
            let meant = problem.traction_warning().is_none()
                && (knows_traction || !(domain.thins() && domain.space.varies_lubricant()));
            estimate.traction = estimate.traction.filter(|_| meant);
        }
        solved
    }
}

impl ReducedSolution {
    /// Whether its film is hotter than lubricants endure: of such a one nothing is promised.
    pub fn is_too_hot(&self) -> bool {
        let inlet_k = self.lubricant.heat.map_or(f64::NAN, |heat| heat.inlet_temperature);
        self.heat.as_ref().is_some_and(|heat| heat.hottest_k(inlet_k) > ENDURED_K)
    }
}

impl ReducedModel {
    /// Shares of the modes with which its iterations are tried at once, and where no start led to a solution.
    fn shares_of_modes(&self) -> (&'static [f64], &'static [f64]) {
        match (self.contact(), self.slides()) {
            (ContactKind::Point, false) => (&SHARES, &[]),
            (ContactKind::Point, true) => SHARES.split_at(1),
            _ => all_modes(),
        }
    }
}

/// No fewer than all modes: so are iterations that are shown to a training.
fn all_modes() -> (&'static [f64], &'static [f64]) {
    (SHARES.split_at(1).0, &[])
}

fn operators_of(model: &ReducedModel, window: &Window, options: &ReducedOptions) -> Operators {
    let modes = options.pressure_modes.unwrap_or(usize::MAX);
    let flow = match &model.domain {
        domain if domain.heats() => Flow::Thermal,
        domain if domain.thins() => Flow::Thinning,
        _ => Flow::Newtonian,
    };
    Operators::new(window, modes, options.deformation_modes, flow)
}
