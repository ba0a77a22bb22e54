//! The quantities of a contact, each defined once: names, symbol, units, range, and how it is read and set.

use super::scale::Scale;
use crate::solver::physics::bodies::BodyHeat;
use crate::solver::physics::contact::{ContactKind, Ellipse, OperatingPoint, expected_film, limits};
use crate::solver::physics::engineering::{Dimension, QuantityKind, Unit, UnitSystem};
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw, roelands_exponent};
use serde::{Deserialize, Serialize};

/// A quantity of a contact. The names of the variants are those of scenes and model files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Quantity {
    /// Load number M.
    M,
    /// Lubricant number L.
    L,
    /// Reduced radius R \[m\].
    Radius,
    /// Reduced radius across R_y \[m\], of a point contact.
    RadiusY,
    /// R_y/R, of a point contact.
    RadiusRatio,
    /// Mean entrainment speed u_m \[m/s\].
    Speed,
    /// Load w: \[N/m\] for a line, \[N\] for a point contact.
    Load,
    /// Reduced modulus E′ \[Pa\].
    Modulus,
    /// Viscosity at ambient pressure η₀ \[Pa·s\].
    Viscosity,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    Alpha,
    /// Slide-to-roll ratio SRR.
    SlideToRollRatio,
    /// Newtonian plateau ratio NPR.
    NewtonianPlateauRatio,
    /// Maximum Hertzian pressure p_H \[Pa\].
    HertzPressure,
    /// Roelands' exponent z.
    RoelandsExponent,
    /// Central film thickness H_c in units of a²/R, by Moes' formula.
    FilmThickness,
    /// Film ratio λ = h/σ of the smooth contact: its central film thickness h by Moes' formula, divided by the
    /// composite roughness σ. Contacts of a space have the reference roughness [`REFERENCE_ROUGHNESS_M`].
    SmoothFilmRatio,
    /// Composite roughness S = σR/a² in units of the film thickness; of the reference roughness in a space.
    RoughnessNumber,
    /// Sliding speed |SRR| u_m \[m/s\].
    SlidingSpeed,
    /// κ₁ = p_H a/R \[Pa\], (3.27).
    StressUnit,
    /// Difference of shear stress \[Pa\] across a film of the thickness given by Moes' formula, for a gradient of p_H
    /// over the half-width.
    GradientStress,
    /// Eyring stress τ₀ \[Pa\].
    EyringStress,
    /// Temperature T₀ of the inlet \[K\].
    InletTemperature,
    /// β = −d ln η/dT of the oil \[1/K\].
    ViscosityTemperature,
    /// β_ρ = −d ln ρ/dT of the oil \[1/K\].
    DensityTemperature,
    /// Thermal conductivity k of the oil \[W/(m K)\].
    Conductivity,
    /// Volumetric heat capacity ρ₀c of the oil \[J/(m³ K)\].
    HeatCapacity,
    /// Effusivity √(kρc) of body 1 \[J/(m² K √s)\].
    Effusivity1,
    /// Effusivity √(kρc) of body 2 \[J/(m² K √s)\].
    Effusivity2,
    /// Limiting stress τ_L0 at ambient pressure \[Pa\].
    LimitAmbient,
    /// Slope Λ of the limiting stress with pressure.
    LimitSlope,
    /// Stress τ_E \[Pa\] at which the limiting stress begins to bend the flow curve.
    LimitEyring,
}

/// Composite rms roughness σ \[m\] of the contacts of a space that varies the film ratio. At equal M and L all
/// dimensionless numbers of a rough contact depend on R/σ alone, so that R realises the film ratio.
pub const REFERENCE_ROUGHNESS_M: f64 = 1e-7;

