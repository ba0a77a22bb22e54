//! Distance-measure study. A distance measure s estimates from the parameters of two contacts how much their solutions
//! differ. The study fits its weights by (3.9) and reports the correlation (3.8) of s with the distances of solutions.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{self, MAX_COMPARED, count, refuse};
use crate::scene::parallel::full_solutions;
use crate::scene::random_points::all_random_points;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::Moes;
use crate::solver::training::distance::{Candidate, DISSERTATION, FURTHER, Fit, correlation, fit};
use serde::{Deserialize, Serialize};

/// Fits the weights of the distance measure (3.20) by (3.9) to full solutions at random points (3.17).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DistanceMeasure {
    /// Range in which the points are drawn.
    pub range: ParameterSpace,
    /// Number of points.
    pub points: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Result of the study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of full solutions that converged.
    pub solutions: usize,
    /// Number of full solutions that did not converge.
    pub full_failures: usize,
    /// Fit with the two functions of (3.20).
    pub two: Fit,
    /// Correlation δ, (3.8), with the weights printed in (3.20); 1 is perfect.
    pub printed: f64,
    /// Fit with all candidate functions, those of (3.20) and further ones.
    pub all: Fit,
    /// Correlation δ of each candidate function alone.
    pub alone: Vec<f64>,
    /// All pairs of converged solutions.
    pub pairs: Vec<Pair>,
}

/// Distance of two solutions, and its estimates by two distance measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// The contacts.
    pub moes: (Moes, Moes),
    /// Distance of the solutions, (3.6).
    pub distance: f64,
    /// Measure (3.20) with its printed weights.
    pub printed: f64,
    /// Measure of all candidate functions with their fitted weights.
    pub all: f64,
}

/// Weights of the two functions as printed in (3.20).
const PRINTED: [f64; 2] = [1.0, 0.001];

/// Returns all candidate functions of a distance measure, those of (3.20) first.
fn candidates() -> impl Iterator<Item = Candidate> {
    DISSERTATION.into_iter().chain(FURTHER)
}

impl Question for DistanceMeasure {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        if experiment.contact.is_point() {
            return Err(refuse("study", "is made for line contacts only; write `contact: Line`, or another study"));
        }
        count("study.points", self.points, 3, MAX_COMPARED)?;
        check::space("study.range", &self.range)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let drawn = all_random_points(&self.range, experiment.contact, self.points, self.seed, observer)?;
        let grid = setting.bench.grid(&experiment.request()?, observer)?;
        let solutions = full_solutions(|_| grid.clone(), &drawn, experiment.lubricant, observer)?;
        let (mut kept, mut states) = (Vec::new(), Vec::new());
        for solution in solutions.into_iter().flatten() {
            // State z of a solution: P and the deformation δ at the nodes, and H₀. Distances are Euclidean, (3.6).
            let h_0 = solution.scalars.h_0;
            let mut z = solution.pressure;
            z.extend(solution.film.iter().zip(&solution.x).map(|(h, x)| h - h_0 - 0.5 * x * x));
            z.push(h_0);
            states.push(z);
            kept.push(solution.problem.point);
        }
        let nothing = || RunError::Study("the solutions are too few or all equal; widen `study.range`".to_owned());
        let two = fit(&DISSERTATION, &kept, &states).ok_or_else(nothing)?;
        let printed = correlation(&DISSERTATION, &PRINTED, &kept, &states).ok_or_else(nothing)?;
        let candidates: Vec<Candidate> = candidates().collect();
        let all = fit(&candidates, &kept, &states).ok_or_else(nothing)?;
        let alone = |candidate| fit(std::slice::from_ref(candidate), &kept, &states);
        let alone =
            candidates.iter().map(|candidate| alone(candidate).map_or(f64::NAN, |fit| fit.correlation)).collect();
        let pair = |i: usize, j: usize| {
            let (a, b) = (&kept[i], &kept[j]);
            let s = |candidates: &[Candidate], weights: &[f64]| -> f64 {
                candidates.iter().zip(weights).map(|(c, w)| w * (c.value)(a, b)).sum()
            };
            let distance = states[i].iter().zip(&states[j]).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
            let (printed, all) = (s(&DISSERTATION, &PRINTED), s(&candidates, &all.weights));
            Pair { moes: (a.moes(), b.moes()), distance, printed, all }
        };
        let pairs = (0..kept.len()).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| pair(i, j)).collect();
        let (solutions, full_failures) = (kept.len(), drawn.len() - kept.len());
        tell(Row { solutions, full_failures, two, printed, all, alone, pairs });
        Ok(())
    }

    /// Adds `points` and `full_failures`; `correlation` and `ratio` (weight of (ΔL)² over that of the M term) for the
    /// two functions of (3.20); `correlation_printed` for their printed weights 1 : 0.001; `correlation_all` and
    /// `weight.…` for all candidates together; and `alone.…` for each candidate alone.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            found.push("points", None, row.solutions as f64);
            found.push("full_failures", None, row.full_failures as f64);
            found.push("correlation", None, row.two.correlation);
            found.push("ratio", None, row.two.weights[1] / row.two.weights[0]);
            found.push("correlation_printed", None, row.printed);
            found.push("correlation_all", None, row.all.correlation);
            for (prefix, values) in [("weight", &row.all.weights), ("alone", &row.alone)] {
                for (candidate, value) in candidates().zip(values) {
                    found.push(format!("{prefix}.{}", candidate.name), None, *value);
                }
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("distances", &["M_1", "L_1", "M_2", "L_2", "D_2", "s_3_20", "s_all"]);
        let row =
            |Pair { moes: (a, b), distance, printed, all }: &Pair| vec![a.m, a.l, b.m, b.l, *distance, *printed, *all];
        table.rows.extend(rows.iter().flat_map(|row| &row.pairs).map(row));
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let (x, y) = (ChartAxis::linear("Distance of solutions D₂"), ChartAxis::linear("Measure s"));
        let mut chart = Chart::new("Distance measures", x, y);
        let pairs = || rows.iter().flat_map(|row| &row.pairs);
        chart.add("weights as printed", Marks::Dots, pairs().map(|pair| [pair.distance, pair.printed]));
        chart.add("all candidates", Marks::Dots, pairs().map(|pair| [pair.distance, pair.all]));
        vec![chart]
    }
}
