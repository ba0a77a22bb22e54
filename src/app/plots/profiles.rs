//! Pressure and film against X, one above the other on a shared axis; the difference to the full solution below on request.

use super::axes;
use crate::app::command::Command;
use crate::app::controls::warning_ui;
use crate::app::export;
use crate::app::files::Purpose;
use crate::app::numbers;
use crate::app::picture::{Comparison, Cuts, Origin, Picture, value_at};
use crate::app::state::{Pin, State};
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, THIN_WIDTH, faded, rich};
use egui::{Align2, Checkbox, Color32, Id, Ui, Vec2b};
use egui_plot::{
    Corner, HoverPosition, Legend, Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi, Points, Span,
    Text,
};

/// X range at first: the contact with its inlet and outlet.
const X_RANGE: (f64, f64) = (-2.2, 1.6);

/// The tab.
pub fn ui(ui: &mut Ui, state: &mut State) {
    toolbar(ui, state);
    pins_ui(ui, state);
    let stale = state.picture_is_stale(ui.input(|i| i.time));
    if stale && let Some(picture) = &state.picture {
        stale_note(ui, picture);
    }
    let Some(picture) = &state.picture else {
        ui.centered_and_justified(|ui| ui.weak("The first picture is being computed"));
        return;
    };
    let reduced = picture.origin != Origin::Full;
    let full = state.full.as_ref().filter(|_| state.display.overlay && reduced);
    let comparison = state.comparison.as_ref().filter(|_| state.display.difference);
    let parts = if comparison.is_some() { 2.6 } else { 2.0 };
    let unit = (ui.available_height() - 6.0) / parts;
    let scene = Scene {
        picture,
        full,
        pins: &state.pins,
        stale,
        full_stale: !state.full_is_current(),
        fit: state.fit_plots,
        cuts: state.display.cuts,
    };
    let stack = |ui: &mut Ui, direction: Direction| {
        pressure_plot(ui, &scene, direction, unit);
        film_plot(ui, &scene, direction, unit);
    };
    if !picture.has_plane() {
        stack(ui, Direction::Along);
    } else {
        ui.horizontal_top(|ui| {
            let across = 0.4 * (ui.available_width() - 8.0);
            let along = ui.available_width() - 8.0 - across;
            for (direction, width) in [(Direction::Along, along), (Direction::Across, across)] {
                ui.vertical(|ui| {
                    ui.set_width(width);
                    stack(ui, direction);
                });
            }
        });
    }
    if let Some(comparison) = comparison {
        difference_plot(ui, comparison, state.fit_plots, 0.6 * unit);
    }
}

/// Says that a picture belongs to other sliders.
pub fn stale_note(ui: &mut Ui, picture: &Picture) {
    let note = format!("The picture belongs to {}, not to the sliders", numbers::moes(picture.key.point.moes()));
    warning_ui(ui, &note);
}

/// In which direction a profile runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Direction {
    /// Along X, in the direction of motion.
    Along,
    /// Across, along Y, of a point contact.
    Across,
}

impl Direction {
    fn pressure(self, picture: &Picture) -> &[PlotPoint] {
        match self {
            Self::Along => &picture.pressure,
            Self::Across => &picture.across.pressure,
        }
    }

    fn film(self, picture: &Picture) -> &[PlotPoint] {
        match self {
            Self::Along => &picture.film,
            Self::Across => &picture.across.film,
        }
    }

    /// Name of the coordinate.
    fn name(self) -> &'static str {
        match self {
            Self::Along => "X",
            Self::Across => "Y",
        }
    }

    /// Range at first: the contact with its inlet and outlet, or with both sides.
    fn range(self) -> (f64, f64) {
        match self {
            Self::Along => X_RANGE,
            Self::Across => (-1.6, 1.6),
        }
    }

    /// Names of the plots that share an axis; those of the other direction have their own.
    fn id(self, plot: &str) -> String {
        match self {
            Self::Along => plot.to_owned(),
            Self::Across => format!("{plot} across"),
        }
    }

    fn x_title(self, picture: &Picture, cuts: Cuts) -> String {
        match self {
            Self::Along if picture.has_plane() => {
                format!("{{X}} = {{x}}/{{a}} at {{Y}} = {}", numbers::digits(cuts.y, 3))
            }
            Self::Along => "{X} = {x}/{a}".to_owned(),
            Self::Across => format!("{{Y}} = {{y}}/{{a}} at {{X}} = {}", numbers::digits(cuts.x, 3)),
        }
    }

    /// Where on the other axis the profile lies.
    fn elsewhere(self, cuts: Cuts) -> f64 {
        match self {
            Self::Along => cuts.y,
            Self::Across => cuts.x,
        }
    }
}

