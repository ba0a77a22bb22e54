//! Controls of the linearised model: number of operating points, selection rule, weights, and a check of the inputs
//! against the training.

use crate::app::context::{Commands, Context};
use crate::app::controls::{RangeSlider, choice};
use crate::app::document::Edit;
use crate::app::tabs::transient::advice::advice;
use crate::app::tabs::transient::method::{RULES, WEIGHTINGS, rule_name, weighting_name};
use crate::app::tabs::transient::reach::beyond;
use crate::app::theme::{Palette, rich};
use egui::{Grid, Ui};

/// Name under which refusals are stored.
pub const NAME: &str = "tpwl";
/// Range of the slider for the number of points.
const POINTS: (f64, f64) = (4.0, 160.0);
/// Width of the slider.
const WIDTH: f32 = 120.0;

/// Draws the controls.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let before = context.document.transient_study();
    let mut study = before.clone();
    let Some(linearised) = &mut study.linearised else {
        ui.label("Number of operating points").on_hover_text("There is no linearised model yet");
        return;
    };
    let tip = "Number of operating points of all training trajectories together";
    ui.label("Points").on_hover_text(tip);
    let there = context.transient.linearised.as_ref().map(|linearised| linearised.model.points.len());
    let present = linearised.points.or(there).unwrap_or(30);
    let slider = RangeSlider {
        name: "Number of operating points",
        range: POINTS.0..=POINTS.1,
        marked: None,
        home: 30.0,
        tooltip: tip,
        logarithmic: true,
    };
    if let Some(moved) = slider.show(ui, present as f64, WIDTH) {
        linearised.points = Some(moved.clamp(POINTS.0, POINTS.1).round() as usize);
    }
    ui.label(present.to_string());
    Grid::new("tpwl rule").spacing([6.0, 0.0]).min_col_width(0.0).show(ui, |ui| {
        let own = RULES.iter().position(|rule| rule.name() == linearised.selection.name()).unwrap_or(0);
        let mut rule = own;
        let tip = "Selection of the trained states for linearisation";
        choice(ui, "Rule", tip, &mut rule, &[0, 1], |k| rule_name(RULES[k]));
        if rule != own {
            linearised.selection = RULES[rule];
        }
    });
    Grid::new("tpwl combine").spacing([6.0, 0.0]).min_col_width(0.0).show(ui, |ui| {
        let former = linearised.weightings.first().copied().unwrap_or(WEIGHTINGS[0]);
        let mut weighting = former;
        choice(ui, "Combine", "Weighting of the operating points", &mut weighting, &WEIGHTINGS, weighting_name);
        if weighting != former {
            linearised.weightings = vec![weighting];
        }
    });
    if study != before {
        commands.edit(Edit::Transient(Box::new(study)), NAME);
    }
}

/// Draws a line, always present, that states whether the inputs are inside the training of the models.
pub fn inputs_ui(ui: &mut Ui, context: &Context<'_>) {
    let view = context.transient;
    let said = view
        .setup
        .as_ref()
        .zip(view.trained_by())
        .map(|(setup, trainings)| beyond(&setup.study.inputs, setup.study.duration, &trainings));
    let palette = Palette::of(ui);
    let (text, color) = match said {
        Some(Some(warning)) => (format!("{warning}: {}", advice(view)), palette.warning),
        Some(None) => {
            ("The inputs are no steeper than trained, and their amplitudes no larger".to_owned(), palette.quiet)
        }
        None => (String::new(), palette.quiet),
    };
    ui.label(rich(&text, 12.5, color));
}
