//! Reduced space of a transient contact: its basis, and conversion between fields and reduced states.

use crate::solver::discrete::elasticity::Scratch;
use crate::solver::discrete::grid::LineGrid;
use crate::solver::full::transient::{Input, State};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{PodBasis, dense, matrix_values};
use faer::Mat;
use serde::{Deserialize, Serialize};

/// Number of entries of the input vector.
pub const INPUTS: usize = 3;

/// Returns the input vector (1/R̄, ū, w̄) of the linearised systems. It contains the curvature instead of the radius
/// because the film thickness is linear in the curvature.
pub fn input_vector(input: Input) -> [f64; INPUTS] {
    [1.0 / input.radius, input.speed, input.load]
}

/// Pressure basis on a grid with all linear parts condensed. The reduced state is ỹ = (p̃, H₀), with the pressure
/// coefficients p̃ and the rigid-body separation H₀, the film thickness H₀ + X²/(2R̄) + K V p̃.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ReducedSpace {
    /// Grid of the fields.
    pub grid: LineGrid,
    /// Modes V, one per column over the node array, Vᵀ W V = I.
    #[serde(with = "matrix_values")]
    pub pressure: Mat<f64>,
    /// Deformation K V of the modes.
    #[serde(with = "matrix_values")]
    pub deformation: Mat<f64>,
    /// wᵀ V: load carried by each mode.
    pub load: Vec<f64>,
    /// Weight of each row of the full system when tested with Vᵀ, see `row_sizes::row_weights`.
    pub row_weights: Vec<f64>,
}

impl ReducedSpace {
    /// Creates the space of the first `modes` modes of a basis, with one weight per row of the full system.
    pub fn new(grid: LineGrid, basis: &PodBasis, modes: usize, row_weights: Vec<f64>) -> Self {
        let modes = modes.clamp(1, basis.modes.ncols());
        let pressure = basis.modes.get(.., ..modes).to_owned();
        let mut deformation = Mat::zeros(grid.len(), modes);
        let (mut column, mut bent, mut fft) = (vec![0.0; grid.len()], vec![0.0; grid.len()], Scratch::default());
        for k in 0..modes {
            column.iter_mut().enumerate().for_each(|(i, p)| *p = pressure[(i, k)]);
            grid.deform(&column, &mut bent, &mut fft);
            bent.iter().enumerate().for_each(|(i, d)| deformation[(i, k)] = *d);
        }
        let load =
            (0..modes).map(|k| grid.weights.iter().enumerate().map(|(i, w)| w * pressure[(i, k)]).sum()).collect();
        Self { grid, pressure, deformation, load, row_weights }
    }

    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.pressure.ncols()
    }

    /// Number of entries of a reduced state.
    pub fn len(&self) -> usize {
        self.modes() + 1
    }

    /// Always false: there is at least one mode.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Returns the reduced state nearest to the fields: Vᵀ W P and their H₀.
    pub fn project(&self, state: &State) -> Vec<f64> {
        let weighted = |k: usize| -> f64 {
            let column = self.pressure.col(k);
            column.iter().zip(&self.grid.weights).zip(&state.pressure).map(|((v, w), p)| v * w * p).sum()
        };
        (0..self.modes()).map(weighted).chain([state.h_0]).collect()
    }

    /// Returns the film thickness for pressures at all nodes.
    pub fn film(&self, pressure: &[f64], h_0: f64, input: Input) -> Vec<f64> {
        let mut film = vec![0.0; pressure.len()];
        self.grid.deform(pressure, &mut film, &mut Scratch::default());
        add_shape(&mut film, &self.grid.x, h_0, input);
        film
    }

    /// Computes P and H of a reduced state at all nodes.
    pub fn fields(&self, state: &[f64], input: Input, pressure: &mut [f64], film: &mut [f64]) {
        let modes = self.modes();
        dense::times(self.pressure.as_ref(), &state[..modes], pressure);
        dense::times(self.deformation.as_ref(), &state[..modes], film);
        add_shape(film, &self.grid.x, state[modes], input);
    }
}

/// Adds H₀ + X²/(2R̄) to a deformation.
fn add_shape(film: &mut [f64], x: &[f64], h_0: f64, input: Input) {
    let curvature = 1.0 / input.radius;
    for (h, x) in film.iter_mut().zip(x) {
        *h += h_0 + 0.5 * curvature * x * x;
    }
}

/// Returns true if two contacts differ only in their load.
pub fn same_but_load(a: &OperatingPoint, b: &OperatingPoint) -> bool {
    OperatingPoint { load: b.load, ..*a } == *b
}
