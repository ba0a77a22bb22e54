//! Text output of `solve`: one line per value.

use crate::engine::{ContactResult, GridAccuracy};
use crate::scene::{ContactDynamics, Subsurface, names};
use crate::solver::full::GridCost;
use crate::solver::full::heat::Rises;
use crate::solver::full::response::{Dynamics, Maxwell};
use std::fmt::Write;

/// Values with nine decimals: their names here and in a result.
const DIMENSIONLESS: [(&str, &str); 8] = [
    ("H_c", "H_c"),
    ("H_min", "H_min"),
    ("X of H_min", "X_H_min"),
    ("Y of H_min", "Y_H_min"),
    ("P_c", "P_c"),
    ("P_max", "P_max"),
    ("X of P_max", "X_P_max"),
    ("H_0", "H_0"),
];

/// Values with an exponent.
const SMALL: [(&str, &str); 20] = [
    ("h_c [m]", "h_c_m"),
    ("h_min [m]", "h_min_m"),
    ("supply film [m]", "supply_film_m"),
    ("X of meniscus", "X_meniscus"),
    ("traction", "traction"),
    ("h_c/σ", "mixed.film_ratio_c"),
    ("h_min/σ", "mixed.film_ratio_min"),
    ("asperity share", "mixed.asperity_load_share"),
    ("boundary friction", "mixed.boundary_traction"),
    ("fluid friction", "mixed.fluid_traction"),
    ("real contact area", "mixed.real_contact_area"),
    ("wear [m/s]", "mixed.wear_m_per_s"),
    ("load [N]", "total.load_n"),
    ("friction [N]", "total.friction_force_n"),
    ("rolling [N]", "total.rolling_resistance_n"),
    ("torque 1 [N·m]", "total.torque_1_nm"),
    ("torque 2 [N·m]", "total.torque_2_nm"),
    ("power loss [W]", "total.power_loss_w"),
    ("load residual", "load_residual"),
    ("residual norm", "residual_norm"),
];

/// Calibrated error bounds: relative, that of the asperity load share absolute.
const BOUNDS: [(&str, &str); 5] = [
    ("H_c", "reduced.h_c_error_bound"),
    ("H_min", "reduced.h_min_error_bound"),
    ("traction", "reduced.traction_error_bound"),
    ("rise at X = 0", "reduced.mid_film_rise_error_bound"),
    ("asperity share", "reduced.load_share_error_bound"),
];

/// Describes stiffness and damping for users.
pub fn dynamics(dynamics: &ContactDynamics) -> String {
    let [stiffness, damping] = dynamics.units();
    let mut lines = Vec::new();
    let mut line = |name: &str, value: String| lines.push(format!("{name:<18} {value}\n"));
    for Dynamics { frequency_hz, stiffness: k, damping: c } in &dynamics.values {
        line(&format!("at {frequency_hz} Hz"), format!("k {k:.6e} {stiffness}, c {c:.6e} {damping}"));
    }
    if let Some(maxwell) = &dynamics.maxwell {
        let Maxwell { static_stiffness, series_stiffness, relaxation_s, parallel_damping, deviation } = maxwell;
        let springs = format!("k_0 {static_stiffness:.4e} and k_1 {series_stiffness:.4e} {stiffness}");
        let dashpots = format!("τ {relaxation_s:.3e} s, c {parallel_damping:.3e} {damping}");
        line("Maxwell element", format!("{springs}, {dashpots}, within {:.1} %", 100.0 * deviation));
    }
    lines.concat()
}

