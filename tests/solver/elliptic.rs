//! Elliptical contacts: comparison with an independent program, Hertz's gap, the circular contact, and a quarter turn.

use crate::contacts::{at, solved};
use ehl_explorer::solver::discrete::elasticity::PointScratch;
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::{ContactSolver, Problem, Start};
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::{ContactKind, Ellipse, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw, Sliding};

const COARSE: PointGridSpec = PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0));

fn complementary() -> Lubricant {
    Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() }
}

/// Eight contacts on coarse and medium grids, R_y/R_x from 0.2 to 20, by an independent program.
#[test]
fn shapes_and_films_agree_with_an_independent_program() {
    let file: serde_json::Value = serde_json::from_str(include_str!("../data/elliptic.json")).unwrap();
    let contacts = file["contacts"].as_array().unwrap();
    assert_eq!(contacts.len(), 8);
    let close = |got: f64, want: f64, within: f64, what: &str| {
        assert!((got / want - 1.0).abs() < within, "{what}: {got} against {want}");
    };
    for contact in contacts {
        let of = |name: &str| contact[name].as_f64().unwrap();
        let quantities = [of("Rx"), of("um"), of("w"), of("E"), of("eta0"), of("alpha")];
        let point = OperatingPoint {
            radius_y_m: Some(of("Ry")),
            ..OperatingPoint::from_quantities(ContactKind::Point, quantities, Sliding::NONE)
        };
        let (hertz, ellipse, moes) = (point.hertz(), point.ellipse(), point.moes());
        for (name, got) in [
            ("kappa", ellipse.kappa),
            ("Jx", ellipse.integral),
            ("a", hertz.half_width_m),
            ("b", hertz.half_length_m),
            ("pH", hertz.pressure_pa),
            ("M", moes.m),
            ("L", moes.l),
        ] {
            close(got, of(name), 1e-9, name);
        }
        let domain = contact["domain"].as_array().unwrap();
        let [from, to, edge] = [0, 1, 2].map(|k| domain[k].as_f64().unwrap());
        for (nodes, wanted) in contact["grids"].as_object().unwrap() {
            let (nx, ny) = nodes.split_once('x').unwrap();
            let [nx, ny] = [nx, ny].map(|n| n.parse::<f64>().unwrap());
            if nx > 450.0 || (nx > 350.0 && of("Ry") / of("Rx") < 6.0) {
                continue;
            }
            let spec = PointGridSpec::uniform((to - from) / (nx - 1.0), -edge / (ny - 1.0), (from, to, edge));
            let mut solver = ContactSolver::on(&GridSpec::Plane(spec).build().unwrap());
            let scalars = solved(&mut solver, &point, Lubricant::default()).scalars;
            for (name, got, within) in
                [("Hc", scalars.h_c, 1e-6), ("Hmin", scalars.h_min, 1e-6), ("Pc", scalars.p_c, 3e-6)]
            {
                let what = format!("{} on {nodes}: {name}", contact["name"]);
                close(got, wanted[name].as_f64().unwrap(), within, &what);
            }
        }
    }
}

