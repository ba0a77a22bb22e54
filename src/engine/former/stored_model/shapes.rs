//! What a model of ellipses has in a file beside what every model has.

use crate::solver::discrete::grid::ContactGrid;
use crate::solver::physics::contact::Ellipse;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{ReducedModel, Shapes};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The ellipses that a model knows.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredShapes {
    /// R_y/R of the model.
    pub radius_ratio: (f64, f64),
    /// R_y/R of every window, and R_y \[m\] of each of its snapshots.
    pub windows: Vec<((f64, f64), Vec<f64>)>,
}

/// Gives the windows of a model their shapes; `None` where these do not fit them.
pub(super) fn shape(model: &mut ReducedModel, StoredShapes { radius_ratio, windows }: StoredShapes) -> Option<()> {
    let sound =
        |(low, high): (f64, f64)| Ellipse::of_ratio(low).is_ok() && Ellipse::of_ratio(high).is_ok() && low < high;
    if windows.len() != model.windows.len() || !sound(radius_ratio) || model.domain.thins() {
        return None;
    }
    let windows: Vec<_> = model.windows.iter_mut().zip(windows).collect();
    windows.into_par_iter().try_for_each(|(window, (ratios, radii))| {
        let ContactGrid::Point(grid) = &window.grid else { return None };
        if !sound(ratios) || radii.len() != window.snapshots.len() || window.cavitation != Cavitation::Penalty {
            return None;
        }
        window.shapes = Some(Shapes::new(grid, &window.pressure.basis().modes, ratios).ok()?);
        for (snapshot, radius_y) in window.snapshots.iter_mut().zip(radii) {
            snapshot.point.radius_y_m = Some(radius_y);
            snapshot.point.check().ok()?;
        }
        Some(())
    })
}
