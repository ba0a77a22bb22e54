//! View of the parts of this contact's error: basis, projection, sampling and discretisation.

use super::parts::{run_or_stop, stale_note};
use crate::app::answers::REST_S;
use crate::app::context::Context;
use crate::app::controls::{message_ui, sentence, spoken, warning_ui};
use crate::app::document::Key;
use crate::app::drawn::{self, Owner};
use crate::app::in_use::{InUse, question};
use crate::app::plot::axes;
use crate::app::theme::{Palette, rich};
use crate::app::{export, numbers};
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::study::error_split::{ErrorSplitStudy, Row};
use crate::scene::{Contacts, Grid as SceneGrid, Study, StudyRow};
use crate::solver::full::Problem;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{ErrorSplit, Parts, Trust};
use egui::{Align2, Grid, Ui, Vec2b};
use egui_plot::{Bar, BarChart, PlotPoint, Text};
use std::sync::Arc;

/// Maximum number of decades of the bars. Much smaller parts are not relevant.
const DECADES: f64 = 7.0;
/// Width of a label of the logarithmic axis.
const LABEL: f32 = 66.0;
/// Width of the row names next to the bars.
const NAMES: f32 = 152.0;

/// Rows of bars and table from top to bottom: name and explanation.
const ROWS: [(&str, &str); 6] = [
    (
        "Basis",
        "Difference between the full solution and its best approximation in the pressure basis, in the norm of the \
         basis. No reduced solution has a smaller pressure error. More snapshots or modes reduce it",
    ),
    (
        "Projection",
        "Difference between the reduced solution with all Reynolds equations and that best approximation. Galerkin’s \
         conditions select another element of the same basis, often one with a better film thickness",
    ),
    (
        "Sampling",
        "Difference between the reduced solution with sampled equations and the one with all equations. More or better \
         sampled equations reduce it",
    ),
    (
        "Reduced against full",
        "Sum of the three parts above with their signs, as the check against the full solution shows it",
    ),
    (
        "Discretisation",
        "Difference between the full solution on the model’s grid and the limit of this and the next finer grid \
         (Richardson, order two). No reduced model can be more accurate than its grid",
    ),
    ("Reduced against the limit", "Sum of all four parts with their signs"),
];

/// Contact and model of a split.
#[derive(Clone, PartialEq)]
pub struct SplitOf {
    key: Key,
    in_use: InUse,
}

/// State of the view.
#[derive(Default)]
pub struct Split {
    /// Running study, and the reason why there is no split.
    pub work: Background<StudyRow>,
    /// Last request, complete or not.
    asked: Option<SplitOf>,
    /// True if it was started automatically.
    unasked: bool,
    /// Last result with its contact and model.
    pub found: Option<(SplitOf, Arc<ErrorSplit>)>,
}

impl Split {
    /// Receives the result.
    pub fn receive(&mut self) {
        let Some(asked) = &self.asked else { return };
        let (mut refused, mut answered, worked) = (None, false, self.work.job().is_some());
        self.work.receive(|row| {
            let StudyRow::ErrorSplit(Row { split, .. }) = row else { return };
            answered = true;
            match split {
                Ok(split) => self.found = Some((asked.clone(), split)),
                Err(why) => refused = Some(why.to_string()),
            }
        });
        if answered {
            // One contact has one row, so the study is complete.
            self.work = Background::default();
        } else if worked && self.work.job().is_none() && self.work.message.is_none() {
            refused = Some("stopped before it was complete".to_owned());
        }
        if refused.is_some() {
            self.work.message = refused;
        }
    }

    /// Stops and discards a study that was started automatically. It starts again when the view is shown again.
    pub fn hide(&mut self) {
        if self.work.job().is_some() && self.unasked {
            (self.asked, self.work) = (None, Background::default());
        }
    }

    fn start(&mut self, ctx: &egui::Context, store: &Store, asked: SplitOf, unasked: bool) {
        self.unasked = unasked;
        let study = ErrorSplitStudy { contacts: Contacts::Here, method: asked.in_use.method() };
        // A cavitation model that differs from the one of the reduced model would count as an error of its basis.
        let mut key = asked.key;
        if !matches!(key.lubricant.cavitation, Cavitation::MassConserving { .. }) {
            key.lubricant.cavitation = asked.in_use.model.domain.lubricant.cavitation;
        }
        let question = question("Splitting the error", &key, SceneGrid::Model, Study::ErrorSplit(study));
        self.work.run(asked.in_use.ask(ctx, store, question));
        self.asked = Some(asked);
    }
}

