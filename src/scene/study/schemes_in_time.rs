//! Comparison of reduction schemes for a transient contact, with the same full marches, bases and test loads.

use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use super::transient::{Drive, Timed, coverage, timed_march};
use crate::scene::check::{self, count, number, refuse};
use crate::scene::statistics::median;
use crate::solver::discrete::grid::ReferenceGrid;
use crate::solver::full::transient::{Frame, FullMarch, Keep, Quantity, Trajectory, Transient};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::ReducedMarch;
use crate::solver::reduced::{Sampling, Scheme};
use crate::solver::training::{TrajectoryTraining, train_trajectories};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Schemes, methods of sampling equations, and cavitation models of transient reduced models that are trained with the
/// same loads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SchemesInTime {
    /// Inputs for training.
    pub trainings: Vec<Drive>,
    /// Inputs for testing, by name.
    pub tests: Vec<Drive>,
    /// Time step.
    pub time_step: f64,
    /// Frame of reference.
    #[serde(default)]
    pub frame: Frame,
    /// Loss of information of the bases, (2.90).
    pub loss: f64,
    /// Schemes to compare.
    pub schemes: Vec<ComparedScheme>,
}

/// Scheme to compare.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedScheme {
    /// Name in results.
    pub name: String,
    /// Scheme of the online solver.
    #[serde(default)]
    pub scheme: Scheme,
    /// Sampling method.
    pub sampling: Sampling,
    /// Number of sampled equations per pressure mode.
    pub rows_per_mode: f64,
    /// Cavitation model, also of the full marches, if it differs from the scene's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cavitation: Option<Cavitation>,
}

/// Result of one scheme for one load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the scheme.
    pub scheme: String,
    /// Name of the load.
    pub test: String,
    /// Numbers of pressure modes and of sampled equations.
    pub size: [usize; 2],
    /// True if the march reached the end time.
    pub finished: bool,
    /// Last time T that was reached.
    pub reached: f64,
    /// Relative L2 and largest difference of H_c, and relative L2 difference of H_min, from the full march with the
    /// same cavitation model, up to the time reached.
    pub differences: [f64; 3],
    /// Newton steps per time step.
    pub newton_per_step: f64,
    /// Number of rejected time steps.
    pub rejected: usize,
    /// Time per step \[s\].
    pub step_s: f64,
}

const COLUMNS: [Column<Row>; 10] = [
    ("modes", |row| row.size[0] as f64),
    ("rows", |row| row.size[1] as f64),
    ("failed", |row| f64::from(!row.finished)),
    ("reached", |row| row.reached),
    ("H_c.difference_l2", |row| row.differences[0]),
    ("H_c.difference", |row| row.differences[1]),
    ("H_min.difference_l2", |row| row.differences[2]),
    ("newton_per_step", |row| row.newton_per_step),
    ("rejected_steps", |row| row.rejected as f64),
    ("step_s_median", |row| row.step_s),
];

/// Full marches with one cavitation model.
struct Full {
    lubricant: Lubricant,
    trainings: Vec<Trajectory>,
    tests: Vec<Trajectory>,
}

impl Row {
    fn new(scheme: &str, test: &str, size: [usize; 2], timed: &Timed, full: &Trajectory) -> Self {
        let Timed { trajectory, seconds } = timed;
        let steps = trajectory.moments.get(1..).unwrap_or(&[]);
        let newton: usize = steps.iter().map(|moment| moment.effort.newton_iterations).sum();
        let all = (0.0, f64::INFINITY);
        let of = |quantity| trajectory.difference(full, quantity, all).unwrap_or((f64::NAN, f64::NAN));
        let (film, thinnest) = (of(Quantity::CentralFilm), of(Quantity::MinimumFilm));
        Self {
            scheme: scheme.to_owned(),
            test: test.to_owned(),
            size,
            finished: trajectory.finished(),
            reached: trajectory.moments.last().map_or(0.0, |moment| moment.time),
            differences: [film.1, film.0, thinnest.1],
            newton_per_step: newton as f64 / steps.len() as f64,
            rejected: trajectory.rejected_steps,
            step_s: median(seconds),
        }
    }
}

impl SchemesInTime {
    /// Returns the march for a load, with or without stored fields.
    fn march(&self, drive: &Drive, request: (Transient, Keep)) -> Transient {
        let (transient, keep) = request;
        Transient { inputs: drive.inputs.clone(), duration: drive.duration, frame: self.frame, keep, ..transient }
    }

