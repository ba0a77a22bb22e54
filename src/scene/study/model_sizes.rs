//! Model-size study: dependence of a reduced model's error and time on its numbers of pressure modes and sampled
//! equations.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::host::clock::Stopwatch;
use crate::scene::Scene;
use crate::scene::check::{MAX_COMPARED, count, number};
use crate::scene::method::ModelSource;
use crate::scene::parallel::full_solutions;
use crate::scene::statistics::{median, percentile};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Window};
use crate::solver::training::{Plan, TrainingObserver, TrainingSpec, random_points, with_rows};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Error and time of a reduced model with fewer modes, and with other numbers of sampled equations, at random contacts
/// of the local model that covers the scene's contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelSizes {
    /// Reduced model. A model with sliding must contain its training scene.
    #[serde(default)]
    pub model: ModelSource,
    /// Number of random contacts (3.17) in the local model, all compared with full solutions on its grid.
    pub contacts: usize,
    /// Seed of the contacts and of the sampled equations.
    pub seed: u64,
    /// Number of different mode counts, from a few modes to all.
    pub modes: usize,
    /// Numbers of sampled equations per mode, with all modes.
    pub rows_per_mode: Vec<f64>,
}

/// Smallest number of modes.
const FEWEST_MODES: usize = 6;
/// Number of solves per contact. The fastest counts, since other load on the machine only adds time.
const REPEATED: usize = 3;

/// Varied size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Varied {
    /// Pressure modes, with the model's own sampled equations.
    Modes,
    /// Sampled equations, with all modes.
    Rows,
}

impl Varied {
    fn name(self) -> &'static str {
        match self {
            Self::Modes => "modes",
            Self::Rows => "rows",
        }
    }
}

/// Result for one size.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Row {
    /// Which size was varied.
    pub varied: Varied,
    /// Number of pressure modes.
    pub modes: usize,
    /// Number of sampled equations.
    pub rows: usize,
    /// Number of contacts that failed.
    pub failures: usize,
    /// Relative errors of H_c at the other contacts.
    pub errors: Vec<f64>,
    /// Times of single solves \[s\].
    pub seconds: Vec<f64>,
    /// Model with these sampled equations, if they were varied.
    pub model: Option<Arc<ReducedModel>>,
}

impl Row {
    /// Returns the varied number.
    pub fn size(&self) -> usize {
        match self.varied {
            Varied::Modes => self.modes,
            Varied::Rows => self.rows,
        }
    }

    /// Returns median and largest error of H_c, and median time of a solve \[s\].
    pub fn summary(&self) -> [f64; 3] {
        [median(&self.errors), percentile(&self.errors, 1.0), median(&self.seconds)]
    }
}

/// Contacts and full solutions that all sizes are compared with.
struct Truth<'a> {
    points: &'a [OperatingPoint],
    full: Vec<Option<Solution>>,
    lubricant: Lubricant,
}

impl Truth<'_> {
    /// Solves all contacts one after the other. Returns failures, errors of H_c and times.
    fn measure(
        &self,
        model: &Arc<ReducedModel>,
        modes: Option<usize>,
        observer: &dyn TrainingObserver,
    ) -> Result<(usize, Vec<f64>, Vec<f64>), RunError> {
        let mut online = Online::new(Arc::clone(model), ReducedOptions { pressure_modes: modes, ..Default::default() });
        let (mut failures, mut errors, mut seconds) = (0, Vec::new(), Vec::new());
        for (point, full) in self.points.iter().zip(&self.full) {
            online.prepare(point);
            let mut quickest = f64::INFINITY;
            let mut film = None;
            for _ in 0..REPEATED {
                if observer.cancelled() {
                    return Err(RunError::Cancelled);
                }
                online.forget();
                let clock = Stopwatch::start();
                let solved = online.solve(point, self.lubricant);
                quickest = quickest.min(clock.seconds());
                match solved {
                    Ok(solved) => film = Some(online.reconstruct(&solved)?.scalars.h_c),
                    Err(error) if error.without_solution().is_some() => break,
                    Err(refused) => return Err(refused.into()),
                }
            }
            let Some(h_c) = film else {
                failures += 1;
                continue;
            };
            seconds.push(quickest);
            errors.extend(full.as_ref().map(|full| (h_c / full.scalars.h_c - 1.0).abs()));
        }
        Ok((failures, errors, seconds))
    }
}

/// Returns numbers from `least` to `most` with approximately constant ratio.
fn ladder(least: usize, most: usize, steps: usize) -> Vec<usize> {
    let least = least.min(most);
    let ratio = (most as f64 / least as f64).max(1.0);
    let at = |k: usize| (least as f64 * ratio.powf(k as f64 / (steps - 1) as f64)).round() as usize;
    let mut all: Vec<usize> = (0..steps).map(at).collect();
    all.dedup();
    all
}

