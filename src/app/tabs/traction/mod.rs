//! Traction and film along one quantity, live by the reduced model, and the laws of the fluid behind them.

mod chart;
mod fluid;

use crate::app::answers::REST_S;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, sentence, standing_ui, warning_ui, why};
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::app::traction::{Against, Choices, Curve, Markers, Served, Sweep, Varied, export, sweep};
use crate::solver::full::Solution;
use egui::{Button, Checkbox, ComboBox, Ui};
use std::sync::Arc;

/// Seconds of rest after which a curve of other sliders is drawn grey.
const STALE_S: f64 = REST_S + 0.75;

/// The tab: how it shows things, and the largest shear stress of a solution.
#[derive(Default)]
pub struct Traction {
    /// What is drawn, and how.
    pub choices: Choices,
    stress_met: Option<(Arc<Solution>, f64)>,
}

impl Traction {
    /// The tab.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let choices = &mut self.choices;
        ui.horizontal_wrapped(|ui| {
            ui.selectable_value(&mut choices.shows_fluid, false, "Traction and film");
            ui.selectable_value(&mut choices.shows_fluid, true, "Laws of the fluid");
            ui.toggle_value(&mut choices.why, "Why").on_hover_text("What is seen here, in three sentences");
        });
        ui.separator();
        why(ui, choices.why, WHY[usize::from(choices.shows_fluid)]);
        if choices.shows_fluid {
            fluid::ui(ui, &mut self.stress_met, context);
            return;
        }
        let Some((sweep, served)) = sweep(context.document, context.answers, choices) else {
            toolbar(ui, choices, context, commands, false);
            ui.centered_and_justified(|ui| {
                ui.weak("The lubricant has no shear constants: it is Newtonian, and there is no plateau ratio to vary")
            });
            return;
        };
        if let Ok(served) = &served
            && !context.traction.is_asked(&sweep, served)
        {
            commands.push(Command::FollowSweep(Box::new((sweep.clone(), served.clone()))));
        }
        toolbar(ui, choices, context, commands, true);
        status(ui, context, &sweep, &served);
        let shown = ShownSweep::of(context, &sweep, &served, ui.input(|i| i.time));
        if shown.curve.is_none() && shown.markers.is_none() {
            let waits = match served {
                Ok(_) if !context.traction.curve_is_current() => "The curve is being computed",
                Ok(_) => "The reduced model has no answer along here: full solutions draw the curve on request",
                Err(_) => "Full solutions draw the curve here on request",
            };
            ui.centered_and_justified(|ui| ui.weak(waits));
            return;
        }
        commands.extend(chart::ui(ui, choices, context, &sweep, &shown).map(Command::GoAlong));
    }
}

/// What there is to draw, and what of it is old.
struct ShownSweep<'a> {
    curve: Option<&'a Curve>,
    markers: Option<&'a Markers>,
    curve_stale: bool,
    markers_stale: bool,
    /// A sentence where the traction is no physics.
    unphysical: Option<String>,
}

impl<'a> ShownSweep<'a> {
    fn of(context: &Context<'a>, sweep: &Sweep, served: &Result<Served, String>, now: f64) -> Self {
        let view = context.traction;
        let varied = sweep.varied;
        let curve = view.curve.as_ref().filter(|curve| curve.sweep.varied == varied && !curve.samples.is_empty());
        let markers = view.markers.as_ref().filter(|markers| markers.sweep.varied == varied);
        let late = served.is_err() || context.answers.rested_s(now) > STALE_S;
        Self {
            curve_stale: !view.curve_is_current() && late,
            markers_stale: markers.is_some_and(|markers| markers.sweep != *sweep),
            curve,
            markers: markers.filter(|markers| !markers.samples.is_empty()),
            unphysical: sweep.unphysical(),
        }
    }
}

/// The notes for teaching: of the traction, and of the laws.
const WHY: [&str; 2] = [
    "Surfaces that slide shear the film, and its shear stress, summed up over the contact, is the traction. A lubricant that thins under shear \
     gives way: the curve bends, and the film gets thinner because the inlet is sheared as well. Under high pressure a film without a limiting \
     stress would carry more than any lubricant can, so look at p_H first. µ = (1/w) ∫ τ(h/2) dA (3.41)",
    "Pressure in the contact lets the viscosity rise by many orders of magnitude, shear stress lets it fall again. The shaded parts are what this \
     very contact meets: their ends decide how much of both the film feels. Where they end left of the bend the lubricant is as good as \
     Newtonian. η(p, τ) = µ(p) (NPR + (1 − NPR)(1 + (τ/G_c)^β)^((1 − 1/n)/β)) (3.40)",
];

fn toolbar(ui: &mut Ui, choices: &mut Choices, context: &Context<'_>, commands: &mut Commands, sweeps: bool) {
    ui.horizontal_wrapped(|ui| {
        against_ui(ui, choices, commands);
        let (along, up) = &mut choices.logarithmic;
        ui.add(Checkbox::new(along, "Log x")).on_hover_text("Equal ways along are equal ratios");
        ui.add(Checkbox::new(up, "Log y")).on_hover_text("Equal ways up are equal ratios of traction and of film");
        if context.traction.full.standing().is_some() {
            if ui.button("Stop").on_hover_text("Full solutions so far stay (Esc)").clicked() {
                commands.push(Command::StopAlong);
            }
        } else {
            let tip = "Eleven full solutions along the curve, set on it as rings";
            let button = ui.add_enabled(sweeps, Button::new("Add full solutions")).on_hover_text(tip);
            if button.clicked() {
                commands.push(Command::SolveAlong);
            }
        }
        exports(ui, context, commands);
    });
}

