//! Test that a picture depends on its request alone. After a sequence of random changes the answer equals that of a
//! newly started program for the same document.

use super::Explorer;
use super::answers::PassedOver;
use super::answers::jobs::JobKind;
use super::answers::picture::Origin;
use super::command::Command;
use super::context::Commands;
use super::document::{Document, Edit, Shape};
use super::model_source::Models;
use crate::engine::Store;
use crate::host::clock::Stopwatch;
use crate::scene::named_lubricant::NAMED;
use crate::scene::{Scene, View};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::parameters::Quantity;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};
use egui_kittest::Harness;
use fastrand::Rng;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;
use std::time::Duration;

/// Number of changes of a sequence.
const CHANGES: usize = 10;
/// Maximum time for an answer.
const PATIENCE: Duration = Duration::from_secs(60);
/// Permitted relative difference of two answers to one request.
const SAME: f64 = 1e-6;
/// Coarse grids of point contacts. The last one is finer than the quick grid, so that a sketch is shown first.
const PLANES: [PointGridSpec; 3] = [
    PointGridSpec::uniform(0.08, 0.1, (-3.2, 1.6, -1.6)),
    PointGridSpec::uniform(0.06, 0.1, (-4.0, 2.0, -2.0)),
    PointGridSpec::uniform(0.04, 0.04, (-4.0, 2.0, -2.0)),
];

type Window = Harness<'static, Explorer>;

fn window(store: &Store) -> Window {
    let explorer = Explorer::with_models(Models::embedded(store), store.clone())
        .without_system_dialogs()
        .waiting_for_answers(PATIENCE);
    Harness::builder().with_size([900.0, 600.0]).build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer)
}

/// Gives a command as a panel does.
fn give(window: &mut Window, command: Command) {
    let ctx = window.ctx.clone();
    let mut commands = Commands::default();
    commands.push(command);
    window.state_mut().execute_all(&ctx, &mut commands);
}

fn edit(window: &mut Window, edit: Edit) {
    give(window, Command::Edit(edit, "test"));
}

/// Waits for the final answer to the document. Returns false if that takes too long.
fn rest(window: &mut Window) -> bool {
    let (begin, mut still) = (Stopwatch::start(), 0);
    while still < 3 {
        window.step();
        let desk = &window.state().desk;
        let answers = &desk.answers;
        let reduced = answers.current_picture().is_some_and(|picture| picture.origin != Origin::Full);
        let settled = reduced || answers.verify_failure().is_some() || !answers.is_quick();
        let there = answers.failure().is_some() || answers.picture_is_current() && settled;
        let runs = answers.coming() || answers.reads() || answers.runs(JobKind::Refine);
        still = if there && !runs && answers.is_answer_to(&desk.document) { still + 1 } else { 0 };
        if still == 0 {
            std::thread::sleep(Duration::from_millis(2));
        }
        if begin.elapsed() > PATIENCE {
            assert!(runs, "nothing runs, and there is no answer to {:?}", window.state().desk.document.key());
            return false;
        }
    }
    true
}

/// State that a window shows.
#[derive(Debug)]
struct Seen {
    numbers: Vec<f64>,
    reduced: bool,
    quick: bool,
    passed_over: Option<Discriminant<PassedOver>>,
}

fn seen(window: &Window) -> Seen {
    let answers = &window.state().desk.answers;
    let picture = answers.current_picture().filter(|_| answers.failure().is_none());
    let numbers = picture.map_or_else(Vec::new, |picture| {
        let s = &picture.solution.scalars;
        vec![s.h_c, s.h_min, s.p_c, s.p_max, s.h_0, picture.traction, picture.solution.x.len() as f64]
    });
    Seen {
        numbers,
        reduced: picture.is_some_and(|picture| picture.origin != Origin::Full),
        quick: picture.is_some() && answers.is_quick(),
        passed_over: answers.passed_over().map(discriminant),
    }
}

impl Seen {
    fn is(&self, other: &Self) -> bool {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME * a.abs().max(b.abs()) + 1e-12;
        self.numbers.len() == other.numbers.len()
            && self.numbers.iter().zip(&other.numbers).all(near)
            && (self.reduced, self.quick, self.passed_over) == (other.reduced, other.quick, other.passed_over)
    }
}

/// Range of the inlet film thickness relative to the film thickness of a formula.
const SUPPLIES: (f64, f64) = (0.2, 0.8);

