//! Laws of the fluid: viscosity against pressure and against shear stress, with the ranges that occur in this
//! contact.

use crate::app::context::Context;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::theme::{LIVE_WIDTH, Palette, THIN_WIDTH, rich};
use crate::app::units::{self, Scale};
use crate::solver::full::{Problem, Solution};
use crate::solver::physics::engineering::QuantityKind;
use egui::{Align2, Ui};
use egui_plot::{HoverPosition, Line, LineStyle, PlotPoint, Span, Text, VLine};
use std::sync::Arc;

/// Number of points of a curve.
const SAMPLES: usize = 161;
/// Width from which the plots are placed side by side.
const SIDE_BY_SIDE: f32 = 620.0;
/// Number of decades of stress below the critical stress, and minimum number above it.
const BELOW: f64 = 2.0;
const ABOVE: f64 = 3.0;
/// Stress in Pa at the centre of the flow curve of a Newtonian fluid, which has no critical stress.
const NEWTONIAN_STRESS: f64 = 1e5;

/// Fluid of the contact, and the largest values that occur.
struct Met {
    problem: Problem,
    /// Maximum pressure \[Pa\].
    pressure_pa: f64,
    /// Maximum shear stress \[Pa\]. `None` without a picture.
    stress_pa: Option<f64>,
}

/// Draws both plots.
pub fn ui(ui: &mut Ui, stress_met: &mut Option<(Arc<Solution>, f64)>, context: &Context<'_>) {
    let key = context.document.key();
    let Ok(problem) = Problem::new(&key.point, key.lubricant) else { return };
    let picture = context.answers.picture().filter(|picture| picture.key == key);
    let stress_pa = picture.map(|picture| Arc::clone(&picture.solution)).map(|solution| match &*stress_met {
        Some((of, stress)) if Arc::ptr_eq(of, &solution) => *stress,
        _ => {
            let stress = largest_stress(&solution);
            *stress_met = Some((solution, stress));
            stress
        }
    });
    let picture = context.answers.picture().filter(|picture| picture.key == key);
    let pressure_pa = picture.map_or(key.point.hertz().pressure_pa, |picture| picture.largest_pressure_pa());
    let met = Met { problem, pressure_pa, stress_pa };
    let mut text = format!("Pressures in this contact reach {}", numbers::pressure(pressure_pa, context.system));
    if let Some(stress) = stress_pa {
        text.push_str(&format!(", shear stresses on its surfaces {}", numbers::pressure(stress, context.system)));
    }
    ui.weak(text);
    let fit = context.fit;
    if ui.available_width() >= SIDE_BY_SIDE {
        let (width, height) = (0.5 * (ui.available_width() - 10.0), ui.available_height() - 4.0);
        ui.horizontal_top(|ui| {
            for plot in [pressure_plot, flow_plot] {
                ui.vertical(|ui| {
                    ui.set_width(width);
                    plot(ui, &met, height, fit);
                });
            }
        });
    } else {
        let height = 0.5 * (ui.available_height() - 8.0);
        pressure_plot(ui, &met, height, fit);
        flow_plot(ui, &met, height, fit);
    }
}

/// Returns the maximum shear stress along the axis of a solution \[Pa\]. The stress is linear across the film, so
/// the maximum occurs at one of the surfaces.
fn largest_stress(solution: &Solution) -> f64 {
    solution.shear_field(&[0.0, 1.0]).iter().map(|shear| shear.stress_pa.abs()).fold(0.0, f64::max)
}

fn logarithmic<'a>(ui: &Ui, id: &str, height: f32, x_title: &str, y_title: &str) -> PlotFrame<'a> {
    axes::plot(ui, id, height.max(120.0), x_title, y_title)
        .decades_y(7.0)
        .auto_bounds(egui::Vec2b::TRUE)
        .set_margin_fraction(egui::vec2(0.0, 0.06))
        .show_y(false)
}

/// Draws µ(p), the viscosity at zero shear.
fn pressure_plot(ui: &mut Ui, met: &Met, height: f32, fit: bool) {
    let palette = Palette::of(ui);
    let (problem, hertz_pa) = (&met.problem, met.problem.point.hertz().pressure_pa);
    let end = (1.3 * met.pressure_pa.max(hertz_pa)).min(0.999 * problem.fluid.largest_pressure() * hertz_pa);
    let system = units::system(ui.ctx());
    let unit = QuantityKind::Viscosity.unit(system);
    let viscosity = |p: f64| unit.number(problem.point.viscosity_pa_s * problem.fluid.at(p / hertz_pa).viscosity);
    let curve: Vec<[f64; 2]> =
        (0..SAMPLES).map(|k| end * k as f64 / (SAMPLES - 1) as f64).map(|p| [p, viscosity(p).log10()]).collect();
    let marks = f64::from((ui.available_width() / 90.0).clamp(3.0, 8.0));
    axes::show(
        logarithmic(
            ui,
            "viscosity and pressure",
            height,
            "Pressure {p}",
            &format!("Low-shear viscosity µ in {}", unit.name),
        )
        .marks_x(marks)
        .always_x(Scale::of(QuantityKind::Pressure, system, 1.0), "Pressure {p}")
        .label_formatter(|at| {
            Some(format!(
                "p = {}\nµ = {}",
                numbers::pressure(place(at)[0], system),
                numbers::quantity(10f64.powf(place(at)[1]), unit.name)
            ))
        }),
        ui,
        "Viscosity against pressure",
        |plot| {
            axes::fit(plot, fit);
            plot.span(
                Span::new("met here", 0.0..=met.pressure_pa)
                    .fill(palette.accent.gamma_multiply(0.14))
                    .border_width(0.0),
            );
            plot.line(Line::new("µ(p)", curve).color(palette.pressure).width(LIVE_WIDTH).allow_band(false));
            let line = VLine::new("p_H", hertz_pa).color(palette.reference).width(THIN_WIDTH);
            plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
            let at = PlotPoint::new(hertz_pa, viscosity(0.0).log10());
            let name = Text::new("", at, rich(" {p_H}", 12.5, palette.quiet));
            plot.text(name.anchor(Align2::LEFT_BOTTOM).id("Hertz").allow_hover(false));
        },
    );
}

