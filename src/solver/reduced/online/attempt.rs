//! One run of the online iteration, from an initial guess or along a path from a known contact.

use super::{ReducedError, ReducedOptions, Starts};
use crate::solver::discrete::heat::Profile;
use crate::solver::full::Problem;
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::{Snapshot, Window};
use crate::solver::reduced::operators::{Case, OnlineOutcome, Operators, RowObserver, RuleTraction, Start, Stop};
use crate::solver::reduced::start::{FilmUnit, Guess};
use crate::solver::reduced::temperature_field::TemperatureField;

/// Converged online iteration.
pub(super) struct Found {
    pub coefficients: Vec<f64>,
    pub h_0: f64,
    pub h_c: f64,
    pub iterations: usize,
    pub residual: f64,
    pub traction: Option<RuleTraction>,
    pub fronts: Vec<usize>,
    pub heat: Option<TemperatureField>,
}

impl Found {
    /// Returns the temperature rise θ at the stations; empty for an isothermal contact.
    pub fn theta(&self) -> &[Profile] {
        self.heat.as_ref().map_or(&[], |heat| &heat.theta)
    }
}

/// Film thickness H above which the iteration ends with the requested tolerance. The remaining error is proportional to
/// the squared step divided by the film thickness, so thinner films need a smaller tolerance. At M = 1000, H is 3e-4.
const THICK: f64 = 0.01;
/// Smallest share of the tolerance; below it rounding dominates.
const LEAST_SHARE: f64 = 0.01;

/// Returns the share of the tolerance for a film of about thickness `h_c`. It is 1 for shear-thinning and thermal
/// contacts and for the dissertation's iteration.
fn share_of_tolerance(problem: &Problem, h_c: f64, options: &ReducedOptions) -> f64 {
    let newtonian = problem.shear.is_none() && problem.heat.is_none();
    // Errors of rough contacts are relative to σ if the film is thinner.
    let film = problem.rough.map_or(h_c, |rough| h_c.max(0.5 * rough.sigma));
    if newtonian && options.starts == Starts::Explorer { (film / THICK).clamp(LEAST_SHARE, 1.0) } else { 1.0 }
}

/// Observers and conditions of an attempt: `rows` receives the sampled equations of every iterate, and `wish` is checked for
/// cancellation before each attempt.
pub(super) struct Watch<'a> {
    pub rows: Option<RowObserver<'a>>,
    pub wish: &'a dyn Observer,
    /// True if the cavitation boundary stays where it is in the initial guess.
    pub holds_front: bool,
}

impl<'a> Watch<'a> {
    /// Creates a watch without an observer of iterates.
    pub fn of(wish: &'a dyn Observer) -> Self {
        Self { rows: None, wish, holds_front: false }
    }

    /// Returns the observer of rows for one iteration.
    fn rows(&mut self) -> Option<RowObserver<'_>> {
        self.rows.as_mut().map(|rows| &mut **rows as RowObserver<'_>)
    }
}

/// Returns the case of a problem for a local model.
pub(super) fn case_of<'a>(window: &Window, problem: &'a Problem, options: &ReducedOptions, stop: Stop) -> Case<'a> {
    // With complementarity the boundary alone determines the cavitated region.
    let penalty = match window.cavitation {
        Cavitation::Penalty => options.penalty.unwrap_or(window.penalty),
        Cavitation::Complementarity | Cavitation::MassConserving { .. } => 0.0,
    };
    let scale = window.grid.scale(problem.moes);
    Case { problem, scale, curvature: 1.0, penalty, prescribed: false, stop }
}

