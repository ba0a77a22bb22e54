//! The embedded reduced model compared with full solutions on its own grid, across the edges of local models, and along
//! a dragged slider.

use ehl_explorer::engine::embedded;
use ehl_explorer::solver::full::{ContactSolver, Solution, Start};
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant};
use ehl_explorer::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use ehl_explorer::solver::training::random_points;
use std::sync::Arc;

fn at(m: f64, l: f64) -> OperatingPoint {
    si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap()
}

fn online() -> Online {
    Online::new(embedded("line").unwrap(), ReducedOptions::default())
}

/// Returns the largest difference of two pressures, the second interpolated linearly at the nodes of the first.
fn pressure_difference(a: &Solution, b: &Solution) -> f64 {
    let other = |x: f64| {
        let k = b.x.partition_point(|&v| v < x);
        if k == 0 || k == b.x.len() {
            return 0.0;
        }
        let t = (x - b.x[k - 1]) / (b.x[k] - b.x[k - 1]);
        (1.0 - t) * b.pressure[k - 1] + t * b.pressure[k]
    };
    a.x.iter().zip(&a.pressure).map(|(&x, p)| (p - other(x)).abs()).fold(0.0, f64::max)
}

#[test]
fn film_and_pressure_do_not_jump_from_window_to_window() {
    let mut online = online();
    let model = Arc::clone(&online.model);
    let mut worst = (0.0f64, 0.0f64);
    let mut borders = 0;
    for l in [1.0, 2.5, 5.0, 8.0, 12.0, 16.0, 20.0] {
        let window = |m: f64| model.window_for(&at(m, l));
        let inside = |m: f64| at(m, l).hertz().pressure_pa < 3.2e9;
        let steps = (0..=300).map(|k| 2.0 * 250f64.powf(f64::from(k) / 300.0)).filter(|m| inside(*m));
        let steps: Vec<f64> = steps.collect();
        for pair in steps.windows(2).filter(|pair| window(pair[0]) != window(pair[1])) {
            let (mut low, mut high) = (pair[0], pair[1]);
            while high / low > 1.0 + 1e-9 {
                let middle = (low * high).sqrt();
                if window(middle) == window(pair[0]) { low = middle } else { high = middle }
            }
            let [below, above] = [low, high].map(|m| {
                let solved = online.solve(&at(m, l), Lubricant::default()).unwrap();
                (solved.window, online.reconstruct(&solved).unwrap())
            });
            assert_ne!(below.0, above.0);
            let jump = (below.1.scalars.h_c / above.1.scalars.h_c - 1.0).abs();
            assert!(jump < 5e-4, "H_c jumps by {jump:.1e} at M = {low}, L = {l}");
            worst.0 = worst.0.max(jump);
            let jump = pressure_difference(&below.1, &above.1);
            assert!(jump < 5e-3, "P jumps by {jump:.1e} at M = {low}, L = {l}");
            worst.1 = worst.1.max(jump);
            borders += 1;
        }
    }
    assert!(borders > 20, "{borders} borders");
    println!("greatest jumps at {borders} borders: H_c {:.1e} (relative), P {:.1e}", worst.0, worst.1);
}

#[test]
fn corners_of_the_range_agree_with_full_solutions() {
    let mut online = online();
    for (m, l) in
        [(2.0, 1.0), (2.0, 20.0), (500.0, 1.0), (500.0, 2.8), (63.0, 20.0), (8.9, 20.0), (9.1, 1.0), (39.0, 10.0)]
    {
        let point = at(m, l);
        let reduced = online.solve(&point, Lubricant::default()).unwrap();
        assert_eq!(reduced.trust, Trust::Trained, "M = {m}, L = {l}");
        let picture = online.reconstruct(&reduced).unwrap();
        let mut solver = ContactSolver::on(&online.model.windows[reduced.window].grid);
        let full = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(full.converged());
        let error = (picture.scalars.h_c / full.scalars.h_c - 1.0).abs();
        assert!(error < 5e-4, "H_c differs by {error:.1e} at M = {m}, L = {l}");
        // The load is carried to rounding before negative pressures of the modes in the inlet are removed.
        assert!(picture.scalars.load_residual < 1e-6);
        assert!(picture.pressure.iter().all(|p| *p >= 0.0));
        assert!((picture.scalars.h_0 - full.scalars.h_0).abs() < 1e-3);
    }
}

#[test]
fn bounds_allow_for_what_a_penalty_moves_films_by() {
    let mut online = online();
    let laws = [Cavitation::Penalty, Cavitation::Complementarity];
    let laws = laws.map(|cavitation| Lubricant { cavitation, ..Lubricant::default() });
    let mut solver = ContactSolver::on(&online.model.windows[0].grid);
    let mut closest = 0.0f64;
    for (m, l) in [(3.0, 2.0), (10.0, 12.0), (30.0, 5.0), (100.0, 2.0), (100.0, 10.0), (300.0, 2.0), (500.0, 2.5)] {
        let [allows, knows] = laws.map(|oil| online.solve(&at(m, l), oil).unwrap().error.unwrap());
        let [penalty, exact] = laws.map(|oil| solver.solve(&at(m, l), oil, Start::Cold, &()).unwrap().scalars);
        for (allows, knows, penalty, exact) in [
            (allows.h_c.bound, knows.h_c.bound, penalty.h_c, exact.h_c),
            (allows.h_min.bound, knows.h_min.bound, penalty.h_min, exact.h_min),
        ] {
            let (moved, allowed) = ((penalty / exact - 1.0).abs(), allows - knows);
            assert!(moved < allowed && allowed < 5e-5, "{moved:.1e} of {allowed:.1e} at M = {m}, L = {l}");
            closest = closest.max(moved / allowed);
        }
    }
    assert!(closest > 0.5, "{closest}");
}

