//! The embedded model of shear-thinning point contacts: it converges in its range, agrees with full solutions, and
//! reports its limits. Also a training of such a model on a coarse grid.

use crate::common::scene_files;
use crate::shear_models;
use crate::shear_models::{assert_file_keeps_everything, assert_limits_are_said, assert_mirrored, errors, narrowed};
use ehl_explorer::scene::named_lubricant::{SQUALANE_PIP, by_name};
use ehl_explorer::scene::study::dimensions::Dimensions;
use ehl_explorer::scene::study::sweep::Sweep;
use ehl_explorer::scene::{Axis, Steps, Study};
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::parameters::{ParameterSpace, Quantity};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::reduced::{Online, ReducedModel, ReducedOptions, Sampling, Trust};
use ehl_explorer::solver::training::{Plan, TrainingSpec, train};
use std::sync::Arc;

const POINT: ContactKind = ContactKind::Point;

fn range() -> ParameterSpace {
    shear_models::range(POINT)
}

fn online() -> Online {
    shear_models::online(POINT)
}

fn points(range: &ParameterSpace, count: usize, seed: u64) -> Vec<OperatingPoint> {
    shear_models::points(POINT, range, count, seed)
}

/// Returns the largest errors of H_c, H_min and, with sliding, traction at the first points. All solves must converge.
fn greatest_errors(online: &mut Online, points: &[OperatingPoint], compared: usize) -> [f64; 3] {
    let mut full = ContactSolver::on(&online.model.windows[0].grid);
    let mut worst = [0.0f64; 3];
    for (k, point) in points.iter().enumerate() {
        online.forget();
        let solved = online.solve(point, SQUALANE_PIP).unwrap_or_else(|error| panic!("{point:?}: {error}"));
        assert_eq!(solved.trust, Trust::Trained, "{point:?}");
        if k >= compared {
            continue;
        }
        let reduced = online.reconstruct(&solved).unwrap();
        let truth = full.solve(point, SQUALANE_PIP, Start::Cold, &()).unwrap();
        assert!(truth.converged());
        let [h_c, h_min, traction] = errors(&reduced, reduced.traction_coefficient(), &truth);
        let traction = if truth.traction_warning().is_none() { traction } else { 0.0 };
        for (worst, error) in worst.iter_mut().zip([h_c, h_min, traction]) {
            *worst = worst.max(error);
        }
    }
    println!("greatest errors of H_c, H_min and traction: {worst:?}");
    worst
}

#[test]
fn it_solves_its_range_and_agrees_with_full_solutions() {
    // `random_test_embedded_point_shear.ron` compares more of them.
    let [h_c, h_min, traction] = greatest_errors(&mut online(), &points(&range(), 80, 78), 3);
    assert!(h_c < 5e-3 && h_min < 2e-2 && traction < 5e-3, "{h_c:.1e} {h_min:.1e} {traction:.1e}");
}

#[test]
fn reversed_sliding_mirrors_and_unit_plateau_is_newtonian() {
    // Initial guesses differ, and the iteration ends with steps below 1e-5.
    assert_mirrored(online(), points(&range(), 1, 3)[0], 1e-5);
}

#[test]
fn what_it_was_not_trained_for_is_said() {
    let base = points(&range(), 1, 3)[0];
    // M and L of its range, but with a pressure above the trained range.
    let [m, l] = [Quantity::M, Quantity::L].map(|own| range().axis(own).unwrap().ends.1);
    let heaviest = narrowed(range(), [(Quantity::M, (0.9 * m, m)), (Quantity::L, (0.9 * l, l))]);
    let heavy = points(&ParameterSpace { limits: Vec::new(), ..heaviest }, 1, 3)[0];
    let further = [(OperatingPoint { load: 1e3 * base.load, ..base }, "M ="), (heavy, "p_H")];
    assert_limits_are_said(&online(), base, &further);
}

#[test]
fn another_lubricant_is_solved_and_reported() {
    // Table 3.8, as used in Figs. 3.15 and 3.16.
    let pao = by_name("pao-650").unwrap();
    let point = OperatingPoint {
        kind: POINT,
        radius_m: 12.7e-3,
        speed_m_per_s: 0.074,
        load: 32.0,
        modulus_pa: 123.878213951e9,
        viscosity_pa_s: 1.42,
        alpha_per_pa: 1.9e-8,
        sliding: Sliding { slide_to_roll_ratio: 0.1, newtonian_plateau_ratio: None },
        radius_y_m: None,
    };
    let mut online = online();
    let solved = online.solve(&point, pao.laws).unwrap();
    assert!(
        matches!(&solved.trust, Trust::Outside(why) if why.to_string().contains("lubricant")),
        "{:?}",
        solved.trust
    );
    let reduced = online.reconstruct(&solved).unwrap();
    let grid = online.model.windows[0].grid.clone();
    let full = ContactSolver::on(&grid).solve(&point, pao.laws, Start::Cold, &()).unwrap();
    let off = (reduced.scalars.h_c / full.scalars.h_c - 1.0).abs();
    let friction = (reduced.traction_coefficient() / full.traction_coefficient() - 1.0).abs();
    assert!(off < 5e-2 && friction < 5e-2, "H_c {off:.1e}, traction {friction:.1e}");
    // With the lubricant of the model the film thickness would be quite different.
    let own = online.solve(&point, SQUALANE_PIP).unwrap();
    assert!((online.scalars(&own).unwrap().h_c / full.scalars.h_c - 1.0).abs() > 2.0 * off);
}

