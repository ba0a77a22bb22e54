//! Tests of transient reduced models: they reproduce their training, follow unseen inputs, and are reproducible.

use super::small::Made;
use super::{LocalBases, TrajectoryTraining, train_trajectories};
use crate::solver::discrete::grid::{GridSpec, ReferenceGrid};
use crate::solver::full::transient::{
    Frame, FullMarch, Inputs, Interpolation, Keep, Quantity, Signal, Trajectory, Transient, march,
};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::reduced::{Sampling, Scheme};
use std::sync::Arc;

const ALL: (f64, f64) = (0.0, f64::INFINITY);

pub(super) fn grid() -> Arc<ReferenceGrid> {
    GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }.line().unwrap()
}

pub(super) fn transient(frame: Frame, load: Signal) -> Transient {
    let marched = Transient::new(OperatingPoint::TABLE_4_2, Inputs::load(load), 1.0, 0.005);
    Transient { frame, keep: Keep::Every(1), ..marched }
}

pub(super) fn under(cavitation: Cavitation, transient: Transient) -> Transient {
    Transient { lubricant: Lubricant { cavitation, ..transient.lubricant }, ..transient }
}

pub(super) fn full(transient: &Transient) -> Trajectory {
    static MARCHES: Made<Trajectory> = Made::new();
    let march = || march(&mut FullMarch::new(grid(), transient).unwrap(), transient, &()).unwrap();
    Trajectory::clone(&MARCHES.of(transient, march))
}

pub(super) fn reduced(model: &Arc<TrajectoryModel>, transient: &Transient) -> Trajectory {
    march(&mut ReducedMarch::new(model, transient).unwrap(), transient, &()).unwrap()
}

pub(super) fn trained(cavitation: Cavitation, frame: Frame) -> (Vec<Trajectory>, Arc<TrajectoryModel>) {
    let loads = [0.5, 1.0 / 3.0].map(|period| Signal::Harmonic { amplitude: 0.1, period });
    let trainings: Vec<Trajectory> =
        loads.into_iter().map(|load| full(&under(cavitation, transient(frame, load)))).collect();
    static MODELS: Made<TrajectoryModel> = Made::new();
    let train = || train_trajectories(&grid(), &trainings, &TrajectoryTraining::default(), &()).unwrap();
    let model = MODELS.of(&(cavitation, frame), train);
    (trainings, model)
}

fn off(seen: &Trajectory, wanted: &Trajectory) -> f64 {
    assert!(seen.finished(), "{}", seen.ended.describe());
    seen.difference(wanted, Quantity::CentralFilm, ALL).unwrap().1
}

#[test]
fn models_reproduce_their_training_and_follow_unseen_loads() {
    for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, Frame::Remeshed(Interpolation::CubicSpline)] {
        let (trainings, model) = trained(Cavitation::Penalty, frame);
        let (rows, modes) = (model.window.sampled_rows.len(), model.window.pressure.count());
        assert!(rows < model.window.grid.unknowns() && rows <= 2 * modes, "{frame:?}: {rows} rows of {modes} modes");
        for training in &trainings {
            assert!(off(&reduced(&model, &training.transient), training) < 1e-4, "{frame:?}");
        }
        let unseen = transient(frame, Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s: 0.0 });
        let seen = off(&reduced(&model, &unseen), &full(&unseen));
        assert!(seen < 1e-3, "{frame:?}: {seen}");
    }
}

