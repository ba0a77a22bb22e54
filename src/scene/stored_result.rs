//! A contact's result field by field, to the last bit: for formats that only programs read.

use super::bench::ReducedFacts;
use super::contact_result::{ContactResult, HeatFacts};
use crate::solver::full::{GridCost, Scalars};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Cavitation;
use serde::{Deserialize, Deserializer, Serialize, de};

/// A word of the program's own; by another name, since serde would borrow a `&str`.
type Word = &'static str;

/// Words that stand in results.
const WORDS: [Word; 5] = ["full", "reduced", "uniform", "graded", "model"];

/// Everything in a result, as it lies in memory.
#[derive(Serialize, Deserialize)]
#[serde(remote = "ContactResult")]
pub(super) struct Fields {
    point: OperatingPoint,
    #[serde(deserialize_with = "word")]
    method: Word,
    converged: bool,
    warnings: Vec<String>,
    #[serde(deserialize_with = "word")]
    grid: Word,
    nodes: (usize, usize),
    dofs: usize,
    grid_cost: Option<GridCost>,
    grid_warning: Option<String>,
    cavitation: Cavitation,
    meniscus: Option<f64>,
    scalars: Option<Scalars>,
    traction: Option<f64>,
    rolling_resistance: Option<f64>,
    residual_norm: Option<f64>,
    newton_iterations: usize,
    linear_iterations: Option<usize>,
    wall_s: f64,
    heat: Option<HeatFacts>,
    reduced: Option<ReducedFacts>,
}

impl<'de> Deserialize<'de> for ContactResult {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Fields::deserialize(deserializer)
    }
}

fn word<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Word, D::Error> {
    let read = String::deserialize(deserializer)?;
    let known = WORDS.into_iter().find(|word| *word == read);
    known.ok_or_else(|| de::Error::custom(format!("`{read}` is no word of a result")))
}