#[test]
fn its_file_keeps_what_a_shear_thinning_lubricant_adds() {
    assert_file_keeps_everything(POINT);
}

fn small() -> (ParameterSpace, TrainingSpec) {
    let m = (30.0, 45.0);
    let ends = [(Quantity::M, m), (Quantity::L, (7.0, 9.0)), (Quantity::NewtonianPlateauRatio, (0.2, 0.5))];
    let range = narrowed(range(), ends);
    let grid = GridSpec::Plane(PointGridSpec::uniform(0.06, 0.1, (-2.7, 1.5, -1.5)));
    let plan = Plan::FarthestPoint { snapshots: 28 };
    let spec = TrainingSpec {
        lubricant: SQUALANE_PIP,
        pressure_loss: 1e-4,
        deformation_loss: 1e-4,
        sampling: Sampling::Cubature,
        rows_per_mode: 3.0,
        penalty: 1e5,
        positive_modes: true,
        evidence: 0,
        seed: 4,
        ..TrainingSpec::new(range.clone(), m, grid, plan)
    };
    (range, spec)
}

#[test]
fn training_makes_such_a_model() {
    let (range, spec) = small();
    let model = train(&spec, &()).unwrap();
    let ReducedModel { windows, domain, .. } = &model;
    assert!(windows[0].sampled_rows.len() <= 3 * windows[0].pressure.count());
    assert_eq!(domain.highest_pressure_pa(), range.interval(Quantity::HertzPressure, POINT).unwrap().1);
    let [h_c, h_min, traction] =
        greatest_errors(&mut Online::new(Arc::new(model), ReducedOptions::default()), &points(&range, 40, 11), 8);
    assert!(h_c < 5e-3 && h_min < 1e-2 && traction < 5e-3, "{h_c:.1e} {h_min:.1e} {traction:.1e}");
}

#[test]
fn a_figure_stands_side_by_side_in_full_and_reduced() {
    // Two of its contacts. The tests of scenes solve every contact of the figures marked `quick`.
    let name = "fig_3_16";
    let mut scene = scene_files::read(name);
    scene.expect.retain(|expectation| !expectation.name.contains('['));
    if let Study::Sweep(Sweep { over, .. }) = &mut scene.study {
        over.iter_mut().for_each(|axis| axis.values = Steps::List(vec![axis.values.values()[0]]));
        if let Some(Axis { values, .. }) = over.last_mut() {
            *values = Steps::List(vec![0.1, 0.5]);
        }
    }
    let outcome = scene_files::run(name, &scene);
    let short: Vec<_> = outcome.verdicts.iter().filter(|verdict| !verdict.holds).collect();
    assert!(short.is_empty() && outcome.verdicts.len() >= 3, "{name}: {short:?}");
}

#[test]
fn dimensions_grow_as_less_may_be_lost() {
    let mut scene = scene_files::read("table_3_7");
    let plane = PointGridSpec::uniform(0.06, 0.1, (-2.7, 1.5, -1.5));
    scene.grid = ehl_explorer::scene::Grid::Plane(plane);
    if let Study::Dimensions(Dimensions { over, .. }) = &mut scene.study {
        over[0].values = Steps::Log { from: 0.4, to: 2.0, n: 4 };
        over[1].values = Steps::List(vec![0.2, 0.6]);
    }
    let outcome = scene_files::run("table_3_7", &scene);
    let value = |name: &str| outcome.found.value(name, None).unwrap();
    assert_eq!((value("snapshots"), value("full_failures")), (24.0, 0.0));
    assert_eq!(value("dofs"), 2.0 * value("nodes_x") * value("nodes_y") + 1.0);
    let of = |field: &str| ["1e-3", "1e-4", "1e-5"].map(|loss| value(&format!("basis_{field}[{loss}]")));
    let (p, delta) = (of("p"), of("delta"));
    assert!(p[0] < p[1] && p[1] <= p[2] && p[2] <= 24.0, "{p:?}");
    // Deformations are smoother than pressures.
    assert!(delta.iter().zip(&p).all(|(delta, p)| delta <= p) && delta[0] < p[0], "{delta:?} {p:?}");
}
