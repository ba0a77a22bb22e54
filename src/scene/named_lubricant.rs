//! Lubricants that have a name: a set of laws under a word that command lines and people can use.

use crate::solver::lubricant::{DensityLaw, Doolittle, Lubricant, ShearLaw, Tait, ViscosityLaw};

/// A lubricant with its name and one line about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedLubricant {
    /// The word on the command line.
    pub name: &'static str,
    /// Its laws.
    pub laws: Lubricant,
    /// Its viscosity at ambient pressure η₀ \[Pa·s\], where the name says that much.
    pub viscosity_pa_s: Option<f64>,
    /// What it is, for people.
    pub about: &'static str,
}

const NEWTONIAN: Lubricant = Lubricant {
    density: DensityLaw::DowsonHigginson,
    viscosity: ViscosityLaw::Roelands,
    shear: ShearLaw::Newtonian,
    limiting_stress: None,
};

const SQUALANE_VOLUME: Tait = Tait { k_0: 1.007837e9, k_0_prime: 11.29 };
const PAO_650_VOLUME: Tait = Tait { k_0: 1.4252e9, k_0_prime: 12.82 };

/// Squalane with polyisoprene, Table 3.5; its η₀ is 0.0705 Pa·s.
pub const SQUALANE_PIP: Lubricant = Lubricant {
    density: DensityLaw::Tait(SQUALANE_VOLUME),
    viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.2, r_0: 0.658, volume: SQUALANE_VOLUME }),
    shear: ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 },
    limiting_stress: None,
};

/// All named lubricants.
pub const NAMED: [NamedLubricant; 5] = [
    NamedLubricant {
        name: "roelands-oil",
        laws: NEWTONIAN,
        viscosity_pa_s: None,
        about: "the dissertation's Newtonian oil: Roelands (2.12), Dowson–Higginson (2.10)",
    },
    NamedLubricant {
        name: "barus-oil",
        laws: Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        about: "the fluid of Moes' film formula: Barus (2.11), incompressible",
    },
    NamedLubricant {
        name: "compressible-barus-oil",
        laws: Lubricant { viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        about: "Barus (2.11), Dowson–Higginson (2.10)",
    },
    NamedLubricant {
        name: "squalane-pip",
        laws: SQUALANE_PIP,
        viscosity_pa_s: Some(0.0705),
        about: "squalane with polyisoprene, Table 3.5: Tait, Doolittle, modified Carreau, η₀ 0.0705 Pa·s, NPR 0.2227",
    },
    NamedLubricant {
        name: "pao-650",
        laws: Lubricant {
            density: DensityLaw::Tait(PAO_650_VOLUME),
            viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.422, r_0: 0.6694, volume: PAO_650_VOLUME }),
            shear: ShearLaw::Carreau { critical_stress: 3.1e4, beta: 2.0, n: 0.74, npr: 0.0 },
            limiting_stress: None,
        },
        viscosity_pa_s: Some(1.42),
        about: "PAO 650, Table 3.8: Tait, Doolittle, modified Carreau, η₀ 1.42 Pa·s, NPR 0",
    },
];

/// The lubricant of a name.
///
/// # Errors
/// With a sentence that lists the accepted names.
pub fn by_name(name: &str) -> Result<NamedLubricant, String> {
    let accepted = || NAMED.map(|lubricant| lubricant.name).join(", ");
    let found = NAMED.iter().find(|lubricant| lubricant.name == name).copied();
    found.ok_or_else(|| format!("there is no lubricant of that name; accepted are {}", accepted()))
}
