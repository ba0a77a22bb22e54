//! The reduced basis: how fast the singular values fall, what the tolerances keep, what the modes look like, where rows are sampled.

use super::axes;
use crate::app::export;
use crate::app::files::Purpose;
use crate::app::numbers;
use crate::app::state::State;
use crate::app::theme::Palette;
use crate::solver::grid::ContactGrid;
use crate::solver::reduced::{PodBasis, ReducedModel, Window};
use egui::{Align2, Color32, ComboBox, RichText, Ui};
use egui_plot::{
    Corner, HLine, Legend, Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, Points, Text, VLine,
};
use std::sync::Arc;

/// How near (in screen points) the pointer must be to take a tolerance along.
const GRAB: f32 = 9.0;
/// Modes drawn at once.
const SHOWN_MODES: usize = 4;
/// Smallest tolerance that can be dragged to, log10.
const LEAST_LOG_LOSS: f64 = -14.0;

/// Which of the two bases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Field {
    /// Pressure.
    #[default]
    Pressure,
    /// Deformation.
    Deformation,
}

impl Field {
    fn name(self) -> &'static str {
        match self {
            Self::Pressure => "Pressure",
            Self::Deformation => "Deformation",
        }
    }

    fn of(self, window: &Window) -> &PodBasis {
        match self {
            Self::Pressure => &window.pressure,
            Self::Deformation => &window.deformation,
        }
    }

    fn color(self, palette: &Palette) -> Color32 {
        match self {
            Self::Pressure => palette.pressure,
            Self::Deformation => palette.deformation,
        }
    }
}

/// State of the tab, with the curves of one window.
#[derive(Default)]
pub struct BasisView {
    field: Field,
    first_mode: usize,
    dragging: Option<Field>,
    curves: Option<Curves>,
}

struct Curves {
    window: usize,
    model: Arc<ReducedModel>,
    singular: [Vec<PlotPoint>; 2],
    loss: [Vec<PlotPoint>; 2],
    modes: Vec<(Field, usize, Vec<PlotPoint>)>,
    rows: Vec<PlotPoint>,
}

impl Curves {
    fn new(model: &Arc<ReducedModel>, at: usize, window: &Window) -> Self {
        let log = |values: &mut dyn Iterator<Item = f64>, from: usize| -> Vec<PlotPoint> {
            values
                .enumerate()
                .filter(|(_, v)| *v > 1e-17)
                .map(|(k, v)| PlotPoint::new((k + from) as f64, v.log10()))
                .collect()
        };
        let singular = |basis: &PodBasis| {
            let first = basis.singular_values.first().copied().unwrap_or(1.0);
            log(&mut basis.singular_values.iter().map(|s| s / first), 1)
        };
        let loss = |basis: &PodBasis| log(&mut (1..=basis.singular_values.len()).map(|k| basis.loss(k)), 1);
        let rows = window.sampled_rows.iter().map(|row| window.grid.place(window.grid.node(*row)).0);
        Self {
            window: at,
            model: Arc::clone(model),
            singular: [singular(&window.pressure), singular(&window.deformation)],
            loss: [loss(&window.pressure), loss(&window.deformation)],
            modes: Vec::new(),
            rows: rows.map(|xi| PlotPoint::new(xi, 0.0)).collect(),
        }
    }
}

/// The tab.
pub fn ui(ui: &mut Ui, state: &mut State) {
    let Some(model) = state.model.clone() else {
        ui.centered_and_justified(|ui| {
            ui.weak("No reduced model is loaded, so there is no basis to show. The full solver draws every picture.")
        });
        return;
    };
    let at = model.window_for(state.document.point.moes());
    let Some(window) = model.windows.get(at) else { return };
    if state.basis.curves.as_ref().is_none_or(|c| c.window != at || !Arc::ptr_eq(&c.model, &model)) {
        state.basis.curves = Some(Curves::new(&model, at, window));
    }
    toolbar(ui, state, &model, at, window);
    let height = ui.available_height();
    let upper = 0.52 * height;
    if ui.available_width() > 640.0 {
        let half = 0.5 * ui.available_width() - 6.0;
        ui.horizontal(|ui| {
            ui.vertical(|ui| {
                ui.set_width(half);
                loss_plot(ui, state, window, upper);
            });
            ui.vertical(|ui| {
                ui.set_width(half);
                singular_plot(ui, state, upper);
            });
        });
    } else {
        loss_plot(ui, state, window, upper);
    }
    mode_plot(ui, state, window, (ui.available_height() - 4.0).max(120.0));
}

