//! Temperatures of a thermal contact: temperature rises of mid-film and surfaces along X, the film in its true
//! shape coloured by temperature, and the heat balance.

use crate::app::context::Context;
use crate::app::controls::warning_ui;
use crate::app::figure::Texture;
use crate::app::plot::direction::Direction;
use crate::app::plot::frame::PlotFrame;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::plot::{axes, color_bar, color_map};
use crate::app::tabs::profiles::curves;
use crate::app::theme::{LIVE_WIDTH, Palette, THIN_WIDTH};
use crate::app::units::{self, Scale, Scales};
use crate::app::{drawn, figure, numbers};
use crate::solver::discrete::heat::{HeatBalance, interpolated_across};
use crate::solver::full::Solution;
use crate::solver::full::heat::{Rises, Temperatures};
use crate::solver::physics::engineering::QuantityKind;
use egui::{Color32, ColorImage, Rect, Sense, Stroke, StrokeKind, Ui, vec2};
use egui_plot::{HoverPosition, PlotPoint, PlotPoints};
use std::sync::Arc;

/// Columns and rows of the image.
const COLUMNS: usize = 240;
const ROWS: usize = 72;
/// Height of the drawn film over H_c. The inlet is higher.
const TOP: f64 = 2.2;
/// Height of the bar with its text.
const BAR_HEIGHT: f32 = 40.0;

/// Curves and image kept between frames, with their solution.
#[derive(Default)]
pub struct TemperatureImage {
    texture: Option<Texture>,
    made_of: Option<Arc<Solution>>,
    /// Temperature rises \[K\] at mid-film, of body 1 and of body 2.
    rises: [Vec<PlotPoint>; 3],
    /// H, film thickness.
    film: Vec<PlotPoint>,
    /// Maximum temperature rise in the image \[K\].
    largest_k: f64,
    /// Height of the image in units of H.
    top: f64,
}

/// Names of the curves.
const NAMES: [&str; 3] = ["mid-film", "body 1", "body 2"];

/// Returns their colours.
fn hues(ui: &Ui, stale: bool) -> [Color32; 3] {
    let palette = Palette::of(ui);
    let hues = [palette.traction, palette.deformation, palette.accent];
    hues.map(|color| if stale { palette.reference } else { color })
}

/// Returns T − T₀ \[K\] at X and at a height scaled with a²/R. `None` outside the film.
fn rise_at(heat: &Temperatures, x: f64, height: f64) -> Option<f64> {
    let right = heat.x.partition_point(|at| *at < x);
    let left = right.checked_sub(1)?;
    let t = (x - heat.x[left]) / (heat.x.get(right)? - heat.x[left]);
    let between = |a: f64, b: f64| (1.0 - t) * a + t * b;
    let film = between(heat.film_along_axis().nth(left)?, heat.film_along_axis().nth(right)?);
    let zeta = height / film;
    let at = |node: usize| heat.along_axis().nth(node).map(|profile| interpolated_across(profile, zeta));
    let (a, b) = (at(left)?, at(right)?);
    (0.0..=1.0).contains(&zeta).then(|| between(a, b))
}

impl TemperatureImage {
    /// Updates curves and image if they are out of date.
    pub fn follow(&mut self, ctx: &egui::Context, solution: &Arc<Solution>) {
        let Some(heat) = solution.heat.as_deref() else { return };
        if self.made_of.as_ref().is_some_and(|of| Arc::ptr_eq(of, solution)) {
            return;
        }
        let rises: Vec<_> = heat.x.iter().zip(heat.along_axis().map(Rises::of)).collect();
        self.rises = [0, 1, 2].map(|k| {
            let of = |(x, rises): &(&f64, Rises)| {
                PlotPoint::new(**x, [rises.mid_film_k, rises.surfaces_k[0], rises.surfaces_k[1]][k])
            };
            rises.iter().map(of).collect()
        });
        self.film = heat.x.iter().zip(heat.film_along_axis()).map(|(x, h)| PlotPoint::new(*x, h)).collect();
        self.top = numbers::round_up(TOP * solution.scalars.h_c);
        let (from, to) = Direction::Along.range();
        let place = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
        // Images start at the top.
        let values: Vec<Option<f64>> = (0..COLUMNS * ROWS)
            .map(|k| {
                let (row, column) = (ROWS - 1 - k / COLUMNS, k % COLUMNS);
                rise_at(heat, from + (to - from) * place(column, COLUMNS), self.top * place(row, ROWS))
            })
            .collect();
        self.largest_k = values.iter().flatten().fold(1e-3, |largest: f64, value| largest.max(*value));
        let table = color_map::table(false);
        let color = |value: &Option<f64>| match value {
            Some(value) => {
                table[((value / self.largest_k).clamp(0.0, 1.0) * (table.len() - 1) as f64).round() as usize]
            }
            None => Color32::TRANSPARENT,
        };
        let image = ColorImage::new([COLUMNS, ROWS], values.iter().map(color).collect());
        Texture::put(&mut self.texture, ctx, "temperatures", image);
        self.made_of = Some(Arc::clone(solution));
    }
}

