//! Every scene of the repository: it parses, survives writing, and the quick ones give what they expect.

use crate::common::scene_files;
use ehl_explorer::engine::{SceneOutcome, Workbench, run_scene};
use ehl_explorer::scene::study::point::Point;
use ehl_explorer::scene::study::random_test::RandomTest;
use ehl_explorer::scene::{Grid, Method, ModelSource, Scene, Study, TransientStudy};
use ehl_explorer::scene::{StudyObserver, StudyRow};
use ehl_explorer::solver::full::transient::{Frame, Signal, TimeStep};
use ehl_explorer::solver::observer::Observer;
use ehl_explorer::solver::training::TrainingObserver;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Mutex;

fn all() -> Vec<(String, Scene)> {
    let read = |path: &Path| Scene::read(path).unwrap_or_else(|error| panic!("{error}"));
    scene_files::all().iter().map(|path| (scene_files::name(path), read(path))).collect()
}

fn run(name: &str) -> SceneOutcome {
    scene_files::run(name, &scene_files::read(name))
}

fn assert_passes(name: &str) {
    let outcome = run(name);
    let short: Vec<_> = outcome.verdicts.iter().filter(|verdict| !verdict.holds).collect();
    assert!(short.is_empty(), "{name}: {short:?}");
    assert!(outcome.converged && outcome.passed(), "{name}: {:?}", outcome.warnings);
}

