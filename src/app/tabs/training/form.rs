//! The specification of a training as a form: presets, range, plan, reduction. What makes no sense is refused beside
//! its field.

use super::tab::TrainingTab;
use crate::app::context::{Commands, Context};
use crate::app::controls::{heading, named};
use crate::app::document::Edit;
use crate::app::form::{Form, choose, row, short};
use crate::app::tabs::training::presets;
use crate::scene::QuantityBox;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::{CIRCLES, Sampling, Scheme};
use crate::solver::training::{
    HeatedOilRange, HeatedRange, Indicator, OilRange, Plan, Range, SlidingOilRange, SlidingRange, TrainingSpec, Windows,
};
use egui::{TextEdit, Ui};

/// The form.
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
    ui.weak(format!("Films rupture by {law}, as chosen beside the lubricant."));
    if spec.range != before.range {
        presets::fit_windows(&mut spec);
    }
    let edit = (spec != *before).then(|| Edit::Training(Box::new(spec)));
    tab.last = form.ask(edit, "presets", commands);
    if !context.document.saves_training() && context.document.training.is_some() {
        ui.weak("The open scene asks another question: it is saved without this training.");
    }
}

/// The title, taken when it is left: not every letter is an edit to undo.
fn title_ui(ui: &mut Ui, typed: &mut Option<String>, spec: &mut TrainingSpec) {
    let tip = "What the model will be called";
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

/// Units with their size in SI units.
const PLAIN: (&str, f64) = ("", 1.0);
const ALPHA: (&str, f64) = ("1/GPa", 1e-9);
const VISCOSITY: (&str, f64) = ("mPa·s", 1e-3);
const GIGAPASCAL: (&str, f64) = ("GPa", 1e9);

fn range_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    heading(ui, "Range");
    let is_box = matches!(spec.range, Range::Box(_));
    let mut wanted = is_box;
    choose(ui, "Given by", "What the model shall be good for", &mut wanted, &[true, false], |is_box| {
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
    let (load_unit, load_tip) = match spec.contact() {
        ContactKind::Line => (("kN/m", 1e3), "Load per unit length (2.9)"),
        ContactKind::Point => (("N", 1.0), "Load (2.9)"),
    };
    let viscosity_tip = "Viscosity at ambient pressure, the same for the whole range";
    match &mut spec.range {
        Range::Box(QuantityBox { radius, speed, load, alpha, modulus, viscosity }) => {
            form.interval(ui, "Radius {R}", ("mm", 1e-3), radius, "Reduced radius of curvature (2.3)");
            form.interval(ui, "Speed {u_m}", ("m/s", 1.0), speed, "Mean entrainment speed (2.1)");
            form.interval(ui, "Load {w}", load_unit, load, load_tip);
            form.interval(ui, "Coefficient {α}", ALPHA, alpha, "Pressure–viscosity coefficient");
            form.row(ui, "Modulus {E'}", GIGAPASCAL, modulus, "Reduced modulus (2.5), the same for the whole range");
            form.row(ui, "Viscosity {η_0}", VISCOSITY, viscosity, viscosity_tip);
        }
        Range::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
            form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19)");
            form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19)");
            form.interval(ui, "Coefficient {α}", ALPHA, alpha, "Pressure–viscosity coefficient");
            form.row(ui, "Highest {p_H}", GIGAPASCAL, max_hertz_pressure, "Contacts beyond it are left out");
            form.row(ui, "Viscosity {η_0}", VISCOSITY, viscosity, viscosity_tip);
        }
        Range::Realisation { m, l, max_hertz_pressure } => {
            form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19)");
            form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19)");
            form.row(ui, "Highest {p_H}", GIGAPASCAL, max_hertz_pressure, "Contacts beyond it are left out");
        }
        Range::Ellipses { m, l, radius_ratio, max_hertz_pressure } => {
            form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19)");
            form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19)");
            form.interval(ui, "Ratio of radii {R_y}/{R}", PLAIN, radius_ratio, "1 is a circle");
            form.row(ui, "Highest {p_H}", GIGAPASCAL, max_hertz_pressure, "Contacts beyond it are left out");
        }
        Range::Oils(range) => oils(ui, form, range),
        Range::SlidingOils(SlidingOilRange { oils: range, srr, modulus, limit_slope, gradient_stress }) => {
            oils(ui, form, range);
            form.interval(ui, "Slide-to-roll ratio", PLAIN, srr, "Of oils that thin by Eyring’s law");
            let modulus_tip = "Reduced modulus (2.5) at the lubricant’s own Eyring stress: their product counts";
            form.interval(ui, "Modulus {E'}", GIGAPASCAL, modulus, modulus_tip);
            form.interval(ui, "Slope {Λ}", PLAIN, limit_slope, "Of limiting stresses that cut traction");
            let gradient_tip = "Thick films that the pressure’s gradient shears by more are left out";
            form.row(ui, "Gradient’s stress", ("MPa", 1e6), gradient_stress, gradient_tip);
        }
        Range::HeatedOils(HeatedOilRange { oils: range, srr, radius, modulus, speed, sliding_speed, thermal }) => {
            oils(ui, form, range);
            form.interval(ui, "Slide-to-roll ratio", PLAIN, srr, "Of contacts with heat");
            form.interval(ui, "Radius {R}", ("mm", 1e-3), radius, "Reduced radius of curvature (2.3)");
            form.interval(ui, "Modulus {E'}", GIGAPASCAL, modulus, "Reduced modulus (2.5)");
            form.interval(ui, "Mean speed {u_m}", ("m/s", 1.0), speed, "Faster and slower contacts are left out");
            form.row(ui, "Highest SRR {u_m}", ("m/s", 1.0), sliding_speed, "Contacts that slide faster are left out");
            if let Some(thermal) = thermal {
                let tip = "In front of the contact; errors are measured at any of them, and at other constants";
                form.interval(ui, "Inlet", ("K", 1.0), &mut thermal.inlet_temperature, tip);
            }
        }
        Range::Heated(HeatedRange { m, l, srr, max_hertz_pressure, .. }) => {
            form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19), by the load");
            form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19), by the speed");
            form.interval(ui, "Slide-to-roll ratio", PLAIN, srr, "Of contacts with heat");
            form.row(ui, "Highest {p_H}", GIGAPASCAL, max_hertz_pressure, "Contacts beyond it are left out");
        }
        Range::Sliding(SlidingRange { m, l, srr, npr, max_hertz_pressure, .. }) => {
            let ratio = "Of a shear-thinning lubricant";
            form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19)");
            form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19)");
            form.interval(ui, "Slide-to-roll ratio", PLAIN, srr, ratio);
            form.interval(ui, "Plateau ratio", PLAIN, npr, ratio);
            if let Some(limit) = max_hertz_pressure {
                form.row(ui, "Highest {p_H}", GIGAPASCAL, limit, "Contacts beyond it are left out");
            }
        }
    }
    ui.weak(described_windows(&spec.windows));
}

