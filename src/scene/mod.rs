//! The experiment as a document: one contact, one question about it, and what is expected of the answer.
//!
//! A [`Scene`] is plain data. The explorer builds, changes and saves it; the engine runs it; [`document`] reads and writes it as RON
//! with line and column in every error; [`check`] refuses values that make no sense, naming the field. What the explorer needs
//! beyond the experiment to open a scene as it was saved stands in its [`View`]; windows, themes and zoom are not part of it.

pub mod atomic_file;
mod axis;
pub mod check;
pub mod document;
mod expectation;
mod marches;
pub mod named_lubricant;
mod published;
pub mod sampled;
mod study;
mod study_check;
mod transient;
mod view;

pub use axis::{Axis, Steps, Variable};
pub use document::{SceneError, SceneFileError};
pub use expectation::{Expectation, Within};
pub use published::PublishedMarch;
pub use study::{ComparedPlan, ComparedSampling, Contacts, Formula, OnlineScheme, Study};
pub use transient::{Drive, LinearisedTransient, ReducedTransient, TransientStudy};
pub use view::{LoadFollower, LubricantFollower, View};

pub use crate::solver::training::QuantityBox;

use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::physics::contact::{ContactError, ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{Lubricant, Sliding};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Version of the scene format this program writes, and the newest it reads.
pub const VERSION: u32 = 1;

/// How far the α of a scene may lie from the one that a viscosity law determines and still count as the same, rounded.
const ROUNDED_ALPHA: f64 = 1e-3;

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// An experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the format, [`VERSION`].
    pub version: u32,
    /// Title for people.
    pub title: String,
    /// Where the experiment comes from: a table, a figure, a paper.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Line or point contact.
    #[serde(default)]
    pub contact: ContactKind,
    /// Laws of the lubricant; its constants are part of [`Scene::at`].
    #[serde(default)]
    pub lubricant: Lubricant,
    /// The operating point. Studies that bring their own points (trajectory, random test, training) do not use it.
    #[serde(default)]
    pub at: At,
    /// Slide-to-roll ratio SRR.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub srr: f64,
    /// Newtonian plateau ratio NPR of a shear-thinning lubricant, in place of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub npr: Option<f64>,
    /// Grid of full solutions; a reduced model always uses its own.
    #[serde(default)]
    pub grid: Grid,
    /// The question.
    pub study: Study,
    /// What the answer should be.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub expect: Vec<Expectation>,
    /// Whether it ends within ten seconds on two cores: `run --all --quick` and the tests take those.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub quick: bool,
    /// What the explorer keeps with it; results do not depend on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<View>,
}

/// An operating point, in SI units or by its Moes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum At {
    /// All six quantities in SI units.
    Si {
        /// Reduced radius R \[m\].
        radius: f64,
        /// Mean entrainment speed u_m \[m/s\].
        speed: f64,
        /// Load \[N/m\] (line) or \[N\] (point).
        load: f64,
        /// Reduced modulus E′ \[Pa\].
        modulus: f64,
        /// Viscosity at ambient pressure η₀ \[Pa·s\].
        viscosity: f64,
        /// Pressure–viscosity coefficient α \[1/Pa\]; where the viscosity law determines it (Doolittle), its α* counts instead.
        alpha: f64,
    },
    /// Moes numbers; quantities that are given are kept, the rest follows or takes the default realisation.
    Moes {
        /// Load number M.
        m: f64,
        /// Lubricant number L.
        l: f64,
        /// Fixed radius \[m\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius: Option<f64>,
        /// Fixed speed \[m/s\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
        /// Fixed load \[N/m\] or \[N\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        load: Option<f64>,
        /// Fixed reduced modulus \[Pa\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        modulus: Option<f64>,
        /// Fixed viscosity \[Pa·s\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        viscosity: Option<f64>,
        /// Fixed pressure–viscosity coefficient \[1/Pa\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        alpha: Option<f64>,
    },
}

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
    /// The explorer's graded grid: along X for a line, across for a point contact.
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
    /// Nodes on the half Y ≤ 0 of a point contact; the dissertation's are `Plane(dx: 0.02, dy: 0.05, domain: (-4.0, 2.0, -2.0))`.
    Plane {
        /// Spacing ΔX.
        dx: f64,
        /// Spacing ΔY.
        dy: f64,
        /// Inlet, outlet and outer edge.
        domain: (f64, f64, f64),
        /// How many times finer the spacing across is in the side lobes.
        #[serde(default = "equidistant", skip_serializing_if = "is_equidistant")]
        refinement: f64,
    },
    /// The grid of the reduced model in the study (of the embedded one where there is none), so that both can be compared.
    Model,
}

