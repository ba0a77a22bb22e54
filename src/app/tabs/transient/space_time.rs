//! Map of film thickness or pressure of a transient contact over space and time: X, at Y = 0, is horizontal and T is
//! vertical. A click or drag moves the displayed time to the pointer.

use super::profiles::dry;
use super::runs::TransientRuns;
use crate::app::context::Context;
use crate::app::figure::Texture;
use crate::app::plot::{axes, color_bar, color_map};
use crate::app::tabs::Offer;
use crate::app::tabs::transient::export::describe;
use crate::app::tabs::transient::{Run, Setup};
use crate::app::theme::faded;
use crate::app::units::{self, Scale, Scales};
use crate::app::{export, numbers};
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::Frame;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Color32, ColorImage, Ui, Vec2};
use egui_plot::{HLine, HoverPosition, Line, LineStyle, PlotPoint, PlotPoints};
use std::sync::Arc;

/// Displayed range of X, in Hertzian half-widths of the reference contact.
const X_RANGE: (f64, f64) = (-2.2, 1.6);
/// Number of pixels along X.
const COLUMNS: usize = 380;
/// Maximum number of pixels along T.
const ROWS: usize = 480;
/// Width below which the colour scale is omitted \[points\].
const LEAST_WIDTH: f32 = 320.0;

/// Displayed field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Field {
    /// H, film thickness.
    #[default]
    Film,
    /// P, pressure.
    Pressure,
}

impl Field {
    const ALL: [Self; 2] = [Self::Film, Self::Pressure];

    /// Returns the name of the plot.
    fn name(self) -> &'static str {
        match self {
            Self::Film => "Film over space and time",
            Self::Pressure => "Pressure over space and time",
        }
    }

    /// Returns label and hint of the button.
    fn button(self) -> (&'static str, &'static str) {
        match self {
            Self::Film => ("Film over time", "H over X and T, bright where the film is thin"),
            Self::Pressure => ("Pressure over time", "P over X and T, bright where the pressure is high"),
        }
    }

    /// Returns the symbol, marked by braces.
    fn symbol(self) -> &'static str {
        match self {
            Self::Film => "{H}",
            Self::Pressure => "{P}",
        }
    }

    /// Returns a dimensionless value of the field as text with its unit.
    fn si(self, setup: &Setup, value: f64, system: UnitSystem) -> String {
        match self {
            Self::Film => color_bar::short(QuantityKind::FilmThickness, value * setup.point.film_scale_m(), system),
            Self::Pressure => color_bar::short(QuantityKind::Pressure, value * setup.point.hertz().pressure_pa, system),
        }
    }
}

/// Data from which an image was computed. If they change, the image is out of date.
#[derive(Clone)]
struct Made {
    setup: Arc<Setup>,
    /// Method and frame of the run, whether it was replayed, and the number of its stored states.
    run: (MarchedBy, Frame, bool, usize),
    field: Field,
}

impl PartialEq for Made {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.setup, &other.setup) && self.run == other.run && self.field == other.field
    }
}

/// State of the map: the displayed field, and the image stored between two frames of the window.
#[derive(Default)]
pub struct SpaceTime {
    field: Field,
    samples: Samples,
    texture: Option<Texture>,
    /// Data of the image in `texture`.
    made: Option<Made>,
}

/// Field at equidistant X for each stored time.
#[derive(Default)]
struct Samples {
    /// Stored times T, ascending.
    times: Vec<f64>,
    /// Values, one row of [`COLUMNS`] per time.
    values: Vec<f32>,
    /// Ends of the colour scale.
    range: (f64, f64),
}

