//! Reads tables from text, such as a CSV file or cells pasted from a spreadsheet: cells, titles with units, and
//! complete tables of numbers.

use csv_core::ReadFieldResult;

/// Returns the cell delimiter: tab for tables pasted from a spreadsheet, semicolon for tables with decimal commas, or
/// comma.
pub(super) fn delimiter(text: &str) -> u8 {
    let titles = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    [b'\t', b';'].into_iter().find(|&mark| titles.contains(char::from(mark))).unwrap_or(b',')
}

/// Returns the cells of each record, with the line number where it begins, from 1.
pub(super) fn records(text: &str) -> Vec<(usize, Vec<String>)> {
    let mut reader = csv_core::ReaderBuilder::new().delimiter(delimiter(text)).build();
    let (mut input, mut out) = (text.as_bytes(), vec![0; text.len() + 1]);
    let (mut records, mut cells, mut cell) = (Vec::new(), Vec::new(), Vec::new());
    let (mut line, mut begin) = (1, 1);
    loop {
        if cells.is_empty() && cell.is_empty() {
            begin = line + input.iter().take_while(|byte| byte.is_ascii_whitespace()).filter(|&&b| b == b'\n').count();
        }
        let (result, read, written) = reader.read_field(input, &mut out);
        let (done, rest) = input.split_at_checked(read).unwrap_or((input, &[]));
        line += done.iter().filter(|&&byte| byte == b'\n').count();
        input = rest;
        cell.extend(out.iter().take(written));
        match result {
            // If the input is used up, the next call ends the field. The output buffer has room for the whole text.
            ReadFieldResult::InputEmpty | ReadFieldResult::OutputFull => {}
            ReadFieldResult::Field { record_end } => {
                cells.push(String::from_utf8_lossy(&cell).into_owned());
                cell.clear();
                if record_end {
                    records.push((begin, std::mem::take(&mut cells)));
                }
            }
            ReadFieldResult::End => return records,
        }
    }
}

/// Splits `load [N/mm]` or `load (N/mm)` into title and unit. The unit is empty if there is none.
pub(super) fn split_title(cell: &str) -> (&str, &str) {
    match cell.split_once(['[', '(']) {
        Some((word, unit)) => (word.trim(), unit.trim().trim_end_matches([']', ')']).trim()),
        None => (cell.trim(), ""),
    }
}

/// Line number, from 1, and what is wrong on this line.
pub(super) type LineProblem = (usize, String);

/// Table of numbers without empty cells.
pub(super) struct Numbers {
    /// Titles of the columns.
    pub titles: Vec<String>,
    /// Line number of the titles, from 1.
    pub title_line: usize,
    /// Line number and numbers of each further line, one number per title.
    pub lines: Vec<(usize, Vec<f64>)>,
}

/// Reads a table of numbers with a line of titles. Decimal signs are points or commas. Blank lines are skipped. Columns
/// whose title begins with # may contain anything; their numbers are NaN.
///
/// # Errors
/// If there is no line of titles, or with the first line that has too many or too few cells, an empty cell, or a cell
/// that is not a finite number.
pub(super) fn numbers(text: &str) -> Result<Numbers, LineProblem> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let filled = |cells: &Vec<String>| cells.iter().any(|cell| !cell.trim().is_empty());
    let mut records = records(text).into_iter().filter(|(_, cells)| filled(cells));
    let (title_line, titles) = records.next().ok_or((1, "the table is empty; it needs a line of titles".to_owned()))?;
    let titles: Vec<String> = titles.iter().map(|title| title.trim().to_owned()).collect();
    let line = |(line, cells): (usize, Vec<String>)| {
        if cells.len() != titles.len() {
            let (wanted, found) = (titles.len(), cells.len());
            return Err((line, format!("{wanted} columns are needed as in the title line, but there are {found}")));
        }
        let numbers = titles.iter().zip(&cells).map(|(title, cell)| number(title, cell.trim()));
        Ok((line, numbers.collect::<Result<Vec<f64>, String>>().map_err(|problem| (line, problem))?))
    };
    let lines = records.map(line).collect::<Result<Vec<_>, LineProblem>>()?;
    Ok(Numbers { titles, title_line, lines })
}

/// Reads a cell of the column with this title.
fn number(title: &str, cell: &str) -> Result<f64, String> {
    match cell.replace(',', ".").replace('−', "-").parse::<f64>() {
        _ if title.starts_with('#') => Ok(f64::NAN),
        _ if cell.is_empty() => Err(format!("`{title}` is missing")),
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("`{title}` is `{cell}`, but must be a finite number")),
    }
}
