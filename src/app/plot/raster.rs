//! Image of a field of a point contact, by a colour table or as the interferogram of a rig. The field is given for
//! Y ≤ 0, and the image shows both halves.

use crate::solver::physics::optics::{Interferometer, RGB_WAVELENGTHS_M};
use egui::{Color32, ColorImage};

/// Number of pixels per Hertzian radius of a circular contact.
const RESOLUTION: f64 = 100.0;
/// Minimum number of pixels per shorter semi-axis of an elliptical contact.
const FEWEST: f64 = 50.0;

/// Values at the pixels of the half Y ≤ 0, row by row from the outer edge to the axis.
pub struct Raster {
    width: usize,
    rows: usize,
    values: Vec<f32>,
}

/// Returns the index of the upper node and its weight for each of `count` equidistant pixels between the outer nodes.
fn places(nodes: &[f64], count: usize) -> Vec<(usize, f32)> {
    let (Some(&first), Some(&last)) = (nodes.first(), nodes.last()) else { return Vec::new() };
    let mut upper = 1;
    (0..count)
        .map(|k| {
            let at = first + (last - first) * (k as f64 + 0.5) / count as f64;
            while upper + 1 < nodes.len() && nodes[upper] < at {
                upper += 1;
            }
            (upper, ((at - nodes[upper - 1]) / (nodes[upper] - nodes[upper - 1])) as f32)
        })
        .collect()
}

impl Raster {
    /// Samples a node array bilinearly at square pixels and multiplies it by `scale`. X is in units of the semi-axis a
    /// and Y in units of b; `kappa` is b/a. Node (i, j) at (X_i, Y_j) has the index i·n_y + j.
    pub fn new((x, y): (&[f64], &[f64]), kappa: f64, field: &[f64], scale: f64) -> Self {
        // The number of pixels is about that of a circular contact, so that long ellipses do not fill the memory.
        let per_shorter = (RESOLUTION / kappa.max(kappa.recip()).sqrt()).max(FEWEST);
        let (per_a, per_b) =
            if kappa >= 1.0 { (per_shorter, per_shorter * kappa) } else { (per_shorter / kappa, per_shorter) };
        let pixels = |nodes: &[f64], per: f64| match nodes {
            [first, .., last] => ((last - first) * per).round().clamp(2.0, 4096.0) as usize,
            _ => 0,
        };
        let (width, rows) = (pixels(x, per_a), pixels(y, per_b));
        let (columns, ordinates) = (places(x, width), places(y, rows));
        let ny = y.len();
        let mut values = Vec::with_capacity(width * rows);
        for &(j, t) in &ordinates {
            values.extend(columns.iter().map(|&(i, s)| {
                let across = |i: usize| {
                    let (low, high) = (field[i * ny + j - 1] as f32, field[i * ny + j] as f32);
                    low + t * (high - low)
                };
                let (west, east) = (across(i - 1), across(i));
                (west + s * (east - west)) * scale as f32
            }));
        }
        Self { width, rows, values }
    }

    /// Returns the image by a colour table whose ends are the colours of the values `low` and `high`.
    pub fn colored(&self, table: &[Color32], (low, high): (f64, f64)) -> ColorImage {
        let last = table.len().saturating_sub(1) as f32;
        let (low, factor) = (low as f32, last / (high - low) as f32);
        self.mirrored(|k| table[((self.values[k] - low) * factor).clamp(0.0, last) as usize])
    }

    /// Returns the interferogram if the values are film thicknesses \[m\]: in grey at the wavelength of the rig, or in
    /// colour by three wavelengths. Fringes narrower than two pixels fade to their mean, as in a camera.
    pub fn interferogram(&self, rig: &Interferometer, three_colors: bool) -> ColorImage {
        const STEPS: usize = 1024;
        let table: Vec<f32> =
            (0..STEPS).map(|k| (rig.intensity_of_order(k as f64 / STEPS as f64) - 0.5) as f32).collect();
        let light = |wavelength: f64| {
            let per_metre = (1.0 / rig.fringe_spacing_m(wavelength)) as f32;
            let offset = (rig.phase / std::f64::consts::TAU) as f32;
            let table = &table;
            move |film: f32, change: f32| {
                let order = film * per_metre + offset;
                // Film thicknesses and orders are positive, so truncation rounds down.
                let step = ((order - (order as u32) as f32) * STEPS as f32) as usize;
                // Half an order between neighbouring pixels is the limit of resolution.
                let sharp = (1.0 - (2.0 * change * per_metre).powi(2)).max(0.0);
                (255.0 * (0.5 + sharp * table[step.min(STEPS - 1)])) as u8
            }
        };
        // Largest difference from a neighbouring pixel of the half.
        let change = |k: usize| {
            let value = self.values[k];
            let next = |other: usize| self.values.get(other).map_or(0.0, |v| (v - value).abs());
            let along = if (k + 1).is_multiple_of(self.width) { k - 1 } else { k + 1 };
            next(along).max(next(k + self.width))
        };
        if three_colors {
            let [red, green, blue] = RGB_WAVELENGTHS_M.map(light);
            self.mirrored(|k| {
                let (film, change) = (self.values[k], change(k));
                Color32::from_rgb(red(film, change), green(film, change), blue(film, change))
            })
        } else {
            let grey = light(rig.wavelength_m);
            self.mirrored(|k| Color32::from_gray(grey(self.values[k], change(k))))
        }
    }

