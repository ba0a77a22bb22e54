//! Grid of full solutions in the form that a scene file uses.

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
    /// Equidistant nodes. The dissertation uses `Uniform(dx: 0.005, domain: (-4.0, 2.0))`.
    Uniform {
        /// Spacing ΔX.
        dx: f64,
        /// Inlet and outlet end.
        domain: (f64, f64),
    },
    /// The dissertation's uniform grid if it is sufficient for the contact, otherwise a longer or finer one. Default of
    /// `solve`.
    Usual,
    /// The explorer's graded grid: graded along X for a line contact, across for a point contact. Longer or finer if
    /// the contact requires it.
    #[default]
    Graded,
    /// Graded grid with given parameters.
    GradedNodes {
        /// Number of nodes, including both ends.
        nodes: usize,
        /// Inlet and outlet end in the reference coordinate ξ.
        domain: (f64, f64),
        /// True if the pressure spike is mapped to ξ = 1.
        registered: bool,
    },
    /// Nodes on the half Y ≤ 0 of a point contact. The dissertation uses `Plane(dx: 0.02, dy: 0.05, domain: (-4.0, 2.0,
    /// -2.0))`.
    Plane(PointGridSpec),
    /// Grid of the study's reduced model, or of the embedded model if the study has none, so that both can be compared.
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
    /// The dissertation's grid: 1201 nodes from X = −4 to 2.
    pub const DISSERTATION: Self = Self::Uniform { dx: 0.005, domain: (-4.0, 2.0) };

    /// Replaces [`Grid::Usual`] by a grid that is sufficient for this contact.
    ///
    /// # Errors
    /// If none of the predefined grids is sufficient.
    pub fn for_contact(self, point: &OperatingPoint) -> Result<Self, GridError> {
        match (self, point.kind) {
            (Self::Usual, ContactKind::Point) => PointGridSpec::DISSERTATION.for_contact(point).map(Self::Plane),
            (Self::Usual, ContactKind::Line) if GridSpec::DISSERTATION.does(point.moes()) => Ok(Self::DISSERTATION),
            (Self::Usual, ContactKind::Line) => GridSpec::explorer_for(point).map(|_| Self::Graded),
            _ => Ok(self),
        }
    }

    /// Returns the solver's specification for a point contact; `None` if this grid is not for point contacts.
    pub fn point_spec(&self) -> Option<PointGridSpec> {
        match *self {
            Self::Plane(spec) => Some(spec),
            Self::Graded => Some(PointGridSpec::EXPLORER),
            Self::Usual | Self::Uniform { .. } | Self::GradedNodes { .. } | Self::Model => None,
        }
    }

    /// Returns the solver's specification for a line contact; `None` for the grid of a reduced model or of a point
    /// contact.
    pub fn spec(&self) -> Option<GridSpec> {
        match *self {
            Self::Uniform { dx, domain } => Some(GridSpec::Uniform { dx, domain }),
            Self::Graded => Some(GridSpec::EXPLORER),
            Self::GradedNodes { nodes, domain, registered } => Some(GridSpec::Graded { nodes, domain, registered }),
            Self::Usual | Self::Model | Self::Plane(_) => None,
        }
    }

    /// Returns the solver's specification for a kind of contact; `None` for the grid of a reduced model, or if this grid
    /// is not for the kind.
    pub fn spec_for(&self, kind: ContactKind) -> Option<GridSpec> {
        if kind.is_line() { self.spec() } else { self.point_spec().map(GridSpec::Plane) }
    }

    /// Returns the word used in results.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Usual | Self::Uniform { .. } => "uniform",
            Self::Plane(spec) if spec.refinement == 1.0 => "uniform",
            Self::Plane(_) | Self::Graded | Self::GradedNodes { .. } => "graded",
            Self::Model => "model",
        }
    }
}

/// Refuses a grid with invalid values or of another contact kind.
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
