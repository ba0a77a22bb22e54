//! Reduced models in time: they reproduce what they were trained with, follow what they never saw, and are the same
//! again.

use super::{TrajectoryTraining, train_trajectories};
use crate::solver::discrete::grid::{GridSpec, ReferenceGrid};
use crate::solver::full::transient::{
    Frame, FullMarch, Inputs, Interpolation, Keep, Quantity, Signal, Trajectory, Transient, march,
};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use std::sync::Arc;

const ALL: (f64, f64) = (0.0, f64::INFINITY);

fn grid() -> Arc<ReferenceGrid> {
    GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }.line().unwrap()
}

fn transient(frame: Frame, load: Signal) -> Transient {
    let marched = Transient::new(OperatingPoint::TABLE_4_2, Inputs::load(load), 1.0, 0.005);
    Transient { frame, keep: Keep::Every(1), ..marched }
}

fn full(transient: &Transient) -> Trajectory {
    march(&mut FullMarch::new(grid(), transient).unwrap(), transient, &()).unwrap()
}

fn reduced(model: &TrajectoryModel, transient: &Transient) -> Trajectory {
    march(&mut ReducedMarch::new(model).unwrap(), transient, &()).unwrap()
}

fn trained(frame: Frame) -> (Vec<Trajectory>, TrajectoryModel) {
    let loads = [0.5, 1.0 / 3.0].map(|period| Signal::Harmonic { amplitude: 0.1, period });
    let trainings: Vec<Trajectory> = loads.into_iter().map(|load| full(&transient(frame, load))).collect();
    let model = train_trajectories(&grid(), &trainings, &TrajectoryTraining::default(), &()).unwrap();
    (trainings, model)
}

fn off(seen: &Trajectory, wanted: &Trajectory) -> f64 {
    assert!(seen.finished(), "{}", seen.ended.describe());
    seen.difference(wanted, Quantity::CentralFilm, ALL).unwrap().1
}

#[test]
fn a_model_reproduces_its_training_in_every_frame_and_follows_an_unseen_load() {
    for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, Frame::Remeshed(Interpolation::CubicSpline)] {
        let (trainings, model) = trained(frame);
        let (rows, modes) = (model.window.sampled_rows.len(), model.window.pressure.modes.ncols());
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
fn rows_and_modes_that_meet_halfway_reproduce_a_heavy_contact() {
    // Case 2 of Table 4.5: the rupture passes nodes whose penalty answers 10⁵ times as strongly as the rows under the
    // contact. Cell sizes alone, for rows and modes alike, leave 1.4e-4 here.
    let heavy = OperatingPoint { load: 12e5, ..OperatingPoint::TABLE_4_5 };
    let load = Signal::Harmonic { amplitude: 0.1, period: 0.5 };
    let training = full(&Transient { point: heavy, ..transient(Frame::Fixed, load) });
    let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let model = train_trajectories(&grid(), std::slice::from_ref(&training), &settings, &()).unwrap();
    let seen = off(&reduced(&model, &training.transient), &training);
    assert!(seen < 8e-5, "{seen:e}");
}

#[test]
fn the_same_training_gives_the_same_rows() {
    let ((_, a), (_, b)) = (trained(Frame::Fixed), trained(Frame::Fixed));
    assert_eq!(a.window.sampled_rows, b.window.sampled_rows);
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
    assert!(message(&[silent]).contains("kept their fields"));
    assert!(message(&[]).contains("trajectories"));
}
