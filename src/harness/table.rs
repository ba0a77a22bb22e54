//! Tables of numbers and their CSV.

use std::fmt::Write;

/// A named table; NaN stands for an empty cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name, used in file names.
    pub name: String,
    /// Column titles.
    pub columns: Vec<String>,
    /// Rows as long as the columns.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// An empty table.
    pub fn new(name: impl Into<String>, columns: &[&str]) -> Self {
        Self { name: name.into(), columns: columns.iter().map(|&c| c.to_owned()).collect(), rows: Vec::new() }
    }

    /// As CSV with a title line; numbers in the shortest form that reads back exactly.
    pub fn to_csv(&self) -> String {
        let mut text = self.columns.iter().map(|title| quoted(title)).collect::<Vec<_>>().join(",");
        text.push('\n');
        for row in &self.rows {
            for (i, value) in row.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                if value.is_finite() {
                    // Writing to a string cannot fail.
                    let _ = write!(text, "{}", Number(*value));
                }
            }
            text.push('\n');
        }
        text
    }
}

/// A number in its shortest exact form, with an exponent where it is very small or large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-4..1e15).contains(&size) { write!(f, "{:e}", self.0) } else { write!(f, "{}", self.0) }
    }
}

fn quoted(title: &str) -> String {
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
    }
}
