//! What one line of a table asks for.

use super::columns::Column;
use crate::scene::answer::Request;
use crate::scene::contact_spec::{ContactSpec, Field, Words};
use crate::scene::experiment::Experiment;
use crate::scene::grid;
use crate::solver::full::Problem;

/// What a line asks for. What it leaves out is the scene's, where that is written in SI units.
pub(super) fn request(
    columns: &[(Column, String)],
    cells: &[&str],
    experiment: &Experiment,
) -> Result<Request, String> {
    if cells.iter().skip(columns.len()).any(|cell| !cell.is_empty()) {
        return Err(format!("{} cells are there, but {} titles", cells.len(), columns.len()));
    }
    let stated = columns.iter().zip(cells).filter_map(|((column, unit), cell)| match (column, *cell) {
        (_, "") | (Column::Name | Column::Skipped, _) => None,
        (Column::Of(field @ Field::Contact), "roller") => Some((*field, "line", "")),
        (Column::Of(field @ Field::Contact), "ball") => Some((*field, "point", "")),
        (Column::Of(field), cell) => Some((*field, cell, unit.as_str())),
    });
    let stated = ContactSpec::read_over(&experiment.into(), stated).map_err(|why| why.in_words(Words::Columns))?;
    grid::check(&experiment.grid, stated.kind()).map_err(|error| error.to_string())?;
    let request = stated.request().map_err(|why| why.in_words(Words::Columns))?;
    Problem::new(&request.point, request.lubricant).map_err(|error| error.to_string())?;
    grid::check(&request.grid, request.point.kind).map_err(|error| match error.field.strip_prefix("grid.") {
        Some(name) => format!("{} {}", name.split('.').next().unwrap_or(name), error.problem),
        None => error.to_string(),
    })?;
    Ok(Request { grid_model: experiment.grid_model.clone(), ..request })
}
