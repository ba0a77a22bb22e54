//! Tests of the parts of an error: they add up, no solution is better than the best approximation, and the
//! discretisation part agrees with much finer grids.

use crate::solver::discrete::grid::{PointGridSpec, ReferenceGrid};
use crate::solver::full::{FullSolver, PointSolver, Solution, Start};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{ErrorSplitter, Online, ReducedModel, ReducedOptions, Sampling, SplitError};
use crate::solver::training::small::{self, POINT_GRID, line_grid};
use crate::solver::training::{Plan, TrainingSpec};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

fn model(sampling: Sampling) -> Arc<ReducedModel> {
    let middle = small::moes_with((20.0, 80.0), (6.0, 12.0), (9e-9, 18e-9), 3.2e9);
    let spec = TrainingSpec::new(middle, (20.0, 80.0), line_grid(300), Plan::FarthestPoint { snapshots: 50 });
    let spec = TrainingSpec { deformation_loss: 1e-7, sampling, evidence: 0, ..spec };
    small::trained(&spec)
}

fn points() -> Vec<OperatingPoint> {
    [(25.0, 7.0), (40.0, 10.0), (70.0, 11.0)]
        .map(|(m, l)| si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap())
        .to_vec()
}

fn full(grid: &Arc<ReferenceGrid>, point: &OperatingPoint) -> Solution {
    let solution = FullSolver::on(Arc::clone(grid)).solve(point, Lubricant::default(), Start::Cold, &()).unwrap();
    assert!(solution.converged());
    solution
}

#[test]
fn the_parts_add_up_to_what_verification_and_extrapolation_see() {
    let model = model(Sampling::QDeim);
    let mut splitter = ErrorSplitter::new(Arc::clone(&model), ReducedOptions::default());
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    let grid = model.windows[0].grid.line().unwrap();
    let finer = grid.refined().unwrap();
    for point in points() {
        let split = splitter.split(&point, Lubricant::default(), &()).unwrap();
        online.forget();
        let solved = online.solve(&point, Lubricant::default()).unwrap();
        let reduced = online.scalars(&solved).unwrap();
        let (full, finer) = (full(grid, &point).scalars, full(&finer, &point).scalars);
        for (parts, reduced, full) in [(split.h_c, reduced.h_c, full.h_c), (split.h_min, reduced.h_min, full.h_min)] {
            assert!((parts.reduction() - (reduced / full - 1.0)).abs() < 1e-9, "{parts:?}");
            let sum: f64 = parts.named().iter().map(|part| part.1).sum();
            assert!((parts.whole() - sum).abs() < 1e-15);
        }
        let limit = (4.0 * finer.h_c - full.h_c) / 3.0;
        assert!((split.h_c.whole() - (reduced.h_c - limit) / full.h_c).abs() < 1e-8);
        // No solution in the basis is closer to the pressure than the best approximation.
        let pressure = split.pressure;
        assert!(pressure.basis <= pressure.reduction * (1.0 + 1e-6), "{pressure:?}");
        assert!(pressure.basis > 1e-9 && pressure.sampling < pressure.reduction + pressure.basis, "{pressure:?}");
    }
}

#[test]
fn all_rows_have_no_sampling_error_and_few_modes_a_basis_error() {
    let model = model(Sampling::All);
    let few = ReducedOptions { pressure_modes: Some(20), ..ReducedOptions::default() };
    let point = points()[1];
    let split = |options| ErrorSplitter::new(Arc::clone(&model), options).split(&point, Lubricant::default(), &());
    let (all, few) = (split(ReducedOptions::default()).unwrap(), split(few).unwrap());
    assert!(all.h_c.sampling.abs() < 1e-12 && all.pressure.sampling < 1e-12, "{all:?}");
    assert!(few.pressure.basis > 3.0 * all.pressure.basis, "{:?} {:?}", few.pressure, all.pressure);
    assert_eq!(few.h_c.discretisation, all.h_c.discretisation, "the basis has no part in it");
}

