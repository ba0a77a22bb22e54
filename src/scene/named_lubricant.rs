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
    /// Pressure–viscosity coefficient α \[1/Pa\], if the name determines it other than by its viscosity law.
    pub alpha_per_pa: Option<f64>,
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
/// Squalane at 40 °C, Bair 2006: K₀ = 8.658 GPa exp(−6.332e-3 T) at T = 313.15 K.
const SQUALANE: Tait = Tait { k_0: 1.1922e9, k_0_prime: 11.74 };
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
pub static NAMED: [NamedLubricant; 13] = [
    NamedLubricant {
        name: "mineral-oil",
        title: "Mineral oil",
        laws: MINERAL_OIL,
        viscosity_pa_s: None,
        alpha_per_pa: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "Newtonian film: Roelands, Dowson–Higginson; Eyring traction with a limiting stress",
    },
    NamedLubricant {
        name: "roelands-oil",
        title: "Roelands oil",
        laws: NEWTONIAN,
        viscosity_pa_s: None,
        alpha_per_pa: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "the dissertation's Newtonian oil: Roelands, Dowson–Higginson",
    },
    NamedLubricant {
        name: "barus-oil",
        title: "Barus oil",
        laws: Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        alpha_per_pa: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "the fluid of Moes' film formula: Barus, incompressible",
    },
    NamedLubricant {
        name: "compressible-barus-oil",
        title: "Barus oil, compressible",
        laws: Lubricant { viscosity: ViscosityLaw::Barus, ..NEWTONIAN },
        viscosity_pa_s: None,
        alpha_per_pa: None,
        heat: OilHeat::MINERAL,
        studied: None,
        about: "Barus, Dowson–Higginson",
    },
    NamedLubricant {
        name: "squalane-pip",
        title: "Squalane with PIP",
        laws: SQUALANE_PIP,
        viscosity_pa_s: Some(0.0705),
        alpha_per_pa: None,
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
        alpha_per_pa: None,
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
    NamedLubricant {
        name: "squalane",
        title: "Squalane",
        laws: Lubricant {
            density: DensityLaw::Tait(SQUALANE),
            viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.71, r_0: 0.6568, volume: SQUALANE }),
            ..NEWTONIAN
        },
        viscosity_pa_s: Some(0.0157),
        alpha_per_pa: None,
        heat: HYDROCARBON,
        studied: None,
        about: "squalane at 40 °C, Bair 2006: Tait, Doolittle, η₀ 15.7 mPa·s, α* 17.8/GPa",
    },
    newtonian(
        ("water", "Water"),
        (0.89e-3, 0.36e-9),
        OilHeat { heat_capacity: 4180.0, conductivity: 0.607, density: 997.0, ..OilHeat::MINERAL },
        "water at 25 °C: η₀ 0.89 mPa·s (IAPWS 2008), usual α 0.36/GPa; its film is nearly isoviscous",
    ),
    newtonian(
        ("pao-4", "PAO 4"),
        (0.0153, 13e-9),
        OilHeat { density: 805.0, ..OilHeat::MINERAL },
        "polyalphaolefin of 4 cSt at 100 °C, at 40 °C: 19.0 cSt by data sheets, representative α 13/GPa",
    ),
    newtonian(
        ("pao-10", "PAO 10"),
        (0.054, 15e-9),
        OilHeat { density: 820.0, ..OilHeat::MINERAL },
        "polyalphaolefin of 10 cSt at 100 °C, at 40 °C: 66 cSt by data sheets, representative α 15/GPa",
    ),
    newtonian(
        ("pao-40", "PAO 40"),
        (0.331, 18e-9),
        OilHeat { density: 835.0, ..OilHeat::MINERAL },
        "polyalphaolefin of 40 cSt at 100 °C, at 40 °C: 396 cSt by data sheets, α 18/GPa of a like oil, Jones 1975",
    ),
    newtonian(
        ("pao-100", "PAO 100"),
        (1.04, 20e-9),
        OilHeat { density: 838.0, ..OilHeat::MINERAL },
        "polyalphaolefin of 100 cSt at 100 °C, at 40 °C: 1240 cSt by data sheets, representative α 20/GPa",
    ),
    newtonian(
        ("pfpe", "PFPE, branched"),
        (0.181, 41.7e-9),
        OilHeat { heat_capacity: 1000.0, conductivity: 0.09, density: 1860.0, ..OilHeat::MINERAL },
        "fluorinated polyether (Krytox 143AB) at 38 °C, Jones, Johnson, Winer & Sanborn 1975: 181 mPa·s, α* 41.7/GPa",
    ),
];

