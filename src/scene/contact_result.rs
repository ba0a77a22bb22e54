//! The result of one contact as people, tables, expectations and other programs see it.

use super::bench::{Answer, ReducedFacts};
use super::stored_result;
use super::table::Table;
use crate::solver::full::heat::{Rises, Temperatures};
use crate::solver::full::{GridCost, Scalars, Shear, Solution};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Cavitation;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// One contact's result. Written as JSON it is the object of `solve --json`; what does not apply is absent. Formats for
/// programs alone keep every bit of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactResult {
    /// The operating point.
    pub point: OperatingPoint,
    /// `full` or `reduced`.
    pub method: &'static str,
    /// Whether the solve converged; without that there are no scalars.
    pub converged: bool,
    /// What a reader must know, one sentence each.
    pub warnings: Vec<String>,
    /// `uniform`, `graded` or `model`.
    pub grid: &'static str,
    /// Nodes along X and across, both ends counted.
    pub nodes: (usize, usize),
    /// Unknowns iterated on.
    pub dofs: usize,
    /// What the grid of a full solution costs H_c.
    pub grid_cost: Option<GridCost>,
    /// A sentence where that is more than a few percent.
    pub grid_warning: Option<String>,
    /// How the film ruptures.
    pub cavitation: Cavitation,
    /// Where a supplied film fills the gap, X on the axis; none where it is flooded.
    pub meniscus: Option<f64>,
    /// Dimensionless scalars of the solution.
    pub scalars: Option<Scalars>,
    /// Traction coefficient (3.41).
    pub traction: Option<f64>,
    /// ½∫h dp: N/m of a line contact, N of a point contact, where there are fields.
    pub rolling_resistance: Option<f64>,
    /// ‖f‖₂ of the scaled rows, each weighted by the square root of its cell: the L2 norm over the domain.
    pub residual_norm: Option<f64>,
    /// Newton steps.
    pub newton_iterations: usize,
    /// Krylov iterations.
    pub linear_iterations: Option<usize>,
    /// Seconds of the solve alone.
    pub wall_s: f64,
    /// Temperatures, where heat was computed.
    pub heat: Option<HeatFacts>,
    /// What only a reduced solve has.
    pub reduced: Option<ReducedFacts>,
}

/// What a solve with heat adds to its result.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct HeatFacts {
    /// Rises at X = 0.
    pub central: Rises,
    /// The largest rises under pressure.
    pub largest: Rises,
    /// Heat that is made and goes nowhere, over what shear and compression make.
    pub energy_balance: f64,
    /// The share of the heat that the bodies take.
    pub into_bodies: [f64; 2],
}

impl From<&Temperatures> for HeatFacts {
    fn from(heat: &Temperatures) -> Self {
        let Temperatures { central, largest, balance, .. } = *heat;
        let made = balance.sheared + balance.compressed;
        let into_bodies = balance.into_bodies.map(|into| into / made);
        Self { central, largest, energy_balance: balance.residual(), into_bodies }
    }
}

/// One named value of a result.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Yes or no; 1 and 0 in tables.
    Truth(bool),
    /// A whole number.
    Count(usize),
    /// A finite number.
    Number(f64),
    /// Words, which are in no table.
    Text(String),
}

type Get = fn(&ContactResult) -> Option<Value>;

