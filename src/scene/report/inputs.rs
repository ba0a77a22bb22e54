//! Inputs of a contact.

use super::rows::{Section, measured, number, percent};
use super::stated::Stated;
use crate::scene::answer::Answer;
use crate::scene::regime::{Ratios, RegimeMap};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{FilmShape, OperatingPoint};
use crate::solver::physics::engineering::{QuantityKind as K, UnitSystem};
use crate::solver::physics::lubricant::{Cavitation, DensityLaw, Lubricant, ShearLaw, ViscosityLaw};
use crate::solver::physics::surfaces::{AsperityLaw, Roughness};

/// Returns the sections of the inputs.
pub fn sections(stated: &Stated, solved: &Answer) -> Vec<Section> {
    let system = stated.system;
    let (point, lubricant) = (&solved.result.point, &solved.request.lubricant);
    vec![
        bodies(stated, solved),
        operation(solved, system),
        oil(stated, point, lubricant),
        surfaces(lubricant.roughness.filter(|_| lubricant.is_rough()).as_ref(), system),
    ]
}

fn bodies(stated: &Stated, solved: &Answer) -> Section {
    let point = &solved.result.point;
    let mut part = Section::new("Contact and bodies", stated.system);
    part.row("Contact", FilmShape::of(point).name());
    part.measure("Length", solved.request.extent.length_m, K::Length);
    part.row("Body 1", stated.bodies[0].clone());
    part.row("Body 2", stated.bodies[1].clone());
    part.measure("Reduced radius {R}", point.radius_m, K::Length);
    part.measure("Across {R_y}", point.radius_y_m.filter(|_| point.is_elliptic()), K::Length);
    part.measure("Reduced modulus {E}’", point.modulus_pa, K::Pressure);
    part
}

fn operation(solved: &Answer, system: UnitSystem) -> Section {
    let point = &solved.result.point;
    let shown = |kind, si| measured(kind, si, system);
    let mut part = Section::new("Operation", system);
    let load = Quantity::Load.kind(point.kind);
    match solved.request.extent.length_m.filter(|_| point.kind.is_line()) {
        Some(length) => {
            let total = shown(K::Force, point.load * length);
            part.row("Load {w}", format!("{}, {total} in total", shown(load, point.load)));
        }
        None => part.measure("Load {w}", point.load, load),
    }
    part.measure("Entrainment speed {u_m}", point.speed_m_per_s, K::Speed);
    let sliding = point.sliding.slide_to_roll_ratio;
    part.row("Slide-to-roll ratio SRR", if sliding == 0.0 { "0, pure rolling".to_owned() } else { percent(sliding) });
    if sliding != 0.0 {
        let [first, second] = point.surface_speeds().map(|speed| shown(K::Speed, speed));
        part.row("Surface speeds {u_1}, {u_2}", format!("{first}, {second}"));
    }
    let cavitation = &solved.result.cavitation;
    part.row(
        "Oil supply",
        match cavitation.supply_film_m() {
            Some(film) => format!("starved, inlet film {}", shown(K::FilmThickness, film)),
            None => "fully flooded".to_owned(),
        },
    );
    part.row(
        "Cavitation",
        match cavitation {
            Cavitation::Penalty => "penalty",
            Cavitation::Complementarity => "complementarity",
            Cavitation::MassConserving { .. } => "mass-conserving (Elrod–Adams)",
        },
    );
    part
}