    /// Computes the full marches with a cavitation model.
    fn full(&self, own: &Transient, grid: &Arc<ReferenceGrid>, setting: &Setting<'_>) -> Result<Full, RunError> {
        let all = |drives: &[Drive], keep: Keep| {
            let march = |drive: &Drive| {
                let transient = self.march(drive, (own.clone(), keep));
                let mut model = FullMarch::new(Arc::clone(grid), &transient)?;
                let stage = format!("Full march by {}", own.lubricant.cavitation.name());
                Ok(timed_march(&mut model, &transient, stage, setting.observer, None)?.trajectory)
            };
            drives.iter().map(march).collect::<Result<Vec<_>, RunError>>()
        };
        let (trainings, tests) = (all(&self.trainings, Keep::Every(1))?, all(&self.tests, Keep::Scalars)?);
        if let Some(cut) = trainings.iter().chain(&tests).find(|trajectory| !trajectory.finished()) {
            return Err(RunError::Study(format!("a full march {}", cut.ended.describe())));
        }
        Ok(Full { lubricant: own.lubricant, trainings, tests })
    }
}

impl Question for SchemesInTime {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        coverage::check(experiment)?;
        count("study.trainings (how many)", self.trainings.len(), 1, 16)?;
        count("study.tests (how many)", self.tests.len(), 1, 16)?;
        count("study.schemes (how many)", self.schemes.len(), 1, 32)?;
        number("study.loss", self.loss, 1e-12, 0.5)?;
        check::names("study.schemes.name", self.schemes.iter().map(|way| way.name.as_str()))?;
        check::names("study.tests.name", self.tests.iter().map(|test| test.name.as_str()))?;
        for way in &self.schemes {
            number("study.schemes.rows_per_mode", way.rows_per_mode, 1.0, 20.0)?;
            let law = way.cavitation.unwrap_or(experiment.lubricant.cavitation);
            if let Cavitation::MassConserving { .. } = law {
                let limit = "is mass-conserving, but reduced models support the penalty or complementarity only";
                return Err(refuse("study.schemes.cavitation", limit));
            }
        }
        let point = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        for drive in self.trainings.iter().chain(&self.tests) {
            let own = Transient::new(point, drive.inputs.clone(), drive.duration, self.time_step);
            own.check().map_err(|problem| refuse("study", format!("is refused: {problem}")))?;
        }
        Ok(())
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let request = experiment.request()?;
        let grid = setting.bench.grid(&request, observer)?;
        let line =
            grid.line().ok_or_else(|| RunError::Study("transient studies support line contacts only".to_owned()))?;
        let mut known: Vec<Full> = Vec::new();
        for (number, way) in self.schemes.iter().enumerate() {
            setting.step("schemes", number, self.schemes.len())?;
            let cavitation = way.cavitation.unwrap_or(request.lubricant.cavitation);
            let lubricant = Lubricant { cavitation, ..request.lubricant };
            let own = Transient::new(request.point, Default::default(), 1.0, self.time_step);
            let own = Transient { lubricant, ..own };
            if known.iter().all(|full| full.lubricant != lubricant) {
                known.push(self.full(&own, line, setting)?);
            }
            let Some(full) = known.iter().find(|full| full.lubricant == lubricant) else { continue };
            let ComparedScheme { scheme, sampling, rows_per_mode, .. } = *way;
            let training =
                TrajectoryTraining { loss: self.loss, rows_per_mode, seed: 1, scheme, sampling, local: None };
            let model = Arc::new(train_trajectories(line, &full.trainings, &training, observer)?);
            let size = [model.window.pressure.count(), model.window.sampled_rows.len()];
            for (drive, full) in self.tests.iter().zip(&full.tests) {
                let transient = self.march(drive, (own.clone(), Keep::Scalars));
                let mut march = ReducedMarch::new(&model, &transient)?;
                let timed = timed_march(&mut march, &transient, way.name.clone(), observer, None)?;
                tell(Row::new(&way.name, &drive.name, size, &timed, full));
            }
        }
        Ok(())
    }

    /// Values are named by scheme and load, as in `lspg.triangle.H_c.difference_l2`: `modes`, `rows`, `failed`,
    /// `reached`, differences, `newton_per_step`, `rejected_steps`, `step_s_median`. For each scheme also `failures`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            for (what, value) in COLUMNS {
                found.push(format!("{}.{}.{what}", row.scheme, row.test), None, value(row));
            }
            found.converged &= row.finished;
        }
        for way in &self.schemes {
            let failures = rows.iter().filter(|row| row.scheme == way.name && !row.finished).count();
            found.push(format!("{}.failures", way.name), None, failures as f64);
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let of = |test: &Drive| {
            let own: Vec<&Row> = rows.iter().filter(|row| row.test == test.name).copied().collect();
            Table::of(format!("schemes_{}", test.name), &COLUMNS, own)
        };
        self.tests.iter().map(of).collect()
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let y = ChartAxis::log("Relative L2 difference of H_c");
        let mut chart = Chart::new("Time per step and difference of H_c", ChartAxis::log("Seconds per step"), y);
        for way in &self.schemes {
            let own = rows.iter().filter(|row| row.scheme == way.name && row.finished);
            chart.add(way.name.as_str(), Marks::Dots, own.map(|row| [row.step_s, row.differences[0]]));
        }
        vec![chart]
    }
}
