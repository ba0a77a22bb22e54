//! Shear stress and shear rate across the film, between the surfaces Z = 0 and Z = 1, along the axis of the
//! contact.

use crate::app::answers::picture::{Picture, value_at};
use crate::app::figure::Texture;
use crate::app::plot::direction::Direction;
use crate::app::plot::{axes, color_map};
use crate::app::theme::Palette;
use crate::app::units::{self, Scale};
use crate::app::{drawn, numbers};
use crate::solver::full::Solution;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{ColorImage, Context, Id, Sense, Ui, Vec2b, vec2};
use egui_plot::{HoverPosition, PlotPoint};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Columns and rows of the image. The shear varies smoothly, and the screen interpolates.
const COLUMNS: usize = 320;
const ROWS: usize = 25;
/// Number of decades of the shear rate below its maximum that have separate colours.
const DECADES: f64 = 4.0;

/// Quantity shown across the film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum FilmShear {
    /// Nothing.
    #[default]
    Off,
    /// τ_zx.
    Stress,
    /// ∂u/∂z.
    Rate,
}

impl FilmShear {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::Off, Self::Stress, Self::Rate];

    /// Returns the name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "no shear",
            Self::Stress => "shear stress",
            Self::Rate => "shear rate",
        }
    }

    pub fn tip(self) -> &'static str {
        match self {
            Self::Off => "Pressure and film only",
            Self::Stress => {
                "τ_zx across the film: linear from body 1 below to body 2 above, positive where body 2 drags the film along"
            }
            Self::Rate => "∂u/∂z across the film, its size on a logarithmic scale over four decades",
        }
    }
}

/// Image kept between frames, with its values and its solution.
#[derive(Default)]
pub struct FilmShearImage {
    texture: Option<Texture>,
    made_of: Option<(Arc<Solution>, FilmShear)>,
    /// Stress \[Pa\] or rate \[1/s\], row after row from Z = 0.
    values: Vec<f64>,
    /// Values at the ends of the colour scale, or decimal logarithms of magnitudes.
    range: (f64, f64),
}

impl FilmShearImage {
    /// Updates the image if it is out of date.
    pub fn follow(&mut self, ctx: &Context, picture: &Picture, shown: FilmShear) {
        let solution = &picture.solution;
        if self.made_of.as_ref().is_some_and(|(of, with)| Arc::ptr_eq(of, solution) && *with == shown) {
            return;
        }
        self.values = values(solution, shown);
        self.range = range(&self.values, shown);
        let colors = color_map::table(false);
        let pixel = |k: usize| {
            // Images start at the top, Z at the bottom.
            let (row, column) = (ROWS - 1 - k / COLUMNS, k % COLUMNS);
            let t = share(self.values[row * COLUMNS + column], shown, self.range);
            colors[(t * (colors.len() - 1) as f64).round() as usize]
        };
        let image = ColorImage::new([COLUMNS, ROWS], (0..COLUMNS * ROWS).map(pixel).collect());
        Texture::put(&mut self.texture, ctx, "film shear", image);
        self.made_of = Some((Arc::clone(solution), shown));
    }

    /// Returns the value at a place. `None` outside the image.
    fn at(&self, x: f64, z: f64) -> Option<f64> {
        let (from, to) = Direction::Along.range();
        let inside = (from..=to).contains(&x) && (0.0..=1.0).contains(&z);
        let column = ((x - from) / (to - from) * (COLUMNS - 1) as f64).round() as usize;
        let row = (z * (ROWS - 1) as f64).round() as usize;
        inside.then(|| self.values.get(row * COLUMNS + column).copied()).flatten()
    }
}

/// Returns the shear at the columns' abscissae and the rows' heights. Zero outside the domain.
fn values(solution: &Solution, shown: FilmShear) -> Vec<f64> {
    let heights: Vec<f64> = (0..ROWS).map(|k| k as f64 / (ROWS - 1) as f64).collect();
    let field = solution.shear_field(&heights);
    let nodes: Vec<f64> = solution.profile().map(|(x, ..)| x).collect();
    let (from, to) = Direction::Along.range();
    let place = |column: usize| from + (to - from) * column as f64 / (COLUMNS - 1) as f64;
    let row = |row: usize| {
        let of = |node: usize| {
            let shear = field[node * ROWS + row];
            PlotPoint::new(nodes[node], if shown == FilmShear::Rate { shear.rate_per_s } else { shear.stress_pa })
        };
        let curve: Vec<PlotPoint> = (0..nodes.len()).map(of).collect();
        (0..COLUMNS).map(move |column| value_at(&curve, place(column)).unwrap_or(0.0))
    };
    (0..ROWS).flat_map(row).collect()
}

fn range(values: &[f64], shown: FilmShear) -> (f64, f64) {
    let (low, high) = values.iter().fold((0.0f64, 0.0f64), |(low, high), v| (low.min(*v), high.max(*v)));
    match shown {
        FilmShear::Rate => {
            let top = high.max(-low).max(f64::MIN_POSITIVE).log10();
            (top - DECADES, top)
        }
        _ if low == high => (0.0, 1.0),
        _ => (low, high),
    }
}

