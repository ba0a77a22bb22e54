//! Chart of a column of a table, along the lines or over another column.

use super::columns::ShownColumn;
use super::measured;
use crate::app::controls::named;
use crate::scene::{Chart, ChartAxis, Marks, MeasuredPoint, Study, Table};
use crate::solver::physics::engineering::UnitSystem;
use egui::{ComboBox, Ui};

/// Plotted column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlottedColumn {
    /// Name of the table.
    pub table: String,
    /// Number of the column.
    pub column: usize,
    /// Number of the column along the horizontal axis; `None` for the lines of the table.
    pub over: Option<usize>,
}

impl PlottedColumn {
    /// Creates the plot of a column: of a sweep over its last varied quantity, of another table along its lines.
    fn new(table: &Table, column: usize, study: &Study) -> Self {
        let over = match study {
            Study::Sweep(sweep) => sweep.over.len().checked_sub(1),
            _ => None,
        };
        Self { table: table.name.clone(), column, over }
    }

    /// Draws the choice of both columns. Returns the plot that was chosen. `shown` is the plot on the screen, if the tab
    /// shows one.
    pub fn ui(ui: &mut Ui, (table, study): (&Table, &Study), shown: Option<&Self>, system: UnitSystem) -> Option<Self> {
        let shown = shown.filter(|shown| shown.table == table.name);
        let text = shown.map_or_else(|| "Plot a column".to_owned(), |shown| title(table, shown.column, system));
        let name = ("Plotted column", "Plots a column along the lines of the table, or over another column");
        let present = shown.map(|shown| Some(shown.column));
        let column = choice(ui, name, (table, system), (&text, 170.0), present, false).flatten();
        if let Some(column) = column {
            let own = || Self::new(table, column, study);
            return Some(shown.map_or_else(own, |shown| Self { column, ..shown.clone() }));
        }
        let shown = shown?;
        ui.weak("over");
        let text = shown.over.map_or_else(|| "Line".to_owned(), |over| title(table, over, system));
        let name = ("Horizontal axis", "Line of the table, or a column");
        let over = choice(ui, name, (table, system), (&text, 130.0), Some(shown.over), true)?;
        Some(Self { over, ..shown.clone() })
    }

    /// Returns the chart, and the measured points over its quantities. `None` if there is no such column.
    pub fn chart(&self, table: &Table, system: UnitSystem, points: &[MeasuredPoint]) -> Option<(Chart, Vec<[f64; 2]>)> {
        let column = |k: usize| Some((table.columns.get(k)?, ShownColumn::of(table.columns.get(k)?, system)));
        let (name, shown) = column(self.column)?;
        let (below, over) = match self.over {
            Some(over) => Some(column(over)?).unzip(),
            None => (None, None),
        };
        let title = shown.plain();
        let axis = over.as_ref().map_or_else(|| "Line".to_owned(), ShownColumn::plain);
        let mut chart = Chart::new(&title, ChartAxis::linear(axis), ChartAxis::linear(&title));
        let number = |row: &Vec<f64>, k: usize, of: &ShownColumn| {
            row.get(k).map(|value| of.number(*value)).filter(|value| value.is_finite())
        };
        let point = |(line, row): (usize, &Vec<f64>)| {
            let along = match (self.over, &over) {
                (Some(k), Some(over)) => number(row, k, over)?,
                _ => (line + 1) as f64,
            };
            Some([along, number(row, self.column, &shown)?])
        };
        let points_of: Vec<[f64; 2]> = table.rows.iter().enumerate().filter_map(point).collect();
        // A line that runs back would show no function.
        if points_of.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
            chart.add("", Marks::Line, points_of.iter().copied());
        }
        chart.add(title, Marks::Dots, points_of);
        let measured = match (below, &over) {
            (Some(below), Some(over)) => {
                let found = measured::points([below.as_str(), name.as_str()], table, points);
                found.into_iter().map(|[x, y]| [over.number(x), shown.number(y)]).collect()
            }
            _ => Vec::new(),
        };
        Some((chart, measured))
    }
}

/// Returns the title of a column without marks of symbols.
fn title(table: &Table, column: usize, system: UnitSystem) -> String {
    table.columns.get(column).map_or_else(String::new, |name| ShownColumn::of(name, system).plain())
}

/// Draws a choice among the columns of a table, after the lines if `lines` is true. Returns the one that was chosen;
/// `Some(None)` for the lines.
fn choice(
    ui: &mut Ui,
    (name, tip): (&str, &str),
    (table, system): (&Table, UnitSystem),
    (text, width): (&str, f32),
    present: Option<Option<usize>>,
    lines: bool,
) -> Option<Option<usize>> {
    let mut chosen = None;
    let combo = ComboBox::from_id_salt(name).selected_text(text).width(width).show_ui(ui, |ui| {
        if lines && ui.selectable_label(present == Some(None), "Line").clicked() {
            chosen = Some(None);
        }
        for column in 0..table.columns.len() {
            if ui.selectable_label(present == Some(Some(column)), title(table, column, system)).clicked() {
                chosen = Some(Some(column));
            }
        }
    });
    named(ui, combo.response, name).on_hover_text(tip);
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::measured_points;

    #[test]
    fn a_column_over_another_has_both_units_and_measured_points() {
        let columns = ["si.speed", "full.h_c_m"];
        let rows = vec![vec![1.0, 50e-9], vec![2.0, 80e-9], vec![4.0, f64::NAN]];
        let table = Table { rows, ..Table::new("load_cases", &columns) };
        let points = measured_points("speed [m/s],film [nm]\n1.5,60\n").unwrap();
        let plotted = |over| PlottedColumn { table: "load_cases".to_owned(), column: 1, over };
        let (chart, measured) = plotted(Some(0)).chart(&table, UnitSystem::Engineering, &points).unwrap();
        assert_eq!((chart.x.label.as_str(), chart.y.label.as_str()), ("u_m [m/s]", "full h_c [µm]"));
        assert_eq!(chart.series.len(), 2, "a line and dots");
        assert!((chart.series[1].points[1][1] / 0.08 - 1.0).abs() < 1e-12);
        assert!(measured.len() == 1 && (measured[0][1] / 0.06 - 1.0).abs() < 1e-12, "{measured:?}");
        let (chart, measured) = plotted(None).chart(&table, UnitSystem::Engineering, &points).unwrap();
        assert_eq!((chart.x.label.as_str(), measured.len()), ("Line", 0));
        assert_eq!(chart.series[1].points.iter().map(|point| point[0]).collect::<Vec<_>>(), [1.0, 2.0]);
        assert!(plotted(Some(7)).chart(&table, UnitSystem::Engineering, &points).is_none());
    }

    #[test]
    fn values_that_go_back_are_not_joined() {
        let rows = vec![vec![1.0, 5.0], vec![3.0, 6.0], vec![2.0, 7.0]];
        let table = Table { rows, ..Table::new("load_cases", &["si.speed", "full.P_c"]) };
        let plotted = PlottedColumn { table: "load_cases".to_owned(), column: 1, over: Some(0) };
        let (chart, _) = plotted.chart(&table, UnitSystem::Si, &[]).unwrap();
        assert_eq!(chart.series.iter().map(|series| series.marks).collect::<Vec<_>>(), [Marks::Dots]);
    }
}
