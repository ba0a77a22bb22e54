//! Rows of a report, and numbers with their units.

use crate::scene::table::significant;
use crate::solver::physics::engineering::{Digits, QuantityKind, UnitSystem};

/// Returns a value in SI units with the largest unit of the system that fits.
pub fn measured(kind: QuantityKind, si: f64, system: UnitSystem) -> String {
    let unit = kind.unit_of(system, si);
    let text = match kind.digits() {
        Digits::Significant(count) => trimmed(unit.number(si), count),
        Digits::Decimals(count) => format!("{:.count$}", unit.number(si)).replace('-', "−"),
    };
    format!("{text} {}", unit.name)
}

/// Returns a dimensionless number, without zeros at the end of its decimals.
pub fn number(value: f64) -> String {
    trimmed(value, 4)
}

fn trimmed(value: f64, digits: usize) -> String {
    let text = significant(value, digits as i32);
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
    system: UnitSystem,
}

impl Section {
    pub fn new(title: &'static str, system: UnitSystem) -> Self {
        Self { title, rows: Vec::new(), system }
    }

    /// Adds a row. An empty value is left out.
    pub fn row(&mut self, name: &str, value: impl Into<String>) {
        let value = value.into();
        if !value.is_empty() {
            self.rows.push(Row { name: name.to_owned(), value });
        }
    }

    /// Adds a number with its unit, if there is one.
    pub fn measure(&mut self, name: &str, value: impl Into<Option<f64>>, kind: QuantityKind) {
        if let Some(value) = value.into().filter(|value| value.is_finite()) {
            self.row(name, measured(kind, value, self.system));
        }
    }
}
