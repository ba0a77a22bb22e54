//! Panel of the lubricant: a named lubricant or custom laws and constants, and the limiting shear stress.

use super::{heat, oil};
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, NAME_WIDTH, choice, heading, named, row_name, sentence, typed_field};
use crate::app::document::{Document, Edit};
use crate::app::numbers;
use crate::app::theme::name_and_symbol;
use crate::scene::named_lubricant::{self, NAMED, NamedLubricant};
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use crate::solver::physics::lubricant::{
    Cavitation, DensityLaw, Doolittle, LimitingStress, Lubricant, ShearLaw, Tait, ViscosityLaw,
};
use egui::{Checkbox, Grid, Ui};

/// Default constants of Tait's law for a custom lubricant: squalane, Table 3.5.
const VOLUME: Tait = Tait { k_0: 1.007837e9, k_0_prime: 11.29 };
/// Default constants of Doolittle's law for a custom lubricant: squalane, Table 3.5.
const DOOLITTLE: Doolittle = Doolittle { b: 4.2, r_0: 0.658, volume: VOLUME };
/// Default shear-thinning laws: the modified Carreau law of Table 3.5, and usual values for the others.
const CARREAU: ShearLaw = ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 };
const ELLIS: ShearLaw = ShearLaw::Ellis { critical_stress: 1e5, n: 0.6, npr: 0.0 };
const EYRING: ShearLaw = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
/// Default Eyring stress of the traction \[Pa\].
const EYRING_STRESS_PA: f64 = 5e6;
/// Default limiting shear stress. Its slope is a value by Bair and Winer for mineral oils.
const LIMITING: LimitingStress = LimitingStress { ambient: 5e6, slope: 0.05, eyring: None };

const LIMITING_TIP: &str = "The film carries at most τ_L = τ_L0 + Λ p (Bair & Winer 1979): beyond it the lubricant slips or yields. \
    It limits the traction; pressure and film are computed without it";

const RUPTURE_TIP: &str = "Cavitation model of full solutions, where the gap opens behind the contact. Reduced models \
                           keep the penalty they were trained with; the film thickness of flooded contacts differs by \
                           less than a millionth";

const SUPPLY_TIP: &str = "Inlet film thickness: the oil layer that the surfaces carry to the inlet. Without it the \
                          inlet is flooded. A layer thinner than the contact needs causes starvation";
/// Default inlet film thickness \[m\], similar to usual film thicknesses in the contact.
const SUPPLY_M: f64 = 200e-9;

/// Name under which refusals of the whole lubricant are stored.
pub const GROUP: &str = "lubricant";