/// Every value by its name, with a dot where it lies in a group, in the order of the JSON object.
const VALUES: [(&str, Get); 61] = [
    ("contact", |r| text(r.point.kind.name())),
    ("method", |r| text(r.method)),
    ("converged", |r| Some(Value::Truth(r.converged))),
    ("warning", |r| (!r.warnings.is_empty()).then(|| Value::Text(r.warnings.join("; ")))),
    ("si.radius", |r| number(r.point.radius_m)),
    ("si.radius_y", |r| number(r.point.radius_y_m.unwrap_or(r.point.radius_m)).filter(|_| is_point(r))),
    ("si.speed", |r| number(r.point.speed_m_per_s)),
    ("si.load", |r| number(r.point.load)),
    ("si.modulus", |r| number(r.point.modulus_pa)),
    ("si.viscosity", |r| number(r.point.viscosity_pa_s)),
    ("si.alpha", |r| number(r.point.alpha_per_pa)),
    ("moes.M", |r| number(r.point.moes().m)),
    ("moes.L", |r| number(r.point.moes().l)),
    ("hertz.a_m", |r| number(r.point.hertz().half_width_m)),
    ("hertz.b_m", |r| number(r.point.hertz().half_length_m).filter(|_| is_point(r))),
    ("hertz.kappa", |r| number(r.point.ellipse().kappa).filter(|_| is_point(r))),
    ("hertz.p_h_pa", |r| number(r.point.hertz().pressure_pa)),
    ("cavitation", |r| text(r.cavitation.name())),
    ("supply_film_m", |r| number(r.cavitation.supply_film_m()?)),
    ("grid.kind", |r| text(r.grid)),
    ("grid.nx", |r| Some(Value::Count(r.nodes.0))),
    ("grid.ny", |r| Some(Value::Count(r.nodes.1))),
    ("grid.dofs", |r| Some(Value::Count(r.dofs))),
    ("grid.truncation_error", |r| number(r.grid_cost?.truncation)),
    ("grid.resolution_error", |r| number(r.grid_cost?.resolution)),
    ("H_c", |r| number(r.scalars?.h_c)),
    ("H_min", |r| number(r.scalars?.h_min)),
    ("X_H_min", |r| number(r.scalars?.x_h_min)),
    ("Y_H_min", |r| number(r.scalars?.y_h_min).filter(|_| is_point(r))),
    ("P_c", |r| number(r.scalars?.p_c)),
    ("P_max", |r| number(r.scalars?.p_max)),
    ("X_P_max", |r| number(r.scalars?.x_p_max)),
    ("X_meniscus", |r| number(r.meniscus?)),
    ("H_0", |r| number(r.scalars?.h_0)),
    ("h_c_m", |r| number(r.scalars?.h_c * r.point.film_scale_m())),
    ("h_min_m", |r| number(r.scalars?.h_min * r.point.film_scale_m())),
    ("traction", |r| number(r.traction?)),
    ("rolling_resistance", |r| number(r.rolling_resistance?)),
    ("rolling_resistance_fit", |r| number(r.rolling_resistance.and(r.point.rolling_resistance_fit())?)),
    ("load_residual", |r| number(r.scalars?.load_residual)),
    ("residual_norm", |r| number(r.residual_norm?)),
    ("newton_iterations", |r| Some(Value::Count(r.newton_iterations))),
    ("linear_iterations", |r| r.linear_iterations.map(Value::Count)),
    ("wall_s", |r| number(r.wall_s)),
    ("heat.mid_film_rise_k", |r| number(r.heat?.central.mid_film_k)),
    ("heat.surface_1_rise_k", |r| number(r.heat?.central.surfaces_k[0])),
    ("heat.surface_2_rise_k", |r| number(r.heat?.central.surfaces_k[1])),
    ("heat.mid_film_rise_max_k", |r| number(r.heat?.largest.mid_film_k)),
    ("heat.surface_1_rise_max_k", |r| number(r.heat?.largest.surfaces_k[0])),
    ("heat.surface_2_rise_max_k", |r| number(r.heat?.largest.surfaces_k[1])),
    ("heat.into_bodies", |r| number(r.heat?.into_bodies.iter().sum())),
    ("heat.energy_balance", |r| number(r.heat?.energy_balance)),
    ("reduced.basis_p", |r| Some(Value::Count(r.reduced.as_ref()?.size.pressure))),
    ("reduced.basis_delta", |r| Some(Value::Count(r.reduced.as_ref()?.size.deformation))),
    ("reduced.sampled_rows", |r| Some(Value::Count(r.reduced.as_ref()?.size.rows))),
    ("reduced.trained", |r| Some(Value::Truth(r.reduced.as_ref()?.trained))),
    ("reduced.residual_estimate", |r| number(r.reduced.as_ref()?.residual_estimate?)),
    ("reduced.h_c_error_bound", |r| number(r.reduced.as_ref()?.error?.h_c.bound)),
    ("reduced.h_min_error_bound", |r| number(r.reduced.as_ref()?.error?.h_min.bound)),
    ("reduced.traction_error_bound", |r| number(r.reduced.as_ref()?.error?.traction?.bound)),
    ("reduced.mid_film_rise_error_bound", |r| number(r.reduced.as_ref()?.error?.rise?.bound)),
];

fn is_point(result: &ContactResult) -> bool {
    result.point.kind == ContactKind::Point
}

fn number(value: f64) -> Option<Value> {
    value.is_finite().then_some(Value::Number(value))
}

fn text(word: &str) -> Option<Value> {
    Some(Value::Text(word.to_owned()))
}

/// What tables hold of a contact, before its result.
pub const CONTACT_COLUMNS: [&str; 10] = [
    "si.radius",
    "si.speed",
    "si.load",
    "si.modulus",
    "si.viscosity",
    "si.alpha",
    "moes.M",
    "moes.L",
    "hertz.a_m",
    "hertz.p_h_pa",
];

/// What tables hold of a result.
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

/// What tables hold of a result with heat, after that.
const HEAT_COLUMNS: [&str; 7] = [
    "heat.mid_film_rise_k",
    "heat.surface_1_rise_k",
    "heat.surface_2_rise_k",
    "heat.mid_film_rise_max_k",
    "heat.surface_1_rise_max_k",
    "heat.surface_2_rise_max_k",
    "heat.energy_balance",
];

/// What tables hold of results with heat or without.
pub fn result_columns(heat: bool) -> Vec<&'static str> {
    [&RESULT_COLUMNS[..], if heat { &HEAT_COLUMNS } else { &[] }].concat()
}

