//! Behaviour of full solves: derivatives, limits, independence of units, initial guesses, cancellation, step counts.

use super::newton_space::NewtonSpace;
use super::*;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, GridSpec, PointGridSpec};
use crate::solver::discrete::reynolds::{CENTER, PENALTY, STENCIL};
use crate::solver::discrete::space::LineSpace;
use crate::solver::observer::{NewtonStep, Observer};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{DensityLaw, Lubricant, ShearLaw, Sliding, ViscosityLaw};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const COARSE: GridSpec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
const PLANE: PointGridSpec = PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0));

fn at(m: f64, l: f64) -> OperatingPoint {
    si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap()
}

fn solve(spec: GridSpec, point: &OperatingPoint) -> Solution {
    let mut solver = FullSolver::new(spec).unwrap();
    solver.solve(point, Lubricant::default(), Start::Cold, &()).unwrap()
}

/// Asserts that rows and gradient slopes are the derivative of the residual in a direction (ΔP, ΔH).
pub(super) fn assert_derivatives<S: NewtonSpace>(
    mut system: System<S>,
    problem: &Problem,
    direction: &[f64],
    d_film: &[f64],
) {
    system.evaluate(problem, PENALTY);
    let rows = system.rows.clone();
    let mut exact = vec![0.0; rows.len()];
    if let Some(thinning) = system.thinning.as_mut().filter(|_| problem.shear.is_some()) {
        thinning.turn::<S>(direction);
        thinning.add_product(&system.space, &vec![1.0; rows.len()], &mut exact);
    }
    let (pressure, film) = (system.pressure.clone(), system.film.clone());
    let mut residual_at = |t: f64| -> Vec<f64> {
        for n in 0..pressure.len() {
            system.pressure[n] = pressure[n] + t * direction[n];
            system.film[n] = film[n] + t * d_film[n];
        }
        system.evaluate(problem, PENALTY);
        system.rows.iter().map(|row| row.value).collect()
    };
    let (up, down) = (residual_at(1e-7), residual_at(-1e-7));
    let scale = rows.iter().map(|row| row.d_p[CENTER].abs() + row.d_h[CENTER].abs()).fold(0.0, f64::max);
    for (k, row) in rows.iter().enumerate() {
        let (stencil, _) = system.space.row(k);
        let terms = (0..STENCIL).map(|e| row.d_p[e] * direction[stencil[e]] + row.d_h[e] * d_film[stencil[e]]);
        exact[k] += terms.sum::<f64>();
        let difference = (up[k] - down[k]) / 2e-7;
        assert!((exact[k] - difference).abs() < 1e-6 * scale, "row {k}: {} against {difference}", exact[k]);
    }
}

#[test]
fn jacobian_products_are_the_derivative_of_the_residual() {
    let thinning = Lubricant {
        shear: ShearLaw::Carreau { critical_stress: 1e6, beta: 2.198, n: 0.6, npr: 0.1 },
        ..Lubricant::default()
    };
    for lubricant in [Lubricant::default(), thinning] {
        let problem = Problem::new(&OperatingPoint::TABLE_2_1, lubricant).unwrap();
        for spec in [COARSE, GridSpec::Graded { nodes: 160, domain: (-6.0, 1.9), registered: true }] {
            let grid = spec.line().unwrap().for_contact(problem.moes);
            let mut system = System::new(LineSpace::new(grid.clone()));
            let start = |x: &f64| 0.9 * (1.0 - x * x).max(0.0).sqrt() + 0.02 * (-x * x).exp();
            system.set_pressure(&problem, &grid.x.iter().map(start).collect::<Vec<f64>>());
            system.set_central_film(0.06);
            // A smooth direction in (P, H₀), with the deformation it causes.
            let direction: Vec<f64> =
                grid.x.iter().map(|x| (3.0 * x).sin() * (1.0 - (x / 1.5).powi(2)).max(0.0)).collect();
            let mut film = vec![0.0; grid.len()];
            grid.deform(&direction, &mut film, &mut Default::default());
            film.iter_mut().for_each(|h| *h += 0.3);
            assert_derivatives(system, &problem, &direction, &film);
        }
    }
}

#[test]
fn krylov_and_dense_newton_find_the_same_solution() {
    let point = at(20.0, 8.0);
    let krylov = solve(COARSE, &point);
    let solver = FullSolver::new(COARSE).unwrap();
    let (mut system, problem) = solver.cold_system(&point, Lubricant::default()).unwrap();
    let kernel = dense::dense_kernel(&system.space.grid);
    dense::dense_newton(&mut system, &problem, &SolveOptions::default(), &kernel);
    for (a, b) in system.pressure.iter().zip(&krylov.pressure) {
        assert!((a - b).abs() < 1e-8);
    }
    assert!((system.h_0 - krylov.scalars.h_0).abs() < 1e-9);
}

