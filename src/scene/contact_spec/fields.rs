//! Table of the fields that specify a contact, with type, name, description and unit of each, and the interfaces that
//! accept it. A macro generates [`ContactSpec`] and [`Field`] from the table, so that each field is defined once.

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
use crate::solver::physics::machines::Machine;
use crate::solver::physics::surfaces::AsperityLaw;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Generates [`ContactSpec`] and [`Field`] from a table. A row contains the member of the struct, its type, the variant
/// of the enum, the name, the description, and further members of [`Facts`].
macro_rules! contact_fields {
    ($($member:ident: $kind:ty, $field:ident, $word:literal, $about:literal, { $($fact:ident: $value:expr),* };)*) => {
        /// Contact as the user stated it. Fields that were not stated are `None`.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct ContactSpec {
            $(
                #[doc = $about]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $member: Option<$kind>,
            )*
            /// Laws with all constants, as in scenes. A named lubricant replaces them.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub laws: Option<Lubricant>,
            /// Thermal constants of lubricant and bodies, as in scenes.
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

            /// Returns name, description, unit and further properties of the field.
            pub const fn facts(self) -> Facts {
                match self {
                    $(Self::$field => Facts { $($fact: $value,)* ..Facts::new($word, $about) },)*
                }
            }

            /// Returns the accepted words with their meanings; empty if the field is not chosen by a word.
            pub fn choices(self) -> Choices {
                match self {
                    $(Self::$field => <$kind as Given>::choices(),)*
                }
            }

            /// Returns how many numbers a value consists of; 0 if the field is not numeric.
            const fn numbers(self) -> usize {
                match self {
                    $(Self::$field => <$kind as Given>::NUMBERS,)*
                }
            }
        }

        impl ContactSpec {
            /// Returns true if a field is stated.
            pub fn states(&self, field: Field) -> bool {
                match field {
                    $(Field::$field => self.$member.is_some(),)*
                }
            }

            /// Returns the number of a field; `None` if it is not stated or not a number.
            pub fn number(&self, field: Field) -> Option<f64> {
                match field {
                    $(Field::$field => self.$member.as_ref().and_then(Given::number),)*
                }
            }

            /// Sets a number in SI units. No effect on fields that are not numbers. For a number in the unit in which
            /// users type it, see [`Self::set_as_typed`].
            pub fn set(&mut self, field: Field, value: f64) {
                match field {
                    $(Field::$field => self.$member = Given::of_number(value).or(self.$member.take()),)*
                }
            }

            /// Makes a field not stated.
            pub(super) fn forget(&mut self, field: Field) {
                match field {
                    $(Field::$field => self.$member = None,)*
                }
            }

            /// Sets a field from a text without a unit; numbers are in SI units.
            pub(super) fn read_plain(&mut self, field: Field, text: &str) -> Result<(), ValueError> {
                match field {
                    $(Field::$field => self.$member = Some(Given::read(text)?),)*
                }
                Ok(())
            }

            /// Fills fields that are not stated from another specification.
            pub(super) fn filled_from(mut self, other: Self) -> Self {
                $(self.$member = self.$member.or(other.$member);)*
                Self { laws: self.laws.or(other.laws), thermal: self.thermal.or(other.thermal), ..self }
            }
        }
    };
}

