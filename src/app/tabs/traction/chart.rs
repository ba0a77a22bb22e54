//! The two plots: traction above, film below, on one axis; a press in either goes to a contact.

use super::ShownSweep;
use crate::app::context::Context;
use crate::app::document::Key;
use crate::app::figure::{self, Subject};
use crate::app::numbers;
use crate::app::tabs::axes;
use crate::app::theme::{LIVE_WIDTH, Palette, faded};
use crate::app::traction::{Against, Choices, Curve, Markers, Sample, Sweep};
use egui::{Color32, CursorIcon, Id, PointerButton, Ui, Vec2b};
use egui_plot::{Corner, HoverPosition, Legend, Line, LineStyle, MarkerShape, Plot, PlotUi, Points, VLine};

/// Heights below which plots cannot be read.
const LEAST_HEIGHT: f32 = 110.0;
/// Metres in the micrometres that films are drawn in.
const MICRO: f64 = 1e-6;

/// Strength of a curve by a model that was not trained for it.
const SKETCH: f32 = 0.7;

/// Points in the units of the axes.
type Points2 = Vec<[f64; 2]>;

/// A quantity of a sample.
type Quantity = fn(&Sample) -> f64;

/// Where samples stand on the axes, logarithms included.
#[derive(Clone, Copy)]
struct Axes<'a> {
    against: Against,
    sweep: &'a Sweep,
    logarithmic: (bool, bool),
}

impl Axes<'_> {
    /// A place along the axis as it is drawn; none for what has no logarithm.
    fn along(&self, value: f64) -> Option<f64> {
        drawn(value, self.logarithmic.0)
    }

    /// The value of a place along the axis.
    fn value(&self, place: f64) -> f64 {
        if self.logarithmic.0 { 10f64.powf(place) } else { place }
    }

    fn place(&self, sample: &Sample) -> Option<f64> {
        self.along(self.against.of(&Key { point: sample.point, lubricant: self.sweep.base.lubricant }))
    }

    /// The points of a quantity of samples.
    fn points(&self, samples: &[Sample], of: Quantity) -> Points2 {
        let point = |sample: &Sample| Some([self.place(sample)?, drawn(of(sample), self.logarithmic.1)?]);
        samples.iter().filter_map(point).collect()
    }
}

fn drawn(value: f64, logarithmic: bool) -> Option<f64> {
    if !logarithmic { Some(value) } else { (value > 0.0).then(|| value.log10()) }
}

/// Traction, and both films in µm.
const TRACTION: Quantity = |sample| sample.traction;
const CENTRAL: Quantity = |sample| sample.h_c_m / MICRO;
const SMALLEST: Quantity = |sample| sample.h_min_m / MICRO;

/// Largest differences of traction and, relative, of H_c between full solutions and the curve they belong to.
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

/// The plots; returns the place on the axis that was pressed.
pub fn ui(ui: &mut Ui, choices: &Choices, context: &Context<'_>, sweep: &Sweep, shown: &ShownSweep<'_>) -> Option<f64> {
    let palette = Palette::of(ui);
    let axes = Axes { against: choices.against, sweep, logarithmic: choices.logarithmic };
    let unit = ((ui.available_height() - 6.0) / 2.0).max(LEAST_HEIGHT);
    let here = context.answers.current_picture();
    let grey = shown.unphysical.is_some();
    let sketch = shown.curve.is_some_and(|curve| curve.served.untrained.is_some());
    let traction = LinkedPlot {
        name: "Traction along the quantity",
        id: "traction",
        titles: ("", "Traction coefficient µ"),
        curves: &[(
            if sketch { "Traction, model not trained for it" } else { "Traction" },
            TRACTION,
            if grey { palette.reference } else { palette.traction },
            LIVE_WIDTH,
        )],
        here: here.map(|picture| picture.traction.abs()),
        legend: Corner::LeftTop,
    };
    let film = LinkedPlot {
        name: "Film along the quantity",
        id: "film",
        titles: (axes.against.axis(sweep.base.point.kind), "Film in µm"),
        curves: &[
            (
                if sketch { "Central film, model not trained for it" } else { "Central film" },
                CENTRAL,
                palette.film,
                LIVE_WIDTH,
            ),
            (if sketch { "Smallest film (dotted)" } else { "Smallest film (dashed)" }, SMALLEST, palette.film, 1.6),
        ],
        here: here.map(|picture| picture.central_film_m() / MICRO),
        legend: Corner::LeftBottom,
    };
    let both = ui.vertical(|ui| {
        let pressed = traction.show(ui, context, &axes, shown, unit);
        film.show(ui, context, &axes, shown, unit).or(pressed)
    });
    figure::offer_of(ui, "Traction and film", both.response.rect, Subject::Sweep);
    both.inner.map(|place| axes.value(place))
}

