//! Film integrals with an initial guess from a nearby film that is already solved. Between two iterations, and from
//! node to node, the stress changes little.

use super::moments::shortened;
use super::{FilmIntegrals, FilmLoad, FilmRule, MOST_ITERATIONS, alone, length, solve};
use crate::solver::physics::lubricant::Fluidity;

/// Largest first step, relative to the mid-film stress τ_m, for which the initial guess from a nearby film is accepted.
const FIRST_STEP: f64 = 0.3;

/// Solved film, used as initial guess for a nearby one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownFilm {
    /// Scalars a, b and S of the film.
    pub load: FilmLoad,
    /// Mid-film stress τ_m; zero if unknown.
    pub mid_stress: [f64; 2],
    /// ∂τ_m/∂(a, b, S).
    pub d_mid_stress: [[f64; 2]; 3],
}

impl KnownFilm {
    /// Returns true if no solution is stored.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.mid_stress == [0.0; 2]
    }

    /// Estimates τ_m of a nearby film, to first order if the change is small. `None` without sliding, or if no
    /// solution is stored.
    #[inline]
    fn near(&self, load: &FilmLoad) -> Option<[f64; 2]> {
        let own = self.mid_stress;
        if self.is_empty() || load.sliding == 0.0 {
            return None;
        }
        let changes = [load.a - self.load.a, load.b - self.load.b, load.sliding - self.load.sliding];
        let mut step = [0.0; 2];
        for (slope, change) in self.d_mid_stress.iter().zip(changes) {
            step = [step[0] + slope[0] * change, step[1] + slope[1] * change];
        }
        let follows = length(step) <= FIRST_STEP * length(own);
        Some(if follows { [own[0] + step[0], own[1] + step[1]] } else { own })
    }
}

/// Computes [`film_integrals`](super::film_integrals) starting from a nearby solved film. Ends when a step of τ_m,
/// relative to τ_m, is as small as `last`; the remaining error is the square of it.
pub fn film_integrals_near(
    law: &Fluidity,
    (rule, last): (&FilmRule, f64),
    load: FilmLoad,
    known: &KnownFilm,
) -> FilmIntegrals {
    if let Some(near) = known.near(&load) {
        let (first, integrals) = solve(law, shortened(law, rule, &load), load, (near, last), 0);
        // If the initial stress is too small, a steep law takes steps that diverge. If it has the wrong sign, the
        // steps are too many and too short.
        if first <= FIRST_STEP * length(near) && integrals.iterations < MOST_ITERATIONS {
            return integrals;
        }
    }
    alone(law, rule, load, last)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{laws, loads};
    use super::super::{LAST_STEP, PRODUCTION_RULE, film_integrals};
    use super::*;

    #[test]
    fn a_film_beside_a_known_one_is_the_same_as_alone() {
        for law in laws() {
            for load in loads() {
                let alone = film_integrals(&law, &PRODUCTION_RULE, load);
                let FilmIntegrals { mid_stress, d_mid_stress, .. } = alone;
                let known = KnownFilm { load, mid_stress, d_mid_stress };
                for factor in [1.0, 1.0 + 1e-9, 1.001, 0.9, 4.0, 0.01, -1.0] {
                    let FilmLoad { a, b, sliding } = load;
                    let moved = FilmLoad { a: a * (2.0 - factor), b: b * factor, sliding: sliding * factor };
                    let (own, near) = (
                        film_integrals(&law, &PRODUCTION_RULE, moved),
                        film_integrals_near(&law, (&PRODUCTION_RULE, LAST_STEP), moved, &known),
                    );
                    assert!((near.mobility / own.mobility - 1.0).abs() < 1e-11, "{law:?} {load:?} {factor}");
                    assert!((near.shift - own.shift).abs() < 1e-11, "{law:?} {load:?} {factor}");
                }
                let again = film_integrals_near(&law, (&PRODUCTION_RULE, LAST_STEP), load, &known);
                assert!(again.iterations <= 1, "{law:?} {load:?}: {} iterations", again.iterations);
            }
        }
    }

    #[test]
    fn a_film_that_ends_at_a_larger_step_misses_its_square() {
        let mut fewer = 0;
        for law in laws() {
            for load in loads().into_iter().filter(|load| load.sliding != 0.0) {
                let FilmIntegrals { mid_stress, d_mid_stress, .. } = film_integrals(&law, &PRODUCTION_RULE, load);
                let known = KnownFilm { load, mid_stress, d_mid_stress };
                let FilmLoad { a, b, sliding } = load;
                let moved = FilmLoad { a: 1.02 * a, b: 0.97 * b, sliding: 1.03 * sliding };
                let exact = film_integrals(&law, &PRODUCTION_RULE, moved);
                for last in [1e-2, 1e-3, 1e-4] {
                    let near = film_integrals_near(&law, (&PRODUCTION_RULE, last), moved, &known);
                    let off = (near.mobility / exact.mobility - 1.0).abs().max((near.shift - exact.shift).abs());
                    assert!(off < 20.0 * last * last, "{law:?} {load:?} {last:e}: {off:.1e}");
                    fewer += usize::from(near.iterations < exact.iterations);
                }
            }
        }
        assert!(fewer > 300, "{fewer}");
    }
}
