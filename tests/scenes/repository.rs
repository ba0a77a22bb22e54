//! Every scene of the repository: it parses, can be written and read again, and the quick ones meet their expectations.

use crate::common::scene_files;
use crate::common::scratch::Scratch;
use ehl_explorer::engine::{Workbench, model_file, run_scene};
use ehl_explorer::scene::study::error_split::Contacts;
use ehl_explorer::scene::study::point::Point;
use ehl_explorer::scene::study::random_test::RandomTest;
use ehl_explorer::scene::study::sweep::Sweep;
use ehl_explorer::scene::{CaseTable, Grid, Method, ModelSource, Scene, SceneOutcome, Study, TransientStudy};
use ehl_explorer::scene::{StudyObserver, StudyRow};
use ehl_explorer::solver::full::transient::{Frame, Signal, TimeStep};
use ehl_explorer::solver::observer::Observer;
use ehl_explorer::solver::training::{TrainingObserver, TrainingSpec, train};
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

fn all() -> Vec<(String, Scene)> {
    scene_files::all().into_iter().map(|file| (scene_files::name(&file.path), file.scene)).collect()
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
fn expectations_name_their_source_and_do_not_judge_time() {
    let mut count = 0;
    for (name, scene) in all() {
        for expectation in &scene.expect {
            let from = expectation.from.trim();
            let sound = from.len() > 5 && !from.starts_with("bar") && !from.contains(".md");
            assert!(sound, "{name}: {} comes from \"{from}\"", expectation.name);
            // Seconds depend on the machine: `bench` compares speeds by ratios within one run.
            let last = expectation.name.rsplit('.').next().unwrap();
            assert!(!last.ends_with("_s") && last != "speed_up", "{name}: {}", expectation.name);
            count += 1;
        }
    }
    assert!(count > 350, "{count} expectations");
}

/// Runs the scenes that no other test has begun, so that two processors share the work.
fn quick_scenes_give_what_they_expect() {
    static BEGUN: AtomicUsize = AtomicUsize::new(0);
    let quick: Vec<_> = all().into_iter().filter(|(_, scene)| scene.quick).collect();
    assert!(quick.len() >= 30, "{} scenes are marked quick", quick.len());
    while let Some((name, scene)) = quick.get(BEGUN.fetch_add(1, Ordering::Relaxed)) {
        let begin = std::time::Instant::now();
        let outcome = scene_files::outcome(name);
        println!("{:6.1} s: {name}", begin.elapsed().as_secs_f64());
        let short: Vec<_> = outcome.verdicts.iter().filter(|verdict| !verdict.holds).collect();
        assert!(short.is_empty() && outcome.verdicts.len() == scene.expect.len(), "{name}: {short:?}");
        assert!(outcome.passed() && !scene.expect.is_empty(), "{name}: {:?}", outcome.found.warnings);
    }
}

#[test]
fn quick_scenes_give_what_they_expect_on_one_processor() {
    quick_scenes_give_what_they_expect();
}

#[test]
fn quick_scenes_give_what_they_expect_on_another() {
    quick_scenes_give_what_they_expect();
}

/// Asserts that a longer scene, reduced in size, meets its expectations.
fn gives_what_it_expects(name: &str, scene: &Scene) {
    assert!(!scene.quick, "{name} is run as it is");
    let outcome = scene_files::run(name, scene);
    let short: Vec<_> = outcome.verdicts.iter().filter(|verdict| !verdict.holds).collect();
    assert!(short.is_empty() && outcome.verdicts.len() == scene.expect.len(), "{name}: {short:?}");
    assert!(outcome.passed() && scene.expect.len() > 1, "{name}: {:?}", outcome.found.warnings);
}

/// The same with a share of its contacts, without the expectation of their number.
fn a_share_gives_what_is_expected_of_all(name: &str, shrink: impl FnOnce(&mut Study)) {
    let mut scene = scene_files::read(name);
    shrink(&mut scene.study);
    scene.expect.retain(|expectation| expectation.name != "cases");
    gives_what_it_expects(name, &scene);
}

#[test]
fn parts_of_the_error_are_small_along_the_trajectory() {
    a_share_gives_what_is_expected_of_all("error_split_trajectory", |study| {
        let Study::ErrorSplit(split) = study else { panic!("no parts of an error") };
        let Contacts::Trajectory { points, .. } = &mut split.contacts else { panic!("no trajectory") };
        *points = 9;
    });
}

#[test]
fn every_eighth_line_is_solved_by_the_embedded_model() {
    let name = "two_hundred_lines";
    let table = std::fs::read_to_string(scene_files::path(name).with_extension("csv")).unwrap();
    let lines = || table.lines();
    let share: Vec<&str> = lines().take(1).chain(lines().skip(1).step_by(8)).collect();
    assert_eq!(share.len(), 1 + 25);
    a_share_gives_what_is_expected_of_all(name, |study| {
        let Study::LoadCases(cases) = study else { panic!("no load cases") };
        cases.cases = CaseTable::Text(share.join("\n"));
    });
}

#[test]
fn corners_of_a_comparison_lie_as_near_to_hamrock_and_dowson() {
    a_share_gives_what_is_expected_of_all("formula_comparison_hamrock_dowson", |study| {
        let Study::FormulaComparison(comparison) = study else { panic!("no comparison") };
        (comparison.m, comparison.l) = (vec![20.0, 200.0], vec![2.5, 10.0]);
    });
}

#[test]
fn error_measures_are_as_correlated_as_in_figure_3_1() {
    let (name, folder) = ("fig_3_1_error_measures", Scratch::new("measures"));
    let Study::Training(spec) = scene_files::read("fig_3_1_model").study else { panic!("no training") };
    // Error bounds take longest and are not needed here.
    let model = train(&TrainingSpec { evidence: 0, ..spec }, &()).unwrap();
    let path = folder.join("model.rom");
    model_file::write(&model, &path).unwrap();
    let mut scene = scene_files::read(name);
    let Study::ErrorMeasures(study) = &mut scene.study else { panic!("{name} measures no errors") };
    study.model = ModelSource::File(path);
    gives_what_it_expects(name, &scene);
}

#[test]
fn cold_solves_converge_at_random_points() {
    for (name, count, most_steps) in [("convergence_table_3_1", 150, 60.0), ("convergence_table_3_4", 8, 40.0)] {
        let mut scene = scene_files::read(name);
        let Study::RandomTest(RandomTest { tests, .. }) = &mut scene.study else {
            panic!("{name} tests something else")
        };
        *tests = count;
        let outcome = scene_files::run(name, &scene);
        assert_eq!(
            (outcome.found.value("tests", None), outcome.found.value("failures", None)),
            (Some(count as f64), Some(0.0))
        );
        assert!(outcome.found.value("newton_max", None).unwrap() <= most_steps, "{name}");
    }
}

#[test]
fn the_frames_of_a_contact_in_time_agree() {
    for (name, duration) in [("fig_4_4_case_1", 0.5), ("fig_4_4_case_2", 0.6)] {
        let mut scene = scene_files::read(name);
        let Study::Transient(study) = &mut scene.study else { panic!("{name} is no contact in time") };
        (study.duration, study.window) = (duration, None);
        study.time_step = TimeStep::Fixed(0.005);
        let outcome = scene_files::run(name, &scene);
        // Steps longer than the scene's have other mass balances.
        let films = outcome.verdicts.iter().filter(|verdict| verdict.expected.name.ends_with("H_c.difference"));
        let count = films.clone().count();
        let short: Vec<_> = films.filter(|verdict| !verdict.holds).collect();
        assert!(short.is_empty() && outcome.found.converged, "{name}: {short:?}");
        assert!(count >= 2, "{count} frames are compared with the fixed one");
        assert_eq!(outcome.tables.len(), 4);
    }
}

#[test]
fn a_reduced_model_reproduces_a_trained_load_in_time() {
    let mut scene = scene_files::read("rnsa_table_4_2_sine");
    let Study::Transient(study) = &mut scene.study else { panic!("no contact in time") };
    (study.duration, study.frames) = (0.5, vec![Frame::Fixed]);
    study.trainings.clear();
    scene.grid = Grid::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let outcome = scene_files::run("rnsa_table_4_2_sine", &scene);
    assert!(outcome.found.converged, "{:?}", outcome.found.warnings);
    assert!(outcome.found.value("fixed.rnsa.H_c.difference_l2", None).unwrap() < 1e-4);
}

#[test]
fn inputs_in_time_that_make_no_sense_are_refused() {
    let refusal = |change: fn(&mut TransientStudy)| {
        let mut scene = scene_files::read("fig_2_6_right");
        let Study::Transient(study) = &mut scene.study else { panic!("no contact in time") };
        change(study);
        run_scene(&scene, &mut Workbench::new(""), &()).unwrap_err().to_string()
    };
    let deep = |study: &mut TransientStudy| study.inputs.load = Signal::Harmonic { amplitude: 1.5, period: 4.0 };
    assert!(refusal(deep).contains("the load falls to"));
    assert!(refusal(|study| study.frames.clear()).contains("study.frames"));
    assert!(refusal(|study| study.window = Some((4.0, 99.0))).contains("study.window.1"));
    assert!(refusal(|study| study.sampled = Some("no/such/inputs.csv".into())).contains("no/such/inputs.csv"));
}

#[test]
fn the_embedded_model_agrees_with_full_solutions() {
    let mut scene = scene_files::read("random_test_embedded");
    let Study::RandomTest(RandomTest { tests, compare, .. }) = &mut scene.study else { panic!("no random test") };
    (*tests, *compare) = (500, 60);
    let outcome = scene_files::run("random_test_embedded", &scene);
    assert_eq!(outcome.found.value("failures", None), Some(0.0));
    assert!(outcome.found.value("H_c_error_max", None).unwrap() <= 2e-2);
}

#[test]
fn the_error_at_the_first_look_comes_from_the_grid() {
    let outcome = scene_files::outcome("error_split_first_look");
    let value = |name: &str| outcome.found.value(name, None).unwrap();
    for film in ["H_c", "H_min"] {
        let part = |name: &str| value(&format!("{film}.{name}"));
        let sum = part("basis") + part("projection") + part("sampling") + part("discretisation");
        assert!((part("whole") - sum).abs() < 1e-15 && part("discretisation").abs() > 3.0 * part("reduction").abs());
    }
}

#[test]
fn line_figures_use_the_models_grid_and_the_reference() {
    for name in ["fig_3_11_line", "fig_3_14_line"] {
        let (mut scene, outcome) = (scene_files::read(name), scene_files::outcome(name));
        let short: Vec<_> = outcome.verdicts.iter().filter(|verdict| !verdict.holds).collect();
        assert!(short.is_empty() && outcome.verdicts.len() >= 6, "{name}: {short:?}");
        // Compared with the dissertation's grid, which begins at X = -4, the error would include that of the grids.
        let of = |outcome: &SceneOutcome| outcome.found.value("H_c_error_max", Some(&Method::EMBEDDED)).unwrap();
        if let Study::Sweep(Sweep { compare_on_model_grid, .. }) = &mut scene.study {
            *compare_on_model_grid = false;
        }
        let elsewhere = scene_files::run(name, &scene);
        assert!(of(&elsewhere) > 3.0 * of(&outcome), "{name}: {} and {}", of(&elsewhere), of(&outcome));
        assert!(elsewhere.found.value("failures_on_model_grid", None).is_none());
    }
}

#[test]
fn a_model_file_that_is_missing_is_named() {
    let mut scene = Scene::at_moes(40.0, 10.0);
    scene.study = Study::Point(Point { methods: vec![Method::reduced(ModelSource::File("no/such/file.rom".into()))] });
    let error = run_scene(&scene, &mut Workbench::new(""), &()).unwrap_err().to_string();
    assert!(error.contains("no/such/file.rom"), "{error}");
}

/// Collects the rows that it receives.
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
    let study = "RandomTest(range: (axes: {M: (5.0, 200.0), L: (2.0, 12.0)}, limits: {HertzPressure: (0.0, 3.2e9)}), \
                 tests: 40, seed: 3, method: Reduced(pressure_loss: 1e-4), compare: 2)";
    let sweep = "Sweep(over: [(vary: M, values: Log(from: 10.0, to: 40.0, n: 3))], methods: [Reduced()])";
    for (study, streamed) in [(study, 42), (sweep, 3)] {
        let scene = Scene::from_ron(&format!("Scene(version: 1, title: \"t\", study: {study})")).unwrap();
        let rows = Rows::default();
        let outcome = run_scene(&scene, &mut Workbench::new(""), &rows).unwrap();
        let rows = rows.0.into_inner().unwrap();
        assert_eq!(rows.len(), streamed);
        let told = scene.outcome(&rows, 0.0);
        // As text, which shows every bit and treats gaps of a table as equal.
        let said = |outcome: &SceneOutcome| format!("{:?} {:?}", outcome.found.values, outcome.tables);
        assert_eq!((said(&told), told.found.converged), (said(&outcome), outcome.found.converged));
        assert!(scene.study.charts(&rows).iter().all(|chart| !chart.series.is_empty()));
        // The rows so far give all available results.
        assert_eq!(scene.study.tables(&rows[..2])[0].rows.len(), 2);
    }
}
