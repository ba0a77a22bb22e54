//! The linearised model: where its operating points lie, which of them carry the present moment, and how many it takes.

use super::table::Sorting;
use super::{dials, export, pictures, plane};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{choice, either_button};
use crate::app::document::Edit;
use crate::app::form::LastField;
use crate::app::tabs::transient::linearised::{Linearised, PointNow};
use crate::app::tabs::transient::method::{WEIGHTINGS, weighting_name};
use crate::app::tabs::transient::{InTimeCommand, Run, TransientView, badge, methods, shared};
use crate::app::tabs::{About, Offer, View};
use crate::app::theme::Palette;
use crate::app::{drawn, numbers};
use crate::engine::job::Standing;
use crate::scene::LinearisedTransient;
use crate::solver::full::transient::Quantity;
use crate::solver::reduced::tpwl::Weighting;
use egui::{Color32, Grid, Pos2, Response, ScrollArea, Ui};
use egui_plot::{PlotPoint, PlotTransform};

/// Width of the settings.
const FORM_WIDTH: f32 = 296.0;
/// Height below which a picture cannot be read.
pub const LEAST_HEIGHT: f32 = 118.0;
/// How near (in screen points) the pointer must be to a point.
const GRAB: f32 = 12.0;

/// What the tab keeps between frames; none of it belongs to the scene.
pub struct Tpwl {
    /// What is drawn along the training trajectory.
    pub(super) quantity: Quantity,
    /// Coordinates of the plane, from 0; the last one is H_0.
    pub(super) coordinates: [usize; 2],
    /// Which training trajectory is drawn.
    pub(super) trajectory: usize,
    /// Whether the other rule's points stand in place of the table.
    pub(super) other: bool,
    sorting: Sorting,
    /// Whether settings are shown.
    form: bool,
    last: LastField,
}

impl Default for Tpwl {
    fn default() -> Self {
        Self {
            quantity: Quantity::CentralFilm,
            coordinates: [0, 1],
            trajectory: 0,
            other: false,
            sorting: Sorting::default(),
            form: false,
            last: None,
        }
    }
}

/// What all pictures of one frame share.
pub struct ShownModel<'a> {
    pub(super) view: &'a TransientView,
    pub(super) tab: &'a Tpwl,
    pub(super) linearised: &'a Linearised,
    /// Its runs.
    pub(super) runs: Vec<(Weighting, &'a Run)>,
    /// Its points at the moment that is looked at.
    pub(super) points: Vec<PointNow>,
    pub(super) palette: Palette,
    pub(super) fit: bool,
}

impl<'a> ShownModel<'a> {
    fn new(palette: Palette, tab: &'a Tpwl, context: &Context<'a>, linearised: &'a Linearised) -> Self {
        let view = context.transient;
        let runs: Vec<_> = view.runs_of(linearised).collect();
        let points = linearised.points_at(&runs, view.player.time());
        Self { view, tab, linearised, runs, points, palette, fit: context.fit }
    }

    /// The operating points of the trajectory that is drawn.
    pub(super) fn of_trajectory(&self) -> impl Iterator<Item = &PointNow> {
        self.points.iter().filter(|now| {
            let trained = self.linearised.model.points.get(now.point);
            trained.is_some_and(|trained| trained.trajectory == self.tab.trajectory)
        })
    }

    /// The colour of a weighting, by its place in [`WEIGHTINGS`].
    pub(super) fn color(&self, weighting: usize) -> Color32 {
        [self.palette.accent, self.palette.warning][weighting]
    }

    /// Whether a weighting, by its place in [`WEIGHTINGS`], was run.
    pub(super) fn was_run(&self, weighting: usize) -> bool {
        self.runs.iter().any(|(own, _)| *own == WEIGHTINGS[weighting])
    }

    /// Whether it is run in this set-up, sooner or later: what has a place for it keeps that.
    pub(super) fn is_run(&self, weighting: usize) -> bool {
        let linearised = self.view.setup.as_ref().and_then(|setup| setup.study.linearised.as_ref());
        linearised.is_some_and(|linearised| linearised.weightings.contains(&WEIGHTINGS[weighting]))
    }
}