/// How a contact is solved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub enum Method {
    /// The full system.
    #[default]
    Full,
    /// A reduced model.
    Reduced {
        /// Which one.
        #[serde(default)]
        model: ModelSource,
    },
}

/// Where a reduced model comes from. Paths are relative to the scene's folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ModelSource {
    /// The one in the program.
    #[default]
    Embedded,
    /// A `.rom` file.
    File(PathBuf),
    /// Trained on the spot as another scene describes.
    Trained(PathBuf),
}

impl Scene {
    /// A scene that solves one contact in its default realisation, in full and by the embedded model.
    pub fn at_moes(m: f64, l: f64) -> Self {
        Self {
            version: VERSION,
            title: format!("Line contact at M = {m}, L = {l}"),
            source: String::new(),
            contact: ContactKind::Line,
            lubricant: Lubricant::default(),
            at: At::moes(m, l),
            srr: 0.0,
            npr: None,
            grid: Grid::Graded,
            study: Study::Point { methods: vec![Method::Full, Method::EMBEDDED] },
            expect: Vec::new(),
            quick: false,
            view: None,
        }
    }

    /// The operating point in SI units.
    ///
    /// # Errors
    /// When it is outside any sense, or more is fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// A sentence where the scene's own α has no effect: the viscosity law determines another one.
    pub fn unused_alpha(&self) -> Option<String> {
        let own = self.lubricant.own_coefficient()?;
        let given = match self.at {
            At::Si { alpha, .. } => alpha,
            At::Moes { alpha, .. } => alpha?,
        };
        let contradicts = (given / own - 1.0).abs() > ROUNDED_ALPHA;
        contradicts.then(|| {
            format!(
                "the alpha of `at`, {given:.4e} 1/Pa, has no effect: the lubricant's viscosity law has {own:.4e} 1/Pa"
            )
        })
    }

    /// The sliding and the plateau ratio.
    pub fn sliding(&self) -> Sliding {
        Sliding { slide_to_roll_ratio: self.srr, newtonian_plateau_ratio: self.npr }
    }
}

impl Default for At {
    /// M = 40, L = 10 in the default realisation.
    fn default() -> Self {
        Self::moes(40.0, 10.0)
    }
}

impl At {
    /// Moes numbers in the default realisation.
    pub fn moes(m: f64, l: f64) -> Self {
        Self::Moes { m, l, radius: None, speed: None, load: None, modulus: None, viscosity: None, alpha: None }
    }

    /// The same with the α* of a lubricant whose viscosity law determines it; unchanged for all others.
    pub fn with_alpha_of(mut self, lubricant: &Lubricant) -> Self {
        if let Some(own) = lubricant.own_coefficient() {
            match &mut self {
                Self::Si { alpha, .. } => *alpha = own,
                Self::Moes { alpha, .. } => *alpha = Some(own),
            }
        }
        self
    }

