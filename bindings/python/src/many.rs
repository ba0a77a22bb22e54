//! Solves many contacts on all cores.

use crate::contact::{Asked, Contact, bench_with};
use crate::tables::structured;
use crate::work::{Watch, long, refused, stated};
use ehl_explorer::engine::{EngineError, Extras, Workbench, contact_columns, result_columns};
use ehl_explorer::host::clock::Stopwatch;
use ehl_explorer::host::pool::on_all_cores;
use ehl_explorer::scene::{Bench, ContactRow, ContactSpec, Field, RowStatus, Words, names};
use ehl_explorer::solver::observer::{Observer, Progress};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::ScopedJoinHandle;

/// Number of contacts for which one reduced solver is built. Building its operators costs as much as a few solves.
const CHUNK: usize = 128;

/// Returns the k-th contact, with its values of the varied fields.
fn varied(contact: &ContactSpec, columns: &[(Field, &[f64])], k: usize) -> ContactSpec {
    let mut own = contact.clone();
    for (field, values) in columns {
        own.set_as_typed(*field, values.get(k).copied().unwrap_or(f64::NAN));
    }
    own
}

/// Text columns of a row.
#[derive(Clone, Default)]
struct Said {
    status: RowStatus,
    reason: String,
    warning: String,
}

/// Solves one contact into a row of the table, and returns its text columns.
///
/// # Errors
/// If a model cannot be read, which affects all rows, or if the observer cancels.
fn solve_row(
    bench: &mut Workbench,
    contact: &ContactSpec,
    (columns, row): (&[&str], &mut [f64]),
    watch: &Watch,
) -> Result<Said, EngineError> {
    bench.forget();
    let request = contact.request().map_err(|refusal| refusal.in_words(Words::Keywords));
    let solved =
        ContactRow::solve(request.as_ref().map_err(Clone::clone), |request| bench.answer(request, None, watch))?;
    solved.fill(columns, row);
    Ok(Said { status: solved.status, warning: solved.warning(), reason: solved.reason })
}

/// Solves a contact with some of its options varied, one contact for each element of the arrays (float64, shape (n,)),
/// on all cores. Each is solved from a cold start, so that results do not depend on order or cores.
///
/// Returns a structured array of shape (n,): the contact and its result by the names of ``sweep``'s tables, NaN if a
/// solve did not converge. ``reduced.trained`` is 1 or 0, ``warning`` is a text. ``status`` is "converged", "not
/// converged" or "refused", and ``reason`` explains the latter two.
#[pyfunction]
#[pyo3(signature = (contact, columns, method=None, model=None, progress=None))]
pub fn solve_many<'py>(
    py: Python<'py>,
    contact: &Contact,
    columns: Vec<(String, PyReadonlyArray1<'py, f64>)>,
    method: Option<&str>,
    model: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let asked = contact.asked(method, model)?;
    let columns = columns.iter().map(|(name, values)| Ok((Field::varied(name).map_err(refused)?, values.as_slice()?)));
    let columns = columns.collect::<PyResult<Vec<(Field, &[f64])>>>()?;
    let total = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
    if let Some((field, values)) = columns.iter().find(|(_, values)| values.len() != total) {
        let name = Words::Keywords.of(*field);
        return Err(refused(format!("{name} has {} values, but another option has {total}", values.len())));
    }
    let varies = |wanted: Field| columns.iter().any(|(field, _)| *field == wanted);
    let extras = Extras {
        heat: asked.spec.heat == Some(true),
        total: asked.spec.length.is_some() || varies(Field::Length),
        mixed: asked.spec.roughness.is_some() || varies(Field::Roughness),
    };
    let columns_of_rows = [contact_columns(), result_columns(extras)].concat();
    let Asked { spec, model } = asked;
    let width = columns_of_rows.len();
    let (numbers, said) = long(py, progress, |watch| {
        let (mut numbers, mut said) = (vec![f64::NAN; width * total], vec![Said::default(); total]);
        let done = AtomicUsize::new(0);
        let chunks = numbers.par_chunks_mut(width * CHUNK).zip(said.par_chunks_mut(CHUNK)).enumerate();
        let solve = |(chunk, (rows, said)): (usize, (&mut [f64], &mut [Said]))| {
            let mut bench = bench_with(model.as_ref());
            for (i, (row, said)) in rows.chunks_exact_mut(width).zip(&mut *said).enumerate() {
                let contact = varied(&spec, &columns, chunk * CHUNK + i);
                *said = solve_row(&mut bench, &contact, (&columns_of_rows, row), watch)?;
            }
            let done = done.fetch_add(said.len(), Ordering::Relaxed) + said.len();
            watch.progress(Progress { stage: "contacts".to_owned(), done, total });
            if watch.cancelled() { Err(EngineError::Cancelled) } else { Ok(()) }
        };
        on_all_cores(|| chunks.try_for_each(solve))?;
        Ok((numbers, said))
    })?;
    let texts = |of: fn(&Said) -> String| said.iter().map(of).collect::<Vec<String>>();
    let [statuses, reasons, warnings] = [
        texts(|said| said.status.name().to_owned()),
        texts(|said| said.reason.clone()),
        texts(|said| said.warning.clone()),
    ];
    let texts = [(names::STATUS, &statuses[..]), (names::REASON, &reasons[..]), (names::WARNING, &warnings[..])];
    structured(py, &columns_of_rows, numbers, &texts)
}

/// Returns the time in seconds of ``runs`` solves of a contact without Python, each from a cold start, on the calling
/// thread, or shared by ``threads`` threads. Used to measure the overhead of this module.
#[pyfunction]
#[pyo3(signature = (contact, runs, method=None, model=None, threads=1))]
pub fn measure(
    py: Python<'_>,
    contact: &Contact,
    runs: usize,
    method: Option<&str>,
    model: Option<&Bound<'_, PyAny>>,
    threads: usize,
) -> PyResult<f64> {
    let asked = contact.asked(method, model)?;
    let request = asked.spec.request().map_err(|refusal| refused(stated(refusal)))?;
    let solve = |bench: &mut Workbench, runs: usize| {
        for _ in 0..runs {
            bench.forget();
            bench.answer(&request, None, &()).map_err(|error| error.to_string())?;
        }
        Ok::<_, String>(())
    };
    let seconds = py.detach(|| {
        let clock = Stopwatch::start();
        let work = || solve(&mut asked.bench(), runs.div_ceil(threads.max(1)));
        // A single thread is the calling one, as for a call from Python: same core and same cache.
        let done = if threads <= 1 {
            work()
        } else {
            std::thread::scope(|scope| {
                let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                let mut ends = handles.into_iter().map(ScopedJoinHandle::join);
                ends.try_for_each(|end| end.unwrap_or_else(|_| Err("a solve failed unexpectedly".to_owned())))
            })
        };
        done.map(|()| clock.seconds())
    });
    seconds.map_err(refused)
}
