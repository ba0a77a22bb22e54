//! Systems of units: in which unit each kind of quantity is shown, and what a number without a unit means.

use super::units::{BTU, Dimension, INCH, KELVIN, LBF, POUND, PSI, UnitError, parse};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// System of units of panels, axes, tables and reports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum UnitSystem {
    /// Coherent SI units: m, N/m, Pa, Pa·s, K.
    Si,
    /// Usual units of engineers: mm, µm, N/mm, GPa, mPa·s, °C.
    #[default]
    Engineering,
    /// Units of the inch system: in, µin, lbf/in, ksi, cP, °F.
    Imperial,
}

impl UnitSystem {
    /// All systems, in the order of the columns of the table.
    pub const ALL: [Self; 3] = [Self::Si, Self::Engineering, Self::Imperial];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Si => "SI",
            Self::Engineering => "Engineering",
            Self::Imperial => "Imperial",
        }
    }

    /// Returns the word of options.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Si => "si",
            Self::Engineering => "engineering",
            Self::Imperial => "imperial",
        }
    }

    /// Returns the system with this word; `None` for others.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|system| system.word() == word)
    }

    /// Returns its units in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Si => "m, m/s, N/m, Pa, Pa·s, 1/Pa, K",
            Self::Engineering => "mm, µm, m/s, N/mm, GPa, mPa·s, 1/GPa, °C",
            Self::Imperial => "in, µin, in/s, lbf/in, ksi, cP, 1/ksi, °F",
        }
    }
}

/// Unit in which a quantity is shown: a value in SI units is `zero + number · size`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Name; empty for a dimensionless number.
    pub name: &'static str,
    /// Size in SI units.
    pub size: f64,
    /// SI value of its zero.
    pub zero: f64,
    /// Smallest number that a text shows in it if there is a smaller unit.
    least: f64,
}

impl Unit {
    /// Returns the number of a value in SI units.
    pub fn number(self, si: f64) -> f64 {
        (si - self.zero) / self.size
    }

    /// Returns the value in SI units of a number.
    pub fn si(self, number: f64) -> f64 {
        self.zero + number * self.size
    }
}

/// Digits with which a quantity is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// Significant digits.
    Significant(usize),
    /// Decimals.
    Decimals(usize),
}

const fn unit(name: &'static str, size: f64) -> Unit {
    from(name, size, 0.1)
}

const fn from(name: &'static str, size: f64, least: f64) -> Unit {
    Unit { name, size, zero: 0.0, least }
}

const fn degrees(name: &'static str, size: f64, zero: f64) -> Unit {
    Unit { name, size, zero, least: 0.0 }
}

const METRES: &[Unit] = &[unit("m", 1.0)];
const NEWTONS: &[Unit] = &[unit("N", 1.0)];
const PASCALS: &[Unit] = &[unit("Pa", 1.0)];
const KELVINS: &[Unit] = &[unit("K", 1.0)];
const PER_KELVIN: &[Unit] = &[unit("1/K", 1.0)];
const METRES_PER_SECOND: &[Unit] = &[unit("m/s", 1.0)];
const KG_PER_M3: &[Unit] = &[unit("kg/m³", 1.0)];
const RPM: &[Unit] = &[unit("rpm", PI / 30.0)];
const DEGREES: &[Unit] = &[unit("°", PI / 180.0)];
const MILLISECONDS: &[Unit] = &[unit("ms", 1e-3)];
const MICROSECONDS: &[Unit] = &[unit("µs", 1e-6)];
const PERCENT: &[Unit] = &[unit("%", 1e-2)];
const NUMBER: &[Unit] = &[unit("", 1.0)];
const PER_SECOND: &[Unit] = &[unit("1/s", 1.0)];
const WATTS_PER_METRE_KELVIN: &[Unit] = &[unit("W/(m K)", 1.0)];
const JOULES_PER_KG_KELVIN: &[Unit] = &[unit("J/(kg K)", 1.0)];
const ACCELERATION: &[Unit] = &[unit("m/s²", 1.0)];
const EFFUSIVITY: &[Unit] = &[unit("J/(m² K √s)", 1.0)];
const NEWTON_METRES: &[Unit] = &[unit("N m", 1.0), unit("N mm", 1e-3)];
const HORSEPOWER: f64 = 550.0 * 12.0 * INCH * LBF;
const FOOT: f64 = 12.0 * INCH;