/// Draws the view.
pub fn ui(ui: &mut Ui, own: &mut Split, context: &Context<'_>, in_use: &InUse) {
    let ctx = ui.ctx().clone();
    let now = SplitOf { key: context.document.key(), in_use: in_use.clone() };
    start_when_rested(ui, own, context, &now);
    ui.horizontal_wrapped(|ui| {
        let tip = "Solves this contact by the reduced model, by the reduced model with all equations, in full, and in \
                   full on the next finer grid";
        if run_or_stop(ui, "Split the error", tip, &own.work) {
            own.start(&ctx, context.answers.store(), now.clone(), false);
        }
        if let Some((asked, _)) = &own.found {
            ui.label(numbers::contact(&asked.key.point));
        }
    });
    if let (Some(message), true) = (&own.work.message, own.asked.as_ref() == Some(&now)) {
        message_ui(ui, message);
    }
    if let Some(Trust::Outside(why)) = context.answers.trust(context.document) {
        warning_ui(ui, &format!("{why}; the split is made on request only"));
    }
    let Some((asked, split)) = &own.found else {
        super::parts::nothing_yet(ui, "The parts appear when the sliders are idle");
        return;
    };
    let owner = Owner::ContactByModel(asked.key, asked.in_use.clone());
    let current = !drawn::is_grey(ui.ctx(), "parts of the error", owner, context);
    if asked.in_use != now.in_use {
        stale_note(ui, &asked.in_use);
    } else if !current {
        warning_ui(ui, &format!("The parts belong to {}, not to the sliders", numbers::contact(&asked.key.point)));
    }
    bars(ui, split, current);
    table(ui, split, current);
}

/// Starts the study automatically once per contact and model, when the sliders are idle inside the trained range.
fn start_when_rested(ui: &Ui, own: &mut Split, context: &Context<'_>, now: &SplitOf) {
    let known = own.asked.as_ref() == Some(now);
    let trained = Problem::new(&now.key.point, now.key.lubricant)
        .is_ok_and(|problem| now.in_use.model.trust(&problem) == Trust::Trained);
    if known || !trained {
        return;
    }
    own.work.stop();
    let rested = context.answers.rested_s(ui.input(|i| i.time));
    if rested >= REST_S {
        own.start(ui.ctx(), context.answers.store(), now.clone(), true);
    } else {
        ui.ctx().request_repaint_after_secs((REST_S - rested) as f32);
    }
}

/// Returns the value of a scalar for each of [`ROWS`].
fn values(parts: &Parts) -> [f64; 6] {
    let Parts { basis, projection, sampling, discretisation } = *parts;
    [basis, projection, sampling, parts.reduction(), discretisation, parts.whole()]
}

