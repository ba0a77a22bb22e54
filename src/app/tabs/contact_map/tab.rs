//! Contact map tab: film thickness or pressure of a point contact over the whole plane, and its interferogram. Two
//! lines that can be dragged mark the cuts of the Profiles tab.

use super::images::Images;
use super::map_view::{MapView, Shown};
use super::why::explain;
use super::{export, optics, scale};
use crate::app::answers::picture::{Cuts, Picture};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{described, sentence};
use crate::app::document::{Edit, Shape};
use crate::app::drawn::{self, Owner};
use crate::app::figure::Canvas;
use crate::app::plot::cut_line::{self, snapped};
use crate::app::plot::grip::Grip;
use crate::app::plot::{axes, color_bar};
use crate::app::purpose::{Purpose, Written};
use crate::app::tabs::transient::{TransientCommand, shared, space_time};
use crate::app::tabs::{About, Offer, View, view};
use crate::app::theme::{Palette, faded};
use crate::app::units::{self, Scales};
use crate::app::{badge, caption, numbers};
use crate::solver::full::heat::Rises;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Align, Color32, CursorIcon, Layout, Response, RichText, Ui, Vec2, vec2};
use egui_plot::{HLine, HoverPosition, Line, LineStyle, PlotBounds, PlotPoint, PlotPoints, PlotTransform, Text, VLine};

/// Initial X range.
const X_RANGE: (f64, f64) = (-2.0, 1.6);
/// Initial Y range to both sides, in units of b.
const Y_RANGE: f64 = 1.45;
/// Space for numbers and titles of both axes.
const AXES: Vec2 = vec2(66.0, 44.0);
/// Distance in screen points within which the pointer can grab a cut.
const GRAB: f32 = 7.0;

/// Accessible name of the map, also used for the export.
const NAME: &str = "Map of the contact";

/// Contact map tab: its settings, and the images kept between frames.
#[derive(Default)]
pub struct ContactMap {
    /// Settings of the map.
    pub view: MapView,
    images: Images,
    /// κ of the elliptical contact that the axes were fitted to.
    framed: Option<f64>,
    /// Map of a line contact over time.
    over_time: space_time::SpaceTime,
}

impl ContactMap {
    /// Draws the content for a line contact: a button that changes to a point contact, and the film thickness over
    /// time.
    fn line(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        ui.horizontal_wrapped(|ui| {
            let tip = "A circular contact with the same quantities";
            if ui.button("Show a circular contact").on_hover_text(tip).clicked() {
                commands.edit(Edit::Shape(Shape::Ball), "contact");
            }
            ui.weak("A line contact is the same at every Y. The map shows its film thickness over time.");
        });
        if let Some(why) = context.document.no_transient() {
            ui.weak(sentence(why));
            return;
        }
        shared::follow(context, commands);
        // Fixed heights, so that nothing moves when runs start and end.
        shared::status(ui, context, None);
        let size = vec2(ui.available_width(), ui.available_height() - 30.0);
        let shown = ui.allocate_ui_with_layout(size, Layout::top_down(Align::LEFT), |ui| {
            ui.set_min_size(size);
            shared::grey_where_stale(ui, context, "film over time");
            // Slightly less than the available height, so that rounding does not move anything.
            self.over_time.ui(ui, context, size.y - 4.0)
        });
        let wanted = shown.inner;
        commands.extend(wanted.map(|time| Command::Transient(TransientCommand::GoTo(time))));
        shared::player(ui, context.transient, commands);
    }

    fn toolbar(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        ui.horizontal_wrapped(|ui| {
            let laws = &context.document.lubricant;
            for shown in Shown::ALL.into_iter().filter(|shown| shown.is_of(laws)) {
                ui.selectable_value(&mut self.view.shown, shown, shown.name()).on_hover_text(shown.tip());
            }
            if context.presenting {
                return;
            }
            let field = self.view.shown != Shown::Interferogram;
            ui.add_enabled(field, egui::Checkbox::new(&mut self.view.contours, "Contours"))
                .on_hover_text("Lines of equal value")
                .on_disabled_hover_text("Fringes are lines of equal film thickness already");
            cut_line::cuts_ui(ui, context, commands);
        });
    }
}

