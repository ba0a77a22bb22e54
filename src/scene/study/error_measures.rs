//! Error-measure study: error measures at random points, ordered by the true error (Fig. 3.1), and how well each
//! measure ranks the errors.

use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{self, MAX_COMPARED, count};
use crate::scene::method::ModelSource;
use crate::scene::names;
use crate::scene::parallel::{full_solutions, reduced_solutions};
use crate::scene::random_points::all_random_points;
use crate::scene::statistics::rank_correlation;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::reduced::{ErrorEstimate, ErrorMeasures, Norm, ReducedOptions};
use serde::{Deserialize, Serialize};

/// Error measures (3.10), (3.14), (3.15) of a reduced model at random points (3.17), ordered by the true error (Fig.
/// 3.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorMeasureStudy {
    /// Range in which the points are drawn.
    pub range: ParameterSpace,
    /// Number of points.
    pub points: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Model under test.
    pub model: ModelSource,
    /// Online scheme of the model.
    #[serde(default)]
    pub online: OnlineScheme,
    /// Norm of states and residuals.
    #[serde(default)]
    pub norm: Norm,
}

/// Online solution scheme of a reduced model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum OnlineScheme {
    /// Explorer: exact deformation operator, several initial guesses, continuation.
    #[default]
    Explorer,
    /// Dissertation: δ̃ in the state; the nearest snapshot by (3.20) is the only initial guess.
    Dissertation,
}

impl OnlineScheme {
    /// Returns the solver options of the scheme.
    pub fn options(self) -> ReducedOptions {
        match self {
            Self::Explorer => ReducedOptions::default(),
            Self::Dissertation => ReducedOptions::dissertation(),
        }
    }
}

/// Result at one random point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Moes numbers of the point.
    pub moes: Moes,
    /// True if the reduced iteration converged.
    pub reduced: bool,
    /// True if the full solver converged.
    pub full: bool,
    /// Measures, if both converged.
    pub measured: Option<Measured>,
}

/// Error measures and true errors at one point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// True state error e_z, (3.10).
    pub state: f64,
    /// Residual e_f of all equations, (3.14).
    pub all_rows: f64,
    /// Residual e_f^I of the sampled equations, (3.15).
    pub sampled_rows: f64,
    /// |H̃_c/H_c − 1|, error of the central film thickness.
    pub h_c: f64,
    /// |H̃_min/H_min − 1|, error of the minimum film thickness.
    pub h_min: f64,
    /// Calibrated error estimates, if the model has them.
    pub estimate: Option<ErrorEstimate>,
}

type Named = Column<Measured>;

const STATE: Named = ("e_z", |m| m.state);
const ALL_ROWS: Named = ("e_f", |m| m.all_rows);
const SAMPLED_ROWS: Named = ("e_f_I", |m| m.sampled_rows);
const H_C: Named = ("H_c_error", |m| m.h_c);
const H_MIN: Named = ("H_min_error", |m| m.h_min);
const MEASURES: [Named; 3] = [STATE, ALL_ROWS, SAMPLED_ROWS];
const TRUTHS: [Named; 3] = [STATE, H_C, H_MIN];
const COLUMNS: [Named; 5] = [STATE, ALL_ROWS, SAMPLED_ROWS, H_C, H_MIN];

/// Returns the measured points, ordered by e_z.
fn ordered(rows: &[&Row]) -> Vec<(Moes, Measured)> {
    let mut measured: Vec<_> = rows.iter().filter_map(|row| Some((row.moes, row.measured?))).collect();
    measured.sort_by(|a, b| a.1.state.total_cmp(&b.1.state));
    measured
}

