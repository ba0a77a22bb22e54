//! The M–L chart: which asymptote of Moes' formula rules where, what the reduced model was trained for, and the current
//! contact, which can be dragged. Beside it the published film formulas.

use super::regime_chart::{ChartLines, L_AXIS, M_AXIS, Regime, shading};
use super::{axes, formulas};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::document::Edit;
use crate::app::figure::Texture;
use crate::app::numbers;
use crate::app::theme::{Palette, faded, rich};
use crate::solver::physics::contact::{ContactKind, Moes};
use crate::solver::reduced::ReducedModel;
use egui::{Align2, RichText, Ui};
use egui_plot::{Line, LineStyle, MarkerShape, PlotImage, PlotPoint, PlotPoints, PlotUi, Points, Text};
use std::sync::Arc;

/// How near (in screen points) the pointer must be to take the contact along.
const GRAB_RADIUS: f32 = 18.0;

/// What lines and snapshots were made for: a kind of contact, and its reduced model where there is one.
#[derive(Clone)]
struct Owner(ContactKind, Option<Arc<ReducedModel>>);

impl PartialEq for Owner {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0 && self.1.as_ref().map(Arc::as_ptr) == other.1.as_ref().map(Arc::as_ptr)
    }
}

/// What the chart keeps between frames: its shading as a picture and all lines, made once.
#[derive(Default)]
pub struct Regimes {
    texture: Option<(ContactKind, bool, Texture)>,
    lines: Option<(Owner, ChartLines)>,
    snapshots: Option<(Owner, Vec<PlotPoint>)>,
    dragging: bool,
}

/// Under this name a drag is refused.
const FIELD: &str = "regimes";