const ABOUT: About = About {
    keywords: "interferogram fringes contours horseshoe side lobes film thickness temperature cavitation starvation",
    page: "tour.md",
    has_units: true,
    why: "Seen from above, the film is flat in the middle and thin in a horseshoe around the sides and the outlet, \
          where pressure drives oil out. The film is thinnest in the two side lobes, where surfaces touch first. The \
          interferogram shows the same film as photographed in a rig with a glass disc, each colour one thickness.",
};

impl View for ContactMap {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn why(&self, context: &Context<'_>) -> String {
        let present = context.answers.shown_picture().filter(|picture| picture.has_plane());
        present.map_or_else(|| ABOUT.why.to_owned(), |picture| explain(&picture.solution))
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if context.document.point.kind.is_line() {
            self.line(ui, context, commands);
            return;
        }
        badge::ui(ui, context);
        if !self.view.shown.is_of(&context.document.lubricant) {
            self.view.shown = Shown::Film;
        }
        self.toolbar(ui, context, commands);
        if self.view.shown == Shown::Interferogram && !context.presenting {
            optics::ui(ui, &mut self.view);
        }
        let Some(picture) = context.answers.picture().filter(|picture| picture.has_plane()) else {
            ui.centered_and_justified(|ui| ui.weak("The first picture is being computed"));
            return;
        };
        let stale = drawn::is_grey(ui.ctx(), "map", Owner::Contact(picture.key), context);
        // The last picture may not have the field yet.
        let view = match self.view.shown.is_of(&picture.key.lubricant) {
            true => self.view,
            false => MapView { shown: Shown::Film, ..self.view },
        };
        self.images.follow(ui.ctx(), picture, &view);
        let framed = self.framed.replace(picture.kappa()).unwrap_or(1.0) == picture.kappa();
        let drawing =
            Drawing { picture, images: &self.images, view, cuts: context.cuts, fit: context.fit, framed, stale };
        let height = ui.available_height();
        let whole = ui.horizontal_top(|ui| {
            let width = (ui.available_width() - color_bar::WIDTH - 8.0).max(200.0);
            let drawn = ui.vertical(|ui| {
                ui.set_width(width);
                drawing.ui(ui, height)
            });
            scale::ui(ui, drawing.images, picture, &drawing.view, height);
            drawn.inner
        });
        let (response, transform) = whole.inner;
        drag_cuts(ui, (context.cuts, picture.kappa()), &response, &transform, commands);
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        if context.document.point.kind.is_line() {
            return vec![space_time::offer(context)];
        }
        let picture = context.answers.picture().filter(|picture| picture.has_plane());
        let tip = "X, Y, P, H of all nodes of both halves, dimensionless and in SI units";
        let image = || Command::Ask(Purpose::Write(Written::Png, self.images.png().into()));
        vec![
            Offer::table("Map as CSV…", tip, picture, |picture| export::csv(picture, context.answers.means())),
            Offer::new("Bare map as PNG…", "The map alone, pixel by pixel", picture.map(|_| image)),
        ]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        if context.document.point.kind.is_line() {
            return shared::caption(context.transient, context.system);
        }
        let more = export::particulars(context.answers, &self.view)?;
        let key = context.answers.picture()?.key;
        Some(format!("{}; {more}", caption::contact(&key.point, &key.lubricant, context.system)))
    }

    fn kept(&self) -> Option<String> {
        view::kept(&self.view)
    }

    fn restore(&mut self, text: &str) -> bool {
        view::restore(&mut self.view, text, |view| optics::are_sound(&view.rig))
    }
}

/// Returns the draggable cuts, at X and at Y.
fn grips() -> [Grip; 2] {
    ["cut x", "cut y"].map(|cut| Grip::new("map", cut))
}

