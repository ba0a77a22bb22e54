//! The embedded models of sliding contacts with Eyring lubricants.

use ehl_explorer::engine::embedded;
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::reduced::{Online, ReducedOptions, ReducedSolution, Trust};
use ehl_explorer::solver::training::random_points;

/// Tractions below this belong to contacts that hardly slide.
const SMALL: f64 = 1e-4;

/// Asserts that film thicknesses and tractions over a model's whole range agree with full solutions on its grid.
fn lie_near_full_solutions(name: &str, contacts: usize) {
    let model = embedded(name).unwrap();
    let (kind, laws) = (model.contact(), model.domain.lubricant);
    let mut solver = ContactSolver::on(&model.windows[0].grid);
    let mut online = Online::new(model.clone(), ReducedOptions::default());
    for point in random_points(&model.domain.space, kind, contacts, 47) {
        let (full, solved) =
            (solver.solve(&point, laws, Start::Cold, &()).unwrap(), online.solve(&point, laws).unwrap());
        assert!(full.converged() && solved.trust == Trust::Trained, "{:?}", point.moes());
        let (own, wanted) = (solved.traction.unwrap(), full.traction_coefficient());
        let film = (solved.h_c / full.scalars.h_c - 1.0).abs();
        let traction = (own - wanted).abs() / wanted.abs().max(SMALL);
        assert!(
            film < 5e-3 && traction < 2e-2,
            "{film:.1e} and {traction:.1e} at {:?}, {:?}",
            point.moes(),
            point.sliding
        );
        assert!(solved.error.is_some_and(|error| error.h_c.bound < 0.1), "{:?}", point.moes());
    }
}

#[test]
fn sliding_lines_agree_with_full_solutions() {
    lie_near_full_solutions("line_sliding", 24);
}

#[test]
fn sliding_balls_agree_with_full_solutions() {
    lie_near_full_solutions("point_light_sliding", 4);
    lie_near_full_solutions("point_sliding", 3);
}

#[test]
fn larger_final_steps_give_the_same_results() {
    let model = embedded("point_sliding").unwrap();
    let laws = model.domain.lubricant;
    let points = random_points(&model.domain.space, model.contact(), 40, 48);
    let solved = [1e-3, ReducedOptions::default().tolerance].map(|tolerance| {
        let mut online = Online::new(model.clone(), ReducedOptions { tolerance, ..ReducedOptions::default() });
        points.iter().map(|point| online.solve(point, laws).unwrap()).collect::<Vec<_>>()
    });
    let [early, late] = &solved;
    for (early, late) in early.iter().zip(late) {
        let (own, wanted) = (early.traction.unwrap(), late.traction.unwrap());
        let (film, traction) = ((early.h_c / late.h_c - 1.0).abs(), (own - wanted).abs() / wanted.abs().max(SMALL));
        assert!(film < 1e-3 && traction < 2e-3, "{film:.1e}, {traction:.1e}, {:?}", late.point.moes());
    }
    let steps = |of: &[ReducedSolution]| of.iter().map(|solved| solved.iterations).sum::<usize>();
    assert!(steps(early) < steps(late));
}
