//! Titles of table columns on the screen: symbol and unit in the system of the window. Files keep the names of results
//! and SI units.

use crate::scene::names;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};

/// Columns with a symbol, and their kind.
const KNOWN: [(&str, &str, QuantityKind); 20] = [
    (names::RADIUS, "{R}", QuantityKind::Length),
    (names::RADIUS_Y, "{R_y}", QuantityKind::Length),
    (names::SPEED, "{u_m}", QuantityKind::Speed),
    (names::U1, "{u_1}", QuantityKind::Speed),
    (names::U2, "{u_2}", QuantityKind::Speed),
    (names::MODULUS, "{E'}", QuantityKind::Pressure),
    (names::VISCOSITY, "{η_0}", QuantityKind::Viscosity),
    (names::ALPHA, "{α}", QuantityKind::PressureCoefficient),
    (names::LENGTH, "length", QuantityKind::Length),
    (names::SRR, "SRR", QuantityKind::Percent),
    (names::HALF_WIDTH, "{a}", QuantityKind::Length),
    (names::HALF_LENGTH, "{b}", QuantityKind::Length),
    (names::HERTZ_PRESSURE, "{p_H}", QuantityKind::Pressure),
    (names::SUPPLY_FILM, "inlet film", QuantityKind::FilmThickness),
    (names::H_C_M, "{h_c}", QuantityKind::FilmThickness),
    (names::H_MIN_M, "{h_min}", QuantityKind::FilmThickness),
    ("measured_h_c_m", "measured {h_c}", QuantityKind::FilmThickness),
    (names::FRICTION_FORCE, "friction force", QuantityKind::Force),
    (names::TOTAL_ROLLING_RESISTANCE, "rolling resistance", QuantityKind::Force),
    (names::POWER_LOSS, "power loss", QuantityKind::Power),
];

/// Ends of names that tell the unit of columns without a symbol.
const ENDS: [(&str, QuantityKind); 5] = [
    ("_pa", QuantityKind::Pressure),
    ("_k", QuantityKind::TemperatureRise),
    ("_nm", QuantityKind::Torque),
    ("_n", QuantityKind::Force),
    ("_w", QuantityKind::Power),
];

/// Column as the screen shows it.
pub struct ShownColumn {
    /// Title with symbols in braces, and the unit.
    pub title: String,
    kind: Option<QuantityKind>,
    system: UnitSystem,
}

impl ShownColumn {
    /// Returns a column by its name in files.
    pub fn of(name: &str, system: UnitSystem) -> Self {
        let (method, own) = match name.split_once('.') {
            Some((method @ ("full" | "reduced"), own)) => (format!("{method} "), own),
            _ => (String::new(), name),
        };
        let known = KNOWN.iter().find(|(known, ..)| *known == own);
        let by_end = || ENDS.iter().find_map(|(end, kind)| own.strip_suffix(end).map(|word| (word, *kind)));
        let (word, kind) = match known {
            Some((_, symbol, kind)) => (*symbol, Some(*kind)),
            None => by_end().map_or((own, None), |(word, kind)| (word, Some(kind))),
        };
        let unit = kind.map_or("", |kind| kind.unit(system).name);
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        // A load is a load per length in lines of line contacts.
        let unit = if own == names::LOAD { " [N/m, N]".to_owned() } else { unit };
        let word = if own == names::LOAD { "{w}" } else { word };
        Self { title: format!("{method}{word}{unit}"), kind, system }
    }

    /// Returns the title without marks of symbols.
    pub fn plain(&self) -> String {
        self.title.replace(['{', '}'], "")
    }

    /// Returns the shown number of a value as files have it.
    pub fn number(&self, value: f64) -> f64 {
        self.kind.map_or(value, |kind| kind.unit(self.system).number(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_have_symbols_and_units_of_the_system() {
        for (name, system, title, value, number) in [
            ("full.h_c_m", UnitSystem::Engineering, "full {h_c} [µm]", 2.5e-7, 0.25),
            ("reduced.h_min_m", UnitSystem::Imperial, "reduced {h_min} [µin]", 2.54e-7, 10.0),
            ("si.modulus", UnitSystem::Si, "{E'} [Pa]", 2e11, 2e11),
            ("srr", UnitSystem::Engineering, "SRR [%]", 0.1, 10.0),
            ("si.load", UnitSystem::Imperial, "{w} [N/m, N]", 3e5, 3e5),
            ("full.H_c", UnitSystem::Engineering, "full H_c", 0.04, 0.04),
            ("full.heat.mid_film_rise_k", UnitSystem::Imperial, "full heat.mid_film_rise [°F]", 10.0, 18.0),
            ("line", UnitSystem::Si, "line", 3.0, 3.0),
        ] {
            let column = ShownColumn::of(name, system);
            assert_eq!(column.title, title);
            assert!((column.number(value) / number - 1.0).abs() < 1e-12, "{name}");
        }
    }
}
