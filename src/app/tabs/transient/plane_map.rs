//! Film thickness, pressure and interferogram of a point contact in its plane at the displayed time.

use super::profiles::dry;
use super::runs::TransientRuns;
use super::space_time::SpaceTime;
use crate::app::context::Context;
use crate::app::figure::Texture;
use crate::app::numbers;
use crate::app::plot::color_bar::{self, STRIPS, UNITS};
use crate::app::plot::contours::Field;
use crate::app::plot::raster::{self, Raster};
use crate::app::plot::{axes, color_map};
use crate::app::tabs::transient::{Run, Setup};
use crate::app::theme::faded;
use crate::app::units::{self, Scales};
use crate::solver::full::transient::{Moment, State};
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::physics::optics::Interferometer;
use egui::{Color32, ColorImage, Ui};
use egui_plot::{HoverPosition, Line, LineStyle, PlotPoint, PlotPoints};
use std::sync::Arc;

/// Initial range of X, and of Y to both sides.
const X_RANGE: (f64, f64) = (-2.0, 1.6);
const Y_RANGE: f64 = 1.45;
/// Approximate number of contour lines between the ends of the scale.
const LINES: f64 = 8.0;

/// Displayed field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Shown {
    /// H over the plane.
    #[default]
    Film,
    /// P over the plane.
    Pressure,
    /// Interference of light in the film.
    Interferogram,
    /// H or P on the axis over space and time.
    OverTime,
}

impl Shown {
    const ALL: [Self; 4] = [Self::Film, Self::Pressure, Self::Interferogram, Self::OverTime];

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Film => ("Film map", "H over the plane at the displayed time, bright where the film is thin"),
            Self::Pressure => ("Pressure map", "P over the plane at the displayed time"),
            Self::Interferogram => ("Interferogram", "Picture of an optical rig at the displayed time"),
            Self::OverTime => ("Axis over time", "Film or pressure on the axis Y = 0 over X and T"),
        }
    }
}

/// Data that an image was made of.
struct Made {
    setup: Arc<Setup>,
    time: f64,
    range: (f64, f64),
    shown: Shown,
}

impl PartialEq for Made {
    fn eq(&self, other: &Self) -> bool {
        let of = |made: &Self| (made.time, made.range, made.shown);
        Arc::ptr_eq(&self.setup, &other.setup) && of(self) == of(other)
    }
}

/// Map with the image kept between frames.
#[derive(Default)]
pub struct PlaneMap {
    shown: Shown,
    texture: Option<Texture>,
    contours: Vec<Vec<PlotPoint>>,
    made: Option<Made>,
}

/// State of a point contact with its nodes.
struct Plane<'a> {
    x: &'a [f64],
    y: Vec<f64>,
    kappa: f64,
    state: &'a State,
}

impl<'a> Plane<'a> {
    fn of(run: &'a Run, time: f64) -> Option<Self> {
        let (state, x) = (run.state_at(time)?, run.trajectory.x.as_slice());
        let spec = run.trajectory.mesh.plane()?;
        let y = spec.ordinates(state.pressure.len() / x.len().max(1));
        let kappa = run.trajectory.transient.point.ellipse().kappa;
        (x.len() > 1 && y.len() > 1 && state.film.len() == x.len() * y.len()).then_some(Self { x, y, kappa, state })
    }

    /// Returns inlet, outlet and outer edge in units of a.
    fn domain(&self) -> (f64, f64, f64) {
        let edge = self.y.first().copied().unwrap_or(0.0);
        (self.x.first().copied().unwrap_or(0.0), self.x.last().copied().unwrap_or(0.0), self.kappa * edge)
    }

    /// Returns the value of a node array at (X, Y in units of a), interpolated linearly.
    fn value(&self, field: &[f64], x: f64, y: f64) -> Option<f64> {
        let cell = |nodes: &[f64], at: f64| {
            let next = nodes.partition_point(|node| *node < at).clamp(1, nodes.len() - 1);
            let (low, high) = (*nodes.get(next - 1)?, *nodes.get(next)?);
            (low..=high).contains(&at).then(|| (next, (at - low) / (high - low)))
        };
        let ((i, s), (j, t)) = (cell(self.x, x)?, cell(&self.y, -(y / self.kappa).abs())?);
        let node = |i: usize, j: usize| field.get(i * self.y.len() + j).copied();
        let across = |i: usize| Some(node(i, j - 1)? + t * (node(i, j)? - node(i, j - 1)?));
        Some(across(i - 1)? + s * (across(i)? - across(i - 1)?))
    }

