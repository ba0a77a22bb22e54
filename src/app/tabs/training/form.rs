//! Form of a training: presets, range, plan, reduction. Invalid entries are refused next to their field.

use super::tab::TrainingTab;
use crate::app::context::{Commands, Context};
use crate::app::controls::{heading, named};
use crate::app::document::Edit;
use crate::app::form::{Form, choose, row, short};
use crate::app::tabs::training::presets;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::parameters::{Axis, ParameterSpace, Quantity};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use crate::solver::reduced::{Sampling, Scheme};
use crate::solver::training::{Indicator, Plan, TrainingSpec, Windows};
use egui::{TextEdit, Ui};

/// Draws the form.
pub fn ui(ui: &mut Ui, tab: &mut TrainingTab, context: &Context<'_>, commands: &mut Commands) {
    let Some(before) = context.document.training_spec() else { return };
    let mut spec = before.clone();
    let mut form = Form::new("training", tab.last, context);
    ui.add_enabled_ui(tab.work.standing().is_none(), |ui| {
        ui.horizontal(|ui| {
            for (name, preset) in presets::of_kind(spec.contact()) {
                if ui.button(name).on_hover_text("Sets everything below").clicked() {
                    spec = preset.clone();
                    form.changed = Some("presets");
                }
            }
        });
        form.message(ui, "presets");
        title_ui(ui, &mut tab.title, &mut spec);
        range_ui(ui, &mut form, &mut spec);
        plan_ui(ui, &mut form, &mut spec);
        reduction_ui(ui, &mut form, &mut spec);
    });
    let law = context.document.lubricant.cavitation.name();
    ui.weak(format!("Cavitation: {law}, as chosen for the lubricant."));
    if spec.range != before.range {
        presets::fit_windows(&mut spec);
    }
    let edit = (spec != *before).then(|| Edit::Training(Box::new(spec)));
    tab.last = form.ask(edit, "presets", commands);
    if !context.document.saves_training() && context.document.training.is_some() {
        ui.weak("The open scene has another study and is saved without this training.");
    }
}

/// Draws the title. It is submitted when the field loses the focus, so that not every letter is an edit to undo.
fn title_ui(ui: &mut Ui, typed: &mut Option<String>, spec: &mut TrainingSpec) {
    let tip = "Name of the model";
    row(ui, "Title", tip, |ui| {
        let mut text = typed.take().unwrap_or_else(|| spec.title.clone());
        let response = ui.add(TextEdit::singleline(&mut text).desired_width(f32::INFINITY));
        let response = named(ui, response, "Title of the model").on_hover_text(tip);
        if response.lost_focus() {
            spec.title = text;
        } else if response.has_focus() {
            *typed = Some(text);
        }
    });
}

/// Kind of a dimensionless number.
const PLAIN: QuantityKind = QuantityKind::Number;

fn range_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    heading(ui, "Range");
    let is_box = spec.range.is_si_box();
    let mut wanted = is_box;
    choose(ui, "Given by", "Range for which the model is trained", &mut wanted, &[true, false], |is_box| {
        if is_box {
            ("SI quantities", "A box of R, u_m, w and α, as Tables 3.1 and 3.4")
        } else {
            ("M, L, α, p_H", "All contacts with these numbers up to a Hertzian pressure")
        }
    });
    if wanted != is_box {
        spec.range = converted(spec);
        form.changed = Some("Given by");
    }
    form.message(ui, "Given by");
    let kind = spec.contact();
    let ParameterSpace { axes, limits, fixed, constants } = &mut spec.range;
    for axis in axes {
        quantity_ui(ui, form, (axis.quantity, kind), &mut axis.ends);
    }
    for (quantity, ends) in limits {
        quantity_ui(ui, form, (*quantity, kind), ends);
    }
    for (quantity, value) in fixed {
        let tip = format!("{}, the same for the whole range", quantity.meaning(kind));
        form.row(ui, quantity.field(), quantity.kind(kind), value, &tip);
    }
    for axis in constants {
        quantity_ui(ui, form, (axis.quantity, kind), &mut axis.ends);
    }
    ui.weak(described_windows(&spec.windows));
}

