//! The embedded model of shear-thinning line contacts: it solves its range, agrees with full solutions, and says where it ends.

use ehl_explorer::harness::model_file::{embedded, embedded_shear_of, from_bytes, to_bytes};
use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::full::{ContactSolver, Problem, Start};
use ehl_explorer::solver::lubricant::Lubricant;
use ehl_explorer::solver::reduced::{CurveVariable, Online, ReducedError, ReducedOptions, Trust, traction_curve};
use ehl_explorer::solver::training::{Plan, Range, SlidingRange, TrainingSpec, Windows, random_points};
use fastrand::Rng;

fn online() -> Online {
    Online::new(embedded_shear_of(ContactKind::Line).unwrap(), ReducedOptions::default())
}

fn points(count: usize) -> Vec<OperatingPoint> {
    let range = Range::Sliding(SlidingRange {
        m: (4.0, 60.0),
        l: (5.0, 13.0),
        srr: (0.0, 1.0),
        npr: (0.2, 1.0),
        radius: 12.7e-3,
        modulus: 123.878213951e9,
        viscosity: 0.0705,
        alpha: 1.8925e-8,
        max_hertz_pressure: None,
    });
    random_points(&range, ContactKind::Line, (4.0, 60.0), count, &mut Rng::with_seed(77))
}

#[test]
fn it_solves_its_range_and_agrees_with_full_solutions() {
    let mut online = online();
    let grid = online.model.windows[0].grid.clone();
    let mut full = ContactSolver::on(&grid);
    let mut worst = [0.0f64; 3];
    let (mut kept, mut promises) = (0, 0);
    for (k, point) in points(400).iter().enumerate() {
        online.forget();
        let solved = online.solve(point, SQUALANE_PIP).unwrap();
        assert_eq!(solved.trust, Trust::Trained, "{point:?}");
        if k % 16 > 0 {
            continue;
        }
        let reduced = online.reconstruct(&solved).unwrap();
        let truth = full.solve(point, SQUALANE_PIP, Start::Cold, &mut ()).unwrap();
        assert!(truth.converged());
        let off = |reduced: f64, full: f64| (reduced / full - 1.0).abs();
        let slides = point.sliding.slide_to_roll_ratio > 0.0;
        let traction = if slides { off(solved.traction.unwrap(), truth.traction_coefficient()) } else { 0.0 };
        let (h_c, h_min) = (off(solved.h_c, truth.scalars.h_c), off(reduced.scalars.h_min, truth.scalars.h_min));
        let promised = solved.error.unwrap();
        let sensible = truth.traction_warning().is_none();
        assert!(promised.traction.is_some() == sensible || !slides);
        let bounds = [Some(promised.h_c), Some(promised.h_min), promised.traction].map(|e| e.map(|e| e.bound));
        for (error, bound) in [h_c, h_min, traction].into_iter().zip(bounds) {
            promises += usize::from(bound.is_some());
            kept += usize::from(bound.is_some_and(|bound| error <= bound));
        }
        let errors = [h_c, h_min, if sensible { traction } else { 0.0 }];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
    }
    println!("greatest errors of H_c, H_min and traction: {worst:?}");
    assert!(worst.iter().all(|&error| error < 5e-3), "{worst:?}");
    assert!(kept * 50 >= 49 * promises, "{kept} of {promises} bounds hold");
}

