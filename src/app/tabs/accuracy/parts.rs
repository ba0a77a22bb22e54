//! Parts shared by the views of the tab: toolbars, notes, columns.

use super::random_tests::{MOST_COMPARED, RandomTests, TESTS};
use crate::app::controls::{either_button, message_ui, named, standing_ui, warning_ui};
use crate::app::in_use::InUse;
use crate::app::theme::{Palette, rich};
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::StudyRow;
use crate::scene::names;
use crate::solver::physics::contact::OperatingPoint;
use egui::{DragValue, Ui};

/// Draws a count with its name.
pub fn count(ui: &mut Ui, name: &str, tip: &str, value: &mut usize, range: std::ops::RangeInclusive<usize>) {
    ui.label(name).on_hover_text(tip);
    let response = ui.add(DragValue::new(value).range(range).speed(10.0));
    named(ui, response, name).on_hover_text(tip);
}

/// Draws the button Run, or Stop during a run. Returns true if a run is requested.
pub fn run_or_stop(ui: &mut Ui, run: &str, tip: &str, work: &Background<StudyRow>) -> bool {
    let runs = work.job().is_some();
    let tip = if runs { "Keeps the results so far (Esc)" } else { tip };
    let clicked = either_button(ui, [run, "Stop"], runs).on_hover_text(tip).clicked();
    if clicked && runs {
        work.stop();
    }
    clicked && !runs
}

/// Draws the toolbar of both views of the random validation.
pub fn tests_toolbar(ui: &mut Ui, store: &Store, tests: &mut RandomTests, in_use: &InUse) {
    tests.show(&ui.ctx().clone(), store, in_use);
    ui.horizontal_wrapped(|ui| {
        let wanted = &mut tests.wanted;
        let tip = "Reduced solves at random contacts (3.17) of the trained range";
        count(ui, "Random contacts", tip, &mut wanted.tests, TESTS);
        let tip = "Number of contacts compared with full solutions on the model’s grid. Up to 20 further contacts with \
                   the largest expected errors come first";
        count(ui, "Compared in full", tip, &mut wanted.compared, 0..=MOST_COMPARED);
        let tip = "The same seed gives the same contacts";
        ui.label("Seed").on_hover_text(tip);
        let seed = ui.add(DragValue::new(&mut wanted.seed));
        named(ui, seed, "Seed").on_hover_text(tip);
        if run_or_stop(ui, "Run validation", "Validates the model with its present truncation", &tests.work) {
            tests.start(&ui.ctx().clone(), store, in_use);
        }
        standing_ui(ui, tests.work.standing(), "Progress of the random validation");
    });
    if let Some(message) = &tests.work.message {
        message_ui(ui, message);
    }
    if let Some(results) = tests.results.as_ref().filter(|r| r.in_use != *in_use) {
        stale_note(ui, &results.in_use);
    }
}

/// Warns that the results belong to another model or truncation.
pub fn stale_note(ui: &mut Ui, of: &InUse) {
    warning_ui(ui, &format!("Results of {}; the model or its truncation has changed since", of.describe()));
}

/// Draws a note if there are no error bounds.
pub fn bound_note(ui: &mut Ui, mut bounds: impl Iterator<Item = Option<f64>>) {
    if !bounds.any(|bound| bound.is_some()) {
        let note = "No calibrated bounds: the model is truncated, or its training measured no errors";
        ui.label(rich(note, 11.0, Palette::of(ui).quiet));
    }
}

/// Columns of an exported table that identify the contact of a row.
pub const CONTACT_COLUMNS: [&str; 8] =
    [names::M, names::L, names::RADIUS, names::SPEED, names::LOAD, names::MODULUS, names::VISCOSITY, names::ALPHA];

/// Returns the values of [`CONTACT_COLUMNS`].
pub fn contact_cells(point: &OperatingPoint) -> [f64; 8] {
    let (moes, [r, u, w, e, eta, alpha]) = (point.moes(), point.quantities());
    [moes.m, moes.l, r, u, w, e, eta, alpha]
}

/// Draws a text in place of missing results.
pub fn nothing_yet(ui: &mut Ui, text: &str) {
    ui.centered_and_justified(|ui| ui.weak(text));
}
