//! Names of the quantities in results, each defined once. They are the keys of the object printed by `solve --json`. As
//! dotted paths they are table columns, names in expectations, keys in Python and outputs of Functional Mock-up Units.
//! `moes-m` is only a flag.

use super::contact_spec::{Field, Measure};
use crate::solver::parameters::Quantity;

macro_rules! names {
    ($($constant:ident $name:literal)*) => {
        $(#[doc = concat!("`", $name, "`")] pub const $constant: &str = $name;)*

        /// All names.
        pub const ALL: &[&str] = &[$($name),*];
    };
}

names! {
    CONTACT "contact"
    METHOD "method"
    CONVERGED "converged"
    WARNING "warning"
    WARNINGS "warnings"
    RADIUS "si.radius"
    RADIUS_Y "si.radius_y"
    SPEED "si.speed"
    U1 "si.u1"
    U2 "si.u2"
    LOAD "si.load"
    MODULUS "si.modulus"
    VISCOSITY "si.viscosity"
    ALPHA "si.alpha"
    LENGTH "si.length"
    SRR "srr"
    NPR "npr"
    M "moes.M"
    L "moes.L"
    HALF_WIDTH "hertz.a_m"
    HALF_LENGTH "hertz.b_m"
    KAPPA "hertz.kappa"
    HERTZ_PRESSURE "hertz.p_h_pa"
    CAVITATION "cavitation"
    SUPPLY_FILM "supply_film_m"
    GRID_KIND "grid.kind"
    GRID_NX "grid.nx"
    GRID_NY "grid.ny"
    GRID_DOFS "grid.dofs"
    TRUNCATION_ERROR "grid.truncation_error"
    RESOLUTION_ERROR "grid.resolution_error"
    H_C "H_c"
    H_MIN "H_min"
    X_H_MIN "X_H_min"
    Y_H_MIN "Y_H_min"
    P_C "P_c"
    P_MAX "P_max"
    X_P_MAX "X_P_max"
    X_MENISCUS "X_meniscus"
    H_0 "H_0"
    H_C_M "h_c_m"
    H_MIN_M "h_min_m"
    TRACTION "traction"
    ROLLING_RESISTANCE "rolling_resistance"
    ROLLING_RESISTANCE_FIT "rolling_resistance_fit"
    TOTAL_LOAD "total.load_n"
    FRICTION_FORCE "total.friction_force_n"
    TOTAL_ROLLING_RESISTANCE "total.rolling_resistance_n"
    TORQUE_1 "total.torque_1_nm"
    TORQUE_2 "total.torque_2_nm"
    POWER_LOSS "total.power_loss_w"
    LOAD_RESIDUAL "load_residual"
    RESIDUAL_NORM "residual_norm"
    NEWTON_ITERATIONS "newton_iterations"
    LINEAR_ITERATIONS "linear_iterations"
    MIXED_FILM_RATIO_C "mixed.film_ratio_c"
    MIXED_FILM_RATIO_MIN "mixed.film_ratio_min"
    MIXED_MEAN_GAP_C "mixed.mean_gap_c"
    MIXED_LOAD_SHARE "mixed.asperity_load_share"
    MIXED_P_A_C "mixed.P_a_c"
    MIXED_BOUNDARY_TRACTION "mixed.boundary_traction"
    MIXED_FLUID_TRACTION "mixed.fluid_traction"
    MIXED_REAL_CONTACT_AREA "mixed.real_contact_area"
    MIXED_WEAR "mixed.wear_m_per_s"
    MID_FILM_RISE "heat.mid_film_rise_k"
    SURFACE_1_RISE "heat.surface_1_rise_k"
    SURFACE_2_RISE "heat.surface_2_rise_k"
    MID_FILM_RISE_MAX "heat.mid_film_rise_max_k"
    SURFACE_1_RISE_MAX "heat.surface_1_rise_max_k"
    SURFACE_2_RISE_MAX "heat.surface_2_rise_max_k"
    RISE_OUTSIDE_SPIKE "heat.mid_film_rise_outside_spike_k"
    RISE_IN_SPIKE "heat.mid_film_rise_in_spike_k"
    HEAT_INTO_BODIES "heat.into_bodies"
    ENERGY_BALANCE "heat.energy_balance"
    BASIS_P "reduced.basis_p"
    BASIS_DELTA "reduced.basis_delta"
    SAMPLED_ROWS "reduced.sampled_rows"
    TRAINED "reduced.trained"
    RESIDUAL_ESTIMATE "reduced.residual_estimate"
    H_C_BOUND "reduced.h_c_error_bound"
    H_MIN_BOUND "reduced.h_min_error_bound"
    TRACTION_BOUND "reduced.traction_error_bound"
    RISE_BOUND "reduced.mid_film_rise_error_bound"
    LOAD_SHARE_BOUND "reduced.load_share_error_bound"
    WALL_S "wall_s"
}

/// Column with the status of a row.
pub const STATUS: &str = "status";
/// Column with the reason why a row has no result.
pub const REASON: &str = "reason";

/// Error bounds of H_c, H_min, traction, temperature rise at mid-film, and asperity load share.
pub const BOUNDS: [&str; 5] = [H_C_BOUND, H_MIN_BOUND, TRACTION_BOUND, RISE_BOUND, LOAD_SHARE_BOUND];

/// Returns the name of a value computed by one of several methods: `full.H_c`.
pub fn by(method: &str, name: &str) -> String {
    format!("{method}.{name}")
}

/// Returns the name of a quantity of a contact.
pub fn of_quantity(quantity: Quantity) -> String {
    let name = match quantity {
        Quantity::M => M,
        Quantity::L => L,
        Quantity::Radius => RADIUS,
        Quantity::RadiusY => RADIUS_Y,
        Quantity::Speed => SPEED,
        Quantity::Load => LOAD,
        Quantity::Modulus => MODULUS,
        Quantity::Viscosity => VISCOSITY,
        Quantity::Alpha => ALPHA,
        Quantity::HertzPressure => HERTZ_PRESSURE,
        other => return other.name().replace('-', "_"),
    };
    name.to_owned()
}

/// Returns the result name of a contact field, or its keyword if it is not part of results.
pub fn of_field(field: Field) -> String {
    match (field, field.facts().measure) {
        (Field::SupplyFilm, _) => SUPPLY_FILM.to_owned(),
        (_, Measure::Of(quantity)) => of_quantity(quantity),
        _ => field.keyword(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::examples;

    #[test]
    fn no_name_stands_twice_and_none_is_the_end_of_another() {
        for (k, name) in ALL.iter().enumerate() {
            assert!(!ALL[..k].contains(name), "{name}");
            assert!(ALL.iter().all(|other| *other == *name || !other.ends_with(&format!(".{name}"))), "{name}");
        }
    }

    /// Sizes determined by a training. They are not values of a contact.
    const OF_TRAININGS: [&str; 3] = ["basis_p", "basis_delta", "sampled_rows"];

    #[test]
    fn tables_of_studies_call_quantities_by_these_names() {
        let short = |name: &str| ALL.iter().any(|known| known.ends_with(&format!(".{name}")));
        let mut seen = 0;
        for example in examples::all() {
            for column in example.scene.study.tables(&[]).into_iter().flat_map(|table| table.columns) {
                // A name may be preceded by a method or a model.
                let ends = || std::iter::successors(Some(&*column), |name| name.split_once('.').map(|(_, end)| end));
                let known = ends().any(|name| ALL.contains(&name));
                let other = !OF_TRAININGS.contains(&&*column)
                    && ends().any(|name| short(name) || name.ends_with("_bound") || name.ends_with("_full"));
                assert!(known || !other, "{}: {column}", example.path);
                seen += usize::from(known);
            }
        }
        assert!(seen > 100, "{seen} columns");
    }
}
