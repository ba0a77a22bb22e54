//! Tests of transient reduced models of circular contacts against full marches, and of what they refuse.

use super::small::Made;
use super::{ResponseBasis, ResponseTraining, TrainingError};
use crate::solver::discrete::grid::{PointGrid, PointGridSpec};
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::transient::{FullMarch, Inputs, Keep, Quantity, Signal, Trajectory, Transient, march};
use crate::solver::observer::{Observer, Progress};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::tpwl::{self, Selection, Weighting};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const BALL: OperatingPoint = OperatingPoint {
    kind: ContactKind::Point,
    radius_m: 0.01,
    speed_m_per_s: 0.26,
    load: 4.8,
    modulus_pa: 231e9,
    viscosity_pa_s: 0.04,
    alpha_per_pa: 2e-8,
    ..OperatingPoint::TABLE_2_1
};
const TRAINING: ResponseTraining = ResponseTraining {
    load: (0.9, 1.1),
    speed: (0.9, 1.1),
    shortest_period: 1.0,
    modes: 40,
    rows_per_mode: 3.5,
    step: 0.02,
    seed: 1,
};

fn lubricant() -> Lubricant {
    Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() }
}

fn grid() -> Arc<PointGrid> {
    PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.6)).build().unwrap()
}

/// Trains the reduced model of a contact.
fn train(
    point: OperatingPoint,
    training: &ResponseTraining,
    observer: &dyn Observer,
) -> Result<TrajectoryModel, TrainingError> {
    ResponseBasis::new(&grid(), point, lubricant(), training, observer)?.reduced(observer)
}

fn trained() -> Arc<TrajectoryModel> {
    static MODELS: Made<TrajectoryModel> = Made::new();
    MODELS.of(&(), || train(BALL, &TRAINING, &()).unwrap())
}

fn harmonic(amplitude: f64, period: f64) -> Signal {
    Signal::Harmonic { amplitude, period }
}

fn driven(inputs: Inputs) -> Transient {
    Transient { lubricant: lubricant(), keep: Keep::Every(20), ..Transient::new(BALL, inputs, 1.5, 0.02) }
}

fn full(transient: &Transient) -> Trajectory {
    march(&mut FullMarch::<PlaneSpace>::on(grid(), transient).unwrap(), transient, &()).unwrap()
}

fn reduced(model: &Arc<TrajectoryModel>, transient: &Transient) -> Trajectory {
    march(&mut ReducedMarch::new(model, transient).unwrap(), transient, &()).unwrap()
}

#[test]
fn a_model_follows_full_marches_under_loads_and_speeds_that_it_has_not_seen() {
    let model = trained();
    assert!(model.rows() <= (3.5 * model.modes() as f64) as usize && model.rows() < grid().unknowns() / 4);
    for inputs in [
        Inputs::load(harmonic(0.08, 1.2)),
        Inputs::load(Signal::TriangleToSquare { amplitude: 0.08, period: 1.4, s: 0.0 }),
        Inputs { load: harmonic(0.07, 1.1), speed: harmonic(-0.08, 1.7), ..Inputs::default() },
    ] {
        let transient = driven(inputs);
        let (wanted, seen) = (full(&transient), reduced(&model, &transient));
        assert!(wanted.finished() && seen.finished(), "{}", seen.ended.describe());
        assert!(model.domain.left_by(&seen).is_empty(), "{:?}", model.domain.left_by(&seen));
        for (quantity, largest, mean) in [
            (Quantity::CentralFilm, 3e-3, 1e-3),
            (Quantity::CentralPressure, 4e-3, 1.5e-3),
            (Quantity::MinimumFilm, 2e-2, 1e-2),
        ] {
            let off = wanted.difference(&seen, quantity, (0.0, transient.duration)).unwrap();
            assert!(off.0 < largest && off.1 < mean, "{quantity:?}: {off:?}");
        }
        // The fields, not only the scalars.
        let (own, other) = (seen.states.last().unwrap(), wanted.states.last().unwrap());
        let off = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off(&own.pressure, &other.pressure) < 0.03, "{}", off(&own.pressure, &other.pressure));
        assert!(off(&own.film, &other.film) < 0.01, "{}", off(&own.film, &other.film));
    }
}

#[test]
fn under_a_prescribed_separation_the_load_is_that_of_the_full_march() {
    let transient = Transient { separation: Some(harmonic(0.03, 1.2)), ..driven(Inputs::default()) };
    let (wanted, seen) = (full(&transient), reduced(&trained(), &transient));
    assert!(wanted.finished() && seen.finished(), "{}", seen.ended.describe());
    let off = wanted.difference(&seen, Quantity::Load, (0.0, transient.duration)).unwrap();
    assert!(off.0 < 3e-3, "{off:?}");
    let loads = wanted.moments.iter().map(|moment| moment.input.load);
    assert!(loads.fold(0.0, f64::max) > 1.02, "the load varies");
}

