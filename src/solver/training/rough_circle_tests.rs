//! Tests of models of rough circular contacts: agreement with full solutions in film thickness and asperity load share,
//! error bounds, and contacts that they do not cover.

use super::rough_tests::errors;
use super::small::{rough_circles, rough_oils_of_points, trained};
use super::*;
use crate::solver::full::{ContactSolver, Problem, Start};
use crate::solver::parameters::{Axis, Quantity, REFERENCE_ROUGHNESS_M};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant};
use crate::solver::physics::surfaces::Roughness;
use crate::solver::reduced::{Online, ReducedOptions, Sampling, Trust};
use std::sync::Arc;

#[test]
fn reduced_rough_circles_are_the_full_ones() {
    for (sampling, limits) in [(Sampling::All, [2e-3, 5e-4]), (Sampling::Cubature, [4e-3, 1e-3])] {
        let spec = rough_circles(sampling);
        spec.check().unwrap();
        let model = trained(&spec);
        let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
        let mut full = ContactSolver::on(&model.windows[0].grid);
        for point in random_points(&spec.range, spec.contact(), 12, 77) {
            online.forget();
            let solved = online.solve(&point, spec.lubricant).unwrap();
            assert_eq!(solved.trust, Trust::Trained);
            let truth = full.solve(&point, spec.lubricant, Start::Cold, &()).unwrap();
            let found = errors(&online.reconstruct(&solved).unwrap(), &truth);
            assert!(found[0] < limits[0] && found[1] < limits[1], "{sampling:?}: {found:?} at {:?}", point.moes());
        }
    }
}

#[test]
fn rough_circles_with_ridges_and_ellipses_are_outside() {
    let spec = rough_circles(Sampling::All);
    let domain = spec.domain();
    let here = random_points(&spec.range, spec.contact(), 1, 5)[0];
    let trust = |point: &OperatingPoint, lubricant| match domain.trust(&Problem::new(point, lubricant).unwrap()) {
        Trust::Outside(why) => why.to_string(),
        Trust::Trained => String::new(),
    };
    let with = |roughness: Roughness| Lubricant { roughness: Some(roughness), ..spec.lubricant };
    let usual = Roughness::new(REFERENCE_ROUGHNESS_M);
    assert_eq!(trust(&here, with(usual)), "");
    assert_eq!(
        trust(&here, with(Roughness { peklenik: 0.5, ..usual })),
        "the Peklenik number 0.50 is not that of the training, 1.00"
    );
    assert_eq!(
        trust(&Quantity::RadiusRatio.at(&here, 2.0), with(usual)),
        "the model was trained for circular contacts only"
    );
    let lower = Quantity::M.at(&here, 26.0);
    let rough = Quantity::SmoothFilmRatio.at(&lower, 0.51);
    let number = Quantity::RoughnessNumber.of(&rough).unwrap();
    assert!(number > 0.5 && trust(&rough, with(usual)).starts_with("S = σR/a²"), "{}", trust(&rough, with(usual)));
}

#[test]
fn trainings_of_rough_ellipses_and_ridges_are_refused() {
    let refused = |change: &dyn Fn(&mut TrainingSpec)| {
        let mut spec = rough_circles(Sampling::All);
        change(&mut spec);
        spec.check().unwrap_err().to_string()
    };
    let ellipses = refused(&|spec| spec.range.axes.push(Axis::new(Quantity::RadiusRatio, (0.5, 2.0))));
    assert!(ellipses.starts_with("`cavitation` must be the penalty"), "{ellipses}");
    let ridges = refused(&|spec| {
        let roughness = Roughness { peklenik: 3.0, ..Roughness::new(REFERENCE_ROUGHNESS_M) };
        spec.lubricant.roughness = Some(roughness);
    });
    assert!(ridges.starts_with("`roughness.peklenik` must be 1"), "{ridges}");
    let automatic = refused(&|spec| spec.windows = Windows::Automatic { modes: 60 });
    assert!(automatic.starts_with("`windows` must be"), "{automatic}");
}

#[test]
fn errors_of_rough_circles_are_bounded_and_local_models_blend() {
    let spec = rough_oils_of_points();
    spec.check().unwrap();
    let model = trained(&spec);
    assert!(model.windows.iter().all(|window| window.anchor.is_some() && window.pressure.combined().is_some()));
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let limit = LimitingStress { ambient: 0.0, slope: 0.06, eyring: Some(4e6) };
    let lubricant = Lubricant { limiting_stress: Some(limit), ..spec.lubricant };
    let (mut held, mut blends, count) = ([0; 3], 0, 60);
    for (k, mut point) in random_points(&spec.range, spec.contact(), count, 41).into_iter().enumerate() {
        point.sliding.slide_to_roll_ratio = [0.01, 0.1, 1.0][k % 3];
        let solved = online.solve(&point, lubricant).unwrap();
        let own = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, lubricant, Start::Cold, &()).unwrap();
        let estimate = solved.error.unwrap();
        let whole = estimate.with_boundary_friction(&own.mixed().unwrap(), 0.12);
        let [film, share] = errors(&own, &truth);
        assert!(film < 5e-2 && share < 2e-2, "{film} {share} at {:?}", point.moes());
        let friction = (own.traction_coefficient() / truth.traction_coefficient() - 1.0).abs();
        let bounds = [estimate.h_c, estimate.load_share.unwrap(), whole.traction.unwrap()];
        for ((error, bound), held) in [film, share, friction].into_iter().zip(bounds).zip(&mut held) {
            *held += usize::from(error <= bound.bound);
        }
        blends += usize::from(!solved.beside.is_empty());
    }
    assert!(held.iter().all(|held| *held >= count - 3) && blends > 0, "{held:?} of {count}, {blends} blends");
}
