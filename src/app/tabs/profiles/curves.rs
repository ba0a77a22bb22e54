//! Common parts of the plots of pressure and film profiles. Curves are those of the present contact (live), of a full
//! solution drawn over it, and of results that were pinned for comparison.

use crate::app::answers::Pin;
use crate::app::answers::picture::{Cuts, Origin, Picture, value_at};
use crate::app::document::Shape;
use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::cut_line::CutLine;
use crate::app::plot::direction::Direction;
use crate::app::plot::frame::PlotFrame;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, THIN_WIDTH, faded, rich};
use crate::app::units::{self, Scale, Scales, Units};
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::physics::lubricant::Cavitation;
use egui::{Align2, Color32, Id, Ui, Vec2b};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points, Span, Text};

/// Position of the number on the first pinned curve, and distance to that of the next one.
const PIN_LABELS: (f64, f64) = (-0.92, 0.1);

fn pin_name(pin: &Pin) -> String {
    let point = &pin.picture.key.point;
    format!("Pin {}: {}, {}", pin.number, Shape::of(point).contact(), numbers::contact(point))
}

/// Results that the plots of the tab show.
pub struct Scene<'a> {
    /// Result for the present contact.
    pub picture: &'a Picture,
    /// Full solution that is drawn over it.
    pub full: Option<&'a Picture>,
    /// Pinned curves.
    pub pins: &'a [Pin],
    /// True if the result belongs to a previous contact.
    pub stale: bool,
    /// True if the full solution belongs to a previous contact.
    pub full_stale: bool,
    /// True if plots shall be fitted to their data.
    pub fit: bool,
    /// Position of the cuts through a point contact.
    pub cuts: Cuts,
}

impl<'a> Scene<'a> {
    /// Returns the line where the other profile cuts a point contact, in the plot of one quantity.
    pub fn cut_line(&self, direction: Direction, plot: &str) -> Option<CutLine> {
        self.picture.has_plane().then(|| CutLine::new(&direction.id(plot), direction.other(self.cuts)))
    }

    /// Returns the colour of a live curve: grey if it belongs to a previous contact.
    fn hue(&self, palette: &Palette, color: Color32) -> Color32 {
        if self.stale { palette.reference } else { color }
    }

    /// Draws pinned, live and full curves of one quantity. Returns the colour of the live one.
    pub fn curves(
        &self,
        plot: &mut Canvas<'_, 'a>,
        (palette, color): (&Palette, Color32),
        direction: Direction,
        of: impl Fn(&'a Picture) -> &'a [PlotPoint],
        unit: fn(Scales) -> f64,
    ) -> Color32 {
        // In dimensional units, curves of other contacts are rescaled to the axes of this one.
        let (units, system) = (Units::of(plot.ctx()), units::system(plot.ctx()));
        let own = Scales::of(&self.picture.key.point, system);
        let fitted = |picture: &'a Picture| {
            let other = Scales::of(&picture.key.point, system);
            match units {
                Units::Dimensional if other != own => {
                    let (x, y) =
                        (direction.length(other).factor / direction.length(own).factor, unit(other) / unit(own));
                    let points = of(picture).iter().map(|point| PlotPoint::new(x * point.x, y * point.y));
                    PlotPoints::Owned(points.collect())
                }
                _ => PlotPoints::Borrowed(of(picture)),
            }
        };
        for (k, pin) in self.pins.iter().enumerate() {
            let (points, hue) = (fitted(&pin.picture), palette.pin(pin.number));
            // Numbers of curves are moved along X, so that they do not overlap.
            let x = PIN_LABELS.0 + PIN_LABELS.1 * k as f64;
            let height = value_at(points.points(), x);
            plot.line(curve(pin_name(pin), points, hue, THIN_WIDTH));
            if let Some(y) = height {
                let text =
                    Text::new("", PlotPoint::new(x, y), rich(&format!("{}", pin.number), 11.5, palette.ink(hue)));
                plot.text(text.anchor(Align2::RIGHT_BOTTOM).id(("pin", pin.number)).allow_hover(false));
            }
        }
        let live = self.hue(palette, color);
        let name = if self.picture.origin == Origin::Full { "Full solution" } else { "Reduced model" };
        plot.line(curve(name.to_owned(), fitted(self.picture), live, LIVE_WIDTH).id("live"));
        if let Some(full) = self.full {
            let over = if self.full_stale { palette.reference } else { palette.over(color) };
            plot.line(curve(full_name(self), fitted(full), over, FULL_WIDTH).id("full"));
        }
        live
    }
}

