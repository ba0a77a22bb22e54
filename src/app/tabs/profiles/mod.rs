//! Pressure and film against X, one above the other on a shared axis; the difference to the full solution below on
//! request.

mod film_shear;

use crate::app::answers::Pin;
use crate::app::answers::picture::{Comparison, Cuts, Origin, Picture, value_at};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::named;
use crate::app::drawn::{self, Owner};
use crate::app::export;
use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::tabs::cut_line::{self, CutLine};
use crate::app::tabs::direction::Direction;
use crate::app::tabs::key::{self, Entry, Sample};
use crate::app::tabs::plot_frame::PlotFrame;
use crate::app::tabs::take_away::Offer;
use crate::app::tabs::{axes, badge};
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, THIN_WIDTH, rich};
use crate::app::units::{Scales, Units};
use egui::{Align2, Checkbox, Color32, ComboBox, Id, Ui, Vec2b};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points, Span, Text};
use film_shear::{FilmShear, FilmShearImage};
use serde::{Deserialize, Serialize};

/// Where the first pinned curve bears its number, and how much further every other one.
const PIN_LABELS: (f64, f64) = (-0.92, 0.1);

/// What the tab shows beside the curves, and the image below them.
#[derive(Default)]
pub struct Profiles {
    /// How they are shown.
    pub choices: Choices,
    image: FilmShearImage,
}

/// How profiles are shown; kept with the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Draw the full solution over the reduced one.
    pub overlay: bool,
    /// Draw the difference below.
    pub difference: bool,
    /// What is shown across the film.
    pub film_shear: FilmShear,
}

impl Profiles {
    /// The tab.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        badge::ui(ui, context);
        toolbar(ui, &mut self.choices, context, commands);
        pins_ui(ui, context, commands);
        let answers = context.answers;
        let Some(picture) = &answers.picture else {
            ui.centered_and_justified(|ui| ui.weak("The first picture is being computed"));
            return;
        };
        let stale = drawn::is_grey(ui.ctx(), "profiles", Owner::Contact(picture.key), context);
        let reduced = picture.origin != Origin::Full;
        let full = answers.full.as_ref().filter(|_| self.choices.overlay && reduced);
        let comparison = answers.comparison.as_ref().filter(|_| self.choices.difference);
        let shear = self.choices.film_shear;
        if shear != FilmShear::Off {
            self.image.follow(ui.ctx(), picture, shear);
        }
        let extra = |shown: bool| if shown { 0.6 } else { 0.0 };
        let parts = 2.0 + extra(comparison.is_some()) + extra(shear != FilmShear::Off);
        let scene = Scene {
            picture,
            full,
            pins: &answers.pins,
            stale,
            full_stale: full
                .is_some_and(|full| drawn::is_grey(ui.ctx(), "full solution", Owner::Contact(full.key), context)),
            fit: context.fit,
            cuts: context.cuts,
        };
        key_ui(ui, &scene);
        let unit = (ui.available_height() - 6.0) / parts;
        let length_mm = Scales::of(&picture.key.point).length_mm;
        let mut moved = None;
        let mut stack = |ui: &mut Ui, direction: Direction| {
            let by_pressure = pressure_plot(ui, &scene, direction, unit);
            let by_film = film_plot(ui, &scene, direction, unit);
            moved = by_pressure.or(by_film).map(|to| (direction, to)).or(moved);
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
            difference_plot(ui, (comparison, length_mm), (context.fit, stale), 0.6 * unit);
        }
        if shear != FilmShear::Off {
            film_shear::ui(ui, (&self.image, length_mm), shear, stale, 0.6 * unit);
        }
        if let Some((direction, to)) = moved {
            let mut cuts = context.cuts;
            direction.move_other(&mut cuts, to);
            commands.push(Command::Cut(cuts));
        }
    }
}

