//! Speed page of the manual: its tables hold the times of one run of `bench`.

use super::bench::{Bench, Row};
use crate::host::clock::today;

/// First words of the line with the day of the run.
const MEASURED: &str = "Measured on ";

/// Reason why the page cannot take a speed table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpeedPageError {
    /// A row of the page was not measured, for instance because its model is missing.
    #[error("the row `{0}` of the page was not measured")]
    NotMeasured(String),
    /// A measured row is missing in the page.
    #[error("the page has no row `{0}`")]
    NoRow(&'static str),
    /// The page lacks the line with the day of the run.
    #[error("the page has no line that begins with \"{MEASURED}\"")]
    NoDay,
}

/// Returns the line with day and version of the run.
pub fn measured_on(page: &str) -> Option<&str> {
    page.lines().find(|line| line.starts_with(MEASURED))
}

/// Returns the name of a row of a table: the code at its beginning.
fn name(line: &str) -> Option<&str> {
    Some(line.strip_prefix("| `")?.split_once('`')?.0)
}

/// Returns the rows of the page with their median times \[s\].
pub fn medians(page: &str) -> Vec<(&str, f64)> {
    let row = |line| {
        let (name, cell) = (name(line)?, line.split('|').nth(2)?);
        let milliseconds: f64 = cell.trim().strip_suffix(" ms")?.parse().ok()?;
        Some((name, milliseconds * 1e-3))
    };
    page.lines().filter_map(row).collect()
}

/// Returns the page with the times of a table in place of its own, and today as the day of the run.
///
/// # Errors
/// [`SpeedPageError`] if page and table do not have the same rows.
pub fn updated(page: &str, table: &Bench) -> Result<String, SpeedPageError> {
    measured_on(page).ok_or(SpeedPageError::NoDay)?;
    if let Some(row) = table.rows.iter().find(|row| page.lines().all(|line| name(line) != Some(row.name))) {
        return Err(SpeedPageError::NoRow(row.name));
    }
    let line = |line: &str| -> Result<String, SpeedPageError> {
        if line.starts_with(MEASURED) {
            return Ok(format!("{MEASURED}{} with version {}.", today(), env!("CARGO_PKG_VERSION")));
        }
        let Some(name) = name(line) else { return Ok(line.to_owned()) };
        let measured = table.rows.iter().find(|row| row.name == name);
        let Row { median_s, p99_s, ratio, .. } = measured.ok_or(SpeedPageError::NotMeasured(name.to_owned()))?;
        let what = line.split('|').nth(1).unwrap_or_default().trim();
        let [median, slowest] = [median_s, p99_s].map(|seconds| digits(seconds * 1e3));
        Ok(format!("| {what} | {median} ms | {slowest} ms | {} |", digits(*ratio)))
    };
    let lines = page.lines().map(line).collect::<Result<Vec<_>, _>>()?;
    Ok(lines.join("\n") + "\n")
}

/// Returns a positive number with two significant digits, from 100 on with three.
fn digits(value: f64) -> String {
    match value {
        100.0.. => {
            let step = 10f64.powf(value.log10().floor() - 2.0).max(1.0);
            format!("{:.0}", (value / step).round() * step)
        }
        10.0.. => format!("{value:.0}"),
        1.0.. => format!("{value:.1}"),
        0.1.. => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# Speed\n\nMeasured on a day with version 0.\n\n| row | median | 99 % | factor |\n|---|---|---|---|\n\
                        | `line/reduced`: the model | 1.0 ms | 2.0 ms | 3 |\n| two cores | 1 |\n";

    fn row(name: &'static str) -> Row {
        Row { name, median_s: 0.000_251, p99_s: 0.012_4, runs: 9, baseline: "line/dense-newton", ratio: 3214.0 }
    }

    fn table(names: &[&'static str]) -> Bench {
        Bench { rows: names.iter().map(|name| row(name)).collect(), ..Bench::default() }
    }

    #[test]
    fn a_run_replaces_times_and_day() {
        let page = updated(PAGE, &table(&["line/reduced"])).unwrap();
        assert!(page.contains("| `line/reduced`: the model | 0.25 ms | 12 ms | 3210 |\n"), "{page}");
        assert!(page.contains("| two cores | 1 |\n") && page.starts_with("# Speed\n\n"));
        assert_eq!(
            measured_on(&page).unwrap(),
            format!("Measured on {} with version {}.", today(), env!("CARGO_PKG_VERSION"))
        );
        let [(name, seconds)] = medians(&page)[..] else { panic!("{page}") };
        assert!(name == "line/reduced" && (seconds / 0.25e-3 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn page_and_table_must_have_the_same_rows() {
        assert_eq!(updated(PAGE, &table(&[])), Err(SpeedPageError::NotMeasured("line/reduced".to_owned())));
        let more = table(&["line/reduced", "point/reduced"]);
        assert_eq!(updated(PAGE, &more), Err(SpeedPageError::NoRow("point/reduced")));
        assert_eq!(updated("# Speed\n", &table(&[])), Err(SpeedPageError::NoDay));
    }
}
