//! What the titles of a table say that its columns hold.

use super::CasesError;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{Dimension, parse};

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Column {
    Name,
    Contact,
    Lubricant,
    Oil,
    Temperature,
    Number(Quantity),
    Skipped,
}

/// Titles of columns, in lower case and without spaces: the word first, then what people write instead.
const TITLES: [(Column, &[&str]); 16] = [
    (Column::Name, &["name", "case", "id", "loadcase"]),
    (Column::Contact, &["contact", "kind"]),
    (Column::Lubricant, &["lubricant"]),
    (Column::Oil, &["oil", "isovg", "vg", "iso_vg"]),
    (Column::Temperature, &["temperature", "t"]),
    (Column::Number(Quantity::Radius), &["radius", "r", "r_x"]),
    (Column::Number(Quantity::RadiusY), &["radius-y", "r_y", "ry"]),
    (Column::Number(Quantity::Speed), &["speed", "u_m", "um", "u"]),
    (Column::Number(Quantity::Load), &["load", "w", "f"]),
    (Column::Number(Quantity::Modulus), &["modulus", "e'", "e’", "e\u{2032}"]),
    (Column::Number(Quantity::Viscosity), &["viscosity", "eta_0", "eta0", "η₀", "η0"]),
    (Column::Number(Quantity::Alpha), &["alpha", "α"]),
    (Column::Number(Quantity::M), &["m", "moes-m", "moes_m"]),
    (Column::Number(Quantity::L), &["l", "moes-l", "moes_l"]),
    (Column::Number(Quantity::SlideToRollRatio), &["srr", "slip"]),
    (Column::Number(Quantity::NewtonianPlateauRatio), &["npr"]),
];

/// The first title of each, as a refusal tells them.
pub(super) fn accepted() -> String {
    TITLES.iter().filter_map(|(_, titles)| titles.first().copied()).collect::<Vec<_>>().join(", ")
}

/// What each column holds, with the unit of its numbers.
pub(super) fn titles(line: usize, cells: &[&str]) -> Result<Vec<(Column, String)>, CasesError> {
    let mut columns: Vec<(Column, String)> = Vec::new();
    for &cell in cells {
        let title = || cell.to_owned();
        let (word, unit) = split_title(cell);
        let key: String = word.to_lowercase().split_whitespace().collect();
        let column = if word.is_empty() || word.starts_with('#') {
            Column::Skipped
        } else {
            let known = TITLES.iter().find(|(_, titles)| titles.contains(&key.as_str()));
            known.ok_or_else(|| CasesError::Title { line, title: title() })?.0
        };
        if column != Column::Skipped && columns.iter().any(|(other, _)| *other == column) {
            return Err(CasesError::Twice { line, title: title() });
        }
        check_unit(column, unit).map_err(|problem| CasesError::Unit { line, title: title(), problem })?;
        columns.push((column, unit.to_owned()));
    }
    Ok(columns)
}

/// Title and unit of `load [N/mm]` or `load (N/mm)`.
fn split_title(cell: &str) -> (&str, &str) {
    match cell.split_once(['[', '(']) {
        Some((word, unit)) => (word.trim(), unit.trim().trim_end_matches([']', ')']).trim()),
        None => (cell.trim(), ""),
    }
}

/// The unit of a title must be one of its quantity, for one of both kinds of contact.
fn check_unit(column: Column, unit: &str) -> Result<(), String> {
    let dimensions = match column {
        _ if unit.is_empty() => return Ok(()),
        Column::Number(quantity) => [ContactKind::Line, ContactKind::Point].map(|kind| quantity.dimension(kind)),
        Column::Temperature => [Dimension::Temperature; 2],
        _ => return Ok(()),
    };
    let [first, second] = dimensions.map(|dimension| parse("1", dimension, unit).map(drop));
    first.or(second).map_err(|error| error.to_string())
}
