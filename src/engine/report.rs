//! One result as the command line prints it.

use super::answer::Answer;
use super::grid_accuracy::GridAccuracy;
use super::table::Table;
use crate::solver::full::Solution;
use crate::solver::physics::contact::ContactKind;
use serde::Serialize;
use serde_json::Value;

/// The object of `solve --json`; what does not apply is absent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PointReport {
    /// `line` or `point`.
    pub contact: &'static str,
    /// `full` or `reduced`.
    pub method: &'static str,
    /// Whether the solve converged; without that there are no scalars.
    pub converged: bool,
    /// What a reader must know.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub warning: Option<String>,
    /// The operating point.
    pub si: SiReport,
    /// Moes numbers.
    pub moes: MoesReport,
    /// Hertzian scales.
    pub hertz: HertzReport,
    /// Grid and unknowns.
    pub grid: GridReport,
    /// Scalars of the solution.
    #[serde(flatten)]
    pub scalars: ScalarsReport,
    /// ‖f‖₂ of the scaled rows, each weighted by the square root of its cell: the L2 norm over the domain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_norm: Option<f64>,
    /// Newton steps.
    pub newton_iterations: usize,
    /// Krylov iterations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_iterations: Option<usize>,
    /// Seconds of the solve alone.
    pub wall_s: f64,
    /// What only a reduced solve has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reduced: Option<ReducedReport>,
    /// What the grid of a point contact costs, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<GridAccuracy>,
}

/// SI quantities without unit suffixes, as the options are called.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SiReport {
    /// R \[m\].
    pub radius: f64,
    /// u_m \[m/s\].
    pub speed: f64,
    /// w \[N/m\] (line) or \[N\] (point).
    pub load: f64,
    /// E′ \[Pa\].
    pub modulus: f64,
    /// η₀ \[Pa·s\].
    pub viscosity: f64,
    /// α \[1/Pa\].
    pub alpha: f64,
}

/// Moes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MoesReport {
    /// Load number.
    #[serde(rename = "M")]
    pub m: f64,
    /// Lubricant number.
    #[serde(rename = "L")]
    pub l: f64,
}

/// Hertzian scales.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HertzReport {
    /// Half width a \[m\].
    pub a_m: f64,
    /// Maximum pressure p_H \[Pa\].
    pub p_h_pa: f64,
}

/// Grid and unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GridReport {
    /// `uniform`, `graded` or `model`.
    pub kind: &'static str,
    /// Nodes along X, both ends counted.
    pub nx: usize,
    /// Nodes along Y.
    pub ny: usize,
    /// Unknowns iterated on.
    pub dofs: usize,
}

/// Dimensionless scalars and their SI twins; all absent without convergence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Default)]
pub struct ScalarsReport {
    /// Film at X = 0.
    #[serde(rename = "H_c", skip_serializing_if = "Option::is_none")]
    pub h_c: Option<f64>,
    /// Smallest film in −1.2 < X < 1.5.
    #[serde(rename = "H_min", skip_serializing_if = "Option::is_none")]
    pub h_min: Option<f64>,
    /// Its position.
    #[serde(rename = "X_H_min", skip_serializing_if = "Option::is_none")]
    pub x_h_min: Option<f64>,
    /// Its position across, Y ≤ 0; point contacts only.
    #[serde(rename = "Y_H_min", skip_serializing_if = "Option::is_none")]
    pub y_h_min: Option<f64>,
    /// Pressure at X = 0.
    #[serde(rename = "P_c", skip_serializing_if = "Option::is_none")]
    pub p_c: Option<f64>,
    /// Largest pressure.
    #[serde(rename = "P_max", skip_serializing_if = "Option::is_none")]
    pub p_max: Option<f64>,
    /// Its position.
    #[serde(rename = "X_P_max", skip_serializing_if = "Option::is_none")]
    pub x_p_max: Option<f64>,
    /// Rigid-body displacement by the kernel of (2.27) or (2.25).
    #[serde(rename = "H_0", skip_serializing_if = "Option::is_none")]
    pub h_0: Option<f64>,
    /// Central film \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h_c_m: Option<f64>,
    /// Smallest film \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h_min_m: Option<f64>,
    /// Traction coefficient (3.41).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub traction: Option<f64>,
    /// |∫P/load − 1|.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_residual: Option<f64>,
}

/// What only a reduced solve has.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ReducedReport {
    /// Pressure modes.
    pub basis_p: usize,
    /// Deformation modes.
    pub basis_delta: usize,
    /// Sampled rows.
    pub sampled_rows: usize,
    /// Whether the model was trained for the point.
    pub trained: bool,
    /// e_f^I, (3.15).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_estimate: Option<f64>,
    /// Calibrated bound on the relative error of H_c.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h_c_error_bound: Option<f64>,
    /// Calibrated bound on the relative error of H_min.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h_min_error_bound: Option<f64>,
    /// Calibrated bound on the relative error of the traction coefficient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub traction_error_bound: Option<f64>,
}

