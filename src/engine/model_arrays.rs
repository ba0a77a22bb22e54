//! Contents of reduced models as arrays for other programs.

use super::arrays::Array;
use crate::solver::reduced::tpwl::TpwlModel;
use crate::solver::reduced::transient::{TrajectoryModel, TrajectoryStart};
use crate::solver::reduced::{PodBasis, ReducedModel, Window, deformation_weights};
use faer::Mat;

/// Returns a matrix in row-major order.
fn matrix(name: String, of: &Mat<f64>) -> Array {
    let values = of.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<f64>>()).collect();
    Array { name, shape: vec![of.nrows(), of.ncols()], values }
}

fn basis(prefix: &str, of: &PodBasis) -> [Array; 2] {
    [
        matrix(format!("{prefix}_modes"), &of.modes),
        Array::list(format!("{prefix}_singular_values"), of.singular_values.clone()),
    ]
}

/// Returns nodes, bases and sampled equations of a local model, with names that begin with `prefix`.
fn of_window(prefix: &str, window: &Window) -> Vec<Array> {
    let (name, grid) = (|what: &str| format!("{prefix}{what}"), &window.grid);
    let places: Vec<(f64, f64)> = (0..grid.weights().len()).map(|node| grid.place(node)).collect();
    let sampled = window.sampled_rows.iter().map(|row| grid.node(*row) as f64).collect();
    let mut arrays = vec![
        Array::list(name("xi"), places.iter().map(|place| place.0).collect()),
        Array::list(name("y"), places.iter().map(|place| place.1).collect()),
        Array::list(name("weights"), grid.weights().to_vec()),
    ];
    arrays.extend(basis(&name("pressure"), window.pressure.basis()));
    arrays.push(Array::list(name("deformation_weights"), deformation_weights(grid)));
    arrays.extend(basis(&name("deformation"), &window.deformation));
    arrays.push(Array::list(name("sampled_nodes"), sampled));
    arrays.push(matrix(name("reconstruction"), &window.reconstruction));
    arrays
}

/// Returns the arrays of a transient model: nodes, bases and sampled equations as for a local model, without prefix;
/// those of its local bases with the prefixes `local_1_` and so on; the starts of its trainings `starts` (R, u_m, w,
/// E', η₀, α, duration T, H₀) with `start_coefficients`.
pub fn of_trajectories(model: &TrajectoryModel) -> Vec<Array> {
    let mut arrays = of_window("", &model.window);
    for (k, local) in model.locals.iter().enumerate() {
        arrays.extend(of_window(&format!("local_{}_", k + 1), &local.window));
    }
    let starts = model.starts.iter();
    let row = |start: &TrajectoryStart| start.point.quantities().into_iter().chain([start.duration, start.h_0]);
    let rows: Vec<Vec<f64>> = starts.clone().map(|start| row(start).collect()).collect();
    arrays.push(Array::rows("starts", &rows));
    let coefficients: Vec<&[f64]> = starts.map(|start| start.coefficients.as_slice()).collect();
    arrays.push(Array::rows("start_coefficients", &coefficients));
    arrays
}

/// Returns the arrays of every local model, with names that begin with `window_1_` and so on:
///
/// - `m` (range of M), `xi` and `y` of the nodes (X over the reference half width, Y), quadrature `weights`;
/// - `pressure_modes` (nodes × modes, orthonormal with respect to `weights`) and `deformation_modes` (orthonormal with
///   respect to `deformation_weights`) with their `_singular_values`;
/// - `sampled_nodes` (from 0), `reconstruction` (modes × sampled equations);
/// - `snapshots` (M, L, R, u_m, w, E′, η₀, α, SRR, H₀, H_c) with `snapshot_coefficients`.
///
/// The first node of a line contact lies outside the inlet.
pub fn of_model(model: &ReducedModel) -> Vec<Array> {
    let mut arrays = Vec::new();
    for (k, window) in model.windows.iter().enumerate() {
        let name = |what: &str| format!("window_{}_{what}", k + 1);
        arrays.push(Array::list(name("m"), vec![window.m.0, window.m.1]));
        arrays.extend(of_window(&format!("window_{}_", k + 1), window));
        let snapshots: Vec<Vec<f64>> = window
            .snapshots
            .iter()
            .map(|snapshot| {
                let (point, moes) = (&snapshot.point, snapshot.point.moes());
                let sliding = point.sliding.slide_to_roll_ratio;
                let own = [sliding, snapshot.h_0, snapshot.h_c];
                [moes.m, moes.l].into_iter().chain(point.quantities()).chain(own).collect()
            })
            .collect();
        arrays.push(Array::rows(name("snapshots"), &snapshots));
        let coefficients: Vec<&[f64]> = window.snapshots.iter().map(|s| s.coefficients.as_slice()).collect();
        arrays.push(Array::rows(name("snapshot_coefficients"), &coefficients));
    }
    arrays
}

