//! Part of the Basis tab for transient reduced models. It draws the singular values, the modes and the sampled
//! equations of one basis: the whole basis, or the local basis of a cluster of states. The model was opened from a
//! file, or it belongs to the transient run on the screen.

use super::curves::{Curves, Shown};
use super::losses::singular_plot;
use super::modes;
use crate::app::context::Context;
use crate::app::controls::named;
use crate::solver::reduced::Window;
use crate::solver::reduced::transient::TrajectoryModel;
use egui::{ComboBox, Ui};
use std::sync::Arc;

/// View of the bases of a transient reduced model.
#[derive(Default)]
pub struct InTime {
    /// Model that was opened from a file. It takes precedence over the model of the run.
    opened: Option<Arc<TrajectoryModel>>,
    /// True if the tab shows the transient model instead of the model of the steady contact.
    pub chosen: bool,
    /// Selected basis: 0 for the whole basis, k + 1 for that of cluster k.
    number: usize,
    /// Model and number of the basis from which the curves were computed.
    drawn: Option<(Arc<TrajectoryModel>, usize)>,
    /// Curves and settings of their display.
    shown: Shown,
}

impl InTime {
    /// Shows a model that was opened from a file.
    pub fn open(&mut self, model: Arc<TrajectoryModel>) {
        (self.opened, self.chosen, self.number) = (Some(model), true, 0);
    }

    /// Returns the opened model, or else that of the transient run on the screen. `None` if there is neither.
    pub fn model(&self, context: &Context<'_>) -> Option<Arc<TrajectoryModel>> {
        let of_run = || context.transient.runs.iter().find_map(|run| run.reduced.clone());
        self.opened.clone().or_else(of_run)
    }

    /// Draws the selected basis. `fit` fits the plots to their data.
    pub fn ui(&mut self, ui: &mut Ui, model: &Arc<TrajectoryModel>, fit: bool) {
        self.number = self.number.min(model.locals.len());
        let window = basis(model, self.number);
        self.toolbar(ui, model, window);
        let same = |(of, number): &(Arc<TrajectoryModel>, usize)| Arc::ptr_eq(of, model) && *number == self.number;
        if !self.drawn.as_ref().is_some_and(same) {
            self.shown.curves = Some(Curves::new(None, self.number, window));
            self.drawn = Some((Arc::clone(model), self.number));
        }
        let height = ui.available_height();
        singular_plot(ui, &self.shown, fit, 0.42 * height);
        modes::ui(ui, &mut self.shown, fit, window, (ui.available_height() - 4.0).max(120.0));
    }

    /// Draws the title, the choice of the basis, and the numbers of modes, sampled equations and trajectories.
    fn toolbar(&mut self, ui: &mut Ui, model: &TrajectoryModel, window: &Window) {
        ui.horizontal_wrapped(|ui| {
            let title = if model.title.is_empty() { "Model of the run" } else { &model.title };
            ui.label(title);
            if !model.locals.is_empty() {
                let name = |number: usize| match number {
                    0 => "Whole basis".to_owned(),
                    number => format!("Cluster {number} of {}", model.locals.len()),
                };
                let combo = ComboBox::from_id_salt("cluster").selected_text(name(self.number)).show_ui(ui, |ui| {
                    for number in 0..=model.locals.len() {
                        ui.selectable_value(&mut self.number, number, name(number));
                    }
                });
                let tip = "A step uses the basis of the cluster whose centre is nearest to its state";
                named(ui, combo.response, "Basis of the transient model").on_hover_text(tip);
            }
            ui.weak(format!(
                "{} pressure modes, {} deformation modes, {} sampled equations; {} training trajectories",
                window.pressure.count(),
                window.deformation.modes.ncols(),
                window.sampled_rows.len(),
                model.starts.len()
            ));
        });
    }
}

/// Returns the basis with a number, see [`InTime::number`]. An invalid number gives the whole basis.
fn basis(model: &TrajectoryModel, number: usize) -> &Window {
    let local = number.checked_sub(1).and_then(|local| model.locals.get(local));
    local.map_or(&model.window, |local| &local.window)
}
