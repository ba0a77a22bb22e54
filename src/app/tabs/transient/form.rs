//! Form of the transient contact: the three inputs with a preview, duration, time steps and frames. Invalid entries
//! are refused next to their field.

use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::heading;
use crate::app::document::input::Input;
use crate::app::form::{Form, LastField, choose};
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::purpose::Purpose;
use crate::app::tabs::transient::method::{frame_meaning, frame_name};
use crate::app::tabs::transient::methods;
use crate::app::tabs::transient::shared::edit;
use crate::app::theme::Palette;
use crate::scene::TransientStudy;
use crate::solver::full::transient::{Frame, Inputs, Signal, TimeStep, Unsupported};
use crate::solver::physics::engineering::QuantityKind;
use egui::{Checkbox, Ui};
use egui_plot::{Line, LineStyle, PlotPoints};

/// Number of points of a curve of the preview.
const PREVIEW: usize = 400;

/// Names of the fields of one input.
struct Names {
    kind: &'static str,
    tip: &'static str,
    /// A and T_ex.
    one: [&'static str; 2],
    /// A₁, T₁, A₂, T₂.
    two: [&'static str; 4],
    steepness: &'static str,
}

/// Name of the only input that may change its sign.
const SPEED: &str = "Speed";

/// Builds the names of the fields from the name of the input.
macro_rules! names {
    ($kind:literal, $tip:literal) => {
        Names {
            kind: $kind,
            tip: $tip,
            one: [concat!($kind, " {A}"), concat!($kind, " {T_ex}")],
            two: [
                concat!($kind, " {A_1}"),
                concat!($kind, " {T_1}"),
                concat!($kind, " {A_2}"),
                concat!($kind, " {T_2}"),
            ],
            steepness: concat!($kind, " {s}"),
        }
    };
}

fn names(input: Input) -> Names {
    match input {
        Input::Load => names!("Load", "w over that of the sliders, as a function of time (2.20)"),
        Input::Speed => {
            names!("Speed", "u_m over that of the sliders, as a function of time (2.19); it may change its sign")
        }
        Input::Radius => names!("Radius", "R over that of the sliders, as a function of time (2.18)"),
    }
}

/// Draws the form. `last` is the field that was changed last.
pub fn ui(ui: &mut Ui, last: &mut LastField, context: &Context<'_>, commands: &mut Commands) {
    let mut read_table = false;
    let kind = context.document.point.kind;
    let point = kind.is_point();
    *last = edit(ui, ("transient", *last), context, commands, |ui, form, study| {
        heading(ui, "Inputs");
        for input in Input::ALL.into_iter().filter(|input| !(point && *input == Input::Radius)) {
            signal_ui(ui, form, (&names(input), point), input.of_mut(&mut study.inputs));
        }
        let tip = "A table with a title line: T and any of radius, speed, load, relative to the sliders, or with units: time [s]; load [N/mm]";
        read_table = ui.button("Inputs from CSV…").on_hover_text(tip).clicked();
        if let Some(path) = &study.sampled {
            ui.weak(format!("Every run reads its inputs from {}.", path.display()));
        }
        preview(ui, &study.inputs, study.duration);
        if !study.further.is_empty() {
            let names: Vec<&str> = study.further.iter().map(|drive| drive.name.as_str()).collect();
            ui.weak(format!("Headless runs follow further inputs too: {}.", names.join(", ")));
        }
        time_ui(ui, form, study);
        if !point {
            frames_ui(ui, form, &mut study.frames);
        }
        if let Some(why) = context.document.marches_in_full_only() {
            heading(ui, "Methods");
            ui.weak(why);
        } else {
            methods::ui(ui, form, study, kind);
        }
    });
    if !context.document.saves_transient() && context.document.transient.is_some() {
        ui.weak(match context.document.unsupported_in_time() {
            Some(Unsupported::MassConservingModel) => {
                "Models support cavitation by penalty and complementarity. With mass-conserving cavitation the scene \
                 is saved without this set-up."
            }
            _ => "The open scene has another study and is saved without this set-up.",
        });
    }
    if read_table {
        commands.push(Command::Ask(Purpose::Inputs));
    }
}

/// Kind of the function of time.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Constant,
    Harmonic,
    TwoScale,
    TriangleToSquare,
    Reversing,
    Sampled,
}

impl Kind {
    const GIVEN: [Self; 4] = [Self::Constant, Self::Harmonic, Self::TwoScale, Self::TriangleToSquare];

    fn of(signal: &Signal) -> Self {
        match signal {
            Signal::Constant => Self::Constant,
            Signal::Harmonic { .. } => Self::Harmonic,
            Signal::TwoScale { .. } => Self::TwoScale,
            Signal::TriangleToSquare { .. } => Self::TriangleToSquare,
            Signal::Reversing { .. } => Self::Reversing,
            Signal::Sampled { .. } => Self::Sampled,
        }
    }

    fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Constant => ("Constant", "The reference value"),
            Self::Harmonic => ("Harmonic", "1 + A sin(2π T/T_ex), (2.49)"),
            Self::TwoScale => ("Two-scale", "1 + A₁ sin(2π T/T₁) + A₂ sin(2π T/T₂), (4.33)"),
            Self::TriangleToSquare => {
                ("Triangle to square", "A triangle for s = 0, ever steeper flanks towards s = 1 (Fig. 4.16)")
            }
            Self::Reversing => ("Reversing", "A cos(2π T/T_ex): the speed falls to zero and changes its sign"),
            Self::Sampled => ("From a table", "Given values, joined by straight lines"),
        }
    }

    /// Returns a function of this kind with the amplitudes and periods of another one as far as it has them.
    fn signal(self, former: &Signal) -> Signal {
        let (amplitude, period) = match former {
            Signal::Harmonic { amplitude, period } | Signal::TriangleToSquare { amplitude, period, .. } => {
                (*amplitude, *period)
            }
            Signal::TwoScale { amplitudes, periods } => (amplitudes.0, periods.0),
            Signal::Reversing { period, .. } => (0.1, *period),
            Signal::Constant | Signal::Sampled { .. } => (0.1, 4.0),
        };
        match self {
            Self::Constant => Signal::Constant,
            Self::Harmonic => Signal::Harmonic { amplitude, period },
            Self::TwoScale => {
                Signal::TwoScale { amplitudes: (amplitude, 0.125 * amplitude), periods: (period, 0.0625 * period) }
            }
            Self::TriangleToSquare => Signal::TriangleToSquare { amplitude, period, s: 0.5 },
            Self::Reversing => Signal::Reversing { amplitude: 1.0, period },
            Self::Sampled => former.clone(),
        }
    }
}

/// Draws one input: the kind of function and its constants. The speed of a point contact cannot reverse.
fn signal_ui(ui: &mut Ui, form: &mut Form<'_>, (names, point): (&Names, bool), signal: &mut Signal) {
    let kind = Kind::of(signal);
    let mut wanted = kind;
    let mut options = Kind::GIVEN.to_vec();
    if names.kind == SPEED && !point {
        options.push(Kind::Reversing);
    }
    if matches!(kind, Kind::Sampled | Kind::Reversing) && !options.contains(&kind) {
        options.push(kind);
    }
    choose(ui, names.kind, names.tip, &mut wanted, &options, Kind::describe);
    if wanted != kind {
        *signal = wanted.signal(signal);
        form.changed = Some(names.kind);
    }
    form.message(ui, names.kind);
    const AMPLITUDE: &str = "Relative to the reference";
    const PERIOD: &str = "In units of a/u_m of the reference contact";
    let plain = QuantityKind::Number;
    match signal {
        Signal::Constant => {}
        Signal::Harmonic { amplitude, period } | Signal::Reversing { amplitude, period } => {
            form.row(ui, names.one[0], plain, amplitude, AMPLITUDE);
            form.row(ui, names.one[1], plain, period, PERIOD);
        }
        Signal::TwoScale { amplitudes, periods } => {
            form.row(ui, names.two[0], plain, &mut amplitudes.0, AMPLITUDE);
            form.row(ui, names.two[1], plain, &mut periods.0, PERIOD);
            form.row(ui, names.two[2], plain, &mut amplitudes.1, AMPLITUDE);
            form.row(ui, names.two[3], plain, &mut periods.1, PERIOD);
        }
        Signal::TriangleToSquare { amplitude, period, s } => {
            form.row(ui, names.one[0], plain, amplitude, AMPLITUDE);
            form.row(ui, names.one[1], plain, period, PERIOD);
            form.row(ui, names.steepness, plain, s, "0 is a triangle; at least 0 and below 1");
        }
        Signal::Sampled { times, .. } => {
            ui.weak(format!("{} values.", times.len()));
        }
    }
}

