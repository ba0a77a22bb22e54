//! Trust badge: a short statement of how far the picture can be trusted.

use crate::app::answers::jobs::JobKind;
use crate::app::answers::picture::{Comparison, Origin, Picture};
use crate::app::answers::{Answers, PassedOver};
use crate::app::context::Context;
use crate::app::controls::{described, named, sentence};
use crate::app::display::Thresholds;
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::engine::Warning;
use crate::solver::full::GridCost;
use crate::solver::reduced::ErrorEstimate;
use egui::{Align, Color32, CornerRadius, Frame, Label, Layout, Margin, RichText, Stroke, Ui, vec2};

/// Content of the badge.
pub struct Verdict {
    /// Title, in bold.
    pub title: String,
    /// Text after the title.
    pub detail: String,
    /// Explanation on hover.
    pub why: String,
    kind: Kind,
}

/// Degree of trust.
#[derive(Clone, Copy, PartialEq)]
pub enum Kind {
    /// Not determined yet.
    Neutral,
    /// Checked against the full solution.
    Verified,
    /// Usable with reservation.
    Warning,
    /// Not to be trusted.
    Wrong,
}

/// Returns the trust badge for the current picture.
pub fn verdict(answers: &Answers, thresholds: Thresholds) -> Verdict {
    let make = |title: &str, detail: String, why: String, kind| Verdict { title: title.to_owned(), detail, why, kind };
    if let Some(failure) = answers.failure() {
        let got = failure.report.as_ref().map_or_else(String::new, |r| {
            format!("{} Newton steps, residual {}", r.newton_iterations, numbers::digits(r.residual_norm, 2))
        });
        let (title, kind) =
            if failure.stopped { ("Cancelled", Kind::Neutral) } else { ("No solution here", Kind::Wrong) };
        return make(title, got, format!("{}. The last valid picture stays, in grey", failure.message), kind);
    }
    let Some(picture) = answers.picture() else {
        return make("Computing", String::new(), "The first picture is being computed".to_owned(), Kind::Neutral);
    };
    let waits = answers.runs(JobKind::Live);
    let full = match () {
        () if waits && !answers.picture_follows() => "full solve running".to_owned(),
        () if answers.picture_follows() && answers.is_quick() => format!("sketch on a quick grid{}", off(picture)),
        () => "full solution".to_owned(),
    };
    // The warnings of a picture that still belongs to another contact are not shown here.
    let warned = answers.shown_picture().map_or_else(String::new, Picture::warned);
    match (picture.origin, answers.passed_over()) {
        (_, Some(PassedOver::Outside(why))) => make(
            "Outside the trained range",
            format!("{full}: {why}"),
            format!("{warned}The picture is a converged full solution. The reduced model does not extrapolate"),
            Kind::Warning,
        ),
        (_, Some(PassedOver::Failed(why))) => make(
            "Reduced model failed",
            full,
            format!("{}. {warned}The full solver draws the picture instead", sentence(why).trim_end_matches('.')),
            Kind::Warning,
        ),
        (_, Some(PassedOver::Reading)) => make(
            "Reading the reduced model",
            full,
            "The reduced model of such contacts is being read. Until then the full solver draws the picture".to_owned(),
            Kind::Neutral,
        ),
        (origin, _) if !answers.picture_follows() => make(
            "Computing",
            if origin == Origin::Full { full } else { "reduced solve running".to_owned() },
            "The picture belongs to the previous position of the sliders".to_owned(),
            Kind::Neutral,
        ),
        (Origin::Full, _) if answers.is_quick() => make(
            "Quick grid",
            full,
            format!(
                "{warned}A converged full solution on {}, the grid that is used while a slider moves. Its errors are \
                 estimated from this grid alone. The chosen grid is used when the sliders are idle",
                grid(picture)
            ),
            if picture.grid_errors().is_some_and(|(_, h_min)| h_min <= thresholds.far_off) {
                Kind::Neutral
            } else {
                Kind::Warning
            },
        ),
        (Origin::Full, _) => match &picture.unresolved {
            Some(_) => {
                let title = if picture.costly_grid { "Grid insufficient" } else { "Side lobes unresolved" };
                make(title, format!("full solution on {}{}", grid(picture), off(picture)), warned, Kind::Warning)
            }
            // The warnings of a grid have the same limit for the error of H_c.
            None if picture.grid_errors().is_some_and(|(_, h_min)| h_min > COARSE) => make(
                "Roughly right",
                format!("full solution on {}{}", grid(picture), off(picture)),
                format!("{warned}A converged full solution on a coarse grid. A finer grid changes H_min"),
                Kind::Warning,
            ),
            None => make(
                "Verified",
                if picture.has_plane() { format!("full solution on {}{}", grid(picture), off(picture)) } else { full },
                format!(
                    "{warned}No reduced model is loaded for this contact. The picture is a converged full solution"
                ),
                Kind::Verified,
            ),
        },
        (Origin::Reduced { residual_estimate, error, iterations, window, by_neighbour }, _) => {
            let how = format!(
                "{iterations} reduced Newton steps in local model {}, residual e_f {}",
                window + 1,
                numbers::small(residual_estimate)
            );
            let grid_cost = picture.solution.grid_cost.map(GridCost::total).filter(|cost| cost.is_finite());
            match answers.comparison() {
                Some(c) if answers.full_is_current() => {
                    let (title, kind) = match judged(c, thresholds) {
                        (_, Kind::Verified) if picture.costly_grid => ("Grid insufficient", Kind::Warning),
                        judged => judged,
                    };
                    let grid_cost = grid_cost.filter(|cost| *cost > thresholds.far_off);
                    let why = format!(
                        "True errors against a full solution on the same grid. {warned}{}{how}",
                        promised(c, error)
                    );
                    make(title, with_grid(c.describe(), grid_cost), why, kind)
                }
                _ => {
                    let neighbour = Warning::NeighbouringModel.to_string();
                    let (detail, meaning) = match error {
                        Some(e) => (
                            format!(
                                "{{H_c}} within {}, {{H_min}} within {}",
                                numbers::error_percent(e.h_c.bound),
                                numbers::error_percent(e.h_min.bound)
                            ),
                            "99 % empirical error bounds: 99 of 100 random contacts of the trained range have smaller \
                             errors against a full solution on the same grid",
                        ),
                        None if by_neighbour => {
                            ("no error bound: a neighbouring local model is used".to_owned(), neighbour.as_str())
                        }
                        None => (
                            format!("no error bound, residual {{e_f}} {}", numbers::small(residual_estimate)),
                            "The model was not calibrated for the present options (fewer modes, or an older training). \
                             e_f of (3.15) is the residual of the reduced equations, not the error of the film \
                             thickness",
                        ),
                    };
                    let next = match answers.verify_failure() {
                        Some(failure) => failure.message.trim_end_matches('.'),
                        None => "The full solve will show the true errors",
                    };
                    let doubtful = answers.verify_failure().is_some() || picture.costly_grid || by_neighbour;
                    let kind = if doubtful { Kind::Warning } else { Kind::Neutral };
                    make(
                        "Reduced model",
                        with_grid(detail, grid_cost),
                        format!("{} {warned}{next}. {how}", sentence(meaning)),
                        kind,
                    )
                }
            }
        }
    }
}

