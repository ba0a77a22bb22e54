//! The training solutions of a model on their way to or from a file: column by column, with as many digits as starts that are
//! made of them ask for.

use super::window::StoredWindow;
use crate::engine::packed::{Small, packed, unpacked};
use crate::engine::stored_matrix::StoredMatrix;
use crate::solver::full::GridCost;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::{
    ALL_DIGITS, FILM_DIGITS, Keeping, ReducedModel, Snapshot, Window, kept_digits, kept_starts,
};
use pco::ChunkConfig;
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
    fn of(numbers: Vec<f64>, digits: u32) -> Self {
        match numbers.first() {
            Some(first) if numbers.iter().all(|number| number.to_bits() == first.to_bits()) => Self::Same(*first),
            _ => Self::of_any(numbers, digits),
        }
    }

    /// One that says how many there are.
    fn of_any(numbers: Vec<f64>, digits: u32) -> Self {
        let numbers: Vec<f32> = numbers.into_iter().map(|number| kept_digits(number, digits)).collect();
        packed(&numbers, &ChunkConfig::default(), MOST_PACKED).map_or(Self::Plain(numbers), Self::Packed)
    }

    fn into_numbers(self, count: usize) -> Option<Vec<f64>> {
        let numbers = match self {
            Self::Packed(packed) => unpacked(count, &packed, MOST_PACKED)?,
            Self::Plain(numbers) => Some(numbers).filter(|numbers| numbers.len() == count)?,
            Self::Same(number) => return Some(vec![number; count]),
        };
        Some(numbers.into_iter().map(f64::from).collect())
    }
}

impl StoredSnapshots {
    /// Those of a model.
    pub fn of(model: &ReducedModel) -> Self {
        let all = || model.windows.iter().flat_map(|window| &window.snapshots);
        let number = |snapshot: &Snapshot, k: usize| numbers(snapshot).get(k).copied().flatten();
        let column = |k: usize| all().map(|snapshot| number(snapshot, k)).collect::<Option<Vec<f64>>>();
        let columns: Vec<_> = (0..NUMBERS).map(column).collect();
        let costs = columns.last().is_some_and(Option::is_some);
        let columns = columns.into_iter().enumerate().map(|(k, own)| match own {
            Some(own) if k == 0 => Column::of_any(own, FILM_DIGITS),
            Some(own) if k < FILMS => Column::of(own, FILM_DIGITS),
            Some(own) if k < NUMBERS - COSTS => Column::of(own, ALL_DIGITS),
            Some(own) if costs => Column::of(own, FEW_DIGITS),
            _ => Column::Plain(Vec::new()),
        });
        let columns = columns.collect();
        let counts = model.windows.iter().map(|window| window.snapshots.len()).collect();
        let apart = model.domain.space.varies_lubricant() && model.windows.iter().all(|window| window.anchor.is_some());
        let heat = model.domain.heats();
        let here = model.windows.iter().filter(|_| !apart);
        let coefficients = here.map(|window| stored_coefficients(window, heat)).collect();
        Self { kind: model.contact(), counts, columns, fronts: fronts(model), coefficients }
    }
}

/// The coefficients of a window's snapshots, of a model that knows heat or does not.
pub(super) fn stored_coefficients(window: &Window, heat: bool) -> StoredMatrix {
    let accuracy = Keeping::of(window, heat).starts();
    let (scales, kept) = kept_starts(&window.snapshots, window.pressure.count(), accuracy);
    StoredMatrix::stepped(&kept, 1, &scales, [accuracy, 0.0])
}

/// Gives the snapshots of a window their coefficients; `None` where they do not fit.
pub(super) fn give_each(window: &mut StoredWindow, stored: StoredMatrix) -> Option<()> {
    let coefficients = stored.into_mat(window.snapshots.len())?;
    for (i, snapshot) in window.snapshots.iter_mut().enumerate() {
        snapshot.coefficients = coefficients.row(i).iter().copied().collect();
    }
    Some(())
}

/// The numbers of a snapshot; both last ones where the cost of its grid was asked for.
fn numbers(snapshot: &Snapshot) -> [Option<f64>; NUMBERS] {
    let Snapshot { point, h_0, h_c, grid_cost, .. } = snapshot;
    let [radius, speed, load, modulus, viscosity, alpha] = point.quantities().map(Some);
    let Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr } = point.sliding;
    let (srr, npr) = (Some(srr), Some(npr.unwrap_or(f64::NAN)));
    let [truncation, resolution] = [grid_cost.map(|cost| cost.truncation), grid_cost.map(|cost| cost.resolution)];
    [Some(*h_c), Some(*h_0), radius, speed, load, modulus, viscosity, alpha, srr, npr, truncation, resolution]
}

