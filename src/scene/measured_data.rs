//! Measured film thicknesses and friction coefficients over speed or slide-to-roll ratio, as test rigs export them.
//!
//! ```text
//! speed [mm/s]; film [nm]          srr [%]; friction
//! 50;           61,2               1;       0,0123
//! ```

use super::csv::{LineProblem, Numbers, numbers, split_title};
use crate::solver::physics::engineering::{Dimension, parse};
use serde::{Deserialize, Serialize};

/// Largest magnitude of a slide-to-roll ratio.
const LARGEST_SRR: f64 = 2.0;
/// Largest friction coefficient.
const LARGEST_FRICTION: f64 = 10.0;

/// Table of measured values as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MeasuredTable {
    /// The table, as pasted or read from a file.
    pub text: String,
}

/// Column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Speed,
    Srr,
    Film,
    Friction,
    /// Title that begins with #.
    Ignored,
}

/// Line of a table. At least one of speed and ratio, and at least one of film thickness and friction coefficient are
/// given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredPoint {
    /// Line in the table, from 1.
    pub line: usize,
    /// Entrainment speed u_m \[m/s\].
    pub speed_m_per_s: Option<f64>,
    /// Slide-to-roll ratio.
    pub srr: Option<f64>,
    /// Central film thickness \[m\].
    pub film_m: Option<f64>,
    /// Magnitude of the friction coefficient.
    pub friction: Option<f64>,
}

/// Reason why a table of measured values is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct MeasuredError {
    /// Line, from 1.
    pub line: usize,
    /// What is wrong, and what is accepted.
    pub problem: String,
}

impl From<LineProblem> for MeasuredError {
    fn from((line, problem): LineProblem) -> Self {
        Self { line, problem }
    }
}

/// Reads a table of measured values.
///
/// # Errors
/// With the first invalid line.
pub fn measured_points(text: &str) -> Result<Vec<MeasuredPoint>, MeasuredError> {
    let Numbers { titles, title_line, lines } = numbers(text)?;
    let columns = titles.iter().map(|title| column(title)).collect::<Result<Vec<_>, _>>();
    let columns = columns.map_err(|problem| (title_line, problem))?;
    let has = |wanted: Column| columns.iter().filter(|(column, _)| *column == wanted).count();
    if let Some((column, _)) = columns.iter().find(|(column, _)| *column != Column::Ignored && has(*column) > 1) {
        return Err((title_line, format!("two columns give the {}", name(*column))).into());
    }
    if has(Column::Speed) + has(Column::Srr) == 0 || has(Column::Film) + has(Column::Friction) == 0 {
        let needed = "a column speed or srr, and a column film or friction are needed".to_owned();
        return Err((title_line, needed).into());
    }
    if lines.is_empty() {
        return Err((title_line, "no line of numbers follows the titles".to_owned()).into());
    }
    let point = |(line, numbers): (usize, Vec<f64>)| {
        let mut point = MeasuredPoint { line, ..MeasuredPoint::default() };
        for ((number, title), (column, factor)) in numbers.iter().zip(&titles).zip(&columns) {
            let value = number * factor;
            let (place, (low, high)) = match column {
                Column::Speed => (&mut point.speed_m_per_s, (f64::MIN_POSITIVE, 1e3)),
                Column::Srr => (&mut point.srr, (-LARGEST_SRR, LARGEST_SRR)),
                Column::Film => (&mut point.film_m, (f64::MIN_POSITIVE, 1e-2)),
                Column::Friction => (&mut point.friction, (-LARGEST_FRICTION, LARGEST_FRICTION)),
                Column::Ignored => continue,
            };
            if !(low..=high).contains(&value) {
                return Err(MeasuredError {
                    line,
                    problem: format!("`{title}` is {number}, but {}", accepted(*column)),
                });
            }
            *place = Some(if *column == Column::Friction { value.abs() } else { value });
        }
        Ok(point)
    };
    lines.into_iter().map(point).collect()
}

fn name(column: Column) -> &'static str {
    match column {
        Column::Speed => "speed",
        Column::Srr => "slide-to-roll ratio",
        Column::Film => "film thickness",
        Column::Friction => "friction coefficient",
        Column::Ignored => "",
    }
}

