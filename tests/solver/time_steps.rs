//! Time-step error of a march: estimated compared with marches with steps eight times shorter, and controlled by a
//! tolerance, with the full system and the embedded reduced model. The ordinary run has six random marches, a run with
//! `EHL_LONG` in the environment 50.

use crate::common::cases::cases;
use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::{Bench, ModelSource};
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::transient::{
    FullMarch, Inputs, Marching, Quantity, Signal, TimeStep, Trajectory, Transient, march,
};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::reduced::transient::ReducedMarch;
use ehl_explorer::solver::warning::Warning;
use fastrand::Rng;

const GRID: GridSpec = GridSpec::Uniform { dx: 0.04, domain: (-4.0, 1.5) };
const DURATION: f64 = 2.0;
/// A larger error of H_c needs a warning.
const NOTABLE: f64 = 0.03;

/// Returns a harmonic, a steep or a tabulated function of time.
fn signal(kind: usize, rng: &mut Rng) -> Signal {
    let (amplitude, period) = (0.05 + 0.25 * rng.f64(), 0.2 * 20f64.powf(rng.f64()));
    match kind {
        0 => Signal::Harmonic { amplitude, period },
        1 => Signal::TriangleToSquare { amplitude, period: period.max(0.5), s: 0.9 * rng.f64() },
        _ => {
            let times: Vec<f64> = (0..8).map(|k| 0.35 * f64::from(k)).collect();
            let values = times.iter().map(|_| 1.0 + amplitude * (2.0 * rng.f64() - 1.0)).collect();
            Signal::Sampled { times, values }
        }
    }
}

fn marched(transient: &Transient) -> (FullMarch, Trajectory) {
    let mut model = FullMarch::new(GRID.line().unwrap(), transient).unwrap();
    let trajectory = march(&mut model, transient, &()).unwrap();
    assert!(trajectory.finished(), "{}", trajectory.ended.describe());
    (model, trajectory)
}

/// Returns the largest relative difference of H_c from a march with equal steps.
fn true_error(trajectory: &Trajectory, model: &mut dyn Marching, step: f64) -> f64 {
    let fine = Transient { time_step: TimeStep::Fixed(step), ..trajectory.transient.clone() };
    let fine = march(model, &fine, &()).unwrap();
    assert!(fine.finished());
    trajectory.difference(&fine, Quantity::CentralFilm, (0.0, DURATION)).unwrap().0
}

#[test]
fn the_error_of_equal_steps_is_estimated_within_a_factor_of_two() {
    let (count, mut rng) = (cases(6, 50), Rng::with_seed(10));
    let (mut wrong, mut silent) = (Vec::new(), Vec::new());
    for k in 0..count {
        let varied = signal(k % 3, &mut rng);
        let inputs = if rng.bool() { Inputs::load(varied) } else { Inputs { speed: varied, ..Inputs::default() } };
        let step = DURATION / (DURATION / (0.004 * 30f64.powf(rng.f64()))).round();
        let transient = Transient::new(OperatingPoint::TABLE_2_1, inputs, DURATION, step);
        let (mut model, mut trajectory) = marched(&transient);
        trajectory.estimate_step_error(&mut model, &());
        let (estimate, error) = (trajectory.step_error.unwrap(), true_error(&trajectory, &mut model, step / 8.0));
        println!("step {step:.4}: error {error:.2e}, estimated {estimate:.2e}; {:?}", transient.inputs);
        let told = matches!(trajectory.step_warning(), Some(Warning::TimeStepError { .. }));
        assert_eq!(told, estimate > NOTABLE);
        if error > 2.0 * estimate {
            wrong.push((error, estimate));
        }
        if (error > 2.0 * NOTABLE && !told) || (error < 0.5 * NOTABLE && told) {
            silent.push((error, estimate));
        }
    }
    assert!(20 * wrong.len() <= count, "true errors above twice the estimate: {wrong:?}");
    assert!(silent.is_empty(), "wrong or missing warnings: {silent:?}");
}

#[test]
fn coarse_steps_are_warned_of_and_rest_has_no_error() {
    let swinging = Inputs::load(Signal::Harmonic { amplitude: 0.15, period: 0.25 });
    let of = |inputs: Inputs| {
        let transient = Transient::new(OperatingPoint::TABLE_2_1, inputs, 1.0, 0.05);
        let (mut model, mut trajectory) = marched(&transient);
        trajectory.estimate_step_error(&mut model, &());
        trajectory
    };
    let warning = of(swinging).step_warning().unwrap().to_string();
    assert!(warning.contains("the time-step error of H_c"), "{warning}");
    let rests = of(Inputs::default());
    assert!(rests.step_error.unwrap() < 1e-6 && rests.step_warning().is_none());
}

#[test]
fn controlled_steps_keep_the_tolerance_in_full_and_reduced() {
    let tolerance = 0.01;
    let steep = Inputs::load(Signal::TriangleToSquare { amplitude: 0.1, period: 1.0, s: 0.5 });
    let equal = Transient::new(OperatingPoint::TABLE_2_1, steep, DURATION, 0.0025);
    let asked = Transient { time_step: TimeStep::Controlled(tolerance), ..equal.clone() };
    let (mut model, trajectory) = marched(&asked);
    let judge = |trajectory: &Trajectory, error: f64, what: &str| {
        let steps = trajectory.moments.len() - 1;
        let estimate = trajectory.step_error.unwrap();
        println!("{what}: {steps} steps, error {error:.2e}, estimated {estimate:.2e}");
        assert!(trajectory.finished() && trajectory.moments.last().unwrap().time == DURATION);
        assert_eq!(
            trajectory.transient.time_step,
            TimeStep::Controlled(tolerance),
            "the answer is that of the request"
        );
        assert!(estimate <= tolerance && error <= 2.0 * estimate, "{what}: {error} against {estimate}");
        assert!((20..800).contains(&steps) && trajectory.step_warning().is_none(), "{what}: {steps} steps");
    };
    judge(&trajectory, true_error(&trajectory, &mut model, 0.001), "full");

    let reduced = Workbench::default().trajectory_model(&ModelSource::Embedded, ContactKind::Line, &()).unwrap();
    let mut model = ReducedMarch::new(&reduced, &asked).unwrap();
    let trajectory = march(&mut model, &asked, &()).unwrap();
    let error = true_error(&trajectory, &mut model, 0.001);
    judge(&trajectory, error, "reduced");
}

#[test]
fn controlled_steps_resolve_inputs_of_their_own_period() {
    let quick = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 0.1 });
    let equal = Transient::new(OperatingPoint::TABLE_2_1, quick, DURATION, 0.01);
    let (mut model, trajectory) = marched(&Transient { time_step: TimeStep::Controlled(0.02), ..equal });
    let (estimate, error) = (trajectory.step_error.unwrap(), true_error(&trajectory, &mut model, 0.001));
    println!("{} steps, error {error:.2e}, estimated {estimate:.2e}", trajectory.moments.len() - 1);
    assert!(trajectory.moments.len() > 200 && estimate <= 0.02 && error <= 2.0 * estimate, "{error} {estimate}");
}

#[test]
fn a_tolerance_without_sense_is_refused() {
    let equal = Transient::new(OperatingPoint::TABLE_2_1, Inputs::default(), DURATION, 0.01);
    for tolerance in [0.0, -1.0, 1e-6, 0.5, f64::NAN, f64::INFINITY] {
        let refused = Transient { time_step: TimeStep::Controlled(tolerance), ..equal.clone() }.check().unwrap_err();
        assert!(refused.to_string().contains("must be between 1e-5 and 0.3"), "{refused}");
    }
}
