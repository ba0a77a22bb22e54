use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::newton_space::NewtonSpace;
use crate::solver::full::solver::Solver;
use crate::solver::full::{FullSolver, Problem, Solution, Start};
use crate::solver::physics::bodies::Material;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use crate::solver::physics::lubricant::{Cavitation, Heat, LimitingStress, Lubricant, OilHeat, ShearLaw};

const GRID: GridSpec = GridSpec::Graded { nodes: 695, domain: (-10.0, 2.0), registered: false };

fn sliding(slide_to_roll_ratio: f64) -> Sliding {
    Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None }
}

/// A rolling and sliding contact of steel bodies, M = 22, L = 10.
pub(super) fn point(slide_to_roll_ratio: f64) -> OperatingPoint {
    OperatingPoint {
        kind: ContactKind::Line,
        radius_m: 0.01,
        speed_m_per_s: 2.0,
        load: 3e5,
        modulus_pa: 231e9,
        viscosity_pa_s: 0.02,
        alpha_per_pa: 1.8e-8,
        sliding: sliding(slide_to_roll_ratio),
        radius_y_m: None,
    }
}

pub(super) const EYRING: ShearLaw = ShearLaw::Eyring { critical_stress: 6e6, npr: 0.0 };

pub(super) fn warm(shear: ShearLaw, heat: Heat) -> Lubricant {
    Lubricant { shear, heat: Some(heat), ..Lubricant::default() }
}

pub(super) fn solved<S: NewtonSpace>(solver: &mut Solver<S>, point: &OperatingPoint, lubricant: Lubricant) -> Solution {
    let solution = solver.solve(point, lubricant, Start::Cold, &()).unwrap();
    assert!(solution.converged(), "{:?}", solution.report);
    solution
}

/// Values of an independent solver, extrapolated to vanishing spacings along and across the film. Its body 1 is the
/// faster one, which is body 2 here.
#[test]
fn independent_solutions_are_met() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let rolling = OperatingPoint {
        radius_m: 0.02,
        speed_m_per_s: 10.0,
        load: 5e5,
        alpha_per_pa: 1.5e-8,
        sliding: sliding(0.0),
        ..point(0.0)
    };
    for (point, shear, film, traction, mid, surfaces) in [
        (point(0.5), EYRING, [0.0744185, 0.0587922], 0.0327481, 22.7812, [14.7274, 12.4927]),
        (rolling, ShearLaw::Newtonian, [0.133433, 0.120432], 0.0, 1.49126, [1.34621, 1.34621]),
    ] {
        let found = solved(&mut solver, &point, warm(shear, Heat::default()));
        let heat = found.heat.as_ref().unwrap();
        let close = |value: f64, wanted: f64, relative: f64, absolute: f64| {
            assert!((value - wanted).abs() < (relative * wanted.abs()).max(absolute), "{value} {wanted}");
        };
        close(found.scalars.h_c, film[0], 1e-3, 0.0);
        close(found.scalars.h_min, film[1], 2e-3, 0.0);
        close(found.traction_coefficient(), traction, 2e-3, 1e-6);
        close(heat.central.mid_film_k, mid, 1e-3, 0.02);
        for (value, wanted) in heat.central.surfaces_k.into_iter().zip(surfaces) {
            close(value, wanted, 1e-3, 0.02);
        }
        assert!(heat.balance.residual().abs() < 1.5e-3, "{:?} {}", heat.balance, heat.balance.residual());
    }
}

