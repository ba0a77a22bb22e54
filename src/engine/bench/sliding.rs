//! Sliding contacts of Eyring (shear-thinning) lubricants in the speed table.

use super::{Bench, EngineError, POINT_BUDGET, REDUCED_SHEAR_POINTS, Timing, reduced_rows};
use crate::solver::parameters::{Axis, ParameterSpace, Quantity};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::training::random_points;

const SEED: u64 = 2028;

/// Returns the range of lubricants and steel bodies of bearings and gears.
fn range() -> ParameterSpace {
    ParameterSpace::of([
        Axis::new(Quantity::M, (15.0, 250.0)),
        Axis::logarithmic(Quantity::L, (1.0, 14.0)),
        Axis::new(Quantity::Alpha, (8e-9, 30e-9)),
        Axis::new(Quantity::Viscosity, (0.002, 0.5)),
        Axis::new(Quantity::SlideToRollRatio, (0.0, 1.0)),
        Axis::new(Quantity::Modulus, (200e9, 240e9)),
    ])
    .limited([
        (Quantity::HertzPressure, (0.3e9, 2.5e9)),
        (Quantity::RoelandsExponent, (0.18, 1.1)),
        (Quantity::FilmThickness, (0.015, 1e6)),
        (Quantity::GradientStress, (0.0, 5e6)),
    ])
}

/// Times reduced solves with H_c and traction, with all fields, and with a relative step tolerance of 1e-3 and without
/// fields. Adds a note if there is no model.
pub(super) fn rows(
    bench: &mut Bench,
    kind: ContactKind,
    names: [&'static str; 3],
    size: usize,
) -> Result<Vec<Timing>, EngineError> {
    let shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
    let Some(mut online) = bench.online(names[0], kind, shear) else { return Ok(Vec::new()) };
    let lubricant = Lubricant { shear, ..Lubricant::default() };
    let points = random_points(&range(), kind, REDUCED_SHEAR_POINTS[size], SEED);
    Ok(reduced_rows(names, &mut online, (&points, lubricant), POINT_BUDGET[size])?.into())
}
