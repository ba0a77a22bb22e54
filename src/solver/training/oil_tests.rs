//! Tests of lubricant-parameterised models: agreement with full solutions for every lubricant, continuity between
//! local models, and reported limits.

use super::small::{self, heated_ellipses, oils, oils_of_points, with_ends};
use super::*;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{ContactSolver, Problem, Start};
use crate::solver::parameters::{Axis, Quantity};
use crate::solver::physics::contact::{
    ContactKind, FilmShape, MoesRequest, OperatingPoint, expected_film, si_from_moes,
};
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ViscosityLaw, roelands_exponent};
use crate::solver::reduced::{
    Online, ReducedModel, ReducedOptions, SampledRows, Sampling, TestSpace, Trust, Window, all_rows,
};
use std::sync::Arc;

fn trained(spec: &TrainingSpec) -> (Arc<ReducedModel>, Online) {
    let model = small::trained(spec);
    (Arc::clone(&model), Online::new(model, ReducedOptions::default()))
}

fn contact(m: f64, l: f64, alpha: f64, viscosity: f64) -> OperatingPoint {
    let (alpha_per_pa, viscosity_pa_s) = (Some(alpha), Some(viscosity));
    si_from_moes(&MoesRequest { alpha_per_pa, viscosity_pa_s, ..MoesRequest::new(ContactKind::Line, m, l) }).unwrap()
}

#[test]
fn models_of_oils_are_near_full_solutions_of_every_oil() {
    for (sampling, cavitation) in [
        (Sampling::QDeim, Cavitation::Complementarity),
        (Sampling::QDeim, Cavitation::Penalty),
        (Sampling::Cubature, Cavitation::Complementarity),
    ] {
        let spec = oils(sampling, 60).under(cavitation);
        let (model, mut online) = trained(&spec);
        assert!(model.windows.len() == 3 && model.windows.iter().all(|window| window.snapshots.len() >= 60));
        let mut full = ContactSolver::on(&model.windows[0].grid);
        let mut steps = 0;
        for point in random_points(&spec.range, spec.contact(), 40, 77) {
            online.forget();
            let solved = online.solve(&point, spec.lubricant).unwrap();
            assert_eq!(solved.trust, Trust::Trained);
            let fields = online.reconstruct(&solved).unwrap();
            let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap().scalars;
            let off = [solved.h_c / truth.h_c - 1.0, fields.scalars.h_min / truth.h_min - 1.0];
            assert!(off.iter().all(|off| off.abs() < 3e-3), "{sampling:?}, {cavitation:?}: {off:?}");
            assert!(
                (fields.scalars.h_c / solved.h_c - 1.0).abs() < 1e-8,
                "the film of the fields is that of the solve"
            );
            let carried = fields.scalars.load_residual;
            assert!(carried < 1e-5, "{sampling:?}, {cavitation:?}: {carried:.1e} of the load");
            assert!(solved.error.is_none_or(|error| error.h_c.bound > 0.0));
            steps += solved.iterations / (1 + solved.beside.len());
        }
        assert!(steps <= 40 * 4, "{sampling:?}, {cavitation:?}: {steps} steps from kriged starts");
    }
}

#[test]
fn rows_are_added_until_they_agree_with_all_rows() {
    let asked = TrainingSpec { rows_per_mode: 1.1, ..oils(Sampling::QDeim, 60) };
    let (model, _) = small::trained_with_state(&asked);
    let points = random_points(&asked.range, asked.contact(), 200, 77);
    for window in &model.windows {
        let with = |rows: Option<SampledRows>| {
            let mut alone = ReducedModel { windows: vec![window.clone()], ..model.clone() };
            rows.into_iter().for_each(|rows| alone.windows[0].set_rows(Sampling::All, rows));
            Online::new(Arc::new(alone), ReducedOptions::default())
        };
        let all = all_rows(&TestSpace::new(window.pressure.basis(), &window.grid));
        let (mut sampled, mut exact) = (with(None), with(Some(all)));
        let mut off = Vec::new();
        for point in points.iter().filter(|point| model.window_at(point).anchor == window.anchor) {
            let [own, exact] = [&mut sampled, &mut exact].map(|online| {
                online.forget();
                online.solve(point, asked.lubricant).unwrap().h_c
            });
            off.push((own / exact - 1.0).abs());
        }
        off.sort_by(f64::total_cmp);
        let (rows, modes) = (window.sampled_rows.len(), window.pressure.count());
        assert!(rows > modes * 11 / 10 + 1, "{rows} rows of {modes} modes");
        assert!(off.len() > 20 && off[off.len() * 9 / 10] < 1e-3, "{rows} rows of {modes} modes: {off:?}");
    }
}

