//! Tests of training a model of point contacts on a coarse grid: every sampling method, new points, and refusals.

use super::small::{POINT_GRID, point, trained};
use super::*;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{ContactSolver, Start};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Sampling};
use std::sync::Arc;

fn films(model: &Arc<ReducedModel>) -> Vec<(f64, f64)> {
    let mut online = Online::new(Arc::clone(model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let points = random_points(&point(Sampling::All, 4).range, ContactKind::Point, 12, 77);
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
    let all = trained(&point(Sampling::All, 24));
    let few = trained(&point(Sampling::Cubature, 24));
    let (modes, rows) = (few.windows[0].pressure.count(), few.windows[0].sampled_rows.len());
    assert!(rows <= 3 * modes && 8 * rows < all.windows[0].sampled_rows.len(), "{rows} rows, {modes} modes");
    assert_eq!((few.windows[0].penalty, few.contact()), (1e5, ContactKind::Point));
    let (all, few) = (worst(&films(&all)), worst(&films(&few)));
    assert!(all < 3e-3 && few < 6e-3, "H_c: {all:.1e} with all rows, {few:.1e} with few");
}

#[test]
fn grids_of_both_kinds_and_senseless_penalties_are_refused() {
    let given = |m, grid| WindowSpec::new(m, grid);
    let mixed = vec![given((1.0, 50.0), GridSpec::Plane(POINT_GRID)), given((50.0, 2000.0), GridSpec::EXPLORER)];
    let mixed = TrainingSpec { windows: Windows::Given(mixed), ..point(Sampling::All, 8) };
    assert!(mixed.check().unwrap_err().to_string().contains("one kind of contact"));
    for penalty in [0.0, f64::NAN, 1e12] {
        let error = TrainingSpec { penalty, ..point(Sampling::All, 8) }.check().unwrap_err();
        assert!(error.to_string().contains("penalty"), "{error}");
    }
}