fn drag_cuts(
    ui: &Ui,
    (mut cuts, kappa): (Cuts, f64),
    response: &Response,
    transform: &PlotTransform,
    commands: &mut Commands,
) {
    let spot = transform.position_from_point(&PlotPoint::new(cuts.x, kappa * cuts.y));
    let near = |p: egui::Pos2| [(p.x - spot.x).abs() < GRAB, (p.y - spot.y).abs() < GRAB];
    let hovered = response.hover_pos().map_or([false; 2], near);
    let held = grips().map(|grip| grip.is_held(ui));
    match if held.contains(&true) { held } else { hovered } {
        [false, false] => {}
        [true, true] => ui.ctx().set_cursor_icon(CursorIcon::Move),
        [true, false] => ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal),
        [false, true] => ui.ctx().set_cursor_icon(CursorIcon::ResizeVertical),
    }
    for ((grip, near), along_x) in grips().into_iter().zip(hovered).zip([true, false]) {
        let Some(pointer) = grip.follow(ui, near) else { continue };
        let to = transform.value_from_position(pointer);
        if along_x {
            cuts.x = snapped(to.x);
        } else {
            cuts.y = snapped(to.y / kappa);
        }
        commands.push(Command::Cut(cuts));
    }
}

/// Content of one frame.
struct Drawing<'a> {
    picture: &'a Picture,
    images: &'a Images,
    view: MapView,
    cuts: Cuts,
    fit: bool,
    /// True if the axes already fit the elliptical contact.
    framed: bool,
    stale: bool,
}

impl Drawing<'_> {
    fn ui(&self, ui: &mut Ui, height: f32) -> (Response, PlotTransform) {
        let palette = Palette::of(ui);
        let held = grips().iter().any(|grip| grip.is_held(ui));
        let Self { picture, images, view, cuts, fit, framed, stale } = *self;
        let system = units::system(ui.ctx());
        let along = Scales::of(&picture.key.point, system).along;
        // Both axes are in units of a, so that an elliptical contact has its true shape.
        let kappa = picture.kappa();
        let (from, to) = frame(kappa, vec2(ui.available_width(), height) - AXES);
        let y_title = if kappa == 1.0 { "{Y} = {y}/{a}" } else { "{y}/{a}" };
        let shown = axes::show(
            axes::plot(ui, "contact map", height, "{X} = {x}/{a}", y_title)
                .units_x(along, "{x}")
                .units_y(along, "{y}")
                .data_aspect(1.0)
                .default_x_bounds(from[0], to[0])
                .default_y_bounds(from[1], to[1])
                .allow_drag(!held)
                .label_formatter(|at| hover(picture, &view, at, system)),
            ui,
            NAME,
            |plot| {
                axes::fit(plot, fit);
                if !(framed || plot.locked) {
                    let (from, to) = frame(kappa, plot.response().rect.size());
                    plot.set_plot_bounds(PlotBounds::from_min_max(from, to));
                }
                image(plot, images, stale);
                contour_lines(plot, images);
                let ellipse = move |t: f64| (t.cos(), kappa * t.sin());
                let hertz = PlotPoints::from_parametric_callback(ellipse, 0.0..=std::f64::consts::TAU, 181);
                let hertz = Line::new("", hertz).id("hertz").color(faded(Color32::WHITE, 0.75)).width(1.0);
                plot.line(hertz.style(LineStyle::dashed_dense()).allow_hover(false));
                let color = if view.shown == Shown::Interferogram { Color32::WHITE } else { palette.accent };
                // These lines are for dragging and are not part of a figure.
                let plot: &mut egui_plot::PlotUi<'_> = plot;
                plot.vline(VLine::new("", cuts.x).id("cut x").color(color).width(1.6).allow_hover(false));
                plot.hline(HLine::new("", kappa * cuts.y).id("cut y").color(color).width(1.6).allow_hover(false));
            },
        );
        let response = shown.response;
        (described(ui, response, &spoken(picture, &view, system)), shown.transform)
    }
}