#[test]
fn the_expected_film_is_moes_formula_in_the_solvers_units() {
    for (kind, m, l) in [(ContactKind::Line, 40.0, 10.0), (ContactKind::Point, 100.0, 6.0)] {
        let point = si_from_moes(&MoesRequest::new(kind, m, l)).unwrap();
        let two_u = 2.0 * point.viscosity_pa_s * point.speed_m_per_s / (point.modulus_pa * point.radius_m);
        let film_m = FilmShape::of(&point).film(point.moes()) * point.radius_m * two_u.sqrt();
        let expected = expected_film(&point) * point.film_scale_m();
        assert!((expected / film_m - 1.0).abs() < 1e-9, "{kind:?}: {expected:e} {film_m:e}");
    }
}

#[test]
fn point_models_share_a_basis_and_state_their_grid_error() {
    let spec = oils_of_points(50);
    let (model, mut online) = trained(&spec);
    let shared: Vec<_> = model.windows.iter().map(|window| &window.pressure.combined().unwrap().shared).collect();
    assert!(shared.len() == 2 && Arc::ptr_eq(shared[0], shared[1]) && shared[0].basis.modes.ncols() == 50);
    let mut full = ContactSolver::on(&model.windows[0].grid);
    for point in random_points(&spec.range, spec.contact(), 20, 77) {
        assert!(expected_film(&point) >= 0.16);
        online.forget();
        let solved = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let fields = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
        let truth = full.judged(truth);
        let off = [fields.scalars.h_c / truth.scalars.h_c - 1.0, fields.scalars.h_min / truth.scalars.h_min - 1.0];
        assert!(off.iter().all(|off| off.abs() < 1e-2), "{:?}: {off:?}", point.moes());
        let (told, wanted) = (fields.grid_cost.unwrap(), truth.grid_cost.unwrap());
        assert!(
            (told.truncation - wanted.truncation).abs() < 0.2 * wanted.truncation.abs() + 2e-3,
            "{told:?} {wanted:?}"
        );
        assert!(
            (told.resolution - wanted.resolution).abs() < 0.2 * wanted.resolution.abs() + 1e-2,
            "{told:?} {wanted:?}"
        );
    }
    let thin = si_from_moes(&MoesRequest {
        alpha_per_pa: Some(16e-9),
        viscosity_pa_s: Some(0.05),
        ..MoesRequest::new(ContactKind::Point, 59.0, 4.1)
    });
    let Trust::Outside(why) = model.trust(&Problem::new(&thin.unwrap(), spec.lubricant).unwrap()) else { panic!() };
    let why = why.to_string();
    assert!(why.starts_with("H_c by Moes’ formula = ") && why.ends_with("lies below the trained 0.16"), "{why}");
}

#[test]
fn windows_with_distant_boundaries_solve_their_contacts() {
    // Thick films cavitate late: the cavitated region of some contacts contains a third of the outlet of others.
    let ends = [
        (Quantity::M, (2.0, 9.0)),
        (Quantity::L, (0.5, 2.6)),
        (Quantity::Alpha, (5e-9, 30e-9)),
        (Quantity::HertzPressure, (0.1e9, 3.2e9)),
    ];
    let thick = ends.iter().fold(oils(Sampling::QDeim, 80).range, |range, (own, ends)| with_ends(&range, *own, *ends));
    let grid = GridSpec::Graded { nodes: 632, domain: (-20.0, 3.2), registered: true };
    let spec = TrainingSpec {
        range: thick,
        windows: Windows::Anchored {
            count: 2,
            modes: 50,
            grid,
            shared: 0,
            missing: 0.0,
            missing_of_any: 0.0,
            divided_by: 0,
        },
        evidence: 0,
        ..oils(Sampling::QDeim, 120).under(Cavitation::Complementarity)
    };
    let (model, mut online) = trained(&spec);
    let ends = |window: &Window| {
        let fronts = || window.snapshots.iter().map(|snapshot| snapshot.fronts[0]);
        fronts().max().unwrap() - fronts().min().unwrap()
    };
    assert!(model.windows.iter().map(ends).max().unwrap() > 24);
    let mut steps = 0;
    for point in random_points(&spec.range, spec.contact(), 300, 5) {
        online.forget();
        let solved = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(solved.window, model.window_for(&point), "{:?}", point.moes());
        steps += solved.iterations / (1 + solved.beside.len());
    }
    assert!(steps <= 300 * 3, "{steps} steps");
}