#[test]
fn constant_properties_give_the_isothermal_film() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let oil = OilHeat { viscosity_temperature: 0.0, density_temperature: 0.0, ..OilHeat::default() };
    for shear in [ShearLaw::Newtonian, EYRING] {
        for cavitation in [Cavitation::Penalty, Cavitation::Complementarity] {
            let lubricant = Lubricant { cavitation, ..warm(shear, Heat { oil, ..Heat::default() }) };
            let warm = solved(&mut solver, &point(0.3), lubricant);
            let cold = solved(&mut solver, &point(0.3), Lubricant { heat: None, ..lubricant });
            assert!((warm.scalars.h_c / cold.scalars.h_c - 1.0).abs() < 1e-12, "{shear:?} {cavitation:?}");
            let difference = warm.pressure.iter().zip(&cold.pressure).fold(0.0f64, |d, (a, b)| d.max((a - b).abs()));
            assert!(difference < 1e-10, "{shear:?} {cavitation:?}: {difference}");
            // Body 1 is below in both, and the shear stress has the same sign.
            let [own, wanted] = [&warm, &cold].map(|solution| solution.shear_field(&[0.0, 0.5, 1.0]));
            let largest = wanted.iter().fold(0.0f64, |largest, shear| largest.max(shear.stress_pa.abs()));
            for (own, wanted) in own.iter().zip(&wanted) {
                assert!((own.stress_pa - wanted.stress_pa).abs() < 1e-6 * largest, "{own:?} {wanted:?}");
            }
        }
    }
}

#[test]
fn solutions_do_not_depend_on_start_or_order_of_bodies() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let [glass, steel] = [Material::GLASS, Material::STEEL].map(|material| material.heat);
    let pair = |bodies| warm(EYRING, Heat { bodies, ..Heat::default() });
    let cold = solved(&mut solver, &point(0.3), pair([glass, steel]));
    let other = solved(&mut solver, &point(-0.3), pair([steel, glass]));
    let next = solver.solve(&point(0.33), pair([glass, steel]), Start::From(&cold), &()).unwrap();
    let back = solver.solve(&point(0.3), pair([glass, steel]), Start::From(&next), &()).unwrap();
    let [a, b, c] = [&cold, &other, &back].map(|solution| solution.heat.clone().unwrap());
    assert!((a.central.surfaces_k[0] - c.central.surfaces_k[0]).abs() < 1e-3);
    assert!((cold.scalars.h_c / back.scalars.h_c - 1.0).abs() < 1e-6);
    assert!((cold.scalars.h_c / other.scalars.h_c - 1.0).abs() < 1e-6);
    for side in 0..2 {
        assert!((a.central.surfaces_k[side] - b.central.surfaces_k[1 - side]).abs() < 1e-3);
    }
    assert!((a.central.mid_film_k - b.central.mid_film_k).abs() < 1e-3);
    assert!((cold.traction_coefficient() + other.traction_coefficient()).abs() < 1e-6);
    // Glass conducts heat badly.
    assert!(a.central.surfaces_k[0] > 2.0 * a.central.surfaces_k[1]);
}

/// The rise in the spike depends on the grid, that in the film hardly. Hence both are reported.
#[test]
fn rises_in_the_pressure_spike_are_reported_apart() {
    let contact = OperatingPoint { load: 1e5, alpha_per_pa: 2.5e-8, ..point(0.3) };
    let on = |nodes: usize, contact: &OperatingPoint| {
        let grid = GridSpec::Graded { nodes, domain: (-10.0, 2.0), registered: false };
        solved(&mut FullSolver::new(grid).unwrap(), contact, warm(EYRING, Heat::default())).heat.unwrap()
    };
    let rises = [401, 1201].map(|nodes| {
        let heat = on(nodes, &contact);
        let spike = heat.in_spike.unwrap();
        assert_eq!(heat.largest.mid_film_k, spike.mid_film_k, "the needle is hotter than the film");
        [heat.outside_spike.mid_film_k, spike.mid_film_k]
    });
    let [[film, spike], [fine_film, fine_spike]] = rises;
    assert!((film / fine_film - 1.0).abs() < 1e-3 && fine_spike / spike > 1.005, "{rises:?}");
    assert!(spike / film > 1.05 && fine_spike / fine_film < 1.3, "{rises:?}");
    // Much sliding flattens the spike.
    let heat = on(695, &OperatingPoint { speed_m_per_s: 4.0, ..point(1.0) });
    assert!(heat.in_spike.is_none() && heat.outside_spike == heat.largest, "{:?}", heat.in_spike);
}

