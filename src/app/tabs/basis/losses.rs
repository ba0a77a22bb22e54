//! Plots of the singular values and of the loss of information, with tolerances that can be dragged.

use super::curves::Shown;
use super::field::{Field, TRUNCATION};
use crate::app::context::{Commands, Context};
use crate::app::document::Edit;
use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::plot::frame::PlotFrame;
use crate::app::plot::{axes, key};
use crate::app::theme::Palette;
use crate::solver::reduced::Window;
use egui::{Align2, Color32, RichText, Ui};
use egui_plot::{HLine, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points, Text, VLine};

/// Distance in screen points within which the pointer can grab a tolerance.
const GRAB: f32 = 9.0;
/// Smallest tolerance of a drag, log10.
const LEAST_LOG_LOSS: f64 = -14.0;

fn log_plot<'a>(ui: &Ui, id: &str, height: f32, title: &str) -> PlotFrame<'a> {
    axes::plot(ui, id, height, "Modes {k}", title).decades_y(8.0).label_formatter(|at| match at {
        egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } => {
            Some(format!("{plot_name}\nk = {:.0}\n{}", position.x, numbers::digits(10f64.powf(position.y), 3)))
        }
        egui_plot::HoverPosition::Elsewhere { .. } => None,
    })
}

/// Draws the loss of information against the number of modes, with the tolerances.
pub fn loss_plot(
    ui: &mut Ui,
    own: &mut Shown,
    context: &Context<'_>,
    commands: &mut Commands,
    window: &Window,
    height: f32,
) {
    let mut view = context.document.view.clone();
    let palette = Palette::of(ui);
    let Some(curves) = &own.curves else { return };
    let projected = view.projected_deformation;
    // Without a tolerance every mode is used. The line is then at the loss of these modes.
    let resting = |field: Field| {
        let curve = match field {
            Field::Pressure => &curves.loss[0],
            Field::Deformation => &curves.loss[1],
        };
        curve.get(field.of(window).modes.ncols().saturating_sub(1)).or(curve.last()).map_or(LEAST_LOG_LOSS, |p| p.y)
    };
    let tolerance = |loss: Option<f64>, field: Field| loss.map_or_else(|| resting(field), f64::log10);
    let mut lines = vec![(Field::Pressure, tolerance(view.pressure_loss, Field::Pressure))];
    if projected {
        lines.push((Field::Deformation, tolerance(view.deformation_loss, Field::Deformation)));
    }
    let options = context.answers.options(context.document);
    let dragging = own.dragging;
    let fit = context.fit;
    let shown = axes::show(
        log_plot(ui, "loss", height, "Loss of information").allow_drag(dragging.is_none()),
        ui,
        "Loss of information and tolerances",
        |plot| {
            axes::fit(plot, fit);
            for (field, points) in [Field::Pressure, Field::Deformation].into_iter().zip(&curves.loss) {
                let color = field.color(&palette);
                plot.line(Line::new(field.name(), PlotPoints::Borrowed(points)).color(color).width(1.8));
                name(plot, field, points, color);
            }
            for (field, level) in &lines {
                let color = field.color(&palette);
                let width = if dragging == Some(*field) { 2.6 } else { 1.4 };
                let line = HLine::new("", *level).id(("tolerance", field.name()));
                plot.hline(line.color(color).width(width).style(LineStyle::dashed_dense()).allow_hover(false));
                // The label is at the right end, where the curves are below the tolerance.
                let end = curves.loss.iter().filter_map(|points| points.last()).map(|last| last.x).fold(1.0, f64::max);
                let place = PlotPoint::new(end, *level);
                let text = RichText::new(format!("tolerance {}", numbers::digits(10f64.powf(*level), 1))).size(11.0);
                let label = Text::new("", place, text.color(palette.ink(color))).anchor(Align2::RIGHT_BOTTOM);
                plot.text(label.id(("tolerance label", field.name())).allow_hover(false));
            }
            if let Some(kept) = options.pressure_modes {
                let line = VLine::new("", kept as f64).id("kept").color(palette.pressure).width(1.0);
                plot.vline(line.style(LineStyle::dotted_dense()).allow_hover(false));
            }
        },
    );
    let transform = shown.transform;
    let tip = "Drag the dashed tolerance. The model is truncated at once, and profiles, error and time per solve are \
               updated";
    let response = shown.response;
    let near = |y: f32| {
        lines.iter().find(|(_, level)| (transform.position_from_point(&PlotPoint::new(0.0, *level)).y - y).abs() < GRAB)
    };
    let hovered = response.hover_pos().and_then(|p| near(p.y)).map(|(field, _)| *field);
    if hovered.is_some() || dragging.is_some() {
        ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeVertical);
        response.on_hover_text(tip);
    }
    if ui.input(|i| i.pointer.primary_pressed()) && hovered.is_some() {
        own.dragging = hovered;
    }
    if !ui.input(|i| i.pointer.primary_down()) {
        own.dragging = None;
    }
    if let (Some(field), Some(pointer)) = (own.dragging, ui.input(|i| i.pointer.latest_pos()))
        && ui.input(|i| i.pointer.press_origin()).is_some_and(|origin| origin.distance(pointer) > 1.0)
    {
        let level = transform.value_from_position(pointer).y.clamp(LEAST_LOG_LOSS, -0.3);
        let loss = Some(10f64.powf(level));
        match field {
            Field::Pressure => view.pressure_loss = loss,
            Field::Deformation => view.deformation_loss = loss,
        }
        commands.edit(Edit::View(view.into()), TRUNCATION);
    }
}

/// Draws the name of a falling curve, on the side away from the other curve.
fn name(plot: &mut Canvas<'_, '_>, field: Field, points: &[PlotPoint], color: Color32) {
    let anchor = match field {
        Field::Pressure => Align2::LEFT_BOTTOM,
        Field::Deformation => Align2::RIGHT_TOP,
    };
    if let Some(middle) = points.get(points.len() / 2) {
        key::name(plot, field.name(), *middle, field.name(), color, anchor);
    }
}

/// Draws the singular values against their number.
pub fn singular_plot(ui: &mut Ui, own: &Shown, fit: bool, height: f32) {
    let palette = Palette::of(ui);
    let Some(curves) = &own.curves else { return };
    axes::show(log_plot(ui, "singular values", height, "Singular value {σ}/{σ_1}"), ui, "Singular values", |plot| {
        axes::fit(plot, fit);
        for (field, points) in [Field::Pressure, Field::Deformation].into_iter().zip(&curves.singular) {
            let color = field.color(&palette);
            plot.line(Line::new(field.name(), PlotPoints::Borrowed(points)).color(color).width(1.4));
            let dots = Points::new(field.name(), PlotPoints::Borrowed(points)).id((field.name(), 1));
            plot.points(dots.color(color).radius(2.0).shape(MarkerShape::Circle));
            name(plot, field, points, color);
        }
    });
}