/// Draws the interval of a quantity for a kind of contact.
fn quantity_ui(ui: &mut Ui, form: &mut Form<'_>, (quantity, kind): (Quantity, ContactKind), ends: &mut (f64, f64)) {
    form.interval(ui, quantity.field(), quantity.kind(kind), ends, quantity.meaning(kind));
}

/// Returns the local models and the grid in one line.
fn described_windows(windows: &Windows) -> String {
    let given = match windows {
        Windows::Automatic { modes } => {
            return format!("Local models in M and grid: chosen by the training, at most {modes} modes each");
        }
        Windows::Anchored { count, modes, .. } => {
            return format!("{count} local models in (ln M, ln L), at most {modes} modes each");
        }
        Windows::Given(given) => given,
    };
    let ranges: Vec<String> = given.iter().map(|w| format!("{}…{}", short(w.m.0), short(w.m.1))).collect();
    let grid = given.first().map_or_else(String::new, |w| match w.grid {
        GridSpec::Graded { nodes, .. } => format!(", {nodes} graded nodes"),
        GridSpec::Following { .. } => ", nodes that follow the film".to_owned(),
        GridSpec::Uniform { dx, .. } => format!(", uniform grid of {dx}"),
        GridSpec::Plane(spec) => match spec.nodes() {
            Ok((nx, ny)) => format!(", {nx}×{ny} nodes"),
            Err(error) => format!(", {error}"),
        },
    });
    format!("Local models in M: {}{grid}", ranges.join(", "))
}

/// Returns a range of the other form that covers the same contacts as far as possible.
fn converted(spec: &TrainingSpec) -> ParameterSpace {
    let domain = spec.domain();
    let viscosity = domain.middle_viscosity_pa_s();
    let alpha = domain.interval(Quantity::Alpha).unwrap_or_default();
    let axis = |quantity, ends| Axis::new(quantity, ends);
    if !spec.range.is_si_box() {
        let mut space = ParameterSpace::of_tables(spec.contact());
        space.axes.retain(|axis| axis.quantity != Quantity::Alpha);
        space.axes.push(Axis::linear(Quantity::Alpha, alpha));
        space.fixed.retain(|(fixed, _)| *fixed != Quantity::Viscosity);
        return space.fixing([(Quantity::Viscosity, viscosity)]);
    }
    ParameterSpace::of([axis(Quantity::M, domain.m()), axis(Quantity::L, domain.l()), axis(Quantity::Alpha, alpha)])
        .limited([(Quantity::HertzPressure, (0.0, domain.highest_pressure_pa()))])
        .fixing([(Quantity::Viscosity, viscosity)])
}

/// Kind of plan.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Adaptive,
    Pool,
    Precomputed,
    Grid,
}

impl Kind {
    fn of(plan: &Plan) -> Self {
        match plan {
            Plan::Adaptive { .. } => Self::Adaptive,
            Plan::WorstOfPool { .. } => Self::Pool,
            Plan::FarthestPoint { .. } => Self::Precomputed,
            Plan::Grid { .. } => Self::Grid,
        }
    }

    fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Adaptive => (
                "Adaptive",
                "Section 3.1.3: starts with spread points, then looks for bad approximations and adds their full solutions",
            ),
            Self::Pool => ("Worst of a pool", "Judges a pool of random points in every round and adds the worst"),
            Self::Precomputed => ("Pre-computed", "Every next point is the one farthest from all others by (3.16)"),
            Self::Grid => ("Grid", "A tensor grid over the box, as in Table 3.2; needs a box of SI quantities"),
        }
    }

    /// Returns a plan of this kind with the settings of another plan that it also has.
    fn plan(self, start: usize, indicator: Indicator, tolerances: &[f64], limit: usize) -> Plan {
        let tolerance = tolerances.last().copied().unwrap_or(1e-3);
        match self {
            Self::Adaptive => Plan::Adaptive {
                start,
                indicator,
                tolerances: tolerances.to_vec(),
                successes: 100,
                local_sigma: 0.1,
                local_successes: 20,
                vicinity: 8,
                limit,
            },
            Self::Pool => Plan::WorstOfPool { start, indicator, pool: 300, per_round: 3, tolerance, limit },
            Self::Precomputed => Plan::FarthestPoint { snapshots: limit },
            Self::Grid => Plan::Grid { nodes: [3, 4, 5, 4] },
        }
    }
}

