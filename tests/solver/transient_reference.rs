//! Transient contact compared with an independent solution on the same grid with the same steps, and a film thickness
//! compared with a published one.

use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::transient::{self, Inputs, Signal, Transient};
use ehl_explorer::solver::full::{PointSolver, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::physics::lubricant::Lubricant;

/// Returns the numbers of a table after its comment and its header.
fn rows<const N: usize>(table: &str) -> Vec<[f64; N]> {
    let row = |line: &str| -> [f64; N] {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    table.lines().skip(2).map(row).collect()
}

#[test]
fn a_breathing_contact_agrees_with_independent_values() {
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 });
    let breathing = Transient::new(OperatingPoint::TABLE_2_1, load, 8.0, 0.01);
    let trajectory = transient::solve(GridSpec::DISSERTATION, &breathing, &()).unwrap();
    assert!(trajectory.finished() && trajectory.moments.len() == 801);
    let reference = rows::<4>(include_str!("../data/line_transient.csv"));
    assert_eq!(reference.len(), 41);
    let mut worst = [0.0f64; 3];
    for [time, p_c, h_c, h_min] in reference {
        let moment = &trajectory.moments[(100.0 * time).round() as usize];
        assert!((moment.time - time).abs() < 1e-9);
        let pairs = [(moment.p_c, p_c), (moment.h_c, h_c), (moment.h_min, h_min)];
        for ((got, wanted), worst) in pairs.into_iter().zip(&mut worst) {
            *worst = worst.max((got / wanted - 1.0).abs());
        }
    }
    println!("greatest relative differences of P_c, H_c, H_min: {worst:?}");
    // The independent solution keeps its factorisation while the cavitation boundary moves. Its minimum film thickness
    // has three digits.
    assert!(worst[0] < 5e-6 && worst[1] < 5e-6 && worst[2] < 5e-4, "{worst:?}");
}

#[test]
fn the_film_of_a_ball_on_a_disc_is_the_published_one() {
    let point = OperatingPoint {
        kind: ContactKind::Point,
        radius_m: 12.5e-3,
        speed_m_per_s: 0.09,
        load: 15.0,
        modulus_pa: 110e9,
        viscosity_pa_s: 0.25,
        alpha_per_pa: 22e-9,
        sliding: Sliding::NONE,
        radius_y_m: None,
    };
    let mut solver = PointSolver::new(PointGridSpec::DISSERTATION).unwrap();
    let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
    assert!(solution.converged());
    let (length, height) = (1e6 * point.hertz().half_width_m, 1e9 * point.film_scale_m());
    let computed: Vec<(f64, f64)> = solution.profile().map(|(x, _, h)| (length * x, height * h)).collect();
    let mut off = Vec::new();
    // Read off a figure: at the steep flanks the reading error exceeds that of the film thickness.
    for [x, published] in rows::<2>(include_str!("../data/ball_on_disc_film.csv")) {
        if x.abs() < 130.0 {
            let k = computed.partition_point(|&(at, _)| at < x);
            let ((x_0, h_0), (x_1, h_1)) = (computed[k - 1], computed[k]);
            off.push((h_0 + (h_1 - h_0) * (x - x_0) / (x_1 - x_0)) / published - 1.0);
        }
    }
    let mean = off.iter().map(|off| off.abs()).sum::<f64>() / off.len() as f64;
    let worst = off.iter().fold(0.0f64, |worst, off| worst.max(off.abs()));
    println!("{} places: {:.1} % in the mean, {:.1} % at most", off.len(), 100.0 * mean, 100.0 * worst);
    assert!(off.len() > 15 && mean < 0.03 && worst < 0.06, "{off:.3?}");
}
