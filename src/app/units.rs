//! In which units plots and exports speak, and whether their axes stand still.

use crate::solver::physics::contact::OperatingPoint;
use egui::{Context, Id};
use serde::{Deserialize, Serialize};

/// The units of plots and of what is exported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Ratios to the dry contact's.
    #[default]
    Dimensionless,
    /// Millimetres, gigapascals, micrometres.
    Si,
}

/// How the plots of a tab are drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Manner {
    /// The units of their axes.
    pub units: Units,
    /// Whether their axes stand still.
    pub locked: bool,
}

fn id() -> Id {
    Id::unique("manner of plots")
}

impl Manner {
    /// That of the plots that are drawn next.
    pub fn set(self, ctx: &Context) {
        ctx.data_mut(|data| data.insert_temp(id(), self));
    }

    /// That of the tab that is drawn now.
    pub fn of(ctx: &Context) -> Self {
        ctx.data(|data| data.get_temp(id())).unwrap_or_default()
    }
}

impl Units {
    /// Those of the tab that is drawn now.
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

/// What dimensionless values of a contact are in the units of plots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Of lengths along the contact, a \[mm\].
    pub length_mm: f64,
    /// Of lengths across it, b \[mm\].
    pub across_mm: f64,
    /// Of pressures \[GPa\].
    pub pressure_gpa: f64,
    /// Of films \[µm\].
    pub film_um: f64,
}

impl Scales {
    /// Those of a contact.
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
