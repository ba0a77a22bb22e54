//! Laws of rough surfaces against independent values, finite differences and limits.

use super::*;

const MODULUS_PA: f64 = 231e9;

fn laws() -> [AsperityLaw; 4] {
    [
        AsperityLaw::default(),
        AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.05, sigma_over_beta: 0.01, hardness: 5e9 },
        AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.035, sigma_over_beta: 0.003, hardness: 9e9 },
        AsperityLaw::Exponential { pressure: 6e9, decay: 0.4 },
    ]
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
}

#[test]
fn asperity_pressures_agree_with_independent_integrals() {
    let separations = [-2.0, 0.0, 1.0, 3.0, 4.5];
    let wanted = [
        [
            [1129969246.710905, -1064379475.9624909],
            [84380716.4405032, -147110693.9539948],
            [11024214.005905015, -25886233.7804766],
            [23382.396559770423, -90303.82461802314],
            [27.294105968707687, -140.77492076008852],
        ],
        [
            [2482087769.118993, -1239109787.8273544],
            [621069755.1295209, -614192547.428887],
            [179042456.27511072, -275457905.05833876],
            [1696865.8340167727, -5465863.322664846],
            [4353.209254513741, -20703.96286177212],
        ],
        [
            [1630640051.8234076, -633652296.7051424],
            [505303564.1242147, -450173434.0608021],
            [158611449.24159762, -233613757.56065688],
            [1407425.9438810397, -4777213.056339285],
            [2236.1516006438615, -11701.560942818953],
        ],
    ];
    for (law, wanted) in laws().into_iter().zip(wanted) {
        let table = AsperityTable::new(law, MODULUS_PA);
        for (separation, [pressure, slope]) in separations.into_iter().zip(wanted) {
            let own = law.pressure(MODULUS_PA, separation);
            close(own.0, pressure, 1e-13);
            close(own.1, slope, 1e-12);
            // Between the nodes of the table.
            let (own, tabulated) = (law.pressure(MODULUS_PA, separation + 0.003), table.pressure(separation + 0.003));
            close(tabulated.0, own.0, 1e-10);
            close(tabulated.1, own.1, 1e-7);
        }
    }
}

#[test]
fn slopes_agree_with_finite_differences() {
    let step = 1e-5;
    let agrees = |of: &dyn Fn(f64) -> (f64, f64), l: f64| {
        let difference = (of(l + step).0 - of(l - step).0) / (2.0 * step);
        let slope = of(l).1;
        assert!((slope - difference).abs() <= 1e-7 * slope.abs() + 1e-9 * of(l).0.abs(), "{slope} {difference} at {l}");
    };
    for l in [-14.3, -5.21, -1.3, 0.21, 0.55, 0.93, 1.7, 3.3, 4.7, 6.1, 13.3, 40.0, 70.0] {
        agrees(&mean_gap, l);
        for peklenik in [0.11, 1.0 / 9.0, 0.2, 1.0 / 3.0, 1.0, 1.5, 3.0, 9.0] {
            let factors = FlowFactors::new(peklenik);
            agrees(&|l| factors.pressure(l), l);
            agrees(&|l| factors.shear(l), l);
        }
        for law in laws() {
            let table = AsperityTable::new(law, MODULUS_PA);
            agrees(&|l| table.pressure(l), l);
            if l < 10.0 {
                agrees(&|l| law.pressure(MODULUS_PA, l), l);
            }
        }
    }
}

#[test]
fn flow_factors_and_gap_agree_with_independent_values() {
    for (l, isotropic, across, along, gap, shear) in [
        (
            -1.0,
            8.263862652046561e-07,
            5.596641498966325e-07,
            0.00014527375136755836,
            0.08331547058768629,
            0.11997680997080729,
        ),
        (0.25, 0.006622391240582467, 0.002155254353131439, 0.06109840879091772, 0.5363446982235802, 0.4686229374956862),
        (2.0, 5.650785478714116, 3.924652658829488, 8.636396103067893, 2.0084907026168297, 0.7265933356364209),
        (4.5, 84.52630650145397, 74.88062607534714, 93.27283684785414, 4.500000694212045, 0.36342703930719567),
    ] {
        for (peklenik, wanted) in [(1.0, isotropic), (1.0 / 3.0, across), (3.0, along)] {
            close(FlowFactors::new(peklenik).pressure(l).0, wanted, 1e-13);
        }
        close(mean_gap(l).0, gap, 1e-13);
        close(FlowFactors::new(1.0).shear(l).0, shear, 1e-13);
    }
    for peklenik in [1.0 / 9.0, 0.5, 1.0, 9.0] {
        let factors = FlowFactors::new(peklenik);
        close(factors.pressure(100.0).0, 1e6, 1e-14);
        assert!(factors.shear(100.0).0 < 1e-9);
        // Both branches of the shear flow factor meet at l = 5.
        close(factors.shear(5.0 - 1e-9).0, factors.shear(5.0 + 1e-9).0, 2e-3);
    }
    // Between tabulated numbers the factors lie between theirs.
    let [low, middle, high] = [1.0, 1.7, 3.0].map(|peklenik| FlowFactors::new(peklenik).pressure(1.0).0);
    assert!(low < middle && middle < high);
}

