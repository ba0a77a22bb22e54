//! Converts one line of a table into a request.

use super::columns::Column;
use super::error::LineError;
use crate::scene::answer::Request;
use crate::scene::contact_spec::{ContactSpec, Field};
use crate::scene::experiment::Experiment;
use crate::scene::grid;
use crate::solver::full::Problem;
use crate::solver::physics::engineering::{Dimension, parse};

/// Returns the measured central film thickness of a line \[m\], or `None` if the line has none.
pub(super) fn measured(columns: &[(Column, String)], cells: &[&str]) -> Result<Option<f64>, LineError> {
    let column = columns.iter().zip(cells).find(|((column, _), cell)| *column == Column::Measured && !cell.is_empty());
    let Some(((_, unit), cell)) = column else { return Ok(None) };
    let film = parse(cell, Dimension::Length, unit).map_err(LineError::Measured)?;
    if film > 0.0 { Ok(Some(film)) } else { Err(LineError::MeasuredRange(film)) }
}

/// Returns the request of a line. Fields that the line leaves out are those of the scene, if the scene is written in SI
/// units.
pub(super) fn request(
    columns: &[(Column, String)],
    cells: &[&str],
    experiment: &Experiment,
) -> Result<Request, LineError> {
    if cells.iter().skip(columns.len()).any(|cell| !cell.is_empty()) {
        return Err(LineError::Cells { cells: cells.len(), titles: columns.len() });
    }
    let stated = columns.iter().zip(cells).filter_map(|((column, unit), cell)| match (column, *cell) {
        (_, "") | (Column::Name | Column::Measured | Column::Skipped, _) => None,
        (Column::Of(field @ Field::Contact), "roller") => Some((*field, "line", "")),
        (Column::Of(field @ Field::Contact), "ball") => Some((*field, "point", "")),
        (Column::Of(field), cell) => Some((*field, cell, unit.as_str())),
    });
    let stated = ContactSpec::read_over(&experiment.into(), stated)?;
    grid::check(&experiment.grid, stated.kind()).map_err(LineError::GridOfScene)?;
    let request = stated.request()?;
    Problem::new(&request.point, request.lubricant)?;
    grid::check(&request.grid, request.point.kind).map_err(LineError::Grid)?;
    Ok(Request { grid_model: experiment.grid_model.clone(), ..request })
}
