//! The dimensionless problem of a contact, and why one is refused.

use crate::solver::discrete::grid::GridError;
use crate::solver::discrete::heat::{Course, StressLaw, WarmLaws};
use crate::solver::discrete::nodes::Laws;
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::physics::contact::{ContactError, ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::{
    Lubricant, LubricantError, ScaledFluid, ScaledHeat, ScaledShear, ShearLaw, Sliding, WholeLubricant,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Why a solve cannot be started.
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
        /// What the solver is made for.
        wanted: ContactKind,
        /// What it was given.
        given: ContactKind,
    },
}

/// One dimensionless problem: what the solver needs of an operating point and a lubricant. Those two are what is
/// serialised of a steady one; the rest follows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Stated", try_from = "Stated")]
pub struct Problem {
    /// The operating point it was made from.
    pub point: OperatingPoint,
    /// The laws it was made with.
    pub lubricant: Lubricant,
    /// The laws with their constants.
    pub fluid: ScaledFluid,
    /// The shear-thinning law with its constants; `None` where the fluid is Newtonian.
    pub shear: Option<ScaledShear>,
    /// What heat adds; `None` where everything has the inlet's temperature.
    pub heat: Option<ScaledHeat>,
    /// Moes numbers.
    pub moes: Moes,
    /// 1/λ̄ of (2.23).
    pub inverse_lambda: f64,
    /// ∫P: π/2 for a line, (2.28), 2π/3 for a point contact, (2.29).
    pub load: f64,
    /// Flow that the surfaces bring to the inlet, the supplied film in units of a²/R; none where it is flooded.
    pub supply: Option<f64>,
}

/// What a steady problem follows from.
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
    /// The same point under other sliding.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn under_sliding(point: &OperatingPoint, lubricant: Lubricant, sliding: Sliding) -> Result<Self, SolveError> {
        Self::new(&OperatingPoint { sliding, ..*point }, lubricant)
    }

    /// Checks the point and the lubricant and makes them dimensionless. Where α follows from the viscosity law, the
    /// problem's point has that α, whatever the given one has; where the lubricant thins under shear, its point has the
    /// plateau ratio that counts.
    ///
    /// # Errors
    /// When the point, its sliding or the lubricant is outside its valid range.
    pub fn new(point: &OperatingPoint, lubricant: Lubricant) -> Result<Self, SolveError> {
        lubricant.check()?;
        // Before the coefficient that follows: that of a law which has ended is beyond any sense as well.
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
            moes: point.moes(),
            inverse_lambda: 1.0 / point.lambda_bar(),
            supply: lubricant.cavitation.supply_film_m().map(|film| film / point.film_scale_m()),
            load: match point.kind {
                ContactKind::Line => 0.5 * PI,
                ContactKind::Point => 2.0 / 3.0 * PI,
            },
        })
    }

    /// The same without heat.
    pub fn isothermal(self) -> Self {
        Self { lubricant: Lubricant { heat: None, ..self.lubricant }, heat: None, ..self }
    }

    /// What makes films with temperatures into nodes; none without heat.
    pub fn warm_laws(&self) -> Option<WarmLaws<'_>> {
        let heat = self.heat.as_ref()?;
        Some(WarmLaws { heat, shear: self.shear.as_ref().map(|shear| StressLaw::new(shear, heat)) })
    }

    /// What a film with heat is marched through, given P, P_X and H at the stations; none without heat.
    pub fn course<'a>(&'a self, states: &'a [NodeState]) -> Option<Course<'a>> {
        let limit = self.lubricant.limiting_stress.map(|limit| (limit, self.fluid.hertz_pressure_pa()));
        Some(Course { laws: self.warm_laws()?, limit, states })
    }

    /// What makes pressure, gradient and film into nodes.
    pub fn laws(&self) -> Laws<'_> {
        Laws { fluid: &self.fluid, shear: self.shear.as_ref(), inverse_lambda: self.inverse_lambda }
    }
}

/// Refuses a point of the other kind.
pub(super) fn expect_kind(wanted: ContactKind, point: &OperatingPoint) -> Result<(), SolveError> {
    let given = point.kind;
    if given == wanted { Ok(()) } else { Err(SolveError::OtherContact { wanted, given }) }
}
