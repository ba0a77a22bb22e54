//! Films of a contact through which a feature passes, at the times at which published films were taken.

use super::{GivenFilm, MeasuredFilm, PLACE_M};
use crate::scene::check::{Checked, number, refuse};
use crate::scene::error::RunError;
use crate::scene::experiment::Experiment;
use crate::scene::study::question::Setting;
use crate::scene::study::transient::{Listener, SurfaceFeature, check_surfaces, read_profile, timed_march};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::transient::{
    FullMarch, Inputs, Keep, Marching, MovingSurface, TimeStep, Trajectory, Transient,
};
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Features that pass the contact, and how they are computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Passing {
    /// Features. The given films name the position of the first one.
    pub surfaces: Vec<SurfaceFeature>,
    /// Time step ΔT.
    pub time_step: f64,
    /// Uncertainty of the positions that were read off \[µm\]. Each given film is moved by at most this length, so that
    /// its mean deviation is smallest.
    #[serde(default)]
    pub reading: f64,
}

/// Film as positions and thicknesses \[m\].
type Film = Vec<[f64; 2]>;

/// Slowest first feature in units of u_m.
const SLOWEST: f64 = 1e-3;
/// Number of tried positions to both sides of a film that was read off.
const TRIED: i32 = 20;

impl Passing {
    /// Refuses features, films without a position, and steps that are invalid.
    pub(super) fn check(&self, study: &MeasuredFilm, experiment: &Experiment) -> Checked {
        check_surfaces(&self.surfaces)?;
        number("study.passing.time_step", self.time_step, 1e-6, 10.0)?;
        number("study.passing.reading", self.reading, 0.0, 1e6)?;
        if let Some(film) = study.films.iter().find(|film| film.at.is_none()) {
            let problem = format!("must give the position of the feature in the film `{}`, in µm", film.name);
            return Err(refuse("study.films.at", problem));
        }
        let point = experiment.point().map_err(|problem| refuse("at", format!("is refused: {problem}")))?;
        let sliding = OperatingPoint { sliding: experiment.sliding, ..point };
        let stated = self.surfaces.iter().filter_map(|surface| surface.moving(&sliding, |_| Err(())).ok());
        let march = self.march(study, experiment, sliding, stated.collect());
        march.check().map_err(|problem| refuse("study.passing", format!("is refused: {problem}")))
    }

    /// Returns the march up to the last given film.
    fn march(
        &self,
        study: &MeasuredFilm,
        experiment: &Experiment,
        point: OperatingPoint,
        surfaces: Vec<MovingSurface>,
    ) -> Transient {
        let times = study.films.iter().filter_map(|film| Some(moment(film, surfaces.first()?, &point)));
        let last = times.fold(0.0, f64::max);
        let steps = (last / self.time_step).ceil().max(1.0);
        let (lubricant, keep) = (experiment.lubricant, Keep::Every(1));
        let own = Transient::new(point, Inputs::default(), steps * self.time_step, self.time_step);
        Transient { lubricant, surfaces, keep, time_step: TimeStep::Fixed(self.time_step), ..own }
    }

    /// Returns the film along Y = 0 \[m\] of each given film at its time.
    pub(super) fn films(
        &self,
        study: &MeasuredFilm,
        setting: &mut Setting<'_>,
    ) -> Result<(Vec<Film>, Trajectory), RunError> {
        let request = setting.experiment.request()?;
        let grid = setting.bench.grid(&request, setting.observer)?;
        let read = |path: &Path| read_profile(&setting.bench.resolve(path));
        let surfaces = self.surfaces.iter().map(|surface| surface.moving(&request.point, read));
        let surfaces = surfaces.collect::<Result<Vec<_>, _>>()?;
        let first = surfaces.first().cloned().ok_or_else(|| RunError::Study("there is no feature".to_owned()))?;
        if first.speed < SLOWEST {
            return Err(RunError::Study("the first feature does not move through the contact".to_owned()));
        }
        let transient = self.march(study, setting.experiment, request.point, surfaces);
        let march = |model: &mut dyn Marching| {
            let stage = "full system".to_owned();
            Ok::<_, RunError>(timed_march(model, &transient, stage, setting.observer, None::<Listener<'_>>)?.trajectory)
        };
        let trajectory = match grid {
            ContactGrid::Line(grid) => march(&mut FullMarch::new(grid, &transient)?)?,
            ContactGrid::Point(grid) => march(&mut FullMarch::<PlaneSpace>::on(grid, &transient)?)?,
        };
        let films = study.films.iter().map(|film| film_at(&trajectory, moment(film, &first, &request.point)));
        Ok((films.collect(), trajectory))
    }

    /// Returns the displacement \[m\] of a given film within the reading uncertainty for which its mean deviation is
    /// smallest.
    pub(super) fn displacement(&self, deviation: impl Fn(f64) -> f64) -> f64 {
        let steps = (-TRIED..=TRIED).map(|k| PLACE_M * self.reading * f64::from(k) / f64::from(TRIED));
        steps.min_by(|a, b| deviation(*a).total_cmp(&deviation(*b))).unwrap_or(0.0)
    }
}

/// Returns the time T at which a feature is where a film shows it.
fn moment(film: &GivenFilm, feature: &MovingSurface, point: &OperatingPoint) -> f64 {
    (film.at.unwrap_or(0.0) * PLACE_M / point.hertz().half_width_m - feature.at) / feature.speed.max(SLOWEST)
}

/// Returns position and film thickness \[m\] along Y = 0 at a time, interpolated between the steps. Empty if the march
/// did not come so far.
fn film_at(trajectory: &Trajectory, time: f64) -> Film {
    let next = trajectory.states.partition_point(|state| state.time < time);
    let before = trajectory.states.get(next.saturating_sub(1));
    let (Some(before), Some(after)) = (before, trajectory.states.get(next)) else { return Vec::new() };
    let apart = after.time - before.time;
    let share = if apart > 0.0 { (time - before.time) / apart } else { 0.0 };
    let point = &trajectory.transient.point;
    let (length, height) = (point.hertz().half_width_m, point.film_scale_m());
    // Nodes of a point contact run from the outer edge to the axis first.
    let column = (after.film.len() / trajectory.x.len().max(1)).max(1);
    let along = |film: &[f64]| film.iter().skip(column - 1).step_by(column).copied().collect::<Vec<f64>>();
    let films = along(&before.film).into_iter().zip(along(&after.film));
    let places = trajectory.x.iter().zip(films).skip(1);
    places.map(|(x, (from, to))| [length * x, height * (from + share * (to - from))]).collect()
}