    /// Returns the image of both halves; `color` returns the colour of a pixel of the given half.
    fn mirrored(&self, color: impl Fn(usize) -> Color32) -> ColorImage {
        let mut pixels: Vec<Color32> = (0..self.values.len()).map(color).collect();
        for row in (0..self.rows).rev() {
            pixels.extend_from_within(row * self.width..(row + 1) * self.width);
        }
        ColorImage::new([self.width, 2 * self.rows], pixels)
    }
}

/// Returns the colour of a film thickness \[m\] in an interferogram.
pub fn fringe(rig: &Interferometer, three_colors: bool, film: f64) -> Color32 {
    let light = |wavelength: f64| (255.0 * rig.intensity(film, wavelength)) as u8;
    if three_colors {
        let [red, green, blue] = RGB_WAVELENGTHS_M.map(light);
        Color32::from_rgb(red, green, blue)
    } else {
        Color32::from_gray(light(rig.wavelength_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::plot::color_map;
    use crate::solver::discrete::grid::PointGridSpec;
    use crate::solver::full::{PointSolver, Start};
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn a_picture_is_symmetric_and_shows_the_nodes_it_was_made_of() {
        let spec = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.4));
        let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 30.0, 5.0)).unwrap();
        let s = PointSolver::new(spec).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        let raster = Raster::new((&s.x, &s.y), 1.0, &s.pressure, 1.0);
        let top = s.scalars.p_max;
        let image = raster.colored(&color_map::table(false), (0.0, top));
        assert_eq!(image.size, [raster.width, 2 * raster.rows]);
        let rows: Vec<&[Color32]> = image.pixels.chunks_exact(raster.width).collect();
        assert!(rows.iter().eq(rows.iter().rev()), "both halves are alike");
        let at = |x: f64, y: f64| {
            let column = ((x + 3.0) / 4.8 * raster.width as f64) as usize;
            let row = ((1.4 - y) / 2.8 * (2 * raster.rows) as f64) as usize;
            image.pixels[row.min(2 * raster.rows - 1) * raster.width + column]
        };
        for (x, y) in [(0.0, 0.3), (-0.7, 0.55), (0.9, 0.11), (-2.0, 1.2)] {
            let wanted = color_map::viridis(s.at(x, y).unwrap().0 / top);
            let got = at(x, y);
            for (a, b) in [(got.r(), wanted.r()), (got.g(), wanted.g()), (got.b(), wanted.b())] {
                assert!(a.abs_diff(b) <= 12, "{x} {y}: {got:?} {wanted:?}");
            }
        }
    }

    #[test]
    fn wide_fringes_have_the_colours_of_the_film() {
        let rig = Interferometer::default();
        let values: Vec<f32> = (0..400).map(|k| k as f32 * 1e-9).collect();
        let raster = Raster { width: 400, rows: 1, values: values.clone() };
        for three_colors in [false, true] {
            let image = raster.interferogram(&rig, three_colors);
            for (pixel, film) in image.pixels[..400].iter().zip(&values) {
                let wanted = fringe(&rig, three_colors, f64::from(*film));
                assert!(pixel.r().abs_diff(wanted.r()) <= 3 && pixel.b().abs_diff(wanted.b()) <= 3, "{film}");
            }
        }
        let steep = Raster { width: 400, rows: 1, values: values.iter().map(|h| 200.0 * h).collect() };
        assert!(steep.interferogram(&rig, false).pixels.iter().all(|p| p.r() == 127), "narrow fringes fade");
    }
}
