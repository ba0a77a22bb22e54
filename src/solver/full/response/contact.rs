//! Linear response of either kind of contact.

use super::derivative::TimeDerivative;
use super::dynamics::{Dynamics, Stiffness};
use super::linear::{LinearResponse, ResponseError};
use super::wave::WaveResponse;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::discrete::space::{LineSpace, PlaneSpace};
use crate::solver::full::{Solution, SolveError};

/// Linear response of a line or point contact.
pub enum ContactResponse {
    /// Response of a line contact.
    Line(LinearResponse<LineSpace>),
    /// Response of a point contact.
    Point(LinearResponse<PlaneSpace>),
}

impl ContactResponse {
    /// Creates the linearised system of a steady solution, on the grid of the solution.
    ///
    /// # Errors
    /// If the solution has not converged, if the contact is not supported, or if its grid cannot be built.
    pub fn of(solution: &Solution) -> Result<Self, ResponseError> {
        Ok(match solution.mesh.spec.build().map_err(SolveError::from)? {
            ContactGrid::Line(grid) => Self::Line(LinearResponse::new(&grid, solution)?),
            ContactGrid::Point(grid) => Self::Point(LinearResponse::new(&grid, solution)?),
        })
    }

    /// Computes the response to a wavy surface, see [`LinearResponse::wave`].
    ///
    /// # Errors
    /// If the linear solve stalls.
    pub fn wave(
        &mut self,
        wavelength: f64,
        speed: f64,
        derivative: TimeDerivative,
    ) -> Result<WaveResponse, ResponseError> {
        match self {
            Self::Line(response) => response.wave(wavelength, speed, derivative),
            Self::Point(response) => response.wave(wavelength, speed, derivative),
        }
    }

    /// Computes dimensionless stiffness and damping, see [`LinearResponse::stiffness`].
    ///
    /// # Errors
    /// If the linear solve stalls.
    pub fn stiffness(&mut self, omega: f64) -> Result<Stiffness, ResponseError> {
        match self {
            Self::Line(response) => response.stiffness(omega),
            Self::Point(response) => response.stiffness(omega),
        }
    }

    /// Computes stiffness and damping at a frequency in Hz, see [`LinearResponse::dynamics`].
    ///
    /// # Errors
    /// If the linear solve stalls.
    pub fn dynamics(&mut self, frequency_hz: f64) -> Result<Dynamics, ResponseError> {
        match self {
            Self::Line(response) => response.dynamics(frequency_hz),
            Self::Point(response) => response.dynamics(frequency_hz),
        }
    }
}
