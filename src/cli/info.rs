//! `info`: what a reduced model holds.

use super::failure::Failure;
use super::{Verdict, output};
use crate::engine::arrays::npz;
use crate::engine::{EngineError, model_arrays, model_file};
use crate::scene::atomic_file;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{CIRCLES, ReducedModel, Scheme};
use std::fmt::Write;
use std::path::Path;

/// Runs the command.
pub fn run(path: &Path, arrays: Option<&Path>) -> Result<Verdict, Failure> {
    let model =
        model_file::read(path).map_err(|reason| EngineError::Model { path: path.to_owned(), reason: reason.into() })?;
    if let Some(file) = arrays {
        atomic_file::replace(file, &npz(&model_arrays::of_model(&model)))?;
    }
    output::print(&describe(&model))?;
    Ok(Verdict::Done)
}

/// The model for people.
pub fn describe(model: &ReducedModel) -> String {
    let mut text = format!("{}\n  {} contacts\n", model.title, model.contact().name());
    let d = &model.domain;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  M {}…{}, L {}…{}", d.m.0, d.m.1, d.l.0, d.l.1);
    let _ = writeln!(
        text,
        "  α {:.3}…{:.3} /GPa, p_H up to {:.3} GPa, η₀ {} Pa·s",
        d.alpha_per_pa.0 * 1e9,
        d.alpha_per_pa.1 * 1e9,
        d.max_hertz_pressure_pa / 1e9,
        d.viscosity_pa_s
    );
    let _ = writeln!(text, "  density {:?}, viscosity {:?}", d.lubricant.density, d.lubricant.viscosity);
    if let Some(sliding) = d.sliding {
        let ((srr, most), (npr, full)) = (sliding.srr, sliding.npr);
        let modulus = sliding.modulus_pa / 1e9;
        let _ = writeln!(text, "  SRR {srr}…{most}, NPR {npr}…{full}, E′ {modulus:.3} GPa, {:?}", d.lubricant.shear);
    }
    if d.radius_ratio != CIRCLES {
        let _ = writeln!(text, "  R_y/R {}…{}", d.radius_ratio.0, d.radius_ratio.1);
    }
    for window in &model.windows {
        let grid = match window.grid.spec() {
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
        };
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