/// Opacity of the asperity pressure within the total pressure, and of the band of the roughness around the film.
const ASPERITIES: f32 = 0.35;
const ROUGHNESS: f32 = 0.2;

/// Fills the area below the asperity pressure, a part of the total pressure of a rough contact.
pub fn asperities(plot: &mut Canvas<'_, '_>, scene: &Scene<'_>, direction: Direction, palette: &Palette) {
    let upper = direction.asperities(scene.picture);
    let lower: Vec<PlotPoint> = upper.iter().map(|point| PlotPoint::new(point.x, 0.0)).collect();
    plot.between("asperities", &lower, upper, faded(scene.hue(palette, palette.pressure), ASPERITIES));
}

/// Fills the band of the composite roughness around the film of a rough contact, H ± σ.
pub fn roughness(plot: &mut Canvas<'_, '_>, scene: &Scene<'_>, direction: Direction, palette: &Palette) {
    let Some(rough) = scene.picture.solution.problem.rough else { return };
    let film = direction.film(scene.picture);
    let moved = |by: f64| -> Vec<PlotPoint> { film.iter().map(|at| PlotPoint::new(at.x, at.y + by)).collect() };
    let fill = faded(scene.hue(palette, palette.film), ROUGHNESS);
    plot.between("roughness", &moved(-rough.sigma), &moved(rough.sigma), fill);
}

/// Draws the legend above the plots.
pub fn key_ui(ui: &mut Ui, scene: &Scene<'_>) {
    let palette = Palette::of(ui);
    let live = scene.hue(&palette, palette.pressure);
    let name = if scene.picture.origin == Origin::Full { "full solution" } else { "reduced model" };
    let mut entries = vec![Entry::new(name, live, Sample::Line(LIVE_WIDTH))];
    if scene.full.is_some() {
        let color = if scene.full_stale { palette.reference } else { palette.over(palette.pressure) };
        entries.push(Entry::new(full_name(scene), color, Sample::Line(FULL_WIDTH)));
    }
    entries.push(Entry::new("dry contact (Hertz)", palette.reference, Sample::Dashed(THIN_WIDTH)));
    if scene.picture.mixed.is_some() {
        entries.push(Entry::new("carried by asperities", faded(live, ASPERITIES), Sample::Area));
        let film = scene.hue(&palette, palette.film);
        entries.push(Entry::new("film ± σ", faded(film, ROUGHNESS), Sample::Area));
    }
    key::ui(ui, entries);
}

/// Creates one of the plots that stand below each other, with a common X axis and cursor.
pub fn stacked<'a>(
    ui: &Ui,
    (direction, length, kappa): (Direction, Scale, f64),
    (id, height): (&str, f32),
    (x_title, y_title): (&str, &str),
) -> PlotFrame<'a> {
    let group = Id::unique(direction.id("profiles"));
    // The number of ticks follows from the width.
    let marks = f64::from((ui.available_width() / 90.0).clamp(3.0, 9.0));
    axes::plot(ui, &direction.id(id), height, x_title, y_title)
        .marks_x(marks)
        .paper_x(direction.title(kappa))
        .units_x(length, &direction.dimensional_title(x_title))
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .set_margin_fraction(egui::vec2(0.0, 0.0))
        .show_y(false)
}

/// Returns the text at the pointer.
pub fn hover(
    picture: &Picture,
    direction: Direction,
    system: UnitSystem,
) -> impl Fn(&HoverPosition<'_>) -> Option<String> + '_ {
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
            numbers::length(x * direction.length_m(&hertz), system),
            numbers::significant(p),
            numbers::pressure(p * hertz.pressure_pa, system),
            numbers::significant(h),
            numbers::length(h * point.film_scale_m(), system)
        ))
    }
}