/// The pressure and, as soon as there is a full solution, what the reduced one differs from it by, side by side.
pub fn with_difference(ui: &mut Ui, context: &Context<'_>) {
    let answers = context.answers;
    let Some(picture) = &answers.picture else {
        ui.weak("The first picture is being computed");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "profiles", Owner::Contact(picture.key), context);
    let scene =
        Scene { picture, full: None, pins: &[], stale, full_stale: false, fit: context.fit, cuts: context.cuts };
    let (height, half) = ((ui.available_height() - 4.0).max(90.0), 0.5 * ui.available_width() - 6.0);
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(half);
            pressure_plot(ui, &scene, Direction::Along, height);
        });
        ui.vertical(|ui| {
            ui.set_width(half);
            match &answers.comparison {
                Some(comparison) => {
                    let length_mm = Scales::of(&context.document.point).length_mm;
                    difference_plot(ui, (comparison, length_mm), (context.fit, stale), height);
                }
                None => _ = ui.weak("The difference appears when the sliders rest and the full solution is there"),
            }
        });
    });
}

fn toolbar(ui: &mut Ui, choices: &mut Choices, context: &Context<'_>, commands: &mut Commands) {
    let answers = context.answers;
    if context.presenting {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button("Pin curve").on_hover_text("Keep this curve and its parameters for comparison (Ctrl+D)").clicked()
        {
            commands.push(Command::Pin);
        }
        let reduced = answers.picture.as_ref().is_some_and(|p| p.origin != Origin::Full);
        let why = "The picture is the full solution itself";
        let switches = [
            ("Full solution", "Draw the full solution over the reduced one", &mut choices.overlay),
            ("Difference", "Reduced minus full, on an axis of its own", &mut choices.difference),
        ];
        for (name, tip, on) in switches {
            ui.add_enabled(reduced, Checkbox::new(on, name)).on_hover_text(tip).on_disabled_hover_text(why);
        }
        let shear = &mut choices.film_shear;
        let tip = "A field between the surfaces below the profiles";
        let choice = ComboBox::from_id_salt("film shear").selected_text(shear.name()).width(104.0).show_ui(ui, |ui| {
            for option in FilmShear::ALL {
                ui.selectable_value(shear, option, option.name()).on_hover_text(option.tip());
            }
        });
        named(ui, choice.response, "Across the film").on_hover_text(tip);
        if ui.button(Command::Verify.name()).on_hover_text("Solve this contact in full now (F5)").clicked() {
            commands.push(Command::Verify);
        }
        if answers.picture.as_ref().is_some_and(|picture| picture.has_plane()) {
            cut_line::cuts_ui(ui, context, commands);
        }
    });
}

/// What can be taken away from it.
pub fn offers<'a>(context: &Context<'a>) -> Vec<Offer<'a>> {
    let (answers, cuts) = (context.answers, context.cuts);
    let picture = answers.picture.as_ref();
    let tip = "Live, full and pinned profiles with their SI twins, all of the domain";
    let mut offers = vec![Offer::new("Profiles as CSV…", tip, picture.map(|_| || Command::ExportProfiles))];
    if let Some(picture) = picture.filter(|picture| picture.has_plane()) {
        let tip = "The live profile across, with its SI twins";
        let across = move |picture: &&Picture| export::profile_across(picture, cuts.x);
        offers.push(Offer::table("Profile across as CSV…", tip, Some(picture), across));
    }
    offers
}

