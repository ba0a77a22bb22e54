//! Results of a contact, and how they were checked.

use super::inputs::regime;
use super::rows::{Section, measured, number, percent};
use super::stated::Stated;
use crate::scene::answer::Answer;
use crate::scene::contact_result::ContactResult;
use crate::scene::subsurface::Subsurface;
use crate::solver::full::Lubrication;
use crate::solver::physics::bodies::film_regime;
use crate::solver::physics::contact::FilmShape;
use crate::solver::physics::engineering::{Extent, Losses, QuantityKind as K, UnitSystem};

/// Returns the sections of the results. The first answer is the reference.
pub fn sections(stated: &Stated, solved: &[Answer], below: Option<&Subsurface>) -> Vec<Section> {
    let Some((first, others)) = solved.split_first() else { return Vec::new() };
    let system = stated.system;
    let mut all = vec![film(stated, first), friction(&first.result, system)];
    all.extend(temperatures(first, system));
    all.extend(below.map(|below| stresses(below, system)));
    all.push(trust(first, others, system));
    all
}

fn film(stated: &Stated, solved: &Answer) -> Section {
    let result = &solved.result;
    let (point, hertz) = (&result.point, result.point.hertz());
    let mut part = Section::new("Film and pressure", stated.system);
    part.measure("Central film thickness {h_c}", result.value("h_c_m"), K::FilmThickness);
    let least = result.value("h_min_m");
    part.measure("Minimum film thickness {h_min}", least, K::FilmThickness);
    let own = result.value("mixed.film_ratio_min");
    let share = result.value("mixed.asperity_load_share");
    if let Some(ratio) = own.or_else(|| stated.pair?.film_ratio(least?).ok()) {
        let regime = share.map_or_else(|| film_regime(ratio), |share| Lubrication::of(share).name());
        part.row("Film ratio {λ}", format!("{} ({regime})", number(ratio)));
    }
    if let Some(share) = share {
        part.row("Load on asperities", percent(share));
    }
    part.measure("Hertzian pressure {p_H}", hertz.pressure_pa, K::Pressure);
    part.measure("Maximum pressure", result.value("P_max").map(|p| p * hertz.pressure_pa), K::Pressure);
    match FilmShape::of(point) {
        FilmShape::Line => part.measure("Half width {a}", hertz.half_width_m, K::Length),
        FilmShape::CIRCLE => part.measure("Contact radius {a}", hertz.half_width_m, K::Length),
        FilmShape::Ellipse(_) => {
            let [along, across] =
                [hertz.half_width_m, hertz.half_length_m].map(|axis| measured(K::Length, axis, stated.system));
            part.row("Semi-axes {a}, {b}", format!("{along}, {across}"));
        }
    }
    for (name, value) in regime(solved) {
        part.row(name, value);
    }
    part
}

fn friction(result: &ContactResult, system: UnitSystem) -> Section {
    let mut part = Section::new("Friction and power", system);
    let (Some(traction), Some(rolling)) = (result.traction, result.rolling_resistance) else { return part };
    let sliding = result.point.sliding.slide_to_roll_ratio;
    part.row("Friction coefficient {µ}", if sliding == 0.0 { "0, pure rolling".to_owned() } else { number(traction) });
    if let Some((fluid, boundary)) =
        result.value("mixed.fluid_traction").zip(result.value("mixed.boundary_traction")).filter(|_| sliding != 0.0)
    {
        part.row("of the film, of asperities", format!("{}, {}", number(fluid), number(boundary)));
    }
    if let Some(losses) = result.losses() {
        part.measure("Friction force", losses.friction_n, K::Force);
        part.measure("Rolling resistance of each body", losses.rolling_n, K::Force);
        for (name, torque) in ["Torque of body 1", "Torque of body 2"].into_iter().zip(losses.torques_nm) {
            part.measure(name, torque, K::Torque);
        }
        part.measure("Power loss", losses.power_w, K::Power);
    } else if let Some(losses) =
        Losses::of(&result.point, traction, rolling, &Extent { length_m: Some(1.0), ..result.extent })
    {
        part.measure("Friction force", losses.friction_n, K::LineLoad);
        part.measure("Rolling resistance of each body", losses.rolling_n, K::LineLoad);
        part.measure("Power loss", losses.power_w, K::PowerPerLength);
    }
    part
}