#[test]
fn heavy_loads_tend_to_hertz_and_light_ones_to_rigid_bodies() {
    let deviation = |m: f64| {
        let s = solve(GridSpec::EXPLORER, &at(m, 5.0));
        s.x.iter()
            .zip(&s.pressure)
            .filter(|(x, _)| x.abs() < 0.9)
            .map(|(x, p)| (p - (1.0 - x * x).sqrt()).abs())
            .fold(0.0, f64::max)
    };
    let (light, middle, heavy) = (deviation(5.0), deviation(30.0), deviation(280.0));
    assert!(heavy < middle && middle < light && heavy < 0.02, "{light} {middle} {heavy}");
    // Rigid and isoviscous: Martin's analytic solution, h₀/R = 4.896 η₀u_m/w, which is H = 2.448/M (Moes' fit rounds it
    // up to 3/M).
    let rigid =
        Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
    let point =
        si_from_moes(&MoesRequest { alpha_per_pa: Some(1e-11), ..MoesRequest::new(ContactKind::Line, 0.3, 0.01) })
            .unwrap();
    let grid = GridSpec::Graded { nodes: 800, domain: (-150.0, 15.0), registered: false };
    let s = FullSolver::new(grid).unwrap().solve(&point, rigid, Start::Cold, &()).unwrap();
    assert!(s.converged(), "{:?}", s.report.termination);
    let film_number = s.scalars.h_c * point.film_scale_m() / point.radius_m / point.speed_group().sqrt();
    let martin = 2.448 / 0.3;
    assert!((film_number / martin - 1.0).abs() < 0.06, "{film_number} against {martin}");
}

#[test]
fn incompressible_barus_fluids_depend_on_moes_numbers_only() {
    let laws =
        Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
    for (mut solver, m, bar) in [
        (ContactSolver::Line(FullSolver::new(COARSE).unwrap()), 20.0, 1e-9),
        (ContactSolver::Point(PointSolver::new(PLANE).unwrap()), 50.0, 1e-6),
    ] {
        let base = MoesRequest::new(solver.grid_spec().kind(), m, 6.0);
        let mut film = |request: MoesRequest| {
            let s = solver.solve(&si_from_moes(&request).unwrap(), laws, Start::Cold, &()).unwrap();
            assert!(s.converged());
            s.scalars.h_c
        };
        let reference = film(base);
        for request in [
            MoesRequest { radius_m: Some(0.05), ..base },
            MoesRequest { modulus_pa: Some(5e10), viscosity_pa_s: Some(0.2), ..base },
            MoesRequest { alpha_per_pa: Some(3e-8), ..base },
        ] {
            assert!((film(request) / reference - 1.0).abs() < bar, "{request:?}");
        }
    }
}

#[test]
fn warm_starts_are_cheaper_than_cold_ones() {
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    let point = at(30.0, 8.0);
    let cold = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
    assert!(cold.report.newton_iterations <= 30 && cold.report.linear_iterations <= 250, "{:?}", cold.report);
    let near = solver.solve(&at(32.0, 8.3), Lubricant::default(), Start::From(&cold), &()).unwrap();
    assert!(near.converged() && near.report.newton_iterations <= 12, "{}", near.report.newton_iterations);
    let again = solver.solve(&point, Lubricant::default(), Start::From(&cold), &()).unwrap();
    assert!(again.report.newton_iterations <= 2, "{}", again.report.newton_iterations);
    let graded = solve(GridSpec::EXPLORER, &point);
    let from_other = solver.solve(&point, Lubricant::default(), Start::From(&graded), &()).unwrap();
    assert!(from_other.converged() && from_other.report.attempts == 1);
    assert!((from_other.scalars.h_c / cold.scalars.h_c - 1.0).abs() < 1e-9);
}

#[test]
fn the_load_is_carried_exactly_and_the_residual_vanishes() {
    let line = [(3.0, 10.0), (40.0, 10.0), (300.0, 4.0)].map(|(m, l)| (solve(GridSpec::EXPLORER, &at(m, l)), 1e-8));
    let mut solver = PointSolver::new(PointGridSpec { dy: 0.05, ..PLANE }).unwrap();
    let plane = [(20.0, 12.0), (100.0, 5.0), (400.0, 3.0)].map(|(m, l)| {
        let point = si_from_moes(&MoesRequest::new(ContactKind::Point, m, l)).unwrap();
        (solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap(), 1e-4)
    });
    for (s, bar) in line.into_iter().chain(plane) {
        assert!(s.converged() && s.report.attempts == 1, "{:?}", s.report);
        assert!(s.scalars.load_residual < 1e-12 && s.report.residual_norm < bar, "{:?}", s.report);
        assert!(s.film.iter().all(|&h| h > 0.0));
        assert!(s.pressure.iter().all(|&p| p > -1e-4), "the penalty keeps pressures from going negative");
    }
}

