//! Reads tables as text: cells of CSV files and of cells pasted from a spreadsheet, and units in titles.

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
            // At the end of the input, the next call ends the field. The output buffer is as long as the text.
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

/// Splits `load [N/mm]` or `load (N/mm)` into title and unit.
pub(super) fn split_title(cell: &str) -> (&str, &str) {
    match cell.split_once(['[', '(']) {
        Some((word, unit)) => (word.trim(), unit.trim().trim_end_matches([']', ')']).trim()),
        None => (cell.trim(), ""),
    }
}