fn temperatures(solved: &Answer, system: UnitSystem) -> Option<Section> {
    let heat = solved.result.heat.as_ref()?;
    let inlet = solved.request.lubricant.heat?.inlet_temperature;
    let mut part = Section::new("Temperatures", system);
    let [first, second] = heat.central.surfaces_k;
    let at = |rise: f64| measured(K::Temperature, inlet + rise, system);
    part.row("Mid-film at {X} = 0", at(heat.central.mid_film_k));
    part.row("Surfaces 1, 2 at {X} = 0", format!("{}, {}", at(first), at(second)));
    part.row("Maximum in the film", at(heat.outside_spike.mid_film_k));
    if let Some(spike) = heat.in_spike {
        part.row("Maximum in the pressure spike", at(spike.mid_film_k));
    }
    Some(part)
}

fn stresses(below: &Subsurface, system: UnitSystem) -> Section {
    let shown = |kind, si| measured(kind, si, system);
    let mut part = Section::new("Stress below the surface of body 1", system);
    for (name, stress, depth) in [
        ("Maximum von Mises stress", below.von_mises_max_pa, below.von_mises_depth_m),
        ("Maximum shear stress", below.shear_max_pa, below.shear_depth_m),
        ("Orthogonal shear stress", below.orthogonal_shear_max_pa, below.orthogonal_shear_depth_m),
    ] {
        part.row(name, format!("{}, {} deep", shown(K::Pressure, stress), shown(K::Length, depth)));
    }
    part
}

fn trust(first: &Answer, others: &[Answer], system: UnitSystem) -> Section {
    let mut part = Section::new("Method and accuracy", system);
    for result in std::iter::once(first).chain(others).map(|answer| &answer.result) {
        let nodes = match result.nodes {
            (nx, 1) => nx.to_string(),
            (nx, ny) => format!("{nx} × {ny}"),
        };
        let ending = if result.converged { "converged" } else { "not converged" };
        let how = match &result.reduced {
            Some(reduced) => {
                let range = if reduced.trained { "inside" } else { "outside" };
                format!("{}, {range} the trained range, {ending}", reduced.size)
            }
            None => format!("{} grid, {nodes} nodes, {ending}", result.grid),
        };
        part.row(if result.reduced.is_some() { "Reduced model" } else { "Full solution" }, how);
        if let Some(cost) = result.grid_cost {
            let [ends, spacing] = [cost.truncation, cost.resolution].map(percent);
            part.row("Grid errors of {h_c}", format!("domain {ends}, spacing {spacing} (estimated)"));
        }
        part.row(
            "Load-balance residual",
            result.value("load_residual").map_or_else(String::new, |residual| format!("{residual:.1e}")),
        );
        if let Some(error) = result.reduced.as_ref().and_then(|reduced| reduced.error) {
            let traction = error.traction.map_or_else(String::new, |t| format!(", µ {}", percent(t.bound)));
            let [h_c, h_min] = [error.h_c.bound, error.h_min.bound].map(percent);
            part.row("99 % error bounds", format!("{{h_c}} {h_c}, {{h_min}} {h_min}{traction}"));
        }
    }
    for other in others {
        let off = |name: &str| {
            let (here, there) = (first.result.value(name)?, other.result.value(name)?);
            (here != 0.0).then(|| percent((there - here) / here))
        };
        let differences: Vec<String> = [("{h_c}", "h_c_m"), ("{h_min}", "h_min_m"), ("{µ}", "traction")]
            .into_iter()
            .filter_map(|(symbol, name)| Some(format!("{symbol} {}", off(name)?)))
            .collect();
        let name = format!("{} against {}", other.result.method, first.result.method);
        part.row(&name, differences.join(", "));
    }
    part
}
