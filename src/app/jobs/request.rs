//! What is asked of the worker, and what comes back.

use crate::engine::Store;
use crate::solver::discrete::grid::{ContactGrid, ContactGridError, ContactGridSpec, GridSpec, PointGridSpec};
use crate::solver::full::Solution;
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// What a result belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// The operating point.
    pub point: OperatingPoint,
    /// The laws.
    pub lubricant: Lubricant,
}

impl Key {
    /// Whether pressure and film are the same: a limiting stress cuts traction only, and a film that does not thin under shear does not feel
    /// the sliding.
    pub fn has_film_of(&self, other: &Self) -> bool {
        let film = |key: &Self| {
            let (mut point, law) = (key.point, key.lubricant.shear);
            let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(law.plateau());
            if law == ShearLaw::Newtonian || plateau == 1.0 {
                point.sliding.slide_to_roll_ratio = 0.0;
            }
            (point, key.lubricant.of_the_film())
        };
        film(self) == film(other)
    }
}

/// What a full solve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobKind {
    /// The live picture where no reduced model serves.
    Live,
    /// The same contact on the grid that was chosen, after a live picture on a quick one.
    Refine,
    /// The check of a picture.
    Verify,
    /// The same contact on a second grid, to estimate what the first one costs.
    Estimate,
}

impl JobKind {
    /// How many kinds there are.
    pub const COUNT: usize = Self::Estimate as usize + 1;

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Live => "Full solve for the picture",
            Self::Refine => "Full solve on the chosen grid",
            Self::Verify => "Verification by a full solve",
            Self::Estimate => "Full solve on a second grid",
        }
    }
}

/// The grid of a solve: one that exists, or one to build.
#[derive(Clone, Debug)]
pub enum GridChoice {
    /// A reduced model's own grid.
    Existing(ContactGrid),
    /// A specification.
    Spec(ContactGridSpec),
}

impl GridChoice {
    /// The grid of the window of a model that serves a contact; without a model the chosen one of a point contact, or the explorer's.
    pub fn of(model: Option<&ReducedModel>, plane: Option<PointGridSpec>, moes: Moes) -> Self {
        match (model.and_then(|model| model.windows.get(model.window_for(moes))), plane) {
            (Some(window), _) => Self::Existing(window.grid.clone()),
            (None, None) => Self::Spec(ContactGridSpec::Line(GridSpec::EXPLORER)),
            (None, Some(plane)) => Self::Spec(ContactGridSpec::Point(plane)),
        }
    }

    /// The grid itself.
    ///
    /// # Errors
    /// When the specification is refused.
    pub fn with(&self, store: &Store) -> Result<ContactGrid, ContactGridError> {
        match self {
            Self::Existing(grid) => Ok(grid.clone()),
            Self::Spec(spec) => store.grid(*spec),
        }
    }
}

/// A full solve that is wanted.
#[derive(Clone)]
pub struct Request {
    /// What for.
    pub kind: JobKind,
    /// What to solve.
    pub key: Key,
    /// On which grid.
    pub grid: GridChoice,
    /// A solution to start from.
    pub start: Option<Arc<Solution>>,
}

/// What comes back.
pub enum Outcome {
    /// A solution (it says itself whether it converged) and the seconds of the solve alone.
    Solved(Box<Solution>, f64),
    /// A sentence why there is none.
    Failed(String),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::SQUALANE_PIP;
    use crate::solver::physics::lubricant::{LimitingStress, Sliding};

    #[test]
    fn sliding_changes_the_film_only_where_it_thins() {
        let slid = |lubricant, srr, npr| {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr };
            Key { point: OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 }, lubricant }
        };
        let oil = Lubricant::default();
        assert!(slid(oil, 0.0, None).has_film_of(&slid(oil, 0.7, None)));
        assert!(!slid(SQUALANE_PIP, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(slid(SQUALANE_PIP, 0.0, Some(1.0)).has_film_of(&slid(SQUALANE_PIP, 0.7, Some(1.0))));
        let limited = Lubricant { limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.0 }), ..SQUALANE_PIP };
        assert!(slid(limited, 0.7, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(!slid(oil, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.0, None)));
    }
}
