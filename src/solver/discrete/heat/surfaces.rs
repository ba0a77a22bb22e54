//! Surface temperatures under the heat fluxes q̄_i into the bodies: θ_i(X) = D_i ∫ q̄_i(S)/√(X − S) dS of a moving
//! half-space (Carslaw & Jaeger 1959, 10.7). Product integration of fluxes that are linear between stations.

/// Weights of ∫ q(S)/√(X − S) dS at every station, for given abscissae of the stations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingSource {
    /// Row i has i + 1 weights, for the stations 0…i.
    weights: Vec<f64>,
}

impl MovingSource {
    /// Computes the weights for increasing abscissae.
    pub fn new(x: &[f64]) -> Self {
        let mut weights = vec![0.0; x.len() * (x.len() + 1) / 2];
        for i in 1..x.len() {
            let row = &mut weights[i * (i + 1) / 2..][..=i];
            let mut far = x[i] - x[0];
            let mut far_root = far.sqrt();
            for k in 0..i {
                let near = x[i] - x[k + 1];
                let near_root = near.sqrt();
                let width = far - near;
                let whole = 2.0 * (far_root - near_root);
                // ∫ (S − x_k)/√(X − S) dS over the interval.
                let first = far * whole - 2.0 / 3.0 * (far * far_root - near * near_root);
                row[k] += whole - first / width;
                row[k + 1] += first / width;
                (far, far_root) = (near, near_root);
            }
        }
        Self { weights }
    }

    /// Returns the integral at station i without the contribution of its own flux, and the weight of that flux.
    #[inline]
    pub fn before(&self, i: usize, flux: &[f64]) -> (f64, f64) {
        let row = &self.weights[i * (i + 1) / 2..][..=i];
        let sum = row[..i].iter().zip(flux).map(|(weight, flux)| weight * flux).sum();
        (sum, row[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::bodies::Material;

    fn integral(source: &MovingSource, flux: &[f64], i: usize) -> f64 {
        let (before, own) = source.before(i, flux);
        before + own * flux[i]
    }

    #[test]
    fn constant_and_linear_fluxes_are_integrated_exactly() {
        let x: Vec<f64> = (0..60).map(|k| -3.0 + 0.03 * f64::from(k) + 1e-3 * f64::from(k).powi(2)).collect();
        let source = MovingSource::new(&x);
        let (constant, linear) = (vec![1.0; 60], x.iter().map(|x| x + 3.0).collect::<Vec<_>>());
        for i in [1, 2, 17, 59] {
            let reach = x[i] - x[0];
            assert!((integral(&source, &constant, i) / (2.0 * reach.sqrt()) - 1.0).abs() < 1e-12);
            assert!((integral(&source, &linear, i) / (4.0 / 3.0 * reach.powf(1.5)) - 1.0).abs() < 1e-12);
        }
    }

    /// Blok 1937: a source of uniform strength q over 2b on a fast body raises its surface temperature by 2q/√(πρck)
    /// √(2b/u) at the trailing edge.
    #[test]
    fn a_uniform_source_makes_bloks_flash_temperature() {
        let (q, half, speed): (f64, f64, f64) = (3e8, 1.5e-4, 4.0);
        let per_flux = std::f64::consts::PI.sqrt() * Material::STEEL.heat.effusivity();
        let blok = 2.0 * q * (2.0 * half / speed).sqrt() / per_flux;
        let x: Vec<f64> = (0..=400).map(|k| -half + 2.0 * half * f64::from(k) / 400.0).collect();
        let rise = integral(&MovingSource::new(&x), &vec![q; x.len()], 400) / (per_flux * speed.sqrt());
        assert!((rise / blok - 1.0).abs() < 1e-12, "{rise} {blok}");
    }
}
