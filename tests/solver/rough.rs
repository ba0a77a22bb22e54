//! Contacts with rough surfaces against an independent solution on the same grid, published fits and limits.

use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::{ContactSolver, Problem, Solution, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, FilmFormula, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Heat, LimitingStress, Lubricant, ShearLaw, Sliding};
use ehl_explorer::solver::physics::surfaces::{AsperityLaw, Roughness};

const LINE: GridSpec = GridSpec::Uniform { dx: 0.005, domain: (-4.0, 2.0) };
const PLANE: GridSpec = GridSpec::Plane(PointGridSpec::uniform(0.04, 0.05, (-4.0, 2.0, -2.0)));

const fn gt(eta_beta_sigma: f64, sigma_over_beta: f64) -> AsperityLaw {
    AsperityLaw::GreenwoodTripp { eta_beta_sigma, sigma_over_beta }
}

const fn zmc(n_beta_sigma: f64, sigma_over_beta: f64, hardness: f64) -> AsperityLaw {
    AsperityLaw::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness }
}

fn point(kind: ContactKind, [radius, speed, load, modulus, viscosity, alpha, srr]: [f64; 7]) -> OperatingPoint {
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
    OperatingPoint::from_quantities(kind, [radius, speed, load, modulus, viscosity, alpha], sliding)
}

fn rough(sigma: f64, asperities: AsperityLaw) -> Roughness {
    Roughness { asperities, ..Roughness::new(sigma) }
}

fn solved(solver: &mut ContactSolver, point: &OperatingPoint, lubricant: Lubricant, start: Start<'_>) -> Solution {
    let solution = solver.solve(point, lubricant, start, &()).unwrap();
    assert!(solution.converged(), "{:?}: {:?}", point.moes(), solution.report.termination);
    solution
}

/// Contact of an independent solution, and its results.
struct Reference {
    /// R, u_m, w, E′, η₀, α, SRR.
    contact: [f64; 7],
    roughness: Roughness,
    /// H_c, H_min, P_c, P_a at the centre, load share of asperities, friction coefficient.
    wanted: [f64; 6],
}

fn agrees(spec: GridSpec, references: &[Reference]) {
    let limited = Lubricant {
        limiting_stress: Some(LimitingStress { ambient: 0.0, slope: 0.08, eyring: Some(5e6) }),
        ..Lubricant::default()
    };
    let mut solver = ContactSolver::on(&spec.build().unwrap());
    for Reference { contact, roughness, wanted } in references {
        let point = point(spec.kind(), *contact);
        let solution = solved(&mut solver, &point, limited.on_rough_surfaces(Some(*roughness)), Start::Cold);
        let (scalars, mixed) = (solution.scalars, solution.mixed().unwrap());
        let [h_c, h_min, p_c, p_a_c, share, friction] = *wanted;
        let half = 0.5 * roughness.sigma / point.film_scale_m();
        for (name, got, wanted, within) in [
            ("H_c", scalars.h_c, h_c, 1e-7 * h_c.abs().max(half)),
            ("H_min", scalars.h_min, h_min, 1e-7 * h_min.abs().max(half)),
            ("P_c", scalars.p_c, p_c, 1e-7),
            ("P_a", mixed.p_a_c, p_a_c, 1e-7),
            ("share", mixed.asperity_load_share, share, 1e-6),
            ("friction", solution.traction_coefficient(), friction, 1e-6),
        ] {
            assert!((got - wanted).abs() < within, "{roughness:?}: {name} is {got}, but {wanted} was wanted");
        }
        let parts = mixed.fluid_traction + mixed.boundary_traction;
        assert!((parts - friction).abs() < 1e-6 && mixed.mean_gap_c > 0.0);
    }
}