fn toolbar(ui: &mut Ui, state: &mut State, model: &ReducedModel, at: usize, window: &Window) {
    let ctx = ui.ctx().clone();
    let options = state.reduced_options();
    ui.horizontal_wrapped(|ui| {
        super::badge::ui(ui, state);
        ui.label(format!(
            "Window {} of {}, M {}…{}, {} of {} modes",
            at + 1,
            model.windows.len(),
            numbers::digits(window.m.0, 3),
            numbers::digits(window.m.1, 3),
            options.pressure_modes.unwrap_or(window.pressure.modes.ncols()),
            window.pressure.modes.ncols()
        ));
        let truncated = state.document.view.pressure_loss.is_some() || state.document.view.deformation_loss.is_some();
        if ui.add_enabled(truncated, egui::Button::new("Keep all modes")).clicked() {
            state.document.view.pressure_loss = None;
            state.document.view.deformation_loss = None;
        }
        if ui.button("Export CSV…").on_hover_text("Singular values and loss of information").clicked() {
            let text = csv(window);
            state.ask_path(&ctx, Purpose::Csv { text });
        }
    });
}

fn csv(window: &Window) -> String {
    let count = window.pressure.singular_values.len().max(window.deformation.singular_values.len());
    let row = |k: usize| {
        let of = |basis: &PodBasis| {
            let value = basis.singular_values.get(k).copied();
            [value, value.map(|_| basis.loss(k + 1))]
        };
        let mut row = vec![Some(k as f64 + 1.0)];
        row.extend(of(&window.pressure));
        row.extend(of(&window.deformation));
        row
    };
    let header = ["mode", "sigma_pressure", "loss_pressure", "sigma_deformation", "loss_deformation"];
    let comment = format!("window M {:e} to {:e}", window.m.0, window.m.1);
    export::csv(&[comment], &header, (0..count).map(row))
}

fn log_plot<'a>(ui: &Ui, id: &str, height: f32, title: &str) -> Plot<'a> {
    axes::plot(ui, id, height, "Modes {k}", title)
        .legend(Legend::default().position(Corner::RightTop).follow_insertion_order(true).background_alpha(0.6))
        .y_grid_spacer(axes::decade_marks)
        .y_axis_formatter(|mark, _| axes::decade_label(mark))
        .label_formatter(|at| match at {
            egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}\nk = {:.0}\n{}", position.x, numbers::digits(10f64.powf(position.y), 3)))
            }
            egui_plot::HoverPosition::Elsewhere { .. } => None,
        })
}

fn loss_plot(ui: &mut Ui, state: &mut State, window: &Window, height: f32) {
    let palette = Palette::of(ui);
    let Some(curves) = &state.basis.curves else { return };
    let projected = state.document.view.projected_deformation;
    // Without a tolerance every mode is kept: the line rests at the loss of the kept modes.
    let resting = |field: Field| {
        let curve = match field {
            Field::Pressure => &curves.loss[0],
            Field::Deformation => &curves.loss[1],
        };
        curve.get(field.of(window).modes.ncols().saturating_sub(1)).or(curve.last()).map_or(LEAST_LOG_LOSS, |p| p.y)
    };
    let tolerance = |loss: Option<f64>, field: Field| loss.map_or_else(|| resting(field), f64::log10);
    let mut lines = vec![(Field::Pressure, tolerance(state.document.view.pressure_loss, Field::Pressure))];
    if projected {
        lines.push((Field::Deformation, tolerance(state.document.view.deformation_loss, Field::Deformation)));
    }
    let options = state.reduced_options();
    let dragging = state.basis.dragging;
    let fit = state.fit_plots;
    let shown = log_plot(ui, "loss", height, "Loss of information").allow_drag(dragging.is_none()).show(ui, |plot| {
        axes::fit(plot, fit);
        for (field, points) in [Field::Pressure, Field::Deformation].into_iter().zip(&curves.loss) {
            let color = field.color(&palette);
            plot.line(Line::new(field.name(), PlotPoints::Borrowed(points)).color(color).width(1.8));
        }
        for (field, level) in &lines {
            let color = field.color(&palette);
            let width = if dragging == Some(*field) { 2.6 } else { 1.4 };
            let line = HLine::new("", *level).id(("tolerance", field.name()));
            plot.hline(line.color(color).width(width).style(LineStyle::dashed_dense()).allow_hover(false));
            let place = PlotPoint::new(1.0, *level);
            let text = RichText::new(format!("tolerance {}", numbers::digits(10f64.powf(*level), 1))).size(11.0);
            let label = Text::new("", place, text.color(color)).anchor(Align2::LEFT_TOP);
            plot.text(label.id(("tolerance label", field.name())).allow_hover(false));
        }
        if let Some(kept) = options.pressure_modes {
            let line = VLine::new("", kept as f64).id("kept").color(palette.pressure).width(1.0);
            plot.vline(line.style(LineStyle::dotted_dense()).allow_hover(false));
        }
    });
    let transform = shown.transform;
    let tip = "Drag the dashed tolerance: the model is truncated at once and profiles, error and time per solve answer";
    let response = crate::app::controls::named(ui, shown.response, "Loss of information and tolerances");
    let near = |y: f32| {
        lines.iter().find(|(_, level)| (transform.position_from_point(&PlotPoint::new(0.0, *level)).y - y).abs() < GRAB)
    };
    let hovered = response.hover_pos().and_then(|p| near(p.y)).map(|(field, _)| *field);
    if hovered.is_some() || dragging.is_some() {
        ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeVertical);
        response.on_hover_text(tip);
    }
    if ui.input(|i| i.pointer.primary_pressed()) && hovered.is_some() {
        state.basis.dragging = hovered;
    }
    if !ui.input(|i| i.pointer.primary_down()) {
        state.basis.dragging = None;
    }
    if let (Some(field), Some(pointer)) = (state.basis.dragging, ui.input(|i| i.pointer.latest_pos()))
        && ui.input(|i| i.pointer.press_origin()).is_some_and(|origin| origin.distance(pointer) > 1.0)
    {
        let level = transform.value_from_position(pointer).y.clamp(LEAST_LOG_LOSS, -0.3);
        let loss = Some(10f64.powf(level));
        match field {
            Field::Pressure => state.document.view.pressure_loss = loss,
            Field::Deformation => state.document.view.deformation_loss = loss,
        }
    }
}

