//! Local model in a file: an entry in the directory, and arrays `windows/K/…`.

use super::container::{Contents, Writer};
use super::error::{ModelFileError, damaged};
use super::sound::are_rows;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::physics::contact::Ellipse;
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::{
    Combined, Keeping, PodBasis, PressureModes, RULE_ACCURACY, SampledRows, Sampling, Scheme, Shapes, SharedBasis,
    Snapshot, TractionRule, Window, factor_accuracy, factor_scales, kept_starts,
};
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Relative accuracy of the deformations of point contacts. Their bases have no modes with small singular values, and
/// no mobility amplifies rounding errors. Deformations of line contacts are stored with the accuracy of pressures.
const BENT_ACCURACY: f64 = 1e-5;
/// Relative accuracies of pressures and deformations of transient models.
const TRANSIENT: [f64; 2] = [1e-12, 1e-6];
/// Accepted relative deviation of a column of a cubature matrix from a multiple of the modes at its node.
const ITS_OWN: f64 = 1e-3;

/// Local model in the directory.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WindowEntry {
    /// Range of M; absent in transient models.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub m: Option<(f64, f64)>,
    /// M and L of the centre, if it was built around one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<(f64, f64)>,
    /// Range of R_y/R, if it was trained for elliptical contacts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_ratio: Option<(f64, f64)>,
    /// Index of its grid.
    pub grid: usize,
    pub penalty: f64,
    pub sampling: Sampling,
    pub scheme: Scheme,
    /// Number of snapshots.
    pub snapshots: usize,
    /// True if it has a traction quadrature: that of its arrays, or without them the trapezoidal rule over all nodes.
    pub traction: bool,
    /// Number of measured errors in its calibration; 0 without one.
    pub evidence: usize,
}

impl WindowEntry {
    /// Returns true if its range of R_y/R is sound: an accepted interval in a model of elliptical contacts
    /// (`ellipses`), absent in any other model.
    pub fn has_sound_shapes(&self, ellipses: bool) -> bool {
        let sound =
            |(low, high): (f64, f64)| Ellipse::of_ratio(low).is_ok() && Ellipse::of_ratio(high).is_ok() && low < high;
        self.radius_ratio.is_some() == ellipses && self.radius_ratio.is_none_or(sound)
    }

    /// Returns the shapes of its local model of elliptical contacts; `None` for other contacts.
    ///
    /// # Errors
    /// If the local model or one of its solutions is not of such contacts.
    pub fn shapes_of(&self, window: &Window) -> Result<Option<Shapes>, ModelFileError> {
        let shaped = |snapshot: &Snapshot| snapshot.point.radius_y_m.is_some() == self.radius_ratio.is_some();
        if !window.snapshots.iter().all(shaped) {
            return Err(damaged("shapes"));
        }
        let Some(ratios) = self.radius_ratio else { return Ok(None) };
        let ContactGrid::Point(grid) = &window.grid else { return Err(damaged("shapes")) };
        Shapes::new(grid, ratios).map(Some).map_err(|_| damaged("shapes"))
    }
}

/// Precision of the arrays of a local model.
#[derive(Clone, Copy)]
pub(super) enum Rounding {
    /// Rounded as for steady models, thermal or isothermal.
    Steady { heat: bool },
    /// Modes rounded to a given accuracy, everything else stored exactly.
    Transient,
}

fn name(k: usize, what: &str) -> String {
    format!("windows/{k}/{what}")
}

/// Adds a basis, given the array names of its modes and singular values.
pub(super) fn write_basis(
    writer: &mut Writer,
    names: [&str; 2],
    basis: &PodBasis,
    (across, accuracy): (usize, f64),
) -> Option<()> {
    writer.rounded(names[0], &basis.modes, across, &basis.scales(), [accuracy, 0.0])?;
    writer.list(names[1], &basis.singular_values)
}

/// Reads a basis with this number of rows. Returns `None` if it is damaged.
pub(super) fn read_basis(contents: &Contents<'_>, names: [&str; 2], rows: usize) -> Option<PodBasis> {
    let (modes, singular_values) = (contents.matrix(names[0], rows)?, singular_values(contents, names[1])?);
    (modes.ncols() > 0 && singular_values.len() >= modes.ncols()).then_some(PodBasis { modes, singular_values })
}

fn singular_values(contents: &Contents<'_>, name: &str) -> Option<Vec<f64>> {
    contents.list(name).filter(|values: &Vec<f64>| values.iter().all(|value| value.is_finite()))
}

/// Returns the array names of the modes and singular values of a local model's deformation basis.
fn deformation(k: usize) -> [String; 2] {
    [name(k, "deformation"), name(k, "deformation_singular_values")]
}

