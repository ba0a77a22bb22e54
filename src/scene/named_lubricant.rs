//! Named lubricants: sets of laws with a name for the command line and for users.

use crate::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use crate::solver::physics::lubricant::{
    Cavitation, DensityLaw, Doolittle, FreeVolumeHeat, LimitingStress, Lubricant, OilHeat, ShearLaw, Tait, ViscosityLaw,
};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Lubricant with a name and a description. Files store only the name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedLubricant {
    /// Name on the command line.
    pub name: &'static str,
    /// Name shown to users.
    pub title: &'static str,
    /// Its laws.
    pub laws: Lubricant,
    /// Viscosity at ambient pressure η₀ \[Pa·s\], if the name determines it.
    pub viscosity_pa_s: Option<f64>,
    /// Thermal constants: typical values, not those of the source.
    pub heat: OilHeat,
    /// Contact that the source studies, if the lubricant has its own ambient viscosity.
    pub studied: Option<StudiedContact>,
    /// Description for users.
    pub about: &'static str,
}

/// Bodies, speed and loads used in a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudiedContact {
    /// Reduced radius R \[m\].
    pub radius_m: f64,
    /// Reduced modulus E′ \[Pa\].
    pub modulus_pa: f64,
    /// Mean entrainment speed u_m \[m/s\].
    pub speed_m_per_s: f64,
    /// Load w of the point contact \[N\].
    pub load_n: f64,
    /// Load w of the line contact with the same Hertzian pressure \[N/m\].
    pub load_n_per_m: f64,
}

const NEWTONIAN: Lubricant = Lubricant {
    density: DensityLaw::DowsonHigginson,
    viscosity: ViscosityLaw::Roelands,
    shear: ShearLaw::Newtonian,
    limiting_stress: None,
    cavitation: Cavitation::Penalty,
    heat: None,
    roughness: None,
};

/// Thermal constants of a synthetic hydrocarbon whose viscosity follows from its free volume.
const HYDROCARBON: OilHeat = OilHeat {
    density: 850.0,
    free_volume: Some(FreeVolumeHeat { bulk_modulus_temperature: 6e-3, expansion: 8e-4, occupied_expansion: -5e-4 }),
    ..OilHeat::MINERAL
};

const SQUALANE_VOLUME: Tait = Tait { k_0: 1.007837e9, k_0_prime: 11.29 };
const PAO_650_VOLUME: Tait = Tait { k_0: 1.4252e9, k_0_prime: 12.82 };

/// Squalane with polyisoprene, Table 3.5. Its η₀ is 0.0705 Pa·s.
pub const SQUALANE_PIP: Lubricant = Lubricant {
    density: DensityLaw::Tait(SQUALANE_VOLUME),
    viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.2, r_0: 0.658, volume: SQUALANE_VOLUME }),
    shear: ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 },
    limiting_stress: None,
    cavitation: Cavitation::Penalty,
    heat: None,
    roughness: None,
};

/// The dissertation's lubricant with typical friction constants: an Eyring stress of 5 MPa and a limiting shear stress
/// of 5 % of the pressure. They affect only the traction; pressure and film thickness are those of a Newtonian
/// lubricant.
pub const MINERAL_OIL: Lubricant =
    Lubricant { limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) }), ..NEWTONIAN };

/// All named lubricants.
pub static NAMED: [NamedLubricant; 6] = [
    NamedLubricant {
        name: "mineral-oil",
        title: "Mineral oil",
        laws: MINERAL_OIL,
        viscosity_pa_s: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "Newtonian film: Roelands, Dowson–Higginson; Eyring traction with a limiting stress",
    },
    NamedLubricant {
        name: "roelands-oil",
        title: "Roelands oil",
        laws: NEWTONIAN,
        viscosity_pa_s: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "the dissertation's Newtonian oil: Roelands, Dowson–Higginson",
    },
    NamedLubricant {
        name: "barus-oil",
        title: "Barus oil",
        laws: Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "the fluid of Moes' film formula: Barus, incompressible",
    },
    NamedLubricant {
        name: "compressible-barus-oil",
        title: "Barus oil, compressible",
        laws: Lubricant { viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "Barus, Dowson–Higginson",
    },
    NamedLubricant {
        name: "squalane-pip",
        title: "Squalane with PIP",
        laws: SQUALANE_PIP,
        viscosity_pa_s: Some(0.0705),
        heat: HYDROCARBON,
        studied: Some(StudiedContact {
            radius_m: 12.7e-3,
            modulus_pa: 123.878213951e9,
            speed_m_per_s: 0.74,
            load_n: 23.0,
            load_n_per_m: 144e3,
        }),
        about: "squalane with polyisoprene, Table 3.5: Tait, Doolittle, modified Carreau, η₀ 0.0705 Pa·s, NPR 0.2227",
    },
    NamedLubricant {
        name: "pao-650",
        title: "PAO 650",
        laws: Lubricant {
            density: DensityLaw::Tait(PAO_650_VOLUME),
            viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.422, r_0: 0.6694, volume: PAO_650_VOLUME }),
            shear: ShearLaw::Carreau { critical_stress: 3.1e4, beta: 2.0, n: 0.74, npr: 0.0 },
            limiting_stress: None,
            cavitation: Cavitation::Penalty,
            heat: None,
            roughness: None,
        },
        viscosity_pa_s: Some(1.42),
        heat: HYDROCARBON,
        studied: Some(StudiedContact {
            radius_m: 12.7e-3,
            modulus_pa: 123.878213951e9,
            speed_m_per_s: 0.074,
            load_n: 32.0,
            load_n_per_m: 179.5e3,
        }),
        about: "PAO 650, Table 3.8: Tait, Doolittle, modified Carreau, η₀ 1.42 Pa·s, NPR 0",
    },
];