/// Draws the inputs against time. Line styles distinguish them without colour.
fn preview(ui: &mut Ui, inputs: &Inputs, duration: f64) {
    let palette = Palette::of(ui);
    let looks = [
        ("Load", palette.accent, LineStyle::Solid),
        ("Speed", palette.verified, LineStyle::dashed_loose()),
        ("Radius", palette.warning, LineStyle::dotted_dense()),
    ];
    let plot = axes::plot(ui, "transient inputs", 96.0, "", "")
        .paper_x("{T}")
        .paper_y("Input over its reference")
        .y_axis_min_width(36.0)
        // Leave space for the scroll bar of the form.
        .width(ui.available_width() - 14.0)
        .marks_x(4.0)
        .marks_y(2.0)
        .allow_zoom(false)
        .allow_drag(false)
        .include_y(0.95)
        .include_y(1.05)
        .auto_bounds(egui::Vec2b::TRUE)
        .set_margin_fraction(egui::vec2(0.0, 0.1));
    let mut named = Vec::new();
    axes::show(plot, ui, "Inputs against time", |plot| {
        for (input, (name, color, style)) in Input::ALL.into_iter().zip(looks) {
            let signal = input.of(inputs);
            let points: PlotPoints<'_> = (0..=PREVIEW)
                .map(|k| duration * k as f64 / PREVIEW as f64)
                .map(|time| [time, signal.at(time)])
                .collect();
            if *signal != Signal::Constant {
                named.push(Entry::new(name, color, Sample::of_line(style, 1.6)));
            }
            let width = if *signal == Signal::Constant { 0.8 } else { 1.6 };
            plot.line(Line::new(name, points).color(color).width(width).style(style).allow_band(false));
        }
    });
    if named.len() > 1 {
        key::ui(ui, named);
    }
}

fn time_ui(ui: &mut Ui, form: &mut Form<'_>, study: &mut TransientStudy) {
    heading(ui, "Time");
    let plain = QuantityKind::Number;
    form.row(ui, "Duration {T}", plain, &mut study.duration, "The last T, in units of a/u_m of the reference contact");
    study.window = study.window.filter(|window| window.1 <= study.duration);
    let mut rule = StepRule::of(study.time_step);
    let present = rule;
    choose(ui, "Steps", "Rule for the time steps", &mut rule, &StepRule::ALL, StepRule::words);
    if rule != present {
        study.time_step = rule.steps(study.time_step.longest(study.duration));
        form.changed = Some("Steps");
    }
    form.message(ui, "Steps");
    match &mut study.time_step {
        TimeStep::Fixed(step) => {
            form.row(ui, "Step {ΔT}", plain, step, "A twentieth of the shortest period is coarse, a hundredth fine");
        }
        TimeStep::Adaptive { tolerance, longest } => {
            let tip = "Permitted relative distance of P from its extrapolation";
            form.row(ui, "Tolerance", plain, tolerance, tip);
            form.row(ui, "Longest {ΔT}", plain, longest, "Maximum step, and the first one");
        }
        TimeStep::Controlled(tolerance) => {
            let tip = "Permitted relative error of H_c due to the time steps";
            form.row(ui, "Tolerance", plain, tolerance, tip);
        }
    }
}

/// Rule for the time step.
#[derive(Clone, Copy, PartialEq)]
enum StepRule {
    Equal,
    Adaptive,
    Controlled,
}

impl StepRule {
    const ALL: [Self; 3] = [Self::Equal, Self::Adaptive, Self::Controlled];

    fn of(time_step: TimeStep) -> Self {
        match time_step {
            TimeStep::Fixed(_) => Self::Equal,
            TimeStep::Adaptive { .. } => Self::Adaptive,
            TimeStep::Controlled(_) => Self::Controlled,
        }
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Equal => ("All the same", "The duration is divided evenly"),
            Self::Adaptive => {
                ("Adaptive", "Limited by the distance of the solution from the extrapolation of the previous two")
            }
            Self::Controlled => {
                ("By their error", "Limited by a tolerance for the estimated error of H_c; needs several runs")
            }
        }
    }

    /// Returns the time step by this rule, given its maximum.
    fn steps(self, longest: f64) -> TimeStep {
        match self {
            Self::Equal => TimeStep::Fixed(longest),
            Self::Adaptive => TimeStep::Adaptive { tolerance: 1e-3, longest },
            Self::Controlled => TimeStep::Controlled(0.01),
        }
    }
}

/// Draws the choice of frames. Each frame gives a separate run.
fn frames_ui(ui: &mut Ui, form: &mut Form<'_>, frames: &mut Vec<Frame>) {
    heading(ui, "Frames");
    for frame in Frame::ALL {
        let mut on = frames.contains(&frame);
        if ui.add(Checkbox::new(&mut on, frame_name(frame))).on_hover_text(frame_meaning(frame)).changed() {
            let chosen: Vec<Frame> =
                Frame::ALL.into_iter().filter(|f| if *f == frame { on } else { frames.contains(f) }).collect();
            if chosen.is_empty() {
                form.refused = Some(("Frames", "at least one frame is needed"));
            } else {
                *frames = chosen;
                form.changed = Some("Frames");
            }
        }
    }
    form.message(ui, "Frames");
}