fn place(at: &HoverPosition<'_>) -> [f64; 2] {
    match at {
        HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position } => {
            [position.x, position.y]
        }
    }
}

/// Draws η(τ) at ambient and at Hertzian pressure.
fn flow_plot(ui: &mut Ui, met: &Met, height: f32, fit: bool) {
    let palette = Palette::of(ui);
    let problem = &met.problem;
    let critical = problem.shear.map_or(NEWTONIAN_STRESS, |shear| shear.stress_scale_pa);
    let system = units::system(ui.ctx());
    let [unit, viscosity_unit] = [QuantityKind::Stress, QuantityKind::Viscosity].map(|kind| kind.unit(system));
    let y_title = format!("Viscosity η in {}", viscosity_unit.name);
    let log_of = |stress_pa: f64| unit.number(stress_pa).log10();
    let from = log_of(critical) - BELOW;
    let to = met.stress_pa.map_or(f64::NEG_INFINITY, log_of).max(log_of(critical) + ABOVE) + 0.5;
    let curve = |p: f64| -> Vec<[f64; 2]> {
        let at_rest = viscosity_unit.number(problem.point.viscosity_pa_s * problem.fluid.at(p).viscosity);
        let log = |k: usize| from + (to - from) * k as f64 / (SAMPLES - 1) as f64;
        let fluidity = |log: f64| {
            problem.shear.map_or(1.0, |law| law.fluidity.at(unit.si(10f64.powf(log)) / law.stress_scale_pa).0)
        };
        (0..SAMPLES).map(log).map(|log| [log, (at_rest / fluidity(log)).log10()]).collect()
    };
    let hertz_pa = problem.point.hertz().pressure_pa;
    let limit = problem.lubricant.limiting_stress;
    axes::show(
        logarithmic(ui, "flow curve", height, &format!("Shear stress τ in {}", unit.name), &y_title)
            .decades_x(6.0)
            .label_formatter(|at| {
                let [stress, viscosity] = place(at).map(|log| 10f64.powf(log));
                let viscosity = numbers::quantity(viscosity, viscosity_unit.name);
                Some(format!("τ = {}\nη = {viscosity}", numbers::quantity(stress, unit.name)))
            }),
        ui,
        "Viscosity against shear stress",
        |plot| {
            axes::fit(plot, fit);
            if let Some(stress) = met.stress_pa.filter(|stress| log_of(*stress) > from) {
                plot.span(
                    Span::new("met here", from..=log_of(stress))
                        .fill(palette.accent.gamma_multiply(0.14))
                        .border_width(0.0),
                );
            }
            let place = |name: &'static str, at: [f64; 2], label: &str, color, anchor| {
                let text = rich(label, 12.5, palette.ink(color));
                Text::new("", PlotPoint::from(at), text).anchor(anchor).id((name, "label")).allow_hover(false)
            };
            let curves =
                [("at p_H", " at {p_H}", 1.0, palette.pressure), ("at p = 0", " at {p} = 0", 0.0, palette.film)];
            for (name, label, p, color) in curves {
                let points = curve(p);
                let first = points.first().copied();
                plot.line(Line::new(name, points).color(color).width(LIVE_WIDTH).allow_band(false));
                if let Some(at) = first {
                    plot.text(place(name, at, label, color, Align2::LEFT_BOTTOM));
                }
            }
            let foot = curve(0.0).last().map_or(0.0, |last| last[1]);
            for (name, label, p) in
                [("τ_L at p = 0", "{τ_L} at {p} = 0 ", 0.0), ("τ_L at p_H", "{τ_L} at {p_H} ", hertz_pa)]
            {
                if let Some(stress) = limit.map(|limit| limit.at(p)).filter(|stress| *stress > 0.0) {
                    let line = VLine::new(name, log_of(stress)).color(palette.warning).width(THIN_WIDTH);
                    plot.vline(line.style(LineStyle::dashed_dense()));
                    let anchor = if p == 0.0 { Align2::RIGHT_BOTTOM } else { Align2::RIGHT_TOP };
                    plot.text(place(name, [log_of(stress), foot], label, palette.warning, anchor));
                }
            }
        },
    );
}
