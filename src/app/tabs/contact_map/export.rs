//! Export of the map: all nodes as a table, and the caption of its image.

use super::map_view::Shown;
use crate::app::answers::Answers;
use crate::app::answers::picture::Picture;
use crate::app::{caption, export as tables};

/// Returns all nodes of both halves, ordered by X, with dimensionless and SI values.
pub fn csv(picture: &Picture, means: String) -> String {
    let (hertz, scale) = (picture.key.point.hertz(), picture.key.point.film_scale_m());
    let solution = &picture.solution;
    let ny = solution.y.len();
    let halves = move || (0..ny).map(|j| (j, 1.0)).chain((0..ny.saturating_sub(1)).rev().map(|j| (j, -1.0)));
    let rows = (0..solution.x.len()).flat_map(move |i| {
        halves().map(move |(j, sign)| {
            let (x, y, k) = (solution.x[i], sign * solution.y[j], i * ny + j);
            let (p, h) = (solution.pressure[k], solution.film[k]);
            let (a, b) = (hertz.half_width_m, hertz.half_length_m);
            [x, y, p, h, x * a, y * b, p * hertz.pressure_pa, h * scale].map(Some).to_vec()
        })
    });
    let comments = [tables::describe(picture), means];
    tables::csv(&comments, &["X", "Y", "P", "H", "x_m", "y_m", "p_pa", "h_m"], rows)
}

/// Returns the part of the caption after the contact: nodes, method, and the light of an interferogram.
pub fn particulars(answers: &Answers, view: &super::map_view::MapView) -> Option<String> {
    let picture = answers.picture()?;
    let rig = &view.rig;
    let (degrees, solution) = (rig.phase.to_degrees(), &picture.solution);
    let optics = format!("n {}, phase {degrees:.0}°, V {}", rig.refractive_index, rig.visibility);
    let light = match (view.shown, view.three_colors) {
        (Shown::Interferogram, true) => format!("; light 630, 532, 460 nm, {optics}"),
        (Shown::Interferogram, false) => format!("; light {:.0} nm, {optics}", 1e9 * rig.wavelength_m),
        _ => String::new(),
    };
    let (nx, ny) = (solution.x.len(), solution.y.len());
    let means = caption::means(answers)?;
    Some(format!("{}; {nx}×{ny} nodes; {means}{light}", view.shown.name()))
}
