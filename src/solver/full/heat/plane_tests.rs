//! Tests of thermal point contacts, circular and elliptical.

use super::tests::{EYRING, point, solved, warm};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::{FullSolver, PointSolver, Solution, Start};
use crate::solver::physics::bodies::Material;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, OilHeat, ShearLaw};

const COARSE: PointGridSpec = PointGridSpec::uniform(0.05, 0.1, (-3.0, 1.8, -1.6));

/// A steel ball with M = 62, L = 8.9.
fn ball(srr: f64) -> OperatingPoint {
    OperatingPoint { kind: ContactKind::Point, load: 30.0, ..point(srr) }
}

#[test]
fn constant_properties_give_the_isothermal_film() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let oil = OilHeat { viscosity_temperature: 0.0, density_temperature: 0.0, ..OilHeat::default() };
    for (shear, cavitation) in [
        (ShearLaw::Newtonian, Cavitation::Penalty),
        (ShearLaw::Newtonian, Cavitation::Complementarity),
        (EYRING, Cavitation::Complementarity),
    ] {
        let lubricant = Lubricant { cavitation, ..warm(shear, Heat { oil, ..Heat::default() }) };
        let warm = solved(&mut solver, &ball(0.3), lubricant);
        let cold = solved(&mut solver, &ball(0.3), Lubricant { heat: None, ..lubricant });
        let off = (warm.scalars.h_c / cold.scalars.h_c - 1.0).abs();
        // Both iterations end with a step below 1e-6.
        assert!(off < 2e-6, "{shear:?} {cavitation:?}: {off:e}");
        assert!(warm.heat.unwrap().central.mid_film_k > 1.0);
    }
}

#[test]
fn generated_heat_leaves_through_bodies_and_oil() {
    for (shear, speed_m_per_s, bar) in [(ShearLaw::Newtonian, 2.0, 1e-3), (EYRING, 2.0, 1e-3), (EYRING, 10.0, 1e-2)] {
        let point = OperatingPoint { speed_m_per_s, ..ball(0.4) };
        let found = solved(&mut PointSolver::new(COARSE).unwrap(), &point, warm(shear, Heat::default()));
        let heat = found.heat.as_ref().unwrap();
        let residual = heat.balance.residual();
        assert!(residual.abs() < bar, "{shear:?}, {speed_m_per_s} m/s: {residual:e} of {:?}", heat.balance);
        assert!(heat.balance.sheared > 0.0 && heat.too_hot().or(heat.heat_lost()).is_none());
    }
}

/// Solves on three grids, each with half the spacings of the previous one. Differences fall at least by half.
#[test]
fn film_traction_and_temperature_converge_with_the_grid() {
    let found = [1.0, 0.5, 0.25].map(|share| {
        let spec = PointGridSpec { dx: 0.08 * share, dy: 0.16 * share, ..COARSE };
        let s = solved(&mut PointSolver::new(spec).unwrap(), &ball(0.4), warm(EYRING, Heat::default()));
        let heat = s.heat.as_ref().unwrap();
        [s.scalars.h_c, s.traction_coefficient(), heat.central.mid_film_k, heat.central.surfaces_k[0]]
    });
    for k in 0..4 {
        let [coarse, middle, fine] = found.map(|values| values[k]);
        let order = ((coarse - middle) / (middle - fine)).abs().log2();
        assert!(order > 1.0, "{k}: {coarse} {middle} {fine}, order {order}");
    }
}

#[test]
fn solutions_do_not_depend_on_start_or_order_of_bodies() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let [glass, steel] = [Material::GLASS, Material::STEEL].map(|material| material.heat);
    let pair = |bodies| warm(EYRING, Heat { bodies, ..Heat::default() });
    let cold = solved(&mut solver, &ball(0.3), pair([glass, steel]));
    let other = solved(&mut solver, &ball(-0.3), pair([steel, glass]));
    let next = solver.solve(&ball(0.33), pair([glass, steel]), Start::From(&cold), &()).unwrap();
    let back = solver.solve(&ball(0.3), pair([glass, steel]), Start::From(&next), &()).unwrap();
    assert!(next.converged() && back.report.newton_iterations < cold.report.newton_iterations);
    let [a, b, c] = [&cold, &other, &back].map(|solution| solution.heat.clone().unwrap());
    assert!((cold.scalars.h_c / back.scalars.h_c - 1.0).abs() < 2e-5);
    assert!((a.central.surfaces_k[0] - c.central.surfaces_k[0]).abs() < 1e-2);
    assert!((cold.scalars.h_c / other.scalars.h_c - 1.0).abs() < 2e-5);
    for side in 0..2 {
        assert!((a.central.surfaces_k[side] - b.central.surfaces_k[1 - side]).abs() < 1e-2);
    }
    assert!((cold.traction_coefficient() + other.traction_coefficient()).abs() < 1e-5);
    assert!(a.central.surfaces_k[0] > 2.0 * a.central.surfaces_k[1], "glass keeps the heat");
}