/// Choice of the lubricant.
#[derive(Clone, Copy, PartialEq)]
enum Pick {
    Named(&'static str),
    /// Lubricant of the scene, by its position.
    Kept(usize),
    Own,
}

/// Draws the group Lubricant.
pub fn ui(ui: &mut Ui, context: &Context<'_>, own_laws: &mut bool, entries: &mut Entries, commands: &mut Commands) {
    let (document, system) = (context.document, context.system);
    let (laws, kind) = (&document.lubricant, document.point.kind);
    heading(ui, "Lubricant");
    let known = named_lubricant::of_laws(laws, &document.point).filter(|_| !*own_laws);
    let kept = document.view.lubricants.iter().position(|kept| kept.is_of(&document.point, laws) && !*own_laws);
    picker(ui, own_laws, (document, commands), (known, kept));
    match known.filter(|_| kept.is_none()) {
        Some(lubricant) => {
            ui.weak(sentence(lubricant.about));
            let tip = "Bodies, speed and load of the contact in its source. Undo restores the present ones";
            if let Some(point) = lubricant.studied_contact(kind)
                && ui.button("Use its published contact").on_hover_text(tip).clicked()
            {
                commands.edit(Edit::Contact(point, Box::new(*laws)), GROUP);
            }
        }
        None => own(ui, (laws, system), entries, commands),
    }
    oil::ui(ui, context, entries, commands);
    limiting_stress(ui, (laws, system), entries, commands);
    rupture(ui, (laws, system), entries, commands);
    heat::ui(ui, context, entries, commands);
    let constants =
        CONSTANTS.iter().chain(&LIMITS).chain(&SUPPLY).chain(&heat::CONSTANTS).map(|constant| constant.name);
    entries.reserved_ui(ui, constants.chain([GROUP]));
}

fn picker(
    ui: &mut Ui,
    own_laws: &mut bool,
    (document, commands): (&Document, &mut Commands),
    (known, kept): (Option<&'static NamedLubricant>, Option<usize>),
) {
    let known = known.map_or(Pick::Own, |lubricant| Pick::Named(lubricant.name));
    let before = kept.map_or(known, Pick::Kept);
    let mut wanted = before;
    let own = &document.view.lubricants;
    let kept = (0..own.len()).map(Pick::Kept);
    let options: Vec<Pick> = NAMED.iter().map(|named| Pick::Named(named.name)).chain(kept).chain([Pick::Own]).collect();
    let of = |name: &str| NAMED.iter().find(|named| named.name == name);
    Grid::new("lubricant").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "Laws of density, viscosity and shear. A lubricant that defines its viscosity also sets it; the \
                   contact does not change";
        choice(ui, "Fluid", tip, &mut wanted, &options, |pick| match pick {
            Pick::Named(name) => of(name).map_or(("", ""), |named| (named.title, named.about)),
            Pick::Kept(k) => (own.get(k).map_or("", |kept| kept.name.as_str()), "Lubricant that this scene keeps"),
            Pick::Own => ("Own", "Custom laws and constants, starting from those of the present lubricant"),
        });
    });
    if wanted == before {
        return;
    }
    match wanted {
        Pick::Own => *own_laws = true,
        Pick::Kept(k) => {
            *own_laws = false;
            if let Some(kept) = own.get(k) {
                let (point, laws) = kept.in_place(&document.point, &document.lubricant);
                commands.edit(Edit::Contact(point, Box::new(laws)), GROUP);
            }
        }
        Pick::Named(name) => {
            *own_laws = false;
            of(name).into_iter().for_each(|named| commands.edit(Edit::Named(named), GROUP));
        }
    }
}

/// Constant of the laws in use.
pub(super) struct Constant {
    name: &'static str,
    /// Name in the row, and base and subscript of the symbol.
    row: (&'static str, &'static str, &'static str),
    kind: QuantityKind,
    tip: &'static str,
    /// Returns the constant. `None` if no law in use has it.
    of: fn(&mut Lubricant) -> Option<&mut f64>,
}

impl Constant {
    /// Returns the accessible name of its field.
    pub(super) fn name(&self) -> &'static str {
        self.name
    }
}

