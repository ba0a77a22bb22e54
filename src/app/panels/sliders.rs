//! Sliders of M, L, SRR and NPR with number fields: one below the other in the panel, side by side in a
//! presentation.

use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, RangeSlider, described, explained, named, typed_field};
use crate::app::document::{Document, Edit, HOME, Shape};
use crate::app::numbers;
use crate::app::refusal::Refusal;
use crate::app::theme::{name_and_symbol, rich};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{self, Dimension};
use crate::solver::physics::lubricant::ShearLaw;
use crate::solver::reduced::Domain;
use egui::{Grid, Slider, TextStyle, Ui};
use std::ops::RangeInclusive;

const M_TIP: &str = "Load number M = w/(E’R) · (2η₀u_m/(E’R))^(−1/2): how heavily the contact is loaded for its speed. \
    Small: nearly rigid bodies; large: nearly Hertzian. Double click: M 40";
const M_POINT_TIP: &str = "Load number M = w/(E’R²) · (2η₀u_m/(E’R))^(−3/4): how heavily the contact is loaded for its speed. \
    Small: nearly rigid bodies; large: nearly Hertzian. Double click: M 40";
const L_TIP: &str = "Lubricant number L = αE’ · (2η₀u_m/(E’R))^(1/4): how strongly the viscosity rises with pressure. \
    Double click: L 10";
const SRR_TIP: &str = "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25): sliding speed over rolling speed. Type negative \
                       values: the film thickness is the same, the traction changes its sign. Double click: pure \
                       rolling";
const SRR_NEWTONIAN_TIP: &str = "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25). The lubricant is Newtonian: sliding \
                                 changes neither pressure nor film thickness, only the traction. Double click: pure \
                                 rolling";
const NPR_TIP: &str = "Newtonian plateau ratio NPR of (3.40): the share of the viscosity that remains at any shear \
                       rate. 1 is Newtonian. Double click: the value of the lubricant";
const NPR_NEWTONIAN_TIP: &str = "The lubricant has no shear constants, so it is Newtonian, with a Newtonian plateau \
                                 ratio NPR of 1. Choose a shear-thinning lubricant below";

const RATIO_TIP: &str = "R_y/R, radius across over radius along the rolling direction: 1 is a circular contact, large \
                         ratios are nearly a line contact, small ratios an ellipse that is long along the rolling \
                         direction. R is kept, R_y follows. Double click: circular contact";

/// Quantities with a slider.
pub const SLIDERS: [Quantity; 5] =
    [Quantity::M, Quantity::L, Quantity::RadiusRatio, Quantity::SlideToRollRatio, Quantity::NewtonianPlateauRatio];
/// Names under which refusals are stored.
pub const FIELDS: [&str; 10] =
    ["M", "L", "R_y/R", "SRR", "NPR", "M value", "L value", "R_y/R value", "SRR value", "NPR value"];
/// Widths of a name, a number field, and the gaps.
const NAME_WIDTH: f32 = 84.0;
/// Width of the symbol alone, and minimum width of a slider in a row with its whole name.
const SYMBOL_WIDTH: f32 = 34.0;
const ROOM_FOR_NAME: f32 = 270.0;
const ENTRY_WIDTH: f32 = 70.0;
const GAPS: f32 = 24.0;

/// Slider with its name and number field.
struct Row {
    quantity: Quantity,
    entry: &'static str,
    slider: RangeSlider<'static>,
    value: f64,
}

