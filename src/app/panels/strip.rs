//! The jobs strip: what runs, how far it is, Cancel; and what a solve costs.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::desk::Desk;
use crate::app::numbers;
use crate::app::theme::Palette;
use egui::{Align, Layout, RichText, Ui};

/// Work younger than this is no news: showing it would only flicker.
const NEWS_S: f64 = 0.12;

/// The strip at the bottom.
pub fn ui(ui: &mut Ui, desk: &Desk, frame_s: f64, commands: &mut Commands) {
    ui.horizontal(|ui| {
        let slow = desk.answers.jobs.running().iter().find(|j| j.since.elapsed().as_secs_f64() > NEWS_S);
        let study = desk.study().filter(|standing| standing.since_s > NEWS_S);
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
                if ui.small_button("Cancel").clicked() {
                    commands.push(Command::Cancel);
                }
            }
            (None, Some(standing)) => {
                ui.label(&standing.stage);
                ui.weak(numbers::standing(&standing));
                if ui.small_button("Cancel").clicked() {
                    commands.push(Command::Cancel);
                }
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
            let time = |seconds: Option<f64>| seconds.map_or_else(|| "–".to_owned(), numbers::duration);
            ui.weak(format!("full {}", time(desk.answers.full_wall_s))).on_hover_text(format!(
                "Time of the last full solve. Drawing the window takes {}",
                numbers::duration(frame_s)
            ));
            if desk.model().is_some() {
                ui.weak(format!("reduced {}", time(desk.answers.reduced_wall_s)))
                    .on_hover_text("Time of the last reduced solve");
            }
            ui.weak("Time per solve");
        });
    });
}
