//! Iterations of full solves. They show a change of equations, preconditioner or step control before the time does.

use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use ehl_explorer::solver::physics::lubricant::Lubricant;

fn newtonian(kind: ContactKind, m: f64, l: f64) -> (OperatingPoint, Lubricant) {
    (si_from_moes(&MoesRequest::new(kind, m, l)).unwrap(), Lubricant::default())
}

fn thinning(kind: ContactKind, load: f64) -> (OperatingPoint, Lubricant) {
    let sliding = Sliding { slide_to_roll_ratio: 0.5, newtonian_plateau_ratio: Some(0.3) };
    let quantities = [0.0127, 1.0, load, 1.2388e11, 0.0705, 2e-8];
    (OperatingPoint::from_quantities(kind, quantities, sliding), SQUALANE_PIP)
}

#[test]
fn newton_and_krylov_iterations_of_cold_solves_are_counted() {
    use ContactKind::{Line, Point};
    let coarse = PointGridSpec { dx: 0.04, dy: 0.1, ..PointGridSpec::DISSERTATION };
    for (grid, (point, lubricant), counts) in [
        (GridSpec::DISSERTATION, newtonian(Line, 40.0, 10.0), (14, 97)),
        (GridSpec::EXPLORER, newtonian(Line, 200.0, 5.0), (14, 117)),
        (GridSpec::EXPLORER, newtonian(Line, 3.0, 12.0), (10, 43)),
        (GridSpec::DISSERTATION, thinning(Line, 144e3), (18, 98)),
        (GridSpec::Plane(coarse), newtonian(Point, 8.0, 3.0), (11, 36)),
        (GridSpec::Plane(coarse), thinning(Point, 23.0), (10, 48)),
    ] {
        let mut solver = ContactSolver::on(&grid.build().unwrap());
        let report = solver.solve(&point, lubricant, Start::Cold, &()).unwrap().report;
        assert_eq!((report.newton_iterations, report.linear_iterations), counts, "{grid:?}, {point:?}");
    }
}