fn accepted(column: Column) -> &'static str {
    match column {
        Column::Speed => "must be above 0 and at most 1000 m/s",
        Column::Srr => "must be from -2 to 2; write `srr [%]` for percent",
        Column::Film => "must be above 0 and at most 10 mm; write a unit as in `film [nm]`",
        _ => "must be from -10 to 10; write `friction [%]` for percent",
    }
}

/// Returns the column of a title, and the factor from its numbers to SI units.
fn column(title: &str) -> Result<(Column, f64), String> {
    if title.starts_with('#') {
        return Ok((Column::Ignored, 1.0));
    }
    let (word, unit) = split_title(title);
    let (column, dimension) = match word.to_lowercase().replace('_', " ").as_str() {
        "speed" | "u" | "u m" | "entrainment speed" | "rolling speed" | "mean speed" => {
            (Column::Speed, Dimension::Speed { radius_m: None })
        }
        "srr" | "slip" | "slide-to-roll ratio" | "slide roll ratio" => (Column::Srr, Dimension::Ratio),
        "film" | "h" | "h c" | "film thickness" | "central film thickness" => (Column::Film, Dimension::Length),
        "friction" | "traction" | "mu" | "µ" | "μ" | "cof" | "friction coefficient" | "traction coefficient" => {
            (Column::Friction, Dimension::Ratio)
        }
        _ => {
            return Err(format!(
                "the column `{title}` is unknown; accepted are speed, srr, film and friction, and titles that begin \
                 with #"
            ));
        }
    };
    if unit.is_empty() || unit == "-" {
        return Ok((column, 1.0));
    }
    let factor = parse("1", dimension, unit).map_err(|problem| format!("the column `{title}`: {problem}"))?;
    Ok((column, factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exports_of_several_rigs_are_read() {
        let film = MeasuredPoint { line: 2, speed_m_per_s: Some(0.05), film_m: Some(61.2e-9), ..Default::default() };
        for text in [
            "speed [mm/s],film [nm]\n50,61.2\n",
            "Speed (mm/s);h_c [nm]\n50;61,2\n",
            "u_m [m/s]\tCentral film thickness [µm]\n0,05\t0,0612\n",
            "\u{feff}speed;#note;film\r\n0.05;a \"b\";6.12e-8\r\n\r\n",
        ] {
            let points = measured_points(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(points.len(), 1, "{text}");
            assert_eq!(points[0].speed_m_per_s, film.speed_m_per_s, "{text}");
            assert!((points[0].film_m.unwrap() / 61.2e-9 - 1.0).abs() < 1e-12, "{text}");
        }
        let friction = measured_points("SRR [%],µ,speed [in/s]\n-5,-0.031,10\n").unwrap()[0];
        assert_eq!((friction.srr, friction.friction, friction.speed_m_per_s), (Some(-0.05), Some(0.031), Some(0.254)));
    }

    #[test]
    fn a_refusal_names_the_cell() {
        for (text, part) in [
            ("", "line 1: the table is empty"),
            ("speed,film\n", "line 1: no line of numbers"),
            ("speed [m/s],film [nm]\n1,60\n2,\n", "line 3: `film [nm]` is missing"),
            ("speed,film [nm]\n1,60\n2,thin\n", "line 3: `film [nm]` is `thin`"),
            ("speed,film [nm]\n1,60\n2\n", "line 3: 2 columns are needed"),
            ("srr,friction\n5,0.03\n", "line 2: `srr` is 5, but must be from -2 to 2; write `srr [%]`"),
            ("speed,film\n1,60\n", "line 2: `film` is 60"),
            ("speed,film [nm]\n-1,60\n", "line 2: `speed` is -1"),
            ("speed,temperature\n1,60\n", "the column `temperature` is unknown"),
            ("speed [nm],film\n1,60\n", "“nm” is no unit of a speed"),
            ("speed,u,film\n1,1,1e-7\n", "two columns give the speed"),
            ("film,friction\n1e-7,0.1\n", "a column speed or srr"),
        ] {
            let said = measured_points(text).unwrap_err().to_string();
            assert!(said.contains(part), "{text:?}: {said}");
        }
    }
}
