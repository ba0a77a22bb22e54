//! Types of the values by which a contact is specified, on the command line and in tables, and how each is read from text.

use crate::scene::grid::Grid;
use crate::scene::named_lubricant::{NamedLubricant, UnknownLubricant, by_name};
use crate::solver::physics::bodies::{BodyHeat, MATERIALS, Material};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::UnitError;
use crate::solver::physics::lubricant::{Cavitation, DensityLaw, LimitingStress, ViscosityLaw};
use crate::solver::physics::surfaces::AsperityLaw;
use serde::{Deserialize, Serialize};
use std::num::ParseFloatError;
use std::path::PathBuf;

/// Reason why a text is not a valid value of a field. The message says what is accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ValueError {
    /// Not a number.
    #[error(transparent)]
    Number(#[from] ParseFloatError),
    /// Not a number, or one with a unit of another dimension.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// Not one of the accepted words.
    #[error("accepted are {}", .0.join(", "))]
    Word(Vec<&'static str>),
    /// Law with constants, which cannot be given as text.
    #[error(
        "{law} needs constants, which come with the lubricants squalane-pip and pao-650 or with a scene; accepted are {}",
        accepted.join(", ")
    )]
    LawWithConstants {
        /// Name of the law.
        law: &'static str,
        /// Laws without constants.
        accepted: [&'static str; 2],
    },
    /// Not a named lubricant.
    #[error(transparent)]
    Lubricant(#[from] UnknownLubricant),
    /// Not a viscosity grade.
    #[error("enter a grade such as ISO VG 68")]
    Grade,
    /// Not a domain.
    #[error(
        "accepted are the inlet and the outlet with a comma between them, as in -4,2, and after another comma the outer \
         edge of a point contact, as in -4,2,-2"
    )]
    Domain,
    /// Not a limiting stress.
    #[error(
        "accepted are two numbers with a comma between them, as in 5e6,0.05, and after another comma an Eyring \
         stress that affects only the traction of a Newtonian lubricant, as in 5e6,0.05,5e6"
    )]
    LimitingStress,
    /// Not an asperity law.
    #[error(
        "accepted are greenwood-tripp with ηβσ and σ/β, as in greenwood-tripp,0.05,0.01; zhao-maietta-chang with nβσ, σ/β \
         and the hardness in Pa, as in zhao-maietta-chang,0.05,0.01,5e9; and exponential with the pressure at h = 0 in Pa and \
         the decay length in units of σ, as in exponential,6e9,0.4"
    )]
    Asperities,
    /// Not a machine.
    #[error(
        "accepted are Bearing(…), Gear(…) and Cam(…) with their values, as Gear(teeth: (16, 24), module_m: 0.0045, \
         shifts: (0.18, 0.17), face_width_m: 0.014, pinion_rpm: 1500, torque_n_m: 200); {0}"
    )]
    Machine(String),
    /// Not three numbers.
    #[error("accepted are three numbers with commas between them, as in 2000,0.14,870")]
    ThreeNumbers,
    /// Not a body.
    #[error(
        "accepted are three numbers, as in 47,460,7850, or one of {}",
        MATERIALS.map(|material| material.word()).join(", ")
    )]
    Body,
}

/// Accepted words with their meanings.
pub type Choices = Vec<(&'static str, &'static str)>;

/// Value of one entry of a contact specification.
pub(super) trait Given: Sized {
    /// How many numbers a value consists of at most, if they are written with commas between them.
    const NUMBERS: usize = 0;

    /// Returns the accepted words, if the value is chosen by a word.
    fn choices() -> Choices {
        Vec::new()
    }

    /// Reads the value from a text.
    ///
    /// # Errors
    /// [`ValueError`], which says what is accepted.
    fn read(text: &str) -> Result<Self, ValueError>;

    /// Returns the value for a number, if it is numeric.
    fn of_number(_: f64) -> Option<Self> {
        None
    }

    /// Returns the value as a number, if it is numeric.
    fn number(&self) -> Option<f64> {
        None
    }
}

/// All words of a choice, with their meanings and values.
type All<T> = &'static [(&'static str, &'static str, T)];

/// Value that is chosen by a word.
trait Choice: Copy + 'static {
    const ALL: All<Self>;
}

impl<T: Choice> Given for T {
    fn choices() -> Choices {
        Self::ALL.iter().map(|&(word, about, _)| (word, about)).collect()
    }

    fn read(text: &str) -> Result<Self, ValueError> {
        let found = Self::ALL.iter().find(|(word, ..)| *word == text).map(|&(.., value)| value);
        found.ok_or_else(|| ValueError::Word(Self::ALL.iter().map(|(word, ..)| *word).collect()))
    }
}

/// Solution method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MethodName {
    /// Full solver.
    Full,
    /// Reduced model.
    Reduced,
}

/// Shear laws that can be selected by name. Their constants are entries of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ShearName {
    /// Viscosity independent of stress.
    Newtonian,
    /// Ree–Eyring law (hyperbolic sine).
    Eyring,
    /// Modified Carreau law (3.40).
    Carreau,
}

/// Ends of the computational domain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Inlet and outlet end.
    pub x: (f64, f64),
    /// Outer edge in Y, for a point contact.
    pub y: Option<f64>,
}

/// Number of an ISO viscosity grade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OilGrade(pub f64);

impl Choice for ContactKind {
    const ALL: All<Self> = &[
        (Self::Line.name(), "Line contact, loads in N/m", Self::Line),
        (
            Self::Point.name(),
            "Point contact, loads in N: circular, or elliptical if a radius across is given",
            Self::Point,
        ),
    ];
}

impl Choice for MethodName {
    const ALL: All<Self> = &[("full", "Full solver", Self::Full), ("reduced", "Reduced model", Self::Reduced)];
}

