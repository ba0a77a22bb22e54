//! The grid of full solutions as a scene writes it.

use super::check::{Checked, count, number, refuse};
use crate::solver::discrete::grid::{
    GridError, GridSpec, LONGEST_INLET, LONGEST_OUTLET, MAX_GRADED_NODES, PointGridSpec,
};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use serde::{Deserialize, Serialize};

/// Grid of full solutions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub enum Grid {
    /// Equidistant nodes, both ends counted; the dissertation's are `Uniform(dx: 0.005, domain: (-4.0, 2.0))`.
    Uniform {
        /// Spacing ΔX.
        dx: f64,
        /// Inlet and outlet.
        domain: (f64, f64),
    },
    /// The dissertation's uniform grid where it does for the contact; elsewhere a longer or finer one. What `solve` takes
    /// where it is not told otherwise.
    Usual,
    /// The explorer's graded grid: along X for a line, across for a point contact; longer or finer where the contact
    /// wants that.
    #[default]
    Graded,
    /// A graded grid of one's own.
    GradedNodes {
        /// Number of nodes, both ends counted.
        nodes: usize,
        /// Inlet and outlet in the reference coordinate ξ.
        domain: (f64, f64),
        /// Whether the pressure spike is mapped to ξ = 1.
        registered: bool,
    },
    /// Nodes on the half Y ≤ 0 of a point contact; the dissertation's are
    /// `Plane(dx: 0.02, dy: 0.05, domain: (-4.0, 2.0, -2.0))`.
    Plane(PointGridSpec),
    /// The grid of the reduced model in the study (of the embedded one where there is none), so that both can be
    /// compared.
    Model,
}

impl From<GridSpec> for Grid {
    fn from(spec: GridSpec) -> Self {
        match spec {
            GridSpec::Uniform { dx, domain } => Self::Uniform { dx, domain },
            GridSpec::Graded { nodes, domain, registered } => Self::GradedNodes { nodes, domain, registered },
            GridSpec::Plane(spec) => Self::Plane(spec),
            // Which one that is, the contact decides.
            GridSpec::Following { .. } => Self::Graded,
        }
    }
}

impl Grid {
    /// The dissertation's grid: 1201 nodes from −4 to 2.
    pub const DISSERTATION: Self = Self::Uniform { dx: 0.005, domain: (-4.0, 2.0) };

    /// The same for one contact: [`Grid::Usual`] becomes the grid that does for it.
    ///
    /// # Errors
    /// When none of the program's own does.
    pub fn for_contact(self, point: &OperatingPoint) -> Result<Self, GridError> {
        match (self, point.kind) {
            (Self::Usual, ContactKind::Point) => PointGridSpec::DISSERTATION.for_contact(point).map(Self::Plane),
            (Self::Usual, ContactKind::Line) if GridSpec::DISSERTATION.does(point.moes()) => Ok(Self::DISSERTATION),
            (Self::Usual, ContactKind::Line) => GridSpec::explorer_for(point).map(|_| Self::Graded),
            _ => Ok(self),
        }
    }

    /// The solver's specification for a point contact; `None` where this is no grid of one.
    pub fn point_spec(&self) -> Option<PointGridSpec> {
        match *self {
            Self::Plane(spec) => Some(spec),
            Self::Graded => Some(PointGridSpec::EXPLORER),
            Self::Usual | Self::Uniform { .. } | Self::GradedNodes { .. } | Self::Model => None,
        }
    }

    /// The solver's specification for a line contact; `None` where a reduced model's grid is wanted, or one of a point
    /// contact.
    pub fn spec(&self) -> Option<GridSpec> {
        match *self {
            Self::Uniform { dx, domain } => Some(GridSpec::Uniform { dx, domain }),
            Self::Graded => Some(GridSpec::EXPLORER),
            Self::GradedNodes { nodes, domain, registered } => Some(GridSpec::Graded { nodes, domain, registered }),
            Self::Usual | Self::Model | Self::Plane(_) => None,
        }
    }

    /// The word that stands for it in results.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Usual | Self::Uniform { .. } => "uniform",
            Self::Plane(spec) if spec.refinement == 1.0 => "uniform",
            Self::Plane(_) | Self::Graded | Self::GradedNodes { .. } => "graded",
            Self::Model => "model",
        }
    }
}

/// Refuses a grid that makes no sense or is none of this kind of contact.
pub(super) fn check(grid: &Grid, contact: ContactKind) -> Checked {
    match (contact, grid) {
        (ContactKind::Line, Grid::Plane(_)) => {
            return Err(refuse("grid", "is Plane, but a line contact has no Y; write Uniform, Graded or GradedNodes"));
        }
        (ContactKind::Point, Grid::Uniform { .. } | Grid::GradedNodes { .. }) => {
            return Err(refuse(
                "grid",
                "must be Plane(dx: …, dy: …, domain: (…, …, …)) or Model for a point contact, or left out",
            ));
        }
        _ => {}
    }
    let domain = |(from, to): (f64, f64)| {
        number("grid.domain.0", from, -LONGEST_INLET, -1.5)?;
        number("grid.domain.1", to, 1.2, LONGEST_OUTLET)
    };
    match *grid {
        Grid::Uniform { dx, domain: ends } => {
            number("grid.dx", dx, 1e-4, 0.2)?;
            domain(ends)
        }
        Grid::GradedNodes { nodes, domain: ends, .. } => {
            count("grid.nodes", nodes, 61, MAX_GRADED_NODES)?;
            domain(ends)
        }
        Grid::Plane(spec) => {
            spec.check().map(|_| ()).map_err(|problem| refuse("grid", format!("makes no sense: {problem}")))
        }
        Grid::Usual | Grid::Graded | Grid::Model => Ok(()),
    }
}