/// Makes one change. Returns its description for the message of a failure.
fn change(rng: &mut Rng, window: &mut Window) -> String {
    let document = window.state().desk.document.clone();
    let lubricant = document.lubricant;
    let laws = |changed: Lubricant| Edit::Laws(Box::new(changed));
    let log = |rng: &mut Rng, low: f64, high: f64| low * (high / low).powf(rng.f64());
    let wanted = match rng.u8(..13) {
        0 => Edit::Shape(Shape::ALL[[0, 0, 1, 2][rng.usize(..4)]]),
        1 | 2 => Edit::Quantity(Quantity::M, log(rng, 8.0, 300.0)),
        3 => Edit::Quantity(Quantity::L, log(rng, 2.0, 15.0)),
        4 => Edit::Quantity(Quantity::SlideToRollRatio, [0.0, 0.1, 0.5][rng.usize(..3)]),
        5 | 6 => Edit::Heat(lubricant.heat.is_none()),
        7 | 8 => {
            let point = &document.point;
            let film_m = point.formula_film_m();
            let supply_film_m = rng.bool().then(|| film_m * log(rng, SUPPLIES.0, SUPPLIES.1));
            let cavitation = match rng.u8(..4) {
                0 => Cavitation::Penalty,
                1 => Cavitation::Complementarity,
                _ => Cavitation::MassConserving { supply_film_m },
            };
            laws(Lubricant { cavitation, ..lubricant })
        }
        9 => Edit::Named(&NAMED[rng.usize(..NAMED.len())]),
        10 => {
            let shear =
                if rng.bool() { ShearLaw::Newtonian } else { ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 } };
            laws(Lubricant { shear, ..lubricant })
        }
        11 => {
            let pressure_loss = rng.bool().then_some(1e-6);
            Edit::View(Box::new(View { pressure_loss, ..document.view.clone() }))
        }
        _ => match rng.u8(..4) {
            0 | 1 => {
                give(window, Command::Undo);
                return "undo".to_owned();
            }
            2 => {
                give(window, Command::Redo);
                return "redo".to_owned();
            }
            _ => {
                window.state_mut().desk.files.set_saved(document);
                let scene = opened(rng);
                give(window, Command::OpenScene(Arc::new(scene)));
                return "open".to_owned();
            }
        },
    };
    let said = format!("{wanted:?}");
    edit(window, wanted);
    said.chars().take(160).collect()
}

/// Returns a scene to be opened.
fn opened(rng: &mut Rng) -> Scene {
    let mut document = Document::default();
    document.set_shape(Shape::ALL[rng.usize(..2)]).unwrap();
    if rng.bool() {
        document.switch_heat(true).unwrap();
    }
    Scene { title: "another".to_owned(), ..document.to_scene() }
}

/// Returns the number of sequences. It is larger if the environment variable `EHL_LONG` is set.
fn sequences() -> u64 {
    if std::env::var_os("EHL_LONG").is_some() { 200 } else { 8 }
}

#[test]
fn requests_do_not_depend_on_earlier_ones() {
    let (used, fresh_store) = (Store::default(), Store::default());
    let (mut reduced, mut full, mut none) = (0, 0, 0);
    for seed in 0..sequences() {
        let mut rng = Rng::with_seed(seed);
        let mut dragged = window(&used);
        dragged.step();
        let mut changes = Vec::new();
        for _ in 0..CHANGES {
            changes.push(change(&mut rng, &mut dragged));
            let desk = &dragged.state().desk;
            if desk.document.point.kind.is_point() && !PLANES.contains(&desk.document.plane()) {
                edit(&mut dragged, Edit::Plane(PLANES[[0, 0, 0, 1, 1, 2][rng.usize(..6)]]));
            }
            dragged.step();
            if rng.u8(..3) == 0 {
                rest(&mut dragged);
            }
        }
        let in_time = rest(&mut dragged);
        let document = dragged.state().desk.document.clone();
        let mut fresh = window(&fresh_store);
        fresh.state_mut().desk.replace_document(document.clone());
        if !(in_time && rest(&mut fresh)) {
            none += 1;
            continue;
        }
        let (last, first) = (seen(&dragged), seen(&fresh));
        assert!(last.is(&first), "{seed}: {last:?}\n{first:?}\n{}\n{:?}", changes.join("\n"), document.key());
        match (first.numbers.is_empty(), first.reduced) {
            (true, _) => none += 1,
            (_, true) => reduced += 1,
            (_, false) => full += 1,
        }
    }
    println!("{reduced} reduced answers, {full} full ones, {none} contacts without");
    assert!(reduced + full > none);
}