impl Tpwl {
    fn form_ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        self.last = shared::edit(ui, ("tpwl", self.last), context, commands, |ui, form, study| {
            methods::linearised_ui(ui, form, study);
            form.message(ui, "Methods");
            methods::trainings_ui(ui, form, study);
        });
        ui.weak("Inputs, duration and steps are those of the Transient tab.");
    }

    /// Lets the study of numbers run by itself, once for each model.
    fn fill_numbers(&self, context: &Context<'_>, commands: &mut Commands) {
        let view = context.transient;
        let Some(linearised) = &view.linearised else { return };
        let compared = view.reference_of_linearised().is_some_and(|full| full.ended) && !view.waits();
        if compared && view.is_current() && view.standing().is_none() && !view.number.is_of(&linearised.model) {
            commands.push(Command::InTime(InTimeCommand::StudyNumber));
        }
    }

    fn results(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
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
            pictures::all(ui, &ShownModel::new(Palette::of(ui), self, context, linearised), &mut sorting, rest)
        });
        self.sorting = sorting;
        commands.extend(pictures.inner.map(|time| Command::InTime(InTimeCommand::GoTo(time))));
    }

    fn buttons(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let view = context.transient;
        ui.horizontal_wrapped(|ui| {
            let tip = "Shows how the linearised model is made, or leaves the room to pictures";
            ui.toggle_value(&mut self.form, "Model set-up").on_hover_text(tip);
            shared::run_button(ui, context, commands);
            let there = view.linearised.is_some();
            let ready = there && view.standing().is_none();
            let tip = "Error of H_c against the number of operating points: both rules on a ladder of tolerances, by both \
                       weightings, along these inputs";
            let runs = view.number.work.standing().is_some();
            let tip = if runs { "What has been found so far stays (Esc)" } else { tip };
            let names = ["Number against error", "Stop the study"];
            let button = ui.add_enabled_ui(runs || ready, |ui| either_button(ui, names, runs)).inner;
            if button.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                if runs {
                    commands.push(Command::InTime(InTimeCommand::StopNumber));
                } else if view.reference_of_linearised().is_some() {
                    commands.push(Command::InTime(InTimeCommand::StudyNumber));
                }
            }
        });
    }

    /// What is drawn: quantity, training, coordinates, and what stands below.
    fn choices(&mut self, ui: &mut Ui, linearised: &Linearised) {
        let modes = linearised.model.space.modes();
        let trainings = linearised.trainings.len();
        self.trajectory = self.trajectory.min(trainings.saturating_sub(1));
        self.coordinates = self.coordinates.map(|k| k.min(modes));
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
                    "What is drawn along the training trajectory",
                    &mut self.quantity,
                    &quantities,
                    name,
                );
            });
            if trainings > 1 {
                let label = ui.label("Training");
                egui::ComboBox::from_id_salt("training shown")
                    .selected_text((self.trajectory + 1).to_string())
                    .width(56.0)
                    .show_ui(ui, |ui| {
                        for k in 0..trainings {
                            ui.selectable_value(&mut self.trajectory, k, (k + 1).to_string());
                        }
                    })
                    .response
                    .labelled_by(label.id);
            }
            for (name, at) in [("Across", 0), ("Up", 1)] {
                let label =
                    ui.label(name).on_hover_text("A reduced coordinate of the plane: a pressure mode’s, or H_0");
                egui::ComboBox::from_id_salt(("coordinate", at))
                    .selected_text(plane::coordinate_name(self.coordinates[at], modes))
                    .width(84.0)
                    .show_ui(ui, |ui| {
                        for k in 0..=modes {
                            ui.selectable_value(&mut self.coordinates[at], k, plane::coordinate_name(k, modes));
                        }
                    })
                    .response
                    .labelled_by(label.id);
            }
            let tip = "All points with their weights and distances at this moment";
            ui.selectable_value(&mut self.other, false, "Table").on_hover_text(tip);
            let tip = "The points that the other rule would choose, as many";
            ui.selectable_value(&mut self.other, true, "Other rule").on_hover_text(tip);
        });
    }
}

const ABOUT: About = About {
    keywords: "linearised operating points weights",
    page: "transient.md",
    has_units: true,
    why: "Near a state that has been seen, the contact answers a small change of load nearly in proportion: its \
          equations can be replaced by their tangents there, d/dT Σ w_i (A_i + B_i y + C_i u) = Σ w_i (D_i + E_i y \
          + F_i u), (4.27), so that a step is one small linear system. The tangents are taken at operating points \
          along a trained trajectory, and the weights w follow the state: drag the time and watch them pass from \
          point to point. Tangents on one side of a curved path err to one side; the dual Taylor form expands half \
          about the points and half about their barycentre, which cancels that, while far from every point, under \
          inputs steeper than the trained ones, no weights help and the reduced model is the right choice.",
};

