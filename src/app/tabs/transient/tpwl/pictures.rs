//! All plots of a linearised model, side by side as far as there is space.

use super::shown::{LEAST_HEIGHT, ShownModel};
use crate::app::tabs::transient::series;
use crate::app::tabs::transient::tpwl::table::{self, Sorting};
use crate::app::tabs::transient::tpwl::{number, plane, trajectory, weights};
use egui::Ui;

/// Widths from which two and three plots are placed side by side.
const SIDE_BY_SIDE: [f32; 2] = [560.0, 840.0];

/// Draws all plots. Returns the time of a click.
pub fn all(ui: &mut Ui, shown: &ShownModel<'_>, sorting: &mut Sorting, rest: f32) -> Option<f64> {
    let width = ui.available_width();
    let columns = 1 + SIDE_BY_SIDE.iter().filter(|least| width >= **least).count();
    let rows = PICTURES.len().div_ceil(columns);
    let height = ((rest / rows as f32) - 6.0).max(LEAST_HEIGHT);
    let mut clicked = None;
    for row in PICTURES.chunks(columns) {
        ui.horizontal_top(|ui| {
            for picture in row {
                ui.vertical(|ui| {
                    ui.set_width((width - 8.0 * (columns - 1) as f32) / columns as f32);
                    ui.set_height(height);
                    clicked = picture.ui(ui, shown, sorting, height).or(clicked);
                });
            }
        });
    }
    clicked
}

/// Plot of a linearised model.
#[derive(Clone, Copy)]
enum Drawn {
    Trajectory,
    Plane,
    Number,
    Error,
    Weights,
    Table,
}

const ERROR_TIP: &str = "Difference of H_c of each method from the full system";

/// Plots in their order.
const PICTURES: [Drawn; 6] =
    [Drawn::Trajectory, Drawn::Plane, Drawn::Number, Drawn::Error, Drawn::Weights, Drawn::Table];

impl Drawn {
    /// Draws the plot. Returns the time of a click.
    fn ui(self, ui: &mut Ui, shown: &ShownModel<'_>, sorting: &mut Sorting, height: f32) -> Option<f64> {
        match self {
            Self::Trajectory => trajectory::chosen(ui, shown, height),
            Self::Plane => plane::ui(ui, shown, height),
            Self::Number => {
                number::ui(ui, shown, height);
                None
            }
            Self::Error => {
                ui.weak("Error, linearised broad, reduced thin").on_hover_text(ERROR_TIP);
                series::deviation(ui, shown.view, height - 22.0)
            }
            Self::Weights => weights::ui(ui, shown, height),
            Self::Table if shown.choices.other => trajectory::not_chosen(ui, shown, height),
            Self::Table => table::ui(ui, shown, sorting, height),
        }
    }
}
