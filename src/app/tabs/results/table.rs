//! Tables of a study.

use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::scene::Table;
use crate::scene::table::is_whole;
use egui::{Grid, ScrollArea, Ui};

/// Minimum width of a column.
const COLUMN: f32 = 84.0;

/// Draws a table in the available space. A long table scrolls.
pub fn ui(ui: &mut Ui, table: &Table) {
    let quiet = Palette::of(ui).quiet;
    let row_height = ui.spacing().interact_size.y - 4.0;
    ScrollArea::both().id_salt(("table", &table.name)).auto_shrink([false, false]).show_viewport(ui, |ui, viewport| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let height = row_height + ui.spacing().item_spacing.y;
        ui.set_height(height * (table.rows.len() + 1) as f32);
        let first = ((viewport.top() / height) as usize).min(table.rows.len());
        let last = (first + (viewport.height() / height) as usize + 2).min(table.rows.len());
        let top = ui.max_rect().top() + first as f32 * height;
        let area = ui.max_rect().with_min_y(top);
        let seen = table.rows.get(first..last).unwrap_or_default();
        let counts: Vec<bool> = (0..table.columns.len()).map(|column| is_counted(seen, column)).collect();
        ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
            let grid = Grid::new(("rows", &table.name)).striped(true).min_col_width(COLUMN).min_row_height(row_height);
            grid.start_row(first).show(ui, |ui| {
                if !table.labels.is_empty() {
                    ui.label("");
                }
                for column in &table.columns {
                    ui.label(rich(column, 12.0, quiet));
                }
                for (title, _) in &table.remarks {
                    ui.label(rich(title, 12.0, quiet));
                }
                ui.end_row();
                for (k, row) in (first..).zip(seen) {
                    if let Some(label) = table.labels.get(k) {
                        ui.label(label);
                    }
                    for (&value, &counts) in row.iter().zip(&counts) {
                        // Missing values are left empty, as in the file.
                        ui.label(match value.is_finite() {
                            true if counts => numbers::counted(value),
                            true => numbers::significant(value),
                            false => String::new(),
                        });
                    }
                    for remark in table.remarks.iter().filter_map(|(_, texts)| texts.get(k)) {
                        ui.label(remark);
                    }
                    ui.end_row();
                }
            });
        });
    });
}

/// Returns true if all visible values of a column are whole numbers: lines, steps and other counts.
fn is_counted(seen: &[Vec<f64>], column: usize) -> bool {
    seen.iter().filter_map(|row| row.get(column)).filter(|value| value.is_finite()).all(|&value| is_whole(value))
}
