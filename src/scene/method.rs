//! Solution method of a contact: the full solver or a reduced model.

use crate::solver::reduced::{ReducedOptions, Window};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Solution method of a contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub enum Method {
    /// Full solver.
    #[default]
    Full,
    /// Reduced model.
    Reduced {
        /// Source of the model.
        #[serde(default)]
        model: ModelSource,
        /// Loss of information (2.92) at which the pressure modes are truncated; all modes if absent.
        #[serde(default)]
        pressure_loss: Option<f64>,
        /// Loss of information (2.93) at which the deformation modes are truncated; exact deformation if absent.
        #[serde(default)]
        deformation_loss: Option<f64>,
    },
}

/// Source of a reduced model. Paths are relative to the scene's folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ModelSource {
    /// The model embedded in the program.
    #[default]
    Embedded,
    /// A `.rom` file.
    File(PathBuf),
    /// Trained when needed, as another scene describes.
    Trained(PathBuf),
}

impl Method {
    /// The embedded reduced model.
    pub const EMBEDDED: Self = Self::reduced(ModelSource::Embedded);

    /// Returns a reduced model with all its modes.
    pub const fn reduced(model: ModelSource) -> Self {
        Self::Reduced { model, pressure_loss: None, deformation_loss: None }
    }

    /// Returns the word used in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced { .. } => "reduced",
        }
    }

    /// Returns the source of the reduced model, if the method uses one.
    pub fn model(&self) -> Option<&ModelSource> {
        match self {
            Self::Full => None,
            Self::Reduced { model, .. } => Some(model),
        }
    }

    /// Returns the settings of the online solver for one of the model's local models.
    pub fn options(&self, window: &Window) -> ReducedOptions {
        let Self::Reduced { pressure_loss, deformation_loss, .. } = self else { return ReducedOptions::default() };
        ReducedOptions {
            pressure_modes: pressure_loss.map(|loss| window.pressure.basis().modes_for(loss)),
            deformation_modes: deformation_loss.map(|loss| window.deformation.modes_for(loss)),
            ..ReducedOptions::default()
        }
    }

    /// Returns true for a reduced model with truncated modes.
    pub fn truncated(&self) -> bool {
        matches!(self, Self::Reduced { pressure_loss: Some(_), .. } | Self::Reduced { deformation_loss: Some(_), .. })
    }
}