/// What a range of oils has with heat and without.
fn oils(ui: &mut Ui, form: &mut Form<'_>, range: &mut OilRange) {
    let OilRange { m, l, alpha, viscosity, exponent, hertz_pressure, radius_ratio, .. } = range;
    form.interval(ui, "Load number {M}", PLAIN, m, "Moes’ load number (3.19)");
    form.interval(ui, "Lubricant {L}", PLAIN, l, "Moes’ lubricant number (3.19)");
    form.interval(ui, "Coefficient {α}", ALPHA, alpha, "Pressure–viscosity coefficient");
    form.interval(ui, "Viscosity {η_0}", VISCOSITY, viscosity, "Viscosity at ambient pressure");
    form.interval(ui, "Exponent {z}", PLAIN, exponent, "Roelands’ exponent (2.12), which α and η₀ make");
    form.interval(ui, "Pressure {p_H}", GIGAPASCAL, hertz_pressure, "Hertzian pressure");
    if *radius_ratio != CIRCLES {
        form.interval(ui, "Ratio of radii {R_y}/{R}", PLAIN, radius_ratio, "1 is a circle");
    }
}

/// The windows of M in a line.
fn described_windows(windows: &Windows) -> String {
    let given = match windows {
        Windows::Automatic { modes } => {
            return format!("Windows of M and grid: chosen by the training, at most {modes} modes each");
        }
        Windows::Anchored { count, modes, .. } => {
            return format!("{count} windows around anchors in ln M and ln L, at most {modes} modes each");
        }
        Windows::Given(given) => given,
    };
    let ranges: Vec<String> = given.iter().map(|w| format!("{}…{}", short(w.m.0), short(w.m.1))).collect();
    let grid = given.first().map_or_else(String::new, |w| match w.grid {
        GridSpec::Graded { nodes, .. } => format!(", {nodes} graded nodes"),
        GridSpec::Uniform { dx, .. } => format!(", uniform grid of {dx}"),
        GridSpec::Plane(spec) => match spec.nodes() {
            Ok((nx, ny)) => format!(", {nx}×{ny} nodes"),
            Err(error) => format!(", {error}"),
        },
    });
    format!("Windows of M: {}{grid}", ranges.join(", "))
}

