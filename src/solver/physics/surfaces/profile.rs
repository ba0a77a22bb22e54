//! Measured or generated height profile z(x) of a surface: levelling, statistics, and means over the cells of a grid.

use serde::{Deserialize, Serialize};

/// Height profile, linear between its points.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightProfile {
    points: Vec<[f64; 2]>,
    /// Integral of the height up to each point.
    integral: Vec<f64>,
}

/// Refusal of a profile: a sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct ProfileError(String);

/// Statistics of a levelled profile (ISO 21920-2, without filters). Heights have the unit of the profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProfileStatistics {
    /// Root mean square height Rq.
    pub rq: f64,
    /// Mean absolute height Ra.
    pub ra: f64,
    /// Height between the lowest and the highest point, Rt.
    pub rt: f64,
    /// Skewness Rsk; negative for a plateau with valleys.
    pub skewness: f64,
    /// Kurtosis Rku; 3 for Gaussian heights.
    pub kurtosis: f64,
    /// Root mean square slope Rdq.
    pub slope: f64,
}

impl HeightProfile {
    /// Creates a profile from at least two points (x, z) with increasing x.
    ///
    /// # Errors
    /// [`ProfileError`] if there are fewer points, or if x does not increase.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, ProfileError> {
        if points.len() < 2 || !points.is_sorted_by(|[a, _], [b, _]| a < b) {
            return Err(ProfileError("a profile needs at least two points, with increasing x".to_owned()));
        }
        let mut integral = Vec::with_capacity(points.len());
        let mut sum = 0.0;
        for (k, [x, z]) in points.iter().enumerate() {
            if let Some([before, height]) = k.checked_sub(1).and_then(|k| points.get(k)) {
                sum += 0.5 * (x - before) * (z + height);
            }
            integral.push(sum);
        }
        Ok(Self { points, integral })
    }

    /// Returns the first and the last x.
    pub fn ends(&self) -> (f64, f64) {
        let end = |point: Option<&[f64; 2]>| point.map_or(f64::NAN, |[x, _]| *x);
        (end(self.points.first()), end(self.points.last()))
    }

    /// Returns the part between two abscissae: the points there. The whole profile if there are fewer than two.
    pub fn between(&self, from: f64, to: f64) -> Self {
        let inside = |[x, _]: &&[f64; 2]| (from..=to).contains(x);
        Self::new(self.points.iter().filter(inside).copied().collect()).unwrap_or_else(|_| self.clone())
    }

    /// Returns the points with the weights of the trapezoidal rule.
    fn weighted(&self) -> impl Iterator<Item = ([f64; 2], f64)> + Clone + '_ {
        let x = |k: usize| self.points.get(k).map(|[x, _]| *x);
        self.points.iter().enumerate().map(move |(k, point)| {
            let [before, after] = [k.checked_sub(1).and_then(x), x(k + 1)].map(|other| other.unwrap_or(point[0]));
            (*point, 0.5 * (after - before))
        })
    }

    /// Returns the profile without its least-squares line: mean height and slope are zero.
    pub fn levelled(&self) -> Self {
        let sum = |of: &dyn Fn([f64; 2]) -> f64| self.weighted().map(|(point, weight)| weight * of(point)).sum::<f64>();
        let length = sum(&|_| 1.0);
        let middle = [sum(&|[x, _]| x) / length, sum(&|[_, z]| z) / length];
        let spread = sum(&|[x, _]| (x - middle[0]).powi(2));
        let slope = sum(&|[x, z]| (x - middle[0]) * (z - middle[1])) / spread;
        let level = |[x, z]: &[f64; 2]| [*x, z - middle[1] - slope * (x - middle[0])];
        let points: Vec<_> = self.points.iter().map(level).collect();
        Self::new(points).unwrap_or_else(|_| self.clone())
    }

    /// Returns the statistics of the levelled profile.
    pub fn statistics(&self) -> ProfileStatistics {
        let levelled = self.levelled();
        let mean = |of: &dyn Fn(f64) -> f64| {
            let sums = levelled.weighted().map(|([_, z], weight)| [weight * of(z), weight]);
            let [sum, length] = sums.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
            sum / length
        };
        let rq = mean(&|z| z * z).sqrt();
        let heights = || levelled.points.iter().map(|[_, z]| *z);
        let steps = levelled.points.iter().zip(levelled.points.iter().skip(1));
        let rises = steps.map(|([a, z], [b, w])| (w - z).powi(2) / (b - a)).sum::<f64>();
        let (from, to) = self.ends();
        ProfileStatistics {
            rq,
            ra: mean(&f64::abs),
            rt: heights().fold(f64::MIN, f64::max) - heights().fold(f64::MAX, f64::min),
            skewness: mean(&|z| z.powi(3)) / rq.powi(3),
            kurtosis: mean(&|z| z.powi(4)) / rq.powi(4),
            slope: (rises / (to - from)).sqrt(),
        }
    }

    /// Returns the mean height over each cell around ascending abscissae. Outside the profile the height is zero.
    pub fn cell_means(&self, x: &[f64]) -> Vec<f64> {
        let edge = |k: usize| Some(0.5 * (x.get(k)? + x.get(k + 1)?));
        let cell = |(k, &own): (usize, &f64)| {
            let before = k.checked_sub(1).and_then(edge).unwrap_or(own);
            let after = edge(k).unwrap_or(own);
            if after > before { (self.integral_to(after) - self.integral_to(before)) / (after - before) } else { 0.0 }
        };
        x.iter().enumerate().map(cell).collect()
    }

    /// Returns the root mean square height about the mean, without levelling.
    pub fn rms(&self) -> f64 {
        let sums = self.weighted().map(|([_, z], weight)| [weight, weight * z, weight * z * z]);
        let [length, sum, square] = sums.fold([0.0; 3], |a, b| std::array::from_fn(|k| a[k] + b[k]));
        (square / length - (sum / length).powi(2)).max(0.0).sqrt()
    }

    /// Returns the integral of the height up to x.
    fn integral_to(&self, x: f64) -> f64 {
        let (first, last) = self.ends();
        let x = x.clamp(first, last);
        let next = self.points.partition_point(|[place, _]| *place <= x);
        let at = |k: usize| Some((self.points.get(k)?, self.integral.get(k)?));
        match (next.checked_sub(1).and_then(at), at(next)) {
            (Some(([a, z], sum)), Some(([b, w], _))) => {
                let here = z + (w - z) * (x - a) / (b - a);
                sum + 0.5 * (x - a) * (z + here)
            }
            (Some((_, sum)), None) => *sum,
            (None, _) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, SQRT_2, TAU};

    fn cosine(amplitude: f64, periods: f64, tilt: f64) -> HeightProfile {
        let x = (0..=20_000).map(|k| f64::from(k) / 20_000.0);
        HeightProfile::new(x.map(|x| [x, amplitude * (TAU * periods * x).cos() + tilt * x + 3.0]).collect()).unwrap()
    }

    #[test]
    fn a_tilted_cosine_has_the_statistics_of_its_formula() {
        let seen = cosine(0.3, 200.0, 2.0).statistics();
        let close =
            |seen: f64, wanted: f64| assert!((seen - wanted).abs() < 1e-3 * wanted.abs().max(1.0), "{seen} {wanted}");
        close(seen.rq / 0.3, 1.0 / SQRT_2);
        close(seen.ra / 0.3, 2.0 / PI);
        close(seen.rt / 0.3, 2.0);
        close(seen.skewness, 0.0);
        close(seen.kurtosis, 1.5);
        // 100 points per period: the chord is flatter than the curve by (sin ϕ)/ϕ with ϕ = π/100.
        close(seen.slope / (0.3 * TAU * 200.0), 1.0 / SQRT_2);
    }

    #[test]
    fn cell_means_are_integrals_of_the_profile() {
        let profile = HeightProfile::new(vec![[0.0, 0.0], [1.0, 2.0], [3.0, 0.0]]).unwrap();
        let x = [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0];
        let means = profile.cell_means(&x);
        let wanted = [0.0, 0.25, 1.625, 1.0, 0.125, 0.0];
        assert!(means.iter().zip(wanted).all(|(seen, wanted)| (seen - wanted).abs() < 1e-15), "{means:?}");
        // Waves much shorter than the cells vanish; long ones remain.
        let cells: Vec<f64> = (0..=100).map(|k| 0.01 * f64::from(k)).collect();
        let rms = |periods: f64| {
            let means = cosine(1.0, periods, 0.0).levelled().cell_means(&cells);
            (means.iter().map(|z| z * z).sum::<f64>() / 101.0).sqrt() * SQRT_2
        };
        assert!(rms(1000.0) < 0.05 && (rms(5.0) - 1.0).abs() < 0.02, "{} {}", rms(1000.0), rms(5.0));
        assert!((cosine(1.0, 40.0, 0.0).between(0.0, 0.5).rms() * SQRT_2 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn profiles_need_two_points_in_order() {
        assert!(HeightProfile::new(vec![[0.0, 1.0]]).is_err());
        assert!(HeightProfile::new(vec![[0.0, 1.0], [0.0, 2.0]]).is_err());
        assert!(HeightProfile::new(vec![[0.0, 1.0], [f64::NAN, 2.0]]).is_err());
    }
}
