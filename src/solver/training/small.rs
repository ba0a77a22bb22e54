//! Small trainings, which tests make of many things.

use super::{
    HeatedOilRange, HeatedRange, OilRange, Plan, QuantityBox, Range, SlidingOilRange, TrainingSpec, WindowSpec,
    Windows, train,
};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::physics::lubricant::{Cavitation, Heat, LimitingStress, Lubricant, ShearLaw};
use crate::solver::reduced::{CIRCLES, ReducedModel, Sampling, ThermalDomain};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, OnceLock};

/// Values that are made once for all tests of this program, by what they are made from.
pub(crate) struct Made<T>(Mutex<BTreeMap<String, Arc<OnceLock<Arc<T>>>>>);

impl<T> Made<T> {
    pub(crate) const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The value made from `what`. A second test that needs it waits for the first one.
    pub(crate) fn of(&self, what: &impl Debug, make: impl FnOnce() -> T) -> Arc<T> {
        let once = Arc::clone(self.0.lock().unwrap().entry(format!("{what:?}")).or_default());
        Arc::clone(once.get_or_init(|| Arc::new(make())))
    }
}

/// The model of a specification.
pub(crate) fn trained(spec: &TrainingSpec) -> Arc<ReducedModel> {
    static MODELS: Made<ReducedModel> = Made::new();
    MODELS.of(spec, || train(spec, &()).unwrap())
}

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

/// Line contacts of oils, in three windows.
pub(crate) fn oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let range = OilRange {
        m: (15.0, 60.0),
        l: (5.0, 10.0),
        alpha: (12e-9, 24e-9),
        viscosity: (0.01, 0.1),
        exponent: (0.4, 0.8),
        hertz_pressure: (0.4e9, 1.6e9),
        thinnest_film: 0.0,
        radius_ratio: CIRCLES,
    };
    let plan = Plan::FarthestPoint { snapshots };
    let windows = Windows::Anchored {
        count: 3,
        modes: 32,
        grid: line_grid(240),
        shared: 0,
        missing: 0.0,
        missing_of_any: 0.0,
        divided_by: 0,
    };
    let spec = TrainingSpec::new(Range::Oils(range), range.m, line_grid(240), plan);
    TrainingSpec { windows, pressure_loss: 1e-9, deformation_loss: 0.1, sampling, evidence: 0, seed: 5, ..spec }
}

/// Sliding line contacts of oils that thin by Eyring's law, in two windows.
pub(crate) fn sliding_oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let spec = oils(sampling, snapshots);
    let Range::Oils(range) = spec.range else { return spec };
    let oils = OilRange { m: (15.0, 30.0), l: (6.0, 10.0), alpha: (14e-9, 22e-9), ..range };
    let range = SlidingOilRange {
        oils,
        srr: (0.0, 0.6),
        modulus: (150e9, 350e9),
        limit_slope: (0.02, 0.15),
        gradient_stress: 5e6,
    };
    TrainingSpec {
        range: Range::SlidingOils(range),
        lubricant: Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() },
        windows: Windows::Anchored {
            count: 2,
            modes: 40,
            grid: line_grid(240),
            shared: 0,
            missing: 0.0,
            missing_of_any: 0.0,
            divided_by: 0,
        },
        ..spec
    }
}

/// Circular contacts of oils, in two windows whose modes are made of one basis.
pub(crate) fn oils_of_points(snapshots: usize) -> TrainingSpec {
    let range = OilRange {
        m: (20.0, 60.0),
        l: (4.0, 8.0),
        alpha: (12e-9, 24e-9),
        viscosity: (0.01, 0.1),
        exponent: (0.4, 0.8),
        hertz_pressure: (0.3e9, 1.6e9),
        thinnest_film: 0.16,
        radius_ratio: CIRCLES,
    };
    let grid = GridSpec::Plane(PointGridSpec { refinement: 2.0, ..POINT_GRID });
    let windows =
        Windows::Anchored { count: 2, modes: 24, grid, shared: 60, missing: 0.0, missing_of_any: 0.0, divided_by: 0 };
    let spec = TrainingSpec::new(Range::Oils(range), range.m, grid, Plan::FarthestPoint { snapshots });
    TrainingSpec {
        windows,
        pressure_loss: 1e-9,
        deformation_loss: 0.1,
        sampling: Sampling::Cubature,
        rows_per_mode: 3.0,
        evidence: 0,
        seed: 4,
        ..spec.under(Cavitation::Complementarity)
    }
}

/// Circular contacts of oils that thin by Eyring's law, in two such windows.
pub(crate) fn sliding_oils_of_points(snapshots: usize) -> TrainingSpec {
    let (spec, sliding) = (oils_of_points(snapshots), sliding_oils(Sampling::Cubature, snapshots));
    let (Range::Oils(oils), Range::SlidingOils(range)) = (spec.range, sliding.range) else { return spec };
    TrainingSpec {
        range: Range::SlidingOils(SlidingOilRange { oils, ..range }),
        lubricant: Lubricant { cavitation: Cavitation::Complementarity, ..sliding.lubricant },
        ..spec
    }
}

