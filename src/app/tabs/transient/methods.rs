//! Form of the methods of a transient contact: the full system, which trains and checks the models, the reduced and
//! the linearised model with their settings, and their training inputs.

use crate::app::controls::heading;
use crate::app::form::{Form, choose};
use crate::app::numbers;
use crate::app::tabs::transient::method::{RULES, WEIGHTINGS, rule_name, weighting_name};
use crate::app::units;
use crate::scene::{Drive, LinearisedTransient, ModelSource, ReducedTransient, TransientStudy};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::reduced::tpwl::Weighting;
use egui::{Checkbox, Ui};

/// Draws the choice of all methods.
pub fn ui(ui: &mut Ui, form: &mut Form<'_>, study: &mut TransientStudy, kind: ContactKind) {
    heading(ui, "Methods");
    let tip = if kind.is_line() {
        "Always run: it trains the models and checks them"
    } else {
        "Always run: it checks the models"
    };
    ui.add_enabled(false, Checkbox::new(&mut true, "Full system")).on_disabled_hover_text(tip);
    let mut on = study.reduced.is_some();
    let tip = "Solves the nonlinear equations in a reduced space, with sampled equations (RNSA); trained beforehand";
    if ui.add(Checkbox::new(&mut on, "Reduced model")).on_hover_text(tip).changed() {
        study.reduced = on.then(ReducedTransient::embedded);
        form.changed = Some("Methods");
    }
    if let Some(reduced) = &mut study.reduced {
        reduced_ui(ui, form, reduced, kind);
    } else if kind.is_point() {
        study.linearised = None;
    }
    if kind.is_line() || study.reduced.is_some() {
        linearised_ui(ui, form, study, kind);
    }
    form.message(ui, "Methods");
    trainings_ui(ui, form, study, kind);
}

/// Draws where the reduced model comes from, and the settings of its training.
fn reduced_ui(ui: &mut Ui, form: &mut Form<'_>, reduced: &mut ReducedTransient, kind: ContactKind) {
    match &reduced.model {
        Some(ModelSource::File(path)) => _ = ui.weak(format!("The model {}", path.display())),
        Some(ModelSource::Trained(path)) => _ = ui.weak(format!("The model that {} trains", path.display())),
        Some(ModelSource::Embedded) | None => {
            let (was, mut embedded) = (reduced.is_embedded(), reduced.is_embedded());
            choose(
                ui,
                "Its training",
                "Where the reduced model comes from",
                &mut embedded,
                &[true, false],
                |embedded| {
                    if embedded {
                        ("Built in", "The model of the program if its range contains the run; otherwise one is trained")
                    } else {
                        (
                            "For this contact",
                            "Trained when the run starts; for a circular contact this takes about a minute",
                        )
                    }
                },
            );
            if embedded != was {
                *reduced = if embedded { ReducedTransient::embedded() } else { ReducedTransient::trained(kind) };
                form.changed = Some("Methods");
            }
        }
    }
    let plain = QuantityKind::Number;
    if let Some(responses) = &mut reduced.responses {
        let relative = "relative to the contact of the sliders";
        let [(load_low, load_high), (speed_low, speed_high)] =
            [&mut responses.load, &mut responses.speed].map(|r| (&mut r.0, &mut r.1));
        form.row(ui, "Smallest load", plain, load_low, &format!("Start of the trained range, {relative}"));
        form.row(ui, "Largest load", plain, load_high, &format!("End of the trained range, {relative}"));
        form.row(ui, "Smallest speed", plain, speed_low, &format!("Start of the trained range, {relative}"));
        form.row(ui, "Largest speed", plain, speed_high, &format!("End of the trained range, {relative}"));
        form.row(ui, "Shortest period", plain, &mut responses.shortest_period, "Of load and speed, in units of a/u_m");
        form.count(ui, "Pressure modes", &mut responses.modes, "A wider range needs more");
        form.row(ui, "Rows per mode", plain, &mut responses.rows_per_mode, "Sampled equations per pressure mode");
    } else if reduced.model.is_none() {
        form.row(ui, "Loss", plain, &mut reduced.loss, "Loss of information of the bases (2.90)");
        form.row(ui, "Rows per mode", plain, &mut reduced.rows_per_mode, "Sampled equations per pressure mode");
    }
}