fn singular_plot(ui: &mut Ui, state: &State, height: f32) {
    let palette = Palette::of(ui);
    let Some(curves) = &state.basis.curves else { return };
    let fit = state.fit_plots;
    log_plot(ui, "singular values", height, "Singular value {σ}/{σ_1}").show(ui, |plot| {
        axes::fit(plot, fit);
        for (field, points) in [Field::Pressure, Field::Deformation].into_iter().zip(&curves.singular) {
            let color = field.color(&palette);
            plot.line(Line::new(field.name(), PlotPoints::Borrowed(points)).color(color).width(1.4));
            let dots = Points::new(field.name(), PlotPoints::Borrowed(points)).id((field.name(), 1));
            plot.points(dots.color(color).radius(2.0).shape(MarkerShape::Circle));
        }
    });
}

fn mode_plot(ui: &mut Ui, state: &mut State, window: &Window, height: f32) {
    let palette = Palette::of(ui);
    let view = &mut state.basis;
    ui.horizontal(|ui| {
        let label = ui.label("Modes of");
        ComboBox::from_id_salt("field of the modes")
            .selected_text(view.field.name())
            .show_ui(ui, |ui| {
                for field in [Field::Pressure, Field::Deformation] {
                    ui.selectable_value(&mut view.field, field, field.name());
                }
            })
            .response
            .labelled_by(label.id);
        let most = view.field.of(window).modes.ncols().saturating_sub(1);
        view.first_mode = view.first_mode.min(most);
        let label = ui.label("from number");
        let mut number = view.first_mode + 1;
        let drag = egui::DragValue::new(&mut number).range(1..=most + 1).speed(0.1);
        ui.add(drag).labelled_by(label.id);
        view.first_mode = number.clamp(1, most + 1) - 1;
        ui.weak(format!("{} sampled rows as marks along ξ", window.sampled_rows.len()));
    });
    let (field, first) = (view.field, view.first_mode);
    let Some(curves) = &mut view.curves else { return };
    let last = (first + SHOWN_MODES).min(field.of(window).modes.ncols());
    for k in first..last {
        if !curves.modes.iter().any(|m| m.0 == field && m.1 == k) {
            let points = mode_points(field.of(window), &window.grid, k);
            curves.modes.push((field, k, points));
        }
    }
    let color = field.color(&palette);
    let fit = state.fit_plots;
    axes::plot(ui, "modes", (height - 30.0).max(90.0), "Reference coordinate {ξ}", "Mode, scaled to 1")
        .legend(Legend::default().position(Corner::LeftTop).follow_insertion_order(true).background_alpha(0.6))
        .default_x_bounds(-2.2, 1.6)
        .show(ui, |plot| {
            axes::fit(plot, fit);
            for (_, k, points) in curves.modes.iter().filter(|m| m.0 == field && (first..last).contains(&m.1)) {
                let fade = 1.0 - 0.24 * (k - first) as f32;
                let line = Line::new(format!("Mode {}", k + 1), PlotPoints::Borrowed(points));
                plot.line(line.color(color.gamma_multiply(fade)).width(if *k == first { 2.2 } else { 1.3 }));
            }
            let marks = Points::new("Sampled rows", PlotPoints::Borrowed(&curves.rows));
            plot.points(marks.color(palette.accent).radius(3.0).shape(MarkerShape::Up));
        });
}

/// One mode, scaled to a largest magnitude of one: its weights make the columns themselves hard to compare.
fn mode_points(basis: &PodBasis, grid: &ContactGrid, k: usize) -> Vec<PlotPoint> {
    let column = (0..basis.modes.nrows()).map(|i| basis.modes[(i, k)]);
    let largest = column.clone().map(f64::abs).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let points = column.enumerate().map(|(node, v)| (grid.place(node), v / largest));
    // Along the axis Y = 0 where there is anything across.
    points.filter(|((_, y), _)| *y == 0.0).skip(1).map(|((xi, _), v)| PlotPoint::new(xi, v)).collect()
}
