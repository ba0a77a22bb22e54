//! Results of a stress field below the surface: its maxima, and the field as a table.

use super::table::Table;
use crate::solver::discrete::half_space::StressMeasure;
use crate::solver::full::{StressMaximum, SubsurfaceStress};
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// Every how many abscissae the table contains.
const EVERY: usize = 4;

/// Maxima of the stress below the surface of body 1, with their positions from the surface down and along X.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subsurface {
    /// Poisson's ratio of body 1.
    pub poisson: f64,
    /// Maximum von Mises stress \[Pa\].
    pub von_mises_max_pa: f64,
    /// Its depth \[m\].
    pub von_mises_depth_m: f64,
    /// Its abscissa \[m\].
    pub von_mises_x_m: f64,
    /// Maximum shear stress \[Pa\], half the difference of the principal stresses.
    pub shear_max_pa: f64,
    /// Its depth \[m\].
    pub shear_depth_m: f64,
    /// Its abscissa \[m\].
    pub shear_x_m: f64,
    /// Maximum magnitude of the orthogonal shear stress τ_xz \[Pa\].
    pub orthogonal_shear_max_pa: f64,
    /// Its depth \[m\].
    pub orthogonal_shear_depth_m: f64,
    /// Its abscissa \[m\].
    pub orthogonal_shear_x_m: f64,
}

impl Subsurface {
    /// Returns the maxima of a field below this contact.
    pub fn of(field: &SubsurfaceStress, point: &OperatingPoint) -> Self {
        let a = point.hertz().half_width_m;
        let at = |measure| {
            let StressMaximum { stress_pa, x, z } = field.maximum(measure);
            [stress_pa, a * z, a * x]
        };
        let [von_mises_max_pa, von_mises_depth_m, von_mises_x_m] = at(StressMeasure::VonMises);
        let [shear_max_pa, shear_depth_m, shear_x_m] = at(StressMeasure::MaximumShear);
        let [orthogonal_shear_max_pa, orthogonal_shear_depth_m, orthogonal_shear_x_m] =
            at(StressMeasure::OrthogonalShear);
        Self {
            poisson: field.poisson,
            von_mises_max_pa,
            von_mises_depth_m,
            von_mises_x_m,
            shear_max_pa,
            shear_depth_m,
            shear_x_m,
            orthogonal_shear_max_pa,
            orthogonal_shear_depth_m,
            orthogonal_shear_x_m,
        }
    }
}

/// Returns a stress field as a table: X, Z, the same in m, the stresses and their measures in Pa. It contains all
/// depths and every fourth abscissa.
pub fn stress_table(name: impl Into<String>, field: &SubsurfaceStress, point: &OperatingPoint) -> Table {
    let columns = [
        "X",
        "Z",
        "x_m",
        "z_m",
        "sigma_x_pa",
        "sigma_y_pa",
        "sigma_z_pa",
        "tau_xz_pa",
        "von_mises_pa",
        "maximum_shear_pa",
    ];
    let mut table = Table::new(name, &columns);
    let a = point.hertz().half_width_m;
    for (row, z) in field.z.iter().enumerate() {
        for (column, x) in field.x.iter().enumerate().step_by(EVERY) {
            let stress = field.at(column, row);
            let [von_mises, shear] = [stress.von_mises(), stress.maximum_shear()];
            table.rows.push(vec![*x, *z, a * x, a * z, stress.x, stress.y, stress.z, stress.xz, von_mises, shear]);
        }
    }
    table
}