/// Returns the arrays of a linearised model:
///
/// - `x` and quadrature `weights` of the nodes;
/// - `pressure_modes` V (nodes × modes, orthonormal with respect to `weights`), `mode_deformations` K V (the
///   deformation by each pressure mode), `singular_values`;
/// - `points`, the operating points (trajectory from 1, reference load, T, R, u, w relative to their references,
///   spacing), with `states` (p̃, H₀);
/// - the linearised systems (4.27), points × state × columns: `storage_by_state`, `storage_by_input`, `flux_by_state`,
///   `flux_by_input`, with `storage` and `flux` at the points.
pub fn of_linearised(model: &TpwlModel) -> Vec<Array> {
    let (space, points) = (&model.space, &model.points);
    let states: Vec<&[f64]> = points.iter().map(|point| point.moment.state.as_slice()).collect();
    let rows: Vec<Vec<f64>> = points
        .iter()
        .map(|point| {
            let input = point.moment.input;
            let load = model.sets.get(point.set).map_or(f64::NAN, |set| set.problem.point.load);
            let place = [(point.trajectory + 1) as f64, load, point.moment.time];
            place.into_iter().chain([input.radius, input.speed, input.load, point.spacing]).collect()
        })
        .collect();
    let mut arrays = vec![
        Array::list("x", space.grid.abscissae().0.to_vec()),
        Array::list("y", space.grid.abscissae().1.to_vec()),
        Array::list("weights", space.grid.weights().to_vec()),
        matrix("pressure_modes".to_owned(), &space.pressure),
        matrix("mode_deformations".to_owned(), &space.deformation),
        Array::list("singular_values", model.singular_values.clone()),
        Array::rows("points", &rows),
        Array::rows("states", &states),
    ];
    for (name, of) in [("storage", 0), ("flux", 1)] {
        let systems = || points.iter().map(|point| if of == 0 { &point.system.storage } else { &point.system.flux });
        let values: Vec<&[f64]> = systems().map(|system| system.value.as_slice()).collect();
        arrays.push(Array::rows(name, &values));
        arrays.push(stacked(format!("{name}_by_state"), systems().map(|system| &system.by_state)));
        arrays.push(stacked(format!("{name}_by_input"), systems().map(|system| &system.by_input)));
    }
    arrays
}

/// Stacks matrices of equal size.
fn stacked<'a>(name: String, matrices: impl Iterator<Item = &'a Mat<f64>>) -> Array {
    let mut stack = Array { name, shape: vec![0, 0, 0], values: Vec::new() };
    for (k, of) in matrices.enumerate() {
        let Array { shape, values, .. } = matrix(String::new(), of);
        stack.shape = std::iter::once(k + 1).chain(shape).collect();
        stack.values.extend(values);
    }
    stack
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;

    #[test]
    fn a_basis_leaves_whole_and_orthonormal() {
        let model = embedded("line").unwrap();
        let arrays = of_model(&model);
        let of = |name: &str| arrays.iter().find(|array| array.name == name).unwrap();
        for (modes, weights) in [("pressure_modes", "weights"), ("deformation_modes", "deformation_weights")] {
            let (modes, weights) = (of(&format!("window_1_{modes}")), of(&format!("window_1_{weights}")));
            let [nodes, columns] = modes.shape[..] else { panic!("{:?}", modes.shape) };
            assert_eq!(nodes, weights.values.len());
            let product = |a: usize, b: usize| -> f64 {
                let at = |i: usize, k: usize| modes.values[i * columns + k];
                (0..nodes).map(|i| weights.values[i] * at(i, a) * at(i, b)).sum()
            };
            // Modes with small singular values have fewer digits in the file.
            let last = columns - 1;
            for (a, b, digits) in [(0, 0, 1e-9), (0, 1, 1e-9), (last, last, 1e-6), (0, last, 1e-6)] {
                assert!((product(a, b) - f64::from(u8::from(a == b))).abs() < digits, "{}: {a}, {b}", modes.name);
            }
        }
        let snapshots = of("window_1_snapshots");
        assert_eq!(snapshots.shape, [model.windows[0].snapshots.len(), 11]);
        assert_eq!(of("window_1_snapshot_coefficients").shape[0], snapshots.shape[0]);
        assert_eq!(of("window_1_sampled_nodes").values.len(), model.windows[0].sampled_rows.len());
        let mut names: Vec<&str> = arrays.iter().map(|array| array.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), arrays.len(), "no name twice");
    }
}