/// The same range, as far as it can be, given the other way.
fn converted(spec: &TrainingSpec) -> Range {
    let domain = spec.domain();
    match spec.range {
        Range::Box(QuantityBox { alpha, viscosity, .. }) => {
            Range::Moes { m: domain.m, l: domain.l, alpha, max_hertz_pressure: domain.max_hertz_pressure_pa, viscosity }
        }
        Range::Moes { viscosity, .. } | Range::Sliding(SlidingRange { viscosity, .. }) => {
            let table = QuantityBox::of_tables(spec.contact());
            Range::Box(QuantityBox { alpha: domain.alpha_per_pa, viscosity, ..table })
        }
        Range::Realisation { .. }
        | Range::Ellipses { .. }
        | Range::Oils(_)
        | Range::Heated(_)
        | Range::HeatedOils(_)
        | Range::SlidingOils(_) => Range::Box(QuantityBox {
            alpha: domain.alpha_per_pa,
            viscosity: domain.viscosity_pa_s,
            ..QuantityBox::of_tables(spec.contact())
        }),
    }
}

/// Which plan.
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

    /// A plan of this kind with as much of another as it can take over.
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
    choose(ui, "Full solutions", "Where they are taken", &mut wanted, &kinds, Kind::describe);
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
    let start_tip = "Spread by (3.16) before the search begins, per window";
    let limit_tip = "The search ends here at the latest, per window";
    match &mut spec.plan {
        Plan::FarthestPoint { snapshots } => {
            form.count(ui, "How many", snapshots, "Full solutions per window");
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
                "Good approximations of the global search (3.17) that end a rung",
            );
            form.row(ui, "Local width {σ}", PLAIN, local_sigma, "Of the local search (3.18), in widths of the range");
            form.count(
                ui,
                "Local good",
                local_successes,
                "Good ones in a row that end a local search; 0 leaves it out",
            );
            form.count(ui, "Vicinity", vicinity, "Candidates around a bad point of which the worst is solved in full");
        }
        Plan::WorstOfPool { start, indicator, pool, per_round, tolerance, limit } => {
            form.count(ui, "Pre-computed", start, start_tip);
            form.count(ui, "At most", limit, limit_tip);
            indicator_ui(ui, form, indicator);
            form.row(ui, "Tolerance", PLAIN, tolerance, "The search ends with a pool that has no worse point");
            form.count(ui, "Pool", pool, "Random points judged per round");
            form.count(ui, "Per round", per_round, "The worst that are solved in full");
        }
    }
    let mut seed = usize::try_from(spec.seed).unwrap_or(usize::MAX);
    form.count(ui, "Seed", &mut seed, "Of everything random: the same one gives the same model");
    spec.seed = seed as u64;
}