fn plan_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    heading(ui, "Plan");
    let kind = Kind::of(&spec.plan);
    let mut wanted = kind;
    let kinds = [Kind::Adaptive, Kind::Pool, Kind::Precomputed, Kind::Grid];
    choose(ui, "Full solutions", "Choice of the training contacts", &mut wanted, &kinds, Kind::describe);
    if wanted != kind {
        spec.plan = match &spec.plan {
            Plan::Adaptive { start, indicator, tolerances, limit, .. } => {
                wanted.plan(*start, *indicator, tolerances, *limit)
            }
            Plan::WorstOfPool { start, indicator, tolerance, limit, .. } => {
                wanted.plan(*start, *indicator, &[*tolerance], *limit)
            }
            Plan::FarthestPoint { snapshots } => {
                wanted.plan((*snapshots / 2).max(4), Indicator::Correction, &[1e-2, 3e-3, 1e-3], *snapshots)
            }
            Plan::Grid { .. } => wanted.plan(60, Indicator::Correction, &[1e-2, 3e-3, 1e-3], 120),
        };
        form.changed = Some("Full solutions");
    }
    form.message(ui, "Full solutions");
    let start_tip = "Contacts spread by (3.16) before the search, per local model";
    let limit_tip = "Maximum number of full solutions, per local model";
    match &mut spec.plan {
        Plan::FarthestPoint { snapshots } => {
            form.count(ui, "How many", snapshots, "Full solutions per local model");
        }
        Plan::Grid { nodes } => {
            for (name, n) in ["Nodes of {R}", "Nodes of {u_m}", "Nodes of {w}", "Nodes of {α}"].into_iter().zip(nodes)
            {
                form.count(ui, name, n, "Points along this quantity; w is spaced logarithmically");
            }
        }
        Plan::Adaptive { start, indicator, tolerances, successes, local_sigma, local_successes, vicinity, limit } => {
            form.count(ui, "Pre-computed", start, start_tip);
            form.count(ui, "At most", limit, limit_tip);
            indicator_ui(ui, form, indicator);
            ladder_ui(ui, form, tolerances);
            form.count(
                ui,
                "Good in a row",
                successes,
                "Consecutive good approximations of the global search (3.17) that end a tolerance level",
            );
            form.row(
                ui,
                "Local width {σ}",
                PLAIN,
                local_sigma,
                "Width of the local search (3.18), relative to the range",
            );
            form.count(
                ui,
                "Local good",
                local_successes,
                "Consecutive good approximations that end a local search; 0 omits it",
            );
            form.count(ui, "Vicinity", vicinity, "Candidates around a bad approximation; the worst is solved in full");
        }
        Plan::WorstOfPool { start, indicator, pool, per_round, tolerance, limit } => {
            form.count(ui, "Pre-computed", start, start_tip);
            form.count(ui, "At most", limit, limit_tip);
            indicator_ui(ui, form, indicator);
            form.row(
                ui,
                "Tolerance",
                PLAIN,
                tolerance,
                "The search ends when no contact of a pool has a larger indicator",
            );
            form.count(ui, "Pool", pool, "Random contacts evaluated per round");
            form.count(ui, "Per round", per_round, "Number of worst contacts that are solved in full");
        }
    }
    let mut seed = usize::try_from(spec.seed).unwrap_or(usize::MAX);
    form.count(ui, "Seed", &mut seed, "Seed of all random numbers; the same seed gives the same model");
    spec.seed = seed as u64;
}

fn indicator_ui(ui: &mut Ui, form: &mut Form<'_>, indicator: &mut Indicator) {
    let before = *indicator;
    let options = [Indicator::Correction, Indicator::Residual, Indicator::Dissertation];
    choose(ui, "Judged by", "The indicator of a bad approximation", indicator, &options, |indicator| match indicator {
        Indicator::Correction => {
            ("Newton steps", "Relative change of film thickness and state in three Newton steps of the full system")
        }
        Indicator::Dissertation => (
            "Residual, 2-norm",
            "The dissertation's e_f^I: Euclidean norm, deformation modes in the state, the nearest snapshot as start",
        ),
        Indicator::Residual => {
            ("Residual", "Residual of the sampled equations, e_f^I (3.15), without full-size computations")
        }
    });
    if *indicator != before {
        form.changed = Some("Judged by");
    }
}

