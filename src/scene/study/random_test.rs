//! Random validation at points (3.17): failures, speed, and errors against full solutions.

mod rows;

pub use rows::{Film, Row, Test, Tested, add, errors, tests};

use super::question::{
    Chart, ChartAxis, Checked, Divisible, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::check::{self, MAX_COMPARED, MAX_TESTS, count};
use crate::scene::method::Method;
use crate::scene::names;
use crate::scene::parallel::full_solutions_told;
use crate::scene::random_points::all_random_points;
use crate::scene::statistics::percentile;
use crate::solver::full::{GridCost, Solution, grid_doubts};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::warning::Warning;
use fastrand::Rng;
use rows::{Asperities, COMPARED};
use serde::{Deserialize, Serialize};
use std::sync::{Mutex, PoisonError};

/// Random validation at points (3.17): failure rate and speed of a method, and errors of a reduced model against full
/// solutions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RandomTest {
    /// Range in which the points are drawn.
    pub range: ParameterSpace,
    /// Number of points.
    pub tests: usize,
    /// Seed of the random numbers. The same seed gives the same points.
    pub seed: u64,
    /// Method under test. The full method starts cold.
    pub method: Method,
    /// Number of points that are compared with full solutions on the model's own grid.
    #[serde(default)]
    pub compare: usize,
    /// Number of additional points that are compared, before the others: those where the method failed, then those
    /// without an error bound, then those with the largest error bounds. They point to weaknesses, and are not counted
    /// in error statistics.
    #[serde(default, skip_serializing_if = "is_none")]
    pub worst: usize,
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Constant for deriving the seeds of points from the seed of the test.
const SCRAMBLE: u64 = 0x9E37_79B9_7F4A_7C15;

/// The observer is notified once per this number of solves.
const REPORT_EVERY: usize = 32;

impl RandomTest {
    /// Returns the points, in the order in which they are drawn.
    fn points(&self, setting: &Setting<'_>) -> Result<Vec<OperatingPoint>, RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let mut points = all_random_points(&self.range, experiment.contact, self.tests, self.seed, observer)?;
        if !self.range.slides() {
            points.iter_mut().for_each(|point| point.sliding = experiment.sliding);
        }
        Ok(points)
    }

    /// Returns the lubricant of the k-th point, independent of the other points: the scene's, or one with random
    /// thermal constants from the range.
    fn lubricant(&self, k: usize, own: Lubricant) -> Lubricant {
        self.range.with_random_heat(own, &mut Rng::with_seed(self.seed ^ SCRAMBLE.wrapping_mul(k as u64 + 1)))
    }

    /// Tests some of the points.
    fn test(
        &self,
        points: &[OperatingPoint],
        chosen: &[usize],
        setting: &mut Setting<'_>,
        tell: &Tell<'_, Row>,
    ) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        for (i, k, point) in chosen.iter().enumerate().filter_map(|(i, k)| Some((i, *k, points.get(*k)?))) {
            if i.is_multiple_of(REPORT_EVERY) {
                setting.step("random tests", i, chosen.len())?;
            }
            // Drop starting values, so that the result does not depend on earlier points.
            setting.bench.forget();
            let lubricant = self.lubricant(k, experiment.lubricant);
            let request = Request { lubricant, method: self.method.clone(), ..experiment.request_at(*point) };
            let answer = setting.bench.answer(&request, None, observer)?;
            let result = &answer.result;
            tell(Row::Test(Test {
                point: *point,
                film: answer.fields().map(|solution| Film {
                    h_c: solution.scalars.h_c,
                    h_min: solution.scalars.h_min,
                    traction: result.traction.unwrap_or(f64::NAN),
                    rises: solution.heat.as_ref().map(|heat| heat.central),
                    grid_cost: solution.grid_cost,
                    rough: Asperities::of(solution),
                }),
                newton_iterations: result.newton_iterations,
                wall_s: result.wall_s,
                trained: result.reduced.as_ref().map(|facts| facts.trained),
                warnings: result.warnings.clone(),
                estimate: result.reduced.as_ref().and_then(|facts| facts.error),
            }));
        }
        Ok(())
    }

    /// Returns the tests to compare with full solutions: those most in doubt, and then the others.
    fn compared<'a>(&self, rows: impl IntoIterator<Item = &'a Row>) -> [Vec<usize>; 2] {
        if self.method == Method::Full {
            return Default::default();
        }
        let doubt = |(test, _): Tested| match test.film {
            Some(_) => test.estimate.map_or(f64::MAX, |error| error.h_c.bound),
            None => f64::INFINITY,
        };
        let doubts: Vec<f64> = tests(rows).into_iter().map(doubt).collect();
        let mut worst: Vec<usize> = (0..doubts.len()).collect();
        worst.sort_by(|a, b| doubts[*b].total_cmp(&doubts[*a]));
        worst.truncate(self.worst);
        let rest = (0..self.compare.min(doubts.len())).filter(|i| !worst.contains(i)).collect();
        [worst, rest]
    }

    /// Compares some of the tests with full solutions on the model's grid.
    fn compare(
        &self,
        points: &[OperatingPoint],
        chosen: &[usize],
        setting: &mut Setting<'_>,
        tell: &Tell<'_, Row>,
    ) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let (Some(source), Some(point)) = (self.method.model(), points.first()) else { return Ok(()) };
        let model = setting.bench.model_for(source, point, &experiment.lubricant, observer)?;
        let grid = |point: &OperatingPoint| model.window_at(point).grid.clone();
        let lubricant = |k: usize| self.lubricant(k, experiment.lubricant);
        let compared: Vec<_> = chosen.iter().filter_map(|k| Some((*points.get(*k)?, lubricant(*k)))).collect();
        let truth = |i: usize, full: Option<&Solution>| tell(Row::Truth(chosen[i], full.map(Film::of_full)));
        full_solutions_told(grid, &compared, observer, truth)?;
        Ok(())
    }
}

