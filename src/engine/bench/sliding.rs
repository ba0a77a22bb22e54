//! Sliding contacts of oils that thin by Eyring's law in the speed table.

use super::{Bench, EngineError, POINT_BUDGET, REDUCED_SHEAR_POINTS, Timing, reduced_rows};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::CIRCLES;
use crate::solver::training::{OilRange, Range, SlidingOilRange, random_points};

const SEED: u64 = 2028;

/// Oils and steel bodies of bearings and gears.
const RANGE: SlidingOilRange = SlidingOilRange {
    oils: OilRange {
        m: (15.0, 250.0),
        l: (1.0, 14.0),
        alpha: (8e-9, 30e-9),
        viscosity: (0.002, 0.5),
        exponent: (0.18, 1.1),
        hertz_pressure: (0.3e9, 2.5e9),
        thinnest_film: 0.015,
        radius_ratio: CIRCLES,
    },
    srr: (0.0, 1.0),
    modulus: (200e9, 240e9),
    limit_slope: (0.03, 0.12),
    gradient_stress: 5e6,
};

/// Reduced solves with H_c and traction, with all fields, and without these ended at a relative step of 1e-3; a note where
/// there is no model.
pub(super) fn rows(
    bench: &mut Bench,
    kind: ContactKind,
    names: [&'static str; 3],
    size: usize,
) -> Result<Vec<Timing>, EngineError> {
    let shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
    let Some(mut online) = bench.online(names[0], kind, shear) else { return Ok(Vec::new()) };
    let lubricant = Lubricant { shear, ..Lubricant::default() };
    let points = random_points(&Range::SlidingOils(RANGE), kind, REDUCED_SHEAR_POINTS[size], SEED);
    Ok(reduced_rows(names, &mut online, (&points, lubricant), POINT_BUDGET[size])?.into())
}
