//! Tests: linearised systems compared with finite differences, steps with Newton's, marches with the full system.

use super::linearisation::{Fields, PENALTY_SLOPE};
use super::superposition::Superposition;
use super::*;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, GridSpec};
use crate::solver::full::Problem;
use crate::solver::full::transient::{
    self, BackwardDifference, Frame, Input, Inputs, Keep, Quantity, Signal, Trajectory, Transient,
};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::dense::SmallSystem;
use faer::linalg::solvers::Solve;
use std::sync::LazyLock;

const COARSE: GridSpec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
const STEP_SELECTION: Selection = Selection::Step { tolerance: 1e-3 };

const CASE_1: OperatingPoint = OperatingPoint::TABLE_4_5;

fn transient(point: OperatingPoint, inputs: Inputs, duration: f64) -> Transient {
    Transient::new(point, inputs, duration, 1.0 / 200.0)
}

fn full(transient: &Transient) -> Trajectory {
    let trajectory = transient::solve(COARSE, transient, &()).unwrap();
    assert!(trajectory.finished(), "{}", trajectory.ended.describe());
    trajectory
}

fn training(transient: Transient) -> Trajectory {
    full(&Transient { keep: Keep::Every(1), ..transient })
}

fn sine(period: f64) -> Signal {
    Signal::Harmonic { amplitude: 0.1, period }
}

fn wave(s: f64) -> Signal {
    Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s }
}

/// (4.32).
static SINE: LazyLock<Trajectory> = LazyLock::new(|| training(transient(CASE_1, Inputs::load(sine(0.5)), 1.0)));

static MODEL: LazyLock<TpwlModel> = LazyLock::new(|| model(&[&SINE], 100, STEP_SELECTION));

fn model(trajectories: &[&Trajectory], modes: usize, selection: Selection) -> TpwlModel {
    TpwlModel::train(trajectories, TpwlTraining { modes, selection }).unwrap()
}

/// Returns the relative L2 difference of H_c between a model's march and the full one.
fn film_error(model: &TpwlModel, transient: &Transient, weighting: Weighting) -> f64 {
    let (got, record) = solve(model, transient, weighting, &()).unwrap();
    assert!(got.finished(), "{}", got.ended.describe());
    assert_eq!(record.steps().len(), got.moments.len());
    got.difference(&full(transient), Quantity::CentralFilm, (0.0, transient.duration)).unwrap().1
}

