//! The embedded reduced model of elliptical contacts against full solutions on its own grids.

use ehl_explorer::engine::embedded;
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::parameters::{Axis, ParameterSpace, Quantity};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::lubricant::Lubricant;
use ehl_explorer::solver::reduced::{Online, ReducedOptions, Trust};
use ehl_explorer::solver::training::random_points;

fn points(count: usize, seed: u64) -> Vec<OperatingPoint> {
    let axes = [(Quantity::M, (10.0, 10_000.0)), (Quantity::L, (2.0, 12.0)), (Quantity::RadiusRatio, (0.5, 200.0))];
    let range = ParameterSpace::of(axes.map(|(quantity, ends)| Axis::new(quantity, ends)))
        .limited([(Quantity::HertzPressure, (0.0, 2.2e9)), (Quantity::FilmThickness, (0.02, 0.6))]);
    random_points(&range, ContactKind::Point, count, seed)
}

/// Shared by the tests, since its operators take a second.
#[test]
fn random_ellipses_agree_with_full_solutions() {
    let mut online = Online::new(embedded("ellipse").unwrap(), ReducedOptions::default());
    for point in points(300, 51) {
        online.forget();
        let solved = online.solve(&point, Lubricant::default()).unwrap_or_else(|e| panic!("{:?}: {e}", point.moes()));
        assert_eq!(solved.trust, Trust::Trained);
        assert!(solved.error.is_some_and(|error| error.h_c.bound > 0.0 && error.h_min.bound > 0.0));
    }
    // `random_test_ellipse.ron` compares hundreds.
    for point in points(6, 52) {
        let solved = online.solve(&point, Lubricant::default()).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        let grid = &online.model.window_at(&point).grid;
        let full = ContactSolver::on(grid).solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(full.converged() && fields.x == full.x && fields.y == full.y);
        let errors =
            [fields.scalars.h_c / full.scalars.h_c - 1.0, 0.3 * (fields.scalars.h_min / full.scalars.h_min - 1.0)];
        assert!(errors.iter().all(|error| error.abs() < 1e-2), "{errors:?} at {:?}", point.moes());
        assert!((fields.scalars.h_c / solved.h_c - 1.0).abs() < 1e-6);
        assert!(fields.scalars.load_residual < 1e-9);
    }
    // Over the radius ratio, through both local models: the film thickness increases with the width of the contact.
    let circle = si_from_moes(&MoesRequest::new(ContactKind::Point, 60.0, 8.0)).unwrap();
    let films: Vec<f64> = (0..40)
        .map(|k| {
            let point = Quantity::RadiusRatio.at(&circle, 0.5 * 16f64.powf(f64::from(k) / 39.0));
            let solved = online.solve(&point, Lubricant::default()).unwrap();
            online.scalars(&solved).unwrap().h_c * point.hertz().half_width_m.powi(2)
        })
        .collect();
    assert!(films.is_sorted_by(|a, b| a < b), "{films:?}");
}
