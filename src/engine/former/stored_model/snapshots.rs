//! The training solutions of a model on their way to or from a file: column by column, with as many digits as starts that are
//! made of them ask for.

use super::window::StoredWindow;
use crate::engine::former::packed::{Small, unpacked};
use crate::engine::former::stored_matrix::StoredMatrix;
use crate::solver::full::GridCost;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::Snapshot;
use serde::{Deserialize, Serialize};

/// Bits of the significand of an f32 that are kept of what the grid costs, which is an estimate. Contacts keep all of them, for
/// some lie on the edges of what a model was trained for.
const FEW_DIGITS: u32 = 8;
/// Films stand first among the numbers of a snapshot.
const FILMS: usize = 2;

/// So many packed numbers take a byte at most.
const MOST_PACKED: usize = 16;

/// Numbers of every snapshot: H_c, H₀, R, u_m, w, E′, η₀, α, SRR, NPR (not a number where it has none), and both parts of
/// what the grid costs.
const NUMBERS: usize = 12;
/// The last of them are costs.
const COSTS: usize = 2;

/// The snapshots of all windows.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredSnapshots {
    kind: ContactKind,
    /// How many each window has.
    counts: Vec<usize>,
    /// One for each of [`NUMBERS`]; the last two are empty where the cost of the grid was not asked for.
    columns: Vec<Column>,
    /// First ruptured columns of the lines of each snapshot, each but the first less the one before; none under a penalty.
    fronts: Option<(usize, Small)>,
    /// Coefficients of every window, snapshots × modes; none where they have a place of their own.
    coefficients: Vec<StoredMatrix>,
}

/// One number of every snapshot.
#[derive(Serialize, Deserialize)]
enum Column {
    Packed(Vec<u8>),
    /// So few, or so alike, that packed ones could ask for much memory.
    Plain(Vec<f32>),
    /// The same for all, to the last digit: the constants of a lubricant have to be met.
    Same(f64),
}

impl Column {
    fn into_numbers(self, count: usize) -> Option<Vec<f64>> {
        let numbers = match self {
            Self::Packed(packed) => unpacked(count, &packed, MOST_PACKED)?,
            Self::Plain(numbers) => Some(numbers).filter(|numbers| numbers.len() == count)?,
            Self::Same(number) => return Some(vec![number; count]),
        };
        Some(numbers.into_iter().map(f64::from).collect())
    }
}

/// Gives the snapshots of a window their coefficients; `None` where they do not fit.
pub(super) fn give_each(window: &mut StoredWindow, stored: StoredMatrix) -> Option<()> {
    let coefficients = stored.into_mat(window.snapshots.len())?;
    for (i, snapshot) in window.snapshots.iter_mut().enumerate() {
        snapshot.coefficients = coefficients.row(i).iter().copied().collect();
    }
    Some(())
}

/// Gives the windows of a model their snapshots, with coefficients unless these have a place of their own; `None` where they
/// do not fit.
pub(super) fn give_snapshots(windows: &mut [StoredWindow], stored: StoredSnapshots) -> Option<()> {
    let StoredSnapshots { kind, counts, columns, fronts, coefficients } = stored;
    if counts.len() != windows.len() || windows.iter().any(|window| !window.snapshots.is_empty()) {
        return None;
    }
    let count = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count))?;
    let mut columns = columns.into_iter();
    // The first column says that there are so many.
    let first = columns.next().filter(|column| !matches!(column, Column::Same(_)))?.into_numbers(count)?;
    let mut all = vec![first];
    let mut costs = true;
    for (k, column) in columns.enumerate() {
        // Where the cost of the grid was not asked for, its columns are empty.
        let empty =
            k + 1 >= NUMBERS - COSTS && count > 0 && matches!(&column, Column::Plain(numbers) if numbers.is_empty());
        costs &= !empty;
        all.push(if empty { vec![0.0; count] } else { column.into_numbers(count)? });
    }
    if all.len() != NUMBERS {
        return None;
    }
    let (lines, fronts) = match fronts {
        None => (0, Vec::new()),
        Some((lines, fronts)) => {
            let wanted = lines.checked_mul(count).filter(|_| lines > 0)?;
            (lines, fronts.into_numbers(wanted, MOST_PACKED)?)
        }
    };
    let (mut columns, mut fronts): (Vec<_>, _) =
        (all.into_iter().map(Vec::into_iter).collect(), fronts.chunks_exact(lines.max(1)));
    for (window, count) in windows.iter_mut().zip(counts) {
        for _ in 0..count {
            let mut own = [0.0; NUMBERS];
            for (number, column) in own.iter_mut().zip(&mut columns) {
                *number = column.next()?;
            }
            let [h_c, h_0, radius, speed, load, modulus, viscosity, alpha, srr, npr, truncation, resolution] = own;
            let newtonian_plateau_ratio = Some(npr).filter(|npr| !npr.is_nan());
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio };
            let quantities = [radius, speed, load, modulus, viscosity, alpha];
            let point = OperatingPoint::from_quantities(kind, quantities, sliding);
            let grid_cost = costs.then_some(GridCost { truncation, resolution });
            let fronts = if lines == 0 { Vec::new() } else { summed(fronts.next()?)? };
            window.snapshots.push(Snapshot { point, coefficients: Vec::new(), h_0, h_c, fronts, grid_cost });
        }
    }
    if coefficients.is_empty() {
        return Some(());
    }
    if coefficients.len() != windows.len() {
        return None;
    }
    windows.iter_mut().zip(coefficients).map(|(window, stored)| give_each(window, stored)).collect()
}

/// Boundaries from what each is more than the one before; `None` where one lies before the first column.
fn summed(steps: &[i16]) -> Option<Vec<usize>> {
    let mut front = 0i32;
    let sum = |step: &i16| {
        front = front.checked_add(i32::from(*step))?;
        usize::try_from(front).ok()
    };
    steps.iter().map(sum).collect()
}