/// Δ(0, 0) = R_F(0, 1, κ²)/J_x, and a flat gap inside: Hertz's pressure on three grids, each twice as fine.
#[test]
fn hertz_pressure_flattens_every_ellipse_with_second_order() {
    for ratio in [0.1, 0.2, 1.0, 5.0, 20.0, 40.0] {
        let ellipse = Ellipse::of_ratio(ratio).unwrap();
        let exact = ellip::elliprf(0.0, 1.0, ellipse.kappa * ellipse.kappa).unwrap() / ellipse.integral;
        let [coarse, fine, finest] = [1.0, 2.0, 4.0].map(|refined| {
            let spec = PointGridSpec::uniform(0.04 / refined, 0.1 / refined, (-2.0, 2.0, -2.0));
            let grid = spec.build().unwrap().of_ellipse(ellipse).unwrap();
            let ny = grid.ny();
            let hertz = |node: usize| (1.0 - grid.x[node / ny].powi(2) - grid.y[node % ny].powi(2)).max(0.0).sqrt();
            let pressure: Vec<f64> = (0..grid.len()).map(hertz).collect();
            let mut deformation = vec![0.0; grid.len()];
            grid.deform(&pressure, &mut deformation, &mut PointScratch::default());
            // Inside, the undeformed gap and the deformation add up to a constant.
            let inside = (0..grid.len()).filter(|node| hertz(*node) > 0.6);
            let uneven = inside.map(|node| (deformation[node] + grid.parabola(node) - exact).abs()).fold(0.0, f64::max);
            (grid.on_axis(&deformation, 0.0), uneven)
        });
        let limit = (4.0 * finest.0 - fine.0) / 3.0;
        assert!((limit / exact - 1.0).abs() < 1e-4, "R_y/R_x {ratio}: {limit} against {exact}");
        let order = ((coarse.0 - exact) / (fine.0 - exact)).log2();
        assert!((1.9..2.3).contains(&order), "R_y/R_x {ratio}: order {order}");
        assert!(coarse.1 < 0.02 * exact && finest.1 < 0.2 * coarse.1, "R_y/R_x {ratio}: {} {}", coarse.1, finest.1);
    }
}

#[test]
fn equal_radii_are_the_circle_to_the_last_bit() {
    let mut solver = ContactSolver::on(&GridSpec::Plane(COARSE).build().unwrap());
    let circle = at(ContactKind::Point, 50.0, 8.0);
    let own = solved(&mut solver, &circle, Lubricant::default());
    let equal = OperatingPoint { radius_y_m: Some(circle.radius_m), ..circle };
    let same = solved(&mut solver, &equal, Lubricant::default());
    assert_eq!((own.scalars, &own.film), (same.scalars, &same.film));
    let near = solved(&mut solver, &Quantity::RadiusRatio.at(&circle, 1.0 + 1e-6), Lubricant::default());
    assert!((near.scalars.h_c / own.scalars.h_c - 1.0).abs() < 2e-6, "{:?}", near.scalars);
    // Back again, with the kernel of the circular contact.
    let again = solved(&mut solver, &circle, Lubricant::default());
    assert_eq!(again.scalars, own.scalars);
}

/// Rolling along the short and along the long axis gives different film thicknesses of the same dry ellipse.
#[test]
fn a_quarter_turn_keeps_the_dry_contact_and_moves_the_film() {
    let long = Quantity::RadiusRatio.at(&at(ContactKind::Point, 50.0, 8.0), 3.0);
    let turned = OperatingPoint { radius_m: 3.0 * long.radius_m, radius_y_m: Some(long.radius_m), ..long };
    let (one, other) = (long.hertz(), turned.hertz());
    assert!((one.half_width_m / other.half_length_m - 1.0).abs() < 1e-12);
    assert!((one.pressure_pa / other.pressure_pa - 1.0).abs() < 1e-12);
    let mut solver = ContactSolver::on(&GridSpec::Plane(COARSE).build().unwrap());
    let [h_long, h_turned] =
        [long, turned].map(|point| solved(&mut solver, &point, complementary()).scalars.h_c * point.film_scale_m());
    // Less lubricant flows out at the sides of the wide contact.
    assert!(h_long > 1.1 * h_turned, "{h_long} {h_turned}");
}

/// Shear-thinning, a limiting stress and a starved inlet are supported for every shape.
#[test]
fn laws_of_the_circle_hold_for_ellipses() {
    let mut solver = ContactSolver::on(&GridSpec::Plane(COARSE).build().unwrap());
    let sliding = Sliding { slide_to_roll_ratio: 0.3, newtonian_plateau_ratio: None };
    for ratio in [0.3, 5.0] {
        let point = OperatingPoint { sliding, ..Quantity::RadiusRatio.at(&at(ContactKind::Point, 40.0, 5.0), ratio) };
        let newtonian = solved(&mut solver, &point, Lubricant::default());
        let eyring = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() };
        let thin = solved(&mut solver, &point, eyring);
        let drop = thin.scalars.h_c / newtonian.scalars.h_c;
        assert!((0.5..1.0).contains(&drop), "R_y/R_x {ratio}: {drop}");
        assert!(thin.traction_coefficient().abs() < newtonian.traction_coefficient().abs());
        // An Eyring stress that is not reached has no effect.
        let stiff = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e10, npr: 0.0 }, ..Lubricant::default() };
        let same = solved(&mut solver, &point, stiff).scalars.h_c;
        assert!((same / newtonian.scalars.h_c - 1.0).abs() < 1e-5, "{same}");
        let supply = 0.5 * newtonian.scalars.h_c * point.film_scale_m();
        let starved = Lubricant {
            cavitation: Cavitation::MassConserving { supply_film_m: Some(supply) },
            ..Lubricant::default()
        };
        let film = solved(&mut solver, &point, starved).scalars.h_c / newtonian.scalars.h_c;
        assert!((0.3..0.6).contains(&film), "starved by half: {film}");
    }
}