/// Draws the tolerances in descending order, each as a number field.
fn ladder_ui(ui: &mut Ui, form: &mut Form<'_>, tolerances: &mut Vec<f64>) {
    let tip = "Tolerances of the indicator, descending. A level ends after enough consecutive good approximations";
    row(ui, "Tolerances", tip, |ui| {
        ui.vertical(|ui| {
            for (k, tolerance) in tolerances.iter_mut().enumerate() {
                form.number(
                    ui,
                    "Tolerances",
                    &format!("Tolerance {}", k + 1),
                    tolerance,
                    PLAIN.unit(UnitSystem::Si),
                    tip,
                );
            }
            ui.horizontal(|ui| {
                let more = ui.small_button("+");
                let more = named(ui, more, "Add a tolerance").on_hover_text("Adds a tolerance of a third of the last");
                if more.clicked() {
                    tolerances.push(tolerances.last().map_or(1e-2, |last| last / 3.0));
                    form.changed = Some("Tolerances");
                }
                let fewer = ui.small_button("−");
                let fewer = named(ui, fewer, "Remove the last tolerance").on_hover_text("Removes the last tolerance");
                if fewer.clicked() {
                    tolerances.pop();
                    form.changed = Some("Tolerances");
                }
            });
        });
    });
    form.message(ui, "Tolerances");
}

/// Draws the choice of the online scheme.
fn scheme_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    let before = spec.scheme;
    let options = [
        Scheme::Galerkin,
        Scheme::LeastSquares { weighted: true },
        Scheme::LeastSquares { weighted: false },
        Scheme::Gnat { weighted: true },
        Scheme::Gnat { weighted: false },
    ];
    let tip = "Conditions that determine each step of the reduced iteration";
    choose(ui, "Scheme", tip, &mut spec.scheme, &options, |scheme| match scheme {
        Scheme::Galerkin => ("Galerkin", "The projection of the residual on the pressure modes vanishes"),
        Scheme::LeastSquares { weighted: true } => {
            ("Least squares, weighted", "Minimises the squared residuals, weighted by the first mode (D.10)–(D.13)")
        }
        Scheme::LeastSquares { weighted: false } => (
            "Least squares",
            "Minimises the squared residuals (2.68); the far inlet dominates, and with the penalty it fails",
        ),
        Scheme::Gnat { weighted: true } => (
            "GNAT, weighted",
            "Minimises the squared residuals reconstructed from two bases (2.80), weighted by the first mode",
        ),
        Scheme::Gnat { weighted: false } => {
            ("GNAT", "Minimises the squared residuals reconstructed from two bases (2.80)")
        }
    });
    if spec.scheme != before {
        form.changed = Some("Scheme");
    }
    form.message(ui, "Scheme");
}

fn reduction_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    heading(ui, "Reduction");
    let tip = "Share of the singular values that may be neglected";
    form.row(ui, "Pressure loss", PLAIN, &mut spec.pressure_loss, &format!("{tip} (2.92)"));
    form.row(ui, "Deformation loss", PLAIN, &mut spec.deformation_loss, &format!("{tip} (2.93)"));
    let before = spec.sampling;
    let options = [Sampling::QDeim, Sampling::Cubature, Sampling::Greedy, Sampling::All];
    choose(
        ui,
        "Sampling",
        "Method to select the sampled equations (hyper-reduction)",
        &mut spec.sampling,
        &options,
        |s| match s {
            Sampling::QDeim => ("Q-DEIM", "Pivoted QR selects the equations, a fixed matrix reconstructs the others"),
            Sampling::Cubature => ("Cubature", "Equations with non-negative weights that reproduce the Newton steps"),
            Sampling::Greedy => ("Greedy", "The dissertation’s choice, Fig. 2.9"),
            Sampling::All => ("All equations", "No sampling error, at the cost of the full size"),
        },
    );
    if spec.sampling != before {
        form.changed = Some("Sampling");
    }
    form.message(ui, "Sampling");
    scheme_ui(ui, form, spec);
    form.row(ui, "Rows per mode", PLAIN, &mut spec.rows_per_mode, "Sampled equations per pressure mode");
    let tip = "Penalty factor of (2.36) in the reduced equations; with few sampled equations of a point contact it \
               must be smaller than in the full system";
    form.row(ui, "Penalty {γ}", PLAIN, &mut spec.penalty, tip);
}
