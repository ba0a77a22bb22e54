//! Rough surfaces of a contact specification.

use super::fields::{ContactSpec, Field};
use super::refusal::{Refusal, refuse};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::{Roughness, SurfaceConstant};

/// Fields that have no effect on smooth surfaces.
const OF_ROUGHNESS: [Field; 5] =
    [Field::Asperities, Field::Peklenik, Field::ShearFlow, Field::BoundaryFriction, Field::WearRate];

impl ContactSpec {
    /// Returns the roughness; `None` if it is not stated.
    pub(super) fn stated_roughness(&self) -> Result<Option<Roughness>, Refusal> {
        let Some(sigma) = self.roughness else {
            let without = |field: Field| format!("<{}> has no effect without <roughness>; add it", field.facts().name);
            let useless = OF_ROUGHNESS.into_iter().find(|field| self.states(*field));
            return useless.map_or(Ok(None), |field| refuse(field, without(field)));
        };
        let usual = Roughness::new(sigma);
        let roughness = Roughness {
            sigma,
            asperities: self.asperities.unwrap_or(usual.asperities),
            peklenik: self.peklenik.unwrap_or(usual.peklenik),
            shear_flow: self.shear_flow.unwrap_or(usual.shear_flow),
            boundary_friction: self.boundary_friction.unwrap_or(usual.boundary_friction),
            wear_rate: self.wear_rate.unwrap_or(usual.wear_rate),
        };
        roughness.check().map_err(|error| {
            let field = match error.constant {
                SurfaceConstant::Roughness => Field::Roughness,
                SurfaceConstant::Asperities(_) => Field::Asperities,
                SurfaceConstant::Peklenik => Field::Peklenik,
                SurfaceConstant::ShearFlow => Field::ShearFlow,
                SurfaceConstant::BoundaryFriction => Field::BoundaryFriction,
                SurfaceConstant::WearRate => Field::WearRate,
            };
            Refusal::new(field, format!("<{}>: {error}", field.facts().name))
        })?;
        Ok(Some(roughness))
    }

    /// Refuses laws that are not supported together with rough surfaces.
    pub(super) fn check_with_roughness(&self, lubricant: &Lubricant) -> Result<(), Refusal> {
        if self.supply_film.is_some() && lubricant.is_rough() {
            return refuse(
                Field::SupplyFilm,
                "rough surfaces need a flooded inlet; leave out <supply-film> or <roughness>",
            );
        }
        if lubricant.lacks_complementarity() {
            return refuse(
                Field::Cavitation,
                "rough surfaces need <cavitation=complementarity>; leave <cavitation> out",
            );
        }
        Ok(())
    }
}
