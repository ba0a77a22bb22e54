//! Plots of traction, film thickness and, for rough surfaces, the load share of asperities with a common axis. A click
//! in a plot moves the contact to that place.

use super::axes::{Axes, Points2, Quantity, drawn, near};
use super::sweeps::{Choices, Markers};
use super::tab::ShownSweep;
use crate::app::context::Context;
use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::tabs::traction::{Against, Companion, Curve, Sample, Sweep};
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, THIN_WIDTH, faded, rich};
use crate::scene::MeasuredPoint;
use crate::solver::full::{Lubrication, Mixed, TractionDoubt};
use crate::solver::physics::engineering::{QuantityKind, Unit, UnitSystem};
use egui::{Align2, Color32, CursorIcon, Id, PointerButton, Ui, Vec2b};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, PlotPoint, Points, Span, Text, VLine};

/// Minimum height of a readable plot.
const LEAST_HEIGHT: f32 = 110.0;

/// Height of the plot of the load share relative to the others.
const SHARE_HEIGHT: f32 = 0.7;
/// Share of the axis that a range needs for its name.
const NAMED: f64 = 0.1;
/// Opacity of a curve outside the trained range, and of the companion curve.
const SKETCH: f32 = 0.7;
const COMPANION: f32 = 0.55;
/// Height of the label on the companion curve, as a share of the plot.
const COMPANION_LABEL: f64 = 0.9;

/// Traction, traction of the companion, and central and minimum film thickness in SI units.
const TRACTION: Quantity = |sample| Some(sample.traction);
const OF_COMPANION: Quantity = |sample| sample.companion;
const CENTRAL: Quantity = |sample| Some(sample.h_c_m);
const SMALLEST: Quantity = |sample| Some(sample.h_min_m);
/// Mean gap of rough surfaces at the centre \[m\].
const GAP: Quantity = |sample| gap_m(&sample.mixed?, sample.h_c_m);
/// Parts of the traction of rough surfaces, and the share of the load that asperities carry.
const BOUNDARY: Quantity = |sample| Some(sample.mixed?.boundary_traction.abs());
const FLUID: Quantity = |sample| Some(sample.mixed?.fluid_traction.abs());
const CARRIED: Quantity = |sample| Some(sample.mixed?.asperity_load_share);

/// Returns the mean gap at the centre \[m\] of a contact with a central film thickness \[m\].
fn gap_m(mixed: &Mixed, h_c_m: f64) -> Option<f64> {
    let sigma_m = h_c_m / mixed.film_ratio_c;
    sigma_m.is_finite().then_some(mixed.mean_gap_c * sigma_m)
}

/// Returns the maximum differences between full solutions and their curve: of the traction coefficient, and of H_c
/// relative.
pub fn differences(curve: &Curve, markers: Option<&Markers>) -> Option<(f64, f64)> {
    let markers = markers.filter(|markers| markers.sweep == curve.sweep && !markers.samples.is_empty())?;
    let pairs = markers.samples.iter().filter_map(|full| {
        let same = |reduced: &&Sample| {
            let [a, b] = [&reduced.point, &full.point].map(|point| {
                [
                    point.speed_m_per_s,
                    point.sliding.slide_to_roll_ratio,
                    point.sliding.newtonian_plateau_ratio.unwrap_or(1.0),
                ]
            });
            a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs())
        };
        curve.samples.iter().find(same).map(|reduced| (reduced, full))
    });
    let worst = |(traction, film): (f64, f64), (reduced, full): (&Sample, &Sample)| {
        let error = (reduced.h_c_m / full.h_c_m - 1.0).abs();
        (traction.max((reduced.traction - full.traction).abs()), film.max(error))
    };
    Some(pairs.fold((0.0, 0.0), worst))
}

