//! The door: every number of a scene is finite and sane before anything is computed from it.

use super::error::SceneError;
use super::method::Method;
use crate::solver::training::{QuantityBox, Range, SlidingRange};

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

pub(super) fn quantity_box(field: &str, range: &QuantityBox) -> Checked {
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

pub(super) fn test_range(range: &Range) -> Checked {
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

pub(super) fn methods(field: &str, methods: &[Method]) -> Checked {
    count(&format!("{field} (how many)"), methods.len(), 1, 16)
}

/// Refuses names that are empty or occur twice.
pub(super) fn names<'a>(field: &str, names: impl Iterator<Item = &'a str>) -> Checked {
    let mut seen: Vec<&str> = Vec::new();
    for name in names {
        if name.is_empty() || seen.contains(&name) {
            return Err(refuse(field, "must not be empty or occur twice: results are named by it"));
        }
        seen.push(name);
    }
    Ok(())
}