impl Samples {
    fn new(run: &Run, field: Field) -> Self {
        let states = &run.trajectory.states;
        let mut values = Vec::with_capacity(states.len() * COLUMNS);
        for state in states {
            let nodes = run.profile(state).map(|(x, p, h)| (x, if field == Field::Film { h } else { p }));
            resample(nodes, &mut values);
        }
        let moments = run.trajectory.moments.iter();
        let range = match field {
            Field::Film => {
                let (thin, thick) =
                    moments.fold((f64::INFINITY, 0.0f64), |(low, high), m| (low.min(m.h_min), high.max(m.h_c)));
                let high = numbers::round_up(1.5 * thick);
                let unit = high / color_bar::UNITS;
                (unit * (thin / unit).floor().clamp(0.0, color_bar::UNITS - 2.0), high)
            }
            Field::Pressure => (0.0, numbers::round_up(moments.fold(0.0, |high, m| m.p_max.max(high)))),
        };
        Self { times: states.iter().map(|state| state.time).collect(), values, range }
    }

    /// Returns the indices of the stored times around T, and the weight of the later one, 0…1.
    fn around(&self, time: f64) -> Option<(usize, usize, f32)> {
        let last = self.times.len().checked_sub(1)?;
        let later = self.times.partition_point(|t| *t < time).min(last);
        let earlier = later.saturating_sub(1);
        let apart = self.times[later] - self.times[earlier];
        let share = if apart > 0.0 { ((time - self.times[earlier]) / apart).clamp(0.0, 1.0) } else { 1.0 };
        Some((earlier, later, share as f32))
    }

    /// Returns the value of a column, interpolated between two stored times.
    fn at(&self, column: usize, (earlier, later, share): (usize, usize, f32)) -> f32 {
        let value = |row: usize| self.values.get(row * COLUMNS + column).copied().unwrap_or(0.0);
        value(earlier) + share * (value(later) - value(earlier))
    }

    /// Returns the value at (X, T); `None` outside the map.
    fn value(&self, x: f64, time: f64) -> Option<f64> {
        let column = (x - X_RANGE.0) / (X_RANGE.1 - X_RANGE.0) * COLUMNS as f64;
        let inside = (0.0..COLUMNS as f64).contains(&column) && (0.0..=self.end()).contains(&time);
        inside.then(|| Some(f64::from(self.at(column as usize, self.around(time)?)))).flatten()
    }

    /// Returns the last stored time.
    fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Returns the image, with the last time at its top. `table` lists the colours in the order of ascending values.
    fn image(&self, table: &[Color32]) -> ColorImage {
        let last = table.len().saturating_sub(1);
        let (low, factor) = (self.range.0 as f32, last as f32 / (self.range.1 - self.range.0) as f32);
        let rows = (3 * self.times.len()).clamp(2, ROWS);
        let mut pixels = Vec::with_capacity(rows * COLUMNS);
        for row in (0..rows).rev() {
            let around = self.around(self.end() * (row as f64 + 0.5) / rows as f64).unwrap_or_default();
            let color = |column| {
                let place = ((self.at(column, around) - low) * factor).clamp(0.0, last as f32);
                table.get(place as usize).copied().unwrap_or_default()
            };
            pixels.extend((0..COLUMNS).map(color));
        }
        ColorImage::new([COLUMNS, rows], pixels)
    }
}

/// Interpolates (X, value) pairs of ascending X linearly to the pixels of one row. Appends the results to `values`.
fn resample(nodes: impl Iterator<Item = (f64, f64)>, values: &mut Vec<f32>) {
    let wanted = values.len() + COLUMNS;
    let pixel = (X_RANGE.1 - X_RANGE.0) / COLUMNS as f64;
    let mut x = X_RANGE.0 + 0.5 * pixel;
    let mut before: Option<(f64, f64)> = None;
    for (node, value) in nodes {
        while x <= node && values.len() < wanted {
            let (from, first) = before.unwrap_or((node - 1.0, value));
            values.push((first + (x - from) / (node - from) * (value - first)) as f32);
            x += pixel;
        }
        before = Some((node, value));
    }
    values.resize(wanted, before.map_or(0.0, |(_, value)| value as f32));
}

/// Returns the displayed run: the first of those that have reached the largest T.
fn shown(view: &TransientRuns) -> Option<&Run> {
    let reached = view.runs.iter().map(Run::reached).fold(0.0, f64::max);
    view.runs.iter().find(|run| run.reached() >= reached && run.trajectory.states.len() > 1)
}