fn pins_ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let pins = &context.answers.pins;
    if pins.is_empty() || context.presenting {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (k, pin) in pins.iter().enumerate() {
            let palette = Palette::of(ui);
            let color = palette.ink(palette.pin(pin.number));
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
            if named(ui, response, &format!("Remove pin {}", pin.number)).clicked() {
                commands.push(Command::RemovePin(k));
            }
            ui.add_space(8.0);
        }
    });
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
    /// Where the other profile cuts a point contact, in the plot of one quantity.
    fn cut_line(&self, direction: Direction, plot: &str) -> Option<CutLine> {
        self.picture.has_plane().then(|| CutLine::new(&direction.id(plot), direction.other(self.cuts)))
    }

    /// Pinned, live and full curves of one quantity; returns the colour of the live one.
    fn curves(
        &self,
        plot: &mut Canvas<'_, 'a>,
        palette: &Palette,
        color: Color32,
        of: impl Fn(&'a Picture) -> &'a [PlotPoint],
        unit: fn(Scales) -> f64,
    ) -> Color32 {
        // In SI units a curve of another contact keeps its own scales on the axes of this one.
        let own = Scales::of(&self.picture.key.point);
        let units = Units::of(plot.ctx());
        let fitted = |picture: &'a Picture| {
            let other = Scales::of(&picture.key.point);
            match units {
                Units::Si if other != own => {
                    let (x, y) = (other.length_mm / own.length_mm, unit(other) / unit(own));
                    let points = of(picture).iter().map(|point| PlotPoint::new(x * point.x, y * point.y));
                    PlotPoints::Owned(points.collect())
                }
                _ => PlotPoints::Borrowed(of(picture)),
            }
        };
        for (k, pin) in self.pins.iter().enumerate() {
            let (points, hue) = (fitted(&pin.picture), palette.pin(pin.number));
            // Its number, where numbers of others are not.
            let x = PIN_LABELS.0 + PIN_LABELS.1 * k as f64;
            let height = value_at(points.points(), x);
            plot.line(curve(pin_name(pin), points, hue, THIN_WIDTH));
            if let Some(y) = height {
                let text =
                    Text::new("", PlotPoint::new(x, y), rich(&format!("{}", pin.number), 11.5, palette.ink(hue)));
                plot.text(text.anchor(Align2::RIGHT_BOTTOM).id(("pin", pin.number)).allow_hover(false));
            }
        }
        let live = if self.stale { palette.reference } else { color };
        let name = if self.picture.origin == Origin::Full { "Full solution" } else { "Reduced model" };
        plot.line(curve(name.to_owned(), fitted(self.picture), live, LIVE_WIDTH).id("live"));
        if let Some(full) = self.full {
            let over = if self.full_stale { palette.reference } else { palette.over(color) };
            plot.line(curve(full_name(self), fitted(full), over, FULL_WIDTH).id("full"));
        }
        live
    }
}

/// What the lines mean, above them: there it covers nothing.
fn key_ui(ui: &mut Ui, scene: &Scene<'_>) {
    let palette = Palette::of(ui);
    let live = if scene.stale { palette.reference } else { palette.pressure };
    let name = if scene.picture.origin == Origin::Full { "full solution" } else { "reduced model" };
    let mut entries = vec![Entry::new(name, live, Sample::Line(LIVE_WIDTH))];
    if scene.full.is_some() {
        let color = if scene.full_stale { palette.reference } else { palette.over(palette.pressure) };
        entries.push(Entry::new(full_name(scene), color, Sample::Line(FULL_WIDTH)));
    }
    entries.push(Entry::new("dry contact (Hertz)", palette.reference, Sample::Dashed(THIN_WIDTH)));
    key::ui(ui, entries);
}

/// A plot of the stack: shared X axis and cursor.
fn stacked<'a>(
    ui: &Ui,
    (direction, length_mm): (Direction, f64),
    (id, height): (&str, f32),
    (x_title, y_title): (&str, &str),
) -> PlotFrame<'a> {
    let group = Id::unique(direction.id("profiles"));
    // As many marks as have room for their numbers.
    let marks = f64::from((ui.available_width() / 90.0).clamp(3.0, 9.0));
    axes::plot(ui, &direction.id(id), height, x_title, y_title)
        .marks_x(marks)
        .paper_x(format!("{{{0}}} = {{{1}}}/{{a}}", direction.name(), direction.name().to_lowercase()))
        .si_x(length_mm, &direction.si_title(x_title))
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .set_margin_fraction(egui::vec2(0.0, 0.0))
        .show_y(false)
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

fn cavitated(plot: &mut Canvas<'_, '_>, picture: &Picture, palette: &Palette) {
    if let (Some(from), Some(end)) = (picture.rupture, picture.pressure.last()) {
        plot.span(Span::new("", from..=end.x.max(from)).fill(palette.cavitated).border_width(0.0));
    }
}

