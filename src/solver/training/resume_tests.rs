//! Tests of complete trainings: stopped and resumed, on any number of threads, with tolerances that cannot be met.

use super::small::{moes, moes_with, oils};
use super::*;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::parameters::ParameterSpace;
use crate::solver::reduced::{ReducedModel, Sampling, Window};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Small box on a coarse grid: a full solve takes a fraction of a millisecond.
fn small(plan: Plan) -> TrainingSpec {
    let grid = GridSpec::Uniform { dx: 0.04, domain: (-4.0, 2.0) };
    let range = ParameterSpace::si_box([(2e-3, 3e-3), (3.0, 5.0), (1e5, 2e5), (6e-9, 10e-9)], 231e9, 0.01);
    TrainingSpec {
        windows: Windows::Given(vec![WindowSpec::new((5.0, 25.0), grid), WindowSpec::new((25.0, 200.0), grid)]),
        pressure_loss: 1e-7,
        evidence: 0,
        seed: 3,
        ..TrainingSpec::new(range, (5.0, 200.0), grid, plan)
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

/// Observer that cancels at a checkpoint and keeps the state written there, as after a crash.
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
}

impl Observer for StopAt {
    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// Returns all parts of a model that its results depend on.
fn essence(model: &ReducedModel) -> Vec<String> {
    let window = |w: &Window| {
        let bases = format!("{:?} {:?}", w.snapshots, w.pressure.basis().modes);
        format!("{bases} {:?} {:?} {:?}", w.sampled_rows, w.reconstruction, w.calibration)
    };
    model.windows.iter().map(window).chain(model.log.iter().cloned()).collect()
}

fn stopped_and_resumed_is_the_same(spec: &TrainingSpec, stops: &[usize]) {
    let mut reference = TrainingState::new(spec.clone());
    let whole = train_resumable(&mut reference, &()).unwrap();
    for &solutions in stops {
        let stop = StopAt { solutions, stopped: AtomicBool::new(false), written: Mutex::new(None) };
        let mut state = TrainingState::new(spec.clone());
        assert_eq!(train_resumable(&mut state, &stop).unwrap_err(), TrainingError::Cancelled, "{solutions}");
        let crashed = stop.written.into_inner().unwrap().unwrap();
        for mut state in [state, crashed] {
            assert!(state.solutions() >= solutions);
            let before: Vec<_> = state.windows.iter().flat_map(|w| &w.solved).map(|s| s.point).collect();
            // Through bytes, as stored in a file.
            let bytes = postcard::to_allocvec(&state).unwrap();
            state = postcard::from_bytes(&bytes).unwrap();
            let resumed = train_resumable(&mut state, &()).unwrap();
            assert!(essence(&resumed) == essence(&whole), "stopped after {solutions}");
            let kept = |point| state.windows.iter().flat_map(|w| &w.solved).any(|s| s.point == point);
            assert!(before.into_iter().all(kept));
            assert!(state == reference, "stopped after {solutions}");
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
fn windows_around_anchors_resume_at_every_stage() {
    let spec = oils(Sampling::QDeim, 40);
    stopped_and_resumed_is_the_same(&spec, &[1, 50, 70]);
    let stop = StopAt { solutions: 48, stopped: AtomicBool::new(false), written: Mutex::new(None) };
    let mut state = TrainingState::new(spec);
    assert_eq!(train_resumable(&mut state, &stop).unwrap_err(), TrainingError::Cancelled);
    assert!(state.windows.is_empty() && !state.trials[0].pending.is_empty());
    assert_eq!(state.model(&()).unwrap().windows.len(), 3);
}

/// The small box with automatic local models of few modes, which must be split.
fn automatic(plan: Plan, modes: usize) -> TrainingSpec {
    TrainingSpec { windows: Windows::Automatic { modes }, pressure_loss: 1e-4, ..small(plan) }
}

#[test]
fn automatic_windows_are_split_and_share_solutions() {
    let mut state = TrainingState::new(automatic(Plan::FarthestPoint { snapshots: 30 }, 12));
    let model = train_resumable(&mut state, &()).unwrap();
    assert!(model.windows.len() >= 2, "{:?}", model.log);
    assert!(model.windows.windows(2).all(|pair| pair[0].m.1 == pair[1].m.0));
    let domain = &model.domain;
    let (first, last) = (model.windows.first().unwrap(), model.windows.last().unwrap());
    assert!(first.m.0 <= domain.m().0 && last.m.1 >= domain.m().1);
    for (k, window) in model.windows.iter().enumerate() {
        assert_eq!(window.grid.spec(), first.grid.spec());
        assert!(window.snapshots.iter().all(|s| state.windows[k].solved.iter().any(|known| known.point == s.point)));
    }
    let mut points: Vec<_> = model.windows.iter().flat_map(|w| &w.snapshots).map(|s| s.point.quantities()).collect();
    let with_shared = points.len();
    points.sort_by(|a, b| a.iter().map(|v| v.to_bits()).cmp(b.iter().map(|v| v.to_bits())));
    points.dedup();
    assert!(points.len() < with_shared && points.len() <= state.solutions());
    for said in ["Grid: inlet", "split at"] {
        assert!(model.log.iter().any(|line| line.contains(said)), "{said}: {:?}", model.log);
    }
}

#[test]
fn automatic_windows_resume_too_even_from_their_trials() {
    // 12 solutions per inlet are tried first, then 48 on each of two grids: stops during the trials and after a split.
    let spec = automatic(Plan::FarthestPoint { snapshots: 30 }, 12);
    let mut state = TrainingState::new(spec.clone());
    train_resumable(&mut state, &()).unwrap();
    assert!(state.windows.len() > 1);
    stopped_and_resumed_is_the_same(&spec, &[30, state.solutions()]);
}

#[test]
fn a_training_stopped_in_its_trials_has_no_model() {
    let stop = StopAt { solutions: 1, stopped: AtomicBool::new(false), written: Mutex::new(None) };
    let mut state = TrainingState::new(automatic(Plan::FarthestPoint { snapshots: 30 }, 12));
    train_resumable(&mut state, &stop).unwrap_err();
    assert!(state.model(&()).unwrap_err().to_string().starts_with("0 full solutions in the first window"));
}

#[test]
fn failed_full_solves_name_their_point_and_keep_the_others() {
    // Films too thin for this grid at M above a few hundred.
    let mut spec = small(Plan::FarthestPoint { snapshots: 60 });
    spec.range = moes((20.0, 50_000.0), (0.05, 2.5), 1e12);
    let grid = GridSpec::Uniform { dx: 0.04, domain: (-4.0, 2.0) };
    spec.windows = Windows::Given(vec![WindowSpec::new((20.0, 50_000.0), grid)]);
    let mut state = TrainingState::new(spec);
    let error = train_resumable(&mut state, &()).unwrap_err();
    let TrainingError::NotConverged { m, .. } = error else { panic!("{error}") };
    assert!(m > 20.0 && error.to_string().contains(&format!("M = {m:.4}")), "{error}");
    assert!(state.solutions() > 0 && state.windows[0].solved.len() == state.solutions());
    if state.solutions() >= 4 {
        assert_eq!(state.model(&()).unwrap().windows[0].snapshots.len(), state.solutions());
    }
}

#[test]
fn a_range_that_holds_no_contact_is_refused_with_a_sentence() {
    let nowhere = moes((400.0, 500.0), (19.0, 20.0), 1e6);
    let one_point = moes_with((20.0, 20.0), (19.0, 19.0), (5e-9, 5e-9), 1e10);
    let plan = Plan::FarthestPoint { snapshots: 8 };
    let given = |m| Windows::Given(vec![WindowSpec::new(m, GridSpec::EXPLORER)]);
    for (range, windows, holds) in [
        (&nowhere, given((400.0, 500.0)), "holds 0"),
        (&nowhere, Windows::Automatic { modes: 90 }, "holds 0"),
        (&one_point, given((10.0, 30.0)), "holds 1"),
        (&one_point, Windows::Automatic { modes: 90 }, "holds 1"),
    ] {
        let spec = TrainingSpec { range: range.clone(), windows, ..small(plan.clone()) };
        let sentence = train(&spec, &()).unwrap_err().to_string();
        assert!(sentence.contains(holds) && sentence.contains("at least 4"), "{sentence}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for spec in
        [small(adaptive(vec![3e-3], 20)), small(pool(3e-3, 20)), automatic(Plan::FarthestPoint { snapshots: 30 }, 12)]
    {
        let spec = TrainingSpec { evidence: 100, ..spec };
        let (a, b) = (one.install(|| train(&spec, &()).unwrap()), three.install(|| train(&spec, &()).unwrap()));
        assert!(essence(&a) == essence(&b));
    }
}

#[test]
fn a_tolerance_that_cannot_be_met_ends_at_the_limit_and_is_said() {
    for plan in [adaptive(vec![1e-2, 1e-12], 12), pool(1e-12, 12)] {
        let model = train(&small(plan), &()).unwrap();
        assert!(model.windows.iter().all(|w| w.snapshots.len() == 12));
        assert!(model.log.iter().any(|line| line.contains("tolerance 1e-12 was not met")), "{:?}", model.log);
    }
}

#[test]
fn a_training_that_is_stopped_still_gives_a_model() {
    let stop = StopAt { solutions: 5, stopped: AtomicBool::new(false), written: Mutex::new(None) };
    let mut state = TrainingState::new(small(adaptive(vec![1e-3], 30)));
    train_resumable(&mut state, &stop).unwrap_err();
    struct Count(AtomicUsize);
    impl Observer for Count {}
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
fn barely_started_windows_are_left_out_of_the_model() {
    let mut state = TrainingState::new(small(adaptive(vec![1e-2], 30)));
    train_resumable(&mut state, &()).unwrap();
    state.windows[1].solved.truncate(2);
    let model = state.model(&()).unwrap();
    assert_eq!((model.windows.len(), model.domain.m().1), (1, 25.0));
    state.windows[0].solved.truncate(2);
    assert!(state.model(&()).unwrap_err().to_string().starts_with("2 full solutions in the first window"));
}

#[test]
fn plans_that_make_no_sense_are_refused_with_a_sentence() {
    let message = |plan| train(&small(plan), &()).unwrap_err().to_string();
    assert!(message(adaptive(vec![], 20)).contains("tolerances"));
    assert!(message(adaptive(vec![1e-3, 1e-2], 20)).contains("descending"));
    assert!(message(adaptive(vec![f64::NAN], 20)).contains("finite"));
    assert!(message(adaptive(vec![1e-3], 3)).contains("`plan.limit` is 3"));
    assert!(
        message(Plan::WorstOfPool {
            start: 6,
            indicator: Indicator::Residual,
            pool: 2,
            per_round: 3,
            tolerance: 1.0,
            limit: 9
        })
        .contains("`plan.per_round` is 3")
    );
    let few = train(&automatic(pool(1e-3, 20), 2), &()).unwrap_err().to_string();
    assert!(few.contains("`windows.modes` is 2"), "{few}");
}