fn indicator_ui(ui: &mut Ui, form: &mut Form<'_>, indicator: &mut Indicator) {
    let before = *indicator;
    let options = [Indicator::Correction, Indicator::Residual, Indicator::Dissertation];
    choose(ui, "Judged by", "The indicator of a bad approximation", indicator, &options, |indicator| match indicator {
        Indicator::Correction => {
            ("Newton steps", "What three Newton steps of the full system change of film and state, relative")
        }
        Indicator::Dissertation => (
            "Residual, 2-norm",
            "The dissertation's e_f^I: Euclidean norm, deformation modes in the state, the nearest snapshot as start",
        ),
        Indicator::Residual => ("Residual", "The residual at the sampled rows, e_f^I (3.15): no large-scale work"),
    });
    if *indicator != before {
        form.changed = Some("Judged by");
    }
}

/// The tolerances, descending; each shown as a number of its own.
fn ladder_ui(ui: &mut Ui, form: &mut Form<'_>, tolerances: &mut Vec<f64>) {
    let tip = "On the indicator, descending: a rung ends with enough good approximations in a row";
    row(ui, "Tolerances", tip, |ui| {
        ui.vertical(|ui| {
            for (k, tolerance) in tolerances.iter_mut().enumerate() {
                form.number(ui, "Tolerances", &format!("Tolerance {}", k + 1), tolerance, 1.0, tip);
            }
            ui.horizontal(|ui| {
                let more = ui.small_button("+");
                let more = named(ui, more, "Add a tolerance").on_hover_text("One more, a third of the last");
                if more.clicked() {
                    tolerances.push(tolerances.last().map_or(1e-2, |last| last / 3.0));
                    form.changed = Some("Tolerances");
                }
                let fewer = ui.small_button("−");
                let fewer = named(ui, fewer, "Remove the last tolerance").on_hover_text("Leave the last out");
                if fewer.clicked() {
                    tolerances.pop();
                    form.changed = Some("Tolerances");
                }
            });
        });
    });
    form.message(ui, "Tolerances");
}

/// By what the online step is found.
fn scheme_ui(ui: &mut Ui, form: &mut Form<'_>, spec: &mut TrainingSpec) {
    let before = spec.scheme;
    let options = [
        Scheme::Galerkin,
        Scheme::LeastSquares { weighted: true },
        Scheme::LeastSquares { weighted: false },
        Scheme::Gnat { weighted: true },
        Scheme::Gnat { weighted: false },
    ];
    let tip = "By what each step of the reduced iteration is found";
    choose(ui, "Scheme", tip, &mut spec.scheme, &options, |scheme| match scheme {
        Scheme::Galerkin => ("Galerkin", "The rows tested by the pressure modes vanish"),
        Scheme::LeastSquares { weighted: true } => {
            ("Least squares, weighted", "The rows' squares are least, each weighted by the first mode (D.10)–(D.13)")
        }
        Scheme::LeastSquares { weighted: false } => (
            "Least squares",
            "The rows' squares are least (2.68): the far inlet counts most, and by the penalty it fails",
        ),
        Scheme::Gnat { weighted: true } => {
            ("GNAT, weighted", "The squares of what two bases make of the rows (2.80), weighted by the first mode")
        }
        Scheme::Gnat { weighted: false } => ("GNAT", "The squares of what two bases make of the sampled rows (2.80)"),
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
    choose(ui, "Rows by", "How rows of the Reynolds equation are sampled", &mut spec.sampling, &options, |s| match s {
        Sampling::QDeim => ("Q-DEIM", "Pivoted QR picks the rows, a fixed matrix reconstructs the rest"),
        Sampling::Cubature => ("Cubature", "Rows with non-negative weights that reproduce the Newton steps"),
        Sampling::Greedy => ("Greedy", "The dissertation’s choice, Fig. 2.9"),
        Sampling::All => ("All rows", "No sampling error, at large-scale cost"),
    });
    if spec.sampling != before {
        form.changed = Some("Rows by");
    }
    form.message(ui, "Rows by");
    scheme_ui(ui, form, spec);
    form.row(ui, "Rows per mode", PLAIN, &mut spec.rows_per_mode, "Sampled rows per pressure mode");
    let tip = "Penalty factor of (2.36) in the reduced equations; few rows of a point contact want it softer than the full system's";
    form.row(ui, "Penalty {γ}", PLAIN, &mut spec.penalty, tip);
}
