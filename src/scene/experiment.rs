//! Contact and solver settings of a scene, without its study.

use super::answer::Request;
use super::at::At;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint};
use crate::solver::physics::engineering::Extent;
use crate::solver::physics::lubricant::{Lubricant, Sliding};

/// Contact of a scene, and how it is solved in full.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// Line or point contact.
    pub contact: ContactKind,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// The operating point.
    pub at: At,
    /// Sliding and plateau ratio.
    pub sliding: Sliding,
    /// Grid of full solutions.
    pub grid: Grid,
    /// Reduced model whose grid [`Grid::Model`] refers to.
    pub grid_model: ModelSource,
    /// Length of a line contact \[m\].
    pub length_m: Option<f64>,
    /// Names of the expected values.
    pub expected: Vec<String>,
}

impl Experiment {
    /// Returns the operating point in SI units, without sliding.
    ///
    /// # Errors
    /// If a quantity is out of range, or if more quantities are fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// Returns the request that solves the contact in full, with its sliding.
    ///
    /// # Errors
    /// As [`point`](Self::point).
    pub fn request(&self) -> Result<Request, ContactError> {
        Ok(self.request_at(OperatingPoint { sliding: self.sliding, ..self.point()? }))
    }

    /// Returns the request for another contact with the same lubricant and grid.
    pub fn request_at(&self, point: OperatingPoint) -> Request {
        Request {
            point,
            lubricant: self.lubricant,
            grid: self.grid,
            grid_model: self.grid_model.clone(),
            method: Method::Full,
            extent: Extent { length_m: self.length_m, ..Extent::default() },
        }
    }
}
