//! The result of one contact as people, tables, expectations and other programs see it.

use super::answer::Request;
use super::names;
use crate::solver::full::heat::{Rises, Temperatures};
use crate::solver::full::{GridCost, Scalars, Solution};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{ErrorEstimate, ModelSize};
use crate::solver::warning::Warning;
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Deserializer, Serialize, de};

/// A word of the program's own; by another name, since serde would borrow a `&str`.
type Word = &'static str;

/// Words that stand in results.
const WORDS: [Word; 5] = ["full", "reduced", "uniform", "graded", "model"];

/// One contact's result; what does not apply is absent. [`ContactResult::json`] is the object of `solve --json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactResult {
    /// The operating point.
    pub point: OperatingPoint,
    /// `full` or `reduced`.
    #[serde(deserialize_with = "word")]
    pub method: Word,
    /// Whether the solve converged; without that there are no scalars.
    pub converged: bool,
    /// What a reader must know.
    pub warnings: Vec<Warning>,
    /// `uniform`, `graded` or `model`.
    #[serde(deserialize_with = "word")]
    pub grid: Word,
    /// Nodes along X and across, both ends counted.
    pub nodes: (usize, usize),
    /// Unknowns iterated on.
    pub dofs: usize,
    /// Discretisation error of H_c of a full solution.
    pub grid_cost: Option<GridCost>,
    /// The law of cavitation; of a reduced model the one that it was trained with.
    pub cavitation: Cavitation,
    /// Where a supplied film fills the gap, X on the axis; none where it is flooded.
    pub meniscus: Option<f64>,
    /// Dimensionless scalars of the solution.
    pub scalars: Option<Scalars>,
    /// Traction coefficient (3.41) over the whole domain; of a reduced model by its own quadrature, to which its bound
    /// belongs.
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

/// What a solve took.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Nodes of the grid along X and across, both ends counted.
    pub nodes: (usize, usize),
    /// Unknowns that were iterated on.
    pub dofs: usize,
    /// Newton steps.
    pub newton_iterations: usize,
    /// Krylov iterations of a full solve.
    pub linear_iterations: Option<usize>,
    /// Seconds of the solve alone.
    pub wall_s: f64,
}

/// What a reduced solve adds to its result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedFacts {
    /// Modes that were used, and sampled rows.
    pub size: ModelSize,
    /// The local model that answers, from 0.
    pub window: usize,
    /// Whether the model was trained for the contact; a warning says why not.
    pub trained: bool,
    /// e_f^I, (3.15); `None` without convergence.
    pub residual_estimate: Option<f64>,
    /// Calibrated errors, where the model has them.
    pub error: Option<ErrorEstimate>,
}

/// What a solve with heat adds to its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    /// Objects, which are in no table.
    List(Vec<serde_json::Value>),
}

type Get = fn(&ContactResult) -> Option<Value>;

/// Which columns of tables a value is in.
#[derive(Clone, Copy, PartialEq)]
enum In {
    None,
    /// Those of the contact.
    Contact,
    /// Those of its result.
    Result,
    /// Those of a thermal result.
    Heat,
}

