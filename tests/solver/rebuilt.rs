//! A model depends on its scene only: the same bytes on any number of threads.

use crate::common::scene_files;
use ehl_explorer::engine::model_file::to_bytes;
use ehl_explorer::scene::Study;
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::training::{Plan, TrainingSpec, Windows, train};

/// Returns the training of an embedded model with fewer full solutions, on a coarser grid.
fn small(scene: &str) -> TrainingSpec {
    let Study::Training(mut spec) = scene_files::read(scene).study else { panic!("{scene} is no training") };
    let si_box = spec.range.is_si_box();
    let shear_thinning = spec.range.varies(Quantity::NewtonianPlateauRatio);
    let thinning_line = shear_thinning && spec.contact() == ContactKind::Line;
    match &mut spec.plan {
        Plan::FarthestPoint { snapshots } => *snapshots = if thinning_line { 40 } else { 30 },
        Plan::WorstOfPool { start, pool, per_round, limit, .. } => {
            (*start, *pool, *per_round) = (12, 12, 2);
            *limit = if matches!(spec.windows, Windows::Automatic { .. }) { 40 } else { 16 };
        }
        plan => panic!("{plan:?}"),
    }
    for axis in &mut spec.range.axes {
        axis.ends = match axis.quantity {
            _ if thinning_line => axis.ends,
            Quantity::M if shear_thinning => (30.0, 45.0),
            Quantity::L if shear_thinning => (7.0, 9.0),
            Quantity::NewtonianPlateauRatio => (0.2, 0.5),
            Quantity::M => (20.0, 40.0),
            Quantity::L => (5.0, 10.0),
            Quantity::Radius if si_box => (10e-3, 11e-3),
            Quantity::Speed if si_box => (2.0, 3.0),
            Quantity::Load if si_box => (30.0, 45.0),
            _ => axis.ends,
        };
    }
    match &mut spec.windows {
        Windows::Automatic { modes } => *modes = 12,
        Windows::Anchored { count, modes, grid, shared, divided_by, .. } => {
            (*count, *modes, *divided_by) = (2, 16, 0);
            *grid = match grid {
                GridSpec::Plane(_) => {
                    *shared = 24;
                    GridSpec::Plane(PointGridSpec::uniform(0.08, 0.13, (-2.7, 1.5, -1.5)))
                }
                _ => GridSpec::Graded { nodes: 180, domain: (-8.0, 3.2), registered: true },
            };
        }
        Windows::Given(windows) => windows.iter_mut().for_each(|window| {
            window.grid = match window.grid {
                GridSpec::Plane(_) => GridSpec::Plane(PointGridSpec::uniform(0.08, 0.13, (-2.7, 1.5, -1.5))),
                _ => GridSpec::Graded { nodes: 240, domain: (-8.0, 3.2), registered: true },
            };
        }),
    }
    // Hardly more than a calibration needs; over its whole range the small model of lines that thin fails at many contacts.
    spec.evidence = if thinning_line { 300 } else { 110 };
    spec
}

fn the_same_bytes_on_one_and_on_three_threads(scene: &str) {
    let spec = small(scene);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| train(&spec, &()).unwrap())
    });
    assert!(one.windows.iter().all(|window| window.calibration.is_some()), "{:?}", one.log);
    assert_eq!(one.log, three.log);
    assert!(to_bytes(&one).unwrap() == to_bytes(&three).unwrap(), "{scene}");
}

#[test]
fn a_line_model_has_the_same_bytes_on_any_number_of_threads() {
    the_same_bytes_on_one_and_on_three_threads("slider_range_model");
}

#[test]
fn a_model_of_oils_has_the_same_bytes_on_any_number_of_threads() {
    the_same_bytes_on_one_and_on_three_threads("line_oils");
}

#[test]
fn a_point_model_has_the_same_bytes_on_any_number_of_threads() {
    the_same_bytes_on_one_and_on_three_threads("table_3_4_model");
}

#[test]
fn line_shear_model_does_not_depend_on_threads() {
    the_same_bytes_on_one_and_on_three_threads("embedded_shear_model");
}

#[test]
fn point_shear_model_does_not_depend_on_threads() {
    the_same_bytes_on_one_and_on_three_threads("embedded_point_shear_model");
}
