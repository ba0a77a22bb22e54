//! Study of a measured or generated surface z(x) at rest in a line contact: steady pressure and film thickness, and
//! statistics of the surface.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use super::transient::{SurfaceFeature, SurfaceShape, check_surfaces, coverage, read_profile};
use crate::scene::check::{count, number, refuse};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::discrete::grid::{ContactGrid, ReferenceGrid};
use crate::solver::full::Termination;
use crate::solver::full::response::widest_spacing;
use crate::solver::full::transient::{FullMarch, Input, Inputs, Marching, MovingSurface, Shape, Transient};
use crate::solver::physics::surfaces::{HeightProfile, ProfileStatistics};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::Arc;

/// Steady line contact of a smooth moving body and a stationary one with a rough surface z(x). The SRR of the scene is
/// 2 if body 1 is at rest and −2 if body 2 is. Measured profiles are levelled: their least-squares line is subtracted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StationaryProfile {
    /// Surface of the body at rest.
    pub surface: SurfaceShape,
    /// Factors by which its heights are multiplied, each with its own solution. The smooth contact precedes them.
    #[serde(default = "unchanged", skip_serializing_if = "is_unchanged")]
    pub factors: Vec<f64>,
}

/// Columns: factor, X, height z \[m\], P, H.
const COLUMNS: [&str; 5] = ["factor", "X", "height_m", "P", "H"];
/// Columns of the table of statistics.
const STATISTICS: [&str; 9] =
    ["Rq_m", "Ra_m", "Rt_m", "Rsk", "Rku", "Rdq", "resolved_share", "smooth_film_m", "film_ratio"];
/// Columns of the table of results.
const RESULTS: [&str; 7] = ["factor", names::H_C, names::H_MIN, "H_mean", "P_max", "X_P_max", names::NEWTON_ITERATIONS];
/// Range of X over which the mean film thickness is computed.
const MIDDLE: f64 = 0.5;
/// Largest film thickness in charts, over the mean one of the smooth contact.
const THICKEST: f64 = 5.0;
/// Range of X shown in charts.
const SHOWN: (f64, f64) = (-2.0, 1.5);
/// Points per grid node at which a surface given by a formula is sampled.
const SAMPLES: usize = 20;
const MOST_FACTORS: usize = 20;
const LARGEST_FACTOR: f64 = 100.0;

/// Solution for one factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Factor of the heights; 0 for the smooth contact.
    pub factor: f64,
    /// Surface with the factor 1; `None` for the smooth contact.
    pub surface: Option<Surface>,
    /// X, height z \[m\], P and H; empty if the solve failed.
    pub profile: Vec<[f64; 4]>,
    /// Central, minimum and mean film thickness H_c, H_min and H, largest pressure P_max and its X.
    pub scalars: [f64; 5],
    /// Scale a²/R of the film thickness \[m\].
    pub film_scale_m: f64,
    /// Number of Newton steps.
    pub newton_iterations: usize,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

/// Statistics of the surface, and how much of it the grid resolves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Statistics with heights and lengths in metres. Of the part in the contact, |X| ≤ 1, if a formula defines the
    /// surface, otherwise of the whole profile.
    pub statistics: ProfileStatistics,
    /// Rms height of the cell means over that of the surface, both for |X| ≤ 1.
    pub resolved: f64,
}

fn unchanged() -> Vec<f64> {
    vec![1.0]
}

fn is_unchanged(factors: &Vec<f64>) -> bool {
    *factors == unchanged()
}

/// Contact and grid of a run.
struct Prepared {
    grid: Arc<ReferenceGrid>,
    smooth: Transient,
    x: Vec<f64>,
}

impl Prepared {
    /// Solves the contact with heights at the nodes, in units of a²/R, times a factor. `None` if the observer cancelled.
    fn solved(
        &self,
        heights: &[f64],
        (factor, surface): (f64, Option<Surface>),
        setting: &Setting<'_>,
    ) -> Result<Option<Row>, RunError> {
        let film_scale_m = self.smooth.point.film_scale_m();
        let heights: Vec<f64> = heights.iter().map(|height| factor * height).collect();
        let surfaces = surface.iter().map(|_| MovingSurface {
            speed: 0.0,
            at: 0.0,
            shape: Shape::Profile { places: self.x.clone(), heights: heights.clone() },
        });
        let transient = Transient { surfaces: surfaces.collect(), ..self.smooth.clone() };
        let start = FullMarch::new(self.grid.clone(), &transient)?.solve_start(Input::REFERENCE, setting.observer)?;
        let failed = Row {
            factor,
            surface,
            profile: Vec::new(),
            scalars: [f64::NAN; 5],
            film_scale_m,
            newton_iterations: 0,
            warnings: Vec::new(),
        };
        let (moment, state) = match start {
            Ok(solved) => solved,
            Err(Termination::Cancelled) => return Ok(None),
            Err(_) => return Ok(Some(failed)),
        };
        let fields = heights.iter().zip(state.pressure.iter().zip(&state.film));
        let profile: Vec<_> =
            self.x.iter().zip(fields).map(|(&x, (&z, (&p, &h)))| [x, z * film_scale_m, p, h]).collect();
        let scalars = [moment.h_c, moment.h_min, mean_film(&profile), moment.p_max, moment.x_p_max];
        Ok(Some(Row { profile, scalars, newton_iterations: moment.effort.newton_iterations, ..failed }))
    }
}

