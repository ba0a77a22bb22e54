//! A contact in time: in every frame and along every input the full system and the models beside it, what each costs, and how far they lie
//! apart.

mod costs;
mod models;
mod values;

pub(crate) use models::{TOO_STEEP, train_linearised};

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::run::request_of;
use super::timed_march::{Timed, timed_march};
use super::workbench::Workbench;
use crate::scene::{Drive, Scene, TransientStudy, sampled};
use crate::solver::discrete::grid::{ContactGrid, ReferenceGrid};
use crate::solver::full::transient::{FullMarch, Keep, Trajectory};
use crate::solver::training::TrainingObserver;
use costs::March;
use std::sync::Arc;

/// What all marches of a study share.
struct Runner<'a> {
    study: &'a TransientStudy,
    grid: Arc<ReferenceGrid>,
    observer: &'a dyn TrainingObserver,
    outcome: &'a mut SceneOutcome,
    /// Rows of the table of costs, in the order the marches were made.
    costs: Vec<March>,
    /// Pressure modes of the first frame's reduced model.
    first_modes: Option<f64>,
}

/// Runs the study.
///
/// Values of a full march stand behind the name of its frame (`fixed`, `ale`, `remeshed`, `remeshed_linear`): `H_c.start`, `H_c.mean`,
/// `H_c.amplitude`, `H_c.offset` (mean over start, less 1) over the window, and so on for H_min, P_c, P_max; `steps`, `rejected_steps`,
/// `newton_per_step`, `krylov_per_step`, `step_s_median`, `step_s_p99`, `march_s`; `mass_defect` where places are given. Of the second frame on:
/// `H_c.difference` (greatest, relative) and `H_c.difference_l2` from the first one within the window, and so on.
///
/// A reduced model's stand behind `fixed.rnsa`, a linearised one's behind `fixed.tpwl` (with several rules behind `fixed.tpwl.step_0.001`
/// and the like, and its marches behind that and `dual_taylor` or `dissertation`): sizes as [`models`] has them, differences from the full
/// march, costs, and `speed_up` (medians of the steps); `reach_median` and `reach_max` of a linearised one: how far steps lie from the trained
/// trajectories, in distances between operating points. `training_s` are the seconds of the trainings' full marches, where the study's own is
/// not the training.
///
/// Values of marches along further inputs have the name of these in front, as in `triangle.fixed.rnsa.H_c.difference_l2`.
///
/// Tables: the time series of each march; losses of information; operating points; with models, what all marches cost.
pub(super) fn run(
    scene: &Scene,
    study: &TransientStudy,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let mut study = study.clone();
    if let Some(path) = &study.sampled {
        sampled::read_into(&mut study.inputs, &workbench.resolve(path))?;
    }
    let request = request_of(scene)?;
    let ContactGrid::Line(grid) = workbench.grid(&request, observer)? else {
        return Err(EngineError::Study("only line contacts are followed in time".to_owned()));
    };
    let mut runner = Runner { study: &study, grid, observer, outcome, costs: Vec::new(), first_modes: None };
    let drives = study.drives();
    // Full marches in the first frame, one for each of the inputs.
    let mut first: Vec<Trajectory> = Vec::new();
    for &frame in &study.frames {
        let mut models = Vec::new();
        for (k, drive) in drives.iter().enumerate() {
            let mut transient = if k == 0 {
                study.own_march(request.point, request.lubricant, frame)
            } else {
                study.march(drive, request.point, request.lubricant, frame)
            };
            if study.mass_between.is_some() {
                transient.keep = Keep::Every(1);
            }
            let name = drive.result(frame.name());
            let mut model = FullMarch::new(Arc::clone(&runner.grid), &transient)?;
            let full = timed_march(&mut model, &transient, format!("{name}, full"), observer)?;
            runner.full(&name, &full, first.get(k));
            if k == 0 {
                models = runner.models(&full)?;
            }
            for model in &models {
                runner.beside(model, drive, &full)?;
            }
            if first.len() == k {
                first.push(Trajectory { states: Vec::new(), ..full.trajectory });
            }
        }
    }
    if study.reduced.is_some() || study.linearised.is_some() {
        let table = costs::table(runner.outcome, &runner.costs, &study.published);
        runner.outcome.tables.push(table);
    }
    Ok(())
}

impl Runner<'_> {
    /// Takes in a full march, and how far it lies from the one of the same inputs in the first frame, where it is not that.
    fn full(&mut self, name: &str, full: &Timed, first: Option<&Trajectory>) {
        let Timed { trajectory, .. } = full;
        let window = self.study.window(trajectory.transient.duration);
        values::statistics(name, trajectory, window, self.outcome);
        values::costs(name, full, self.outcome);
        if let Some(balance) = self.study.mass_between.and_then(|places| trajectory.mass_balance(places)) {
            self.outcome.push(format!("{name}.mass_defect"), None, balance.defect());
        }
        if let Some(first) = first {
            values::differences(name, trajectory, first, window, self.outcome);
        }
        values::end(name, trajectory, self.outcome);
        self.outcome.tables.push(values::series(name, trajectory));
        self.costs.push(March {
            name: name.to_owned(),
            model: format!("{name}.full."),
            full: name.to_owned(),
            published: format!("{name}.full"),
        });
    }

    /// Takes in a model's march beside the full one of its frame and inputs.
    fn compared(&mut self, name: &str, model: String, method: &str, march: &Timed, drive: &Drive, full: &Timed) {
        let of = drive.result(full.trajectory.transient.frame.name());
        values::costs(name, march, self.outcome);
        self.outcome.push(format!("{name}.speed_up"), None, full.step_s() / march.step_s());
        // A march that ended early agrees with nothing.
        if march.trajectory.finished() {
            let window = self.study.window(drive.duration);
            values::differences(name, &march.trajectory, &full.trajectory, window, self.outcome);
        }
        values::end(name, &march.trajectory, self.outcome);
        self.outcome.tables.push(values::series(name, &march.trajectory));
        self.costs.push(March { name: name.to_owned(), model, published: format!("{of}.{method}"), full: of });
    }
}
