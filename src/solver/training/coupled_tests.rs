//! Tests of transient reduced models with inputs given step by step: they reproduce marches, return to stored states,
//! and report inputs outside the trained range.

use super::small::Made;
use super::trajectories_tests::{full, grid, reduced, trained, transient, under};
use super::{LocalBases, TrajectoryTraining, train_trajectories};
use crate::solver::full::transient::{
    Frame, Input, Inputs, Interpolation, Keep, Moment, Signal, TimeStep, Transient, march,
};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::transient::{CoupledError, CoupledMarch, ReducedMarch, TrajectoryModel};
use crate::solver::warning::Warning;
use std::sync::Arc;

const SINE: Signal = Signal::Harmonic { amplitude: 0.1, period: 0.5 };

fn model(cavitation: Cavitation, frame: Frame) -> Arc<TrajectoryModel> {
    model_with(cavitation, frame, None)
}

fn model_with(cavitation: Cavitation, frame: Frame, local: Option<LocalBases>) -> Arc<TrajectoryModel> {
    static MODELS: Made<TrajectoryModel> = Made::new();
    MODELS.of(&(cavitation, frame, local), || {
        let training = full(&under(cavitation, Transient { duration: 0.6, ..transient(frame, SINE) }));
        let settings = TrajectoryTraining { loss: 1e-5, local, ..TrajectoryTraining::default() };
        train_trajectories(&grid(), &[training], &settings, &()).unwrap()
    })
}

fn begun(model: &Arc<TrajectoryModel>) -> CoupledMarch {
    let start = &model.starts[0];
    let lubricant = model.domain.reference.lubricant;
    let own = Transient { lubricant, ..Transient::new(start.point, Inputs::default(), 1.0, 0.1) };
    CoupledMarch::begin(model, own.problem().unwrap(), start.inputs.at(0.0)).unwrap()
}

fn loads(count: usize) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| 1.0 + 0.08 * (0.06 * k as f64).sin())
}

fn at(load: f64) -> Input {
    Input { load, ..Input::REFERENCE }
}

fn same(a: &Moment, b: &Moment, within: f64) {
    for get in [|m: &Moment| m.h_c, |m: &Moment| m.h_min, |m: &Moment| m.p_c, |m: &Moment| m.p_max] {
        assert!((get(a) / get(b) - 1.0).abs() < within, "{a:?} against {b:?}");
    }
    assert!((a.time - b.time).abs() < 1e-12);
}

#[test]
fn led_step_by_step_it_gives_the_march_along_the_same_inputs() {
    let (step, count) = (0.005, 120);
    for (frame, cavitation) in [
        (Frame::Fixed, Cavitation::Penalty),
        (Frame::Fixed, Cavitation::Complementarity),
        (Frame::Remeshed(Interpolation::CubicSpline), Cavitation::Penalty),
    ] {
        let model = model(cavitation, frame);
        assert!((model.domain.step / step - 1.0).abs() < 1e-12);
        // Communication at every step, and at every fourth one.
        for every in [1, 4] {
            let told: Vec<f64> = loads(count / every).collect();
            let times = (0..=told.len()).map(|k| (k * every) as f64 * step).collect();
            let values = std::iter::once(1.0).chain(told.iter().copied()).collect();
            let load = Signal::Sampled { times, values };
            let wanted = Transient { duration: count as f64 * step, ..transient(frame, load) };
            let wanted = reduced(&model, &under(cavitation, wanted));
            assert!(wanted.finished());
            let mut led = begun(&model);
            same(led.moment(), &wanted.moments[0], 1e-14);
            for (k, load) in told.iter().enumerate() {
                let moment = *led.advance(every as f64 * step, at(*load)).unwrap();
                same(&moment, &wanted.moments[(k + 1) * every], 1e-12);
            }
        }
    }
}