/// Returns the export of the map as a CSV table.
pub fn offer<'a>(context: &Context<'a>) -> Offer<'a> {
    let view = context.transient;
    let tip = "T, X, P and H of all displayed nodes, at every stored time";
    Offer::table("Map as CSV…", tip, view.setup.as_ref().zip(shown(view)), |(setup, run)| csv(setup, run))
}

impl SpaceTime {
    /// Draws the map, `height` points high. On a click or drag, returns T at the pointer.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, height: f32) -> Option<f64> {
        let view = context.transient;
        let displayed = view.setup.as_ref().zip(shown(view));
        ui.horizontal_wrapped(|ui| {
            for field in Field::ALL {
                let (name, tip) = field.button();
                ui.selectable_value(&mut self.field, field, name).on_hover_text(tip);
            }
            if let Some((_, run)) = displayed {
                ui.weak(run.name());
            }
        });
        let (setup, run) = displayed?;
        self.update_image(ui, setup, run);
        let height = (height - 26.0).max(80.0);
        let whole = ui.horizontal_top(|ui| {
            let scale = ui.available_width() >= LEAST_WIDTH;
            let width = if scale { ui.available_width() - color_bar::WIDTH - 8.0 } else { ui.available_width() };
            let clicked = ui.vertical(|ui| {
                ui.set_width(width);
                self.plot(ui, view, (setup, run), height)
            });
            let colors = color_bar::strips(&color_map::table(self.field == Field::Film));
            let field = self.field;
            let system = units::system(ui.ctx());
            let scales = Scales::of(&setup.point, system);
            let (name, dimensional) = match field {
                Field::Film => ("Film {H}", (scales.film, "Film {h}")),
                Field::Pressure => ("Pressure {P}", (scales.pressure, "Pressure {p}")),
            };
            color_bar::on_paper(ui, name, dimensional, (&colors, self.samples.range));
            if scale {
                let si = |value| field.si(setup, value, system);
                color_bar::ui(ui, field.symbol(), (&colors, self.samples.range), height, si);
            }
            clicked.inner
        });
        whole.inner
    }

    /// Updates the image if it is out of date.
    fn update_image(&mut self, ui: &Ui, setup: &Arc<Setup>, run: &Run) {
        let states = run.trajectory.states.len();
        let of = (run.by, run.frame(), run.replayed, states);
        let made = Made { setup: Arc::clone(setup), run: of, field: self.field };
        if self.made.as_ref() != Some(&made) {
            self.samples = Samples::new(run, self.field);
            let image = self.samples.image(&color_map::table(self.field == Field::Film));
            Texture::put(&mut self.texture, ui.ctx(), "space and time", image);
            self.made = Some(made);
        }
    }

    /// Draws the image, the edges of the dry contact, the paths of surface features and the displayed time. Returns T
    /// at the pointer on a click or drag.
    fn plot(&self, ui: &mut Ui, view: &TransientRuns, (setup, run): (&Setup, &Run), height: f32) -> Option<f64> {
        let texture = self.texture.as_ref()?.shown(ui.ctx());
        let (end, duration) = (self.samples.end(), setup.study.duration);
        let symbol = self.field.symbol().trim_matches(['{', '}']);
        let system = units::system(ui.ctx());
        let hover = |at: &HoverPosition<'_>| {
            let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
            let value = self.samples.value(position.x, position.y)?;
            let seconds = position.y * setup.time_scale_s();
            Some(format!(
                "X = {}\nT = {}   ({})\n{symbol} = {}   ({})",
                numbers::digits(position.x, 3),
                numbers::digits(position.y, 3),
                numbers::duration(seconds),
                numbers::significant(value),
                self.field.si(setup, value, system)
            ))
        };
        let plot = axes::plot(ui, &format!("space and time {}", view.generation), height, "{X}", "{T}")
            .units_x(Scales::of(&setup.point, system).along, "{x}")
            .units_y(Scale::of(QuantityKind::TransitTime, system, setup.time_scale_s()), "{t}")
            .y_axis_min_width(40.0)
            .allow_drag(false)
            .allow_zoom(false)
            .set_margin_fraction(Vec2::ZERO)
            .default_x_bounds(X_RANGE.0, X_RANGE.1)
            .default_y_bounds(0.0, duration)
            .label_formatter(hover);
        let edges = |sign: f64| -> Vec<PlotPoint> {
            let kind = run.trajectory.transient.point.kind;
            let edge = |m: &crate::solver::full::transient::Moment| sign * dry(kind, m).0;
            run.trajectory.moments.iter().map(|m| PlotPoint::new(edge(m), m.time)).collect()
        };
        let drawn = axes::show(plot, ui, self.field.name(), |plot| {
            plot.field("field", texture, X_RANGE, (0.0, end), Color32::WHITE);
            for (name, sign) in [("inlet", -1.0), ("outlet", 1.0)] {
                let edge = Line::new("", PlotPoints::Owned(axes::thinned(edges(sign)))).id(name);
                let edge = edge.color(faded(Color32::WHITE, 0.75)).width(1.0).style(LineStyle::dashed_dense());
                plot.line(edge.allow_hover(false));
            }
            for (k, surface) in run.trajectory.transient.surfaces.iter().enumerate() {
                let path = [0.0, end].map(|time| PlotPoint::new(surface.at + surface.speed * time, time));
                let path = Line::new("", PlotPoints::Owned(path.to_vec())).id(("feature", k));
                let path = path.color(faded(Color32::WHITE, 0.75)).width(1.0).style(LineStyle::dotted_dense());
                plot.line(path.allow_hover(false));
            }
            let now = HLine::new("", view.player.time()).id("now").color(Color32::WHITE).width(1.6);
            plot.hline(now.allow_hover(false));
        });
        let held = drawn.response.clicked() || drawn.response.dragged();
        let pointer = drawn.response.interact_pointer_pos().filter(|_| held)?;
        Some(drawn.transform.value_from_position(pointer).y)
    }
}

