//! Table of the operating points of a linearised model (TPWL, trajectory piecewise linear). For each point it lists the
//! number, the time T, the weights and the distance from the present state. A click on a column title sorts the table,
//! and a click on the number of a point moves to its time.

use super::shown::ShownModel;
use crate::app::controls::named;
use crate::app::numbers;
use crate::app::tabs::transient::linearised::PointNow;
use crate::app::tabs::transient::method::{WEIGHTINGS, weighting_name};
use crate::app::theme::rich;
use crate::solver::reduced::tpwl::Weighting;
use egui::{Button, Grid, ScrollArea, Ui};

/// Column of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Column {
    /// Number of the point, from 1.
    Point,
    /// Time T of the point on its training trajectory.
    Time,
    /// Weight by one weighting, given by its index in [`WEIGHTINGS`].
    Weight(usize),
    /// Relative distance of the point from the state at the displayed time.
    #[default]
    Distance,
}

/// Order of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sorting {
    /// Column by which the table is sorted.
    by: Column,
    /// True to reverse the order. By default weights descend and all other columns ascend.
    reversed: bool,
}

impl Sorting {
    /// Sorts pairs of a point and its time. Among equal values, the nearer point comes first unless the order
    /// is reversed.
    fn sort(self, points: &mut [(PointNow, f64)]) {
        let key = |(now, time): &(PointNow, f64)| match self.by {
            Column::Point => now.point as f64,
            Column::Time => *time,
            Column::Weight(k) => -now.weights[k],
            Column::Distance => now.distance,
        };
        let nearer = |a: &(PointNow, f64), b: &(PointNow, f64)| a.0.distance.total_cmp(&b.0.distance);
        points.sort_by(|a, b| key(a).total_cmp(&key(b)).then_with(|| nearer(a, b)));
        if self.reversed {
            points.reverse();
        }
    }

    /// Sorts by a column. A second click on the same column reverses the order.
    fn click(&mut self, column: Column) {
        *self = Self { by: column, reversed: self.by == column && !self.reversed };
    }
}

/// Draws the table with the given height in screen points. Returns the time to move to if the user clicked on a point.
pub fn ui(ui: &mut Ui, shown: &ShownModel<'_>, sorting: &mut Sorting, height: f32) -> Option<f64> {
    let model = &shown.linearised.model;
    let with_time = |now: &PointNow| Some((*now, model.points.get(now.point)?.moment.time));
    let mut rows: Vec<(PointNow, f64)> = shown.points.iter().filter_map(with_time).collect();
    sorting.sort(&mut rows);
    let several = shown.linearised.trainings.len() > 1;
    let mut columns = vec![(Column::Point, "Point"), (Column::Time, "{T}")];
    for (k, &weighting) in WEIGHTINGS.iter().enumerate().filter(|(k, _)| shown.is_run(*k)) {
        columns
            .push((Column::Weight(k), if weighting == Weighting::DualTaylor { "Dual Taylor" } else { "Exponential" }));
    }
    columns.push((Column::Distance, "Distance"));
    let count = columns.len() + usize::from(several);
    let width = ((ui.available_width() - 16.0) / count as f32 - 6.0).clamp(40.0, 110.0);
    let grid =
        |id: &'static str| Grid::new(id).striped(true).min_col_width(width).max_col_width(width).spacing([6.0, 3.0]);
    let quiet = shown.palette.quiet;
    grid("tpwl heads").striped(false).show(ui, |ui| {
        for (column, name) in &columns {
            let color = if sorting.by == *column { shown.palette.accent } else { quiet };
            let tip = match column {
                Column::Point => "Number of the point, in the order of trajectories and time",
                Column::Time => "Time on its training trajectory",
                Column::Weight(k) => weighting_name(WEIGHTINGS[*k]).1,
                Column::Distance => "|y − y_i|/|y| of the state at the displayed time",
            };
            let head = ui.add(Button::new(rich(name, 12.0, color)).frame(false));
            let plain = name.replace(['{', '}'], "");
            if named(ui, head, &format!("Sort by {plain}")).on_hover_text(tip).clicked() {
                sorting.click(*column);
            }
        }
        if several {
            ui.label(rich("Training", 12.0, quiet));
        }
        ui.end_row();
    });
    let mut wanted = None;
    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
    let row_height = ui.spacing().interact_size.y.max(18.0);
    let area = ScrollArea::vertical().id_salt("tpwl points").auto_shrink(false).max_height(height - 24.0);
    area.show_rows(ui, row_height - 4.0, rows.len(), |ui, range| {
        grid("tpwl rows").start_row(range.start).show(ui, |ui| {
            for (now, time) in rows.get(range).unwrap_or(&[]) {
                let link = ui.link((now.point + 1).to_string()).on_hover_text("Go to its time");
                if named(ui, link, &format!("Go to operating point {}", now.point + 1)).clicked() {
                    wanted = shown.linearised.moment_of(now.point, &shown.runs);
                }
                ui.label(numbers::significant(*time));
                for k in (0..WEIGHTINGS.len()).filter(|&k| shown.is_run(k)) {
                    let weight = now.weights[k];
                    if weight > 0.0 {
                        ui.label(numbers::digits(weight, 3));
                    } else {
                        ui.weak("0");
                    }
                }
                ui.label(numbers::digits(now.distance, 3));
                if several {
                    let training = model.points.get(now.point).map_or(0, |point| point.trajectory + 1);
                    ui.label(training.to_string());
                }
                ui.end_row();
            }
        });
    });
    wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_sorted_by_any_column_and_back() {
        let now = |point: usize, weight: f64, distance: f64| {
            (PointNow { point, weights: [weight, 0.0], distance }, 10.0 - point as f64)
        };
        let mut rows = [now(0, 0.0, 0.3), now(1, 0.7, 0.1), now(2, 0.3, 0.2), now(3, 0.0, 0.25)];
        let mut order = |sorting: Sorting| {
            sorting.sort(&mut rows);
            rows.map(|(now, _)| now.point)
        };
        let mut sorting = Sorting::default();
        assert_eq!(order(sorting), [1, 2, 3, 0]);
        sorting.click(Column::Weight(0));
        assert_eq!(order(sorting), [1, 2, 3, 0], "the heaviest first, then the nearer");
        sorting.click(Column::Time);
        assert_eq!(order(sorting), [3, 2, 1, 0]);
        sorting.click(Column::Time);
        assert_eq!(order(sorting), [0, 1, 2, 3]);
        sorting.click(Column::Point);
        assert_eq!(order(sorting), [0, 1, 2, 3]);
    }
}
