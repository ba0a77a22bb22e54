//! Export of the transient contact: the time series of all runs, and their profiles at the displayed time.

use super::runs::TransientRuns;
use crate::app::document::features::{FeatureKind, place_of, sizes_of};
use crate::app::tabs::transient::{Run, Setup, method};
use crate::app::{export, numbers};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::transient::{Inputs, Signal};
use crate::solver::physics::engineering::UnitSystem;

/// Block of columns: its name and its rows.
type Block = (String, Vec<Vec<Option<f64>>>);

/// Returns all time steps of every run with dimensionless and SI values, each run in separate columns. `None`
/// without a set-up.
pub fn series(view: &TransientRuns) -> Option<String> {
    const COLUMNS: [&str; 15] = [
        "T", "radius", "speed", "load", "H_c", "H_min", "X_H_min", "P_c", "P_max", "X_P_max", "t_s", "h_c_m",
        "h_min_m", "p_c_pa", "p_max_pa",
    ];
    let setup = view.setup.as_ref()?;
    let (seconds, film, pressure) = (setup.time_scale_s(), setup.point.film_scale_m(), setup.point.hertz().pressure_pa);
    let blocks = view.runs.iter().map(|run| {
        let rows = run.trajectory.moments.iter().map(|m| {
            let inputs = [m.time, m.input.radius, m.input.speed, m.input.load];
            let own = [m.h_c, m.h_min, m.x_h_min, m.p_c, m.p_max, m.x_p_max];
            let si = [m.time * seconds, m.h_c * film, m.h_min * film, m.p_c * pressure, m.p_max * pressure];
            inputs.into_iter().chain(own).chain(si).map(Some).collect()
        });
        (name(run), rows.collect())
    });
    let estimated = view.runs.iter().filter_map(|run| Some((run, run.trajectory.step_error?)));
    let errors: Vec<String> =
        estimated.map(|(run, error)| format!("{}: time-step error of H_c about {error:.1e}", name(run))).collect();
    Some(table(setup, &errors, &COLUMNS, blocks.collect()))
}

/// Returns P and H of every run at the displayed time, in the scales of the reference contact and in SI units.
/// `None` without a set-up.
pub fn profiles(view: &TransientRuns) -> Option<String> {
    const COLUMNS: [&str; 6] = ["X", "P", "H", "x_m", "p_pa", "h_m"];
    let setup = view.setup.as_ref()?;
    let (hertz, film) = (setup.point.hertz(), setup.point.film_scale_m());
    let mut comments = Vec::new();
    let blocks = view.runs.iter().filter_map(|run| {
        let state = run.state_at(view.player.time())?;
        let seconds = state.time * setup.time_scale_s();
        comments.push(format!("{} at T {:e}; t {seconds:e} s", name(run), state.time));
        let rows = run
            .profile(state)
            .map(|(x, p, h)| [x, p, h, x * hertz.half_width_m, p * hertz.pressure_pa, h * film].map(Some).to_vec());
        Some((name(run), rows.collect()))
    });
    let blocks: Vec<Block> = blocks.collect();
    Some(table(setup, &comments, &COLUMNS, blocks))
}

fn name(run: &Run) -> String {
    format!("{}.{}", method::word(run.by), run.frame().name())
}

fn table(setup: &Setup, more: &[String], columns: &[&str], blocks: Vec<Block>) -> String {
    let mut comments = describe(setup);
    comments.extend_from_slice(more);
    let header: Vec<String> =
        blocks.iter().flat_map(|(name, _)| columns.iter().map(move |column| format!("{name}.{column}"))).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let length = blocks.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
    let row = |k: usize| {
        blocks
            .iter()
            .flat_map(|(_, rows)| rows.get(k).cloned().unwrap_or_else(|| vec![None; columns.len()]))
            .collect::<Vec<_>>()
    };
    export::csv(&comments, &header, (0..length).map(row))
}

/// Returns a description of the inputs that vary.
pub fn inputs(setup: &Setup) -> String {
    let percent = |share: f64| numbers::quantity(100.0 * share, "%");
    let number = |value: f64| numbers::digits(value, 3);
    let words = |signal: &Signal| match signal {
        Signal::Constant => None,
        Signal::Harmonic { amplitude, period } => {
            Some(format!("harmonic, amplitude {}, period {}", percent(*amplitude), number(*period)))
        }
        Signal::TwoScale { amplitudes: (a, b), periods: (long, short) } => Some(format!(
            "two harmonics, amplitudes {} and {}, periods {} and {}",
            percent(*a),
            percent(*b),
            number(*long),
            number(*short)
        )),
        Signal::Reversing { amplitude, period } => {
            Some(format!("reversing, amplitude {}, period {}", percent(*amplitude), number(*period)))
        }
        Signal::TriangleToSquare { amplitude, period, s } => Some(format!(
            "between a triangle and a square wave (s {}), amplitude {}, period {}",
            number(*s),
            percent(*amplitude),
            number(*period)
        )),
        Signal::Sampled { times, .. } => Some(format!("by {} given values", times.len())),
    };
    let Inputs { radius, speed, load } = &setup.study.inputs;
    let varied = [("load", load), ("speed", speed), ("radius", radius)];
    let varied = varied.into_iter().filter_map(|(name, signal)| Some(format!("{name} {}", words(signal)?)));
    varied
        .chain(features(setup))
        .chain([format!("T up to {}", number(setup.study.duration))])
        .collect::<Vec<_>>()
        .join("; ")
}

/// Returns the set-up as lines above a table.
pub fn describe(setup: &Setup) -> Vec<String> {
    let Inputs { radius, speed, load } = &setup.study.inputs;
    let grid = match setup.grid.spec_for(setup.point.kind) {
        Some(GridSpec::Uniform { dx, domain }) => format!("uniform grid of {dx} over {domain:?}"),
        Some(GridSpec::Graded { nodes, domain, .. }) => format!("{nodes} graded nodes over {domain:?}"),
        Some(GridSpec::Plane(spec)) => format!("spacings of {} and {} over {:?}", spec.dx, spec.dy, spec.domain),
        Some(GridSpec::Following { domain, .. }) => format!("nodes that follow the film over {domain:?}"),
        None => "the reduced model's grid".to_owned(),
    };
    let described = |signal: &Signal| match signal {
        Signal::Sampled { times, .. } => format!("{} given values", times.len()),
        other => format!("{other:?}"),
    };
    let mut lines = vec![
        export::describe_contact(&setup.point, &setup.lubricant),
        format!("radius {}; speed {}; load {}", described(radius), described(speed), described(load)),
        format!("duration {}; time step {:?}; {grid}", setup.study.duration, setup.study.time_step),
    ];
    lines.extend(features(setup));
    lines
}

/// Returns a description of each feature of the surfaces.
fn features(setup: &Setup) -> impl Iterator<Item = String> {
    let srr = setup.point.sliding.slide_to_roll_ratio;
    let length_of = |metre: f64| numbers::length(metre, UnitSystem::default());
    setup.study.surfaces.iter().map(move |feature| {
        let kind = FeatureKind::of(&feature.shape).words().0.to_lowercase();
        let (mut shape, mut sizes) = (feature.shape.clone(), String::new());
        if let Some((height, length)) = sizes_of(&mut shape) {
            sizes = format!(" of {} over {}", length_of(*height), length_of(*length));
        }
        let from = place_of(&mut shape).map_or(String::new(), |at| format!(" from X {}", numbers::digits(*at, 3)));
        format!("{kind}{sizes}{from} on body {}, speed {} u_m", feature.body, numbers::digits(feature.speed(srr), 3))
    })
}
