//! The values that fields have, and how they are read from a text.

use crate::scene::grid::Grid;
use crate::scene::named_lubricant::{NamedLubricant, UnknownLubricant, by_name};
use crate::solver::physics::bodies::{BodyHeat, MATERIALS, Material};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Cavitation, DensityLaw, LimitingStress, ViscosityLaw};
use serde::{Deserialize, Serialize};
use std::num::ParseFloatError;
use std::path::PathBuf;

/// Why a text is no value of a field: a sentence that says what is accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ValueError {
    /// It is no number.
    #[error(transparent)]
    Number(#[from] ParseFloatError),
    /// It is none of some words.
    #[error("accepted are {}", .0.join(", "))]
    Word(Vec<&'static str>),
    /// It is a law with constants that no text gives.
    #[error(
        "{law} needs constants, which come with the lubricants squalane-pip and pao-650 or with a scene; accepted are {}",
        accepted.join(", ")
    )]
    LawWithConstants {
        /// The law.
        law: &'static str,
        /// Laws without constants.
        accepted: [&'static str; 2],
    },
    /// It is no named lubricant.
    #[error(transparent)]
    Lubricant(#[from] UnknownLubricant),
    /// It is no viscosity grade.
    #[error("write it like ISO VG 68")]
    Grade,
    /// It is no domain.
    #[error(
        "accepted are the inlet and the outlet with a comma between them, as in -4,2, and after another comma the outer \
         edge of a point contact, as in -4,2,-2"
    )]
    Domain,
    /// It is no limiting stress.
    #[error(
        "accepted are two numbers with a comma between them, as in 5e6,0.05, and after another comma the stress from which \
         the traction of a Newtonian film thins, as in 5e6,0.05,5e6"
    )]
    LimitingStress,
    /// It is not made of three numbers.
    #[error("accepted are three numbers with commas between them, as in 2000,0.14,870")]
    ThreeNumbers,
    /// It is no body.
    #[error(
        "accepted are three numbers, as in 47,460,7850, or one of {}",
        MATERIALS.map(|material| material.word()).join(", ")
    )]
    Body,
}

/// Words with what they mean.
pub type Choices = Vec<(&'static str, &'static str)>;

/// A value of a field.
pub(super) trait Given: Sized {
    /// Of how many numbers it is made.
    const NUMBERS: usize = 0;

    /// The words it is chosen by.
    fn choices() -> Choices {
        Vec::new()
    }

    /// Reads it from a text.
    ///
    /// # Errors
    /// A sentence that says what is accepted.
    fn read(text: &str) -> Result<Self, ValueError>;

    /// The value of a number, where it is one.
    fn of_number(_: f64) -> Option<Self> {
        None
    }

    /// Its number, where it is one.
    fn number(&self) -> Option<f64> {
        None
    }
}

/// Words, their meanings, their values.
type All<T> = &'static [(&'static str, &'static str, T)];

/// A value that is chosen by a word.
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

/// How a contact is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MethodName {
    /// The full system.
    Full,
    /// A reduced model.
    Reduced,
}

/// Laws of shear thinning that can be stated by their constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ShearName {
    /// Viscosity does not depend on stress.
    Newtonian,
    /// Ree and Eyring's hyperbolic sine.
    Eyring,
    /// The modified Carreau law (3.40).
    Carreau,
}

/// Ends of the computational domain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Inlet and outlet.
    pub x: (f64, f64),
    /// Outer edge of a point contact.
    pub y: Option<f64>,
}

/// The number of an ISO viscosity grade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OilGrade(pub f64);

impl Choice for ContactKind {
    const ALL: All<Self> = &[
        ("line", "Line contact, loads in N/m", Self::Line),
        ("point", "Point contact, loads in N: a circle, or with a radius across an ellipse", Self::Point),
    ];
}

impl Choice for MethodName {
    const ALL: All<Self> = &[("full", "The full system", Self::Full), ("reduced", "A reduced model", Self::Reduced)];
}

impl Choice for Grid {
    const ALL: All<Self> = &[
        ("uniform", "Equidistant nodes", Self::Usual),
        ("graded", "The explorer's default", Self::Graded),
        ("model", "The reduced model's own", Self::Model),
    ];
}

impl Choice for Cavitation {
    const ALL: All<Self> = &[
        ("penalty", "The penalty term of (2.36)", Self::Penalty),
        ("complementarity", "No pressure below zero, by a multiplier (appendix D)", Self::Complementarity),
        (
            "mass-conserving",
            "No liquid lost behind the contact: the gap is filled in part (Elrod and Adams)",
            Self::MassConserving { supply_film_m: None },
        ),
    ];
}

impl Choice for ShearName {
    const ALL: All<Self> = &[
        ("newtonian", "Viscosity does not depend on stress", Self::Newtonian),
        ("eyring", "Ree and Eyring's hyperbolic sine", Self::Eyring),
        ("carreau", "The modified Carreau law (3.40)", Self::Carreau),
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

/// A law without constants of its own; one with them is refused by saying where they come from.
fn law<T>(text: &str, laws: [(&'static str, T); 2], other: &'static str) -> Result<T, ValueError> {
    let accepted = [laws[0].0, laws[1].0];
    laws.into_iter().find(|(word, _)| *word == text).map(|(_, law)| law).ok_or_else(|| match text == other {
        true => ValueError::LawWithConstants { law: other, accepted },
        false => ValueError::Word(accepted.to_vec()),
    })
}

/// Numbers with commas between them; none where something else stands there.
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
