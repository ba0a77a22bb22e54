//! Training a model of point contacts on a coarse grid: every sampling method, fresh points, and what is refused.

use super::*;
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::{ContactSolver, Start};
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Sampling};
use std::sync::Arc;

const GRID: PointGridSpec = PointGridSpec::uniform(0.06, 0.1, (-2.7, 1.5, -1.5));

fn small(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    TrainingSpec {
        title: "A corner of Table 3.4".to_owned(),
        range: Range::Box(QuantityBox {
            radius: (10e-3, 11e-3),
            speed: (2.0, 3.0),
            load: (30.0, 45.0),
            alpha: (8e-9, 11e-9),
            modulus: 231e9,
            viscosity: 0.01,
        }),
        lubricant: Lubricant::default(),
        plan: Plan::FarthestPoint { snapshots },
        windows: Windows::Given(vec![WindowSpec { m: (1.0, 2000.0), grid: ContactGridSpec::Point(GRID) }]),
        pressure_loss: 1e-4,
        deformation_loss: 1e-4,
        positive_modes: false,
        sampling,
        rows_per_mode: 3.0,
        penalty: 1e5,
        evidence: 0,
        seed: 2,
    }
}

fn films(model: &Arc<ReducedModel>) -> Vec<(f64, f64)> {
    let mut online = Online::new(Arc::clone(model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let range = small(Sampling::All, 4).range;
    let points = random_points(&range, ContactKind::Point, 12, 77);
    points
        .iter()
        .map(|point| {
            let solved = online.solve(point, Lubricant::default()).unwrap();
            let full = full.solve(point, Lubricant::default(), Start::Cold, &()).unwrap();
            assert!(full.converged());
            (online.scalars(&solved).unwrap().h_c, full.scalars.h_c)
        })
        .collect()
}

fn worst(films: &[(f64, f64)]) -> f64 {
    films.iter().map(|(reduced, full)| (reduced / full - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn a_point_model_solves_fresh_points_with_all_rows_and_with_few() {
    let all = Arc::new(train(&small(Sampling::All, 24), &()).unwrap());
    let few = Arc::new(train(&small(Sampling::Cubature, 24), &()).unwrap());
    let (modes, rows) = (few.windows[0].pressure.modes.ncols(), few.windows[0].sampled_rows.len());
    assert!(rows <= 3 * modes && 8 * rows < all.windows[0].sampled_rows.len(), "{rows} rows, {modes} modes");
    assert_eq!((few.windows[0].penalty, few.contact()), (1e5, ContactKind::Point));
    let (all, few) = (worst(&films(&all)), worst(&films(&few)));
    assert!(all < 3e-3 && few < 6e-3, "H_c: {all:.1e} with all rows, {few:.1e} with few");
}

#[test]
fn the_same_specification_gives_the_same_point_model() {
    let spec = TrainingSpec {
        plan: Plan::WorstOfPool {
            start: 12,
            indicator: Indicator::Correction,
            pool: 8,
            per_round: 2,
            tolerance: 1e-4,
            limit: 16,
        },
        evidence: 100,
        ..small(Sampling::Cubature, 0)
    };
    let [a, b] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| train(&spec, &()).unwrap())
    });
    assert_eq!(a.windows[0].sampled_rows, b.windows[0].sampled_rows);
    assert_eq!(a.windows[0].snapshots, b.windows[0].snapshots);
    assert_eq!(a.windows[0].calibration, b.windows[0].calibration);
    assert!(a.windows[0].calibration.is_some() && a.windows[0].snapshots.len() <= 16);
}

#[test]
fn grids_of_both_kinds_and_senseless_penalties_are_refused() {
    let given = |m, grid| WindowSpec { m, grid };
    let mixed = vec![
        given((1.0, 50.0), ContactGridSpec::Point(GRID)),
        given((50.0, 2000.0), ContactGridSpec::Line(GridSpec::EXPLORER)),
    ];
    let mixed = TrainingSpec { windows: Windows::Given(mixed), ..small(Sampling::All, 8) };
    assert!(mixed.check().unwrap_err().to_string().contains("one kind of contact"));
    for penalty in [0.0, f64::NAN, 1e12] {
        let error = TrainingSpec { penalty, ..small(Sampling::All, 8) }.check().unwrap_err();
        assert!(error.to_string().contains("penalty"), "{error}");
    }
}