/// Limit of a long ellipse, in which hardly any lubricant flows sideways. On its axis it is a line contact of the
/// same pressure.
#[test]
fn a_long_ellipse_is_a_line_contact_on_its_axis() {
    let line = OperatingPoint { kind: ContactKind::Line, load: 2.5e5, ..ball(0.3) };
    let p_h = line.hertz().pressure_pa;
    let lubricant = warm(EYRING, Heat::default());
    let grid = GridSpec::Graded { nodes: 300, domain: (-4.0, 2.0), registered: false };
    let roller = FullSolver::new(grid).unwrap().solve(&line, lubricant, Start::Cold, &()).unwrap();
    // p_H grows with the cube root of a point contact's load.
    let shaped = |load: f64| OperatingPoint { radius_y_m: Some(0.3), load, ..ball(0.3) };
    let ellipse = shaped((p_h / shaped(1.0).hertz().pressure_pa).powi(3));
    assert!((ellipse.hertz().pressure_pa / p_h - 1.0).abs() < 1e-9);
    let spec = PointGridSpec::uniform(0.03, 0.1, (-4.0, 2.0, -1.4));
    let long = solved(&mut PointSolver::new(spec).unwrap(), &ellipse, lubricant);
    let ny = long.y.len();
    // Traction of the strip along the axis: both pressures are half ellipses of the same height.
    let strip = |solution: &Solution, ny: usize| {
        let stress = solution.mid_film_stress();
        let along = |values: &[f64]| -> f64 {
            let at = |i: usize| values[i * ny + ny - 1];
            (1..solution.x.len()).map(|i| 0.5 * (solution.x[i] - solution.x[i - 1]) * (at(i) + at(i - 1))).sum()
        };
        along(&stress) / along(&solution.pressure) / p_h
    };
    let [film, other] = [&roller, &long].map(|s| s.scalars.h_c * s.problem.point.film_scale_m());
    assert!((other / film - 1.0).abs() < 0.03, "{other:e} {film:e}");
    let [mu, strip] = [strip(&roller, 1), strip(&long, ny)];
    assert!((strip / mu - 1.0).abs() < 0.05, "{strip} {mu}");
    let [rise, other] = [&roller, &long].map(|s| s.heat.as_ref().unwrap().central.mid_film_k);
    assert!((other / rise - 1.0).abs() < 0.05, "{other} {rise}");
    assert!(rise > 10.0, "{rise}");
}

/// An inlet film thickness starves the inlet whatever was solved before: without it, with another one, thermal or not.
#[test]
fn starved_films_do_not_depend_on_the_start() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let of = |supply_film_m: Option<f64>, heat: Option<Heat>| Lubricant {
        cavitation: Cavitation::MassConserving { supply_film_m },
        heat,
        ..Lubricant::default()
    };
    let (point, heat) = (ball(0.1), Some(Heat::default()));
    let flooded = solved(&mut solver, &point, of(None, heat));
    let film_m = flooded.scalars.h_c * point.film_scale_m();
    let formers = [
        flooded,
        solved(&mut solver, &point, Lubricant { heat, ..Lubricant::default() }),
        solved(&mut solver, &point, of(Some(4.0 * film_m), None)),
        solved(&mut solver, &OperatingPoint { load: 40.0, ..point }, of(Some(0.5 * film_m), heat)),
    ];
    for laws in [of(Some(1.5 * film_m), heat), of(Some(1.5 * film_m), None)] {
        let cold = solved(&mut solver, &point, laws);
        assert!(cold.scalars.h_c < 0.97 * formers[0].scalars.h_c, "{}", cold.scalars.h_c);
        for former in &formers {
            let warm = solver.solve(&point, laws, Start::From(former), &()).unwrap();
            assert!(
                (warm.scalars.h_c / cold.scalars.h_c - 1.0).abs() < 1e-9,
                "{:?}",
                former.problem.lubricant.cavitation
            );
        }
    }
}