/// Definition of a quantity.
struct Facts {
    /// Word in tables, options and messages.
    name: &'static str,
    /// Display name, with symbol and SI unit.
    label: &'static str,
    /// Name of its field in a form, with the symbol in braces.
    field: &'static str,
    /// Symbol and its subscript.
    symbol: (&'static str, &'static str),
    /// Short name in sentences.
    short: &'static str,
    /// SI unit behind a number, with a leading space, or empty.
    unit: &'static str,
    /// Kind, which determines its unit on the screen. That of the load is the one of a point contact.
    kind: QuantityKind,
    /// Smallest and largest accepted value.
    range: (f64, f64),
    /// Usual spread of values.
    scale: Scale,
}

impl Quantity {
    /// Quantities by which an operating point can be varied. All others follow from these, or belong to lubricant and
    /// bodies.
    pub const VARIED: [Self; 12] = [
        Self::M,
        Self::L,
        Self::Radius,
        Self::RadiusY,
        Self::RadiusRatio,
        Self::Speed,
        Self::Load,
        Self::Modulus,
        Self::Viscosity,
        Self::Alpha,
        Self::SlideToRollRatio,
        Self::NewtonianPlateauRatio,
    ];

    /// The six SI quantities, in the order of [`OperatingPoint::quantities`].
    pub const SI: [Self; 6] = [Self::Radius, Self::Speed, Self::Load, Self::Modulus, Self::Viscosity, Self::Alpha];

