//! Calibrated bounds on synthetic evidence: they cover new cases, follow indicators beyond the evidence, and survive
//! storage.

use super::*;
use fastrand::Rng;

/// Errors that follow e_f^I and a bump in the position, with a scatter that is larger on one side.
fn synthetic(count: usize, seed: u64) -> Vec<Evidence> {
    let mut rng = Rng::with_seed(seed);
    let mut normal = move || {
        let (a, b) = (rng.f64(), rng.f64());
        ((-2.0 * (1.0 - a).ln()).sqrt() * (2.0 * std::f64::consts::PI * b).cos(), a, b)
    };
    (0..count)
        .map(|_| {
            let ((n, a, b), (k, c, _)) = (normal(), normal());
            let place = [2.0 + 3.0 * a, 2.0 + 18.0 * b, -19.0 + c];
            let residual = -8.0 + k + (4.0 * a).sin();
            let error = residual - 2.0 + (6.0 * a).cos() * b + (0.3 + b) * n;
            let mut values = [0.0; MOST_FEATURES];
            values[..FEATURES].copy_from_slice(&[place[0], place[1], place[2], residual, -12.0]);
            Evidence {
                features: Features { values, count: FEATURES, errors: &[] },
                errors: Measured {
                    load_share: None,
                    h_c: error.exp(),
                    h_min: (error - 1.0).exp(),
                    state: (error + 1.0).exp(),
                    traction: None,
                    rise: None,
                },
            }
        })
        .collect()
}

#[test]
fn the_bound_covers_fresh_cases_and_is_not_idle() {
    let calibration = Calibration::fit(&synthetic(1000, 1)).unwrap();
    let fresh = synthetic(4000, 2);
    let mut ratios = Vec::new();
    let mut medians = 0;
    for case in &fresh {
        let estimate = calibration.estimate(&case.features);
        ratios.push(estimate.h_c.bound / case.errors.h_c);
        medians += usize::from(estimate.h_min.likely > case.errors.h_min);
    }
    let covered = ratios.iter().filter(|r| **r >= 1.0).count();
    assert!(covered >= 3960, "{covered} of 4000");
    ratios.sort_by(f64::total_cmp);
    // 2.65 standard deviations of the logarithm, 0.8 on average.
    assert!(ratios[2000] < 10.0, "{}", ratios[2000]);
    assert!((1800..2200).contains(&medians), "the likely error is the median: {medians} of 4000 below");
}

/// Errors of H_c that change their sign: normally distributed with a size that depends on the position. The standard
/// deviation of the logarithm is 1.1 everywhere.
fn signed(count: usize, seed: u64) -> Vec<Evidence> {
    let mut rng = Rng::with_seed(seed);
    let mut cases = synthetic(count, seed);
    for case in &mut cases {
        let (a, b) = (rng.f64(), rng.f64());
        let normal = (-2.0 * (1.0 - a).ln()).sqrt() * (2.0 * std::f64::consts::PI * b).cos();
        case.errors.h_c = normal.abs() * (case.features.values[0] - 12.0).exp();
    }
    cases
}

#[test]
fn errors_that_change_their_sign_do_not_loosen_the_bound() {
    let calibration = Calibration::fit(&signed(1000, 8)).unwrap();
    let ratio = |case: &Evidence| calibration.estimate(&case.features).h_c.bound / case.errors.h_c;
    let mut ratios: Vec<f64> = signed(4000, 9).iter().map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[40] >= 1.0, "the bound covers 99 %: {}", ratios[40]);
    // The best possible value is 4.3.
    assert!(ratios[2000] < 5.2, "{}", ratios[2000]);
}