/// λ of the full solution behind the contact, where complementarity ruptures the film.
fn multiplier(plot: &mut Canvas<'_, '_>, scene: &Scene<'_>, palette: &Palette) {
    let full = scene.full.filter(|_| !scene.full_stale).unwrap_or(scene.picture);
    let points: Vec<[f64; 2]> = full.solution.axis_multiplier().map(|(x, value)| [x, value]).collect();
    let Some(&[x, value]) = points.get(points.len() / 4) else { return };
    plot.line(Line::new("λ", points).color(palette.reference).width(1.4).style(LineStyle::dotted_dense()));
    let label = Text::new("", PlotPoint::new(x, value), rich("λ  ", 13.0, palette.ink(palette.reference)));
    plot.text(label.anchor(Align2::RIGHT_BOTTOM).id("multiplier label").allow_hover(false));
}

fn curve(name: String, points: PlotPoints<'_>, color: Color32, width: f32) -> Line<'_> {
    Line::new(name, points).color(color).width(width).allow_band(false)
}

/// A dot with its name; the name stands clear of the curve by a leading space or line.
fn mark(plot: &mut Canvas<'_, '_>, at: (f64, f64), name: &'static str, color: Color32, anchor: Align2) {
    let dot = Points::new("", vec![[at.0, at.1]]).id(name).shape(MarkerShape::Circle).radius(3.5).color(color);
    plot.points(dot.allow_hover(false));
    let text = match anchor {
        Align2::CENTER_TOP => format!("\n{name}"),
        Align2::RIGHT_BOTTOM => format!("{name}  "),
        _ => format!("  {name}"),
    };
    let ink = Palette::of_screen(plot.ctx()).ink(color);
    let label = Text::new("", PlotPoint::new(at.0, at.1), rich(&text, 13.0, ink));
    plot.text(label.anchor(anchor).id((name, "label")).allow_hover(false));
}

/// The pressure; returns where the hand takes the line of the other cut.
fn pressure_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) -> Option<f64> {
    let palette = Palette::of(ui);
    let picture = scene.picture;
    let (scalars, scales) = (picture.solution.scalars, Scales::of(&picture.key.point));
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.p_max).fold(scalars.p_max.max(1.0), f64::max);
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let (on_axis, height_here) = (elsewhere == 0.0 && direction == Direction::Along, 1.0 - elsewhere * elsewhere);
    let y_title = if direction == Direction::Along { "Pressure {P} = {p}/{p_H}" } else { "" };
    let cut = scene.cut_line(direction, "pressure");
    let shown = axes::show(
        stacked(ui, (direction, scales.length_mm), ("pressure", height), ("", y_title))
            .paper_y("Pressure {P} = {p}/{p_H}")
            .si_y(scales.pressure_gpa, "Pressure {p} / GPa")
            .allow_drag(cut.as_ref().is_none_or(|cut| !cut.is_held(ui)))
            .default_x_bounds(from, to)
            .default_y_bounds(-0.04 * top, numbers::round_up(1.12 * top))
            .label_formatter(hover(picture, direction)),
        ui,
        &direction.profile_name("Pressure"),
        |plot| {
            axes::fit(plot, scene.fit);
            if on_axis {
                cavitated(plot, picture, &palette);
            }
            let hertz: PlotPoints<'_> =
                PlotPoints::from_explicit_callback(move |x| (height_here - x * x).max(0.0).sqrt(), -1.0..=1.0, 201);
            plot.line(
                Line::new("Hertz", hertz).color(palette.reference).width(THIN_WIDTH).style(LineStyle::dashed_dense()),
            );
            let live = scene.curves(
                plot,
                &palette,
                palette.pressure,
                move |picture| direction.pressure(picture),
                |of| of.pressure_gpa,
            );
            if on_axis {
                multiplier(plot, scene, &palette);
            }
            if let Some(spike) = picture.spike.filter(|s| on_axis && (s.0 < scalars.x_p_max - 1e-9 || s.0 > 0.5)) {
                mark(plot, spike, "spike", live, Align2::LEFT_BOTTOM);
            }
            if let Some(cut) = &cut {
                cut.draw(plot, palette.accent);
            }
        },
    );
    cut?.moved(ui, &shown.response, &shown.transform)
}

