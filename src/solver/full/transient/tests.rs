//! Tests of marches of the full system: comparison with an independent solution, convergence in the time step,
//! agreement of the frames, and early ends.

use super::*;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{FullSolver, Start};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::warning::Warning;
use std::sync::atomic::{AtomicUsize, Ordering};

const COARSE: GridSpec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
const MIDDLE: GridSpec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
const REMESHED: Frame = Frame::Remeshed(Interpolation::CubicSpline);
const ALL: (f64, f64) = (0.0, f64::INFINITY);
const FRAMES: [Frame; 3] = [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, REMESHED];

/// Case 1 of Table 4.1.
fn case_1(duration: f64, step: f64) -> Transient {
    let load = Signal::Harmonic { amplitude: 0.1, period: 1.0 / 3.0 };
    Transient::new(OperatingPoint::TABLE_4_2, Inputs::load(load), duration, step)
}

fn finished(spec: GridSpec, transient: &Transient) -> Trajectory {
    let trajectory = solve(spec, transient, &()).unwrap();
    assert!(trajectory.finished(), "{}", trajectory.ended.describe());
    trajectory
}

#[test]
fn table_2_1_breathes_as_the_independent_solution_does() {
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 });
    let transient = Transient::new(OperatingPoint::TABLE_2_1, load, 8.0, 0.02);
    let trajectory = finished(GridSpec::DISSERTATION, &transient);
    let window = (4.0, 8.0);
    for (quantity, mean, amplitude) in [
        (Quantity::CentralFilm, 0.040049385794635184, 0.001997365278354535),
        (Quantity::CentralPressure, 0.9958219462821398, 0.05263676890607921),
        (Quantity::MinimumFilm, 0.035264178115314564, 0.0018756215150153716),
    ] {
        let seen = (trajectory.mean(quantity, window).unwrap(), trajectory.amplitude(quantity, window).unwrap());
        assert!(
            (seen.0 / mean - 1.0).abs() < 1e-3 && (seen.1 / amplitude - 1.0).abs() < 1e-3,
            "{quantity:?}: {seen:?}"
        );
    }
}

#[test]
fn the_time_step_is_of_second_order() {
    let [coarse, middle, fine] = [300.0, 600.0, 1200.0].map(|steps| finished(COARSE, &case_1(1.2, 1.0 / steps)));
    for quantity in [Quantity::CentralFilm, Quantity::CentralPressure] {
        let (far, near) =
            (coarse.difference(&middle, quantity, ALL).unwrap().1, middle.difference(&fine, quantity, ALL).unwrap().1);
        let order = (far / near).log2();
        assert!((1.7..2.3).contains(&order), "{quantity:?}: order {order} ({far:e}, {near:e})");
    }
}

#[test]
fn what_flows_in_and_not_out_is_stored() {
    for frame in FRAMES {
        let defect = |spec, step| {
            let transient = Transient { frame, keep: Keep::Every(1), ..case_1(0.4, step) };
            finished(spec, &transient).mass_balance((-1.0, 0.0)).unwrap().defect()
        };
        let (coarse, fine) = (defect(COARSE, 1.0 / 150.0), defect(MIDDLE, 1.0 / 300.0));
        assert!(fine < 2e-2 && coarse / fine > 3.0, "{frame:?}: {coarse:e}, then {fine:e}");
    }
}

#[test]
fn the_frames_agree() {
    let case_2 = Transient {
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.5, period: 0.5 }),
        ..case_1(0.5, 1.0 / 400.0)
    };
    // One period of each; the scenes of Figure 4.4 use several.
    for (transient, bar) in [(case_1(0.35, 1.0 / 400.0), 2e-3), (case_2, 5e-3)] {
        let fixed = finished(MIDDLE, &transient);
        for frame in [Frame::ArbitraryLagrangianEulerian, REMESHED] {
            let other = finished(MIDDLE, &Transient { frame, ..transient.clone() });
            let (greatest, _) = other.difference(&fixed, Quantity::CentralFilm, ALL).unwrap();
            assert!(greatest < bar, "{frame:?}: {greatest}");
        }
    }
}

