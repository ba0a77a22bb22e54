//! Superposition of linearised systems, (4.27), and the linear system of a step.

use super::linearisation::LinearFunction;
use super::model::{TpwlModel, TrainedPoint};
use super::space::INPUTS;
use super::weights::{Weight, Weighting};
use crate::solver::reduced::dense::SmallSystem;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, MatRef, Par, unzip, zip};

/// Superposed system g = ḡ + B (y − ȳ) + C (u − ū), and likewise f with E and F, about the barycentre (ȳ, ū) of its
/// points.
pub struct Superposition {
    weighting: Weighting,
    /// Operating points in use.
    pub weights: Vec<Weight>,
    /// ȳ.
    pub state: Vec<f64>,
    /// ū.
    pub input: [f64; INPUTS],
    storage: LinearFunction,
    flux: LinearFunction,
}

/// Computes out += `factor` A x.
fn add_product(a: MatRef<'_, f64>, x: &[f64], factor: f64, out: &mut [f64]) {
    let (out, x) = (ColMut::from_slice_mut(out), ColRef::from_slice(x));
    matmul(out.as_mat_mut(), Accum::Add, a, x.as_mat(), factor, Par::Seq);
}

impl LinearFunction {
    fn zero(len: usize) -> Self {
        Self { value: vec![0.0; len], by_state: Mat::zeros(len, len), by_input: Mat::zeros(len, INPUTS) }
    }

    /// Computes Σ w (value − θ intercept + slope), Σ w of the derivatives, and adds θ (A ȳ + B ū), with A and B the
    /// derivatives by state and input. θ = 1 expands about the points, θ = ½ half about the points and half about the
    /// barycentre.
    fn superpose<'a>(&mut self, (state, input): (&[f64], &[f64]), theta: f64, parts: impl Iterator<Item = Part<'a>>) {
        self.value.fill(0.0);
        for (k, Part { weight, function, intercept, slope, load_difference }) in parts.enumerate() {
            let terms = function.value.iter().zip(intercept).zip(slope);
            for (out, ((value, intercept), slope)) in self.value.iter_mut().zip(terms) {
                *out += weight * (value - theta * intercept + load_difference * slope);
            }
            let derivatives = [(&mut self.by_state, &function.by_state), (&mut self.by_input, &function.by_input)];
            for (sum, part) in derivatives {
                if k == 0 {
                    zip!(sum, part).for_each(|unzip!(sum, part)| *sum = weight * *part);
                } else {
                    zip!(sum, part).for_each(|unzip!(sum, part)| *sum += weight * *part);
                }
            }
        }
        add_product(self.by_state.as_ref(), state, theta, &mut self.value);
        add_product(self.by_input.as_ref(), input, theta, &mut self.value);
    }
}

/// Contribution of one point to one system function.
struct Part<'a> {
    weight: f64,
    function: &'a LinearFunction,
    intercept: &'a [f64],
    slope: &'a [f64],
    load_difference: f64,
}

impl Superposition {
    /// Allocates systems of `len` equations and up to `most` points.
    pub fn new(weighting: Weighting, len: usize, most: usize) -> Self {
        Self {
            weighting,
            weights: Vec::with_capacity(most),
            state: vec![0.0; len],
            input: [0.0; INPUTS],
            storage: LinearFunction::zero(len),
            flux: LinearFunction::zero(len),
        }
    }

    /// Superposes the points in use for a reference load \[N/m\].
    pub fn assemble(&mut self, model: &TpwlModel, load: f64) {
        let Self { weighting, weights, state, input, storage, flux } = self;
        state.fill(0.0);
        input.fill(0.0);
        let points = || weights.iter().map(|w| (w.weight, &model.points[w.point]));
        for (weight, point) in points() {
            state.iter_mut().zip(&point.moment.state).for_each(|(sum, y)| *sum += weight * y);
            input.iter_mut().zip(point.input).for_each(|(sum, u)| *sum += weight * u);
        }
        // The joint barycentre has the reference load itself, so half of the slope remains.
        let (theta, slope) = match weighting {
            Weighting::DualTaylor => (0.5, 0.5),
            Weighting::Dissertation => (1.0, 0.0),
        };
        let about = (state.as_slice(), input.as_slice());
        type Own = for<'a> fn(&'a TrainedPoint) -> (&'a LinearFunction, &'a [f64], &'a [f64]);
        let of_storage: Own = |p| (&p.system.storage, &p.intercepts.storage, &p.load_slope.storage);
        let of_flux: Own = |p| (&p.system.flux, &p.intercepts.flux, &p.load_slope.flux);
        for (sum, own) in [(storage, of_storage), (flux, of_flux)] {
            let parts = points().map(|(weight, point)| {
                let (function, intercept, slopes) = own(point);
                let load_difference = slope * (load - model.sets[point.set].problem.point.load);
                Part { weight, function, intercept, slope: slopes, load_difference }
            });
            sum.superpose(about, theta, parts);
        }
    }

    /// Solves q g(y, u) + `history` = f(y, u) for y and computes g there; q = 0 gives the steady state. Returns false
    /// if the system is singular.
    pub fn solve(
        &self,
        (quotient, history): (f64, [(f64, &[f64]); 2]),
        input: [f64; INPUTS],
        system: &mut SmallSystem,
        (state, storage): (&mut [f64], &mut [f64]),
    ) -> bool {
        let change: [f64; INPUTS] = std::array::from_fn(|k| input[k] - self.input[k]);
        // g and f at (ȳ, u).
        storage.copy_from_slice(&self.storage.value);
        add_product(self.storage.by_input.as_ref(), &change, 1.0, storage);
        system.rhs.copy_from_slice(&self.flux.value);
        add_product(self.flux.by_input.as_ref(), &change, 1.0, &mut system.rhs);
        for ((rhs, g), (near, far)) in system.rhs.iter_mut().zip(&*storage).zip(history[0].1.iter().zip(history[1].1)) {
            *rhs -= quotient * g + history[0].0 * near + history[1].0 * far;
        }
        zip!(&mut system.matrix, &self.storage.by_state, &self.flux.by_state)
            .for_each(|unzip!(m, b, e)| *m = quotient * *b - *e);
        system.solve();
        add_product(self.storage.by_state.as_ref(), &system.rhs, 1.0, storage);
        for ((y, center), step) in state.iter_mut().zip(&self.state).zip(&system.rhs) {
            *y = center + step;
        }
        state.iter().all(|y| y.is_finite())
    }
}
