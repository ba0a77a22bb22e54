//! Film integrals compared with adaptive quadrature, their derivatives compared with finite differences, and
//! properties that hold for every law.

use super::*;
use crate::solver::physics::lubricant::ShearLaw;

pub fn laws() -> Vec<Fluidity> {
    [
        (ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 }, 0.2227),
        (ShearLaw::Carreau { critical_stress: 3.1e4, beta: 2.0, n: 0.74, npr: 0.0 }, 0.0),
        (ShearLaw::Ellis { critical_stress: 1e5, n: 0.6, npr: 0.1 }, 0.1),
        (ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, 0.0),
    ]
    .into_iter()
    .filter_map(|(law, npr)| Some(Fluidity::of(law, npr)?.0))
    .collect()
}

pub fn loads() -> Vec<FilmLoad> {
    let mut out = Vec::new();
    for a in [0.0, -0.03, 0.7, -6.0, 40.0] {
        for b in [0.0, 0.4, -9.0] {
            for sliding in [0.0, 1e-3, -0.5, 8.0, 3e3] {
                out.push(FilmLoad { a, b, sliding });
            }
        }
    }
    out
}

/// Panels of 1/16 that shrink towards the kink of |τ|, with 12 Gauss points (two times six) each.
fn reference_rule(kink: f64) -> Vec<(f64, f64)> {
    let mut edges: Vec<f64> = (0..=16).map(|k| f64::from(k) / 16.0 - 0.5).collect();
    for k in 0..26 {
        let d = 0.5f64.powi(k);
        edges.extend([kink - d, kink + d]);
    }
    edges.push(kink);
    edges.retain(|e| (-0.5..=0.5).contains(e));
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    let panels = edges.windows(2).flat_map(|w| {
        let (from, width) = (w[0], w[1] - w[0]);
        PRODUCTION_RULE.map(|(at, weight)| (from + (at + 0.5) * width, weight * width))
    });
    panels.collect()
}

/// Adaptive Simpson quadrature.
fn adaptive(f: &dyn Fn(f64) -> f64, from: f64, to: f64, tolerance: f64, depth: usize) -> f64 {
    let simpson = |a: f64, b: f64| (b - a) / 6.0 * (f(a) + 4.0 * f(0.5 * (a + b)) + f(b));
    let middle = 0.5 * (from + to);
    let (whole, halves) = (simpson(from, to), simpson(from, middle) + simpson(middle, to));
    if depth == 0 || (whole - halves).abs() < 15.0 * tolerance {
        return halves + (halves - whole) / 15.0;
    }
    adaptive(f, from, middle, 0.5 * tolerance, depth - 1) + adaptive(f, middle, to, 0.5 * tolerance, depth - 1)
}

/// Returns the height at which |τ| is smallest.
fn kink(load: &FilmLoad, mid: [f64; 2]) -> f64 {
    let length = load.a * load.a + load.b * load.b;
    if length == 0.0 { 0.0 } else { -(mid[0] * load.a + mid[1] * load.b) / length }
}

#[test]
fn the_reference_rule_agrees_with_adaptive_quadrature_to_1e_8() {
    for law in laws() {
        for load in loads() {
            let first = film_integrals(&law, &PRODUCTION_RULE, load);
            let mid = film_integrals(&law, &reference_rule(kink(&load, first.mid_stress)), load).mid_stress;
            let at = kink(&load, mid);
            let fine = film_integrals(&law, &reference_rule(at), load);
            let stress = |z: f64| (mid[0] + load.a * z).hypot(mid[1] + load.b * z);
            let g = |z: f64| law.at(stress(z)).0;
            let scale = law.at(stress(0.5).max(stress(-0.5))).0;
            let integral = |k: i32| {
                let f = |z: f64| z.powi(k) * g(z) / scale;
                let edge = at.clamp(-0.5, 0.5);
                scale * (adaptive(&f, -0.5, edge, 1e-11, 40) + adaptive(&f, edge, 0.5, 1e-11, 40))
            };
            let (g_0, g_1, g_2) = (integral(0), integral(1), integral(2));
            let mobility = 12.0 * (g_2 - g_1 * g_1 / g_0);
            assert!((fine.mobility / mobility - 1.0).abs() < 1e-8, "{law:?} {load:?}");
            assert!((fine.shift - g_1 / g_0).abs() < 1e-8, "{law:?} {load:?}");
            let rate = (mid[0] * g_0 + load.a * g_1, mid[1] * g_0 + load.b * g_1);
            let size = load.sliding.abs().max(load.a.abs()).max(load.b.abs()).max(1e-3) * scale;
            assert!((rate.0 - load.sliding).abs() < 1e-8 * size && rate.1.abs() < 1e-8 * size, "{law:?} {load:?}");
        }
    }
}

