//! Read-outs below the plots: the results of the contact, and their differences from the last pinned curve.

use crate::app::answers::picture::Picture;
use crate::app::badge::verdict;
use crate::app::context::Context;
use crate::app::controls::sentence;
use crate::app::document::Document;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::theme::{Palette, symbol};
use crate::solver::full::Lubrication;
use crate::solver::physics::bodies::film_regime;
use crate::solver::physics::engineering::{Extent, Losses, QuantityKind};
use egui::text::LayoutJob;
use egui::{Color32, FontId, RichText, TextStyle, Ui};
use std::borrow::Cow;
use std::sync::Arc;

/// Draws the read-outs.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let (answers, document) = (context.answers, context.document);
    let Some(picture) = answers.picture() else {
        ui.weak("The first picture is being computed");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "read-outs", Owner::Contact(picture.key), context);
    let pin = answers.pins().last();
    let palette = Palette::of(ui);
    let scalars = |p: &Picture| p.solution.scalars;
    let delta = |f: &dyn Fn(&Picture) -> f64| pin.map(|pin| f(picture) / f(&pin.picture) - 1.0);
    let s = scalars(picture);
    // Show the discretisation error only next to the value that it was estimated for.
    let shown_is_full = answers.full().is_some_and(|full| Arc::ptr_eq(&full.solution, &picture.solution));
    let grid_error = answers.grid_error().filter(|_| shown_is_full).map(|error| error.accuracy);
    let off = |error: Option<f64>| error.map_or_else(String::new, |e| format!(" ±{}", numbers::error_percent(e)));
    let mut cells = vec![
        Cell {
            name: symbol(ui, "H", "c"),
            value: numbers::significant(s.h_c) + &off(grid_error.map(|e| e.h_c_error)),
            unit: numbers::length(picture.central_film_m(), context.system),
            color: palette.film,
            delta: delta(&|p| p.central_film_m()),
            tip:
                "Central film thickness, H = hR/a² at X = 0 (2.22). ± is the discretisation error, if it was estimated"
                    .into(),
        },
        Cell {
            name: symbol(ui, "H", "min"),
            value: numbers::significant(s.h_min) + &off(grid_error.map(|e| e.h_min_error)),
            unit: numbers::length(picture.minimum_film_m(), context.system),
            color: palette.film,
            delta: delta(&|p| p.minimum_film_m()),
            tip: "Minimum film thickness of the contact zone; in a heavily loaded point contact it occurs in the side \
                  lobes"
                .into(),
        },
        Cell {
            name: symbol(ui, "P", "max"),
            value: numbers::significant(s.p_max),
            unit: numbers::pressure(picture.largest_pressure_pa(), context.system),
            color: palette.pressure,
            delta: delta(&|p| p.largest_pressure_pa()),
            tip: "Maximum pressure, P = p/p_H (2.22)".into(),
        },
    ];
    cells.extend(film_ratio(ui, picture, document, &palette));
    cells.extend(friction(ui, (picture, context), delta(&|p| p.traction), &palette));
    ui.scope(|ui| {
        if stale {
            ui.disable();
        }
        cells_ui(ui, cells);
    });
}