#[test]
fn radius_and_speed_vary_alike_in_all_frames() {
    let transient =
        Transient { inputs: Inputs::all(Signal::Harmonic { amplitude: 0.1, period: 1.0 }), ..case_1(1.0, 0.01) };
    let fixed = finished(MIDDLE, &transient);
    for frame in [Frame::ArbitraryLagrangianEulerian, REMESHED] {
        let other = finished(MIDDLE, &Transient { frame, ..transient.clone() });
        let (greatest, _) = other.difference(&fixed, Quantity::CentralFilm, ALL).unwrap();
        assert!(greatest < 2e-3, "{frame:?}: {greatest}");
    }
}

#[test]
fn constant_inputs_keep_the_stationary_contact() {
    // Also for constant values other than the reference.
    let rest = |value| Signal::Sampled { times: vec![0.0], values: vec![value] };
    let others = Inputs { radius: rest(1.2), speed: rest(0.8), load: rest(1.5) };
    for inputs in [Inputs::default(), others] {
        let at = inputs.at(0.0);
        let point = point_at(&OperatingPoint::TABLE_4_2, at);
        let want = FullSolver::new(MIDDLE).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        // The scales of the contact differ from those of the reference.
        let (film, pressure) = (at.load * want.scalars.h_c, (at.load / at.radius).sqrt() * want.scalars.p_c);
        for frame in FRAMES {
            let trajectory = finished(MIDDLE, &Transient { frame, inputs: inputs.clone(), ..case_1(0.05, 0.01) });
            for moment in &trajectory.moments {
                // The fixed frame resolves a contact of another size with another number of nodes.
                let bar = if frame == Frame::Fixed && at.load != 1.0 { 5e-3 } else { 1e-7 };
                assert!((moment.h_c / film - 1.0).abs() < bar, "{frame:?}: {} against {film}", moment.h_c);
                assert!((moment.p_c / pressure - 1.0).abs() < bar, "{frame:?}");
            }
            let drift = trajectory.moments.last().unwrap().h_c / trajectory.moments[0].h_c - 1.0;
            assert!(drift.abs() < 1e-7, "{frame:?}: {drift}");
        }
    }
}

#[test]
fn adaptive_steps_find_what_fixed_ones_do_with_fewer() {
    let wave = Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s: 0.9 };
    let fixed = Transient { inputs: Inputs::load(wave), ..case_1(0.5, 1.0 / 1000.0) };
    let adaptive = Transient { time_step: TimeStep::Adaptive { tolerance: 2e-3, longest: 0.01 }, ..fixed.clone() };
    let (fixed, adaptive) = (finished(COARSE, &fixed), finished(COARSE, &adaptive));
    let (_, l2) = adaptive.difference(&fixed, Quantity::CentralFilm, ALL).unwrap();
    assert!(l2 < 2e-3, "{l2}");
    let steps = adaptive.moments.windows(2).map(|pair| pair[1].time - pair[0].time);
    let (shortest, longest) = steps.fold((f64::INFINITY, 0.0f64), |(a, b), step| (a.min(step), b.max(step)));
    assert!(shortest < 0.3 * longest && adaptive.moments.len() < 300, "{}", adaptive.moments.len());
    assert_eq!(adaptive.moments.last().unwrap().time, 0.5);
}

#[test]
fn what_was_computed_before_an_end_is_kept() {
    struct Until(AtomicUsize);
    impl Observer for Until {
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed) == 0
        }
    }
    impl TransientObserver for Until {
        fn moment(&self, _: &Moment) {
            self.0.fetch_sub(1, Ordering::Relaxed);
        }
    }
    let transient = Transient { keep: Keep::Every(2), ..case_1(0.5, 0.01) };
    let trajectory = solve(COARSE, &transient, &Until(AtomicUsize::new(6))).unwrap();
    assert_eq!((trajectory.moments.len(), trajectory.states.len()), (6, 3));
    assert_eq!(trajectory.ended, Ended::Cancelled { time: trajectory.moments[5].time });

    // A load that leads to a contact outside the accepted range.
    let jump = Signal::Sampled { times: vec![0.0, 0.1, 0.1001], values: vec![1.0, 1.0, 1e-9] };
    let trajectory = solve(COARSE, &Transient { inputs: Inputs::load(jump), ..case_1(0.5, 0.01) }, &()).unwrap();
    let sentence = trajectory.ended.describe();
    assert!(sentence.contains("T = 0.11") && sentence.contains("kept"), "{sentence}");
    assert_eq!(trajectory.moments.len(), 11);
}

