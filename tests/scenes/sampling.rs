//! Methods of sampling equations on a small point contact: a cubature of few equations is as good as all equations.

use crate::common::scratch::Scratch;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;

const TRAINING: &str = "Scene(
    version: 1, title: \"small\", source: \"test\", contact: Point,
    study: Training(
        title: \"small\",
        range: (axes: {Radius: (10e-3, 11e-3, Linear), Speed: (2.0, 3.0, Linear),
            Load: (30.0, 45.0, Linear), Alpha: (8e-9, 11e-9, Linear)},
            fixed: {Modulus: 231e9, Viscosity: 0.01}),
        plan: FarthestPoint(snapshots: 20),
        windows: Given([(m: (1.0, 2000.0), grid: Plane(dx: 0.06, dy: 0.1, domain: (-2.7, 1.5, -1.5)))]),
        pressure_loss: 1e-4, deformation_loss: 1e-3, sampling: All, rows_per_mode: 3.0, penalty: 1e5, evidence: 0, seed: 2,
    ),
)";

const COMPARISON: &str = "Scene(
    version: 1, title: \"ways\", source: \"test\", contact: Point,
    study: SamplingComparison(
        training: \"training.ron\",
        samplings: [
            (name: \"all\", sampling: All, rows_per_mode: 3.0, penalty: 1e6),
            (name: \"greedy\", sampling: Greedy, rows_per_mode: 4.0, penalty: 1e6),
            (name: \"q_deim\", sampling: QDeim, rows_per_mode: 4.0, penalty: 1e5),
            (name: \"cubature\", sampling: Cubature, rows_per_mode: 3.0, penalty: 1e5),
        ],
        range: (axes: {Radius: (10e-3, 11e-3, Linear), Speed: (2.0, 3.0, Linear),
            Load: (30.0, 45.0, Linear), Alpha: (8e-9, 11e-9, Linear)},
            fixed: {Modulus: 231e9, Viscosity: 0.01}),
        tests: 20, seed: 3, compare: 8,
    ),
)";

#[test]
fn a_cubature_of_few_rows_does_what_all_rows_do() {
    let folder = Scratch::new("samplings");
    folder.write("training.ron", TRAINING);
    let scene = Scene::from_ron(COMPARISON).unwrap();
    let outcome = run_scene(&scene, &mut Workbench::new(&*folder), &()).unwrap();
    let value = |name: &str| outcome.found.value(name, None).unwrap_or_else(|| panic!("{name} is missing"));
    let modes = value("basis_p");
    assert_eq!(value("snapshots"), 20.0);
    assert_eq!(value("all.rows"), 69.0 * 15.0);
    assert!(value("cubature.rows") <= 3.0 * modes + 1.0);
    assert_eq!((value("all.failures"), value("cubature.failures")), (0.0, 0.0));
    // Ten modes limit the accuracy of both; interpolation by Q-DEIM is not sufficient for a point contact.
    let worst = |name: &str| value(&format!("{name}.H_c_error_max"));
    assert!(worst("all") < 6e-3 && worst("cubature") < 1.5 * worst("all") && worst("q_deim") > 0.1);
    assert!(value("greedy.rows") > modes && value("q_deim.rows") > modes);
    assert!(outcome.tables.iter().any(|table| table.name == "samplings" && table.rows.len() == 4));

    let twice = COMPARISON.replace("greedy\"", "all\"");
    assert!(Scene::from_ron(&twice).unwrap_err().to_string().contains("study.samplings.name"));
}

#[test]
fn a_range_with_too_few_contacts_is_refused_in_a_sentence() {
    let folder = Scratch::new("few");
    folder.write("training.ron", TRAINING);
    let scene =
        Scene::from_ron(&COMPARISON.replace("Load: (30.0, 45.0, Linear)", "Load: (1e9, 1e10, Linear)")).unwrap();
    let sentence = run_scene(&scene, &mut Workbench::new(&*folder), &()).unwrap_err().to_string();
    assert!(sentence.contains("too few points") && sentence.contains("of 20 were found"), "{sentence}");
}
