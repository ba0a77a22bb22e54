//! Information-loss study: number of modes needed by the pressures of a transient contact in each frame (Fig. 4.5).

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use super::transient::coverage;
use crate::scene::check::{count, number, refuse};
use crate::scene::method::Method;
use crate::solver::full::transient::{Frame, Inputs, Keep, MarchProgress, Transient, solve};
use crate::solver::reduced::PodBasis;
use faer::Mat;
use serde::{Deserialize, Serialize};

/// Loss of information (2.92) over the number of pressure modes, for the states of a transient contact in each frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InformationLoss {
    /// Time-dependent inputs.
    pub inputs: Inputs,
    /// End time T.
    pub duration: f64,
    /// Time step.
    pub time_step: f64,
    /// Every n-th step is a snapshot.
    pub every: usize,
    /// Frames of reference.
    pub frames: Vec<Frame>,
}

/// Largest number of snapshots of one frame.
const MOST_SNAPSHOTS: usize = 4000;
/// Smaller losses are rounding errors.
const LEAST_LOSS: f64 = 1e-12;

/// Result in one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The frame.
    pub frame: Frame,
    /// Number of snapshots.
    pub snapshots: usize,
    /// Numbers of modes with their losses of information.
    pub losses: Vec<[f64; 2]>,
}

impl Row {
    /// Returns the loss with this number of modes.
    fn at(&self, modes: usize) -> f64 {
        self.losses.iter().find(|[k, _]| *k == modes as f64).map_or(0.0, |[_, loss]| *loss)
    }
}

impl Question for InformationLoss {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        coverage::check(experiment)?;
        count("study.frames (how many)", self.frames.len(), 1, 4)?;
        number("study.duration", self.duration, 1e-3, 1e4)?;
        number("study.time_step", self.time_step, 1e-6, self.duration)?;
        count("study.every", self.every, 1, 1_000_000)?;
        let snapshots = self.duration / self.time_step / self.every as f64;
        number("study.duration over study.time_step and study.every", snapshots, 4.0, MOST_SNAPSHOTS as f64)?;
        self.inputs.check(self.duration).map_err(|problem| refuse("study.inputs", format!("make no sense: {problem}")))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let request = experiment.request()?;
        let grid = setting.bench.grid(&request, observer)?;
        let line =
            grid.line().ok_or_else(|| RunError::Study("transient studies support line contacts only".to_owned()))?;
        for (i, &frame) in self.frames.iter().enumerate() {
            setting.step("frames", i, self.frames.len())?;
            let transient = Transient {
                lubricant: request.lubricant,
                frame,
                keep: Keep::Every(self.every),
                ..Transient::new(request.point, self.inputs.clone(), self.duration, self.time_step)
            };
            let stage = format!("frame {} of {}", i + 1, self.frames.len());
            let progress = MarchProgress { observer, stage, duration: self.duration };
            let trajectory = solve(line.spec, &transient, &progress)?;
            if observer.cancelled() {
                return Err(RunError::Cancelled);
            }
            let states = &trajectory.states;
            let snapshots = Mat::from_fn(trajectory.x.len(), states.len(), |i, j| states[j].pressure[i]);
            let own = line.for_contact(trajectory.problem.moes);
            let basis = PodBasis::new(snapshots.as_ref(), &own.weights, 0.0);
            let loss = |basis: PodBasis| {
                let all = (0..=basis.singular_values.len()).map(|k| [k as f64, basis.loss(k)]);
                all.take_while(|[_, loss]| *loss > LEAST_LOSS).collect()
            };
            let losses = if trajectory.finished() { basis.map(loss).unwrap_or_default() } else { Vec::new() };
            tell(Row { frame, snapshots: states.len(), losses });
        }
        Ok(())
    }

    /// Values of each frame, by its name: `.snapshots`, and the losses with 10, 20 and 40 modes `.loss_10`, `.loss_20`,
    /// `.loss_40`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            let name = row.frame.name();
            found.converged &= !row.losses.is_empty();
            found.push(format!("{name}.snapshots"), Some(&Method::Full), row.snapshots as f64);
            for modes in [10, 20, 40] {
                found.push(format!("{name}.loss_{modes}"), Some(&Method::Full), row.at(modes));
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let table = |row: &&Row| {
            let mut table = Table::new(format!("loss_{}", row.frame.name()), &["modes", "loss"]);
            table.rows.extend(row.losses.iter().map(|pair| pair.to_vec()));
            table
        };
        rows.iter().map(table).collect()
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut chart = Chart::new(
            "Loss of information in pressure",
            ChartAxis::linear("Pressure modes"),
            ChartAxis::log("Loss of information (2.92)"),
        );
        for row in rows {
            chart.add(row.frame.name(), Marks::Line, row.losses.iter().copied());
        }
        vec![chart]
    }
}
