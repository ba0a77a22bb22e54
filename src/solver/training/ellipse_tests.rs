//! Tests of models of elliptical contacts: agreement with full solutions of every shape in any order, and refusal
//! outside the range.

use super::small::{self, ellipses, with_ends};
use super::*;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::{ContactSolver, Start};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, Ellipse, OperatingPoint};
use crate::solver::reduced::{Online, ReducedError, ReducedModel, ReducedOptions, Sampling, Shapes, Trust};
use faer::Mat;
use std::sync::Arc;

fn trained(sampling: Sampling) -> (TrainingSpec, Arc<ReducedModel>) {
    let spec = ellipses(sampling, 60);
    let model = small::trained(&spec);
    (spec, model)
}

/// Returns the largest relative error of H_c at new points.
fn worst(spec: &TrainingSpec, model: &Arc<ReducedModel>) -> f64 {
    let mut online = Online::new(Arc::clone(model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let mut worst = 0.0;
    for point in random_points(&spec.range, spec.contact(), 12, 77) {
        let solved = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let fields = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
        assert!(truth.converged());
        worst = f64::max(worst, (solved.h_c / truth.scalars.h_c - 1.0).abs());
        assert!((fields.scalars.h_c / solved.h_c - 1.0).abs() < 1e-8, "the film of the fields is that of the solve");
        assert!(fields.scalars.load_residual < 1e-9);
    }
    worst
}

#[test]
fn ellipse_models_agree_with_full_solutions() {
    for sampling in [Sampling::All, Sampling::Cubature] {
        let (spec, model) = trained(sampling);
        assert_eq!((model.windows.len(), model.domain.space.radius_ratio()), (2, (0.5, 4.0)));
        let worst = worst(&spec, &model);
        assert!(worst < 0.015, "{sampling:?}: {worst:.1e}");
    }
}

#[test]
fn earlier_solves_do_not_matter_and_other_shapes_are_refused() {
    let (spec, model) = trained(Sampling::Cubature);
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    let points = random_points(&spec.range, spec.contact(), 4, 5);
    let mut solve = |point: &OperatingPoint| {
        online.forget();
        online.solve(point, spec.lubricant)
    };
    let once: Vec<f64> = points.iter().map(|point| solve(point).unwrap().h_c).collect();
    let again: Vec<f64> = points.iter().rev().map(|point| solve(point).unwrap().h_c).collect();
    assert!(once.iter().eq(again.iter().rev()));
    // A circular contact lies inside; its shape comes from the same interpolation.
    let circle = OperatingPoint { radius_y_m: None, ..points[0] };
    assert_eq!(solve(&circle).unwrap().trust, Trust::Trained);
    for ratio in [0.2, 20.0] {
        let refused = solve(&Quantity::RadiusRatio.at(&circle, ratio)).unwrap_err();
        assert_eq!(refused, ReducedError::Ellipse { given: ratio, known: (0.5, 4.0) });
        assert!(
            refused.to_string().contains("a ratio of radii from 0.5 to 4 only")
                && refused.without_solution() == Some(0)
        );
    }
    let beside = Quantity::RadiusRatio.at(&circle, 4.1);
    assert!(
        matches!(solve(&beside).map(|solved| solved.trust), Ok(Trust::Outside(why)) if why.to_string().starts_with("the ratio of radii = 4.1"))
    );
}

/// Deformations of any shape in the range agree with those of its own kernel.
#[test]
fn shapes_interpolate_the_deformation_of_every_ellipse() {
    let grid = super::small::POINT_GRID.build().unwrap();
    let ny = grid.ny();
    let modes = Mat::from_fn(grid.len(), 2, |node, k| {
        let (x, y) = (grid.x[node / ny], grid.y[node % ny]);
        let hill = (1.0 - x * x - y * y).max(0.0).sqrt();
        if k == 0 { hill } else { hill * (3.0 * x).sin() }
    });
    let shapes = Shapes::new(&grid, (0.5, 2.0)).unwrap();
    for ratio in [0.5, 0.61, 1.0, 1.7, 2.0] {
        let ellipse = Ellipse::of_ratio(ratio).unwrap();
        let exact = ContactGrid::Point(grid.of_ellipse(ellipse).unwrap()).flex(&modes);
        let own = shapes.flexed_at(&modes, &ellipse);
        let largest = (0..grid.len()).map(|i| exact[(i, 0)].abs()).fold(0.0, f64::max);
        for (i, k) in (0..grid.len()).flat_map(|i| [(i, 0), (i, 1)]) {
            assert!((own[(i, k)] - exact[(i, k)]).abs() < 3e-6 * largest, "R_y/R {ratio}, node {i}");
        }
    }
}

#[test]
fn ranges_and_windows_that_fit_no_ellipse_are_refused() {
    let good = ellipses(Sampling::All, 20);
    let Windows::Given(windows) = good.windows.clone() else { panic!() };
    let [first, second] = [windows[0], windows[1]];
    let refused = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    let with = |windows: Vec<WindowSpec>| TrainingSpec { windows: Windows::Given(windows), ..good.clone() };
    assert!(good.check().is_ok());
    let beyond = WindowSpec { radius_ratio: Some((1.4, 9.0)), ..second };
    assert!(refused(with(vec![first, beyond])).contains("radius_ratio 1.4…9"));
    assert!(refused(with(vec![second, first])).contains("ascending order"));
    let none = WindowSpec { radius_ratio: None, ..second };
    assert!(refused(with(vec![first, none])).contains("radius_ratio"));
    let line = WindowSpec::new((1.0, 500.0), super::small::line_grid(240));
    assert!(refused(with(vec![line])).contains("elliptical contacts"));
    for radius_ratio in [(f64::NAN, 2.0), (0.01, 2.0), (2.0, 0.5)] {
        let range = with_ends(&good.range, Quantity::RadiusRatio, radius_ratio);
        assert!(refused(TrainingSpec { range, ..good.clone() }).contains("range.axes.RadiusRatio"));
    }
    let ruptured = good.clone().under(crate::solver::physics::lubricant::Cavitation::Complementarity);
    assert!(refused(ruptured).contains("penalty"));
    assert_eq!(good.contact(), ContactKind::Point);
}
