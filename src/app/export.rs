//! Tables for other programs: the data behind a plot as CSV, the read-outs as text.

use super::numbers;
use super::picture::{Picture, value_at};
use super::state::State;
use std::fmt::Write as _;

/// A CSV table: comment lines, header, rows of numbers with full precision; what is missing is an empty field.
pub fn csv(comments: &[String], header: &[&str], rows: impl IntoIterator<Item = Vec<Option<f64>>>) -> String {
    let mut out = String::new();
    for line in comments {
        out.push_str("# ");
        out.push_str(line);
        out.push('\n');
    }
    out.push_str(&header.join(","));
    out.push('\n');
    for row in rows {
        for (k, value) in row.iter().enumerate() {
            if k > 0 {
                out.push(',');
            }
            if let Some(value) = value {
                // Writing to a string cannot fail.
                let _ok = write!(out, "{value:e}");
            }
        }
        out.push('\n');
    }
    out
}

/// The parameters of a picture in one line.
pub fn describe(picture: &Picture) -> String {
    let (point, moes) = (&picture.key.point, picture.key.point.moes());
    format!(
        "M {:e}; L {:e}; R {:e} m; u_m {:e} m/s; w {:e} N/m; E' {:e} Pa; eta_0 {:e} Pa s; alpha {:e} 1/Pa; {:?}; {:?}",
        moes.m,
        moes.l,
        point.radius_m,
        point.speed_m_per_s,
        point.load,
        point.modulus_pa,
        point.viscosity_pa_s,
        point.alpha_per_pa,
        picture.key.lubricant.viscosity,
        picture.key.lubricant.density
    )
}

/// Profiles with their SI twins, and the full solution beside a reduced one where both belong together.
pub fn profiles(state: &State) -> Option<String> {
    let picture = state.picture.as_ref()?;
    let (a, p_h, h) = (
        picture.key.point.hertz().half_width_m,
        picture.key.point.hertz().pressure_pa,
        picture.key.point.film_scale_m(),
    );
    let full = state.comparison.as_ref().and(state.full.as_ref());
    let mut header = vec!["X", "P", "H", "x_m", "p_pa", "h_m"];
    if full.is_some() {
        header.extend(["P_full", "H_full"]);
    }
    let rows = picture.solution.profile().map(|(x, p, film)| {
        let mut row = vec![Some(x), Some(p), Some(film), Some(x * a), Some(p * p_h), Some(film * h)];
        if let Some(full) = full {
            row.push(value_at(&full.pressure, x));
            row.push(value_at(&full.film, x));
        }
        row
    });
    Some(csv(&[describe(picture), format!("{:?}", picture.origin)], &header, rows))
}

/// The rows of the read-outs: name, dimensionless value, value with unit.
pub fn readouts(state: &State) -> Vec<(&'static str, String, String)> {
    let Some(picture) = &state.picture else { return Vec::new() };
    let (scalars, scale, p_h) =
        (&picture.solution.scalars, picture.key.point.film_scale_m(), picture.key.point.hertz().pressure_pa);
    let mu = picture.traction.per_srr * state.document.view.slide_to_roll_ratio;
    vec![
        ("H_c", numbers::significant(scalars.h_c), numbers::length(scalars.h_c * scale)),
        ("H_min", numbers::significant(scalars.h_min), numbers::length(scalars.h_min * scale)),
        ("P_max", numbers::significant(scalars.p_max), numbers::pressure(scalars.p_max * p_h)),
        ("traction", numbers::significant(mu), String::new()),
    ]
}

/// The read-outs as a tab-separated table for a clipboard.
pub fn readouts_table(state: &State) -> String {
    let mut out = String::from("quantity\tdimensionless\tdimensional\n");
    if let Some(picture) = &state.picture {
        let moes = picture.key.point.moes();
        let _ok = writeln!(out, "M\t{}\t\nL\t{}\t", numbers::significant(moes.m), numbers::significant(moes.l));
    }
    for (name, value, unit) in readouts(state) {
        let _ok = writeln!(out, "{name}\t{value}\t{}", unit.replace(numbers::THIN, " "));
    }
    out
}
