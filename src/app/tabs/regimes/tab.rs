//! Regimes tab: the M–L chart with the regimes of Moes' formula, the trained range of the reduced model, and the
//! current contact, which can be dragged. The published film formulas are next to it.

use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, spoken};
use crate::app::document::Edit;
use crate::app::figure::{Canvas, Texture};
use crate::app::plot::axes;
use crate::app::plot::grip::Grip;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::tabs::regimes::chart::{ChartLine, ChartLines, Kind, point, shading};
use crate::app::tabs::regimes::trail::Trail;
use crate::app::tabs::{About, Offer, View, view};
use crate::app::theme::{Palette, faded, rich};
use crate::app::{formulas, numbers, units};
use crate::scene::regime::RegimeMap;
use crate::scene::regimes::{L_AXIS, M_AXIS};
use crate::solver::physics::contact::{ContactKind, FilmShape, Moes, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::reduced::ReducedModel;
use egui::{Align2, RichText, ScrollArea, Ui, WidgetText};
use egui_plot::{Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points, Text};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Distance in screen points within which the pointer can grab the contact.
const GRAB_RADIUS: f32 = 18.0;

/// Data that the lines of the chart depend on: the shape of the contact, and its reduced model if there is one.
#[derive(Clone)]
struct Owner(FilmShape, Option<Arc<ReducedModel>>);

impl PartialEq for Owner {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0 && self.1.as_ref().map(Arc::as_ptr) == other.1.as_ref().map(Arc::as_ptr)
    }
}

/// Settings of the chart, stored with the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// True if the training points of the reduced model are drawn.
    pub training_points: bool,
}

/// State of the tab: its settings, and the data kept between frames. These are the shading as an image, all lines, and
/// the trail of the contact.
#[derive(Default)]
pub struct Regimes {
    /// Settings of the chart.
    pub choices: Choices,
    texture: Option<(FilmShape, bool, Texture)>,
    lines: Option<(Owner, ChartLines)>,
    trail: Trail,
}

/// Name under which the refusal of a drag is stored.
const FIELD: &str = "regimes";
/// Height of the table of formulas below the chart \[points\].
const FORMULAS: f32 = 212.0;
/// Width that the hint needs together with the checkbox and the button next to it \[points\].
const HINT: f32 = 700.0;
/// Text size of the name of the regime \[points\].
const LARGE: f32 = 22.0;

impl Regimes {
    /// Adds the present place of the contact to its trail, even if the chart is hidden.
    pub fn follow(&mut self, kind: ContactKind, moes: Moes) {
        self.trail.follow(kind, at(moes));
    }

    /// Clears the trail. Call after the document was replaced.
    pub fn forget(&mut self) {
        self.trail = Trail::default();
    }