/// Every value by its name, with a dot if it belongs to a group, in the order of the JSON object and of tables.
const VALUES: [(&str, In, Get); names::ALL.len()] = [
    (names::CONTACT, In::None, |r| text(r.point.kind.name())),
    (names::METHOD, In::None, |r| text(r.method)),
    (names::CONVERGED, In::Result, |r| Some(Value::Truth(r.converged))),
    (names::WARNING, In::None, |r| (!r.warnings.is_empty()).then(|| Value::Text(r.warning()))),
    (names::WARNINGS, In::None, |r| {
        (!r.warnings.is_empty()).then(|| Value::List(r.warnings.iter().map(Warning::to_json).collect()))
    }),
    (names::RADIUS, In::Contact, |r| number(r.point.radius_m)),
    (names::RADIUS_Y, In::Contact, |r| number(r.point.radius_y_m.unwrap_or(r.point.radius_m)).filter(|_| is_point(r))),
    (names::SPEED, In::Contact, |r| number(r.point.speed_m_per_s)),
    (names::U1, In::None, |r| number(r.point.surface_speeds()[0])),
    (names::U2, In::None, |r| number(r.point.surface_speeds()[1])),
    (names::LOAD, In::Contact, |r| number(r.point.load)),
    (names::MODULUS, In::Contact, |r| number(r.point.modulus_pa)),
    (names::VISCOSITY, In::Contact, |r| number(r.point.viscosity_pa_s)),
    (names::ALPHA, In::Contact, |r| number(r.point.alpha_per_pa)),
    (names::SRR, In::Contact, |r| number(r.point.sliding.slide_to_roll_ratio)),
    (names::NPR, In::Contact, |r| number(r.point.sliding.newtonian_plateau_ratio?)),
    (names::M, In::Contact, |r| number(r.point.moes().m)),
    (names::L, In::Contact, |r| number(r.point.moes().l)),
    (names::HALF_WIDTH, In::Contact, |r| number(r.point.hertz().half_width_m)),
    (names::HALF_LENGTH, In::None, |r| number(r.point.hertz().half_length_m).filter(|_| is_point(r))),
    (names::KAPPA, In::None, |r| number(r.point.ellipse().kappa).filter(|_| is_point(r))),
    (names::HERTZ_PRESSURE, In::Contact, |r| number(r.point.hertz().pressure_pa)),
    (names::CAVITATION, In::None, |r| text(r.cavitation.name())),
    (names::SUPPLY_FILM, In::None, |r| number(r.cavitation.supply_film_m()?)),
    (names::GRID_KIND, In::None, |r| text(r.grid)),
    (names::GRID_NX, In::None, |r| Some(Value::Count(r.nodes.0))),
    (names::GRID_NY, In::None, |r| Some(Value::Count(r.nodes.1))),
    (names::GRID_DOFS, In::None, |r| Some(Value::Count(r.dofs))),
    (names::TRUNCATION_ERROR, In::None, |r| number(r.grid_cost?.truncation)),
    (names::RESOLUTION_ERROR, In::None, |r| number(r.grid_cost?.resolution)),
    (names::H_C, In::Result, |r| number(r.scalars?.h_c)),
    (names::H_MIN, In::Result, |r| number(r.scalars?.h_min)),
    (names::X_H_MIN, In::Result, |r| number(r.scalars?.x_h_min)),
    (names::Y_H_MIN, In::Result, |r| number(r.scalars?.y_h_min).filter(|_| is_point(r))),
    (names::P_C, In::Result, |r| number(r.scalars?.p_c)),
    (names::P_MAX, In::Result, |r| number(r.scalars?.p_max)),
    (names::X_P_MAX, In::Result, |r| number(r.scalars?.x_p_max)),
    (names::X_MENISCUS, In::None, |r| number(r.meniscus?)),
    (names::H_0, In::Result, |r| number(r.scalars?.h_0)),
    (names::H_C_M, In::Result, |r| number(r.scalars?.h_c * r.point.film_scale_m())),
    (names::H_MIN_M, In::Result, |r| number(r.scalars?.h_min * r.point.film_scale_m())),
    (names::TRACTION, In::Result, |r| number(r.traction?)),
    (names::ROLLING_RESISTANCE, In::None, |r| number(r.rolling_resistance?)),
    (names::ROLLING_RESISTANCE_FIT, In::None, |r| number(r.rolling_resistance.and(r.point.rolling_resistance_fit())?)),
    (names::LOAD_RESIDUAL, In::Result, |r| number(r.scalars?.load_residual)),
    (names::RESIDUAL_NORM, In::Result, |r| number(r.residual_norm?)),
    (names::NEWTON_ITERATIONS, In::Result, |r| Some(Value::Count(r.newton_iterations))),
    (names::LINEAR_ITERATIONS, In::Result, |r| r.linear_iterations.map(Value::Count)),
    (names::MID_FILM_RISE, In::Heat, |r| number(r.heat?.central.mid_film_k)),
    (names::SURFACE_1_RISE, In::Heat, |r| number(r.heat?.central.surfaces_k[0])),
    (names::SURFACE_2_RISE, In::Heat, |r| number(r.heat?.central.surfaces_k[1])),
    (names::MID_FILM_RISE_MAX, In::Heat, |r| number(r.heat?.largest.mid_film_k)),
    (names::SURFACE_1_RISE_MAX, In::Heat, |r| number(r.heat?.largest.surfaces_k[0])),
    (names::SURFACE_2_RISE_MAX, In::Heat, |r| number(r.heat?.largest.surfaces_k[1])),
    (names::HEAT_INTO_BODIES, In::None, |r| number(r.heat?.into_bodies.iter().sum())),
    (names::ENERGY_BALANCE, In::Heat, |r| number(r.heat?.energy_balance)),
    (names::BASIS_P, In::None, |r| Some(Value::Count(r.reduced.as_ref()?.size.pressure))),
    (names::BASIS_DELTA, In::None, |r| Some(Value::Count(r.reduced.as_ref()?.size.deformation))),
    (names::SAMPLED_ROWS, In::None, |r| Some(Value::Count(r.reduced.as_ref()?.size.rows))),
    (names::TRAINED, In::Result, |r| Some(Value::Truth(r.reduced.as_ref()?.trained))),
    (names::RESIDUAL_ESTIMATE, In::Result, |r| number(r.reduced.as_ref()?.residual_estimate?)),
    (names::H_C_BOUND, In::Result, |r| number(r.reduced.as_ref()?.error?.h_c.bound)),
    (names::H_MIN_BOUND, In::Result, |r| number(r.reduced.as_ref()?.error?.h_min.bound)),
    (names::TRACTION_BOUND, In::Result, |r| number(r.reduced.as_ref()?.error?.traction?.bound)),
    (names::RISE_BOUND, In::Heat, |r| number(r.reduced.as_ref()?.error?.rise?.bound)),
    (names::WALL_S, In::Result, |r| number(r.wall_s)),
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

/// Columns of a contact in tables.
pub fn contact_columns() -> Vec<&'static str> {
    columns(&[In::Contact])
}

