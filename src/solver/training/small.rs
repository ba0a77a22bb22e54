//! Small trainings for tests.

use super::spec::{Plan, TrainingSpec, WindowSpec, Windows};
use super::state::TrainingState;
use super::train::train_resumable;
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::parameters::{Axis, ParameterSpace, Quantity};
use crate::solver::physics::lubricant::{Cavitation, Heat, LimitingStress, Lubricant, ShearLaw};
use crate::solver::reduced::{ReducedModel, Sampling};
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, OnceLock};

/// Values that are computed once for all tests of this program, by a key.
pub(crate) struct Made<T>(Mutex<BTreeMap<String, Arc<OnceLock<Arc<T>>>>>);

impl<T> Made<T> {
    pub(crate) const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// Returns the value for the key `what`. A second test that needs it waits for the first one.
    pub(crate) fn of(&self, what: &impl Debug, make: impl FnOnce() -> T) -> Arc<T> {
        let once = Arc::clone(self.0.lock().unwrap().entry(format!("{what:?}")).or_default());
        Arc::clone(once.get_or_init(|| Arc::new(make())))
    }
}

/// Returns the model of a specification.
pub(crate) fn trained(spec: &TrainingSpec) -> Arc<ReducedModel> {
    static MODELS: Made<ReducedModel> = Made::new();
    MODELS.of(spec, || trained_with_state(spec).0)
}

/// Returns the model with the state at the end of the training. Trainings that differ only after the full solutions
/// share these.
pub(crate) fn trained_with_state(spec: &TrainingSpec) -> (ReducedModel, TrainingState) {
    static SOLVED: Made<TrainingState> = Made::new();
    let mut alike = spec.clone();
    if let Plan::FarthestPoint { .. } = spec.plan {
        (alike.sampling, alike.rows_per_mode, alike.evidence) = (Sampling::All, 1.0, 0);
        if let Windows::Anchored { missing, missing_of_any, .. } = &mut alike.windows {
            (*missing, *missing_of_any) = (0.0, 0.0);
        }
    }
    let mut model = None;
    let solved = SOLVED.of(&alike, || {
        let mut state = TrainingState::new(spec.clone());
        model = Some(train_resumable(&mut state, &()).unwrap());
        state
    });
    let mut state = TrainingState { spec: spec.clone(), ..TrainingState::clone(&solved) };
    (model.unwrap_or_else(|| train_resumable(&mut state, &()).unwrap()), state)
}

/// Grid of point contacts on which a full solve takes milliseconds.
pub(crate) const POINT_GRID: PointGridSpec = PointGridSpec::uniform(0.06, 0.1, (-2.7, 1.5, -1.5));

/// Registered graded grid of few nodes.
pub(crate) fn line_grid(nodes: usize) -> GridSpec {
    GridSpec::Graded { nodes, domain: (-6.0, 1.9), registered: true }
}

/// Line contacts of a corner of Table 3.1.
pub(crate) fn line(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let corner = ParameterSpace::si_box([(3e-3, 4e-3), (2.0, 4.0), (2e5, 4e5), (8e-9, 12e-9)], 231e9, 0.01);
    let plan = Plan::FarthestPoint { snapshots };
    let spec = TrainingSpec::new(corner, (1.0, 500.0), line_grid(240), plan);
    TrainingSpec { sampling, evidence: 0, seed: 5, ..spec }
}

/// Point contacts of a corner of Table 3.4.
pub(crate) fn point(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let corner = ParameterSpace::si_box([(10e-3, 11e-3), (2.0, 3.0), (30.0, 45.0), (8e-9, 11e-9)], 231e9, 0.01);
    let (grid, plan) = (GridSpec::Plane(POINT_GRID), Plan::FarthestPoint { snapshots });
    TrainingSpec {
        pressure_loss: 1e-4,
        deformation_loss: 1e-4,
        sampling,
        rows_per_mode: 3.0,
        penalty: 1e5,
        evidence: 0,
        seed: 2,
        ..TrainingSpec::new(corner, (1.0, 2000.0), grid, plan)
    }
}