/// Each piece is one test; in the second round, one comparison with a full solution.
impl Divisible for RandomTest {
    fn pieces(&self, _: &mut Setting<'_>, round: usize, before: &[&Row]) -> Result<Vec<usize>, RunError> {
        Ok(match round {
            0 => (0..self.tests).collect(),
            1 => self.compared(before.iter().copied()).concat(),
            _ => Vec::new(),
        })
    }

    fn work(
        &self,
        setting: &mut Setting<'_>,
        round: usize,
        pieces: &[usize],
        tell: &Tell<'_, Row>,
    ) -> Result<(), RunError> {
        let points = self.points(setting)?;
        match round {
            0 => self.test(&points, pieces, setting, tell),
            _ => self.compare(&points, pieces, setting, tell),
        }
    }

    fn seconds(row: &mut Row) -> Vec<&mut f64> {
        match row {
            Row::Test(test) => vec![&mut test.wall_s],
            Row::Truth(..) => Vec::new(),
        }
    }

    fn methods_mut(&mut self) -> &mut [Method] {
        std::slice::from_mut(&mut self.method)
    }
}

fn own(rows: &[&Row]) -> Vec<Tested> {
    tests(rows.iter().copied())
}

impl Question for RandomTest {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.tests", self.tests, 1, MAX_TESTS)?;
        count("study.compare", self.compare, 0, self.tests.min(MAX_COMPARED))?;
        count("study.worst", self.worst, 0, self.tests.min(MAX_COMPARED))?;
        check::space("study.range", &self.range)
    }

    fn methods(&self) -> &[Method] {
        std::slice::from_ref(&self.method)
    }

    /// Solves are timed one by one.
    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let points = self.points(setting)?;
        let all: Vec<usize> = (0..points.len()).collect();
        let rows = Mutex::new(Vec::with_capacity(points.len()));
        self.test(&points, &all, setting, &|row| {
            rows.lock().unwrap_or_else(PoisonError::into_inner).push(row.clone());
            tell(row);
        })?;
        let rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
        let compared = self.compared(rows.iter());
        compared.iter().try_for_each(|chosen| self.compare(&points, chosen, setting, tell))
    }

    /// Values of the method: `tests`, `failures`, `failure_percent`, Newton steps and times. For a reduced method also
    /// `untrained`, `without_bound` (answers without an error bound, if others have one), `compared`, `full_failures`,
    /// its errors, and the reliability of its error bounds. `grid_error_max` is the largest relative discretisation
    /// error of H_c of a full solution; a warning says where it is too large.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let (of, tests) = (Some(&self.method), own(rows));
        let failures = tests.iter().filter(|(test, _)| test.film.is_none()).count();
        found.converged &= failures == 0;
        found.push("tests", of, tests.len() as f64);
        found.push("failures", of, failures as f64);
        found.push("failure_percent", of, 100.0 * failures as f64 / tests.len() as f64);
        let newton: Vec<f64> = tests.iter().map(|(test, _)| test.newton_iterations as f64).collect();
        let seconds: Vec<f64> = tests.iter().map(|(test, _)| test.wall_s).collect();
        found.push_effort(of, &newton, &seconds);
        let full = tests.iter().flat_map(|(test, truth)| [(test, test.film), (test, truth.flatten())]);
        let judged = full.filter_map(|(test, film)| Some((test.point, film?.grid_cost?)));
        let judged: Vec<(OperatingPoint, GridCost)> = judged.collect();
        if !judged.is_empty() {
            let errors: Vec<f64> = judged.iter().map(|(_, cost)| cost.total()).collect();
            found.push("grid_error_max", None, percentile(&errors, 1.0));
        }
        found.warnings.extend(grid_doubts(judged).into_iter().map(Notice::from));
        let said = tests.iter().map(|(test, _)| test.warnings.iter().filter(|warning| !warning.is_of_grid()).cloned());
        let said: Vec<Vec<Warning>> = said.map(Iterator::collect).collect();
        found.warn_repeated("", Warning::summary(said.iter().map(Vec::as_slice)));
        if self.method == Method::Full {
            return;
        }
        found.push("untrained", of, tests.iter().filter(|(test, _)| test.trained == Some(false)).count() as f64);
        let answers = || tests.iter().filter(|(test, _)| test.film.is_some());
        let without = answers().filter(|(test, _)| test.estimate.is_none()).count();
        if without < answers().count() {
            found.push("without_bound", of, without as f64);
        }
        if self.compare == 0 {
            return;
        }
        let mut errors: [Vec<f64>; 5] = Default::default();
        let mut bounds: [Vec<f64>; 5] = Default::default();
        for tested in tests.iter().take(self.compare) {
            for (k, (error, bound)) in self::errors(tested).into_iter().zip(tested.0.bounds()).enumerate() {
                errors[k].extend(error);
                bounds[k].extend(error.zip(bound).map(|(error, bound)| bound / error));
            }
        }
        found.push("compared", of, errors[0].len() as f64);
        let full_failures = tests.iter().take(self.compare).filter(|(_, truth)| *truth == Some(None)).count();
        found.push("full_failures", of, full_failures as f64);
        let too_hot = |truth: &Option<Option<Film>>| truth.flatten().is_some_and(|full| full.h_c.is_nan());
        let too_hot = tests.iter().take(self.compare).filter(|(_, truth)| too_hot(truth)).count();
        if too_hot > 0 {
            found.push("too_hot", of, too_hot as f64);
            let sentence = "films are hotter than lubricants endure, where no law was measured: they are not compared";
            found.warnings.push(Notice::Sentence(format!("{too_hot} {sentence}")));
        }
        for (k, (errors, bounds)) in errors.iter().zip(&bounds).enumerate() {
            let name = COMPARED[k];
            if errors.is_empty() {
                continue;
            }
            found.push_spread(&format!("{name}_error"), of, errors);
            if !bounds.is_empty() {
                found.push_bounds(names::BOUNDS[k], of, bounds);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        vec![rows::table(&own(rows))]
    }

    /// Draws a map of failures, and errors over their bounds.
    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let tests = own(rows);
        let mut map =
            Chart::new("Random tests", ChartAxis::log("Load number M"), ChartAxis::linear("Lubricant number L"));
        let at = |solved: bool| {
            let of = move |(test, _): &&Tested| test.film.is_some() == solved;
            tests.iter().filter(of).map(|(test, _)| test.point.moes()).map(|moes| [moes.m, moes.l])
        };
        map.add("converged", Marks::Dots, at(true));
        map.add("failed", Marks::Crosses, at(false));
        let axes = |name: &str| (ChartAxis::log("Load number M"), ChartAxis::log(format!("Relative error of {name}")));
        let charts = COMPARED.iter().enumerate().map(|(k, name)| {
            let (x, y) = axes(name);
            let mut chart = Chart::new(format!("Errors of {name}"), x, y);
            let bounds = tests.iter().filter_map(|(test, _)| Some([test.point.moes().m, test.bounds()[k]?]));
            chart.add("bound", Marks::Dots, bounds);
            let errors = tests.iter().filter_map(|tested| Some([tested.0.point.moes().m, self::errors(tested)[k]?]));
            chart.add("true", Marks::Dots, errors);
            chart
        });
        std::iter::once(map).chain(charts).filter(|chart| !chart.series.is_empty()).collect()
    }
}