/// Draws the cavitated region and the starved inlet.
pub fn cavitated(plot: &mut Canvas<'_, '_>, picture: &Picture, palette: &Palette) {
    if let (Some(from), Some(end)) = (picture.rupture, picture.pressure.last()) {
        plot.span(Span::new("", from..=end.x.max(from)).fill(palette.cavitated).border_width(0.0));
    }
    if let (Some(end), Some(from)) = (picture.meniscus, picture.pressure.first()) {
        plot.span(Span::new("", from.x.min(end)..=end).fill(palette.cavitated).border_width(0.0));
    }
}

/// Draws the additional variable of the cavitated region: λ for the complementarity model, θ for the
/// mass-conserving model. A reduced model may use complementarity where the penalty is requested.
pub fn rupture(plot: &mut Canvas<'_, '_>, scene: &Scene<'_>, palette: &Palette) {
    let full = scene.full.filter(|_| !scene.full_stale).unwrap_or(scene.picture);
    let mut draw = |name: &str, points: Vec<[f64; 2]>, at: usize| {
        let Some(&[x, value]) = points.get(at) else { return };
        plot.line(Line::new(name, points).color(palette.reference).width(1.4).style(LineStyle::dotted_dense()));
        let text = rich(&format!("{name}  "), 13.0, palette.ink(palette.reference));
        let label = Text::new("", PlotPoint::new(x, value), text);
        plot.text(label.anchor(Align2::RIGHT_BOTTOM).id((name, "label")).allow_hover(false));
    };
    let asked = scene.picture.key.lubricant.cavitation == Cavitation::Complementarity;
    let multiplier = full.solution.axis_multiplier().filter(|_| asked).map(Into::into);
    let multiplier: Vec<[f64; 2]> = multiplier.collect();
    let quarter = multiplier.len() / 4;
    draw("λ", multiplier, quarter);
    let fraction: Vec<[f64; 2]> = full.solution.axis_fraction().map(Into::into).collect();
    // Place the label at the decrease behind the contact.
    let fallen = fraction.iter().rposition(|[_, value]| *value > 0.5).unwrap_or(0);
    draw("θ", fraction, fallen);
}

/// Returns a curve without a band.
pub fn curve(name: String, points: PlotPoints<'_>, color: Color32, width: f32) -> Line<'_> {
    Line::new(name, points).color(color).width(width).allow_band(false)
}

/// Draws a dot with its name. A leading space or line separates the name from the curve.
pub fn mark(plot: &mut Canvas<'_, '_>, at: (f64, f64), name: &'static str, color: Color32, anchor: Align2) {
    mark_lifted(plot, (at, 0.0), name, color, anchor);
}

/// Draws a dot with its name, with the name raised by `lift` in units of the axis.
pub fn mark_lifted(
    plot: &mut Canvas<'_, '_>,
    ((x, y), lift): ((f64, f64), f64),
    name: &'static str,
    color: Color32,
    anchor: Align2,
) {
    let dot = Points::new("", vec![[x, y]]).id(name).shape(MarkerShape::Circle).radius(3.5).color(color);
    plot.points(dot.allow_hover(false));
    let text = match anchor {
        Align2::CENTER_TOP => format!("\n{name}"),
        Align2::CENTER_BOTTOM => format!("{name}\n"),
        Align2::RIGHT_BOTTOM => format!("{name}  "),
        _ => format!("  {name}"),
    };
    let ink = Palette::of_screen(plot.ctx()).ink(color);
    let label = Text::new("", PlotPoint::new(x, y + lift), rich(&text, 13.0, ink));
    plot.text(label.anchor(anchor).id((name, "label")).allow_hover(false));
}

fn full_name(scene: &Scene<'_>) -> String {
    match scene.full {
        Some(full) if scene.full_stale => format!("Full, of {}", numbers::contact(&full.key.point)),
        _ => "full solution".to_owned(),
    }
}
