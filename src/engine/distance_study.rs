//! Weights of the distance measure by (3.9), with the correlation (3.8) they reach.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::full_solutions;
use super::run::request_of;
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::Scene;
use crate::solver::training::distance::{Candidate, DISSERTATION, FURTHER, correlation, fit};
use crate::solver::training::{Range, TrainingObserver, random_points};

/// Values: `correlation` and `ratio` (weight of (ΔL)² over that of the M-term) for the two functions of (3.20), `correlation_printed` for
/// its own weights 1 : 0.001, `correlation_all` and `weight.…` for all candidates together, `alone.…` for each by itself.
pub(super) fn run(
    scene: &Scene,
    (range, points, seed): (&Range, usize, u64),
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let drawn = random_points(range, scene.contact, points, seed);
    let grid = workbench.grid(&request_of(scene)?, observer)?;
    let solutions = full_solutions(|_| grid.clone(), &drawn, scene.lubricant, observer)?;
    let (mut kept, mut states) = (Vec::new(), Vec::new());
    for solution in solutions.into_iter().flatten() {
        // z = (P, δ, H₀) at the nodes, in the Euclidean norm of (3.6).
        let h_0 = solution.scalars.h_0;
        let mut z = solution.pressure;
        z.extend(solution.film.iter().zip(&solution.x).map(|(h, x)| h - h_0 - 0.5 * x * x));
        z.push(h_0);
        states.push(z);
        kept.push(solution.problem.point);
    }
    outcome.push("points", None, kept.len() as f64);
    outcome.push("full_failures", None, (points - kept.len()) as f64);
    let nothing = || EngineError::Study("the solutions are too few or all equal; widen `study.range`".to_owned());
    let two = fit(&DISSERTATION, &kept, &states).ok_or_else(nothing)?;
    outcome.push("correlation", None, two.correlation);
    outcome.push("ratio", None, two.weights[1] / two.weights[0]);
    let printed = correlation(&DISSERTATION, &[1.0, 0.001], &kept, &states).ok_or_else(nothing)?;
    outcome.push("correlation_printed", None, printed);
    let all: Vec<Candidate> = DISSERTATION.iter().chain(&FURTHER).copied().collect();
    let every = fit(&all, &kept, &states).ok_or_else(nothing)?;
    outcome.push("correlation_all", None, every.correlation);
    for (candidate, weight) in all.iter().zip(&every.weights) {
        outcome.push(format!("weight.{}", candidate.name), None, *weight);
    }
    for candidate in &all {
        let alone = fit(std::slice::from_ref(candidate), &kept, &states).map_or(f64::NAN, |fit| fit.correlation);
        outcome.push(format!("alone.{}", candidate.name), None, alone);
    }
    let mut table = Table::new("distances", &["M_1", "L_1", "M_2", "L_2", "D_2", "s_3_20", "s_all"]);
    for i in 0..kept.len() {
        for j in 0..i {
            let (a, b) = (kept[i].moes(), kept[j].moes());
            let true_distance = states[i].iter().zip(&states[j]).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
            let s = |candidates: &[Candidate], weights: &[f64]| -> f64 {
                candidates.iter().zip(weights).map(|(c, w)| w * (c.value)(&kept[i], &kept[j])).sum()
            };
            let fitted = s(&all, &every.weights);
            table.rows.push(vec![a.m, a.l, b.m, b.l, true_distance, s(&DISSERTATION, &[1.0, 0.001]), fitted]);
        }
    }
    outcome.tables.push(table);
    Ok(())
}
