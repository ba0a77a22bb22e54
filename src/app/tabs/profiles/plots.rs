//! Plots of pressure, film thickness, and the difference between reduced and full solution.

use super::curves::{Scene, asperities, cavitated, curve, hover, mark, mark_lifted, roughness, rupture, stacked};
use crate::app::answers::picture::Comparison;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::direction::Direction;
use crate::app::theme::{Palette, THIN_WIDTH, rich};
use crate::app::units::{self, Scale, Scales};
use egui::{Align2, Ui};
use egui_plot::{Line, LineStyle, PlotPoint, PlotPoints, Text};

/// Space that the name of the spike needs next to it.
const SPIKE_ROOM: f32 = 48.0;

/// Draws the pressure. Returns the position to which the user drags the line of the other cut.
pub fn pressure_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) -> Option<f64> {
    let palette = Palette::of(ui);
    let (picture, system) = (scene.picture, units::system(ui.ctx()));
    let (scalars, scales) = (picture.solution.scalars, Scales::of(&picture.key.point, system));
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.p_max).fold(scalars.p_max.max(1.0), f64::max);
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let (on_axis, height_here) = (elsewhere == 0.0 && direction == Direction::Along, 1.0 - elsewhere * elsewhere);
    let y_title = if direction == Direction::Along { "Pressure {P} = {p}/{p_H}" } else { "" };
    let cut = scene.cut_line(direction, "pressure");
    let shown = axes::show(
        stacked(ui, (direction, direction.length(scales), picture.kappa()), ("pressure", height), ("", y_title))
            .paper_y("Pressure {P} = {p}/{p_H}")
            .units_y(scales.pressure, "Pressure {p}")
            .allow_drag(cut.as_ref().is_none_or(|cut| !cut.is_held(ui)))
            .default_x_bounds(from, to)
            .default_y_bounds(-0.04 * top, numbers::round_up(1.12 * top))
            .label_formatter(hover(picture, direction, system)),
        ui,
        &direction.profile_name("Pressure"),
        |plot| {
            axes::fit(plot, scene.fit);
            if on_axis {
                cavitated(plot, picture, &palette);
            }
            asperities(plot, scene, direction, &palette);
            let hertz: PlotPoints<'_> =
                PlotPoints::from_explicit_callback(move |x| (height_here - x * x).max(0.0).sqrt(), -1.0..=1.0, 201);
            plot.line(
                Line::new("Hertz", hertz).color(palette.reference).width(THIN_WIDTH).style(LineStyle::dashed_dense()),
            );
            let live = scene.curves(
                plot,
                (&palette, palette.pressure),
                direction,
                move |picture| direction.pressure(picture),
                |of| of.pressure.factor,
            );
            if on_axis {
                rupture(plot, scene, &palette);
            }
            if let Some(spike) = picture.spike.filter(|s| on_axis && (s.0 < scalars.x_p_max - 1e-9 || s.0 > 0.5)) {
                // The name is next to the spike, or above it if the plot ends.
                let place = plot.transform().position_from_point(&PlotPoint::new(spike.0, spike.1));
                let room = plot.response().rect.right() - place.x > SPIKE_ROOM;
                mark(plot, spike, "spike", live, if room { Align2::LEFT_BOTTOM } else { Align2::CENTER_BOTTOM });
            }
            if let Some(cut) = &cut {
                cut.draw(plot, palette.accent);
            }
        },
    );
    cut?.moved(ui, &shown.response, &shown.transform)
}

/// Draws the film thickness. Returns the position to which the user drags the line of the other cut.
pub fn film_plot(ui: &mut Ui, scene: &Scene<'_>, direction: Direction, height: f32) -> Option<f64> {
    let palette = Palette::of(ui);
    let (picture, system) = (scene.picture, units::system(ui.ctx()));
    let (scalars, scales) = (picture.solution.scalars, Scales::of(&picture.key.point, system));
    // The mean planes of rough surfaces may touch.
    let sigma = picture.solution.problem.rough.map_or(0.0, |rough| rough.sigma);
    let top = scene.pins.iter().map(|p| p.picture.solution.scalars.h_c).fold(scalars.h_c.max(sigma), f64::max);
    let bottom = if sigma > 0.0 { (scalars.h_min - 1.5 * sigma).min(0.0) } else { 0.0 };
    let (from, to) = direction.range();
    let elsewhere = direction.elsewhere(scene.cuts);
    let x_title = direction.x_title(picture, scene.cuts);
    let y_title = if direction == Direction::Along { "Film {H} = {h}{R}/{a}²" } else { "" };
    let cut = scene.cut_line(direction, "film");
    let shown = axes::show(
        stacked(ui, (direction, direction.length(scales), picture.kappa()), ("film", height), (&x_title, y_title))
            .paper_y("Film {H} = {h}{R}/{a}²")
            .units_y(scales.film, "Film {h}")
            .allow_drag(cut.as_ref().is_none_or(|cut| !cut.is_held(ui)))
            .default_x_bounds(from, to)
            .default_y_bounds(bottom, numbers::round_up(4.0 * top))
            .label_formatter(hover(picture, direction, system)),
        ui,
        &direction.profile_name("Film"),
        |plot| {
            axes::fit(plot, scene.fit);
            if direction == Direction::Along && elsewhere == 0.0 {
                cavitated(plot, picture, &palette);
            }
            roughness(plot, scene, direction, &palette);
            let live = scene.curves(
                plot,
                (&palette, palette.film),
                direction,
                move |of| direction.film(of),
                |of| of.film.factor,
            );
            if elsewhere == 0.0 {
                mark(plot, (0.0, scalars.h_c), "{H_c}", live, Align2::LEFT_BOTTOM);
            }
            if let Some(cut) = &cut {
                cut.draw(plot, palette.accent);
            }
            let Some(at) = direction.minimum(picture, scene.cuts) else { return };
            // The name is below the curve, or below its outlet. If the axis would cut it off, it is above the flat
            // part of the film.
            let point = plot.transform().position_from_point(&PlotPoint::new(0.0, scalars.h_min));
            let above = (scalars.h_c - scalars.h_min).max(0.0) + 3.0 * plot.transform().dvalue_dpos()[1].abs();
            let (anchor, lift) = match plot.response().rect.bottom() - point.y {
                room if room > 34.0 => (Align2::CENTER_TOP, 0.0),
                room if room > 20.0 => (Align2::LEFT_TOP, 0.0),
                _ => (Align2::RIGHT_BOTTOM, above),
            };
            mark_lifted(plot, ((at, scalars.h_min), lift), "{H_min}", live, anchor);
        },
    );
    cut?.moved(ui, &shown.response, &shown.transform)
}

/// Draws the difference between reduced and full solution.
pub fn difference_plot(
    ui: &mut Ui,
    (comparison, along): (&Comparison, Scale),
    (wanted, stale): (bool, bool),
    height: f32,
) {
    let palette = Palette::of(ui);
    let (from, to) = Direction::Along.range();
    let plot = stacked(ui, (Direction::Along, along, 1.0), ("difference", height), ("", "Reduced − full"));
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
                // The name is at the maximum of the curve, away from the other curve.
                if let Some(at) = points.iter().max_by(|a, b| a.y.abs().total_cmp(&b.y.abs())) {
                    let text = Text::new("", *at, rich(&format!("  {label}"), 12.5, palette.ink(color(hue))));
                    plot.text(text.anchor(anchor).id((name, "label")).allow_hover(false));
                }
            }
        },
    );
}
