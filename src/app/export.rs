//! Export for other programs: the data of a plot as CSV, and the read-outs as text.

use super::answers::Answers;
use super::answers::picture::{Cuts, Picture, value_at};
use super::numbers;
use crate::engine::Table;
use crate::solver::full::heat::Rises;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use egui_plot::PlotPoint;
use std::fmt::Write as _;

/// Returns a CSV table: comment lines, header, and rows of numbers with full precision. A missing value is an empty
/// field.
pub fn csv(comments: &[String], header: &[&str], rows: impl IntoIterator<Item = Vec<Option<f64>>>) -> String {
    let mut table = Table::new("", header);
    let row = |row: Vec<Option<f64>>| row.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect();
    table.rows.extend(rows.into_iter().map(row));
    commented(comments, &table)
}

/// Returns a table as CSV after comment lines.
pub fn commented(comments: &[String], table: &Table) -> String {
    comments.iter().map(|line| format!("# {line}\n")).chain([table.to_csv()]).collect()
}

/// Returns the parameters of a picture in one line.
pub fn describe(picture: &Picture) -> String {
    describe_contact(&picture.key.point, &picture.key.lubricant)
}

/// Returns the parameters of a contact in one line.
pub fn describe_contact(point: &OperatingPoint, lubricant: &Lubricant) -> String {
    let moes = point.moes();
    let unit = point.kind.load_unit();
    let sliding = match (point.sliding.slide_to_roll_ratio, lubricant.shear) {
        (0.0, ShearLaw::Newtonian) => String::new(),
        (srr, ShearLaw::Newtonian) => format!("; SRR {srr:e}"),
        (srr, shear) => {
            let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(shear.plateau());
            format!("; SRR {srr:e}; NPR {plateau:e}")
        }
    };
    let across = point.radius_y_m.map_or_else(String::new, |radius_y| format!("; R_y {radius_y:e} m"));
    format!(
        "M {:e}; L {:e}; R {:e} m{across}; u_m {:e} m/s; w {:e} {unit}; E' {:e} Pa; eta_0 {:e} Pa s; alpha {:e} 1/Pa; {}{sliding}",
        moes.m,
        moes.l,
        point.radius_m,
        point.speed_m_per_s,
        point.load,
        point.modulus_pa,
        point.viscosity_pa_s,
        point.alpha_per_pa,
        lubricant.describe()
    )
}

/// Returns one row of a picture's profile along X, with dimensionless and SI values.
fn profile_row(picture: &Picture, node: (f64, f64, f64)) -> [Option<f64>; 6] {
    row_in(picture, picture.key.point.hertz().half_width_m, node)
}

/// Returns one row of a profile whose coordinate is scaled with `length_m`, with dimensionless and SI values.
fn row_in(picture: &Picture, length_m: f64, (x, p, film): (f64, f64, f64)) -> [Option<f64>; 6] {
    let (hertz, film_scale) = (picture.key.point.hertz(), picture.key.point.film_scale_m());
    [x, p, film, x * length_m, p * hertz.pressure_pa, film * film_scale].map(Some)
}

/// Returns the profiles as CSV, with dimensionless and SI values. Adds the full solution to a reduced one if both
/// belong together, and every pinned curve on its own nodes in separate columns. `None` without a picture.
pub fn profiles(answers: &Answers, cuts: Cuts) -> Option<String> {
    const COLUMNS: [&str; 6] = ["X", "P", "H", "x_m", "p_pa", "h_m"];
    let picture = answers.picture()?;
    let full = answers.comparison().and(answers.full());
    let mut comments = vec![describe(picture), answers.means()];
    let mut header: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    if full.is_some() {
        header.extend(["P_full", "H_full"].map(str::to_owned));
    }
    let further = further(picture, cuts);
    header.extend(further.iter().map(|(name, _)| (*name).to_owned()));
    for pin in answers.pins() {
        comments.push(format!("pin{}: {}; {}", pin.number, describe(&pin.picture), pin.picture.means()));
        header.extend(COLUMNS.map(|column| format!("pin{}.{column}", pin.number)));
    }
    let live_width = COLUMNS.len() + if full.is_some() { 2 } else { 0 } + further.len();
    if picture.has_plane() {
        comments.push(format!("profiles along X at Y {:e}", cuts.y));
    }
    let live: Vec<Vec<Option<f64>>> = picture
        .solution
        .along(cuts.y)
        .into_iter()
        .map(|node| {
            let mut row = profile_row(picture, node).to_vec();
            if let Some(full) = full {
                row.extend([value_at(&full.pressure, node.0), value_at(&full.film, node.0)]);
            }
            row.extend(further.iter().map(|(_, curve)| value_at(curve, node.0)));
            row
        })
        .collect();
    let pinned: Vec<Vec<[Option<f64>; 6]>> = answers
        .pins()
        .iter()
        .map(|pin| pin.picture.solution.along(cuts.y).into_iter().map(|node| profile_row(&pin.picture, node)).collect())
        .collect();
    let rows = pinned.iter().map(Vec::len).fold(live.len(), usize::max);
    let row = |k: usize| {
        let mut row = live.get(k).cloned().unwrap_or_else(|| vec![None; live_width]);
        row.extend(pinned.iter().flat_map(|pin| pin.get(k).copied().unwrap_or_default()));
        row
    };
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    Some(csv(&comments, &header, (0..rows).map(row)))
}