fn toolbar(ui: &mut Ui, state: &mut State) {
    let ctx = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        super::badge::ui(ui, state);
        if ui.button("Pin curve").on_hover_text("Keep this curve and its parameters for comparison (Ctrl+D)").clicked()
        {
            state.pin();
        }
        let reduced = state.picture.as_ref().is_some_and(|p| p.origin != Origin::Full);
        let why = "The picture is the full solution itself";
        let switches = [
            ("Full solution", "Draw the full solution over the reduced one", &mut state.display.overlay),
            ("Difference", "Reduced minus full, on an axis of its own", &mut state.display.difference),
        ];
        for (name, tip, on) in switches {
            ui.add_enabled(reduced, Checkbox::new(on, name)).on_hover_text(tip).on_disabled_hover_text(why);
        }
        if ui.button(Command::Verify.name()).on_hover_text("Solve this contact in full now (F5)").clicked() {
            state.verify(&ctx);
        }
        if ui
            .button("Export CSV…")
            .on_hover_text("Live, full and pinned profiles with their SI twins, all of the domain")
            .clicked()
            && let Some(text) = export::profiles(state)
        {
            state.ask_path(&ctx, Purpose::Csv { text });
        }
        if let Some(picture) = state.picture.as_ref().filter(|picture| picture.has_plane()) {
            let across = ui.button("Export across…").on_hover_text("The live profile across as CSV, with its SI twins");
            if across.clicked() {
                let text = export::profile_across(picture, state.display.cuts.x);
                state.ask_path(&ctx, Purpose::Csv { text });
            }
            super::contact_map::cuts_ui(ui, state);
        }
    });
}

fn pins_ui(ui: &mut Ui, state: &mut State) {
    if state.pins.is_empty() {
        return;
    }
    let mut removed = None;
    ui.horizontal_wrapped(|ui| {
        let color = ui.visuals().text_color();
        for (k, pin) in state.pins.iter().enumerate() {
            let moes = pin.picture.key.point.moes();
            let text = format!(
                "Pin {}: {{M}} {}, {{L}} {}, {{H_c}} {}",
                pin.number,
                numbers::significant(moes.m),
                numbers::significant(moes.l),
                numbers::significant(pin.picture.solution.scalars.h_c)
            );
            ui.label(rich(&text, 12.5, color)).on_hover_text(export::describe(&pin.picture));
            let response = ui.small_button("×").on_hover_text("Remove this pin");
            if crate::app::controls::named(ui, response, &format!("Remove pin {}", pin.number)).clicked() {
                removed = Some(k);
            }
            ui.add_space(8.0);
        }
    });
    if let Some(k) = removed {
        state.pins.remove(k);
    }
}

fn pin_name(pin: &Pin) -> String {
    format!("Pin {}: {}", pin.number, numbers::moes(pin.picture.key.point.moes()))
}

struct Scene<'a> {
    picture: &'a Picture,
    full: Option<&'a Picture>,
    pins: &'a [Pin],
    stale: bool,
    full_stale: bool,
    fit: bool,
    cuts: Cuts,
}

