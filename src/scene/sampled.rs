//! Inputs of a transient contact from a table: a column of times and any of radius, speed and load.
//!
//! Without units, times are in units of a_ref/u_ref and the other columns are relative to the reference contact. With
//! a unit in the title, as in `time [ms]` or `load [N/mm]`, they are quantities.

use super::csv::{LineProblem, Numbers, numbers, split_title};
use crate::host::files;
use crate::solver::full::transient::{Inputs, Signal};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{Dimension, parse};
use std::path::{Path, PathBuf};

/// Largest accepted size of a file \[bytes\].
pub const MAX_SAMPLED_BYTES: u64 = 32 << 20;

/// Reason why sampled inputs are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SampledError {
    /// The file cannot be read.
    #[error("cannot read the inputs {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        reason: String,
    },
    /// A line is invalid.
    #[error("the inputs {} are refused: line {line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong, and what is accepted.
        problem: String,
    },
}

/// Contact to which quantities with units refer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Reference contact.
    pub point: OperatingPoint,
    /// Length of the line contact \[m\], over which a force in N is distributed; `None` if it is unknown.
    pub length_m: Option<f64>,
}

impl From<OperatingPoint> for Reference {
    fn from(point: OperatingPoint) -> Self {
        Self { point, length_m: None }
    }
}

/// Column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Time,
    Radius,
    Speed,
    Load,
}

/// Reads a file and replaces the inputs named by its columns. Returns the last time T.
///
/// # Errors
/// If the file cannot be read, or with the first invalid line.
pub fn read_into(inputs: &mut Inputs, path: &Path, reference: &Reference) -> Result<f64, SampledError> {
    let unreadable = |reason: String| SampledError::Read { path: path.to_owned(), reason };
    let bytes = files::read_at_most(path, MAX_SAMPLED_BYTES + 1).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
    if text.len() as u64 > MAX_SAMPLED_BYTES {
        return Err(unreadable(format!("it is larger than {} MiB", MAX_SAMPLED_BYTES >> 20)));
    }
    parse_into(inputs, &text, reference).map_err(|(line, problem)| SampledError::Line {
        path: path.to_owned(),
        line,
        problem,
    })
}

/// Returns the column of a title, and the factor from its numbers to values relative to the reference contact.
fn column(title: &str, reference: &Reference) -> Result<(Column, f64), String> {
    let (word, unit) = split_title(title);
    let Reference { point, length_m } = reference;
    let (column, dimension, unit_of_reference) = match word.to_lowercase().as_str() {
        "t" | "time" => (Column::Time, Dimension::Time, point.hertz().half_width_m / point.speed_m_per_s),
        "radius" | "r" => (Column::Radius, Dimension::Length, point.radius_m),
        "speed" | "u" | "u_m" => (Column::Speed, Dimension::Speed { radius_m: None }, point.speed_m_per_s),
        "load" | "w" | "f" => (Column::Load, Dimension::LineLoad, point.load),
        _ => {
            return Err(format!("the column `{title}` is unknown; write T or time [s] and any of radius, speed, load"));
        }
    };
    if unit.is_empty() {
        if column == Column::Time && word != "T" {
            return Err(format!("the column `{title}` has no unit; write time [s], or T for times in units of a/u_m"));
        }
        return Ok((column, 1.0));
    }
    let factor = |dimension| parse("1", dimension, unit).map_err(|problem| format!("the column `{title}`: {problem}"));
    if column != Column::Time
        && let Ok(ratio) = parse("1", Dimension::Ratio, unit)
    {
        return Ok((column, ratio));
    }
    if column == Column::Load
        && let Ok(force) = parse("1", Dimension::Force, unit)
    {
        let Some(length) = length_m else {
            return Err(format!(
                "the column `{title}` is a force, but the length of the contact is unknown; write a load per length, \
                 as load [N/mm]"
            ));
        };
        return Ok((column, force / length / unit_of_reference));
    }
    Ok((column, factor(dimension)? / unit_of_reference))
}

