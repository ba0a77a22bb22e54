//! Tests of reduced models of thermal contacts.

use super::small::{
    heated, heated_balls, heated_bounded, heated_ellipses, heated_ellipses_bounded, heated_oils, heated_oils_bounded,
    line, trained, with_ends,
};
use super::{TrainingSpec, Windows, random_points};
use crate::solver::full::{ContactSolver, Problem, Solution, Start};
use crate::solver::parameters::{ParameterSpace, Quantity};
use crate::solver::physics::bodies::BodyHeat;
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant};
use crate::solver::reduced::{
    Online, ReducedError, ReducedModel, ReducedOptions, ReducedSolution, Sampling, TractionRule, Trust, traction_curve,
};
use std::sync::Arc;

fn online(model: &Arc<ReducedModel>) -> Online {
    Online::new(Arc::clone(model), ReducedOptions::default())
}

/// Returns the errors of H_c, H_min, traction and mid-film temperature rise with respect to the full solution on the
/// model's grid.
fn errors(online: &Online, solved: &ReducedSolution, full: &Solution) -> [f64; 4] {
    let own = online.reconstruct(solved).unwrap();
    let [rise, true_rise] = [&own, full].map(|solution| solution.heat.as_ref().unwrap().central);
    let relative = |a: f64, b: f64| (a / b - 1.0).abs();
    [
        relative(own.scalars.h_c, full.scalars.h_c),
        relative(own.scalars.h_min, full.scalars.h_min),
        relative(own.traction_coefficient(), full.traction_coefficient()),
        rise.difference(&true_rise),
    ]
}

/// Asserts that errors are below `bars`, and below three times their bounds.
fn assert_near_and_bounded(solved: &ReducedSolution, found: [f64; 4], bars: [f64; 4]) {
    for (error, bar) in found.into_iter().zip(bars) {
        assert!(error < bar, "{:?}: {found:?}", solved.point);
    }
    let estimate = solved.error.unwrap();
    let bounds = [Some(estimate.h_c), Some(estimate.h_min), estimate.traction, estimate.rise];
    for (error, bound) in found.into_iter().zip(bounds) {
        assert!(error < 3.0 * bound.map_or(f64::INFINITY, |known| known.bound), "{found:?} {estimate:?}");
    }
}

#[test]
fn reduced_contacts_with_heat_are_the_full_ones() {
    // Largest permitted errors of a thermal model.
    let bars = [5e-3, 1e-2, 1e-2, 3e-2];
    for spec in [heated(Sampling::All, 30), heated_bounded()] {
        let sampling = spec.sampling;
        let model = trained(&spec);
        let mut online = online(&model);
        let mut full = ContactSolver::on(&model.windows[0].grid);
        for point in random_points(&spec.range, ContactKind::Line, 6, 11) {
            online.forget();
            let solved = online.solve(&point, spec.lubricant).unwrap();
            assert_eq!(solved.trust, Trust::Trained);
            let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
            let found = errors(&online, &solved, &truth);
            for (error, bar) in found.into_iter().zip(bars) {
                assert!(error < bar, "{sampling:?} at {point:?}: {found:?}");
            }
            // Scalars computed without fields agree with those of the fields.
            let fields = online.reconstruct(&solved).unwrap();
            let (warmth, heat) = (solved.heat.as_ref().unwrap(), fields.heat.as_ref().unwrap());
            assert!((warmth.central.mid_film_k - heat.central.mid_film_k).abs() < 1e-6);
            if let Some(own) = solved.traction {
                assert!((own - fields.traction_coefficient()).abs() < 1e-3 * own.abs().max(1e-3), "{own}");
            }
        }
    }
}

#[test]
fn the_rule_on_all_nodes_gives_the_traction_with_heat() {
    for spec in [heated_bounded(), heated_balls(Sampling::Cubature, 24)] {
        let mut model = ReducedModel::clone(&trained(&spec));
        model.windows.iter_mut().for_each(|window| window.traction = Some(TractionRule::whole()));
        let mut online = online(&Arc::new(model));
        for point in random_points(&spec.range, spec.contact(), 3, 17) {
            let solved = online.solve(&point, spec.lubricant).unwrap();
            let (own, fields) = (solved.traction.unwrap(), online.reconstruct(&solved).unwrap().traction_coefficient());
            assert!((own - fields).abs() < 1e-9 * own.abs().max(1e-3), "{own} {fields}");
        }
    }
}

