//! The embedded model of shear-thinning line contacts: it converges in its range, agrees with full solutions, and

use crate::shear_models;
use crate::shear_models::{assert_file_keeps_everything, assert_limits_are_said, assert_mirrored, errors};
use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::{ContactSolver, Start};
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::physics::lubricant::Lubricant;
use ehl_explorer::solver::reduced::{ErrorMeasures, Norm, Online, ReducedOptions, Trust, traction_curve};
use ehl_explorer::solver::training::{Plan, TrainingSpec};

const LINE: ContactKind = ContactKind::Line;

fn online() -> Online {
    shear_models::online(LINE)
}

fn points(count: usize) -> Vec<OperatingPoint> {
    shear_models::points(LINE, &shear_models::range(LINE), count, 77)
}

#[test]
fn it_solves_its_range_and_agrees_with_full_solutions() {
    let mut online = online();
    let grid = online.model.windows[0].grid.clone();
    let mut full = ContactSolver::on(&grid);
    let mut worst = [0.0f64; 3];
    let (mut kept, mut promises) = (0, 0);
    let mut tightness: [Vec<f64>; 3] = Default::default();
    for (k, point) in points(400).iter().enumerate() {
        online.forget();
        let solved = online.solve(point, SQUALANE_PIP).unwrap();
        assert_eq!(solved.trust, Trust::Trained, "{point:?}");
        if k % 16 > 0 {
            continue;
        }
        let reduced = online.reconstruct(&solved).unwrap();
        let truth = full.solve(point, SQUALANE_PIP, Start::Cold, &()).unwrap();
        assert!(truth.converged());
        let slides = point.sliding.slide_to_roll_ratio > 0.0;
        let [h_c, h_min, traction] = errors(&reduced, solved.traction.unwrap(), &truth);
        let promised = solved.error.unwrap();
        let sensible = truth.traction_warning().is_none();
        assert!(promised.traction.is_some() == sensible || !slides);
        let bounds = [Some(promised.h_c), Some(promised.h_min), promised.traction].map(|e| e.map(|e| e.bound));
        for ((error, bound), ratios) in [h_c, h_min, traction].into_iter().zip(bounds).zip(&mut tightness) {
            promises += usize::from(bound.is_some());
            kept += usize::from(bound.is_some_and(|bound| error <= bound));
            ratios.extend(bound.map(|bound| bound / error));
        }
        let errors = [h_c, h_min, if sensible { traction } else { 0.0 }];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
    }
    println!("greatest errors of H_c, H_min and traction: {worst:?}");
    assert!(worst.iter().all(|&error| error < 5e-3), "{worst:?}");
    assert!(kept * 50 >= 49 * promises, "{kept} of {promises} bounds hold");
    // A bound that is many times too large is useless: the best possible one is 4 times the error in the median. Too
    // few of these contacts have a traction to assess its bound; the scene of random validation does so.
    let median = |mut ratios: Vec<f64>| {
        ratios.sort_by(f64::total_cmp);
        ratios[ratios.len() / 2]
    };
    let [h_c, h_min, _] = tightness.map(median);
    println!("bounds of H_c and H_min over the errors, medians: {h_c:.1} and {h_min:.1}");
    assert!(h_c < 8.0 && h_min < 10.0, "{h_c:.1} and {h_min:.1}");
}

#[test]
fn its_traction_without_fields_is_that_of_its_fields() {
    let mut online = online();
    let mut off = Vec::new();
    for (k, point) in points(300).into_iter().enumerate() {
        // Every other contact slides slowly.
        let srr = point.sliding.slide_to_roll_ratio * if k % 2 == 0 { 1.0 } else { 0.01 };
        let sliding = Sliding { slide_to_roll_ratio: srr, ..point.sliding };
        let solved = online.solve(&OperatingPoint { sliding, ..point }, SQUALANE_PIP).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        assert!((solved.h_c / fields.scalars.h_c - 1.0).abs() < 1e-12);
        let traction = fields.traction_coefficient();
        off.extend((srr > 0.0).then(|| (solved.traction.unwrap() / traction - 1.0).abs()));
        if srr == 0.0 {
            assert_eq!(solved.traction, Some(0.0));
        }
    }
    let worst = off.into_iter().fold(0.0, f64::max);
    println!("traction without fields against that of fields: {worst:.1e} at most");
    assert!(worst < 1e-9, "{worst:.1e}");
}

