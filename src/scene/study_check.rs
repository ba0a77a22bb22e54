//! The door for questions: every number of a study is finite and sane.

use super::check::{Checked, MAX_COMPARED, MAX_POINTS, MAX_TESTS, count, interval, number, refuse};
use super::{Axis, Contacts, Grid, Method, QuantityBox, Scene, Steps, Study, Variable};
use crate::solver::physics::contact::ContactKind;
use crate::solver::training::{Plan, Range, SlidingRange, TrainingSpec, Windows};

/// Refuses a question that makes no sense, naming the field.
pub(super) fn study(scene: &Scene) -> Checked {
    match &scene.study {
        Study::DistanceMeasure { .. } if scene.contact == ContactKind::Point => {
            Err(refuse("study", "is made for line contacts only; write `contact: Line`, or another study"))
        }
        Study::Training(spec) if spec.contact() != scene.contact => Err(refuse(
            "study.windows",
            format!(
                "hold grids of {} contacts, but the scene's is a {} contact",
                spec.contact().name(),
                scene.contact.name()
            ),
        )),
        Study::Point { methods: list } => methods("study.methods", list),
        Study::Sweep { over, methods: list, compare_on_model_grid, .. } => {
            methods("study.methods", list)?;
            if *compare_on_model_grid && list.iter().all(|method| method.model().is_none()) {
                return Err(refuse(
                    "study.compare_on_model_grid",
                    "needs a reduced method to compare; add Reduced(…) to the methods, or leave it out",
                ));
            }
            axes(over, scene)
        }
        Study::Dimensions { over, losses } => {
            axes(over, scene)?;
            count("study.losses (how many)", losses.len(), 1, 32)?;
            losses.iter().try_for_each(|&loss| number("study.losses", loss, 1e-15, 0.5))
        }
        Study::Trajectory { range, points, methods: list } => {
            methods("study.methods", list)?;
            count("study.points", *points, 2, MAX_POINTS)?;
            quantity_box("study.range", range)
        }
        Study::RandomTest { range, tests, compare, .. } => {
            count("study.tests", *tests, 1, MAX_TESTS)?;
            count("study.compare", *compare, 0, *tests)?;
            test_range(range)
        }
        Study::ErrorSplit { contacts, method } => {
            if method.model().is_none() {
                return Err(refuse("study.method", "must be Reduced(…): a full solution has no such parts"));
            }
            match contacts {
                Contacts::Here => Ok(()),
                Contacts::Trajectory { range, points } => {
                    count("study.contacts.points", *points, 2, MAX_POINTS)?;
                    quantity_box("study.contacts.range", range)
                }
            }
        }
        Study::GridStudy { dx } => {
            count("study.dx (how many)", dx.len(), 3, 12)?;
            dx.iter().try_for_each(|&dx| number("study.dx", dx, 1e-4, 0.2))?;
            let ratio = dx[0] / dx[1];
            if !(ratio > 1.05 && dx.windows(2).all(|w| (w[0] / w[1] / ratio - 1.0).abs() < 1e-6)) {
                return Err(refuse("study.dx", "must fall by one constant factor, as 0.02, 0.01, 0.005 do"));
            }
            match scene.grid {
                Grid::Uniform { .. } | Grid::Plane { .. } => Ok(()),
                _ => Err(refuse("grid", "must be Uniform or Plane for a grid study, which takes its domain from it")),
            }
        }
        Study::Training(spec) => training(spec),
        Study::ErrorMeasures { range, points, .. } | Study::DistanceMeasure { range, points, .. } => {
            count("study.points", *points, 3, MAX_COMPARED)?;
            test_range(range)
        }
        Study::PlanComparison { plans, range, tests, compare, trajectory, .. } => {
            count("study.plans (how many)", plans.len(), 1, 16)?;
            count("study.tests", *tests, 1, MAX_TESTS)?;
            count("study.compare", *compare, 0, (*tests).min(MAX_COMPARED))?;
            count("study.trajectory", *trajectory, 2, MAX_COMPARED)?;
            for (i, plan) in plans.iter().enumerate() {
                if plan.name.is_empty() || plans[..i].iter().any(|other| other.name == plan.name) {
                    return Err(refuse(
                        "study.plans.name",
                        "must not be empty or occur twice: results are named by it",
                    ));
                }
            }
            let published = plans.iter().filter_map(|plan| plan.published_failure_percent);
            published.into_iter().try_for_each(|p| number("study.plans.published_failure_percent", p, 0.0, 100.0))?;
            quantity_box("study.range", range)
        }
        Study::ToleranceStudy { range, points, tests, .. } => {
            count("study.points", *points, 2, MAX_COMPARED)?;
            count("study.tests", *tests, 1, MAX_TESTS)?;
            quantity_box("study.range", range)
        }
        Study::SamplingComparison { samplings, range, tests, compare, .. } => {
            count("study.samplings (how many)", samplings.len(), 1, 16)?;
            count("study.tests", *tests, 1, MAX_TESTS)?;
            count("study.compare", *compare, 0, (*tests).min(MAX_COMPARED))?;
            for (i, way) in samplings.iter().enumerate() {
                if way.name.is_empty() || samplings[..i].iter().any(|other| other.name == way.name) {
                    let sentence = "must not be empty or occur twice: results are named by it";
                    return Err(refuse("study.samplings.name", sentence));
                }
                number("study.samplings.rows_per_mode", way.rows_per_mode, 1.0, 20.0)?;
                number("study.samplings.penalty", way.penalty, 1e2, 1e9)?;
            }
            quantity_box("study.range", range)
        }
        Study::Transient(study) => study.check(scene),
        Study::FormulaComparison { formula, .. } if formula.film_formula().contact() != scene.contact => {
            let wanted = formula.film_formula().contact().name();
            Err(refuse(
                "study.formula",
                format!("is made for {wanted} contacts, but the scene's is a {} contact", scene.contact.name()),
            ))
        }
        Study::FormulaComparison { m, l, .. } => {
            count("study.m (how many)", m.len(), 1, 1000)?;
            count("study.l (how many)", l.len(), 1, 1000)?;
            m.iter().try_for_each(|&m| number("study.m", m, 0.05, 1e5))?;
            l.iter().try_for_each(|&l| number("study.l", l, 1e-3, 1e3))
        }
    }
}