#[test]
fn reduced_balls_with_heat_are_the_full_ones() {
    let spec = heated_balls(Sampling::Cubature, 24);
    let model = trained(&spec);
    let mut online = online(&model);
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let mut warmest = 0.0f64;
    for point in random_points(&spec.range, ContactKind::Point, 5, 13) {
        online.forget();
        let solved = online.solve(&point, spec.lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
        let found = errors(&online, &solved, &truth);
        for (error, bar) in found.into_iter().zip([1e-2, 2e-2, 2e-2, 3e-2]) {
            assert!(error < bar, "{point:?}: {found:?}");
        }
        // Temperatures are interpolated to every node of the plane, between the marched lines.
        let fields = online.reconstruct(&solved).unwrap();
        let (own, heat) = (fields.heat.as_ref().unwrap(), truth.heat.as_ref().unwrap());
        assert!(own.y == heat.y && own.rise_k.len() == heat.rise_k.len());
        let hottest = heat.largest.mid_film_k;
        let off: f64 = own.rises().zip(heat.rises()).map(|(a, b)| (a.mid_film_k - b.mid_film_k).abs()).sum();
        let off = off / heat.rise_k.len() as f64;
        assert!(off < 0.02 * hottest.max(1.0), "{off} K in the mean of {hottest} K");
        assert!(own.balance.residual().abs() < 3e-2, "{:?}", own.balance);
        let traction = fields.traction_coefficient();
        assert!((solved.traction.unwrap() - traction).abs() < 1e-3 * traction.abs().max(1e-3));
        warmest = warmest.max(hottest);
    }
    assert!(warmest > 3.0, "{warmest} K");
}

#[test]
fn reduced_thermal_ellipses_agree_with_full_ones() {
    let spec = heated_ellipses_bounded();
    let model = trained(&spec);
    assert!(model.of_ellipses() && model.domain.space == spec.range);
    let mut online = online(&model);
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let mut random = fastrand::Rng::with_seed(5);
    let (mut narrow, mut wide) = (0, 0);
    for (k, point) in random_points(&spec.range, ContactKind::Point, 10, 12).into_iter().enumerate() {
        let lubricant =
            if k % 3 == 0 { spec.lubricant } else { spec.range.with_random_constants(spec.lubricant, &mut random) };
        online.forget();
        let solved = online.solve(&point, lubricant).unwrap();
        assert_eq!(solved.trust, Trust::Trained);
        let truth = full.solve(&point, lubricant, Start::Cold, &()).unwrap();
        let found = errors(&online, &solved, &truth);
        assert_near_and_bounded(&solved, found, [1e-2, 2e-2, 2e-2, 3e-2]);
        // Fields are stored at Y = y/b; temperatures and side flow use lengths in units of a.
        let fields = online.reconstruct(&solved).unwrap();
        let (own, heat) = (fields.heat.as_ref().unwrap(), truth.heat.as_ref().unwrap());
        assert!(own.y == heat.y && own.balance.residual().abs() < 3e-2, "{:?}", own.balance);
        let traction = fields.traction_coefficient();
        assert!((solved.traction.unwrap() - traction).abs() < 1e-3 * traction.abs().max(1e-3));
        *(if point.is_narrow() { &mut narrow } else { &mut wide }) += 1;
    }
    assert!(narrow > 0 && wide > 0);
    let point = random_points(&spec.range, ContactKind::Point, 1, 12)[0];
    let slender = Quantity::RadiusRatio.at(&point, 4.0);
    let told = model.trust(&Problem::new(&slender, spec.lubricant).unwrap());
    assert!(matches!(&told, Trust::Outside(why) if why.to_string().contains("ratio of radii")), "{told:?}");
}

/// Returns the contact of equal M, L, α and η₀ with R and E′ multiplied by factors.
fn equal_but(point: &OperatingPoint, radius: f64, modulus: f64) -> OperatingPoint {
    let request = MoesRequest {
        radius_m: Some(point.radius_m * radius),
        modulus_pa: Some(point.modulus_pa * modulus),
        viscosity_pa_s: Some(point.viscosity_pa_s),
        alpha_per_pa: Some(point.alpha_per_pa),
        ..MoesRequest::new(ContactKind::Line, point.moes().m, point.moes().l)
    };
    OperatingPoint { sliding: point.sliding, ..si_from_moes(&request).unwrap() }
}

#[test]
fn equal_radius_over_cubed_modulus_gives_equal_contacts() {
    let spec = heated_oils(Sampling::All, 8);
    let Windows::Anchored { grid, .. } = spec.windows else { panic!() };
    let free = Lubricant { limiting_stress: None, ..spec.lubricant };
    let mut solver = ContactSolver::on(&grid.build().unwrap());
    for point in random_points(&spec.range, ContactKind::Line, 3, 5) {
        let (stiffer, laws) = (0.8f64, free);
        let other = equal_but(&point, stiffer.powi(3), stiffer);
        assert!((other.speed_m_per_s / point.speed_m_per_s - 1.0).abs() < 1e-9, "the speed says it");
        let [a, b] = [point, other].map(|at| solver.solve(&at, laws, Start::Cold, &()).unwrap());
        // The coupled iteration ends with steps of a millionth.
        assert!((a.scalars.h_c / b.scalars.h_c - 1.0).abs() < 3e-6, "{} {}", a.scalars.h_c, b.scalars.h_c);
        let [warm, as_warm] = [&a, &b].map(|solution| solution.heat.as_ref().unwrap().central);
        assert!(warm.mid_film_k > 0.1 && warm.difference(&as_warm) < 1e-4, "{warm:?} {as_warm:?}");
        // Shear rates, and with them stresses, are proportional to a/R = 4 p_H/E′.
        let ratio = a.traction_coefficient() / b.traction_coefficient();
        assert!((ratio / stiffer - 1.0).abs() < 1e-4, "{ratio}");
    }
}

#[test]
fn many_oils_with_heat_are_the_full_ones_and_bounded() {
    let spec = heated_oils_bounded();
    let model = trained(&spec);
    assert!(model.windows.len() == 2 && model.windows.iter().all(|window| window.anchor.is_some()));
    // Bases contain solutions with other constants; starting values are contacts with the model's own.
    for window in &model.windows {
        assert!(window.snapshots.len() < 75 && window.pressure.count() == window.snapshots[0].coefficients.len());
        assert!(window.snapshots.iter().all(|snapshot| spec.lubricant_of(&snapshot.point) == spec.lubricant));
    }
    let mut online = online(&model);
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let mut random = fastrand::Rng::with_seed(5);
    for (k, point) in random_points(&spec.range, ContactKind::Line, 12, 12).into_iter().enumerate() {
        // The model's own constants, and others of its range.
        let lubricant =
            if k % 3 == 0 { spec.lubricant } else { spec.range.with_random_constants(spec.lubricant, &mut random) };
        online.forget();
        let solved = online.solve(&point, lubricant).unwrap();
        assert!(solved.trust == Trust::Trained && solved.beside.is_empty(), "temperatures are not blended");
        let truth = full.solve(&point, lubricant, Start::Cold, &()).unwrap();
        let found = errors(&online, &solved, &truth);
        assert_near_and_bounded(&solved, found, [5e-3, 1e-2, 1e-2, 3e-2]);
    }
    let point = random_points(&spec.range, ContactKind::Line, 1, 12)[0];
    let why = |point: OperatingPoint, laws: Lubricant| match model.trust(&Problem::new(&point, laws).unwrap()) {
        Trust::Outside(why) => why.to_string(),
        Trust::Trained => String::new(),
    };
    let (own, larger) = (spec.lubricant, equal_but(&point, 5.0, 1.0));
    let told = why(larger, own);
    assert!(told.starts_with("R = ") && told.ends_with(" mm lies outside the trained range 5…20 mm"), "{told}");
    let inlet = |inlet_temperature| Lubricant { heat: Some(Heat { inlet_temperature, ..Heat::default() }), ..own };
    assert_eq!(why(point, inlet(360.0)), "");
    let told = why(point, inlet(400.0));
    assert!(told.contains("the inlet temperature = 400 K lies outside the trained range 293…373 K"), "{told}");
    assert!(why(point, Lubricant { limiting_stress: None, ..own }).contains("limiting stresses"));
    assert!(model.domain.is_of(&inlet(360.0)));
}

#[test]
fn most_training_contacts_have_thermal_constants_of_the_range() {
    let balls = heated_ellipses(Sampling::Cubature, 90);
    let points = random_points(&balls.range, ContactKind::Point, 400, 3);
    let other = points.iter().filter(|point| balls.lubricant_of(point) != balls.lubricant).count();
    assert!((160..240).contains(&other), "every second one of a plane: {other}");
    let spec = heated_oils(Sampling::Cubature, 90);
    let points = random_points(&spec.range, ContactKind::Line, 400, 3);
    let other: Vec<Lubricant> =
        points.iter().map(|point| spec.lubricant_of(point)).filter(|own| *own != spec.lubricant).collect();
    assert!((260..340).contains(&other.len()), "three of four of a line: {}", other.len());
    assert!(other.iter().all(|lubricant| spec.domain().other_constants(lubricant).is_none()));
    let hot = other.iter().filter(|lubricant| lubricant.heat.unwrap().inlet_temperature > 333.0).count();
    assert!(hot > other.len() / 3 && hot < other.len() / 3 * 2, "they are all over the interval");
    let bare = ParameterSpace { constants: Vec::new(), ..spec.range.clone() };
    let alone = TrainingSpec { range: bare, ..spec.clone() };
    assert!(points.iter().all(|point| alone.lubricant_of(point) == spec.lubricant));
}

#[test]
fn of_a_film_hotter_than_lubricants_endure_nothing_is_promised() {
    let spec = heated_oils_bounded();
    let model = trained(&spec);
    let mut online = online(&model);
    let point = random_points(&spec.range, ContactKind::Line, 1, 12)[0];
    let warm = online.solve(&point, spec.lubricant).unwrap();
    assert!(warm.error.is_some() && !warm.is_too_hot());
    let rise = 573.0 - 313.15;
    let mut hot = warm.clone();
    let theta = &mut hot.heat.as_mut().unwrap().theta;
    theta[7][2] = (rise - 1.0) / 313.15;
    assert!(!hot.is_too_hot());
    hot.heat.as_mut().unwrap().theta[7][2] = (rise + 1.0) / 313.15;
    assert!(hot.is_too_hot());
}

#[test]
fn invalid_thermal_ranges_are_refused_with_their_field() {
    let good = heated_oils(Sampling::All, 24);
    good.check().unwrap();
    assert_eq!(good.domain().space, good.range);
    for (own, ends, field) in [
        (Quantity::SlideToRollRatio, (0.0, 2.0), "range.axes.SlideToRollRatio"),
        (Quantity::Radius, (0.2, 0.1), "range.axes.Radius"),
        (Quantity::Speed, (1.0, f64::NAN), "range.limits.Speed"),
        (Quantity::SlidingSpeed, (0.0, f64::NAN), "range.limits.SlidingSpeed"),
        (Quantity::Conductivity, (0.2, 0.1), "range.constants.Conductivity"),
        (Quantity::InletTemperature, (350.0, 360.0), "must contain the scene's own"),
        (Quantity::L, (-1.0, 2.0), "range.axes.L"),
    ] {
        let spec = TrainingSpec { range: with_ends(&good.range, own, ends), ..good.clone() };
        let sentence = spec.check().unwrap_err().to_string();
        assert!(sentence.contains(field), "{field}: {sentence}");
    }
    assert!(good.clone().heated(None).check().is_err());
    let points = random_points(&good.range, ContactKind::Line, 200, 9);
    assert_eq!(points.len(), 200);
    let (mut slowest, mut fastest) = (f64::INFINITY, 0.0f64);
    for point in &points {
        let srr = point.sliding.slide_to_roll_ratio;
        assert!((0.2..=10.0).contains(&point.speed_m_per_s) && (0.0..=0.5).contains(&srr));
        assert!(srr * point.speed_m_per_s <= 3.0);
        assert!((5e-3 * (1.0 - 1e-9)..=20e-3 * (1.0 + 1e-9)).contains(&point.radius_m));
        (slowest, fastest) = (slowest.min(point.speed_m_per_s), fastest.max(point.speed_m_per_s));
    }
    assert!(fastest > 10.0 * slowest);
}

#[test]
fn contacts_along_a_curve_equal_those_solved_alone() {
    let spec = heated_bounded();
    let model = trained(&spec);
    let mut online = online(&model);
    let point = random_points(&spec.range, ContactKind::Line, 1, 3)[0];
    let values: Vec<f64> = (0..=20).map(|k| 0.03 * f64::from(k)).collect();
    let curve: Vec<ReducedSolution> =
        traction_curve(&mut online, &point, spec.lubricant, Quantity::SlideToRollRatio, &values)
            .map(|contact| contact.solution.unwrap())
            .collect();
    for solved in [&curve[4], &curve[20]] {
        online.forget();
        let alone = online.solve(&solved.point, spec.lubricant).unwrap();
        assert!(solved.iterations < alone.iterations, "{} {}", solved.iterations, alone.iterations);
        assert!((solved.h_c / alone.h_c - 1.0).abs() < 1e-4);
        let [rise, other] = [solved, &alone].map(|solution| solution.heat.as_ref().unwrap().central);
        assert!(rise.difference(&other) < 1e-3, "{rise:?} {other:?}");
        let [own, other] = [solved, &alone].map(|solution| solution.traction.unwrap());
        assert!((own / other - 1.0).abs() < 1e-3, "{own} {other}");
    }
    assert!(curve[0].traction.unwrap().abs() < 1e-6);
    let rises: Vec<f64> = curve.iter().map(|solved| solved.heat.as_ref().unwrap().central.mid_film_k).collect();
    assert!(rises.is_sorted(), "{rises:?}");
}

#[test]
fn what_a_model_does_not_know_is_told() {
    let spec = heated_bounded();
    let model = trained(&spec);
    let point = random_points(&spec.range, ContactKind::Line, 1, 3)[0];
    let outside = |point: OperatingPoint, lubricant: Lubricant| {
        let problem = Problem::new(&point, lubricant).unwrap();
        match model.trust(&problem) {
            Trust::Outside(why) => why.to_string(),
            Trust::Trained => String::new(),
        }
    };
    let laws = spec.lubricant;
    let with = |heat: Heat| Lubricant { heat: Some(heat), ..laws };
    assert_eq!(outside(point, laws), "");
    assert!(outside(point, Lubricant { heat: None, ..laws }).contains("trained for thermal contacts"));
    assert!(outside(point, Lubricant { limiting_stress: None, ..laws }).contains("limiting stress"));
    assert!(outside(point, with(Heat { inlet_temperature: 353.15, ..Heat::default() })).contains("thermal constants"));
    let wide = Sliding { slide_to_roll_ratio: 0.9, newtonian_plateau_ratio: None };
    assert!(outside(OperatingPoint { sliding: wide, ..point }, laws).contains("SRR"));
    let mirrored = Sliding { slide_to_roll_ratio: -0.5, newtonian_plateau_ratio: None };
    assert_eq!(outside(OperatingPoint { sliding: mirrored, ..point }, laws), "");
    // At equal M and L.
    let other = 2.0;
    let larger = OperatingPoint {
        radius_m: other * point.radius_m,
        speed_m_per_s: other * point.speed_m_per_s,
        load: other * point.load,
        ..point
    };
    assert_eq!(outside(larger, laws), "R = 20 mm, but the model was trained at 10 mm only");
    let stiffer = outside(equal_but(&point, 1.0, 1.1), laws);
    assert!(stiffer.starts_with("E' = 254") && stiffer.ends_with("trained at 231 GPa only"), "{stiffer}");
    // An isothermal model refuses.
    let cold = trained(&line(Sampling::QDeim, 50));
    let refused = online(&cold).solve(&point, laws).unwrap_err();
    assert!(refused == ReducedError::Heat && refused.to_string().contains("is isothermal"));
}

#[test]
fn trainings_with_heat_are_of_ranges_with_heat() {
    let good = heated(Sampling::All, 8);
    good.check().unwrap();
    let refused = |spec: TrainingSpec| spec.check().unwrap_err().to_string();
    assert!(refused(good.clone().heated(None)).contains("varies SRR, but the lubricant is Newtonian and isothermal"));
    let box_of = TrainingSpec { range: ParameterSpace::table_3_1(), ..good.clone() };
    assert!(refused(box_of).contains("must vary or fix SlideToRollRatio for thermal contacts"));
    assert!(refused(good.clone().under(Cavitation::Complementarity)).contains("penalty"));
    let with = |range| TrainingSpec { range, ..good.clone() };
    let sliding = with_ends(&good.range, Quantity::SlideToRollRatio, (0.0, 2.0));
    assert!(refused(with(sliding)).contains("range.axes.SlideToRollRatio"));
    let mut hollow = good.range.clone();
    hollow.fixed[0] = (Quantity::Radius, -1.0);
    assert!(refused(with(hollow)).contains("range.fixed.Radius"));
    let cold = BodyHeat { conductivity: 0.0, ..BodyHeat::default() };
    let heat = Heat { bodies: [cold; 2], ..Heat::default() };
    assert!(refused(good.clone().heated(Some(heat))).contains("conductivity"));
    // A model declares the trained range.
    assert_eq!(good.domain().space, good.range);
}

#[test]
fn errors_with_heat_are_bounded_and_rises_among_them() {
    let spec = heated_bounded();
    let model = trained(&spec);
    let mut online = online(&model);
    let point = random_points(&spec.range, ContactKind::Line, 3, 21)[2];
    let solved = online.solve(&point, spec.lubricant).unwrap();
    let estimate = solved.error.unwrap();
    let truth = ContactSolver::on(&model.windows[0].grid).solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
    let [film, smallest, traction, rise] = errors(&online, &solved, &truth);
    let bounds = [(film, Some(estimate.h_c)), (smallest, Some(estimate.h_min)), (traction, estimate.traction)];
    for (error, estimated) in bounds.into_iter().chain([(rise, estimate.rise)]) {
        assert!(error < 2.0 * estimated.unwrap().bound, "{error} {estimate:?}");
    }
}