/// Kind of a quantity. Quantities of one kind are shown and read in the same unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the quantities")]
pub enum QuantityKind {
    /// Length of the size of a body or a contact.
    Length,
    /// Length of the size of a film thickness or a roughness.
    FilmThickness,
    /// Length of the size of an oil layer in front of a starved contact.
    OilLayer,
    Speed,
    Force,
    /// Load per length.
    LineLoad,
    /// Pressure of a contact, or modulus.
    Pressure,
    /// Shear stress of a lubricant, or pressure of asperities.
    Stress,
    Viscosity,
    KinematicViscosity,
    /// Pressure–viscosity coefficient.
    PressureCoefficient,
    Temperature,
    /// Difference of temperatures.
    TemperatureRise,
    /// Temperature coefficient.
    PerKelvin,
    Density,
    Time,
    /// Time that a surface needs through the contact.
    TransitTime,
    Rotation,
    Angle,
    Torque,
    Stiffness,
    Mass,
    Power,
    PowerPerLength,
    Conductivity,
    /// Specific heat capacity.
    HeatCapacity,
    /// Heat capacity per volume.
    VolumetricHeatCapacity,
    /// √(kρc) of a body.
    Effusivity,
    Acceleration,
    ShearRate,
    /// Ratio shown in percent, such as the slide-to-roll ratio.
    Percent,
    /// Dimensionless number.
    Number,
}