/// Draws the plots. Returns the clicked position on the axis.
pub fn ui(ui: &mut Ui, choices: &Choices, context: &Context<'_>, sweep: &Sweep, shown: &ShownSweep<'_>) -> Option<f64> {
    let palette = Palette::of(ui);
    let axes = Axes::new(choices, sweep, context.system);
    let rough = sweep.base.lubricant.is_rough();
    let parts = if rough { 2.0 + SHARE_HEIGHT } else { 2.0 };
    let unit = ((ui.available_height() - 6.0) / parts).max(LEAST_HEIGHT);
    let here = context.answers.shown_picture();
    let below = axes.against.axis(sweep.base.point.kind, context.system);
    let drawn = |name, of, color, width| Drawn { name, of, color, width, named_at_start: false };
    let [number, films, percent] = [QuantityKind::Number, QuantityKind::FilmThickness, QuantityKind::Percent]
        .map(|kind| kind.unit(context.system));
    let film_title = format!("Film in {}", films.name);
    let total = drawn("traction", TRACTION, palette.traction, LIVE_WIDTH);
    let parts = [
        drawn("of the film", FLUID, palette.film, 1.6),
        Drawn { named_at_start: true, ..drawn("of asperities", BOUNDARY, palette.pressure, 1.6) },
    ];
    let curves: Vec<Drawn> = std::iter::once(total).chain(parts.into_iter().filter(|_| rough)).collect();
    let traction = LinkedPlot {
        below: &below,
        name: "Traction along the quantity",
        id: "traction",
        titles: ("", "Traction coefficient µ"),
        unit: number,
        curves: &curves,
        here: here.map(|picture| (picture.traction.abs(), picture.unphysical.is_some())),
        measured: Points2::new(),
    };
    let film = LinkedPlot {
        below: &below,
        name: "Film along the quantity",
        id: "film",
        titles: (if rough { "" } else { &below }, &film_title),
        unit: films,
        curves: &[
            match rough {
                true => drawn("mean gap at the centre", GAP, palette.film, LIVE_WIDTH),
                false => drawn("central film thickness", CENTRAL, palette.film, LIVE_WIDTH),
            },
            drawn("minimum film thickness", SMALLEST, palette.film, 1.6),
        ],
        here: here.and_then(|picture| match &picture.mixed {
            Some(mixed) => Some((gap_m(mixed, picture.central_film_m())?, false)),
            None => Some((picture.central_film_m(), false)),
        }),
        measured: Points2::new(),
    };
    let share = LinkedPlot {
        below: &below,
        name: "Load share of asperities along the quantity",
        id: "share",
        titles: (&below, "On asperities, %"),
        unit: percent,
        curves: &[drawn("load share of asperities", CARRIED, palette.pressure, LIVE_WIDTH)],
        here: here.and_then(|picture| Some((picture.mixed?.asperity_load_share, false))),
        measured: Points2::new(),
    };
    let (traction, film) =
        (traction.with(&axes, context, |point| point.friction), film.with(&axes, context, |p| p.film_m));
    let mut pressed = traction.show(ui, context, &axes, shown, unit);
    pressed = film.show(ui, context, &axes, shown, unit).or(pressed);
    if rough {
        let linear = Axes { logarithmic: (axes.logarithmic.0, false), ..axes };
        pressed = share.show(ui, context, &linear, shown, SHARE_HEIGHT * unit).or(pressed);
    }
    pressed.map(|place| axes.value(place))
}

/// Curve of a plot.
struct Drawn {
    name: &'static str,
    of: Quantity,
    color: Color32,
    width: f32,
    /// True if the name is at the start of the curve, otherwise at its end.
    named_at_start: bool,
}

/// One of the two plots.
struct LinkedPlot<'a> {
    name: &'static str,
    id: &'static str,
    titles: (&'a str, &'a str),
    /// Unit of the vertical axis.
    unit: Unit,
    /// Quantity of the horizontal axis, also if its title is below the other plot.
    below: &'a str,
    curves: &'a [Drawn],
    /// Value of the contact on the screen in SI units, and whether it is unphysical.
    here: Option<(f64, bool)>,
    /// Measured values over the quantity of the horizontal axis, in SI units.
    measured: Points2,
}

