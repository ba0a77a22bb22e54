//! Plots of the modes and of the sampled equations: along ξ, and over the plane for a point contact.

use super::curves::Shown;
use super::field::Field;
use super::plane;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::Palette;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::reduced::{PodBasis, Window};
use egui::{Color32, ComboBox, Ui};
use egui_plot::{Line, MarkerShape, PlotPoint, PlotPoints, Points};

/// Number of modes drawn at once.
const SHOWN_MODES: usize = 4;
/// Height of the row of choices.
const CHOICES: f32 = 30.0;
/// Minimum height of a plot.
const LEAST: f32 = 90.0;
/// Radius of the mark of a sampled equation.
const MARK: f32 = 3.0;
/// Accessible name of the plot.
const SHAPES: &str = "Mode shapes";

/// Draws choices and plots.
pub fn ui(ui: &mut Ui, view: &mut Shown, fit: bool, window: &Window, height: f32) {
    let palette = Palette::of(ui);
    let of_points = window.grid.kind().is_point();
    ui.horizontal(|ui| {
        let label = ui.label("Modes of");
        ComboBox::from_id_salt("field of the modes")
            .selected_text(view.field.name())
            .show_ui(ui, |ui| {
                for field in [Field::Pressure, Field::Deformation] {
                    ui.selectable_value(&mut view.field, field, field.name());
                }
            })
            .response
            .labelled_by(label.id);
        let most = view.field.of(window).modes.ncols().saturating_sub(1);
        view.first_mode = view.first_mode.min(most);
        let label = ui.label("from number");
        let mut number = view.first_mode + 1;
        let drag = egui::DragValue::new(&mut number).range(1..=most + 1).speed(0.1);
        ui.add(drag).labelled_by(label.id);
        view.first_mode = number.clamp(1, most + 1) - 1;
        let rows = window.sampled_rows.len();
        let said = match (of_points, rows == window.grid.unknowns()) {
            (_, true) => format!("all {rows} equations are used"),
            (true, false) => {
                format!("{rows} of {} equations are sampled, the marks in the plane", window.grid.unknowns())
            }
            (false, false) => format!("{rows} sampled equations as marks along ξ"),
        };
        // There is little space next to another tab.
        ui.add(egui::Label::new(egui::RichText::new(said).weak()).truncate());
    });
    let (field, first) = (view.field, view.first_mode);
    let Some(curves) = &mut view.curves else { return };
    let last = (first + SHOWN_MODES).min(field.of(window).modes.ncols());
    for k in first..last {
        if !curves.modes.iter().any(|m| m.0 == field && m.1 == k) {
            let points = mode_points(field.of(window), &window.grid, k);
            curves.modes.push((field, k, points));
        }
    }
    let shown: Vec<_> = curves.modes.iter().filter(|m| m.0 == field && (first..last).contains(&m.1)).collect();
    let height = (height - CHOICES).max(LEAST);
    let color = field.color(&palette);
    let Some(grid) = window.grid.point() else {
        shapes(ui, &shown, first, color, (height, fit), Some((&curves.rows, palette.accent)));
        return;
    };
    ui.horizontal(|ui| {
        let half = 0.5 * ui.available_width() - 6.0;
        ui.vertical(|ui| {
            ui.set_width(half);
            // Marks of all equations would hide the mode.
            let sampled = curves.rows.len() < grid.unknowns();
            let rows = if sampled { curves.rows.as_slice() } else { &[] };
            curves.plane.ui(ui, (grid, field.of(window)), (field, first), rows, (height, fit));
        });
        ui.vertical(|ui| {
            ui.set_width(half);
            shapes(ui, &shown, first, color, (height, fit), None);
        });
    });
}

/// Draws modes along ξ, the first one in the strongest colour, with marks of the sampled equations of a line
/// contact.
fn shapes(
    ui: &mut Ui,
    shown: &[&(Field, usize, Vec<PlotPoint>)],
    first: usize,
    color: Color32,
    (height, fit): (f32, bool),
    rows: Option<(&[PlotPoint], Color32)>,
) {
    let (x_title, id) = match rows {
        Some(_) => ("Reference coordinate {ξ}", "modes"),
        None => ("{X} = {x}/{a}, on the axis {Y} = 0", "modes on the axis"),
    };
    let look = |k: usize| (color.gamma_multiply(1.0 - 0.24 * (k - first) as f32), if k == first { 2.2 } else { 1.3 });
    let modes = shown.iter().map(|(_, k, _)| {
        let (color, width) = look(*k);
        Entry::new(format!("mode {}", k + 1), color, Sample::Line(width))
    });
    let marks = rows.map(|(_, color)| Entry::new("sampled equations", color, Sample::Up(MARK)));
    let entries: Vec<Entry> = modes.chain(marks).collect();
    key::over(ui, height, entries, |ui, height| {
        let plot = axes::plot(ui, id, height, x_title, "Mode, scaled to 1").default_x_bounds(-2.2, 1.6);
        axes::show(plot, ui, SHAPES, |plot| {
            axes::fit(plot, fit);
            for (_, k, points) in shown {
                let (color, width) = look(*k);
                let line = Line::new(format!("Mode {}", k + 1), PlotPoints::Borrowed(points));
                plot.line(line.color(color).width(width));
            }
            if let Some((rows, color)) = rows {
                let marks = Points::new("Sampled equations", PlotPoints::Borrowed(rows));
                plot.points(marks.color(color).radius(MARK).shape(MarkerShape::Up));
            }
        });
    });
}

/// Returns one mode along the axis Y = 0, scaled to a maximum magnitude of one. The columns themselves contain
/// weights and are hard to compare.
fn mode_points(basis: &PodBasis, grid: &ContactGrid, k: usize) -> Vec<PlotPoint> {
    let points = plane::scaled(basis, k).into_iter().enumerate().map(|(node, v)| (grid.place(node), v));
    points.filter(|((_, y), _)| *y == 0.0).skip(grid.first_column()).map(|((xi, _), v)| PlotPoint::new(xi, v)).collect()
}
