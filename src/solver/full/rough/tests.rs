//! Derivatives of the equations of rough contacts.

use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::discrete::reynolds::STENCIL;
use crate::solver::discrete::space::Grid;
use crate::solver::full::newton_space::NewtonSpace;
use crate::solver::full::{FullSolver, PointSolver, Problem, System};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::physics::surfaces::{AsperityLaw, Roughness};

/// Asserts that the rows of a system are derivatives of its residual in a smooth direction (ΔP, ΔH), by extrapolated
/// central differences. The film pressure is kept away from zero, where the laws of the lubricant have a kink: it is
/// positive in front of X = 0.9 and negative in the cavitated set behind.
fn assert_exact<S: NewtonSpace>(mut system: System<S>, problem: &Problem, within: f64) {
    system.begin_rough(problem);
    system.evaluate(problem, 0.0);
    let (x, y) = system.space.grid().abscissae();
    let (x, lines) = (x.to_vec(), y.len());
    let weights = system.space.grid().weights().to_vec();
    let nodes = system.rough.as_ref().unwrap();
    for n in (0..weights.len()).filter(|n| weights[*n] > 0.0) {
        let x = x[n / lines];
        let film_pressure = if x < 0.9 { 0.05 + 0.7 * (1.0 - x * x).max(0.0).sqrt() } else { -0.05 };
        system.pressure[n] = nodes.asperities(n).pressure + film_pressure;
    }
    system.begin_rough_rupture(problem);
    system.evaluate(problem, 0.0);
    assert!(system.active.ruptured.contains(&true) && system.active.ruptured.contains(&false));
    let rows = system.rows.clone();
    let weights_of_rows = vec![1.0; rows.len()];
    let (pressure, film) = (system.pressure.clone(), system.film.clone());
    let wave = |n: usize, length: f64| (0.3 + n as f64 / length).sin();
    let d_p: Vec<f64> = (0..pressure.len()).map(|n| if weights[n] > 0.0 { wave(n, 29.0) } else { 0.0 }).collect();
    let d_h: Vec<f64> = (0..film.len()).map(|n| 0.1 * wave(n, 17.0)).collect();
    let mut by_gradient = vec![0.0; rows.len()];
    if let Some(thinning) = system.thinning.as_mut().filter(|_| system.nodes.thins()) {
        thinning.turn_rough::<S>(&d_p, (&d_h, 0.0), system.rough.as_ref().unwrap());
        thinning.add_product(&system.space, &weights_of_rows, &mut by_gradient);
    }
    let mut residual_at = |t: f64| -> Vec<f64> {
        for n in 0..pressure.len() {
            system.pressure[n] = pressure[n] + t * d_p[n];
            system.film[n] = film[n] + t * d_h[n];
        }
        system.evaluate(problem, 0.0);
        system.rows.iter().map(|row| row.value).collect()
    };
    let mut difference = |step: f64| -> Vec<f64> {
        let (up, down) = (residual_at(step), residual_at(-step));
        up.iter().zip(down).map(|(up, down)| (up - down) / (2.0 * step)).collect()
    };
    let (wide, narrow) = (difference(4e-5), difference(2e-5));
    for (k, row) in rows.iter().enumerate() {
        let (stencil, _) = system.space.row(k);
        let own: f64 = (0..STENCIL).map(|e| row.d_p[e] * d_p[stencil[e]] + row.d_h[e] * d_h[stencil[e]]).sum();
        let exact = own + by_gradient[k];
        let found = (4.0 * narrow[k] - wide[k]) / 3.0;
        let scale = row.d_p.iter().chain(&row.d_h).fold(0.0f64, |largest, slope| largest.max(slope.abs()));
        assert!((exact - found).abs() < within * scale, "row {k}: {exact} against {found}, scale {scale}");
    }
}

const CARREAU: ShearLaw = ShearLaw::Carreau { critical_stress: 5e6, beta: 2.198, n: 0.6, npr: 0.1 };

fn rough_laws() -> impl Iterator<Item = Lubricant> {
    let laws = [
        AsperityLaw::default(),
        AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.05, sigma_over_beta: 0.01, hardness: 5e9 },
        AsperityLaw::Exponential { pressure: 6e9, decay: 0.4 },
    ];
    laws.into_iter().zip([1.0, 2.0, 0.5]).map(|(asperities, peklenik)| {
        let roughness = Roughness { asperities, peklenik, shear_flow: 0.4, ..Roughness::new(3e-7) };
        Lubricant::default().on_rough_surfaces(Some(roughness))
    })
}

#[test]
fn equations_of_lines_have_exact_derivatives() {
    let mut point = OperatingPoint::TABLE_2_1;
    point.sliding.slide_to_roll_ratio = 0.5;
    let solver = FullSolver::new(GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }).unwrap();
    for lubricant in rough_laws() {
        let (system, problem) = solver.cold_system(&point, lubricant).unwrap();
        assert_exact(system, &problem, 1e-9);
        let (system, problem) = solver.cold_system(&point, Lubricant { shear: CARREAU, ..lubricant }).unwrap();
        assert_exact(system, &problem, 1e-6);
    }
}

#[test]
fn equations_of_ellipses_have_exact_derivatives() {
    let request = MoesRequest { radius_y_m: Some(0.02), ..MoesRequest::new(ContactKind::Point, 60.0, 8.0) };
    let mut point = si_from_moes(&request).unwrap();
    point.sliding.slide_to_roll_ratio = -0.5;
    let solver = PointSolver::new(PointGridSpec::uniform(0.08, 0.1, (-4.0, 2.0, -2.0))).unwrap();
    for lubricant in rough_laws() {
        let (system, problem) = solver.cold_system(&point, lubricant).unwrap();
        assert_exact(system, &problem, 1e-9);
    }
    // The derivatives of ridges by the pressure gradient are those of isotropic surfaces.
    let isotropic = Roughness { shear_flow: 0.4, ..Roughness::new(3e-7) };
    let lubricant = Lubricant { shear: CARREAU, ..Lubricant::default().on_rough_surfaces(Some(isotropic)) };
    let (system, problem) = solver.cold_system(&point, lubricant).unwrap();
    assert_exact(system, &problem, 1e-6);
}