    #[rustfmt::skip]
    const fn facts(self) -> Facts {
        use QuantityKind as K;
        let (name, label, field, symbol, short, unit, kind, range, scale) = match self {
            Self::M => ("M", "Load number M", "Load number {M}", ("M", ""), "M", "", K::Number, limits::M.range, Scale::Log),
            Self::L => ("L", "Lubricant number L", "Lubricant {L}", ("L", ""), "L", "", K::Number, limits::L.range, Scale::Linear),
            Self::Radius => (limits::RADIUS.name, "Radius R [m]", "Radius {R}", ("R", ""), "R", limits::RADIUS.unit, K::Length, limits::RADIUS.range, Scale::Log),
            Self::RadiusY => (limits::RADIUS_Y.name, "Radius across R_y [m]", "Radius across {R_y}", ("R", "y"), "R_y", limits::RADIUS_Y.unit, K::Length, limits::RADIUS_Y.range, Scale::Log),
            Self::RadiusRatio => ("radius-ratio", "Ratio of radii R_y/R", "Ratio of radii {R_y}/{R}", ("R_y/R", ""), "the ratio of radii", "", K::Number, Ellipse::RADIUS_RATIOS, Scale::Log),
            Self::Speed => (limits::SPEED.name, "Entrainment speed u_m [m/s]", "Speed {u_m}", ("u", "m"), "u_m", limits::SPEED.unit, K::Speed, limits::SPEED.range, Scale::Log),
            Self::Load => (limits::LOAD.name, "Load w [N/m or N]", "Load {w}", ("w", ""), "w", limits::LOAD.unit, K::Force, limits::LOAD.range, Scale::Log),
            Self::Modulus => (limits::MODULUS.name, "Reduced modulus E’ [Pa]", "Modulus {E'}", ("E'", ""), "E'", limits::MODULUS.unit, K::Pressure, limits::MODULUS.range, Scale::Log),
            Self::Viscosity => (limits::VISCOSITY.name, "Viscosity η₀ [Pa s]", "Viscosity {η_0}", ("η", "0"), "η₀", limits::VISCOSITY.unit, K::Viscosity, limits::VISCOSITY.range, Scale::Log),
            Self::Alpha => (limits::ALPHA.name, "Pressure–viscosity coefficient α [1/Pa]", "Coefficient {α}", ("α", ""), "α", limits::ALPHA.unit, K::PressureCoefficient, limits::ALPHA.range, Scale::Log),
            Self::SlideToRollRatio => ("srr", "Slide-to-roll ratio SRR", "Slide-to-roll ratio", ("SRR", ""), "SRR", "", K::Percent, (-10.0, 10.0), Scale::Linear),
            Self::NewtonianPlateauRatio => ("npr", "Newtonian plateau ratio NPR", "Plateau ratio", ("NPR", ""), "NPR", "", K::Number, (0.0, 1.0), Scale::Linear),
            Self::HertzPressure => ("hertz-pressure", "Hertzian pressure p_H [Pa]", "Pressure {p_H}", ("p", "H"), "p_H", " Pa", K::Pressure, (0.0, 1e12), Scale::Log),
            Self::RoelandsExponent => ("roelands-exponent", "Roelands’ exponent z", "Exponent {z}", ("z", ""), "Roelands’ z", "", K::Number, (0.05, 2.0), Scale::Linear),
            Self::FilmThickness => ("film-thickness", "Central film thickness H_c by Moes’ formula", "Film {H_c}", ("H", "c"), "H_c by Moes’ formula", "", K::Number, (0.0, 1e6), Scale::Log),
            Self::SmoothFilmRatio => ("smooth-film-ratio", "Film ratio λ of the smooth contact", "Film ratio {λ}", ("λ", ""), "λ of the smooth film", "", K::Number, (1e-3, 1e3), Scale::Log),
            Self::RoughnessNumber => ("roughness-number", "Roughness S = σR/a²", "Roughness {S}", ("S", ""), "S = σR/a²", "", K::Number, (0.0, 1e3), Scale::Log),
            Self::SlidingSpeed => ("sliding-speed", "Sliding speed SRR u_m [m/s]", "Sliding speed", ("Δu", ""), "the sliding speed SRR u_m", " m/s", K::Speed, (0.0, 1e3), Scale::Linear),
            Self::StressUnit => ("stress-unit", "Unit of shear stress κ₁ [Pa]", "Stress {κ_1}", ("κ", "1"), "κ₁ = p_H a/R", " Pa", K::Stress, (0.0, 1e15), Scale::Log),
            Self::GradientStress => ("gradient-stress", "Shear stress by the pressure gradient [Pa]", "Gradient stress", ("τ", "p"), "the shear stress by the pressure gradient", " Pa", K::Stress, (0.0, 1e12), Scale::Log),
            Self::EyringStress => ("eyring-stress", "Eyring stress τ₀ [Pa]", "Eyring stress {τ_0}", ("τ", "0"), "the Eyring stress τ₀", " Pa", K::Stress, (1e3, 1e12), Scale::Log),
            Self::InletTemperature => ("inlet-temperature", "Inlet temperature T₀ [K]", "Inlet", ("T", "0"), "the inlet temperature", " K", K::Temperature, (200.0, 600.0), Scale::Linear),
            Self::ViscosityTemperature => ("viscosity-temperature", "Temperature coefficient of viscosity β [1/K]", "Coefficient {β}", ("β", ""), "β", " 1/K", K::PerKelvin, (0.0, 0.2), Scale::Linear),
            Self::DensityTemperature => ("density-temperature", "Temperature coefficient of density β_ρ [1/K]", "Coefficient {β_ρ}", ("β", "ρ"), "β_ρ", " 1/K", K::PerKelvin, (0.0, 0.01), Scale::Linear),
            Self::Conductivity => ("conductivity", "Thermal conductivity of the oil k [W/(m K)]", "Conductivity {k}", ("k", ""), "the thermal conductivity of the oil", " W/(m K)", K::Conductivity, (1e-3, 100.0), Scale::Linear),
            Self::HeatCapacity => ("heat-capacity", "Heat capacity of the oil ρ₀c [J/(m³ K)]", "Heat capacity {ρc}", ("ρc", ""), "ρ₀c of the oil", " J/(m³ K)", K::VolumetricHeatCapacity, (1e4, 1e8), Scale::Linear),
            Self::Effusivity1 => ("effusivity-1", "Effusivity of body 1 √(kρc) [J/(m² K √s)]", "Effusivity 1", ("e", "1"), "√(kρc) of body 1", " J/(m² K √s)", K::Effusivity, (10.0, 1e6), Scale::Log),
            Self::Effusivity2 => ("effusivity-2", "Effusivity of body 2 √(kρc) [J/(m² K √s)]", "Effusivity 2", ("e", "2"), "√(kρc) of body 2", " J/(m² K √s)", K::Effusivity, (10.0, 1e6), Scale::Log),
            Self::LimitAmbient => ("limit-ambient", "Limiting stress at ambient pressure τ_L0 [Pa]", "Limit {τ_L0}", ("τ", "L0"), "τ_L0 of the limiting stress", " Pa", K::Stress, (0.0, 1e9), Scale::Linear),
            Self::LimitSlope => ("limit-slope", "Slope of the limiting stress Λ", "Slope {Λ}", ("Λ", ""), "Λ of the limiting stress", "", K::Number, (1e-4, 1.0), Scale::Linear),
            Self::LimitEyring => ("limit-eyring", "Eyring stress of the limiting stress τ_E [Pa]", "Limit {τ_E}", ("τ", "E"), "τ_E of the limiting stress", " Pa", K::Stress, (1e4, 1e9), Scale::Linear),
        };
        Facts { name, label, field, symbol, short, unit, kind, range, scale }
    }

