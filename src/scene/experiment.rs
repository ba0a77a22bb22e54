//! What a study is about: the facts of its scene, without the question itself.

use super::answer::Request;
use super::at::At;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, Sliding};

/// The contact of a scene, and how it is solved in full.
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
    /// The model that [`Grid::Model`] means.
    pub grid_model: ModelSource,
    /// Names of the values that are expected.
    pub expected: Vec<String>,
}

impl Experiment {
    /// The operating point in SI units, without sliding.
    ///
    /// # Errors
    /// When it is outside any sense, or more is fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// The same as something to be solved in full, with its sliding.
    ///
    /// # Errors
    /// As [`point`](Self::point).
    pub fn request(&self) -> Result<Request, ContactError> {
        Ok(self.request_at(OperatingPoint { sliding: self.sliding, ..self.point()? }))
    }

    /// Another contact of the same lubricant on the same grid.
    pub fn request_at(&self, point: OperatingPoint) -> Request {
        Request {
            point,
            lubricant: self.lubricant,
            grid: self.grid,
            grid_model: self.grid_model.clone(),
            method: Method::Full,
        }
    }
}