#[test]
fn linearised_systems_agree_with_finite_differences() {
    let model = &*MODEL;
    let (space, problem) = (&model.space, &model.sets[0].problem);
    let base = Input { radius: 1.05, speed: 0.95, load: 1.02 };
    let moment = &model.points[model.points.len() / 2].moment;
    let film = space.film(&moment.pressure, moment.state[space.modes()], base);
    let exact = Linearisation::at(space, problem, Fields { pressure: &moment.pressure, film: &film, input: base });
    // g and f with the penalty slope, at the fields plus a multiple of others.
    let beside = |(p, h): (&dyn Fn(usize) -> f64, &dyn Fn(usize) -> f64), input: Input, by: f64| {
        let plus = |values: &[f64], more: &dyn Fn(usize) -> f64| -> Vec<f64> {
            values.iter().enumerate().map(|(i, value)| value + by * more(i)).collect()
        };
        let (pressure, film) = (plus(&moment.pressure, p), plus(&film, h));
        SystemFunctions::at(space, problem, Fields { pressure: &pressure, film: &film, input }, PENALTY_SLOPE)
    };
    // At the cavitation boundary the penalty has a kink: a step must stay on one side of it.
    let step = 1e-7;
    let compare = |name: &str, exact: (Vec<f64>, Vec<f64>), at: &dyn Fn(f64) -> SystemFunctions| {
        let (more, less) = (at(step), at(-step));
        for (exact, more, less) in [(exact.0, more.storage, less.storage), (exact.1, more.flux, less.flux)] {
            let scale = exact.iter().fold(1e-3f64, |a, b| a.max(b.abs()));
            for (i, exact) in exact.iter().enumerate() {
                let difference = (more[i] - less[i]) / (2.0 * step);
                assert!((difference - exact).abs() < 2e-5 * scale, "{name}, row {i}: {difference:e} against {exact:e}");
            }
        }
    };
    let column = |of: &faer::Mat<f64>, j: usize| of.col(j).iter().copied().collect::<Vec<f64>>();
    for j in [0, 1, 7, 40, space.modes()] {
        let mode = |of: &faer::Mat<f64>, i: usize, h_0: f64| if j < space.modes() { of[(i, j)] } else { h_0 };
        let fields = (&|i: usize| mode(&space.pressure, i, 0.0), &|i: usize| mode(&space.deformation, i, 1.0));
        let exact = (column(&exact.storage.by_state, j), column(&exact.flux.by_state, j));
        compare(&format!("state {j}"), exact, &|by| beside((fields.0, fields.1), base, by));
    }
    for (j, name) in ["curvature", "speed", "load"].into_iter().enumerate() {
        let still = |_: usize| 0.0;
        let shape = |i: usize| if j == 0 { 0.5 * space.grid.place(i).0.powi(2) } else { 0.0 };
        compare(name, (column(&exact.storage.by_input, j), column(&exact.flux.by_input, j)), &|by| {
            let moved = match j {
                0 => base,
                1 => Input { speed: base.speed + by, ..base },
                _ => Input { load: base.load + by, ..base },
            };
            beside((&still, &shape), moved, by)
        });
    }
    let load = problem.point.load;
    let heavier = |by: f64| {
        let point = OperatingPoint { load: load + 1e4 * by, ..problem.point };
        Problem::new(&point, problem.lubricant).unwrap()
    };
    let (low, high) = (heavier(-1.0), heavier(1.0));
    let point = &model.points[model.points.len() / 2];
    let at = |problem| point.moment.functions(space, problem);
    for (slope, (low, high)) in [
        (&point.load_slope.storage, (at(&low).storage, at(&high).storage)),
        (&point.load_slope.flux, (at(&low).flux, at(&high).flux)),
    ] {
        let scale = slope.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for ((slope, low), high) in slope.iter().zip(&low).zip(&high) {
            assert!(((high - low) / 2e4 - slope).abs() < 0.02 * scale, "{slope:e}");
        }
    }
}

#[test]
fn a_step_about_an_operating_point_is_the_reduced_newton_step() {
    let model = &*MODEL;
    let number = model.points.len() / 3;
    let point = &model.points[number];
    let len = model.space.len();
    let quotient = BackwardDifference::second_order(0.005, 0.004);
    let former: Vec<f64> =
        point.system.storage.value.iter().enumerate().map(|(i, g)| g + 1e-4 * (i as f64).sin()).collect();
    let input = Input { load: point.moment.input.load + 0.01, ..point.moment.input };
    // Newton's method from the point with the new input, also linearised in the input.
    let Linearisation { storage: g, flux: f } = &point.system;
    let change = faer::Col::from_fn(INPUTS, |k| input_vector(input)[k] - point.input[k]);
    let matrix = &g.by_state * faer::Scale(quotient.now) - &f.by_state;
    let by_input = &f.by_input * &change - &g.by_input * &change * faer::Scale(quotient.now);
    let rhs = faer::Col::from_fn(len, |i| f.value[i] - quotient.of([g.value[i], former[i], former[i]]) + by_input[i]);
    let newton = matrix.partial_piv_lu().solve(&rhs);
    for weighting in [Weighting::DualTaylor, Weighting::Dissertation] {
        let mut superposition = Superposition::new(weighting, len, 1);
        superposition.weights.push(Weight { point: number, weight: 1.0 });
        superposition.assemble(model, model.sets[0].problem.point.load);
        let (mut state, mut reached) = (vec![0.0; len], vec![0.0; len]);
        let history = quotient.former.map(|weight| (weight, former.as_slice()));
        let mut system = SmallSystem::new(len);
        let solved =
            superposition.solve((quotient.now, history), input_vector(input), &mut system, (&mut state, &mut reached));
        assert!(solved);
        let scale = newton.norm_l2();
        for i in 0..len {
            let taken = state[i] - point.moment.state[i];
            assert!((taken - newton[i]).abs() < 1e-7 * scale, "{weighting:?}, {i}: {taken:e} against {:e}", newton[i]);
        }
    }
}

