//! Thermal constants in postcard's encoding, which leaves nothing out as scenes do.

use crate::solver::physics::bodies::BodyHeat;
use crate::solver::physics::lubricant::{FreeVolumeHeat, Heat, OilHeat};
use serde::{Deserialize, Serialize};

/// What a film that warms itself needs to be computed.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct StoredHeat {
    /// T₀ \[K\].
    inlet_temperature: f64,
    /// Heat capacity, conductivity, density and both coefficients of the oil.
    oil: [f64; 5],
    /// What Tait's and Doolittle's laws need.
    free_volume: Option<[f64; 3]>,
    /// Conductivity, heat capacity and density of both bodies.
    bodies: [[f64; 3]; 2],
}

impl From<Heat> for StoredHeat {
    fn from(Heat { inlet_temperature, oil, bodies }: Heat) -> Self {
        let OilHeat { heat_capacity, conductivity, density, viscosity_temperature, density_temperature, free_volume } =
            oil;
        Self {
            inlet_temperature,
            oil: [heat_capacity, conductivity, density, viscosity_temperature, density_temperature],
            free_volume: free_volume.map(
                |FreeVolumeHeat { bulk_modulus_temperature, expansion, occupied_expansion }| {
                    [bulk_modulus_temperature, expansion, occupied_expansion]
                },
            ),
            bodies: bodies
                .map(|BodyHeat { conductivity, heat_capacity, density }| [conductivity, heat_capacity, density]),
        }
    }
}

impl From<StoredHeat> for Heat {
    fn from(StoredHeat { inlet_temperature, oil, free_volume, bodies }: StoredHeat) -> Self {
        let [heat_capacity, conductivity, density, viscosity_temperature, density_temperature] = oil;
        let free_volume = free_volume.map(|[bulk_modulus_temperature, expansion, occupied_expansion]| FreeVolumeHeat {
            bulk_modulus_temperature,
            expansion,
            occupied_expansion,
        });
        let body = |[conductivity, heat_capacity, density]: [f64; 3]| BodyHeat { conductivity, heat_capacity, density };
        Self {
            inlet_temperature,
            oil: OilHeat {
                heat_capacity,
                conductivity,
                density,
                viscosity_temperature,
                density_temperature,
                free_volume,
            },
            bodies: bodies.map(body),
        }
    }
}