/// Reads the deformation basis of local model k; `Some(None)` if it shares that of the first. Returns `None` if it is
/// damaged.
pub(super) fn read_deformation(contents: &Contents<'_>, k: usize, nodes: usize) -> Option<Option<PodBasis>> {
    let names = deformation(k);
    if k > 0 && contents.shape(&names[0]).is_none() {
        return Some(None);
    }
    read_basis(contents, names.each_ref().map(String::as_str), nodes).map(Some)
}

/// Returns the shapes of the pressure and deformation modes of a local model, without decoding them.
pub(super) fn shapes<'a>(contents: &'a Contents<'_>, k: usize) -> [Option<&'a [usize]>; 2] {
    [contents.shape(&name(k, "pressure")), contents.shape(&deformation(k)[0])]
}

impl Rounding {
    fn keeping(self, window: &Window) -> Option<Keeping> {
        match self {
            Self::Steady { heat } => Some(Keeping::of(window, heat)),
            Self::Transient => None,
        }
    }

    /// Returns the accuracies of a local model's pressures and deformations.
    pub fn accuracies(self, window: &Window) -> [f64; 2] {
        match self.keeping(window).map(Keeping::accuracy) {
            None => TRANSIENT,
            Some(accuracy) if window.grid.kind().is_line() => [accuracy; 2],
            Some(accuracy) => [accuracy, BENT_ACCURACY],
        }
    }

    /// Adds the factors that combine the modes of a shared basis into a local model's modes.
    fn write_factors(self, writer: &mut Writer, k: usize, window: &Window, factors: &Mat<f64>) -> Option<()> {
        if self.keeping(window).is_none() {
            return writer.exact(name(k, "factors"), factors);
        }
        let scales = factor_scales(window.pressure.singular_values(), factors.ncols());
        writer.rounded(name(k, "factors"), factors, 1, &scales, factor_accuracy(factors, &scales))
    }

    /// Adds the reconstruction matrix of a local model: exactly, as the weights of a cubature, or rounded.
    fn write_reconstruction(self, writer: &mut Writer, k: usize, window: &Window) -> Option<()> {
        let exact = &window.reconstruction;
        if !self.keeping(window).is_some_and(Keeping::shortens_rules) {
            return writer.exact(name(k, "reconstruction"), exact);
        }
        let weights = || cubature_weights(exact, &modes_at(&window.grid, &window.pressure, &window.sampled_rows));
        match if window.sampling == Sampling::Cubature { weights() } else { None } {
            Some(weights) => writer.list(name(k, "weights"), &weights),
            None => {
                let scales = vec![1.0; exact.ncols()];
                writer.rounded(name(k, "reconstruction"), exact, 1, &scales, [RULE_ACCURACY, 0.0])
            }
        }
    }

    /// Adds the coefficients of a local model's snapshots.
    fn write_coefficients(self, writer: &mut Writer, k: usize, window: &Window) -> Option<()> {
        let (snapshots, modes) = (&window.snapshots, window.pressure.count());
        if snapshots.is_empty() {
            return Some(());
        }
        match self.keeping(window).map(Keeping::starts) {
            Some(accuracy) => {
                let (scales, kept) = kept_starts(snapshots, modes, accuracy);
                writer.rounded(name(k, "coefficients"), &kept, 1, &scales, [accuracy, 0.0])
            }
            None => {
                let all: Vec<f64> = snapshots.iter().flat_map(|snapshot| &snapshot.coefficients).copied().collect();
                writer.table(name(k, "coefficients"), &[snapshots.len(), all.len() / snapshots.len()], &all)
            }
        }
    }
}

