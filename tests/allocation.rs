//! Online iterations and online time steps do not allocate: more of them need the same number of allocations.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests wait by the clock")]
#![allow(unsafe_code, reason = "an allocator that counts")]

use ehl_explorer::engine::embedded;
use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::transient::{
    self, Frame, Inputs, Interpolation, Keep, Marching, Moment, Signal, Transient, TransientObserver, march,
};
use ehl_explorer::solver::observer::Observer;
use ehl_explorer::solver::parameters::{Axis, ParameterSpace, Quantity, Scale};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant};
use ehl_explorer::solver::reduced::tpwl::{Selection, TpwlMarch, TpwlModel, TpwlTraining, Weighting};
use ehl_explorer::solver::reduced::transient::ReducedMarch;
use ehl_explorer::solver::reduced::{Online, ReducedModel, ReducedOptions, Scheme};
use ehl_explorer::solver::training::{Plan, TrainingSpec, TrajectoryTraining, Windows, train, train_trajectories};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::{Arc, Mutex};

struct Counting;

thread_local! {
    /// Counts this thread only: the online phases are sequential, and tests run in parallel.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn allocations() -> usize {
    ALLOCATIONS.with(Cell::get)
}

// SAFETY: every call is passed to the system allocator unchanged; only a counter is added.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Returns the allocations of a solve whose attempts all run to their limit, since a tolerance of zero is never met.
fn allocations_of_a_solve(
    model: &Arc<ReducedModel>,
    point: &OperatingPoint,
    lubricant: Lubricant,
    max_newton: usize,
) -> usize {
    let options = ReducedOptions { tolerance: 0.0, max_newton, ..ReducedOptions::default() };
    let mut online = Online::new(Arc::clone(model), options);
    assert!(online.solve(point, lubricant).is_err());
    let before = allocations();
    assert!(online.solve(point, lubricant).is_err());
    allocations() - before
}

fn space<const N: usize>(axes: [(Quantity, (f64, f64)); N]) -> ParameterSpace {
    ParameterSpace::of(axes.map(|(quantity, ends)| Axis::new(quantity, ends)))
}

#[test]
fn more_online_iterations_do_not_allocate_more() {
    let newtonian = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
    let request = MoesRequest {
        radius_m: Some(12.7e-3),
        modulus_pa: Some(123.878213951e9),
        viscosity_pa_s: Some(0.0705),
        alpha_per_pa: Some(1.8925e-8),
        ..MoesRequest::new(ContactKind::Line, 20.0, 9.0)
    };
    let sliding = Sliding { slide_to_roll_ratio: 0.5, newtonian_plateau_ratio: Some(0.3) };
    let thinning = OperatingPoint { sliding, ..si_from_moes(&request).unwrap() };
    let ruptured = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let trained = |scheme| {
        let range = space([(Quantity::M, (35.0, 45.0)), (Quantity::L, (9.0, 11.0)), (Quantity::Alpha, (5e-9, 20e-9))])
            .limited([(Quantity::HertzPressure, (0.0, 3.2e9))])
            .fixing([(Quantity::Viscosity, 0.01)]);
        let (coarse, plan) =
            (GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }, Plan::FarthestPoint { snapshots: 16 });
        let spec = TrainingSpec::new(range, (10.0, 100.0), coarse, plan);
        let spec = TrainingSpec { scheme, evidence: 0, pressure_loss: 1e-4, lubricant: ruptured, ..spec };
        Arc::new(train(&spec, &()).unwrap())
    };
    let oils = {
        let m = (35.0, 45.0);
        let mut range = space([
            (Quantity::M, m),
            (Quantity::L, (9.0, 11.0)),
            (Quantity::Alpha, (12e-9, 24e-9)),
            (Quantity::Viscosity, (0.01, 0.1)),
        ])
        .limited([(Quantity::HertzPressure, (0.4e9, 3.2e9)), (Quantity::RoelandsExponent, (0.4, 0.8))]);
        range.axes[1].scale = Scale::Log;
        let grid = GridSpec::Graded { nodes: 240, domain: (-6.0, 1.9), registered: true };
        let spec = TrainingSpec::new(range, m, grid, Plan::FarthestPoint { snapshots: 40 });
        let windows = Windows::Anchored {
            count: 2,
            modes: 12,
            grid,
            shared: 0,
            missing: 0.0,
            missing_of_any: 0.0,
            divided_by: 0,
        };
        Arc::new(train(&TrainingSpec { windows, evidence: 0, lubricant: ruptured, ..spec }, &()).unwrap())
    };
    let oiled = OperatingPoint { viscosity_pa_s: 0.03, alpha_per_pa: 18e-9, ..newtonian };
    for (model, point, lubricant) in [
        (oils, oiled, ruptured),
        (embedded("line").unwrap(), newtonian, Lubricant::default()),
        (embedded("line_shear").unwrap(), thinning, SQUALANE_PIP),
        (trained(Scheme::Galerkin), newtonian, ruptured),
        (trained(Scheme::LeastSquares { weighted: true }), newtonian, ruptured),
        (trained(Scheme::Gnat { weighted: true }), newtonian, ruptured),
    ] {
        let [few, many] = [3, 11].map(|max_newton| allocations_of_a_solve(&model, &point, lubricant, max_newton));
        assert_eq!(few, many, "allocations of the same attempts with 3 and with 11 iterations each");
    }
}

