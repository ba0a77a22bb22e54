//! Reduced basis tab: decay of the singular values, effect of the tolerances, shapes of the modes, sampled
//! equations.

use super::curves::{Curves, Shown};
use super::field::TRUNCATION;
use super::given_modes::GivenModes;
use super::in_time::InTime;
use super::losses::{loss_plot, singular_plot};
use super::{modes, sizes};
use crate::app::context::{Commands, Context};
use crate::app::document::Edit;
use crate::app::drawn::{self, Owner};
use crate::app::in_use::InUse;
use crate::app::tabs::{About, Offer, View, profiles};
use crate::app::{badge, export, numbers};
use crate::engine::job::Standing;
use crate::engine::model_arrays;

use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{PodBasis, ReducedModel, Scheme, Window};
use egui::Ui;

use std::sync::Arc;

/// Content below the losses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
enum Below {
    /// Shapes of the modes and sampled equations.
    #[default]
    Modes,
    /// Error and time against their numbers.
    Sizes,
    /// Pressure of the contact, and its difference to the full solution.
    Difference,
}

impl Below {
    const ALL: [(Self, &str); 3] = [
        (Self::Modes, "Modes and equations"),
        (Self::Sizes, "Error and time"),
        (Self::Difference, "Profile and difference"),
    ];
}

/// State of the tab, with the curves of one local model.
#[derive(Default)]
pub struct Basis {
    below: Below,
    sizes: sizes::Sizes,
    shown: Shown,
    given: GivenModes,
    in_time: InTime,
}

impl Basis {
    /// Shows the bases of a transient model that was opened.
    pub fn open_in_time(&mut self, model: Arc<TrajectoryModel>) {
        self.in_time.open(model);
    }
}

const ABOUT: About = About {
    keywords: "singular values modes truncation sampled equations rows hyper-reduction",
    page: "training.md",
    has_units: true,
    why: "The pressures of all contacts of a range are similar, so that a few dozen shapes, the modes, represent each \
          of them. The decay of the singular values shows how many modes a chosen error needs. The reduced model then \
          evaluates only some of the equations, the sampled equations, most of which lie at the inlet and at the \
          spike.",
};

