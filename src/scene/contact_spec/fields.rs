//! The fields of a contact, each defined once: its type, its word, what it is, its unit, and what interfaces have it.

use super::facts::{Facts, Measure};
use super::given::{Choices, Domain, Given, MethodName, OilGrade, ShearName, ValueError};
use super::words::Words;
use crate::scene::grid::Grid;
use crate::scene::named_lubricant::NamedLubricant;
use crate::scene::names;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::BodyHeat;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::Dimension;
use crate::solver::physics::lubricant::{Cavitation, DensityLaw, Heat, LimitingStress, Lubricant, ViscosityLaw};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Makes [`ContactSpec`] and [`Field`] of a table: member, type, field, word, what it is, further facts.
macro_rules! contact_fields {
    ($($member:ident: $kind:ty, $field:ident, $word:literal, $about:literal, { $($fact:ident: $value:expr),* };)*) => {
        /// A contact as people state it: what was stated, and nothing else.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct ContactSpec {
            $(
                #[doc = $about]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $member: Option<$kind>,
            )*
            /// Laws with all constants, as scenes have them; a named lubricant takes their place.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub laws: Option<Lubricant>,
            /// Thermal constants of lubricant and bodies, as scenes have them.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub thermal: Option<Heat>,
        }

        /// A field of a [`ContactSpec`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum Field {
            $(#[doc = $about] $field,)*
        }

        impl Field {
            /// All fields.
            pub const ALL: &[Self] = &[$(Self::$field),*];

            /// What is known of it.
            pub const fn facts(self) -> Facts {
                match self {
                    $(Self::$field => Facts { $($fact: $value,)* ..Facts::new($word, $about) },)*
                }
            }

            /// The words it is chosen by, with what they mean; empty where it is no choice.
            pub fn choices(self) -> Choices {
                match self {
                    $(Self::$field => <$kind as Given>::choices(),)*
                }
            }

            /// How its values look.
            const fn numbers(self) -> usize {
                match self {
                    $(Self::$field => <$kind as Given>::NUMBERS,)*
                }
            }
        }

        impl ContactSpec {
            /// Whether a field is stated.
            pub fn states(&self, field: Field) -> bool {
                match field {
                    $(Field::$field => self.$member.is_some(),)*
                }
            }

            /// The number of a field; `None` where it is not stated, or no number.
            pub fn number(&self, field: Field) -> Option<f64> {
                match field {
                    $(Field::$field => self.$member.as_ref().and_then(Given::number),)*
                }
            }

            /// States a number in SI units.
            pub fn set(&mut self, field: Field, value: f64) {
                match field {
                    $(Field::$field => self.$member = Given::of_number(value).or(self.$member.take()),)*
                }
            }

            pub(super) fn forget(&mut self, field: Field) {
                match field {
                    $(Field::$field => self.$member = None,)*
                }
            }

            pub(super) fn read_plain(&mut self, field: Field, text: &str) -> Result<(), ValueError> {
                match field {
                    $(Field::$field => self.$member = Some(Given::read(text)?),)*
                }
                Ok(())
            }

            /// What is not stated here is that of another one.
            pub(super) fn filled_from(mut self, other: Self) -> Self {
                $(self.$member = self.$member.or(other.$member);)*
                Self { laws: self.laws.or(other.laws), thermal: self.thermal.or(other.thermal), ..self }
            }
        }
    };
}