#[test]
fn complementarity_models_follow_the_full_boundary() {
    for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, Frame::Remeshed(Interpolation::CubicSpline)] {
        let (trainings, model) = trained(Cavitation::Complementarity, frame);
        assert!(model.window.sampled_rows.len() <= 2 * model.window.pressure.count());
        let unseen = transient(frame, Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s: 0.0 });
        let unseen = full(&under(Cavitation::Complementarity, unseen));
        // Typical values: 5e-6, for H_min 7e-6.
        for (wanted, bound) in [(&trainings[0], 2e-5), (&trainings[1], 2e-5), (&unseen, 3e-5)] {
            let seen = reduced(&model, &wanted.transient);
            assert!(off(&seen, wanted) < bound, "{frame:?}: {:e}", off(&seen, wanted));
            let thinnest = seen.difference(wanted, Quantity::MinimumFilm, ALL).unwrap().1;
            assert!(thinnest < 1e-4, "{frame:?}: {thinnest:e}");
            for (own, other) in seen.states.iter().zip(&wanted.states) {
                let front = |p: &[f64]| p.iter().rposition(|p| *p > 1e-4).unwrap();
                let apart = front(&own.pressure).abs_diff(front(&other.pressure));
                assert!(apart <= 2, "{frame:?}: {apart} nodes at T = {}", own.time);
                assert!(own.pressure.iter().all(|p| *p > -1e-4));
            }
        }
    }
}

#[test]
fn local_bases_with_few_modes_each_go_a_long_way_in_every_frame() {
    let wide = Signal::Harmonic { amplitude: 0.3, period: 1.0 };
    for (frame, cavitation) in [
        (Frame::Fixed, Cavitation::Penalty),
        (Frame::Fixed, Cavitation::Complementarity),
        (Frame::ArbitraryLagrangianEulerian, Cavitation::Penalty),
        (Frame::Remeshed(Interpolation::CubicSpline), Cavitation::Penalty),
    ] {
        let training = full(&under(cavitation, transient(frame, wide.clone())));
        let local = Some(LocalBases { clusters: 4, modes: 25 });
        let settings = TrajectoryTraining { local, rows_per_mode: 3.0, ..TrajectoryTraining::default() };
        let trainings = std::slice::from_ref(&training);
        let model = Arc::new(train_trajectories(&grid(), trainings, &settings, &()).unwrap());
        assert_eq!((model.locals.len(), model.modes()), (4, 25), "{frame:?}");
        assert!(model.window.pressure.count() > 25 && model.rows() <= 75, "{frame:?}: {} rows", model.rows());
        let seen = reduced(&model, &training.transient);
        assert_eq!(seen.rejected_steps, 0, "{frame:?}");
        // Typical value: 5e-6.
        assert!(off(&seen, &training) < 5e-5, "{frame:?}, {cavitation:?}: {:e}", off(&seen, &training));
        // The same number of modes for all states together.
        let single = TrajectoryTraining { local: Some(LocalBases { clusters: 1, modes: 25 }), ..settings };
        let single = Arc::new(train_trajectories(&grid(), trainings, &single, &()).unwrap());
        let single = reduced(&single, &training.transient);
        let far = seen.difference(&training, Quantity::CentralFilm, ALL).unwrap().1;
        let farther = single.difference(&training, Quantity::CentralFilm, ALL).map_or(f64::INFINITY, |off| off.1);
        assert!(far < 0.5 * farther, "{frame:?}, {cavitation:?}: {far:e} against {farther:e}");
    }
}

#[test]
fn every_scheme_follows_an_unseen_load_under_complementarity() {
    let loads = [0.5, 1.0 / 3.0].map(|period| Signal::Harmonic { amplitude: 0.1, period });
    let held = |load| under(Cavitation::Complementarity, transient(Frame::Fixed, load));
    let trainings: Vec<Trajectory> = loads.into_iter().map(|load| full(&held(load))).collect();
    let unseen = full(&held(Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s: 0.0 }));
    for (scheme, sampling) in [
        (Scheme::Galerkin, Sampling::All),
        (Scheme::Galerkin, Sampling::QDeim),
        (Scheme::LeastSquares { weighted: true }, Sampling::All),
        (Scheme::LeastSquares { weighted: true }, Sampling::QDeim),
        (Scheme::Gnat { weighted: true }, Sampling::QDeim),
    ] {
        let settings = TrajectoryTraining { loss: 1e-5, scheme, sampling, ..TrajectoryTraining::default() };
        let model = Arc::new(train_trajectories(&grid(), &trainings, &settings, &()).unwrap());
        assert_eq!((model.window.scheme, model.window.sampling), (scheme, sampling));
        let seen = off(&reduced(&model, &unseen.transient), &unseen);
        assert!(seen < 1e-4, "{scheme:?}, {sampling:?}: {seen:e}");
    }
    let scheme = Scheme::Gnat { weighted: true };
    let settings = TrajectoryTraining { scheme, ..TrajectoryTraining::default() };
    let sentence = train_trajectories(&grid(), &trainings, &settings, &()).unwrap_err().to_string();
    assert!(sentence.contains("cubature"), "{sentence}");
}