#[test]
fn neighbouring_local_models_are_reported_without_bounds() {
    let contact = at(40.0, 10.0);
    let mut model = ReducedModel::clone(&embedded("line").unwrap());
    let own = model.window_for(&contact);
    // A system of zero equations has no solution.
    model.windows[own].reconstruction.fill(0.0);
    let mut online = Online::new(Arc::new(model), ReducedOptions::default());
    let solved = online.solve(&contact, Lubricant::default()).unwrap();
    assert!(solved.by_neighbour && solved.window != own && solved.trust == Trust::Trained);
    assert_eq!(solved.error, None);
    let by_its_own = self::online().solve(&contact, Lubricant::default()).unwrap();
    assert!(!by_its_own.by_neighbour && by_its_own.window == own && by_its_own.error.is_some());
    let off = (solved.h_c / by_its_own.h_c - 1.0).abs();
    assert!(off < 1e-2, "{off:.1e}");
}

#[test]
fn rupture_lies_behind_the_last_pressure() {
    let mut online = online();
    let mut oils = online.model.domain.space.clone();
    assert!(oils.varies_lubricant());
    oils.axis_mut(Quantity::M).unwrap().ends = (4.0, 300.0);
    let oil = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let mut solver = ContactSolver::on(&online.model.windows[0].grid);
    let mut off = Vec::new();
    for point in random_points(&oils, ContactKind::Line, 150, 61) {
        online.forget();
        let solved = online.solve(&point, oil).unwrap();
        if !solved.beside.is_empty() {
            continue;
        }
        let (fields, full) =
            (online.reconstruct(&solved).unwrap(), solver.solve(&point, oil, Start::Cold, &()).unwrap());
        let carries = |pressure: &[f64]| pressure.iter().rposition(|p| *p > 0.0).map_or(0, |last| last + 1);
        assert_eq!(solved.fronts, [carries(&fields.pressure)], "no pressure is left out: {:?}", point.moes());
        off.push((fields.scalars.h_min / full.scalars.h_min - 1.0).abs());
    }
    off.sort_by(f64::total_cmp);
    assert!(off.len() > 100 && off[off.len() * 97 / 100] < 2e-5, "{:?}", &off[off.len() - 8..]);
}

#[test]
fn dragging_gives_the_same_picture_as_jumping() {
    let (mut dragged, mut fresh) = (online(), online());
    let mut iterations = 0;
    for k in 0..120 {
        let point = at(3.0 * 1.04f64.powi(k), 4.0 + 0.1 * f64::from(k));
        let a = dragged.solve(&point, Lubricant::default()).unwrap();
        fresh.forget();
        let b = fresh.solve(&point, Lubricant::default()).unwrap();
        iterations += a.iterations;
        let (a, b) = (dragged.scalars(&a).unwrap(), fresh.scalars(&b).unwrap());
        assert!((a.h_c / b.h_c - 1.0).abs() < 1e-8);
    }
    assert!(iterations <= 120 * 5, "{iterations} iterations for 120 pictures");
}

#[test]
fn contacts_outside_the_range_are_solved_and_reported() {
    let mut online = online();
    let point = OperatingPoint { viscosity_pa_s: 0.001, ..at(40.0, 10.0) };
    let solved = online.solve(&point, Lubricant::default()).unwrap();
    let Trust::Outside(why) = &solved.trust else { panic!("must not claim to be trained") };
    let why = why.to_string();
    assert!(why.contains("η₀ = 1 mPa·s lies outside the trained range 2…500 mPa·s"), "{why}");
    assert_eq!(solved.point, point);
    for (m, l) in [(80.0, 20.0), (150.0, 14.0)] {
        let solved = online.solve(&at(m, l), Lubricant::default()).unwrap();
        assert!(matches!(&solved.trust, Trust::Outside(why) if why.to_string().contains("p_H")), "{:?}", solved.trust);
    }
}

#[test]
fn fewer_modes_need_no_training_and_lose_accuracy_gradually() {
    let model = embedded("line").unwrap();
    let point = at(20.0, 8.0);
    let film = |modes, deformation| {
        let options =
            ReducedOptions { pressure_modes: modes, deformation_modes: deformation, ..ReducedOptions::default() };
        let mut online = Online::new(Arc::clone(&model), options);
        let solved = online.solve(&point, Lubricant::default()).unwrap();
        online.scalars(&solved).unwrap().h_c
    };
    let exact = film(None, None);
    let error = |modes, deformation| (film(modes, deformation) / exact - 1.0).abs();
    assert!(error(Some(45), None) < 1e-3);
    assert!(error(Some(25), None) < 5e-2);
    assert!(error(Some(25), None) > error(Some(50), None));
    // The dissertation's V_δ V_δᵀ K V_p gives the same solution if V_δ has enough modes.
    assert!(error(None, Some(60)) < 1e-3);
}
