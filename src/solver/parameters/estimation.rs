//! Estimation of positive parameters from measured values: nonlinear least squares by the method of Levenberg and
//! Marquardt in the logarithms of the parameters, with standard errors and confidence intervals of the linearised
//! problem. D. W. Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431; G. A. F. Seber, C. J. Wild, Nonlinear Regression,
//! Wiley 1989, ch. 2 and 5.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, Side};
use serde::{Deserialize, Serialize};

/// Estimated parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Parameters with their uncertainty, in the order of the start values.
    pub parameters: Vec<Estimated>,
    /// Standard deviation of the residuals.
    pub deviation: f64,
    /// Number of residuals minus number of parameters.
    pub degrees_of_freedom: usize,
    /// Largest magnitude of the correlation of two parameters; zero for one parameter.
    pub correlation: f64,
    /// Number of accepted steps.
    pub iterations: usize,
}

/// Estimated parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// Value.
    pub value: f64,
    /// Standard error relative to the value.
    pub relative_error: f64,
    /// Ends of the 95 % confidence interval.
    pub interval: (f64, f64),
}

/// Reason why there is no estimate. Parameters are numbered from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum EstimationError<E> {
    /// The model has no residuals at the start values.
    Model(E),
    /// There are not enough measured values.
    TooFew {
        /// Number of values.
        values: usize,
        /// Smallest number.
        least: usize,
    },
    /// The values do not determine this parameter, alone or next to the others.
    Undetermined(usize),
    /// The best value of this parameter lies beyond its range.
    AtItsEnd(usize),
    /// The steps do not converge.
    NotConverged,
}

/// Step of ln θ for derivatives by central differences.
const STEP: f64 = 1e-3;
/// Relative change of the parameters that ends the iteration.
const TOLERANCE: f64 = 1e-7;
const MOST_STEPS: usize = 60;
/// Range of the damping parameter.
const DAMPING: (f64, f64) = (1e-9, 1e9);
/// Smallest eigenvalue of the correlation matrix of the derivatives at which the parameters count as determined.
const LEAST_EIGENVALUE: f64 = 1e-7;
/// Smallest derivative of a residual with respect to ln θ that counts.
const LEAST_SENSITIVITY: f64 = 1e-6;
/// Smallest number of degrees of freedom.
const LEAST_FREEDOM: usize = 3;

