//! Tables of numbers, written as CSV and text.

pub use crate::solver::limits::Number;

use super::names;
use crate::solver::warning::Warning;

/// Named table. NaN is an empty cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Name, used in file names.
    pub name: String,
    /// Column titles.
    pub columns: Vec<String>,
    /// Rows, each with one value per column.
    pub rows: Vec<Vec<f64>>,
    /// Names of the rows, if they have names. `run` prints such a table.
    pub labels: Vec<String>,
    /// Text columns after the numbers: title, and one text per row.
    pub remarks: Vec<(&'static str, Vec<String>)>,
}

/// Column of a table of typed rows: name and value.
pub type Column<T> = (&'static str, fn(&T) -> f64);

impl Table {
    /// Returns a table of typed rows.
    pub fn of<'a, T: 'a>(
        name: impl Into<String>,
        columns: &[Column<T>],
        rows: impl IntoIterator<Item = &'a T>,
    ) -> Self {
        let mut table = Self::new(name, &columns.iter().map(|(name, _)| *name).collect::<Vec<_>>());
        table.rows.extend(rows.into_iter().map(|row| columns.iter().map(|(_, get)| get(row)).collect()));
        table
    }

    /// Returns an empty table.
    pub fn new(name: impl Into<String>, columns: &[&str]) -> Self {
        Self { name: name.into(), columns: columns.iter().map(|&c| c.to_owned()).collect(), ..Self::default() }
    }

    /// Adds the warnings of each row as last column.
    pub fn with_warnings<'a>(self, rows: impl IntoIterator<Item = &'a [Warning]>) -> Self {
        Self { remarks: vec![(names::WARNING, rows.into_iter().map(Warning::joined).collect())], ..self }
    }

    /// Writes CSV with a title line. Numbers have the shortest form that reads back exactly. Row names are the first
    /// column, text columns the last ones.
    pub fn to_csv(&self) -> String {
        let named = (!self.labels.is_empty()).then_some("name");
        let titles = named.into_iter().chain(self.columns.iter().map(String::as_str));
        let titles = titles.chain(self.remarks.iter().map(|(title, _)| *title));
        let mut text = titles.map(quoted).collect::<Vec<_>>().join(",");
        text.push('\n');
        for (k, row) in self.rows.iter().enumerate() {
            let exact = |value: &f64| if value.is_finite() { Number(*value).to_string() } else { String::new() };
            let words = |words: &[String]| words.get(k).map(|word| quoted(word));
            let remarks = self.remarks.iter().filter_map(|(_, texts)| words(texts));
            let cells = words(&self.labels).into_iter().chain(row.iter().map(exact)).chain(remarks);
            text.push_str(&cells.collect::<Vec<_>>().join(","));
            text.push('\n');
        }
        text
    }

    /// Writes aligned columns for the terminal: numbers with three digits, each line after `indent`.
    pub fn to_text(&self, indent: &str) -> String {
        let short = |value: &f64| if value.is_finite() { significant(*value, 3) } else { String::new() };
        let mut lines = vec![std::iter::once(String::new()).chain(self.columns.iter().cloned()).collect::<Vec<_>>()];
        lines.extend(self.rows.iter().enumerate().map(|(k, row)| {
            let label = self.labels.get(k).cloned().unwrap_or_default();
            std::iter::once(label).chain(row.iter().map(short)).collect()
        }));
        let width =
            |column: usize| lines.iter().filter_map(|line| Some(line.get(column)?.chars().count())).max().unwrap_or(0);
        let widths: Vec<usize> = (0..=self.columns.len()).map(width).collect();
        let mut text = String::new();
        for line in &lines {
            let cells = line.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
                if column == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
            });
            text.push_str(indent);
            text.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
            text.push('\n');
        }
        text
    }
}

/// Returns true for a whole number below one million, which is written with all digits.
pub fn is_whole(value: f64) -> bool {
    value.fract() == 0.0 && value.abs() < 1e6
}

/// Formats a number with this number of significant digits. Whole numbers below one million have all digits.
pub fn significant(value: f64, digits: i32) -> String {
    let size = value.abs();
    if is_whole(value) {
        format!("{value}")
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (digits - 1 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        let decimals = (digits - 1).max(0) as usize;
        format!("{value:.decimals$e}")
    }
}

pub(super) fn quoted(title: &str) -> String {
    if title.contains([',', '"', '\n']) { format!("\"{}\"", title.replace('"', "\"\"")) } else { title.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_reads_back_exactly_and_leaves_gaps_empty() {
        let mut table = Table::new("t", &["a", "b,c"]);
        table.rows.push(vec![0.1, f64::NAN]);
        table.rows.push(vec![2.2e-8, 3.0]);
        assert_eq!(table.to_csv(), "a,\"b,c\"\n0.1,\n2.2e-8,3\n");
        table.labels = vec!["first".to_owned(), "x, y".to_owned()];
        assert_eq!(table.to_csv(), "name,a,\"b,c\"\nfirst,0.1,\n\"x, y\",2.2e-8,3\n");
        table.remarks = vec![("remark", vec!["no film".to_owned(), String::new()])];
        assert_eq!(table.to_csv(), "name,a,\"b,c\",remark\nfirst,0.1,,no film\n\"x, y\",2.2e-8,3,\n");
    }

    #[test]
    fn text_is_aligned_and_short() {
        let mut table = Table::new("t", &["steps", "s"]);
        table.labels = vec!["full".to_owned(), "reduced".to_owned()];
        table.rows = vec![vec![12000.0, 24.123456], vec![f64::NAN, 2.2e-8]];
        assert_eq!(
            table.to_text("  "),
            "           steps        s\n  full     12000     24.1\n  reduced         2.20e-8\n"
        );
        assert_eq!(
            [0.0, 0.01234, 99.5, 123456.7].map(|value| significant(value, 3)),
            ["0", "0.0123", "99.5", "1.23e5"]
        );
    }
}
