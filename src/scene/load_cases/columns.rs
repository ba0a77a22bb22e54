//! Columns of a table of load cases, read from their titles.

use super::error::CasesError;
use crate::scene::contact_spec::{Field, Words};
use crate::scene::csv::split_title;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{Dimension, UnitError, parse};

/// Content of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Column {
    Name,
    /// Measured central film thickness.
    Measured,
    Of(Field),
    Skipped,
}

/// Titles of the column with contact names, in lower case and without spaces.
const NAMES: [&str; 4] = ["name", "case", "id", "loadcase"];
/// Titles of the column with measured central film thicknesses, written the same way.
const MEASURED: [&str; 3] = ["measured", "measuredfilm", "measuredh_c"];

/// Returns the titles of all fields that a column may hold.
pub(super) fn accepted() -> String {
    Field::of(Words::Columns).map(|field| field.facts().column).collect::<Vec<_>>().join(", ")
}

/// Returns the content of each column, with the unit of its numbers.
pub(super) fn titles(line: usize, cells: &[&str]) -> Result<Vec<(Column, String)>, CasesError> {
    let mut columns: Vec<(Column, String)> = Vec::new();
    for &cell in cells {
        let title = || cell.to_owned();
        let (word, unit) = split_title(cell);
        let column = if word.is_empty() || word.starts_with('#') {
            Column::Skipped
        } else {
            let plain: String = word.to_lowercase().split_whitespace().collect();
            let own = |titles: &[&str]| titles.contains(&plain.as_str());
            let column = if own(&NAMES) { Some(Column::Name) } else { own(&MEASURED).then_some(Column::Measured) };
            column
                .or_else(|| Field::titled(word).map(Column::Of))
                .ok_or_else(|| CasesError::Title { line, title: title() })?
        };
        if column != Column::Skipped && columns.iter().any(|(other, _)| *other == column) {
            return Err(CasesError::Twice { line, title: title() });
        }
        check_unit(column, unit).map_err(|problem| CasesError::Unit { line, title: title(), problem })?;
        columns.push((column, unit.to_owned()));
    }
    Ok(columns)
}

/// Checks that the unit of a title belongs to its field, for at least one contact kind.
fn check_unit(column: Column, unit: &str) -> Result<(), UnitError> {
    let Column::Of(field) = column else {
        let checked = column == Column::Measured && !unit.is_empty();
        return if checked { parse("1", Dimension::Length, unit).map(drop) } else { Ok(()) };
    };
    if unit.is_empty() || !field.is_number() {
        return Ok(());
    }
    let read = |kind| parse("1", field.facts().dimension_in(kind), unit).map(drop);
    let [line, point] = ContactKind::BOTH.map(read);
    line.or(point)
}