impl View for Basis {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let in_time = self.in_time.model(context);
        // The row is there also without a transient model, so that nothing moves when a run gets one.
        ui.horizontal(|ui| {
            let chosen = self.in_time.chosen && in_time.is_some();
            let tip = "Reduced model of the contact on the left";
            if ui.selectable_label(!chosen, "Model of the contact").on_hover_text(tip).clicked() {
                self.in_time.chosen = false;
            }
            let tip = "Transient reduced model: the one that was opened, or that of the run on the screen";
            let label = egui::Button::selectable(chosen, "Transient model");
            let none = "Open a transient model, or run one in Transient";
            if ui.add_enabled(in_time.is_some(), label).on_hover_text(tip).on_disabled_hover_text(none).clicked() {
                self.in_time.chosen = true;
            }
        });
        if let Some(model) = in_time.filter(|_| self.in_time.chosen) {
            self.in_time.ui(ui, &model, context.fit);
            return;
        }
        let Some(model) = context.answers.model(context.document).cloned() else {
            ui.centered_and_justified(|ui| {
                ui.weak(
                    "No reduced model is loaded, so there is no basis to show. The full solver draws every picture.",
                )
            });
            return;
        };
        let at = model.window_for(&context.document.point);
        let Some(window) = model.windows.get(at) else { return };
        if self.shown.curves.as_ref().is_none_or(|c| !c.is_of(&model, at)) {
            self.shown.curves = Some(Curves::new(Some(&model), at, window));
        }
        if let Some(model) = self.shown.curves.as_ref().and_then(|curves| curves.model.as_ref()) {
            let of = Owner::Model(InUse::new(model, &context.document.view));
            drawn::note(ui.ctx(), "basis", of, false);
        }
        toolbar(ui, context, commands, &model, (at, window));
        let height = ui.available_height();
        let upper = 0.48 * height;
        if ui.available_width() > 640.0 {
            let half = 0.5 * ui.available_width() - 6.0;
            ui.horizontal(|ui| {
                ui.vertical(|ui| {
                    ui.set_width(half);
                    loss_plot(ui, &mut self.shown, context, commands, window, upper);
                });
                ui.vertical(|ui| {
                    ui.set_width(half);
                    singular_plot(ui, &self.shown, context.fit, upper);
                });
            });
        } else {
            loss_plot(ui, &mut self.shown, context, commands, window, upper);
        }
        ui.horizontal_wrapped(|ui| {
            for (below, name) in Below::ALL {
                ui.selectable_value(&mut self.below, below, name);
            }
        });
        match self.below {
            Below::Modes => {
                let window = match model.is_outline() {
                    true => self.given.of(ui, context.answers.store(), &model, at),
                    false => Some(window),
                };
                if let Some(window) = window {
                    modes::ui(ui, &mut self.shown, context.fit, window, (ui.available_height() - 4.0).max(120.0));
                }
            }
            Below::Sizes => sizes::ui(ui, &mut self.sizes, context, commands, (&model, at, window)),
            Below::Difference => profiles::with_difference(ui, context),
        }
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let model = context.answers.model(context.document);
        let window = model.and_then(|model| model.windows.get(model.window_for(&context.document.point)));
        let tip = "Singular values and loss of information";
        let whole =
            "Bases, singular values, sampled equations and snapshots of every local model, in one archive for numpy";
        vec![
            Offer::table("Singular values as CSV…", tip, window, |window| csv(window)),
            Offer::arrays("Model as npz…", whole, model, |model| {
                context.answers.store().whole(model).map_or_else(|_| Vec::new(), |model| model_arrays::of_model(&model))
            }),
        ]
    }

    fn receive(&mut self) {
        self.sizes.receive();
        self.given.receive();
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        self.sizes.standing().into_iter().collect()
    }

    fn stop(&mut self) {
        self.sizes.stop();
    }
}

fn toolbar(
    ui: &mut Ui,
    context: &Context<'_>,
    commands: &mut Commands,
    model: &ReducedModel,
    (at, window): (usize, &Window),
) {
    let options = context.answers.options(context.document);
    let view = &context.document.view;
    badge::ui(ui, context);
    ui.horizontal_wrapped(|ui| {
        ui.label(format!(
            "Local model {} of {}, M {}…{}, {} of {} modes",
            at + 1,
            model.windows.len(),
            numbers::digits(window.m.0, 3),
            numbers::digits(window.m.1, 3),
            options.pressure_modes.unwrap_or(window.pressure.count()),
            window.pressure.count()
        ));
        ui.weak(format!("Cavitation: {}", model.domain.lubricant.cavitation.name()));
        if window.scheme != Scheme::Galerkin {
            ui.weak(format!("Steps by {}", window.scheme.name()));
        }
        let truncated = view.pressure_loss.is_some() || view.deformation_loss.is_some();
        if ui.add_enabled(truncated, egui::Button::new("Keep all modes")).clicked() {
            commands.edit(
                Edit::View(crate::scene::View { pressure_loss: None, deformation_loss: None, ..view.clone() }.into()),
                TRUNCATION,
            );
        }
    });
}

fn csv(window: &Window) -> String {
    let count = window.pressure.singular_values().len().max(window.deformation.singular_values.len());
    let row = |k: usize| {
        let of = |basis: &PodBasis| {
            let value = basis.singular_values.get(k).copied();
            [value, value.map(|_| basis.loss(k + 1))]
        };
        let mut row = vec![Some(k as f64 + 1.0)];
        row.extend(of(window.pressure.basis()));
        row.extend(of(&window.deformation));
        row
    };
    let header = ["mode", "sigma_pressure", "loss_pressure", "sigma_deformation", "loss_deformation"];
    let comment = format!("window M {:e} to {:e}", window.m.0, window.m.1);
    export::csv(&[comment], &header, (0..count).map(row))
}