impl Serialize for NamedLubricant {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl<'de> Deserialize<'de> for NamedLubricant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        by_name(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl NamedLubricant {
    /// Returns the contact that the source studies, in pure rolling; `None` if the lubricant has no such contact.
    pub fn studied_contact(&self, kind: ContactKind) -> Option<OperatingPoint> {
        let (viscosity, studied) = (self.viscosity_pa_s?, self.studied?);
        let load = match kind {
            ContactKind::Line => studied.load_n_per_m,
            ContactKind::Point => studied.load_n,
        };
        let StudiedContact { radius_m, modulus_pa, speed_m_per_s, .. } = studied;
        let quantities = [radius_m, speed_m_per_s, load, modulus_pa, viscosity, self.laws.own_coefficient()?];
        Some(OperatingPoint::from_quantities(kind, quantities, Sliding::NONE))
    }
}

/// Returns the named lubricant with these laws. If no lubricant has all of them, returns one with the same film
/// thickness, ignoring the stress that limits the traction.
pub fn of_laws(laws: &Lubricant) -> Option<&'static NamedLubricant> {
    let laws = Lubricant { heat: None, ..*laws };
    let film = |named: &&NamedLubricant| {
        named.laws.limiting_stress.is_none() && named.laws.of_the_liquid() == laws.of_the_liquid()
    };
    let same = |named: &&NamedLubricant| Lubricant { cavitation: laws.cavitation, ..named.laws } == laws;
    NAMED.iter().find(same).or_else(|| NAMED.iter().find(film))
}

/// Error: no lubricant has this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no lubricant of that name; accepted are {}", NAMED.map(|lubricant| lubricant.name).join(", "))]
pub struct UnknownLubricant;

/// Returns the lubricant with this name.
///
/// # Errors
/// If there is none. The message lists the accepted names.
pub fn by_name(name: &str) -> Result<NamedLubricant, UnknownLubricant> {
    NAMED.iter().find(|lubricant| lubricant.name == name).copied().ok_or(UnknownLubricant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::full::Problem;

    #[test]
    fn studied_contacts_have_the_pressures_of_their_sources() {
        // Tables 3.5 and 3.8 (point contacts). The line contacts have the same Hertzian pressure.
        for (name, pressure_pa) in [("squalane-pip", 0.4728e9), ("pao-650", 0.5278e9)] {
            let named = by_name(name).unwrap();
            for kind in [ContactKind::Line, ContactKind::Point] {
                let point = named.studied_contact(kind).unwrap();
                let problem = Problem::new(&point, named.laws).unwrap();
                assert!((point.hertz().pressure_pa / pressure_pa - 1.0).abs() < 2e-3, "{name}, {kind:?}");
                assert_eq!(problem.point.alpha_per_pa, point.alpha_per_pa);
            }
        }
        assert_eq!(by_name("roelands-oil").unwrap().studied_contact(ContactKind::Line), None);
    }

    #[test]
    fn a_lubricant_keeps_its_name_under_a_limiting_stress_and_loses_it_with_other_constants() {
        let limited = Lubricant {
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: None }),
            ..SQUALANE_PIP
        };
        assert_eq!(of_laws(&limited).map(|named| named.name), Some("squalane-pip"));
        let thicker = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..SQUALANE_PIP };
        assert_eq!(of_laws(&thicker), None);
    }
}