/// Runs Newton's method from an initial guess, within `limit` steps and the options' own limit.
pub(super) fn attempt(
    window: &Window,
    operators: &mut Operators,
    problem: &Problem,
    start: &Guess,
    limit: usize,
    options: &ReducedOptions,
    watch: &mut Watch<'_>,
) -> Result<Found, ReducedError> {
    if watch.wish.cancelled() {
        return Err(ReducedError::Cancelled);
    }
    let mut coefficients = vec![0.0; operators.modes()];
    coefficients.iter_mut().zip(&start.coefficients).for_each(|(c, known)| *c = *known);
    let tolerance = options.tolerance * share_of_tolerance(problem, start.h_c, options);
    let case = case_of(window, problem, options, Stop::new(tolerance, options.max_newton.min(limit)));
    let scale = case.scale;
    let Guess { coefficients: known, fronts, theta, .. } = start;
    operators.begin(&case, &Start { window, modes: known.len(), fronts: Some(fronts), held: watch.holds_front, theta });
    operators.carry_load(problem, scale, &mut coefficients);
    operators.aim(window, scale);
    // H(0) = H₀ − ½ ln s + s δ(0).
    let offset = -0.5 * scale.ln();
    let mut h_0 = start.h_c - (operators.lifted(&coefficients) + offset);
    let outcome = operators.newton(&case, (&mut coefficients, &mut h_0), watch.rows());
    let h_c = h_0 + (operators.lifted(&coefficients) + offset);
    if outcome.converged && (h_c > 0.0 || problem.rough.is_some()) {
        let OnlineOutcome { iterations, residual, .. } = outcome;
        let readings = operators.read(&case, &coefficients, h_0);
        let (traction, heat) = (readings.traction, readings.temperatures.take());
        let fronts = readings.fronts.clone();
        Ok(Found { coefficients, h_0, h_c, iterations, residual, traction, fronts, heat })
    } else {
        Err(ReducedError::NotConverged { iterations: outcome.iterations, step: outcome.step })
    }
}