/// Returns the position of a value between the ends of the colour scale, 0…1.
fn share(value: f64, shown: FilmShear, (low, high): (f64, f64)) -> f64 {
    let value = if shown == FilmShear::Rate { value.abs().max(f64::MIN_POSITIVE).log10() } else { value };
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

/// Returns the value with its unit.
fn quantity(value: f64, shown: FilmShear, system: UnitSystem) -> String {
    let kind = if shown == FilmShear::Rate { QuantityKind::ShearRate } else { QuantityKind::Stress };
    numbers::shown(kind, value, system)
}

/// Draws the scale, and the film between its surfaces on the axis of the profiles.
pub fn ui(ui: &mut Ui, (image, along): (&FilmShearImage, Scale), shown: FilmShear, stale: bool, height: f32) {
    let Some(texture) = image.texture.as_ref().map(|texture| texture.shown(ui.ctx())) else { return };
    let system = units::system(ui.ctx());
    scale_ui(ui, image, shown);
    let (from, to) = Direction::Along.range();
    axes::show(
        axes::plot(ui, "film shear", (height - 26.0).max(70.0), "", "Height {Z} = {z}/{h}")
            .paper_x("{X} = {x}/{a}")
            .units_x(along, "{x}")
            .link_axis(Id::unique(Direction::Along.id("profiles")), Vec2b::new(true, false))
            .link_cursor(Id::unique(Direction::Along.id("profiles")), Vec2b::new(true, false))
            .marks_y(2.0)
            .default_x_bounds(from, to)
            .default_y_bounds(0.0, 1.0)
            .show_y(false)
            .label_formatter(|at| {
                let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
                let value = image.at(position.x, position.y)?;
                let (x, z) = (numbers::digits(position.x, 3), numbers::digits(position.y, 2));
                Some(format!("X = {x}   Z = {z}\n{} {}", shown.name(), quantity(value, shown, system)))
            }),
        ui,
        "Shear across the film",
        |plot| {
            plot.field("shear field", texture, (from, to), (0.0, 1.0), drawn::tint(stale));
        },
    );
}

fn scale_ui(ui: &mut Ui, image: &FilmShearImage, shown: FilmShear) {
    let plane = image.made_of.as_ref().is_some_and(|(solution, _)| solution.y.len() > 1);
    let ((low, high), system) = (image.range, units::system(ui.ctx()));
    let [low, high] = if shown == FilmShear::Rate { [low, high].map(|log| 10f64.powf(log)) } else { [low, high] };
    ui.horizontal(|ui| {
        ui.label(crate::app::controls::sentence(shown.name()).trim_end_matches('.')).on_hover_text(shown.tip());
        ui.weak(quantity(low, shown, system));
        let (area, _) = ui.allocate_exact_size(vec2(120.0, 10.0), Sense::hover());
        let colors = color_map::table(false);
        let strips = 60;
        for k in 0..strips {
            let left = area.left() + area.width() * k as f32 / strips as f32;
            let strip = egui::Rect::from_min_size(
                egui::pos2(left, area.top()),
                vec2(area.width() / strips as f32 + 0.6, area.height()),
            );
            ui.painter().rect_filled(strip, 0.0, colors[k * (colors.len() - 1) / (strips - 1)]);
        }
        ui.painter().rect_stroke(area, 0.0, egui::Stroke::new(1.0, Palette::of(ui).quiet), egui::StrokeKind::Outside);
        ui.weak(quantity(high, shown, system));
        ui.weak(if plane { "in the plane Y = 0, between the surfaces" } else { "between the surfaces" });
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::by_name;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::{FullSolver, Start};
    use crate::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};

    #[test]
    fn stress_across_the_film_averages_to_the_traction() {
        let squalane = by_name("squalane-pip").unwrap();
        let sliding = Sliding { slide_to_roll_ratio: 0.5, newtonian_plateau_ratio: None };
        let point = OperatingPoint { sliding, ..squalane.studied_contact(ContactKind::Line).unwrap() };
        let mut solver = FullSolver::new(GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }).unwrap();
        let solution = solver.solve(&point, squalane.laws, Start::Cold, &()).unwrap();
        assert!(solution.converged());
        let stress = values(&solution, FilmShear::Stress);
        let at = |row: usize, column: usize| stress[row * COLUMNS + column];
        for column in (0..COLUMNS).step_by(20) {
            let mean = 0.5 * (at(0, column) + at(ROWS - 1, column));
            assert!((mean - at(ROWS / 2, column)).abs() < 1e-9 * at(0, column).abs().max(1.0));
        }
        // Integral of mid-film over the drawn part of the domain, which contains nearly all of the traction.
        let (from, to) = Direction::Along.range();
        let step = (to - from) / (COLUMNS - 1) as f64 * point.hertz().half_width_m;
        let traction = (0..COLUMNS).map(|column| at(ROWS / 2, column)).sum::<f64>() * step / point.load;
        assert!((traction / solution.traction_coefficient() - 1.0).abs() < 0.02, "{traction}");
        // The shear rate integrates exactly to the sliding speed at every place.
        let rate = values(&solution, FilmShear::Rate);
        let middle = COLUMNS * 22 / 38;
        let film = solution.scalars.h_c * point.film_scale_m();
        let ends = 0.5 * (rate[middle] + rate[(ROWS - 1) * COLUMNS + middle]);
        let inner: f64 = (1..ROWS - 1).map(|row| rate[row * COLUMNS + middle]).sum();
        let slip = (ends + inner) / (ROWS - 1) as f64 * film;
        assert!((slip / (0.5 * point.speed_m_per_s) - 1.0).abs() < 5e-3, "{slip}");
    }

    #[test]
    fn colours_cover_the_range_and_a_film_at_rest_has_one() {
        let stress = [-2.0, 0.0, 6.0];
        let bounds = range(&stress, FilmShear::Stress);
        assert_eq!(stress.map(|v| share(v, FilmShear::Stress, bounds)), [0.0, 0.25, 1.0]);
        let rates = [0.0, -1e6, 1e2];
        let bounds = range(&rates, FilmShear::Rate);
        assert_eq!(rates.map(|v| share(v, FilmShear::Rate, bounds)), [0.0, 1.0, 0.0]);
        assert_eq!(range(&[0.0; 4], FilmShear::Stress), (0.0, 1.0));
    }
}
