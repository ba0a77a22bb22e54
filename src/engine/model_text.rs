//! Text descriptions of reduced models for users.

use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::transient::{Inputs, Signal};
use crate::solver::limits::digits;
use crate::solver::parameters::Quantity;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Domain, ReducedModel, Scheme, Window};
use std::fmt::Write;

/// Describes a transient model.
pub fn describe_in_time(model: &TrajectoryModel) -> String {
    let (domain, window) = (&model.domain, &model.window);
    let kind = window.grid.kind();
    let (contacts, unit) = (if kind.is_line() { "line" } else { "circular" }, kind.load_unit());
    let mut text = format!("{}\n  transient {contacts} contacts, frame {:?}\n", model.title, model.frame);
    // Writing to a string cannot fail.
    text.push_str(&describe_domain(&domain.reference));
    for (name, reach) in [("load", domain.load), ("speed", domain.speed), ("radius", domain.radius)] {
        let (from, to) = reach.range;
        let _ = match reach.varies() {
            true => writeln!(text, "  {name} {from:.4}…{to:.4} of its reference, {:.4} per unit of T", reach.rate),
            false => writeln!(text, "  {name} constant"),
        };
    }
    let _ = writeln!(text, "  steps of T {:.6}", domain.step);
    if domain.only.is_some() {
        text.push_str("  one course of inputs: errors along other courses are unknown\n");
    }
    let cavitation = match window.cavitation {
        Cavitation::Penalty => format!("γ̄ {:e}", window.penalty),
        other => other.name().to_owned(),
    };
    let scheme = match window.scheme {
        Scheme::Galerkin => String::new(),
        other => format!(", {}", other.name()),
    };
    let (size, sampling) = (window.size(), window.sampling);
    let _ = writeln!(text, "  {}; {size} ({sampling:?}{scheme}), {cavitation}", grid_of(window));
    for (k, local) in model.locals.iter().enumerate() {
        let (size, sampling) = (local.window.size(), local.window.sampling);
        let _ = writeln!(text, "  local basis {}: {size} ({sampling:?})", k + 1);
    }
    for (k, start) in model.starts.iter().enumerate() {
        let p = &start.point;
        let _ = writeln!(
            text,
            "  training {}: R {} m, u_m {} m/s, w {} {unit}, T up to {:.4}, {}",
            k + 1,
            p.radius_m,
            p.speed_m_per_s,
            p.load,
            start.duration,
            driven(&start.inputs)
        );
    }
    for line in &model.log {
        let _ = writeln!(text, "  {line}");
    }
    text
}

/// Describes the varying inputs, in the notation of scenes.
fn driven(inputs: &Inputs) -> String {
    let all = [("radius", &inputs.radius), ("speed", &inputs.speed), ("load", &inputs.load)];
    let told = |(name, signal): (&str, &Signal)| match signal {
        Signal::Constant => None,
        Signal::Sampled { values, .. } => Some(match values[..] {
            [value] => format!("{name} at {value}"),
            _ => format!("{name} by {} samples", values.len()),
        }),
        other => Some(format!("{name} {other:?}")),
    };
    let told: Vec<String> = all.into_iter().filter_map(told).collect();
    if told.is_empty() { "constant inputs".to_owned() } else { told.join(", ") }
}

/// Describes the grid of a local model.
fn grid_of(window: &Window) -> String {
    match window.grid.spec() {
        GridSpec::Uniform { dx, domain } => {
            format!("uniform, dx {dx}, {}…{}", domain.0, domain.1)
        }
        GridSpec::Graded { nodes, domain, registered } => {
            let registered = if registered { ", registered" } else { "" };
            format!("graded, {nodes} nodes, ξ {}…{}{registered}", domain.0, domain.1)
        }
        GridSpec::Following { domain, .. } => {
            format!("following the film, {} nodes, {}…{}", window.grid.nodes().0, domain.0, domain.1)
        }
        GridSpec::Plane(spec) => {
            let ((nx, ny), (from, to, edge)) = (window.grid.nodes(), spec.domain);
            format!("{nx}×{ny} nodes, X {from}…{to}, Y {edge}…0")
        }
    }
}

/// Describes the varied, limited and fixed quantities of a trained range, and the laws of its lubricant, one per line.
fn describe_domain(domain: &Domain) -> String {
    let interval = |quantity: Quantity, (low, high): (f64, f64)| {
        let shown = quantity.unit_in_sentences(domain.contact);
        let unit = if shown.name.is_empty() { String::new() } else { format!(" {}", shown.name) };
        let [low, high] = [low, high].map(|value| digits(shown.number(value)));
        let ends = if low == high { low } else { format!("{low}…{high}") };
        format!("{} {ends}{unit}", quantity.short())
    };
    let space = &domain.space;
    let axes =
        space.axes.iter().map(|axis| interval(axis.quantity, domain.interval(axis.quantity).unwrap_or(axis.ends)));
    let limits = space.limits.iter().filter(|(limited, _)| !space.gives(*limited));
    let limits = limits.map(|(limited, ends)| interval(*limited, *ends));
    let fixed = space.fixed.iter().map(|(fixed, value)| interval(*fixed, (*value, *value)));
    let constants = space.constants.iter().map(|axis| interval(axis.quantity, axis.ends));
    let lists: [(&str, Vec<String>); 4] = [
        ("varies", axes.collect()),
        ("limits", limits.collect()),
        ("fixes", fixed.collect()),
        ("any", constants.collect()),
    ];
    let lists = lists.into_iter().filter(|(_, list)| !list.is_empty());
    let mut text: String = lists.map(|(name, list)| format!("  {name}: {}\n", list.join(", "))).collect();
    let Lubricant { density, viscosity, shear, heat, roughness, .. } = domain.lubricant;
    let _ = writeln!(text, "  density {density:?}, viscosity {viscosity:?}, shear {shear:?}");
    if let Some(rough) = roughness {
        let _ = writeln!(text, "  rough surfaces, trained with {:?}, γ {}", rough.asperities, rough.peklenik);
    }
    if let Some(heat) = heat {
        let _ = writeln!(text, "  thermal, inlet {} K", heat.inlet_temperature);
    }
    text
}

/// Describes a steady model.
pub fn describe(model: &ReducedModel) -> String {
    let mut text = format!("{}\n  {} contacts\n", model.title, model.contact().name());
    text.push_str(&describe_domain(&model.domain));
    for window in &model.windows {
        let grid = grid_of(window);
        let shapes = window
            .shapes
            .as_ref()
            .map_or_else(String::new, |shapes| format!(", R_y/R {}…{}", shapes.ratios.0, shapes.ratios.1));
        let scheme = match window.scheme {
            Scheme::Galerkin => String::new(),
            other => format!(", {}", other.name()),
        };
        let _ = writeln!(
            text,
            "  local model M {}…{}{shapes}: {grid}; {} snapshots, {} ({:?}{scheme}), {}",
            window.m.0,
            window.m.1,
            window.snapshots.len(),
            window.size(),
            window.sampling,
            match window.cavitation {
                Cavitation::Penalty => format!("γ̄ {:e}", window.penalty),
                other => other.name().to_owned(),
            }
        );
    }
    for line in &model.log {
        let _ = writeln!(text, "  {line}");
    }
    text
}