/// Returns the allocations up to each time of a march.
struct Counts(Mutex<Vec<usize>>);

impl Observer for Counts {}

impl TransientObserver for Counts {
    fn moment(&self, _: &Moment) {
        self.0.lock().unwrap().push(allocations());
    }
}

#[test]
fn online_steps_in_time_do_not_allocate() {
    let coarse = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 1.0 });
    let breathing = Transient::new(OperatingPoint::TABLE_2_1, load, 0.62, 0.01);
    let breathing = Transient { keep: Keep::Every(1), ..breathing };
    let full = transient::solve(coarse, &breathing, &()).unwrap();
    assert!(full.finished());
    let training = TpwlTraining { modes: 40, selection: Selection::Distance { tolerance: 0.02 } };
    let linearised = TpwlModel::train(&[&full], training).unwrap();
    let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let sampled = Arc::new(train_trajectories(&coarse.line().unwrap(), &[full], &settings, &()).unwrap());

    let online = Transient { keep: Keep::Scalars, ..breathing };
    let steps_that_allocate = |model: &mut dyn Marching, online: &Transient| {
        let counts = Counts(Mutex::new(Vec::with_capacity(100)));
        let trajectory = march(model, online, &counts).unwrap();
        assert!(trajectory.finished());
        let counts = counts.0.into_inner().unwrap();
        assert_eq!(counts.len(), 63);
        // The list of moments doubles its capacity for the 33rd one, to 64.
        counts[33..].windows(2).filter(|pair| pair[0] != pair[1]).count()
    };
    assert_eq!(steps_that_allocate(&mut ReducedMarch::new(&sampled, &online).unwrap(), &online), 0, "sampled rows");
    // The cavitation boundary moves without further allocation, also with remeshed films.
    let cavitation = Cavitation::Complementarity;
    for frame in [Frame::Fixed, Frame::Remeshed(Interpolation::CubicSpline)] {
        let held = Transient { frame, lubricant: Lubricant { cavitation, ..online.lubricant }, ..online.clone() };
        let full = transient::solve(coarse, &Transient { keep: Keep::Every(1), ..held.clone() }, &()).unwrap();
        let model = Arc::new(train_trajectories(&coarse.line().unwrap(), &[full], &settings, &()).unwrap());
        let mut march = ReducedMarch::new(&model, &held).unwrap();
        assert_eq!(steps_that_allocate(&mut march, &held), 0, "{frame:?}");
    }
    for weighting in [Weighting::DualTaylor, Weighting::Dissertation] {
        let mut march = TpwlMarch::new(&linearised, &online, weighting).unwrap();
        assert_eq!(steps_that_allocate(&mut march, &online), 0, "{weighting:?}");
    }
}