/// Load that changes by a factor within 0.01 from T = 0.1 on.
fn jump(factor: f64) -> Inputs {
    Inputs::load(Signal::Sampled { times: vec![0.0, 0.1, 0.11], values: vec![1.0, 1.0, factor] })
}

#[test]
fn a_fixed_step_that_newton_cannot_take_is_taken_in_parts() {
    let coarse = Transient { inputs: jump(4.0), ..case_1(0.4, 0.05) };
    let trajectory = finished(COARSE, &coarse);
    assert!(trajectory.rejected_steps > 0 && trajectory.moments.len() == 9, "{}", trajectory.rejected_steps);
    for (k, moment) in trajectory.moments.iter().enumerate().skip(1) {
        assert!((moment.time - 0.05 * k as f64).abs() < 1e-12 && (moment.step - 0.05).abs() < 1e-12, "{}", moment.time);
    }
    let fine = finished(COARSE, &Transient { time_step: TimeStep::Fixed(0.001), ..coarse });
    assert_eq!(fine.rejected_steps, 0);
    let (greatest, _) = trajectory.difference(&fine, Quantity::CentralFilm, ALL).unwrap();
    assert!(greatest < 1e-3, "{greatest:e}");
}

#[test]
fn a_step_that_no_part_of_can_be_taken_ends_the_march() {
    let trajectory = solve(COARSE, &Transient { inputs: jump(10.0), ..case_1(0.5, 0.01) }, &()).unwrap();
    let Ended::StepRefused { time, step, .. } = trajectory.ended else { panic!("{:?}", trajectory.ended) };
    assert!(time > 0.1 && time < 0.12 && step < 0.01 / 32.0, "{time}, {step}");
    let sentence = trajectory.ended.describe();
    assert!(sentence.contains("could not take the step") && sentence.contains("kept"), "{sentence}");
    assert_eq!(trajectory.moments.len(), 11);
}

#[test]
fn stopped_marches_report_the_error_so_far() {
    let fall = Signal::Sampled { times: vec![0.0, 0.1, 0.1001], values: vec![1.0, 1.0, 1e-9] };
    let time_step = TimeStep::Controlled(0.02);
    let transient = Transient { inputs: Inputs::load(fall), time_step, ..case_1(0.5, 0.01) };
    let mut model = FullMarch::new(COARSE.line().unwrap(), &transient).unwrap();
    let mut trajectory = march(&mut model, &transient, &()).unwrap();
    assert!(!trajectory.finished() && trajectory.step_error.is_none(), "{:?}", trajectory.ended);
    let Some(Warning::MarchStopped { reached, ended }) = trajectory.stopped() else { panic!() };
    assert_eq!((reached, &ended), (trajectory.reached(), &trajectory.ended));
    trajectory.estimate_step_error(&mut model, &());
    assert!(trajectory.step_error.is_some_and(|error| error < 0.02), "{:?}", trajectory.step_error);
}

#[test]
fn questions_without_sense_are_refused() {
    let message = |transient: Transient| solve(COARSE, &transient, &()).unwrap_err().to_string();
    assert!(message(case_1(0.0, 0.01)).starts_with("the duration is 0"));
    assert!(message(case_1(1.0, f64::NAN)).starts_with("the time step is NaN"));
    assert!(message(case_1(1.0, 2.0)).contains("duration 1"));
    assert!(message(case_1(1.0, 1e-9)).contains("time step"));
    let deep = Signal::Harmonic { amplitude: 1.5, period: 1.0 };
    assert!(message(Transient { inputs: Inputs::load(deep), ..case_1(1.0, 0.01) }).starts_with("the load falls"));
    let thinning = Lubricant {
        shear: ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 },
        ..Lubricant::default()
    };
    assert!(message(Transient { lubricant: thinning, ..case_1(1.0, 0.01) }).contains("shear-thinning"));
}