    fn contours(&self, field: &[f64], (low, high): (f64, f64)) -> Vec<Vec<PlotPoint>> {
        let field = Field { x: self.x, y: &self.y, values: field };
        let step = numbers::round_up((high - low) / LINES);
        let levels = (1..=(high / step).floor() as usize).map(|k| step * k as f64).filter(|level| *level > low);
        let lines = levels.flat_map(|level| field.contours(level));
        let both = |line: Vec<[f64; 2]>| {
            [self.kappa, -self.kappa].map(|up| line.iter().map(|p| PlotPoint::new(p[0], up * p[1])).collect())
        };
        lines.flat_map(both).collect()
    }
}

/// Returns the ends of the scale. They cover the whole run, so that colours stay fixed while it plays.
fn range(run: &Run, shown: Shown) -> (f64, f64) {
    let moments = &run.trajectory.moments;
    let most = |of: fn(&Moment) -> f64| moments.iter().map(of).fold(0.0, f64::max);
    match shown {
        Shown::Pressure => (0.0, numbers::round_up(most(|m| m.p_max))),
        Shown::Interferogram => (0.0, numbers::round_up(2.5 * most(|m| m.h_c))),
        Shown::Film | Shown::OverTime => {
            let high = numbers::round_up(1.5 * most(|m| m.h_c));
            let thin = moments.iter().map(|m| m.h_min).fold(f64::INFINITY, f64::min);
            let unit = high / UNITS;
            (unit * (thin / unit).floor().clamp(0.0, UNITS - 2.0), high)
        }
    }
}

/// Returns the displayed run: the first one with fields.
fn shown_run(view: &TransientRuns) -> Option<&Run> {
    view.runs.iter().find(|run| !run.trajectory.states.is_empty())
}

