//! Transient study: the full solver and models in every frame and along every input, with cost and differences.

mod costs;
pub(super) mod coverage;
mod data;
mod march;
mod marches;
mod models;
mod published;
mod surfaces;
mod timed_march;
mod train;

pub use coverage::check_request;
pub use data::{Drive, LinearisedTransient, ReducedTransient, TransientStudy};
pub use march::{By, March, MarchedBy, series};
pub use models::{Kind, Model};
pub use published::PublishedMarch;
pub use surfaces::{SurfaceFeature, SurfaceShape};
pub(crate) use surfaces::{check as check_surfaces, read_profile};
pub(crate) use timed_march::{Listener, Timed, timed_march};

use super::{StudyObserver, StudyRow};
use crate::scene::bench::Bench;
use crate::scene::sampled;
use crate::scene::study::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::solver::discrete::grid::{ContactGrid, ReferenceGrid};
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::transient::{Frame, FullMarch, Keep, Marching, Moment, State, Trajectory, Transient};
use crate::solver::reduced::transient::TrajectoryModel;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::Arc;

/// Row of a transient study.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Row {
    /// Start of a march.
    Begun {
        /// Prefix of its values.
        march: Arc<str>,
        /// Solution method.
        by: MarchedBy,
        /// The march, without moments yet.
        trajectory: Box<Trajectory>,
    },
    /// Moment of the march that started last.
    Moment {
        /// Name of the march.
        march: Arc<str>,
        /// The moment.
        moment: Moment,
        /// Time of the step before it \[s\]; 0 at the start.
        seconds: f64,
    },
    /// Fields of the last reported moment, for some moments and if requested.
    State {
        /// Name of the march.
        march: Arc<str>,
        /// The fields.
        state: Arc<State>,
    },
    /// Completed march.
    Marched(Arc<March>),
    /// Completed training marches for the models of a frame.
    Trained {
        /// The frame.
        frame: Frame,
        /// Total time \[s\].
        wall_s: f64,
        /// Their moments.
        moments: Vec<Vec<Moment>>,
        /// Warnings about marches that ended early.
        cut_short: Vec<Notice>,
    },
    /// Trained model.
    Model(Model),
}

/// Common data of all marches of a study.
struct Runner<'a, 'b> {
    study: &'a TransientStudy,
    grid: ContactGrid,
    /// Saved reduced model, if the study does not train one.
    saved: Option<Arc<TrajectoryModel>>,
    setting: &'a Setting<'b>,
    tell: &'a Tell<'a, Row>,
}

fn marches<'a>(rows: &[&'a Row]) -> Vec<&'a March> {
    only!(rows, Row::Marched).into_iter().map(Arc::as_ref).collect()
}