    /// Returns the word that stands for it in tables, options and messages.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns its display name, with symbol and SI unit.
    pub fn label(self) -> &'static str {
        self.facts().label
    }

    /// Returns the name of its field in a form, with the symbol in braces.
    pub fn field(self) -> &'static str {
        self.facts().field
    }

    /// Returns its symbol and the subscript of that.
    pub fn symbol(self) -> (&'static str, &'static str) {
        self.facts().symbol
    }

    /// Returns its short name in sentences.
    pub fn short(self) -> &'static str {
        self.facts().short
    }

    /// Returns its definition, with the equation.
    pub fn meaning(self, kind: ContactKind) -> &'static str {
        match (self, kind) {
            (Self::M, ContactKind::Line) => "Load number M = w/(E’R) · (2η₀u_m/(E’R))^(−1/2) (3.19)",
            (Self::M, ContactKind::Point) => "Load number M = w/(E’R²) · (2η₀u_m/(E’R))^(−3/4) (3.22)",
            (Self::L, _) => "Lubricant number L = αE’ · (2η₀u_m/(E’R))^(1/4)",
            (Self::Radius, _) => "Reduced radius of curvature, 1/R = 1/R₁ + 1/R₂ (2.3)",
            (Self::RadiusY, _) => "Reduced radius across the rolling direction, 1/R_y = 1/R_y1 + 1/R_y2",
            (Self::RadiusRatio, _) => "Radius across over radius along: 1 is a circle, large ones are nearly lines",
            (Self::Speed, _) => "Mean entrainment speed, u_m = (u₁ + u₂)/2 (2.1)",
            (Self::Load, ContactKind::Line) => "Load per unit length of the line contact (2.9)",
            (Self::Load, ContactKind::Point) => "Load of the point contact (2.9)",
            (Self::Modulus, _) => "Reduced modulus, 2/E’ = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (2.5)",
            (Self::Viscosity, _) => "Viscosity at ambient pressure",
            (Self::Alpha, _) => "Pressure–viscosity coefficient, the slope of ln η at ambient pressure",
            (Self::SlideToRollRatio, _) => "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25)",
            (Self::NewtonianPlateauRatio, _) => "Newtonian plateau ratio NPR of (3.40)",
            _ => self.label(),
        }
    }

    /// Returns its SI unit as it stands behind a number: with a leading space, or empty.
    pub fn unit(self) -> &'static str {
        self.facts().unit
    }

    /// Returns the kind, which determines its unit on the screen.
    pub const fn kind(self, contact: ContactKind) -> QuantityKind {
        match (self, contact) {
            (Self::Load, ContactKind::Line) => QuantityKind::LineLoad,
            _ => self.facts().kind,
        }
    }

    /// Returns its unit in sentences, which is the same in every system of units. Temperatures are those of options, in K.
    pub const fn unit_in_sentences(self, contact: ContactKind) -> Unit {
        let system = match self {
            Self::InletTemperature => UnitSystem::Si,
            _ => UnitSystem::Engineering,
        };
        self.kind(contact).unit(system)
    }

    /// Returns the dimension of its entries.
    pub const fn dimension(self, contact: ContactKind) -> Dimension {
        match self.kind(contact).dimension() {
            Some(dimension) => dimension,
            None => Dimension::Ratio,
        }
    }

    /// Returns the smallest and largest accepted value: wider than any contact, narrow enough to keep numbers finite.
    pub const fn range(self) -> (f64, f64) {
        self.facts().range
    }

    /// Returns how its values are usually spread over an interval.
    pub const fn scale(self) -> Scale {
        self.facts().scale
    }

    /// Returns where sliders and curves of it begin and end.
    pub const fn usual_range(self) -> (f64, f64) {
        match self {
            Self::M => (1.0, 1000.0),
            Self::L => (0.5, 25.0),
            Self::SlideToRollRatio => (0.0, 2.0),
            other => other.range(),
        }
    }

    /// Returns its value for a contact with a lubricant; `None` if the contact or the lubricant does not have it.
    pub fn of_contact(self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<f64> {
        let heat = || lubricant.heat;
        let limit = || lubricant.limiting_stress;
        match self {
            Self::EyringStress => match lubricant.shear {
                ShearLaw::Eyring { critical_stress, .. } => Some(critical_stress),
                ShearLaw::Newtonian | ShearLaw::Carreau { .. } | ShearLaw::Ellis { .. } => None,
            },
            Self::SmoothFilmRatio | Self::RoughnessNumber => {
                let sigma = lubricant.roughness.map(|roughness| roughness.sigma).filter(|sigma| *sigma > 0.0)?;
                let number = sigma / point.film_scale_m();
                Some(if self == Self::RoughnessNumber { number } else { smooth_film_m(point) / sigma })
            }
            Self::InletTemperature => Some(heat()?.inlet_temperature),
            Self::ViscosityTemperature => Some(heat()?.oil.viscosity_temperature),
            Self::DensityTemperature => Some(heat()?.oil.density_temperature),
            Self::Conductivity => Some(heat()?.oil.conductivity),
            Self::HeatCapacity => heat().map(|heat| heat.oil.density * heat.oil.heat_capacity),
            Self::Effusivity1 => heat().map(|heat| heat.bodies[0].effusivity()),
            Self::Effusivity2 => heat().map(|heat| heat.bodies[1].effusivity()),
            Self::LimitAmbient => Some(limit()?.ambient),
            Self::LimitSlope => Some(limit()?.slope),
            Self::LimitEyring => limit()?.eyring,
            _ => self.of(point),
        }
    }

    /// Returns its value for an operating point. `None` for the plateau ratio if it is that of the lubricant, for
    /// quantities that a line contact does not have, and for constants of lubricant and bodies.
    pub fn of(self, point: &OperatingPoint) -> Option<f64> {
        Some(match self {
            Self::M => point.moes().m,
            Self::L => point.moes().l,
            Self::Radius => point.radius_m,
            Self::RadiusY if point.kind.is_line() => return None,
            Self::RadiusY => point.radius_y_m.unwrap_or(point.radius_m),
            Self::RadiusRatio if point.kind.is_line() => return None,
            Self::RadiusRatio => point.radius_ratio(),
            Self::Speed => point.speed_m_per_s,
            Self::Load => point.load,
            Self::Modulus => point.modulus_pa,
            Self::Viscosity => point.viscosity_pa_s,
            Self::Alpha => point.alpha_per_pa,
            Self::SlideToRollRatio => point.sliding.slide_to_roll_ratio,
            Self::NewtonianPlateauRatio => return point.sliding.newtonian_plateau_ratio,
            Self::HertzPressure => point.hertz().pressure_pa,
            Self::RoelandsExponent => roelands_exponent(point),
            Self::FilmThickness => expected_film(point),
            Self::SmoothFilmRatio => smooth_film_m(point) / REFERENCE_ROUGHNESS_M,
            Self::RoughnessNumber => REFERENCE_ROUGHNESS_M / point.film_scale_m(),
            Self::SlidingSpeed => (point.sliding.slide_to_roll_ratio * point.speed_m_per_s).abs(),
            Self::StressUnit => point.gradient_stress_pa(),
            Self::GradientStress => point.gradient_stress_pa() * expected_film(point),
            Self::EyringStress
            | Self::InletTemperature
            | Self::ViscosityTemperature
            | Self::DensityTemperature
            | Self::Conductivity
            | Self::HeatCapacity
            | Self::Effusivity1
            | Self::Effusivity2
            | Self::LimitAmbient
            | Self::LimitSlope
            | Self::LimitEyring => return None,
        })
    }

    /// Returns true if it is a ratio to R, which must be set before it.
    pub fn is_relative_to_radius(self) -> bool {
        self == Self::RadiusRatio
    }

    /// Returns true if the dimensionless pressure and film depend on it apart from the constants of the lubricant, so
    /// that a basis for other values may not represent them.
    pub fn changes_shapes(self) -> bool {
        matches!(
            self,
            Self::M
                | Self::L
                | Self::HertzPressure
                | Self::RadiusRatio
                | Self::FilmThickness
                | Self::GradientStress
                | Self::SmoothFilmRatio
                | Self::RoughnessNumber
        )
    }

    /// Returns the same contact with another value of it. M changes by the load, L by α. A change of speed, radius,
    /// modulus or viscosity also changes M and L. The film ratio changes by R, and speed and load follow so that M and L
    /// are the same. For dependent quantities the contact is returned unchanged.
    pub fn at(self, point: &OperatingPoint, value: f64) -> OperatingPoint {
        let mut point = *point;
        match self {
            Self::M => point.load *= value / point.moes().m,
            Self::L => point.alpha_per_pa *= value / point.moes().l,
            Self::Radius => point.radius_m = value,
            Self::RadiusY => point.radius_y_m = Some(value),
            Self::RadiusRatio => point.radius_y_m = Some(value * point.radius_m),
            Self::Speed => point.speed_m_per_s = value,
            Self::Load => point.load = value,
            Self::Modulus => point.modulus_pa = value,
            Self::Viscosity => point.viscosity_pa_s = value,
            Self::Alpha => point.alpha_per_pa = value,
            Self::SlideToRollRatio => point.sliding.slide_to_roll_ratio = value,
            Self::NewtonianPlateauRatio => point.sliding.newtonian_plateau_ratio = Some(value),
            Self::SmoothFilmRatio => point = enlarged(&point, value * REFERENCE_ROUGHNESS_M / smooth_film_m(&point)),
            _ => {}
        }
        point
    }

    /// Returns a lubricant with another value of a constant of oil, bodies or limiting stress. It is unchanged for
    /// quantities of the operating point, and if the lubricant does not have the constant.
    pub fn with_constant(self, mut lubricant: Lubricant, value: f64) -> Lubricant {
        if let Some(heat) = &mut lubricant.heat {
            match self {
                Self::InletTemperature => heat.inlet_temperature = value,
                Self::ViscosityTemperature => heat.oil.viscosity_temperature = value,
                Self::DensityTemperature => heat.oil.density_temperature = value,
                Self::Conductivity => heat.oil.conductivity = value,
                Self::HeatCapacity => heat.oil.heat_capacity = value / heat.oil.density,
                Self::Effusivity1 => heat.bodies[0] = body_of_effusivity(value),
                Self::Effusivity2 => heat.bodies[1] = body_of_effusivity(value),
                _ => {}
            }
        }
        let own = lubricant.limiting_stress.unwrap_or(LimitingStress { ambient: 0.0, slope: 0.0, eyring: None });
        let limit = match self {
            Self::LimitAmbient => Some(LimitingStress { ambient: value, ..own }),
            Self::LimitSlope => Some(LimitingStress { slope: value, ..own }),
            Self::LimitEyring => Some(LimitingStress { eyring: Some(value), ..own }),
            _ => lubricant.limiting_stress,
        };
        Lubricant { limiting_stress: limit, ..lubricant }
    }
}

