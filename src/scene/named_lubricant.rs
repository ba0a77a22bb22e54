//! Lubricants that have a name: a set of laws under a word that command lines and people can use.

use crate::solver::lubricant::{DensityLaw, Lubricant, ViscosityLaw};

/// A lubricant with its name and one line about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedLubricant {
    /// The word on the command line.
    pub name: &'static str,
    /// Its laws.
    pub laws: Lubricant,
    /// What it is, for people.
    pub about: &'static str,
}

/// All named lubricants.
pub const NAMED: [NamedLubricant; 3] = [
    NamedLubricant {
        name: "roelands-oil",
        laws: Lubricant { density: DensityLaw::DowsonHigginson, viscosity: ViscosityLaw::Roelands },
        about: "the dissertation's Newtonian oil: Roelands (2.12), Dowson–Higginson (2.10)",
    },
    NamedLubricant {
        name: "barus-oil",
        laws: Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus },
        about: "the fluid of Moes' film formula: Barus (2.11), incompressible",
    },
    NamedLubricant {
        name: "compressible-barus-oil",
        laws: Lubricant { density: DensityLaw::DowsonHigginson, viscosity: ViscosityLaw::Barus },
        about: "Barus (2.11), Dowson–Higginson (2.10)",
    },
];

/// Names that belong to lubricants with shear-thinning, which this version does not have.
const ANNOUNCED: [&str; 2] = ["squalane-pip", "pao-650"];

/// The lubricant of a name.
///
/// # Errors
/// With a sentence that lists the accepted names.
pub fn by_name(name: &str) -> Result<Lubricant, String> {
    if let Some(found) = NAMED.iter().find(|lubricant| lubricant.name == name) {
        return Ok(found.laws);
    }
    let accepted = NAMED.map(|lubricant| lubricant.name).join(", ");
    if ANNOUNCED.contains(&name) {
        return Err(format!(
            "the lubricant {name} comes with shear-thinning, which this version does not have; accepted are {accepted}"
        ));
    }
    Err(format!("there is no lubricant of that name; accepted are {accepted}"))
}
