//! The names of the tabs.

use serde::{Deserialize, Serialize};

/// A tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tab {
    /// Pressure and film.
    Profiles,
    /// Film, pressure and interferogram of a point contact.
    ContactMap,
    /// The M–L chart.
    Regimes,
    /// Friction along one quantity.
    Traction,
    /// Singular values, modes, sampled rows.
    Basis,
    /// Residuals and errors.
    Accuracy,
    /// Making a reduced model.
    Training,
    /// The contact in time.
    Transient,
    /// The linearised model of it.
    Tpwl,
    /// The answer to the scene’s question.
    Results,
}

impl Tab {
    /// All tabs in their order.
    pub const ALL: [Self; 10] = [
        Self::Profiles,
        Self::ContactMap,
        Self::Regimes,
        Self::Traction,
        Self::Basis,
        Self::Accuracy,
        Self::Training,
        Self::Transient,
        Self::Tpwl,
        Self::Results,
    ];

    /// Title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Profiles => "Profiles",
            Self::ContactMap => "Contact map",
            Self::Regimes => "Regimes",
            Self::Traction => "Traction",
            Self::Basis => "Reduced basis",
            Self::Accuracy => "Accuracy",
            Self::Training => "Training",
            Self::Transient => "Transient",
            Self::Tpwl => "TPWL",
            Self::Results => "Results",
        }
    }

    /// Words for what it shows.
    pub fn subjects(self) -> &'static str {
        match self {
            Self::Profiles => "pressure film spike shear",
            Self::ContactMap => "interferogram fringes contours horseshoe side lobes",
            Self::Regimes => "chart film formulas Moes asymptotes",
            Self::Traction => "friction Stribeck slide-to-roll fluid viscosity",
            Self::Basis => "singular values modes truncation sampled rows",
            Self::Accuracy => "error failure map residuals bound",
            Self::Training => "snapshots model plan range",
            Self::Transient => "time load speed radius frames",
            Self::Tpwl => "linearised operating points weights",
            Self::Results => "study scene run expectations verdicts table",
        }
    }
}