#[test]
fn lines_agree_with_an_independent_solution() {
    agrees(
        LINE,
        &[
            Reference {
                contact: [0.0225, 5.0365, 646_110.0, 287.8e9, 0.004, 22e-9, 0.1],
                roughness: rough(1e-6, zmc(0.05, 0.01, 5e9)),
                wanted: [
                    0.061594967998836236,
                    0.06159460208511086,
                    0.9556537447602876,
                    0.4433460928843531,
                    0.5976058027756493,
                    0.08891086212720452,
                ],
            },
            Reference {
                contact: [0.01, 2.5, 2e5, 220e9, 0.01, 1.78e-8, 0.4],
                roughness: Roughness { shear_flow: 0.5, ..rough(5e-7, gt(0.05, 0.01)) },
                wanted: [
                    0.09660916677798737,
                    0.09660871937266646,
                    0.9806475028863001,
                    0.04163194032237075,
                    0.05894053963979059,
                    0.03718297375248687,
                ],
            },
            Reference {
                contact: [0.01, 1.0, 4e5, 220e9, 0.02, 1.5e-8, 0.05],
                roughness: rough(2.5e-7, AsperityLaw::Exponential { pressure: 6e9, decay: 0.4 }),
                wanted: [
                    0.046679519611602105,
                    0.04613201212121487,
                    0.9865464265372688,
                    0.5839605386905072,
                    0.6754007528542165,
                    0.08133683931465678,
                ],
            },
            // Nearly dry: the mean planes have passed each other.
            Reference {
                contact: [0.005, 0.001, 3e5, 231e9, 0.01, 1.8e-8, 1.0],
                roughness: rough(3e-7, zmc(0.05, 0.01, 4e9)),
                wanted: [
                    -0.05817883506724775,
                    -0.060087150955216495,
                    0.9508822406681916,
                    0.7284850367234654,
                    0.8831837328571815,
                    0.10598924615118771,
                ],
            },
        ],
    );
}

#[test]
fn circles_agree_with_an_independent_solution() {
    agrees(
        PLANE,
        &[
            Reference {
                contact: [0.0034, 0.14718, 4.069, 231e9, 0.04, 22e-9, 0.1],
                roughness: rough(5.1301327816107634e-8, zmc(0.05, 0.01, 5e9)),
                wanted: [
                    0.09331567821208187,
                    0.06331141247925565,
                    0.9962301609468008,
                    0.1648900626662815,
                    0.3022391818387255,
                    0.059735203784987825,
                ],
            },
            Reference {
                contact: [0.01, 0.02, 30.0, 231e9, 0.02, 1.8e-8, 0.5],
                roughness: rough(1.5e-7, zmc(0.04, 0.005, 7e9)),
                wanted: [
                    0.00695632423890491,
                    0.0014093994499854157,
                    0.9494361440602154,
                    0.5677276373417869,
                    0.8318396228920467,
                    0.09992711669475968,
                ],
            },
        ],
    );
}

#[test]
fn vanishing_roughness_gives_the_smooth_contact() {
    let laws = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let point = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let smooth = solved(&mut solver, &point, laws, Start::Cold);
    let film = smooth.scalars.h_c * point.film_scale_m();
    let fine = solved(&mut solver, &point, laws.on_rough_surfaces(Some(Roughness::new(1e-3 * film))), Start::Cold);
    let moved = smooth.pressure.iter().zip(&fine.pressure).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved < 1e-12, "{moved:e}");
    let none = Problem::new(&point, laws.on_rough_surfaces(Some(Roughness::new(0.0)))).unwrap();
    assert!(none.rough.is_none() && none.lubricant.cavitation == Cavitation::Complementarity);
    assert!(smooth.mixed().is_none() && smooth.asperity_pressure.is_empty());
}

/// Sliding line and ball whose asperities carry a part of the load, with their grids.
fn sliding_contacts() -> [(GridSpec, OperatingPoint, Roughness); 2] {
    [(ContactKind::Line, 1.5), (ContactKind::Point, 2.0)].map(|(kind, share)| {
        let mut point = si_from_moes(&MoesRequest::new(kind, 30.0, 8.0)).unwrap();
        point.sliding.slide_to_roll_ratio = 0.4;
        let spec = if kind == ContactKind::Line { LINE } else { PLANE };
        (spec, point, Roughness::new(share * point.formula_film_m()))
    })
}