impl QuantityKind {
    /// The table: units of the kind in the systems SI, engineering, imperial. The first unit of a cell is that of fields
    /// and axes; a text uses the largest one that fits.
    #[rustfmt::skip]
    const fn table(self) -> [&'static [Unit]; 3] {
        match self {
            Self::Length => const { [METRES, &[from("mm", 1e-3, 1.0), unit("µm", 1e-6), unit("nm", 1e-9)], &[from("in", INCH, 0.001), unit("µin", 1e-6 * INCH)]] },
            Self::FilmThickness => const { [METRES, &[unit("µm", 1e-6), from("mm", 1e-3, 1.0), unit("nm", 1e-9)], &[unit("µin", 1e-6 * INCH), from("in", INCH, 0.001)]] },
            Self::OilLayer => const { [METRES, &[unit("nm", 1e-9), unit("µm", 1e-6), from("mm", 1e-3, 1.0)], &[unit("µin", 1e-6 * INCH), from("in", INCH, 0.001)]] },
            Self::Speed => const { [METRES_PER_SECOND, METRES_PER_SECOND, &[unit("in/s", INCH)]] },
            Self::Force => const { [NEWTONS, &[unit("N", 1.0), from("kN", 1e3, 1.0), unit("mN", 1e-3)], &[unit("lbf", LBF)]] },
            Self::LineLoad => const { [&[unit("N/m", 1.0)], &[unit("N/mm", 1e3)], &[unit("lbf/in", LBF / INCH)]] },
            Self::Pressure => const { [PASCALS, &[unit("GPa", 1e9), unit("MPa", 1e6), unit("kPa", 1e3)], &[unit("ksi", 1e3 * PSI), unit("psi", PSI)]] },
            Self::Stress => const { [PASCALS, &[unit("MPa", 1e6), from("GPa", 1e9, 0.1), unit("kPa", 1e3)], &[unit("psi", PSI), from("ksi", 1e3 * PSI, 1.0)]] },
            Self::Viscosity => const { [&[unit("Pa·s", 1.0)], &[unit("mPa·s", 1e-3), from("Pa·s", 1.0, 1.0)], &[unit("cP", 1e-3)]] },
            Self::KinematicViscosity => const { [&[unit("m²/s", 1.0)], &[unit("mm²/s", 1e-6)], &[unit("cSt", 1e-6)]] },
            Self::PressureCoefficient => const { [&[unit("1/Pa", 1.0)], &[unit("1/GPa", 1e-9)], &[unit("1/ksi", 1e-3 / PSI)]] },
            Self::Temperature => const { [KELVINS, &[degrees("°C", 1.0, KELVIN)], &[degrees("°F", 5.0 / 9.0, KELVIN - 160.0 / 9.0)]] },
            Self::TemperatureRise => const { [KELVINS, KELVINS, &[unit("°F", 5.0 / 9.0)]] },
            Self::PerKelvin => const { [PER_KELVIN, PER_KELVIN, &[unit("1/°F", 1.8)]] },
            Self::Density => const { [KG_PER_M3, KG_PER_M3, &[unit("lb/ft³", POUND / (FOOT * FOOT * FOOT))]] },
            Self::Time => const { [&[unit("s", 1.0)], MILLISECONDS, MILLISECONDS] },
            Self::TransitTime => const { [&[unit("s", 1.0)], MICROSECONDS, MICROSECONDS] },
            Self::Rotation => const { [&[unit("rad/s", 1.0)], RPM, RPM] },
            Self::Angle => const { [&[unit("rad", 1.0)], DEGREES, DEGREES] },
            Self::Torque => const { [&[unit("N m", 1.0)], NEWTON_METRES, &[unit("lbf in", LBF * INCH)]] },
            Self::Stiffness => const { [&[unit("N/m", 1.0)], &[unit("N/mm", 1e3)], &[unit("lbf/in", LBF / INCH)]] },
            Self::Mass => const { [&[unit("kg", 1.0)], &[unit("kg", 1.0)], &[unit("lb", POUND)]] },
            Self::Power => const { [&[unit("W", 1.0)], &[unit("W", 1.0), from("kW", 1e3, 1.0), unit("mW", 1e-3)], &[unit("hp", HORSEPOWER)]] },
            Self::PowerPerLength => const { [&[unit("W/m", 1.0)], &[unit("W/mm", 1e3)], &[unit("hp/in", HORSEPOWER / INCH)]] },
            Self::Conductivity => const { [WATTS_PER_METRE_KELVIN, WATTS_PER_METRE_KELVIN, &[unit("Btu/(h ft °F)", BTU * 1.8 / (3600.0 * FOOT))]] },
            Self::HeatCapacity => const { [JOULES_PER_KG_KELVIN, JOULES_PER_KG_KELVIN, &[unit("Btu/(lb °F)", BTU * 1.8 / POUND)]] },
            Self::VolumetricHeatCapacity => const { [&[unit("J/(m³ K)", 1.0)], &[unit("MJ/(m³ K)", 1e6)], &[unit("Btu/(ft³ °F)", BTU * 1.8 / (FOOT * FOOT * FOOT))]] },
            Self::Effusivity => const { [EFFUSIVITY, EFFUSIVITY, EFFUSIVITY] },
            Self::Acceleration => const { [ACCELERATION, ACCELERATION, &[unit("in/s²", INCH)]] },
            Self::ShearRate => const { [PER_SECOND, PER_SECOND, PER_SECOND] },
            Self::Percent => const { [PERCENT, PERCENT, PERCENT] },
            Self::Number => const { [NUMBER, NUMBER, NUMBER] },
        }
    }

