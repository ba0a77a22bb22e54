//! Trainings as a whole: stopped and resumed, on any number of threads, with tolerances out of reach.

use super::*;
use crate::solver::grid::GridSpec;
use crate::solver::reduced::{ReducedModel, Window};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A small box on a coarse grid: a full solve takes a fraction of a millisecond.
fn small(plan: Plan) -> TrainingSpec {
    let grid = GridSpec::Uniform { dx: 0.04, domain: (-4.0, 2.0) };
    TrainingSpec {
        title: "small".to_owned(),
        range: Range::Box {
            radius: (2e-3, 3e-3),
            speed: (3.0, 5.0),
            load: (1e5, 2e5),
            alpha: (6e-9, 10e-9),
            modulus: 231e9,
            viscosity: 0.01,
        },
        lubricant: Default::default(),
        plan,
        windows: Windows::Given(vec![WindowSpec { m: (5.0, 25.0), grid }, WindowSpec { m: (25.0, 200.0), grid }]),
        pressure_loss: 1e-7,
        deformation_loss: 1e-6,
        sampling: Sampling::QDeim,
        rows_per_mode: 2.0,
        seed: 3,
    }
}

fn adaptive(tolerances: Vec<f64>, limit: usize) -> Plan {
    Plan::Adaptive {
        start: 6,
        indicator: Indicator::Correction,
        tolerances,
        successes: 32,
        local_sigma: 0.1,
        local_successes: 8,
        vicinity: 4,
        limit,
    }
}

fn pool(tolerance: f64, limit: usize) -> Plan {
    Plan::WorstOfPool { start: 6, indicator: Indicator::Correction, pool: 40, per_round: 3, tolerance, limit }
}

/// Cancels at a checkpoint and keeps what was written there, as a crash would find it.
struct StopAt {
    solutions: usize,
    stopped: AtomicBool,
    written: Mutex<Option<TrainingState>>,
}

impl TrainingObserver for StopAt {
    fn checkpoint(&self, state: &TrainingState) {
        if state.solutions() >= self.solutions && !self.stopped.swap(true, Ordering::Relaxed) {
            *self.written.lock().unwrap() = Some(state.clone());
        }
    }
    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// Everything of a model that its results depend on.
fn essence(model: &ReducedModel) -> Vec<String> {
    let window =
        |w: &Window| format!("{:?} {:?} {:?} {:?}", w.snapshots, w.pressure.modes, w.sampled_rows, w.reconstruction);
    model.windows.iter().map(window).chain(model.log.iter().cloned()).collect()
}

fn stopped_and_resumed_is_the_same(spec: &TrainingSpec, stops: &[usize]) {
    let whole = train(spec, &()).unwrap();
    for &solutions in stops {
        let stop = StopAt { solutions, stopped: AtomicBool::new(false), written: Mutex::new(None) };
        let mut state = TrainingState::new(spec.clone());
        assert_eq!(train_resumable(&mut state, &stop).unwrap_err(), TrainingError::Cancelled, "{solutions}");
        let crashed = stop.written.into_inner().unwrap().unwrap();
        for mut state in [state, crashed] {
            assert!(state.solutions() >= solutions);
            let before = state.windows[0].solved.clone();
            // Through bytes, as a file would keep it.
            let bytes = postcard::to_allocvec(&state).unwrap();
            state = postcard::from_bytes(&bytes).unwrap();
            let resumed = train_resumable(&mut state, &()).unwrap();
            assert!(essence(&resumed) == essence(&whole), "stopped after {solutions}");
            assert!(before.iter().all(|s| state.windows[0].solved.contains(s)));
        }
    }
}

#[test]
fn a_training_stopped_and_resumed_gives_the_same_model() {
    let spec = small(adaptive(vec![1e-2, 1e-3], 30));
    let whole = train(&spec, &()).unwrap();
    let total: usize = whole.windows.iter().map(|w| w.snapshots.len()).sum();
    assert!(total > 13, "the search added nothing");
    stopped_and_resumed_is_the_same(&spec, &[1, 7, 9, total - 1]);
    stopped_and_resumed_is_the_same(&small(pool(1e-3, 30)), &[1, 7, 11]);
    stopped_and_resumed_is_the_same(&small(Plan::FarthestPoint { snapshots: 20 }), &[1, 17, 30]);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for plan in [adaptive(vec![3e-3], 20), pool(3e-3, 20)] {
        let spec = small(plan);
        let (a, b) = (one.install(|| train(&spec, &()).unwrap()), three.install(|| train(&spec, &()).unwrap()));
        assert!(essence(&a) == essence(&b));
    }
}

#[test]
fn a_tolerance_that_cannot_be_met_ends_at_the_limit_and_is_said() {
    for plan in [adaptive(vec![1e-2, 1e-13], 12), pool(1e-13, 12)] {
        let model = train(&small(plan), &()).unwrap();
        assert!(model.windows.iter().all(|w| w.snapshots.len() == 12));
        assert!(model.log.iter().any(|line| line.contains("tolerance 1e-13 was not met")), "{:?}", model.log);
    }
}

#[test]
fn a_training_that_is_stopped_still_gives_a_model() {
    let stop = StopAt { solutions: 5, stopped: AtomicBool::new(false), written: Mutex::new(None) };
    let mut state = TrainingState::new(small(adaptive(vec![1e-3], 30)));
    train_resumable(&mut state, &stop).unwrap_err();
    struct Count(AtomicUsize);
    impl TrainingObserver for Count {
        fn checkpoint(&self, _: &TrainingState) {
            self.0.fetch_add(1, Ordering::Relaxed);
        }
    }
    let count = Count(AtomicUsize::new(0));
    let model = state.model(&count).unwrap();
    assert_eq!(count.0.into_inner(), 0, "no further full solution");
    assert_eq!(model.windows.len(), 1);
    assert_eq!(model.windows[0].snapshots.len(), state.windows[0].solved.len());
}

#[test]
fn plans_that_make_no_sense_are_refused_with_a_sentence() {
    let message = |plan| train(&small(plan), &()).unwrap_err().to_string();
    assert!(message(adaptive(vec![], 20)).contains("tolerances"));
    assert!(message(adaptive(vec![1e-3, 1e-2], 20)).contains("descending"));
    assert!(message(adaptive(vec![f64::NAN], 20)).contains("positive"));
    assert!(message(adaptive(vec![1e-3], 3)).contains("stops at 3"));
    assert!(
        message(Plan::WorstOfPool {
            start: 6,
            indicator: Indicator::Residual,
            pool: 2,
            per_round: 3,
            tolerance: 1.0,
            limit: 9
        })
        .contains("per_round is 3")
    );
}
