//! Sweep: the contact along one to three varied quantities.

use super::path::{self, Path, PathRow};
use super::question::{
    Chart, ChartAxis, Checked, Divisible, Experiment, Findings, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::axis::{Axis, Steps};
use crate::scene::check::{self, MAX_POINTS, count, number, refuse};
use crate::scene::contact_row::RefusedContact;
use crate::scene::contact_spec::{ContactSpec, Field, Words};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// The contact along one to three varied quantities; the last one varies fastest. Each solve starts from its neighbour,
/// and the first one of each line starts cold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// Varied quantities.
    pub over: Vec<Axis>,
    /// Methods by which each point is solved.
    pub methods: Vec<Method>,
    /// True to start all full solves cold.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cold: bool,
    /// True to compare reduced methods with full solutions on the model's own grid. The error then excludes differences
    /// between the grids.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub compare_on_model_grid: bool,
}

impl Sweep {
    fn varied(&self) -> Vec<String> {
        self.over.iter().map(|axis| names::of_quantity(axis.vary)).collect()
    }

    /// Returns the number of consecutive contacts that depend on each other because each starts from the one before it.
    /// 1 if all methods are full and start cold.
    fn line(&self) -> usize {
        let alone = self.cold && self.methods.iter().all(|method| *method == Method::Full);
        if alone { 1 } else { self.over.last().map_or(1, |axis| axis.values.len()) }
    }

    fn solve(
        &self,
        contacts: Vec<Stated>,
        setting: &mut Setting<'_>,
        tell: &Tell<'_, PathRow>,
    ) -> Result<(), RunError> {
        let Self { methods, cold, compare_on_model_grid, .. } = self;
        let (line, cold, on_model_grid) = (self.line(), *cold, *compare_on_model_grid);
        Path { name: "sweep", contacts, line, methods, cold, on_model_grid }.solve(setting, tell)
    }
}

impl Question for Sweep {
    type Row = PathRow;

    fn check(&self, experiment: &Experiment) -> Checked {
        check::methods("study.methods", &self.methods)?;
        if self.compare_on_model_grid && self.methods.iter().all(|method| method.model().is_none()) {
            return Err(refuse(
                "study.compare_on_model_grid",
                "needs a reduced method to compare; add Reduced(…) to the methods, or leave it out",
            ));
        }
        check_axes(&self.over, experiment)
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, PathRow>) -> Result<(), RunError> {
        let contacts = contacts_of(setting.experiment, &self.over)?;
        self.solve(contacts, setting, tell)
    }

    fn findings(&self, experiment: &Experiment, rows: &[&PathRow], found: &mut Findings) {
        path::findings(&self.methods, experiment, rows, found);
    }

    fn tables(&self, rows: &[&PathRow]) -> Vec<Table> {
        vec![path::table("sweep", &self.varied(), &self.methods, rows)]
    }

    fn charts(&self, rows: &[&PathRow]) -> Vec<Chart> {
        let Some(last) = self.over.last() else { return Vec::new() };
        let x = ChartAxis::new(last.vary.label(), matches!(last.values, Steps::Log { .. }));
        path::charts(&x, &self.varied(), &self.methods, rows)
    }
}

/// Each piece is a line of neighbours: all values of the last quantity at one combination of the others. If all methods
/// are full and start cold, each piece is one contact.
impl Divisible for Sweep {
    fn pieces(&self, _: &mut Setting<'_>, round: usize, _: &[&PathRow]) -> Result<Vec<usize>, RunError> {
        let contacts: usize = self.over.iter().map(|axis| axis.values.len()).product();
        Ok(if round == 0 { (0..contacts / self.line()).collect() } else { Vec::new() })
    }

    fn work(
        &self,
        setting: &mut Setting<'_>,
        _: usize,
        pieces: &[usize],
        tell: &Tell<'_, PathRow>,
    ) -> Result<(), RunError> {
        let contacts = contacts_of(setting.experiment, &self.over)?;
        let lines: Vec<&[_]> = contacts.chunks(self.line()).collect();
        let chosen = pieces.iter().filter_map(|piece| lines.get(*piece)).flat_map(|line| line.to_vec()).collect();
        self.solve(chosen, setting, tell)
    }

    fn seconds(row: &mut PathRow) -> Vec<&mut f64> {
        row.seconds()
    }

    fn methods_mut(&mut self) -> &mut [Method] {
        &mut self.methods
    }
}

