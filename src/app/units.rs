//! Units of plots and exports, and locking of axes.

use crate::solver::physics::contact::OperatingPoint;
use egui::{Context, Id};
use serde::{Deserialize, Serialize};

/// Units of plots and exports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Ratios to the quantities of the dry contact.
    #[default]
    Dimensionless,
    /// Millimetres, gigapascals, micrometres.
    Si,
}

/// Plot settings of a tab.
#[derive(Clone, Copy, Debug, Default)]
pub struct Manner {
    /// Units of the axes.
    pub units: Units,
    /// True if the axes are locked.
    pub locked: bool,
}

fn id() -> Id {
    Id::unique("manner of plots")
}

impl Manner {
    /// Sets the settings for the plots that are drawn next.
    pub fn set(self, ctx: &Context) {
        ctx.data_mut(|data| data.insert_temp(id(), self));
    }

    /// Returns the settings of the tab that is being drawn.
    pub fn of(ctx: &Context) -> Self {
        ctx.data(|data| data.get_temp(id())).unwrap_or_default()
    }
}

impl Units {
    /// Returns the units of the tab that is being drawn.
    pub fn of(ctx: &Context) -> Self {
        Manner::of(ctx).units
    }

    pub fn other(self) -> Self {
        match self {
            Self::Dimensionless => Self::Si,
            Self::Si => Self::Dimensionless,
        }
    }
}

/// Factors from dimensionless values of a contact to the units of plots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Factor of lengths along the contact, a \[mm\].
    pub length_mm: f64,
    /// Factor of lengths across the contact, b \[mm\].
    pub across_mm: f64,
    /// Factor of pressures \[GPa\].
    pub pressure_gpa: f64,
    /// Factor of film thicknesses \[µm\].
    pub film_um: f64,
}

impl Scales {
    /// Returns the factors of a contact.
    pub fn of(point: &OperatingPoint) -> Self {
        let hertz = point.hertz();
        Self {
            length_mm: 1e3 * hertz.half_width_m,
            across_mm: 1e3 * hertz.half_length_m,
            pressure_gpa: 1e-9 * hertz.pressure_pa,
            film_um: 1e6 * point.film_scale_m(),
        }
    }
}