/// Elliptical contacts with two local models.
pub(crate) fn ellipses(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let mut range = moes_as_realised((15.0, 60.0), (4.0, 8.0), 3.2e9);
    range.axes.push(Axis::new(Quantity::RadiusRatio, (0.5, 4.0)));
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

/// Space of M, L, α and η₀ with limits of the Hertzian pressure p_H \[Pa\] and of Roelands' exponent (0.4…0.8).
pub(crate) fn lubricants([m, l, alpha, viscosity]: [(f64, f64); 4], hertz_pressure: (f64, f64)) -> ParameterSpace {
    ParameterSpace::of([
        Axis::new(Quantity::M, m),
        Axis::logarithmic(Quantity::L, l),
        Axis::new(Quantity::Alpha, alpha),
        Axis::new(Quantity::Viscosity, viscosity),
    ])
    .limited([(Quantity::HertzPressure, hertz_pressure), (Quantity::RoelandsExponent, (0.4, 0.8))])
}

/// Local models around anchors on a grid.
fn anchored(count: usize, modes: usize, grid: GridSpec, shared: usize) -> Windows {
    Windows::Anchored { count, modes, grid, shared, missing: 0.0, missing_of_any: 0.0, divided_by: 0 }
}

/// Adds slide-to-roll ratio, reduced modulus E′ and the limits of Eyring lubricants to a space.
fn with_eyring(mut range: ParameterSpace) -> ParameterSpace {
    range
        .axes
        .extend([Axis::new(Quantity::SlideToRollRatio, (0.0, 0.6)), Axis::new(Quantity::Modulus, (150e9, 350e9))]);
    range.constants =
        vec![Axis::new(Quantity::LimitAmbient, (0.0, 10e6)), Axis::logarithmic(Quantity::LimitSlope, (0.02, 0.15))];
    range.limited([(Quantity::GradientStress, (0.0, 5e6))])
}

/// Line contacts of varying lubricants, with three local models.
pub(crate) fn oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let m = (15.0, 60.0);
    let range = lubricants([m, (5.0, 10.0), (12e-9, 24e-9), (0.01, 0.1)], (0.4e9, 1.6e9));
    let spec = TrainingSpec::new(range, m, line_grid(240), Plan::FarthestPoint { snapshots });
    let windows = anchored(3, 32, line_grid(240), 0);
    TrainingSpec { windows, pressure_loss: 1e-9, deformation_loss: 0.1, sampling, evidence: 0, seed: 5, ..spec }
}

/// Sliding line contacts of Eyring lubricants, with two local models.
pub(crate) fn sliding_oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let range = lubricants([(15.0, 30.0), (6.0, 10.0), (14e-9, 22e-9), (0.01, 0.1)], (0.4e9, 1.6e9));
    TrainingSpec {
        range: with_eyring(range),
        lubricant: Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() },
        windows: anchored(2, 40, line_grid(240), 0),
        ..oils(sampling, snapshots)
    }
}

/// Circular contacts of varying lubricants, with two local models that share a basis.
pub(crate) fn oils_of_points(snapshots: usize) -> TrainingSpec {
    let m = (20.0, 60.0);
    let range = lubricants([m, (4.0, 8.0), (12e-9, 24e-9), (0.01, 0.1)], (0.3e9, 1.6e9))
        .limited([(Quantity::FilmThickness, (0.16, 1e6))]);
    let grid = GridSpec::Plane(PointGridSpec { refinement: 2.0, ..POINT_GRID });
    let spec = TrainingSpec::new(range, m, grid, Plan::FarthestPoint { snapshots });
    TrainingSpec {
        windows: anchored(2, 24, grid, 60),
        pressure_loss: 1e-9,
        deformation_loss: 0.1,
        sampling: Sampling::Cubature,
        rows_per_mode: 3.0,
        evidence: 0,
        seed: 4,
        ..spec.under(Cavitation::Complementarity)
    }
}

/// Circular contacts of Eyring lubricants, with two such local models.
pub(crate) fn sliding_oils_of_points(snapshots: usize) -> TrainingSpec {
    let (spec, sliding) = (oils_of_points(snapshots), sliding_oils(Sampling::Cubature, snapshots));
    TrainingSpec {
        range: with_eyring(spec.range.clone()),
        lubricant: Lubricant { cavitation: Cavitation::Complementarity, ..sliding.lubricant },
        ..spec
    }
}

const HEATED_GRID: GridSpec = GridSpec::Graded { nodes: 240, domain: (-10.0, 2.0), registered: true };

/// Grid of thermal circular contacts, whose full solves take longest.
const HEATED_BALLS_GRID: PointGridSpec = PointGridSpec::uniform(0.08, 0.13, (-2.7, 1.5, -1.5));