/// What a study varies.
fn axes(over: &[Axis], scene: &Scene) -> Checked {
    count("study.over (how many)", over.len(), 1, 3)?;
    over.iter().try_for_each(axis)?;
    if over.iter().any(|axis| axis.vary == Variable::Alpha) && scene.lubricant.own_coefficient().is_some() {
        return Err(refuse("study.over.alpha", "cannot be varied: the lubricant's viscosity law determines it"));
    }
    let points = over.iter().map(|axis| axis.values.len()).try_fold(1usize, usize::checked_mul);
    count("study.over (points)", points.unwrap_or(usize::MAX), 1, MAX_POINTS)
}

fn axis(axis: &Axis) -> Checked {
    let field = format!("study.over.{}", axis.vary.name());
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
        Steps::List(values) => values.iter().try_for_each(|&value| limit(value)),
    }
}

fn quantity_box(field: &str, range: &QuantityBox) -> Checked {
    for (name, ends, low, high) in [
        ("radius", range.radius, 1e-6, 1e3),
        ("speed", range.speed, 1e-9, 1e4),
        ("load", range.load, 1e-6, 1e10),
        ("alpha", range.alpha, 1e-12, 1e-5),
    ] {
        interval(&format!("{field}.{name}"), ends, low, high)?;
    }
    number(&format!("{field}.modulus"), range.modulus, 1e5, 1e14)?;
    number(&format!("{field}.viscosity"), range.viscosity, 1e-6, 1e4)
}

fn moes_range(field: &str, m: (f64, f64), l: (f64, f64), pressure: f64) -> Checked {
    interval(&format!("{field}.m"), m, 0.05, 1e5)?;
    interval(&format!("{field}.l"), l, 1e-3, 1e3)?;
    number(&format!("{field}.max_hertz_pressure"), pressure, 1e5, 1e12)
}

