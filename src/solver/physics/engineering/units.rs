//! Numbers with units as entered by users: `300 N/mm`, `0,4 µm`, `68 cSt`, `5 %`, `1500 rpm`, `80 °C`, `1.5 in`.

use std::f64::consts::PI;

/// 0 °C in K.
pub const KELVIN: f64 = 273.15;

/// Dimension of an entered number. Results are in SI units: m, m/s, N, N/m, Pa, Pa·s, m²/s, 1/Pa, K, 1/K, kg/m³, s,
/// rad/s, rad, N m, kg, and dimensionless ratios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dimension {
    /// Length in m.
    Length,
    /// Speed in m/s. A rotational speed is accepted if the radius of the body \[m\] is given.
    Speed {
        /// Radius at which the surface moves.
        radius_m: Option<f64>,
    },
    /// Force in N.
    Force,
    /// Load per length in N/m.
    LineLoad,
    /// Pressure in Pa.
    Pressure,
    /// Dynamic viscosity in Pa·s. A kinematic viscosity is accepted if the density \[kg/m³\] is given.
    Viscosity {
        /// Density of the oil.
        density: Option<f64>,
    },
    /// Kinematic viscosity in m²/s.
    KinematicViscosity,
    /// Pressure–viscosity coefficient in 1/Pa.
    PressureCoefficient,
    /// Temperature in K.
    Temperature,
    /// Temperature coefficient in 1/K.
    PerKelvin,
    /// Density in kg/m³.
    Density,
    /// Time in s.
    Time,
    /// Rotational speed in rad/s.
    Rotation,
    /// Angle in rad.
    Angle,
    /// Torque in N m. A power is accepted if the rotational speed \[rad/s\] is given.
    Torque {
        /// Rotational speed of the shaft.
        turning: Option<f64>,
    },
    /// Spring rate in N/m.
    Stiffness,
    /// Mass in kg.
    Mass,
    /// Thermal conductivity in W/(m K).
    Conductivity,
    /// Specific heat capacity in J/(kg K).
    HeatCapacity,
    /// Dimensionless number.
    Ratio,
}

/// Reason why a text is not a value of a dimension.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// The text is empty.
    #[error("a number is needed here")]
    Empty,
    /// The text does not begin with a finite number.
    #[error("“{text}” is no number; write it like {example}")]
    NoNumber {
        /// Text that was entered.
        text: String,
        /// Example of an accepted text.
        example: String,
    },
    /// The unit does not belong to this dimension.
    #[error("“{unit}” is no unit of {of}; accepted are {accepted}")]
    Unit {
        /// Unit that was entered.
        unit: String,
        /// Name of the dimension.
        of: &'static str,
        /// Units of the dimension.
        accepted: String,
    },
    /// A rotational speed without a radius.
    #[error("“{unit}” needs the radius of the body that turns; enter that first, or a speed in m/s")]
    NeedsRadius {
        /// Unit that was entered.
        unit: String,
    },
    /// A power without a rotational speed.
    #[error("“{unit}” is a power and needs the speed of the shaft; enter that first, or a torque in N m")]
    NeedsTurning {
        /// Unit that was entered.
        unit: String,
    },
    /// A kinematic viscosity without a density.
    #[error("“{unit}” is a kinematic viscosity and needs the density of the oil; enter that first, or mPa·s")]
    NeedsDensity {
        /// Unit that was entered.
        unit: String,
    },
}

/// Units with their size in SI units. The first of each list is used as an example.
type Units = &'static [(&'static str, f64)];

/// Pound-force \[N\], from the avoirdupois pound and standard gravity.
pub(super) const LBF: f64 = 4.448_221_615_260_5;
pub(super) const INCH: f64 = 0.0254;
pub(super) const PSI: f64 = LBF / (INCH * INCH);
/// Avoirdupois pound \[kg\].
pub(super) const POUND: f64 = LBF / 9.806_65;
const CUBIC_FOOT: f64 = 12.0 * INCH * 12.0 * INCH * 12.0 * INCH;
/// International table Btu \[J\].
pub(super) const BTU: f64 = 1_055.055_852_62;