/// Returns the central film thickness \[m\] of the smooth contact by Moes' formula.
fn smooth_film_m(point: &OperatingPoint) -> f64 {
    expected_film(point) * point.film_scale_m()
}

/// Returns the contact with all lengths multiplied by a factor. M, L and p_H are the same.
pub(crate) fn enlarged(point: &OperatingPoint, factor: f64) -> OperatingPoint {
    let load = factor.powi(point.kind.radius_power());
    OperatingPoint {
        radius_m: point.radius_m * factor,
        radius_y_m: point.radius_y_m.map(|radius| radius * factor),
        speed_m_per_s: point.speed_m_per_s * factor,
        load: point.load * load,
        ..*point
    }
}

/// Returns steel with its conductivity adapted to the given effusivity.
fn body_of_effusivity(wanted: f64) -> BodyHeat {
    let steel = BodyHeat::default();
    BodyHeat { conductivity: steel.conductivity * (wanted / steel.effusivity()).powi(2), ..steel }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::surfaces::{Roughness, ScaledRoughness};

    #[test]
    fn contacts_of_equal_film_ratio_have_equal_numbers_whatever_their_roughness() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let here = OperatingPoint { kind, ..OperatingPoint::TABLE_2_1 };
            let ratio = Quantity::SmoothFilmRatio;
            let moved = ratio.at(&here, 0.7);
            assert!((ratio.of(&moved).unwrap() / 0.7 - 1.0).abs() < 1e-12);
            for same in [Quantity::M, Quantity::L, Quantity::HertzPressure] {
                assert!((same.of(&moved).unwrap() / same.of(&here).unwrap() - 1.0).abs() < 1e-12, "{same:?}");
            }
            // Another roughness with the same film ratio gives the same dimensionless contact.
            let rough = |sigma| Lubricant { roughness: Some(Roughness::new(sigma)), ..Lubricant::default() };
            let sigma = REFERENCE_ROUGHNESS_M * ratio.of(&here).unwrap() / 0.7;
            assert!((ratio.of_contact(&here, &rough(sigma)).unwrap() / 0.7 - 1.0).abs() < 1e-12);
            let scaled = |point, sigma| ScaledRoughness::new(rough(sigma).roughness, point).unwrap().sigma;
            assert!((scaled(&here, sigma) / scaled(&moved, REFERENCE_ROUGHNESS_M) - 1.0).abs() < 1e-12);
            assert_eq!(ratio.of_contact(&here, &Lubricant::default()), None);
            let number = Quantity::RoughnessNumber;
            assert!((number.of(&moved).unwrap() / scaled(&here, sigma) - 1.0).abs() < 1e-12);
            assert!((number.of_contact(&here, &rough(sigma)).unwrap() / scaled(&here, sigma) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_contact_that_was_moved_has_the_value_and_keeps_all_others() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let here = OperatingPoint { kind, ..OperatingPoint::TABLE_2_1 };
            for quantity in Quantity::VARIED {
                if kind == ContactKind::Line && matches!(quantity, Quantity::RadiusY | Quantity::RadiusRatio) {
                    assert_eq!(quantity.of(&here), None);
                    continue;
                }
                let value = quantity.of(&here).filter(|value| *value != 0.0).map_or(0.3, |value| 1.1 * value);
                let moved = quantity.at(&here, value);
                assert!((quantity.of(&moved).unwrap() / value - 1.0).abs() < 1e-12, "{quantity:?}");
                let others = here.quantities().into_iter().zip(moved.quantities()).filter(|(a, b)| a != b).count();
                assert!(others <= 1, "{quantity:?}");
            }
            assert_eq!(Quantity::SI.map(|quantity| quantity.of(&here).unwrap()), here.quantities());
        }
    }
}