    fn chart(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands, height: f32) {
        let ctx = ui.ctx().clone();
        let palette = Palette::of(ui);
        let dark = ui.visuals().dark_mode;
        let kind = context.document.point.kind;
        let present = FilmShape::of(&context.document.point);
        // While the user changes an ellipse by dragging, the chart of the previous ellipse stays, because a new chart
        // takes longer than a frame.
        let held = ui.input(|input| input.pointer.any_down());
        let previous = self.lines.as_ref().map(|(Owner(shape, _), _)| *shape);
        let both_ellipses = matches!((previous, present), (Some(FilmShape::Ellipse(_)), FilmShape::Ellipse(_)));
        let shape = previous.filter(|_| held && both_ellipses).unwrap_or(present);
        if self.texture.as_ref().is_none_or(|t| (t.0, t.1) != (shape, dark)) {
            let texture = Texture::new(&ctx, "regimes", shading(shape, &palette));
            self.texture = Some((shape, dark, texture));
        }
        // The chart of an elliptical contact does not show a model of circular contacts, and vice versa.
        let model = context.answers.model(context.document).filter(|model| model.is_of(&context.document.point));
        let owner = Owner(shape, model.cloned());
        if self.lines.as_ref().is_none_or(|lines| lines.0 != owner) {
            let lines = ChartLines::new(shape, owner.1.as_deref());
            self.lines = Some((owner, lines));
        }
        let lines = self.lines.iter().flat_map(|(_, lines)| &lines.lines);
        let model_points =
            lines.filter(|line| line.kind == Kind::Snapshots).map(|line| line.points.len()).sum::<usize>();
        let top = ui.cursor().top();
        let (map, ratios) = (RegimeMap::new(shape), context.regime_ratios());
        let regime = ratios.regime();
        ui.horizontal_wrapped(|ui| {
            let name = ui.label(RichText::new(regime.title()).size(LARGE).strong());
            spoken(ui, name, &format!("Regime: {}", regime.title()));
            ui.label(ratios.describe());
        });
        // If the hint needs more than one line, the button is below it.
        let beside = ui.available_width() > HINT;
        let row = if beside { egui::Layout::left_to_right(egui::Align::Center) } else { *ui.layout() };
        ui.allocate_ui_with_layout([ui.available_width(), 0.0].into(), row, |ui| {
            let hint = if kind.is_line() {
                "Drag the contact across the chart. Contours are Moes’ film number ({h}/{R})/√(2{U})"
            } else {
                "Drag the contact. Contours: ({h}/{R})/√(2{U}) of Nijenbanning, Venner and Moes"
            };
            // A refusal replaces the hint, so that the chart does not move.
            match context.entries.message(FIELD) {
                Some(refusal) => message_ui(ui, refusal),
                None if context.presenting => {}
                None => _ = ui.label(rich(hint, 12.5, palette.quiet)),
            }
            if !context.presenting && model_points > 0 {
                let tip =
                    format!("Contacts of the {model_points} full solutions that the reduced model was trained with");
                ui.checkbox(&mut self.choices.training_points, "Training points").on_hover_text(tip);
            }
            let clear = ui.add_enabled(self.trail.points().len() > 1, egui::Button::new("Clear the trail"));
            if clear.on_hover_text("Removes the path of the contact from the chart").clicked() {
                self.trail.clear();
            }
        });
        let here = context.document.point.moes();
        let grip = Grip::new("regimes", "contact");
        let grabbed = grip.is_held(ui);
        let fit = context.fit;
        let pins: Vec<[f64; 2]> = context
            .answers
            .pins()
            .iter()
            .filter(|p| p.picture.key.point.kind == kind)
            .map(|p| at(p.picture.key.point.moes()))
            .map(|p| [p.x, p.y])
            .collect();
        let points_shown = self.choices.training_points;
        if points_shown && model_points > 0 {
            let dots = Entry::new("training points of the reduced model", faded(palette.accent, 0.7), Sample::Dot(2.5));
            key::ui(ui, vec![dots]);
        }
        let chart_height = (height - (ui.cursor().top() - top) - ui.spacing().item_spacing.y).max(160.0);
        let trail = &self.trail;
        let Some((_, lines)) = &self.lines else { return };
        let texture = self.texture.as_ref().map(|t| t.2.shown(&ctx));
        let response = axes::show(
            axes::plot(ui, "regimes", chart_height, "Load number {M}", "Lubricant number {L}")
                .default_x_bounds(M_AXIS.0.log10(), M_AXIS.1.log10())
                .default_y_bounds(L_AXIS.0.log10(), L_AXIS.1.log10())
                .allow_drag(!grabbed)
                .log_x()
                .log_y()
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
                        map.regime(moes).name().replace('\n', " ")
                    ))
                }),
            ui,
            "Chart of M and L",
            |plot| {
                axes::fit(plot, fit);
                if let Some(texture) = texture {
                    image(plot, texture);
                }
                // Draw dots over lines.
                let (dots, all): (Vec<_>, Vec<_>) = lines.lines.iter().partition(|l| l.kind == Kind::Snapshots);
                let dots = dots.into_iter().filter(|_| points_shown);
                for (k, line) in all.into_iter().chain(dots).enumerate() {
                    draw(plot, line, k, &palette);
                }
                for (regime, place) in &lines.names {
                    let ink = palette.ink_on_regimes(palette.quiet);
                    let text = RichText::new(regime.name()).size(12.0).color(ink).italics();
                    let name = Text::new("", *place, text).id(("regime", regime.name())).allow_hover(false);
                    // A name at an edge starts or ends there, so that a narrow chart does not cut it off.
                    let anchor = match place.x {
                        ..0.0 => Align2::LEFT_CENTER,
                        3.0.. => Align2::RIGHT_CENTER,
                        _ => Align2::CENTER_CENTER,
                    };
                    plot.text(name.anchor(anchor));
                }
                plot.points(
                    Points::new("Pinned", pins)
                        .color(palette.quiet)
                        .radius(4.5)
                        .filled(false)
                        .shape(MarkerShape::Circle),
                );
                trail.draw(plot, palette.accent);
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
        let near = response.hover_pos().is_some_and(near);
        if near || grabbed {
            ctx.set_cursor_icon(egui::CursorIcon::Grab);
        }
        if let Some(pointer) = grip.follow(ui, near) {
            let value = transform.value_from_position(pointer);
            let m = 10f64.powf(value.x.clamp(M_AXIS.0.log10(), M_AXIS.1.log10()));
            let l = 10f64.powf(value.y.clamp(L_AXIS.0.log10(), L_AXIS.1.log10()));
            commands.edit(Edit::Moes(Moes { m, l }), FIELD);
        }
    }
}

const ABOUT: About = About {
    keywords: "chart film thickness formulas Moes Hamrock Dowson Higginson isoviscous piezoviscous rigid elastic",
    page: "physics.md",
    has_units: false,
    why: "Load, speed, size and stiffness determine the film thickness only through two numbers: the load number M, \
          and the lubricant number L, which measures how strongly the viscosity rises with pressure. Different laws \
          apply for rigid bodies and for constant viscosity, and the colours show these regimes. Every published \
          formula is valid in a part of this chart, so check the position of your contact before you use one.",
};

