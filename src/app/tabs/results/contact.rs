//! Table of the results for the present contact, without a study. It compares the reduced model with the full solution,
//! if there is one, and is shown next to the published film formulas.

use crate::app::answers::picture::{Origin, Picture};
use crate::app::context::Context;
use crate::app::drawn::{self, Owner};
use crate::app::export::describe;
use crate::app::theme::{Palette, rich};
use crate::app::{badge, formulas, numbers};
use crate::scene::Table;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Grid, ScrollArea, Ui};

/// Width above which the formulas are next to the table, and not below it \[points\].
const BESIDE: f32 = 860.0;

/// Values below this limit are rounding errors.
const ROUNDING: f64 = 1e-9;

/// Quantity of a picture.
struct Quantity {
    /// Name on the screen, with its symbol.
    name: &'static str,
    /// Name in files.
    symbol: &'static str,
    /// Tooltip.
    tip: &'static str,
    /// Value as computed, mostly dimensionless.
    value: f64,
    /// Value with its unit, empty for some dimensionless quantities.
    with_unit: String,
}

/// Returns the displayed quantities from top to bottom.
fn quantities(picture: &Picture, system: UnitSystem) -> Vec<Quantity> {
    let (s, point) = (picture.solution.scalars, &picture.key.point);
    let hertz = point.hertz();
    let film = |h: f64| numbers::length(h * point.film_scale_m(), system);
    let place = |x: f64| numbers::length(x * hertz.half_width_m, system);
    let pressure = |p: f64| numbers::pressure(p * hertz.pressure_pa, system);
    let rolling = picture.solution.rolling_resistance();
    let quantity = |name, symbol, tip, value, with_unit| Quantity { name, symbol, tip, value, with_unit };
    vec![
        quantity(
            "Central film thickness {H_c}",
            "H_c",
            "Film thickness at X = 0 and Y = 0; H = hR/a² (2.22)",
            s.h_c,
            film(s.h_c),
        ),
        quantity(
            "Minimum film thickness {H_min}",
            "H_min",
            "Minimum film thickness of the contact zone",
            s.h_min,
            film(s.h_min),
        ),
        quantity("at {X}", "X_H_min", "Position of the minimum film thickness", s.x_h_min, place(s.x_h_min)),
        quantity(
            "Central pressure {P_c}",
            "P_c",
            "Pressure at X = 0 and Y = 0; P = p/p_H (2.22)",
            s.p_c,
            pressure(s.p_c),
        ),
        quantity("Maximum pressure {P_max}", "P_max", "Maximum pressure of all nodes", s.p_max, pressure(s.p_max)),
        quantity("at {X}", "X_P_max", "Position of the maximum pressure", s.x_p_max, place(s.x_p_max)),
        quantity(
            "Rigid separation {H_0}",
            "H_0",
            "Rigid-body separation, with the kernel of (2.27) or (2.25)",
            s.h_0,
            String::new(),
        ),
        quantity("Traction coefficient {µ}", "traction", TRACTION, picture.traction, friction(picture, system)),
        quantity(
            "Rolling resistance",
            "rolling_resistance_over_load",
            ROLLING,
            rolling / point.load,
            numbers::load(rolling, point.kind, system),
        ),
        quantity(
            "Load residual",
            "load_residual",
            "Load-balance residual, relative to the load",
            s.load_residual,
            String::new(),
        ),
    ]
    .into_iter()
    .chain(temperatures(picture, system))
    .collect()
}

/// Returns temperature rises \[K\], and heat flows as shares of the generated heat. Empty for an isothermal contact.
fn temperatures(picture: &Picture, system: UnitSystem) -> Vec<Quantity> {
    let Some(heat) = picture.solution.heat.as_deref() else { return Vec::new() };
    let balance = &heat.balance;
    let generated = balance.sheared + balance.compressed;
    let rise = |name, symbol, tip, value: f64| {
        let with_unit = numbers::shown(QuantityKind::TemperatureRise, value, system);
        Quantity { name, symbol, tip, value, with_unit }
    };
    let share = |name, symbol, tip, value: f64| {
        let with_unit = numbers::percent(value);
        Quantity { name, symbol, tip, value, with_unit }
    };
    [
        rise("Rise at mid-film", "mid_film_rise_k", "Above the inlet temperature, at X = 0", heat.central.mid_film_k),
        rise(
            "Rise of body 1",
            "surface_1_rise_k",
            "Temperature rise of its surface at X = 0",
            heat.central.surfaces_k[0],
        ),
        rise(
            "Rise of body 2",
            "surface_2_rise_k",
            "Temperature rise of its surface at X = 0",
            heat.central.surfaces_k[1],
        ),
        rise(
            "Largest rise in the film",
            "mid_film_rise_outside_spike_k",
            "At mid-film under pressure, without the pressure spike",
            heat.outside_spike.mid_film_k,
        ),
    ]
    .into_iter()
    .chain(heat.in_spike.map(|spike| rise("Rise in the spike", "mid_film_rise_in_spike_k", SPIKE, spike.mid_film_k)))
    .chain([
        share(
            "Heat into body 1",
            "heat_into_body_1",
            "Share of the heat from shear and compression",
            balance.into_bodies[0] / generated,
        ),
        share(
            "Heat into body 2",
            "heat_into_body_2",
            "Share of the heat from shear and compression",
            balance.into_bodies[1] / generated,
        ),
        share("Heat with the oil", "heat_with_the_oil", "Carried out of the contact", balance.carried / generated),
        share(
            "Heat residual",
            "energy_balance",
            "Heat-balance residual: heat generated minus heat removed",
            balance.residual(),
        ),
    ])
    .collect()
}

