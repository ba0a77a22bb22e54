//! Inputs of a transient contact from a CSV file: a column T and any of radius, speed and load, relative to the
//! reference values.

use crate::host::files;
use crate::solver::full::transient::{Inputs, Signal};
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

/// Reads a file and replaces the inputs named by its columns.
///
/// # Errors
/// If the file cannot be read, or with the first invalid line.
pub fn read_into(inputs: &mut Inputs, path: &Path) -> Result<(), SampledError> {
    let unreadable = |reason: String| SampledError::Read { path: path.to_owned(), reason };
    let bytes = files::read_at_most(path, MAX_SAMPLED_BYTES + 1).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
    if text.len() as u64 > MAX_SAMPLED_BYTES {
        return Err(unreadable(format!("it is larger than {} MiB", MAX_SAMPLED_BYTES >> 20)));
    }
    parse_into(inputs, &text).map_err(|(line, problem)| SampledError::Line { path: path.to_owned(), line, problem })
}

/// Same for a text. An error is the line number, from 1, and the problem.
fn parse_into(inputs: &mut Inputs, text: &str) -> Result<(), (usize, String)> {
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let (title_line, titles) =
        lines.next().ok_or((1, "the file is empty; it needs a title line `T,load`".to_owned()))?;
    let titles: Vec<&str> = titles.split(',').map(str::trim).collect();
    for (i, title) in titles.iter().enumerate() {
        if !["T", "radius", "speed", "load"].contains(title) {
            let problem = format!("the column `{title}` is unknown; write T and any of radius, speed, load");
            return Err((title_line, problem));
        }
        if titles.iter().take(i).any(|other| other == title) {
            return Err((title_line, format!("the column `{title}` occurs twice")));
        }
    }
    let Some(time_column) = titles.iter().position(|title| *title == "T").filter(|_| titles.len() > 1) else {
        return Err((title_line, "a column T and at least one of radius, speed, load are needed".to_owned()));
    };
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); titles.len()];
    for (line, text) in lines {
        let cells: Vec<&str> = text.split(',').map(str::trim).collect();
        if cells.len() != titles.len() {
            let problem =
                format!("{} columns are needed as in the title line, but there are {}", titles.len(), cells.len());
            return Err((line, problem));
        }
        for ((cell, title), column) in cells.iter().zip(&titles).zip(&mut columns) {
            let value = match cell.parse::<f64>() {
                _ if cell.is_empty() => return Err((line, format!("`{title}` is missing"))),
                Ok(value) if value.is_finite() => value,
                _ => return Err((line, format!("`{title}` is `{cell}`, but must be a finite number"))),
            };
            if let (&"T", Some(before)) = (title, column.last())
                && value <= *before
            {
                return Err((line, format!("T is {value}, but must be greater than the previous {before}")));
            }
            if matches!(*title, "radius" | "load") && value <= 0.0 {
                return Err((line, format!("`{title}` is {value}, but must be above zero")));
            }
            column.push(value);
        }
    }
    let Some(times) = columns.get(time_column).filter(|times| !times.is_empty()) else {
        return Err((title_line, "no line of numbers follows the titles".to_owned()));
    };
    for (title, values) in titles.iter().zip(&columns) {
        let signal = Signal::Sampled { times: times.clone(), values: values.clone() };
        match *title {
            "radius" => inputs.radius = signal,
            "speed" => inputs.speed = signal,
            "load" => inputs.load = signal,
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_take_the_place_of_the_inputs_of_their_names() {
        let mut inputs = Inputs::default();
        parse_into(&mut inputs, "T, load, speed\n0, 1, 1\n\n0.5, 1.2, 0.9\n").unwrap();
        let at = inputs.at(0.25);
        assert!((at.load - 1.1).abs() < 1e-15 && (at.speed - 0.95).abs() < 1e-15 && at.radius == 1.0);
    }

    #[test]
    fn a_refusal_names_the_line_and_what_is_wrong_there() {
        for (text, line, part) in [
            ("", 1, "empty"),
            ("T\n0\n", 1, "at least one"),
            ("T,force\n0,1\n", 1, "`force` is unknown"),
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
            let (seen, problem) = parse_into(&mut Inputs::default(), text).unwrap_err();
            assert!(seen == line && problem.contains(part), "{text:?}: line {seen}: {problem}");
        }
    }

    #[test]
    fn a_file_that_is_missing_is_named() {
        let error = read_into(&mut Inputs::default(), Path::new("no/such/inputs.csv")).unwrap_err().to_string();
        assert!(error.contains("no/such/inputs.csv"), "{error}");
    }
}