impl View for Tpwl {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if let Some(why) = context.document.no_transient() {
            shared::elsewhere(ui, context, why, commands);
            return;
        }
        shared::follow(context, commands);
        self.fill_numbers(context, commands);
        ui.horizontal_top(|ui| {
            if self.form {
                ui.vertical(|ui| {
                    ui.set_width(FORM_WIDTH);
                    let area = ScrollArea::vertical().id_salt("tpwl form").auto_shrink(false);
                    area.show(ui, |ui| self.form_ui(ui, context, commands));
                });
                ui.separator();
            }
            shared::over_the_time_bar(ui, "tpwl", context, commands, |ui, commands| {
                self.results(ui, context, commands);
            });
        });
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let context = *context;
        let view = context.transient;
        let there = view.linearised.as_ref();
        type Text = fn(&ShownModel<'_>) -> String;
        let table = |name, tip, text: Text| {
            let shown = move |linearised: &&'a Linearised| {
                // Colours are for the screen only.
                let palette = Palette::for_visuals(&egui::Visuals::light());
                text(&ShownModel::new(palette, self, &context, linearised))
            };
            Offer::table(name, tip, there, shown)
        };
        let points = "All operating points with inputs, state norms, weights and distances at this moment";
        let weights = "Every step’s operating points and weights, and how far it lies from them";
        let whole = "Basis, operating points, linearised systems and the weights of every step, in one archive that numpy \
                     reads";
        let numbers = "Rule, tolerance, number of points, weights and error of every model tried";
        let studied = (!view.number.rows.is_empty()).then_some(view);
        vec![
            table("Points as CSV…", points, export::points),
            table("Weights as CSV…", weights, export::weights),
            Offer::table("Numbers as CSV…", numbers, studied, |view| export::numbers(view)),
            Offer::arrays("Model as npz…", whole, there, move |linearised| export::arrays(view, linearised)),
        ]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        shared::caption(context.transient)
    }

    fn jobs(&self, context: &Context<'_>) -> Vec<Standing> {
        context.transient.number.work.standing().into_iter().collect()
    }
}

/// What to do where there is no linearised model yet.
fn nothing_yet(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let mut study = context.document.transient_study();
    if study.linearised.is_none() {
        ui.weak("This contact in time has no linearised model yet.");
        if ui.button("Linearise this run").on_hover_text("Adds it with its usual settings").clicked() {
            study.linearised = Some(LinearisedTransient::default());
            commands.edit(Edit::Transient(Box::new(study)), dials::NAME);
        }
    } else if !shared::is_coming(context) {
        ui.weak("Run it in time: the full system first, whose trajectory is then linearised and followed.");
    }
}

/// The point whose place on the screen is nearest to the pointer, if it is near.
pub fn near<T>(places: impl Iterator<Item = (T, PlotPoint)>, transform: &PlotTransform, pointer: Pos2) -> Option<T> {
    let distance = |place: &PlotPoint| transform.position_from_point(place).distance(pointer);
    let measured = places.map(|(what, place)| (what, distance(&place)));
    measured.filter(|(_, d)| *d < GRAB).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(what, _)| what)
}

/// What the weights of a point are, for people.
pub fn weights_text(shown: &ShownModel<'_>, now: &PointNow) -> String {
    let each = (0..WEIGHTINGS.len()).filter(|&k| shown.was_run(k));
    let said = each.map(|k| format!("{} {}", weighting_name(WEIGHTINGS[k]).0, numbers::digits(now.weights[k], 3)));
    said.collect::<Vec<_>>().join(", ")
}

/// Says which operating point lies under the pointer; returns the moment to go to when it is clicked.
pub fn point_under(shown: &ShownModel<'_>, response: Response, under: Option<&PointNow>) -> Option<f64> {
    let (now, trained) = under.and_then(|now| Some((now, shown.linearised.model.points.get(now.point)?)))?;
    let clicked = response.clicked();
    response.on_hover_text_at_pointer(format!(
        "Operating point {}, T = {}\nWeights: {}\nA click goes to its moment",
        now.point + 1,
        numbers::significant(trained.moment.time),
        weights_text(shown, now)
    ));
    if clicked { shown.linearised.moment_of(now.point, &shown.runs) } else { None }
}