#[test]
fn its_residual_is_measured_with_nodes_that_thin() {
    for kind in [LINE, ContactKind::Point] {
        let mut online = shear_models::online(kind);
        for point in shear_models::points(kind, &shear_models::range(kind), 6, 5) {
            let solved = online.solve(&point, SQUALANE_PIP).unwrap();
            let fields = online.reconstruct(&solved).unwrap();
            let window = &online.model.windows[solved.window];
            let measures = ErrorMeasures::new(window, &ReducedOptions::default(), Norm::Quadrature);
            let found = measures.residuals(&solved.coefficients, &fields);
            let off = (found.sampled_rows / solved.residual_estimate - 1.0).abs();
            assert!(off < 1e-4, "{kind:?}: {found:?}, but the iteration found {:e}", solved.residual_estimate);
            assert!(found.all_rows >= found.sampled_rows);
        }
    }
}

#[test]
fn curves_equal_single_contacts_in_fewer_iterations() {
    let mut online = online();
    let base = points(5)[3];
    for (vary, from, to) in [
        (Quantity::SlideToRollRatio, 0.0, 1.0),
        (Quantity::NewtonianPlateauRatio, 0.2, 1.0),
        (Quantity::Speed, 0.9 * base.speed_m_per_s, 1.3 * base.speed_m_per_s),
    ] {
        let values: Vec<f64> = (0..41).map(|k| from + (to - from) * f64::from(k) / 40.0).collect();
        let curve: Vec<_> = traction_curve(&mut online, &base, SQUALANE_PIP, vary, &values).collect();
        let (mut along, mut alone, mut greatest) = (0, 0, 0.0f64);
        for (place, &value) in curve.iter().zip(&values) {
            assert_eq!(place.value, value);
            let on_curve = place.solution.as_ref().unwrap();
            online.forget();
            let single = online.solve(&vary.at(&base, value), SQUALANE_PIP).unwrap();
            // Both iterations end with a step below this.
            let tolerance = ReducedOptions::default().tolerance;
            let off = (on_curve.h_c / single.h_c - 1.0).abs();
            assert!(off < tolerance, "{vary:?} {value}: H_c off by {off:e}");
            let (one, other) = (on_curve.traction.unwrap(), single.traction.unwrap());
            assert!((one - other).abs() <= tolerance * other.abs(), "{vary:?} {value}: {one} against {other}");
            greatest = greatest.max(off);
            (along, alone) = (along + on_curve.iterations, alone + single.iterations);
        }
        println!("{vary:?}: {along} iterations along, {alone} one by one; H_c within {greatest:.1e}");
        assert!(along * 4 < alone * 3, "{vary:?}: {along} iterations along the curve, {alone} one by one");
    }
}

#[test]
fn a_curve_beyond_what_the_equations_know_says_so_where_it_ends() {
    let mut online = online();
    let base = points(1)[0];
    let values = [0.8, 1.0, 1.2];
    let curve: Vec<_> =
        traction_curve(&mut online, &base, SQUALANE_PIP, Quantity::NewtonianPlateauRatio, &values).collect();
    assert!(curve[0].solution.is_ok() && curve[1].solution.is_ok());
    let sentence = curve[2].solution.as_ref().unwrap_err().to_string();
    assert!(sentence.contains("plateau ratio") && sentence.contains("1.2"), "{sentence}");
}

#[test]
fn reversed_sliding_mirrors_and_unit_plateau_is_newtonian() {
    assert_mirrored(online(), points(1)[0], 1e-6);
}

#[test]
fn untrained_and_foreign_lubricants_are_reported() {
    assert_limits_are_said(&online(), points(1)[0], &[]);
}

#[test]
fn its_file_keeps_what_a_shear_thinning_lubricant_adds() {
    assert_file_keeps_everything(LINE);
}

#[test]
fn a_range_with_sliding_needs_a_lubricant_that_feels_it() {
    let spec = |lubricant: Lubricant, alpha: f64| {
        let (m, own) = ((10.0, 20.0), shear_models::range(LINE));
        let mut range = shear_models::narrowed(own, [(Quantity::M, m), (Quantity::L, (6.0, 8.0))]);
        range.fixed.iter_mut().filter(|(own, _)| *own == Quantity::Alpha).for_each(|(_, value)| *value = alpha);
        let (grid, plan) = (GridSpec::EXPLORER, Plan::FarthestPoint { snapshots: 10 });
        TrainingSpec { lubricant, ..TrainingSpec::new(range, m, grid, plan) }
    };
    let sentence = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    assert!(sentence(spec(Lubricant::default(), 2e-8)).contains("no shear constants"));
    assert!(sentence(spec(SQUALANE_PIP, 1e-8)).contains("viscosity law"));
    assert!(spec(SQUALANE_PIP, 1.8925e-8).check().is_ok());
}