/// One of both plots.
struct LinkedPlot<'a> {
    name: &'static str,
    id: &'static str,
    titles: (&'a str, &'a str),
    curves: &'a [(&'static str, Quantity, Color32, f32)],
    /// The value of the contact on the screen.
    here: Option<f64>,
    legend: Corner,
}

impl LinkedPlot<'_> {
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
        let current = axes.along(axes.against.of(&context.document.key()));
        let response = axes::show(self.plot(ui, axes, height, marks), ui, self.name, |plot| {
            axes::fit(plot, context.fit);
            if let Some(current) = current {
                let line = VLine::new("", current).id("here line").color(palette.accent).width(1.0);
                plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
            }
            for (k, &(name, of, color, width)) in self.curves.iter().enumerate() {
                if let Some(curve) = shown.curve {
                    let color = if shown.curve_stale { palette.reference } else { color };
                    // What nobody has measured is no firm line.
                    let (color, style) = match (curve.served.untrained.is_some(), k) {
                        (false, 0) => (color, LineStyle::Solid),
                        (false, _) => (color, LineStyle::dashed_loose()),
                        (true, 0) => (faded(color, SKETCH), LineStyle::dashed_dense()),
                        (true, _) => (faded(color, SKETCH), LineStyle::dotted_dense()),
                    };
                    let line = Line::new(name, axes.points(&curve.samples, of)).color(color).width(width);
                    plot.line(line.style(style).id((self.id, k)).allow_band(false));
                }
                if let Some(markers) = shown.markers {
                    let color = if shown.markers_stale { palette.reference } else { palette.over(color) };
                    rings(plot, axes.points(&markers.samples, of), color, k);
                }
            }
            if let (Some(place), Some(value)) = (current, self.here.and_then(|value| drawn(value, axes.logarithmic.1)))
            {
                let dot = Points::new("", vec![[place, value]]).id("here").color(palette.accent).radius(5.0);
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

    fn plot<'p>(&self, ui: &Ui, axes: &Axes<'_>, height: f32, marks: f64) -> Plot<'p> {
        let group = Id::unique("traction sweep");
        let (along, up) = axes.logarithmic;
        let plot = axes::plot(ui, self.id, height, self.titles.0, self.titles.1)
            .link_axis(group, Vec2b::new(true, false))
            .link_cursor(group, Vec2b::new(true, false))
            .allow_drag(false)
            .auto_bounds(Vec2b::TRUE)
            .set_margin_fraction(egui::vec2(0.02, 0.08))
            .legend(Legend::default().position(self.legend).follow_insertion_order(true).background_alpha(0.6))
            .show_y(false)
            .label_formatter(move |at: &HoverPosition<'_>| {
                let (name, position) = match at {
                    HoverPosition::NearDataPoint { plot_name, position, .. } => (*plot_name, position),
                    HoverPosition::Elsewhere { .. } => return None,
                };
                let value =
                    |v: f64, logarithmic: bool| numbers::significant(if logarithmic { 10f64.powf(v) } else { v });
                Some(format!("{name}\n{} at {}", value(position.y, up), value(position.x, along)))
            });
        let plot = if along {
            plot.x_grid_spacer(axes::log_marks).x_axis_formatter(|mark, _| axes::log_label(mark))
        } else {
            plot.x_grid_spacer(move |input| axes::round_marks(input, marks))
        };
        if up {
            plot.y_grid_spacer(axes::log_marks).y_axis_formatter(|mark, _| axes::log_label(mark))
        } else {
            plot.include_y(0.0)
        }
    }
}

fn rings(plot: &mut PlotUi<'_>, points: Points2, color: Color32, k: usize) {
    let rings = Points::new("Full solutions", points).color(color).radius(4.0).filled(false);
    plot.points(rings.shape(MarkerShape::Circle).id(("rings", k)));
}