const HEATED_GRID: GridSpec = GridSpec::Graded { nodes: 280, domain: (-10.0, 2.0), registered: true };

/// Line contacts with heat of an oil whose stress is limited, between steel bodies.
pub(crate) fn heated(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let range = HeatedRange {
        m: (15.0, 30.0),
        l: (8.0, 11.0),
        srr: (0.0, 0.6),
        radius: 0.01,
        modulus: 231e9,
        viscosity: 0.02,
        alpha: 1.8e-8,
        max_hertz_pressure: 1.6e9,
    };
    let plan = Plan::FarthestPoint { snapshots };
    let grid = HEATED_GRID;
    let limiting_stress = Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) });
    let lubricant = Lubricant { heat: Some(Heat::default()), limiting_stress, ..Lubricant::default() };
    let spec = TrainingSpec::new(Range::Heated(range), range.m, grid, plan);
    TrainingSpec { lubricant, positive_modes: true, penalty: 1e5, sampling, rows_per_mode: 3.0, evidence: 0, ..spec }
}

/// Line contacts with heat of many such oils, in two windows.
pub(crate) fn heated_oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let oils = OilRange {
        m: (15.0, 30.0),
        l: (7.0, 10.0),
        alpha: (14e-9, 22e-9),
        viscosity: (0.01, 0.05),
        exponent: (0.4, 0.8),
        hertz_pressure: (0.5e9, 1.4e9),
        thinnest_film: 0.0,
        radius_ratio: CIRCLES,
    };
    let range = HeatedOilRange {
        oils,
        srr: (0.0, 0.5),
        radius: (5e-3, 20e-3),
        modulus: (200e9, 240e9),
        speed: (0.2, 10.0),
        sliding_speed: 3.0,
        thermal: Some(ThermalDomain {
            inlet_temperature: (293.0, 373.0),
            viscosity_temperature: (0.03, 0.06),
            density_temperature: (4e-4, 9e-4),
            conductivity: (0.1, 0.18),
            heat_capacity: (1.5e6, 2e6),
            effusivity: (2e3, 2e4),
            limit_ambient: (0.0, 8e6),
            limit_slope: (0.03, 0.1),
            limit_eyring: (3e6, 8e6),
        }),
    };
    let one = heated(sampling, snapshots);
    let windows = Windows::Anchored {
        count: 2,
        modes: 40,
        grid: HEATED_GRID,
        shared: 0,
        missing: 0.0,
        missing_of_any: 0.0,
        divided_by: 0,
    };
    TrainingSpec {
        range: Range::HeatedOils(range),
        windows,
        pressure_loss: 1e-8,
        deformation_loss: 0.1,
        seed: 3,
        ..one
    }
}

/// Circular contacts with heat of one such oil.
pub(crate) fn heated_balls(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let one = heated(sampling, snapshots);
    let Range::Heated(range) = one.range else { return one };
    let range = HeatedRange { m: (25.0, 40.0), l: (6.0, 8.0), srr: (0.0, 0.5), ..range };
    let windows = Windows::Given(vec![WindowSpec::new(range.m, GridSpec::Plane(POINT_GRID))]);
    TrainingSpec { range: Range::Heated(range), windows, pressure_loss: 1e-7, deformation_loss: 0.1, ..one }
}

/// Elliptical contacts with heat of many such oils.
pub(crate) fn heated_ellipses(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let lines = heated_oils(sampling, snapshots);
    let Range::HeatedOils(range) = lines.range else { return lines };
    let oils = OilRange { m: (25.0, 40.0), l: (6.0, 8.0), radius_ratio: (0.7, 3.0), ..range.oils };
    let grid = GridSpec::Plane(POINT_GRID);
    let windows =
        Windows::Anchored { count: 1, modes: 40, grid, shared: 0, missing: 0.0, missing_of_any: 0.0, divided_by: 0 };
    TrainingSpec { range: Range::HeatedOils(HeatedOilRange { oils, ..range }), windows, pressure_loss: 1e-7, ..lines }
}

/// Line contacts with heat whose model has error bounds. Most tests of heat share this model, as training it is expensive.
pub(crate) fn heated_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 110, ..heated(Sampling::Cubature, 30) }
}

/// The same of many oils.
pub(crate) fn heated_oils_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 120, ..heated_oils(Sampling::Cubature, 130) }
}

/// The same of elliptical contacts.
pub(crate) fn heated_ellipses_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 100, ..heated_ellipses(Sampling::Cubature, 90) }
}

/// Contacts with these numbers up to a pressure, at an α of 5…20 1/GPa.
pub(crate) fn moes(m: (f64, f64), l: (f64, f64), max_hertz_pressure: f64) -> Range {
    moes_with(m, l, (5e-9, 20e-9), max_hertz_pressure)
}

/// The same at another α.
pub(crate) fn moes_with(m: (f64, f64), l: (f64, f64), alpha: (f64, f64), max_hertz_pressure: f64) -> Range {
    Range::Moes { m, l, alpha, max_hertz_pressure, viscosity: 0.01 }
}