/// Columns of a contact in a table that begins with its varied values.
pub(super) fn contact_columns_after(varied: &[String]) -> Vec<&'static str> {
    contact_columns().into_iter().filter(|column| !varied.iter().any(|name| name == column)).collect()
}

/// Columns of its result, thermal or not.
pub fn result_columns(heat: bool) -> Vec<&'static str> {
    columns(if heat { &[In::Result, In::Heat] } else { &[In::Result] })
}

fn columns(of: &[In]) -> Vec<&'static str> {
    VALUES.iter().filter(|(_, own, _)| of.contains(own)).map(|(name, ..)| *name).collect()
}

fn word<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Word, D::Error> {
    let read = String::deserialize(deserializer)?;
    let known = WORDS.into_iter().find(|word| *word == read);
    known.ok_or_else(|| de::Error::custom(format!("`{read}` is no word of a result")))
}

impl Value {
    fn as_number(&self) -> Option<f64> {
        match *self {
            Self::Truth(truth) => Some(f64::from(u8::from(truth))),
            Self::Count(count) => Some(count as f64),
            Self::Number(number) => Some(number),
            Self::Text(_) | Self::List(_) => None,
        }
    }
}

impl ContactResult {
    /// The result of a request whose solve ended with a solution, converged or not, or with none; without warnings.
    /// A reduced model may bring its own traction coefficient and law of cavitation.
    pub fn new(
        request: &Request,
        solution: Option<&Solution>,
        reduced: Option<(ReducedFacts, Cavitation, Option<f64>)>,
        effort: Effort,
    ) -> Self {
        let Request { point, lubricant, grid, method, .. } = request;
        let Effort { nodes, dofs, newton_iterations, linear_iterations, wall_s } = effort;
        let converged = solution.filter(|solution| solution.converged());
        let slides = point.sliding.slide_to_roll_ratio != 0.0;
        let by_model = reduced.as_ref().and_then(|(.., traction)| *traction).filter(|_| slides);
        Self {
            point: *point,
            method: method.name(),
            converged: converged.is_some(),
            warnings: Vec::new(),
            grid: if reduced.is_some() { "model" } else { grid.kind() },
            nodes,
            dofs,
            grid_cost: converged.and_then(|solution| solution.grid_cost),
            cavitation: reduced.as_ref().map_or(lubricant.cavitation, |(_, own, _)| *own),
            meniscus: converged.and_then(Solution::meniscus),
            scalars: converged.map(|solution| solution.scalars),
            traction: converged.map(|solution| by_model.unwrap_or_else(|| solution.traction_coefficient())),
            rolling_resistance: converged.map(Solution::rolling_resistance),
            residual_norm: solution.map(|solution| solution.report.residual_norm),
            newton_iterations,
            linear_iterations,
            wall_s,
            heat: converged.and_then(|solution| solution.heat.as_deref()).map(HeatFacts::from),
            reduced: reduced.map(|(facts, ..)| facts),
        }
    }

    /// The number of a name; none where the result has no such number.
    pub fn value(&self, name: &str) -> Option<f64> {
        VALUES.iter().find(|(own, ..)| *own == name).and_then(|(.., get)| get(self)?.as_number())
    }

    /// The numbers of some names; NaN where there is none.
    pub fn row<'a>(&'a self, names: &'a [&str]) -> impl Iterator<Item = f64> + 'a {
        names.iter().map(|name| self.value(name).unwrap_or(f64::NAN))
    }

    /// Every number by its name, in alphabetical order; truth as 1 and 0.
    pub fn values(&self) -> Vec<(&'static str, f64)> {
        let number = |(name, _, get): &(&'static str, In, Get)| Some((*name, get(self)?.as_number()?));
        let mut values: Vec<_> = VALUES.iter().filter_map(number).collect();
        values.sort_by_key(|(name, _)| *name);
        values
    }

    /// Whether a reduced model was asked about a contact it was not trained for.
    pub fn untrained(&self) -> bool {
        self.reduced.as_ref().is_some_and(|facts| !facts.trained)
    }

    /// Its warnings as one sentence; empty without any.
    pub fn warning(&self) -> String {
        Warning::joined(&self.warnings)
    }

    /// The warnings of one contact's results by several methods as one sentence, each once.
    pub fn warning_of_all(results: &[Self]) -> String {
        let mut warnings: Vec<&Warning> = results.iter().flat_map(|result| &result.warnings).collect();
        warnings.dedup();
        Warning::joined(warnings)
    }

    /// The object of `solve --json`.
    pub fn json(&self) -> ResultJson<'_> {
        ResultJson(self)
    }
}

/// A result as the object of `solve --json`: what does not apply is absent.
#[derive(Clone, Copy)]
pub struct ResultJson<'a>(&'a ContactResult);

/// Values of one group, without its name.
struct Group<'a>(&'a [(&'static str, Value)]);

impl Serialize for Group<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name.split_once('.').map_or(*name, |n| n.1), value)))
    }
}

impl Serialize for ResultJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let group = |name: &'static str| name.split_once('.').map(|(group, _)| group);
        let values: Vec<(&str, Value)> =
            VALUES.iter().filter_map(|(name, _, get)| Some((*name, get(self.0)?))).collect();
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