impl Regimes {
    /// The tab.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if context.presenting {
            // An audience looks at the chart.
            self.chart(ui, context, commands, ui.available_height());
        } else if ui.available_width() > 760.0 {
            ui.horizontal_top(|ui| {
                let table = if context.document.point.kind == ContactKind::Line { 350.0 } else { 384.0 };
                let width = ui.available_width() - table - 14.0;
                ui.vertical(|ui| {
                    ui.set_width(width);
                    self.chart(ui, context, commands, ui.available_height());
                });
                ui.add_space(6.0);
                ui.vertical(|ui| formulas::ui(ui, context));
            });
        } else {
            let height = (ui.available_height() - 190.0).max(220.0);
            self.chart(ui, context, commands, height);
            formulas::ui(ui, context);
        }
    }

    fn chart(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands, height: f32) {
        let ctx = ui.ctx().clone();
        let palette = Palette::of(ui);
        let dark = ui.visuals().dark_mode;
        let kind = context.document.point.kind;
        if self.texture.as_ref().is_none_or(|t| (t.0, t.1) != (kind, dark)) {
            let texture = Texture::new(&ctx, "regimes", shading(kind, &palette));
            self.texture = Some((kind, dark, texture));
        }
        let owner = Owner(kind, context.answers.model(context.document).cloned());
        if self.lines.as_ref().is_none_or(|lines| lines.0 != owner) {
            let lines = ChartLines::new(kind, owner.1.as_deref().map(|model| &model.domain));
            self.lines = Some((owner.clone(), lines));
        }
        if self.snapshots.as_ref().is_none_or(|snapshots| snapshots.0 != owner) {
            let points = owner.1.iter().flat_map(|model| &model.windows).flat_map(|w| &w.snapshots);
            let points = points.map(|s| at(s.point.moes())).collect();
            self.snapshots = Some((owner, points));
        }
        let mut toolbar_export = false;
        ui.horizontal_wrapped(|ui| {
            let hint = match kind {
                ContactKind::Line => {
                    "Drag the contact across the chart. Contours are Moes’ film number ({h}/{R})/√(2{U})"
                }
                ContactKind::Point => "Drag the contact. Contours: ({h}/{R})/√(2{U}) of Nijenbanning, Venner and Moes",
            };
            ui.label(rich(hint, 12.5, palette.quiet));
            toolbar_export = !context.presenting
                && ui.button("Export CSV…").on_hover_text("Contours, boundaries and snapshots").clicked();
        });
        context.entries.message_ui(ui, FIELD);
        let here = context.document.point.moes();
        let grabbed = self.dragging;
        let fit = context.fit;
        let pins: Vec<[f64; 2]> = context
            .answers
            .pins
            .iter()
            .filter(|p| p.picture.key.point.kind == kind)
            .map(|p| at(p.picture.key.point.moes()))
            .map(|p| [p.x, p.y])
            .collect();
        let chart_height = (height - 34.0).max(160.0);
        let Some((_, lines)) = &self.lines else { return };
        let texture = self.texture.as_ref().map(|t| t.2.shown(&ctx));
        let snapshots = self.snapshots.as_ref().map(|s| s.1.as_slice()).unwrap_or_default();
        let response = axes::show(
            axes::plot(ui, "regimes", chart_height, "Load number {M}", "Lubricant number {L}")
                .default_x_bounds(M_AXIS.0.log10(), M_AXIS.1.log10())
                .default_y_bounds(L_AXIS.0.log10(), L_AXIS.1.log10())
                .allow_drag(!grabbed)
                .x_grid_spacer(axes::log_marks)
                .y_grid_spacer(axes::log_marks)
                .x_axis_formatter(|mark, _| axes::log_label(mark))
                .y_axis_formatter(|mark, _| axes::log_label(mark))
                .y_axis_min_width(34.0)
                .label_formatter(|hover| {
                    let at = match hover {
                        egui_plot::HoverPosition::NearDataPoint { position, .. }
                        | egui_plot::HoverPosition::Elsewhere { position } => position,
                    };
                    let moes = Moes { m: 10f64.powf(at.x), l: 10f64.powf(at.y) };
                    Some(format!(
                        "M {}   L {}\n{}",
                        numbers::significant(moes.m),
                        numbers::significant(moes.l),
                        Regime::of(kind, moes).name().replace('\n', " ")
                    ))
                }),
            ui,
            "Chart of M and L",
            |plot| {
                axes::fit(plot, fit);
                if let Some(texture) = texture {
                    image(plot, texture);
                }
                for (name, points) in &lines.contours {
                    let line = Line::new(name.clone(), PlotPoints::Borrowed(points));
                    plot.line(line.color(faded(palette.film, 0.55)).width(1.0).style(LineStyle::dotted_dense()));
                    if let Some(end) = points.iter().rev().find(|p| p.x < M_AXIS.1.log10() - 0.04) {
                        let text = RichText::new(name).size(10.5).color(palette.film);
                        plot.text(
                            Text::new("", *end, text)
                                .anchor(Align2::RIGHT_BOTTOM)
                                .id(("contour", name))
                                .allow_hover(false),
                        );
                    }
                }
                for (k, points) in lines.boundaries.iter().enumerate() {
                    let line = Line::new("", PlotPoints::Borrowed(points)).id(("boundary", k));
                    plot.line(line.color(palette.quiet).width(1.2).allow_hover(false));
                }
                for (regime, place) in &lines.names {
                    let text = RichText::new(regime.name()).size(12.0).color(palette.quiet).italics();
                    plot.text(Text::new("", *place, text).id(("regime", regime.name())).allow_hover(false));
                }
                let limit =
                    Line::new("p_H = 3.2 GPa in the default realisation", PlotPoints::Borrowed(&lines.pressure_limit));
                plot.line(limit.color(palette.warning).width(1.4).style(LineStyle::dashed_loose()));
                if let Some(end) = lines.pressure_limit.first() {
                    let text = rich("{p_H} = 3.2 GPa", 11.5, palette.warning);
                    plot.text(Text::new("", *end, text).anchor(Align2::RIGHT_TOP).id("limit").allow_hover(false));
                }
                if let Some(outline) = &lines.trained {
                    plot.line(
                        Line::new("Trained range", PlotPoints::Borrowed(outline)).color(palette.accent).width(1.8),
                    );
                    // Outside the outline, at its lower left corner.
                    let low = |a: &PlotPoint, b: &PlotPoint| (a.x + a.y).total_cmp(&(b.x + b.y));
                    if let Some(corner) = outline.iter().min_by(|a, b| low(a, b)) {
                        let text = RichText::new("trained range").size(11.0).color(palette.accent);
                        let label = Text::new("", *corner, text).anchor(Align2::LEFT_TOP);
                        plot.text(label.id("trained label").allow_hover(false));
                    }
                }
                if let Some(corner) = lines.table.first() {
                    let table = Line::new("Table 3.4", PlotPoints::Borrowed(&lines.table));
                    plot.line(table.color(palette.deformation).width(1.6));
                    let text = RichText::new("Table 3.4").size(11.0).color(palette.deformation);
                    plot.text(
                        Text::new("", *corner, text).anchor(Align2::RIGHT_CENTER).id("table label").allow_hover(false),
                    );
                    let path = Line::new("Trajectory (3.21)", PlotPoints::Borrowed(&lines.trajectory));
                    plot.line(path.color(faded(palette.deformation, 0.75)).width(1.0).style(LineStyle::dashed_dense()));
                }
                plot.points(
                    Points::new("Snapshots", PlotPoints::Borrowed(snapshots))
                        .color(faded(palette.accent, 0.7))
                        .radius(1.8),
                );
                plot.points(
                    Points::new("Pinned", pins)
                        .color(palette.quiet)
                        .radius(4.5)
                        .filled(false)
                        .shape(MarkerShape::Circle),
                );
                let current = [at(here).x, at(here).y];
                let ring = Points::new("", vec![current]).id("ring").color(palette.accent).radius(9.0).filled(false);
                plot.points(ring.shape(MarkerShape::Circle).allow_hover(false));
                plot.points(
                    Points::new("", vec![current]).id("current").color(palette.accent).radius(5.0).allow_hover(false),
                );
            },
        );
        let transform = response.transform;
        let response = response.response;
        let spot = transform.position_from_point(&at(here));
        let near = |p: egui::Pos2| p.distance(spot) < GRAB_RADIUS;
        let over = response.hover_pos().is_some_and(near) || self.dragging;
        if over {
            ctx.set_cursor_icon(egui::CursorIcon::Grab);
        }
        // Taking hold before the drag begins keeps the chart itself still.
        if ui.input(|i| i.pointer.primary_pressed()) && response.hover_pos().is_some_and(near) {
            self.dragging = true;
        }
        if !ui.input(|i| i.pointer.primary_down()) {
            self.dragging = false;
        }
        if self.dragging
            && let Some(pointer) = ui.input(|i| i.pointer.latest_pos())
            && ui.input(|i| i.pointer.press_origin()).is_some_and(|origin| origin.distance(pointer) > 1.0)
        {
            let value = transform.value_from_position(pointer);
            let m = 10f64.powf(value.x.clamp(M_AXIS.0.log10(), M_AXIS.1.log10()));
            let l = 10f64.powf(value.y.clamp(L_AXIS.0.log10(), L_AXIS.1.log10()));
            commands.edit(Edit::Moes(Moes { m, l }), FIELD);
        }
        if toolbar_export {
            let snapshots = self.snapshots.as_ref().map(|s| s.1.as_slice()).unwrap_or_default();
            commands.extend(self.lines.as_ref().map(|(_, lines)| Command::csv(lines.csv(snapshots))));
        }
    }
}

fn at(moes: Moes) -> PlotPoint {
    PlotPoint::new(moes.m.log10(), moes.l.log10())
}

fn image(plot: &mut PlotUi<'_>, texture: egui::TextureId) {
    let (x, y) = ((M_AXIS.0.log10(), M_AXIS.1.log10()), (L_AXIS.0.log10(), L_AXIS.1.log10()));
    let center = PlotPoint::new(0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1));
    let size = egui::vec2((x.1 - x.0) as f32, (y.1 - y.0) as f32);
    plot.image(PlotImage::new("", texture, center, size).id("shading").allow_hover(false));
}