/// Returns the contacts of a sweep over one quantity as requests for its first method. Refused contacts are left out.
///
/// # Errors
/// If a quantity cannot be varied.
pub fn requests(sweep: &Sweep, experiment: &Experiment) -> Result<Vec<(f64, Request)>, RunError> {
    let contacts = contacts_of(experiment, &sweep.over)?.into_iter();
    let request = |point| match sweep.methods.first() {
        Some(method) => Request { method: method.clone(), ..experiment.request_at(point) },
        None => experiment.request_at(point),
    };
    Ok(contacts.filter_map(|(values, point)| Some((*values.first()?, request(point.ok()?)))).collect())
}

/// Values of the axes, and their contact or the reason why it is refused.
pub(super) type Stated = (Vec<f64>, Result<OperatingPoint, RefusedContact>);

/// Returns all combinations of the values of the axes with their contacts; the last axis varies fastest.
pub(super) fn contacts_of(experiment: &Experiment, over: &[Axis]) -> Result<Vec<Stated>, RunError> {
    let mut contacts = Vec::new();
    for values in Steps::combinations(over.iter().map(|axis| &axis.values)) {
        let mut stated = ContactSpec::from(experiment);
        for (axis, &value) in over.iter().zip(&values) {
            match axis.vary {
                quantity @ (Quantity::M | Quantity::L) if stated.moes_m.is_none() => {
                    let name = quantity.name();
                    return Err(RunError::Study(format!(
                        "{name} can only be varied if `at` is Moes(…), which names the quantities that follow"
                    )));
                }
                Quantity::M => stated.moes_m = Some(value),
                Quantity::L => stated.moes_l = Some(value),
                quantity => Field::named(quantity.name()).into_iter().for_each(|field| stated.set(field, value)),
            }
        }
        if experiment.lubricant.own_coefficient().is_some() {
            stated.alpha = None;
        }
        let point = stated.operating_point(&experiment.lubricant);
        let mut point = point.map_err(|refusal| RefusedContact::of(&refusal.in_words(Words::Scene)));
        // The radius ratio is applied last, because the radius may follow from M and L.
        for (axis, &value) in over.iter().zip(&values).filter(|(axis, _)| axis.vary.is_relative_to_radius()) {
            point = point.and_then(|point| {
                let point = axis.vary.at(&point, value);
                point.check().map(|()| point).map_err(|why| RefusedContact::of(&why))
            });
        }
        contacts.push((values, point));
    }
    Ok(contacts)
}

/// Checks the varied quantities of a study.
pub(super) fn check_axes(over: &[Axis], experiment: &Experiment) -> Checked {
    count("study.over (how many)", over.len(), 1, 3)?;
    over.iter().try_for_each(check_axis)?;
    if over.iter().any(|axis| axis.vary == Quantity::Alpha) && experiment.lubricant.own_coefficient().is_some() {
        return Err(refuse("study.over.alpha", "cannot be varied: the lubricant's viscosity law determines it"));
    }
    let points = over.iter().map(|axis| axis.values.len()).try_fold(1usize, usize::checked_mul);
    count("study.over (points)", points.unwrap_or(usize::MAX), 1, MAX_POINTS)
}

fn check_axis(axis: &Axis) -> Checked {
    let field = format!("study.over.{}", axis.vary.name());
    if !Quantity::VARIED.contains(&axis.vary) {
        let accepted: Vec<String> = Quantity::VARIED.iter().map(|quantity| format!("{quantity:?}")).collect();
        return Err(refuse(&field, format!("cannot be varied; accepted are {}", accepted.join(", "))));
    }
    let (least, most) = axis.vary.range();
    let limit = |value: f64| number(&field, value, least, most);
    count(&format!("{field} (values)"), axis.values.len(), 1, MAX_POINTS)?;
    match &axis.values {
        Steps::Linear { from, to, .. } => {
            limit(*from)?;
            limit(*to)
        }
        Steps::Log { from, to, .. } => {
            number(&field, *from, least.max(f64::MIN_POSITIVE), most)?;
            number(&field, *to, least.max(f64::MIN_POSITIVE), most)
        }
        Steps::Graded { from, half, to, .. } => {
            limit(*from)?;
            limit(*to)?;
            Steps::check_grading(*from, *half, *to).map_err(|why| refuse(&field, why.to_string()))
        }
        Steps::List(values) => values.iter().try_for_each(|&value| limit(value)),
    }
}