#[test]
fn derivatives_agree_with_finite_differences_to_1e_6() {
    for law in laws() {
        for load in loads() {
            // Finite differences across the kink of pure rolling do not approximate the derivative there.
            if load.a == 0.0 && load.b == 0.0 && load.sliding == 0.0 {
                continue;
            }
            let exact = film_integrals(&law, &PRODUCTION_RULE, load);
            let size = load.a.abs().max(load.b.abs()).max(exact.mid_stress[0].abs());
            for q in 0..3 {
                let place = [size, size, load.sliding.abs().max(size)][q];
                let step = 3e-5 * place;
                let moved = |by: f64| {
                    let mut moved = load;
                    *[&mut moved.a, &mut moved.b, &mut moved.sliding][q] += by;
                    film_integrals(&law, &PRODUCTION_RULE, moved)
                };
                let (up, down, up2, down2) = (moved(step), moved(-step), moved(2.0 * step), moved(-2.0 * step));
                let slope = |f: &dyn Fn(&FilmIntegrals) -> f64| {
                    (8.0 * (f(&up) - f(&down)) - (f(&up2) - f(&down2))) / (12.0 * step)
                };
                let mobility = slope(&|i| i.mobility);
                let shift = slope(&|i| i.shift);
                let error = (mobility - exact.d_mobility[q]).abs() * place / exact.mobility;
                assert!(error < 1e-6, "{law:?} {load:?} mobility by {q}: {error:e}");
                let error = (shift - exact.d_shift[q]).abs() * place;
                assert!(error < 1e-6, "{law:?} {load:?} shift by {q}: {error:e}");
            }
        }
    }
}

