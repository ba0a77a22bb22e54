//! Rows of a report, and numbers in engineering units.

use crate::scene::table::significant;

/// Significant digits.
const DIGITS: i32 = 4;

/// Unit with its size in SI units.
pub type Unit = (&'static str, f64);

pub const LENGTH: &[Unit] = &[("nm", 1e-9), ("µm", 1e-6), ("mm", 1e-3), ("m", 1.0)];
pub const PRESSURE: &[Unit] = &[("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];
pub const FORCE: &[Unit] = &[("mN", 1e-3), ("N", 1.0), ("kN", 1e3), ("MN", 1e6)];
pub const LINE_LOAD: &[Unit] = &[("N/mm", 1e3)];
pub const SPEED: &[Unit] = &[("m/s", 1.0)];
pub const VISCOSITY: &[Unit] = &[("mPa·s", 1e-3), ("Pa·s", 1.0)];
pub const PRESSURE_COEFFICIENT: &[Unit] = &[("1/GPa", 1e-9)];
pub const TORQUE: &[Unit] = &[("N mm", 1e-3), ("N m", 1.0)];
pub const POWER: &[Unit] = &[("mW", 1e-3), ("W", 1.0), ("kW", 1e3)];
pub const POWER_PER_LENGTH: &[Unit] = &[("W/mm", 1e3)];

/// Returns a value with the largest of these units in which it is at least 1, or with the first one.
pub fn measured(value: f64, units: &[Unit]) -> String {
    let fits = |(_, size): &&Unit| value.abs() >= 0.999_95 * size;
    match units.iter().rev().find(fits).or(units.first()) {
        Some((unit, size)) => format!("{} {unit}", number(value / size)),
        None => number(value),
    }
}

/// Returns a dimensionless number, without zeros at the end of its decimals.
pub fn number(value: f64) -> String {
    let text = significant(value, DIGITS);
    let short = match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text.as_str(),
    };
    short.replace('-', "−")
}

/// Returns a ratio in percent.
pub fn percent(value: f64) -> String {
    format!("{} %", significant(100.0 * value, 2).replace('-', "−"))
}

/// Returns a temperature in °C.
pub fn celsius(kelvin: f64) -> String {
    format!("{:.1} °C", kelvin - crate::solver::physics::engineering::KELVIN).replace('-', "−")
}

/// Row of a section: name and value, both with symbols in braces.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub name: String,
    pub value: String,
}

/// Section of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    pub title: &'static str,
    pub rows: Vec<Row>,
}

impl Section {
    pub fn new(title: &'static str) -> Self {
        Self { title, rows: Vec::new() }
    }

    /// Adds a row. An empty value is left out.
    pub fn row(&mut self, name: &str, value: impl Into<String>) {
        let value = value.into();
        if !value.is_empty() {
            self.rows.push(Row { name: name.to_owned(), value });
        }
    }

    /// Adds a number with its unit, if there is one.
    pub fn measure(&mut self, name: &str, value: impl Into<Option<f64>>, units: &[Unit]) {
        if let Some(value) = value.into().filter(|value| value.is_finite()) {
            self.row(name, measured(value, units));
        }
    }
}