/// Adds local model k, given the index of its grid. `shared` is true if there is a shared pressure basis. The
/// deformation basis is left out if it is that of the `first` local model. Returns `None` if it cannot be encoded.
pub(super) fn write_window(
    writer: &mut Writer,
    (k, window, grid): (usize, &Window, usize),
    rounding: Rounding,
    (shared, first): (bool, Option<&Window>),
) -> Option<WindowEntry> {
    let across = window.grid.nodes().1;
    let [pressures, deformations] = rounding.accuracies(window);
    match window.pressure.combined().filter(|_| shared) {
        Some(own) => {
            rounding.write_factors(writer, k, window, &own.factors)?;
            writer.list(name(k, "singular_values"), window.pressure.singular_values())?;
        }
        None => {
            let names = [name(k, "pressure"), name(k, "singular_values")];
            let names = names.each_ref().map(String::as_str);
            write_basis(writer, names, window.pressure.basis(), (across, pressures))?;
        }
    }
    if !first.is_some_and(|first| shares_deformation(window, first)) {
        let names = deformation(k);
        write_basis(writer, names.each_ref().map(String::as_str), &window.deformation, (across, deformations))?;
    }
    writer.indices(name(k, "rows"), &window.sampled_rows)?;
    rounding.write_reconstruction(writer, k, window)?;
    if let Some(residual) = &window.residual_reconstruction {
        writer.exact(name(k, "residual_reconstruction"), residual)?;
    }
    if let Some(rule) = &window.traction {
        writer.indices(name(k, "traction_nodes"), &rule.nodes)?;
        writer.list(name(k, "traction_weights"), &rule.weights)?;
    }
    rounding.write_coefficients(writer, k, window)?;
    Some(WindowEntry {
        m: matches!(rounding, Rounding::Steady { .. }).then_some(window.m),
        anchor: window.anchor.map(|anchor| (anchor.m, anchor.l)),
        radius_ratio: window.shapes.as_ref().map(|shapes| shapes.ratios),
        grid,
        penalty: window.penalty,
        sampling: window.sampling,
        scheme: window.scheme,
        snapshots: window.snapshots.len(),
        traction: window.traction.is_some(),
        evidence: window.calibration.as_ref().map_or(0, |known| known.evidence()),
    })
}

/// Reads local model k on its grid, given the data that it shares with others and its snapshots without coefficients.
///
/// # Errors
/// If its parts are inconsistent.
pub(super) fn read_window(
    contents: &Contents<'_>,
    (k, entry): (usize, &WindowEntry),
    (grid, shared): (ContactGrid, Option<&Arc<SharedBasis>>),
    deformation: Arc<PodBasis>,
    mut snapshots: Vec<Snapshot>,
) -> Result<Window, ModelFileError> {
    let pressure = read_pressure(contents, k, &grid, shared).ok_or(damaged("bases"))?;
    let modes = pressure.count();
    if !(entry.penalty.is_finite() && entry.penalty > 0.0) {
        return Err(damaged("penalty"));
    }
    let rows = read_rows(contents, k, entry.scheme, (&grid, &pressure))?;
    give_coefficients(contents, k, &mut snapshots).ok_or(damaged("snapshots"))?;
    let sound = |snapshot: &Snapshot| {
        let Sliding { slide_to_roll_ratio, newtonian_plateau_ratio } = snapshot.point.sliding;
        snapshot.point.check().is_ok()
            && snapshot.point.kind == grid.kind()
            && slide_to_roll_ratio.is_finite()
            && newtonian_plateau_ratio.is_none_or(|ratio| (0.0..=1.0).contains(&ratio))
            && (contents.is_outline() || snapshot.coefficients.len() == modes)
            && snapshot.coefficients.iter().chain([&snapshot.h_0, &snapshot.h_c]).all(|value| value.is_finite())
    };
    if !snapshots.iter().all(sound) {
        return Err(damaged("snapshots"));
    }
    let (nodes, weights) = (name(k, "traction_nodes"), name(k, "traction_weights"));
    let rule = contents.indices(&nodes).zip(contents.list(&weights));
    let rule = rule.map(|(nodes, weights)| TractionRule { nodes, weights }).filter(|rule| rule.sound(&grid));
    let rule = rule.filter(|rule| entry.traction || rule.nodes.is_empty()).ok_or(damaged("traction"))?;
    let m = entry.m.unwrap_or((0.0, f64::INFINITY));
    let mut window = Window::new(m, grid, pressure, deformation, snapshots, entry.sampling, rows);
    (window.penalty, window.traction) = (entry.penalty, Some(rule).filter(|_| entry.traction));
    Ok(window)
}

fn read_pressure(
    contents: &Contents<'_>,
    k: usize,
    grid: &ContactGrid,
    shared: Option<&Arc<SharedBasis>>,
) -> Option<PressureModes> {
    let (factors, values) = (name(k, "factors"), name(k, "singular_values"));
    if contents.shape(&factors).is_none() {
        let basis = read_basis(contents, [&name(k, "pressure"), &values], grid.len())?;
        return Some(PressureModes::own(basis, grid));
    }
    if contents.is_outline() {
        let &[_, modes] = contents.shape(&factors)? else { return None };
        let basis = PodBasis { modes: Mat::zeros(0, modes), singular_values: singular_values(contents, &values)? };
        return Some(PressureModes::own(basis, grid));
    }
    let shared = shared?;
    let modes = shared.basis.modes.ncols();
    let factors = contents.matrix(&factors, modes).filter(|own| (1..=modes).contains(&own.ncols()))?;
    Some(Combined { shared: Arc::clone(shared), factors }.into_modes(singular_values(contents, &values)?))
}

