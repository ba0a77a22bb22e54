//! Tests of models of rough line contacts: agreement with full solutions in film thickness and asperity load share, for
//! other roughnesses and asperity laws than those of the training as well.

use super::small::{rough, rough_bounded, trained};
use super::*;
use crate::solver::full::{ContactSolver, Problem, Solution, Start};
use crate::solver::parameters::{Quantity, REFERENCE_ROUGHNESS_M, enlarged};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant};
use crate::solver::physics::surfaces::{AsperityLaw, Roughness};
use crate::solver::reduced::{Online, ReducedError, ReducedOptions, Sampling, Trust};
use std::sync::Arc;

/// Returns the errors of H_c, relative to its size or to half the roughness, and of the asperity load share.
pub(super) fn errors(own: &Solution, truth: &Solution) -> [f64; 2] {
    let sigma = truth.problem.rough.unwrap().sigma;
    let share = |solution: &Solution| solution.mixed().unwrap().asperity_load_share;
    let film = (own.scalars.h_c - truth.scalars.h_c).abs() / truth.scalars.h_c.abs().max(0.5 * sigma);
    [film, (share(own) - share(truth)).abs()]
}

#[test]
fn reduced_rough_contacts_are_the_full_ones() {
    for (sampling, limits) in [(Sampling::All, [1e-3, 2e-4]), (Sampling::Cubature, [2e-3, 5e-4])] {
        let spec = rough(sampling);
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
fn a_contact_of_another_roughness_and_law_is_covered() {
    let spec = rough(Sampling::All);
    let model = trained(&spec);
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let here = random_points(&spec.range, spec.contact(), 1, 5)[0];
    let of_reference = online.solve(&here, spec.lubricant).unwrap();
    // The same dimensionless contact, four times as large and as rough.
    let large = enlarged(&here, 4.0);
    let on = |roughness: Roughness| Lubricant { roughness: Some(roughness), ..spec.lubricant };
    let lubricant = on(Roughness::new(4.0 * REFERENCE_ROUGHNESS_M));
    let solved = online.solve(&large, lubricant).unwrap();
    assert_eq!(solved.trust, Trust::Trained);
    assert!((solved.h_c / of_reference.h_c - 1.0).abs() < 1e-7);
    // A somewhat stiffer law, and ridges across the flow.
    let stiffer = AsperityLaw::GreenwoodTripp { eta_beta_sigma: 0.053, sigma_over_beta: 0.01 };
    let other = on(Roughness { asperities: stiffer, peklenik: 0.5, ..Roughness::new(REFERENCE_ROUGHNESS_M) });
    let solved = online.solve(&here, other).unwrap();
    assert_eq!(solved.trust, Trust::Trained);
    let truth = full.solve(&here, other, Start::Cold, &()).unwrap();
    let found = errors(&online.reconstruct(&solved).unwrap(), &truth);
    assert!(found[0] < 5e-3 && found[1] < 1e-3, "{found:?}");
}

#[test]
fn a_model_of_rough_surfaces_refuses_smooth_ones_and_other_film_ratios_are_outside() {
    let spec = rough(Sampling::All);
    let model = trained(&spec);
    let here = random_points(&spec.range, spec.contact(), 1, 5)[0];
    let smooth = Lubricant { roughness: None, ..spec.lubricant };
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    assert!(matches!(online.solve(&here, smooth), Err(ReducedError::Roughness { rough: false })));
    let trust = |point: &OperatingPoint, lubricant| match model.trust(&Problem::new(point, lubricant).unwrap()) {
        Trust::Outside(why) => why.to_string(),
        Trust::Trained => String::new(),
    };
    assert_eq!(trust(&here, spec.lubricant), "");
    assert_eq!(trust(&here, smooth), "the model was trained for rough surfaces");
    let with = |roughness: Roughness| Lubricant { roughness: Some(roughness), ..spec.lubricant };
    let usual = Roughness::new(REFERENCE_ROUGHNESS_M);
    let hard = AsperityLaw::GreenwoodTripp { eta_beta_sigma: 0.1, sigma_over_beta: 0.01 };
    let stiffer = AsperityLaw::GreenwoodTripp { eta_beta_sigma: 0.053, sigma_over_beta: 0.01 };
    assert_eq!(trust(&here, with(Roughness { asperities: stiffer, ..usual })), "");
    assert_eq!(
        trust(&here, with(Roughness { asperities: hard, ..usual })),
        "asperities carry 4.00 times the pressure of those of the training (0.5…1.2)"
    );
    assert!(trust(&here, with(Roughness { peklenik: 6.0, ..usual })).starts_with("the Peklenik number 6.00 lies"));
    let mut sliding = here;
    sliding.sliding.slide_to_roll_ratio = -1.0;
    let sheared = with(Roughness { shear_flow: 0.5, ..usual });
    assert_eq!(trust(&here, sheared), "");
    assert!(trust(&sliding, sheared).starts_with("the shear flow ½ |SRR (σ₁² − σ₂²)|/σ² = 0.25 exceeds"));
    let thick = Quantity::SmoothFilmRatio.at(&here, 8.0);
    assert!(
        trust(&thick, spec.lubricant).starts_with("λ of the smooth film = 8 lies"),
        "{}",
        trust(&thick, spec.lubricant)
    );
}

#[test]
fn errors_of_film_load_share_and_friction_are_bounded() {
    let spec = rough_bounded();
    let model = trained(&spec);
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    let mut full = ContactSolver::on(&model.windows[0].grid);
    let limit = LimitingStress { ambient: 0.0, slope: 0.06, eyring: Some(4e6) };
    let lubricant = Lubricant { limiting_stress: Some(limit), ..spec.lubricant };
    let points = random_points(&spec.range, spec.contact(), 60, 41);
    let mut held = [0; 3];
    for (k, mut point) in points.iter().copied().enumerate() {
        point.sliding.slide_to_roll_ratio = [0.01, 0.1, 1.0][k % 3];
        let solved = online.solve(&point, lubricant).unwrap();
        let own = online.reconstruct(&solved).unwrap();
        let truth = full.solve(&point, lubricant, Start::Cold, &()).unwrap();
        let (mixed, true_one) = (own.mixed().unwrap(), truth.mixed().unwrap());
        let estimate = solved.error.unwrap();
        // The boundary friction coefficient is 0.12.
        let whole = estimate.with_boundary_friction(&mixed, 0.12);
        let [film, share] = errors(&own, &truth);
        let friction = (own.traction_coefficient() / truth.traction_coefficient() - 1.0).abs();
        let bounds = [estimate.h_c, estimate.load_share.unwrap(), whole.traction.unwrap()];
        for ((error, bound), held) in [film, share, friction].into_iter().zip(bounds).zip(&mut held) {
            *held += usize::from(error <= bound.bound);
        }
        assert!(true_one.asperity_load_share > 0.0);
    }
    assert!(held.iter().all(|held| *held >= 57), "{held:?} of 60");
    // Without a limiting stress friction is no evidence.
    let mut sliding = points[0];
    sliding.sliding.slide_to_roll_ratio = 0.1;
    assert_eq!(online.solve(&sliding, spec.lubricant).unwrap().error.unwrap().traction, None);
}