impl Question for TransientStudy {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        self.check_with(experiment)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let mut study = self.clone();
        let request = setting.experiment.request()?;
        if let Some(path) = &study.sampled {
            sampled::read_into(&mut study.inputs, &setting.bench.resolve(path), &request.point.into())?;
        }
        let grid = setting.bench.grid(&request, setting.observer)?;
        let saved = study.saved_model(setting)?;
        let profile = |path: &Path| surfaces::read_profile(&setting.bench.resolve(path));
        let moving = study.surfaces.iter().map(|surface| surface.moving(&request.point, profile));
        let moving = moving.collect::<Result<Vec<_>, _>>()?;
        let runner = Runner { study: &study, grid, saved, setting, tell };
        let drives = study.drives();
        for &frame in &study.frames {
            let mut models = Vec::new();
            for (k, drive) in drives.iter().enumerate() {
                let transient = if k == 0 {
                    study.own_march(request.point, request.lubricant, frame)
                } else {
                    study.march(drive, request.point, request.lubricant, frame)
                };
                let transient = Transient { surfaces: moving.clone(), ..transient };
                let (full, states) = runner.full(drive, transient)?;
                tell(Row::Marched(Arc::clone(&full)));
                if k == 0 {
                    models = runner.models(Trajectory { states, ..full.trajectory.clone() })?;
                }
                for model in &models {
                    runner.compared(model, drive, (&full.name, &full.trajectory.transient))?;
                }
            }
        }
        Ok(())
    }

    /// Values of a full march are prefixed by the name of its frame (`fixed`, `ale`, `remeshed`, `remeshed_linear`):
    ///
    /// - `H_c.start`, `H_c.mean`, `H_c.amplitude`, `H_c.offset` (mean over start, minus 1), `H_c.min`, `H_c.max` within
    ///   the interval for statistics, and the same for H_min, P_c, P_max;
    /// - the same for `load`, if the separation is prescribed;
    /// - `steps`, `rejected_steps`, `newton_per_step`, `krylov_per_step`, `step_s_median`, `step_s_p99`, `march_s`;
    /// - `mass_defect` if positions are given;
    /// - `grid_error`, the discretisation error of H_c relative to H_c, the largest among steady contacts under the
    ///   inputs of the start, of the thinnest and of the thickest film. Beyond a few per cent, a warning is given;
    /// - `step_error` (also for models), the estimated largest relative error of H_c due to the time step;
    /// - from the second frame on, `H_c.difference` (largest, relative) and `H_c.difference_l2` from the first frame
    ///   within the interval, and so on.
    ///
    /// Values of a reduced model are prefixed by `fixed.rnsa`, those of a linearised model by `fixed.tpwl`. With
    /// several rules, the prefix is `fixed.tpwl.step_0.001` and the like; its marches are further prefixed by
    /// `dual_taylor` or `dissertation`. The values are size, differences from the full march, cost, and `speed_up`
    /// (ratio of the medians of the steps). For a reduced model, `trained` is 1 if the march stayed inside the trained
    /// range and 0 otherwise. For a linearised model, `reach_median` and `reach_max` are distances of steps from the
    /// trained trajectories, in distances between operating points. `training_s` is the time of the full training
    /// marches \[s\], if they are not the study's own march; for a circular contact that of the basis.
    ///
    /// Values of marches along further inputs are prefixed by the name of the inputs, as in
    /// `triangle.fixed.rnsa.H_c.difference_l2`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let (marches, models) = (marches(rows), only!(rows, Row::Model));
        for row in rows {
            match row {
                Row::Marched(march) => march.findings(self, &marches, found),
                Row::Model(model) => model.findings(&models, found),
                Row::Trained { frame, wall_s, cut_short, .. } => {
                    found.converged &= cut_short.is_empty();
                    found.warnings.extend(cut_short.iter().cloned());
                    found.push(format!("{}.training_s", frame.name()), None, *wall_s);
                }
                Row::Begun { .. } | Row::Moment { .. } | Row::State { .. } => {}
            }
        }
    }

    /// Returns the time series of each march, losses of information, operating points, and the cost of all marches if
    /// there are models.
    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let table = |row: &&Row| match row {
            Row::Marched(march) => Some(march.series()),
            Row::Model(model) => Some(model.table()),
            _ => None,
        };
        let mut tables: Vec<Table> = rows.iter().filter_map(table).collect();
        if self.reduced.is_some() || self.linearised.is_some() {
            tables.push(costs::table(self, &marches(rows), &only!(rows, Row::Model)));
        }
        tables
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let quantities: [Column<Moment>; 4] = [
            ("Central film thickness H_c", |moment| moment.h_c),
            ("Minimum film thickness H_min", |moment| moment.h_min),
            ("Central pressure P_c", |moment| moment.p_c),
            ("Maximum pressure P_max", |moment| moment.p_max),
        ];
        let moment = |row: &&Row| match *row {
            Row::Moment { march, moment, .. } => Some((Arc::clone(march), *moment)),
            _ => None,
        };
        let moments: Vec<(Arc<str>, Moment)> = rows.iter().filter_map(moment).collect();
        let chart = |(title, get): Column<Moment>| {
            let mut chart = Chart::new(title, ChartAxis::linear("T = t u_ref/a_ref"), ChartAxis::linear(title));
            for march in moments.chunk_by(|a, b| a.0 == b.0) {
                chart.add(march[0].0.as_ref(), Marks::Line, march.iter().map(|(_, moment)| [moment.time, get(moment)]));
            }
            chart
        };
        quantities.map(chart).into()
    }
}