impl PlaneMap {
    /// Draws the map with this height, or the map over space and time. Returns the time under a press or a drag there.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, over_time: &mut SpaceTime, height: f32) -> Option<f64> {
        ui.horizontal_wrapped(|ui| {
            for shown in Shown::ALL {
                let (name, tip) = shown.words();
                ui.selectable_value(&mut self.shown, shown, name).on_hover_text(tip);
            }
        });
        let height = (height - 26.0).max(80.0);
        if self.shown == Shown::OverTime {
            return over_time.ui(ui, context, height);
        }
        let view = context.transient;
        let (setup, run) = view.setup.as_ref().zip(shown_run(view))?;
        let plane = Plane::of(run, view.player.time())?;
        self.follow(ui, setup, (run, &plane));
        let range = range(run, self.shown);
        ui.horizontal_top(|ui| {
            let width = (ui.available_width() - color_bar::WIDTH - 8.0).max(120.0);
            ui.vertical(|ui| {
                ui.set_width(width);
                self.plot(ui, (setup, run), &plane, (context.fit, height));
            });
            self.scale(ui, setup, range, height);
        });
        None
    }

    /// Updates image and contour lines if they are out of date.
    fn follow(&mut self, ui: &Ui, setup: &Arc<Setup>, (run, plane): (&Run, &Plane<'_>)) {
        let range = range(run, self.shown);
        let made = Made { setup: Arc::clone(setup), time: plane.state.time, range, shown: self.shown };
        if self.made.as_ref() == Some(&made) {
            return;
        }
        let State { film, pressure, .. } = plane.state;
        let raster = |field, scale| Raster::new((plane.x, &plane.y), plane.kappa, field, scale);
        let image: ColorImage = match self.shown {
            Shown::Pressure => raster(pressure, 1.0).colored(&color_map::table(false), range),
            Shown::Interferogram => {
                raster(film, setup.point.film_scale_m()).interferogram(&Interferometer::default(), true)
            }
            Shown::Film | Shown::OverTime => raster(film, 1.0).colored(&color_map::table(true), range),
        };
        self.contours = match self.shown {
            Shown::Interferogram => Vec::new(),
            Shown::Pressure => plane.contours(pressure, range),
            Shown::Film | Shown::OverTime => plane.contours(film, range),
        };
        Texture::put(&mut self.texture, ui.ctx(), "plane in time", image);
        self.made = Some(made);
    }

    fn plot(&self, ui: &mut Ui, (setup, run): (&Arc<Setup>, &Run), plane: &Plane<'_>, (fit, height): (bool, f32)) {
        let Some(texture) = self.texture.as_ref().map(|texture| texture.shown(ui.ctx())) else { return };
        let system = units::system(ui.ctx());
        let scales = Scales::of(&setup.point, system);
        let (hertz, scale) = (setup.point.hertz(), setup.point.film_scale_m());
        let hover = |at: &HoverPosition<'_>| {
            let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
            let value = |field: &[f64]| plane.value(field, position.x, position.y);
            let (p, h) = (value(&plane.state.pressure)?, value(&plane.state.film)?);
            Some(format!(
                "X = {}   ({})\nY = {}   ({})\nP = {}   ({})\nH = {}   ({})",
                numbers::digits(position.x, 3),
                numbers::length(position.x * hertz.half_width_m, system),
                numbers::digits(position.y / plane.kappa, 3),
                numbers::length(position.y * hertz.half_width_m, system),
                numbers::significant(p),
                numbers::pressure(p * hertz.pressure_pa, system),
                numbers::significant(h),
                numbers::length(h * scale, system)
            ))
        };
        let plot = axes::plot(ui, "plane in time", height, "{X} = {x}/{a}", "{y}/{a}")
            .units_x(scales.along, "{x}")
            .units_y(scales.along, "{y}")
            .data_aspect(1.0)
            .default_x_bounds(X_RANGE.0, X_RANGE.1)
            .default_y_bounds(-Y_RANGE * plane.kappa, Y_RANGE * plane.kappa)
            .label_formatter(hover);
        let moment = run.trajectory.moments.iter().find(|moment| moment.time == plane.state.time);
        let kind = run.trajectory.transient.point.kind;
        let half_width = moment.map_or(1.0, |moment| dry(kind, moment).0);
        axes::show(plot, ui, "Contact at this moment", |plot| {
            axes::fit(plot, fit);
            let (from, to, edge) = plane.domain();
            plot.field("field", texture, (from, to), (edge, -edge), Color32::WHITE);
            for (k, line) in self.contours.iter().enumerate() {
                let line = Line::new("", PlotPoints::Borrowed(line)).id(("contour", k));
                plot.line(line.color(Color32::from_white_alpha(150)).width(1.0).allow_hover(false));
            }
            let kappa = plane.kappa;
            let ellipse = move |t: f64| (half_width * t.cos(), half_width * kappa * t.sin());
            let dry = PlotPoints::from_parametric_callback(ellipse, 0.0..=std::f64::consts::TAU, 181);
            let dry = Line::new("", dry).id("dry contact").color(faded(Color32::WHITE, 0.75)).width(1.0);
            plot.line(dry.style(LineStyle::dashed_dense()).allow_hover(false));
        });
    }

    fn scale(&self, ui: &mut Ui, setup: &Setup, (low, high): (f64, f64), height: f32) {
        let system = units::system(ui.ctx());
        let scales = Scales::of(&setup.point, system);
        let (title, name, in_si) = match self.shown {
            Shown::Pressure => ("{P}", "Pressure {P}", (scales.pressure, "Pressure {p}")),
            _ => ("{H}", "Film {H}", (scales.film, "Film {h}")),
        };
        let film_m = setup.point.film_scale_m();
        let colors: Vec<Color32> = if self.shown == Shown::Interferogram {
            let film = |k: usize| (low + (high - low) * (k as f64 + 0.5) / STRIPS as f64) * film_m;
            (0..STRIPS).map(|k| raster::fringe(&Interferometer::default(), true, film(k))).collect()
        } else {
            color_bar::strips(&color_map::table(self.shown == Shown::Film))
        };
        let si = |value: f64| match self.shown {
            Shown::Pressure => {
                color_bar::short(QuantityKind::Pressure, value * setup.point.hertz().pressure_pa, system)
            }
            _ => color_bar::short(QuantityKind::FilmThickness, value * film_m, system),
        };
        color_bar::on_paper(ui, name, in_si, (&colors, (low, high)));
        color_bar::ui(ui, title, (&colors, (low, high)), height, si);
    }
}