fn full_name(scene: &Scene<'_>) -> String {
    match scene.full {
        Some(full) if scene.full_stale => format!("Full, of {}", numbers::moes(full.key.point.moes())),
        _ => "full solution".to_owned(),
    }
}

/// The film; returns where the hand takes the line of the other cut.
fn film_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) -> Option<f64> {
    let palette = Palette::of(ui);
    let picture = scene.picture;
    let (scalars, scales) = (picture.solution.scalars, Scales::of(&picture.key.point));
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.h_c).fold(scalars.h_c, f64::max);
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let x_title = direction.x_title(picture, scene.cuts);
    let y_title = if direction == Direction::Along { "Film {H} = {h}{R}/{a}²" } else { "" };
    let cut = scene.cut_line(direction, "film");
    let shown = axes::show(
        stacked(ui, (direction, scales.length_mm), ("film", height), (&x_title, y_title))
            .paper_y("Film {H} = {h}{R}/{a}²")
            .si_y(scales.film_um, "Film {h} / µm")
            .allow_drag(cut.as_ref().is_none_or(|cut| !cut.is_held(ui)))
            .default_x_bounds(from, to)
            .default_y_bounds(0.0, numbers::round_up(4.0 * top))
            .label_formatter(hover(picture, direction)),
        ui,
        &direction.profile_name("Film"),
        |plot| {
            axes::fit(plot, scene.fit);
            if direction == Direction::Along && elsewhere == 0.0 {
                cavitated(plot, picture, &palette);
            }
            let live =
                scene.curves(plot, &palette, palette.film, move |picture| direction.film(picture), |of| of.film_um);
            if elsewhere == 0.0 {
                mark(plot, (0.0, scalars.h_c), "{H_c}", live, Align2::LEFT_BOTTOM);
            }
            if let Some(cut) = &cut {
                cut.draw(plot, palette.accent);
            }
            let Some(at) = direction.minimum(picture, scene.cuts) else { return };
            // Below the curve, or below its outlet, unless the axis would cut the name off.
            let point = plot.transform().position_from_point(&PlotPoint::new(0.0, scalars.h_min));
            let anchor = match plot.response().rect.bottom() - point.y {
                room if room > 34.0 => Align2::CENTER_TOP,
                room if room > 20.0 => Align2::LEFT_TOP,
                _ => Align2::RIGHT_BOTTOM,
            };
            mark(plot, (at, scalars.h_min), "{H_min}", live, anchor);
        },
    );
    cut?.moved(ui, &shown.response, &shown.transform)
}

fn difference_plot(
    ui: &mut Ui,
    (comparison, length_mm): (&Comparison, f64),
    (wanted, stale): (bool, bool),
    height: f32,
) {
    let palette = Palette::of(ui);
    let (from, to) = Direction::Along.range();
    let plot = stacked(ui, (Direction::Along, length_mm), ("difference", height), ("", "Reduced − full"));
    axes::show(
        plot.default_x_bounds(from, to).set_margin_fraction(egui::vec2(0.0, 0.08)),
        ui,
        "Difference of the profiles",
        |plot| {
            axes::fit(plot, wanted);
            let color = |color| if stale { palette.reference } else { color };
            let lines = [
                ("ΔP", "Δ{P}", &comparison.pressure, palette.pressure, Align2::LEFT_BOTTOM),
                ("ΔH/H_c", "Δ{H}/{H_c}", &comparison.film, palette.film, Align2::LEFT_TOP),
            ];
            for (name, label, points, hue, anchor) in lines {
                plot.line(curve(name.to_owned(), PlotPoints::Borrowed(points), color(hue), 1.4));
                // At its largest, where it stands clear of the other.
                if let Some(at) = points.iter().max_by(|a, b| a.y.abs().total_cmp(&b.y.abs())) {
                    let text = Text::new("", *at, rich(&format!("  {label}"), 12.5, palette.ink(color(hue))));
                    plot.text(text.anchor(anchor).id((name, "label")).allow_hover(false));
                }
            }
        },
    );
}