/// Reads the sampled equations of a local model.
///
/// # Errors
/// If they are inconsistent with its grid, its modes, or each other.
fn read_rows(
    contents: &Contents<'_>,
    k: usize,
    scheme: Scheme,
    (grid, pressure): (&ContactGrid, &PressureModes),
) -> Result<SampledRows, ModelFileError> {
    let (modes, name) = (pressure.count(), |what| name(k, what));
    let rows =
        contents.indices(&name("rows")).filter(|rows| are_rows(rows, grid)).ok_or(damaged("sampled equations"))?;
    let (own, residual) = (name("reconstruction"), name("residual_reconstruction"));
    let stored = contents.shape(&own).and_then(|shape| shape.first().copied()).unwrap_or(modes);
    let equations = match scheme {
        Scheme::Galerkin => modes,
        Scheme::LeastSquares { .. } => 1,
        Scheme::Gnat { .. } => stored.max(modes).min(grid.unknowns()),
    };
    let weights: Vec<f32> = contents.list(&name("weights")).ok_or(damaged("sampled equations"))?;
    let reconstruction = match weights.is_empty() {
        _ if contents.is_outline() => Some(Mat::zeros(0, rows.len())),
        true => contents.matrix(&own, equations),
        false => of_weights(&weights, &rows, || modes_at(grid, pressure, &rows)).filter(|own| own.nrows() == equations),
    };
    let reconstruction = reconstruction.filter(|own| own.ncols() == rows.len()).ok_or(damaged("sampled equations"))?;
    let gnat = matches!(scheme, Scheme::Gnat { .. });
    let enough = scheme == Scheme::Galerkin || rows.len() > modes;
    if !enough || gnat != contents.shape(&residual).is_some() {
        return Err(damaged("scheme"));
    }
    let residual = if gnat {
        let residual = contents.matrix(&residual, equations).filter(|own| own.ncols() == rows.len());
        Some(residual.ok_or(damaged("scheme"))?)
    } else {
        None
    };
    Ok(SampledRows { rows, reconstruction, scheme, residual })
}

/// Reads the coefficients of snapshots. Returns `None` if they are inconsistent.
fn give_coefficients(contents: &Contents<'_>, k: usize, snapshots: &mut [Snapshot]) -> Option<()> {
    if snapshots.is_empty() {
        return Some(());
    }
    let coefficients = contents.matrix(&name(k, "coefficients"), snapshots.len())?;
    for (snapshot, own) in snapshots.iter_mut().zip(coefficients.row_iter()) {
        snapshot.coefficients = own.iter().copied().collect();
    }
    Some(())
}

/// Returns all modes at the nodes of sampled equations, equations × modes.
fn modes_at(grid: &ContactGrid, pressure: &PressureModes, rows: &[usize]) -> Mat<f64> {
    let nodes: Vec<usize> = rows.iter().map(|&row| grid.node(row)).collect();
    pressure.at(&nodes, pressure.count())
}

/// Returns the weights of a cubature, with the precision of `f32`. Column r of its matrix must be a multiple of row r
/// of `modes`; otherwise returns `None`.
fn cubature_weights(matrix: &Mat<f64>, modes: &Mat<f64>) -> Option<Vec<f32>> {
    if (matrix.nrows(), matrix.ncols()) != (modes.ncols(), modes.nrows()) {
        return None;
    }
    let weight = |r: usize| {
        let (column, node) = (matrix.col(r), modes.row(r).transpose());
        let square = node.squared_norm_l2();
        let weight = if square > 0.0 { node.transpose() * column / square } else { 0.0 };
        let off = (column - node * faer::Scale(weight)).norm_l2();
        (off <= ITS_OWN * column.norm_l2()).then_some(weight as f32)
    };
    (0..matrix.ncols()).map(weight).collect()
}

/// Returns the matrix of a cubature from its weights; `None` if the number of weights is wrong or one is not finite.
fn of_weights(weights: &[f32], rows: &[usize], modes: impl FnOnce() -> Mat<f64>) -> Option<Mat<f64>> {
    if weights.len() != rows.len() || weights.iter().any(|weight| !weight.is_finite()) {
        return None;
    }
    let modes = modes();
    Some(Mat::from_fn(modes.ncols(), modes.nrows(), |k, r| {
        f64::from(weights.get(r).copied().unwrap_or_default()) * modes[(r, k)]
    }))
}

/// Returns true if two local models have the same deformation basis.
fn shares_deformation(window: &Window, other: &Window) -> bool {
    if Arc::ptr_eq(&window.deformation, &other.deformation) {
        return true;
    }
    let equal = || window.deformation.modes == other.deformation.modes;
    window.anchor.is_some() && window.grid.spec() == other.grid.spec() && equal()
}