fn against_ui(ui: &mut Ui, choices: &mut Choices, commands: &mut Commands) {
    let label = ui.label("Against").on_hover_text("What traction and film are drawn against");
    let before = choices.against;
    let chosen = &mut choices.against;
    let response =
        ComboBox::from_id_salt("traction against").selected_text(before.name()).width(150.0).show_ui(ui, |ui| {
            for option in Against::ALL {
                ui.selectable_value(chosen, option, option.name()).on_hover_text(option.tip());
            }
        });
    response.response.labelled_by(label.id).on_hover_text(before.tip());
    if *chosen != before {
        // Speeds span decades, ratios do not.
        choices.logarithmic.0 = !matches!(choices.against, Against::SlideToRoll | Against::Plateau);
        commands.push(Command::FitPlots);
    }
}

fn exports(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let there = context.traction.curve.as_ref().is_some_and(|curve| !curve.samples.is_empty())
        || context.traction.markers.as_ref().is_some_and(|markers| !markers.samples.is_empty());
    let tip = "The curve and the full solutions, every contact with its traction and films";
    if ui.add_enabled(there, Button::new("Export CSV…")).on_hover_text(tip).clicked()
        && let Some(text) = export::csv(context.traction)
    {
        commands.push(Command::csv(text));
    }
    let tip = "Traction, film or both, as SVG or PNG with axes and parameters";
    if ui.add_enabled(there, Button::new("Export plot…")).on_hover_text(tip).clicked() {
        commands.push(Command::ExportPlot);
    }
}

/// What runs, what is amiss, and what the curve says in numbers.
fn status(ui: &mut Ui, context: &Context<'_>, sweep: &Sweep, served: &Result<Served, String>) {
    let view = context.traction;
    standing_ui(ui, view.full.standing(), "Progress of the full solutions");
    match served {
        Ok(Served { untrained: None, .. }) => {}
        Ok(Served { untrained: Some(why), .. }) => warning_ui(
            ui,
            &format!(
                "the curve is a sketch, for the model was not trained for it: {why}. It solves the equations of these contacts, but no bound on \
                 its errors is known; full solutions check it"
            ),
        ),
        Err(why) => warning_ui(ui, &format!("no curve by the reduced model: {}", why.trim_end_matches('.'))),
    }
    if let Some(unphysical) = sweep.unphysical() {
        warning_ui(ui, &format!("{unphysical}: it is drawn grey. Set a limiting shear stress, or take less load"));
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
            Ok(left_out) => left_out_ui(ui, *left_out),
            Err(message) => message_ui(ui, message),
        }
    }
    if let Some(markers) =
        view.markers.as_ref().filter(|markers| markers.sweep != *sweep && !markers.samples.is_empty())
    {
        let of = numbers::moes(markers.sweep.base.point.moes());
        ui.weak(sentence(&format!("the grey rings are full solutions of another sweep, beginning at {of}")));
    }
    ui.label(rich(&summary(context, sweep), 13.0, Palette::of(ui).quiet));
}

/// Why there are fewer contacts than the curve should have.
fn left_out_ui(ui: &mut Ui, failed: usize) {
    let contacts = match failed {
        0 => return,
        1 => "1 contact, which is".to_owned(),
        _ => format!("{failed} contacts, which are"),
    };
    warning_ui(ui, &format!("the reduced model did not converge at {contacts} left out"));
}

/// Traction here, the largest of the curve, and how far full solutions lie from it.
fn summary(context: &Context<'_>, sweep: &Sweep) -> String {
    let mut parts = Vec::new();
    let here = context.answers.picture.as_ref().filter(|_| context.answers.picture_is_current());
    if let Some(picture) = here.filter(|picture| picture.unphysical.is_none()) {
        parts.push(format!("µ {} here", numbers::significant(picture.traction)));
    }
    if let Some(curve) =
        context.traction.curve.as_ref().filter(|curve| curve.sweep == *sweep && !curve.samples.is_empty())
    {
        let tractions = curve.samples.iter().map(|sample| sample.traction);
        if sweep.unphysical().is_none() {
            parts.push(format!("{} at most", numbers::significant(tractions.fold(0.0, f64::max))));
        }
        if let Some((traction, film)) = chart::differences(curve, context.traction.markers.as_ref()) {
            parts.push(format!(
                "full solutions differ by {} in µ and {} in {{H_c}}",
                numbers::small(traction),
                numbers::error_percent(film)
            ));
        }
        parts.push(format!("{} contacts in {}", curve.samples.len(), numbers::duration(curve.wall_s)));
    }
    parts.push("over the whole domain (3.41), isothermal".to_owned());
    parts.join(";  ")
}