#[test]
fn shear_thinning_films_between_rough_surfaces_have_their_limits() {
    let carreau = |critical_stress: f64| ShearLaw::Carreau { critical_stress, beta: 2.198, n: 0.6, npr: 0.1 };
    for (spec, point, roughness) in sliding_contacts() {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let mut with = |shear: ShearLaw, roughness: Option<Roughness>| {
            let cavitation = Cavitation::Complementarity;
            let laws = Lubricant { shear, cavitation, ..Lubricant::default() }.on_rough_surfaces(roughness);
            solved(&mut solver, &point, laws, Start::Cold)
        };
        let thinned = with(carreau(5e6), Some(roughness));
        assert!(thinned.report.newton_iterations < 40, "{}", thinned.report.newton_iterations);
        let newtonian = with(ShearLaw::Newtonian, Some(roughness));
        let (share, before) = (thinned.asperity_load_share(), newtonian.asperity_load_share());
        assert!(thinned.scalars.h_c < newtonian.scalars.h_c && share > before, "{share} {before}");
        assert!(thinned.fluid_traction() < 0.9 * newtonian.fluid_traction());
        // A critical stress that the film never reaches.
        let unreached = with(carreau(1e12), Some(roughness));
        let off = unreached.scalars.h_c / newtonian.scalars.h_c - 1.0;
        assert!(off.abs() < 1e-6, "{off:e}");
        // Vanishing roughness.
        let smooth = with(carreau(5e6), None);
        let fine = with(carreau(5e6), Some(Roughness::new(1e-3 * point.formula_film_m())));
        let off = fine.scalars.h_c / smooth.scalars.h_c - 1.0;
        assert!(off.abs() < 1e-5, "{off:e}");
    }
}

#[test]
fn friction_of_asperities_heats_the_surfaces_of_mixed_contacts() {
    for (spec, point, roughness) in sliding_contacts() {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let mut with = |boundary_friction: f64| {
            let laws = Roughness { boundary_friction, ..roughness };
            let heat = Some(Heat::default());
            let laws = Lubricant { heat, ..Lubricant::default() }.on_rough_surfaces(Some(laws));
            solved(&mut solver, &point, laws, Start::Cold)
        };
        let (rubbing, sliding) = (with(0.12), with(0.0));
        let heat = |solution: &Solution| solution.heat.clone().unwrap();
        let [more, less] = [heat(&rubbing), heat(&sliding)];
        assert!(more.balance.residual().abs() < 0.01, "{:?}", more.balance);
        assert!(more.largest.surfaces_k[0] > less.largest.surfaces_k[0], "{:?} {:?}", more.largest, less.largest);
        assert!(
            rubbing.scalars.h_c < sliding.scalars.h_c && rubbing.asperity_load_share() > sliding.asperity_load_share()
        );
    }
}

/// Blok's flash temperature with the pressure of the asperities of a nearly dry contact: half of the friction heats
/// each of two equal bodies, ΔT(x) = ∫ q(s)/√(x − s) ds/(e √(π u)) with the effusivity e.
#[test]
fn a_nearly_dry_contact_has_bloks_flash_temperature() {
    let point = point(ContactKind::Line, [0.01, 1e-3, 2e5, 231e9, 1e-3, 1.5e-8, 0.02]);
    let roughness = Roughness::new(1e-6);
    let laws = Lubricant { heat: Some(Heat::default()), ..Lubricant::default() }.on_rough_surfaces(Some(roughness));
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let solution = solved(&mut solver, &point, laws, Start::Cold);
    assert!(solution.asperity_load_share() > 0.9, "{}", solution.asperity_load_share());
    let hertz = point.hertz();
    let x: Vec<f64> = solution.profile().map(|(x, ..)| x * hertz.half_width_m).collect();
    let flux: Vec<f64> = solution
        .asperity_pressures()
        .map(|carried| 0.5 * roughness.boundary_friction * carried * hertz.pressure_pa * 0.02 * point.speed_m_per_s)
        .collect();
    let steel = laws.heat.unwrap().bodies[0];
    let effusivity = (steel.density * steel.heat_capacity * steel.conductivity).sqrt();
    // With s = x − r² the kernel is regular.
    let at = |x_s: f64| {
        let next = x.partition_point(|x| *x < x_s).clamp(1, x.len() - 1);
        let t = (x_s - x[next - 1]) / (x[next] - x[next - 1]);
        (1.0 - t) * flux[next - 1] + t * flux[next]
    };
    let rise = |end: f64| {
        let root = (end - x[0]).sqrt();
        let cells = 4000;
        let sum: f64 =
            (0..cells).map(|k| 2.0 * at(end - (root * (f64::from(k) + 0.5) / f64::from(cells)).powi(2))).sum();
        sum * root / f64::from(cells) / (effusivity * (std::f64::consts::PI * point.speed_m_per_s).sqrt())
    };
    let blok = x.iter().skip(1).step_by(20).map(|x| rise(*x)).fold(0.0, f64::max);
    let seen = solution.heat.as_ref().unwrap().largest.surfaces_k;
    assert!(blok > 0.01 && seen.iter().all(|seen| (seen / blok - 1.0).abs() < 0.05), "{seen:?} {blok}");
}

