//! Full solutions of random contacts on random grids compared with references on much finer grids. No error above
//! 5 % is without a warning, and few accurate solutions carry one. The ordinary run solves a share of them, a run with
//! `EHL_LONG` in the environment 2,000.

use crate::common::cases::{cases, long};
use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::{Bench, Grid, Method, ModelSource, Request, answer_or_full};
use ehl_explorer::solver::discrete::grid::{GridSpec, MAX_GRADED_NODES, PointGridSpec};
use ehl_explorer::solver::full::{ContactSolver, Solution, Start};
use ehl_explorer::solver::observer::{NewtonStep, Observer};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::engineering::Extent;
use ehl_explorer::solver::physics::lubricant::Lubricant;
use fastrand::Rng;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// An answer with a larger error needs a warning.
const WRONG: f64 = 0.05;
/// An answer with a smaller error should have no warning.
const RIGHT: f64 = 0.01;
/// Maximum discretisation error of a reference.
const NO_REFERENCE: f64 = 0.02;
/// Largest α p_H, twice that of the most heavily loaded contacts in practice.
const STIFFEST: f64 = 60.0;

/// Results of all cases.
#[derive(Default)]
struct Tally {
    counts: BTreeMap<&'static str, usize>,
    silent: Vec<String>,
}

impl Tally {
    fn add(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    fn of(&self, what: &str) -> usize {
        self.counts.get(what).copied().unwrap_or(0)
    }
}

/// Maximum number of Newton steps. Longer solves mostly have no solution, which is not a wrong one.
const PATIENCE: usize = 120;

#[derive(Default)]
struct Patience(AtomicUsize);

impl Observer for Patience {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) > PATIENCE
    }

    fn newton_step(&self, _: &NewtonStep) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }
}

fn between(rng: &mut Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(rng.f64())
}

fn solved(spec: GridSpec, point: &OperatingPoint) -> Option<Solution> {
    let mut solver = ContactSolver::on(&spec.build().ok()?);
    let solution = solver.solve(point, Lubricant::default(), Start::Cold, &Patience::default()).ok()?;
    Some(solver.judged(solution)).filter(Solution::converged)
}

/// Returns the program's own grid or a random one that a user might give.
fn drawn(rng: &mut Rng, point: &OperatingPoint) -> Option<GridSpec> {
    let own = GridSpec::explorer_for(point).ok()?;
    let inlet = -between(rng, 1.6, 12.0);
    Some(match (own, rng.u8(0..4)) {
        (_, 0) => own,
        (GridSpec::Plane(spec), 1) => {
            GridSpec::Plane(PointGridSpec { dx: 2.0 * spec.dx, dy: 2.0 * spec.dy, refinement: 1.0, ..spec })
        }
        (GridSpec::Plane(_), _) => {
            let (dx, dy) = (between(rng, 0.02, 0.1), between(rng, 0.05, 0.2));
            GridSpec::Plane(PointGridSpec::uniform(dx, dy, (inlet.max(-6.0), 2.0, (0.5 * inlet).clamp(-3.0, -1.2))))
        }
        (_, 1) => GridSpec::DISSERTATION,
        (GridSpec::Graded { nodes, domain, registered }, 2) => {
            GridSpec::Graded { nodes: nodes / rng.usize(2..6), domain, registered }
        }
        _ => GridSpec::Uniform { dx: between(rng, 2e-3, 0.09), domain: (inlet, 2.0) },
    })
}

/// Returns the program's own grid for a line contact with half the spacing in twice the domain. Point contacts have
/// equidistant grids with half the spacing, at least as fine and as large as the program's own grid.
fn reference(spec: GridSpec, point: &OperatingPoint) -> Option<GridSpec> {
    Some(match (GridSpec::explorer_for(point).ok()?, spec) {
        (GridSpec::Graded { nodes, domain, registered }, _) => GridSpec::Graded {
            nodes: (22 * nodes / 10).min(MAX_GRADED_NODES),
            domain: (2.0 * domain.0, 2.0 * domain.1),
            registered,
        },
        (GridSpec::Following { zone, finer, domain }, _) => {
            GridSpec::Following { zone, finer: 2.0 * finer, domain: (2.0 * domain.0, 2.0 * domain.1) }
        }
        (GridSpec::Plane(own), GridSpec::Plane(PointGridSpec { dx, dy, domain: (from, to, edge), .. })) => {
            let domain = (own.domain.0.min(from), own.domain.1.max(to), own.domain.2.min(edge));
            GridSpec::Plane(PointGridSpec::uniform(own.dx.min(0.5 * dx), own.dy.min(0.5 * dy), domain))
        }
        _ => return None,
    })
}