#[test]
fn constant_inputs_stay_at_rest() {
    let still = transient(CASE_1, Inputs::default(), 0.2);
    for weighting in [Weighting::DualTaylor, Weighting::Dissertation] {
        let (trajectory, record) = solve(&MODEL, &still, weighting, &()).unwrap();
        assert!(trajectory.finished());
        let start = trajectory.moments[0].h_c;
        assert!((start / SINE.moments[0].h_c - 1.0).abs() < 1e-4, "{start}");
        for (k, moment) in trajectory.moments.iter().enumerate() {
            assert!((moment.h_c / start - 1.0).abs() < 1e-8, "{weighting:?}: {}", moment.h_c / start - 1.0);
            let weights = record.weights(k);
            let total: f64 = weights.iter().map(|w| w.weight).sum();
            assert!((total - 1.0).abs() < 1e-12 && weights.iter().all(|w| w.weight >= 0.0));
            assert_eq!(record.state(k).len(), MODEL.space.len());
        }
    }
}

#[test]
fn case_1_of_table_4_5_is_reproduced_and_other_loads_are_met() {
    assert!(MODEL.points.len() <= 120, "{} points", MODEL.points.len());
    for (name, signal, bar) in [
        ("sine", sine(0.5), 1e-4),
        ("triangle", wave(0.0), 1.5e-3),
        ("s = 0.5", wave(0.5), 3e-3),
        ("s = 0.9", wave(0.9), 1e-2),
    ] {
        let transient = transient(CASE_1, Inputs::load(signal), 1.0);
        let [dual, dissertation] =
            [Weighting::DualTaylor, Weighting::Dissertation].map(|weighting| film_error(&MODEL, &transient, weighting));
        assert!(dual < bar, "{name}: {dual:e}");
        assert!(dissertation < 10.0 * bar, "{name}: {dissertation:e}");
    }
}

#[test]
fn complementarity_training_is_as_accurate_as_the_penalty() {
    // Without the conversion of the multiplier to a pressure, H_c would have an error of 2e-2.
    let held = |transient: Transient| Transient {
        lubricant: Lubricant { cavitation: Cavitation::Complementarity, ..transient.lubricant },
        ..transient
    };
    let sine_held = training(held(SINE.transient.clone()));
    let model = model(&[&sine_held], 100, STEP_SELECTION);
    for (load, bound) in [(sine(0.5), 1e-4), (wave(0.0), 2e-3)] {
        let other = held(transient(CASE_1, Inputs::load(load), 1.0));
        let error = film_error(&model, &other, Weighting::DualTaylor);
        assert!(error < bound, "{error:e}");
    }
    let given = TpwlMarch::new(&model, &SINE.transient, Weighting::DualTaylor).err().unwrap().to_string();
    assert!(given.contains("lubricant"), "{given}");
    let filled = Cavitation::MassConserving { supply_film_m: None };
    let short = Transient { duration: 0.05, ..SINE.transient.clone() };
    let filled = training(Transient { lubricant: Lubricant { cavitation: filled, ..short.lubricant }, ..short });
    let settings = TpwlTraining { modes: 10, selection: STEP_SELECTION };
    let refused = TpwlModel::train(&[&filled], settings).err().unwrap().to_string();
    assert!(refused.contains("mass-conserving cavitation"), "{refused}");
}

#[test]
fn balanced_rows_need_few_modes() {
    // With rows weighted by cell sizes only and the full penalty slope, H_c would have an error of 0.05.
    let model = model(&[&SINE], 40, STEP_SELECTION);
    for (name, signal, bar) in [("sine", sine(0.5), 5e-4), ("triangle", wave(0.0), 4e-3)] {
        let error = film_error(&model, &transient(CASE_1, Inputs::load(signal), 1.0), Weighting::DualTaylor);
        assert!(error < bar, "{name}: {error:e}");
    }
    // |∂r/∂P| of the rows in the far inlet is more than 10⁶ times that in the contact.
    let space = &model.space;
    let at = |x: f64| {
        let node = space.grid.abscissae().0.partition_point(|&own| own < x);
        space.test[(node - FIRST_UNKNOWN, 0)] / space.pressure[(node, 0)]
    };
    assert!(at(0.0) > 500.0 * at(-3.5), "{} and {}", at(0.0), at(-3.5));
}