#[test]
fn every_scene_survives_writing() {
    let scenes = all();
    let names: BTreeSet<_> = scenes.iter().map(|(name, _)| name).collect();
    assert!(scenes.len() >= 102 && names.len() == scenes.len(), "a name is given twice");
    for (name, scene) in scenes {
        let text = scene.to_ron().unwrap();
        assert_eq!(Scene::from_ron(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}")), scene, "{name}");
    }
}

#[test]
fn every_expectation_says_where_its_bound_comes_from_and_none_judges_time() {
    let mut count = 0;
    for (name, scene) in all() {
        for expectation in &scene.expect {
            let from = expectation.from.trim();
            let sound = from.len() > 5 && !from.starts_with("bar") && !from.contains(".md");
            assert!(sound, "{name}: {} comes from \"{from}\"", expectation.name);
            // Seconds depend on the machine: `bench` judges speed by ratios within one run.
            let last = expectation.name.rsplit('.').next().unwrap();
            assert!(!last.ends_with("_s") && last != "speed_up", "{name}: {}", expectation.name);
            count += 1;
        }
    }
    assert!(count > 350, "{count} expectations");
}

#[test]
fn scenes_that_need_no_model_give_what_they_expect() {
    let needs_model = |method: &Method| method.model().is_some();
    let mut run_count = 0;
    for (name, scene) in all() {
        let quick = matches!(scene.study, Study::Point(_) | Study::GridStudy(_));
        if quick && !scene.study.methods().iter().any(needs_model) {
            assert_passes(&name);
            run_count += 1;
        }
    }
    assert!(run_count >= 9);
}

#[test]
fn full_solutions_lie_within_5_percent_of_moes_formula() {
    assert_passes("formula_comparison");
}

#[test]
fn the_whole_plane_of_m_and_l_converges() {
    assert_passes("convergence_default_realisation");
}

#[test]
fn cold_solves_converge_at_random_points_of_table_3_1() {
    let mut scene = scene_files::read("convergence_table_3_1");
    if let Study::RandomTest(RandomTest { tests, .. }) = &mut scene.study {
        *tests = 150;
    }
    let outcome = scene_files::run("convergence_table_3_1", &scene);
    // Times are the business of `bench`; a test only counts.
    assert_eq!(outcome.value("failures", None), Some(0.0));
    assert!(outcome.value("newton_max", None).unwrap() <= 60.0);
}

#[test]
fn cold_solves_of_point_contacts_converge_at_random_points_of_table_3_4() {
    let mut scene = scene_files::read("convergence_table_3_4");
    if let Study::RandomTest(RandomTest { tests, .. }) = &mut scene.study {
        *tests = 8;
    }
    let outcome = scene_files::run("convergence_table_3_4", &scene);
    assert_eq!(outcome.value("failures", None), Some(0.0));
    assert!(outcome.value("newton_max", None).unwrap() <= 40.0);
}

#[test]
fn a_contact_in_time_breathes_as_its_scene_expects() {
    assert_passes("fig_2_6_right");
}

#[test]
fn the_frames_of_a_contact_in_time_agree() {
    for (name, duration) in [("fig_4_4_case_1", 0.5), ("fig_4_4_case_2", 0.6)] {
        let mut scene = scene_files::read(name);
        if let Study::Transient(study) = &mut scene.study {
            (study.duration, study.window) = (duration, None);
            study.time_step = TimeStep::Fixed(0.0025);
        }
        let outcome = scene_files::run(name, &scene);
        // Longer steps than the scene's have other balances of mass.
        let films = outcome.verdicts.iter().filter(|verdict| verdict.name.ends_with("H_c.difference"));
        let short: Vec<_> = films.filter(|verdict| !verdict.holds).collect();
        assert!(short.is_empty() && outcome.converged, "{name}: {short:?}");
        assert_eq!(outcome.tables.len(), 4);
    }
}

#[test]
fn a_reduced_model_reproduces_a_trained_load_in_time() {
    let mut scene = scene_files::read("rnsa_table_4_2_sine");
    if let Study::Transient(study) = &mut scene.study {
        (study.duration, study.frames) = (0.5, vec![Frame::Fixed]);
        study.trainings.clear();
    }
    scene.grid = Grid::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let outcome = scene_files::run("rnsa_table_4_2_sine", &scene);
    assert!(outcome.converged, "{:?}", outcome.warnings);
    assert!(outcome.value("fixed.rnsa.H_c.difference_l2", None).unwrap() < 1e-4);
    assert!(outcome.value("fixed.rnsa.speed_up", None).unwrap() > 1.0);
}

#[test]
fn linearised_models_carry_over_to_an_unseen_load() {
    assert_passes("fig_4_17_quick");
}

#[test]
fn inputs_in_time_that_make_no_sense_are_refused() {
    let refusal = |change: fn(&mut TransientStudy)| {
        let mut scene = scene_files::read("fig_2_6_right");
        if let Study::Transient(study) = &mut scene.study {
            change(study);
        }
        run_scene(&scene, &mut Workbench::new(""), &()).unwrap_err().to_string()
    };
    let deep = |study: &mut TransientStudy| study.inputs.load = Signal::Harmonic { amplitude: 1.5, period: 4.0 };
    assert!(refusal(deep).contains("the load falls to"));
    assert!(refusal(|study| study.frames.clear()).contains("study.frames"));
    assert!(refusal(|study| study.window = Some((4.0, 99.0))).contains("study.window.1"));
    assert!(refusal(|study| study.sampled = Some("no/such/inputs.csv".into())).contains("no/such/inputs.csv"));
}

#[test]
fn the_first_look_shows_a_trained_contact() {
    assert_passes("first_look");
}

#[test]
fn the_embedded_model_agrees_with_full_solutions() {
    let mut scene = scene_files::read("random_test_embedded");
    if let Study::RandomTest(RandomTest { tests, compare, .. }) = &mut scene.study {
        (*tests, *compare) = (500, 60);
    }
    let outcome = scene_files::run("random_test_embedded", &scene);
    assert_eq!(outcome.value("failures", None), Some(0.0));
    assert!(outcome.value("H_c_error_max", None).unwrap() <= 2e-2);
}

#[test]
fn the_reduced_model_of_table_3_1_follows_the_trajectory() {
    assert_passes("fig_3_7_trajectory");
}

#[test]
fn the_error_at_the_first_look_comes_from_the_grid() {
    assert_passes("error_split_first_look");
    let outcome = run("error_split_first_look");
    let value = |name: &str| outcome.value(name, None).unwrap();
    for film in ["H_c", "H_min"] {
        let part = |name: &str| value(&format!("{film}.{name}"));
        let sum = part("basis") + part("projection") + part("sampling") + part("discretisation");
        assert!((part("whole") - sum).abs() < 1e-15 && part("discretisation").abs() > 3.0 * part("reduction").abs());
    }
}

#[test]
fn the_distance_measure_comes_out_of_full_solutions() {
    assert_passes("distance_measure_uniform");
    assert_passes("distance_measure_graded");
}

#[test]
fn error_measures_rank_as_the_figure_shows() {
    assert_passes("fig_3_1_error_measures");
}

#[test]
fn a_model_file_that_is_missing_is_named() {
    let mut scene = Scene::at_moes(40.0, 10.0);
    scene.study = Study::Point(Point { methods: vec![Method::reduced(ModelSource::File("no/such/file.rom".into()))] });
    let error = run_scene(&scene, &mut Workbench::new(""), &()).unwrap_err().to_string();
    assert!(error.contains("no/such/file.rom"), "{error}");
}

/// Keeps the rows it is told.
#[derive(Default)]
struct Rows(Mutex<Vec<StudyRow>>);

impl Observer for Rows {}
impl TrainingObserver for Rows {}
impl StudyObserver for Rows {
    fn row(&self, row: StudyRow) {
        self.0.lock().unwrap().push(row);
    }
}

#[test]
fn rows_that_were_told_say_what_the_outcome_says() {
    let study = "RandomTest(range: Realisation(m: (5.0, 200.0), l: (2.0, 12.0), max_hertz_pressure: 3.2e9), \
                 tests: 40, seed: 3, method: Reduced(pressure_loss: 1e-4), compare: 2)";
    let sweep = "Sweep(over: [(vary: M, values: Log(from: 10.0, to: 40.0, n: 3))], methods: [Reduced()])";
    for (study, streamed) in [(study, 42), (sweep, 3)] {
        let scene = Scene::from_ron(&format!("Scene(version: 1, title: \"t\", study: {study})")).unwrap();
        let rows = Rows::default();
        let outcome = run_scene(&scene, &mut Workbench::new(""), &rows).unwrap();
        let rows = rows.0.into_inner().unwrap();
        assert_eq!(rows.len(), streamed);
        let told = scene.outcome(&rows, 0.0);
        assert_eq!((&told.values, &told.tables, told.converged), (&outcome.values, &outcome.tables, outcome.converged));
        assert!(scene.study.charts(&rows).iter().all(|chart| !chart.series.is_empty()));
        // What was told so far says as much as it can.
        assert_eq!(scene.study.tables(&rows[..2])[0].rows.len(), 2);
    }
}