impl View for Regimes {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if context.presenting {
            // A presentation shows only the chart.
            self.chart(ui, context, commands, ui.available_height());
        } else if ui.available_width() > 760.0 {
            ui.horizontal_top(|ui| {
                let table = if context.document.point.kind.is_line() { 350.0 } else { 384.0 };
                let width = ui.available_width() - table - 14.0;
                ui.vertical(|ui| {
                    ui.set_width(width);
                    self.chart(ui, context, commands, ui.available_height());
                });
                ui.add_space(6.0);
                ui.vertical(|ui| {
                    ScrollArea::vertical().id_salt("formulas").show(ui, |ui| formulas::ui(ui, context, commands));
                });
            });
        } else {
            let room = ui.available_height();
            self.chart(ui, context, commands, (room - FORMULAS).max(0.7 * room));
            let table = ScrollArea::vertical().id_salt("formulas").auto_shrink(false).min_scrolled_height(0.0);
            table.show(ui, |ui| formulas::ui(ui, context, commands));
        }
    }

    fn kept(&self) -> Option<String> {
        view::kept(&self.choices)
    }

    fn restore(&mut self, text: &str) -> bool {
        view::restore(&mut self.choices, text, |_| true)
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let lines = self.lines.as_ref().map(|(_, lines)| lines);
        let tip = "Each published formula with its film thickness, its range, its source and the deviation from this \
                   contact";
        vec![
            Offer::table("Chart as CSV…", "Contours, boundaries and snapshots", lines, |lines| lines.csv()),
            Offer::table("Formulas as CSV…", tip, Some(*context), formulas::csv),
        ]
    }
}

/// Returns the point of a contact in the chart, (log10 M, log10 L).
fn at(moes: Moes) -> PlotPoint {
    point(moes.m, moes.l)
}

/// Returns the largest plausible Hertzian pressure with its unit in the unit system of the window.
fn limit(ctx: &egui::Context) -> String {
    numbers::in_field_unit(QuantityKind::Pressure, PLAUSIBLE_HERTZ_PRESSURE_PA, units::system(ctx))
}

/// Draws a line of the chart with its name next to it. `index` is its number among all lines.
fn draw<'a>(plot: &mut Canvas<'_, 'a>, line: &'a ChartLine, index: usize, palette: &Palette) {
    let points = &line.points;
    let film = || line.value.map_or_else(String::new, |value| value.to_string());
    let (name, color, width, style) = match line.kind {
        Kind::Contour => (film(), faded(palette.film, 0.55), 1.0, LineStyle::dotted_dense()),
        Kind::Boundary => (String::new(), palette.quiet, 1.2, LineStyle::Solid),
        Kind::PressureLimit => {
            let name = format!("p_H = {} in the default realisation", limit(plot.ctx()));
            (name, palette.warning, 1.4, LineStyle::dashed_loose())
        }
        Kind::Trained => ("Trained range".to_owned(), palette.accent, 1.8, LineStyle::Solid),
        Kind::Snapshots => {
            let dots = Points::new("Snapshots", PlotPoints::Borrowed(points)).color(faded(palette.accent, 0.7));
            return plot.points(dots.radius(1.8));
        }
        Kind::Table => ("Table 3.4".to_owned(), palette.deformation, 1.6, LineStyle::Solid),
        Kind::Trajectory => {
            let color = faded(palette.deformation, 0.75);
            ("Test trajectory".to_owned(), color, 1.0, LineStyle::dashed_dense())
        }
    };
    let small =
        |text: &str, size, color| WidgetText::from(RichText::new(text).size(size).color(palette.ink_on_regimes(color)));
    let label: Option<(WidgetText, Option<&PlotPoint>, Align2)> = match line.kind {
        Kind::Contour => {
            let end = points.iter().rev().find(|p| p.x < M_AXIS.1.log10() - 0.04);
            Some((small(&name, 10.5, palette.film), end, Align2::RIGHT_BOTTOM))
        }
        Kind::PressureLimit => {
            let text = format!("{{p_H}} = {}", limit(plot.ctx()));
            let text = rich(&text, 11.5, palette.ink_on_regimes(palette.warning)).into();
            Some((text, points.first(), Align2::RIGHT_TOP))
        }
        Kind::Trained => {
            // Outside the outline, at its lower left corner.
            let corner = points.iter().min_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y)));
            Some((small("trained range", 11.0, color), corner, Align2::LEFT_TOP))
        }
        Kind::Table => Some((small("Table 3.4", 11.0, color), points.first(), Align2::RIGHT_CENTER)),
        Kind::Boundary | Kind::Snapshots | Kind::Trajectory => None,
    };
    let drawn =
        Line::new(name, PlotPoints::Borrowed(points)).id(("line", index)).color(color).width(width).style(style);
    plot.line(drawn.allow_hover(line.kind != Kind::Boundary));
    if let Some((text, Some(at), anchor)) = label {
        plot.text(Text::new("", *at, text).anchor(anchor).id(("name", index)).allow_hover(false));
    }
}

/// Draws the shading of the regimes over the whole chart.
fn image(plot: &mut Canvas<'_, '_>, texture: egui::TextureId) {
    let (x, y) = ((M_AXIS.0.log10(), M_AXIS.1.log10()), (L_AXIS.0.log10(), L_AXIS.1.log10()));
    plot.field("shading", texture, x, y, egui::Color32::WHITE);
}