#[test]
fn the_explorers_grid_is_within_its_stated_error() {
    for (m, l, bar) in [(5.0, 5.0, 3e-3), (50.0, 5.0, 3e-3), (165.0, 5.0, 3e-3), (500.0, 2.5, 1e-2)] {
        let GridSpec::Graded { nodes, domain, .. } = GridSpec::EXPLORER else { panic!("graded") };
        let film = |nodes| solve(GridSpec::Graded { nodes, domain, registered: true }, &at(m, l)).scalars.h_c;
        let (normal, fine) = (film(nodes), film(2 * nodes - 1));
        let extrapolated = fine + (fine - normal) / 3.0;
        let error = (normal / extrapolated - 1.0).abs();
        assert!(error < bar, "M = {m}: {error:.1e}");
    }
}

#[test]
fn what_does_not_converge_says_so() {
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    solver.options.max_newton = 3;
    let s = solver.solve(&at(40.0, 10.0), Lubricant::default(), Start::Cold, &()).unwrap();
    assert!(!s.converged());
    assert!(s.report.termination.describe().contains("try"));
}

#[test]
fn small_steps_far_from_a_solution_do_not_end_a_solve() {
    // The first initial guess has equations that differ by thirty orders of magnitude, with steps of 1e-20. One in
    // fifteen such contacts ended there, with film thicknesses of 0.06 to 0.26.
    let grid = GridSpec::Graded { nodes: 632, domain: (-20.0, 3.2), registered: true };
    let mut solver = FullSolver::new(grid).unwrap();
    let lubricant = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() };
    let point = OperatingPoint {
        radius_m: 0.003,
        speed_m_per_s: 3.4212508,
        load: 103776.577,
        modulus_pa: 1.7278018e11,
        viscosity_pa_s: 0.015391292,
        alpha_per_pa: 3.10542314e-8,
        sliding: Sliding { slide_to_roll_ratio: 0.50149631, newtonian_plateau_ratio: Some(0.0) },
        ..at(14.0, 20.0)
    };
    for k in 0..30 {
        let load = point.load * (1.0 + 1e-9 * f64::from(k));
        let solution = solver.solve(&OperatingPoint { load, ..point }, lubricant, Start::Cold, &()).unwrap();
        assert!(solution.converged(), "{k}: {:?}", solution.report.termination);
        assert!(solution.report.residual_norm < 1e-9 && (solution.scalars.h_c / 0.20329740 - 1.0).abs() < 1e-6, "{k}");
    }
}

#[test]
fn cancelling_stops_after_the_step_under_way() {
    struct After(usize, AtomicUsize);
    impl Observer for After {
        fn newton_step(&self, _: &NewtonStep) {
            self.1.fetch_add(1, Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.1.load(Ordering::Relaxed) >= self.0
        }
    }
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    let after = After(2, AtomicUsize::new(0));
    let s = solver.solve(&at(40.0, 10.0), Lubricant::default(), Start::Cold, &after).unwrap();
    assert_eq!((s.report.termination, after.1.into_inner()), (Termination::Cancelled, 2));
    let flag = AtomicBool::new(true);
    let s = solver.solve(&at(40.0, 10.0), Lubricant::default(), Start::Cold, &flag).unwrap();
    assert_eq!(s.report.newton_iterations, 0);
}

#[test]
fn newtonian_traction_is_the_integral_of_the_shear_stress() {
    // Nearly isoviscous and rigid: traction ≈ η u ∫ dx/h / w per unit SRR; compare with a direct sum in SI units.
    let s = solve(GridSpec::DISSERTATION, &at(10.0, 2.5));
    let point = s.problem.point;
    let (a, scale) = (point.hertz().half_width_m, point.film_scale_m());
    let mut force = 0.0;
    for i in FIRST_UNKNOWN..s.x.len() {
        let eta = |k: usize| point.viscosity_pa_s * s.problem.fluid.at(s.pressure[k].max(0.0)).viscosity;
        let stress = |k: usize| eta(k) * point.speed_m_per_s / (s.film[k] * scale);
        force += 0.5 * (stress(i - 1) + stress(i)) * a * (s.x[i] - s.x[i - 1]);
    }
    assert!((s.traction().per_srr / (force / point.load) - 1.0).abs() < 1e-9);
}