impl From<&Answer> for PointReport {
    fn from(answer: &Answer) -> Self {
        let point = &answer.request.point;
        let (moes, hertz) = (point.moes(), point.hertz());
        let [radius, speed, load, modulus, viscosity, alpha] = point.quantities();
        let film_scale = point.film_scale_m();
        let scalars = answer.result().map_or_else(ScalarsReport::default, |solution| {
            let s = &solution.scalars;
            ScalarsReport {
                h_c: finite(s.h_c),
                h_min: finite(s.h_min),
                x_h_min: finite(s.x_h_min),
                y_h_min: finite(s.y_h_min).filter(|_| point.kind == ContactKind::Point),
                p_c: finite(s.p_c),
                p_max: finite(s.p_max),
                x_p_max: finite(s.x_p_max),
                h_0: finite(s.h_0),
                h_c_m: finite(s.h_c * film_scale),
                h_min_m: finite(s.h_min * film_scale),
                traction: answer.traction().and_then(finite),
                load_residual: finite(s.load_residual),
            }
        });
        let kind = if answer.reduced.is_some() { "model" } else { answer.request.grid.kind() };
        Self {
            contact: point.kind.name(),
            method: answer.method.name(),
            converged: answer.converged,
            warning: (!answer.warnings.is_empty()).then(|| answer.warnings.join("; ")),
            si: SiReport { radius, speed, load, modulus, viscosity, alpha },
            moes: MoesReport { m: moes.m, l: moes.l },
            hertz: HertzReport { a_m: hertz.half_width_m, p_h_pa: hertz.pressure_pa },
            grid: GridReport { kind, nx: answer.nodes, ny: answer.nodes_across, dofs: answer.dofs },
            scalars,
            residual_norm: answer.solution.as_ref().and_then(|solution| finite(solution.report.residual_norm)),
            newton_iterations: answer.newton_iterations,
            linear_iterations: answer.linear_iterations,
            wall_s: answer.wall_s,
            reduced: answer.reduced.as_ref().map(|facts| ReducedReport {
                basis_p: facts.basis_p,
                basis_delta: facts.basis_delta,
                sampled_rows: facts.sampled_rows,
                trained: facts.trained,
                residual_estimate: facts.residual_estimate.and_then(finite),
                h_c_error_bound: facts.error.and_then(|e| finite(e.h_c.bound)),
                h_min_error_bound: facts.error.and_then(|e| finite(e.h_min.bound)),
                traction_error_bound: facts.error.and_then(|e| e.traction).and_then(|e| finite(e.bound)),
            }),
            accuracy: None,
        }
    }
}

/// What tables hold of a result, by the names of [`PointReport::values`].
pub const RESULT_COLUMNS: [&str; 21] = [
    "converged",
    "H_c",
    "H_min",
    "X_H_min",
    "Y_H_min",
    "P_c",
    "P_max",
    "X_P_max",
    "H_0",
    "h_c_m",
    "h_min_m",
    "traction",
    "load_residual",
    "residual_norm",
    "newton_iterations",
    "linear_iterations",
    "reduced.residual_estimate",
    "reduced.h_c_error_bound",
    "reduced.h_min_error_bound",
    "reduced.traction_error_bound",
    "wall_s",
];

impl PointReport {
    /// The values of some names; NaN where there is none.
    pub fn row(&self, names: &[&str]) -> Vec<f64> {
        let values = self.values();
        names.iter().map(|name| values.iter().find(|(own, _)| own == name).map_or(f64::NAN, |(_, v)| *v)).collect()
    }

    /// Every number by its dotted name, `moes.M` for instance; truth as 1 and 0. Expectations and tables use these names.
    pub fn values(&self) -> Vec<(String, f64)> {
        let mut out = Vec::new();
        // A structure of numbers, words and options always has a JSON form.
        if let Ok(value) = serde_json::to_value(self) {
            flatten("", &value, &mut out);
        }
        out
    }
}

fn flatten(prefix: &str, value: &Value, out: &mut Vec<(String, f64)>) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                let name = if prefix.is_empty() { name.clone() } else { format!("{prefix}.{name}") };
                flatten(&name, field, out);
            }
        }
        Value::Bool(truth) => out.push((prefix.to_owned(), f64::from(u8::from(*truth)))),
        Value::Number(number) => out.extend(number.as_f64().map(|number| (prefix.to_owned(), number))),
        Value::Null | Value::String(_) | Value::Array(_) => {}
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// The fields of a solution at its nodes: X, Y, P, H and their SI twins.
pub fn profile_table(name: impl Into<String>, solution: &Solution) -> Table {
    let mut table = Table::new(name, &["X", "Y", "P", "H", "x_m", "y_m", "p_pa", "h_m"]);
    let hertz = solution.problem.point.hertz();
    let (a, film_scale) = (hertz.half_width_m, solution.problem.point.film_scale_m());
    table.rows.extend(
        solution.nodes().map(|(x, y, p, h)| vec![x, y, p, h, x * a, y * a, p * hertz.pressure_pa, h * film_scale]),
    );
    table
}

/// Heights Z at which [`film_shear_table`] looks.
const HEIGHTS: usize = 11;

/// Shear across the film in the plane Y = 0: X, Z = z/h, the stress τ_zx and the shear rate ∂u/∂z.
pub fn film_shear_table(name: impl Into<String>, solution: &Solution) -> Table {
    let mut table = Table::new(name, &["X", "Z", "tau_zx_pa", "rate_per_s"]);
    let heights: [f64; HEIGHTS] = std::array::from_fn(|k| k as f64 / (HEIGHTS - 1) as f64);
    let field = solution.shear_field(&heights);
    for (k, height) in heights.into_iter().enumerate() {
        let places = solution.profile().zip(field.chunks_exact(HEIGHTS));
        table.rows.extend(places.map(|((x, ..), at)| vec![x, height, at[k].stress_pa, at[k].rate_per_s]));
    }
    table
}