#[test]
fn mid_film_stress_has_the_stated_derivatives() {
    for law in laws() {
        for load in loads().into_iter().filter(|load| load.sliding != 0.0) {
            let exact = film_integrals(&law, &PRODUCTION_RULE, load);
            let size = load.a.abs().max(load.b.abs()).max(exact.mid_stress[0].abs());
            for q in 0..3 {
                let step = 1e-5 * [size, size, load.sliding.abs().max(size)][q];
                let moved = |by: f64| {
                    let mut moved = load;
                    *[&mut moved.a, &mut moved.b, &mut moved.sliding][q] += by;
                    film_integrals(&law, &PRODUCTION_RULE, moved).mid_stress
                };
                let (up, down) = (moved(step), moved(-step));
                for axis in 0..2 {
                    let slope = (up[axis] - down[axis]) / (2.0 * step);
                    let error = (slope - exact.d_mid_stress[q][axis]).abs();
                    assert!(error < 1e-5 * (1.0 + slope.abs()), "{law:?} {load:?} axis {axis} by {q}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn sliding_the_other_way_mirrors_the_film() {
    for law in laws() {
        for load in loads() {
            let one = film_integrals(&law, &PRODUCTION_RULE, load);
            let other = film_integrals(&law, &PRODUCTION_RULE, FilmLoad { sliding: -load.sliding, ..load });
            assert!((one.mobility / other.mobility - 1.0).abs() < 1e-12, "{law:?} {load:?}");
            assert!((one.shift + other.shift).abs() < 1e-12, "{law:?} {load:?}");
            assert!(
                (one.mid_stress[0] + other.mid_stress[0]).abs() <= 1e-11 * (one.mid_stress[0].abs() + load.a.abs())
            );
        }
    }
}

#[test]
fn shorter_rules_of_a_smooth_law_change_nothing() {
    let (eyring, _) = Fluidity::of(ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, 0.0).unwrap();
    // A rule with twice the points is recognised by their number and is not shortened.
    let longer: Vec<(f64, f64)> = [-0.25, 0.25]
        .into_iter()
        .flat_map(|middle| PRODUCTION_RULE.map(|(at, weight)| (middle + 0.5 * at, 0.5 * weight)))
        .collect();
    for across in [1e-3, 0.02, 0.08, 0.3, 0.9] {
        for direction in [0.0f64, 0.4, 0.8, 1.5] {
            for sliding in [0.0, 1e-6, 1e-2, 0.3, 4.0, 1e3, 1e6] {
                let load = FilmLoad { a: across * direction.cos(), b: across * direction.sin(), sliding };
                let (short, long) =
                    (film_integrals(&eyring, &PRODUCTION_RULE, load), film_integrals(&eyring, &longer, load));
                assert!((short.mobility / long.mobility - 1.0).abs() < 1e-13, "{load:?}");
                assert!((short.shift - long.shift).abs() < 1e-13, "{load:?}");
                // Derivatives affect the path of Newton's method, not its solution.
                for (one, other) in short.d_mobility.iter().zip(long.d_mobility) {
                    assert!((one - other).abs() < 1e-7 * (long.mobility + other.abs()), "{load:?}: {one} {other}");
                }
                for (one, other) in short.d_shift.iter().zip(long.d_shift) {
                    assert!((one - other).abs() < 1e-7, "{load:?}: {one} {other}");
                }
            }
        }
    }
}

#[test]
fn the_inner_newton_method_is_short() {
    let strong = [
        (ShearLaw::Ellis { critical_stress: 1e5, n: 0.2, npr: 0.0 }, 0.0),
        (ShearLaw::Carreau { critical_stress: 1e5, beta: 2.0, n: 0.3, npr: 0.0 }, 0.0),
    ];
    let strong = strong.into_iter().filter_map(|(law, npr)| Some(Fluidity::of(law, npr)?.0));
    for (k, law) in laws().into_iter().chain(strong).enumerate() {
        let mut most = 0;
        for exponents in 0..14 * 10 {
            let power = |e: i32| 10f64.powf(0.5 * f64::from(e));
            let (sliding, a) = (power(exponents % 14 - 6), power(exponents / 14 - 6));
            for b in [0.0, 0.4, -9.0, 40.0] {
                most = most.max(film_integrals(&law, &PRODUCTION_RULE, FilmLoad { a, b, sliding }).iterations);
            }
        }
        // The first two are those of Tables 3.5 and 3.8.
        let bar = if k < 2 { 5 } else { 8 };
        assert!(most <= bar, "{law:?}: {most} iterations");
    }
}

#[test]
fn a_film_without_stress_and_one_without_thinning_are_newtonian() {
    for law in laws() {
        let rest = film_integrals(&law, &PRODUCTION_RULE, FilmLoad::default());
        assert!((rest.mobility - 1.0).abs() < 1e-14 && rest.shift.abs() < 1e-15);
    }
    let carreau = ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.0 };
    let (unit, _) = Fluidity::of(carreau, 1.0).unwrap();
    for load in loads() {
        let film = film_integrals(&unit, &PRODUCTION_RULE, load);
        assert!((film.mobility - 1.0).abs() < 1e-14 && film.shift.abs() < 1e-15, "{load:?}");
        assert!((film.mid_stress[0] - load.sliding).abs() <= 1e-14 * (load.sliding.abs() + load.a.abs()), "{load:?}");
    }
}