contact_fields! {
    contact: ContactKind, Contact, "contact", "Shape of the contact", { default: Some("line"), titles: &["kind"] };
    method: MethodName, Method, "method", "Solution method", { default: Some("full"), absent: &[Words::Columns] };
    rom: PathBuf, Rom, "rom", "Reduced model to use: a file, or the name of an embedded one",
        { note: " (default: the embedded one for the contact)", placeholder: Some("FILE"), absent: &[Words::Columns] };
    machine: Machine, Machine, "machine",
        "Rolling bearing, gear pair or cam in the notation of scenes, which determines radii, speeds and load",
        { note: ", as Gear(teeth: (16, 24), module_m: 0.0045, …)", placeholder: Some("MACHINE") };
    radius: f64, Radius, "radius", "Reduced radius R", { measure: Measure::Of(Quantity::Radius), titles: &["r", "r_x"] };
    radius_y: f64, RadiusY, "radius-y", "Reduced radius R_y across the rolling direction",
        { measure: Measure::Of(Quantity::RadiusY), note: ", for a point contact (default: <radius>)", titles: &["r_y", "ry"],
          variable: "radius_ratio" };
    speed: f64, Speed, "speed", "Mean entrainment speed u_m",
        { measure: Measure::Of(Quantity::Speed), note: ", or <u1> <u2>", titles: &["u_m", "um", "u"] };
    u1: f64, U1, "u1", "Speed of the surface of body 1",
        { measure: Measure::In(Dimension::Speed { radius_m: None }), note: "; with <u2> in place of <speed> and <srr>",
          titles: &["u_1"] };
    u2: f64, U2, "u2", "Speed of the surface of body 2",
        { measure: Measure::In(Dimension::Speed { radius_m: None }), titles: &["u_2"] };
    radius1: f64, Radius1, "radius1", "Radius of body 1 along the rolling direction, negative for a concave surface",
        { measure: Measure::In(Dimension::Length), note: ", with <radius2> in place of <radius>; without one a body is a plane",
          titles: &["r1", "r_1"], absent: &[Words::Variables] };
    radius2: f64, Radius2, "radius2", "Radius of body 2 along the rolling direction, negative for a concave surface",
        { measure: Measure::In(Dimension::Length), titles: &["r2", "r_2"], absent: &[Words::Variables] };
    load: f64, Load, "load", "Load w", { measure: Measure::Of(Quantity::Load), titles: &["w", "f"] };
    length: f64, Length, "length", "Length of a line contact, for its forces, torques and power loss",
        { measure: Measure::In(Dimension::Length), titles: &["width"], absent: &[Words::Variables] };
    total_load: f64, TotalLoad, "total-load", "Load of a line contact over its whole length",
        { measure: Measure::In(Dimension::Force), note: ", with <length> in place of <load>", titles: &["totalload"],
          absent: &[Words::Variables] };
    modulus: f64, Modulus, "modulus", "Reduced modulus E’",
        { measure: Measure::Of(Quantity::Modulus), note: ", or <e1> <nu1> <e2> <nu2>", titles: &["e'", "e’", "e\u{2032}"] };
    e1: f64, E1, "e1", "Young's modulus of body 1", { measure: Measure::In(Dimension::Pressure) };
    nu1: f64, Nu1, "nu1", "Poisson ratio of body 1", {};
    e2: f64, E2, "e2", "Young's modulus of body 2", { measure: Measure::In(Dimension::Pressure) };
    nu2: f64, Nu2, "nu2", "Poisson ratio of body 2", {};
    viscosity: f64, Viscosity, "viscosity", "Viscosity at ambient pressure η₀",
        { measure: Measure::Of(Quantity::Viscosity), note: " (default: that of the named lubricant, if it has one)",
          titles: &["eta_0", "eta0", "η₀", "η0"] };
    alpha: f64, Alpha, "alpha", "Pressure–viscosity coefficient α",
        { measure: Measure::Of(Quantity::Alpha), note: "; not accepted if the lubricant determines it", titles: &["α"] };
    moes_m: f64, MoesM, "moes-m", "Moes' load number M",
        { measure: Measure::Of(Quantity::M), note: "; SI quantities that are not given follow or take default values",
          column: "M", titles: &["m", "moes_m"] };
    moes_l: f64, MoesL, "moes-l", "Moes' lubricant number L",
        { measure: Measure::Of(Quantity::L), column: "L", titles: &["l", "moes_l"] };
    oil: OilGrade, Oil, "oil", "ISO viscosity grade of a mineral oil, as ISO VG 68",
        { note: ", with <temperature>", placeholder: Some("GRADE"), titles: &["isovg", "vg", "iso_vg"] };
    temperature: f64, Temperature, "temperature", "Temperature of the oil of a grade",
        { measure: Measure::In(Dimension::Temperature), bare: Some("°C"), titles: &["t"] };
    lubricant: NamedLubricant, Lubricant, "lubricant",
        "Named lubricant: a set of laws; a given density or viscosity law replaces that of the lubricant",
        { placeholder: Some("NAME") };
    density: DensityLaw, Density, "density", "Density law: dowson-higginson or incompressible",
        { note: " (default: dowson-higginson)", placeholder: Some("LAW") };
    pressure_viscosity: ViscosityLaw, PressureViscosity, "pressure-viscosity", "Viscosity law: roelands or barus",
        { note: " (default: roelands; barus below 6.7e-5 Pa·s, where Roelands' law is not defined)", placeholder: Some("LAW") };
    srr: f64, Srr, "srr", "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m",
        { measure: Measure::Of(Quantity::SlideToRollRatio), note: "; for a Newtonian lubricant it affects only the traction",
          default: Some("0"), titles: &["slip"] };
    npr: f64, Npr, "npr", "Newtonian plateau ratio of a shear-thinning lubricant",
        { measure: Measure::Of(Quantity::NewtonianPlateauRatio), note: " (default: that of the lubricant); 1 is Newtonian" };
    grid: Grid, Grid, "grid", "Grid of a full solution",
        { note: " (default: the dissertation's uniform grid, or a longer or finer one if the contact requires it)" };
    dx: f64, Dx, "dx", "Spacing ΔX of a uniform grid", { note: " (default: 0.005 line, 0.02 point)" };
    dy: f64, Dy, "dy", "Spacing ΔY of a point contact's grid",
        { note: " (default: 0.05); a graded grid is four times finer in the side lobes" };
    domain: Domain, Domain, "domain", "Inlet and outlet end, and outer edge of the half domain of a point contact",
        { note: " (default: -4,2 on a uniform grid, and -2); for a graded grid in its reference coordinate",
          placeholder: Some("X0,X1[,Y0]") };
    cavitation: Cavitation, Cavitation, "cavitation", "Cavitation model of a full solution",
        { default: Some("penalty"), placeholder: Some("MODEL") };
    supply_film: f64, SupplyFilm, "supply-film", "Inlet film thickness of a starved contact",
        { measure: Measure::In(Dimension::Length), note: ", with <cavitation=mass-conserving> (default: a fully flooded inlet)",
          placeholder: Some("METRES") };
    shear: ShearName, Shear, "shear", "Shear-thinning law; replaces that of the named lubricant", { placeholder: Some("LAW") };
    shear_stress: f64, ShearStress, "shear-stress", "Critical stress of the Eyring or Carreau law",
        { measure: Measure::In(Dimension::Pressure), placeholder: Some("PA") };
    shear_beta: f64, ShearBeta, "shear-beta", "Carreau's exponent β_c", { note: " (default: 2)", placeholder: Some("BETA") };
    shear_n: f64, ShearN, "shear-n", "Carreau's power-law exponent n_c", { placeholder: Some("N") };
    limiting_stress: LimitingStress, LimitingStress, "limiting-stress",
        "Limiting shear stress τ_L0 + Λ p: τ_L0 in Pa and the slope Λ",
        { note: ", and optionally an Eyring stress in Pa that affects only the traction", placeholder: Some("TAU0,SLOPE[,TAU_E]") };
    roughness: f64, Roughness, "roughness", "Composite rms roughness σ of both surfaces",
        { measure: Measure::In(Dimension::Length), note: " (default: smooth surfaces)", placeholder: Some("METRES"),
          titles: &["sigma", "σ", "rq", "sq"] };
    asperities: AsperityLaw, Asperities, "asperities",
        "Law of the asperity pressure: greenwood-tripp,ETA_BETA_SIGMA,SIGMA/BETA, zhao-maietta-chang,N_BETA_SIGMA,SIGMA/BETA,HARDNESS in Pa, or exponential,P0 in Pa,C",
        { note: " (default: greenwood-tripp,0.05,0.01)", placeholder: Some("LAW,CONSTANTS") };
    peklenik: f64, Peklenik, "peklenik", "Peklenik number γ of the roughness, above 1 for ridges along the flow",
        { note: ", 1/9 to 9 (default: 1)", titles: &["γ"] };
    shear_flow: f64, ShearFlow, "shear-flow", "Difference (σ₁² − σ₂²)/σ² of the roughness of both surfaces",
        { note: ", where σ₁ is that of the surface that is faster at a positive SRR (default: 0)" };
    boundary_friction: f64, BoundaryFriction, "boundary-friction", "Friction coefficient μ_b of touching asperities",
        { note: " (default: 0.12)", titles: &["mu_b", "μ_b"] };
    wear_rate: f64, WearRate, "wear-rate", "Specific wear rate of Archard's law in m²/N, for the wear of rough surfaces",
        { note: " (default: 0)", placeholder: Some("M2/N") };
    heat: bool, Heat, "heat", "Compute temperatures of film and bodies, and their effect on film thickness and traction",
        { note: " (with <method=reduced>: line and circular contacts by the embedded thermal models, or the model of <rom>)" };
    inlet_temperature: f64, InletTemperature, "inlet-temperature",
        "Inlet temperature of lubricant and bodies, at which viscosity and α are given",
        { measure: Measure::In(Dimension::Temperature), note: " (default: 313.15)", placeholder: Some("K") };
    oil_thermal: [f64; 3], OilThermal, "oil-thermal",
        "Heat capacity in J/(kg K), thermal conductivity in W/(m K) and density in kg/m³ of the lubricant",
        { note: " (default: those of the named lubricant, or 2000,0.14,870)", placeholder: Some("CP,K,RHO0") };
    viscosity_temperature: f64, ViscosityTemperature, "viscosity-temperature",
        "Temperature coefficient of viscosity, β = -d ln η/dT,",
        { measure: Measure::In(Dimension::PerKelvin), note: " (default: 0.045); not with Doolittle's law",
          placeholder: Some("BETA") };
    density_temperature: f64, DensityTemperature, "density-temperature", "Temperature coefficient of density",
        { measure: Measure::In(Dimension::PerKelvin), note: " (default: 6.5e-4); not with Tait's law",
          placeholder: Some("BETA_RHO") };
    body1: BodyHeat, Body1, "body1",
        "Thermal conductivity in W/(m K), heat capacity in J/(kg K) and density in kg/m³ of body 1, which moves with u_m (1 - SRR/2), or a material",
        { note: ": steel, silicon-nitride, bronze, cast-iron, glass, tungsten-carbide (default: steel, 47,460,7850)",
          placeholder: Some("K,C,RHO|MATERIAL") };
    body2: BodyHeat, Body2, "body2", "The same for body 2, which moves with u_m (1 + SRR/2)", { placeholder: Some("K,C,RHO|MATERIAL") };
}

