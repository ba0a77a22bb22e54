//! Integrals (3.24) of a generalized-Newtonian fluid across the film, with their derivatives: the inner problem of
//! (3.23).
//!
//! Across the film the shear stress is linear: τ(ζ) = τ_m + (a, b) ζ with ζ = Z − ½. The pressure gradient determines
//! the difference (a, b) between the surfaces. The stress τ_m at mid-film is such that the shear rates add up to the
//! sliding speed, ∫ τ g(|τ|) dζ = (S, 0). All stresses are in units of the law's own scale; g = μ/η is the law's
//! fluidity.
//!
//! So everything depends on three scalars: a = κ₁H P_X, b = κ₁H P_Y and S = κ₂ μ̄/H. This is (3.29)–(3.36) with τ_m
//! instead of χ̄₀ and χ̄₁ as the unknown of the inner Newton iteration. For a line contact (b = 0) it is one monotone
//! scalar equation. Without sliding τ_m = 0, and no iteration is needed.

mod known;
mod moments;
#[cfg(test)]
mod tests;

pub use known::{KnownFilm, film_integrals_near};
pub use moments::{FilmRule, PRODUCTION_RULE};

use crate::solver::physics::lubricant::Fluidity;
use moments::{Moments, shortened};

/// Three scalars that the integrals depend on, in units of the law's stress scale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmLoad {
    /// a: difference of τ_zx between the surfaces.
    pub a: f64,
    /// b: difference of τ_zy between the surfaces; zero for a line contact.
    pub b: f64,
    /// S: stress that sliding would cause in a Newtonian film.
    pub sliding: f64,
}

/// Film integrals of the generalized Reynolds equation, and the stress in the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmIntegrals {
    /// φ = 12 μ̄ (χ̄₂ − χ̄₁²/χ̄₀), the factor on the Newtonian mobility; 1 for a Newtonian film.
    pub mobility: f64,
    /// ∂φ/∂(a, b, S).
    pub d_mobility: [f64; 3],
    /// χ̄₁/χ̄₀ − ½, the shift of the plane in which the fluid moves with the mean of both surfaces.
    pub shift: f64,
    /// Derivatives of the shift by a, b and S.
    pub d_shift: [f64; 3],
    /// τ_m: shear stress (zx, zy) at mid-film.
    pub mid_stress: [f64; 2],
    /// ∂τ_m/∂(a, b, S).
    pub d_mid_stress: [[f64; 2]; 3],
    /// Number of iterations of the inner Newton method.
    pub iterations: usize,
}

/// Maximum number of iterations of the inner Newton method. The named lubricants need five. A power law with n = 0.2
/// and a hyperbolic sine at ten times its scale need eight.
const MOST_ITERATIONS: usize = 12;

/// The initial guess uses the fluidity under the pressure gradient if that fluidity exceeds the one under sliding by
/// this factor.
const MUCH_MORE_FLUID: f64 = 10.0;

/// Step, relative to τ_m, after which the next step would be below rounding, because it is the square of this one.
/// The integrals then follow the step to first order.
pub const LAST_STEP: f64 = 1e-7;

/// Share of [`LAST_STEP`] relative to a and b that is accepted as well, for τ_m so small that rounding hides it.
const ACROSS: f64 = 1e-2;

/// Stresses are far from overflowing; `hypot` would take longer than a sum over the rule.
#[inline]
fn length(v: [f64; 2]) -> f64 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

fn times(m: [f64; 3], v: [f64; 2]) -> [f64; 2] {
    [m[0] * v[0] + m[1] * v[1], m[1] * v[0] + m[2] * v[1]]
}

/// Solves the inner problem and returns the integrals with their derivatives.
pub fn film_integrals(law: &Fluidity, rule: &FilmRule, load: FilmLoad) -> FilmIntegrals {
    alone(law, rule, load, LAST_STEP)
}