/// Draws the key of the lines.
pub fn key_ui(ui: &mut Ui, stale: bool) {
    let entries = NAMES.into_iter().zip(hues(ui, stale));
    key::ui(ui, entries.map(|(name, color)| Entry::new(name, color, Sample::Line(LIVE_WIDTH))));
}

/// Draws two plots of equal height, the lower one including the bar of the heat balance.
pub fn ui(ui: &mut Ui, image: &TemperatureImage, context: &Context<'_>, (scales, stale): (Scales, bool), height: f32) {
    let Some((solution, texture)) = image.made_of.as_ref().zip(image.texture.as_ref()) else { return };
    let Some(heat) = solution.heat.as_deref() else { return };
    let palette = Palette::of(ui);
    let hues = hues(ui, stale);
    rises_plot(ui, image, (hues, scales), context.fit, height);
    let texture = texture.shown(ui.ctx());
    let (from, to) = Direction::Along.range();
    let (top, system) = (image.top, context.system);
    let rise_text = move |kelvin: f64| numbers::shown(QuantityKind::TemperatureRise, kelvin, system);
    let plot = linked(
        ui,
        ("temperatures", height - BAR_HEIGHT),
        (&Direction::Along.title(1.0), "Height {Z} = {z}{R}/{a}²"),
        scales,
    )
    .paper_y("Height {Z} = {z}{R}/{a}²")
    .units_y(scales.film, "Height {z}")
    .default_y_bounds(0.0, top)
    .label_formatter(move |at| {
        let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
        let rise = rise_at(heat, position.x, position.y)?;
        Some(format!("X = {}   {} above the inlet", numbers::digits(position.x, 3), rise_text(rise)))
    });
    axes::show(plot, ui, "Temperatures of the film", |plot| {
        axes::fit(plot, context.fit);
        plot.field("temperature field", texture, (from, to), (0.0, top), drawn::tint(stale));
        let film = PlotPoints::Borrowed(&image.film);
        plot.line(curves::curve("upper surface".to_owned(), film, palette.quiet, THIN_WIDTH));
    });
    let Scale { factor, unit } = Scale::of(QuantityKind::TemperatureRise, system, 1.0);
    let colors = color_bar::strips(&color_map::table(false));
    figure::scale(ui.ctx(), &format!("Rise in {unit}"), (0.0, factor * image.largest_k), &colors);
    balance_ui(ui, &heat.balance, hues);
    match heat.too_hot() {
        Some(warning) => warning_ui(ui, &warning.to_string()),
        None => {
            let above = rise_text(image.largest_k);
            ui.weak(format!("Colours: from the inlet’s temperature to {above} above it"));
        }
    }
}

fn rises_plot(ui: &mut Ui, image: &TemperatureImage, (hues, scales): ([Color32; 3], Scales), fit: bool, height: f32) {
    let most = image.rises.iter().flatten().fold(1e-3, |most: f64, point| most.max(point.y));
    let least = image.rises.iter().flatten().fold(0.0, |least: f64, point| least.min(point.y));
    let system = units::system(ui.ctx());
    let plot = linked(ui, ("rises", height), ("", "Rise"), scales)
        .always_y(Scale::of(QuantityKind::TemperatureRise, system, 1.0), "Rise")
        .default_y_bounds(1.08 * least.max(-0.3 * most), numbers::round_up(1.08 * most))
        .label_formatter(move |at| match at {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                let x = numbers::digits(position.x, 3);
                let rise = numbers::shown(QuantityKind::TemperatureRise, position.y, system);
                Some(format!("X = {x}\n{plot_name} {rise} above the inlet"))
            }
            HoverPosition::Elsewhere { .. } => None,
        });
    axes::show(plot, ui, "Rises of temperature", |plot| {
        axes::fit(plot, fit);
        for ((points, name), color) in image.rises.iter().zip(NAMES).zip(hues) {
            plot.line(curves::curve(name.to_owned(), PlotPoints::Borrowed(points), color, LIVE_WIDTH));
        }
    });
}

