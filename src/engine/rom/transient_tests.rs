//! Tests of transient models in files.

use super::container::VERSION;
use super::{Catalogue, ModelFileError, ModelKind, SavedModel};
use crate::engine::{bytes_of, model_file};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::transient::{
    Frame, Inputs, Interpolation, Keep, Quantity, Signal, Trajectory, Transient, march, solve,
};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::reduced::{Sampling, Scheme};
use crate::solver::training::{LocalBases, ResponseBasis, ResponseTraining, TrajectoryTraining, train_trajectories};
use std::sync::Arc;

fn to_bytes(model: &TrajectoryModel) -> Result<Vec<u8>, ModelFileError> {
    SavedModel::InTime(Arc::new(model.clone())).to_bytes()
}

fn from_bytes(bytes: &[u8]) -> Result<Arc<TrajectoryModel>, ModelFileError> {
    SavedModel::from_bytes(bytes)?.in_time()
}

/// Returns a short training on a coarse grid.
fn training(frame: Frame, cavitation: Cavitation) -> Transient {
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 0.5 });
    let lubricant = Lubricant { cavitation, ..Lubricant::default() };
    let own = Transient::new(OperatingPoint::TABLE_4_2, load, 0.3, 0.01);
    Transient { frame, lubricant, keep: Keep::Every(1), ..own }
}

fn trained(transient: &Transient, settings: TrajectoryTraining) -> Arc<TrajectoryModel> {
    let spec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
    let trajectory = solve(spec, transient, &()).unwrap();
    let mut model = train_trajectories(&spec.line().unwrap(), &[trajectory], &settings, &()).unwrap();
    model.title = "A load that breathes".to_owned();
    model.scene = "Scene(…)".to_owned();
    model.log = vec!["one".to_owned()];
    Arc::new(model)
}

fn small() -> Arc<TrajectoryModel> {
    trained(&training(Frame::Fixed, Cavitation::Penalty), TrajectoryTraining::default())
}

fn marched(model: &Arc<TrajectoryModel>, transient: &Transient) -> Trajectory {
    march(&mut ReducedMarch::new(model, transient).unwrap(), transient, &()).unwrap()
}

#[test]
fn what_is_read_is_what_was_written_and_marches_alike() {
    let galerkin = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let gnat = TrajectoryTraining { scheme: Scheme::Gnat { weighted: true }, sampling: Sampling::QDeim, ..galerkin };
    let least = TrajectoryTraining { scheme: Scheme::LeastSquares { weighted: true }, ..gnat };
    let local = TrajectoryTraining { local: Some(LocalBases { clusters: 3, modes: 15 }), ..galerkin };
    for (frame, cavitation, settings) in [
        (Frame::Fixed, Cavitation::Penalty, local),
        (Frame::Fixed, Cavitation::Complementarity, local),
        (Frame::Fixed, Cavitation::Penalty, galerkin),
        (Frame::Fixed, Cavitation::Complementarity, galerkin),
        (Frame::Fixed, Cavitation::Complementarity, gnat),
        (Frame::Fixed, Cavitation::Complementarity, least),
        (Frame::ArbitraryLagrangianEulerian, Cavitation::Complementarity, galerkin),
        (Frame::Remeshed(Interpolation::CubicSpline), Cavitation::Penalty, galerkin),
    ] {
        let transient = training(frame, cavitation);
        let model = trained(&transient, settings);
        let bytes = to_bytes(&model).unwrap();
        let read = from_bytes(&bytes).unwrap();
        assert!(to_bytes(&read).unwrap() == bytes, "{frame:?}, {cavitation:?}");
        assert_eq!((&read.title, &read.scene, &read.log), (&model.title, &model.scene, &model.log));
        assert_eq!((read.frame, &read.domain, &read.starts), (model.frame, &model.domain, &model.starts));
        let [own, other] = [&model, &read].map(|model| marched(model, &transient));
        let off = own.difference(&other, Quantity::CentralFilm, (0.0, transient.duration)).unwrap().0;
        assert!(own.finished() && off < 1e-7, "{frame:?}, {cavitation:?}: {off:e}");
        assert_eq!(read.locals.len(), settings.local.map_or(0, |local| local.clusters));
    }
}

#[test]
fn local_bases_that_are_none_of_the_model_are_refused() {
    let settings = TrajectoryTraining { local: Some(LocalBases { clusters: 3, modes: 15 }), ..Default::default() };
    let model = trained(&training(Frame::Fixed, Cavitation::Penalty), settings);
    let lies: [&dyn Fn(&mut TrajectoryModel); 3] =
        [&|m| m.locals[1].centre.truncate(2), &|m| m.locals[0].centre[0] = f64::NAN, &|m| {
            *m.locals[2].window.sampled_rows.last_mut().unwrap() = 1_000_000
        }];
    for (k, lie) in lies.iter().enumerate() {
        let mut wrong = (*model).clone();
        lie(&mut wrong);
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { .. })), "lie {k}: {refused:?}");
    }
}