pub(super) const fn constant(
    name: &'static str,
    row: (&'static str, &'static str, &'static str),
    kind: QuantityKind,
    tip: &'static str,
    of: fn(&mut Lubricant) -> Option<&mut f64>,
) -> Constant {
    Constant { name, row, kind, tip, of }
}

const MODULUS: QuantityKind = QuantityKind::Pressure;
const STRESS: QuantityKind = QuantityKind::Stress;
const NUMBER: QuantityKind = QuantityKind::Number;

const BULK_TIP: &str = "Tait’s initial bulk modulus K₀ (3.37)";
const RATE_TIP: &str = "Rate of change of the bulk modulus with pressure, K’₀ (3.37)";
const B_TIP: &str = "Doolittle’s parameter B (3.39): how strongly the viscosity depends on the free volume";
const OCCUPIED_TIP: &str = "Occupied volume over the volume at ambient pressure (3.39). The viscosity is infinite if \
                            the relative volume falls to this value";
const VOLUME_BULK_TIP: &str = "Bulk modulus of the volume in Doolittle’s law, which is not that of the density law";
const VOLUME_RATE_TIP: &str = "Its rate of change with pressure";
const CRITICAL_TIP: &str = "Shear stress above which the viscosity falls: G_c of (3.40), the stress of half the \
                            viscosity (Ellis), or τ_E (Eyring)";
const BETA_TIP: &str = "How sharply the viscosity turns at the critical stress, β_c of (3.40)";
const N_TIP: &str = "Power-law exponent, stress over rate, n_c of (3.40); 1 is Newtonian";

const CONSTANTS: [Constant; 9] = [
    constant("Bulk modulus K_0", ("Bulk modulus", "K", "0"), MODULUS, BULK_TIP, |l| Some(&mut density_volume(l)?.k_0)),
    constant("Rate of change K_0'", ("Its rate", "K'", "0"), NUMBER, RATE_TIP, |l| {
        Some(&mut density_volume(l)?.k_0_prime)
    }),
    constant("Doolittle's parameter B", ("Parameter", "B", ""), NUMBER, B_TIP, |l| Some(&mut doolittle(l)?.b)),
    constant("Occupied volume R_0", ("Occupied", "R", "0"), NUMBER, OCCUPIED_TIP, |l| Some(&mut doolittle(l)?.r_0)),
    constant("Volume's bulk modulus", ("Of volume", "K", "0"), MODULUS, VOLUME_BULK_TIP, |l| {
        Some(&mut other_volume(l)?.k_0)
    }),
    constant("Volume's rate of change", ("Its rate", "K'", "0"), NUMBER, VOLUME_RATE_TIP, |l| {
        Some(&mut other_volume(l)?.k_0_prime)
    }),
    constant("Critical stress", ("Critical stress", "G", "c"), STRESS, CRITICAL_TIP, critical_stress),
    constant("Exponent beta_c", ("Exponent", "β", "c"), NUMBER, BETA_TIP, beta),
    constant("Exponent n_c", ("Exponent", "n", "c"), NUMBER, N_TIP, exponent),
];

const AMBIENT_TIP: &str = "τ_L0, the limit at ambient pressure";
const EYRING_TIP: &str =
    "τ_E: above it the traction bends, τ = τ_E asinh(τ/τ_E), while the film stays Newtonian; Johnson & Tevaarwerk 1977";
const SLOPE_TIP: &str = "Λ, how the limit rises with pressure";

/// Constants of the limiting shear stress.
const LIMITS: [Constant; 3] = [
    constant("Ambient limiting stress", ("At ambient", "τ", "L0"), STRESS, AMBIENT_TIP, |l| {
        Some(&mut l.limiting_stress.as_mut()?.ambient)
    }),
    constant("Slope of the limiting stress", ("Slope", "Λ", ""), NUMBER, SLOPE_TIP, |l| {
        Some(&mut l.limiting_stress.as_mut()?.slope)
    }),
    constant("Eyring stress of the traction", ("Eyring", "τ", "E"), STRESS, EYRING_TIP, |l| {
        l.limiting_stress.as_mut()?.eyring.as_mut()
    }),
];

const SUPPLY: [Constant; 1] =
    [constant("Inlet film thickness", ("Inlet film", "h", "in"), QuantityKind::OilLayer, SUPPLY_TIP, |l| match &mut l
        .cavitation
    {
        Cavitation::MassConserving { supply_film_m } => supply_film_m.as_mut(),
        Cavitation::Penalty | Cavitation::Complementarity => None,
    })];

fn critical_stress(laws: &mut Lubricant) -> Option<&mut f64> {
    match &mut laws.shear {
        ShearLaw::Newtonian => None,
        ShearLaw::Carreau { critical_stress, .. }
        | ShearLaw::Ellis { critical_stress, .. }
        | ShearLaw::Eyring { critical_stress, .. } => Some(critical_stress),
    }
}

fn beta(laws: &mut Lubricant) -> Option<&mut f64> {
    if let ShearLaw::Carreau { beta, .. } = &mut laws.shear { Some(beta) } else { None }
}

fn exponent(laws: &mut Lubricant) -> Option<&mut f64> {
    match &mut laws.shear {
        ShearLaw::Carreau { n, .. } | ShearLaw::Ellis { n, .. } => Some(n),
        ShearLaw::Newtonian | ShearLaw::Eyring { .. } => None,
    }
}

fn density_volume(laws: &mut Lubricant) -> Option<&mut Tait> {
    if let DensityLaw::Tait(tait) = &mut laws.density { Some(tait) } else { None }
}

fn doolittle(laws: &mut Lubricant) -> Option<&mut Doolittle> {
    if let ViscosityLaw::Doolittle(law) = &mut laws.viscosity { Some(law) } else { None }
}

/// Returns the constants of the volume in Doolittle's law if they differ from those of the density law.
fn other_volume(laws: &mut Lubricant) -> Option<&mut Tait> {
    let density = laws.density;
    doolittle(laws).map(|law| &mut law.volume).filter(|volume| density != DensityLaw::Tait(**volume))
}

/// Draws the laws and constants for editing.
fn own(ui: &mut Ui, (laws, system): (&Lubricant, UnitSystem), entries: &mut Entries, commands: &mut Commands) {
    let before = *laws;
    let mut wanted = before;
    Grid::new("laws").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let present = |law: ViscosityLaw| if let ViscosityLaw::Doolittle(own) = law { own } else { DOOLITTLE };
        let options = [ViscosityLaw::Roelands, ViscosityLaw::Barus, ViscosityLaw::Doolittle(present(before.viscosity))];
        choice(
            ui,
            "Viscosity",
            "How the viscosity rises with pressure",
            &mut wanted.viscosity,
            &options,
            viscosity_law,
        );
        let present = |law: DensityLaw| if let DensityLaw::Tait(own) = law { own } else { VOLUME };
        let options =
            [DensityLaw::DowsonHigginson, DensityLaw::Incompressible, DensityLaw::Tait(present(before.density))];
        choice(ui, "Density", "How the density rises with pressure", &mut wanted.density, &options, density_law);
        let or = |default: ShearLaw| {
            let same = std::mem::discriminant(&before.shear) == std::mem::discriminant(&default);
            if same { before.shear } else { default }
        };
        let options = [ShearLaw::Newtonian, or(CARREAU), or(ELLIS), or(EYRING)];
        choice(ui, "Shear", "How the viscosity falls with shear stress", &mut wanted.shear, &options, shear_law);
    });
    let field = constants_ui(ui, entries, &CONSTANTS, &mut wanted, system);
    // If both laws share the constants of the volume, they keep sharing them.
    if let (DensityLaw::Tait(volume), DensityLaw::Tait(former)) = (wanted.density, before.density)
        && let Some(law) = doolittle(&mut wanted).filter(|law| law.volume == former)
    {
        law.volume = volume;
    }
    if wanted != before {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}