/// Returns the mean film thickness for |X| ≤ ½.
fn mean_film(profile: &[[f64; 4]]) -> f64 {
    let pairs = profile.windows(2).filter(|pair| pair.iter().all(|[x, ..]| x.abs() <= MIDDLE));
    let [area, length] = pairs.fold([0.0; 2], |[area, length], pair| {
        let width = pair[1][0] - pair[0][0];
        [area + 0.5 * width * (pair[0][3] + pair[1][3]), length + width]
    });
    area / length
}

impl StationaryProfile {
    fn feature(&self) -> SurfaceFeature {
        SurfaceFeature { body: 1, shape: self.surface.clone() }
    }

    /// Returns the heights of the surface in units of a and a²/R, levelled if they were measured.
    fn heights(&self, prepared: &Prepared, setting: &Setting<'_>) -> Result<HeightProfile, RunError> {
        let read = |path: &Path| read_profile(&setting.bench.resolve(path));
        let surface = self.feature().moving(&prepared.smooth.point, read)?;
        let refused = |why: &dyn std::fmt::Display| RunError::Study(format!("the surface is refused: {why}"));
        let (&[first, .., last], MovingSurface { at, shape, .. }) = (&prepared.x[..], &surface) else {
            return Err(refused(&"the grid has too few nodes"));
        };
        let Shape::Profile { places, heights } = shape else {
            let count = SAMPLES * prepared.x.len();
            let x = (0..=count).map(|k| first + (last - first) * k as f64 / count as f64);
            let points = x.map(|x| [x, surface.height(x, 0.0, 0.0)]).collect();
            return HeightProfile::new(points).map_err(|why| refused(&why));
        };
        let points = places.iter().zip(heights).map(|(place, height)| [place + at, *height]).collect();
        let profile = HeightProfile::new(points).map_err(|why| refused(&why))?.levelled();
        let (from, to) = profile.ends();
        if !(from <= -1.0 && to >= 1.0) {
            let half_width_m = prepared.smooth.point.hertz().half_width_m;
            return Err(refused(&format!(
                "the profile covers x from {:.4e} to {:.4e} m, but must cover the contact, from {:.4e} to {:.4e} m",
                from * half_width_m,
                to * half_width_m,
                -half_width_m,
                half_width_m
            )));
        }
        Ok(profile)
    }

    /// Returns the heights at the nodes, the surface with its statistics in metres, and a warning about short waves.
    fn on_grid(
        &self,
        prepared: &Prepared,
        setting: &Setting<'_>,
    ) -> Result<(Vec<f64>, Surface, Option<Warning>), RunError> {
        let (profile, point) = (self.heights(prepared, setting)?, &prepared.smooth.point);
        let (length, height) = (point.hertz().half_width_m, point.film_scale_m());
        let measured = matches!(self.surface, SurfaceShape::Profile(_) | SurfaceShape::Sampled { .. });
        let seen = if measured { profile.statistics() } else { profile.between(-1.0, 1.0).statistics() };
        let statistics = ProfileStatistics {
            rq: seen.rq * height,
            ra: seen.ra * height,
            rt: seen.rt * height,
            slope: seen.slope * height / length,
            ..seen
        };
        let means = profile.cell_means(&prepared.x);
        let nodes = prepared.x.iter().zip(&means).map(|(x, z)| [*x, *z]).collect();
        let nodes = HeightProfile::new(nodes).map_err(|why| RunError::Study(why.to_string()))?;
        let resolved = nodes.between(-1.0, 1.0).rms() / profile.between(-1.0, 1.0).rms();
        let warning = Warning::of_resolved_height(resolved, widest_spacing(&prepared.x));
        Ok((means, Surface { statistics, resolved }, warning))
    }
}

