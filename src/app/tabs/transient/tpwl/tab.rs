//! TPWL tab: operating points of the linearised model, their weights at the displayed time, and the necessary
//! number of points.

use super::shown::{Choices, ShownModel};
use super::table::Sorting;
use super::{dials, export, pictures, plane};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{choice, either_button};
use crate::app::document::Edit;
use crate::app::drawn;
use crate::app::form::LastField;
use crate::app::tabs::transient::linearised::Linearised;
use crate::app::tabs::transient::{TransientCommand, badge, methods, shared};
use crate::app::tabs::{About, Offer, View};
use crate::app::theme::Palette;
use crate::engine::job::Standing;
use crate::scene::{LinearisedTransient, ReducedTransient};
use crate::solver::full::transient::Quantity;

use egui::{Grid, Ui};

/// Width of the settings.
const FORM_WIDTH: f32 = 296.0;
/// State of the tab between frames. It is not part of the scene.
#[derive(Default)]
pub struct Tpwl {
    choices: Choices,
    sorting: Sorting,
    /// True if the settings are shown.
    form: bool,
    last: LastField,
}

impl Tpwl {
    fn form_ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let kind = context.document.point.kind;
        self.last = shared::edit(ui, ("tpwl", self.last), context, commands, |ui, form, study| {
            methods::linearised_ui(ui, form, study, kind);
            form.message(ui, "Methods");
            methods::trainings_ui(ui, form, study, kind);
        });
        ui.weak("Inputs, duration and steps are those of the Transient tab.");
    }

    /// Starts the study of the number of points automatically, once for each model.
    fn fill_numbers(&self, context: &Context<'_>, commands: &mut Commands) {
        let view = context.transient;
        let Some(linearised) = &view.linearised else { return };
        let compared = view.reference_of_linearised().is_some_and(|full| full.ended) && !view.waits();
        if compared && view.is_current() && view.standing().is_none() && !view.number.is_of(&linearised.model) {
            commands.push(Command::Transient(TransientCommand::StudyNumber));
        }
    }

    fn results(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        self.fill_numbers(context, commands);
        let (top, height) = (ui.cursor().top(), ui.available_height());
        self.buttons(ui, context, commands);
        ui.horizontal_wrapped(|ui| {
            dials::ui(ui, context, commands);
            badge::ui(ui, context);
        });
        let refused = context.entries.message(dials::NAME).filter(|_| !self.form);
        let failed = context.transient.number.work.message.as_deref();
        shared::status(ui, context, refused.into_iter().chain(failed));
        let Some(linearised) = &context.transient.linearised else {
            nothing_yet(ui, context, commands);
            return;
        };
        self.choices(ui, linearised);
        dials::inputs_ui(ui, context);
        let rest = height - (ui.cursor().top() - top) - 6.0;
        let mut sorting = self.sorting;
        let pictures = ui.scope(|ui| {
            shared::grey_where_stale(ui, context, "linearised model");
            if context.transient.is_current() && context.transient.runs_of(linearised).next().is_none() {
                drawn::fade(ui, shared::is_coming(context));
            }
            pictures::all(ui, &ShownModel::new(Palette::of(ui), &self.choices, context, linearised), &mut sorting, rest)
        });
        self.sorting = sorting;
        commands.extend(pictures.inner.map(|time| Command::Transient(TransientCommand::GoTo(time))));
    }

    fn buttons(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let view = context.transient;
        ui.horizontal_wrapped(|ui| {
            let tip = "Shows or hides the settings of the linearised model";
            ui.toggle_value(&mut self.form, "Model set-up").on_hover_text(tip);
            shared::run_button(ui, context, commands);
            let there = view.linearised.is_some();
            let ready = there && view.standing().is_none();
            let tip = "Error of H_c against the number of operating points: both rules with a sequence of tolerances \
                       and both weightings, for these inputs";
            let runs = view.number.work.standing().is_some();
            let tip = if runs { "Keeps the results so far (Esc)" } else { tip };
            let names = ["Error vs. number of points", "Stop the study"];
            let button = ui.add_enabled_ui(runs || ready, |ui| either_button(ui, names, runs)).inner;
            if button.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                if runs {
                    commands.push(Command::Transient(TransientCommand::StopNumber));
                } else if view.reference_of_linearised().is_some() {
                    commands.push(Command::Transient(TransientCommand::StudyNumber));
                }
            }
        });
    }

    /// Draws the choices of the plots: quantity, training, coordinates, and the content of the last plot.
    fn choices(&mut self, ui: &mut Ui, linearised: &Linearised) {
        let modes = linearised.model.space.modes();
        let trainings = linearised.trainings.len();
        self.choices.trajectory = self.choices.trajectory.min(trainings.saturating_sub(1));
        self.choices.coordinates = self.choices.coordinates.map(|k| k.min(modes));
        ui.horizontal_wrapped(|ui| {
            let combo = |ui: &mut Ui, content: &mut dyn FnMut(&mut Ui)| {
                Grid::new(ui.next_auto_id()).spacing([6.0, 0.0]).min_col_width(0.0).show(ui, |ui| content(ui));
            };
            combo(ui, &mut |ui| {
                let quantities = [Quantity::CentralFilm, Quantity::CentralPressure];
                let name = |quantity| match quantity {
                    Quantity::CentralPressure => ("Central pressure", "P_c of the full system"),
                    _ => ("Central film", "H_c of the full system"),
                };
                choice(
                    ui,
                    "Along",
                    "Quantity along the training trajectory",
                    &mut self.choices.quantity,
                    &quantities,
                    name,
                );
            });
            if trainings > 1 {
                let label = ui.label("Training");
                egui::ComboBox::from_id_salt("training shown")
                    .selected_text((self.choices.trajectory + 1).to_string())
                    .width(56.0)
                    .show_ui(ui, |ui| {
                        for k in 0..trainings {
                            ui.selectable_value(&mut self.choices.trajectory, k, (k + 1).to_string());
                        }
                    })
                    .response
                    .labelled_by(label.id);
            }
            for (name, at) in [("Across", 0), ("Up", 1)] {
                let label =
                    ui.label(name).on_hover_text("A reduced coordinate of the plane: a pressure mode’s, or H_0");
                egui::ComboBox::from_id_salt(("coordinate", at))
                    .selected_text(plane::coordinate_name(self.choices.coordinates[at], modes))
                    .width(84.0)
                    .show_ui(ui, |ui| {
                        for k in 0..=modes {
                            ui.selectable_value(&mut self.choices.coordinates[at], k, plane::coordinate_name(k, modes));
                        }
                    })
                    .response
                    .labelled_by(label.id);
            }
            let tip = "All points with their weights and distances at the displayed time";
            ui.selectable_value(&mut self.choices.other, false, "Table").on_hover_text(tip);
            let tip = "The same number of points, chosen by the other rule";
            ui.selectable_value(&mut self.choices.other, true, "Other rule").on_hover_text(tip);
        });
    }
}