impl TransientStudy {
    /// Marches existing models along the study's own inputs, without the full solver. Includes the embedded model if
    /// the study refers to it. The rows are the same as those of the study.
    ///
    /// # Errors
    /// If the study or a model is refused, or if the observer cancels. A linearised model that does not support the
    /// reference contact is skipped.
    pub fn replay(
        &self,
        models: &[Model],
        experiment: &Experiment,
        bench: &mut dyn Bench,
        observer: &dyn StudyObserver,
    ) -> Result<(), RunError> {
        let tell = |row| observer.row(StudyRow::Transient(row));
        let request = experiment.request()?;
        let mut study = self.clone();
        if let Some(path) = &study.sampled {
            sampled::read_into(&mut study.inputs, &bench.resolve(path), &request.point.into())?;
        }
        let grid = bench.grid(&request, observer)?;
        let mut setting = Setting { experiment, bench, observer, wants_states: observer.wants_states() };
        let reduced = |model: &&Model| matches!(model.kind, Kind::Reduced(_));
        let embedded = study.reduced.as_ref().is_some_and(ReducedTransient::is_embedded);
        let named = if embedded && !models.iter().any(|model| reduced(&model)) {
            study.saved_model(&mut setting)?.map(Model::saved)
        } else {
            None
        };
        let runner = Runner { study: &study, grid, saved: None, setting: &setting, tell: &tell };
        let drive = Drive { name: String::new(), inputs: study.inputs.clone(), duration: study.duration };
        for model in named.iter().chain(models) {
            let transient = study.own_march(request.point, request.lubricant, model.frame);
            let unknown = match &model.kind {
                Kind::Linearised { model, .. } => model.shares(&transient.problem()?).is_err(),
                Kind::Reduced(_) => false,
            };
            if !unknown {
                runner.compared(model, &drive, (&drive.result(model.frame.name()), &transient))?;
            }
        }
        Ok(())
    }
}

impl Runner<'_, '_> {
    /// Returns the grid of a line contact, which all models need.
    fn line(&self) -> Result<&Arc<ReferenceGrid>, RunError> {
        self.grid.line().ok_or_else(|| RunError::Study("transient models need a line contact".to_owned()))
    }

    /// Returns the listener for a named march.
    fn told(&self, march: &str, by: MarchedBy) -> Option<Listener<'_>> {
        Some(Listener { march: Arc::from(march), by, tell: self.tell, wants_states: self.setting.wants_states })
    }

    /// Computes a full march, with its fields if they were stored.
    fn full(&self, drive: &Drive, mut transient: Transient) -> Result<(Arc<March>, Vec<State>), RunError> {
        let (study, frame) = (self.study, transient.frame);
        if study.mass_between.is_some() {
            transient.keep = Keep::Every(1);
        }
        let name = drive.result(frame.name());
        let stage = MarchedBy::Full.stage(frame);
        let told = self.told(&name, MarchedBy::Full);
        let observer = self.setting.observer;
        let of_time = |model: &mut dyn Marching| -> Result<Timed, RunError> {
            let mut timed = timed_march(model, &transient, stage, observer, told)?;
            timed.trajectory.estimate_step_error(model, observer);
            Ok(timed)
        };
        let (mut timed, grid_cost) = match &self.grid {
            ContactGrid::Line(grid) => {
                let mut model = FullMarch::new(Arc::clone(grid), &transient)?;
                let timed = of_time(&mut model)?;
                let cost = timed.trajectory.grid_cost(&mut model, observer);
                (timed, cost)
            }
            ContactGrid::Point(grid) => {
                (of_time(&mut FullMarch::<PlaneSpace>::on(Arc::clone(grid), &transient)?)?, None)
            }
        };
        let balance = study.mass_between.and_then(|places| timed.trajectory.mass_balance(places));
        let states = std::mem::take(&mut timed.trajectory.states);
        let first = study.frames.first().filter(|first| **first != frame).map(|first| drive.result(first.name()));
        let march = March::new(&name, By::Full { first }, timed);
        let mass_defect = balance.map(|balance| balance.defect());
        Ok((Arc::new(March { mass_defect, grid_cost, ..march }), states))
    }
}
