//! Read-outs below the plots: the results of the contact, and their differences from the last pinned curve.

use crate::app::answers::picture::Picture;
use crate::app::badge::verdict;
use crate::app::context::Context;
use crate::app::controls::sentence;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::theme::{Palette, symbol};
use crate::solver::physics::bodies::film_regime;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{Extent, Losses};
use egui::text::LayoutJob;
use egui::{RichText, Ui};
use std::sync::Arc;

/// Draws the read-outs.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let (answers, document) = (context.answers, context.document);
    let bodies = document.view.bodies.as_ref();
    let Some(picture) = answers.picture() else {
        ui.weak("The first picture is being computed");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "read-outs", Owner::Contact(picture.key), context);
    let pin = answers.pins().last();
    let palette = Palette::of(ui);
    let srr = picture.key.point.sliding.slide_to_roll_ratio;
    let scalars = |p: &Picture| p.solution.scalars;
    let delta = |f: &dyn Fn(&Picture) -> f64| pin.map(|pin| f(picture) / f(&pin.picture) - 1.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 26.0;
        if stale {
            ui.disable();
        }
        let s = scalars(picture);
        // Show the discretisation error only next to the value that it was estimated for.
        let shown_is_full = answers.full().is_some_and(|full| Arc::ptr_eq(&full.solution, &picture.solution));
        let grid_error = answers.grid_error().filter(|_| shown_is_full).map(|error| error.accuracy);
        let doubt = picture.unphysical;
        let unphysical = doubt.is_some();
        let traction_tip = "Traction coefficient (3.41): the shear stress at mid-film over the whole domain, over the \
                            load. Zero in pure rolling";
        let traction_tip = doubt.map_or_else(|| traction_tip.to_owned(), |why| sentence(&why.to_string()));
        let traction_delta = delta(&|p| p.traction).filter(|delta| delta.is_finite() && !unphysical);
        let off = |error: Option<f64>| error.map_or_else(String::new, |e| format!(" ±{}", numbers::error_percent(e)));
        cell(
            ui,
            symbol(ui, "H", "c"),
            numbers::significant(s.h_c) + &off(grid_error.map(|e| e.h_c_error)),
            numbers::length(picture.central_film_m()),
            palette.film,
            delta(&|p| p.central_film_m()),
            "Central film thickness, H = hR/a² at X = 0 (2.22). ± is the discretisation error, if it was estimated",
        );
        cell(
            ui,
            symbol(ui, "H", "min"),
            numbers::significant(s.h_min) + &off(grid_error.map(|e| e.h_min_error)),
            numbers::length(picture.minimum_film_m()),
            palette.film,
            delta(&|p| p.minimum_film_m()),
            "Minimum film thickness of the contact zone; in a heavily loaded point contact it occurs in the side lobes",
        );
        cell(
            ui,
            symbol(ui, "P", "max"),
            numbers::significant(s.p_max),
            numbers::pressure(picture.largest_pressure_pa()),
            palette.pressure,
            delta(&|p| p.largest_pressure_pa()),
            "Maximum pressure, P = p/p_H (2.22)",
        );
        cell(
            ui,
            symbol(ui, "µ", ""),
            numbers::significant(picture.traction),
            format!(
                "at SRR {}{}",
                numbers::digits(srr, 3),
                doubt.map_or_else(String::new, |why| format!(", {}", why.mark()))
            ),
            if unphysical { palette.reference } else { palette.traction },
            traction_delta,
            &traction_tip,
        );
        let point = &picture.key.point;
        // Without a length the values of a line contact are per mm.
        let own = document.extent();
        let whole = point.kind == ContactKind::Point || own.length_m.is_some();
        let extent = Extent { length_m: own.length_m.or(Some(1e-3)), ..own };
        let losses = Losses::of(point, picture.traction, picture.solution.rolling_resistance(), &extent);
        if let Some(losses) = losses.filter(|_| !unphysical) {
            let per = if whole { "" } else { "/mm" };
            let torques: Vec<String> = losses.torques_nm.iter().flatten().map(|t| numbers::digits(*t, 3)).collect();
            let torques = match torques.as_slice() {
                [] => String::new(),
                torques => format!("; torques of the bodies {} N m{per}", torques.join(", ")),
            };
            cell(
                ui,
                symbol(ui, "F", ""),
                numbers::significant(losses.friction_n),
                format!("N{per}, {} W{per} lost", numbers::digits(losses.power_w, 3)),
                palette.traction,
                None,
                &format!(
                    "Friction force F = µw, and the power loss F SRR u_m + 2 F_r u_m with the rolling resistance F_r = {} \
                     N{per} of each body{torques}",
                    numbers::digits(losses.rolling_n, 3)
                ),
            );
        }
        if let Some(lambda) = bodies.and_then(|bodies| bodies.film_ratio(picture.minimum_film_m()).ok()) {
            cell(
                ui,
                symbol(ui, "λ", ""),
                numbers::digits(lambda, 3),
                film_regime(lambda).to_owned(),
                palette.film,
                None,
                "Film ratio λ = h_min/√(Rq₁² + Rq₂²) of the bodies’ roughness",
            );
        }
    });
}

/// Returns badge and read-outs as text for screen readers. `None` while the picture follows a change.
pub fn spoken(context: &Context<'_>) -> Option<String> {
    let answers = context.answers;
    let verdict = verdict(answers, context.thresholds);
    // Remove the markup of symbols.
    let badge = format!("{} {}.", verdict.title, verdict.detail).replace(['{', '}'], "");
    let Some(picture) = answers.current_picture() else { return answers.failure().map(|_| badge) };
    Some(format!(
        "{badge} Central film thickness {}, minimum film thickness {}, maximum pressure {}, traction coefficient {}.",
        numbers::length(picture.central_film_m()),
        numbers::length(picture.minimum_film_m()),
        numbers::pressure(picture.largest_pressure_pa()),
        numbers::significant(picture.traction),
    ))
}

/// Draws a symbol, its value, and the value in SI units.
pub(super) fn cell(
    ui: &mut Ui,
    name: LayoutJob,
    value: String,
    unit: String,
    color: egui::Color32,
    delta: Option<f64>,
    tip: &str,
) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 7.0;
        ui.label(name).on_hover_text(tip);
        ui.label(RichText::new(value).size(16.0).strong().color(Palette::of(ui).ink(color))).on_hover_text(tip);
        ui.label(RichText::new(unit)).on_hover_text(tip);
        if let Some(delta) = delta {
            ui.label(RichText::new(format!("Δ {}", numbers::percent(delta))).small().weak())
                .on_hover_text("Relative to the last pinned curve, in SI units");
        }
    });
}
