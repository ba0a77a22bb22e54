//! Reduced models side by side: size, speed, and errors at the same random points.

use super::EngineError;
use super::{median, percentile};
use crate::scene::full_solutions;
use crate::solver::full::Problem;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use crate::solver::training::{Progress, Range, TrainingError, TrainingObserver, random_points};
use std::sync::Arc;
use std::time::Instant;

/// Several models at the same random points.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelComparison {
    /// Random points, (3.17).
    pub points: usize,
    /// One entry per model, in the order given.
    pub scores: Vec<ModelScore>,
}

/// What one model is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelScore {
    /// Its title.
    pub title: String,
    /// Full solutions it was made of, all windows.
    pub solutions: usize,
    /// Pressure modes of the largest window.
    pub modes: usize,
    /// Sampled rows of the largest window.
    pub rows: usize,
    /// Median time of a reduced solve \[s\], one after the other.
    pub online_median_s: f64,
    /// Points it was not trained for.
    pub untrained: usize,
    /// Reduced solves that failed.
    pub failures: usize,
    /// Full solves that failed on its grids: no error is known there.
    pub full_failures: usize,
    /// |H_c/H_c,full − 1|.
    pub h_c: Spread,
    /// |H_min/H_min,full − 1|.
    pub h_min: Spread,
}

/// How a relative error is spread over the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Median.
    pub median: f64,
    /// 95 % of the points lie below.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    fn of(errors: &[f64]) -> Self {
        Self { median: median(errors), p95: percentile(errors, 0.95), max: percentile(errors, 1.0) }
    }
}

/// Compares models at `count` random points of a range; each is held against cold full solutions on its own grids.
///
/// # Errors
/// When the range holds no points, a point is refused, or the observer cancels.
pub fn compare_models(
    models: &[Arc<ReducedModel>],
    range: &Range,
    lubricant: Lubricant,
    count: usize,
    seed: u64,
    observer: &dyn TrainingObserver,
) -> Result<ModelComparison, EngineError> {
    range.check().map_err(TrainingError::from)?;
    let contact = models.first().map_or_else(ContactKind::default, |model| model.contact());
    let points = random_points(range, contact, count, seed);
    if points.is_empty() {
        return Err(EngineError::Study("the range holds no points to compare at".to_owned()));
    }
    let mut films: Vec<Films> = Vec::with_capacity(models.len());
    let mut scores = Vec::with_capacity(models.len());
    for (k, model) in models.iter().enumerate() {
        let same_grids = |other: &&Arc<ReducedModel>| points.iter().all(|p| grid_of(model, p) == grid_of(other, p));
        let known = models.iter().take(k).zip(&films).find(|(other, _)| same_grids(other));
        let full = match known {
            Some((_, films)) => films.clone(),
            None => full_films(model, &points, lubricant, observer)?,
        };
        scores.push(score(model, &points, lubricant, &full, observer)?);
        films.push(full);
    }
    Ok(ModelComparison { points: points.len(), scores })
}

/// Films of full solutions on a model's own grids.
fn full_films(
    model: &ReducedModel,
    points: &[OperatingPoint],
    lubricant: Lubricant,
    observer: &dyn TrainingObserver,
) -> Result<Films, EngineError> {
    let grid = |point: &OperatingPoint| model.window_at(point.moes()).grid.clone();
    let full = full_solutions(grid, points, lubricant, observer)?;
    Ok(full.into_iter().map(|full| full.map(|full| (full.scalars.h_c, full.scalars.h_min))).collect())
}

/// H_c and H_min of full solutions, where there are any.
type Films = Vec<Option<(f64, f64)>>;

fn grid_of(model: &ReducedModel, point: &OperatingPoint) -> Option<crate::solver::discrete::grid::ContactGridSpec> {
    model.windows.get(model.window_for(point.moes())).map(|window| window.grid.spec())
}

fn score(
    model: &Arc<ReducedModel>,
    points: &[OperatingPoint],
    lubricant: Lubricant,
    full: &[Option<(f64, f64)>],
    observer: &dyn TrainingObserver,
) -> Result<ModelScore, EngineError> {
    let mut online = Online::new(Arc::clone(model), ReducedOptions::default());
    let (mut seconds, mut h_c, mut h_min) = (Vec::new(), Vec::new(), Vec::new());
    let (mut untrained, mut failures) = (0, 0);
    for (i, (point, truth)) in points.iter().zip(full).enumerate() {
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let stage = format!("Reduced solves of “{}”", model.title);
        observer.progress(Progress { stage, done: i, total: points.len() });
        untrained += usize::from(model.trust(&Problem::new(point, lubricant)?) != Trust::Trained);
        online.prepare(point.moes());
        let clock = Instant::now();
        let solved = online.solve(point, lubricant);
        let wall_s = clock.elapsed().as_secs_f64();
        let Ok(scalars) = solved.and_then(|solved| online.scalars(&solved)) else {
            failures += 1;
            continue;
        };
        seconds.push(wall_s);
        if let Some((full_h_c, full_h_min)) = truth {
            h_c.push((scalars.h_c / full_h_c - 1.0).abs());
            h_min.push((scalars.h_min / full_h_min - 1.0).abs());
        }
    }
    let largest =
        |size: fn(&crate::solver::reduced::Window) -> usize| model.windows.iter().map(size).max().unwrap_or(0);
    Ok(ModelScore {
        title: model.title.clone(),
        solutions: model.windows.iter().map(|w| w.snapshots.len()).sum(),
        modes: largest(|w| w.pressure.modes.ncols()),
        rows: largest(|w| w.sampled_rows.len()),
        online_median_s: median(&seconds),
        untrained,
        failures,
        full_failures: full.iter().filter(|film| film.is_none()).count(),
        h_c: Spread::of(&h_c),
        h_min: Spread::of(&h_min),
    })
}