/// Thermal line contacts of a lubricant with a limiting stress, between steel bodies.
pub(crate) fn heated(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let range = one_heated((15.0, 30.0), (8.0, 11.0), (0.0, 0.6));
    let plan = Plan::FarthestPoint { snapshots };
    let grid = HEATED_GRID;
    let limiting_stress = Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) });
    let lubricant = Lubricant { heat: Some(Heat::default()), limiting_stress, ..Lubricant::default() };
    let spec = TrainingSpec::new(range, (15.0, 30.0), grid, plan);
    TrainingSpec { lubricant, positive_modes: true, penalty: 1e5, sampling, rows_per_mode: 3.0, evidence: 0, ..spec }
}

/// Thermal contacts of one lubricant between steel bodies.
pub(crate) fn one_heated(m: (f64, f64), l: (f64, f64), srr: (f64, f64)) -> ParameterSpace {
    ParameterSpace::of([
        Axis::new(Quantity::M, m),
        Axis::new(Quantity::L, l),
        Axis::new(Quantity::SlideToRollRatio, srr),
    ])
    .limited([(Quantity::HertzPressure, (0.0, 1.6e9))])
    .fixing([
        (Quantity::Radius, 0.01),
        (Quantity::Modulus, 231e9),
        (Quantity::Viscosity, 0.02),
        (Quantity::Alpha, 1.8e-8),
    ])
}

/// Thermal line contacts of varying lubricants, with two local models.
pub(crate) fn heated_oils(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    TrainingSpec {
        range: many_heated((15.0, 30.0), (7.0, 10.0)),
        windows: anchored(2, 40, HEATED_GRID, 0),
        pressure_loss: 1e-8,
        deformation_loss: 0.1,
        seed: 3,
        ..heated(sampling, snapshots)
    }
}

/// Thermal contacts of varying lubricants between bodies of varying materials.
fn many_heated(m: (f64, f64), l: (f64, f64)) -> ParameterSpace {
    let mut range = lubricants([m, l, (14e-9, 22e-9), (0.01, 0.05)], (0.5e9, 1.4e9));
    range.axes.extend([
        Axis::new(Quantity::Radius, (5e-3, 20e-3)),
        Axis::new(Quantity::SlideToRollRatio, (0.0, 0.5)),
        Axis::new(Quantity::Modulus, (200e9, 240e9)),
    ]);
    let constants = [
        (Quantity::InletTemperature, (293.0, 373.0)),
        (Quantity::ViscosityTemperature, (0.03, 0.06)),
        (Quantity::DensityTemperature, (4e-4, 9e-4)),
        (Quantity::Conductivity, (0.1, 0.18)),
        (Quantity::HeatCapacity, (1.5e6, 2e6)),
        (Quantity::LimitAmbient, (0.0, 8e6)),
        (Quantity::LimitSlope, (0.03, 0.1)),
        (Quantity::LimitEyring, (3e6, 8e6)),
        (Quantity::Effusivity2, (2e3, 2e4)),
        (Quantity::Effusivity1, (2e3, 2e4)),
    ];
    range.constants = constants.map(|(quantity, ends)| Axis::new(quantity, ends)).to_vec();
    range.limited([(Quantity::Speed, (0.2, 10.0)), (Quantity::SlidingSpeed, (0.0, 3.0))])
}

/// Thermal circular contacts of one lubricant.
pub(crate) fn heated_balls(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let m = (25.0, 40.0);
    TrainingSpec {
        range: one_heated(m, (6.0, 8.0), (0.0, 0.5)),
        windows: Windows::Given(vec![WindowSpec::new(m, GridSpec::Plane(HEATED_BALLS_GRID))]),
        pressure_loss: 1e-7,
        deformation_loss: 0.1,
        ..heated(sampling, snapshots)
    }
}

/// Thermal elliptical contacts of varying lubricants.
pub(crate) fn heated_ellipses(sampling: Sampling, snapshots: usize) -> TrainingSpec {
    let mut range = many_heated((25.0, 40.0), (6.0, 8.0));
    range.axes.push(Axis::new(Quantity::RadiusRatio, (0.7, 3.0)));
    let windows = anchored(1, 40, GridSpec::Plane(HEATED_BALLS_GRID), 0);
    TrainingSpec { range, windows, pressure_loss: 1e-7, ..heated_oils(sampling, snapshots) }
}

/// Thermal line contacts whose model has error bounds. Most thermal tests share this model, as training it is
/// expensive.
pub(crate) fn heated_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 110, ..heated(Sampling::Cubature, 30) }
}

