//! Quadrature across the film: the rule, and the moments of the fluidity at one mid-film stress, from which the inner
//! problem is built.

use super::{FilmLoad, length};
use crate::solver::physics::lubricant::{Fluidity, GAUSS_6};

/// Points ζ, ascending, and weights of a rule over the film. A panel ends at ζ = 0, so that the points above are a
/// rule for the upper half.
pub type FilmRule = [(f64, f64)];

/// Production rule: two panels with six Gauss points each. The panels meet at ζ = 0, where the stress of pure rolling
/// has its kink.
pub const PRODUCTION_RULE: [(f64, f64); 12] = two_panels();

const fn two_panels() -> [(f64, f64); 12] {
    let mut rule = [(0.0, 0.0); 12];
    let mut i = 0;
    while i < 6 {
        let (at, weight) = GAUSS_6[i];
        rule[i] = (0.5 * at - 0.25, 0.5 * weight);
        rule[i + 6] = (0.5 * at + 0.25, 0.5 * weight);
        i += 1;
    }
    rule
}

/// Four Gauss points over the film.
const GAUSS_4: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
    (-0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Rules that are sufficient for a smooth law, to rounding, up to this difference of the stress between the surfaces,
/// in units of the law's scale.
const SHORTER: [(f64, &FilmRule); 2] = [(0.08, &GAUSS_4), (0.9, &GAUSS_6)];

/// Returns the rule for a film: a shorter one without panels if the law is smooth and the stress varies little.
#[inline]
pub(super) fn shortened<'a>(law: &Fluidity, rule: &'a FilmRule, load: &FilmLoad) -> &'a FilmRule {
    if rule.len() != POINTS || !law.is_smooth() {
        return rule;
    }
    let across = load.a.abs().max(load.b.abs());
    SHORTER.into_iter().find(|(most, _)| across <= *most).map_or(rule, |(_, shorter)| shorter)
}

/// Sums over a film rule at one mid-film stress τ_m, with the fluidity g.
#[derive(Clone, Copy, Default)]
pub(super) struct Moments {
    /// ∫ ζ^k g.
    pub fluidity: [f64; 3],
    /// ∫ ζ^k ∂g/∂τ.
    pub slope: [[f64; 2]; 4],
    /// ∫ ζ^k ∂(τ g)/∂τ without its isotropic part g: xx, xy, yy.
    pub stiffness: [[f64; 3]; 2],
}

/// Points of a rule at which the law is evaluated at once; unused points have weight zero.
struct Lanes<const N: usize> {
    zeta: [f64; N],
    weight: [f64; N],
}

/// Splits a rule into portions of N points.
fn portions<const N: usize>(rule: &FilmRule) -> impl Iterator<Item = Lanes<N>> + '_ {
    rule.chunks(N).map(|points| {
        let mut lanes = Lanes { zeta: [0.0; N], weight: [0.0; N] };
        for (i, &(zeta, weight)) in points.iter().enumerate() {
            (lanes.zeta[i], lanes.weight[i]) = (zeta, weight);
        }
        lanes
    })
}

/// Number of points of the production rule.
const POINTS: usize = PRODUCTION_RULE.len();

impl Moments {
    #[inline]
    pub fn of(law: &Fluidity, rule: &FilmRule, load: &FilmLoad, mid: [f64; 2]) -> Self {
        match rule.len() {
            4 => Self::by_portions::<4, 2>(law, rule, load, mid),
            6 => Self::by_portions::<6, 3>(law, rule, load, mid),
            _ => Self::by_portions::<POINTS, { POINTS / 2 }>(law, rule, load, mid),
        }
    }

    /// Computes the sums with `N` points of the rule at once, or `HALF` points of its upper half.
    #[inline]
    fn by_portions<const N: usize, const HALF: usize>(
        law: &Fluidity,
        rule: &FilmRule,
        load: &FilmLoad,
        mid: [f64; 2],
    ) -> Self {
        if mid == [0.0; 2] {
            Self::rolling::<HALF>(law, rule, load)
        } else if load.b == 0.0 && mid[1] == 0.0 {
            Self::along::<N>(law, rule, load.a, mid[0])
        } else {
            Self::plane::<N>(law, rule, load, mid)
        }
    }