contact_fields! {
    contact: ContactKind, Contact, "contact", "Shape of the contact", { default: Some("line"), titles: &["kind"] };
    method: MethodName, Method, "method", "How it is solved", { default: Some("full"), absent: &[Words::Columns] };
    rom: PathBuf, Rom, "rom", "Reduced model to use",
        { note: " (default: the embedded one)", placeholder: Some("FILE"), absent: &[Words::Columns] };
    radius: f64, Radius, "radius", "Reduced radius R", { measure: Measure::Of(Quantity::Radius), titles: &["r", "r_x"] };
    radius_y: f64, RadiusY, "radius-y", "Reduced radius R_y across the rolling direction",
        { measure: Measure::Of(Quantity::RadiusY), note: ", of a point contact (default: <radius>)", titles: &["r_y", "ry"],
          variable: "radius_ratio" };
    speed: f64, Speed, "speed", "Mean entrainment speed u_m",
        { measure: Measure::Of(Quantity::Speed), note: ", or <u1> <u2>", titles: &["u_m", "um", "u"] };
    u1: f64, U1, "u1", "Speed of the surface of body 1",
        { measure: Measure::In(Dimension::Speed { radius_m: None }), note: "; with <u2> in place of <speed> and <srr>",
          titles: &["u_1"] };
    u2: f64, U2, "u2", "Speed of the surface of body 2",
        { measure: Measure::In(Dimension::Speed { radius_m: None }), titles: &["u_2"] };
    load: f64, Load, "load", "Load w", { measure: Measure::Of(Quantity::Load), titles: &["w", "f"] };
    modulus: f64, Modulus, "modulus", "Reduced modulus E’",
        { measure: Measure::Of(Quantity::Modulus), note: ", or <e1> <nu1> <e2> <nu2>", titles: &["e'", "e’", "e\u{2032}"] };
    e1: f64, E1, "e1", "Young's modulus of body 1", { measure: Measure::In(Dimension::Pressure) };
    nu1: f64, Nu1, "nu1", "Poisson ratio of body 1", {};
    e2: f64, E2, "e2", "Young's modulus of body 2", { measure: Measure::In(Dimension::Pressure) };
    nu2: f64, Nu2, "nu2", "Poisson ratio of body 2", {};
    viscosity: f64, Viscosity, "viscosity", "Viscosity at ambient pressure η₀",
        { measure: Measure::Of(Quantity::Viscosity), note: " (default: the named lubricant's, where it has one)",
          titles: &["eta_0", "eta0", "η₀", "η0"] };
    alpha: f64, Alpha, "alpha", "Pressure–viscosity coefficient α",
        { measure: Measure::Of(Quantity::Alpha), note: "; not with a lubricant that determines it", titles: &["α"] };
    moes_m: f64, MoesM, "moes-m", "Moes' load number M",
        { measure: Measure::Of(Quantity::M), note: "; what is not given of the SI quantities follows or takes its default",
          column: "M", titles: &["m", "moes_m"] };
    moes_l: f64, MoesL, "moes-l", "Moes' lubricant number L",
        { measure: Measure::Of(Quantity::L), column: "L", titles: &["l", "moes_l"] };
    oil: OilGrade, Oil, "oil", "ISO viscosity grade of a mineral oil, as ISO VG 68",
        { titles: &["isovg", "vg", "iso_vg"], absent: &[Words::Flags] };
    temperature: f64, Temperature, "temperature", "Temperature of the oil of a grade",
        { measure: Measure::In(Dimension::Temperature), bare: Some("°C"), titles: &["t"], absent: &[Words::Flags] };
    lubricant: NamedLubricant, Lubricant, "lubricant",
        "Named lubricant: a set of laws, which a density or a viscosity law of its own overrides",
        { placeholder: Some("NAME") };
    density: DensityLaw, Density, "density", "Density law: dowson-higginson or incompressible",
        { note: " (default: dowson-higginson)", placeholder: Some("LAW") };
    pressure_viscosity: ViscosityLaw, PressureViscosity, "pressure-viscosity", "Viscosity law: roelands or barus",
        { note: " (default: roelands; barus below 6.7e-5 Pa·s, where Roelands' law is not defined)", placeholder: Some("LAW") };
    srr: f64, Srr, "srr", "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m",
        { measure: Measure::Of(Quantity::SlideToRollRatio), note: "; of a Newtonian fluid it moves only the traction",
          default: Some("0"), titles: &["slip"] };
    npr: f64, Npr, "npr", "Newtonian plateau ratio of a shear-thinning lubricant",
        { measure: Measure::Of(Quantity::NewtonianPlateauRatio), note: " (default: its own); 1 is a Newtonian fluid" };
    grid: Grid, Grid, "grid", "Grid of a full solution",
        { note: " (default: the dissertation's uniform one, or one that does for the contact where that does not)" };
    dx: f64, Dx, "dx", "Spacing ΔX of a uniform grid", { note: " (default: 0.005 line, 0.02 point)" };
    dy: f64, Dy, "dy", "Spacing ΔY of a point contact's grid",
        { note: " (default: 0.05); a graded grid is four times finer in the side lobes" };
    domain: Domain, Domain, "domain", "Inlet and outlet, and outer edge of a point contact's half domain",
        { note: " (default: -4,2 on a uniform grid, and -2); of a graded grid in its reference coordinate",
          placeholder: Some("X0,X1[,Y0]") };
    cavitation: Cavitation, Cavitation, "cavitation", "How the film of a full solution ruptures",
        { default: Some("penalty"), placeholder: Some("MODEL") };
    supply_film: f64, SupplyFilm, "supply-film", "Thickness of the film that the surfaces bring to the inlet",
        { measure: Measure::In(Dimension::Length), note: ", with <cavitation=mass-conserving> (default: a flooded inlet)",
          placeholder: Some("METRES") };
    shear: ShearName, Shear, "shear", "Law of shear thinning in place of the named lubricant's", { placeholder: Some("LAW") };
    shear_stress: f64, ShearStress, "shear-stress", "Eyring's or Carreau's critical stress",
        { measure: Measure::In(Dimension::Pressure), placeholder: Some("PA") };
    shear_beta: f64, ShearBeta, "shear-beta", "Carreau's exponent β_c", { note: " (default: 2)", placeholder: Some("BETA") };
    shear_n: f64, ShearN, "shear-n", "Carreau's power-law exponent n_c", { placeholder: Some("N") };
    limiting_stress: LimitingStress, LimitingStress, "limiting-stress",
        "Limiting stress τ_L0 + Λ p that the film carries at most: Pa and a slope",
        { note: ", and in Pa an Eyring stress of the traction alone", placeholder: Some("TAU0,SLOPE[,TAU_E]") };
    heat: bool, Heat, "heat", "Compute temperatures of film and bodies, and what they do to film and traction",
        { note: " (with <method=reduced>, of lines and circles, by the program's models with heat, or by another one, <rom>)" };
    inlet_temperature: f64, InletTemperature, "inlet-temperature",
        "Temperature of oil and bodies in front of the contact, at which viscosity and α are given",
        { measure: Measure::In(Dimension::Temperature), note: " (default: 313.15)", placeholder: Some("K") };
    oil_thermal: [f64; 3], OilThermal, "oil-thermal",
        "Heat capacity in J/(kg K), thermal conductivity in W/(m K) and density in kg/m³ of the oil",
        { note: " (default: the named lubricant's, or 2000,0.14,870)", placeholder: Some("CP,K,RHO0") };
    viscosity_temperature: f64, ViscosityTemperature, "viscosity-temperature",
        "How viscosity falls with temperature, β = -d ln η/dT,",
        { measure: Measure::In(Dimension::PerKelvin), note: " (default: 0.045); not with Doolittle's law",
          placeholder: Some("BETA") };
    density_temperature: f64, DensityTemperature, "density-temperature", "How density falls with temperature",
        { measure: Measure::In(Dimension::PerKelvin), note: " (default: 6.5e-4); not with Tait's law",
          placeholder: Some("BETA_RHO") };
    body1: BodyHeat, Body1, "body1",
        "Thermal conductivity in W/(m K), heat capacity in J/(kg K) and density in kg/m³ of body 1, which moves with u_m (1 - SRR/2), or a material",
        { note: ": steel, silicon-nitride, bronze, cast-iron, glass, tungsten-carbide (default: steel, 47,460,7850)",
          placeholder: Some("K,C,RHO|MATERIAL") };
    body2: BodyHeat, Body2, "body2", "The same of body 2, which moves with u_m (1 + SRR/2)", { placeholder: Some("K,C,RHO|MATERIAL") };
}

