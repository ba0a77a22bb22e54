//! Status strip: running jobs, their progress, Cancel, and the time per solve.

use crate::app::answers::jobs::Running;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{named, sentence};
use crate::app::desk::Desk;
use crate::app::numbers;
use crate::app::theme::Palette;
use egui::{Align, Button, Layout, RichText, Ui};

/// Age from which a job is shown \[s\]. Shorter jobs would only flicker.
const NEWS_S: f64 = 0.12;

/// Draws the strip at the bottom.
pub fn ui(ui: &mut Ui, desk: &Desk, frame_s: f64, commands: &mut Commands) {
    ui.horizontal(|ui| {
        let usual = desk.answers.full_times().median_s();
        let solves = desk.answers.running().iter().map(|job| (job.since.elapsed().as_secs_f64(), job));
        let solves = solves.filter(|(since_s, _)| *since_s > NEWS_S).map(|(_, job)| solve(job, usual));
        let (works, young): (Vec<_>, Vec<_>) = desk.works().into_iter().partition(|work| work.since_s > NEWS_S);
        if let Some(work) = young.first() {
            ui.ctx().request_repaint_after_secs((NEWS_S - work.since_s) as f32);
        }
        let all: Vec<[String; 2]> =
            solves.chain(works.iter().map(|work| [sentence(&work.stage), numbers::standing(work)])).collect();
        // The button has a fixed place.
        let cancel = ui.add_enabled(!all.is_empty(), Button::new("Cancel").small());
        let cancel = cancel.on_hover_text("Stops everything that runs (Esc)").on_disabled_hover_text("Nothing runs");
        if named(ui, cancel, "Cancel what runs").clicked() {
            commands.push(Command::Cancel);
        }
        match &all[..] {
            [[name, standing], more @ ..] => {
                ui.label(name.trim_end_matches('.'));
                ui.weak(standing);
                if !more.is_empty() {
                    let more: Vec<String> = more.iter().map(|[name, standing]| format!("{name} {standing}")).collect();
                    ui.weak(format!("and {} more", more.len())).on_hover_text(more.join("\n"));
                }
            }
            [] => {
                let idle = ui.weak("Ready");
                if let Some(failure) = desk.answers.failure().or(desk.answers.verify_failure()) {
                    let color = Palette::of(ui).wrong;
                    ui.label(RichText::new(&failure.message).small().color(color));
                } else {
                    idle.on_hover_text("Nothing runs");
                }
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let (full, reduced) = (desk.answers.full_times(), desk.answers.reduced_times());
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

/// Returns the purpose of a full solve, its progress, and its remaining time based on the last solves.
fn solve(job: &Running, usual_s: Option<f64>) -> [String; 2] {
    let since_s = job.since.elapsed().as_secs_f64();
    let walk = job.walk.as_ref().map(ToString::to_string);
    let step = job
        .steps
        .last()
        .map(|step| format!("Newton step {}, residual {}", step.iteration, numbers::digits(step.residual, 2)));
    let inner = (job.krylov > 0).then(|| format!("Krylov iteration {}", job.krylov));
    let left_s = usual_s.map(|usual_s| usual_s - since_s).filter(|left_s| *left_s >= 1.0);
    let time = left_s
        .map_or_else(|| numbers::duration(since_s), |left_s| format!("about {} left", numbers::remaining(left_s)));
    [job.kind.name().to_owned(), walk.into_iter().chain(step).chain(inner).chain([time]).collect::<Vec<_>>().join(", ")]
}
