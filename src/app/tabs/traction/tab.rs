//! Traction tab: traction and film thickness along one quantity, live by the reduced model, and the laws of the
//! fluid.

use super::axes::NEAR_SRR;
use super::chart;
use super::fluid;
use super::sweeps::edit_along;
use crate::app::answers::Answers;
use crate::app::caption;
use crate::app::document::Document;
use crate::app::refusal::Refusal;
use crate::engine::job::Standing;

use super::sweeps::{Choices, Markers, SlideView, Sweeps};
use crate::app::answers::REST_S;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, sentence, standing_ui, warning_ui, why};
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::tabs::traction::{Against, Curve, Sample, Served, Sweep, Varied, export, sweep};
use crate::app::tabs::{About, Offer, View, view};
use crate::app::theme::{Palette, rich};
use crate::solver::full::{PLAUSIBLE_TRACTION, Solution, TractionDoubt};
use crate::solver::physics::contact::ContactKind;
use egui::{Align, Button, Checkbox, ComboBox, Layout, ScrollArea, TextStyle, Ui, vec2};
use std::sync::Arc;

/// Traction tab with its settings, its curves, and the maximum shear stress of a solution.
#[derive(Default)]
pub struct Traction {
    /// Settings of the plots.
    pub choices: Choices,
    /// Curve and full solutions.
    pub sweeps: Sweeps,
    stress_met: Option<(Arc<Solution>, f64)>,
}

const ABOUT: About = About {
    keywords: "friction coefficient Stribeck lambda power loss slide-to-roll fluid viscosity flow curve Eyring",
    page: "physics.md",
    has_units: false,
    why: "Sliding surfaces shear the film, and the shear stress integrated over the contact is the traction. High \
          pressure raises the viscosity so much that a Newtonian film would carry more stress than any lubricant can; \
          above the Eyring stress the curve bends, and at the limiting stress it levels off. If neither stress is \
          given, the result is Newtonian and unphysical at high pressure.",
};

impl View for Traction {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let choices = &mut self.choices;
        // A presentation shows only the curves.
        if !context.presenting {
            ui.horizontal_wrapped(|ui| {
                ui.selectable_value(&mut choices.shows_fluid, false, "Traction and film");
                ui.selectable_value(&mut choices.shows_fluid, true, "Laws of the fluid");
            });
            ui.separator();
        }
        if context.why && choices.shows_fluid {
            why(ui, WHY_FLUID);
        }
        if choices.shows_fluid {
            fluid::ui(ui, &mut self.stress_met, context);
            return;
        }
        let Some((sweep, served)) = sweep(context.document, context.answers, choices) else {
            toolbar(ui, (choices, &self.sweeps), context, commands, false);
            ui.centered_and_justified(|ui| ui.weak(choices.against.why_none()));
            return;
        };
        if let Ok(served) = &served {
            self.sweeps.follow(ui.ctx(), context.answers.store(), sweep.clone(), served.clone());
        }
        fill(ui, &mut self.sweeps, context, choices, (&sweep, &served));
        toolbar(ui, (choices, &self.sweeps), context, commands, true);
        if !context.presenting {
            status(ui, context, &self.sweeps, (&sweep, choices), &served);
        }
        let shown = ShownSweep::of(ui, context, &self.sweeps, (&sweep, &served));
        if shown.curve.is_none() && shown.markers.is_none() {
            let waits = match served {
                Ok(_) if !self.sweeps.curve_is_current() => "The curve is being computed",
                Ok(_) => "The reduced model has no solution here: full solutions draw the curve",
                Err(_) => "Full solutions draw the curve here",
            };
            ui.centered_and_justified(|ui| ui.weak(waits));
            return;
        }
        if let Some(place) = chart::ui(ui, choices, context, &sweep, &shown) {
            commands.edit(edit_along(context.document, choices, place), "traction");
        }
    }

    fn offers<'a>(&'a self, _: &Context<'a>) -> Vec<Offer<'a>> {
        let view = &self.sweeps;
        let there = view.curve.as_ref().is_some_and(|curve| !curve.samples.is_empty())
            || view.markers.as_ref().is_some_and(|markers| !markers.samples.is_empty());
        let tip = "The curve and the full solutions, every contact with its traction and film thicknesses";
        let text = |view: &&Sweeps| export::csv(view).unwrap_or_default();
        vec![Offer::table("Curve as CSV…", tip, there.then_some(view), text)]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        let (key, notes) = export::parameters(&self.sweeps)?;
        let contact = caption::contact(&key.point, &key.lubricant, context.system);
        Some(std::iter::once(contact).chain(notes).collect::<Vec<_>>().join("; "))
    }

    fn receive(&mut self) {
        self.sweeps.receive();
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        let full = self.sweeps.full.standing();
        full.into_iter().chain(view::lasting(self.sweeps.following())).collect()
    }

    fn stop(&mut self) {
        self.sweeps.stop_markers();
    }

    fn kept(&self) -> Option<String> {
        view::kept(&self.choices)
    }

    fn restore(&mut self, text: &str) -> bool {
        view::restore(&mut self.choices, text, |_| true)
    }
}