/// Draws a row for each constant that the laws have. Returns the name of the field that was changed last, otherwise
/// that of the whole group.
pub(super) fn constants_ui(
    ui: &mut Ui,
    entries: &mut Entries,
    constants: &[Constant],
    laws: &mut Lubricant,
    system: UnitSystem,
) -> &'static str {
    let mut field = GROUP;
    for Constant { name, row: (row, base, subscript), kind, tip, of } in constants {
        let Some(value) = of(laws) else { continue };
        let unit = kind.unit(system);
        ui.horizontal(|ui| {
            row_name(ui, name_and_symbol(ui, row, base, subscript), tip);
            let read = |text: &str| match kind {
                QuantityKind::Number => numbers::parse(text),
                _ => Ok(unit.number(kind.read(text, system)?)),
            };
            if let Some(entered) = typed_field(ui, entries, name, unit.number(*value), 96.0, tip, read) {
                *value = unit.si(entered);
                field = name;
            }
            ui.label(unit.name);
        });
    }
    field
}

/// Draws the limiting shear stress with its switch.
fn limiting_stress(
    ui: &mut Ui,
    (laws, system): (&Lubricant, UnitSystem),
    entries: &mut Entries,
    commands: &mut Commands,
) {
    let before = *laws;
    let mut wanted = before;
    let mut on = wanted.limiting_stress.is_some();
    let limit = ui.add(Checkbox::new(&mut on, "Limiting shear stress"));
    if named(ui, limit, "Limiting shear stress").on_hover_text(LIMITING_TIP).changed() {
        wanted.limiting_stress = on.then_some(LIMITING);
    }
    if wanted.shear == ShearLaw::Newtonian
        && let Some(limit) = &mut wanted.limiting_stress
    {
        let mut bends = limit.eyring.is_some();
        if ui.add(Checkbox::new(&mut bends, "Eyring traction")).on_hover_text(EYRING_TIP).changed() {
            limit.eyring = bends.then_some(EYRING_STRESS_PA);
        }
    }
    let field = constants_ui(ui, entries, &LIMITS, &mut wanted, system);
    if wanted != before {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}

/// Draws the cavitation model of full solutions.
fn rupture(ui: &mut Ui, (laws, system): (&Lubricant, UnitSystem), entries: &mut Entries, commands: &mut Commands) {
    let supplied = Cavitation::MassConserving { supply_film_m: laws.cavitation.supply_film_m() };
    let mut wanted = laws.cavitation;
    Grid::new("rupture").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let options = [Cavitation::Penalty, Cavitation::Complementarity, supplied];
        choice(ui, "Cavitation", RUPTURE_TIP, &mut wanted, &options, |law| match law {
            Cavitation::Penalty => ("Penalty", "A penalty limits negative pressures, Λ = −γ min(P, 0) (2.36)"),
            Cavitation::Complementarity => {
                ("Complementarity", "P ≥ 0 and λ ≥ 0 with P λ = 0 (appendix D): no negative pressure, half the steps")
            }
            Cavitation::MassConserving { .. } => (
                "Mass-conserving",
                "P ≥ 0; where P = 0 oil fills the gap to a fraction θ, so that mass is conserved (JFO, Elrod & Adams \
                 1974)",
            ),
        });
    });
    let mut wanted = Lubricant { cavitation: wanted, ..*laws };
    let mut field = GROUP;
    if let Cavitation::MassConserving { supply_film_m } = &mut wanted.cavitation {
        let mut starves = supply_film_m.is_some();
        if ui.add(Checkbox::new(&mut starves, "Starved inlet")).on_hover_text(SUPPLY_TIP).changed() {
            *supply_film_m = starves.then_some(SUPPLY_M);
        }
        field = constants_ui(ui, entries, &SUPPLY, &mut wanted, system);
    }
    if wanted != *laws {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}

