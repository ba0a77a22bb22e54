//! Tests of lubricant-parameterised models of sliding contacts with Eyring lubricants.

use super::small::{self, POINT_GRID, line_grid, sliding_oils, with_ends};
use super::*;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{ContactSolver, Problem, Solution, Start};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use crate::solver::physics::lubricant::{Cavitation, LimitingStress, Lubricant, ShearLaw};
use crate::solver::reduced::{Domain, Online, ReducedModel, ReducedOptions, Sampling, Trust};
use std::sync::Arc;

fn eyring(critical_stress: f64) -> Lubricant {
    Lubricant { shear: ShearLaw::Eyring { critical_stress, npr: 0.0 }, ..Lubricant::default() }
}

fn limited(lubricant: Lubricant, ambient: f64, slope: f64) -> Lubricant {
    Lubricant { limiting_stress: Some(LimitingStress { ambient, slope, eyring: None }), ..lubricant }
}

/// Returns a sliding contact with these parameters.
fn contact(kind: ContactKind, (m, l): (f64, f64), (radius, modulus): (f64, f64), srr: f64) -> OperatingPoint {
    let request = MoesRequest {
        radius_m: Some(radius),
        modulus_pa: Some(modulus),
        viscosity_pa_s: Some(0.03),
        alpha_per_pa: Some(18e-9),
        ..MoesRequest::new(kind, m, l)
    };
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
    OperatingPoint { sliding, ..si_from_moes(&request).unwrap() }
}