/// No numeric field has this word.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{word}` cannot be varied; accepted are {}", varied_words())]
pub struct NotVaried {
    /// The word.
    word: String,
}

/// The words that can be varied.
fn varied_words() -> String {
    let numbers = Field::of(Words::Flags).filter(|field| field.is_number());
    numbers.map(|field| field.facts().name).collect::<Vec<_>>().join(", ")
}

impl Field {
    /// The fields of an interface.
    pub fn of(words: Words) -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().filter(move |field| !field.facts().absent.contains(&words))
    }

    /// Its keyword in Python and its field in a scene, such as `moes_m`.
    pub fn keyword(self) -> String {
        self.facts().name.replace('-', "_")
    }

    /// The field that results have by a name, such as `moes.M`.
    fn in_results(name: &str) -> Option<Self> {
        let name = name.replace('-', "_");
        Self::ALL.iter().copied().find(|field| names::of_field(*field) == name)
    }

    /// The field of a word, with hyphens or underscores.
    pub fn named(word: &str) -> Option<Self> {
        let word = word.replace('_', "-");
        Self::ALL.iter().copied().find(|field| field.facts().name == word)
    }

    /// The field of a title, as people write it in a table.
    pub fn titled(title: &str) -> Option<Self> {
        let key: String = title.to_lowercase().split_whitespace().collect();
        let known = |field: &Self| field.facts().titles.contains(&key.as_str());
        let own = Self::named(&key).or_else(|| Self::ALL.iter().copied().find(known));
        let own = own.or_else(|| Self::in_results(title.trim()));
        own.filter(|field| !field.facts().absent.contains(&Words::Columns))
    }

    /// The numeric field that a word varies; `m` and `l` are short for `moes-m` and `moes-l`.
    ///
    /// # Errors
    /// With the accepted words.
    pub fn varied(word: &str) -> Result<Self, NotVaried> {
        let found = match word {
            "m" | "M" => Some(Self::MoesM),
            "l" | "L" => Some(Self::MoesL),
            word => Self::named(word).or_else(|| Self::in_results(word)).filter(|field| field.is_number()),
        };
        found.ok_or_else(|| NotVaried { word: word.to_owned() })
    }

    /// Refuses a text that is no value of it.
    ///
    /// # Errors
    /// With what is accepted.
    pub fn check(self, text: &str) -> Result<(), ValueError> {
        ContactSpec::default().read_plain(self, text)
    }

    /// Whether its value is one number.
    pub const fn is_number(self) -> bool {
        self.numbers() == 1
    }

    /// Whether a value may begin with a minus sign.
    pub const fn may_be_negative(self) -> bool {
        self.numbers() > 0
    }

    /// Whether it is on or off.
    pub const fn is_switch(self) -> bool {
        matches!(self, Self::Heat)
    }
}