const ROTATION: Units =
    &[("rpm", PI / 30.0), ("1/min", PI / 30.0), ("U/min", PI / 30.0), ("rad/s", 1.0), ("1/s", 2.0 * PI)];
const POWER: Units = &[("kW", 1e3), ("W", 1.0), ("MW", 1e6), ("hp", 550.0 * 12.0 * INCH * LBF), ("PS", 735.498_75)];
const KINEMATIC: Units = &[("cSt", 1e-6), ("mm²/s", 1e-6), ("m²/s", 1.0), ("St", 1e-4)];

impl Dimension {
    /// Returns its name with the article.
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Speed { .. } => "a speed",
            Self::Force => "a force",
            Self::LineLoad => "a load per length",
            Self::Pressure => "a pressure or modulus",
            Self::Viscosity { .. } => "a viscosity",
            Self::KinematicViscosity => "a kinematic viscosity",
            Self::PressureCoefficient => "a pressure–viscosity coefficient",
            Self::Temperature => "a temperature",
            Self::PerKelvin => "a temperature coefficient",
            Self::Density => "a density",
            Self::Time => "a time",
            Self::Rotation => "a rotational speed",
            Self::Angle => "an angle",
            Self::Torque { .. } => "a torque",
            Self::Stiffness => "a spring rate",
            Self::Mass => "a mass",
            Self::Conductivity => "a thermal conductivity",
            Self::HeatCapacity => "a heat capacity",
            Self::Ratio => "a ratio",
        }
    }

    /// Returns the SI unit of its values; empty for a ratio.
    pub fn si_unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Speed { .. } => "m/s",
            Self::Force => "N",
            Self::LineLoad => "N/m",
            Self::Pressure => "Pa",
            Self::Viscosity { .. } => "Pa·s",
            Self::KinematicViscosity => "m²/s",
            Self::PressureCoefficient => "1/Pa",
            Self::Temperature => "K",
            Self::PerKelvin => "1/K",
            Self::Density => "kg/m³",
            Self::Time => "s",
            Self::Rotation => "rad/s",
            Self::Angle => "rad",
            Self::Torque { .. } => "N m",
            Self::Stiffness => "N/m",
            Self::Mass => "kg",
            Self::Conductivity => "W/(m K)",
            Self::HeatCapacity => "J/(kg K)",
            Self::Ratio => "",
        }
    }

    /// Returns its units.
    pub fn units(self) -> Units {
        match self {
            Self::Length => &[
                ("mm", 1e-3),
                ("µm", 1e-6),
                ("nm", 1e-9),
                ("cm", 1e-2),
                ("m", 1.0),
                ("in", INCH),
                ("µin", 1e-6 * INCH),
            ],
            Self::Speed { .. } => &[
                ("m/s", 1.0),
                ("mm/s", 1e-3),
                ("km/h", 1.0 / 3.6),
                ("in/s", INCH),
                ("ft/s", 12.0 * INCH),
                ("ft/min", 12.0 * INCH / 60.0),
            ],
            Self::Force => &[("N", 1.0), ("kN", 1e3), ("mN", 1e-3), ("MN", 1e6), ("lbf", LBF)],
            Self::LineLoad => {
                &[("N/mm", 1e3), ("kN/m", 1e3), ("N/m", 1.0), ("kN/mm", 1e6), ("MN/m", 1e6), ("lbf/in", LBF / INCH)]
            }
            Self::Pressure => &[
                ("GPa", 1e9),
                ("MPa", 1e6),
                ("kPa", 1e3),
                ("Pa", 1.0),
                ("bar", 1e5),
                ("N/mm²", 1e6),
                ("psi", PSI),
                ("ksi", 1e3 * PSI),
            ],
            Self::Viscosity { .. } => &[("mPa·s", 1e-3), ("Pa·s", 1.0), ("cP", 1e-3), ("P", 0.1), ("reyn", PSI)],
            Self::KinematicViscosity => KINEMATIC,
            Self::PressureCoefficient => &[
                ("1/GPa", 1e-9),
                ("GPa-1", 1e-9),
                ("1/Pa", 1.0),
                ("Pa-1", 1.0),
                ("1/MPa", 1e-6),
                ("mm²/N", 1e-6),
                ("1/psi", 1.0 / PSI),
                ("1/ksi", 1e-3 / PSI),
            ],
            Self::Temperature => &[("°C", 1.0), ("C", 1.0), ("K", 1.0), ("°F", 5.0 / 9.0), ("F", 5.0 / 9.0)],
            Self::PerKelvin => &[("1/K", 1.0), ("K-1", 1.0), ("1/°F", 1.8)],
            Self::Density => &[("kg/m³", 1.0), ("g/cm³", 1e3), ("kg/l", 1e3), ("lb/ft³", POUND / CUBIC_FOOT)],
            Self::Time => &[("ms", 1e-3), ("µs", 1e-6), ("s", 1.0)],
            Self::Rotation => ROTATION,
            Self::Angle => &[("°", PI / 180.0), ("deg", PI / 180.0), ("rad", 1.0), ("mrad", 1e-3)],
            Self::Torque { .. } => {
                &[("N m", 1.0), ("N mm", 1e-3), ("kN m", 1e3), ("lbf in", LBF * INCH), ("lbf ft", 12.0 * LBF * INCH)]
            }
            Self::Stiffness => &[("N/mm", 1e3), ("N/m", 1.0), ("kN/m", 1e3), ("kN/mm", 1e6), ("lbf/in", LBF / INCH)],
            Self::Mass => &[("kg", 1.0), ("g", 1e-3), ("lb", POUND)],
            Self::Conductivity => &[("W/(m K)", 1.0), ("Btu/(h ft °F)", BTU * 1.8 / (3600.0 * 12.0 * INCH))],
            Self::HeatCapacity => &[("J/(kg K)", 1.0), ("kJ/(kg K)", 1e3), ("Btu/(lb °F)", BTU * 1.8 / POUND)],
            Self::Ratio => &[("%", 1e-2), ("‰", 1e-3)],
        }
    }
}

