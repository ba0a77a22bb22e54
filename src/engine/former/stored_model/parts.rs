//! What a model may have in its file beside its windows, each part under a name of its own.

use super::calibrations::StoredCalibrations;
use super::oils::{GridCosts, StoredOils, StoredSharedBasis};
use super::rupture::StoredRupture;
use super::shapes::StoredShapes;
use super::snapshots::StoredSnapshots;
use crate::engine::former::domain::{FormerEyring, FormerHeat, FormerThermal};
use crate::engine::former::stored_heat::StoredHeat;
use crate::engine::former::stored_matrix::StoredMatrix;
use crate::solver::reduced::Scheme;
use serde::{Deserialize, Serialize};

/// Of every window its scheme, and what GNAT makes of the residual.
pub(super) type Schemes = Vec<(Scheme, Option<StoredMatrix>)>;

/// One part. New ones go to the end, so that older files stay readable.
#[derive(Serialize, Deserialize)]
enum Part {
    Rupture(StoredRupture),
    Schemes(Schemes),
    Shapes(StoredShapes),
    Oils(StoredOils),
    SharedBasis(StoredSharedBasis),
    GridCosts(GridCosts),
    Heat(StoredHeat, FormerHeat),
    Eyring(FormerEyring),
    Calibrations(StoredCalibrations),
    Snapshots(StoredSnapshots),
    Thermal(FormerThermal),
}

/// The parts that a model has.
#[derive(Default)]
pub(super) struct Parts {
    /// None where a penalty holds the pressures.
    pub rupture: Option<StoredRupture>,
    /// None where every window has Galerkin's.
    pub schemes: Option<Schemes>,
    /// Of ellipses.
    pub shapes: Option<StoredShapes>,
    /// Of many oils.
    pub oils: Option<StoredOils>,
    /// Of many oils whose windows share a basis.
    pub shared: Option<StoredSharedBasis>,
    /// Of many oils where they were measured; in newer files they are with the snapshots.
    pub grid_costs: Option<GridCosts>,
    /// Of contacts with heat.
    pub heat: Option<(StoredHeat, FormerHeat)>,
    /// Of many oils that thin by Eyring's law.
    pub eyring: Option<FormerEyring>,
    /// None where nothing was measured, or windows keep it themselves.
    pub calibrations: Option<StoredCalibrations>,
    /// Of older files none, whose windows keep them.
    pub snapshots: Option<StoredSnapshots>,
    /// Of contacts with heat whose thermal constants are many.
    pub thermal: Option<FormerThermal>,
}

impl Parts {
    /// The parts of a model of so many windows; `None` where they cannot be understood, or do not go together. Files that
    /// are `older` than these names have them without.
    pub fn read(rest: &[u8], windows: usize) -> Option<Self> {
        let parts = Self::named(rest)?;
        let schemes = parts.schemes.as_ref().is_none_or(|schemes| schemes.len() == windows);
        let of_oils = parts.shared.is_some() || parts.grid_costs.is_some() || parts.eyring.is_some();
        // Ellipses with heat are those of many oils, and none thins under shear.
        let beside_shapes = parts.eyring.is_none() && (parts.heat.is_none() || parts.oils.is_some());
        let together = (parts.shapes.is_none() || beside_shapes)
            && (parts.oils.is_some() || !of_oils)
            && (parts.heat.is_some() || parts.thermal.is_none());
        (schemes && together).then_some(parts)
    }

    fn named(rest: &[u8]) -> Option<Self> {
        let (parts, rest) = postcard::take_from_bytes::<Vec<Part>>(rest).ok()?;
        let mut known = Self::default();
        for part in parts {
            let once = match part {
                Part::Rupture(part) => known.rupture.replace(part).is_none(),
                Part::Schemes(part) => known.schemes.replace(part).is_none(),
                Part::Shapes(part) => known.shapes.replace(part).is_none(),
                Part::Oils(part) => known.oils.replace(part).is_none(),
                Part::SharedBasis(part) => known.shared.replace(part).is_none(),
                Part::GridCosts(part) => known.grid_costs.replace(part).is_none(),
                Part::Heat(heat, domain) => known.heat.replace((heat, domain)).is_none(),
                Part::Eyring(part) => known.eyring.replace(part).is_none(),
                Part::Calibrations(part) => known.calibrations.replace(part).is_none(),
                Part::Snapshots(part) => known.snapshots.replace(part).is_none(),
                Part::Thermal(part) => known.thermal.replace(part).is_none(),
            };
            if !once {
                return None;
            }
        }
        rest.is_empty().then_some(known)
    }
}
