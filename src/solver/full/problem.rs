//! Dimensionless problem of a contact, and the reasons for refusing one.

use crate::solver::discrete::grid::GridError;
use crate::solver::discrete::heat::{Course, StressLaw, WarmLaws};
use crate::solver::discrete::nodes::Laws;
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::discrete::rough::RoughLaws;
use crate::solver::physics::contact::{ContactError, ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::{
    Lubricant, LubricantError, ScaledFluid, ScaledHeat, ScaledShear, ShearLaw, Sliding, WholeLubricant,
};
use crate::solver::physics::surfaces::ScaledRoughness;
use serde::{Deserialize, Serialize};

/// Reason why a solve cannot start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The operating point is refused.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The lubricant is refused.
    #[error(transparent)]
    Lubricant(#[from] LubricantError),
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The problem is of the other kind.
    #[error("this solver is made for {} contacts, but the operating point is that of a {} contact", wanted.name(), given.name())]
    OtherContact {
        /// Kind of contact that the solver supports.
        wanted: ContactKind,
        /// Kind of contact that was given.
        given: ContactKind,
    },
}

/// Dimensionless problem, made from an operating point and a lubricant. Only these two are serialised for a steady
/// problem; the other fields follow from them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Stated", try_from = "Stated")]
pub struct Problem {
    /// Operating point from which it was made.
    pub point: OperatingPoint,
    /// Lubricant from which it was made.
    pub lubricant: Lubricant,
    /// Viscosity and density laws with their scaled constants.
    pub fluid: ScaledFluid,
    /// Shear-thinning law with its scaled constants; `None` for a Newtonian fluid.
    pub shear: Option<ScaledShear>,
    /// Scaled thermal properties; `None` for an isothermal problem at the inlet temperature.
    pub heat: Option<ScaledHeat>,
    /// Scaled roughness; `None` for smooth surfaces.
    pub rough: Option<ScaledRoughness>,
    /// Moes numbers M and L.
    pub moes: Moes,
    /// 1/λ̄ of (2.23).
    pub inverse_lambda: f64,
    /// Dimensionless load ∫P: π/2 for a line contact, (2.28), and 2π/3 for a point contact, (2.29).
    pub load: f64,
    /// Flow that the surfaces carry to the inlet: the inlet film thickness in units of a²/R. `None` for a flooded
    /// inlet.
    pub supply: Option<f64>,
}

/// Data from which a steady problem follows.
#[derive(Serialize, Deserialize)]
struct Stated {
    point: OperatingPoint,
    #[serde(with = "WholeLubricant")]
    lubricant: Lubricant,
}

impl From<Problem> for Stated {
    fn from(Problem { point, lubricant, .. }: Problem) -> Self {
        Self { point, lubricant }
    }
}

impl TryFrom<Stated> for Problem {
    type Error = SolveError;

    fn try_from(Stated { point, lubricant }: Stated) -> Result<Self, SolveError> {
        Self::new(&point, lubricant)
    }
}

impl Problem {
    /// Creates the problem of the same point with other sliding.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn under_sliding(point: &OperatingPoint, lubricant: Lubricant, sliding: Sliding) -> Result<Self, SolveError> {
        Self::new(&OperatingPoint { sliding, ..*point }, lubricant)
    }

    /// Checks the point and the lubricant and makes them dimensionless. If the pressure coefficient α follows from
    /// the viscosity law, the problem's point has that α instead of the given one. For a shear-thinning lubricant,
    /// its point has the plateau ratio of the law.
    ///
    /// # Errors
    /// If the point, its sliding or the lubricant is outside its valid range.
    pub fn new(point: &OperatingPoint, lubricant: Lubricant) -> Result<Self, SolveError> {
        lubricant.check()?;
        // Checked before α is computed from the law, because α is meaningless beyond the law's range.
        lubricant.check_pressure(point.hertz().pressure_pa)?;
        let alpha_per_pa = lubricant.own_coefficient().unwrap_or(point.alpha_per_pa);
        let mut point = OperatingPoint { alpha_per_pa, ..*point };
        point.check()?;
        let fluid = lubricant.scaled(&point)?;
        let shear = ScaledShear::new(lubricant.shear, point.sliding, &point)?;
        if lubricant.shear != ShearLaw::Newtonian {
            point.sliding.newtonian_plateau_ratio.get_or_insert(lubricant.shear.plateau());
        }
        Ok(Self {
            point,
            lubricant,
            fluid,
            shear,
            heat: lubricant.scaled_heat(&fluid, &point)?,
            rough: ScaledRoughness::new(lubricant.roughness, &point),
            moes: point.moes(),
            inverse_lambda: 1.0 / point.lambda_bar(),
            supply: lubricant.cavitation.supply_film_m().map(|film| film / point.film_scale_m()),
            load: point.kind.pressure_integral(),
        })
    }

    /// Returns the same problem without heat.
    pub fn isothermal(self) -> Self {
        Self { lubricant: Lubricant { heat: None, ..self.lubricant }, heat: None, ..self }
    }

    /// Returns the laws that turn film thickness and temperatures into nodes, or `None` for an isothermal problem.
    pub fn warm_laws(&self) -> Option<WarmLaws<'_>> {
        let heat = self.heat.as_ref()?;
        Some(WarmLaws { heat, shear: self.shear.as_ref().map(|shear| StressLaw::new(shear, heat)) })
    }

    /// Returns the laws of a rough contact, or `None` for smooth surfaces.
    pub fn rough_laws(&self) -> Option<RoughLaws<'_>> {
        let rough = self.rough.as_ref()?;
        Some(RoughLaws { fluid: &self.fluid, rough, inverse_lambda: self.inverse_lambda })
    }

    /// Returns the heat flux into each body per asperity pressure P_a, in the unit of the march of the temperatures: half
    /// of the friction μ_b p_a |u₂ − u₁|. `None` without heat or for smooth surfaces.
    pub fn boundary_flux(&self) -> Option<f64> {
        let (heat, rough) = self.heat.as_ref().zip(self.rough)?;
        let stress = rough.roughness.boundary_friction * self.point.hertz().pressure_pa / heat.stress_scale_pa;
        let sliding = self.point.sliding.slide_to_roll_ratio.abs();
        Some(0.5 * heat.shear * stress * sliding / heat.conduction)
    }

    /// Returns the data for marching through a thermal film, given P, P_X and H at the stations, or `None` for an
    /// isothermal problem.
    pub fn course<'a>(&'a self, states: &'a [NodeState]) -> Option<Course<'a>> {
        let limit = self.lubricant.limiting_stress.map(|limit| (limit, self.fluid.hertz_pressure_pa()));
        Some(Course { laws: self.warm_laws()?, limit, states })
    }

    /// Returns the laws that turn pressure, gradient and film thickness into nodes.
    pub fn laws(&self) -> Laws<'_> {
        Laws { fluid: &self.fluid, shear: self.shear.as_ref(), inverse_lambda: self.inverse_lambda }
    }
}

/// Refuses a point of the other kind.
pub(super) fn expect_kind(wanted: ContactKind, point: &OperatingPoint) -> Result<(), SolveError> {
    let given = point.kind;
    if given == wanted { Ok(()) } else { Err(SolveError::OtherContact { wanted, given }) }
}