fn test_range(range: &Range) -> Checked {
    match range {
        Range::Box(range) => quantity_box("study.range", range),
        Range::Realisation { m, l, max_hertz_pressure } => moes_range("study.range", *m, *l, *max_hertz_pressure),
        Range::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
            moes_range("study.range", *m, *l, *max_hertz_pressure)?;
            interval("study.range.alpha", *alpha, 1e-12, 1e-5)?;
            number("study.range.viscosity", *viscosity, 1e-6, 1e4)
        }
        Range::Sliding(range) => {
            let SlidingRange { m, l, srr, npr, radius, modulus, viscosity, alpha, max_hertz_pressure } = range;
            interval("study.range.m", *m, 0.05, 1e5)?;
            interval("study.range.l", *l, 1e-3, 1e3)?;
            interval("study.range.srr", *srr, -10.0, 10.0)?;
            interval("study.range.npr", *npr, 0.0, 1.0)?;
            number("study.range.radius", *radius, 1e-6, 1e3)?;
            number("study.range.modulus", *modulus, 1e5, 1e14)?;
            number("study.range.viscosity", *viscosity, 1e-6, 1e4)?;
            number("study.range.alpha", *alpha, 1e-12, 1e-5)?;
            max_hertz_pressure.iter().try_for_each(|&p| number("study.range.max_hertz_pressure", p, 1e5, 1e12))
        }
    }
}

fn training(spec: &TrainingSpec) -> Checked {
    test_range(&spec.range)?;
    match &spec.plan {
        Plan::FarthestPoint { snapshots } => count("study.plan.snapshots", *snapshots, 2, 100_000)?,
        Plan::Grid { nodes } => {
            let total = nodes.iter().try_fold(1usize, |product, &n| product.checked_mul(n)).unwrap_or(usize::MAX);
            count("study.plan.nodes (product)", total, 2, 100_000)?;
        }
        Plan::Adaptive { start, tolerances, successes, local_sigma, local_successes, vicinity, limit, .. } => {
            count("study.plan.start", *start, 4, 5000)?;
            count("study.plan.limit", *limit, *start, 5000)?;
            count("study.plan.tolerances (how many)", tolerances.len(), 1, 32)?;
            tolerances.iter().try_for_each(|&t| number("study.plan.tolerances", t, 1e-12, 1e12))?;
            count("study.plan.successes", *successes, 1, MAX_POINTS)?;
            number("study.plan.local_sigma", *local_sigma, 1e-6, 1.0)?;
            count("study.plan.local_successes", *local_successes, 0, MAX_POINTS)?;
            count("study.plan.vicinity", *vicinity, 0, 10_000)?;
        }
        Plan::WorstOfPool { start, pool, per_round, tolerance, limit, .. } => {
            count("study.plan.start", *start, 4, 5000)?;
            count("study.plan.limit", *limit, *start, 5000)?;
            count("study.plan.pool", *pool, 1, MAX_POINTS)?;
            count("study.plan.per_round", *per_round, 1, *pool)?;
            number("study.plan.tolerance", *tolerance, 1e-12, 1e12)?;
        }
    }
    match &spec.windows {
        Windows::Given(windows) => {
            count("study.windows (how many)", windows.len(), 1, 64)?;
            windows.iter().try_for_each(|window| interval("study.windows.m", window.m, 1e-3, 1e6))?;
        }
        Windows::Automatic { modes } => count("study.windows.modes", *modes, 8, 1000)?,
    }
    number("study.pressure_loss", spec.pressure_loss, 1e-15, 0.5)?;
    number("study.deformation_loss", spec.deformation_loss, 1e-15, 0.5)?;
    number("study.rows_per_mode", spec.rows_per_mode, 1.0, 100.0)?;
    number("study.penalty", spec.penalty, 1e2, 1e9)
}

fn methods(field: &str, methods: &[Method]) -> Checked {
    count(&format!("{field} (how many)"), methods.len(), 1, 16)
}
