//! Time until a cancelled training or full solve returns from any stage, in processor time of one thread, so that other
//! load on the machine does not matter.

use crate::common::stop_after::assert_stops;
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::{PointSolver, Start, Termination};
use ehl_explorer::solver::observer::Observer;
use ehl_explorer::solver::parameters::ParameterSpace;
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
use ehl_explorer::solver::reduced::Sampling;
use ehl_explorer::solver::training::{
    Indicator, Plan, Progress, TrainingError, TrainingObserver, TrainingSpec, TrainingState, train_resumable,
};
use std::sync::atomic::{AtomicBool, Ordering};

/// The explorer's grid, and enough solutions for bases of realistic size.
fn spec(sampling: Sampling) -> TrainingSpec {
    let plan = Plan::Adaptive {
        start: 60,
        indicator: Indicator::Correction,
        tolerances: vec![1e-4],
        successes: 100,
        local_sigma: 0.1,
        local_successes: 20,
        vicinity: 8,
        limit: 120,
    };
    let (range, grid) = (ParameterSpace::table_3_1(), GridSpec::EXPLORER);
    let spec = TrainingSpec::new(range, (5.0, 200.0), grid, plan);
    TrainingSpec { pressure_loss: 1e-7, sampling, evidence: 300, ..spec }
}

#[test]
fn a_cancelled_training_returns_within_a_tenth_of_a_second() {
    struct Precomputed(AtomicBool);
    impl TrainingObserver for Precomputed {}
    impl Observer for Precomputed {
        fn progress(&self, progress: Progress) {
            self.0.fetch_or(progress.stage.starts_with("Bases"), Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }
    let mut solved = TrainingState::new(spec(Sampling::QDeim));
    train_resumable(&mut solved, &Precomputed(AtomicBool::new(false))).unwrap_err();
    let fresh = TrainingState::new(spec(Sampling::QDeim));
    let mut cubature = solved.clone();
    cubature.spec.sampling = Sampling::Cubature;
    for (name, state, stage, moments) in [
        ("full solutions", &fresh, "Full solutions", &[30, 33, 36][..]),
        ("bases", &solved, "Bases", &[0]),
        ("row snapshots", &solved, "Row snapshots", &[20, 27]),
        ("Q-DEIM", &solved, "Row sampling", &[0]),
        ("cubature", &cubature, "Row sampling", &[0]),
        ("search", &solved, "Search", &[0, 60, 70]),
    ] {
        assert_stops(name, stage, moments, |observer| {
            matches!(train_resumable(&mut state.clone(), observer), Err(TrainingError::Cancelled))
        });
    }
}

#[test]
fn cancelled_full_solves_return_within_a_tenth_of_a_second() {
    let mut solver = PointSolver::new(PointGridSpec::FINE).unwrap();
    let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 200.0, 10.0)).unwrap();
    // All parts of a Newton step: assembly, factorisation, Krylov iterations.
    let moments: Vec<u64> = (0..9).map(|k| 40 + 57 * k).collect();
    assert_stops("601×81 nodes", "", &moments, |observer| {
        let solution = solver.solve(&point, Default::default(), Start::Cold, observer).unwrap();
        solution.report.termination == Termination::Cancelled
    });
}