/// Error: no numeric field has this name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{word}` cannot be varied; accepted are {}", varied_words())]
pub struct NotVaried {
    /// Name that was given.
    word: String,
}

/// Returns the names of the fields that can be varied.
fn varied_words() -> String {
    let numbers = Field::of(Words::Flags).filter(|field| field.is_number());
    numbers.map(|field| field.facts().name).collect::<Vec<_>>().join(", ")
}

impl Field {
    /// Returns the fields that an interface accepts.
    pub fn of(words: Words) -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().filter(move |field| !field.facts().absent.contains(&words))
    }

    /// Returns the keyword in Python and the field name in a scene, such as `moes_m`.
    pub fn keyword(self) -> String {
        self.facts().name.replace('-', "_")
    }

    /// Returns the field with this name in results, such as `moes.M`.
    fn in_results(name: &str) -> Option<Self> {
        let name = name.replace('-', "_");
        Self::ALL.iter().copied().find(|field| names::of_field(*field) == name)
    }

    /// Returns the field with this name, written with hyphens or underscores.
    pub fn named(word: &str) -> Option<Self> {
        let word = word.replace('_', "-");
        Self::ALL.iter().copied().find(|field| field.facts().name == word)
    }

    /// Returns the field with this column title. Accepted are its name and its other titles, whatever the case and the
    /// blanks, and its exact name in results. `None` if there is no such field, or if tables do not accept it.
    pub fn titled(title: &str) -> Option<Self> {
        let key: String = title.to_lowercase().split_whitespace().collect();
        let known = |field: &Self| field.facts().titles.contains(&key.as_str());
        let own = Self::named(&key).or_else(|| Self::ALL.iter().copied().find(known));
        let own = own.or_else(|| Self::in_results(title.trim()));
        own.filter(|field| !field.facts().absent.contains(&Words::Columns))
    }

    /// Returns the numeric field with a name. Used for the quantity that a sweep varies. `m` and `l` are short for
    /// `moes-m` and `moes-l`.
    ///
    /// # Errors
    /// If no numeric field has this name. The message lists the accepted names.
    pub fn varied(word: &str) -> Result<Self, NotVaried> {
        let found = match word {
            "m" | "M" => Some(Self::MoesM),
            "l" | "L" => Some(Self::MoesL),
            word => Self::named(word).or_else(|| Self::in_results(word)).filter(|field| field.is_number()),
        };
        found.ok_or_else(|| NotVaried { word: word.to_owned() })
    }

    /// Checks that a text is a valid value of the field by the rules of [`ContactSpec::read_flag`].
    ///
    /// # Errors
    /// If it is not. The message says what is accepted.
    pub fn check(self, text: &str) -> Result<(), ValueError> {
        // The radii are arbitrary. They are needed because a speed in revolutions per minute is converted by a radius.
        let mut spec = ContactSpec { radius1: Some(1.0), radius2: Some(1.0), ..ContactSpec::default() };
        spec.read_typed(self, text)
    }

    /// Returns the key by which fields are sorted before they are read. The kind of contact comes first, because the
    /// unit of the load depends on it. The speeds of the bodies come after their radii, because these convert
    /// revolutions per minute.
    pub fn reading_order(self) -> (bool, Self) {
        (matches!(self, Self::U1 | Self::U2), self)
    }

    /// Returns true if the value is one number.
    pub const fn is_number(self) -> bool {
        self.numbers() == 1
    }

    /// Returns true if a value may begin with a minus sign.
    pub const fn may_be_negative(self) -> bool {
        self.numbers() > 0
    }

    /// Returns true if the field is a switch, which needs no value as a flag.
    pub const fn is_switch(self) -> bool {
        matches!(self, Self::Heat)
    }
}