#[cfg(test)]
mod tests_of_doubts {
    use super::*;
    use crate::scene::{ModelSource, Scene};
    use crate::solver::parameters::ParameterSpace;
    use crate::solver::reduced::{ErrorEstimate, Estimated};

    #[test]
    fn doubtful_contacts_are_sorted_by_severity() {
        let bound = |h_c: f64| {
            let of = |bound: f64| Estimated { likely: bound / 4.0, bound };
            ErrorEstimate { h_c: of(h_c), h_min: of(h_c), state: of(h_c), traction: None, rise: None, load_share: None }
        };
        let film = Film { h_c: 1.0, h_min: 0.9, traction: f64::NAN, rises: None, grid_cost: None, rough: None };
        let test = |film, estimate| {
            let point = OperatingPoint::TABLE_2_1;
            Row::Test(Test {
                point,
                film,
                newton_iterations: 3,
                wall_s: 0.0,
                trained: Some(true),
                warnings: Vec::new(),
                estimate,
            })
        };
        let rows = [
            test(Some(film), Some(bound(1e-3))),
            test(Some(film), None),
            test(Some(film), Some(bound(0.3))),
            test(None, None),
        ];
        let study = RandomTest {
            range: ParameterSpace::table_3_1(),
            tests: 4,
            seed: 1,
            method: Method::Reduced { model: ModelSource::Embedded, pressure_loss: None, deformation_loss: None },
            compare: 2,
            worst: 3,
        };
        assert_eq!(study.compared(rows.iter()), [vec![3, 1, 2], vec![0]]);
        let scene = Scene::from_ron("Scene(version: 1, title: \"t\", study: Point(methods: [Full]))").unwrap();
        let mut found = Findings::default();
        study.findings(&scene.experiment(), &rows.iter().collect::<Vec<_>>(), &mut found);
        let value = |name: &str| found.values.iter().find(|value| value.name == name).map(|value| value.value);
        assert_eq!((value("failures"), value("without_bound")), (Some(1.0), Some(1.0)));
    }
}
