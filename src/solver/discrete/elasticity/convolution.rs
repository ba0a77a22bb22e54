//! Fast convolution with a kernel that is even along X. Signals are zero-padded to a length with small prime factors.

use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;

/// Failure to build an elastic kernel, with the reason.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the elastic kernel cannot be transformed: {0}")]
pub struct KernelError(String);

/// Forward and inverse transforms of one length.
#[derive(Clone)]
pub(crate) struct Convolution {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl Convolution {
    /// Plans transforms for signals with at least `entries` entries.
    pub fn new(entries: usize) -> Self {
        let length = fft_length(entries);
        let mut planner = RealFftPlanner::new();
        Self { forward: planner.plan_fft_forward(length), inverse: planner.plan_fft_inverse(length) }
    }

    /// Number of entries of a padded signal.
    pub fn len(&self) -> usize {
        self.forward.len()
    }

    /// Number of entries of its spectrum.
    pub fn frequencies(&self) -> usize {
        self.len() / 2 + 1
    }

    /// Number of entries of the work space.
    pub fn work(&self) -> usize {
        self.forward.get_scratch_len().max(self.inverse.get_scratch_len()).max(1)
    }

    /// Returns the spectrum of an even kernel, which is real. `signal` is the circular kernel. The spectrum is scaled
    /// such that a forward and an inverse transform together are the identity.
    ///
    /// # Errors
    /// [`KernelError`] if `signal` does not have the length of the transforms.
    pub fn kernel(&self, signal: &mut [f64]) -> Result<Vec<f64>, KernelError> {
        let scale = self.len() as f64;
        signal.iter_mut().for_each(|value| *value /= scale);
        let (mut spectrum, mut work) = (self.forward.make_output_vec(), self.forward.make_scratch_vec());
        let done = self.forward.process_with_scratch(signal, &mut spectrum, &mut work);
        done.map_err(|refused| KernelError(refused.to_string()))?;
        Ok(spectrum.iter().map(|value| value.re).collect())
    }

    /// Computes the spectrum of a padded signal and overwrites the signal. All slices must have the lengths of this
    /// convolution; otherwise the spectrum is filled with NaN.
    pub fn forward(&self, signal: &mut [f64], spectrum: &mut [Complex64], work: &mut [Complex64]) {
        if self.forward.process_with_scratch(signal, spectrum, work).is_err() {
            spectrum.fill(Complex64::new(f64::NAN, f64::NAN));
        }
    }

    /// Computes the signal of a spectrum and overwrites the spectrum. Lengths as in [`Convolution::forward`].
    pub fn inverse(&self, spectrum: &mut [Complex64], signal: &mut [f64], work: &mut [Complex64]) {
        // The first and last bin of a real signal's spectrum are real. Rounding must not make the inverse refuse them.
        if let [first, .., last] = spectrum {
            (first.im, last.im) = (0.0, 0.0);
        }
        if self.inverse.process_with_scratch(spectrum, signal, work).is_err() {
            signal.fill(f64::NAN);
        }
    }
}

/// Returns the smallest even length ≥ n whose prime factors are 2, 3 and 5.
fn fft_length(n: usize) -> usize {
    let smooth = |mut m: usize| {
        for p in [2, 3, 5] {
            while m.is_multiple_of(p) {
                m /= p;
            }
        }
        m == 1
    };
    (n..).find(|&m| m.is_multiple_of(2) && smooth(m)).unwrap_or(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn untransformable_kernels_are_errors() {
        let convolution = Convolution::new(100);
        assert_eq!((convolution.len(), convolution.frequencies()), (100, 51));
        assert!(convolution.kernel(&mut [1.0; 100]).is_ok());
        let refused = convolution.kernel(&mut [1.0; 99]).unwrap_err().to_string();
        assert!(refused.starts_with("the elastic kernel cannot be transformed: "), "{refused}");
        let (mut spectrum, mut work) = (vec![Complex64::default(); 51], vec![Complex64::default(); convolution.work()]);
        convolution.forward(&mut [1.0; 99], &mut spectrum, &mut work);
        assert!(spectrum.iter().all(|value| value.re.is_nan()));
    }
}