impl Traction {
    /// Starts full solutions along the curve.
    pub fn solve_along(&mut self, ctx: &egui::Context, document: &Document, answers: &Answers) {
        self.sweeps.start_markers(ctx, document, answers, &self.choices, false);
    }
}

/// Starts full solutions along the curve when the sliders are idle, if no model was trained for it.
fn fill(
    ui: &Ui,
    sweeps: &mut Sweeps,
    context: &Context<'_>,
    choices: &Choices,
    (sweep, served): (&Sweep, &Result<Served, Refusal>),
) {
    if sweeps.fills_another(sweep) {
        sweeps.stop_markers();
    }
    let trained = served.as_ref().is_ok_and(|served| served.untrained.is_none());
    if trained || sweeps.has_markers_of(sweep) {
        return;
    }
    let rest = context.answers.rested_s(ui.input(|i| i.time));
    if rest < REST_S {
        ui.ctx().request_repaint_after_secs((REST_S - rest) as f32);
    } else {
        sweeps.start_markers(ui.ctx(), context.document, context.answers, choices, true);
        ui.ctx().request_repaint();
    }
}

/// Curves to draw, and whether they are out of date.
pub struct ShownSweep<'a> {
    pub(super) curve: Option<&'a Curve>,
    pub(super) markers: Option<&'a Markers>,
    curve_stale: bool,
    pub(super) markers_stale: bool,
}

impl<'a> ShownSweep<'a> {
    fn of(
        ui: &Ui,
        context: &Context<'_>,
        view: &'a Sweeps,
        (sweep, served): (&Sweep, &Result<Served, Refusal>),
    ) -> Self {
        let varied = sweep.varied;
        let curve = view.curve.as_ref().filter(|curve| curve.sweep.varied == varied && !curve.samples.is_empty());
        let markers = view.markers.as_ref().filter(|markers| markers.sweep.varied == varied);
        let markers = markers.filter(|markers| !markers.samples.is_empty());
        let present =
            |curve: &&Curve| curve.sweep == *sweep && served.as_ref().is_ok_and(|served| *served == curve.served);
        let curve_stale = curve.filter(present).is_none();
        let markers_stale = markers.is_none_or(|markers| markers.sweep != *sweep);
        // Full solutions of the present contacts replace a curve of others.
        let curve = curve.filter(|_| !curve_stale || markers_stale);
        let key = context.document.key();
        let of = |sweep: &Sweep| sweep.contact_like(&key);
        let note = |name, sweep: &Sweep| drawn::is_grey(ui.ctx(), name, Owner::Contact(of(sweep)), context);
        Self {
            curve_stale: curve.is_some_and(|curve| note("traction curve", &curve.sweep)) || curve_stale,
            markers_stale: markers.is_some_and(|markers| note("full solutions", &markers.sweep)) || markers_stale,
            curve,
            markers,
        }
    }
}

impl ShownSweep<'_> {
    /// Returns the contacts of the line: the curve of the reduced model, or the full solutions if there is none.
    pub(super) fn samples(&self) -> &[Sample] {
        match (self.curve, self.markers) {
            (Some(curve), _) => &curve.samples,
            (None, Some(markers)) => &markers.samples,
            (None, None) => &[],
        }
    }

    pub(super) fn line_stale(&self) -> bool {
        if self.curve.is_some() { self.curve_stale } else { self.markers_stale }
    }
}

/// Explanation of the laws of the fluid, for teaching.
const WHY_FLUID: &str = "Pressure in the contact raises the viscosity by many orders of magnitude, and shear stress \
                         reduces it again. The shaded ranges occur in this contact, and their upper ends determine how \
                         strong both effects are. If they end to the left of the bend, the lubricant behaves like a \
                         Newtonian one.";