/// Requested value, and the field of the request.
type Wanted = (Quantity, &'static str, f64);

/// Returns the ends of a slider.
fn range(quantity: Quantity) -> RangeInclusive<f64> {
    let (low, high) = quantity.usual_range();
    low..=high
}

fn is_shear_thinning(document: &Document) -> bool {
    document.lubricant.shear != ShearLaw::Newtonian
}

fn rows(Context { document, answers, .. }: &Context<'_>) -> Vec<Row> {
    let (moes, kind) = (document.point.moes(), document.point.kind);
    // The trained range of a model of circular contacts is not marked for elliptical contacts.
    let domain = answers.model(document).filter(|model| model.is_of(&document.point)).map(|model| &model.domain);
    let srr = document.point.sliding.slide_to_roll_ratio;
    let (npr, own_npr) = (document.plateau_ratio(), document.lubricant.shear.plateau());
    let trained = |quantity| domain.and_then(|domain| domain.interval(quantity));
    let slider = |quantity: Quantity, marked, home, tooltip| RangeSlider {
        name: quantity.label(),
        range: range(quantity),
        marked,
        home,
        tooltip,
        logarithmic: matches!(quantity, Quantity::M | Quantity::L | Quantity::RadiusRatio),
    };
    let m_tip = if kind == ContactKind::Line { M_TIP } else { M_POINT_TIP };
    let srr_tip = if is_shear_thinning(document) { SRR_TIP } else { SRR_NEWTONIAN_TIP };
    let m = slider(Quantity::M, trained(Quantity::M), HOME.m, m_tip);
    let l = slider(Quantity::L, trained(Quantity::L), HOME.l, L_TIP);
    let marked = domain.and_then(Domain::srr);
    let slide = slider(Quantity::SlideToRollRatio, marked, 0.0, srr_tip);
    let marked = trained(Quantity::NewtonianPlateauRatio);
    let plateau = slider(Quantity::NewtonianPlateauRatio, marked, own_npr, NPR_TIP);
    let ratio = trained(Quantity::RadiusRatio);
    // A circular contact has the ratio 1. Moving this slider makes it elliptical.
    let ellipse = (kind == ContactKind::Point).then(|| Row {
        quantity: Quantity::RadiusRatio,
        entry: "R_y/R value",
        slider: slider(Quantity::RadiusRatio, ratio, 1.0, RATIO_TIP),
        value: document.point.radius_ratio(),
    });
    let mut rows = vec![
        Row { quantity: Quantity::M, entry: "M value", slider: m, value: moes.m },
        Row { quantity: Quantity::L, entry: "L value", slider: l, value: moes.l },
    ];
    rows.extend(ellipse);
    rows.extend([
        Row { quantity: Quantity::SlideToRollRatio, entry: "SRR value", slider: slide, value: srr },
        Row { quantity: Quantity::NewtonianPlateauRatio, entry: "NPR value", slider: plateau, value: npr },
    ]);
    rows
}

/// Draws all sliders, one below the other.
pub fn column(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let width = (ui.available_width() - NAME_WIDTH - ENTRY_WIDTH - GAPS).clamp(70.0, 420.0);
    let mut wanted = None;
    Grid::new("sliders").num_columns(3).spacing([8.0, 6.0]).show(ui, |ui| {
        for row in rows(context) {
            if row.quantity == Quantity::NewtonianPlateauRatio && !is_shear_thinning(context.document) {
                disabled_plateau(ui, width);
            } else {
                wanted = row.ui(ui, entries, width, true).or(wanted);
            }
            ui.end_row();
        }
    });
    take(commands, wanted);
}

/// Draws the sliders that change the picture, side by side.
pub fn in_use(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let document = context.document;
    let slides = is_shear_thinning(document) || document.point.sliding.slide_to_roll_ratio != 0.0;
    let used = |quantity: Quantity| match quantity {
        Quantity::SlideToRollRatio => slides,
        Quantity::NewtonianPlateauRatio => is_shear_thinning(document),
        Quantity::RadiusRatio => Shape::of(&document.point) == Shape::Ellipse,
        _ => true,
    };
    side_by_side(ui, context, (&used, &|_| true), entries, commands);
}

/// Draws the chosen sliders side by side. Only sliders that are `free` can be moved.
pub fn side_by_side(
    ui: &mut Ui,
    context: &Context<'_>,
    (chosen, free): (&dyn Fn(Quantity) -> bool, &dyn Fn(Quantity) -> bool),
    entries: &mut Entries,
    commands: &mut Commands,
) {
    let rows: Vec<Row> = rows(context).into_iter().filter(|row| chosen(row.quantity)).collect();
    let each = ui.available_width() / rows.len() as f32;
    let named = each >= ROOM_FOR_NAME;
    let name = if named { NAME_WIDTH } else { SYMBOL_WIDTH };
    let width = (each - name - ENTRY_WIDTH - GAPS).max(40.0);
    let mut wanted = None;
    ui.horizontal(|ui| {
        for row in rows {
            let moved = ui.add_enabled_ui(free(row.quantity), |ui| row.ui(ui, entries, width, named)).inner;
            wanted = moved.or(wanted);
            ui.add_space(8.0);
        }
    });
    take(commands, wanted);
    for field in FIELDS {
        entries.message_ui(ui, field);
    }
}

impl Row {
    /// Draws the name or only its symbol, the slider and the number field. Returns the requested value.
    fn ui(&self, ui: &mut Ui, entries: &mut Entries, width: f32, named: bool) -> Option<Wanted> {
        let tip = self.slider.tooltip;
        let (sign, _) = self.quantity.symbol();
        let name = if named { word(self.quantity) } else { "" };
        let name = match self.quantity {
            Quantity::RadiusRatio => rich(
                &format!("{name} {{R_y}}/{{R}}"),
                TextStyle::Body.resolve(ui.style()).size,
                ui.visuals().text_color(),
            ),
            _ => name_and_symbol(ui, name, sign, ""),
        };
        explained(ui, name, tip);
        let moved = self.slider.show(ui, self.value, width).map(|value| (sign, value));
        let ratio = matches!(self.quantity, Quantity::SlideToRollRatio | Quantity::RadiusRatio);
        let read = |text: &str| match ratio {
            true => engineering::parse(text, Dimension::Ratio, "").map_err(Refusal::from),
            false => numbers::parse(text),
        };
        let entered = typed_field(ui, entries, self.entry, self.value, ENTRY_WIDTH, tip, read);
        let (field, value) = moved.or(entered.map(|value| (self.entry, value)))?;
        Some((self.quantity, field, value))
    }
}

/// Returns the quantity of a slider in one word.
fn word(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::M => "Load",
        Quantity::L => "Lubricant",
        Quantity::RadiusRatio => "Ellipse",
        Quantity::SlideToRollRatio => "Sliding",
        _ => "Plateau",
    }
}

/// Submits the requested value.
fn take(commands: &mut Commands, wanted: Option<Wanted>) {
    if let Some((quantity, field, value)) = wanted {
        commands.edit(Edit::Quantity(quantity, value), field);
    }
}

/// Draws the slider of NPR for a Newtonian fluid. It is fixed at 1, and its tooltip says why.
fn disabled_plateau(ui: &mut Ui, width: f32) {
    let tip = NPR_NEWTONIAN_TIP;
    ui.add_enabled(false, egui::Label::new("Plateau NPR")).on_disabled_hover_text(tip);
    ui.spacing_mut().slider_width = width;
    let response =
        ui.add_enabled(false, Slider::new(&mut 1.0, range(Quantity::NewtonianPlateauRatio)).show_value(false));
    let response = described(ui, named(ui, response, Quantity::NewtonianPlateauRatio.label()), tip);
    response.on_disabled_hover_text(tip);
    ui.weak("Newtonian").on_hover_text(tip);
}