/// The same for varying lubricants.
pub(crate) fn heated_oils_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 60, ..heated_oils(Sampling::Cubature, 100) }
}

/// The same for elliptical contacts.
pub(crate) fn heated_ellipses_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 100, ..heated_ellipses(Sampling::Cubature, 90) }
}

/// Contacts with these M and L up to a Hertzian pressure, with α of 5…20 1/GPa.
pub(crate) fn moes(m: (f64, f64), l: (f64, f64), max_hertz_pressure: f64) -> ParameterSpace {
    moes_with(m, l, (5e-9, 20e-9), max_hertz_pressure)
}

/// The same with another α.
pub(crate) fn moes_with(m: (f64, f64), l: (f64, f64), alpha: (f64, f64), max_hertz_pressure: f64) -> ParameterSpace {
    let mut space = moes_as_realised(m, l, max_hertz_pressure).fixing([(Quantity::Viscosity, 0.01)]);
    space.axes.push(Axis::new(Quantity::Alpha, alpha));
    space
}

/// The same in the default realisation.
pub(crate) fn moes_as_realised(m: (f64, f64), l: (f64, f64), max_hertz_pressure: f64) -> ParameterSpace {
    ParameterSpace::of([Axis::new(Quantity::M, m), Axis::new(Quantity::L, l)])
        .limited([(Quantity::HertzPressure, (0.0, max_hertz_pressure))])
}

/// Replaces the interval of a quantity that a space varies, limits or has as a constant.
pub(crate) fn with_ends(space: &ParameterSpace, quantity: Quantity, ends: (f64, f64)) -> ParameterSpace {
    let mut space = space.clone();
    let varied = space.axes.iter_mut().chain(&mut space.constants).find(|axis| axis.quantity == quantity);
    match varied {
        Some(axis) => axis.ends = ends,
        None => space.set_limit(quantity, ends),
    }
    space
}

/// Rough line contacts.
pub(crate) fn rough(sampling: Sampling) -> TrainingSpec {
    let range = ParameterSpace::of([
        Axis::new(Quantity::M, (15.0, 30.0)),
        Axis::new(Quantity::L, (7.0, 10.0)),
        Axis::new(Quantity::SmoothFilmRatio, (0.4, 2.0)),
    ]);
    let spec = TrainingSpec::new(range, (10.0, 40.0), line_grid(280), Plan::FarthestPoint { snapshots: 60 });
    let (pressure_loss, rows_per_mode) = (1e-9, 3.5);
    TrainingSpec { sampling, pressure_loss, rows_per_mode, evidence: 0, ..spec }.on_surfaces(None)
}

/// The same with error bounds.
pub(crate) fn rough_bounded() -> TrainingSpec {
    TrainingSpec { evidence: 200, ..rough(Sampling::Cubature) }
}

/// Rough circular contacts.
pub(crate) fn rough_circles(sampling: Sampling) -> TrainingSpec {
    let m = (25.0, 40.0);
    let range = ParameterSpace::of([
        Axis::new(Quantity::M, m),
        Axis::new(Quantity::L, (6.0, 8.0)),
        Axis::new(Quantity::SmoothFilmRatio, (0.5, 2.0)),
    ])
    .limited([(Quantity::RoughnessNumber, (0.0, 0.5))]);
    let plan = Plan::FarthestPoint { snapshots: 80 };
    let spec = TrainingSpec::new(range, m, GridSpec::Plane(POINT_GRID), plan);
    let (pressure_loss, deformation_loss, rows_per_mode) = (1e-8, 0.1, 4.0);
    TrainingSpec { sampling, pressure_loss, deformation_loss, rows_per_mode, evidence: 0, ..spec }.on_surfaces(None)
}

/// Rough circular contacts of varying lubricants, with two local models that share a basis, and with error bounds.
pub(crate) fn rough_oils_of_points() -> TrainingSpec {
    let mut spec = oils_of_points(60);
    spec.range.axes.push(Axis::new(Quantity::SmoothFilmRatio, (0.5, 2.0)));
    spec.range.limits.retain(|(limited, _)| *limited != Quantity::FilmThickness);
    spec.range.limits.push((Quantity::RoughnessNumber, (0.0, 0.5)));
    let windows = anchored(2, 40, GridSpec::Plane(POINT_GRID), 70);
    TrainingSpec { windows, rows_per_mode: 4.0, evidence: 100, ..spec }.on_surfaces(None)
}
