//! The door: every number of a scene is finite and sane before anything is computed from it.

use super::{Expectation, Grid, Scene, SceneError, View, Within, study_check};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{LubricantError, ScaledShear};

/// Most points of a sweep, a trajectory or a formula comparison.
pub const MAX_POINTS: usize = 100_000;
/// Most random tests.
pub const MAX_TESTS: usize = 1_000_000;

/// Most full solutions that a study keeps to compare with.
pub const MAX_COMPARED: usize = 20_000;

pub(super) type Checked = Result<(), SceneError>;

pub(super) fn refuse(field: impl Into<String>, problem: impl Into<String>) -> SceneError {
    SceneError::Field { field: field.into(), problem: problem.into() }
}

pub(super) fn number(field: &str, value: f64, low: f64, high: f64) -> Checked {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(refuse(field, format!("is {value}, but must be a finite number between {low:e} and {high:e}")))
}

pub(super) fn count(field: &str, value: usize, low: usize, high: usize) -> Checked {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(refuse(field, format!("is {value}, but must lie between {low} and {high}")))
}

pub(super) fn interval(field: &str, (from, to): (f64, f64), low: f64, high: f64) -> Checked {
    number(&format!("{field}.0"), from, low, high)?;
    number(&format!("{field}.1"), to, low, high)?;
    if from > to {
        return Err(refuse(field, format!("runs from {from} down to {to}; write the smaller value first")));
    }
    Ok(())
}

impl Scene {
    /// Refuses values that are not finite or make no sense, naming the field.
    ///
    /// # Errors
    /// With the first such field.
    pub fn check(&self) -> Result<(), SceneError> {
        let lubricant = |problem: LubricantError| refuse("lubricant", format!("is refused: {problem}"));
        self.lubricant.check().map_err(lubricant)?;
        let point = self.point()?;
        self.lubricant.scaled(&point).map_err(lubricant)?;
        ScaledShear::new(self.lubricant.shear, self.sliding(), &point)
            .map_err(|problem| refuse("srr, npr", format!("are refused: {problem}")))?;
        grid(&self.grid, self.contact)?;
        study_check::study(self)?;
        self.view.iter().try_for_each(view)?;
        self.expect.iter().enumerate().try_for_each(|(i, entry)| expectation(i, entry))
    }
}

fn grid(grid: &Grid, contact: ContactKind) -> Checked {
    match (contact, grid) {
        (ContactKind::Line, Grid::Plane { .. }) => {
            return Err(refuse("grid", "is Plane, but a line contact has no Y; write Uniform, Graded or GradedNodes"));
        }
        (ContactKind::Point, Grid::Uniform { .. } | Grid::GradedNodes { .. }) => {
            return Err(refuse(
                "grid",
                "must be Plane(dx: …, dy: …, domain: (…, …, …)) or Model for a point contact, or left out",
            ));
        }
        _ => {}
    }
    let domain = |(from, to): (f64, f64)| {
        number("grid.domain.0", from, -200.0, -1.5)?;
        number("grid.domain.1", to, 1.2, 20.0)
    };
    match *grid {
        Grid::Uniform { dx, domain: ends } => {
            number("grid.dx", dx, 1e-4, 0.2)?;
            domain(ends)
        }
        Grid::GradedNodes { nodes, domain: ends, .. } => {
            count("grid.nodes", nodes, 61, crate::solver::discrete::grid::MAX_GRADED_NODES)?;
            domain(ends)
        }
        Grid::Plane { dx, dy, domain, refinement } => PointGridSpec { dx, dy, refinement, domain }
            .check()
            .map(|_| ())
            .map_err(|problem| refuse("grid", format!("makes no sense: {problem}"))),
        Grid::Graded | Grid::Model => Ok(()),
    }
}

fn view(view: &View) -> Checked {
    for (field, loss) in [("pressure_loss", view.pressure_loss), ("deformation_loss", view.deformation_loss)] {
        loss.iter().try_for_each(|&loss| number(&format!("view.{field}"), loss, 1e-16, 0.99))?;
    }
    if !view.when_m_moves.partners().contains(&view.when_l_moves) {
        let partners = view.when_m_moves.partners().iter().map(|p| format!("{p:?}")).collect::<Vec<_>>().join(", ");
        let problem =
            format!("cannot be {:?} when M moves {:?}; write {partners}", view.when_l_moves, view.when_m_moves);
        return Err(refuse("view.when_l_moves", problem));
    }
    Ok(())
}

fn expectation(index: usize, entry: &Expectation) -> Checked {
    let field = format!("expect.{index} ({})", entry.name);
    let limits: &[f64] = match &entry.within {
        Within::Relative(v) | Within::Absolute(v) => {
            if entry.value.is_none() {
                return Err(refuse(field, "needs a `value` to be compared with"));
            }
            number(&format!("{field}.within"), *v, 0.0, f64::MAX)?;
            &[]
        }
        Within::AtMost(v) | Within::AtLeast(v) => &[*v],
        Within::Between(low, high) => &[*low, *high],
    };
    let all = limits.iter().copied().chain(entry.value);
    all.into_iter().try_for_each(|value| number(&field, value, -f64::MAX, f64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{At, Axis, Contacts, Method, QuantityBox, Steps, Study, Variable};

    #[test]
    fn numbers_that_make_no_sense_are_refused_by_name() {
        let good = Scene::at_moes(40.0, 10.0);
        good.check().unwrap();
        let message = |scene: Scene| scene.check().unwrap_err().to_string();
        assert!(message(Scene { at: At::moes(f64::NAN, 10.0), ..good.clone() }).contains("Moes number M"));
        let bad_grid = Grid::Uniform { dx: f64::INFINITY, domain: (-4.0, 2.0) };
        assert!(message(Scene { grid: bad_grid, ..good.clone() }).contains("grid.dx"));
        assert!(message(Scene { study: Study::Point { methods: vec![] }, ..good.clone() }).contains("methods"));
        let huge = Study::Sweep {
            over: vec![Axis { vary: Variable::M, values: Steps::Log { from: 1.0, to: 9.0, n: usize::MAX } }],
            methods: vec![Method::Full],
            cold: false,
            compare_on_model_grid: false,
        };
        assert!(message(Scene { study: huge, ..good.clone() }).contains("study.over.M"));
        let alone = Study::Sweep {
            over: vec![Axis { vary: Variable::M, values: Steps::List(vec![20.0]) }],
            methods: vec![Method::Full],
            cold: false,
            compare_on_model_grid: true,
        };
        assert!(message(Scene { study: alone, ..good.clone() }).contains("study.compare_on_model_grid"));
        let range = QuantityBox { load: (2.0, f64::NAN), ..QuantityBox::TABLE_3_1 };
        let study = Study::Trajectory { range, points: 10, methods: vec![Method::Full] };
        assert!(message(Scene { study, ..good.clone() }).contains("study.range.load.1"));
        let study = Study::ErrorSplit { contacts: Contacts::Here, method: Method::Full };
        assert!(message(Scene { study, ..good.clone() }).contains("study.method"));
        let study = Study::GridStudy { dx: vec![0.02, 0.01, 0.004] };
        assert!(message(Scene { study, ..good }).contains("constant factor"));
    }
}