fn toolbar(
    ui: &mut Ui,
    (choices, sweeps): (&mut Choices, &Sweeps),
    context: &Context<'_>,
    commands: &mut Commands,
    there: bool,
) {
    ui.horizontal_wrapped(|ui| {
        against_ui(ui, choices, context.document.point.kind, commands);
        if context.document.lubricant.is_rough() {
            stribeck_ui(ui, choices, commands);
        }
        let (along, up) = &mut choices.logarithmic;
        let before = choices.slide;
        if choices.against == Against::SlideToRoll {
            for (view, name, tip) in SlideView::ALL {
                ui.selectable_value(&mut choices.slide, view, name).on_hover_text(tip);
            }
        } else {
            ui.add(Checkbox::new(along, "Log x")).on_hover_text("Logarithmic horizontal axis");
        }
        if choices.slide != before {
            commands.push(Command::FitPlots);
        }
        ui.add(Checkbox::new(up, "Log y")).on_hover_text("Logarithmic axes of traction and film thickness");
        if sweeps.full.standing().is_some() {
            let stop =
                ui.add_sized(FULL_BUTTON, Button::new("Stop")).on_hover_text("Keeps the full solutions so far (Esc)");
            if stop.clicked() {
                sweeps.stop_markers();
            }
        } else {
            let tip = "Computes eleven full solutions along the curve, drawn as rings";
            let button = ui.add_enabled(there, Button::new("Add full solutions").min_size(FULL_BUTTON.into()));
            if button.on_hover_text(tip).clicked() {
                commands.push(Command::SolveAlong);
            }
        }
    });
}

/// Draws the button that shows the Stribeck curve.
fn stribeck_ui(ui: &mut Ui, choices: &mut Choices, commands: &mut Commands) {
    let shown = choices.against == Against::Speed && choices.logarithmic.0;
    let tip = "Friction and load share of the asperities over five decades of speed, from boundary to full film";
    if ui.selectable_label(shown, "Stribeck curve").on_hover_text(tip).clicked() && !shown {
        (choices.against, choices.logarithmic.0) = (Against::Speed, true);
        commands.push(Command::FitPlots);
    }
}

fn against_ui(ui: &mut Ui, choices: &mut Choices, kind: ContactKind, commands: &mut Commands) {
    let label = ui.label("Against").on_hover_text("Quantity on the horizontal axis");
    let before = choices.against;
    let chosen = &mut choices.against;
    let response =
        ComboBox::from_id_salt("traction against").selected_text(before.name()).width(150.0).show_ui(ui, |ui| {
            for option in Against::ALL.into_iter().filter(|option| option.is_of(kind)) {
                ui.selectable_value(chosen, option, option.name()).on_hover_text(option.tip());
            }
        });
    response.response.labelled_by(label.id).on_hover_text(before.tip());
    if *chosen != before {
        // Speeds and radii span decades, SRR and NPR do not.
        choices.logarithmic.0 = !matches!(choices.against, Against::SlideToRoll | Against::Plateau);
        commands.push(Command::FitPlots);
    }
}

/// Size of the buttons that start and stop full solutions.
const FULL_BUTTON: [f32; 2] = [136.0, 22.0];
/// Number of lines reserved above the plots, so that the plots do not move.
const STATUS_LINES: f32 = 3.0;

/// Draws progress, warnings and a summary of the curve in an area of fixed size.
fn status(
    ui: &mut Ui,
    context: &Context<'_>,
    sweeps: &Sweeps,
    swept: (&Sweep, &Choices),
    served: &Result<Served, Refusal>,
) {
    let line = ui.text_style_height(&TextStyle::Small) + ui.spacing().item_spacing.y;
    let size = vec2(ui.available_width(), STATUS_LINES * line);
    ui.allocate_ui_with_layout(size, Layout::top_down(Align::LEFT), |ui| {
        ui.set_min_size(size);
        let area = ScrollArea::vertical().id_salt("traction status").max_height(size.y).auto_shrink(false);
        area.show(ui, |ui| said(ui, context, sweeps, swept, served));
    });
}