#[test]
fn what_is_no_ellipse_is_refused_with_a_sentence() {
    let circle = at(ContactKind::Point, 50.0, 8.0);
    let refused = |point: OperatingPoint| Problem::new(&point, Lubricant::default()).unwrap_err().to_string();
    for (radius_y, word) in [
        (-0.01, "convex together"),
        (0.0, "convex together"),
        (f64::NAN, "radius-y is NaN"),
        (f64::INFINITY, "radius-y is"),
        (1000.0 * circle.radius_m, "radius ratio R_y/R_x is 1000"),
        (0.01 * circle.radius_m, "between"),
    ] {
        let message = refused(OperatingPoint { radius_y_m: Some(radius_y), ..circle });
        assert!(message.contains(word), "{radius_y}: {message}");
    }
    let line = OperatingPoint { radius_y_m: Some(0.01), ..at(ContactKind::Line, 40.0, 10.0) };
    assert!(refused(line).contains("a line contact has no radius across"));
}

/// The previous solution is a good initial guess for the next shape.
#[test]
fn a_former_shape_is_a_start() {
    let mut solver = ContactSolver::on(&GridSpec::Plane(COARSE).build().unwrap());
    let base = at(ContactKind::Point, 50.0, 8.0);
    let mut last = solved(&mut solver, &base, Lubricant::default());
    for ratio in [1.2, 1.5, 2.0] {
        let point = Quantity::RadiusRatio.at(&base, ratio);
        let warm = solver.solve(&point, Lubricant::default(), Start::From(&last), &()).unwrap();
        let cold = solved(&mut solver, &point, Lubricant::default());
        assert!(warm.converged() && warm.report.attempts == 1, "{:?}", warm.report);
        assert!((warm.scalars.h_c / cold.scalars.h_c - 1.0).abs() < 3e-6);
        last = warm;
    }
}

/// The flow in the middle of a long ellipse is that of a line contact with the same pressure, speed and radius. The
/// inlet is at X = −8, with domain-truncation errors below a hundredth for both.
#[test]
fn a_wide_ellipse_is_a_line_contact_in_its_middle() {
    let wide = Quantity::RadiusRatio.at(&at(ContactKind::Point, 1000.0, 8.0), 40.0);
    let mut solver =
        ContactSolver::on(&GridSpec::Plane(PointGridSpec::uniform(0.03, 0.1, (-8.0, 2.0, -2.0))).build().unwrap());
    let solution = solved(&mut solver, &wide, complementary());
    let (middle, p_h) = (solution.scalars.h_c * wide.film_scale_m(), wide.hertz().pressure_pa);
    // p_H = √(wE′/(2πR)) of a line contact.
    let load = 2.0 * std::f64::consts::PI * wide.radius_m * p_h * p_h / wide.modulus_pa;
    let line = OperatingPoint { kind: ContactKind::Line, load, radius_y_m: None, ..wide };
    assert!((line.hertz().pressure_pa / p_h - 1.0).abs() < 1e-12);
    let mut solver = ContactSolver::on(&GridSpec::Uniform { dx: 0.005, domain: (-8.0, 2.0) }.build().unwrap());
    let film = solved(&mut solver, &line, complementary()).scalars.h_c * line.film_scale_m();
    assert!((middle / film - 1.0).abs() < 0.02, "{middle} against {film}");
}