/// Estimated error of H_min above which a grid is called coarse.
const COARSE: f64 = 0.03;

/// Returns the errors of a model together with the discretisation error.
fn with_grid(errors: String, cost: Option<f64>) -> String {
    match cost {
        Some(cost) => format!("{errors}; discretisation error of {{H_c}} {}", numbers::error_percent(cost)),
        None => errors,
    }
}

/// Returns title and trust for a picture whose true errors are known. The larger error of H_c and H_min decides.
fn judged(truth: &Comparison, thresholds: Thresholds) -> (&'static str, Kind) {
    match truth.h_c.abs().max(truth.h_min.abs()) {
        error if error <= thresholds.verified => ("Verified", Kind::Verified),
        error if error <= thresholds.far_off => ("Roughly right", Kind::Warning),
        _ => ("Far off", Kind::Wrong),
    }
}

/// Returns the size of a point contact's grid as text.
fn grid(picture: &Picture) -> String {
    format!("{}×{} nodes", picture.solution.x.len(), picture.solution.y.len())
}

/// Returns the discretisation errors of a full solution as part of a sentence, with symbols in braces.
fn off(picture: &Picture) -> String {
    let Some((h_c, h_min)) = picture.grid_errors() else { return String::new() };
    if h_c.is_nan() {
        return ", its error is unknown".to_owned();
    }
    let [h_c, h_min] = [h_c, h_min].map(numbers::error_percent);
    format!(", error of {{H_c}} about {h_c}, of {{H_min}} {h_min}")
}