impl<'a> Scene<'a> {
    /// Pinned, live and full curves of one quantity; returns the colour of the live one.
    fn curves(
        &self,
        plot: &mut PlotUi<'a>,
        palette: &Palette,
        color: Color32,
        of: impl Fn(&'a Picture) -> &'a [PlotPoint],
    ) -> Color32 {
        for pin in self.pins {
            plot.line(curve(pin_name(pin), of(&pin.picture), faded(color, 0.45), THIN_WIDTH));
        }
        let live = if self.stale { palette.reference } else { color };
        let name = if self.picture.origin == Origin::Full { "Full solution" } else { "Reduced model" };
        plot.line(curve(name.to_owned(), of(self.picture), live, LIVE_WIDTH).id("live"));
        if let Some(full) = self.full {
            let over = if self.full_stale { palette.reference } else { palette.over(color) };
            plot.line(curve(full_name(self), of(full), over, FULL_WIDTH).id("full"));
        }
        live
    }
}

/// A plot of the stack: shared X axis and cursor.
fn stacked<'a>(ui: &Ui, direction: Direction, id: &str, height: f32, x_title: &str, y_title: &str) -> Plot<'a> {
    let group = Id::unique(direction.id("profiles"));
    let marks = if direction == Direction::Along { 9.0 } else { 5.0 };
    axes::plot(ui, &direction.id(id), height, x_title, y_title)
        .x_grid_spacer(move |input| axes::round_marks(input, marks))
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .set_margin_fraction(egui::vec2(0.0, 0.0))
        .show_y(false)
        .legend(legend(Corner::LeftTop))
}

fn legend(corner: Corner) -> Legend {
    Legend::default().position(corner).follow_insertion_order(true).background_alpha(0.6)
}

fn hover(picture: &Picture, direction: Direction) -> impl Fn(&HoverPosition<'_>) -> Option<String> + '_ {
    move |at| {
        let x = match at {
            HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position } => position.x,
        };
        let (p, h) = (value_at(direction.pressure(picture), x)?, value_at(direction.film(picture), x)?);
        let point = &picture.key.point;
        let hertz = point.hertz();
        Some(format!(
            "{} = {}   ({})\nP = {}   ({})\nH = {}   ({})",
            direction.name(),
            numbers::digits(x, 4),
            numbers::length(x * hertz.half_width_m),
            numbers::significant(p),
            numbers::pressure(p * hertz.pressure_pa),
            numbers::significant(h),
            numbers::length(h * point.film_scale_m())
        ))
    }
}

fn cavitated(plot: &mut PlotUi<'_>, picture: &Picture, palette: &Palette) {
    if let (Some(from), Some(end)) = (picture.rupture, picture.pressure.last()) {
        plot.span(Span::new("", from..=end.x.max(from)).fill(palette.cavitated).border_width(0.0));
    }
}

fn curve<'a>(name: String, points: &'a [PlotPoint], color: Color32, width: f32) -> Line<'a> {
    Line::new(name, PlotPoints::Borrowed(points)).color(color).width(width).allow_band(false)
}

/// A dot with its name; the name stands clear of the curve by a leading space or line.
fn mark(plot: &mut PlotUi<'_>, at: (f64, f64), name: &'static str, color: Color32, anchor: Align2) {
    let dot = Points::new("", vec![[at.0, at.1]]).id(name).shape(MarkerShape::Circle).radius(3.5).color(color);
    plot.points(dot.allow_hover(false));
    let text = match anchor {
        Align2::CENTER_TOP => format!("\n{name}"),
        Align2::RIGHT_BOTTOM => format!("{name}  "),
        _ => format!("  {name}"),
    };
    let label = Text::new("", PlotPoint::new(at.0, at.1), rich(&text, 13.0, color));
    plot.text(label.anchor(anchor).id((name, "label")).allow_hover(false));
}