/// Same for a text. An error is the line number, from 1, and the problem.
fn parse_into(inputs: &mut Inputs, text: &str, reference: &Reference) -> Result<f64, LineProblem> {
    let Numbers { titles, title_line, lines } = numbers(text)?;
    let mut columns: Vec<(Column, f64)> = Vec::new();
    for title in &titles {
        let (column, factor) = column(title, reference).map_err(|problem| (title_line, problem))?;
        if columns.iter().any(|(other, _)| *other == column) {
            return Err((title_line, format!("the column `{title}` occurs twice")));
        }
        columns.push((column, factor));
    }
    let Some(time_column) = columns.iter().position(|(column, _)| *column == Column::Time).filter(|_| titles.len() > 1)
    else {
        return Err((title_line, "a column T and at least one of radius, speed, load are needed".to_owned()));
    };
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); titles.len()];
    for (line, numbers) in lines {
        for (((value, title), (column, factor)), values) in numbers.iter().zip(&titles).zip(&columns).zip(&mut values) {
            let scaled = value * factor;
            if let (Column::Time, Some(before)) = (column, values.last())
                && scaled <= *before
            {
                let before = before / factor;
                return Err((line, format!("{title} is {value}, but must be greater than the previous {before}")));
            }
            if matches!(column, Column::Radius | Column::Load) && *value <= 0.0 {
                return Err((line, format!("`{title}` is {value}, but must be above zero")));
            }
            values.push(scaled);
        }
    }
    let times = values.get(time_column).cloned().unwrap_or_default();
    let Some(last) = times.last().copied() else {
        return Err((title_line, "no line of numbers follows the titles".to_owned()));
    };
    for ((column, _), values) in columns.iter().zip(values) {
        let signal = Signal::Sampled { times: times.clone(), values };
        match column {
            Column::Radius => inputs.radius = signal,
            Column::Speed => inputs.speed = signal,
            Column::Load => inputs.load = signal,
            Column::Time => {}
        }
    }
    Ok(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(inputs: &mut Inputs, text: &str) -> Result<f64, (usize, String)> {
        parse_into(inputs, text, &Reference { point: OperatingPoint::TABLE_2_1, length_m: Some(0.01) })
    }

    #[test]
    fn columns_take_the_place_of_the_inputs_of_their_names() {
        let mut inputs = Inputs::default();
        let last = read(&mut inputs, "T, load, speed\n0, 1, 1\n\n0.5, 1.2, 0.9\n").unwrap();
        let at = inputs.at(0.25);
        assert!((at.load - 1.1).abs() < 1e-15 && (at.speed - 0.95).abs() < 1e-15 && at.radius == 1.0 && last == 0.5);
    }

    #[test]
    fn quantities_with_units_are_read_with_every_separator() {
        let point = OperatingPoint::TABLE_2_1;
        let unit = point.hertz().half_width_m / point.speed_m_per_s;
        for text in [
            "time [ms];load [N/mm];speed [m/s];radius [mm]\n0;646,11;5,0365;22,5\n1;1292,22;10,073;45\n",
            "time [ms]\tload [N/mm]\tspeed [m/s]\tradius [mm]\n0\t646,11\t5,0365\t22,5\n1\t1292,22\t10,073\t45\n",
            "t (s),w [kN/m],u_m [m/s],R [m]\n0,646.11,5.0365,0.0225\n1e-3,1292.22,10.073,0.045\n",
            "t [s],load [N],speed [%],radius\n0,6461.1,100,1\n1e-3,12922.2,200,2\n",
        ] {
            let mut inputs = Inputs::default();
            let last = read(&mut inputs, text).unwrap();
            assert!((last * unit / 1e-3 - 1.0).abs() < 1e-12, "{text}: {last}");
            let (first, end) = (inputs.at(0.0), inputs.at(last));
            for (value, expected) in [
                (first.load, 1.0),
                (first.speed, 1.0),
                (first.radius, 1.0),
                (end.load, 2.0),
                (end.speed, 2.0),
                (end.radius, 2.0),
            ] {
                assert!((value - expected).abs() < 1e-9, "{text}: {value} {expected}");
            }
        }
        let unknown = Reference::from(point);
        let refused = parse_into(&mut Inputs::default(), "t [s],load [N]\n0,1\n", &unknown).unwrap_err().1;
        assert!(refused.contains("the length of the contact is unknown"), "{refused}");
    }

    #[test]
    fn a_refusal_names_the_line_and_what_is_wrong_there() {
        for (text, line, part) in [
            ("", 1, "empty"),
            ("T\n0\n", 1, "at least one"),
            ("T,force\n0,1\n", 1, "`force` is unknown"),
            ("time,load\n0,1\n", 1, "has no unit"),
            ("T,load [mm]\n0,1\n", 1, "“mm” is no unit of a load per length"),
            ("T,load,load\n", 1, "twice"),
            ("T,load\n", 1, "no line of numbers"),
            ("T,load\n0,1\n1\n", 3, "2 columns are needed"),
            ("T,load\n0,1\n1,2,3\n", 3, "there are 3"),
            ("T,load\n0,1\n1,\n", 3, "`load` is missing"),
            ("T,load\n0,1\n1,NaN\n", 3, "finite"),
            ("T,load\n0,1\nx,1\n", 3, "`T` is `x`"),
            ("T,load\n0,1\n2,1\n2,1\n", 4, "must be greater than the previous 2"),
            ("T,load\n0,1\n1,-0.5\n", 3, "above zero"),
        ] {
            let (seen, problem) = read(&mut Inputs::default(), text).unwrap_err();
            assert!(seen == line && problem.contains(part), "{text:?}: line {seen}: {problem}");
        }
    }

    #[test]
    fn a_file_that_is_missing_is_named() {
        let reference = OperatingPoint::TABLE_2_1.into();
        let read = read_into(&mut Inputs::default(), Path::new("no/such/inputs.csv"), &reference);
        let error = read.unwrap_err().to_string();
        assert!(error.contains("no/such/inputs.csv"), "{error}");
    }
}