#[test]
fn late_in_a_march_it_is_the_same_still() {
    // T of 40 is rounded to 7e-15, which is 7e-13 of a step.
    let (step, count) = (0.01, 4000);
    let model = model(Cavitation::Penalty, Frame::Fixed);
    let values: Vec<f64> = std::iter::once(1.0).chain(loads(count)).collect();
    let times = (0..=count).map(|k| k as f64 * step).collect();
    let load = Signal::Sampled { times, values: values.clone() };
    let own = Transient { duration: count as f64 * step, keep: Keep::Scalars, ..transient(Frame::Fixed, load) };
    let wanted = reduced(&model, &Transient { time_step: TimeStep::Fixed(step), ..own });
    let mut longer = (*model).clone();
    longer.domain.step = step;
    let mut led = begun(&Arc::new(longer));
    for (load, wanted) in values.iter().zip(&wanted.moments).skip(1) {
        let moment = led.advance(step, at(*load)).unwrap();
        assert!((moment.h_c / wanted.h_c - 1.0).abs() < 1e-12, "{moment:?} against {wanted:?}");
    }
}

#[test]
fn it_goes_back_to_a_state_and_on_from_there_to_the_last_bit() {
    let local = Some(LocalBases { clusters: 4, modes: 20 });
    for (frame, cavitation, local) in [
        (Frame::Fixed, Cavitation::Complementarity, None),
        (Frame::Fixed, Cavitation::Complementarity, local),
        (Frame::ArbitraryLagrangianEulerian, Cavitation::Penalty, local),
        (Frame::Remeshed(Interpolation::CubicSpline), Cavitation::Penalty, None),
        (Frame::Remeshed(Interpolation::CubicSpline), Cavitation::Penalty, local),
    ] {
        let model = model_with(cavitation, frame, local);
        let mut led = begun(&model);
        let go = |led: &mut CoupledMarch| -> Vec<Moment> {
            loads(30).map(|load| *led.advance(0.0123, at(load)).unwrap()).collect()
        };
        go(&mut led);
        let (state, fields) = (led.state().clone(), led.fields());
        let onwards = go(&mut led);
        let reference = *led.reference();
        led.restore(reference, &state).unwrap();
        assert_eq!((led.moment().time, led.fields()), (state.time(), fields));
        assert_eq!(go(&mut led), onwards);
        let mut other = CoupledMarch::resume(&model, reference, &state).unwrap();
        assert_eq!(go(&mut other), onwards);
    }
    let (fixed, moving) =
        (model(Cavitation::Penalty, Frame::Fixed), model(Cavitation::Penalty, Frame::Remeshed(Interpolation::Linear)));
    let mut led = begun(&fixed);
    let refused = led.restore(*begun(&fixed).reference(), begun(&moving).state());
    assert!(matches!(refused, Err(CoupledError::Foreign)));
}

#[test]
fn a_way_that_cannot_be_gone_leaves_it_where_it_was() {
    let model = model(Cavitation::Penalty, Frame::Fixed);
    let mut led = begun(&model);
    led.advance(0.02, at(1.05)).unwrap();
    let before = (*led.moment(), led.fields());
    for (span, load) in [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (1e6, 1.0), (0.01, -2.0), (0.01, f64::NAN)] {
        let refused = led.advance(span, at(load)).map(|_| ()).unwrap_err().to_string();
        assert!(!refused.is_empty() && (*led.moment(), led.fields()) == before, "{span}, {load}: {refused}");
    }
    // It continues as if nothing had been requested.
    let mut other = begun(&model);
    other.advance(0.02, at(1.05)).unwrap();
    assert_eq!(led.advance(0.01, at(1.0)).unwrap(), other.advance(0.01, at(1.0)).unwrap());
}

#[test]
fn the_approach_is_the_same_in_every_frame() {
    // With the kernel in lengths of the reference contact, for every frame.
    let approach = |led: &CoupledMarch| {
        let at = led.conditions();
        -led.separation() - at.scales.film * at.problem.load / std::f64::consts::PI * at.scales.half_width.ln()
    };
    let approaches = |frame: Frame| -> Vec<f64> {
        let mut led = begun(&model(Cavitation::Penalty, frame));
        let mut seen = vec![approach(&led)];
        seen.extend(loads(60).map(|load| {
            led.advance(0.005, at(load)).unwrap();
            approach(&led)
        }));
        seen
    };
    let fixed = approaches(Frame::Fixed);
    let moved = fixed.iter().fold(0.0f64, |most, own| most.max((own - fixed[0]).abs()));
    for frame in [Frame::ArbitraryLagrangianEulerian, Frame::Remeshed(Interpolation::CubicSpline)] {
        let other = approaches(frame);
        let off = fixed.iter().zip(&other).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(off < 0.01 * moved, "{frame:?}: {off:e} of {moved:e}");
    }
}

