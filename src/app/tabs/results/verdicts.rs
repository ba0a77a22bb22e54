//! Verdicts of a study: its expectations with the values found.

use super::run::Look;
use crate::app::controls::warning_ui;
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::scene::{Method, SceneOutcome, Verdict};
use egui::{Color32, Grid, ScrollArea, Ui};

/// Tooltip of an expectation without a value after the runs of the Transient tab.
const NOT_RUN: &str = "Run transient does not compute this value; Run the study does";

/// Returns whether all expectations are met. `None` before the runs are complete. `partial` is true for the runs of the
/// Transient tab, which leave out some comparisons: `None` if only their values are missing.
pub fn passed(look: &Look, partial: bool) -> Option<bool> {
    let outcome = &look.outcome;
    let left_out = partial && missing(outcome) > 0;
    let fails = |verdict: &Verdict| !verdict.holds && verdict.value.is_some();
    match look.complete {
        false => None,
        true if left_out && !outcome.verdicts.iter().any(fails) => None,
        true => Some(outcome.passed()),
    }
}

/// Returns the number of expectations without a value.
fn missing(outcome: &SceneOutcome) -> usize {
    outcome.verdicts.iter().filter(|verdict| verdict.value.is_none()).count()
}

/// Draws the verdicts, the warnings, and the values of a study without expectations.
pub fn ui(ui: &mut Ui, look: &Look, partial: bool) {
    let palette = Palette::of(ui);
    let outcome = &look.outcome;
    ScrollArea::vertical().id_salt("verdicts").auto_shrink(false).show(ui, |ui| {
        ui.strong("Expectations");
        let (text, hue) = summary(look, partial);
        ui.colored_label(hue(&palette), text);
        Grid::new("expectations").num_columns(3).striped(true).spacing([8.0, 3.0]).show(ui, |ui| {
            for verdict in &outcome.verdicts {
                let left_out = partial && look.complete && verdict.value.is_none();
                verdict_ui(ui, verdict, (look.complete, left_out), &palette);
            }
        });
        for warning in &outcome.found.warnings {
            warning_ui(ui, &warning.to_string());
        }
        if outcome.verdicts.is_empty() {
            ui.add_space(4.0);
            Grid::new("values").num_columns(2).striped(true).spacing([8.0, 3.0]).show(ui, |ui| {
                for value in &outcome.found.values {
                    ui.label(of_method(&value.name, value.method.as_ref()));
                    ui.label(numbers::counted(value.value));
                    ui.end_row();
                }
            });
        }
    });
}

/// Colour of a sentence.
type Hue = fn(&Palette) -> Color32;

/// Returns the verdict on all expectations in one sentence, with its colour.
fn summary(look: &Look, partial: bool) -> (String, Hue) {
    const QUIET: Hue = |palette| palette.quiet;
    const GOOD: Hue = |palette| palette.verified;
    const SHORT: Hue = |palette| palette.warning;
    let outcome = &look.outcome;
    let (all, missing) = (outcome.verdicts.len(), if partial { missing(outcome) } else { 0 });
    let held = outcome.verdicts.iter().filter(|verdict| verdict.holds).count();
    match (look.complete, all) {
        (false, _) => (format!("Not complete yet: {} rows", look.rows), QUIET),
        (true, 0) if outcome.passed() => ("The scene expects nothing; all converged".to_owned(), GOOD),
        (true, 0) => ("Some solves did not converge".to_owned(), SHORT),
        (true, all) if outcome.passed() => (format!("All {all} hold"), GOOD),
        (true, all) if held == all => ("All hold, but some solves did not converge".to_owned(), SHORT),
        (true, all) if missing > 0 => {
            let hue = if held + missing == all { QUIET } else { SHORT };
            (format!("{held} of {all} hold. Run the study computes {missing} more"), hue)
        }
        (true, all) => (format!("{held} of {all} hold"), SHORT),
    }
}

fn verdict_ui(ui: &mut Ui, verdict: &Verdict, (complete, left_out): (bool, bool), palette: &Palette) {
    let (mark, color) = match (verdict.holds, complete && !left_out) {
        (true, _) => ("holds", palette.verified),
        (false, true) => ("short", palette.warning),
        (false, false) => ("open", palette.quiet),
    };
    let expected = &verdict.expected;
    let mut tip = format!("Expected {}; {}", expected.wanted(), expected.from);
    if left_out {
        tip = format!("{tip}\n{NOT_RUN}");
    }
    ui.label(rich(mark, 11.0, color)).on_hover_text(&tip);
    ui.label(of_method(&expected.name, expected.method.as_ref())).on_hover_text(&tip);
    let value = verdict.value.map_or_else(|| "–".to_owned(), numbers::counted);
    ui.label(value).on_hover_text(tip);
    ui.end_row();
}

fn of_method(name: &str, method: Option<&Method>) -> String {
    method.map_or_else(|| name.to_owned(), |method| format!("{name}, {}", method.name()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Expectation, Within};

    fn look(values: &[(Option<f64>, bool)], complete: bool) -> Look {
        let verdict = |&(value, holds): &(Option<f64>, bool)| Verdict {
            expected: Expectation {
                name: "fixed.H_c.mean".to_owned(),
                method: None,
                value: None,
                within: Within::AtLeast(1.0),
                from: "a test".to_owned(),
            },
            value,
            holds,
        };
        let outcome = SceneOutcome { verdicts: values.iter().map(verdict).collect(), ..SceneOutcome::default() };
        Look::of(outcome, complete)
    }

    #[test]
    fn values_left_out_by_partial_runs_are_no_failures() {
        let (held, short, missing) = ((Some(2.0), true), (Some(0.5), false), (None, false));
        for (values, complete, partial, wanted, text) in [
            (vec![held, held], true, true, Some(true), "All 2 hold"),
            (vec![held, short], true, true, Some(false), "1 of 2 hold"),
            (vec![held, missing], true, true, None, "1 of 2 hold. Run the study computes 1 more"),
            (vec![short, missing], true, true, Some(false), "0 of 2 hold. Run the study computes 1 more"),
            (vec![held, missing], true, false, Some(false), "1 of 2 hold"),
            (vec![held, held], false, true, None, "Not complete yet: 0 rows"),
        ] {
            let look = look(&values, complete);
            assert_eq!(passed(&look, partial), wanted, "{values:?}");
            assert_eq!(summary(&look, partial).0, text);
        }
    }
}
