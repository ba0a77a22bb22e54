//! Tables of the fields of a solution.

use super::table::Table;
use crate::solver::full::{Shear, Solution};

/// Returns the fields of a solution at its nodes: X, Y, P, H, the same in SI units, λ or θ of the cavitation model if
/// the solution has one, and the asperity pressure P_a of rough surfaces, which is a part of P. For a thermal solution
/// also the temperature rises at mid-film and of both surfaces.
pub fn profile_table(name: impl Into<String>, solution: &Solution) -> Table {
    let mut columns = vec!["X", "Y", "P", "H", "x_m", "y_m", "p_pa", "h_m"];
    if !solution.multiplier.is_empty() {
        columns.push("lambda");
    }
    if !solution.fraction.is_empty() {
        columns.push("theta");
    }
    if !solution.asperity_pressure.is_empty() {
        columns.extend(["P_a", "p_a_pa"]);
    }
    let wear: Option<Vec<f64>> = solution.wear_rates().map(Iterator::collect);
    if wear.is_some() {
        columns.push("wear_m_per_s");
    }
    let heat = solution.heat.as_deref();
    if heat.is_some() {
        columns.extend(["mid_film_rise_k", "surface_1_rise_k", "surface_2_rise_k"]);
    }
    let mut table = Table::new(name, &columns);
    let hertz = solution.problem.point.hertz();
    let (a, b, film_scale) = (hertz.half_width_m, hertz.half_length_m, solution.problem.point.film_scale_m());
    let row = |(x, y, p, h)| vec![x, y, p, h, x * a, y * b, p * hertz.pressure_pa, h * film_scale];
    table.rows.extend(solution.nodes().map(row));
    for (row, value) in table.rows.iter_mut().zip(solution.multipliers().chain(solution.fractions())) {
        row.push(value);
    }
    for (row, carried) in table.rows.iter_mut().zip(solution.asperity_pressures()) {
        row.extend([carried, carried * hertz.pressure_pa]);
    }
    for (row, rate) in table.rows.iter_mut().zip(wear.into_iter().flatten()) {
        row.push(rate);
    }
    for (row, at) in table.rows.iter_mut().zip(heat.iter().flat_map(|heat| heat.rises())) {
        row.push(at.mid_film_k);
        row.extend(at.surfaces_k);
    }
    table
}

/// Number of heights Z in [`film_shear_table`].
const HEIGHTS: usize = 11;

/// Returns the shear across the film in the plane Y = 0: X, Z = z/h, shear stress τ_zx and shear rate ∂u/∂z.
pub fn film_shear_table(name: impl Into<String>, solution: &Solution) -> Table {
    let mut table = Table::new(name, &["X", "Z", "tau_zx_pa", "rate_per_s"]);
    let heights: [f64; HEIGHTS] = std::array::from_fn(|k| k as f64 / (HEIGHTS - 1) as f64);
    let field = solution.shear_field(&heights);
    for (k, height) in heights.into_iter().enumerate() {
        let places = solution.profile().zip(field.chunks_exact(HEIGHTS));
        let row = |(x, shear): (f64, &Shear)| vec![x, height, shear.stress_pa, shear.rate_per_s];
        table.rows.extend(places.filter_map(|((x, ..), at)| Some((x, at.get(k)?))).map(row));
    }
    table
}