/// Returns a plot on the axis of the profiles.
fn linked<'a>(ui: &Ui, (id, height): (&str, f32), titles: (&str, &str), scales: Scales) -> PlotFrame<'a> {
    let (from, to) = Direction::Along.range();
    let direction = (Direction::Along, Direction::Along.length(scales), 1.0);
    curves::stacked(ui, direction, (id, height), titles).default_x_bounds(from, to)
}

/// Draws the heat balance as parts of a bar with their names.
fn balance_ui(ui: &mut Ui, balance: &HeatBalance, hues: [Color32; 3]) {
    let palette = Palette::of(ui);
    let [one, two] = balance.into_bodies;
    let shares =
        [("into body 1", one, hues[1]), ("into body 2", two, hues[2]), ("with the oil", balance.carried, hues[0])];
    let whole: f64 = shares.iter().map(|(_, share, _)| share.max(0.0)).sum();
    let made = balance.sheared + balance.compressed;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        ui.weak("Heat").on_hover_text(
            "Shares of the heat from shear and compression up to the cavitation boundary. Heat of the backflow in the \
             inlet leaves with the oil",
        );
        let (area, _) = ui.allocate_exact_size(vec2(70.0, 11.0), Sense::hover());
        let mut left = area.left();
        for (_, share, color) in shares {
            let width = area.width() * (share.max(0.0) / whole.max(f64::MIN_POSITIVE)) as f32;
            let part = Rect::from_min_size(egui::pos2(left, area.top()), vec2(width, area.height()));
            ui.painter().rect_filled(part, 0.0, color);
            left += width;
        }
        ui.painter().rect_stroke(area, 0.0, Stroke::new(1.0, palette.quiet), StrokeKind::Outside);
        for (name, share, color) in shares {
            let share = if made > 0.0 { numbers::digits(100.0 * share / made, 2) } else { "–".to_owned() };
            ui.colored_label(palette.ink(color), format!("{share} % {name}"));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::{FullSolver, Start};
    use crate::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
    use crate::solver::physics::lubricant::{Heat, Lubricant, ShearLaw};

    #[test]
    fn the_picture_is_as_hot_as_the_film_and_empty_above_it() {
        let sliding = Sliding { slide_to_roll_ratio: 0.3, newtonian_plateau_ratio: None };
        let quantities = [0.01, 2.0, 3e5, 231e9, 0.02, 1.8e-8];
        let point = OperatingPoint::from_quantities(ContactKind::Line, quantities, sliding);
        let shear = ShearLaw::Eyring { critical_stress: 6e6, npr: 0.0 };
        let lubricant = Lubricant { shear, heat: Some(Heat::default()), ..Lubricant::default() };
        let mut solver = FullSolver::new(GridSpec::EXPLORER).unwrap();
        let solution = Arc::new(solver.solve(&point, lubricant, Start::Cold, &()).unwrap());
        let mut image = TemperatureImage::default();
        image.follow(&egui::Context::default(), &solution);
        let heat = solution.heat.as_ref().unwrap();
        let at = |height: f64| rise_at(heat, 0.0, height * solution.scalars.h_c);
        assert!((at(0.5).unwrap() - heat.central.mid_film_k).abs() < 0.05);
        assert!((at(0.0).unwrap() - heat.central.surfaces_k[0]).abs() < 0.05);
        assert_eq!((at(1.1), at(-0.1), rise_at(heat, 5.0, 0.0)), (None, None, None));
        assert!((image.largest_k / heat.largest.mid_film_k - 1.0).abs() < 0.1, "{}", image.largest_k);
        let hottest = image.rises[0].iter().fold(0.0f64, |hottest, point| hottest.max(point.y));
        assert!((hottest / heat.largest.mid_film_k - 1.0).abs() < 0.02);
        let pixels = &image.texture.as_ref().unwrap().image().pixels;
        // At the centre the film fills part of the height, at the end of the inlet all of it.
        let filled = |column: usize| (0..ROWS).filter(|row| pixels[row * COLUMNS + column].a() > 0).count();
        let middle = filled(COLUMNS * 22 / 38) as f64 / ROWS as f64;
        assert!((middle * image.top / solution.scalars.h_c - 1.0).abs() < 0.05 && filled(2) == ROWS, "{middle}");
    }
}