/// Continues in the logarithms of the SI quantities from a snapshot's point to the target, with steps that shrink on
/// failure. `None` if the steps become too small, or on cancellation.
pub(super) fn walk(
    window: &Window,
    operators: &mut Operators,
    target: &Problem,
    snapshot: &Snapshot,
    options: &ReducedOptions,
    watch: &mut Watch<'_>,
) -> Option<Found> {
    let at = |t: f64| Problem::new(&snapshot.point.towards(&target.point, t), target.lubricant).ok();
    let (mut t, mut stride) = (0.0, 0.25);
    let (coefficients, fronts) = (snapshot.coefficients.clone(), snapshot.fronts.clone());
    let mut guess = Guess { coefficients, h_c: snapshot.h_c, fronts, theta: Vec::new() };
    let mut from_point = snapshot.point;
    let mut iterations = 0;
    while stride > 0.01 {
        let next = f64::min(t + stride, 1.0);
        let problem = if next >= 1.0 { *target } else { at(next)? };
        let h_c = FilmUnit::carried(window, guess.h_c, (&from_point, &problem.point));
        let start = Guess { h_c, ..guess.clone() };
        match attempt(window, operators, &problem, &start, usize::MAX, options, watch) {
            Ok(found) => {
                iterations += found.iterations;
                if next >= 1.0 {
                    return Some(Found { iterations, ..found });
                }
                (t, stride) = (next, 1.5 * stride);
                let theta = found.theta().to_vec();
                guess = Guess { coefficients: found.coefficients, h_c: found.h_c, fronts: found.fronts, theta };
                from_point = problem.point;
            }
            Err(ReducedError::Cancelled) => return None,
            Err(_) => stride *= 0.4,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::{Online, operators_of};
    use super::*;
    use crate::solver::parameters::ParameterSpace;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::Lubricant;
    use crate::solver::reduced::Sampling;
    use crate::solver::reduced::kept::kept_starts;
    use crate::solver::reduced::model::ReducedModel;
    use crate::solver::reduced::start;
    use crate::solver::training::small::{line_grid, oils, trained};
    use crate::solver::training::{Plan, TrainingSpec, random_points, train};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn iterations_towards_thin_films_end_later() {
        let problem = |m, l| {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            Problem::new(&point, Lubricant::default()).unwrap()
        };
        let (options, thin) = (ReducedOptions::default(), problem(1000.0, 1.0));
        let share = |h_c: f64| share_of_tolerance(&thin, h_c, &options);
        assert_eq!([share(0.5), share(0.01), share(1e-9), share(-1.0)], [1.0, 1.0, 0.01, 0.01]);
        assert!((share(3e-4) - 0.03).abs() < 1e-15);
        assert_eq!(share_of_tolerance(&thin, 3e-4, &ReducedOptions::dissertation()), 1.0);
    }

    /// Observer that cancels after a number of checks.
    struct AskedOften(AtomicUsize, usize);

    impl Observer for AskedOften {
        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, Ordering::Relaxed) >= self.1
        }
    }

    #[test]
    fn stopped_solves_do_not_affect_the_next_one() {
        let spec = oils(Sampling::QDeim, 60);
        let model = trained(&spec);
        let online = || Online::new(Arc::clone(&model), ReducedOptions::default());
        // Far outside the trained range: no initial guess and no continuation leads there.
        let far = si_from_moes(&MoesRequest::new(ContactKind::Line, 900.0, 24.0)).unwrap();
        let never = AskedOften(AtomicUsize::new(0), usize::MAX);
        assert!(online().solve_watched(&far, spec.lubricant, &never).is_err());
        let asked = never.0.into_inner();
        assert!(asked > 4, "{asked}");
        let near = random_points(&spec.range, spec.contact(), 1, 5)[0];
        let fresh = online().solve(&near, spec.lubricant).unwrap();
        let mut stopped = online();
        for limit in 0..asked {
            let solved = stopped.solve_watched(&far, spec.lubricant, &AskedOften(AtomicUsize::new(0), limit));
            assert!(matches!(solved, Err(ReducedError::Cancelled)), "{limit} of {asked}: {solved:?}");
        }
        assert_eq!(stopped.solve(&near, spec.lubricant).unwrap().coefficients, fresh.coefficients);
    }

    #[test]
    fn starts_with_fewer_modes_match_smaller_models() {
        let spec = oils(Sampling::QDeim, 60);
        let model = trained(&spec);
        let options = ReducedOptions::default();
        let with = |modes| ReducedOptions { pressure_modes: Some(modes), ..options };
        for point in random_points(&spec.range, spec.contact(), 6, 3) {
            let window = model.window_at(&point);
            let problem = Problem::new(&point, spec.lubricant).unwrap();
            let guess = start::nearest(window, &point).unwrap();
            let mut operators = operators_of(&model, window, &options);
            let mut film = |share: f64| {
                let guess = guess.with_modes(share);
                let found =
                    attempt(window, &mut operators, &problem, &guess, 40, &options, &mut Watch::of(&())).unwrap();
                let used = guess.coefficients.len();
                assert!(found.coefficients.len() == window.pressure.count());
                assert!(found.coefficients[used..].iter().all(|c| *c == 0.0));
                (used, found.h_c)
            };
            let (all, (modes, fewer), again) = (film(1.0), film(0.75), film(1.0));
            assert!(all.1 == again.1 && all.1 != fewer, "what one attempt leaves out the next one has");
            let options = with(modes);
            let mut operators = operators_of(&model, window, &options);
            let small = attempt(window, &mut operators, &problem, &guess, 40, &options, &mut Watch::of(&())).unwrap();
            assert!((fewer / small.h_c - 1.0).abs() < 1e-8, "{fewer} {}", small.h_c);
        }
    }

    #[test]
    fn heavy_lines_start_near_stored_solutions() {
        // The most heavily loaded corner of Table 3.1, α p_H up to 44.
        let corner = [(3e-3, 4e-3), (6.0, 10.0), (3e5, 5e5), (1.4e-8, 2e-8)];
        let corner = ParameterSpace::si_box(corner, 231e9, 0.01);
        let plan = Plan::Grid { nodes: [2, 3, 3, 3] };
        let spec = TrainingSpec::new(corner, (1.0, 500.0), line_grid(400), plan);
        let spec = TrainingSpec { pressure_loss: 1e-8, sampling: Sampling::All, evidence: 0, ..spec };
        let kept = train(&spec, &()).unwrap();
        let mut coarse = kept.clone();
        for window in &mut coarse.windows {
            let (_, starts) = kept_starts(&window.snapshots, window.pressure.count(), 1e-3);
            for (snapshot, start) in window.snapshots.iter_mut().zip(starts.row_iter()) {
                snapshot.coefficients = start.iter().copied().collect();
            }
        }
        let steps = |model: &ReducedModel| -> Vec<Option<usize>> {
            let mut online = Online::new(Arc::new(model.clone()), ReducedOptions::dissertation());
            let contacts = kept.windows.iter().flat_map(|window| &window.snapshots);
            contacts.map(|known| Some(online.solve(&known.point, spec.lubricant).ok()?.iterations)).collect()
        };
        let (fine, rough) = (steps(&kept), steps(&coarse));
        assert!(fine.iter().all(|steps| steps.is_some_and(|steps| steps <= 3)), "{fine:?}");
        assert!(rough.iter().any(|steps| steps.is_none_or(|steps| steps > 6)), "{rough:?}");
    }
}