/// Returns the value in SI units of an entered text. A number without a unit is in `field_unit`, the unit shown next
/// to the field (empty for a dimensionless number).
///
/// # Errors
/// If the text is not a value of the dimension. The message names the text and what is accepted.
pub fn parse(text: &str, dimension: Dimension, field_unit: &str) -> Result<f64, UnitError> {
    let plain: String = text.chars().filter(|c| !c.is_whitespace()).map(plain_character).collect();
    if plain.is_empty() {
        return Err(UnitError::Empty);
    }
    let (number, unit) = split(&plain);
    let example = || {
        let unit = dimension.units().first().map_or("", |(unit, _)| unit);
        let example = if dimension == Dimension::Ratio { "0.125 or 12.5 %".to_owned() } else { format!("12.5 {unit}") };
        UnitError::NoNumber { text: text.trim().to_owned(), example }
    };
    let value = number.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(example)?;
    let typed = if unit.is_empty() { field_unit } else { unit };
    let si = in_si((number, value), typed, dimension)?;
    if si.is_finite() { Ok(si) } else { Err(example()) }
}

fn in_si((number, value): (&str, f64), typed: &str, dimension: Dimension) -> Result<f64, UnitError> {
    if typed.is_empty() && dimension == Dimension::Ratio {
        return Ok(value);
    }
    let size = |units: Units| units.iter().find(|(unit, _)| key(unit) == key(typed)).map(|(_, size)| *size);
    if let Some(size) = size(dimension.units()) {
        let (offset, zero) = match (dimension, key(typed).as_str()) {
            (Dimension::Temperature, "C") => (0.0, KELVIN),
            (Dimension::Temperature, "F") => (-32.0, KELVIN),
            _ => (0.0, 0.0),
        };
        let shifted = shifted(number, size).filter(|_| dimension != Dimension::Temperature);
        return Ok(shifted.unwrap_or((value + offset) * size + zero));
    }
    match dimension {
        Dimension::Speed { radius_m } => {
            if let Some(size) = size(ROTATION) {
                let unit = typed.to_owned();
                return radius_m.map(|radius| value * size * radius).ok_or(UnitError::NeedsRadius { unit });
            }
        }
        Dimension::Torque { turning } => {
            if let Some(size) = size(POWER) {
                let unit = typed.to_owned();
                let turning = turning.map(f64::abs).filter(|turning| *turning > 0.0);
                return turning.map(|turning| value * size / turning).ok_or(UnitError::NeedsTurning { unit });
            }
        }
        Dimension::Viscosity { density } => {
            if let Some(size) = size(KINEMATIC) {
                let unit = typed.to_owned();
                return density.map(|density| value * size * density).ok_or(UnitError::NeedsDensity { unit });
            }
        }
        _ => {}
    }
    let accepted: Vec<&str> = dimension.units().iter().map(|(unit, _)| *unit).collect();
    Err(UnitError::Unit { unit: typed.to_owned(), of: dimension.name(), accepted: accepted.join(", ") })
}