#[test]
fn the_rougher_surface_carries_more_lubricant_if_faster() {
    let mut solver = ContactSolver::on(&GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }.build().unwrap());
    let mut with = |srr: f64, shear_flow: f64| {
        let mut point = si_from_moes(&MoesRequest::new(ContactKind::Line, 30.0, 6.0)).unwrap();
        point.sliding.slide_to_roll_ratio = srr;
        let roughness = Roughness { shear_flow, ..Roughness::new(2e-7) };
        let solution =
            solved(&mut solver, &point, Lubricant::default().on_rough_surfaces(Some(roughness)), Start::Cold);
        (solution.scalars.h_c, solution.traction_coefficient())
    };
    let (equal, faster, slower, exchanged) = (with(0.6, 0.0), with(0.6, 0.8), with(0.6, -0.8), with(-0.6, -0.8));
    assert!(slower.0 < equal.0 && equal.0 < faster.0);
    assert!((exchanged.0 - faster.0).abs() < 1e-12 && (exchanged.1 + faster.1).abs() < 1e-12);
    assert!(faster.1 > 0.0 && with(0.0, 0.8).1 == 0.0);
}

#[test]
fn film_and_load_share_converge_with_second_order() {
    let point = point(ContactKind::Line, [0.0225, 5.0365, 646_110.0, 287.8e9, 0.004, 22e-9, 0.0]);
    let lubricant = Lubricant::default().on_rough_surfaces(Some(rough(5e-7, gt(0.05, 0.01))));
    let at = |dx: f64| {
        let mut solver = ContactSolver::on(&GridSpec::Uniform { dx, domain: (-4.0, 2.0) }.build().unwrap());
        let solution = solved(&mut solver, &point, lubricant, Start::Cold);
        [solution.scalars.h_c, solution.asperity_load_share()]
    };
    let [coarse, middle, fine] = [0.01, 0.005, 0.0025].map(at);
    for k in 0..2 {
        let order = ((coarse[k] - middle[k]) / (middle[k] - fine[k])).log2();
        assert!((1.8..2.3).contains(&order), "order {order} of value {k}");
    }
}

/// Central pressure over the Hertzian one of a dry rough line contact: Gelinck & Schipper, J. Tribol. 121 (1999) 449,
/// with n̄ = nR√(Rβ), σ̄ = σ/R and W = w/(E′R).
fn gelinck_schipper(n: f64, sigma: f64, w: f64) -> f64 {
    let ratio = 1.558 * n.powf(0.0337) * sigma.powf(-0.442) * w.powf(0.4757);
    (1.0 + ratio.powf(-1.7)).powf(-1.0 / 1.7)
}

#[test]
fn a_slow_contact_is_the_dry_rough_one() {
    let (radius, load, modulus) = (0.01, 2e5, 231e9);
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 4.0) };
    let mut solver = ContactSolver::on(&spec.build().unwrap());
    let mut at = |speed: f64, sigma: f64| {
        let point = point(ContactKind::Line, [radius, speed, load, modulus, 0.01, 1e-8, 0.0]);
        solved(&mut solver, &point, Lubricant::default().on_rough_surfaces(Some(Roughness::new(sigma))), Start::Cold)
    };
    for (sigma, within) in [(1e-7, 0.01), (3e-7, 0.005), (1e-6, 0.042)] {
        let dry = at(1e-9, sigma);
        let (beta, eta_beta_sigma) = (sigma / 0.01, 0.05);
        let density = eta_beta_sigma / (beta * sigma) * radius * (radius * beta).sqrt();
        let published = gelinck_schipper(density, sigma / radius, load / (modulus * radius));
        let off = dry.scalars.p_c / published - 1.0;
        assert!(off.abs() < within && dry.asperity_load_share() > 0.999, "{sigma}: {off}");
    }
    // The distance from the dry contact is linear in the speed.
    let [dry, slow, faster] = [1e-9, 1e-7, 2e-7].map(|speed| at(speed, 3e-7).pressure);
    let distance = |fields: &[f64]| fields.iter().zip(&dry).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let ratio = distance(&faster) / distance(&slow);
    assert!((1.9..2.1).contains(&ratio), "{ratio}");
}