impl Choice for Grid {
    const ALL: All<Self> = &[
        ("uniform", "Equidistant nodes", Self::Usual),
        ("graded", "Graded grid, the explorer's default", Self::Graded),
        ("model", "Grid of the reduced model", Self::Model),
    ];
}

impl Choice for Cavitation {
    const ALL: All<Self> = &[
        ("penalty", "Penalty term (2.36)", Self::Penalty),
        ("complementarity", "No negative pressure, by a complementarity condition (appendix D)", Self::Complementarity),
        (
            "mass-conserving",
            "Conserves mass: the gap is partially filled where the film cavitates (JFO, Elrod–Adams)",
            Self::MassConserving { supply_film_m: None },
        ),
    ];
}

impl Choice for ShearName {
    const ALL: All<Self> = &[
        ("newtonian", "Viscosity independent of stress", Self::Newtonian),
        ("eyring", "Ree–Eyring law (hyperbolic sine)", Self::Eyring),
        ("carreau", "Modified Carreau law (3.40)", Self::Carreau),
    ];
}

impl Given for f64 {
    const NUMBERS: usize = 1;

    fn read(text: &str) -> Result<Self, ValueError> {
        Ok(text.parse::<f64>()?)
    }

    fn of_number(value: f64) -> Option<Self> {
        Some(value)
    }

    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}

impl Given for bool {
    fn read(text: &str) -> Result<Self, ValueError> {
        match text.to_lowercase().as_str() {
            "yes" | "true" | "on" | "1" => Ok(true),
            "no" | "false" | "off" | "0" => Ok(false),
            _ => Err(ValueError::Word(vec!["yes", "no"])),
        }
    }
}

impl Given for PathBuf {
    fn read(text: &str) -> Result<Self, ValueError> {
        Ok(Self::from(text))
    }
}

impl Given for NamedLubricant {
    fn read(text: &str) -> Result<Self, ValueError> {
        Ok(by_name(text)?)
    }
}

impl Given for OilGrade {
    fn read(text: &str) -> Result<Self, ValueError> {
        let digits = text.trim_start_matches(|c: char| !c.is_ascii_digit());
        digits.parse().map(Self).map_err(|_| ValueError::Grade)
    }
}

impl Given for DensityLaw {
    fn read(text: &str) -> Result<Self, ValueError> {
        law(text, [("dowson-higginson", Self::DowsonHigginson), ("incompressible", Self::Incompressible)], "tait")
    }
}

impl Given for ViscosityLaw {
    fn read(text: &str) -> Result<Self, ValueError> {
        law(text, [("roelands", Self::Roelands), ("barus", Self::Barus)], "doolittle")
    }
}

/// Reads a law without constants. A law with constants is refused with a message that says where such laws come from.
fn law<T>(text: &str, laws: [(&'static str, T); 2], other: &'static str) -> Result<T, ValueError> {
    let accepted = [laws[0].0, laws[1].0];
    laws.into_iter().find(|(word, _)| *word == text).map(|(_, law)| law).ok_or_else(|| match text == other {
        true => ValueError::LawWithConstants { law: other, accepted },
        false => ValueError::Word(accepted.to_vec()),
    })
}

/// Reads comma-separated numbers; `None` if a part is not a number.
fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse().ok()).collect()
}

impl Given for Domain {
    const NUMBERS: usize = 3;

    fn read(text: &str) -> Result<Self, ValueError> {
        match numbers(text).as_deref() {
            Some(&[from, to]) => Ok(Self { x: (from, to), y: None }),
            Some(&[from, to, side]) => Ok(Self { x: (from, to), y: Some(side) }),
            _ => Err(ValueError::Domain),
        }
    }
}

impl Given for LimitingStress {
    const NUMBERS: usize = 2;

    fn read(text: &str) -> Result<Self, ValueError> {
        match numbers(text).as_deref() {
            Some(&[ambient, slope]) => Ok(Self { ambient, slope, eyring: None }),
            Some(&[ambient, slope, eyring]) => Ok(Self { ambient, slope, eyring: Some(eyring) }),
            _ => Err(ValueError::LimitingStress),
        }
    }
}

impl Given for AsperityLaw {
    fn read(text: &str) -> Result<Self, ValueError> {
        let (word, constants) = text.split_once(',').unwrap_or((text, ""));
        let constants =
            if constants.is_empty() { Vec::new() } else { numbers(constants).ok_or(ValueError::Asperities)? };
        match (word.trim(), constants.as_slice()) {
            ("greenwood-tripp", []) => Ok(Self::default()),
            ("greenwood-tripp", &[eta_beta_sigma, sigma_over_beta]) => {
                Ok(Self::GreenwoodTripp { eta_beta_sigma, sigma_over_beta })
            }
            ("zhao-maietta-chang", &[n_beta_sigma, sigma_over_beta, hardness]) => {
                Ok(Self::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness })
            }
            ("exponential", &[pressure, decay]) => Ok(Self::Exponential { pressure, decay }),
            _ => Err(ValueError::Asperities),
        }
    }
}

impl Given for [f64; 3] {
    const NUMBERS: usize = 3;

    fn read(text: &str) -> Result<Self, ValueError> {
        let three = numbers(text).and_then(|numbers| numbers.try_into().ok());
        three.ok_or(ValueError::ThreeNumbers)
    }
}

impl Given for BodyHeat {
    const NUMBERS: usize = 3;

    fn read(text: &str) -> Result<Self, ValueError> {
        if let Some(material) = Material::named(text) {
            return Ok(material.heat);
        }
        let [conductivity, heat_capacity, density] = <[f64; 3]>::read(text).map_err(|_| ValueError::Body)?;
        Ok(Self { conductivity, heat_capacity, density })
    }
}
