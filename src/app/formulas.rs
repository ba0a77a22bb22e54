//! Comparison of the contact's film thickness with published formulas.

use crate::app::context::{Commands, Context};
use crate::app::controls::warning_ui;
use crate::app::document::Edit;
use crate::app::export::describe_contact;
use crate::app::numbers;
use crate::app::panels::lubricant::GROUP;
use crate::app::theme::symbol;
use crate::engine::Table;
use crate::scene::named_lubricant::NAMED;
use crate::solver::full::{Problem, Solution};
use crate::solver::physics::contact::{FilmFormula, OperatingPoint};
use crate::solver::physics::lubricant::{DensityLaw, HeatReduction, Lubricant, ShearLaw, ViscosityLaw};
use egui::{Grid, RichText, Ui};

/// Returns the comparison as CSV.
pub fn csv(context: &Context<'_>) -> String {
    let picture = context.answers.shown_picture();
    let point = &context.document.point;
    let mut sources = Vec::new();
    let mut table = Table::new("formulas", &["film_m", "own_film_m", "deviation", "in_range"]);
    for &formula in FilmFormula::of(point.kind) {
        let prediction = formula.predict(point);
        let minimum = formula.predicts_minimum();
        let own = picture.map_or(f64::NAN, |p| if minimum { p.minimum_film_m() } else { p.central_film_m() });
        let which = if minimum { "h_min" } else { "h_c" };
        table.labels.push(format!("{which} by {}", formula.name()));
        table.rows.push(vec![
            prediction.film_m,
            own,
            prediction.film_m / own - 1.0,
            f64::from(u8::from(prediction.in_range)),
        ]);
        sources.push(formula.source().to_owned());
    }
    for (by, _, film, in_range) in reduced(point, &context.document.lubricant) {
        let own = picture.map_or(f64::NAN, |p| p.central_film_m());
        table.labels.push(format!("h_c by Moes, thinned by {}", by.name()));
        table.rows.push(vec![film, own, film / own - 1.0, f64::from(u8::from(in_range))]);
        sources.push(by.source().to_owned());
    }
    table.remarks = vec![("remark", sources)];
    format!("# {}\n{}", describe_contact(point, &context.document.lubricant), table.to_csv())
}

/// Name of the lubricant to which Moes' formula was fitted.
const FITTED: &str = "barus-oil";

/// Draws the table under its title, and below it why the formulas deviate from this contact.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    ui.strong("Film thickness by published formulas");
    table(ui, context);
    // Above the sentences, so that it does not move when a result changes them.
    let fitted = NAMED.iter().find(|named| named.name == FITTED);
    let own = context.document.lubricant;
    let other = fitted.filter(|named| {
        let laws = named.laws;
        own.density != laws.density || own.viscosity != laws.viscosity || own.shear != laws.shear
    });
    if let Some(fitted) = other {
        let tip = "Selects an incompressible oil with Barus’ law, to which Moes’ formula was fitted, for this contact. \
                   Undo restores your oil";
        if ui.button("Use the fluid of the formulas").on_hover_text(tip).clicked() {
            commands.edit(Edit::Named(fitted), GROUP);
        }
    }
    ui.add_space(4.0);
    let picture = context.answers.shown_picture();
    for reason in picture.map(|picture| reasons(&picture.solution)).unwrap_or_default() {
        ui.label(RichText::new(reason).small());
    }
}

/// Returns the properties of a contact that the formulas do not cover, one sentence each.
fn reasons(solution: &Solution) -> Vec<String> {
    let problem = &solution.problem;
    let lubricant = &problem.lubricant;
    let mut reasons = Vec::new();
    if lubricant.density != DensityLaw::Incompressible {
        let denser = problem.fluid.at(solution.scalars.p_c).density;
        reasons.push(format!(
            "The oil is {} denser in the middle, so that the same mass makes the central film {} thinner. Moes’ formula \
             is for an incompressible oil.",
            numbers::share(denser - 1.0),
            numbers::share(1.0 - 1.0 / denser)
        ));
    }
    if lubricant.viscosity != ViscosityLaw::Barus {
        reasons.push("Moes’ formula is for Barus’ law; the viscosity of this oil rises less.".to_owned());
    }
    if lubricant.shear != ShearLaw::Newtonian {
        reasons.push("The formulas are for Newtonian oils; this oil is shear-thinning.".to_owned());
    }
    if lubricant.cavitation.supply_film_m().is_some() {
        reasons.push("The formulas are for a flooded inlet; this one has a limited supply.".to_owned());
    }
    reasons
}