/// Masjedi & Khonsari, J. Tribol. 134 (2012) 011503: film thickness relative to the smooth contact, minimum film
/// thickness likewise, and load share of asperities in per cent, of a line contact with the elastic–plastic law.
fn masjedi_khonsari(sigma: f64, v: f64, [w, u, g]: [f64; 3]) -> [f64; 3] {
    let rise = |factor: f64, [s, hardness, load, speed, piezo]: [f64; 5]| {
        factor * sigma.powf(s) * v.powf(hardness) * w.powf(load) * u.powf(speed) * g.powf(piezo)
    };
    let share = 4470.0 * sigma.powf(6.015) * v.powf(1.168) * w.powf(0.485) * u.powf(-3.741) * g.powf(-2.898);
    [
        1.0 + rise(0.2, [1.222, 0.223, -0.229, -0.748, -0.842]),
        1.0 + rise(0.026, [1.120, 0.185, -0.312, -0.809, -0.977]),
        0.005 * w.powf(-0.408) * u.powf(-0.088) * g.powf(0.103) * (1.0 + share).ln(),
    ]
}

#[test]
fn films_and_load_shares_are_those_of_a_published_fit() {
    let (w, u, g, v, modulus, radius) = (1e-4, 1e-11, 4500.0, 0.01, 231e9, 0.01);
    let contact = [radius, u * modulus * radius / 0.01, w * modulus * radius, modulus, 0.01, g / modulus, 0.0];
    let point = point(ContactKind::Line, contact);
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let laws = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let smooth = solved(&mut solver, &point, laws, Start::Cold).scalars;
    for (sigma, within) in [(1e-5, 0.02), (2e-5, 0.05), (3e-5, 0.06)] {
        let roughness = rough(sigma * radius, zmc(0.05, 0.01, v * modulus));
        let solution = solved(&mut solver, &point, laws.on_rough_surfaces(Some(roughness)), Start::Cold);
        let [h_c, h_min, share] = masjedi_khonsari(sigma, v, [w, u, g]);
        let (scalars, own) = (solution.scalars, 100.0 * solution.asperity_load_share());
        assert!((scalars.h_c / smooth.h_c / h_c - 1.0).abs() < within, "{sigma}: {}", scalars.h_c / smooth.h_c);
        assert!((scalars.h_min / smooth.h_min / h_min - 1.0).abs() < within, "{sigma}");
        assert!((own - share).abs() < 6.0, "{sigma}: {own} against {share}");
    }
}

#[test]
fn a_sweep_of_the_speed_is_the_same_in_both_directions() {
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let speeds: Vec<f64> = (0..10).map(|k| 1e-8 * 10f64.powi(k)).collect();
    let lubricant = Lubricant {
        limiting_stress: Some(LimitingStress { ambient: 0.0, slope: 0.08, eyring: Some(5e6) }),
        ..Lubricant::default()
    }
    .on_rough_surfaces(Some(Roughness::new(1e-7)));
    let mut along = |speeds: &mut dyn Iterator<Item = &f64>| -> Vec<f64> {
        let mut former: Option<Solution> = None;
        let mut friction = Vec::new();
        for &speed in speeds {
            let point = point(ContactKind::Line, [0.01, speed, 2e5, 231e9, 0.02, 1.5e-8, 0.1]);
            let start = former.as_ref().map_or(Start::Cold, Start::From);
            let solution = solved(&mut solver, &point, lubricant, start);
            friction.push(solution.traction_coefficient());
            former = Some(solution);
        }
        friction
    };
    let up = along(&mut speeds.iter());
    let mut down = along(&mut speeds.iter().rev());
    down.reverse();
    assert!(up.iter().zip(&down).all(|(a, b)| (a - b).abs() < 1e-10), "{up:?} {down:?}");
    // A Stribeck curve: a plateau of boundary friction, and a minimum where the film carries the load.
    let least = up.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((up[0] - 0.12).abs() < 0.005 && least < 0.06, "{up:?}");
}

#[test]
fn ridges_along_the_flow_thin_the_film_of_ellipses() {
    let contact = MoesRequest { radius_y_m: Some(0.03), ..MoesRequest::new(ContactKind::Point, 100.0, 8.0) };
    let point = si_from_moes(&contact).unwrap();
    let sigma = 0.5 * FilmFormula::NijenbanningVennerMoes.predict(&point).film_m;
    let spec = GridSpec::Plane(PointGridSpec::uniform(0.06, 0.1, (-4.0, 2.0, -2.0)));
    let mut solver = ContactSolver::on(&spec.build().unwrap());
    let [across, isotropic, along] = [1.0 / 3.0, 1.0, 3.0].map(|peklenik| {
        let roughness = Roughness { peklenik, ..Roughness::new(sigma) };
        solved(&mut solver, &point, Lubricant::default().on_rough_surfaces(Some(roughness)), Start::Cold).scalars.h_c
    });
    assert!(along < isotropic && isotropic < across, "{along} {isotropic} {across}");
}