/// Estimates parameters from residuals of equal variance. `ends` are the smallest and largest accepted values;
/// `residuals` returns the residuals at given parameters. Parameters at which it fails are avoided.
///
/// # Errors
/// If the residuals do not determine the parameters within their ends.
pub fn estimate<E>(
    start: &[f64],
    ends: &[(f64, f64)],
    mut residuals: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<Estimate, EstimationError<E>> {
    let logs = |(low, high): &(f64, f64)| (low.ln(), high.ln());
    let ends: Vec<(f64, f64)> = ends.iter().map(logs).collect();
    let clamped = |q: f64, (low, high): (f64, f64)| q.clamp(low, high);
    let mut place: Vec<f64> = start.iter().zip(&ends).map(|(value, ends)| clamped(value.ln(), *ends)).collect();
    let mut at = |place: &[f64]| residuals(&place.iter().map(|q| q.exp()).collect::<Vec<f64>>());
    let mut here = at(&place).map_err(EstimationError::Model)?;
    let least = place.len() + LEAST_FREEDOM;
    if here.len() < least {
        return Err(EstimationError::TooFew { values: here.len(), least });
    }
    let (mut damping, mut iterations) = (1e-3, 0);
    loop {
        let slopes = jacobian(&place, &here, &mut at);
        let (normal, gradient) = (gram(&slopes), products(&slopes, &here));
        let mut converged = false;
        loop {
            let damped = Mat::from_fn(place.len(), place.len(), |i, j| {
                let own = normal[(i, j)];
                if i == j { own * (1.0 + damping) + f64::MIN_POSITIVE } else { own }
            });
            let step = PartialPivLu::new(damped.as_ref()).solve(&gradient);
            let trial: Vec<f64> =
                (0..place.len()).map(|i| clamped(place[i] - step[(i, 0)].clamp(-1.0, 1.0), ends[i])).collect();
            let moved = trial.iter().zip(&place).fold(0.0f64, |moved, (a, b)| moved.max((a - b).abs()));
            if moved.is_nan() || moved < TOLERANCE {
                converged = true;
                break;
            }
            match at(&trial) {
                Ok(there) if squares(&there) < squares(&here) => {
                    (place, here) = (trial, there);
                    damping = (0.2 * damping).max(DAMPING.0);
                    break;
                }
                _ => damping *= 4.0,
            }
            if damping > DAMPING.1 {
                converged = true;
                break;
            }
        }
        if converged {
            return uncertainty(&place, &ends, &here, &slopes, iterations);
        }
        iterations += 1;
        if iterations > MOST_STEPS {
            return Err(EstimationError::NotConverged);
        }
    }
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}

/// Returns the derivatives of the residuals with respect to ln θ, one vector for each parameter. Differences are
/// one-sided where the model fails on one side, and zero where it fails on both.
fn jacobian<E>(place: &[f64], here: &[f64], at: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, E>) -> Vec<Vec<f64>> {
    let mut slope = |k: usize| {
        let mut moved = |by: f64| {
            let mut moved = place.to_vec();
            moved[k] += by;
            at(&moved).ok().filter(|there| there.len() == here.len())
        };
        let (before, after) = (moved(-STEP), moved(STEP));
        let width = STEP * f64::from(u8::from(before.is_some()) + u8::from(after.is_some()));
        let ends = [before, after].map(|side| side.unwrap_or_else(|| here.to_vec()));
        let slope = |(a, b): (&f64, &f64)| if width > 0.0 { (b - a) / width } else { 0.0 };
        ends[0].iter().zip(&ends[1]).map(slope).collect()
    };
    (0..place.len()).map(&mut slope).collect()
}

fn gram(slopes: &[Vec<f64>]) -> Mat<f64> {
    let product = |i: usize, j: usize| slopes[i].iter().zip(&slopes[j]).map(|(a, b)| a * b).sum();
    Mat::from_fn(slopes.len(), slopes.len(), product)
}

fn products(slopes: &[Vec<f64>], residuals: &[f64]) -> Mat<f64> {
    Mat::from_fn(slopes.len(), 1, |i, _| slopes[i].iter().zip(residuals).map(|(a, b)| a * b).sum())
}

/// Returns the estimate with its uncertainty from the derivatives at the end of the iteration.
fn uncertainty<E>(
    place: &[f64],
    ends: &[(f64, f64)],
    here: &[f64],
    slopes: &[Vec<f64>],
    iterations: usize,
) -> Result<Estimate, EstimationError<E>> {
    let (count, normal) = (place.len(), gram(slopes));
    let sizes: Vec<f64> = (0..count).map(|k| normal[(k, k)].sqrt()).collect();
    let least = LEAST_SENSITIVITY * (here.len() as f64).sqrt();
    if let Some(flat) = sizes.iter().position(|size| size.is_nan() || *size <= least) {
        return Err(EstimationError::Undetermined(flat));
    }
    if let Some(end) = place.iter().zip(ends).position(|(q, (low, high))| q <= low || q >= high) {
        return Err(EstimationError::AtItsEnd(end));
    }
    let scaled = Mat::from_fn(count, count, |i, j| normal[(i, j)] / (sizes[i] * sizes[j]));
    let eigen = scaled.self_adjoint_eigen(Side::Lower).map_err(|_| EstimationError::NotConverged)?;
    let least = eigen.S()[0];
    if least.is_nan() || least <= LEAST_EIGENVALUE {
        let weak = (0..count).max_by(|a, b| eigen.U()[(*a, 0)].abs().total_cmp(&eigen.U()[(*b, 0)].abs()));
        return Err(EstimationError::Undetermined(weak.unwrap_or(0)));
    }
    let inverse = PartialPivLu::new(scaled.as_ref()).solve(&Mat::<f64>::identity(count, count));
    let degrees_of_freedom = here.len() - count;
    let deviation = (squares(here) / degrees_of_freedom as f64).sqrt();
    let quantile = student_quantile(degrees_of_freedom);
    let parameter = |k: usize| {
        let relative_error = deviation * inverse[(k, k)].sqrt() / sizes[k];
        let half = quantile * relative_error;
        Estimated {
            value: place[k].exp(),
            relative_error,
            interval: ((place[k] - half).exp(), (place[k] + half).exp()),
        }
    };
    let pairs = (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
    let correlation = |(i, j): (usize, usize)| (inverse[(i, j)] / (inverse[(i, i)] * inverse[(j, j)]).sqrt()).abs();
    Ok(Estimate {
        parameters: (0..count).map(parameter).collect(),
        deviation,
        degrees_of_freedom,
        correlation: pairs.map(correlation).fold(0.0, f64::max),
        iterations,
    })
}

/// Returns the 97.5 % quantile of Student's distribution for at least three degrees of freedom: the expansion of Fisher
/// and Cornish, M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 26.7.5. Its error is below 0.2 %.
fn student_quantile(degrees_of_freedom: usize) -> f64 {
    const Z: f64 = 1.959_963_984_540_054;
    let n = degrees_of_freedom as f64;
    let [z3, z5, z7, z9] = [3, 5, 7, 9].map(|power| Z.powi(power));
    let terms = [
        (z3 + Z) / 4.0,
        (5.0 * z5 + 16.0 * z3 + 3.0 * Z) / 96.0,
        (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * Z) / 384.0,
        (79.0 * z9 + 776.0 * z7 + 1482.0 * z5 - 1920.0 * z3 - 945.0 * Z) / 92_160.0,
    ];
    (1..).zip(terms).fold(Z, |sum, (power, term)| sum + term / n.powi(power))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// NIST Statistical Reference Datasets, Misra1a: y = b₁ (1 − exp(−b₂ x)), certified values.
    #[test]
    fn misra1a_gives_the_certified_values() {
        const DATA: [(f64, f64); 14] = [
            (77.6, 10.07),
            (114.9, 14.73),
            (141.1, 17.94),
            (190.8, 23.93),
            (239.9, 29.61),
            (289.0, 35.18),
            (332.8, 40.02),
            (378.4, 44.82),
            (434.8, 50.76),
            (477.3, 55.05),
            (536.8, 61.01),
            (593.1, 66.40),
            (689.1, 75.47),
            (760.0, 81.78),
        ];
        let residuals =
            |b: &[f64]| Ok::<_, Infallible>(DATA.iter().map(|(x, y)| b[0] * (1.0 - (-b[1] * x).exp()) - y).collect());
        for start in [[500.0, 1e-4], [250.0, 5e-4]] {
            let found = estimate(&start, &[(1.0, 1e4), (1e-6, 1.0)], residuals).unwrap();
            let certified = [(2.389_421_291_8e2, 2.707_007_524_1), (5.501_564_318_1e-4, 7.266_868_843_6e-6)];
            for (own, (value, error)) in found.parameters.iter().zip(certified) {
                assert!((own.value / value - 1.0).abs() < 1e-6, "{} {value}", own.value);
                assert!((own.value * own.relative_error / error - 1.0).abs() < 1e-4, "{own:?} {error}");
            }
            assert!((found.deviation / 1.018_787_633_0e-1 - 1.0).abs() < 1e-6);
            assert!(found.degrees_of_freedom == 12 && found.correlation > 0.99, "{found:?}");
        }
    }

    #[test]
    fn quantiles_are_those_of_tables() {
        for (freedom, quantile) in [(3, 3.182), (4, 2.776), (5, 2.571), (10, 2.228), (30, 2.042), (1000, 1.962)] {
            let own = student_quantile(freedom);
            assert!((own / quantile - 1.0).abs() < 2e-3, "{freedom}: {own}");
        }
    }

    #[test]
    fn what_the_values_do_not_determine_is_named() {
        let line = |b: &[f64]| Ok::<_, &str>((1..9).map(|x| b[0] * f64::from(x) - f64::from(x)).collect());
        let ends = [(0.01, 100.0); 2];
        assert_eq!(estimate(&[3.0, 1.0], &ends, line), Err(EstimationError::Undetermined(1)));
        let product = |b: &[f64]| {
            Ok::<_, &str>((1..9).map(|x| b[0] * b[1] * f64::from(x) - f64::from(x) - 0.1 * f64::from(x % 2)).collect())
        };
        assert!(matches!(estimate(&[3.0, 1.0], &ends, product), Err(EstimationError::Undetermined(_))));
        assert_eq!(estimate(&[3.0], &[(2.0, 100.0)], line), Err(EstimationError::AtItsEnd(0)));
        let few = |_: &[f64]| Ok::<_, &str>(vec![1.0; 3]);
        assert_eq!(estimate(&[1.0], &ends[..1], few), Err(EstimationError::TooFew { values: 3, least: 4 }));
        let fails = |_: &[f64]| Err::<Vec<f64>, _>("no solution");
        assert_eq!(estimate(&[1.0], &ends[..1], fails), Err(EstimationError::Model("no solution")));
    }

    #[test]
    fn values_at_which_the_model_fails_are_avoided() {
        let tried = std::cell::Cell::new(0);
        let model = |b: &[f64]| {
            tried.set(tried.get() + 1);
            if b[0] > 4.0 { Err("too large") } else { Ok((1..9).map(|x| (b[0] / 3.9).ln() * f64::from(x)).collect()) }
        };
        let found = estimate(&[0.1], &[(1e-3, 1e3)], model).unwrap();
        assert!((found.parameters[0].value / 3.9 - 1.0).abs() < 1e-6 && tried.get() < 60, "{found:?}");
    }
}