    const fn units(self, system: UnitSystem) -> &'static [Unit] {
        let [si, engineering, imperial] = self.table();
        match system {
            UnitSystem::Si => si,
            UnitSystem::Engineering => engineering,
            UnitSystem::Imperial => imperial,
        }
    }

    /// Returns the unit of fields and axes. A number without a unit is read in it.
    pub const fn unit(self, system: UnitSystem) -> Unit {
        match self.units(system) {
            [first, ..] => *first,
            [] => unit("", 1.0),
        }
    }

    /// Returns the unit in which a text shows a value: the largest one that gives a readable number. A value of zero has
    /// the unit of fields.
    pub fn unit_of(self, system: UnitSystem, si: f64) -> Unit {
        let units = self.units(system);
        let fits = units.iter().filter(|unit| unit.number(si).abs() >= unit.least);
        let smallest = || units.iter().min_by(|a, b| a.size.total_cmp(&b.size));
        let found = fits.max_by(|a, b| a.size.total_cmp(&b.size)).or_else(smallest);
        found.filter(|_| si != 0.0).copied().unwrap_or(self.unit(system))
    }

    /// Returns the digits with which it is shown.
    pub const fn digits(self) -> Digits {
        match self {
            Self::Temperature => Digits::Decimals(1),
            Self::Percent | Self::Angle | Self::TemperatureRise | Self::Torque | Self::Power | Self::PowerPerLength => {
                Digits::Significant(3)
            }
            _ => Digits::Significant(4),
        }
    }

    /// Returns the dimension of entries; `None` for kinds that are never entered.
    pub const fn dimension(self) -> Option<Dimension> {
        Some(match self {
            Self::Length | Self::FilmThickness | Self::OilLayer => Dimension::Length,
            Self::Speed => Dimension::Speed { radius_m: None },
            Self::Force => Dimension::Force,
            Self::LineLoad => Dimension::LineLoad,
            Self::Pressure | Self::Stress => Dimension::Pressure,
            Self::Viscosity => Dimension::Viscosity { density: None },
            Self::KinematicViscosity => Dimension::KinematicViscosity,
            Self::PressureCoefficient => Dimension::PressureCoefficient,
            Self::Temperature => Dimension::Temperature,
            Self::PerKelvin => Dimension::PerKelvin,
            Self::Density => Dimension::Density,
            Self::Time | Self::TransitTime => Dimension::Time,
            Self::Rotation => Dimension::Rotation,
            Self::Angle => Dimension::Angle,
            Self::Torque => Dimension::Torque { turning: None },
            Self::Stiffness => Dimension::Stiffness,
            Self::Mass => Dimension::Mass,
            Self::Conductivity => Dimension::Conductivity,
            Self::HeatCapacity => Dimension::HeatCapacity,
            Self::Percent | Self::Number => Dimension::Ratio,
            Self::TemperatureRise
            | Self::Power
            | Self::PowerPerLength
            | Self::VolumetricHeatCapacity
            | Self::Effusivity
            | Self::Acceleration
            | Self::ShearRate => return None,
        })
    }

    /// Returns the value in SI units of an entered text. A number without a unit is in the unit of the system.
    ///
    /// # Errors
    /// If the text is not a value of this kind.
    pub fn read(self, text: &str, system: UnitSystem) -> Result<f64, UnitError> {
        parse(text, self.dimension().unwrap_or(Dimension::Ratio), self.unit(system).name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use QuantityKind as K;
    use UnitSystem::{Engineering, Imperial, Si};

    /// Kind, value in SI units, and its number and unit in each system.
    type Entry = (K, f64, [(f64, &'static str); 3]);

    /// Values in SI units with their numbers in the three systems, from the definitions of the inch (0.0254 m), the
    /// pound-force (4.448 221 615 260 5 N), the horsepower (550 ft lbf/s), the Btu (1055.055 852 62 J) and the Celsius
    /// and Fahrenheit scales.
    #[rustfmt::skip]
    const TABLE: [Entry; 20] = [
        (K::Length, 0.0254, [(0.0254, "m"), (25.4, "mm"), (1.0, "in")]),
        (K::FilmThickness, 2.54e-7, [(2.54e-7, "m"), (0.254, "µm"), (10.0, "µin")]),
        (K::Speed, 2.54, [(2.54, "m/s"), (2.54, "m/s"), (100.0, "in/s")]),
        (K::Force, 444.822_161_526_05, [(444.822_161_526_05, "N"), (444.822_161_526_05, "N"), (100.0, "lbf")]),
        (K::LineLoad, 175_126.835_246_476_4, [(175_126.835_246_476_4, "N/m"), (175.126_835_246_476_4, "N/mm"), (1000.0, "lbf/in")]),
        (K::Pressure, 1e9, [(1e9, "Pa"), (1.0, "GPa"), (145.037_737_730_209, "ksi")]),
        (K::Stress, 6_894_757.293_168_36, [(6_894_757.293_168_36, "Pa"), (6.894_757_293_168_36, "MPa"), (1000.0, "psi")]),
        (K::Viscosity, 0.04, [(0.04, "Pa·s"), (40.0, "mPa·s"), (40.0, "cP")]),
        (K::KinematicViscosity, 6.8e-5, [(6.8e-5, "m²/s"), (68.0, "mm²/s"), (68.0, "cSt")]),
        (K::PressureCoefficient, 2e-8, [(2e-8, "1/Pa"), (20.0, "1/GPa"), (0.137_895_145_863_367, "1/ksi")]),
        (K::Temperature, 353.15, [(353.15, "K"), (80.0, "°C"), (176.0, "°F")]),
        (K::PerKelvin, 0.045, [(0.045, "1/K"), (0.045, "1/K"), (0.025, "1/°F")]),
        (K::Density, 880.0, [(880.0, "kg/m³"), (880.0, "kg/m³"), (54.936_605_3, "lb/ft³")]),
        (K::Time, 0.002, [(0.002, "s"), (2.0, "ms"), (2.0, "ms")]),
        (K::Rotation, 50.0 * PI, [(50.0 * PI, "rad/s"), (1500.0, "rpm"), (1500.0, "rpm")]),
        (K::Torque, 1.129_848_290_276_17, [(1.129_848_290_276_17, "N m"), (1.129_848_290_276_17, "N m"), (10.0, "lbf in")]),
        (K::Stiffness, 17_512.683_524_647_64, [(17_512.683_524_647_64, "N/m"), (17.512_683_524_647_64, "N/mm"), (100.0, "lbf/in")]),
        (K::Conductivity, 0.14, [(0.14, "W/(m K)"), (0.14, "W/(m K)"), (0.080_890_504_3, "Btu/(h ft °F)")]),
        (K::HeatCapacity, 2000.0, [(2000.0, "J/(kg K)"), (2000.0, "J/(kg K)"), (0.477_691_793_3, "Btu/(lb °F)")]),
        (K::Percent, 0.1, [(10.0, "%"), (10.0, "%"), (10.0, "%")]),
    ];

    #[test]
    fn sixty_entries_are_shown_and_read_in_three_systems() {
        for (kind, si, numbers) in TABLE {
            for (system, (number, name)) in UnitSystem::ALL.into_iter().zip(numbers) {
                let unit = kind.unit(system);
                assert_eq!(unit.name, name, "{kind:?}, {system:?}");
                assert!((unit.number(si) / number - 1.0).abs() < 1e-7, "{kind:?}: {} {name}", unit.number(si));
                assert!((unit.si(unit.number(si)) / si - 1.0).abs() < 1e-14, "{kind:?}, there and back");
                // A bare number has the unit of the system; the same number with its unit is read in any system.
                let typed = format!("{:.15}", unit.number(si));
                for (text, read_in) in [(typed.clone(), system)]
                    .into_iter()
                    .chain(UnitSystem::ALL.map(|other| (format!("{typed} {name}"), other)))
                {
                    let read = kind.read(&text, read_in).unwrap_or_else(|error| panic!("{text}: {error}"));
                    assert!((read / si - 1.0).abs() < 1e-8, "{kind:?}, {text}: {read} instead of {si}");
                }
            }
        }
    }

    #[test]
    fn a_slide_to_roll_ratio_is_read_in_percent() {
        for system in UnitSystem::ALL {
            assert_eq!(K::Percent.read("10", system), Ok(0.1));
            assert_eq!(K::Percent.read("10 %", system), Ok(0.1));
            assert_eq!(K::Percent.unit(system).number(0.1), 10.0);
        }
    }

    #[test]
    fn a_text_has_the_largest_unit_that_fits() {
        for (kind, system, si, name) in [
            (K::Length, Engineering, 0.012, "mm"),
            (K::Length, Engineering, 2e-4, "µm"),
            (K::FilmThickness, Engineering, 3e-7, "µm"),
            (K::FilmThickness, Engineering, 3e-8, "nm"),
            (K::Length, Imperial, 2e-4, "in"),
            (K::FilmThickness, Imperial, 3e-7, "µin"),
            (K::Length, Si, 3e-7, "m"),
            (K::Pressure, Engineering, 0.95e9, "GPa"),
            (K::Pressure, Engineering, -0.2e9, "GPa"),
            (K::Pressure, Engineering, 2e7, "MPa"),
            (K::Force, Engineering, 3200.0, "kN"),
            (K::Force, Engineering, 0.0, "N"),
            (K::Stress, Imperial, 5e6, "psi"),
        ] {
            assert_eq!(kind.unit_of(system, si).name, name, "{kind:?}, {system:?}, {si}");
        }
    }
}