#[test]
fn a_linearised_model_in_the_same_basis_follows_a_full_march_roughly() {
    let basis = ResponseBasis::new(&grid(), BALL, lubricant(), &TRAINING, &()).unwrap();
    let model = basis.linearised(30, Selection::Distance { tolerance: 0.03 }, None).unwrap();
    assert!(model.space.modes() == 30 && model.points.len() > 10, "{} points", model.points.len());
    let transient = driven(Inputs::load(harmonic(0.08, 1.2)));
    let (seen, _) = tpwl::solve(&model, &transient, Weighting::DualTaylor, &()).unwrap();
    let off = full(&transient).difference(&seen, Quantity::CentralFilm, (0.0, transient.duration)).unwrap();
    assert!(seen.finished() && off.1 < 1e-2, "{off:?}");
    let twenty = basis.linearised(30, Selection::Distance { tolerance: 0.03 }, Some(20)).unwrap();
    assert!((15..=25).contains(&twenty.points.len()), "{} points", twenty.points.len());
    let other = Transient { point: OperatingPoint { speed_m_per_s: 0.3, ..BALL }, ..transient };
    assert!(tpwl::solve(&model, &other, Weighting::DualTaylor, &()).is_err());
}

#[test]
fn the_basis_of_a_reduced_model_is_that_of_its_training() {
    let model = trained();
    let own = ResponseTraining::of_model(&model);
    assert!((own.shortest_period / TRAINING.shortest_period - 1.0).abs() < 1e-12);
    assert_eq!(
        (own.load, own.speed, own.modes, own.step),
        (TRAINING.load, TRAINING.speed, TRAINING.modes, TRAINING.step)
    );
    let other = OperatingPoint { load: 1.01 * BALL.load, ..BALL };
    assert!(
        ResponseBasis::of_model(&model, (other, lubricant()), &())
            .err()
            .unwrap()
            .to_string()
            .contains("does not cover")
    );
    // The contact of the training up to rounding.
    let point = OperatingPoint { load: (1.0 + 1e-9) * BALL.load, ..BALL };
    let basis = ResponseBasis::of_model(&model, (point, lubricant()), &()).unwrap();
    let linearised = basis.linearised(30, Selection::Distance { tolerance: 0.03 }, None).unwrap();
    let transient = Transient { point, ..driven(Inputs::load(harmonic(0.08, 1.2))) };
    let (seen, _) = tpwl::solve(&linearised, &transient, Weighting::DualTaylor, &()).unwrap();
    let off = full(&transient).difference(&seen, Quantity::CentralFilm, (0.0, transient.duration)).unwrap();
    assert!(seen.finished() && off.1 < 1e-2, "{off:?}");
}

#[test]
fn training_is_reproducible_and_can_be_cancelled() {
    let model = trained();
    let again = train(BALL, &TRAINING, &()).unwrap();
    assert_eq!(model.window.sampled_rows, again.window.sampled_rows);
    struct Stops(AtomicBool);
    impl Observer for Stops {
        fn progress(&self, progress: Progress) {
            self.0.fetch_or(progress.stage.contains("test functions"), Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }
    let stops = Stops(AtomicBool::new(false));
    assert!(matches!(train(BALL, &TRAINING, &stops), Err(TrainingError::Cancelled)));
}

#[test]
fn settings_and_contacts_that_are_not_covered_are_refused() {
    let refused =
        |point: OperatingPoint, training: ResponseTraining| train(point, &training, &()).unwrap_err().to_string();
    let ellipse = OperatingPoint { radius_y_m: Some(0.02), ..BALL };
    assert!(refused(ellipse, TRAINING).contains("circular contacts"));
    for (training, word) in [
        (ResponseTraining { load: (0.0, 1.1), ..TRAINING }, "smallest load"),
        (ResponseTraining { speed: (0.5, f64::NAN), ..TRAINING }, "largest speed"),
        (ResponseTraining { shortest_period: 0.0, ..TRAINING }, "shortest period"),
        (ResponseTraining { modes: 0, ..TRAINING }, "number of modes"),
        (ResponseTraining { rows_per_mode: f64::INFINITY, ..TRAINING }, "rows per mode"),
        (ResponseTraining { step: -1.0, ..TRAINING }, "time step"),
    ] {
        assert!(refused(BALL, training).contains(word), "{}", refused(BALL, training));
    }
    let line = Transient::new(OperatingPoint::TABLE_4_2, Inputs::default(), 1.0, 0.01);
    assert!(ReducedMarch::new(&trained(), &line).err().unwrap().to_string().contains("contact"));
    let outside = driven(Inputs::load(harmonic(0.3, 1.2)));
    let seen = reduced(&trained(), &outside);
    assert!(!trained().domain.left_by(&seen).is_empty());
}