fn bars(ui: &mut Ui, split: &ErrorSplit, current: bool) {
    let both =
        [("{H_c}", "Parts of the error of H_c", &split.h_c), ("{H_min}", "Parts of the error of H_min", &split.h_min)];
    let logs = both.iter().flat_map(|(_, _, parts)| values(parts)).map(|v| v.abs().log10()).filter(|v| v.is_finite());
    let (low, high) = logs.fold((0.0f64, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let high = if high.is_finite() { high.ceil() } else { 0.0 };
    // Both plots share one axis, so that they are comparable. The right side is reserved for the numbers.
    let low = low.floor().max(high - DECADES).min(high - 2.0);
    let end = high + 0.32 * (high - low);
    let wide = ui.available_width() > 560.0;
    let room = (ui.available_height() - 190.0).max(150.0);
    let one = |ui: &mut Ui, k: usize, height: f32, rows: bool| {
        let (symbol, name, parts) = both[k];
        let drawing = Drawing { range: (low, end), height, rows, current };
        bar_plot(ui, (symbol, name), &values(parts), &drawing);
    };
    if wide {
        // The row names are shown once, on the left.
        let bars = 0.5 * (ui.available_width() - NAMES - 22.0);
        ui.horizontal_top(|ui| {
            for (k, width) in [NAMES + bars, bars].into_iter().enumerate() {
                ui.vertical(|ui| {
                    ui.set_width(width);
                    one(ui, k, room, k == 0);
                });
            }
        });
    } else {
        one(ui, 0, 0.5 * room, true);
        one(ui, 1, 0.5 * room, true);
    }
}

/// Settings of a plot of bars: its axis (log10), its height, whether the row names are shown, whether it is up to
/// date.
struct Drawing {
    range: (f64, f64),
    height: f32,
    rows: bool,
    current: bool,
}

fn bar_plot(ui: &mut Ui, (symbol, name): (&str, &str), values: &[f64; 6], drawing: &Drawing) {
    let &Drawing { range: (low, end), height, rows, current } = drawing;
    let palette = Palette::of(ui);
    let title = format!("Relative error of {symbol}");
    let marks = f64::from((ui.available_width() - if rows { NAMES } else { 0.0 }) / LABEL).max(2.0);
    let at = |row: usize| -(row as f64);
    let color = |row: usize| match row {
        _ if !current => palette.reference,
        3 | 5 => palette.accent,
        4 => palette.reference,
        _ => palette.film,
    };
    axes::show(
        axes::plot(ui, name, height, &title, "")
            .default_x_bounds(low, end)
            .default_y_bounds(at(5) - 0.6, 0.6)
            .auto_bounds(Vec2b::FALSE)
            .allow_drag(false)
            .allow_zoom(false)
            .allow_boxed_zoom(false)
            .allow_double_click_reset(false)
            .show_x(false)
            .show_y(false)
            .decades_x(marks)
            .names_y((0..ROWS.len()).map(|k| -(k as f64)).map(|place| (place, row_name(place))).collect(), rows)
            .y_axis_min_width(if rows { NAMES - 8.0 } else { 6.0 })
            .label_formatter(|_| None),
        ui,
        name,
        |plot| {
            plot.set_plot_bounds_x(low..=end);
            let bars = values.iter().enumerate().filter_map(|(row, value)| {
                let length = value.abs().log10() - low;
                (length > 0.0).then(|| {
                    Bar::new(at(row), length).base_offset(low).width(0.62).fill(color(row)).stroke(egui::Stroke::NONE)
                })
            });
            plot.bar_chart(BarChart::new("", bars.collect()).horizontal().allow_hover(false));
            for (row, value) in values.iter().enumerate() {
                let x = value.abs().log10().max(low);
                let text = rich(&format!(" {}", relative(*value)), 12.0, ui_text(&palette, current));
                let label = Text::new("", PlotPoint::new(x, at(row)), text).anchor(Align2::LEFT_CENTER);
                plot.text(label.id(("value", row)).allow_hover(false));
            }
        },
    );
}

fn ui_text(palette: &Palette, current: bool) -> egui::Color32 {
    if current { palette.text } else { palette.quiet }
}

fn row_name(value: f64) -> String {
    let row = (-value).round();
    ROWS.iter()
        .enumerate()
        .find(|(k, _)| *k as f64 == row)
        .map_or_else(String::new, |(_, (name, _))| (*name).to_owned())
}

/// Returns a signed relative error in the units of the axis.
fn relative(value: f64) -> String {
    let text = numbers::digits(value, 2);
    if value > 0.0 { format!("+{text}") } else { text }
}

/// Returns a signed relative error in percent.
fn signed(value: f64) -> String {
    let sign = if value < 0.0 { "−" } else { "+" };
    let size = numbers::error_percent(value);
    if value == 0.0 || size.starts_with('<') { size } else { format!("{sign}{size}") }
}

fn table(ui: &mut Ui, split: &ErrorSplit, current: bool) {
    let palette = Palette::of(ui);
    let color = ui_text(&palette, current);
    let p = &split.pressure;
    let pressure = [Some(p.basis), Some(p.projection), Some(p.sampling), Some(p.reduction), None, None];
    let (h_c, h_min) = (values(&split.h_c), values(&split.h_min));
    Grid::new("parts").num_columns(4).spacing([22.0, 3.0]).striped(true).show(ui, |ui| {
        for title in ["Part", "of {H_c}", "of {H_min}", "of {P}, in the norm"] {
            ui.label(rich(title, 12.5, palette.quiet));
        }
        ui.end_row();
        for (row, (name, why)) in ROWS.iter().enumerate() {
            ui.label(rich(name, 13.0, color)).on_hover_text(sentence(why));
            for (of, value) in [("H_c", h_c[row]), ("H_min", h_min[row])] {
                let text = signed(value);
                let label = ui.label(rich(&text, 13.0, color)).on_hover_text(format!("{value:.3e}"));
                spoken(ui, label, &format!("{name}, {of}: {text}"));
            }
            let text = pressure[row].map_or_else(String::new, numbers::error_percent);
            ui.label(rich(&text, 13.0, color));
            ui.end_row();
        }
    });
}

/// Returns every part as a row of CSV.
pub fn csv(asked: &SplitOf, split: &ErrorSplit) -> String {
    let moes = asked.key.point.moes();
    let rows: Vec<&str> = ROWS.iter().map(|row| row.0).collect();
    let comments = [
        format!(
            "M {:e}; L {:e}; alpha {:e} 1/Pa; {}",
            moes.m,
            moes.l,
            asked.key.point.alpha_per_pa,
            asked.in_use.describe()
        ),
        format!("rows: {}", rows.join(", ")),
        "signed, relative to the full solution on the model's grid; P as lengths in the weighted norm".to_owned(),
    ];
    let p = &split.pressure;
    let pressure = [Some(p.basis), Some(p.projection), Some(p.sampling), Some(p.reduction), None, None];
    let (h_c, h_min) = (values(&split.h_c), values(&split.h_min));
    let rows = (0..ROWS.len()).map(|k| vec![Some(k as f64 + 1.0), Some(h_c[k]), Some(h_min[k]), pressure[k]]);
    export::csv(&comments, &["row", "H_c", "H_min", "P"], rows)
}
