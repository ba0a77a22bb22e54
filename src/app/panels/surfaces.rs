//! Panel of the surfaces: roughness of both bodies, film ratio, and the switch for mixed lubrication with the law of the
//! asperity pressure.

use super::lubricant::{Constant, constant, constants_ui};
use crate::app::context::{Commands, Context};
use crate::app::controls::{
    Entries, NAME_WIDTH, RangeSlider, choice, described, named, ringed, row_name, typed_field, warning_ui,
};
use crate::app::document::{Document, Edit};
use crate::app::numbers;
use crate::app::theme::{name_and_symbol, rich};
use crate::scene::View;
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::{AsperityLaw, FINISHES, Finish, HeightMeasure, Roughness};
use egui::{Checkbox, CollapsingHeader, ComboBox, Grid, TextStyle, Ui};

/// Name under which refusals of the surfaces are stored.
const GROUP: &str = "surfaces";
const FIELDS: [&str; 2] = ["Roughness of body 1", "Roughness of body 2"];
const FINISH_FIELDS: [&str; 2] = ["Finish of body 1", "Finish of body 2"];
/// Kind of the fields.
const HEIGHT: QuantityKind = QuantityKind::FilmThickness;
/// Range of the slider of the composite roughness \[m\].
const SLIDER_M: (f64, f64) = (5e-9, 5e-6);
/// Film ratio h_min/σ below which asperities carry a noticeable part of the load.
const TOUCHES: f64 = 3.0;
/// Default elastic–plastic law and exponential law: constants of the library's default law, and the hardness of bearing
/// steel.
const ZHAO: AsperityLaw = AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.05, sigma_over_beta: 0.01, hardness: 7.5e9 };
const EXPONENTIAL: AsperityLaw = AsperityLaw::Exponential { pressure: 5e8, decay: 0.6 };

const TIP: &str = "Root-mean-square roughness after running-in. It determines the film ratio, and with Mixed lubrication \
                   the flow in the film and the pressure of the asperities";
const MIXED_TIP: &str = "Asperities carry part of the load, and roughness changes the flow (Patir & Cheng)";
const SIGMA_TIP: &str = "σ = √(Rq₁² + Rq₂²). The slider changes both surfaces by the same factor";
const FRICTION_TIP: &str = "Friction coefficient µ_b of touching asperities; 0.1…0.15 for steel with mineral oils";
const PEKLENIK_TIP: &str = "Length over width of the asperities along the flow, 1/9…9: 1 is isotropic, above 1 are ridges \
                            along the flow, below 1 across it";
const SUMMITS_TIP: &str = "Number of summits per area times their radius times σ; 0.03…0.07 for most surfaces";
const RADIUS_TIP: &str = "σ over the radius of the summits; 0.0001 (smooth) … 0.01 (ground)";
const HARDNESS_TIP: &str = "Hardness of the softer body; bearing steel 7…8 GPa";

const CONSTANTS: [Constant; 7] = [
    constant("Boundary friction", ("Boundary friction", "µ", "b"), QuantityKind::Number, FRICTION_TIP, |laws| {
        Some(&mut laws.roughness.as_mut()?.boundary_friction)
    }),
    constant("Peklenik number", ("Lay", "γ", ""), QuantityKind::Number, PEKLENIK_TIP, |laws| {
        Some(&mut laws.roughness.as_mut()?.peklenik)
    }),
    constant("Summits", ("Summits", "ηβσ", ""), QuantityKind::Number, SUMMITS_TIP, |laws| match asperities(laws)? {
        AsperityLaw::GreenwoodTripp { eta_beta_sigma: summits, .. }
        | AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: summits, .. } => Some(summits),
        AsperityLaw::Exponential { .. } => None,
    }),
    constant("Roughness over summit radius", ("Slope", "σ/β", ""), QuantityKind::Number, RADIUS_TIP, |laws| {
        match asperities(laws)? {
            AsperityLaw::GreenwoodTripp { sigma_over_beta, .. }
            | AsperityLaw::ZhaoMaiettaChang { sigma_over_beta, .. } => Some(sigma_over_beta),
            AsperityLaw::Exponential { .. } => None,
        }
    }),
    constant("Hardness", ("Hardness", "H", "d"), QuantityKind::Pressure, HARDNESS_TIP, |laws| {
        match asperities(laws)? {
            AsperityLaw::ZhaoMaiettaChang { hardness, .. } => Some(hardness),
            AsperityLaw::GreenwoodTripp { .. } | AsperityLaw::Exponential { .. } => None,
        }
    }),
    constant("Asperity pressure", ("Pressure", "p", "0"), QuantityKind::Stress, "Asperity pressure at h = 0", |laws| {
        if let AsperityLaw::Exponential { pressure, .. } = asperities(laws)? { Some(pressure) } else { None }
    }),
    constant(
        "Decay",
        ("Decay", "c", ""),
        QuantityKind::Number,
        "h/σ over which the asperity pressure falls by e",
        |laws| {
            if let AsperityLaw::Exponential { decay, .. } = asperities(laws)? { Some(decay) } else { None }
        },
    ),
];