impl Question for StationaryProfile {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        coverage::check(experiment)?;
        check_surfaces(&[self.feature()])?;
        if experiment.sliding.slide_to_roll_ratio.abs() != 2.0 {
            return Err(refuse("srr", "must be 2 or -2, so that the body with the surface is at rest"));
        }
        count("study.factors (how many)", self.factors.len(), 1, MOST_FACTORS)?;
        self.factors.iter().try_for_each(|&factor| number("study.factors", factor, 0.0, LARGEST_FACTOR))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let steps = self.factors.len() + 1;
        setting.step("factors", 0, steps)?;
        let request = setting.experiment.request()?;
        let answer = setting.bench.answer(&request, None, setting.observer)?;
        let ContactGrid::Line(grid) = setting.bench.grid(&request, setting.observer)? else {
            return Err(RunError::Study("the surface needs a line contact".to_owned()));
        };
        let mut smooth = Transient::new(request.point, Inputs::default(), 1.0, 1.0);
        smooth.lubricant = request.lubricant;
        let x = FullMarch::new(grid.clone(), &smooth)?.abscissae().to_vec();
        let prepared = Prepared { grid, smooth, x };
        let (heights, surface, warning) = self.on_grid(&prepared, setting)?;
        let cases = std::iter::once((0.0, None)).chain(self.factors.iter().map(|&factor| (factor, Some(surface))));
        for (k, case) in cases.enumerate() {
            setting.step("factors", k, steps)?;
            let Some(mut row) = prepared.solved(&heights, case, setting)? else {
                return setting.step("factors", k, steps);
            };
            if k == 0 {
                row.warnings.extend(answer.result.warnings.iter().cloned().chain(warning.clone()));
            }
            tell(row);
        }
        Ok(())
    }

    /// Values: `failures`; of the surface `Rq_m`, `Ra_m`, `Rt_m`, `Rsk`, `Rku`, `Rdq` and `resolved_share`, the share of
    /// its rms height that the grid resolves; `smooth.H_c`, `smooth.H_min`, `smooth.H_mean`, `smooth.P_max`; and for
    /// each factor, numbered from 0, `H_c_0`, `H_min_0`, `H_mean_0` and `P_max_0`. H_mean is the mean for |X| ≤ ½.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        let failures = rows.iter().filter(|row| row.profile.is_empty()).count();
        found.converged &= failures == 0 && rows.len() == self.factors.len() + 1;
        found.push("failures", of, failures as f64);
        found.warn("", rows.iter().flat_map(|row| row.warnings.iter().cloned()));
        if let Some(values) = statistics(rows) {
            for (name, value) in STATISTICS.iter().zip(values) {
                found.push(*name, of, value);
            }
        }
        for (k, row) in rows.iter().enumerate() {
            for (name, value) in ["H_c", "H_min", "H_mean", "P_max"].iter().zip(row.scalars) {
                let name = match k.checked_sub(1) {
                    None => format!("smooth.{name}"),
                    Some(k) => format!("{name}_{k}"),
                };
                found.push(name, of, value);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut fields = Table::new("profiles", &COLUMNS);
        for row in rows {
            let node = |&[x, z, p, h]: &[f64; 4]| vec![row.factor, x, z, p, h];
            fields.rows.extend(row.profile.iter().map(node));
        }
        let mut results = Table::new("results", &RESULTS);
        results
            .rows
            .extend(rows.iter().map(|row| {
                [row.factor].into_iter().chain(row.scalars).chain([row.newton_iterations as f64]).collect()
            }));
        let mut surface = Table::new("surface", &STATISTICS);
        surface.rows.extend(statistics(rows));
        vec![surface, results.with_warnings(rows.iter().map(|row| &row.warnings[..])), fields]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let x = || ChartAxis::linear("X = x/a");
        let mut pressures = Chart::new("Pressure", x(), ChartAxis::linear("P = p/p_H"));
        let mut films = Chart::new("Film", x(), ChartAxis::linear("h [µm]"));
        let mut heights = Chart::new("Undeformed surface", x(), ChartAxis::linear("z [µm]"));
        // In front of the contact and behind it, the gap is many times as thick.
        let thickest = rows.first().map_or(f64::INFINITY, |row| THICKEST * row.scalars[2]);
        // Rough curves are below the smooth one.
        for row in rows.iter().rev() {
            let name = match row.factor {
                0.0 => "smooth".to_owned(),
                1.0 => "rough".to_owned(),
                factor => format!("heights × {factor}"),
            };
            let shown = || row.profile.iter().filter(|[x, ..]| (SHOWN.0..=SHOWN.1).contains(x));
            pressures.add(&name, Marks::Line, shown().map(|&[x, _, p, _]| [x, p]));
            let film = shown().filter(|[.., h]| *h <= thickest);
            films.add(&name, Marks::Line, film.map(|&[x, .., h]| [x, h * row.film_scale_m * 1e6]));
            if row.factor > 0.0 {
                heights.add(name, Marks::Line, shown().map(|&[x, z, ..]| [x, 1e6 * z]));
            }
        }
        vec![pressures, films, heights]
    }
}

/// Returns the statistics of the surface in the order of [`STATISTICS`], with the film ratio of the smooth contact:
/// its central film thickness over Rq.
fn statistics(rows: &[&Row]) -> Option<Vec<f64>> {
    let Surface { statistics: of, resolved } = rows.iter().find_map(|row| row.surface)?;
    let film = rows.first().map_or(f64::NAN, |row| row.scalars[0] * row.film_scale_m);
    Some(vec![of.rq, of.ra, of.rt, of.skewness, of.kurtosis, of.slope, resolved, film, film / of.rq])
}