/// Returns further curves along the axis with their names: film fraction, asperity pressure, temperature rises. Empty
/// away from the axis.
fn further(picture: &Picture, cuts: Cuts) -> Vec<(&'static str, Vec<PlotPoint>)> {
    if picture.has_plane() && cuts.y != 0.0 {
        return Vec::new();
    }
    let (solution, ny) = (&picture.solution, picture.solution.y.len());
    let fraction = solution.axis_fraction().map(|(x, value)| PlotPoint::new(x, value)).collect();
    let carried = solution.asperity_pressure.iter().skip(ny - 1).step_by(ny);
    let carried = solution.x.iter().zip(carried).map(|(x, value)| PlotPoint::new(*x, *value)).collect();
    let heat = solution.heat.as_deref();
    let rises = |of: fn(Rises) -> f64| -> Vec<PlotPoint> {
        let along = heat.into_iter().flat_map(|heat| heat.x.iter().zip(heat.along_axis()));
        along.map(|(x, profile)| PlotPoint::new(*x, of(Rises::of(profile)))).collect()
    };
    let curves: [(&str, Vec<PlotPoint>); 5] = [
        ("theta", fraction),
        ("P_a", carried),
        ("mid_film_rise_k", rises(|rises| rises.mid_film_k)),
        ("surface_1_rise_k", rises(|rises| rises.surfaces_k[0])),
        ("surface_2_rise_k", rises(|rises| rises.surfaces_k[1])),
    ];
    curves.into_iter().filter(|(_, curve)| !curve.is_empty()).collect()
}

/// Returns the profile across a point contact, with dimensionless and SI values. Empty without a picture.
pub fn profile_across(answers: &Answers, x: f64) -> String {
    let Some(picture) = answers.picture() else { return String::new() };
    let half_length_m = picture.key.point.hertz().half_length_m;
    let rows = picture.solution.across(x).into_iter().map(|node| row_in(picture, half_length_m, node).to_vec());
    let comments = [describe(picture), answers.means(), format!("profile across at X {x:e}")];
    csv(&comments, &["Y", "P", "H", "y_m", "p_pa", "h_m"], rows)
}

/// Returns the read-outs as a tab-separated table for the clipboard.
pub fn readouts_table(answers: &Answers, system: UnitSystem) -> String {
    let mut out = String::from("quantity\tdimensionless\tdimensional\n");
    let Some(picture) = answers.picture() else { return out };
    let (moes, s) = (picture.key.point.moes(), &picture.solution.scalars);
    let rows = [
        ("M", moes.m, String::new()),
        ("L", moes.l, String::new()),
        ("H_c", s.h_c, numbers::length(picture.central_film_m(), system)),
        ("H_min", s.h_min, numbers::length(picture.minimum_film_m(), system)),
        ("P_max", s.p_max, numbers::pressure(picture.largest_pressure_pa(), system)),
        ("traction", picture.traction, String::new()),
    ];
    for (name, value, unit) in rows {
        let _ok = writeln!(out, "{name}\t{}\t{}", numbers::significant(value), unit.replace(numbers::THIN, " "));
    }
    let _ok = writeln!(out, "computed by\t{}\t", answers.means());
    out
}
