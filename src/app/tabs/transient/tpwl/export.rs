//! Export of the linearised model: its operating points, the weights of every step, and the study of their number.

use super::shown::ShownModel;
use crate::app::export;
use crate::app::tabs::transient::TransientRuns;
use crate::app::tabs::transient::export::describe;
use crate::app::tabs::transient::linearised::{Linearised, NumberRow};
use crate::app::tabs::transient::method::{RULES, WEIGHTINGS, rule_name, word};
use crate::engine::arrays::Array;
use crate::engine::model_arrays;
use crate::scene::names;
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::Quantity;

/// Returns comment lines about the set-up and the training of the model.
fn comments(shown: &ShownModel<'_>) -> Vec<String> {
    let model = &shown.linearised.model;
    let selection = model.training.selection;
    let mut lines = shown.view.setup.as_ref().map_or_else(Vec::new, |setup| describe(setup));
    lines.push(format!(
        "{} pressure modes; {} operating points by rule {}, tolerance {:e}; at T {:e}",
        model.space.modes(),
        model.points.len(),
        rule_name(selection).0,
        selection.tolerance(),
        shown.view.player.time()
    ));
    lines
}

/// Returns all operating points with their weights and distances at the displayed time.
pub fn points(shown: &ShownModel<'_>) -> String {
    let model = &shown.linearised.model;
    let [across, up] = shown.choices.coordinates;
    let header = [
        "point",
        "training",
        names::LOAD,
        "T",
        "radius",
        "speed",
        "load",
        "H_c",
        "P_c",
        "H_0",
        "across",
        "up",
        "spacing",
        "distance",
        "weight_dual_taylor",
        "weight_dissertation",
    ];
    let rows = shown.points.iter().filter_map(|now| {
        let trained = model.points.get(now.point)?;
        let (moment, input) = (&trained.moment, trained.moment.input);
        let value = |quantity| shown.linearised.value(trained.trajectory, quantity, moment.time);
        let load = model.sets.get(trained.set).map(|set| set.problem.point.load);
        let weight = |k: usize| shown.was_run(k).then(|| now.weights[k]);
        Some(vec![
            Some((now.point + 1) as f64),
            Some((trained.trajectory + 1) as f64),
            load,
            Some(moment.time),
            Some(input.radius),
            Some(input.speed),
            Some(input.load),
            value(Quantity::CentralFilm),
            value(Quantity::CentralPressure),
            moment.state.last().copied(),
            moment.state.get(across).copied(),
            moment.state.get(up).copied(),
            Some(trained.spacing),
            Some(now.distance),
            weight(0),
            weight(1),
        ])
    });
    export::csv(&comments(shown), &header, rows)
}

/// Returns the operating points and weights of every step, one line for each weight.
pub fn weights(shown: &ShownModel<'_>) -> String {
    let mut lines = comments(shown);
    lines.push("weighting 1 is the dual Taylor form, 2 the weights (4.29)".to_owned());
    let header = ["weighting", "T", "point", "point_T", "weight", "distance_from_barycentre", "spacing"];
    let rows = shown.runs.iter().flat_map(|(weighting, run)| {
        let number = WEIGHTINGS.iter().position(|other| other == weighting).map(|k| (k + 1) as f64);
        run.record.iter().flat_map(move |record| {
            record.steps().iter().enumerate().flat_map(move |(k, step)| {
                record.weights(k).iter().map(move |w| {
                    let time = shown.linearised.model.points.get(w.point).map(|point| point.moment.time);
                    let point = Some((w.point + 1) as f64);
                    vec![number, Some(step.time), point, time, Some(w.weight), Some(step.distance), Some(step.spacing)]
                })
            })
        })
    });
    export::csv(&lines, &header, rows)
}

/// Returns the model as arrays. `weights_1` of the dual Taylor form and `weights_2` of (4.29) contain the weight of
/// each operating point at every step (`times_1`, `times_2`).
pub fn arrays(view: &TransientRuns, linearised: &Linearised) -> Vec<Array> {
    let model = &linearised.model;
    let mut arrays = model_arrays::of_linearised(model);
    for (weighting, run) in view.runs_of(linearised) {
        let number = WEIGHTINGS.iter().position(|other| *other == weighting).map_or(0, |k| k + 1);
        let Some(record) = &run.record else { continue };
        let row = |k: usize| {
            let mut row = vec![0.0; model.points.len()];
            for weight in record.weights(k) {
                if let Some(entry) = row.get_mut(weight.point) {
                    *entry = weight.weight;
                }
            }
            row
        };
        let rows: Vec<Vec<f64>> = (0..record.steps().len()).map(row).collect();
        arrays.push(Array::list(format!("times_{number}"), record.steps().iter().map(|step| step.time).collect()));
        arrays.push(Array::rows(format!("weights_{number}"), &rows));
    }
    arrays
}

/// Returns the study of the number of operating points.
pub fn numbers(view: &TransientRuns) -> String {
    let mut lines = view.setup.as_ref().map_or_else(Vec::new, |setup| describe(setup));
    let names = RULES.map(|rule| rule_name(rule).0).join(", 2 ");
    let words = WEIGHTINGS.map(|weighting| word(MarchedBy::Linearised(weighting))).join(", 2 ");
    lines.push(format!("rule 1 {names}; weighting 1 {words}"));
    let header = ["rule", "tolerance", "points", "weighting", "H_c_difference_l2", "step_s_median"];
    let row = |row: &NumberRow| {
        let rule = RULES.iter().position(|rule| rule.name() == row.selection.name()).map(|k| (k + 1) as f64);
        let weighting = WEIGHTINGS.iter().position(|other| *other == row.weighting).map(|k| (k + 1) as f64);
        let (tolerance, points) = (Some(row.selection.tolerance()), Some(row.points as f64));
        vec![rule, tolerance, points, weighting, row.difference, Some(row.step_s).filter(|s| s.is_finite())]
    };
    export::csv(&lines, &header, view.number.rows.iter().map(row))
}