fn asperities(laws: &mut Lubricant) -> Option<&mut AsperityLaw> {
    laws.roughness.as_mut().map(|roughness| &mut roughness.asperities)
}

/// Draws the group. It is collapsed until a roughness has been entered.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let document = context.document;
    let group = CollapsingHeader::new("Surfaces").default_open(document.has_surfaces());
    let shown = group.show(ui, |ui| {
        Grid::new("surfaces").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
            measure_ui(ui, document, commands);
        });
        heights_ui(ui, context, entries, commands);
        finishes_ui(ui, context, commands);
        composite_ui(ui, context, commands);
        state_ui(ui, context);
        mixed_ui(ui, context, entries, commands);
        entries.reserved_ui(ui, FIELDS.into_iter().chain(CONSTANTS.iter().map(Constant::name)).chain([GROUP]));
    });
    ringed(ui, shown.header_response, "Surfaces");
}

/// Draws the choice of the measure in which roughness is typed.
fn measure_ui(ui: &mut Ui, document: &Document, commands: &mut Commands) {
    let present = document.view.height_measure;
    let mut wanted = present;
    let tip = "Measure of the fields below. Mean heights are converted by the factor of Gaussian heights";
    choice(ui, "Measured as", tip, &mut wanted, &HeightMeasure::ALL, |measure| (measure.name(), measure.meaning()));
    if wanted != present {
        commands.edit(Edit::View(Box::new(View { height_measure: wanted, ..document.view.clone() })), GROUP);
    }
}

fn heights_ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let (document, system) = (context.document, context.system);
    let unit = HEIGHT.unit(system);
    let (measure, present) = (document.view.height_measure, document.surfaces());
    let mut wanted = present;
    ui.horizontal(|ui| {
        let name = format!("Roughness {{{}}}", measure.name());
        row_name(ui, rich(&name, TextStyle::Body.resolve(ui.style()).size, ui.visuals().text_color()), TIP);
        let read = |text: &str| Ok(unit.number(HEIGHT.read(text, system)?));
        for (field, rms) in FIELDS.into_iter().zip(&mut wanted) {
            let shown = unit.number(*rms * measure.of_rms());
            if let Some(typed) = typed_field(ui, entries, field, shown, 66.0, TIP, read) {
                *rms = unit.si(typed) / measure.of_rms();
            }
        }
        ui.label(unit.name);
    });
    for (k, field) in FIELDS.into_iter().enumerate() {
        if wanted[k] != present[k] {
            commands.edit(Edit::Surfaces(wanted), field);
        }
    }
}

fn finishes_ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let document = context.document;
    let unit = HEIGHT.unit(context.system);
    let mut wanted = document.surfaces();
    ui.horizontal(|ui| {
        let tip = "Usual roughness of a finish, the middle of its range";
        row_name(ui, name_and_symbol(ui, "Finish", "", ""), tip);
        for (name, rms) in FINISH_FIELDS.into_iter().zip(&mut wanted) {
            let present = Finish::of_rms(*rms);
            let text = present.map_or("Own", |finish| finish.name);
            let response = ComboBox::from_id_salt(name).width(78.0).selected_text(text).show_ui(ui, |ui| {
                for finish in FINISHES {
                    let (least, most) = finish.mean_height_m;
                    let [least, most] = [least, most].map(|height| numbers::digits(unit.number(height), 2));
                    let range = format!("Ra {least}…{most} {}: {}", unit.name, finish.source);
                    let text = format!(
                        "{}, Rq {} {}",
                        finish.name,
                        numbers::digits(unit.number(finish.rms_m()), 2),
                        unit.name
                    );
                    if ui.selectable_label(present == Some(finish), text).on_hover_text(range).clicked() {
                        *rms = finish.rms_m();
                    }
                }
            });
            named(ui, response.response, name);
        }
    });
    if wanted != document.surfaces() {
        commands.edit(Edit::Surfaces(wanted), GROUP);
    }
}

