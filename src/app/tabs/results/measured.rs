//! Converts measured points to the quantities on the axes of a results chart. Measured are film thickness or friction
//! over speed or slide-to-roll ratio (SRR).

use crate::scene::{MeasuredPoint, Table, names};

/// Largest relative variation of the film scale h/H \[m\] over a table for which measured film thicknesses h are
/// converted to the dimensionless H.
const SAME_SCALE: f64 = 1e-9;

/// Returns the measured points as pairs of the quantities x and y, which are columns of result tables, in the units of
/// these columns. `table` holds the computed values. Empty if a quantity is not measured.
///
/// Measured friction coefficients are magnitudes; they get the sign of the computed ones. If no computed slide-to-roll
/// ratio is negative, the magnitudes of the measured ones are used. Film thicknesses are converted to H only if all
/// rows of the table have the same film scale.
pub fn points([x, y]: [&str; 2], table: &Table, measured: &[MeasuredPoint]) -> Vec<[f64; 2]> {
    let of = |name: &str| values(table, name);
    // True if some computed SRR is negative.
    let reversed = !of(names::SRR).is_empty() && of(names::SRR).iter().any(|srr| *srr < 0.0);
    let along = |point: &MeasuredPoint| match quantity(x) {
        names::SPEED => point.speed_m_per_s,
        names::SRR => point.srr.map(|srr| if reversed { srr } else { srr.abs() }),
        _ => None,
    };
    let (films, tractions) = (film_scale(table), of(names::TRACTION));
    // True if the computed friction coefficients are negative.
    let negative =
        tractions.iter().all(|traction| *traction <= 0.0) && tractions.iter().any(|traction| *traction < 0.0);
    let value = |point: &MeasuredPoint| match quantity(y) {
        names::H_C_M => point.film_m,
        names::H_C => Some(point.film_m? / films?),
        names::TRACTION => {
            let backwards = if reversed && quantity(x) == names::SRR { point.srr? < 0.0 } else { negative };
            point.friction.map(|friction| if backwards { -friction } else { friction })
        }
        _ => None,
    };
    measured.iter().filter_map(|point| Some([along(point)?, value(point)?])).collect()
}

/// Returns the quantity of a column: its name without a method such as `full.`.
fn quantity(column: &str) -> &str {
    match column.split_once('.') {
        Some((method, quantity)) if ["full", "reduced"].iter().any(|name| method.starts_with(name)) => quantity,
        _ => column,
    }
}

/// Returns the finite values of a quantity by all methods.
fn values(table: &Table, name: &str) -> Vec<f64> {
    let columns = table.columns.iter().enumerate().filter(|(_, column)| quantity(column) == name);
    let of = |(k, _): (usize, &String)| table.rows.iter().filter_map(move |row| row.get(k).copied());
    columns.flat_map(of).filter(|value| value.is_finite()).collect()
}

/// Returns the film scale h/H \[m\]; `None` if it differs between rows.
fn film_scale(table: &Table) -> Option<f64> {
    let (films_m, films) = (values(table, names::H_C_M), values(table, names::H_C));
    let scales = || films_m.iter().zip(&films).map(|(h, dimensionless)| h / dimensionless);
    let first = scales().next().filter(|scale| scale.is_finite() && films_m.len() == films.len())?;
    scales().all(|scale| (scale / first - 1.0).abs() < SAME_SCALE).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::measured_points;

    fn table(columns: &[&str], rows: &[&[f64]]) -> Table {
        Table { rows: rows.iter().map(|row| row.to_vec()).collect(), ..Table::new("sweep", columns) }
    }

    #[test]
    fn films_over_speed_are_drawn_in_metres_and_as_h() {
        let measured = measured_points("speed [m/s],film [nm]\n1,60\n2,100\n").unwrap();
        let columns = ["si.speed", "srr", "full.H_c", "full.h_c_m", "full.traction"];
        let swept = table(&columns, &[&[1.0, 0.0, 0.1, 50e-9, 0.0], &[2.0, 0.0, 0.2, 100e-9, 0.0]]);
        let near = |found: Vec<[f64; 2]>, wanted: [[f64; 2]; 2]| {
            assert_eq!(found.len(), 2, "{found:?}");
            let pairs = found.iter().flatten().zip(wanted.iter().flatten());
            assert!(pairs.clone().all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{found:?} {wanted:?}");
        };
        near(points(["si.speed", "full.h_c_m"], &swept, &measured), [[1.0, 60e-9], [2.0, 100e-9]]);
        near(points(["si.speed", "H_c"], &swept, &measured), [[1.0, 0.12], [2.0, 0.2]]);
        for other in
            [["si.speed", "full.P_c"], ["si.load", "full.h_c_m"], ["srr", "full.h_c_m"], ["si.speed", "traction"]]
        {
            assert_eq!(points(other, &swept, &measured), [[0.0; 2]; 0], "{other:?}");
        }
        // If the load varies, h/H varies too, and measured film thicknesses cannot be converted to H.
        let loaded = table(&columns, &[&[1.0, 0.0, 0.1, 50e-9, 0.0], &[2.0, 0.0, 0.2, 120e-9, 0.0]]);
        assert_eq!(points(["si.speed", "H_c"], &loaded, &measured), [[0.0; 2]; 0]);
        assert_eq!(points(["si.speed", "h_c_m"], &loaded, &measured).len(), 2);
    }

    #[test]
    fn friction_over_sliding_has_the_signs_of_the_computed_one() {
        let measured = measured_points("srr [%],friction\n-5,-0.03\n10,0.04\n").unwrap();
        let of = |rows: &[&[f64]]| {
            points(["srr", "reduced.traction"], &table(&["srr", "reduced.traction"], rows), &measured)
        };
        assert_eq!(of(&[&[0.0, 0.0], &[0.2, 0.05]]), [[0.05, 0.03], [0.1, 0.04]]);
        assert_eq!(of(&[&[-0.2, -0.05], &[0.2, 0.05]]), [[-0.05, -0.03], [0.1, 0.04]]);
        assert_eq!(of(&[]), [[0.05, 0.03], [0.1, 0.04]]);
    }
}
