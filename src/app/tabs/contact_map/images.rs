//! Image and contour lines of the map, updated only when the solution or its display changes.

use super::map_view::{MapView, Shown, mid_film_rises};
use crate::app::answers::picture::Picture;
use crate::app::figure::{Texture, pixels};
use crate::app::numbers;
use crate::app::plot::color_bar::UNITS;
use crate::app::plot::color_map;
use crate::app::plot::contours::Field;
use crate::app::plot::raster::Raster;
use crate::scene::drawing::encode;
use crate::solver::full::Solution;
use egui::{Color32, ColorImage, Context, TextureId};
use egui_plot::PlotPoint;
use std::borrow::Cow;
use std::sync::Arc;

/// Contour line. The longest line of each level also has its name and the position of the name.
pub type Contour = (Option<(PlotPoint, String)>, Vec<PlotPoint>);

/// Images kept between frames.
#[derive(Default)]
pub struct Images {
    texture: Option<Texture>,
    contours: Vec<Contour>,
    range: (f64, f64),
    domain: (f64, f64, f64),
    made_of: Option<(Arc<Solution>, MapView)>,
}

/// Minimum upper end of a temperature scale \[K\].
const LEAST_K: f64 = 0.1;

/// Minimum upper end of a scale of asperity pressures.
const LEAST_ASPERITIES: f64 = 1e-4;

/// Approximate number of contour lines between the ends of the scale.
const LINES: f64 = 8.0;
impl Images {
    /// Updates image and contour lines if they are out of date.
    pub fn follow(&mut self, ctx: &Context, picture: &Picture, view: &MapView) {
        let solution = &picture.solution;
        if self.made_of.as_ref().is_some_and(|(of, with)| Arc::ptr_eq(of, solution) && with == view) {
            return;
        }
        self.range = range(solution, view.shown);
        let kappa = picture.kappa();
        self.domain = match (solution.x.as_slice(), solution.y.as_slice()) {
            ([from, .., to], [edge, ..]) => (*from, *to, kappa * edge),
            _ => (0.0, 0.0, 0.0),
        };
        Texture::put(&mut self.texture, ctx, "contact map", draw(picture, view, self.range));
        let lines = view.contours && view.shown != Shown::Interferogram;
        self.contours = if lines { contours(solution, kappa, view.shown, self.range) } else { Vec::new() };
        self.made_of = Some((Arc::clone(solution), *view));
    }

    /// Returns the texture and its domain in units of a: inlet, outlet, outer edge.
    pub fn texture(&self, ctx: &Context) -> Option<(TextureId, (f64, f64, f64))> {
        self.texture.as_ref().map(|texture| (texture.shown(ctx), self.domain))
    }

    /// Returns the contour lines of both halves.
    pub fn contours(&self) -> &[Contour] {
        &self.contours
    }

    /// Returns the values at the ends of the scale.
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// Returns the image as a PNG file. Empty if there is none.
    pub fn png(&self) -> Vec<u8> {
        self.texture.as_ref().map_or_else(Vec::new, |texture| encode(&pixels(texture.image()), None))
    }
}

/// Returns the film thickness at the centre, or the composite roughness if it is larger: the mean planes of rough surfaces
/// may touch.
fn usual_film(solution: &Solution) -> f64 {
    solution.scalars.h_c.max(solution.problem.rough.map_or(0.0, |rough| rough.sigma))
}

/// Returns the ends of the scale. They are round, so that colours stay fixed while the contact changes.
fn range(solution: &Solution, shown: Shown) -> (f64, f64) {
    match shown {
        // The scale ends just above the film thickness of the contact, so that the colours resolve the side lobes.
        Shown::Film => {
            let high = numbers::round_up(1.5 * usual_film(solution));
            let unit = high / UNITS;
            (unit * (solution.scalars.h_min / unit).floor().clamp(0.0, UNITS - 2.0), high)
        }
        Shown::Interferogram => (0.0, numbers::round_up(2.5 * usual_film(solution))),
        Shown::Pressure => (0.0, numbers::round_up(solution.scalars.p_max)),
        Shown::Asperities => {
            let largest = solution.asperity_pressure.iter().copied().fold(0.0, f64::max);
            (0.0, numbers::round_up(largest.max(LEAST_ASPERITIES)))
        }
        Shown::Temperature => {
            let largest = solution.heat.as_deref().map_or(0.0, |heat| heat.largest.mid_film_k);
            (0.0, numbers::round_up(largest.max(LEAST_K)))
        }
    }
}

/// Returns the colours of a field's scale. Thin film and high pressure are bright.
pub fn table(shown: Shown) -> Vec<Color32> {
    color_map::table(shown == Shown::Film)
}

/// Returns the displayed field as a node array.
fn values(solution: &Solution, shown: Shown) -> Cow<'_, [f64]> {
    match (shown, solution.heat.as_deref()) {
        (Shown::Temperature, Some(heat)) => Cow::Owned(mid_film_rises(heat)),
        (Shown::Asperities, _) if solution.asperity_pressure.len() == solution.pressure.len() => {
            Cow::Borrowed(&solution.asperity_pressure)
        }
        (Shown::Pressure, _) => Cow::Borrowed(&solution.pressure),
        _ => Cow::Borrowed(&solution.film),
    }
}

fn draw(picture: &Picture, view: &MapView, range: (f64, f64)) -> ColorImage {
    let solution = &*picture.solution;
    let raster = |field, scale| {
        let nodes = (solution.x.as_slice(), solution.y.as_slice());
        Raster::new(nodes, picture.kappa(), field, scale)
    };
    match view.shown {
        Shown::Film => raster(&solution.film, 1.0).colored(&table(view.shown), range),
        Shown::Pressure | Shown::Asperities | Shown::Temperature => {
            raster(&values(solution, view.shown), 1.0).colored(&table(view.shown), range)
        }
        Shown::Interferogram => {
            let films = raster(&solution.film, picture.key.point.film_scale_m());
            films.interferogram(&view.rig, view.three_colors)
        }
    }
}

/// Returns contour lines at round levels in units of a, each with its mirror image.
fn contours(solution: &Solution, kappa: f64, shown: Shown, (low, high): (f64, f64)) -> Vec<Contour> {
    let values = values(solution, shown);
    let field = Field { x: &solution.x, y: &solution.y, values: &values };
    let step = numbers::round_up((high - low) / LINES);
    let levels = (1..=(high / step).floor() as usize).filter(|&k| step * k as f64 > low);
    let mut all = Vec::new();
    for k in levels {
        let level = step * k as f64;
        // Names of neighbouring lines are placed apart, each further along its line by the golden section.
        let place = (0.618 * k as f64).fract();
        let lines = field.contours(level);
        let longest = lines.iter().map(Vec::len).max().unwrap_or(0);
        let mut unnamed = true;
        for line in lines {
            for up in [kappa, -kappa] {
                let points: Vec<PlotPoint> = line.iter().map(|p| PlotPoint::new(p[0], up * p[1])).collect();
                let name = (unnamed && line.len() == longest && longest > 12)
                    .then(|| {
                        points.get((place * points.len() as f64) as usize).map(|at| (*at, numbers::digits(level, 2)))
                    })
                    .flatten();
                unnamed &= name.is_none();
                all.push((name, points));
            }
        }
    }
    all
}