fn viscosity_law(law: ViscosityLaw) -> (&'static str, &'static str) {
    match law {
        ViscosityLaw::Roelands => (
            "Roelands",
            "ln(η/η₀) = (ln η₀ + 9.67)((1 + p/0.196 GPa)^z − 1) (2.12), Roelands 1966; mineral oils to about 1 GPa",
        ),
        ViscosityLaw::Barus => ("Barus", "η = η₀ exp(αp) (2.11), Barus 1893; overestimates above some 0.5 GPa"),
        ViscosityLaw::Doolittle(_) => {
            ("Doolittle", "from the free volume that Tait’s equation leaves (3.39), Doolittle 1951; α follows from it")
        }
    }
}

fn density_law(law: DensityLaw) -> (&'static str, &'static str) {
    match law {
        DensityLaw::DowsonHigginson => (
            "Dowson–Higginson",
            "ρ/ρ₀ = (0.59 GPa + 1.34p)/(0.59 GPa + p) (2.10), Dowson & Higginson 1966; saturates at 1.34",
        ),
        DensityLaw::Incompressible => ("Incompressible", "ρ = ρ₀"),
        DensityLaw::Tait(_) => ("Tait", "from the relative volume of Tait’s equation (3.37), Dymond & Malhotra 1988"),
    }
}

fn shear_law(law: ShearLaw) -> (&'static str, &'static str) {
    match law {
        ShearLaw::Newtonian => ("Newtonian", "η does not depend on the shear stress"),
        ShearLaw::Carreau { .. } => (
            "Modified Carreau",
            "η/µ = NPR + (1 − NPR)(1 + (τ/G_c)^β)^((1 − 1/n)/β) (3.40), Carreau 1972, as modified by Bair 2004",
        ),
        ShearLaw::Ellis { .. } => {
            ("Ellis", "η/µ = NPR + (1 − NPR)/(1 + (τ/G)^(1/n − 1)), Matsuhisa & Bird 1965; Cross’s law in stress")
        }
        ShearLaw::Eyring { .. } => {
            ("Eyring", "η/µ = NPR + (1 − NPR)(τ/τ_E)/sinh(τ/τ_E), Ree & Eyring 1955; Johnson & Tevaarwerk 1977")
        }
    }
}
