//! Sliders of amplitude and period of the input that varies.

use super::feature_dials;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{RangeSlider, named};
use crate::app::document::Edit;
use crate::app::document::input::Input;
use crate::app::numbers;
use crate::app::theme::rich;
use crate::scene::TransientStudy;
use crate::solver::full::transient::Signal;
use egui::{DragValue, Label, Ui};

/// Range of the amplitude slider.
const AMPLITUDES: (f64, f64) = (0.01, 0.5);
/// Range of the period slider in units of T.
const PERIODS: (f64, f64) = (1.0, 16.0);
/// Width of a slider.
const WIDTH: f32 = 110.0;

/// Returns the label and the accessible names of an input's sliders.
fn words(input: Input) -> [&'static str; 3] {
    match input {
        Input::Load => ["Load", "Load amplitude", "Load period"],
        Input::Speed => ["Speed", "Speed amplitude", "Speed period"],
        Input::Radius => ["Radius", "Radius amplitude", "Radius period"],
    }
}

/// Returns amplitude and period of a function of time, to be changed. Of several amplitudes it returns the first.
fn swing(signal: &mut Signal) -> Option<(&mut f64, &mut f64)> {
    match signal {
        Signal::Harmonic { amplitude, period }
        | Signal::Reversing { amplitude, period }
        | Signal::TriangleToSquare { amplitude, period, .. } => Some((amplitude, period)),
        Signal::TwoScale { amplitudes, periods } => Some((&mut amplitudes.0, &mut periods.0)),
        Signal::Constant | Signal::Sampled { .. } => None,
    }
}

/// Returns the kind of a function of time as a word.
fn shape(signal: &Signal) -> &'static str {
    match signal {
        Signal::Constant => "constant",
        Signal::Harmonic { .. } => "harmonic",
        Signal::TwoScale { .. } => "two-scale",
        Signal::Reversing { .. } => "reversing",
        Signal::TriangleToSquare { .. } => "triangle to square",
        Signal::Sampled { .. } => "from a table",
    }
}

/// Draws the sliders of the first feature, otherwise of the first input that varies. If there is neither, draws a button
/// that makes the load harmonic.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let before = context.document.transient_study();
    if !before.surfaces.is_empty() {
        return feature_dials::ui(ui, context, commands);
    }
    let mut study = before.clone();
    let swings = Input::ALL.into_iter().find(|input| swing(input.of_mut(&mut study.inputs)).is_some());
    let Some(input) = swings else {
        let tip = "1 + A sin(2π T/T_ex), (2.49), with a tenth and a period of 4";
        if study.inputs.load == Signal::Constant && ui.button("Harmonic load").on_hover_text(tip).clicked() {
            study.inputs.load = Signal::Harmonic { amplitude: 0.1, period: 4.0 };
            commands.edit(Edit::Transient(Box::new(study)), "transient");
        }
        return;
    };
    let scale_s = context.document.point.hertz().half_width_m / context.document.point.speed_m_per_s;
    swing_ui(ui, input, &mut study, scale_s);
    if study != before {
        commands.push(Command::Edit(Edit::Transient(Box::new(study)), "transient"));
    }
}

fn swing_ui(ui: &mut Ui, input: Input, study: &mut TransientStudy, scale_s: f64) {
    let [name, amplitude_name, period_name] = words(input);
    let kind = shape(input.of(&study.inputs));
    ui.strong(name);
    ui.weak(kind);
    let Some((amplitude, period)) = swing(input.of_mut(&mut study.inputs)) else { return };
    let tip = "Amplitude relative to the value of the sliders";
    ui.label("amplitude").on_hover_text(tip);
    let slider = |name: &'static str, (low, high): (f64, f64), home, logarithmic, tooltip: &'static str| RangeSlider {
        name,
        range: low..=high,
        marked: None,
        home,
        tooltip,
        logarithmic,
    };
    if let Some(moved) = slider(amplitude_name, AMPLITUDES, 0.1, false, tip).show(ui, *amplitude, WIDTH) {
        *amplitude = numbers::rounded(moved.clamp(AMPLITUDES.0, AMPLITUDES.1), 3);
    }
    let mut percent = 100.0 * *amplitude;
    let entry = DragValue::new(&mut percent).range(0.1..=99.0).speed(0.2).max_decimals(2).suffix(" %");
    let entry = ui.add_sized([58.0, ui.spacing().interact_size.y], entry);
    if named(ui, entry, &format!("{amplitude_name} value")).changed() {
        *amplitude = 0.01 * percent;
    }
    let tip = "Period in units of a/u_m";
    ui.label("period").on_hover_text(tip);
    if let Some(moved) = slider(period_name, PERIODS, 4.0, true, tip).show(ui, *period, WIDTH) {
        *period = numbers::rounded(moved.clamp(PERIODS.0, PERIODS.1), 3);
    }
    let entry = DragValue::new(period).range(1e-3..=1e4).speed(0.02).max_decimals(3);
    let entry = ui.add_sized([48.0, ui.spacing().interact_size.y], entry);
    named(ui, entry, &format!("{period_name} value")).on_hover_text(tip);
    let text = format!("{{T}} = {}", numbers::duration(*period * scale_s));
    ui.add(Label::new(rich(&text, 13.0, ui.visuals().weak_text_color())).extend());
}