const ABOUT: About = About {
    keywords: "linearised operating points weights trajectory piecewise linear",
    page: "transient.md",
    has_units: true,
    why: "Near a trained state the response of the contact to a small change of load is nearly linear: its equations \
          can be replaced by their tangents, d/dT Σ w_i (A_i + B_i y + C_i u) = Σ w_i (D_i + E_i y + F_i u), (4.27), \
          so that a step is one small linear system. The tangents are taken at operating points along a trained \
          trajectory, and the weights w follow the state: drag the time to see them pass from point to point. Tangents \
          on one side of a curved path have a systematic error; the dual Taylor form expands half about the points and \
          half about their barycentre, which cancels it, while far from every point, with inputs steeper than trained, \
          no weights are sufficient.",
};

impl View for Tpwl {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let page = ("tpwl", self.form.then_some(FORM_WIDTH), context.document.no_linearised());
        let form = |tab: &mut Self, ui: &mut Ui, commands: &mut Commands| tab.form_ui(ui, context, commands);
        shared::page(ui, self, page, (context, commands), form, |tab, ui, commands| tab.results(ui, context, commands));
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let context = *context;
        let view = context.transient;
        let there = view.linearised.as_ref();
        type Text = fn(&ShownModel<'_>) -> String;
        let table = |name, tip, text: Text| {
            let shown = move |linearised: &&'a Linearised| {
                // The export contains no colours.
                let palette = Palette::for_visuals(&egui::Visuals::light());
                text(&ShownModel::new(palette, &self.choices, &context, linearised))
            };
            Offer::table(name, tip, there, shown)
        };
        let points = "All operating points with inputs, state norms, weights and distances at the displayed time";
        let weights = "Operating points and weights of every step, and its distance from them";
        let whole = "Basis, operating points, linearised systems and the weights of every step, in one archive that numpy \
                     reads";
        let numbers = "Rule, tolerance, number of points, weights and error of every tested model";
        let studied = (!view.number.rows.is_empty()).then_some(view);
        vec![
            table("Points as CSV…", points, export::points),
            table("Weights as CSV…", weights, export::weights),
            Offer::table("Numbers as CSV…", numbers, studied, |view| export::numbers(view)),
            Offer::arrays("Model as npz…", whole, there, move |linearised| export::arrays(view, linearised)),
        ]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        shared::caption(context.transient, context.system)
    }

    fn jobs(&self, context: &Context<'_>) -> Vec<Standing> {
        context.transient.number.work.standing().into_iter().collect()
    }
}

/// Draws what to do if there is no linearised model yet.
fn nothing_yet(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let mut study = context.document.transient_study();
    if study.linearised.is_none() {
        ui.weak("This transient contact has no linearised model yet.");
        if ui.button("Linearise this run").on_hover_text("Adds it with its usual settings").clicked() {
            let kind = context.document.point.kind;
            study.linearised = Some(LinearisedTransient::usual(kind));
            if kind.is_point() {
                study.reduced.get_or_insert_with(ReducedTransient::embedded);
            }
            commands.edit(Edit::Transient(Box::new(study)), dials::NAME);
        }
    } else if !shared::is_coming(context) {
        ui.weak(if context.document.point.kind.is_line() {
            "Press Run transient. The full system runs first, and its trajectory is then linearised and followed."
        } else {
            "Press Run transient. The full system runs first; then a sweep of loads and speeds is linearised."
        });
    }
}
