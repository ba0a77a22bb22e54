//! What a reduced model holds, as text for people.

use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::transient::{Inputs, Signal};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{CIRCLES, ReducedModel, Scheme, Window};
use std::fmt::Write;

/// A model in time for people.
pub fn describe_in_time(model: &TrajectoryModel) -> String {
    let (domain, window) = (&model.domain, &model.window);
    let mut text = format!("{}\n  line contacts in time, frame {:?}\n", model.title, model.frame);
    let d = &domain.reference;
    let between =
        |(from, to): (f64, f64)| if from == to { format!("{from:.4}") } else { format!("{from:.4}…{to:.4}") };
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  M {}, L {} of the reference contacts", between(d.m), between(d.l));
    let _ = writeln!(
        text,
        "  α {} /GPa, p_H up to {:.3} GPa, η₀ {} Pa·s",
        between((d.alpha_per_pa.0 * 1e9, d.alpha_per_pa.1 * 1e9)),
        d.max_hertz_pressure_pa / 1e9,
        d.viscosity_pa_s
    );
    let _ = writeln!(text, "  density {:?}, viscosity {:?}", d.lubricant.density, d.lubricant.viscosity);
    for (name, reach) in [("load", domain.load), ("speed", domain.speed), ("radius", domain.radius)] {
        let (from, to) = reach.range;
        let _ = match reach.varies() {
            true => writeln!(text, "  {name} {from:.4}…{to:.4} of its reference, {:.4} per unit of T", reach.rate),
            false => writeln!(text, "  {name} at rest"),
        };
    }
    let _ = writeln!(text, "  steps of T {:.6}", domain.step);
    if domain.only.is_some() {
        text.push_str("  one course of inputs: along others nothing is known of its errors\n");
    }
    let ruptures = match window.cavitation {
        Cavitation::Penalty => format!("γ̄ {:e}", window.penalty),
        other => other.name().to_owned(),
    };
    let scheme = match window.scheme {
        Scheme::Galerkin => String::new(),
        other => format!(", {}", other.name()),
    };
    let (size, sampling) = (window.size(), window.sampling);
    let _ = writeln!(text, "  {}; {size} ({sampling:?}{scheme}), {ruptures}", grid_of(window));
    for (k, local) in model.locals.iter().enumerate() {
        let (size, sampling) = (local.window.size(), local.window.sampling);
        let _ = writeln!(text, "  local basis {}: {size} ({sampling:?})", k + 1);
    }
    for (k, start) in model.starts.iter().enumerate() {
        let p = &start.point;
        let _ = writeln!(
            text,
            "  training {}: R {} m, u_m {} m/s, w {} N/m, T up to {:.4}, {}",
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

/// What varies, in the words of a scene.
fn driven(inputs: &Inputs) -> String {
    let all = [("radius", &inputs.radius), ("speed", &inputs.speed), ("load", &inputs.load)];
    let told = |(name, signal): (&str, &Signal)| match signal {
        Signal::Constant => None,
        Signal::Sampled { times, .. } => Some(format!("{name} by {} samples", times.len())),
        other => Some(format!("{name} {other:?}")),
    };
    let told: Vec<String> = all.into_iter().filter_map(told).collect();
    if told.is_empty() { "at rest".to_owned() } else { told.join(", ") }
}

/// The grid of a window.
fn grid_of(window: &Window) -> String {
    match window.grid.spec() {
        GridSpec::Uniform { dx, domain } => {
            format!("uniform, dx {dx}, {}…{}", domain.0, domain.1)
        }
        GridSpec::Graded { nodes, domain, registered } => {
            let registered = if registered { ", registered" } else { "" };
            format!("graded, {nodes} nodes, ξ {}…{}{registered}", domain.0, domain.1)
        }
        GridSpec::Plane(spec) => {
            let ((nx, ny), (from, to, edge)) = (window.grid.nodes(), spec.domain);
            format!("{nx}×{ny} nodes, X {from}…{to}, Y {edge}…0")
        }
    }
}

/// The model for people.
pub fn describe(model: &ReducedModel) -> String {
    let mut text = format!("{}\n  {} contacts\n", model.title, model.contact().name());
    let d = &model.domain;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  M {}…{}, L {}…{}", d.m.0, d.m.1, d.l.0, d.l.1);
    let _ = writeln!(
        text,
        "  α {:.3}…{:.3} /GPa, p_H up to {:.3} GPa, η₀ {}",
        d.alpha_per_pa.0 * 1e9,
        d.alpha_per_pa.1 * 1e9,
        d.max_hertz_pressure_pa / 1e9,
        d.oils.map_or_else(
            || format!("{} Pa·s", d.viscosity_pa_s),
            |oils| {
                let ((from, to), (least, most)) = (oils.viscosity_pa_s, oils.exponent);
                format!(
                    "{from}…{to} Pa·s, Roelands’ z {least}…{most}, p_H from {:.3} GPa",
                    oils.lowest_hertz_pressure_pa / 1e9
                )
            }
        )
    );
    let _ = writeln!(text, "  density {:?}, viscosity {:?}", d.lubricant.density, d.lubricant.viscosity);
    if let Some(sliding) = d.sliding {
        let ((srr, most), (npr, full)) = (sliding.srr, sliding.npr);
        let modulus = sliding.modulus_pa / 1e9;
        let _ = writeln!(text, "  SRR {srr}…{most}, NPR {npr}…{full}, E′ {modulus:.3} GPa, {:?}", d.lubricant.shear);
    }
    if let Some(eyring) = d.eyring {
        let ((srr, most), (low, high), (from, to)) = (eyring.srr, eyring.modulus_pa, eyring.limit_slope);
        let [low, high] = [low, high].map(|modulus| modulus * 1e-9);
        let law = d.lubricant.shear;
        let _ = writeln!(
            text,
            "  SRR {srr}…{most}, E′ {low:.3}…{high:.3} GPa, {law:?}, Λ of limiting stresses {from}…{to}"
        );
    }
    if let Some((heat, laws)) = d.heat.zip(d.lubricant.heat) {
        let ((srr, most), inlet) = (heat.srr, laws.inlet_temperature);
        let interval = |(low, high): (f64, f64), scale: f64| {
            if low == high { format!("{:.3}", low * scale) } else { format!("{}…{}", low * scale, high * scale) }
        };
        let (radius, modulus) = (interval(heat.radius_m, 1e3), interval(heat.modulus_pa, 1e-9));
        let speeds = d.oils.map_or_else(String::new, |_| {
            let ((slowest, fastest), sliding) = (heat.speed_m_per_s, heat.fastest_sliding_m_per_s);
            format!(", u_m {slowest}…{fastest} m/s, SRR u_m up to {sliding} m/s")
        });
        let shear = d.lubricant.shear;
        let _ = writeln!(
            text,
            "  heat: SRR {srr}…{most}, R {radius} mm, E′ {modulus} GPa{speeds}, inlet {inlet} K, {shear:?}"
        );
        if let Some(thermal) = heat.thermal {
            let [(cold, hot), (from, to), (least, highest)] =
                [thermal.inlet_temperature, thermal.effusivity, thermal.limit_slope];
            let _ = writeln!(
                text,
                "  and any inlet of {cold}…{hot} K, bodies of √(kρc) {from}…{to} J/(m² K √s), limits of Λ {least}…{highest}"
            );
        }
    }
    if d.radius_ratio != CIRCLES {
        let _ = writeln!(text, "  R_y/R {}…{}", d.radius_ratio.0, d.radius_ratio.1);
    }
    for window in &model.windows {
        let grid = grid_of(window);
        let shapes = window
            .shapes
            .as_ref()
            .map_or_else(String::new, |shapes| format!(", R_y/R {}…{}", shapes.radius_ratio.0, shapes.radius_ratio.1));
        let scheme = match window.scheme {
            Scheme::Galerkin => String::new(),
            other => format!(", {}", other.name()),
        };
        let _ = writeln!(
            text,
            "  window M {}…{}{shapes}: {grid}; {} snapshots, {} ({:?}{scheme}), {}",
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