impl Question for ErrorMeasureStudy {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.points", self.points, 3, MAX_COMPARED)?;
        check::space("study.range", &self.range)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let points = all_random_points(&self.range, experiment.contact, self.points, self.seed, observer)?;
        let Some(first) = points.first() else { return Ok(()) };
        let model = setting.bench.model_for(&self.model, first, &experiment.lubricant, observer)?;
        let options = self.online.options();
        let measures: Vec<ErrorMeasures> =
            model.windows.iter().map(|window| ErrorMeasures::new(window, &options, self.norm)).collect();
        let reduced = reduced_solutions(&model, options, &points, experiment.lubricant, |_| true, observer)?;
        let grid = |point: &OperatingPoint| model.window_at(point).grid.clone();
        let full = full_solutions(grid, &points, experiment.lubricant, observer)?;
        for ((point, reduced), full) in points.iter().zip(&reduced).zip(&full) {
            let fields = reduced.as_ref().and_then(|reduced| Some((&reduced.solved, reduced.fields.as_ref()?)));
            let measured = fields.zip(full.as_ref()).map(|((solved, fields), full)| {
                let measure = &measures[solved.window];
                let residuals = measure.residuals(&solved.coefficients, fields);
                let error = |reduced: f64, full: f64| (reduced / full - 1.0).abs();
                Measured {
                    state: measure.state_error(fields, full),
                    all_rows: residuals.all_rows,
                    sampled_rows: residuals.sampled_rows,
                    h_c: error(fields.scalars.h_c, full.scalars.h_c),
                    h_min: error(fields.scalars.h_min, full.scalars.h_min),
                    estimate: solved.error,
                }
            });
            tell(Row { moes: point.moes(), reduced: reduced.is_some(), full: full.is_some(), measured });
        }
        Ok(())
    }

    /// Values: `e_z_median`, …, and rank correlations such as `rank.e_f_I.e_z`: Spearman's correlation of a measure
    /// with an error. Points at which the reduced iteration fails are counted in `failures` and excluded from the other
    /// values.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let measured = ordered(rows);
        let column = |(_, get): Named| measured.iter().map(|(_, m)| get(m)).collect::<Vec<f64>>();
        found.push("points", None, rows.len() as f64);
        found.push("failures", None, rows.iter().filter(|row| !row.reduced).count() as f64);
        found.push("full_failures", None, rows.iter().filter(|row| !row.full).count() as f64);
        for named in COLUMNS {
            found.push_spread(named.0, None, &column(named));
        }
        for measure in MEASURES {
            for truth in TRUTHS.into_iter().filter(|truth| truth.0 != measure.0) {
                let rank = rank_correlation(&column(measure), &column(truth));
                found.push(format!("rank.{}.{}", measure.0, truth.0), None, rank);
            }
        }
        found.push("rank.e_f_I.e_f", None, rank_correlation(&column(SAMPLED_ROWS), &column(ALL_ROWS)));
        let estimated: Vec<(ErrorEstimate, Measured)> =
            rows.iter().filter_map(|row| row.measured).filter_map(|m| Some((m.estimate?, m))).collect();
        if estimated.is_empty() {
            return;
        }
        // Quality of the calibrated estimates: compared with the true e_z and with the errors of H_c and H_min.
        let (states, truths): (Vec<f64>, Vec<f64>) =
            estimated.iter().map(|(estimate, truth)| (estimate.state.likely, truth.state)).unzip();
        found.push("rank.estimate.e_z", None, rank_correlation(&states, &truths));
        let ratios = |ratio: fn(&(ErrorEstimate, Measured)) -> f64| estimated.iter().map(ratio).collect::<Vec<f64>>();
        found.push_bounds(names::H_C_BOUND, None, &ratios(|(estimate, truth)| estimate.h_c.bound / truth.h_c));
        found.push_bounds(names::H_MIN_BOUND, None, &ratios(|(estimate, truth)| estimate.h_min.bound / truth.h_min));
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let measured = ordered(rows);
        let mut columns: Vec<String> = [names::M, names::L].map(str::to_owned).into();
        columns.extend(COLUMNS.map(|(name, _)| name.to_owned()));
        columns.extend(MEASURES.map(|(name, _)| format!("{name}_normalised")));
        let largest = |get: fn(&Measured) -> f64| measured.iter().map(|(_, m)| get(m)).fold(0.0, f64::max);
        // As in Fig. 3.1: each measure divided by its largest value.
        let scales = MEASURES.map(|(_, get)| (get, largest(get)));
        let row = |(moes, m): &(Moes, Measured)| {
            let measures = COLUMNS.map(|(_, get)| get(m));
            [moes.m, moes.l].into_iter().chain(measures).chain(scales.map(|(get, scale)| get(m) / scale)).collect()
        };
        let rows = measured.iter().map(row).collect();
        vec![Table { name: "error_measures".to_owned(), columns, rows, ..Table::default() }]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let measured = ordered(rows);
        let x = ChartAxis::linear("Contact, ordered by e_z");
        let mut chart = Chart::new("Error measures", x, ChartAxis::log("Measure"));
        for (name, get) in COLUMNS {
            let marks = if name == STATE.0 { Marks::Line } else { Marks::Dots };
            chart.add(name, marks, measured.iter().enumerate().map(|(i, (_, m))| [(i + 1) as f64, get(m)]));
        }
        vec![chart]
    }
}
