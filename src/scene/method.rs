//! How a contact is solved, and by which reduced model.

use crate::solver::reduced::{ReducedOptions, Window};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How a contact is solved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub enum Method {
    /// The full system.
    #[default]
    Full,
    /// A reduced model.
    Reduced {
        /// Which one.
        #[serde(default)]
        model: ModelSource,
        /// Loss of information (2.92) at which its pressure modes are cut off; all of them where there is none.
        #[serde(default)]
        pressure_loss: Option<f64>,
        /// Loss of information (2.93) at which its deformation modes are cut off; the exact deformation where there is
        /// none.
        #[serde(default)]
        deformation_loss: Option<f64>,
    },
}

/// Where a reduced model comes from. Paths are relative to the scene's folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ModelSource {
    /// The one in the program.
    #[default]
    Embedded,
    /// A `.rom` file.
    File(PathBuf),
    /// Trained on the spot as another scene describes.
    Trained(PathBuf),
}

impl Method {
    /// The embedded reduced model.
    pub const EMBEDDED: Self = Self::reduced(ModelSource::Embedded);

    /// A reduced model with all its modes.
    pub const fn reduced(model: ModelSource) -> Self {
        Self::Reduced { model, pressure_loss: None, deformation_loss: None }
    }

    /// The word that stands for it in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced { .. } => "reduced",
        }
    }

    /// The reduced model, if it is one.
    pub fn model(&self) -> Option<&ModelSource> {
        match self {
            Self::Full => None,
            Self::Reduced { model, .. } => Some(model),
        }
    }

    /// The online settings in one of the model's windows.
    pub fn options(&self, window: &Window) -> ReducedOptions {
        let Self::Reduced { pressure_loss, deformation_loss, .. } = self else { return ReducedOptions::default() };
        ReducedOptions {
            pressure_modes: pressure_loss.map(|loss| window.pressure.basis().modes_for(loss)),
            deformation_modes: deformation_loss.map(|loss| window.deformation.modes_for(loss)),
            ..ReducedOptions::default()
        }
    }

    /// Whether it is a model whose modes are cut off.
    pub fn truncated(&self) -> bool {
        matches!(self, Self::Reduced { pressure_loss: Some(_), .. } | Self::Reduced { deformation_loss: Some(_), .. })
    }
}
