//! List of the worst random tests, failures first. A click moves the contact there.

use super::failure_map::{By, stamp};
use super::random_tests::{Results, bound_of, error_of};
use crate::app::controls::named;
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::solver::physics::contact::OperatingPoint;
use egui::{Grid, ScrollArea, Ui};

/// Number of listed cases.
const LISTED: usize = 60;

/// Indices of the worst tests, sorted after a change.
#[derive(Default)]
pub struct Worst {
    of: Option<(usize, usize, By)>,
    order: Vec<usize>,
}

impl Worst {
    /// Sorts the tests: failures first, then by decreasing error. Tests without an error are omitted.
    pub fn sort(&mut self, results: &Results, by: By) {
        if self.of == Some(stamp(results, by)) {
            return;
        }
        self.of = Some(stamp(results, by));
        let badness = |k: &usize| match &results.tests[*k] {
            (test, _) if test.film.is_none() => Some(f64::INFINITY),
            tested => by.of(tested),
        };
        let mut rated: Vec<(usize, f64)> =
            (0..results.tests.len()).filter_map(|k| badness(&k).map(|error| (k, error))).collect();
        rated.sort_by(|a, b| b.1.total_cmp(&a.1));
        self.order = rated.into_iter().take(LISTED).map(|(k, _)| k).collect();
    }
}

/// Draws the list. Returns the chosen contact.
pub fn ui(ui: &mut Ui, worst: &Worst, results: &Results) -> Option<OperatingPoint> {
    let palette = Palette::of(ui);
    let mut wanted = None;
    ui.strong("Worst cases").on_hover_text("Failures first. Click on M and L to go to the contact");
    ScrollArea::vertical().id_salt("worst").auto_shrink(false).show(ui, |ui| {
        Grid::new("worst").num_columns(4).spacing([10.0, 3.0]).striped(true).show(ui, |ui| {
            for title in ["", "{M}, {L}", "Bound", "True Δ{H_c}"] {
                ui.label(rich(title, 12.0, palette.quiet));
            }
            ui.end_row();
            for (place, tested) in worst.order.iter().filter_map(|k| results.tests.get(*k)).enumerate() {
                let point = tested.0.point;
                let moes = point.moes();
                ui.weak((place + 1).to_string());
                let text = format!("{}, {}", numbers::digits(moes.m, 3), numbers::digits(moes.l, 3));
                let tip = format!(
                    "Go to this contact: {}, α {}/GPa (Ctrl+Z returns)",
                    numbers::moes(moes),
                    numbers::digits(point.alpha_per_pa * 1e9, 3)
                );
                let link = ui.link(text).on_hover_text(tip);
                if named(ui, link, &format!("Go to worst case {}", place + 1)).clicked() {
                    wanted = Some(point);
                }
                let error = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numbers::error_percent);
                if tested.0.film.is_some() {
                    ui.label(error(bound_of(tested)));
                    ui.label(error(error_of(tested)));
                } else {
                    ui.colored_label(palette.wrong, "failed");
                    ui.label("");
                }
                ui.end_row();
            }
        });
    });
    wanted
}