impl LinkedPlot<'_> {
    /// Returns the plot with the measured values of a quantity.
    fn with(self, axes: &Axes<'_>, context: &Context<'_>, of: fn(&MeasuredPoint) -> Option<f64>) -> Self {
        let along = |point: &MeasuredPoint| match axes.against {
            Against::SlideToRoll => point.srr.map(f64::abs),
            Against::Speed => point.speed_m_per_s,
            _ => None,
        };
        let measured = context.measured.iter().filter_map(|point| Some([along(point)?, of(point)?])).collect();
        Self { measured, ..self }
    }

    fn show(
        &self,
        ui: &mut Ui,
        context: &Context<'_>,
        axes: &Axes<'_>,
        shown: &ShownSweep<'_>,
        height: f32,
    ) -> Option<f64> {
        let palette = Palette::of(ui);
        let marks = f64::from((ui.available_width() / 90.0).clamp(3.0, 9.0));
        let current = axes.along(axes.against.of(&context.document.key())).filter(|place| axes.shows(*place));
        let up = self.up(axes, shown, current.is_some());
        let response = axes::show(self.plot(ui, axes, height, marks, up), ui, self.name, |plot| {
            axes::fit(plot, context.fit);
            if let Some(current) = current {
                let line = VLine::new("", current).id("here line").color(palette.accent).width(1.0);
                plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
            }
            let samples = shown.samples();
            regimes(plot, axes, samples, &palette, (up, self.id == "traction"));
            if self.id == "traction" {
                let color = if shown.line_stale() { palette.reference } else { palette.traction };
                companion(plot, axes, samples, faded(color, COMPANION), up);
            }
            for (k, curve) in self.curves.iter().enumerate() {
                self.curve(plot, axes, shown, (k, curve), (&palette, up));
                if let Some(markers) = shown.markers {
                    let color = if shown.markers_stale { palette.reference } else { palette.over(curve.color) };
                    rings(plot, axes.points(&markers.samples, (curve.of, self.unit)), color, k);
                }
            }
            let place = |[x, y]: &[f64; 2]| Some([axes.along(*x)?, drawn(self.unit.number(*y), axes.logarithmic.1)?]);
            let measured: Points2 = self.measured.iter().filter_map(place).collect();
            if !measured.is_empty() {
                let measured = Points::new("measured", measured).color(palette.text).radius(4.0);
                plot.points(measured.shape(MarkerShape::Diamond).id((self.id, "measured")));
            }
            if let (Some(place), Some((value, unphysical))) = (current, self.here)
                && let Some(value) = drawn(self.unit.number(value), axes.logarithmic.1)
            {
                let color = if unphysical { palette.reference } else { palette.accent };
                let dot = Points::new("", vec![[place, value]]).id("here").color(color).radius(5.0);
                plot.points(dot.allow_hover(false));
            }
        });
        let transform = response.transform;
        let response = response.response;
        let held = response.is_pointer_button_down_on() && ui.input(|i| i.pointer.button_down(PointerButton::Primary));
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        let pointer = ui.input(|i| i.pointer.latest_pos()).filter(|_| held || response.clicked())?;
        Some(transform.value_from_position(pointer).x)
    }

    /// Returns the ends of the vertical axis. Unphysical values are ignored.
    fn up(&self, axes: &Axes<'_>, shown: &ShownSweep<'_>, here: bool) -> (f64, f64) {
        let seen = |sample: &&Sample| axes.place(sample).is_some_and(|place| axes.shows(place));
        let traction = self.id == "traction";
        let samples = shown.curve.iter().flat_map(|curve| &curve.samples);
        let samples = samples.chain(shown.markers.iter().flat_map(|markers| &markers.samples));
        let samples = samples.filter(seen).filter(|sample| !traction || sample.unphysical.is_none());
        let of_curves = samples.flat_map(|sample| self.curves.iter().filter_map(|curve| (curve.of)(sample)));
        let here = self.here.filter(|(_, unphysical)| here && !unphysical).map(|(value, _)| value);
        let measured = self.measured.iter().filter(|[x, _]| axes.along(*x).is_some_and(|place| axes.shows(place)));
        let measured = measured.map(|[_, y]| *y);
        let (from, to) = axes.up(of_curves.chain(here).chain(measured).map(|value| self.unit.number(value)));
        (from, if self.id == "share" { to.min(100.0) } else { to })
    }

    /// Draws one curve with its name at its end. Unphysical parts are grey and thin.
    fn curve(
        &self,
        plot: &mut Canvas<'_, '_>,
        axes: &Axes<'_>,
        shown: &ShownSweep<'_>,
        (k, curve): (usize, &Drawn),
        (palette, up): (&Palette, (f64, f64)),
    ) {
        let sketch = shown.curve.is_some_and(|curve| curve.served.untrained.is_some());
        let color = if shown.line_stale() { palette.reference } else { curve.color };
        // Solid lines are for curves inside the trained range only.
        let (color, style) = match (sketch, k) {
            (false, 0) => (color, LineStyle::Solid),
            (false, _) => (color, LineStyle::dashed_loose()),
            (true, 0) => (faded(color, SKETCH), LineStyle::dashed_dense()),
            (true, _) => (faded(color, SKETCH), LineStyle::dotted_dense()),
        };
        let width = if shown.curve.is_some() { curve.width } else { FULL_WIDTH };
        let samples = shown.samples();
        let mark = |sample: &Sample| sample.unphysical.filter(|_| self.id == "traction").map(TractionDoubt::mark);
        let mut end = 0;
        for (part, run) in samples.chunk_by(|a, b| mark(a) == mark(b)).enumerate() {
            let mark = run.first().and_then(mark);
            end += run.len();
            // Extend each part to the start of the next one.
            let next = samples.get(end);
            let (name, color, style, width) = match mark {
                Some(mark) => (format!("traction, {mark}"), palette.reference, LineStyle::dotted_loose(), THIN_WIDTH),
                None => (curve.name.to_owned(), color, style, width),
            };
            let points = near(axes.points(run.iter().chain(next), (curve.of, self.unit)), up);
            let line = Line::new(name, points).color(color).width(width);
            plot.line(line.style(style).id((self.id, k, part)).allow_band(false));
        }
        let points = axes.points(samples.iter().filter(|sample| mark(sample).is_none()), (curve.of, self.unit));
        let mut seen = points.into_iter().filter(|point| axes.shows(point[0]));
        if let Some([x, y]) = if curve.named_at_start { seen.next() } else { seen.next_back() } {
            let name = if sketch {
                format!("{}, outside the trained range  ", curve.name)
            } else {
                format!("  {}  ", curve.name)
            };
            let text = Text::new("", PlotPoint::new(x, y), rich(&name, axes::TITLE_SIZE, palette.ink(color)));
            // The name of the lower curve is placed below it.
            let anchor = match (k, curve.named_at_start) {
                (0, _) => Align2::RIGHT_BOTTOM,
                (_, false) => Align2::RIGHT_TOP,
                (_, true) => Align2::LEFT_TOP,
            };
            plot.text(text.anchor(anchor).id((self.id, k, "name")).allow_hover(false));
        }
    }

    fn plot<'p>(&self, ui: &Ui, axes: &Axes<'_>, height: f32, marks: f64, up: (f64, f64)) -> PlotFrame<'p> {
        let group = Id::unique("traction sweep");
        let (along, logarithmic) = axes.logarithmic;
        let margin = 0.02 * (axes.ends.1 - axes.ends.0);
        let unit = axes.unit.name;
        let unit = if unit.is_empty() { String::new() } else { format!("\u{2009}{unit}") };
        let plot = axes::plot(ui, self.id, height, self.titles.0, self.titles.1)
            .paper_x(self.below)
            .link_axis(group, Vec2b::new(true, false))
            .link_cursor(group, Vec2b::new(true, false))
            .allow_drag(false)
            .default_x_bounds(axes.ends.0 - margin, axes.ends.1 + margin)
            .default_y_bounds(up.0, up.1)
            .set_margin_fraction(egui::Vec2::ZERO)
            .show_y(false)
            .label_formatter(move |at: &HoverPosition<'_>| {
                let (name, position) = match at {
                    HoverPosition::NearDataPoint { plot_name, position, .. } => (*plot_name, position),
                    HoverPosition::Elsewhere { .. } => return None,
                };
                let value =
                    |v: f64, logarithmic: bool| numbers::significant(if logarithmic { 10f64.powf(v) } else { v });
                Some(format!("{name}\n{} at {}{unit}", value(position.y, logarithmic), value(position.x, along)))
            });
        let plot = if along { plot.log_x() } else { plot.marks_x(marks) };
        let plot = if self.id == "share" { plot.marks_y(3.0) } else { plot };
        if logarithmic { plot.log_y() } else { plot }
    }
}

