//! Sliders of M, L, SRR and NPR with number fields: one below the other in the panel, side by side in a
//! presentation.

use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, RangeSlider, described, explained, named, typed_field};
use crate::app::document::{Document, Edit, HOME, Shape};
use crate::app::numbers;
use crate::app::theme::{name_and_symbol, rich};
use crate::solver::parameters::Quantity;
use crate::solver::physics::engineering::{KELVIN, Oil, QuantityKind, Unit, UnitSystem};
use crate::solver::physics::lubricant::{Heat, Lubricant, ShearLaw};
use crate::solver::reduced::Domain;
use egui::{Grid, Slider, TextStyle, Ui};
use serde::{Deserialize, Serialize};

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
/// Quantities that a presentation may show as sliders.
pub const PRESENTED: [Quantity; 10] = [
    Quantity::M,
    Quantity::L,
    Quantity::RadiusRatio,
    Quantity::SlideToRollRatio,
    Quantity::NewtonianPlateauRatio,
    Quantity::Speed,
    Quantity::Load,
    Quantity::Radius,
    Quantity::Viscosity,
    Quantity::InletTemperature,
];
/// Names under which refusals are stored.
pub const FIELDS: [&str; 20] = [
    "M",
    "L",
    "R_y/R",
    "SRR",
    "NPR",
    "u",
    "w",
    "R",
    "η",
    "T",
    "M value",
    "L value",
    "R_y/R value",
    "SRR value",
    "NPR value",
    "u_m value",
    "w value",
    "R value",
    "η₀ value",
    "T value",
];
/// Widths of a name, a number field, and the gaps.
const NAME_WIDTH: f32 = 84.0;
/// Width of the symbol alone, and minimum width of a slider in a row with its whole name.
const SYMBOL_WIDTH: f32 = 34.0;
const ROOM_FOR_NAME: f32 = 270.0;
const ENTRY_WIDTH: f32 = 70.0;
const GAPS: f32 = 24.0;
/// Width of a unit, and of the sign of percent.
const UNIT_WIDTH: f32 = 44.0;
const PERCENT_WIDTH: f32 = 16.0;

/// Slider with its name and number field.
struct Row {
    quantity: Quantity,
    entry: &'static str,
    slider: RangeSlider<'static>,
    /// Value in the unit of the slider.
    value: f64,
    /// Kind, which determines how a text is read.
    kind: QuantityKind,
    /// Unit of the slider.
    unit: Unit,
}