/// Returns the traction coefficient with its change from the last pinned curve, and the friction force with the power
/// loss.
fn friction(
    ui: &Ui,
    (picture, context): (&Picture, &Context<'_>),
    traction_change: Option<f64>,
    palette: &Palette,
) -> Vec<Cell> {
    let (srr, doubt) = (picture.key.point.sliding.slide_to_roll_ratio, picture.unphysical);
    let tip = "Traction coefficient (3.41): the shear stress at mid-film over the whole domain, over the load. Zero in \
               pure rolling";
    let mut cells = vec![Cell {
        name: symbol(ui, "µ", ""),
        value: numbers::significant(picture.traction),
        unit: format!(
            "at SRR {}{}",
            numbers::slide_to_roll(srr),
            doubt.map_or_else(String::new, |why| format!(", {}", why.mark()))
        ),
        color: if doubt.is_some() { palette.reference } else { palette.traction },
        delta: traction_change.filter(|delta| delta.is_finite() && doubt.is_none()),
        tip: doubt.map_or_else(|| tip.to_owned(), |why| sentence(&why.to_string())).into(),
    }];
    let point = &picture.key.point;
    let own = context.document.extent();
    let whole = point.kind.is_point() || own.length_m.is_some();
    // Without a length the values of a line contact are per length.
    let extent = Extent { length_m: own.length_m.or(Some(1.0)), ..own };
    let losses = Losses::of(point, picture.traction, picture.solution.rolling_resistance(), &extent);
    if let Some(losses) = losses.filter(|losses| doubt.is_none() && losses.friction_n != 0.0) {
        let kinds = match whole {
            true => [QuantityKind::Force, QuantityKind::Power],
            false => [QuantityKind::LineLoad, QuantityKind::PowerPerLength],
        };
        let [force, power] = kinds.map(|kind| move |si: f64| numbers::in_field_unit(kind, si, context.system));
        let torques = losses.torques_nm.iter().flatten().filter(|_| whole);
        let torque = |si: &f64| numbers::in_field_unit(QuantityKind::Torque, *si, context.system);
        let torques: Vec<String> = torques.map(torque).collect();
        let torques = match torques.as_slice() {
            [] => String::new(),
            torques => format!("; torques of the bodies {}", torques.join(", ")),
        };
        let tip = format!(
            "Friction force F = µw, and the power loss F SRR u_m + 2 F_r u_m with the rolling resistance F_r = {} of \
             each body{torques}",
            force(losses.rolling_n)
        );
        let unit = kinds[0].unit(context.system);
        cells.push(Cell {
            name: symbol(ui, "F", ""),
            value: numbers::significant(unit.number(losses.friction_n)),
            unit: format!("{}, {} lost", unit.name, power(losses.power_w)),
            color: palette.traction,
            delta: None,
            tip: tip.into(),
        });
    }
    cells
}

/// Returns the film ratio if a roughness was entered: with the regime by the load that asperities carry, or by the limits
/// of handbooks if they are not computed.
fn film_ratio(ui: &Ui, picture: &Picture, document: &Document, palette: &Palette) -> Option<Cell> {
    let lambda = picture.minimum_film_m() / document.composite_roughness_m();
    if !document.has_surfaces() || !lambda.is_finite() {
        return None;
    }
    let regime = match picture.mixed {
        Some(mixed) => {
            let share = mixed.asperity_load_share;
            format!("{}, asperities {}", Lubrication::of(share).name(), numbers::share(share))
        }
        None => film_regime(lambda).to_owned(),
    };
    let tip = match picture.mixed {
        Some(_) => {
            "Film ratio λ = h_min/σ, σ = √(Rq₁² + Rq₂²), and the share of the load that asperities carry. λ is negative \
             if asperities are compressed below the mean planes"
        }
        None => "Film ratio λ = h_min/√(Rq₁² + Rq₂²). Mixed lubrication in Surfaces computes what asperities carry",
    };
    let value = numbers::digits(lambda, 3);
    Some(Cell { name: symbol(ui, "λ", ""), value, unit: regime, color: palette.film, delta: None, tip: tip.into() })
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
        numbers::length(picture.central_film_m(), context.system),
        numbers::length(picture.minimum_film_m(), context.system),
        numbers::pressure(picture.largest_pressure_pa(), context.system),
        numbers::significant(picture.traction),
    ))
}

/// Read-out: a symbol, its value, and the value in SI units.
pub(super) struct Cell {
    pub(super) name: LayoutJob,
    pub(super) value: String,
    pub(super) unit: String,
    pub(super) color: Color32,
    /// Relative difference from the last pinned curve.
    pub(super) delta: Option<f64>,
    pub(super) tip: Cow<'static, str>,
}

/// Space between the parts of a read-out, and between read-outs.
const WITHIN: f32 = 7.0;
const APART: f32 = 26.0;
/// Font size of values.
const VALUE: f32 = 16.0;

/// Draws read-outs in as many rows as they need.
pub(super) fn cells_ui(ui: &mut Ui, cells: Vec<Cell>) {
    let room = ui.available_width();
    let mut rows: Vec<(f32, Vec<Cell>)> = Vec::new();
    for cell in cells {
        let width = cell.width(ui);
        match rows.last_mut() {
            Some((used, row)) if *used + APART + width <= room => {
                *used += APART + width;
                row.push(cell);
            }
            _ => rows.push((width, vec![cell])),
        }
    }
    for (_, row) in rows {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = APART;
            row.into_iter().for_each(|cell| cell.ui(ui));
        });
    }
}

impl Cell {
    fn width(&self, ui: &Ui) -> f32 {
        let body = TextStyle::Body.resolve(ui.style());
        let small = TextStyle::Small.resolve(ui.style());
        let plain = |text: String, font: FontId| ui.painter().layout_no_wrap(text, font, Color32::PLACEHOLDER).size().x;
        let name = ui.painter().layout_job(self.name.clone()).size().x;
        let value = plain(self.value.clone(), FontId { size: VALUE, ..body.clone() });
        let delta = self.delta.map_or(0.0, |delta| WITHIN + plain(change(delta), small));
        name + value + plain(self.unit.clone(), body) + delta + 2.0 * WITHIN
    }

    fn ui(self, ui: &mut Ui) {
        let Self { name, value, unit, color, delta, tip } = self;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = WITHIN;
            ui.label(name).on_hover_text(&*tip);
            let value = RichText::new(value).size(VALUE).strong().color(Palette::of(ui).ink(color));
            ui.label(value).on_hover_text(&*tip);
            ui.label(RichText::new(unit)).on_hover_text(&*tip);
            if let Some(delta) = delta {
                ui.label(RichText::new(change(delta)).small().weak())
                    .on_hover_text("Relative to the last pinned curve, in SI units");
            }
        });
    }
}

fn change(relative: f64) -> String {
    format!("Δ {}", numbers::percent(relative))
}