/// Shades the ranges of boundary and mixed lubrication of rough surfaces, and names them in one of the plots.
fn regimes(
    plot: &mut Canvas<'_, '_>,
    axes: &Axes<'_>,
    samples: &[Sample],
    palette: &Palette,
    (up, named): ((f64, f64), bool),
) {
    let carried = |sample: &Sample| Some((axes.place(sample)?, Lubrication::of(sample.mixed?.asperity_load_share)));
    let places: Vec<(f64, Lubrication)> = samples.iter().filter_map(carried).collect();
    let mut from = places.first().map_or(0.0, |(place, _)| *place);
    let mut end = 0;
    for run in places.chunk_by(|a, b| a.1 == b.1) {
        end += run.len();
        let (Some((last, regime)), next) = (run.last(), places.get(end)) else { continue };
        let to = next.map_or(*last, |(next, _)| 0.5 * (last + next));
        let (left, right) = (from.max(axes.ends.0), to.min(axes.ends.1));
        let strength = match regime {
            Lubrication::Boundary => 0.22,
            Lubrication::Mixed => 0.1,
            Lubrication::FullFilm => 0.0,
        };
        if strength > 0.0 {
            let fill = faded(palette.pressure, strength);
            plot.span(Span::new("", from..=to).fill(fill).border_width(0.0));
        }
        if named && right - left > NAMED * (axes.ends.1 - axes.ends.0) {
            let at = PlotPoint::new(0.5 * (left + right), up.1);
            let text = Text::new("", at, rich(&format!("\n{}", regime.name()), axes::TITLE_SIZE, palette.quiet));
            plot.text(text.anchor(Align2::CENTER_TOP).id(("regime", end)).allow_hover(false));
        }
        from = to;
    }
}