/// Returns the displayed nodes at all stored times, with the factors to SI units.
fn csv(setup: &Setup, run: &Run) -> String {
    let (hertz, seconds) = (setup.point.hertz(), setup.time_scale_s());
    let mut comments = describe(setup);
    comments.push(run.name());
    comments.push(format!(
        "t = T times {seconds:e} s; x = X times {:e} m; p = P times {:e} Pa; h = H times {:e} m",
        hertz.half_width_m,
        hertz.pressure_pa,
        setup.point.film_scale_m()
    ));
    let rows = run.trajectory.states.iter().flat_map(|state| {
        let inside = |(x, _, _): &(f64, f64, f64)| (X_RANGE.0..=X_RANGE.1).contains(x);
        run.profile(state).filter(inside).map(|(x, p, h)| [state.time, x, p, h].map(Some).to_vec())
    });
    export::csv(&comments, &["T", "X", "P", "H"], rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_interpolated_in_space_and_time() {
        let mut values = Vec::new();
        for slope in [1.0, 3.0] {
            resample((0..=60).map(|k| -4.0 + 0.1 * f64::from(k)).map(|x| (x, slope * x)), &mut values);
        }
        let samples = Samples { times: vec![0.0, 2.0], values, range: (0.0, 1.0) };
        assert_eq!(samples.values.len(), 2 * COLUMNS);
        for (x, time, wanted) in [(1.0, 0.0, 1.0), (1.0, 2.0, 3.0), (-1.5, 1.0, -3.0)] {
            let got = samples.value(x, time).unwrap();
            assert!((got - wanted).abs() < 0.02, "{x} {time}: {got} {wanted}");
        }
        assert_eq!((samples.value(0.0, 2.1), samples.value(5.0, 1.0)), (None, None));
        let image = samples.image(&color_map::table(false));
        assert_eq!(image.size, [COLUMNS, 6]);
    }
}
