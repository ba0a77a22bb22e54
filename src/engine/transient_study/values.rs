//! What a march gives: statistics, differences from another one, costs, its time series.

use crate::engine::outcome::SceneOutcome;
use crate::engine::statistics::percentile;
use crate::engine::table::Table;
use crate::engine::timed_march::Timed;
use crate::solver::full::transient::{Moment, Quantity, Trajectory};

/// Quantities that statistics are taken of, with their names.
const QUANTITIES: [(&str, Quantity); 4] = [
    ("H_c", Quantity::CentralFilm),
    ("H_min", Quantity::MinimumFilm),
    ("P_c", Quantity::CentralPressure),
    ("P_max", Quantity::MaximumPressure),
];

/// Start, mean, offset and amplitude of each quantity within a window.
pub(super) fn statistics(name: &str, trajectory: &Trajectory, window: (f64, f64), outcome: &mut SceneOutcome) {
    let Some(start) = trajectory.moments.first() else { return };
    for (quantity_name, quantity) in QUANTITIES {
        let mut push = |what: &str, value| outcome.push(format!("{name}.{quantity_name}.{what}"), None, value);
        push("start", start.value(quantity));
        if let (Some(mean), Some(amplitude)) =
            (trajectory.mean(quantity, window), trajectory.amplitude(quantity, window))
        {
            push("mean", mean);
            push("offset", mean / start.value(quantity) - 1.0);
            push("amplitude", amplitude);
        }
    }
}

/// How far a march lies from another one within a window.
pub(super) fn differences(
    name: &str,
    trajectory: &Trajectory,
    from: &Trajectory,
    window: (f64, f64),
    outcome: &mut SceneOutcome,
) {
    for (quantity_name, quantity) in QUANTITIES {
        if let Some((greatest, l2)) = trajectory.difference(from, quantity, window) {
            outcome.push(format!("{name}.{quantity_name}.difference"), None, greatest);
            outcome.push(format!("{name}.{quantity_name}.difference_l2"), None, l2);
        }
    }
}

/// Steps and seconds of a march.
pub(super) fn costs(name: &str, march: &Timed, outcome: &mut SceneOutcome) {
    let Timed { trajectory, seconds } = march;
    let taken = trajectory.moments.get(1..).unwrap_or(&[]);
    let per_step = |count: fn(&Moment) -> usize| taken.iter().map(count).sum::<usize>() as f64 / taken.len() as f64;
    for (what, value) in [
        ("steps", taken.len() as f64),
        ("rejected_steps", trajectory.rejected_steps as f64),
        ("newton_per_step", per_step(|moment| moment.effort.newton_iterations)),
        ("krylov_per_step", per_step(|moment| moment.effort.linear_iterations)),
        ("step_s_median", march.step_s()),
        ("step_s_p99", percentile(seconds, 0.99)),
        ("march_s", seconds.iter().sum()),
    ] {
        outcome.push(format!("{name}.{what}"), None, value);
    }
}

/// Says how a march ended that did not reach its end.
pub(super) fn end(name: &str, trajectory: &Trajectory, outcome: &mut SceneOutcome) {
    if !trajectory.finished() {
        outcome.converged = false;
        outcome.warnings.push(format!("{name}: the march {}", trajectory.ended.describe()));
    }
}

/// The time series of a march.
pub(super) fn series(name: &str, trajectory: &Trajectory) -> Table {
    let columns = [
        "T", "step", "radius", "speed", "load", "H_c", "H_min", "X_H_min", "P_c", "P_max", "X_P_max", "newton",
        "krylov",
    ];
    let mut table = Table::new(format!("transient_{}", name.replace('.', "_")), &columns);
    table.rows.extend(trajectory.moments.iter().map(|m| {
        let Moment { time, step, input, h_c, h_min, x_h_min, p_c, p_max, x_p_max, effort, .. } = *m;
        let effort = [effort.newton_iterations as f64, effort.linear_iterations as f64];
        [&[time, step, input.radius, input.speed, input.load, h_c, h_min, x_h_min, p_c, p_max, x_p_max][..], &effort]
            .concat()
    }));
    table
}
