//! Training solutions in a model file: one array per quantity, for the snapshots of all local models.

use super::container::{Contents, Writer};
use crate::solver::full::GridCost;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::{ALL_DIGITS, FILM_DIGITS, Snapshot, Window, kept_digits};

/// Number of significand bits of a discretisation error, which is only an estimate.
const FEW_DIGITS: u32 = 8;

/// Quantities, and the number of significand bits stored for steady models; `None` stores eight bytes. Operating points
/// keep all bits of a four-byte number, since some lie on the edges of the trained range. NaN means that a snapshot
/// does not have the quantity. A quantity that no snapshot has is left out.
const QUANTITIES: [(&str, Option<u32>); 13] = [
    ("h_c", Some(FILM_DIGITS)),
    ("h_0", Some(FILM_DIGITS)),
    ("radius", Some(ALL_DIGITS)),
    ("speed", Some(ALL_DIGITS)),
    ("load", Some(ALL_DIGITS)),
    ("modulus", Some(ALL_DIGITS)),
    ("viscosity", Some(ALL_DIGITS)),
    ("alpha", Some(ALL_DIGITS)),
    ("srr", Some(ALL_DIGITS)),
    ("npr", Some(ALL_DIGITS)),
    ("radius_y", None),
    ("grid_truncation", Some(FEW_DIGITS)),
    ("grid_resolution", Some(FEW_DIGITS)),
];

fn values(snapshot: &Snapshot) -> [f64; QUANTITIES.len()] {
    let Snapshot { point, h_0, h_c, grid_cost, .. } = snapshot;
    let [radius, speed, load, modulus, viscosity, alpha] = point.quantities();
    let Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr } = point.sliding;
    let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let (npr, radius_y) = (or_nan(npr), or_nan(point.radius_y_m));
    let truncation = or_nan(grid_cost.map(|cost| cost.truncation));
    let resolution = or_nan(grid_cost.map(|cost| cost.resolution));
    [*h_c, *h_0, radius, speed, load, modulus, viscosity, alpha, srr, npr, radius_y, truncation, resolution]
}

/// Reverse of [`values`], without coefficients.
fn snapshot(kind: ContactKind, values: [f64; QUANTITIES.len()], fronts: Vec<usize>) -> Snapshot {
    let [h_c, h_0, radius, speed, load, modulus, viscosity, alpha, srr, npr, radius_y, truncation, resolution] = values;
    let known = |value: f64| Some(value).filter(|value| !value.is_nan());
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: known(npr) };
    let quantities = [radius, speed, load, modulus, viscosity, alpha];
    let point = OperatingPoint::from_quantities(kind, quantities, sliding);
    let point = OperatingPoint { radius_y_m: known(radius_y), ..point };
    let cost = |(truncation, resolution)| GridCost { truncation, resolution };
    let grid_cost = known(truncation).zip(known(resolution)).map(cost);
    Snapshot { point, coefficients: Vec::new(), h_0, h_c, fronts, grid_cost }
}

/// Adds the snapshots of all local models without their coefficients, `rounded` for a steady model. Returns `None` if
/// they cannot be encoded.
pub(super) fn write(writer: &mut Writer, windows: &[&Window], rounded: bool) -> Option<()> {
    let snapshots = || windows.iter().flat_map(|window| &window.snapshots);
    let all: Vec<_> = snapshots().map(values).collect();
    for (k, (name, digits)) in QUANTITIES.into_iter().enumerate() {
        let column: Vec<f64> = all.iter().filter_map(|values| values.get(k)).copied().collect();
        let first = column.first().copied().unwrap_or(f64::NAN);
        let (name, constant) = (format!("snapshots/{name}"), column.iter().all(|own| own.to_bits() == first.to_bits()));
        match digits.filter(|_| rounded) {
            _ if column.iter().all(|value| value.is_nan()) => {}
            // Constants of a lubricant must be stored exactly.
            Some(digits) if !constant || k == 0 => {
                let column: Vec<f32> = column.into_iter().map(|value| kept_digits(value, digits)).collect();
                writer.list(name, &column)?;
            }
            _ => writer.list(name, &column)?,
        }
    }
    let lines = snapshots().next().map_or(0, |snapshot| snapshot.fronts.len());
    // If a boundary is missing, the array is left out, and the reader refuses the file.
    if snapshots().any(|snapshot| snapshot.fronts.len() != lines) {
        return Some(());
    }
    let fronts = snapshots().flat_map(|snapshot| &snapshot.fronts).map(|front| u32::try_from(*front).ok());
    writer.table("snapshots/fronts", &[all.len(), lines], &fronts.collect::<Option<Vec<u32>>>()?)
}

/// Reads the snapshots of local models, given the number of each, without their coefficients. Returns `None` if they
/// are inconsistent.
pub(super) fn read(contents: &Contents<'_>, counts: &[usize]) -> Option<Vec<Vec<Snapshot>>> {
    let count = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count))?;
    let h_c = contents.shape("snapshots/h_c").unwrap_or(&[0]);
    // The number is checked before memory is allocated.
    if h_c != [count] {
        return None;
    }
    let column = |(name, _): (&str, _)| match contents.numbers(&format!("snapshots/{name}"))? {
        numbers if numbers.is_empty() => Some(vec![f64::NAN; count]),
        numbers => Some(numbers).filter(|numbers| numbers.len() == count),
    };
    let columns: Vec<Vec<f64>> = QUANTITIES.into_iter().map(column).collect::<Option<_>>()?;
    let lines = match contents.shape("snapshots/fronts") {
        None => 0,
        Some(&[snapshots, lines]) if snapshots == count => lines,
        Some(_) => return None,
    };
    let fronts: Vec<u32> = contents.list("snapshots/fronts")?;
    let mut fronts = fronts.chunks(lines.max(1));
    let mut all = (0..count).map(|i| {
        let mut own = [f64::NAN; QUANTITIES.len()];
        own.iter_mut().zip(&columns).for_each(|(own, column)| *own = column.get(i).copied().unwrap_or(f64::NAN));
        let fronts = fronts.next().unwrap_or_default().iter().map(|front| *front as usize).collect();
        snapshot(contents.contact(), own, fronts)
    });
    Some(counts.iter().map(|count| all.by_ref().take(*count).collect()).collect())
}