/// Returns whether the true errors lie within the error bounds shown before.
fn promised(truth: &Comparison, error: Option<ErrorEstimate>) -> String {
    let Some(e) = error else { return String::new() };
    let held = truth.h_c.abs() <= e.h_c.bound && truth.h_min.abs() <= e.h_min.bound;
    let (h_c, h_min) = (numbers::error_percent(e.h_c.bound), numbers::error_percent(e.h_min.bound));
    format!("The bounds shown before, {h_c} and {h_min}, {}. ", if held { "held" } else { "did not hold" })
}

/// Height of the badge's row. It is constant so that nothing below moves.
const HEIGHT: f32 = 26.0;

/// Draws the badge in a separate row, followed by a note if the picture belongs to another contact than the
/// sliders.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let verdict = verdict(context.answers, context.thresholds);
    let other = context.answers.picture().filter(|picture| picture.key != context.document.key());
    let row = vec2(ui.available_width(), HEIGHT);
    ui.allocate_ui_with_layout(row, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(row);
        pill(ui, verdict.kind, [&verdict.title, &verdict.detail, &verdict.why], "Trust in the picture");
        if let Some(picture) = other {
            let of = numbers::contact(&picture.key.point);
            let color = Palette::of(ui).warning;
            let note = RichText::new(format!("Grey: the picture belongs to {of}")).small().color(color);
            ui.add(Label::new(note).truncate());
        }
    });
}

/// Draws a badge from its title, text and explanation. `name` is its accessible name.
pub fn pill(ui: &mut Ui, kind: Kind, [title, detail, why]: [&str; 3], name: &str) {
    let palette = Palette::of(ui);
    let color = match kind {
        Kind::Neutral => palette.quiet,
        Kind::Verified => palette.verified,
        Kind::Warning => palette.warning,
        Kind::Wrong => palette.wrong,
    };
    let fill = color.gamma_multiply(if ui.visuals().dark_mode { 0.22 } else { 0.13 });
    let ink = palette.ink_on(color, ui.visuals().panel_fill.blend(fill));
    let frame = Frame::new()
        .fill(fill)
        .stroke(Stroke::new(1.0, color.gamma_multiply(0.6)))
        .corner_radius(CornerRadius::same(10))
        .inner_margin(Margin::symmetric(10, 2));
    // In a layout with a single row the text is truncated. Elsewhere the badge wraps to the next row.
    let wraps = ui.layout().main_wrap;
    let response = frame
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            ui.label(RichText::new(title).strong().color(ink));
            if !detail.is_empty() {
                let plain: Color32 = ui.visuals().text_color();
                let label = Label::new(rich(detail, 13.0, plain));
                ui.add(if wraps { label.extend() } else { label.truncate() });
            }
        })
        .response;
    let response = described(ui, named(ui, response, name), &sentence(why));
    response.on_hover_text(sentence(why));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::answers::picture::Cuts;

    #[test]
    fn the_word_follows_the_larger_error_of_both_films() {
        let truth = |h_c, h_min| Comparison {
            h_c,
            h_min,
            traction: None,
            max_dp: 0.0,
            cuts: Cuts::default(),
            pressure: Vec::new(),
            film: Vec::new(),
        };
        for ((h_c, h_min), word) in
            [((1e-5, -1e-4), "Verified"), ((1e-5, -5e-3), "Roughly right"), ((0.02, 0.0), "Far off")]
        {
            assert_eq!(judged(&truth(h_c, h_min), Thresholds::default()).0, word, "{h_c} {h_min}");
        }
        let strict = Thresholds { verified: 5e-5, far_off: 9e-5 };
        assert_eq!(judged(&truth(1e-5, -1e-4), strict).0, "Far off");
    }
}