    /// Sums without stress at mid-film. The fluidity is then even across the film: the upper half suffices, and odd
    /// moments vanish.
    fn rolling<const N: usize>(law: &Fluidity, rule: &FilmRule, load: &FilmLoad) -> Self {
        let mut out = Self::default();
        let across = length([load.a, load.b]);
        let (nx, ny) = if across > 0.0 { (load.a / across, load.b / across) } else { (0.0, 0.0) };
        let per = if across > 0.0 { 1.0 / across } else { 0.0 };
        let upper = &rule[rule.partition_point(|(zeta, _)| *zeta < 0.0)..];
        for Lanes { zeta, weight } in portions::<N>(upper) {
            let (g, slope) = law.at_all(&zeta.map(|z| across * z));
            for i in 0..N {
                let (z, weight) = (zeta[i], 2.0 * weight[i]);
                let (wg, we) = (weight * g[i], weight * slope[i]);
                out.fluidity[0] += wg;
                out.fluidity[2] += z * z * wg;
                // ζ ∂g/∂|τ| = (|τ| ∂g/∂|τ|)/|(a, b)|.
                let radial = we * per;
                for (sum, moment) in [(1, radial), (3, z * z * radial)] {
                    out.slope[sum][0] += moment * nx;
                    out.slope[sum][1] += moment * ny;
                }
                for (sum, direction) in out.stiffness[0].iter_mut().zip([nx * nx, nx * ny, ny * ny]) {
                    *sum += we * direction;
                }
            }
        }
        out
    }

    /// Sums without shear perpendicular to the sliding direction: the y parts vanish, and stresses are scalars.
    fn along<const N: usize>(law: &Fluidity, rule: &FilmRule, a: f64, mid: f64) -> Self {
        let mut out = Self::default();
        for Lanes { zeta, weight } in portions::<N>(rule) {
            let stress = zeta.map(|z| mid + a * z);
            let (g, slope) = law.at_all(&stress.map(f64::abs));
            for i in 0..N {
                let z = zeta[i];
                let (wg, we) = (weight[i] * g[i], weight[i] * slope[i]);
                let sx = if stress[i] == 0.0 { 0.0 } else { we / stress[i] };
                let (z2, z3) = (z * z, z * z * z);
                for (sum, z) in out.fluidity.iter_mut().zip([1.0, z, z2]) {
                    *sum += z * wg;
                }
                for (sum, z) in out.slope.iter_mut().zip([1.0, z, z2, z3]) {
                    sum[0] += z * sx;
                }
                out.stiffness[0][0] += we;
                out.stiffness[1][0] += z * we;
            }
        }
        out
    }

    fn plane<const N: usize>(law: &Fluidity, rule: &FilmRule, load: &FilmLoad, mid: [f64; 2]) -> Self {
        let mut out = Self::default();
        for Lanes { zeta, weight } in portions::<N>(rule) {
            let (x, y) = (zeta.map(|z| mid[0] + load.a * z), zeta.map(|z| mid[1] + load.b * z));
            let mut stress = [0.0; N];
            for i in 0..N {
                stress[i] = (x[i] * x[i] + y[i] * y[i]).sqrt();
            }
            let (g, slope) = law.at_all(&stress);
            for i in 0..N {
                let z = zeta[i];
                let per = if stress[i] > 0.0 { 1.0 / stress[i] } else { 0.0 };
                let (nx, ny) = (x[i] * per, y[i] * per);
                let (wg, we) = (weight[i] * g[i], weight[i] * slope[i]);
                let (sx, sy) = (we * nx * per, we * ny * per);
                let (z2, z3) = (z * z, z * z * z);
                for (sum, z) in out.fluidity.iter_mut().zip([1.0, z, z2]) {
                    *sum += z * wg;
                }
                for (sum, z) in out.slope.iter_mut().zip([1.0, z, z2, z3]) {
                    sum[0] += z * sx;
                    sum[1] += z * sy;
                }
                for (sum, z) in out.stiffness.iter_mut().zip([1.0, z]) {
                    sum[0] += z * we * nx * nx;
                    sum[1] += z * we * nx * ny;
                    sum[2] += z * we * ny * ny;
                }
            }
        }
        out
    }

    /// Returns the inverse of ∂(∫ τ g)/∂τ_m, a symmetric positive definite 2 × 2 matrix: xx, xy, yy.
    pub fn inverse(&self) -> [f64; 3] {
        let [xx, xy, yy] = self.stiffness[0];
        let (xx, yy) = (self.fluidity[0] + xx, self.fluidity[0] + yy);
        let determinant = xx * yy - xy * xy;
        [yy / determinant, -xy / determinant, xx / determinant]
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{laws, loads};
    use super::*;

    #[test]
    fn without_sliding_the_upper_half_of_the_film_tells_all() {
        for law in laws() {
            for load in loads() {
                let half = Moments::rolling::<6>(&law, &PRODUCTION_RULE, &load);
                let whole = Moments::plane::<12>(&law, &PRODUCTION_RULE, &load, [0.0; 2]);
                let flat = |m: &Moments| -> Vec<f64> {
                    let slopes = m.slope.iter().flatten().chain(m.stiffness.iter().flatten());
                    m.fluidity.iter().chain(slopes).copied().collect()
                };
                let largest = flat(&whole).iter().fold(0.0f64, |a, b| a.max(b.abs()));
                for (one, other) in flat(&half).into_iter().zip(flat(&whole)) {
                    assert!((one - other).abs() < 1e-13 * largest, "{law:?} {load:?}: {one} against {other}");
                }
            }
        }
    }
}