#[test]
fn the_mean_gap_is_positive_and_continuous_for_every_separation() {
    for k in -300..300 {
        let l = 0.05 * f64::from(k);
        let (gap, slope) = mean_gap(l);
        assert!(gap > 0.0 && slope > 0.0 && slope <= 1.0 && gap >= l * (1.0 - 1e-14), "{l}: {gap} {slope}");
    }
    for l in [-3.5, 9.0] {
        close(mean_gap(l - 1e-12).0, mean_gap(l + 1e-12).0, 1e-9);
    }
}

#[test]
fn a_separation_is_found_by_its_pressure() {
    for law in laws() {
        let table = AsperityTable::new(law, MODULUS_PA);
        for pressure in [1e5, 1e7, 5e8] {
            close(table.pressure(table.separation_at(pressure)).0, pressure, 1e-9);
        }
    }
}

#[test]
fn a_rounded_peklenik_number_is_accepted() {
    for peklenik in [0.1111, 1.0 / 9.0, 9.0] {
        assert_eq!(Roughness { peklenik, ..Roughness::new(1e-7) }.check(), Ok(()));
    }
    let refused = Roughness { peklenik: 0.11, ..Roughness::new(1e-7) }.check().unwrap_err();
    assert!(
        refused.constant == SurfaceConstant::Peklenik && refused.to_string().contains("between 0.111"),
        "{refused}"
    );
}

#[test]
fn real_contact_area_is_that_of_its_summits() {
    // Elastic summits of Greenwood and Tripp: π²(ηβσ)² ∫ (s − l)² φ(s) ds by Simpson's rule.
    let AsperityLaw::GreenwoodTripp { eta_beta_sigma, .. } = AsperityLaw::default() else { panic!() };
    let density = |s: f64| (-0.5 * s * s).exp() / (2.0 * std::f64::consts::PI).sqrt();
    for l in [-3.0, -1.0, 0.0, 1.0, 2.5] {
        let (n, step) = (4000, 12.0 / 4000.0);
        let weight = |k: i32| {
            if k == 0 || k == n {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        let integral: f64 = (0..=n)
            .map(|k| (weight(k), step * f64::from(k)))
            .map(|(weight, w)| step / 3.0 * weight * w * w * density(l + w))
            .sum();
        let wanted = (std::f64::consts::PI * eta_beta_sigma).powi(2) * integral;
        close(AsperityLaw::default().contact_area(MODULUS_PA, l).unwrap(), wanted, 1e-9);
    }
    // Fully plastic summits carry their hardness; elastic ones a mean pressure far below it.
    let law = |hardness| AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.05, sigma_over_beta: 0.01, hardness };
    let mean = |hardness: f64, l: f64| {
        let law = law(hardness);
        law.pressure(MODULUS_PA, l).0 / law.contact_area(MODULUS_PA, l).unwrap()
    };
    close(mean(1e7, 0.0), 1e7, 1e-3);
    // Elastic summits: a load of (4/3)E*√β w^1.5 on an area of πβw; the ratio of both means is that of Gaussian moments.
    let l = 0.3;
    let law = law(1e12);
    let (n, step) = (200_000, 10.0 / 200_000.0);
    let distance = l - 0.045944 / 0.05;
    let spread = 1.0 - 3.717e-4 / 0.05f64.powi(2);
    let moment = |power: f64| -> f64 {
        let of = |w: f64| w.powf(power) * (-0.5 * (distance + w).powi(2) / spread).exp();
        (0..n).map(|k| step * of(step * (f64::from(k) + 0.5))).sum()
    };
    let wanted = 4.0 / 3.0 * 0.5 * MODULUS_PA * 0.1 * moment(1.5) / (std::f64::consts::PI * moment(1.0));
    close(law.pressure(MODULUS_PA, l).0 / law.contact_area(MODULUS_PA, l).unwrap(), wanted, 1e-5);
    assert_eq!(AsperityLaw::Exponential { pressure: 1e9, decay: 0.5 }.contact_area(MODULUS_PA, 0.0), None);
}

#[test]
fn the_separation_of_a_gap_is_the_inverse_of_the_gap() {
    for k in -60..=60 {
        let l = 0.2 * f64::from(k);
        let again = separation_of_gap(mean_gap(l).0);
        assert!((again - l).abs() < 1e-10 * (1.0 + l.abs()), "{l}: {again}");
    }
}