/// Draws the companion curve. It does not change the axis. Its label is at its end or where it leaves the plot.
fn companion(plot: &mut Canvas<'_, '_>, axes: &Axes<'_>, samples: &[Sample], color: Color32, up: (f64, f64)) {
    let points = axes.points(samples, (OF_COMPANION, QuantityKind::Number.unit(UnitSystem::Si)));
    let Some(name) = axes.sweep.companion().map(Companion::name).filter(|_| !points.is_empty()) else { return };
    let level = up.0 + COMPANION_LABEL * (up.1 - up.0);
    let crossing = points.windows(2).find(|pair| pair[0][1] < level && pair[1][1] >= level).map(|pair| {
        let share = (level - pair[0][1]) / (pair[1][1] - pair[0][1]);
        ([pair[0][0] + share * (pair[1][0] - pair[0][0]), level], Align2::LEFT_CENTER)
    });
    let end = || points.iter().rfind(|point| axes.shows(point[0])).map(|point| (*point, Align2::RIGHT_BOTTOM));
    let label = crossing.or_else(end);
    let ink = Palette::of_screen(plot.ctx()).ink(color);
    let line = Line::new(name, near(points, up)).color(color).width(THIN_WIDTH);
    plot.line(line.style(LineStyle::dashed_loose()).id("companion").allow_band(false));
    if let Some(([x, y], anchor)) = label {
        let text = Text::new("", PlotPoint::new(x, y), rich(&format!("  {name}  "), axes::TITLE_SIZE, ink));
        plot.text(text.anchor(anchor).id("companion name").allow_hover(false));
    }
}

fn rings(plot: &mut Canvas<'_, '_>, points: Points2, color: Color32, k: usize) {
    let rings = Points::new("full solution", points).color(color).radius(4.0).filled(false);
    plot.points(rings.shape(MarkerShape::Circle).id(("rings", k)));
}