#[test]
fn nothing_jumps_on_the_way_from_one_anchor_to_the_next() {
    let spec = oils(Sampling::QDeim, 60);
    let (model, mut online) = trained(&spec);
    let (mut blended, steps) = (0, 400);
    for pair in model.windows.windows(2) {
        let [from, to] = [pair[0].anchor.unwrap(), pair[1].anchor.unwrap()];
        let at = |t: f64| contact(from.m * (to.m / from.m).powf(t), from.l * (to.l / from.l).powf(t), 16e-9, 0.03);
        let mut films = Vec::new();
        for step in 0..=steps {
            let solved = online.solve(&at(f64::from(step) / f64::from(steps)), spec.lubricant).unwrap();
            blended += usize::from(!solved.beside.is_empty());
            assert!(solved.beside.iter().map(|(share, _)| share).sum::<f64>() < 0.7);
            films.push(solved.h_c.ln());
        }
        for three in films.windows(3) {
            let bend = three[0] - 2.0 * three[1] + three[2];
            assert!(bend.abs() < 2e-5, "{bend:.1e}");
        }
    }
    assert!((10..steps as usize).contains(&blended), "{blended}");
}

#[test]
fn windows_have_no_more_modes_than_what_they_may_miss_asks_for() {
    let root_mean_square = |missed: &[f64]| (missed.iter().sum::<f64>() / missed.len() as f64).sqrt();
    windows_miss_no_more_than([4e-3, 0.0], root_mean_square);
    let most = |missed: &[f64]| missed.iter().copied().fold(0.0, f64::max).sqrt();
    windows_miss_no_more_than([0.0, 1e-2], most);
}

/// Tests a training with limits of the modes' error for all solutions together and for any single one. `of` combines
/// the squared errors of the solutions.
fn windows_miss_no_more_than([missing, missing_of_any]: [f64; 2], of: fn(&[f64]) -> f64) {
    let spec = oils(Sampling::QDeim, 60);
    let Windows::Anchored { count, modes, grid, .. } = spec.windows else { panic!() };
    let windows = Windows::Anchored { count, modes, grid, shared: 0, missing, missing_of_any, divided_by: 0 };
    let limit = missing.max(missing_of_any);
    let (model, state) = small::trained_with_state(&TrainingSpec { windows, ..spec });
    let counts: Vec<usize> = model.windows.iter().map(|window| window.pressure.count()).collect();
    assert!(counts.iter().all(|count| *count < modes) && counts.iter().any(|count| *count != counts[0]), "{counts:?}");
    for (window, state) in model.windows.iter().zip(&state.windows) {
        let (basis, weights) = (window.pressure.basis(), window.grid.weights());
        let norm = |v: &dyn Fn(usize) -> f64| (0..weights.len()).map(|i| weights[i] * v(i).powi(2)).sum::<f64>();
        // Error of the first modes for a pressure, relative to its film thickness.
        let missed = |modes: usize| {
            let squared = |solved: &Solved| {
                let shares = basis.coefficients(weights, |i| solved.pressure[i]);
                let made = |i: usize| (0..modes).map(|k| shares[k] * basis.modes[(i, k)]).sum::<f64>();
                norm(&|i| solved.pressure[i] - made(i)) / solved.h_c.min(0.1).powi(2)
            };
            of(&state.solved.iter().map(squared).collect::<Vec<f64>>())
        };
        let all = window.pressure.count();
        assert!(missed(all) < 1.01 * limit && missed(all - 1) > 0.99 * limit, "{} {}", missed(all), missed(all - 1));
    }
}

#[test]
fn ellipses_of_every_oil_are_near_full_solutions() {
    let warm = heated_ellipses(Sampling::Cubature, 80);
    let mut range = warm.range.clone();
    let sliding = [Quantity::Radius, Quantity::SlideToRollRatio, Quantity::Modulus];
    range.axes.retain(|axis| !sliding.contains(&axis.quantity));
    range.limits.retain(|(limited, _)| !matches!(limited, Quantity::Speed | Quantity::SlidingSpeed));
    range.constants.clear();
    let spec = TrainingSpec { range, lubricant: Lubricant::default(), ..warm };
    let (model, mut online) = trained(&spec);
    assert!(model.domain.space == spec.range && model.of_ellipses());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    for point in random_points(&spec.range, ContactKind::Point, 10, 6) {
        online.forget();
        let solved = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
        let off = (solved.h_c / truth.scalars.h_c - 1.0).abs();
        assert!(off < 5e-3, "{point:?}: {off:.1e}");
    }
    let sliding = small::sliding_oils(Sampling::QDeim, 60);
    let mut range = sliding.range.clone();
    range.axes.push(Axis::new(Quantity::RadiusRatio, (0.5, 2.0)));
    let refused = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    let lines = TrainingSpec { range, ..sliding };
    let points = TrainingSpec { windows: spec.windows, ..lines.clone() };
    assert!(refused(lines.clone()).contains("line contacts"), "{}", refused(lines));
    assert!(refused(points.clone()).contains("range.axes.RadiusRatio"), "{}", refused(points));
}