#[test]
fn inputs_far_from_the_trained_ones_are_told_apart() {
    let march =
        |signal| solve(&MODEL, &transient(CASE_1, Inputs::load(signal), 0.5), Weighting::DualTaylor, &()).unwrap().1;
    assert!(!march(sine(0.5)).too_steep());
    assert!(march(Signal::TriangleToSquare { amplitude: 0.3, period: 0.2, s: 0.9 }).too_steep());
}

#[test]
fn both_rules_choose_more_points_where_less_is_tolerated() {
    let moments = &MODEL.trajectories[0];
    let count = |rule| {
        let chosen = MODEL.selected(rule).remove(0);
        assert_eq!(chosen[0], 0);
        assert!(chosen.windows(2).all(|pair| pair[0] < pair[1]));
        chosen.len()
    };
    let distance = [0.05, 0.02, 1e-9].map(|tolerance| count(Selection::Distance { tolerance }));
    assert!(distance[0] < distance[1] && distance[1] < distance[2], "{distance:?}");
    assert_eq!(distance[2], moments.len());
    let step = [3e-3, 3e-4].map(|tolerance| count(Selection::Step { tolerance }));
    assert!(step[0] < step[1], "{step:?}");
}

#[test]
fn a_number_of_points_is_met_by_either_rule_in_the_same_space() {
    for rule in [Selection::Distance { tolerance: 0.1 }, STEP_SELECTION] {
        let selection = MODEL.selection_of(rule, 40);
        let chosen = MODEL.selected(selection);
        assert_eq!(selection.name(), rule.name());
        assert!(chosen[0].len().abs_diff(40) <= 2, "{} points by {selection:?}", chosen[0].len());
        let other = MODEL.reselected(selection).unwrap();
        assert_eq!(
            (other.points.len(), other.sets[0].points.clone()),
            (chosen[0].len(), (0..chosen[0].len()).collect())
        );
        let times = chosen[0].iter().map(|&i| MODEL.trajectories[0][i].time);
        assert!(other.points.iter().map(|point| point.moment.time).eq(times));
    }
    // The same rule gives the same model.
    let again = MODEL.reselected(MODEL.training.selection).unwrap();
    assert_eq!(again.points.len(), MODEL.points.len());
    let still = transient(CASE_1, Inputs::load(sine(0.5)), 0.1);
    let film = |model: &TpwlModel| solve(model, &still, Weighting::DualTaylor, &()).unwrap().0.moments[20].h_c;
    assert_eq!(film(&again), film(&MODEL));
    let wanted = TpwlTraining { modes: 100, selection: STEP_SELECTION };
    let wanted = TpwlModel::train_with_points(&[&SINE], wanted, 25).unwrap();
    assert!(wanted.points.len().abs_diff(25) <= 2, "{} points", wanted.points.len());
}

#[test]
fn what_a_model_cannot_do_is_refused() {
    let message = |transient: &Transient| match solve(&MODEL, transient, Weighting::DualTaylor, &()) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("{transient:?} was accepted"),
    };
    let good = transient(CASE_1, Inputs::load(sine(0.5)), 0.1);
    let heavier = OperatingPoint { load: 3e5, ..CASE_1 };
    assert!(message(&Transient { point: heavier, ..good.clone() }).contains("outside the trained"));
    let rounder = OperatingPoint { radius_m: 0.02, ..CASE_1 };
    assert!(message(&Transient { point: rounder, ..good.clone() }).contains("contact differs"));
    let moving = Transient { frame: Frame::ArbitraryLagrangianEulerian, ..good.clone() };
    assert!(message(&moving).contains("fixed frame"));
    let reversing = Inputs { speed: Signal::Harmonic { amplitude: 1.5, period: 0.1 }, ..Inputs::default() };
    assert!(message(&Transient { inputs: reversing, ..good.clone() }).contains("the speed falls"));

    let refusal = |trajectories: &[&Trajectory], modes, tolerance| {
        let training = TpwlTraining { modes, selection: Selection::Distance { tolerance } };
        TpwlModel::train(trajectories, training).unwrap_err().to_string()
    };
    assert!(refusal(&[], 10, 0.1).contains("at least one training trajectory"));
    assert!(refusal(&[&SINE], 0, 0.1).contains("number of modes"));
    assert!(refusal(&[&SINE], 10, f64::NAN).contains("tolerance"));
    assert!(refusal(&[&full(&good)], 10, 0.1).contains("stores the fields at 0 times"));
}