#[test]
fn a_boundary_that_finds_no_place_gives_way_to_the_penalty() {
    // A load that jumps within a step, outside the trained range: the outlet fills beyond all modes.
    let (_, model) = trained(Cavitation::Complementarity, Frame::Fixed);
    let steep = transient(Frame::Fixed, Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s: 0.9 });
    let steep = full(&under(Cavitation::Complementarity, steep));
    assert!(off(&reduced(&model, &steep.transient), &steep) < 2e-3);
}

#[test]
fn films_that_rupture_otherwise_are_refused() {
    let short = |cavitation| {
        let load = Signal::Harmonic { amplitude: 0.1, period: 0.5 };
        full(&under(cavitation, Transient { duration: 0.05, ..transient(Frame::Fixed, load) }))
    };
    let settings = TrajectoryTraining::default();
    let message = |all: &[Trajectory]| train_trajectories(&grid(), all, &settings, &()).unwrap_err().to_string();
    let (penalty, held) = (short(Cavitation::Penalty), short(Cavitation::Complementarity));
    assert!(
        message(&[penalty.clone(), held.clone()])
            .contains("all have cavitation by the penalty or all by complementarity")
    );
    let conserving = short(Cavitation::MassConserving { supply_film_m: None });
    assert!(message(&[conserving]).contains("mass-conserving"));
    let model = Arc::new(train_trajectories(&grid(), &[held], &settings, &()).unwrap());
    let refused = ReducedMarch::new(&model, &penalty.transient).err().unwrap().to_string();
    assert!(refused.contains("cavitation model complementarity, not penalty"), "{refused}");
}

#[test]
fn rows_and_modes_that_meet_halfway_reproduce_a_heavy_contact() {
    // Case 2 of Table 4.5: the cavitation boundary passes nodes whose penalty is 10⁵ times as sensitive as the rows
    // in the contact. With cell sizes alone as weights, the error would be 1.4e-4.
    let heavy = OperatingPoint { load: 12e5, ..OperatingPoint::TABLE_4_5 };
    let load = Signal::Harmonic { amplitude: 0.1, period: 0.5 };
    let training = full(&Transient { point: heavy, ..transient(Frame::Fixed, load) });
    let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let model = Arc::new(train_trajectories(&grid(), std::slice::from_ref(&training), &settings, &()).unwrap());
    let seen = off(&reduced(&model, &training.transient), &training);
    assert!(seen < 8e-5, "{seen:e}");
}

#[test]
fn the_same_training_gives_the_same_rows() {
    for cavitation in [Cavitation::Penalty, Cavitation::Complementarity] {
        let (trainings, first) = trained(cavitation, Frame::Fixed);
        let again = train_trajectories(&grid(), &trainings, &TrajectoryTraining::default(), &()).unwrap();
        assert_eq!(first.window.sampled_rows, again.window.sampled_rows);
    }
}

#[test]
fn trajectories_without_fields_teach_nothing() {
    let silent = full(&Transient {
        keep: Keep::Scalars,
        duration: 0.02,
        ..transient(Frame::Fixed, Signal::Harmonic { amplitude: 0.1, period: 0.5 })
    });
    let settings = TrajectoryTraining::default();
    let message = |all: &[Trajectory]| train_trajectories(&grid(), all, &settings, &()).unwrap_err().to_string();
    assert!(message(&[silent]).contains("stored their fields"));
    assert!(message(&[]).contains("trajectories"));
}