fn pressure_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) {
    let palette = Palette::of(ui);
    let picture = scene.picture;
    let scalars = picture.solution.scalars;
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.p_max).fold(scalars.p_max.max(1.0), f64::max);
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let (on_axis, height_here) = (elsewhere == 0.0 && direction == Direction::Along, 1.0 - elsewhere * elsewhere);
    let y_title = if direction == Direction::Along { "Pressure {P} = {p}/{p_H}" } else { "" };
    stacked(ui, direction, "pressure", height, "", y_title)
        .default_x_bounds(from, to)
        .default_y_bounds(-0.04 * top, numbers::round_up(1.12 * top))
        .label_formatter(hover(picture, direction))
        .show(ui, |plot| {
            axes::fit(plot, scene.fit);
            if on_axis {
                cavitated(plot, picture, &palette);
            }
            let hertz: PlotPoints<'_> =
                PlotPoints::from_explicit_callback(move |x| (height_here - x * x).max(0.0).sqrt(), -1.0..=1.0, 201);
            plot.line(
                Line::new("Hertz", hertz).color(palette.reference).width(THIN_WIDTH).style(LineStyle::dashed_dense()),
            );
            let live = scene.curves(plot, &palette, palette.pressure, move |picture| direction.pressure(picture));
            if let Some(spike) = picture.spike.filter(|s| on_axis && (s.0 < scalars.x_p_max - 1e-9 || s.0 > 0.5)) {
                mark(plot, spike, "spike", live, Align2::LEFT_BOTTOM);
            }
        });
}

fn full_name(scene: &Scene<'_>) -> String {
    match scene.full {
        Some(full) if scene.full_stale => format!("Full, of {}", numbers::moes(full.key.point.moes())),
        _ => "Full solution".to_owned(),
    }
}

fn film_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) {
    let palette = Palette::of(ui);
    let picture = scene.picture;
    let scalars = picture.solution.scalars;
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.h_c).fold(scalars.h_c, f64::max);
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let x_title = direction.x_title(picture, scene.cuts);
    let y_title = if direction == Direction::Along { "Film {H} = {h}{R}/{a}²" } else { "" };
    stacked(ui, direction, "film", height, &x_title, y_title)
        .default_x_bounds(from, to)
        .default_y_bounds(0.0, numbers::round_up(4.0 * top))
        // The inlet's film comes down from the top left.
        .legend(legend(Corner::LeftBottom))
        .label_formatter(hover(picture, direction))
        .show(ui, |plot| {
            axes::fit(plot, scene.fit);
            if direction == Direction::Along && elsewhere == 0.0 {
                cavitated(plot, picture, &palette);
            }
            let live = scene.curves(plot, &palette, palette.film, move |picture| direction.film(picture));
            if elsewhere == 0.0 {
                mark(plot, (0.0, scalars.h_c), "{H_c}", live, Align2::LEFT_BOTTOM);
            }
            let Some(at) = minimum_on(direction, scene) else { return };
            // Below the curve, unless the axis would cut the name off.
            let below = plot.transform().position_from_point(&PlotPoint::new(0.0, scalars.h_min)).y + 34.0;
            let room = below < plot.response().rect.bottom();
            let anchor = if room { Align2::CENTER_TOP } else { Align2::RIGHT_BOTTOM };
            mark(plot, (at, scalars.h_min), "{H_min}", live, anchor);
        });
}

/// Where a profile meets the smallest film, if it does: within what two hundredths of the contact make of it.
fn minimum_on(direction: Direction, scene: &Scene<'_>) -> Option<f64> {
    const NEAR: f64 = 0.02;
    let s = scene.picture.solution.scalars;
    match direction {
        Direction::Along => ((scene.cuts.y.abs() + s.y_h_min).abs() < NEAR).then_some(s.x_h_min),
        Direction::Across => ((scene.cuts.x - s.x_h_min).abs() < NEAR).then_some(s.y_h_min),
    }
}

fn difference_plot(ui: &mut Ui, comparison: &Comparison, wanted: bool, height: f32) {
    let palette = Palette::of(ui);
    stacked(ui, Direction::Along, "difference", height, "", "Reduced − full")
        .default_x_bounds(X_RANGE.0, X_RANGE.1)
        .set_margin_fraction(egui::vec2(0.0, 0.08))
        .show(ui, |plot| {
            axes::fit(plot, wanted);
            plot.line(curve("ΔP".to_owned(), &comparison.pressure, palette.pressure, 1.4));
            plot.line(curve("ΔH/H_c".to_owned(), &comparison.film, palette.film, 1.4));
        });
}