fn said(
    ui: &mut Ui,
    context: &Context<'_>,
    view: &Sweeps,
    (sweep, choices): (&Sweep, &Choices),
    served: &Result<Served, Refusal>,
) {
    ui.label(rich(&summary(context, view, sweep), 12.5, Palette::of(ui).quiet)).on_hover_text(
        match sweep.base.lubricant.heat {
            Some(_) => "Traction coefficient of the thermal contact over the area under pressure",
            None => "Traction coefficient of the isothermal contact over the whole domain (3.41)",
        },
    );
    let place = choices.against.of(&context.document.key());
    if choices.against == Against::SlideToRoll && choices.slide == SlideView::Near && 100.0 * place > NEAR_SRR {
        let place = numbers::slide_to_roll(place);
        ui.weak(format!("The contact on the screen slides at {place}, outside this view"));
    }
    standing_ui(ui, view.full.standing(), "Progress of the full solutions");
    match served {
        Ok(Served { untrained: None, .. }) => {}
        Ok(Served { untrained: Some(why), .. }) => warning_ui(
            ui,
            &format!(
                "the curve is a sketch, because it is outside the trained range: {why}. The model solves the equations \
                 of these contacts, but there is no error bound; full solutions check it"
            ),
        ),
        Err(why) => warning_ui(ui, &format!("no curve by the reduced model: {}", why.trim_end_matches('.'))),
    }
    if let Some(unphysical) = sweep.unphysical() {
        warning_ui(ui, &format!("{unphysical}: it is drawn grey. Set a limiting shear stress, or reduce the load"));
    } else {
        let doubts = || view.curve.iter().flat_map(|curve| &curve.samples).filter_map(|sample| sample.unphysical);
        if doubts().any(|doubt| matches!(doubt, TractionDoubt::Coefficient(_))) {
            warning_ui(ui, &format!("where µ exceeds {PLAUSIBLE_TRACTION} it is unphysical, and drawn grey"));
        }
        if let Some(doubt) = doubts().find(|doubt| matches!(doubt, TractionDoubt::Stress { .. })) {
            warning_ui(ui, &format!("{doubt}; such a traction is drawn grey"));
        }
    }
    let rolls = sweep.varied != Varied::SlideToRoll && sweep.base.point.sliding.slide_to_roll_ratio == 0.0;
    if rolls {
        ui.weak("Pure rolling: without a slide-to-roll ratio there is no traction");
    }
    if let Some(message) = &view.full.message {
        message_ui(ui, message);
    }
    context.entries.message_ui(ui, "traction");
    if let Some(curve) = view.curve.as_ref().filter(|curve| curve.sweep.varied == sweep.varied) {
        match &curve.left_out {
            Ok(left_out) => left_out_ui(ui, *left_out, &curve.served),
            Err(message) => message_ui(ui, message),
        }
    }
    if let Some(markers) =
        view.markers.as_ref().filter(|markers| markers.sweep != *sweep && !markers.samples.is_empty())
    {
        let of = numbers::contact(&markers.sweep.base.point);
        ui.weak(sentence(&format!("the grey rings are full solutions of another sweep, starting at {of}")));
    }
}

/// Draws a warning if contacts of the curve are missing.
fn left_out_ui(ui: &mut Ui, failed: usize, served: &Served) {
    let contacts = match failed {
        0 => return,
        1 => "1 contact, which is".to_owned(),
        _ => format!("{failed} contacts, which are"),
    };
    let solver = if served.by.is_some() { "reduced model" } else { "full solver" };
    warning_ui(ui, &format!("the {solver} did not converge at {contacts} left out"));
}

/// Returns the traction of the contact, the maximum of the curve, and the difference to full solutions.
fn summary(context: &Context<'_>, view: &Sweeps, sweep: &Sweep) -> String {
    let mut parts = Vec::new();
    let here = context.answers.picture().filter(|_| context.answers.picture_follows());
    if let Some(picture) = here.filter(|picture| picture.unphysical.is_none()) {
        parts.push(format!("µ {} here", numbers::significant(picture.traction)));
    }
    if let Some(curve) = view.curve.as_ref().filter(|curve| curve.sweep == *sweep && !curve.samples.is_empty()) {
        let plausible = curve.samples.iter().filter(|sample| sample.unphysical.is_none());
        let tractions = plausible.map(|sample| sample.traction);
        if sweep.unphysical().is_none() {
            parts.push(format!("{} at most", numbers::significant(tractions.fold(0.0, f64::max))));
        }
        if let Some((traction, film)) = chart::differences(curve, view.markers.as_ref()) {
            parts.push(format!(
                "full solutions differ by {} in µ and {} in {{H_c}}",
                numbers::small(traction),
                numbers::error_percent(film)
            ));
        }
        parts.push(format!("{} contacts in {}", curve.samples.len(), numbers::duration(curve.wall_s)));
    }
    parts.join(";  ")
}
