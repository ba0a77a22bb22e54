//! Damaged scenes, models and unfinished trainings, with correct checksums.

use crate::common::cases::cases;
use crate::common::scene_files;
use crate::common::scratch::Scratch;
use crate::{alone, most_bytes, spoil};
use ehl_explorer::engine::{SavedModel, embedded, model_file, training_file};
use ehl_explorer::scene::Scene;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::transient::{self, Inputs, Keep, Signal, Transient};
use ehl_explorer::solver::parameters::{Axis, ParameterSpace, Quantity};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant};
use ehl_explorer::solver::training::{
    Plan, Search, Solved, TrainingSpec, TrainingState, TrajectoryTraining, WindowSpec, WindowState, train_trajectories,
};
use fastrand::Rng;
use std::sync::Arc;

/// Maximum memory that reading a damaged file may take, in bytes.
const MOST_BYTES: usize = 200_000_000;

/// Asserts that a refusal is a sentence: not empty, on one line, and without the words of a panic.
fn is_sentence(text: &str) -> bool {
    !text.is_empty() && !text.contains('\n') && !text.contains("panicked")
}

fn check(case: usize, (bytes, refusal): (usize, Option<String>)) {
    assert!(bytes < MOST_BYTES, "case {case} took {bytes} bytes");
    assert!(refusal.as_deref().is_none_or(is_sentence), "case {case}: {refusal:?}");
}

#[test]
fn damaged_scenes_are_refused_or_mean_what_they_say() {
    let _alone = alone();
    let mut rng = Rng::with_seed(1);
    let texts: Vec<String> =
        scene_files::all().iter().map(|file| std::fs::read_to_string(&file.path).unwrap()).collect();
    let mut read = 0;
    for case in 0..cases(3000, 20_000) {
        let whole = spoil::one(&mut rng, &texts).clone();
        let spoiled = spoil::text(&mut rng, &whole);
        check(
            case,
            most_bytes(|| match Scene::from_ron(&spoiled) {
                Ok(scene) => {
                    read += 1;
                    let again = Scene::from_ron(&scene.to_ron().unwrap());
                    assert!(again.as_ref() == Ok(&scene), "case {case}: {again:?}\n{spoiled}");
                    None
                }
                Err(error) => Some(error.to_string()),
            }),
        );
    }
    println!("{read} of the damaged scenes are scenes");
}

/// Returns a model file that is damaged anywhere, or in the text of its directory.
fn spoiled_model(rng: &mut Rng, whole: &[u8]) -> Vec<u8> {
    if rng.bool() { spoil::payload(rng, whole) } else { spoil::directory(rng, whole) }
}

#[test]
fn damaged_models_are_refused_or_solve_their_snapshots() {
    let _alone = alone();
    let mut rng = Rng::with_seed(2);
    for (contact, cases) in [(ContactKind::Line, cases(150, 19_000)), (ContactKind::Point, cases(10, 1000))] {
        let thinning = if contact == ContactKind::Line { "line_shear" } else { "point_shear" };
        let model = embedded(thinning).unwrap();
        let whole = model_file::to_bytes(&model).unwrap();
        drop(model);
        let mut read = 0;
        for case in 0..cases {
            let spoiled = spoiled_model(&mut rng, &whole);
            let mut refusal = |spoiled: &[u8]| match model_file::from_bytes(spoiled) {
                Ok(_) => {
                    read += 1;
                    None
                }
                Err(error) => Some(error.to_string()),
            };
            check(case, most_bytes(|| refusal(&spoiled)));
        }
        println!("{read} of {cases} damaged models of {} contacts could be used", contact.name());
    }
}

/// Returns a transient model that is trained quickly.
fn model_in_time(cavitation: Cavitation) -> Vec<u8> {
    let grid = GridSpec::Uniform { dx: 0.03, domain: (-3.0, 1.8) };
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 0.5 });
    let own = Transient::new(OperatingPoint::TABLE_4_2, load, 0.2, 0.01);
    let lubricant = Lubricant { cavitation, ..own.lubricant };
    let trajectory = transient::solve(grid, &Transient { keep: Keep::Every(1), lubricant, ..own }, &()).unwrap();
    let settings = TrajectoryTraining { loss: 1e-4, ..TrajectoryTraining::default() };
    let model = train_trajectories(&grid.line().unwrap(), &[trajectory], &settings, &()).unwrap();
    SavedModel::InTime(Arc::new(model)).to_bytes().unwrap()
}

#[test]
fn damaged_transient_models_are_refused_or_rest() {
    let _alone = alone();
    let mut rng = Rng::with_seed(4);
    for cavitation in [Cavitation::Penalty, Cavitation::Complementarity] {
        let whole = model_in_time(cavitation);
        assert!(SavedModel::from_bytes(&whole).is_ok());
        let (mut read, count) = (0, cases(400, 10_000));
        for case in 0..count {
            let spoiled = spoiled_model(&mut rng, &whole);
            let mut refusal = || match SavedModel::from_bytes(&spoiled) {
                Ok(_) => {
                    read += 1;
                    None
                }
                Err(error) => Some(error.to_string()),
            };
            check(case, most_bytes(&mut refusal));
        }
        println!("{read} of {count} damaged models in time by {} could be used", cavitation.name());
    }
}

/// Returns a training with one solved contact and one to be solved.
fn training() -> TrainingState {
    let axes = [(Quantity::M, (10.0, 20.0)), (Quantity::L, (2.0, 3.0)), (Quantity::Alpha, (1e-8, 2e-8))];
    let range = ParameterSpace::of(axes.map(|(quantity, ends)| Axis::new(quantity, ends)))
        .limited([(Quantity::HertzPressure, (0.0, 3e9))])
        .fixing([(Quantity::Viscosity, 0.01)]);
    let (grid, plan) = (GridSpec::EXPLORER, Plan::FarthestPoint { snapshots: 8 });
    let spec = TrainingSpec::new(range, (10.0, 20.0), grid, plan);
    let point = OperatingPoint::TABLE_2_1;
    let window = WindowState {
        window: WindowSpec::new((10.0, 20.0), grid),
        seed: 1,
        inherited: 0,
        solved: vec![Solved {
            place: 0,
            point,
            pressure: vec![0.5; 633],
            h_0: -0.1,
            h_c: 0.04,
            grid_cost: None,
            fronts: Vec::new(),
        }],
        pending: vec![(1, point)],
        planned: true,
        search: Search::default(),
    };
    TrainingState { windows: vec![window], solves: 1, ..TrainingState::new(spec) }
}

#[test]
fn damaged_trainings_are_refused_in_a_sentence_or_are_sound() {
    let _alone = alone();
    let (mut rng, folder) = (Rng::with_seed(3), Scratch::new("damaged-training"));
    let path = folder.join("a.rom.training");
    training_file::write(&training(), &path).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for case in 0..cases(2000, 20_000) {
        std::fs::write(&path, spoil::payload(&mut rng, &whole)).unwrap();
        check(case, most_bytes(|| training_file::read(&path).err().map(|error| error.to_string())));
    }
}
