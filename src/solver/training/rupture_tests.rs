//! Tests of models with complementarity: agreement with full solutions of the same cavitation model, including the
//! cavitation boundary.

use super::small::{line, line_grid, point, sliding_oils, sliding_oils_of_points, trained};
use super::*;
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::full::{ContactSolver, Solution, Start};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Sampling, fronts};
use std::sync::Arc;

fn ruptured(spec: TrainingSpec) -> TrainingSpec {
    spec.under(Cavitation::Complementarity)
}

fn on(grid: GridSpec, spec: TrainingSpec) -> TrainingSpec {
    TrainingSpec { windows: Windows::Given(vec![WindowSpec::new((1.0, 500.0), grid)]), ..spec }
}

/// Returns the largest relative errors of H_c and, if available, of traction at new points, and the largest distance
/// of the cavitation boundary from that of the full solutions.
fn errors(spec: &TrainingSpec, model: &Arc<ReducedModel>) -> ([f64; 2], usize) {
    let grid = &model.windows[0].grid;
    let mut online = Online::new(Arc::clone(model), ReducedOptions::default());
    let mut full = ContactSolver::on(grid);
    let (mut worst, mut off) = ([0.0; 2], 0);
    for point in random_points(&spec.range, spec.contact(), 16, 77) {
        online.forget();
        let solved = online.solve(&point, spec.lubricant).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
        assert!(truth.converged());
        worst[0] = f64::max(worst[0], (solved.h_c / truth.scalars.h_c - 1.0).abs());
        if let Some(traction) = solved.traction {
            worst[1] = f64::max(worst[1], (traction / truth.traction_coefficient() - 1.0).abs());
        }
        // Pressures of modes that share a basis are computed in single precision, and the deformation is ten times
        // the film thickness.
        let (shares, apart) = (model.windows[0].pressure.combined().is_some(), fields.scalars.h_c / solved.h_c - 1.0);
        let digits = if shares { 1e-6 } else { 1e-8 };
        assert!(apart.abs() < digits, "{:?}: the film of the fields is by {apart:.1e} another", spec.contact());
        let true_fronts = fronts(grid, |node| truth.pressure[node]);
        off = true_fronts.iter().zip(&solved.fronts).map(|(a, b)| a.abs_diff(*b)).fold(off, usize::max);
        assert_eq!(true_fronts.len(), solved.fronts.len());
        assert!(fields.pressure.iter().all(|p| *p >= 0.0));
        assert!(fields.pressure.iter().zip(&fields.multiplier).all(|(p, multiplier)| p * multiplier == 0.0));
        let highest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        assert!((highest(&fields.multiplier) / highest(&truth.multiplier) - 1.0).abs() < 0.1);
        let missed = missed_by_multiplier(&fields, grid) / highest(&fields.multiplier);
        assert!(missed < 1e-9, "{:?}: λ balances the rows but for {missed:.1e}", spec.contact());
    }
    (worst, off)
}

/// Returns the largest difference between λ and the value that balances the rows behind the boundary, with every node
/// evaluated by its law.
fn missed_by_multiplier(fields: &Solution, grid: &ContactGrid) -> f64 {
    let gradient = PlaneGradient::new(&fields.x, &fields.y);
    let nodes = Nodes::of(fields.problem.laws(), &gradient, &fields.pressure, &fields.film);
    let behind = (0..grid.unknowns()).filter(|unknown| fields.multiplier[grid.node(*unknown)] != 0.0);
    let missed = behind.map(|unknown| {
        let (stencil, geometry) = grid.row(unknown);
        let row = nodes.row(&geometry.scaled(fields.mesh.scale), 0.0, stencil);
        (row.value + fields.multiplier[grid.node(unknown)]).abs()
    });
    missed.fold(0.0, f64::max)
}

#[test]
fn line_models_agree_with_full_complementarity() {
    let uniform = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
    for (grid, sampling) in [
        (line_grid(240), Sampling::All),
        (line_grid(240), Sampling::QDeim),
        (uniform, Sampling::QDeim),
        (uniform, Sampling::Cubature),
    ] {
        let spec = ruptured(on(grid, line(sampling, 50)));
        let model = trained(&spec);
        assert_eq!(model.domain.lubricant.cavitation, Cavitation::Complementarity);
        let ([worst, _], off) = errors(&spec, &model);
        assert!(worst < 2e-3 && off <= 1, "{grid:?}, {sampling:?}: H_c {worst:.1e}, {off} nodes");
    }
}

#[test]
fn the_boundary_is_found_from_any_start() {
    let spec = ruptured(line(Sampling::QDeim, 50));
    let model = trained(&spec);
    let points = random_points(&spec.range, ContactKind::Line, 6, 3);
    let mut moved = ReducedModel::clone(&model);
    for snapshot in &mut moved.windows[0].snapshots {
        snapshot.fronts[0] -= 3;
    }
    let (mut own, mut other) =
        (Online::new(model, ReducedOptions::default()), Online::new(Arc::new(moved), ReducedOptions::default()));
    let solve = |online: &mut Online, k: usize| {
        online.forget();
        online.solve(&points[k], spec.lubricant).unwrap()
    };
    let first: Vec<_> = (0..points.len()).map(|k| solve(&mut own, k)).collect();
    for (k, solved) in first.iter().enumerate().rev() {
        assert_eq!(solve(&mut own, k), *solved);
        let found = solve(&mut other, k);
        assert!(found.fronts[0].abs_diff(solved.fronts[0]) <= 1 && (found.h_c / solved.h_c - 1.0).abs() < 1e-4);
    }
}

#[test]
fn point_models_are_near_full_complementarity() {
    let spec = ruptured(point(Sampling::Cubature, 24));
    let model = trained(&spec);
    let ([worst, _], off) = errors(&spec, &model);
    assert!(worst < 6e-3 && off <= 2, "H_c {worst:.1e}, {off} nodes");
}

#[test]
fn shear_thinning_models_agree_with_full_complementarity() {
    for (spec, allowed) in [(sliding_oils(Sampling::QDeim, 60), 2e-3), (sliding_oils_of_points(70), 6e-3)] {
        let spec = ruptured(spec);
        let model = trained(&spec);
        let ([film, traction], off) = errors(&spec, &model);
        let told = format!("{:?}: H_c {film:.1e}, traction {traction:.1e}, {off} nodes", spec.contact());
        assert!(film < allowed && traction < allowed && traction > 0.0 && off <= 2, "{told}");
    }
}