fn one(rng: &mut Rng, kind: ContactKind, m: (f64, f64), tally: &mut Tally) {
    let m = between(rng, m.0, m.1);
    let at = |l: f64| si_from_moes(&MoesRequest::new(kind, m, l)).ok();
    let Some(unit) = at(1.0) else { return tally.add("refused") };
    // α p_H is proportional to L.
    let l = between(rng, 0.1, (STIFFEST / (unit.alpha_per_pa * unit.hertz().pressure_pa)).clamp(0.2, 1e3));
    let Some(point) = at(l) else { return tally.add("refused") };
    let Some(spec) = drawn(rng, &point) else { return tally.add("refused") };
    let Some(answer) = solved(spec, &point) else { return tally.add("refused or not converged") };
    let truth = reference(spec, &point).and_then(|spec| solved(spec, &point));
    let truth = truth.filter(|truth| truth.grid_cost.is_some_and(|cost| cost.total() < NO_REFERENCE));
    let Some(truth) = truth else { return tally.add("without a reference") };
    let error = (answer.scalars.h_c / truth.scalars.h_c - 1.0).abs();
    let warning = answer.grid_warning();
    match (warning, error) {
        (None, error) if error > WRONG => {
            let case = format!("M {m}, L {l}, {spec:?}: H_c off by {error:.3}, {:?}", answer.grid_cost);
            println!("{case}");
            tally.silent.push(case);
        }
        (Some(_), error) if error < RIGHT => tally.add("right with a warning"),
        (None, error) if error < RIGHT => tally.add("right"),
        (Some(_), error) if error > WRONG => tally.add("wrong with a warning"),
        (Some(_), _) => tally.add("between with a warning"),
        (None, _) => tally.add("between"),
    }
}

fn judged(kind: ContactKind, seed: u64, cases: usize, m: (f64, f64)) {
    let (mut rng, mut tally) = (Rng::with_seed(seed), Tally::default());
    for case in 1..=cases {
        one(&mut rng, kind, m, &mut tally);
        if case % 10 == 0 || case == cases {
            println!("{case} {} contacts: {:?}, silent {}", kind.name(), tally.counts, tally.silent.len());
        }
    }
    assert!(tally.silent.is_empty(), "{:#?}", tally.silent);
    let (alarms, right) = (tally.of("right with a warning"), tally.of("right"));
    // With few cases none may be.
    assert!(alarms * 20 <= (right + alarms).max(20), "{alarms} of {} that are right carry a warning", right + alarms);
}

#[test]
fn no_line_contact_is_wrong_in_silence() {
    // The references of more lightly and more heavily loaded contacts take seconds.
    let m = if long() { (0.05, 1e5) } else { (1.0, 300.0) };
    judged(ContactKind::Line, 11, cases(8, 1900), m);
}

#[test]
fn no_point_contact_is_wrong_in_silence() {
    judged(ContactKind::Point, 12, cases(1, 100), if long() { (3.0, 2e3) } else { (20.0, 200.0) });
}

/// Outside its trained range a reduced model falls back to the full solver or warns, and no film thickness is negative.
fn reduced(kind: ContactKind, seed: u64, cases: usize, (m, l): ((f64, f64), (f64, f64))) {
    let mut rng = Rng::with_seed(seed);
    let mut bench = Workbench::new("");
    let mut counts: BTreeMap<&'static str, usize> = BTreeMap::new();
    for _ in 0..cases {
        let (m, l) = (between(&mut rng, m.0, m.1), between(&mut rng, l.0, l.1));
        let Ok(point) = si_from_moes(&MoesRequest::new(kind, m, l)) else { continue };
        let lubricant = Lubricant::default();
        let (grid, grid_model, method) = (Grid::Model, ModelSource::Embedded, Method::EMBEDDED);
        let request = Request { point, lubricant, grid, grid_model, method, extent: Extent::default() };
        let Ok(answer) = answer_or_full(&mut bench, &request, &()) else {
            *counts.entry("refused").or_default() += 1;
            continue;
        };
        let Some(own) = answer.fields() else {
            *counts.entry("not converged").or_default() += 1;
            continue;
        };
        assert!(own.film.iter().all(|h| *h > 0.0), "M {m}, L {l}: a film below zero is shown as converged");
        let what = match (answer.result.warnings.is_empty(), answer.result.reduced.is_some()) {
            (false, true) => "reduced with a warning",
            (false, false) => "handed over",
            (true, _) => {
                let full = bench.answer(&Request { method: Method::Full, ..request }, None, &()).unwrap();
                let truth = full.fields().expect("the reference converges").scalars.h_c;
                let error = (own.scalars.h_c / truth - 1.0).abs();
                assert!(error < 0.1, "M {m}, L {l}: H_c off by {error:.3} without a word");
                "right without a word"
            }
        };
        *counts.entry(what).or_default() += 1;
    }
    println!("{} {counts:?}", kind.name());
    assert!(counts.values().sum::<usize>() > 0);
}

#[test]
fn no_reduced_line_contact_is_wrong_in_silence() {
    reduced(ContactKind::Line, 13, cases(12, 400), ((0.3, 5e3), (0.2, 40.0)));
}

#[test]
fn no_reduced_point_contact_is_wrong_in_silence() {
    reduced(ContactKind::Point, 14, cases(3, 100), ((5.0, 2e3), (0.5, 30.0)));
}