#[test]
fn oils_beyond_the_table_are_told() {
    let spec = oils(Sampling::QDeim, 60);
    let domain = spec.domain();
    assert_eq!(domain.space, spec.range);
    let told = |m, l, alpha, viscosity| {
        let problem = Problem::new(&contact(m, l, alpha, viscosity), spec.lubricant).unwrap();
        match domain.trust(&problem) {
            Trust::Trained => String::new(),
            Trust::Outside(why) => why.to_string(),
        }
    };
    assert_eq!(told(30.0, 7.0, 16e-9, 0.03), "");
    assert_eq!(told(30.0, 7.0, 16e-9, 0.2), "η₀ = 200 mPa·s lies outside the trained range 10…100 mPa·s");
    assert!(told(30.0, 7.0, 13e-9, 0.099).starts_with("Roelands’ z = 0.346"));
    assert!(told(60.0, 7.0, 12e-9, 0.011).starts_with("p_H = 1.8"));
    assert!(told(70.0, 7.0, 20e-9, 0.03).starts_with("M = 70"));
    assert!(told(30.0, 7.0, 40e-9, 0.03).starts_with("α = 40/GPa"));
}

#[test]
fn ranges_of_oils_are_refused_with_their_field() {
    let good = oils(Sampling::QDeim, 60);
    assert!(good.check().is_ok() && good.contact() == ContactKind::Line);
    let refused = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    let with = |own, ends| TrainingSpec { range: with_ends(&good.range, own, ends), ..good.clone() };
    for (own, ends, field) in [
        (Quantity::Viscosity, (0.1, 0.01), "range.axes.Viscosity"),
        (Quantity::RoelandsExponent, (0.0, 0.8), "range.limits.RoelandsExponent"),
        (Quantity::HertzPressure, (f64::NAN, 1e9), "range.limits.HertzPressure"),
        (Quantity::Alpha, (0.0, 1e-8), "range.axes.Alpha"),
        (Quantity::L, (5.0, f64::INFINITY), "range.axes.L"),
    ] {
        let sentence = refused(with(own, ends));
        assert!(sentence.contains(field), "{field}: {sentence}");
    }
    let grid = small::line_grid(240);
    let anchored = |count, modes, shared, [missing, missing_of_any]: [f64; 2], divided_by| TrainingSpec {
        windows: Windows::Anchored { count, modes, grid, shared, missing, missing_of_any, divided_by },
        ..good.clone()
    };
    let windows = |count, modes| anchored(count, modes, 0, [0.0; 2], 0);
    assert!(refused(windows(0, 20)).contains("windows.count") && refused(windows(3, 2)).contains("windows.modes"));
    assert!(refused(TrainingSpec { windows: Windows::Automatic { modes: 20 }, ..good.clone() }).contains("Anchored"));
    let plain = TrainingSpec { range: small::moes((5.0, 50.0), (5.0, 8.0), 4e9), ..good.clone() };
    assert!(refused(plain).contains("a range that varies Viscosity"));
    let mut barus = good.clone();
    barus.lubricant.viscosity = ViscosityLaw::Barus;
    assert!(refused(barus).contains("has another one"));
    assert!(refused(with(Quantity::FilmThickness, (-1.0, 1e6))).contains("range.limits.FilmThickness"));
    assert!(refused(anchored(3, 32, 20, [0.0; 2], 0)).contains("windows.shared"));
    for (missing, divided_by, field) in [
        ([0.2, 0.0], 0, "missing"),
        ([f64::NAN, 0.0], 0, "missing"),
        ([0.0, -1e-3], 0, "missing_of_any"),
        ([0.0, 0.0], 3, "divided_by"),
    ] {
        let sentence = refused(anchored(3, 32, 0, missing, divided_by));
        assert!(sentence.contains(&format!("windows.{field}")), "{sentence}");
    }
}

#[test]
fn oils_are_those_of_the_range() {
    let range = oils(Sampling::QDeim, 60).range;
    let points = random_points(&range, ContactKind::Line, 200, 3);
    assert_eq!(points.len(), 200);
    let inside = |value: f64, (low, high): (f64, f64)| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&value);
    for point in points {
        let moes = point.moes();
        assert!(inside(moes.m, (15.0, 60.0)) && inside(moes.l, (5.0, 10.0)));
        assert!(inside(point.alpha_per_pa, (12e-9, 24e-9)) && inside(point.viscosity_pa_s, (0.01, 0.1)));
        assert!(inside(roelands_exponent(&point), (0.4, 0.8)) && inside(point.hertz().pressure_pa, (0.4e9, 1.6e9)));
    }
}