#[test]
fn its_traction_by_few_nodes_is_that_of_its_fields() {
    let mut online = online();
    let rule = online.model.windows.iter().map(|window| window.traction.clone().unwrap());
    assert!(rule.map(|rule| rule.nodes.len()).all(|nodes| (20..=60).contains(&nodes)));
    let mut off = Vec::new();
    for (k, point) in points(300).into_iter().enumerate() {
        // Every other one slides slowly.
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
    off.sort_by(f64::total_cmp);
    let (p95, worst) = (off[off.len() * 95 / 100], off[off.len() - 1]);
    println!("rule of the traction against all nodes: 95 % {p95:.1e}, max {worst:.1e}");
    assert!(p95 < 1e-3 && worst < 5e-3, "95 % {p95:.1e}, max {worst:.1e}");
}

#[test]
fn a_curve_is_what_its_contacts_are_one_by_one_in_fewer_iterations() {
    let mut online = online();
    let base = points(5)[3];
    for (vary, from, to) in [
        (CurveVariable::SlideToRollRatio, 0.0, 1.0),
        (CurveVariable::NewtonianPlateauRatio, 0.2, 1.0),
        (CurveVariable::Speed, 0.9 * base.speed_m_per_s, 1.3 * base.speed_m_per_s),
    ] {
        let values: Vec<f64> = (0..41).map(|k| from + (to - from) * f64::from(k) / 40.0).collect();
        let curve: Vec<_> = traction_curve(&mut online, &base, SQUALANE_PIP, vary, &values).collect();
        let (mut along, mut alone, mut greatest) = (0, 0, 0.0f64);
        for (place, &value) in curve.iter().zip(&values) {
            assert_eq!(place.value, value);
            let on_curve = place.solution.as_ref().unwrap();
            online.forget();
            let single = online.solve(&vary.at(&base, value), SQUALANE_PIP).unwrap();
            // Either iteration ends with a step below this.
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
        traction_curve(&mut online, &base, SQUALANE_PIP, CurveVariable::NewtonianPlateauRatio, &values).collect();
    assert!(curve[0].solution.is_ok() && curve[1].solution.is_ok());
    let sentence = curve[2].solution.as_ref().unwrap_err().to_string();
    assert!(sentence.contains("plateau ratio") && sentence.contains("1.2"), "{sentence}");
}

#[test]
fn it_is_mirrored_by_the_sliding_and_newtonian_at_a_plateau_of_one() {
    let mut online = online();
    let point = points(1)[0];
    let mut film = |srr: f64, npr: f64| {
        online.forget();
        let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) };
        let solved = online.solve(&OperatingPoint { sliding, ..point }, SQUALANE_PIP).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        (fields.scalars.h_c, fields.traction_coefficient())
    };
    let (one, other) = (film(0.4, 0.3), film(-0.4, 0.3));
    assert!((one.0 / other.0 - 1.0).abs() < 1e-6 && (one.1 / other.1 + 1.0).abs() < 1e-6);
    assert!((film(0.0, 1.0).0 / film(0.9, 1.0).0 - 1.0).abs() < 1e-6);
}

#[test]
fn what_it_was_not_trained_for_is_said_and_a_newtonian_model_refuses_its_lubricant() {
    let online_shear = online();
    let base = points(1)[0];
    let trust = |point: OperatingPoint| online_shear.model.trust(&Problem::new(&point, SQUALANE_PIP).unwrap());
    let slid = |srr, npr| Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) };
    for (point, word) in [
        (OperatingPoint { sliding: slid(1.5, 0.5), ..base }, "SRR"),
        (OperatingPoint { sliding: slid(0.5, 0.1), ..base }, "NPR"),
        (OperatingPoint { modulus_pa: 2.0 * base.modulus_pa, ..base }, "modulus"),
    ] {
        assert!(matches!(trust(point), Trust::Outside(why) if why.contains(word)), "{word}");
    }
    let mut newtonian = Online::new(embedded().unwrap(), ReducedOptions::default());
    let sliding = slid(0.5, 0.3);
    let refused = newtonian.solve(&OperatingPoint { sliding, ..base }, SQUALANE_PIP);
    assert_eq!(refused.unwrap_err(), ReducedError::ShearThinning);
}

#[test]
fn its_file_keeps_what_a_shear_thinning_lubricant_adds() {
    let model = embedded_shear_of(ContactKind::Line).unwrap();
    let bytes = to_bytes(&model).unwrap();
    let again = from_bytes(&bytes).unwrap();
    assert_eq!(again.domain, model.domain);
    assert!(again.windows[0].snapshots == model.windows[0].snapshots && again.domain.sliding.is_some());
    assert!(again.windows[0].traction == model.windows[0].traction && again.windows[0].traction.is_some());
    assert_eq!(
        again.windows[0].calibration.as_ref().map(|c| c.evidence()),
        model.windows[0].calibration.as_ref().map(|c| c.evidence())
    );
    assert_eq!(to_bytes(&again).unwrap(), bytes);
    assert!(from_bytes(&bytes[..bytes.len() - 8]).is_err());
}

#[test]
fn a_range_with_sliding_needs_a_lubricant_that_feels_it() {
    let model = embedded_shear_of(ContactKind::Line).unwrap();
    let spec = |lubricant: Lubricant, alpha: f64| TrainingSpec {
        title: String::new(),
        range: Range::Sliding(SlidingRange {
            m: (10.0, 20.0),
            l: (6.0, 8.0),
            srr: (0.0, 1.0),
            npr: (0.2, 1.0),
            radius: 12.7e-3,
            modulus: 123.9e9,
            viscosity: 0.0705,
            alpha,
            max_hertz_pressure: None,
        }),
        lubricant,
        plan: Plan::FarthestPoint { snapshots: 10 },
        windows: Windows::Automatic { modes: 50 },
        pressure_loss: 1e-5,
        deformation_loss: 1e-5,
        sampling: model.windows[0].sampling,
        rows_per_mode: 2.5,
        penalty: 1e5,
        positive_modes: true,
        evidence: 0,
        seed: 1,
    };
    let sentence = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    assert!(sentence(spec(Lubricant::default(), 2e-8)).contains("no shear constants"));
    assert!(sentence(spec(SQUALANE_PIP, 1e-8)).contains("viscosity law"));
    assert!(spec(SQUALANE_PIP, 1.8925e-8).check().is_ok());
}
