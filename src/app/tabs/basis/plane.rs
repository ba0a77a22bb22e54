//! Mode of a point contact over the plane, with the sampled equations of the reduced model.

use super::field::Field;
use crate::app::figure::Texture;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::plot::raster::Raster;
use crate::app::theme::Palette;
use crate::solver::discrete::grid::PointGrid;
use crate::solver::reduced::PodBasis;
use egui::{Color32, Ui};
use egui_plot::{Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points};

/// Number of colours between the two signs.
const SHADES: usize = 257;
/// Initial range of X and Y.
const RANGE: (f64, f64) = (-1.5, 1.5);
/// Accessible name of the plot.
const PLOT: &str = "Mode and sampled equations on the plane";

/// Image of one mode, kept while it is displayed.
#[derive(Default)]
pub struct ModeMap {
    texture: Option<Texture>,
    made_of: Option<(Field, usize, Color32)>,
}

impl ModeMap {
    /// Draws the mode in colour with marks of the sampled equations.
    pub fn ui(
        &mut self,
        ui: &mut Ui,
        (grid, basis): (&PointGrid, &PodBasis),
        (field, mode): (Field, usize),
        rows: &[PlotPoint],
        (height, fit): (f32, bool),
    ) {
        let palette = Palette::of(ui);
        let ground = ui.visuals().extreme_bg_color;
        if self.made_of != Some((field, mode, ground)) {
            let raster = Raster::new((&grid.x, &grid.y), grid.ellipse.kappa, &scaled(basis, mode), 1.0);
            let image = raster.colored(&shades(palette.reference, ground, field.color(&palette)), (-1.0, 1.0));
            Texture::put(&mut self.texture, ui.ctx(), "mode", image);
            self.made_of = Some((field, mode, ground));
        }
        let entries = [
            Entry::new("sampled equations", palette.accent, Sample::Dot(2.0)),
            Entry::new("dry contact (Hertz)", palette.reference, Sample::Dashed(1.0)),
        ];
        let shown = key::over(ui, height, entries, |ui, height| {
            let plot = axes::plot(ui, "mode in the plane", height, "{X} = {x}/{a}", "{Y} = {y}/{a}")
                .data_aspect(1.0)
                .default_x_bounds(RANGE.0, RANGE.1)
                .default_y_bounds(RANGE.0, RANGE.1);
            axes::show(plot, ui, PLOT, |plot| {
                axes::fit(plot, fit);
                if let (Some(texture), [from, .., to], [edge, ..]) =
                    (&self.texture, grid.x.as_slice(), grid.y.as_slice())
                {
                    let texture = texture.shown(plot.ctx());
                    plot.field("mode", texture, (*from, *to), (*edge, -edge), Color32::WHITE);
                }
                let circle = |t: f64| (t.cos(), t.sin());
                let hertz = PlotPoints::from_parametric_callback(circle, 0.0..=std::f64::consts::TAU, 181);
                let hertz = Line::new("", hertz).id("hertz").color(palette.reference).width(1.0);
                plot.line(hertz.style(LineStyle::dashed_dense()).allow_hover(false));
                let marks = Points::new("Sampled equations", PlotPoints::Borrowed(rows));
                plot.points(marks.color(palette.accent).radius(1.6).shape(MarkerShape::Circle));
            })
        });
        let tip = "The first of the chosen modes, coloured where it is positive and grey where it is negative. Marks \
                   are the sampled equations and their mirror images, the dashed circle is the Hertzian contact";
        shown.response.on_hover_text(tip);
    }
}

/// Returns colours from a first through a second to a third.
fn shades(negative: Color32, zero: Color32, positive: Color32) -> Vec<Color32> {
    let middle = (SHADES / 2) as f32;
    let at = |k: usize| {
        let t = k as f32 / middle - 1.0;
        zero.lerp_to_gamma(if t < 0.0 { negative } else { positive }, t.abs())
    };
    (0..SHADES).map(at).collect()
}

/// Returns a mode over the node array, scaled so that its value of largest magnitude is one. The sign of a mode is
/// arbitrary.
pub fn scaled(basis: &PodBasis, k: usize) -> Vec<f64> {
    let column = (0..basis.modes.nrows()).map(|i| basis.modes[(i, k)]);
    let largest = column.clone().fold(0.0, |most: f64, v| if v.abs() > most.abs() { v } else { most });
    column.map(|v| if largest == 0.0 { 0.0 } else { v / largest }).collect()
}
