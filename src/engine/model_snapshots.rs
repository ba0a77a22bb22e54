//! Training contacts of a reduced model, solved in full again to export their fields.

use super::EngineError;
use super::arrays::Array;
use crate::host::pool::map_with;
use crate::solver::full::{ContactSolver, Start};
use crate::solver::observer::{Observer, Progress};
use crate::solver::reduced::{ReducedModel, Snapshot};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Full solution of a training contact.
struct Solved {
    pressure: Vec<f64>,
    film: Vec<f64>,
    /// K P in the reference coordinate.
    deformation: Vec<f64>,
    /// P after every Newton step.
    iterates: Vec<Vec<f64>>,
}

/// Solves the training contacts of a local model (`window`, from 1) in full, each from a cold start on the model's
/// grid, on all cores. Returns arrays of nodes × contacts in the order of the model's `snapshots`, with names that
/// begin with `window_1_` and so on: `snapshot_pressures` P, `snapshot_films` H, `snapshot_deformations` K P. With
/// `iterates` also `iterate_pressures`, P after every Newton step (nodes × steps), and `iterate_snapshots`, the contact
/// of each step (from 0).
///
/// # Errors
/// If the model has no such local model, a contact has no full solution, or the observer cancels.
pub fn solve(
    model: &ReducedModel,
    window: usize,
    iterates: bool,
    observer: &dyn Observer,
) -> Result<Vec<Array>, EngineError> {
    let count = model.windows.len();
    let own = window
        .checked_sub(1)
        .and_then(|k| model.windows.get(k))
        .ok_or_else(|| EngineError::Study(format!("the model has no window {window}; accepted are 1 to {count}")))?;
    let (grid, total, done) = (&own.grid, own.snapshots.len(), AtomicUsize::new(0));
    let contact = |solver: &mut ContactSolver, k: usize, snapshot: &Snapshot| {
        let watch = Iterates { observer, kept: iterates.then(Mutex::default) };
        let solution = solver.solve(&snapshot.point, model.domain.lubricant, Start::Cold, &watch)?;
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        if !solution.converged() {
            let ending = solution.report.termination.describe();
            return Err(EngineError::Study(format!(
                "training contact {k} of window {window}: the full solver {ending}"
            )));
        }
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        observer.progress(Progress { stage: format!("training contacts of window {window}"), done, total });
        let kept = watch.kept.map(|kept| kept.into_inner().unwrap_or_else(PoisonError::into_inner));
        let deformation = grid.deformation(&solution.pressure);
        let (pressure, film) = (solution.pressure, solution.film);
        Ok(Solved { pressure, film, deformation, iterates: kept.unwrap_or_default() })
    };
    let solved = map_with(&own.snapshots, || ContactSolver::on(grid), contact)?;
    let name = |what: &str| format!("window_{window}_{what}");
    let fields = |what: &str, of: fn(&Solved) -> &Vec<f64>| {
        Array::columns(name(what), grid.len(), &solved.iter().map(of).collect::<Vec<_>>())
    };
    let mut arrays = vec![
        fields("snapshot_pressures", |solved| &solved.pressure),
        fields("snapshot_films", |solved| &solved.film),
        fields("snapshot_deformations", |solved| &solved.deformation),
    ];
    if iterates {
        let steps: Vec<&Vec<f64>> = solved.iter().flat_map(|solved| &solved.iterates).collect();
        let contacts = solved.iter().enumerate().flat_map(|(k, solved)| solved.iterates.iter().map(move |_| k as f64));
        arrays.push(Array::columns(name("iterate_pressures"), grid.len(), &steps));
        arrays.push(Array::list(name("iterate_snapshots"), contacts.collect()));
    }
    Ok(arrays)
}

/// Observer that stores the pressure of each Newton step.
struct Iterates<'a> {
    observer: &'a dyn Observer,
    kept: Option<Mutex<Vec<Vec<f64>>>>,
}

impl Observer for Iterates<'_> {
    fn iterate(&self, pressure: &[f64]) {
        if let Some(kept) = &self.kept {
            kept.lock().unwrap_or_else(PoisonError::into_inner).push(pressure.to_vec());
        }
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;
    use crate::engine::model_arrays::of_model;
    use faer::Mat;
    use std::sync::Arc;

    #[test]
    fn training_contacts_have_the_fields_that_the_basis_was_made_of() {
        let mut model = Arc::unwrap_or_clone(embedded("line").unwrap());
        model.windows.truncate(1);
        model.windows[0].snapshots.truncate(3);
        let (window, arrays) = (&model.windows[0], solve(&model, 1, true, &()).unwrap());
        let [pressures, films, deformations, iterates, contacts] = &arrays[..] else { panic!("{}", arrays.len()) };
        let nodes = window.grid.len();
        assert!([pressures, films, deformations].iter().all(|array| array.shape == [nodes, 3]));
        assert_eq!(iterates.shape, [nodes, contacts.values.len()]);
        assert!(of_model(&model).iter().all(|array| arrays.iter().all(|own| own.name != array.name)));
        let column = |array: &Array, k: usize| -> Vec<f64> {
            array.values.iter().skip(k).step_by(array.shape[1]).copied().collect()
        };
        let last = contacts.values.iter().rposition(|contact| *contact == 1.0).unwrap();
        assert_eq!(column(iterates, last), column(pressures, 1), "the last step leads to the solution");
        let fields = Mat::from_fn(nodes, 3, |i, k| pressures.values[3 * i + k]);
        let coefficients = window.pressure.coefficients(window.grid.weights(), &fields);
        for (k, snapshot) in window.snapshots.iter().enumerate() {
            let kept = &snapshot.coefficients;
            let off = coefficients.col(k).iter().zip(kept).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 5e-3 * kept[0].abs(), "{off:e} of {}", kept[0]);
        }
        assert!(solve(&model, 0, false, &()).unwrap_err().to_string().contains("no window 0; accepted are 1 to 1"));
    }
}