/// Returns an entered number times the size of its unit. The decimal point of the text is shifted, so that 12.7 mm
/// are exactly 0.0127 m. `None` if the size is not a power of ten or the number has an exponent.
fn shifted(number: &str, size: f64) -> Option<f64> {
    let places = size.log10().round();
    let decimal = (size / 10f64.powf(places) - 1.0).abs() < 1e-12 && !number.contains(['e', 'E']);
    if decimal { format!("{number}e{places}").parse().ok() } else { None }
}

/// Replaces minus signs and decimal commas by those of programs.
fn plain_character(c: char) -> char {
    match c {
        ',' => '.',
        '−' | '–' => '-',
        'μ' => 'µ',
        other => other,
    }
}

/// Splits a text into the longest number at its beginning and a valid unit. “201/GPa”, entered as “20 1/GPa”, gives
/// 20.
fn split(plain: &str) -> (&str, &str) {
    let ends = plain.char_indices().map(|(at, c)| at + c.len_utf8());
    let parts = ends.filter_map(|end| plain.split_at_checked(end));
    let mut whole = parts.filter(|(number, unit)| is_number(number) && !unit.starts_with('/'));
    whole.next_back().unwrap_or(("", plain))
}

fn is_number(text: &str) -> bool {
    text.ends_with(|c: char| c.is_ascii_digit() || c == '.') && text.parse::<f64>().is_ok()
}