#[test]
fn the_discretisation_part_is_what_much_finer_grids_say() {
    let model = model(Sampling::QDeim);
    let mut splitter = ErrorSplitter::new(Arc::clone(&model), ReducedOptions::default());
    let coarse = model.windows[0].grid.line().unwrap();
    let finest = coarse.refined().unwrap().refined().unwrap();
    let limit = finest.refined().unwrap();
    for point in points() {
        let split = splitter.split(&point, Lubricant::default(), &()).unwrap();
        let here = full(coarse, &point).scalars;
        let (a, b) = (full(&finest, &point).scalars, full(&limit, &point).scalars);
        let error = |here: f64, a: f64, b: f64| here - (4.0 * b - a) / 3.0;
        let (h_c, h_min) = (error(here.h_c, a.h_c, b.h_c) / here.h_c, error(here.h_min, a.h_min, b.h_min) / here.h_min);
        assert!((split.h_c.discretisation / h_c - 1.0).abs() < 0.01, "{:e} against {h_c:e}", split.h_c.discretisation);
        assert!(
            (split.h_min.discretisation / h_min - 1.0).abs() < 0.2,
            "{:e} against {h_min:e}",
            split.h_min.discretisation
        );
    }
}

#[test]
fn a_point_contacts_error_has_the_same_parts() {
    let training = TrainingSpec { deformation_loss: 1e-3, rows_per_mode: 4.0, ..small::point(Sampling::Cubature, 16) };
    let model = small::trained(&training);
    let point = OperatingPoint {
        kind: ContactKind::Point,
        radius_m: 10.4e-3,
        speed_m_per_s: 2.6,
        load: 38.0,
        alpha_per_pa: 9.7e-9,
        ..points()[0]
    };
    let split = ErrorSplitter::new(Arc::clone(&model), ReducedOptions::default())
        .split(&point, Lubricant::default(), &())
        .unwrap();
    let solved =
        |spec| PointSolver::new(spec).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap().scalars;
    let (full, finer) = (solved(POINT_GRID), solved(PointGridSpec::uniform(0.03, 0.05, (-2.7, 1.5, -1.5))));
    let reduction = |reduced: f64, full: f64| reduced / full - 1.0;
    assert!((split.h_c.reduction() - reduction(split.scalars.h_c, full.h_c)).abs() < 1e-6, "{:?}", split.h_c);
    assert!((split.h_min.reduction() - reduction(split.scalars.h_min, full.h_min)).abs() < 1e-6, "{:?}", split.h_min);
    let limit = finer.h_c + (finer.h_c - full.h_c) / 3.0;
    assert!(
        (split.h_c.discretisation - (full.h_c - limit) / full.h_c).abs() < 1e-5,
        "{:?} {full:?} {finer:?}",
        split.h_c
    );
    let pressure = split.pressure;
    assert!(pressure.basis > 1e-6 && pressure.basis <= pressure.reduction * (1.0 + 1e-6), "{pressure:?}");
    assert!(
        split.h_c.discretisation.abs() > split.h_c.reduction().abs(),
        "a coarse grid costs more than the reduction"
    );
}

#[test]
fn a_split_can_be_stopped_and_says_what_failed() {
    let model = model(Sampling::QDeim);
    let mut splitter = ErrorSplitter::new(model, ReducedOptions::default());
    let stop = AtomicBool::new(true);
    let error = splitter.split(&points()[1], Lubricant::default(), &stop).unwrap_err();
    assert_eq!(error, SplitError::Cancelled);
    splitter.split(&points()[1], Lubricant::default(), &()).unwrap();
    let bad = OperatingPoint { load: -1.0, ..points()[0] };
    assert!(splitter.split(&bad, Lubricant::default(), &()).unwrap_err().to_string().contains("load"));
}