/// Does the same until a step is as small as `last`.
fn alone(law: &Fluidity, rule: &FilmRule, load: FilmLoad, last: f64) -> FilmIntegrals {
    let rule = shortened(law, rule, &load);
    let (start, iterations) = cold_start(law, rule, &load);
    solve(law, rule, load, (start, last), iterations).1
}

/// Returns an initial guess of τ_m, and the number of evaluations of the film that it took.
fn cold_start(law: &Fluidity, rule: &FilmRule, load: &FilmLoad) -> ([f64; 2], usize) {
    let FilmLoad { a, b, sliding } = *load;
    // A film under a pressure gradient has higher shear rates than the mid-film stress alone causes: this guess is
    // never too small.
    let mid = [law.stress_near(sliding.abs()).copysign(sliding), 0.0];
    let edge = 0.5 * length([a, b]);
    if sliding != 0.0 && edge > mid[0].abs() && law.at(edge).0 > MUCH_MORE_FLUID * law.at(mid[0].abs()).0 {
        // The guess with the fluidity of the gradient alone is not too small either, and much closer here.
        return (times(Moments::of(law, rule, load, [0.0; 2]).inverse(), [sliding, 0.0]), 1);
    }
    (mid, 0)
}

/// Applies Newton's method to τ_m until a step is as small as `last`. Returns the size of its first step, and the
/// integrals.
fn solve(
    law: &Fluidity,
    rule: &FilmRule,
    load: FilmLoad,
    (mut mid, last): ([f64; 2], f64),
    mut iterations: usize,
) -> (f64, FilmIntegrals) {
    let FilmLoad { a, b, sliding } = load;
    let mut first = None;
    let mut moments = Moments::of(law, rule, &load, mid);
    let mut inverse = moments.inverse();
    while sliding != 0.0 && iterations < MOST_ITERATIONS {
        iterations += 1;
        let [g_0, g_1, _] = moments.fluidity;
        let excess = [mid[0] * g_0 + a * g_1 - sliding, mid[1] * g_0 + b * g_1];
        let step = times(inverse, excess).map(|s| -s);
        first.get_or_insert(length(step));
        mid = [mid[0] + step[0], mid[1] + step[1]];
        let small = last * (length(mid) + ACROSS * (a.abs() + b.abs()));
        if length(step) <= small {
            for (g, slope) in moments.fluidity.iter_mut().zip(moments.slope) {
                *g += slope[0] * step[0] + slope[1] * step[1];
            }
            break;
        }
        moments = Moments::of(law, rule, &load, mid);
        inverse = moments.inverse();
    }
    let [g_0, g_1, g_2] = moments.fluidity;
    let shift = g_1 / g_0;
    let mut out = FilmIntegrals {
        mobility: 12.0 * (g_2 - g_1 * shift),
        d_mobility: [0.0; 3],
        shift,
        d_shift: [0.0; 3],
        mid_stress: mid,
        d_mid_stress: [[0.0; 2]; 3],
        iterations,
    };
    // (3.33)–(3.36): derivatives of τ_m by each scalar, then of the integrals directly and through τ_m.
    let [xx, xy, yy] = moments.stiffness[1];
    let answers = [times(inverse, [-(g_1 + xx), -xy]), times(inverse, [-xy, -(g_1 + yy)]), [inverse[0], inverse[1]]];
    out.d_mid_stress = answers;
    for (q, answer) in answers.into_iter().enumerate() {
        let change: [f64; 3] = std::array::from_fn(|k| {
            let direct = if q < 2 { moments.slope[k + 1][q] } else { 0.0 };
            direct + moments.slope[k][0] * answer[0] + moments.slope[k][1] * answer[1]
        });
        out.d_mobility[q] = 12.0 * (change[2] - 2.0 * shift * change[1] + shift * shift * change[0]);
        out.d_shift[q] = (change[1] - shift * change[0]) / g_0;
    }
    (first.unwrap_or(0.0), out)
}