fn oil(stated: &Stated, point: &OperatingPoint, lubricant: &Lubricant) -> Section {
    let mut part = Section::new("Lubricant", stated.system);
    let shown = |kind, si| measured(kind, si, stated.system);
    part.row("Oil", stated.oil.clone());
    part.measure("Viscosity {η_0} at {p} = 0", point.viscosity_pa_s, K::Viscosity);
    part.measure("Pressure coefficient {α}", point.alpha_per_pa, K::PressureCoefficient);
    let viscosity = match lubricant.viscosity {
        ViscosityLaw::Barus => "Barus",
        ViscosityLaw::Roelands => "Roelands",
        ViscosityLaw::Doolittle(_) => "Doolittle",
    };
    let density = match lubricant.density {
        DensityLaw::Incompressible => "incompressible",
        DensityLaw::DowsonHigginson => "Dowson–Higginson",
        DensityLaw::Tait(_) => "Tait",
    };
    part.row("Viscosity, density", format!("{viscosity}, {density}"));
    let plateau = || {
        let ratio = point.sliding.newtonian_plateau_ratio.unwrap_or(lubricant.shear.plateau());
        if ratio == 0.0 { String::new() } else { format!(", plateau ratio {}", number(ratio)) }
    };
    part.row(
        "Shear law",
        match lubricant.shear {
            ShearLaw::Newtonian => "Newtonian".to_owned(),
            ShearLaw::Eyring { critical_stress, .. } => {
                format!("Eyring, {}{}", shown(K::Stress, critical_stress), plateau())
            }
            ShearLaw::Carreau { critical_stress, n, beta, .. } => {
                let [n, beta] = [n, beta].map(number);
                format!("Carreau, {}, n {n}, β {beta}{}", shown(K::Stress, critical_stress), plateau())
            }
            ShearLaw::Ellis { critical_stress, n, .. } => {
                format!("Ellis, {}, n {}{}", shown(K::Stress, critical_stress), number(n), plateau())
            }
        },
    );
    if let Some(limit) = lubricant.limiting_stress {
        let own = shown(K::Stress, limit.ambient);
        part.row("Limiting shear stress", format!("{own} + {} {{p}}", number(limit.slope)));
    }
    match &lubricant.heat {
        None => part.row("Temperature", "isothermal at the inlet temperature"),
        Some(heat) => {
            part.row("Inlet temperature", shown(K::Temperature, heat.inlet_temperature));
            let oil = &heat.oil;
            let constants = |c: f64, k: f64, density: f64| {
                let [c, k] = [shown(K::HeatCapacity, c), shown(K::Conductivity, k)];
                format!("c {c}, k {k}, ρ {}", shown(K::Density, density))
            };
            part.row("Heat of the oil", constants(oil.heat_capacity, oil.conductivity, oil.density));
            if oil.free_volume.is_none() {
                part.row("Viscosity over temperature", format!("β {}", shown(K::PerKelvin, oil.viscosity_temperature)));
            }
            for (name, body) in ["Heat of body 1", "Heat of body 2"].into_iter().zip(&heat.bodies) {
                part.row(name, constants(body.heat_capacity, body.conductivity, body.density));
            }
        }
    }
    part
}

fn surfaces(roughness: Option<&Roughness>, system: UnitSystem) -> Section {
    let mut part = Section::new("Surfaces", system);
    let Some(rough) = roughness else {
        part.row("In the model", "smooth");
        return part;
    };
    part.measure("Composite roughness {σ}", rough.sigma, K::FilmThickness);
    part.row(
        "Asperity contact",
        match rough.asperities {
            AsperityLaw::GreenwoodTripp { .. } => "Greenwood–Tripp",
            AsperityLaw::ZhaoMaiettaChang { .. } => "Zhao–Maietta–Chang",
            AsperityLaw::Exponential { .. } => "exponential",
        },
    );
    let isotropic = if rough.peklenik == 1.0 { ", isotropic" } else { "" };
    part.row("Peklenik number {γ}", format!("{}{isotropic}", number(rough.peklenik)));
    part.row("Boundary friction {µ_b}", number(rough.boundary_friction));
    part
}

/// Returns M, L and the regime.
pub fn regime(solved: &Answer) -> [(&'static str, String); 2] {
    let point = &solved.result.point;
    let moes = point.moes();
    let estimate = || RegimeMap::new(FilmShape::of(point)).at(moes);
    let ratios = solved.fields().map_or_else(estimate, Ratios::of);
    let numbers = format!("{}, {}", number(moes.m), number(moes.l));
    [("Moes’ numbers {M}, {L}", numbers), ("Regime", ratios.regime().title().to_lowercase())]
}
