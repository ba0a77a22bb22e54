//! Every number that a built-in lesson states is compared with full solutions of its contacts.

use super::panel::LESSONS;
use crate::engine::{Answer, Store, Workbench};
use crate::scene::regime::Ratios;
use crate::scene::{Method, answer_or_full};
use crate::solver::physics::contact::FilmFormula;

/// Solves the contacts of a lesson. Returns the answers, and for the start and each step the index of its answer.
fn solved(number: usize) -> (Vec<Answer>, Vec<usize>) {
    let (keys, indices) = LESSONS[number].pictures().unwrap();
    let store = Store::default();
    let mut bench = Workbench::on(&store, "");
    let document = crate::app::document::Document::default();
    let solve = |key: &crate::app::document::Key| {
        answer_or_full(&mut bench, &key.request(document.grid, Method::Full), &()).unwrap()
    };
    (keys.iter().map(solve).collect(), indices)
}

/// Returns the value of a name in a check: a value of the result, a deviation of a formula, or a property of the
/// solution.
fn value(answer: &Answer, name: &str) -> f64 {
    let (result, solution) = (&answer.result, answer.fields().unwrap());
    let point = &result.point;
    let formula = FilmFormula::of(point.kind).iter().find(|formula| formula.name() == name);
    match (name, formula) {
        ("deformation", _) => Ratios::of(solution).deformation,
        ("viscosity", _) => Ratios::of(solution).viscosity,
        ("spike", _) => solution.spike().map_or(0.0, |(_, p)| p),
        ("x_spike", _) => solution.spike().unwrap().0,
        ("film_number", _) => result.value("h_c_m").unwrap() / (point.radius_m * point.speed_group().sqrt()),
        (_, Some(formula)) => {
            let own = result.value(if formula.predicts_minimum() { "h_min_m" } else { "h_c_m" }).unwrap();
            formula.predict(point).film_m / own - 1.0
        }
        _ => result.value(name).unwrap_or_else(|| panic!("{name} is no value of a result")),
    }
}

/// Checks one statement, `NAME [per NAME] [over start | over step N] between A and B`.
/// Returns what is wrong, if anything.
fn check(place: &str, words: &str, answers: &[Answer], indices: &[usize], step: usize) -> Option<String> {
    let (what, range) = words.split_once(" between ").unwrap_or_else(|| panic!("{place}: “{words}”"));
    let (low, high) = range.split_once(" and ").unwrap();
    let (low, high): (f64, f64) = (low.parse().unwrap(), high.parse().unwrap());
    let (what, base) = what.split_once(" over ").map_or((what, None), |(what, base)| (what, Some(base)));
    let of = |at: usize| {
        let answer = &answers[indices[at]];
        match what.split_once(" per ") {
            Some((a, b)) => value(answer, a) / value(answer, b),
            None => value(answer, what),
        }
    };
    let base = match base {
        None => 1.0,
        Some("start") => of(0),
        Some(step) => of(step.trim_start_matches("step ").parse().unwrap()),
    };
    let found = of(step) / base;
    // A wide range states nothing, unless it says that a value is small or a viscosity large.
    let narrow = high - low < 0.35 * high.abs().max(low.abs());
    assert!(what == "viscosity" || low <= 0.0 && high >= 0.0 || narrow, "{place}: {words}");
    (!(low..=high).contains(&found)).then(|| format!("{place}: {words}: {found}"))
}

#[test]
fn lessons_state_what_the_solver_computes() {
    let (mut checks, mut wrong) = (0, Vec::new());
    for (number, lesson) in LESSONS.iter().enumerate() {
        if lesson.steps.iter().all(|step| step.check.is_empty()) {
            continue;
        }
        let (answers, indices) = solved(number);
        for (k, step) in lesson.steps.iter().enumerate() {
            for words in step.check.split(',').map(str::trim).filter(|words| !words.is_empty()) {
                wrong.extend(check(&format!("{}: {}", lesson.title, step.title), words, &answers, &indices, k + 1));
                checks += 1;
            }
        }
        // Contacts of lessons are possible: steel carries a static load up to 4 GPa.
        for answer in &answers {
            let pressure = answer.result.value("hertz.p_h_pa").unwrap();
            assert!(pressure < 4e9, "{}: {pressure:e}", lesson.title);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(checks > 45, "{checks}");
}

#[test]
fn a_step_that_states_a_number_has_a_check() {
    for lesson in LESSONS.iter() {
        for step in &lesson.steps {
            assert!(!step.ask.is_empty(), "{}: {} has no question", lesson.title, step.title);
            let words = ["half", "third", "quarter", "fifth", "sixth", "twice", "doubled", "%"];
            let states = words.iter().any(|word| step.seen.contains(word));
            assert!(!states || !step.check.is_empty(), "{}: {}", lesson.title, step.title);
        }
    }
}

#[test]
fn a_worksheet_has_questions_space_and_solutions() {
    let number = LESSONS.iter().position(|lesson| lesson.title == "Starvation").unwrap();
    let (answers, indices) = solved(number);
    let (lesson, page) = (&LESSONS[number], LESSONS[number].worksheet(&answers, &indices));
    let (first, second) = page.split_once("class=\"solutions\"").unwrap();
    for step in &lesson.steps {
        assert!(first.contains(&step.ask) && !first.contains(&step.seen), "{}", step.title);
        assert!(second.contains(&step.title) && second.contains(&step.seen.replace('<', "&lt;")), "{}", step.title);
    }
    assert_eq!(first.matches("class=\"answer\"").count(), 2 * lesson.steps.len());
    assert_eq!((first.matches("<svg").count(), second.matches("<svg").count()), (2, 2 * lesson.steps.len()));
    assert!(!page.contains("**") && page.contains("<b>Starved inlet</b>"));
}