/// The boundaries of all snapshots; none where one has no boundary, or they do not fit small numbers.
fn fronts(model: &ReducedModel) -> Option<(usize, Small)> {
    let snapshots = || model.windows.iter().flat_map(|window| &window.snapshots);
    let lines = snapshots().next()?.fronts.len();
    if lines == 0 || snapshots().any(|snapshot| snapshot.fronts.len() != lines) {
        return None;
    }
    let mut all = Vec::new();
    for snapshot in snapshots() {
        let mut before = 0;
        for front in &snapshot.fronts {
            let front = i32::try_from(*front).ok()?;
            all.push(i16::try_from(front - before).ok()?);
            before = front;
        }
    }
    Some((lines, Small::of(all, MOST_PACKED)))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;

    fn bare(model: &ReducedModel) -> Vec<StoredWindow> {
        model.windows.iter().enumerate().map(|(k, window)| StoredWindow::of(model, k, window)).collect()
    }

    #[test]
    fn contacts_films_boundaries_and_costs_come_back_with_the_digits_that_are_kept() {
        for which in ["point_light", "line_sliding", "line_shear"] {
            let model = embedded(which).unwrap();
            let mut windows = bare(&model);
            give_snapshots(&mut windows, StoredSnapshots::of(&model)).unwrap();
            for (stored, window) in windows.iter().zip(&model.windows) {
                assert_eq!(stored.snapshots.len(), window.snapshots.len());
                let modes = window.pressure.count();
                for (found, own) in stored.snapshots.iter().zip(&window.snapshots) {
                    assert_eq!((found.point.kind, &found.fronts), (own.point.kind, &own.fronts));
                    assert_eq!(found.coefficients.len(), if window.anchor.is_some() { 0 } else { modes });
                    assert!(found.coefficients.iter().zip(&own.coefficients).all(|(found, own)| found == own));
                    for (found, own) in found.point.quantities().into_iter().zip(own.point.quantities()) {
                        assert!((found - own).abs() <= 6e-8 * own.abs(), "{found} and {own}");
                    }
                    let films = [(found.h_c, own.h_c), (found.h_0, own.h_0)];
                    let [npr, own_npr] = [found, own].map(|snapshot| snapshot.point.sliding.newtonian_plateau_ratio);
                    assert_eq!(npr.is_some(), own_npr.is_some());
                    let slides = [found, own].map(|snapshot| snapshot.point.sliding.slide_to_roll_ratio);
                    for (found, own) in films.into_iter().chain([slides.into()]).chain(npr.zip(own_npr)) {
                        assert!((found - own).abs() <= 8e-6 * own.abs(), "{found} and {own}");
                    }
                    assert_eq!(found.grid_cost.is_some(), own.grid_cost.is_some());
                    let Some((found, own)) = found.grid_cost.zip(own.grid_cost) else { continue };
                    for (found, own) in [(found.truncation, own.truncation), (found.resolution, own.resolution)] {
                        assert!((found - own).abs() <= 2e-3 * own.abs(), "{found} and {own}");
                    }
                }
            }
        }
    }

    #[test]
    fn columns_that_do_not_fit_are_refused() {
        let model = embedded("point_light").unwrap();
        let given = |change: &dyn Fn(&mut StoredSnapshots)| {
            let (mut windows, mut stored) = (bare(&model), StoredSnapshots::of(&model));
            change(&mut stored);
            give_snapshots(&mut windows, stored)
        };
        assert!(given(&|_| {}).is_some());
        for (what, change) in [
            ("one fewer", &(|stored: &mut StoredSnapshots| stored.counts[0] -= 1) as &dyn Fn(&mut StoredSnapshots)),
            ("very many", &|stored| stored.counts[0] = usize::MAX),
            ("many of the same", &|stored| {
                stored.counts[0] = 1 << 40;
                stored.columns[0] = Column::Same(1.0);
            }),
            ("a window more", &|stored| stored.counts.push(0)),
            ("a column less", &|stored| drop(stored.columns.pop())),
            ("no lines", &|stored| stored.fronts.as_mut().unwrap().0 = 0),
            ("very many lines", &|stored| stored.fronts.as_mut().unwrap().0 = usize::MAX),
            ("before the first column", &|stored| {
                let (lines, count) = (stored.fronts.as_ref().unwrap().0, stored.counts.iter().sum::<usize>());
                stored.fronts = Some((lines, Small::Plain(vec![-1; lines * count])));
            }),
        ] {
            assert!(given(change).is_none(), "{what}");
        }
    }
}
