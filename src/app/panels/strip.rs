//! The jobs strip: what runs, how far it is, Cancel; and what a solve costs.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::named;
use crate::app::desk::Desk;
use crate::app::numbers;
use crate::app::theme::Palette;
use egui::{Align, Button, Layout, RichText, Ui};

/// Work younger than this is no news: showing it would only flicker.
const NEWS_S: f64 = 0.12;

/// The strip at the bottom.
pub fn ui(ui: &mut Ui, desk: &Desk, frame_s: f64, commands: &mut Commands) {
    ui.horizontal(|ui| {
        let slow = desk.answers.jobs.running().iter().find(|j| j.since.elapsed().as_secs_f64() > NEWS_S);
        let study = desk.study().filter(|standing| standing.since_s > NEWS_S);
        // At a place of its own, whatever stands beside it.
        let runs = slow.is_some() || study.is_some();
        let cancel = ui.add_enabled(runs, Button::new("Cancel").small()).on_disabled_hover_text("Nothing runs");
        if named(ui, cancel, "Cancel what runs").clicked() {
            commands.push(Command::Cancel);
        }
        match (slow, study) {
            (Some(job), _) => {
                ui.label(job.kind.name());
                let mut step = job.steps.last().map_or_else(String::new, |s| {
                    format!("Newton step {}, residual {}", s.iteration, numbers::digits(s.residual, 2))
                });
                if job.krylov > 0 {
                    step = format!("{step}, Krylov iteration {}", job.krylov);
                }
                ui.weak(step.trim_start_matches(", "));
                ui.weak(numbers::duration(job.since.elapsed().as_secs_f64()));
            }
            (None, Some(standing)) => {
                ui.label(&standing.stage);
                ui.weak(numbers::standing(&standing));
            }
            (None, None) => {
                let idle = ui.weak("Ready");
                if let Some(failure) = desk.answers.failure.as_ref().or(desk.answers.verify_failure.as_ref()) {
                    let color = Palette::of(ui).wrong;
                    ui.label(RichText::new(&failure.message).small().color(color));
                } else {
                    idle.on_hover_text("Nothing runs");
                }
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let (full, reduced) = (&desk.answers.full_times, &desk.answers.reduced_times);
            let time = |seconds: Option<f64>| seconds.map_or_else(|| "–".to_owned(), numbers::duration);
            ui.weak(format!("full {}", time(full.median_s()))).on_hover_text(format!(
                "Median of the last {} full solves. Drawing the window takes {}",
                full.len(),
                numbers::duration(frame_s)
            ));
            if desk.model().is_some() {
                ui.weak(format!("reduced {}", time(reduced.median_s())))
                    .on_hover_text(format!("Median of the last {} reduced solves", reduced.len()));
            }
            ui.weak("Median time per solve");
        });
    });
}
