//! What one line of a table asks for.

use super::columns::Column;
use crate::scene::At;
use crate::scene::bench::Request;
use crate::scene::experiment::Experiment;
use crate::scene::grid;
use crate::scene::named_lubricant::by_name;
use crate::solver::full::Problem;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::engineering::{Dimension, Grade, Oil, OilFamily, parse};

/// Units of numbers that have none: those of the command line, and °C.
fn si_unit(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Length => "m",
        Dimension::Speed { .. } => "m/s",
        Dimension::Force => "N",
        Dimension::LineLoad => "N/m",
        Dimension::Pressure => "Pa",
        Dimension::Viscosity { .. } => "Pa·s",
        Dimension::PressureCoefficient => "1/Pa",
        Dimension::Temperature => "°C",
        _ => "",
    }
}

/// The cells of a line by what they hold.
struct Cells<'a>(Vec<(Column, &'a str, &'a str)>);

impl Cells<'_> {
    fn text(&self, wanted: Column) -> Option<&str> {
        self.0.iter().find(|(column, ..)| *column == wanted).map(|(_, _, cell)| *cell)
    }

    fn number(&self, wanted: Column, name: &str, dimension: Dimension) -> Result<Option<f64>, String> {
        let Some((_, unit, cell)) = self.0.iter().find(|(column, ..)| *column == wanted) else { return Ok(None) };
        let unit = if unit.is_empty() { si_unit(dimension) } else { unit };
        parse(cell, dimension, unit).map(Some).map_err(|error| format!("{name}: {error}"))
    }

    fn quantity(&self, quantity: Quantity, kind: ContactKind) -> Result<Option<f64>, String> {
        self.number(Column::Number(quantity), quantity.name(), quantity.dimension(kind))
    }
}

/// What a line asks for. What it leaves out is the scene's, where that is written in SI units.
pub(super) fn request(
    columns: &[(Column, String)],
    cells: &[&str],
    experiment: &Experiment,
) -> Result<Request, String> {
    let filled = cells.iter().skip(columns.len()).any(|cell| !cell.is_empty());
    if filled {
        return Err(format!("{} cells are there, but {} titles", cells.len(), columns.len()));
    }
    let pairs = columns.iter().zip(cells).filter(|(_, cell)| !cell.is_empty());
    let cells = Cells(pairs.map(|((column, unit), cell)| (*column, unit.as_str(), *cell)).collect());
    let kind = match cells.text(Column::Contact) {
        None => experiment.contact,
        Some("line" | "roller") => ContactKind::Line,
        Some("point" | "ball") => ContactKind::Point,
        Some(word) => return Err(format!("contact: “{word}” is none; accepted are line, point")),
    };
    let named = cells.text(Column::Lubricant).map(by_name).transpose().map_err(|why| format!("lubricant: {why}"))?;
    let lubricant = named.map_or(experiment.lubricant, |named| named.laws);
    let mut given = [None; 6];
    for (place, quantity) in given.iter_mut().zip(Quantity::SI) {
        *place = cells.quantity(quantity, kind)?;
    }
    let radius_y = cells.quantity(Quantity::RadiusY, kind)?;
    let [radius, speed, load, modulus, mut viscosity, mut alpha] = given;
    if let Some(oil) = oil(&cells)? {
        if viscosity.is_some() || named.is_some() {
            return Err("oil says what viscosity and lubricant say; give one of them".to_owned());
        }
        let state = oil.state().map_err(|error| format!("oil: {error}"))?;
        viscosity = Some(state.viscosity_pa_s);
        alpha = alpha.or(Some(state.alpha_per_pa));
    }
    viscosity = viscosity.or(named.and_then(|named| named.viscosity_pa_s));
    if let Some(own) = lubricant.own_coefficient() {
        if alpha.is_some() {
            return Err(format!(
                "alpha follows from the lubricant's viscosity law ({own:.4e} 1/Pa); leave its cell empty"
            ));
        }
        alpha = Some(own);
    }
    let (m, l) = (cells.quantity(Quantity::M, kind)?, cells.quantity(Quantity::L, kind)?);
    let at = match (m, l) {
        (Some(m), Some(l)) => At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha },
        (None, None) => si([radius, speed, load, modulus, viscosity, alpha], radius_y, kind, experiment)?,
        _ => return Err("M and L belong together; give both".to_owned()),
    };
    let mut sliding = experiment.sliding;
    if let Some(srr) = cells.quantity(Quantity::SlideToRollRatio, kind)? {
        sliding.slide_to_roll_ratio = srr;
    }
    sliding.newtonian_plateau_ratio =
        cells.quantity(Quantity::NewtonianPlateauRatio, kind)?.or(sliding.newtonian_plateau_ratio);
    let point = at.point(kind).map_err(|error| error.to_string())?;
    let point = OperatingPoint { sliding, ..point };
    Problem::new(&point, lubricant).map_err(|error| error.to_string())?;
    grid::check(&experiment.grid, kind).map_err(|error| error.to_string())?;
    let grid = experiment.grid.for_contact(&point).map_err(|error| error.to_string())?;
    Ok(Request { lubricant, grid, ..experiment.request_at(point) })
}

/// The oil of a line by its grade and temperature.
fn oil(cells: &Cells<'_>) -> Result<Option<Oil>, String> {
    let temperature = cells.number(Column::Temperature, "temperature", Dimension::Temperature)?;
    let (grade, temperature_k) = match (cells.text(Column::Oil), temperature) {
        (Some(grade), Some(temperature)) => (grade, temperature),
        (Some(_), None) => return Err("an oil of a grade needs a temperature; add the column temperature".to_owned()),
        (None, Some(_)) => return Err("a temperature needs an oil; add the column oil, as ISO VG 68".to_owned()),
        (None, None) => return Ok(None),
    };
    let digits = grade.trim_start_matches(|c: char| !c.is_ascii_digit());
    let number: f64 = digits.parse().map_err(|_| format!("oil: “{grade}” is no grade; write it like ISO VG 68"))?;
    let family = OilFamily::Mineral;
    Ok(Some(Oil { grade: Grade::IsoVg(number), family, temperature_k, density_15: family.usual_density() }))
}

/// The contact in SI units; what is not given is the scene's.
fn si(
    given: [Option<f64>; 6],
    radius_y: Option<f64>,
    kind: ContactKind,
    experiment: &Experiment,
) -> Result<At, String> {
    let mut radius_y = radius_y;
    let own = match experiment.at {
        At::Si { radius, radius_y: own, speed, load, modulus, viscosity, alpha } => {
            if kind == ContactKind::Point {
                radius_y = radius_y.or(own);
            }
            // A load per length is no load.
            let load = (kind == experiment.contact).then_some(load);
            [Some(radius), Some(speed), load, Some(modulus), Some(viscosity), Some(alpha)]
        }
        At::Moes { .. } => [None; 6],
    };
    let all: Vec<Option<f64>> = given.into_iter().zip(own).map(|(given, own)| given.or(own)).collect();
    let [Some(radius), Some(speed), Some(load), Some(modulus), Some(viscosity), Some(alpha)] = *all else {
        let missing = Quantity::SI.into_iter().zip(&all).filter(|(_, value)| value.is_none());
        let missing: Vec<&str> = missing.map(|(quantity, _)| quantity.name()).collect();
        return Err(format!("the contact is incomplete: give {} too, or M and L", missing.join(", ")));
    };
    Ok(At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha })
}