#[test]
fn windows_with_little_evidence_each_learn_together() {
    // The local models differ in the size of their errors.
    let window = |k: usize, count: usize, seed: u64| -> Vec<Evidence> {
        let mut cases = signed(count, seed);
        cases.iter_mut().for_each(|case| case.errors.h_c *= [1.0, 2.0, 4.0][k % 3]);
        cases
    };
    let evidence: Vec<Vec<Evidence>> = (0..24).map(|k| window(k, if k == 7 { 10 } else { 40 }, k as u64)).collect();
    let slices: Vec<&[Evidence]> = evidence.iter().map(Vec::as_slice).collect();
    assert!(Calibration::fit(slices[0]).is_none(), "alone they would not learn");
    let together = Calibration::fit_together(&slices);
    assert!(together[7].is_none(), "what was hardly measured says nothing");
    let mut ratios = Vec::new();
    for (k, calibration) in together.iter().enumerate().filter_map(|(k, known)| Some((k, known.as_ref()?))) {
        assert_eq!(calibration.evidence(), 40);
        let ratio = |case: &Evidence| calibration.estimate(&case.features).h_c.bound / case.errors.h_c;
        ratios.extend(window(k, 100, 100 + k as u64).iter().map(ratio));
    }
    assert_eq!(ratios.len(), 2300);
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[23] >= 1.0, "the bound covers 99 %: {}", ratios[23]);
    // The best possible value is 4.3.
    assert!(ratios[1150] < 6.0, "{}", ratios[1150]);
    assert!(Calibration::fit_together(&slices[..2]).iter().all(Option::is_none), "80 are too few together");
}

#[test]
fn windows_have_error_laws_of_their_own() {
    let window = |k: usize, count: usize, seed: u64| -> Vec<Evidence> {
        let mut cases = signed(count, seed);
        let slope = if k.is_multiple_of(2) { 2.0 } else { -2.0 };
        cases.iter_mut().for_each(|case| case.errors.h_c *= (slope * (case.features.values[0] - 3.5)).exp());
        cases
    };
    let evidence: Vec<Vec<Evidence>> = (0..12).map(|k| window(k, 100, k as u64)).collect();
    let slices: Vec<&[Evidence]> = evidence.iter().map(Vec::as_slice).collect();
    let mut ratios = Vec::new();
    for (k, calibration) in Calibration::fit_together(&slices).into_iter().map(Option::unwrap).enumerate() {
        let ratio = |case: &Evidence| calibration.estimate(&case.features).h_c.bound / case.errors.h_c;
        ratios.extend(window(k, 200, 100 + k as u64).iter().map(ratio));
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[24] >= 1.0, "the bound covers 99 %: {}", ratios[24]);
    // A single law for all gives 8; the best possible value is 4.3.
    assert!(ratios[1200] < 5.5, "{}", ratios[1200]);
}

#[test]
fn larger_residuals_raise_the_bound_in_proportion() {
    let evidence = synthetic(300, 3);
    let calibration = Calibration::fit(&evidence).unwrap();
    let mut features = evidence[0].features;
    features.values[SIGNS.start] = calibration.ranges[SIGNS.start].1;
    let at_the_edge = calibration.estimate(&features).h_c.bound;
    features.values[SIGNS.start] += 3.0;
    assert!((calibration.estimate(&features).h_c.bound / at_the_edge / 3f64.exp() - 1.0).abs() < 1e-9);
}

#[test]
fn too_little_or_broken_evidence_gives_no_calibration() {
    assert!(Calibration::fit(&synthetic(LEAST_EVIDENCE - 1, 1)).is_none());
    let mut broken = synthetic(LEAST_EVIDENCE, 1);
    broken[7].errors.h_c = f64::NAN;
    assert!(Calibration::fit(&broken).is_none());
}

/// Synthetic evidence with sliding: the traction error is largest at small SRR, and some cases do not slide.
fn sliding(count: usize, seed: u64) -> Vec<Evidence> {
    let mut rng = Rng::with_seed(seed ^ 77);
    let mut cases = synthetic(count, seed);
    for case in &mut cases {
        let srr = if rng.f64() < 0.1 { 0.0 } else { rng.f64() };
        (case.features.values[5], case.features.values[6]) = (srr, rng.f64());
        (case.features.count, case.features.errors) = (FEATURES + 2, &[FurtherError::Traction]);
        case.errors.traction = (srr > 0.0).then(|| case.errors.h_c * (2.0 - 3.0 * srr + rng.f64()).exp());
    }
    cases
}

#[test]
fn traction_has_a_bound_of_its_own_where_a_model_knows_sliding() {
    let calibration = Calibration::fit(&sliding(1000, 4)).unwrap();
    assert!(calibration.sound() && calibration.evidence() == 1000);
    let fresh = sliding(4000, 5);
    let slides: Vec<&Evidence> = fresh.iter().filter(|case| case.errors.traction.is_some()).collect();
    let ratio = |case: &&Evidence| {
        let bound = calibration.estimate(&case.features).traction.unwrap().bound;
        bound / case.errors.traction.unwrap()
    };
    let mut ratios: Vec<f64> = slides.iter().map(ratio).collect();
    let covered = ratios.iter().filter(|r| **r >= 1.0).count();
    assert!(covered * 100 >= 99 * ratios.len(), "{covered} of {}", ratios.len());
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 2] < 12.0, "{}", ratios[ratios.len() / 2]);
}

