//! Trust badge of the transient contact: live by models, checked against the full solution, or not available yet.

use super::runs::TransientRuns;
use crate::app::badge::{Kind, pill};
use crate::app::context::Context;
use crate::app::display::Thresholds;
use crate::app::numbers;
use crate::app::tabs::transient::Run;
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::Ended;
use egui::Ui;

/// Maximum width.
const WIDTH: f32 = 300.0;

/// Title, text after it, and explanation.
struct Verdict {
    kind: Kind,
    title: &'static str,
    detail: String,
    why: &'static str,
}

/// Draws the badge of the transient contact.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let Verdict { kind, title, detail, why } = verdict(context.transient, context.thresholds);
    if ui.available_size_before_wrap().x < WIDTH {
        ui.end_row();
    }
    let runs = &context.transient.runs;
    let grid = runs.iter().find_map(|run| run.grid_cost).map_or_else(String::new, |(_, cost)| {
        format!(". Discretisation error of H_c: {}", numbers::error_percent(cost.total()))
    });
    let steps = runs.iter().filter_map(|run| run.trajectory.step_error).reduce(f64::max);
    let steps = steps
        .map_or_else(String::new, |error| format!(". Time-step error of H_c: about {}", numbers::error_percent(error)));
    pill(ui, kind, [title, &detail, &format!("{why}{grid}{steps}")], "Trust in the transient contact");
}

fn verdict(view: &TransientRuns, thresholds: Thresholds) -> Verdict {
    let make = |kind, title, detail: String, why| Verdict { kind, title, detail, why };
    let live = view.runs.iter().any(|run| run.replayed);
    let standing = view.work.standing();
    let done = standing.as_ref().map_or_else(String::new, |standing| {
        let percent = (100 * standing.done).checked_div(standing.total).unwrap_or(0);
        match standing.stage.as_str() {
            stage if stage.starts_with("full system") => format!("full system {percent}{}%", numbers::THIN),
            "error of the time step" => format!("error of the time step {percent}{}%", numbers::THIN),
            _ => "models are being trained".to_owned(),
        }
    });
    if live && view.is_current() {
        let why =
            "Models trained for previous inputs replay at once; the full system checks them when the sliders are idle";
        let detail = if done.is_empty() { errors(view) } else { done };
        return make(Kind::Neutral, "Live", detail, why);
    }
    if standing.is_some() || view.waits() {
        return make(Kind::Neutral, "Running", done, "The full system first, then the models that it trains");
    }
    if view.runs.is_empty() {
        return make(Kind::Neutral, "Not run yet", String::new(), "Press Run transient: it takes more than a moment");
    }
    if !view.is_current() {
        let why = "It takes more than a moment: press Run transient for the present set-up";
        return make(Kind::Warning, "Previous set-up", String::new(), why);
    }
    if view.runs.iter().any(|run| run.trajectory.ended != Ended::Finished) {
        return make(Kind::Warning, "Ended early", String::new(), "A run has not reached the end of its duration");
    }
    let warned = view.runs.iter().filter(|run| run.trajectory.step_warning().is_some());
    if let Some(error) = warned.filter_map(|run| run.trajectory.step_error).reduce(f64::max) {
        let why = "Shorter steps change H_c noticeably. Choose shorter steps or a tolerance for their error in Set-up, \
                   Steps";
        return make(Kind::Warning, "Steps too long", format!("H_c ±{}", numbers::error_percent(error)), why);
    }
    let why = "Maximum relative difference of H_c from the full run";
    let models = view.runs.iter().filter(|run| run.by != MarchedBy::Full);
    match models.filter_map(|run| run.difference).reduce(f64::max) {
        None => make(Kind::Verified, "Full", String::new(), "All runs are full solutions"),
        Some(worst) if worst <= thresholds.verified => make(Kind::Verified, "Checked", errors(view), why),
        Some(worst) if worst <= thresholds.far_off => make(Kind::Warning, "Roughly right", errors(view), why),
        Some(_) => make(Kind::Wrong, "Far off", errors(view), why),
    }
}

/// Returns the errors of the models as far as they are available.
fn errors(view: &TransientRuns) -> String {
    let said = |run: &Run| {
        let name = match run.by {
            MarchedBy::Full => return None,
            MarchedBy::Reduced => "reduced",
            MarchedBy::Linearised(_) => "linearised",
        };
        Some(format!("{name} {}", numbers::error_percent(run.difference?)))
    };
    view.runs.iter().filter_map(said).collect::<Vec<_>>().join(", ")
}