/// Returns axis ranges that show a whole elliptical contact in the available space. For a circular contact they are
/// constant.
fn frame(kappa: f64, room: Vec2) -> ([f64; 2], [f64; 2]) {
    let (middle, half) = (0.5 * (X_RANGE.0 + X_RANGE.1), 0.5 * (X_RANGE.1 - X_RANGE.0));
    let up = kappa * Y_RANGE;
    let wide = up * f64::from(room.x.max(1.0) / room.y.max(1.0));
    let across = if kappa == 1.0 { half } else { half.max(wide) };
    ([middle - across, -up], [middle + across, up])
}

/// Draws contour lines that are visible on every colour of the map.
fn contour_lines<'a>(plot: &mut Canvas<'_, 'a>, images: &'a Images) {
    let color = Color32::from_white_alpha(170);
    for (k, (name, line)) in images.contours().iter().enumerate() {
        let line = Line::new("", PlotPoints::Borrowed(line)).id(("contour", k)).color(color).width(1.0);
        plot.line(line.allow_hover(false));
        if let Some((at, text)) = name {
            let text = RichText::new(text).size(10.5).color(color).background_color(Color32::from_black_alpha(110));
            plot.text(Text::new("", *at, text).id(("contour name", k)).allow_hover(false));
        }
    }
}

fn image(plot: &mut Canvas<'_, '_>, images: &Images, stale: bool) {
    let Some((texture, (from, to, edge))) = images.texture(plot.ctx()) else { return };
    plot.field("field", texture, (from, to), (edge, -edge), drawn::tint(stale));
}

fn hover(picture: &Picture, view: &MapView, at: &HoverPosition<'_>, system: UnitSystem) -> Option<String> {
    let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
    let y = position.y / picture.kappa();
    let solution = &picture.solution;
    let (p, h) = solution.at(position.x, y)?;
    let (hertz, scale) = (picture.key.point.hertz(), picture.key.point.film_scale_m());
    let more = match view.shown {
        Shown::Interferogram if !view.three_colors => {
            format!("\norder {}", numbers::digits(view.rig.order(h * scale, view.rig.wavelength_m), 3))
        }
        Shown::Asperities => {
            let carried = solution.problem.asperity_pressure(h);
            let pascal = carried * hertz.pressure_pa;
            format!("\nP_a = {}   ({})", numbers::significant(carried), numbers::pressure(pascal, system))
        }
        Shown::Temperature => solution
            .heat
            .as_deref()
            .and_then(|heat| {
                let rise = |node: usize| Some(Rises::of(heat.rise_k.get(node)?).mid_film_k);
                solution.value_at(rise, position.x, y)
            })
            .map_or_else(String::new, |rise| {
                format!("\nrise {}", numbers::shown(QuantityKind::TemperatureRise, rise, system))
            }),
        _ => String::new(),
    };
    Some(format!(
        "X = {}   ({})\nY = {}   ({})\nP = {}   ({})\nH = {}   ({}){more}",
        numbers::digits(position.x, 3),
        numbers::length(position.x * hertz.half_width_m, system),
        numbers::digits(y, 3),
        numbers::length(y * hertz.half_length_m, system),
        numbers::significant(p),
        numbers::pressure(p * hertz.pressure_pa, system),
        numbers::significant(h),
        numbers::length(h * scale, system)
    ))
}

/// Returns the map as text for screen readers.
fn spoken(picture: &Picture, view: &MapView, system: UnitSystem) -> String {
    let (s, scale) = (picture.solution.scalars, picture.key.point.film_scale_m());
    let heat = picture.solution.heat.as_deref();
    let warms = heat.map_or_else(String::new, |heat| {
        format!(
            ", largest temperature rise in the film {}",
            numbers::shown(QuantityKind::TemperatureRise, heat.outside_spike.mid_film_k, system)
        )
    });
    format!(
        "{} of {}: central film thickness {}, minimum {} at X {}, Y ±{}{warms}",
        view.shown.name(),
        numbers::contact(&picture.key.point),
        numbers::length(s.h_c * scale, system),
        numbers::length(s.h_min * scale, system),
        numbers::digits(s.x_h_min, 3),
        numbers::digits(s.y_h_min.abs(), 3)
    )
}