/// Returns the training of a model: from its own scene, or otherwise reconstructed from one of its local models.
fn training(model: &ReducedModel, window: &Window) -> Result<TrainingSpec, RunError> {
    match Scene::from_ron(&model.scene).ok().and_then(|scene| scene.training()) {
        Some(spec) => Ok(spec),
        None if !model.domain.is_shear_thinning() => {
            let (range, plan) = (model.domain.space.clone(), Plan::FarthestPoint { snapshots: window.snapshots.len() });
            Ok(TrainingSpec {
                lubricant: model.domain.lubricant,
                sampling: window.sampling,
                scheme: window.scheme,
                penalty: window.penalty,
                ..TrainingSpec::new(range, window.m, window.grid.spec(), plan)
            })
        }
        None => Err(RunError::Study("the reduced model does not state the sliding that it was trained for".to_owned())),
    }
}

impl Question for ModelSizes {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.contacts", self.contacts, 1, MAX_COMPARED)?;
        count("study.modes", self.modes, 2, 64)?;
        count("study.rows_per_mode (how many)", self.rows_per_mode.len(), 0, 32)?;
        self.rows_per_mode.iter().try_for_each(|&rows| number("study.rows_per_mode", rows, 1.0, 20.0))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let point = experiment.request()?.point;
        let model = setting.bench.model_for(&self.model, &point, &experiment.lubricant, observer)?;
        let k = model.window_for(&point);
        let window = &model.windows[k];
        let spec = training(&model, window)?;
        // Drawn from the whole range, as many as needed to find enough points in the local model.
        let all = random_points(&spec.range, experiment.contact, 100 * self.contacts, self.seed);
        let inside = all.into_iter().filter(|point| model.window_for(point) == k);
        let points: Vec<OperatingPoint> = inside.take(self.contacts).collect();
        let lubricant = experiment.lubricant;
        let full = full_solutions(|_| window.grid.clone(), &points, lubricant, observer)?;
        let truth = Truth { points: &points, full, lubricant };
        let own = (window.pressure.count(), window.sampled_rows.len());
        let sizes = ladder(FEWEST_MODES, own.0, self.modes);
        let total = sizes.len() + self.rows_per_mode.len();
        for (i, modes) in sizes.into_iter().enumerate() {
            setting.step("numbers of modes", i, total)?;
            let (failures, errors, seconds) = truth.measure(&model, Some(modes), observer)?;
            tell(Row { varied: Varied::Modes, modes, rows: own.1, failures, errors, seconds, model: None });
        }
        setting.step("sampling of equations", total - self.rows_per_mode.len(), total)?;
        let sampled = with_rows(&spec, &model, k, &self.rows_per_mode, observer)?;
        for (i, sampled) in sampled.into_iter().flatten().enumerate() {
            setting.step("numbers of sampled equations", total - self.rows_per_mode.len() + i, total)?;
            let sampled = Arc::new(sampled);
            let rows = sampled.windows[k].sampled_rows.len();
            let (failures, errors, seconds) = truth.measure(&sampled, None, observer)?;
            tell(Row { varied: Varied::Rows, modes: own.0, rows, failures, errors, seconds, model: Some(sampled) });
        }
        Ok(())
    }

    /// Values, for every size: `modes[24].failures`, `modes[24].H_c_error_median`, `…_max` and `modes[24].median_s`,
    /// and the same for `rows[…]`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            let name = |what: &str| format!("{}[{}].{what}", row.varied.name(), row.size());
            let [middle, largest, seconds] = row.summary();
            found.push(name("failures"), None, row.failures as f64);
            found.push(name("H_c_error_median"), None, middle);
            found.push(name("H_c_error_max"), None, largest);
            found.push(name("median_s"), None, seconds);
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let columns = ["modes", "rows", "failures", "H_c_error_median", "H_c_error_max", "median_s"];
        let of = |varied: Varied| {
            let mut table = Table::new(varied.name(), &columns);
            let row = |row: &&&Row| {
                let [middle, largest, seconds] = row.summary();
                vec![row.modes as f64, row.rows as f64, row.failures as f64, middle, largest, seconds]
            };
            table.rows.extend(rows.iter().filter(|row| row.varied == varied).map(|r| row(&r)));
            table
        };
        [Varied::Modes, Varied::Rows].map(of).into()
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let of = |varied: Varied| rows.iter().filter(move |row| row.varied == varied);
        let chart = |(varied, x): (Varied, &str)| {
            let error = ChartAxis::log("Relative error of H_c");
            let mut errors = Chart::new(format!("Error against {}", varied.name()), ChartAxis::linear(x), error);
            let at = |row: &Row, k: usize| [row.size() as f64, row.summary()[k]];
            errors.add("median", Marks::Line, of(varied).map(|row| at(row, 0)));
            errors.add("largest", Marks::Dots, of(varied).map(|row| at(row, 1)));
            let axis = ChartAxis::linear("Median time of a solve [ms]");
            let mut times = Chart::new(format!("Time against {}", varied.name()), ChartAxis::linear(x), axis);
            times.add("median", Marks::Line, of(varied).map(|row| [row.size() as f64, 1e3 * row.summary()[2]]));
            [errors, times]
        };
        [(Varied::Modes, "Pressure modes"), (Varied::Rows, "Sampled equations")].into_iter().flat_map(chart).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ladder_increases_from_least_to_most() {
        assert_eq!(ladder(6, 86, 2), [6, 86]);
        let all = ladder(6, 86, 9);
        assert!(all.len() == 9 && all[0] == 6 && all[8] == 86 && all.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(ladder(6, 4, 3), [4]);
    }
}