/// Draws the slider of the composite roughness.
fn composite_ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let document = context.document;
    let unit = HEIGHT.unit(context.system);
    let ([first, second], sigma) = (document.surfaces(), document.composite_roughness_m());
    let usual = Finish::rms_m(&FINISHES[1]) * std::f64::consts::SQRT_2;
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, "Composite", "σ", ""), SIGMA_TIP);
        let slider = RangeSlider {
            name: "Composite roughness",
            range: unit.number(SLIDER_M.0)..=unit.number(SLIDER_M.1),
            marked: None,
            home: unit.number(usual),
            tooltip: SIGMA_TIP,
            logarithmic: true,
        };
        if let Some(moved) = slider.show(ui, unit.number(sigma), 96.0) {
            let wanted = unit.si(numbers::rounded(moved, 3));
            let surfaces = match sigma {
                0.0 => [wanted / std::f64::consts::SQRT_2; 2],
                sigma => [first, second].map(|rms| rms * wanted / sigma),
            };
            commands.edit(Edit::Surfaces(surfaces), GROUP);
        }
        let text = format!("{}{}{}", numbers::digits(unit.number(sigma), 3), numbers::THIN, unit.name);
        ui.label(text).on_hover_text(SIGMA_TIP);
    });
}

/// Draws the film ratio of the present picture, with advice if asperities touch and are not computed.
fn state_ui(ui: &mut Ui, context: &Context<'_>) {
    let document = context.document;
    let sigma = document.composite_roughness_m();
    let picture = context.answers.shown_picture();
    let mixed = picture.and_then(|picture| picture.mixed);
    let ratio = picture.map(|picture| picture.minimum_film_m() / sigma).filter(|ratio| ratio.is_finite());
    let text = match (ratio, mixed) {
        (Some(ratio), Some(mixed)) => format!(
            "Film ratio {{λ}} {}; asperities carry {} of the load",
            numbers::digits(ratio, 3),
            numbers::share(mixed.asperity_load_share)
        ),
        (Some(ratio), None) => format!("Film ratio {{λ}} {}", numbers::digits(ratio, 3)),
        (None, _) => "Film ratio {λ} –".to_owned(),
    };
    let size = TextStyle::Small.resolve(ui.style()).size;
    ui.label(rich(&text, size, ui.visuals().weak_text_color()));
    let touches = !document.lubricant.is_rough() && ratio.is_some_and(|ratio| ratio < TOUCHES);
    if touches {
        warning_ui(ui, "asperities touch: switch on Mixed lubrication to compute their share of the load");
    }
}

/// Draws the switch and, if it is on, the constants of the asperities.
fn mixed_ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let before = context.document.lubricant;
    let mut on = before.roughness.is_some();
    let mixed = ui.add(Checkbox::new(&mut on, "Mixed lubrication"));
    let mixed = described(ui, named(ui, mixed, "Mixed lubrication"), MIXED_TIP);
    if mixed.on_hover_text(MIXED_TIP).changed() {
        commands.edit(Edit::Mixed(on), GROUP);
    }
    let Some(roughness) = before.roughness else { return };
    let mut law = roughness.asperities;
    Grid::new("asperities").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let or = |default: AsperityLaw| {
            let same = std::mem::discriminant(&roughness.asperities) == std::mem::discriminant(&default);
            if same { roughness.asperities } else { default }
        };
        let options = [or(AsperityLaw::default()), or(ZHAO), or(EXPONENTIAL)];
        choice(ui, "Asperities", "Law of the asperity pressure", &mut law, &options, |law| match law {
            AsperityLaw::GreenwoodTripp { .. } => {
                ("Greenwood–Tripp", "Elastic summits of Gaussian heights; Greenwood & Tripp 1970, exact integral")
            }
            AsperityLaw::ZhaoMaiettaChang { .. } => {
                ("Zhao–Maietta–Chang", "Elastic–plastic summits with a hardness; Zhao, Maietta & Chang 2000")
            }
            AsperityLaw::Exponential { .. } => ("Exponential", "p_a = p₀ exp(−(h/σ)/c)"),
        });
    });
    let asperities = Roughness { asperities: law, ..roughness };
    let mut wanted = Lubricant { roughness: Some(asperities), ..before };
    let field = constants_ui(ui, entries, &CONSTANTS, &mut wanted, context.system);
    if wanted != before {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}
