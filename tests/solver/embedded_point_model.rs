//! The embedded reduced models of point contacts compared with full solutions on their own grids.

use crate::common::cases::cases;
use ehl_explorer::engine::embedded;
use ehl_explorer::engine::{median, percentile};
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::parameters::ParameterSpace;
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant};
use ehl_explorer::solver::reduced::{Online, ReducedError, ReducedOptions, Trust};
use ehl_explorer::solver::training::random_points;

fn online() -> Online {
    Online::new(embedded("point").unwrap(), ReducedOptions::default())
}

fn points(count: usize, seed: u64) -> Vec<OperatingPoint> {
    random_points(&ParameterSpace::table_3_4(), ContactKind::Point, count, seed)
}

#[test]
fn random_contacts_of_its_box_are_solved_and_trusted() {
    let mut online = online();
    let mut iterations = Vec::new();
    for point in points(400, 41) {
        online.forget();
        let solved = online.solve(&point, Lubricant::default()).unwrap_or_else(|e| panic!("{:?}: {e}", point.moes()));
        assert_eq!(solved.trust, Trust::Trained);
        assert!(solved.error.is_some_and(|error| error.h_c.bound > 0.0 && error.h_min.bound > 0.0));
        iterations.push(solved.iterations as f64);
    }
    assert!(median(&iterations) <= 7.0, "{} iterations", median(&iterations));
}

#[test]
fn its_films_lie_near_full_solutions() {
    let mut online = online();
    let mut solver = ContactSolver::on(&online.model.windows[0].grid);
    let (mut h_c, mut h_min) = (Vec::new(), Vec::new());
    // `random_test_point.ron` compares 300 contacts.
    for point in points(cases(4, 16), 42) {
        let full = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(full.converged());
        let solved = online.solve(&point, Lubricant::default()).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        assert!(fields.mesh == full.mesh && fields.x == full.x && fields.y == full.y);
        // Near the boundary the modes are slightly negative; such pressures are omitted.
        assert!(fields.scalars.load_residual < 1e-4, "{:.1e}", fields.scalars.load_residual);
        h_c.push((fields.scalars.h_c / full.scalars.h_c - 1.0).abs());
        h_min.push((fields.scalars.h_min / full.scalars.h_min - 1.0).abs());
    }
    println!(
        "H_c {:.1e} / {:.1e}, H_min {:.1e} / {:.1e}",
        median(&h_c),
        percentile(&h_c, 1.0),
        median(&h_min),
        percentile(&h_min, 1.0)
    );
    assert!(median(&h_c) <= 1e-3 && percentile(&h_c, 1.0) <= 1e-2, "{h_c:?}");
    assert!(percentile(&h_min, 1.0) <= 2e-2, "{h_min:?}");
}

#[test]
fn light_films_agree_with_full_solutions() {
    let mut light = Online::new(embedded("point_light").unwrap(), ReducedOptions::default());
    let oil = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let mut solver = ContactSolver::on(&light.model.windows[0].grid);
    // `random_test_point_light_oils.ron` compares more of them.
    for point in random_points(&light.model.domain.space, ContactKind::Point, 4, 43) {
        let full = solver.solve(&point, oil, Start::Cold, &()).unwrap();
        let solved = light.solve(&point, oil).unwrap();
        assert!(full.converged() && solved.trust == Trust::Trained, "{:?}", point.moes());
        let fields = light.reconstruct(&solved).unwrap();
        let off = [fields.scalars.h_c / full.scalars.h_c - 1.0, fields.scalars.h_min / full.scalars.h_min - 1.0];
        assert!(off.iter().all(|off| off.abs() < 5e-3), "{off:?} at {:?}", point.moes());
    }
    // At the load between both models their film thicknesses differ by the discretisation errors of their grids.
    let mut heavy = online();
    for l in [2.0, 6.0, 12.0, 18.0] {
        let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 12.0, l)).unwrap();
        let of = |online: &mut Online| {
            let solved = online.solve(&point, oil).unwrap();
            let cost = online.model.windows[solved.window].grid_cost(&point).unwrap();
            (solved.h_c, cost.total())
        };
        let ((one, cost), (other, other_cost)) = (of(&mut light), of(&mut heavy));
        let apart = (one / other).ln().abs();
        assert!(apart < cost + other_cost + 5e-3, "L = {l}: {apart:.1e}, costs {cost:.1e} and {other_cost:.1e}");
    }
}

#[test]
fn dragging_gives_the_same_picture_as_jumping() {
    let (mut dragged, mut fresh) = (online(), online());
    let mut iterations = 0;
    for k in 0..40 {
        let moes = MoesRequest::new(ContactKind::Point, 40.0 * 1.03f64.powi(k), 4.0 + 0.05 * f64::from(k));
        let point = si_from_moes(&moes).unwrap();
        let a = dragged.solve(&point, Lubricant::default()).unwrap();
        fresh.forget();
        let b = fresh.solve(&point, Lubricant::default()).unwrap();
        iterations += a.iterations;
        let (a, b) = (dragged.scalars(&a).unwrap(), fresh.scalars(&b).unwrap());
        // The iteration ends with steps below 1e-5 of p̃; nodes at the cavitation boundary may still change sides.
        let difference = (a.h_c / b.h_c - 1.0).abs();
        assert!(difference < 1e-5, "H_c differs by {difference:.1e} at {:?}", point.moes());
    }
    assert!(iterations <= 40 * 6, "{iterations} iterations for 40 pictures");
}

#[test]
fn a_line_contact_is_refused_with_a_sentence() {
    let point = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
    let error = online().solve(&point, Lubricant::default()).unwrap_err();
    assert!(matches!(error, ReducedError::OtherContact { model: ContactKind::Point, given: ContactKind::Line }));
    assert!(error.to_string().contains("point contacts") && error.to_string().contains("line contact"), "{error}");
}