#[test]
fn a_limiting_stress_bounds_the_traction_and_the_heat_it_makes() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let free = warm(ShearLaw::Newtonian, Heat::default());
    let limit = LimitingStress { ambient: 2e6, slope: 0.01, eyring: None };
    let [free, limited] = [free, Lubricant { limiting_stress: Some(limit), ..free }]
        .map(|lubricant| solved(&mut solver, &point(0.2), lubricant));
    let hertz = free.problem.point.hertz().pressure_pa;
    let stress = limited.mid_film_stress();
    assert!(stress.iter().zip(&limited.pressure).all(|(stress, p)| *stress <= limit.at(p * hertz) * 1.0001));
    assert!(limited.traction_coefficient() < 0.8 * free.traction_coefficient());
    let [free, limited] = [free, limited].map(|solution| solution.heat.unwrap().central.mid_film_k);
    assert!(limited < 0.8 * free, "{limited} {free}");
}

/// The energy balance also holds if lubricant flows back out of the inlet.
#[test]
fn what_is_made_leaves_through_bodies_and_with_the_oil() {
    let mut solver = FullSolver::new(GRID).unwrap();
    for (speed, shear, bar) in [(0.5, ShearLaw::Newtonian, 2e-5), (2.0, EYRING, 2e-5), (8.0, EYRING, 1e-3)] {
        let point = OperatingPoint { speed_m_per_s: speed, ..point(0.3) };
        let found = solved(&mut solver, &point, warm(shear, Heat::default()));
        let heat = found.heat.as_ref().unwrap();
        assert!(heat.balance.residual().abs() < bar, "{speed} m/s: {:?} {}", heat.balance, heat.balance.residual());
        assert_eq!((heat.too_hot(), heat.heat_lost()), (None, None));
    }
}

/// A limiting stress causes a kink in the heat of shear, at which the steps of a station may turn back and forth until
/// they end where they began.
#[test]
fn temperatures_come_to_rest_where_a_limit_cuts_the_stress() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let limit = LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) };
    let oil = OilHeat {
        heat_capacity: 1700.0,
        conductivity: 0.11,
        density: 900.0,
        viscosity_temperature: 0.06,
        ..OilHeat::default()
    };
    let heat = Heat { inlet_temperature: 293.15, oil, ..Heat::default() };
    let lubricant = Lubricant { limiting_stress: Some(limit), ..warm(ShearLaw::Newtonian, heat) };
    let at = |srr| OperatingPoint {
        radius_m: 18.3e-3,
        speed_m_per_s: 15.2,
        load: 550e3,
        modulus_pa: 220e9,
        viscosity_pa_s: 0.0054,
        alpha_per_pa: 2.035e-8,
        ..point(srr)
    };
    let found = [0.29, 0.3, 0.31].map(|srr| solved(&mut solver, &at(srr), lubricant));
    for solution in &found {
        let heat = solution.heat.as_ref().unwrap();
        assert!(heat.balance.residual().abs() < 1e-3, "{:?}", heat.balance);
    }
    let [less, own, more] = found.map(|solution| [solution.scalars.h_c, solution.traction_coefficient()]);
    for ((less, own), more) in less.into_iter().zip(own).zip(more) {
        assert!((0.5 * (less + more) / own - 1.0).abs() < 2e-3, "{less} {own} {more}");
    }
}

#[test]
fn what_cannot_be_computed_is_refused_in_a_sentence() {
    let refused = |point: OperatingPoint| {
        Problem::new(&point, warm(ShearLaw::Newtonian, Heat::default())).unwrap_err().to_string()
    };
    assert!(refused(point(2.0)).contains("moving heat sources"));
}
