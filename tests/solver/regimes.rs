//! Regimes: the headline and the chart of M and L compared with full solutions of line, circular and elliptical
//! contacts all over the chart. With `EHL_LONG` 200 contacts of each kind are solved.

use crate::common::cases::cases;
use ehl_explorer::scene::regime::{Ratios, Regime, RegimeMap};
use ehl_explorer::scene::regimes::{L_AXIS, M_AXIS};
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::{ContactSolver, Solution, Start};
use ehl_explorer::solver::physics::contact::{
    ContactKind, FilmShape, MoesRequest, OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA, si_from_moes,
};
use ehl_explorer::solver::physics::lubricant::Lubricant;
use fastrand::Rng;

/// Point contacts above this M take minutes.
const HEAVY: f64 = 300.0;

fn solved(point: &OperatingPoint) -> Option<Solution> {
    let grid = GridSpec::explorer_for(point).ok()?.build().ok()?;
    let solution = ContactSolver::on(&grid).solve(point, Lubricant::default(), Start::Cold, &()).ok()?;
    solution.converged().then_some(solution)
}

/// Returns deformation over film thickness and largest viscosity from the nodes, independently of the program's
/// regime.
fn measured(solution: &Solution) -> (f64, f64) {
    let (ny, deformation) = (solution.y.len(), solution.deformation());
    let nearest = |x: f64| {
        let distance = |i: &usize| (solution.x[*i] - x).abs();
        (0..solution.x.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    };
    let at = |x: f64| deformation[nearest(x) * ny + ny - 1];
    let viscosity = |p: &f64| solution.problem.fluid.at(*p).viscosity;
    let largest = solution.nodes().map(|(_, _, p, _)| viscosity(&p)).fold(0.0, f64::max);
    ((at(0.0) - 0.5 * (at(-1.0) + at(1.0))) / solution.scalars.h_c, largest)
}

/// Checks the regimes of random contacts. A ratio within `margin` of its limit allows both names on the chart.
fn check(count: usize, seed: u64, mut draw: impl FnMut(&mut Rng, f64, f64) -> OperatingPoint) {
    let (mut rng, mut solutions, mut met) = (Rng::with_seed(seed), 0, [0; 4]);
    let between = |rng: &mut Rng, (low, high): (f64, f64)| low * (high / low).powf(rng.f64());
    while solutions < count {
        let (m, l) = (between(&mut rng, M_AXIS), between(&mut rng, L_AXIS));
        let point = draw(&mut rng, m, l);
        let heavy = point.kind == ContactKind::Point && m > HEAVY;
        if heavy || point.hertz().pressure_pa > PLAUSIBLE_HERTZ_PRESSURE_PA {
            continue;
        }
        let Some(solution) = solved(&point) else { continue };
        solutions += 1;
        let (deformation, viscosity) = measured(&solution);
        let headline = Ratios::of(&solution).regime();
        let chart = RegimeMap::new(FilmShape::of(&point)).at(point.moes());
        let name = format!(
            "M {m:.3}, L {l:.3}, R_y/R {:.2}: deformation {deformation:.3}, viscosity {viscosity:.3e}, {chart:?}",
            point.radius_ratio()
        );
        println!("{name}");
        met[headline as usize] += 1;
        // The headline follows the solution, except for the distance between nodes.
        if (deformation - 1.0).abs() > 0.03 {
            assert_eq!(headline.is_elastic(), deformation > 1.0, "{name}");
        }
        assert_eq!(headline.is_piezoviscous(), viscosity > 2.0, "{name}");
        // The chart follows it outside a band around each boundary.
        if !(0.75..1.33).contains(&deformation) {
            assert_eq!(chart.regime().is_elastic(), deformation > 1.0, "{name}");
        }
        if !(0.65..1.5).contains(&(viscosity.ln() / 2f64.ln())) {
            assert_eq!(chart.regime().is_piezoviscous(), viscosity > 2.0, "{name}");
        }
    }
    println!("{met:?}");
    assert!(met.iter().filter(|count| **count > 0).count() >= 3, "the contacts cover the chart: {met:?}");
}

#[test]
fn line_contacts_have_the_regime_of_their_solution() {
    check(cases(24, 200), 71, |_, m, l| si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap());
}

#[test]
fn circular_contacts_have_the_regime_of_their_solution() {
    check(cases(12, 200), 72, |_, m, l| si_from_moes(&MoesRequest::new(ContactKind::Point, m, l)).unwrap());
}

#[test]
fn elliptical_contacts_have_the_regime_of_their_solution() {
    check(cases(12, 200), 73, |rng, m, l| {
        let circle = si_from_moes(&MoesRequest::new(ContactKind::Point, m, l)).unwrap();
        let ratio = 0.2 * 75f64.powf(rng.f64());
        OperatingPoint { radius_y_m: Some(ratio * circle.radius_m), ..circle }
    });
}

/// A ball with a horseshoe was once called rigid.
#[test]
fn a_heavily_loaded_ball_is_elastic_and_piezoviscous() {
    let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 200.0, 8.0)).unwrap();
    assert_eq!(RegimeMap::new(FilmShape::CIRCLE).regime(point.moes()), Regime::ElasticPiezoviscous);
    let ratios = Ratios::of(&solved(&point).unwrap());
    assert_eq!(ratios.regime(), Regime::ElasticPiezoviscous);
    assert!(ratios.deformation > 5.0 && ratios.viscosity > 1e3, "{ratios:?}");
}
