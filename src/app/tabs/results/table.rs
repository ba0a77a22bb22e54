//! Tables of a study: titles with units, sorting by a column, and names that stay in view.

use super::columns::ShownColumn;
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::scene::Table;
use crate::scene::table::is_whole;
use crate::solver::physics::engineering::UnitSystem;
use egui::{Align, Button, Grid, Id, Label, Rect, ScrollArea, TextStyle, Ui, pos2, vec2};

/// Minimum width of a column.
const COLUMN: f32 = 84.0;
/// Largest width of the column of names.
const NAMES: f32 = 190.0;

/// Column by which a table is sorted, and whether it falls.
type Sorting = Option<(usize, bool)>;

/// Draws a table in the available space. A long table scrolls; a click on a title sorts it.
pub fn ui(ui: &mut Ui, table: &Table, system: UnitSystem) {
    let id = Id::unique(("sorting", &table.name));
    let mut sorting: Sorting = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let order = order(table, sorting);
    let columns: Vec<ShownColumn> = table.columns.iter().map(|name| ShownColumn::of(name, system)).collect();
    let row_height = ui.spacing().interact_size.y - 4.0;
    let names = names_width(ui, table);
    ScrollArea::both().id_salt(("table", &table.name)).auto_shrink([false, false]).show_viewport(ui, |ui, viewport| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let height = row_height + ui.spacing().item_spacing.y;
        ui.set_height(height * (table.rows.len() + 1) as f32);
        let first = ((viewport.top() / height) as usize).min(table.rows.len());
        let last = (first + (viewport.height() / height) as usize + 2).min(table.rows.len());
        let top = ui.max_rect().top() + first as f32 * height;
        let area = ui.max_rect().with_min_y(top);
        let seen = order.get(first..last).unwrap_or_default();
        let rows = || seen.iter().filter_map(|&k| table.rows.get(k));
        let counts: Vec<bool> = (0..columns.len()).map(|column| is_counted(rows(), column)).collect();
        let mut places = Vec::with_capacity(seen.len());
        ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
            let grid = Grid::new(("rows", &table.name)).striped(true).min_col_width(COLUMN).min_row_height(row_height);
            grid.start_row(first).show(ui, |ui| {
                if names > 0.0 {
                    ui.allocate_space(vec2(names, 1.0));
                }
                for (k, column) in columns.iter().enumerate() {
                    if title_ui(ui, column, sorting.filter(|(own, _)| *own == k).map(|(_, falls)| falls)) {
                        sorting = next(sorting, k);
                    }
                }
                for (title, _) in &table.remarks {
                    ui.label(rich(title, 12.0, Palette::of(ui).quiet));
                }
                ui.end_row();
                for &k in seen {
                    if names > 0.0 {
                        places.push((k, ui.allocate_space(vec2(names, row_height)).1));
                    }
                    for ((&value, &counts), column) in table.rows[k].iter().zip(&counts).zip(&columns) {
                        let value = column.number(value);
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
        names_ui(ui, table, (names, viewport), &places);
    });
    ui.data_mut(|data| data.insert_temp(id, sorting));
}

/// Draws a title. Returns true if it was clicked.
fn title_ui(ui: &mut Ui, column: &ShownColumn, falls: Option<bool>) -> bool {
    let mark = falls.map_or("", |falls| if falls { " 9…1" } else { " 1…9" });
    let title = rich(&format!("{}{mark}", column.title), 12.0, Palette::of(ui).quiet);
    let title = ui.add(Button::new(title).frame(false)).on_hover_text("Sorts the lines by this column");
    title.clicked()
}

/// Draws the names over the left edge of the visible part, so that they stay when the table scrolls sideways.
fn names_ui(ui: &mut Ui, table: &Table, (width, viewport): (f32, Rect), places: &[(usize, Rect)]) {
    let left = ui.max_rect().left() + viewport.left();
    for (row, place) in places {
        let place = Rect::from_min_size(pos2(left, place.top()), vec2(width, place.height()));
        if viewport.left() > 0.0 {
            ui.painter().rect_filled(place.expand2(vec2(3.0, 3.0)), 0.0, ui.visuals().panel_fill);
        }
        let name = table.labels.get(*row).map_or("", String::as_str);
        ui.put(place, Label::new(name).truncate().halign(Align::LEFT));
    }
}

/// Returns the width of the column of names; zero if the rows have none.
fn names_width(ui: &Ui, table: &Table) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let width =
        |name: &String| ui.painter().layout_no_wrap(name.clone(), font.clone(), ui.visuals().text_color()).size().x;
    table.labels.iter().map(width).fold(0.0, f32::max).min(NAMES)
}

/// Returns the next sorting after a click: rising, falling, none.
fn next(sorting: Sorting, column: usize) -> Sorting {
    match sorting {
        Some((own, false)) if own == column => Some((column, true)),
        Some((own, true)) if own == column => None,
        _ => Some((column, false)),
    }
}

/// Returns the rows in their order on the screen. Missing values are last.
fn order(table: &Table, sorting: Sorting) -> Vec<usize> {
    let mut order: Vec<usize> = (0..table.rows.len()).collect();
    if let Some((column, falls)) = sorting {
        let key = |row: usize| table.rows[row].get(column).copied().filter(|value| value.is_finite());
        order.sort_by(|a, b| match (key(*a), key(*b)) {
            (Some(a), Some(b)) if falls => b.total_cmp(&a),
            (Some(a), Some(b)) => a.total_cmp(&b),
            (a, b) => b.is_some().cmp(&a.is_some()),
        });
    }
    order
}

/// Returns true if all visible values of a column are whole numbers: lines, steps and other counts.
fn is_counted<'a>(mut seen: impl Iterator<Item = &'a Vec<f64>>, column: usize) -> bool {
    seen.all(|row| row.get(column).is_none_or(|&value| !value.is_finite() || is_whole(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_click_sorts_and_missing_values_are_last() {
        let rows = [[1.0, 3.0], [2.0, f64::NAN], [3.0, 1.0], [4.0, 2.0]].map(|row| row.to_vec()).to_vec();
        let table = Table { rows, ..Table::new("t", &["line", "h_c_m"]) };
        let mut sorting = None;
        let mut orders = Vec::new();
        for _ in 0..3 {
            sorting = next(sorting, 1);
            orders.push(order(&table, sorting));
        }
        assert_eq!(orders, [vec![2, 3, 0, 1], vec![0, 3, 2, 1], vec![0, 1, 2, 3]]);
        assert_eq!(next(Some((1, true)), 0), Some((0, false)));
    }
}