/// Tooltip of the rise in the pressure spike.
const SPIKE: &str = "Largest rise at mid-film in the pressure spike. It is a needle much narrower than the contact; \
                     finer grids make it higher";

/// Tooltip of the rolling resistance.
const ROLLING: &str = "½∫h dp of each body, over the load; it is present in pure rolling too";

/// Tooltip of the traction coefficient.
const TRACTION: &str = "Shear stress at mid-film over the whole domain, over the load (3.41); zero in pure rolling";

/// Returns the friction force with its unit, or a mark that states why the traction is not physical.
fn friction(picture: &Picture, system: UnitSystem) -> String {
    let force = picture.traction * picture.key.point.load;
    picture
        .unphysical
        .map_or_else(|| numbers::load(force, picture.key.point.kind, system), |doubt| doubt.mark().to_owned())
}

/// Returns the current picture. If the reduced model computed it, returns the full solution of the same contact too,
/// if there is one.
fn columns<'a>(context: &Context<'a>) -> Option<(&'a Picture, Option<&'a Picture>)> {
    let picture = context.answers.picture()?;
    let full = context.answers.full();
    Some((picture, full.filter(|full| picture.origin != Origin::Full && full.key == picture.key)))
}

fn name(picture: &Picture) -> &'static str {
    if picture.origin == Origin::Full { "Full solution" } else { "Reduced model" }
}

/// Draws the table.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let Some((picture, full)) = columns(context) else {
        ui.weak("The first picture is being computed");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "results", Owner::Contact(picture.key), context);
    badge::ui(ui, context);
    ui.add_space(4.0);
    ScrollArea::both().id_salt("results of the contact").auto_shrink(false).show(ui, |ui| {
        if stale {
            ui.disable();
        }
        if ui.available_width() > BESIDE {
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| table_ui(ui, picture, full, context.system));
                ui.add_space(18.0);
                ui.vertical(|ui| formulas::table(ui, context));
            });
        } else {
            table_ui(ui, picture, full, context.system);
            ui.add_space(8.0);
            formulas::table(ui, context);
        }
    });
}

fn table_ui(ui: &mut Ui, picture: &Picture, full: Option<&Picture>, system: UnitSystem) {
    let palette = Palette::of(ui);
    let text = ui.visuals().text_color();
    Grid::new("results of the contact").striped(true).spacing([16.0, 5.0]).show(ui, |ui| {
        let mut titles = vec!["", name(picture), "with units"];
        if full.is_some() {
            titles.extend(["Full solution", "Deviation"]);
        }
        for title in titles {
            ui.label(rich(title, 12.5, palette.quiet));
        }
        ui.end_row();
        let full_quantities = full.map(|full| quantities(full, system)).unwrap_or_default();
        for Quantity { name, symbol, tip, value, with_unit } in quantities(picture, system) {
            ui.label(rich(name, 13.5, text)).on_hover_text(tip);
            ui.strong(numbers::significant(value)).on_hover_text(tip);
            ui.label(with_unit);
            if let Some(full_value) = value_of(symbol, &full_quantities) {
                ui.label(numbers::significant(full_value)).on_hover_text(tip);
                // A full value that is zero up to rounding has no relative deviation.
                let nonzero = full_value.abs() > ROUNDING;
                let deviation = if nonzero { numbers::percent(value / full_value - 1.0) } else { String::new() };
                ui.label(deviation).on_hover_text("Reduced over full, minus one");
            }
            ui.end_row();
        }
    });
}

/// Returns the value of a quantity. `None` if the picture does not have it: not every thermal contact has a rise in the
/// spike.
fn value_of(symbol: &str, quantities: &[Quantity]) -> Option<f64> {
    quantities.iter().find(|quantity| quantity.symbol == symbol).map(|quantity| quantity.value)
}

/// Returns the table as CSV. `None` without a picture.
pub fn csv(context: &Context<'_>) -> Option<String> {
    let (picture, full) = columns(context)?;
    let mut titles = vec![if picture.origin == Origin::Full { "full" } else { "reduced" }];
    titles.extend(full.map(|_| "full"));
    let mut table = Table::new("contact", &titles);
    let of = |picture| quantities(picture, context.system);
    let full_quantities = full.map(of);
    for Quantity { symbol, value, .. } in of(picture) {
        table.labels.push(symbol.to_owned());
        let full = full_quantities.as_ref().map(|full| value_of(symbol, full).unwrap_or(f64::NAN));
        table.rows.push(std::iter::once(value).chain(full).collect());
    }
    Some(format!("# {}\n# {}\n{}", describe(picture), context.answers.means(), table.to_csv()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_paired_by_their_names() {
        let of = |symbol, value| Quantity { name: "", symbol, tip: "", value, with_unit: String::new() };
        let full = [of("mid_film_rise_k", 30.0), of("heat_into_body_1", 0.4)];
        assert_eq!(value_of("heat_into_body_1", &full), Some(0.4));
        assert_eq!(value_of("mid_film_rise_in_spike_k", &full), None);
    }
}
