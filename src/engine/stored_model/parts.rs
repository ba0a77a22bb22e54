//! What a model may have in its file beside its windows, each part under a name of its own.

use super::calibrations::StoredCalibrations;
use super::former_domain::{FormerEyring, FormerHeat, FormerThermal};
use super::oils::{GridCosts, StoredOils, StoredSharedBasis};
use super::rupture::StoredRupture;
use super::shapes::{StoredShapes, stored_shapes};
use super::snapshots::StoredSnapshots;
use crate::engine::stored_heat::StoredHeat;
use crate::engine::stored_matrix::StoredMatrix;
use crate::solver::reduced::{ReducedModel, Scheme, Window};
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
    Space(String),
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
    /// The space, in JSON.
    pub space: Option<String>,
}

impl Parts {
    /// The parts of a model, in postcard's encoding behind a payload.
    pub fn write(model: &ReducedModel, calibrations: Option<StoredCalibrations>, payload: Vec<u8>) -> Option<Vec<u8>> {
        let usual = model.windows.iter().all(|window| window.scheme == Scheme::Galerkin);
        let scheme =
            |window: &Window| (window.scheme, window.residual_reconstruction.as_ref().map(StoredMatrix::exact));
        let schemes = (!usual).then(|| model.windows.iter().map(scheme).collect());
        let none = FormerHeat {
            srr: (0.0, 0.0),
            radius_m: (0.0, 0.0),
            modulus_pa: (0.0, 0.0),
            speed_m_per_s: (0.0, 0.0),
            fastest_sliding_m_per_s: 0.0,
        };
        let parts = [
            StoredRupture::of(model).map(Part::Rupture),
            schemes.map(Part::Schemes),
            stored_shapes(model).map(Part::Shapes),
            StoredOils::of(model).map(Part::Oils),
            StoredSharedBasis::of(model).map(Part::SharedBasis),
            model.domain.lubricant.heat.map(|heat| Part::Heat(heat.into(), none)),
            calibrations.map(Part::Calibrations),
            Some(Part::Snapshots(StoredSnapshots::of(model))),
            serde_json::to_string(&model.domain.space).ok().map(Part::Space),
        ];
        let parts: Vec<Part> = parts.into_iter().flatten().collect();
        postcard::to_extend(&parts, payload).ok()
    }

    /// The parts of a model of so many windows; `None` where they cannot be understood, or do not go together.
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
                Part::Space(part) => known.space.replace(part).is_none(),
            };
            if !once {
                return None;
            }
        }
        rest.is_empty().then_some(known)
    }
}