/// Draws the settings of the linearised model.
pub fn linearised_ui(ui: &mut Ui, form: &mut Form<'_>, study: &mut TransientStudy, kind: ContactKind) {
    let mut on = study.linearised.is_some();
    let tip = "Superposes systems linearised about trained states (TPWL, 4.27): one small linear system per step; in \
               the fixed frame";
    if ui.add(Checkbox::new(&mut on, "Linearised model")).on_hover_text(tip).changed() {
        study.linearised = on.then(|| LinearisedTransient::usual(kind));
        form.changed = Some("Methods");
    }
    let Some(linearised) = &mut study.linearised else { return };
    let tip = if kind.is_line() {
        "Pressure modes of its space; fewer than 85 cost accuracy"
    } else {
        "Pressure modes of its space, at most those of the reduced model"
    };
    form.count(ui, "Modes", &mut linearised.modes, tip);
    let own = RULES.iter().position(|rule| rule.name() == linearised.selection.name()).unwrap_or(0);
    let mut rule = own;
    choose(ui, "Operating points", "Selection of the trained states for linearisation", &mut rule, &[0, 1], |k| {
        rule_name(RULES[k])
    });
    if rule != own {
        linearised.selection = RULES[rule];
        form.changed = Some("Operating points");
    }
    form.message(ui, "Operating points");
    let mut by_number = linearised.points.is_some();
    choose(ui, "How many", "Criterion for the number of points", &mut by_number, &[false, true], |by_number| {
        if by_number {
            ("A given number", "The tolerance is chosen to give about this number")
        } else {
            ("By tolerance", "The number follows from the tolerance")
        }
    });
    if by_number != linearised.points.is_some() {
        linearised.points = by_number.then_some(100);
        form.changed = Some("How many");
    }
    form.message(ui, "How many");
    match &mut linearised.points {
        Some(points) => {
            form.count(ui, "Points", points, "Number of operating points of all training trajectories together")
        }
        None => {
            let mut tolerance = linearised.selection.tolerance();
            form.row(
                ui,
                "Tolerance β",
                QuantityKind::Number,
                &mut tolerance,
                "Tolerance of the rule; half the value gives about twice the points",
            );
            linearised.selection = linearised.selection.with_tolerance(tolerance);
        }
    }
    let mut chosen = linearised.weightings.clone();
    for weighting in WEIGHTINGS {
        let (name, meaning) = weighting_name(weighting);
        let mut on = chosen.contains(&weighting);
        ui.horizontal(|ui| {
            ui.add_space(18.0);
            if ui.checkbox(&mut on, name).on_hover_text(meaning).changed() {
                form.changed = Some("Weights");
                let wanted = |w: &Weighting| if *w == weighting { on } else { chosen.contains(w) };
                chosen = WEIGHTINGS.into_iter().filter(wanted).collect();
            }
        });
    }
    if chosen.is_empty() {
        form.refused = Some(("Weights", "at least one kind of weights is needed"));
    } else {
        linearised.weightings = chosen;
    }
    form.message(ui, "Weights");
    if !linearised.further.is_empty() {
        let count = linearised.further.len();
        let rules = if count == 1 { "rule" } else { "rules" };
        ui.weak(format!("Headless runs also compare {count} further {rules}."));
    }
}

/// Draws the training inputs of the models: the run itself, or other inputs that were stored for it.
pub fn trainings_ui(ui: &mut Ui, form: &mut Form<'_>, study: &mut TransientStudy, kind: ContactKind) {
    if !study.trains(kind) {
        return;
    }
    let own = study.trains_on_itself(kind);
    let contacts = study.training_loads.len().max(study.training_contacts.len()).max(1);
    ui.label(match study.trainings.len().max(1) * contacts {
        _ if own => "Trained on the run itself.".to_owned(),
        1 => "Trained on other inputs.".to_owned(),
        count => format!("Trained on {count} other inputs."),
    });
    if !study.training_loads.is_empty() {
        let loads =
            study.training_loads.iter().map(|load| numbers::load(*load, ContactKind::Line, units::system(ui.ctx())));
        ui.weak(format!("At reference loads of {}.", loads.collect::<Vec<_>>().join(", ")));
    }
    if !study.training_contacts.is_empty() {
        let contacts = study.training_contacts.iter().map(|(m, l)| format!("M {m}, L {l}"));
        ui.weak(format!("At reference contacts of {}.", contacts.collect::<Vec<_>>().join("; ")));
    }
    ui.horizontal(|ui| {
        let tip = "Stores the present inputs as a training trajectory. Then change the inputs to test the models";
        if ui.button("Train on these inputs").on_hover_text(tip).clicked() {
            let (inputs, duration) = (study.inputs.clone(), study.duration);
            if !study.trainings.iter().any(|kept| kept.inputs == inputs && kept.duration == duration) {
                study.trainings.push(Drive { name: String::new(), inputs, duration });
                form.changed = Some("Methods");
            }
        }
        if !own && ui.button("On the run itself").on_hover_text("Discards the other inputs").clicked() {
            study.drop_trainings();
            form.changed = Some("Methods");
        }
    });
}