/// Requested value, and the field of the request.
type Wanted = (Quantity, &'static str, f64);

fn is_shear_thinning(document: &Document) -> bool {
    document.lubricant.shear != ShearLaw::Newtonian
}

fn rows(Context { document, answers, system, .. }: &Context<'_>) -> Vec<Row> {
    let (moes, kind) = (document.point.moes(), document.point.kind);
    // The trained range of a model of circular contacts is not marked for elliptical contacts.
    let domain = answers.model(document).filter(|model| model.is_of(&document.point)).map(|model| &model.domain);
    let srr = document.point.sliding.slide_to_roll_ratio;
    let (npr, own_npr) = (document.plateau_ratio(), document.lubricant.shear.plateau());
    let trained = |quantity| domain.and_then(|domain| domain.interval(quantity));
    let row = |quantity: Quantity, entry, value: f64, marked: Option<(f64, f64)>, home: f64, tooltip| {
        let kind = quantity.kind(kind);
        let unit = kind.unit(*system);
        let (low, high) = quantity.usual_range();
        let slider = RangeSlider {
            name: quantity.label(),
            range: unit.number(low)..=unit.number(high),
            marked: marked.map(|(low, high)| (unit.number(low), unit.number(high))),
            home: unit.number(home),
            tooltip,
            logarithmic: matches!(quantity, Quantity::M | Quantity::L | Quantity::RadiusRatio),
        };
        Row { quantity, entry, slider, value: unit.number(value), kind, unit }
    };
    let m_tip = if kind.is_line() { M_TIP } else { M_POINT_TIP };
    let srr_tip = if is_shear_thinning(document) { SRR_TIP } else { SRR_NEWTONIAN_TIP };
    let (slides, plateaus) = (domain.and_then(Domain::srr), trained(Quantity::NewtonianPlateauRatio));
    let mut rows = vec![
        row(Quantity::M, "M value", moes.m, trained(Quantity::M), HOME.m, m_tip),
        row(Quantity::L, "L value", moes.l, trained(Quantity::L), HOME.l, L_TIP),
    ];
    // A circular contact has the ratio 1. Moving this slider makes it elliptical.
    if kind.is_point() {
        let (ratio, ratios) = (document.point.radius_ratio(), trained(Quantity::RadiusRatio));
        rows.push(row(Quantity::RadiusRatio, "R_y/R value", ratio, ratios, 1.0, RATIO_TIP));
    }
    rows.push(row(Quantity::SlideToRollRatio, "SRR value", srr, slides, 0.0, srr_tip));
    rows.push(row(Quantity::NewtonianPlateauRatio, "NPR value", npr, plateaus, own_npr, NPR_TIP));
    rows
}

/// Returns the sliders of SI quantities and of the oil's temperature, as far as the contact has them.
fn si_rows(document: &Document, system: UnitSystem) -> Vec<Row> {
    let contact = document.point.kind;
    let row = |quantity: Quantity, value: Option<f64>, entry, (name, ends): (&'static str, (f64, f64)), tooltip| {
        let (kind, value) = (quantity.kind(contact), value?);
        let unit = kind.unit(system);
        let temperature = quantity == Quantity::InletTemperature;
        let slider = RangeSlider {
            name,
            range: unit.number(ends.0)..=unit.number(ends.1),
            marked: None,
            home: unit.number(if temperature { KELVIN + 40.0 } else { value }),
            tooltip,
            logarithmic: !temperature,
        };
        Some(Row { quantity, entry, slider, value: unit.number(value), kind, unit })
    };
    let of_point = |quantity: Quantity, entry, named| {
        row(quantity, quantity.of(&document.point), entry, named, quantity.meaning(contact))
    };
    let loads = if contact.is_line() { (1e3, 5e6) } else { (0.1, 5000.0) };
    let temperatures = (KELVIN, KELVIN + 150.0);
    [
        of_point(Quantity::Speed, "u_m value", ("Slider of the speed", (1e-3, 100.0))),
        of_point(Quantity::Load, "w value", ("Slider of the load", loads)),
        of_point(Quantity::Radius, "R value", ("Slider of the radius", (5e-4, 0.5))),
        of_point(Quantity::Viscosity, "η₀ value", ("Slider of the viscosity", (1e-3, 2.0))),
        row(
            Quantity::InletTemperature,
            temperature_k(document),
            "T value",
            ("Slider of the oil temperature", temperatures),
            "Temperature of the oil as it enters the contact",
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns the temperature of the oil \[K\], or that of the inlet of a thermal contact; `None` if the contact has neither.
fn temperature_k(document: &Document) -> Option<f64> {
    let oil = document.view.oil.filter(|_| document.lubricant.own_coefficient().is_none());
    oil.map(|oil| oil.temperature_k).or(document.lubricant.heat.map(|heat| heat.inlet_temperature))
}

/// Draws all sliders, one below the other.
pub fn column(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let width = (ui.available_width() - NAME_WIDTH - ENTRY_WIDTH - PERCENT_WIDTH - GAPS).clamp(70.0, 420.0);
    let mut wanted = None;
    Grid::new("sliders").num_columns(3).spacing([8.0, 6.0]).show(ui, |ui| {
        for row in rows(context) {
            if row.quantity == Quantity::NewtonianPlateauRatio && !is_shear_thinning(context.document) {
                disabled_plateau(ui, width);
            } else {
                wanted = row.ui(ui, context.system, entries, (width, true)).or(wanted);
            }
            ui.end_row();
        }
    });
    take(context.document, commands, wanted);
}

/// Draws the chosen sliders side by side. If none was chosen, draws those of M, L, SRR, NPR and R_y/R that change the
/// picture.
pub fn in_use(
    ui: &mut Ui,
    context: &Context<'_>,
    chosen: ChosenSliders,
    entries: &mut Entries,
    commands: &mut Commands,
) {
    let document = context.document;
    if !chosen.is_empty() {
        return side_by_side(ui, context, (&|quantity| chosen.contains(quantity), &|_| true), entries, commands);
    }
    let slides = is_shear_thinning(document) || document.point.sliding.slide_to_roll_ratio != 0.0;
    let used = |quantity: Quantity| match quantity {
        Quantity::SlideToRollRatio => slides,
        Quantity::NewtonianPlateauRatio => is_shear_thinning(document),
        Quantity::RadiusRatio => Shape::of(&document.point) == Shape::Ellipse,
        Quantity::M | Quantity::L => true,
        _ => false,
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
    let rows = rows(context).into_iter().chain(si_rows(context.document, context.system));
    let rows: Vec<Row> = rows.filter(|row| chosen(row.quantity)).collect();
    let each = ui.available_width() / rows.len() as f32;
    let named = each >= ROOM_FOR_NAME;
    let name = if named { NAME_WIDTH } else { SYMBOL_WIDTH };
    let unit = if rows.iter().any(|row| !row.unit.name.is_empty()) { UNIT_WIDTH } else { 0.0 };
    let width = (each - name - ENTRY_WIDTH - GAPS - unit).max(40.0);
    let mut wanted = None;
    ui.horizontal(|ui| {
        for row in rows {
            let moved =
                ui.add_enabled_ui(free(row.quantity), |ui| row.ui(ui, context.system, entries, (width, named))).inner;
            wanted = moved.or(wanted);
            ui.add_space(8.0);
        }
    });
    take(context.document, commands, wanted);
    for field in FIELDS {
        entries.message_ui(ui, field);
    }
}

impl Row {
    /// Draws the name or only its symbol, the slider and the number field. Returns the requested value.
    fn ui(
        &self,
        ui: &mut Ui,
        system: UnitSystem,
        entries: &mut Entries,
        (width, named): (f32, bool),
    ) -> Option<Wanted> {
        let tip = self.slider.tooltip;
        let (sign, subscript) = self.quantity.symbol();
        let name = if named { word(self.quantity) } else { "" };
        let name = match self.quantity {
            Quantity::RadiusRatio => rich(
                &format!("{name} {{R_y}}/{{R}}"),
                TextStyle::Body.resolve(ui.style()).size,
                ui.visuals().text_color(),
            ),
            _ => name_and_symbol(ui, name, sign, subscript),
        };
        explained(ui, name, tip);
        let moved = self.slider.show(ui, self.value, width).map(|value| (sign, value));
        let read = |text: &str| match self.quantity {
            Quantity::M | Quantity::L | Quantity::NewtonianPlateauRatio => numbers::parse(text),
            _ => Ok(self.unit.number(self.kind.read(text, system)?)),
        };
        let entered = ui.horizontal(|ui| {
            let entered = typed_field(ui, entries, self.entry, self.value, ENTRY_WIDTH, tip, read);
            if !self.unit.name.is_empty() {
                ui.spacing_mut().item_spacing.x = 3.0;
                ui.label(self.unit.name);
            }
            entered
        });
        let entered = entered.inner;
        let (field, value) = moved.or(entered.map(|value| (self.entry, value)))?;
        Some((self.quantity, field, self.unit.si(value)))
    }
}

/// Returns the quantity of a slider in one word.
fn word(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::M => "Load",
        Quantity::L => "Lubricant",
        Quantity::RadiusRatio => "Ellipse",
        Quantity::SlideToRollRatio => "Sliding",
        Quantity::NewtonianPlateauRatio => "Plateau",
        Quantity::Speed => "Speed",
        Quantity::Load => "Load",
        Quantity::Radius => "Radius",
        Quantity::Viscosity => "Viscosity",
        _ => "Oil",
    }
}

/// Submits the requested value in SI units.
fn take(document: &Document, commands: &mut Commands, wanted: Option<Wanted>) {
    let Some((quantity, field, value)) = wanted else { return };
    let edit = match (quantity, document.view.oil, document.lubricant.heat) {
        (Quantity::InletTemperature, Some(oil), _) => Edit::Oil(Some(Oil { temperature_k: value, ..oil })),
        (Quantity::InletTemperature, None, Some(heat)) => {
            let heat = Some(Heat { inlet_temperature: value, ..heat });
            Edit::Laws(Box::new(Lubricant { heat, ..document.lubricant }))
        }
        _ => Edit::Quantity(quantity, value),
    };
    commands.edit(edit, field);
}

/// Sliders that a presentation shows. In files, a list of the names of their quantities; empty for the usual ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
#[serde(from = "Vec<Quantity>", into = "Vec<Quantity>")]
pub struct ChosenSliders([bool; PRESENTED.len()]);

impl ChosenSliders {
    /// Returns true if a quantity was chosen.
    pub fn contains(self, quantity: Quantity) -> bool {
        PRESENTED.iter().zip(self.0).any(|(own, chosen)| chosen && *own == quantity)
    }

    /// Returns true if none was chosen.
    pub fn is_empty(self) -> bool {
        !self.0.contains(&true)
    }

    /// Returns the list with a quantity added or removed.
    pub fn toggled(mut self, quantity: Quantity) -> Self {
        for (own, chosen) in PRESENTED.iter().zip(&mut self.0) {
            *chosen ^= *own == quantity;
        }
        self
    }
}

impl From<Vec<Quantity>> for ChosenSliders {
    fn from(quantities: Vec<Quantity>) -> Self {
        let fresh = |list: Self, quantity| if list.contains(quantity) { list } else { list.toggled(quantity) };
        quantities.into_iter().fold(Self::default(), fresh)
    }
}

impl From<ChosenSliders> for Vec<Quantity> {
    fn from(chosen: ChosenSliders) -> Self {
        PRESENTED.into_iter().filter(|quantity| chosen.contains(*quantity)).collect()
    }
}

/// Draws the slider of NPR for a Newtonian fluid. It is fixed at 1, and its tooltip says why.
fn disabled_plateau(ui: &mut Ui, width: f32) {
    let tip = NPR_NEWTONIAN_TIP;
    ui.add_enabled(false, egui::Label::new("Plateau NPR")).on_disabled_hover_text(tip);
    ui.spacing_mut().slider_width = width;
    let (low, high) = Quantity::NewtonianPlateauRatio.usual_range();
    let response = ui.add_enabled(false, Slider::new(&mut 1.0, low..=high).show_value(false));
    let response = described(ui, named(ui, response, Quantity::NewtonianPlateauRatio.label()), tip);
    response.on_disabled_hover_text(tip);
    ui.weak("Newtonian").on_hover_text(tip);
}