/// Describes the result for users.
pub fn result(result: &ContactResult, accuracy: Option<&GridAccuracy>, subsurface: Option<&Subsurface>) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<18} {value}");
    };
    let (point, moes, hertz) = (&result.point, result.point.moes(), result.point.hertz());
    line("method", format!("{}, {} contact", result.method, point.kind.name()));
    line("converged", if result.converged { "yes" } else { "no" }.to_owned());
    if !result.warnings.is_empty() {
        line("warning", result.warning());
    }
    line("R", format!("{:.6e} m", point.radius_m));
    if let (Some(radius_y_m), Some(ratio)) = (point.radius_y_m, point.stated_ratio()) {
        line("R_y", format!("{radius_y_m:.6e} m, R_y/R {ratio:.6}"));
    }
    line("u_m", format!("{:.6e} m/s", point.speed_m_per_s));
    line("w", format!("{:.6e} {}", point.load, point.kind.load_unit()));
    line("E′", format!("{:.6e} Pa", point.modulus_pa));
    line("η₀", format!("{:.6e} Pa·s", point.viscosity_pa_s));
    line("α", format!("{:.6e} 1/Pa", point.alpha_per_pa));
    line("M, L", format!("{:.6}, {:.6}", moes.m, moes.l));
    let across = match point.radius_y_m {
        Some(_) => format!(" b {:.6e} m, κ {:.6},", hertz.half_length_m, point.ellipse().kappa),
        None => String::new(),
    };
    line("Hertz", format!("a {:.6e} m,{across} p_H {:.6e} Pa", hertz.half_width_m, hertz.pressure_pa));
    let nodes = match result.nodes {
        (nx, 1) => nx.to_string(),
        (nx, ny) => format!("{nx}×{ny}"),
    };
    line("grid", format!("{}, {nodes} nodes, {} unknowns", result.grid, result.dofs));
    line("cavitation", result.cavitation.name().to_owned());
    for (title, name) in DIMENSIONLESS {
        if let Some(value) = result.value(name) {
            line(title, format!("{value:.9}"));
        }
    }
    for (title, name) in SMALL {
        if let Some(value) = result.value(name) {
            line(title, format!("{value:.6e}"));
        }
    }
    if let Some(heat) = &result.heat {
        let rises = |name: &str, at: &Rises| {
            let [first, second] = at.surfaces_k;
            (name.to_owned(), format!("mid-film {:.3} K, body 1 {first:.3} K, body 2 {second:.3} K", at.mid_film_k))
        };
        let of_spike = heat.in_spike.map(|spike| rises("in the spike", &spike));
        let of_film = [rises("rise at X = 0", &heat.central), rises("largest in film", &heat.outside_spike)];
        for (name, value) in of_film.into_iter().chain(of_spike) {
            line(&name, value);
        }
        let [first, second] = heat.into_bodies.map(|share| 100.0 * share);
        line("heat", format!("{first:.1} % into body 1, {second:.1} % into body 2, the rest with the lubricant"));
        line("energy balance", format!("{:.2e}", heat.energy_balance));
    }
    let linear = result.linear_iterations.map_or(String::new(), |n| format!(", {n} linear"));
    line("iterations", format!("{} Newton{linear}", result.newton_iterations));
    if let Some(reduced) = &result.reduced {
        line("reduced", reduced.size.to_string());
        line("in trained range", if reduced.trained { "yes" } else { "no" }.to_owned());
        if let Some(estimate) = result.value("reduced.residual_estimate") {
            line("estimate e_f", format!("{estimate:.3e}"));
        }
        for (title, name) in BOUNDS {
            if let Some(bound) = result.value(name) {
                let kind = if name == names::LOAD_SHARE_BOUND { "absolute" } else { "relative" };
                line(&format!("error of {title}"), format!("{kind}, below {bound:.2e} (99 % of contacts)"));
            }
        }
    }
    if let Some(accuracy) = accuracy {
        let second = format!("by a second solve on {}×{} nodes", accuracy.nx, accuracy.ny);
        let off = |error: f64, limit: f64| format!("{:.2} %; {limit:.6} in the limit, {second}", 100.0 * error);
        line("grid error of H_c", off(accuracy.h_c_error, accuracy.h_c_limit));
        line("grid error of H_min", off(accuracy.h_min_error, accuracy.h_min_limit));
        if !accuracy.resolved {
            line("", "one of both grids does not resolve the side lobes: the error of H_min may be larger".to_owned());
        }
    } else if let Some(error) = result.grid_cost.map(GridCost::total).filter(|error| error.is_finite()) {
        line("grid error of H_c", format!("about {:.2} %", 100.0 * error));
    }
    if let Some(stress) = subsurface {
        for (name, value, depth) in [
            ("von Mises stress", stress.von_mises_max_pa, stress.von_mises_depth_m),
            ("maximum shear", stress.shear_max_pa, stress.shear_depth_m),
            ("orthogonal shear", stress.orthogonal_shear_max_pa, stress.orthogonal_shear_depth_m),
        ] {
            line(name, format!("{value:.6e} Pa at a depth of {depth:.6e} m"));
        }
    }
    line("time", format!("{:.3} ms", result.wall_s * 1e3));
    text
}