fn apart(a: &Solution, b: &Solution) -> f64 {
    let fields = |s: &Solution| s.pressure.iter().chain(&s.film).copied().collect::<Vec<f64>>();
    fields(a).iter().zip(fields(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn equal_modulus_times_stress_gives_equal_films() {
    let plane = GridSpec::Plane(POINT_GRID);
    for (kind, grid, tolerance) in [(ContactKind::Line, line_grid(240), 1e-11), (ContactKind::Point, plane, 1e-7)] {
        let mut solver = ContactSolver::on(&grid.build().unwrap());
        let mut solve = |point: &OperatingPoint, laws| {
            let solution = solver.solve(point, laws, Start::Cold, &()).unwrap();
            assert!(solution.converged(), "{kind:?}: {:?}", solution.report);
            solution
        };
        let one = solve(&contact(kind, (25.0, 8.0), (0.01, 250e9), 0.6), eyring(4e6));
        let other = solve(&contact(kind, (25.0, 8.0), (0.03, 100e9), 0.6), eyring(10e6));
        assert!(apart(&one, &other) < tolerance, "{kind:?}: {:.1e}", apart(&one, &other));
        let ratio = other.traction_coefficient() / one.traction_coefficient();
        assert!((ratio / 2.5 - 1.0).abs() < 100.0 * tolerance, "{kind:?}: {ratio}");
        // A limited traction depends on the ratio of the limit's slope to the stress.
        let [one, other] = [(&one, 0.02), (&other, 0.05)].map(|(solution, slope)| {
            let lubricant = limited(solution.problem.lubricant, slope * 1e8, slope);
            solution.clone().of_problem(Problem::new(&solution.problem.point, lubricant).unwrap())
        });
        let ratio = other.traction_coefficient() / one.traction_coefficient();
        assert!((ratio / 2.5 - 1.0).abs() < 100.0 * tolerance, "{kind:?}: {ratio}");
        // Shear-thinning has an effect, and so has the stress alone.
        let [softer, newtonian] = [eyring(10e6), Lubricant::default()]
            .map(|laws| solve(&contact(kind, (25.0, 8.0), (0.01, 250e9), 0.6), laws).scalars.h_c);
        let felt = [softer, newtonian].map(|film| (film / one.scalars.h_c - 1.0).abs());
        assert!(felt.iter().all(|felt| *felt > 1e-4), "{kind:?}: {felt:?}");
        // Film thickness is even in SRR.
        let mirrored = solve(&contact(kind, (25.0, 8.0), (0.01, 250e9), -0.6), eyring(4e6));
        assert!(apart(&one, &mirrored) < tolerance);
    }
}

fn trained(spec: &TrainingSpec) -> (Arc<ReducedModel>, Online) {
    let model = small::trained(spec);
    (Arc::clone(&model), Online::new(model, ReducedOptions::default()))
}

/// Returns the contact with the same dimensionless film and τ₀ multiplied by `stresses`.
fn equal_but(point: &OperatingPoint, stresses: f64) -> OperatingPoint {
    let request = MoesRequest {
        radius_m: Some(2.0 * point.radius_m),
        modulus_pa: Some(point.modulus_pa / stresses),
        viscosity_pa_s: Some(point.viscosity_pa_s),
        alpha_per_pa: Some(point.alpha_per_pa),
        ..MoesRequest::new(point.kind, point.moes().m, point.moes().l)
    };
    OperatingPoint { sliding: point.sliding, ..si_from_moes(&request).unwrap() }
}

#[test]
fn sliding_contacts_of_all_oils_agree_with_full_solutions() {
    let spec = TrainingSpec { evidence: 110, ..sliding_oils(Sampling::QDeim, 80) };
    let (model, mut online) = trained(&spec);
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let (mut steps, mut held) = (0, 0);
    let points = random_points(&spec.range, ContactKind::Line, 30, 77);
    for (k, own) in points.iter().enumerate() {
        // For another τ₀ its product with E′ is the same, and the limit's slope divided by τ₀ is in the trained range.
        let stresses = [1.0, 0.5, 2.0][k % 3];
        let slope = stresses * [0.03, 0.06, 0.1][k / 3 % 3];
        let (point, lubricant) = (equal_but(own, stresses), limited(eyring(5e6 * stresses), 2e6, slope));
        online.forget();
        let solved = online.solve(&point, lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let fields = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, lubricant, Start::Cold, &()).unwrap();
        let (traction, bounds) = (solved.traction.unwrap(), solved.error.unwrap());
        let off = [solved.h_c / truth.scalars.h_c, fields.scalars.h_min / truth.scalars.h_min].map(|r| (r - 1.0).abs());
        let rubbed = (traction / truth.traction_coefficient() - 1.0).abs();
        assert!(off.iter().all(|off| *off < 5e-3) && rubbed < 1e-2, "{off:?} {rubbed:.1e} at {point:?}");
        assert!((fields.scalars.h_c / solved.h_c - 1.0).abs() < 1e-8);
        held += usize::from(off[0] < bounds.h_c.bound && rubbed < bounds.traction.unwrap().bound);
        steps += solved.iterations / (1 + solved.beside.len());
    }
    assert!(steps <= 30 * 6, "{steps} steps");
    assert!(held >= 28, "bounds hold for {held} of 30");
}

#[test]
fn traction_does_not_jump_between_windows_and_knows_its_limits() {
    let spec = sliding_oils(Sampling::QDeim, 60);
    let (model, mut online) = trained(&spec);
    let [from, to] = [0, 1].map(|k| model.windows[k].anchor.unwrap());
    let laws = limited(spec.lubricant, 5e6, 0.05);
    let at = |t: f64| {
        let moes = (from.m * (to.m / from.m).powf(t), from.l * (to.l / from.l).powf(t));
        contact(ContactKind::Line, moes, (0.01, 231e9), 0.2)
    };
    let mut tractions = Vec::new();
    let mut blended = 0;
    for step in 0..=200 {
        let solved = online.solve(&at(f64::from(step) / 200.0), laws).unwrap();
        blended += usize::from(!solved.beside.is_empty());
        let fields = online.reconstruct(&solved).unwrap().traction_coefficient();
        // The quadrature of a line contact is that of the whole grid; a blend of tractions is close to the traction
        // of the blend.
        let near = if solved.beside.is_empty() { 1e-9 } else { 1e-4 };
        assert!((solved.traction.unwrap() / fields - 1.0).abs() < near);
        tractions.push(solved.traction.unwrap().ln());
    }
    assert!((2..200).contains(&blended), "{blended}");
    for three in tractions.windows(3) {
        let bend = three[0] - 2.0 * three[1] + three[2];
        assert!(bend.abs() < 1e-3, "{bend:.1e}");
    }
    let known = |laws: Lubricant, online: &mut Online| online.solve(&at(0.0), laws).unwrap().traction.is_some();
    assert!(known(spec.lubricant, &mut online) && known(limited(spec.lubricant, 0.0, 0.149), &mut online));
    // Outside the range of the quadrature the traction can be computed from the fields.
    assert!(!known(limited(spec.lubricant, 5e6, 0.2), &mut online));
}

#[test]
fn the_share_of_a_traction_that_a_limit_takes_is_told() {
    let spec = sliding_oils(Sampling::QDeim, 60);
    let (_, mut online) = trained(&spec);
    let mut most = 0.0f64;
    for point in random_points(&spec.range, ContactKind::Line, 6, 31) {
        online.forget();
        let free = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(free.cut, Some(0.0));
        let mut before = 1.0;
        for slope in [0.01, 0.03, 0.1] {
            online.forget();
            let solved = online.solve(&point, limited(spec.lubricant, 0.0, slope)).unwrap();
            let cut = solved.cut.unwrap();
            // A limiting stress reduces the traction only: the state is the same.
            if let (Some(own), Some(free), true) = (solved.traction, free.traction, solved.beside.is_empty()) {
                assert!((cut - (1.0 - own / free)).abs() < 1e-7, "{cut} {own} {free}");
            }
            assert!((0.0..=before).contains(&cut), "{cut} after {before}");
            (before, most) = (cut, most.max(cut));
        }
    }
    assert!(most > 0.3, "{most}");
}

#[test]
fn what_lies_outside_is_told_by_the_number_that_does() {
    let spec = sliding_oils(Sampling::QDeim, 60);
    let domain = spec.domain();
    assert_eq!(domain.space, spec.range);
    assert!(domain.is_shear_thinning() && domain.srr() == Some((0.0, 0.6)));
    let told = |modulus, srr, laws| {
        let problem = Problem::new(&contact(ContactKind::Line, (25.0, 8.0), (0.01, modulus), srr), laws).unwrap();
        match domain.trust(&problem) {
            Trust::Trained => String::new(),
            Trust::Outside(why) => why.to_string(),
        }
    };
    assert_eq!(told(231e9, 0.3, eyring(5e6)), "");
    assert_eq!(told(231e9, -0.6, limited(eyring(5e6), 5e6, 0.4)), "", "a limit cuts traction only");
    assert_eq!(told(115e9, 0.3, eyring(10e6)), "");
    assert_eq!(
        told(200e9, 0.3, eyring(15e6)),
        "the Eyring stress τ₀ = 15 MPa lies outside the trained range 3.75…8.75 MPa"
    );
    let thick = Problem::new(&contact(ContactKind::Line, (15.0, 9.9), (0.01, 150e9), 0.1), eyring(5e6)).unwrap();
    let low = Domain { space: with_ends(&domain.space, Quantity::GradientStress, (0.0, 1e6)), ..domain.clone() };
    let Trust::Outside(why) = low.trust(&thick) else { panic!() };
    let sentence = why.to_string();
    assert!(sentence.starts_with("the shear stress by the pressure gradient = "), "{sentence}");
    assert!(sentence.ends_with("lies above the trained 1 MPa"), "{sentence}");
    assert_eq!(low.strange_shape(&thick), Some(why));
    assert_eq!(told(231e9, 0.7, eyring(5e6)), "SRR = 70 % lies above the trained 60 %");
    let plateau = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.1 }, ..eyring(5e6) };
    assert_eq!(told(231e9, 0.3, plateau), "the model was trained with other lubricant laws");
    assert_eq!(told(231e9, 0.3, Lubricant::default()), "the model was trained with other lubricant laws");
}

#[test]
fn ranges_of_sliding_oils_are_refused_with_their_field() {
    let good = sliding_oils(Sampling::QDeim, 60);
    assert!(good.check().is_ok() && good.range.slides());
    let refused = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    for (own, ends, field) in [
        (Quantity::SlideToRollRatio, (0.5, 0.1), "range.axes.SlideToRollRatio"),
        (Quantity::Modulus, (0.0, 1e11), "range.axes.Modulus"),
        (Quantity::LimitSlope, (0.0, 0.1), "range.constants.LimitSlope"),
        (Quantity::GradientStress, (0.0, f64::NAN), "range.limits.GradientStress"),
        (Quantity::M, (0.0, 1.0), "range.axes.M"),
    ] {
        let spec = TrainingSpec { range: with_ends(&good.range, own, ends), ..good.clone() };
        assert!(refused(spec.clone()).contains(field), "{field}: {}", refused(spec));
    }
    let newtonian = TrainingSpec { lubricant: Lubricant::default(), ..good.clone() };
    assert!(refused(newtonian).contains("varies SRR, but the lubricant is Newtonian"));
    assert!(good.clone().under(Cavitation::Complementarity).check().is_ok());
    let points = random_points(&good.range, ContactKind::Line, 200, 3);
    assert_eq!(points.len(), 200);
    for point in points {
        let (modulus, srr) = (point.modulus_pa, point.sliding.slide_to_roll_ratio);
        assert!((150e9 * (1.0 - 1e-9)..=350e9 * (1.0 + 1e-9)).contains(&modulus) && (0.0..=0.6).contains(&srr));
        assert!((0.4e9..=1.6e9).contains(&point.hertz().pressure_pa));
    }
}