impl From<&Answer> for ContactResult {
    fn from(answer: &Answer) -> Self {
        Self {
            point: answer.request.point,
            method: answer.method.name(),
            converged: answer.converged,
            warnings: answer.warnings.clone(),
            grid: if answer.reduced.is_some() { "model" } else { answer.request.grid.kind() },
            nodes: (answer.nodes, answer.nodes_across),
            dofs: answer.dofs,
            grid_cost: answer.result().and_then(|solution| solution.grid_cost),
            grid_warning: answer.result().and_then(Solution::grid_warning),
            scalars: answer.result().map(|solution| solution.scalars),
            cavitation: answer.cavitation(),
            meniscus: answer.result().and_then(Solution::meniscus),
            traction: answer.traction(),
            rolling_resistance: answer.result().map(Solution::rolling_resistance),
            residual_norm: answer.solution.as_ref().map(|solution| solution.report.residual_norm),
            newton_iterations: answer.newton_iterations,
            linear_iterations: answer.linear_iterations,
            wall_s: answer.wall_s,
            heat: answer.result().and_then(|solution| solution.heat.as_deref()).map(HeatFacts::from),
            reduced: answer.reduced.clone(),
        }
    }
}

impl Value {
    fn as_number(&self) -> Option<f64> {
        match *self {
            Self::Truth(truth) => Some(f64::from(u8::from(truth))),
            Self::Count(count) => Some(count as f64),
            Self::Number(number) => Some(number),
            Self::Text(_) => None,
        }
    }
}

impl ContactResult {
    /// The number of a name; none where the result has no such number.
    pub fn value(&self, name: &str) -> Option<f64> {
        VALUES.iter().find(|(own, _)| *own == name).and_then(|(_, get)| get(self)?.as_number())
    }

    /// The numbers of some names; NaN where there is none.
    pub fn row<'a>(&'a self, names: &'a [&str]) -> impl Iterator<Item = f64> + 'a {
        names.iter().map(|name| self.value(name).unwrap_or(f64::NAN))
    }

    /// Every number by its name, in alphabetical order; truth as 1 and 0.
    pub fn values(&self) -> Vec<(&'static str, f64)> {
        let number = |(name, get): &(&'static str, Get)| Some((*name, get(self)?.as_number()?));
        let mut values: Vec<_> = VALUES.iter().filter_map(number).collect();
        values.sort_by_key(|(name, _)| *name);
        values
    }

    /// Whether a reduced model was asked about a contact it was not trained for.
    pub fn untrained(&self) -> bool {
        self.reduced.as_ref().is_some_and(|facts| !facts.trained)
    }
}

/// Values of one group, without its name.
struct Group<'a>(&'a [(&'static str, Value)]);

impl Serialize for Group<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name.split_once('.').map_or(*name, |n| n.1), value)))
    }
}

impl Serialize for ContactResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !serializer.is_human_readable() {
            return stored_result::Fields::serialize(self, serializer);
        }
        let group = |name: &'static str| name.split_once('.').map(|(group, _)| group);
        let values: Vec<(&str, Value)> = VALUES.iter().filter_map(|(name, get)| Some((*name, get(self)?))).collect();
        let mut map = serializer.serialize_map(None)?;
        for values in values.chunk_by(|a, b| group(a.0).is_some() && group(a.0) == group(b.0)) {
            match (values, values.first().and_then(|value| group(value.0))) {
                ([(name, value)], None) => map.serialize_entry(name, value)?,
                (_, group) => map.serialize_entry(&group, &Group(values))?,
            }
        }
        map.end()
    }
}

/// The fields of a solution at its nodes: X, Y, P, H and their SI twins, λ or θ where it has one, and the rises of
/// temperature at mid-film and of both surfaces where heat was computed.
pub fn profile_table(name: impl Into<String>, solution: &Solution) -> Table {
    let mut columns = vec!["X", "Y", "P", "H", "x_m", "y_m", "p_pa", "h_m"];
    if !solution.multiplier.is_empty() {
        columns.push("lambda");
    }
    if !solution.fraction.is_empty() {
        columns.push("theta");
    }
    let heat = solution.heat.as_deref();
    if heat.is_some() {
        columns.extend(["mid_film_rise_k", "surface_1_rise_k", "surface_2_rise_k"]);
    }
    let mut table = Table::new(name, &columns);
    let hertz = solution.problem.point.hertz();
    let (a, b, film_scale) = (hertz.half_width_m, hertz.half_length_m, solution.problem.point.film_scale_m());
    let row = |(x, y, p, h)| vec![x, y, p, h, x * a, y * b, p * hertz.pressure_pa, h * film_scale];
    table.rows.extend(solution.nodes().map(row));
    for (row, value) in table.rows.iter_mut().zip(solution.multipliers().chain(solution.fractions())) {
        row.push(value);
    }
    for (row, at) in table.rows.iter_mut().zip(heat.iter().flat_map(|heat| heat.rises())) {
        row.push(at.mid_film_k);
        row.extend(at.surfaces_k);
    }
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
        let row = |(x, shear): (f64, &Shear)| vec![x, height, shear.stress_pa, shear.rate_per_s];
        table.rows.extend(places.filter_map(|((x, ..), at)| Some((x, at.get(k)?))).map(row));
    }
    table
}
