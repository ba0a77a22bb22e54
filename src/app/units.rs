//! Units of plots and exports, and locking of axes.

use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Context, Id};
use serde::{Deserialize, Serialize};

/// Units of plots and exports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Ratios to the quantities of the dry contact.
    #[default]
    Dimensionless,
    /// Units of the chosen system.
    Dimensional,
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
            Self::Dimensionless => Self::Dimensional,
            Self::Dimensional => Self::Dimensionless,
        }
    }
}

fn system_id() -> Id {
    Id::unique("system of units")
}

/// Sets the system of units for everything that is drawn next.
pub fn set_system(ctx: &Context, system: UnitSystem) {
    ctx.data_mut(|data| data.insert_temp(system_id(), system));
}

/// Returns the system of units of the window.
pub fn system(ctx: &Context) -> UnitSystem {
    ctx.data(|data| data.get_temp(system_id())).unwrap_or_default()
}

/// Unit of an axis, and the factor from the values of a plot to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    pub factor: f64,
    pub unit: &'static str,
}

impl Scale {
    /// Returns the scale of plotted values of which one is `si` in SI units.
    pub fn of(kind: QuantityKind, system: UnitSystem, si: f64) -> Self {
        let unit = kind.unit(system);
        Self { factor: si / unit.size, unit: unit.name }
    }
}

/// Factors from dimensionless values of a contact to the units of plots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Lengths along the contact, in units of a.
    pub along: Scale,
    /// Lengths across the contact, in units of b.
    pub across: Scale,
    /// Pressures.
    pub pressure: Scale,
    /// Film thicknesses.
    pub film: Scale,
}

impl Scales {
    /// Returns the factors of a contact.
    pub fn of(point: &OperatingPoint, system: UnitSystem) -> Self {
        let hertz = point.hertz();
        Self {
            along: Scale::of(QuantityKind::Length, system, hertz.half_width_m),
            across: Scale::of(QuantityKind::Length, system, hertz.half_length_m),
            pressure: Scale::of(QuantityKind::Pressure, system, hertz.pressure_pa),
            film: Scale::of(QuantityKind::FilmThickness, system, point.film_scale_m()),
        }
    }
}