/// Draws the table without title.
pub fn table(ui: &mut Ui, context: &Context<'_>) {
    let picture = context.answers.shown_picture();
    let central = picture.map(|p| p.central_film_m());
    let minimum = picture.map(|p| p.minimum_film_m());
    Grid::new("formulas").num_columns(4).spacing([10.0, 5.0]).striped(true).show(ui, |ui| {
        ui.weak("Formula");
        ui.weak("Of");
        ui.weak("Film");
        ui.weak("Deviation").on_hover_text("Film thickness of the formula over that of this contact, minus one");
        ui.end_row();
        for &formula in FilmFormula::of(context.document.point.kind) {
            let prediction = formula.predict(&context.document.point);
            let (name, own) = if formula.predicts_minimum() { ("min", minimum) } else { ("c", central) };
            let tip = if prediction.in_range {
                formula.source().to_owned()
            } else {
                format!("{}. This contact lies outside its range of validity", formula.source())
            };
            let text = |t: String| if prediction.in_range { RichText::new(t) } else { RichText::new(t).weak() };
            ui.label(text(formula.name().to_owned())).on_hover_text(&tip);
            ui.label(symbol(ui, "h", name));
            ui.label(text(numbers::length(prediction.film_m, context.system))).on_hover_text(&tip);
            let against = own.map_or_else(|| "–".to_owned(), |h| numbers::percent(prediction.film_m / h - 1.0));
            ui.label(text(against)).on_hover_text(&tip);
            ui.end_row();
        }
        reduced_rows(ui, context, central);
        for (name, subscript, own) in [("This contact", "c", central), ("This contact", "min", minimum)] {
            ui.strong(name);
            ui.label(symbol(ui, "h", subscript));
            ui.strong(own.map_or_else(|| "–".to_owned(), |h| numbers::length(h, context.system)));
            ui.label("");
            ui.end_row();
        }
    });
    ui.add_space(4.0);
    ui.weak(RichText::new("Grey: outside the range a formula was fitted to. Sources appear on hover.").small());
    if context.document.point.is_narrow() {
        warning_ui(
            ui,
            "Hamrock–Dowson is 15–75 % too high for R_y smaller than R: it was fitted to ellipses that are long across \
             the rolling direction",
        );
    }
}

/// Draws the rows of a thermal contact: Moes' film thickness with published thermal reduction factors.
fn reduced_rows(ui: &mut Ui, context: &Context<'_>, central: Option<f64>) {
    for (by, factor, film, in_range) in reduced(&context.document.point, &context.document.lubricant) {
        let text = |t: String| if in_range { RichText::new(t) } else { RichText::new(t).weak() };
        let outside = if in_range { "" } else { ". This contact lies outside its range of validity" };
        let tip = format!("Moes’ film thickness with thermal reduction: {}{outside}", by.source());
        ui.label(text(format!("× {} {}", numbers::digits(factor, 3), by.name()))).on_hover_text(&tip);
        ui.label(symbol(ui, "h", "c"));
        ui.label(text(numbers::length(film, context.system))).on_hover_text(&tip);
        let against = central.map_or_else(|| "–".to_owned(), |h| numbers::percent(film / h - 1.0));
        ui.label(text(against)).on_hover_text(&tip);
        ui.end_row();
    }
}

/// Returns the thermal reduction factors, the resulting film thicknesses \[m\], and whether the contact is in their
/// range. Empty without heat.
fn reduced(point: &OperatingPoint, lubricant: &Lubricant) -> Vec<(HeatReduction, f64, f64, bool)> {
    let problem = lubricant.heat.and_then(|_| Problem::new(point, *lubricant).ok());
    let Some(heat) = problem.as_ref().and_then(|problem| problem.heat.as_ref()) else { return Vec::new() };
    let cold = FilmFormula::MoesLine.predict(point).film_m;
    let row = |by: HeatReduction| {
        let (factor, in_range) = by.factor(point, heat);
        (by, factor, factor * cold, in_range)
    };
    HeatReduction::ALL.map(row).to_vec()
}
