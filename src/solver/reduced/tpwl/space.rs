//! Reduced space of a transient contact: its basis, and conversion between fields and reduced states.

use super::grid::SpaceGrid;
use super::linearisation::PENALTY_SLOPE;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid, add_gap};
use crate::solver::discrete::reynolds::PENALTY;
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
    pub grid: SpaceGrid,
    /// Modes V, one per column over the node array, Vᵀ W V = I.
    #[serde(with = "matrix_values")]
    pub pressure: Mat<f64>,
    /// Deformation K V of the modes.
    #[serde(with = "matrix_values")]
    pub deformation: Mat<f64>,
    /// wᵀ V: load carried by each mode.
    pub load: Vec<f64>,
    /// Test functions of the full system's rows: rows × modes. For a line contact V with a weight for each row, see
    /// `row_sizes::row_weights`; for a circular contact the adjoints of the modes.
    #[serde(with = "matrix_values")]
    pub test: Mat<f64>,
    /// Penalty factor γ̄ of the trained states.
    pub penalty: f64,
    /// Slope of the penalty in the cavitated region.
    pub penalty_slope: f64,
}

impl ReducedSpace {
    /// Creates the space of a basis with its test functions, for states with a penalty factor, and the slope of the
    /// penalty in the linearised systems.
    pub fn new(grid: SpaceGrid, basis: &PodBasis, test: Mat<f64>, [penalty, penalty_slope]: [f64; 2]) -> Self {
        let modes = basis.modes.ncols().min(test.ncols());
        let pressure = basis.modes.get(.., ..modes).to_owned();
        let mut deformation = Mat::zeros(grid.len(), modes);
        let (mut column, mut bent) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        for k in 0..modes {
            column.iter_mut().enumerate().for_each(|(i, p)| *p = pressure[(i, k)]);
            grid.deform(&column, &mut bent);
            bent.iter().enumerate().for_each(|(i, d)| deformation[(i, k)] = *d);
        }
        let load = |k: usize| grid.weights().iter().enumerate().map(|(i, w)| w * pressure[(i, k)]).sum();
        let load = (0..modes).map(load).collect();
        Self { grid, pressure, deformation, load, test, penalty, penalty_slope }
    }

    /// Creates the space of a line contact from the first `modes` modes of a basis, with one weight per row of the full
    /// system.
    pub fn of_line(grid: LineGrid, basis: &PodBasis, modes: usize, row_weights: &[f64]) -> Self {
        let modes = modes.clamp(1, basis.modes.ncols());
        let test =
            Mat::from_fn(row_weights.len(), modes, |row, k| row_weights[row] * basis.modes[(row + FIRST_UNKNOWN, k)]);
        Self::new(SpaceGrid::Line(grid), basis, test, [PENALTY, PENALTY_SLOPE])
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
            column.iter().zip(self.grid.weights()).zip(&state.pressure).map(|((v, w), p)| v * w * p).sum()
        };
        (0..self.modes()).map(weighted).chain([state.h_0]).collect()
    }

    /// Returns the film thickness for pressures at all nodes.
    pub fn film(&self, pressure: &[f64], h_0: f64, input: Input) -> Vec<f64> {
        let mut film = vec![0.0; pressure.len()];
        self.grid.deform(pressure, &mut film);
        add_shape(&mut film, &self.grid, h_0, input);
        film
    }

    /// Computes P and H of a reduced state at all nodes.
    pub fn fields(&self, state: &[f64], input: Input, pressure: &mut [f64], film: &mut [f64]) {
        let modes = self.modes();
        dense::times(self.pressure.as_ref(), &state[..modes], pressure);
        dense::times(self.deformation.as_ref(), &state[..modes], film);
        add_shape(film, &self.grid, state[modes], input);
    }
}

/// Adds H₀ + X²/(2R̄) + Y²/2 to a deformation.
fn add_shape(film: &mut [f64], grid: &SpaceGrid, h_0: f64, input: Input) {
    add_gap(film, grid.abscissae(), h_0, 1.0 / input.radius);
}

/// Returns true if two contacts differ only in their load.
pub fn same_but_load(a: &OperatingPoint, b: &OperatingPoint) -> bool {
    OperatingPoint { load: b.load, ..*a } == *b
}