#[test]
fn damage_and_other_kinds_are_named() {
    let whole = to_bytes(&small()).unwrap();
    assert!(matches!(from_bytes(&whole[..10]), Err(ModelFileError::Truncated { .. })));
    assert!(matches!(from_bytes(&whole[..whole.len() - 9]), Err(ModelFileError::Truncated { .. })));
    assert!(matches!(from_bytes(b"PNG"), Err(ModelFileError::Foreign)));
    for place in [whole.len() / 2, 20, whole.len() - 1] {
        let mut flipped = whole.clone();
        flipped[place] ^= 0x10;
        assert!(matches!(from_bytes(&flipped), Err(ModelFileError::Damaged { .. })), "byte {place}");
    }
    let mut other = whole.clone();
    other[8] = VERSION as u8 + 1;
    assert!(matches!(from_bytes(&other), Err(ModelFileError::OtherVersion { found }) if found == VERSION + 1));
    assert!(matches!(from_bytes(&bytes_of("line").unwrap()), Err(ModelFileError::Stationary)));
    assert!(matches!(model_file::from_bytes(&whole), Err(ModelFileError::InTime)));
    assert!(matches!(SavedModel::from_bytes(&whole), Ok(SavedModel::InTime(_))));
    assert!(matches!(SavedModel::from_bytes(&bytes_of("line").unwrap()), Ok(SavedModel::Stationary(_))));
    let catalogue = Catalogue::of(&whole).unwrap();
    assert_eq!((catalogue.kind, catalogue.title.as_str()), (ModelKind::Transient, "A load that breathes"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.rom");
    SavedModel::InTime(small()).write(&path).unwrap();
    assert!(std::fs::read(&path).unwrap() == whole);
    assert!(matches!(model_file::read(&path), Err(ModelFileError::InTime)));
    assert!(matches!(SavedModel::read(&path), Ok(SavedModel::InTime(_))));
}

#[test]
fn contradicting_parts_are_refused_despite_a_valid_hash() {
    let model = small();
    let refused = |spoil: &dyn Fn(&mut TrajectoryModel)| {
        let mut wrong = (*model).clone();
        spoil(&mut wrong);
        from_bytes(&to_bytes(&wrong).unwrap()).err()
    };
    let lies: [&dyn Fn(&mut TrajectoryModel); 14] = [
        &|m| *m.window.sampled_rows.last_mut().unwrap() = 1_000_000,
        &|m| m.window.penalty = -1.0,
        &|m| m.domain.reference.lubricant.cavitation = Cavitation::Complementarity,
        &|m| m.domain.reference.lubricant.cavitation = Cavitation::MassConserving { supply_film_m: None },
        &|m| m.starts.clear(),
        &|m| m.starts[0].h_0 = f64::NAN,
        &|m| m.starts[0].coefficients.truncate(3),
        &|m| m.starts[0].fronts.push(7),
        &|m| m.starts[0].inputs.load = Signal::Harmonic { amplitude: 2.0, period: 0.1 },
        &|m| m.starts[0].point.load = -1.0,
        &|m| m.domain.step = 0.0,
        &|m| m.domain.load.range = (1.2, 0.8),
        &|m| m.domain.reference.space.axes[0].ends.0 = f64::NAN,
        &|m| m.domain.speed.rate = f64::INFINITY,
    ];
    for (k, lie) in lies.iter().enumerate() {
        assert!(matches!(refused(lie), Some(ModelFileError::Damaged { .. })), "lie {k}: {:?}", refused(lie));
    }
    let foreign = refused(&|m| m.starts.iter_mut().for_each(|start| start.coefficients.reverse()));
    assert!(matches!(foreign, Some(ModelFileError::UnprovenInTime)), "{foreign:?}");
    let mut loud = (*model).clone();
    loud.title.push_str("\u{1b}[2J");
    assert!(!from_bytes(&to_bytes(&loud).unwrap()).unwrap().title.contains('\u{1b}'));
}

#[test]
fn a_model_of_a_circular_contact_is_read_as_it_was_written() {
    let point = OperatingPoint {
        kind: ContactKind::Point,
        radius_m: 0.01,
        speed_m_per_s: 0.26,
        load: 4.8,
        viscosity_pa_s: 0.04,
        alpha_per_pa: 2e-8,
        ..OperatingPoint::TABLE_4_2
    };
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let grid = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.6)).build().unwrap();
    let training =
        ResponseTraining { load: (0.9, 1.1), speed: (0.9, 1.1), modes: 25, step: 0.02, ..ResponseTraining::default() };
    let basis = ResponseBasis::new(&grid, point, lubricant, &training, &()).unwrap();
    let model = Arc::new(basis.reduced(&()).unwrap());
    let bytes = to_bytes(&model).unwrap();
    let read = from_bytes(&bytes).unwrap();
    assert!(to_bytes(&read).unwrap() == bytes);
    assert_eq!((read.frame, &read.domain, &read.starts), (model.frame, &model.domain, &model.starts));
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.05, period: 1.0 });
    let transient = Transient { lubricant, ..Transient::new(point, load, 0.4, 0.02) };
    let [own, other] = [&model, &read].map(|model| marched(model, &transient));
    let off = own.difference(&other, Quantity::CentralFilm, (0.0, transient.duration)).unwrap().0;
    assert!(own.finished() && off < 1e-7, "{off:e}");
}