#[test]
fn the_rise_has_a_bound_of_its_own_where_a_model_knows_heat() {
    let mut cases = sliding(400, 8);
    for case in &mut cases {
        case.features.errors = &[FurtherError::Traction, FurtherError::Rise];
        case.errors.rise = Some(3.0 * case.errors.h_c);
    }
    let calibration = Calibration::fit(&cases).unwrap();
    assert!(calibration.sound() && calibration.by_full_solutions());
    let estimate = calibration.estimate(&cases[7].features);
    assert!((estimate.rise.unwrap().bound / estimate.h_c.bound / 3.0 - 1.0).abs() < 0.1, "{estimate:?}");
    assert!(estimate.traction.is_some());
}

/// Contacts with shear-thinning lubricants: traction errors are a hundredth where a limiting stress acts everywhere.
fn cut(count: usize, seed: u64) -> Vec<Evidence> {
    let mut rng = Rng::with_seed(seed ^ 99);
    let mut cases = signed(count, seed);
    for case in &mut cases {
        let values = &mut case.features.values;
        (values[5], values[6], values[7], values[8]) = (rng.f64(), rng.f64(), rng.f64(), -6.0 * rng.f64());
        let size = 0.01f64.powf(1.0 + values[8] / 6.0);
        (case.features.count, case.features.errors) = (FEATURES + 4, &[FurtherError::Traction]);
        case.errors.traction = Some(size * case.errors.h_c);
    }
    cases
}

#[test]
fn bounds_of_tractions_follow_what_a_limit_cuts() {
    let blind = |mut cases: Vec<Evidence>| {
        cases.iter_mut().for_each(|case| case.features.values[8] = 0.0);
        cases
    };
    let median = |learned: &[Evidence], fresh: &[Evidence]| {
        let calibration = Calibration::fit(learned).unwrap();
        assert!(calibration.sound());
        let ratio = |case: &Evidence| {
            calibration.estimate(&case.features).traction.unwrap().bound / case.errors.traction.unwrap()
        };
        let mut ratios: Vec<f64> = fresh.iter().map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        assert!(ratios[40] >= 1.0, "the bound covers 99 %: {}", ratios[40]);
        ratios[2000]
    };
    let (learned, fresh) = (cut(1000, 8), cut(4000, 9));
    let (knowing, not) = (median(&learned, &fresh), median(&blind(learned), &blind(fresh)));
    assert!(knowing < 6.0 && not > 2.0 * knowing, "{knowing} {not}");
}

#[test]
fn a_calibration_is_its_numbers_and_missing_ones_are_noticed() {
    // Missing measurements are NaN, which equals nothing.
    let text = |calibration: &Calibration| format!("{calibration:?}");
    for evidence in [synthetic(300, 6), sliding(300, 6)] {
        let calibration = Calibration::fit(&evidence).unwrap();
        let again = Calibration::from_parts(calibration.parts()).unwrap();
        assert_eq!(text(&again), text(&calibration));
        let lies: [fn(&mut CalibrationParts); 7] = [
            |parts| {
                parts.places.pop();
            },
            |parts| {
                parts.surplus[1].pop();
            },
            |parts| {
                parts.surplus.pop();
            },
            |parts| {
                parts.laws[0].pop();
            },
            |parts| {
                parts.ranges.pop();
            },
            |parts| parts.laws[2][3] = f64::NAN,
            |parts| parts.laws.iter_mut().for_each(Vec::clear),
        ];
        for (k, lie) in lies.into_iter().enumerate() {
            let mut parts = calibration.parts();
            lie(&mut parts);
            assert!(Calibration::from_parts(parts).is_none(), "lie {k}");
        }
    }
}

#[test]
fn neighbours_are_the_nearest_in_order() {
    let mut near = Neighbours::none();
    let mut rng = Rng::with_seed(5);
    let distances: Vec<f32> = (0..300).map(|_| rng.f32()).collect();
    for (i, d) in distances.iter().enumerate() {
        near.meet(*d, i);
    }
    let mut sorted = distances.clone();
    sorted.sort_by(f32::total_cmp);
    assert!(near.nearest.iter().zip(&sorted).all(|((d, i), wanted)| d == wanted && distances[*i] == *d));
}