fn sentences(warnings: Vec<Warning>) -> Vec<String> {
    warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn what_leaves_the_training_is_told_by_quantity_and_time() {
    let (trainings, model) = trained(Cavitation::Penalty, Frame::Fixed);
    let domain = &model.domain;
    for training in &trainings {
        assert_eq!(domain.left_by(training), []);
    }
    let rates = [0.5f64, 1.0 / 3.0].map(|period| 0.1 * std::f64::consts::TAU / period);
    assert!((domain.load.rate / rates[1] - 1.0).abs() < 1e-3 && domain.load.rate > rates[0]);
    assert!(!domain.speed.varies() && domain.speed.range == (1.0, 1.0));
    let said = |inputs: Inputs| {
        let asked = Transient { inputs, duration: 0.1, ..transient(Frame::Fixed, Signal::Constant) };
        sentences(domain.left_by(&march(&mut ReducedMarch::new(&model, &asked).unwrap(), &asked, &()).unwrap()))
    };
    let fast = said(Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 0.2 }));
    assert!(fast.len() == 1 && fast[0].contains("the load changes by 3.1") && fast[0].contains("faster"), "{fast:?}");
    let far = said(Inputs::load(Signal::Sampled { times: vec![0.0, 0.1], values: vec![1.0, 1.15] }));
    assert!(far.len() == 1 && far[0].contains("1.15 times its reference") && far[0].contains("(T = 0.1"), "{far:?}");
    let quicker = Signal::Sampled { times: vec![0.0, 0.1], values: vec![1.0, 1.02] };
    let speed = said(Inputs { speed: quicker, ..Inputs::default() });
    assert!(speed.len() == 2 && speed.iter().all(|said| said.contains("was constant")), "{speed:?}");
    let other = Transient { duration: 0.05, ..transient(Frame::Fixed, Signal::Constant) };
    let other =
        Transient { point: crate::solver::physics::contact::OperatingPoint { load: 2.5e5, ..other.point }, ..other };
    let other = march(&mut ReducedMarch::new(&model, &other).unwrap(), &other, &()).unwrap();
    assert!(domain.left_by(&other)[0].to_string().starts_with("M = "), "{:?}", domain.left_by(&other));
    // Any other time history is outside the range of a single training, however slow and near.
    let single = self::model(Cavitation::Penalty, Frame::Fixed);
    let own = Transient { duration: 0.6, ..transient(Frame::Fixed, SINE) };
    let other = Signal::Harmonic { amplitude: 0.05, period: 0.5 };
    for (asked, strange) in [(own.clone(), false), (Transient { inputs: Inputs::load(other), ..own }, true)] {
        let said = sentences(single.domain.left_by(&reduced(&single, &asked)));
        assert_eq!(said.iter().any(|said| said.contains("of other courses")), strange, "{said:?}");
    }
    assert_eq!(domain.only, None);
}

#[test]
fn the_reference_of_a_load_is_the_trained_one_nearest_to_it() {
    let at_load = |load: f64| {
        let own = transient(Frame::Fixed, SINE);
        let point = crate::solver::physics::contact::OperatingPoint { load, ..own.point };
        full(&Transient { point, duration: 0.2, time_step: TimeStep::Fixed(0.01), keep: Keep::Every(1), ..own })
    };
    let trainings = [at_load(1.8e5), at_load(2.2e5)];
    let model = train_trajectories(&grid(), &trainings, &TrajectoryTraining::default(), &()).unwrap();
    for (load, wanted) in [(1e5, 1.8e5), (1.8e5, 1.8e5), (1.95e5, 1.95e5), (9e5, 2.2e5)] {
        assert_eq!(model.reference_for(load).unwrap().load, wanted);
    }
}
