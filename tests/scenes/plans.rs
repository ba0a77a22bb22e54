//! Studies of training at a small size: comparison of plans, and an adaptive training cut at its tolerances.

use crate::common::scratch::Scratch;
use ehl_explorer::engine::{SceneOutcome, Workbench, run_scene};
use ehl_explorer::scene::study::plan_comparison::PlanComparison;
use ehl_explorer::scene::study::tolerance_study::ToleranceStudy;
use ehl_explorer::scene::{ComparedPlan, OnlineScheme, Scene, Study};
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::parameters::ParameterSpace;
use ehl_explorer::solver::training::{Indicator, Plan, TrainingSpec};
use std::path::{Path, PathBuf};

fn corner() -> ParameterSpace {
    ParameterSpace::si_box([(2e-3, 3e-3), (3.0, 5.0), (1e5, 2e5), (6e-9, 10e-9)], 231e9, 0.01)
}

/// Folder with scenes of small trainings.
struct Folder(Scratch);

impl Folder {
    fn new(name: &str) -> Self {
        Self(Scratch::new(name))
    }

    fn training(&self, name: &str, plan: Plan) -> PathBuf {
        let mut scene = Scene::at_moes(40.0, 10.0);
        let grid = GridSpec::Uniform { dx: 0.04, domain: (-4.0, 2.0) };
        let spec = TrainingSpec::new(corner(), (1.0, 500.0), grid, plan);
        scene.study = Study::Training(TrainingSpec { title: name.to_owned(), evidence: 0, seed: 3, ..spec });
        let file = format!("{name}.ron");
        self.0.write(&file, &scene.to_ron().unwrap());
        file.into()
    }

    fn run(&self, study: Study) -> SceneOutcome {
        let scene = Scene { study, ..Scene::at_moes(40.0, 10.0) };
        run_scene(&scene, &mut Workbench::new(&*self.0), &()).unwrap_or_else(|error| panic!("{error}"))
    }
}

fn adaptive(indicator: Indicator, tolerances: Vec<f64>) -> Plan {
    let (start, successes, local_sigma, local_successes, vicinity, limit) = (8, 48, 0.1, 8, 4, 60);
    Plan::Adaptive { start, indicator, tolerances, successes, local_sigma, local_successes, vicinity, limit }
}

#[test]
fn plans_are_compared_side_by_side() {
    let folder = Folder::new("comparison");
    let plan = |name: &str, training: &Path, published| ComparedPlan {
        name: name.to_owned(),
        training: training.to_owned(),
        published_failure_percent: Some(published),
    };
    let wide = folder.training("wide", Plan::FarthestPoint { snapshots: 40 });
    let corners = folder.training("corners", Plan::Grid { nodes: [2, 2, 2, 2] });
    let study = Study::PlanComparison(PlanComparison {
        plans: vec![plan("wide", &wide, 0.0), plan("corners", &corners, 1.0)],
        range: corner(),
        tests: 300,
        seed: 7,
        compare: 40,
        trajectory: 21,
        online: OnlineScheme::Explorer,
    });
    let outcome = folder.run(study.clone());
    let value = |name: &str| outcome.found.value(name, None).unwrap_or_else(|| panic!("no {name}"));
    assert_eq!((value("wide.snapshots"), value("corners.snapshots")), (40.0, 16.0));
    assert_eq!((value("full_failures"), value("order.against")), (0.0, 0.0));
    // More snapshots over a wider range: information decays more slowly, and unseen solutions are approximated better.
    assert!(value("wide.modes_p_1e-6") > value("corners.modes_p_1e-6"));
    assert!(value("wide.unseen_p95") < value("corners.unseen_p95"));
    assert!(value("wide.H_c_error_p95") < 0.3 * value("corners.H_c_error_p95"));
    assert!(value("wide.trajectory_e_z_mean") < value("corners.trajectory_e_z_mean"));
    let rows = |name: &str| outcome.tables.iter().find(|t| t.name == name).map(|t| (t.rows.len(), t.columns.len()));
    assert_eq!(rows("snapshots"), Some((56, 7)));
    assert_eq!(rows("trajectory"), Some((21, 3 + 2 * 8)));
    assert_eq!(rows("loss_of_information"), Some((41, 5)));
    // Only the two times may differ between runs, and this study measures none.
    assert_eq!(folder.run(study).found.values, outcome.found.values);
}

#[test]
fn a_cut_training_is_the_training_with_that_tolerance() {
    let folder = Folder::new("tolerances");
    let ladder = folder.training("ladder", adaptive(Indicator::Correction, vec![3e-2, 3e-3]));
    let study = |training: &Path| {
        Study::ToleranceStudy(ToleranceStudy {
            training: training.to_owned(),
            range: corner(),
            points: 11,
            tests: 100,
            seed: 5,
            online: OnlineScheme::Explorer,
        })
    };
    let both = folder.run(study(&ladder));
    assert_eq!(both.found.value("rungs_met", None), Some(2.0));
    let short = folder.training("short", adaptive(Indicator::Correction, vec![3e-2]));
    let first = folder.run(study(&short));
    for name in ["snapshots", "basis_p", "failures", "e_z_mean", "e_f_I_mean", "H_c_error_max"] {
        let value = |outcome: &SceneOutcome| outcome.found.value(&format!("3e-2.{name}"), None).unwrap();
        assert_eq!(value(&both), value(&first), "{name}");
    }
    assert!(both.found.value("3e-3.snapshots", None) > both.found.value("3e-2.snapshots", None));
    assert!(both.found.value("3e-3.H_c_error_p95", None) < both.found.value("3e-2.H_c_error_p95", None));
}

#[test]
fn the_dissertations_own_indicator_trains_a_model() {
    let folder = Folder::new("indicator");
    let training = folder.training("own", adaptive(Indicator::Dissertation, vec![10.0, 1.0]));
    let study = Study::ToleranceStudy(ToleranceStudy {
        training,
        range: corner(),
        points: 11,
        tests: 100,
        seed: 5,
        online: OnlineScheme::Dissertation,
    });
    let outcome = folder.run(study);
    assert_eq!(outcome.found.value("rungs_met", None), Some(2.0));
    assert!(outcome.found.value("1e0.e_f_I_mean", None).unwrap() < 1.0);
}

#[test]
fn a_tolerance_study_of_another_plan_is_refused() {
    let folder = Folder::new("refused");
    let training = folder.training("grid", Plan::Grid { nodes: [2, 2, 2, 2] });
    let online = OnlineScheme::Explorer;
    let study =
        Study::ToleranceStudy(ToleranceStudy { training, range: corner(), points: 11, tests: 10, seed: 5, online });
    let scene = Scene { study, ..Scene::at_moes(40.0, 10.0) };
    let error = run_scene(&scene, &mut Workbench::new(&*folder.0), &()).unwrap_err().to_string();
    assert!(error.contains("adaptive"), "{error}");
}