/// Returns a unit in a normalised form, without characters that may be omitted or written differently.
fn key(unit: &str) -> String {
    if unit.trim() == "°" {
        return "deg".to_owned();
    }
    let kept = unit.chars().filter(|c| !matches!(c, '·' | '*' | '^' | '°' | ' ' | '\u{2009}'));
    let plain: String = kept
        .map(|c| match c {
            '²' => '2',
            '³' => '3',
            'µ' | 'μ' => 'u',
            other => other,
        })
        .collect();
    // These units are unambiguous in any case of letters.
    match plain.to_lowercase().as_str() {
        "rpm" | "cst" | "cp" | "gpa" | "kn" | "1/gpa" | "n/mm" | "kn/m" | "n/m" => plain.to_lowercase(),
        _ => plain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OIL: Dimension = Dimension::Viscosity { density: Some(850.0) };
    const ROLLER: Dimension = Dimension::Speed { radius_m: Some(0.02) };

    #[test]
    fn people_type_units_in_many_ways() {
        for (text, dimension, field, si) in [
            ("300 N/mm", Dimension::LineLoad, "kN/m", 3e5),
            ("300N/mm", Dimension::LineLoad, "kN/m", 3e5),
            ("300", Dimension::LineLoad, "kN/m", 3e5),
            ("0.4 µm", Dimension::Length, "mm", 4e-7),
            ("0,4 μm", Dimension::Length, "mm", 4e-7),
            ("0,4um", Dimension::Length, "mm", 4e-7),
            ("68 cSt", OIL, "mPa·s", 68e-6 * 850.0),
            ("20 cP", OIL, "mPa·s", 0.02),
            ("20 mPa s", OIL, "mPa·s", 0.02),
            ("5 %", Dimension::Ratio, "", 0.05),
            ("−5%", Dimension::Ratio, "", -0.05),
            ("0.05", Dimension::Ratio, "", 0.05),
            ("5", Dimension::Ratio, "%", 0.05),
            ("1500 rpm", ROLLER, "m/s", 1500.0 * 2.0 * PI / 60.0 * 0.02),
            ("3", ROLLER, "m/s", 3.0),
            ("80 °C", Dimension::Temperature, "°C", 353.15),
            ("176 F", Dimension::Temperature, "°C", 353.15),
            ("353.15 K", Dimension::Temperature, "°C", 353.15),
            ("20 1/GPa", Dimension::PressureCoefficient, "1/GPa", 2e-8),
            ("2e-8 1/Pa", Dimension::PressureCoefficient, "1/GPa", 2e-8),
            ("20 GPa^-1", Dimension::PressureCoefficient, "1/GPa", 2e-8),
            ("231 gpa", Dimension::Pressure, "GPa", 231e9),
            ("0.87 g/cm3", Dimension::Density, "kg/m³", 870.0),
            ("132 us", Dimension::Time, "ms", 132e-6),
        ] {
            let value = parse(text, dimension, field).expect(text);
            assert!((value - si).abs() <= 1e-12 * si.abs(), "{text}: {value} instead of {si}");
        }
    }

    #[test]
    fn a_decimal_number_is_the_same_in_every_unit() {
        for (text, dimension, si) in [
            ("12.7 mm", Dimension::Length, 0.0127),
            ("70.5 mPa·s", OIL, 0.0705),
            ("21.3 1/GPa", Dimension::PressureCoefficient, 2.13e-8),
            ("0.3 µm", Dimension::Length, 3e-7),
            ("7 %", Dimension::Ratio, 0.07),
        ] {
            assert_eq!(parse(text, dimension, "").expect(text), si, "{text}");
        }
    }

    #[test]
    fn what_does_not_fit_is_refused_with_what_would() {
        for (text, dimension, said) in [
            ("", Dimension::Length, "a number is needed here"),
            ("12 mPa·s", Dimension::LineLoad, "“mPa·s” is no unit of a load per length; accepted are N/mm"),
            ("1500 rpm", Dimension::Speed { radius_m: None }, "needs the radius of the body that turns"),
            ("68 cSt", Dimension::Viscosity { density: None }, "needs the density of the oil"),
            ("thick", Dimension::Length, "“thick” is no number; write it like 12.5 mm"),
            ("inf mm", Dimension::Length, "is no number"),
            ("nan", Dimension::Ratio, "is no number"),
            ("1e308 km/h", Dimension::Length, "is no unit of a length"),
            ("1e308 MN/m", Dimension::LineLoad, "is no number"),
        ] {
            let error = parse(text, dimension, "").expect_err(text).to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }

    #[test]
    fn every_unit_reads_itself() {
        for dimension in [
            Dimension::Rotation,
            Dimension::Angle,
            Dimension::Torque { turning: None },
            Dimension::Stiffness,
            Dimension::Mass,
            Dimension::Conductivity,
            Dimension::HeatCapacity,
            Dimension::Length,
            ROLLER,
            Dimension::Force,
            Dimension::LineLoad,
            Dimension::Pressure,
            OIL,
            Dimension::KinematicViscosity,
            Dimension::PressureCoefficient,
            Dimension::Temperature,
            Dimension::PerKelvin,
            Dimension::Density,
            Dimension::Time,
            Dimension::Ratio,
        ] {
            let si = dimension.si_unit();
            assert!(si.is_empty() || dimension.units().contains(&(si, 1.0)), "{dimension:?}");
            for (unit, _) in dimension.units() {
                let typed = parse(&format!("2 {unit}"), dimension, "").expect(unit);
                assert_eq!(typed, parse("2", dimension, unit).expect(unit), "{unit}");
            }
        }
    }

    /// Units with their sizes in SI units, from the definitions of the inch (0.0254 m), the pound-force
    /// (4.448 221 615 260 5 N), the horsepower (550 ft lbf/s) and the Celsius and Fahrenheit scales.
    #[test]
    fn sixty_units_are_read_and_written_both_ways() {
        const SHAFT: Dimension = Dimension::Torque { turning: Some(100.0) };
        use Dimension as D;
        let table: [(&str, D, f64); 60] = [
            ("1 m", D::Length, 1.0),
            ("1 cm", D::Length, 0.01),
            ("1 mm", D::Length, 1e-3),
            ("1 µm", D::Length, 1e-6),
            ("1 nm", D::Length, 1e-9),
            ("1 in", D::Length, 0.0254),
            ("1 µin", D::Length, 2.54e-8),
            ("1 m/s", ROLLER, 1.0),
            ("1 mm/s", ROLLER, 1e-3),
            ("36 km/h", ROLLER, 10.0),
            ("1 in/s", ROLLER, 0.0254),
            ("1 ft/s", ROLLER, 0.3048),
            ("1 ft/min", ROLLER, 0.00508),
            ("30 rpm", ROLLER, PI * 0.02),
            ("1 rad/s", ROLLER, 0.02),
            ("1 N", D::Force, 1.0),
            ("3.2 kN", D::Force, 3200.0),
            ("1 mN", D::Force, 1e-3),
            ("1 lbf", D::Force, 4.448_221_615_260_5),
            ("1 N/m", D::LineLoad, 1.0),
            ("1 N/mm", D::LineLoad, 1e3),
            ("1 kN/m", D::LineLoad, 1e3),
            ("1 kN/mm", D::LineLoad, 1e6),
            ("1 lbf/in", D::LineLoad, 175.126_835_246_476_4),
            ("1 Pa", D::Pressure, 1.0),
            ("1 kPa", D::Pressure, 1e3),
            ("1 MPa", D::Pressure, 1e6),
            ("1 GPa", D::Pressure, 1e9),
            ("1 bar", D::Pressure, 1e5),
            ("1 N/mm²", D::Pressure, 1e6),
            ("1 psi", D::Pressure, 6_894.757_293_168_36),
            ("30000 ksi", D::Pressure, 206.842_718_795_051e9),
            ("1 Pa·s", OIL, 1.0),
            ("1 mPa·s", OIL, 1e-3),
            ("1 cP", OIL, 1e-3),
            ("1 P", OIL, 0.1),
            ("1 reyn", OIL, 6_894.757_293_168_36),
            ("100 cSt", OIL, 0.085),
            ("1 cSt", D::KinematicViscosity, 1e-6),
            ("1 mm²/s", D::KinematicViscosity, 1e-6),
            ("1 St", D::KinematicViscosity, 1e-4),
            ("20 1/GPa", D::PressureCoefficient, 2e-8),
            ("1 mm²/N", D::PressureCoefficient, 1e-6),
            ("1 1/psi", D::PressureCoefficient, 1.450_377_377_302_09e-4),
            ("80 °C", D::Temperature, 353.15),
            ("176 °F", D::Temperature, 353.15),
            ("-40 °F", D::Temperature, 233.15),
            ("300 K", D::Temperature, 300.0),
            ("0.025 1/°F", D::PerKelvin, 0.045),
            ("0.88 g/cm³", D::Density, 880.0),
            ("5 %", D::Ratio, 0.05),
            ("2 ms", D::Time, 2e-3),
            ("1500 rpm", D::Rotation, 50.0 * PI),
            ("180 °", D::Angle, PI),
            ("1 kN m", SHAFT, 1e3),
            ("1 lbf ft", SHAFT, 1.355_817_948_331_4),
            ("20 kW", SHAFT, 200.0),
            ("1 hp", SHAFT, 7.456_998_715_822_7),
            ("25 N/mm", D::Stiffness, 25e3),
            ("250 g", D::Mass, 0.25),
        ];
        for (text, dimension, si) in table {
            let read = parse(text, dimension, "").expect(text);
            assert!((read / si - 1.0).abs() < 1e-12, "{text}: {read} instead of {si}");
            // Back: the unit as that of the field, with the number alone.
            let (number, unit) = text.split_once(' ').unwrap();
            let back = parse(number, dimension, unit).expect(text);
            assert!((back / si - 1.0).abs() < 1e-12, "{text}");
        }
        let power = parse("20 kW", D::Torque { turning: None }, "N m").unwrap_err().to_string();
        assert!(power.contains("needs the speed of the shaft"), "{power}");
    }
}