    /// The operating point in SI units, checked.
    ///
    /// # Errors
    /// When it is outside any sense, or more is fixed than M and L leave free.
    pub fn point(&self, kind: ContactKind) -> Result<OperatingPoint, ContactError> {
        match *self {
            Self::Si { radius, speed, load, modulus, viscosity, alpha } => {
                let point = OperatingPoint {
                    kind,
                    radius_m: radius,
                    speed_m_per_s: speed,
                    load,
                    modulus_pa: modulus,
                    viscosity_pa_s: viscosity,
                    alpha_per_pa: alpha,
                    sliding: Sliding::NONE,
                };
                point.check()?;
                Ok(point)
            }
            Self::Moes { m, l, radius, speed, load, modulus, viscosity, alpha } => {
                check_given(kind, [radius, speed, load, modulus, viscosity, alpha])?;
                let request = MoesRequest {
                    kind,
                    m,
                    l,
                    radius_m: radius,
                    speed_m_per_s: speed,
                    load,
                    modulus_pa: modulus,
                    viscosity_pa_s: viscosity,
                    alpha_per_pa: alpha,
                };
                si_from_moes(&request)
            }
        }
    }
}

/// Refuses a given quantity by its own name, before others follow from it.
fn check_given(kind: ContactKind, given: [Option<f64>; 6]) -> Result<(), ContactError> {
    let known = OperatingPoint::TABLE_2_1.quantities();
    let [radius, speed, load, modulus, viscosity, alpha]: [f64; 6] =
        std::array::from_fn(|i| given[i].unwrap_or(known[i]));
    match (At::Si { radius, speed, load, modulus, viscosity, alpha }).point(kind) {
        // The mixture of given and known quantities need not make sense as a contact.
        Err(ContactError::OutOfRange { quantity, .. }) if quantity.starts_with("Moes") => Ok(()),
        result => result.map(|_| ()),
    }
}

impl From<OperatingPoint> for At {
    fn from(point: OperatingPoint) -> Self {
        let [radius, speed, load, modulus, viscosity, alpha] = point.quantities();
        Self::Si { radius, speed, load, modulus, viscosity, alpha }
    }
}

fn equidistant() -> f64 {
    1.0
}

fn is_equidistant(refinement: &f64) -> bool {
    *refinement == 1.0
}

impl Grid {
    /// The dissertation's grid: 1201 nodes from −4 to 2.
    pub const DISSERTATION: Self = Self::Uniform { dx: 0.005, domain: (-4.0, 2.0) };

    /// The solver's specification for a point contact; `None` where this is no grid of one.
    pub fn point_spec(&self) -> Option<PointGridSpec> {
        match *self {
            Self::Plane { dx, dy, domain, refinement } => Some(PointGridSpec { dx, dy, refinement, domain }),
            Self::Graded => Some(PointGridSpec::EXPLORER),
            Self::Uniform { .. } | Self::GradedNodes { .. } | Self::Model => None,
        }
    }

    /// The solver's specification for a line contact; `None` where a reduced model's grid is wanted, or one of a point contact.
    pub fn spec(&self) -> Option<GridSpec> {
        match *self {
            Self::Uniform { dx, domain } => Some(GridSpec::Uniform { dx, domain }),
            Self::Graded => Some(GridSpec::EXPLORER),
            Self::GradedNodes { nodes, domain, registered } => Some(GridSpec::Graded { nodes, domain, registered }),
            Self::Model | Self::Plane { .. } => None,
        }
    }

    /// The word that stands for it in results.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Uniform { .. } => "uniform",
            Self::Plane { refinement, .. } if is_equidistant(refinement) => "uniform",
            Self::Plane { .. } => "graded",
            Self::Graded | Self::GradedNodes { .. } => "graded",
            Self::Model => "model",
        }
    }
}

impl Method {
    /// The embedded reduced model.
    pub const EMBEDDED: Self = Self::Reduced { model: ModelSource::Embedded };

    /// The word that stands for it in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced { .. } => "reduced",
        }
    }

    /// The reduced model, if it is one.
    pub fn model(&self) -> Option<&ModelSource> {
        match self {
            Self::Full => None,
            Self::Reduced { model } => Some(model),
        }
    }
}