#[test]
fn what_is_not_supported_is_refused_in_one_sentence() {
    let laws = Lubricant::default().on_rough_surfaces(Some(Roughness::new(1e-7)));
    let with = |change: &dyn Fn(&mut Lubricant, &mut Roughness)| {
        let (mut laws, mut roughness) = (laws, Roughness::new(1e-7));
        change(&mut laws, &mut roughness);
        laws.roughness = Some(roughness);
        Problem::new(&OperatingPoint::TABLE_2_1, laws).unwrap_err().to_string()
    };
    let starved = Cavitation::MassConserving { supply_film_m: Some(1e-7) };
    for (sentence, said) in [
        (with(&|laws, _| laws.cavitation = Cavitation::Penalty), "not penalty"),
        (with(&|laws, _| laws.cavitation = starved), "flooded inlet"),
        (with(&|_, rough| rough.sigma = -1e-7), "the roughness in m is -1e-7"),
        (with(&|_, rough| rough.sigma = f64::NAN), "the roughness in m is NaN"),
        (with(&|_, rough| rough.peklenik = 10.0), "the Peklenik number is 10"),
        (with(&|_, rough| rough.peklenik = 0.1), "the Peklenik number is 0.1"),
        (with(&|_, rough| rough.asperities = zmc(0.05, 0.01, 0.0)), "the hardness in Pa is 0"),
        (with(&|_, rough| rough.asperities = zmc(0.01, 0.01, 5e9)), "nβσ of Zhao-Maietta-Chang is 0.01"),
        (with(&|_, rough| rough.shear_flow = 1.5), "the relative difference of both variances is 1.5"),
        (with(&|_, rough| rough.boundary_friction = -0.1), "the boundary friction coefficient is -0.1"),
    ] {
        assert!(sentence.contains(said), "{sentence}");
    }
}

#[test]
fn a_slow_contact_has_a_real_contact_area_wears_and_is_elastic() {
    let slow = point(ContactKind::Line, [0.01, 1e-3, 2e5, 231e9, 0.02, 1.5e-8, 0.1]);
    let roughness = Roughness { wear_rate: 1e-16, ..Roughness::new(3e-7) };
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let lubricant = Lubricant::default().on_rough_surfaces(Some(roughness));
    let solution = solved(&mut solver, &slow, lubricant, Start::Cold);
    let mixed = solution.mixed().unwrap();
    // The mean pressure in the real contact area is one of those of the law between the film thicknesses.
    let hertz = slow.hertz();
    let area = mixed.real_contact_area.unwrap() * 2.0 * hertz.half_width_m;
    let mean = mixed.asperity_load_share * slow.load / area;
    let of = |ratio: f64| {
        let law = roughness.asperities;
        law.pressure(slow.modulus_pa, ratio).0 / law.contact_area(slow.modulus_pa, ratio).unwrap()
    };
    let (deep, apart) = (of(mixed.film_ratio_min), of(3.0));
    assert!(mixed.real_contact_area.unwrap() < 1.0 && (apart..deep).contains(&mean), "{apart:e} {mean:e} {deep:e}");
    // Archard's law at the largest asperity pressure.
    let largest = solution.asperity_pressures().fold(0.0, f64::max) * hertz.pressure_pa;
    let wear = mixed.wear_m_per_s.unwrap();
    assert!((wear / (1e-16 * largest * 1e-4) - 1.0).abs() < 1e-12, "{wear:e}");
    // The same film at another sliding: friction and wear follow, everything else remains.
    let mut faster = slow;
    faster.sliding.slide_to_roll_ratio = -0.4;
    let same_film = solution.clone().of_problem(Problem::new(&faster, lubricant).unwrap());
    let moved = same_film.mixed_at_sliding(mixed);
    assert_eq!(moved, same_film.mixed().unwrap());
    assert!((moved.wear_m_per_s.unwrap() / wear - 4.0).abs() < 1e-12);
    assert!((moved.boundary_traction + mixed.boundary_traction).abs() < 1e-15);
    // The nominal film is below zero, but the bodies flatten by much more than the mean gap.
    assert!(solution.scalars.h_c < 0.0);
    let ratios = ehl_explorer::scene::regime::Ratios::of(&solution);
    assert!(ratios.regime().is_elastic() && ratios.deformation > 1.0, "{ratios:?}");
}
