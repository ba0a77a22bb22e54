//! Small trainings, which tests make of many things.

use super::{Plan, QuantityBox, Range, TrainingSpec, WindowSpec, Windows};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::reduced::Sampling;

/// A grid of point contacts on which a full solve takes milliseconds.
pub(crate) const POINT_GRID: PointGridSpec = PointGridSpec::uniform(0.06, 0.1, (-2.7, 1.5, -1.5));

/// A registered graded grid of few nodes.
pub(crate) fn line_grid(nodes: usize) -> GridSpec {
    GridSpec::Graded { nodes, domain: (-6.0, 1.9), registered: true }
}

/// Line contacts of a corner of Table 3.1.
pub(crate) fn line(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let corner = QuantityBox {
        radius: (3e-3, 4e-3),
        speed: (2.0, 4.0),
        load: (2e5, 4e5),
        alpha: (8e-9, 12e-9),
        ..QuantityBox::TABLE_3_1
    };
    let plan = Plan::FarthestPoint { snapshots };
    let spec = TrainingSpec::new(Range::Box(corner), (1.0, 500.0), line_grid(240), plan);
    TrainingSpec { sampling, evidence: 0, seed: 5, ..spec }
}

/// Point contacts of a corner of Table 3.4.
pub(crate) fn point(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let corner = QuantityBox {
        radius: (10e-3, 11e-3),
        speed: (2.0, 3.0),
        load: (30.0, 45.0),
        alpha: (8e-9, 11e-9),
        ..QuantityBox::TABLE_3_4
    };
    let (grid, plan) = (GridSpec::Plane(POINT_GRID), Plan::FarthestPoint { snapshots });
    TrainingSpec {
        pressure_loss: 1e-4,
        deformation_loss: 1e-4,
        sampling,
        rows_per_mode: 3.0,
        penalty: 1e5,
        evidence: 0,
        seed: 2,
        ..TrainingSpec::new(Range::Box(corner), (1.0, 2000.0), grid, plan)
    }
}

/// Ellipses of two windows.
pub(crate) fn ellipses(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let range = Range::Ellipses { m: (15.0, 60.0), l: (4.0, 8.0), radius_ratio: (0.5, 4.0), max_hertz_pressure: 3.2e9 };
    let window = |ratios| WindowSpec {
        radius_ratio: Some(ratios),
        ..WindowSpec::new((1.0, 500.0), GridSpec::Plane(POINT_GRID))
    };
    TrainingSpec {
        windows: Windows::Given(vec![window((0.5, 1.4)), window((1.4, 4.0))]),
        pressure_loss: 1e-4,
        deformation_loss: 0.1,
        positive_modes: true,
        rows_per_mode: 4.0,
        range,
        ..TrainingSpec { plan: Plan::FarthestPoint { snapshots }, ..point(sampling, snapshots) }
    }
}

/// Contacts with these numbers up to a pressure, at an α of 5…20 1/GPa.
pub(crate) fn moes(m: (f64, f64), l: (f64, f64), max_hertz_pressure: f64) -> Range {
    moes_with(m, l, (5e-9, 20e-9), max_hertz_pressure)
}

/// The same at another α.
pub(crate) fn moes_with(m: (f64, f64), l: (f64, f64), alpha: (f64, f64), max_hertz_pressure: f64) -> Range {
    Range::Moes { m, l, alpha, max_hertz_pressure, viscosity: 0.01 }
}