/// Returns a lubricant with the dissertation's laws and its own constants η₀ \[Pa·s\] and α \[1/Pa\].
const fn newtonian(
    (name, title): (&'static str, &'static str),
    (viscosity, alpha): (f64, f64),
    heat: OilHeat,
    about: &'static str,
) -> NamedLubricant {
    NamedLubricant {
        name,
        title,
        laws: NEWTONIAN,
        viscosity_pa_s: Some(viscosity),
        alpha_per_pa: Some(alpha),
        heat,
        studied: None,
        about,
    }
}

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
        let load = if kind.is_line() { studied.load_n_per_m } else { studied.load_n };
        let StudiedContact { radius_m, modulus_pa, speed_m_per_s, .. } = studied;
        let quantities = [radius_m, speed_m_per_s, load, modulus_pa, viscosity, self.laws.own_coefficient()?];
        Some(OperatingPoint::from_quantities(kind, quantities, Sliding::NONE))
    }
}

/// Returns the named lubricant with these laws, and with the constants η₀ and α of this point if it defines both. If no
/// lubricant has all of them, returns one with the same film thickness, ignoring the stress that limits the traction.
pub fn of_laws(laws: &Lubricant, point: &OperatingPoint) -> Option<&'static NamedLubricant> {
    let laws = Lubricant { heat: None, ..*laws };
    let constants = Some((point.viscosity_pa_s, point.alpha_per_pa));
    let own = |named: &NamedLubricant| named.viscosity_pa_s.zip(named.alpha_per_pa);
    let same = |named: &NamedLubricant| Lubricant { cavitation: laws.cavitation, ..named.laws } == laws;
    let film = |named: &NamedLubricant| {
        named.laws.limiting_stress.is_none() && named.laws.of_the_liquid() == laws.of_the_liquid()
    };
    let with = |fits: &dyn Fn(&NamedLubricant) -> bool| {
        let exact = NAMED.iter().find(|named| own(named) == constants && fits(named));
        exact.or_else(|| NAMED.iter().find(|named| own(named).is_none() && fits(named)))
    };
    with(&same).or_else(|| with(&film))
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
    fn lubricant_keeps_its_name_under_a_limiting_stress() {
        let limited = Lubricant {
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: None }),
            ..SQUALANE_PIP
        };
        let point = OperatingPoint::TABLE_2_1;
        assert_eq!(of_laws(&limited, &point).map(|named| named.name), Some("squalane-pip"));
        let thicker = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..SQUALANE_PIP };
        assert_eq!(of_laws(&thicker, &point), None);
    }

    #[test]
    fn a_lubricant_with_its_own_constants_is_recognised_by_them() {
        let name = |viscosity_pa_s, alpha_per_pa| {
            let point = OperatingPoint { viscosity_pa_s, alpha_per_pa, ..OperatingPoint::TABLE_2_1 };
            of_laws(&NEWTONIAN, &point).map(|named| named.name)
        };
        assert_eq!(name(0.89e-3, 0.36e-9), Some("water"));
        assert_eq!(name(1.04, 20e-9), Some("pao-100"));
        assert_eq!(name(1.05, 20e-9), Some("roelands-oil"));
    }

    #[test]
    fn squalane_has_the_published_pressure_viscosity_coefficient() {
        // Bair 2006: α* of squalane at 40 °C is 17.8/GPa, and η(1 GPa) about 1.7 kPa·s.
        let laws = by_name("squalane").unwrap().laws;
        let alpha = laws.own_coefficient().unwrap();
        assert!((alpha / 17.8e-9 - 1.0).abs() < 0.02, "{alpha}");
    }
}
