//! Full solutions of point contacts compared with independent ones on the same grid, and the corners of the
//! dissertation's box.

use ehl_explorer::solver::discrete::grid::PointGridSpec;
use ehl_explorer::solver::full::{PointSolver, Start};
use ehl_explorer::solver::parameters::ParameterSpace;
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::physics::lubricant::Lubricant;
use serde_json::Value;

#[test]
fn full_solutions_agree_with_independent_ones_on_301_by_41() {
    let file: Value = serde_json::from_str(include_str!("../data/point_stationary.json")).unwrap();
    let points = file["points"].as_array().unwrap();
    assert_eq!(points.len(), 5);
    let mut solver = PointSolver::new(PointGridSpec::DISSERTATION).unwrap();
    let (mut worst, mut off_axis) = ([0.0f64; 4], 0.0f64);
    for reference in points {
        let number = |name: &str| reference[name].as_f64().unwrap();
        let point = OperatingPoint {
            kind: ContactKind::Point,
            radius_m: number("radius_m"),
            speed_m_per_s: number("speed_m_per_s"),
            load: number("load_n"),
            modulus_pa: number("modulus_pa"),
            viscosity_pa_s: number("viscosity_pa_s"),
            alpha_per_pa: number("alpha_per_pa"),
            sliding: Sliding::NONE,
            radius_y_m: None,
        };
        assert!((point.lambda_bar() / number("lambda_bar") - 1.0).abs() < 1e-12);
        let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        let (s, m) = (&solution.scalars, number("M"));
        assert!(solution.converged() && solution.report.attempts == 1, "M {m}: {:?}", solution.report.termination);
        assert!(s.load_residual < 1e-14, "M {m}: load {}", s.load_residual);
        let wanted = |name: &str| reference["301x41"][name].as_f64().unwrap();
        let pairs = [("H_c", s.h_c), ("P_c", s.p_c), ("H_0", s.h_0), ("H_min", s.h_min)];
        // The minimum film thickness depends on where the cavitation boundary ends.
        let bounds = [1e-8, 1e-8, 1e-8, 5e-7];
        for (((name, got), bound), worst) in pairs.into_iter().zip(bounds).zip(&mut worst) {
            let error = (got / wanted(name) - 1.0).abs();
            assert!(error < bound, "M {m}: {name} {got} against {}", wanted(name));
            *worst = worst.max(error);
        }
        let place = [("X_H_min", s.x_h_min), ("Y_H_min", s.y_h_min)];
        assert!(place.iter().all(|&(name, got)| (got - wanted(name)).abs() < 1e-9), "M {m}: {place:?}");
        let axis = reference["301x41"]["P_on_axis_every_10th_node"].as_array().unwrap();
        assert_eq!(axis.len(), 31);
        for ((_, p, _), wanted) in solution.profile().step_by(10).zip(axis) {
            off_axis = off_axis.max((p - wanted.as_f64().unwrap()).abs());
            assert!((p - wanted.as_f64().unwrap()).abs() < 1e-7, "M {m}: P {p} against {wanted}");
        }
    }
    println!("greatest relative differences of H_c, P_c, H_0, H_min: {worst:?}; of P along the axis: {off_axis:.1e}");
}

#[test]
fn corners_of_the_corrected_box_of_table_3_4_converge() {
    let mut solver = PointSolver::new(PointGridSpec { dx: 0.04, ..PointGridSpec::DISSERTATION }).unwrap();
    let table = ParameterSpace::table_3_4();
    assert_eq!(table.corners().count(), 16);
    for corner in table.corners() {
        let point = table.at(ContactKind::Point, &corner).unwrap();
        let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(solution.converged(), "{:?}: {:?}", point.moes(), solution.report.termination);
    }
}
