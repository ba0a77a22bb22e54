//! What followed a model in files up to version 13: parts without names, each told by what came before it.

use super::oils::{GridCosts, StoredAnchor, StoredOils, StoredSharedBasis};
use super::parts::Parts;
use super::rupture::StoredRupture;
use super::shapes::StoredShapes;
use crate::engine::stored_heat::StoredHeat;
use crate::engine::stored_matrix::{StoredBasis, StoredMatrix};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{CIRCLES, EyringDomain, HeatDomain, OilDomain, Scheme};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// How films rupture, and the scheme of every window with what GNAT makes of the residual.
#[derive(Deserialize)]
struct First {
    cavitation: Cavitation,
    fronts: Vec<Vec<Vec<usize>>>,
    schemes: Vec<(Scheme, Option<StoredMatrix>)>,
}

/// What followed the anchors of many oils.
#[derive(Deserialize)]
struct InCommon {
    thinnest_film: f64,
    pressure: Option<(StoredBasis, Vec<StoredMatrix>)>,
    grid_costs: GridCosts,
}

#[derive(Deserialize)]
struct Heated {
    heat: StoredHeat,
    srr: (f64, f64),
    /// The smallest R and E′.
    radius_m: f64,
    modulus_pa: f64,
}

/// What followed that in a model of many oils.
#[derive(Deserialize)]
struct HeatedOils {
    largest_radius_m: f64,
    largest_modulus_pa: f64,
    speed_m_per_s: (f64, f64),
    fastest_sliding_m_per_s: f64,
}

/// What a model of oils that thin by Eyring's law had in the place of heat.
#[derive(Deserialize)]
struct Eyring {
    /// T₀ \[K\] of a model with heat, which would begin with it: none.
    no_inlet_temperature: f64,
    srr: (f64, f64),
    modulus_pa: (f64, f64),
    limit_slope: (f64, f64),
    gradient_stress_pa: f64,
}

/// What is left of a payload.
struct Rest<'a>(&'a [u8]);

impl Rest<'_> {
    fn has_ended(&self) -> bool {
        self.0.is_empty()
    }

    fn take<T: DeserializeOwned>(&mut self) -> Option<T> {
        let (value, rest) = postcard::take_from_bytes(self.0).ok()?;
        self.0 = rest;
        Some(value)
    }
}

impl Heated {
    /// With what followed it; without that, of bodies of one radius at any speed.
    fn with(self, further: Option<HeatedOils>) -> (StoredHeat, HeatDomain) {
        let Self { heat, srr, radius_m, modulus_pa } = self;
        let any = HeatedOils {
            largest_radius_m: radius_m,
            largest_modulus_pa: modulus_pa,
            speed_m_per_s: (0.0, f64::INFINITY),
            fastest_sliding_m_per_s: f64::INFINITY,
        };
        let HeatedOils { largest_radius_m, largest_modulus_pa, speed_m_per_s, fastest_sliding_m_per_s } =
            further.unwrap_or(any);
        let (radius_m, modulus_pa) = ((radius_m, largest_radius_m), (modulus_pa, largest_modulus_pa));
        (heat, HeatDomain { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s, thermal: None })
    }
}

impl Eyring {
    fn domain(self) -> Option<EyringDomain> {
        let Self { no_inlet_temperature, srr, modulus_pa, limit_slope, gradient_stress_pa } = self;
        (no_inlet_temperature == 0.0).then_some(EyringDomain { srr, modulus_pa, limit_slope, gradient_stress_pa })
    }
}

/// What follows the model in a payload; `None` where it cannot be understood.
pub(super) fn read(rest: &[u8], windows: usize) -> Option<Parts> {
    let (mut rest, mut parts) = (Rest(rest), Parts::default());
    if rest.has_ended() {
        return Some(parts);
    }
    let First { cavitation, fronts, schemes } = rest.take()?;
    if schemes.len() != windows {
        return None;
    }
    (parts.rupture, parts.schemes) = (Some(StoredRupture { cavitation, fronts }), Some(schemes));
    if rest.has_ended() {
        return Some(parts);
    }
    let shapes: StoredShapes = rest.take()?;
    if rest.has_ended() {
        parts.shapes = Some(shapes);
        return Some(parts);
    }
    // The word for no ellipses.
    if !(shapes.windows.is_empty() && shapes.radius_ratio == CIRCLES) {
        return None;
    }
    let (oils, anchors): (OilDomain, Vec<StoredAnchor>) = rest.take()?;
    if anchors.is_empty() {
        // That for no oils.
        parts.heat = Some(rest.take::<Heated>()?.with(None));
        return rest.has_ended().then_some(parts);
    }
    let mut thinnest_film = 0.0;
    if !rest.has_ended() {
        let in_common: InCommon = rest.take()?;
        thinnest_film = in_common.thinnest_film;
        parts.shared = in_common.pressure.map(|(basis, factors)| StoredSharedBasis { basis, factors });
        parts.grid_costs = Some(in_common.grid_costs).filter(|costs| !costs.is_empty());
    }
    parts.oils = Some(StoredOils { oils, thinnest_film, windows: anchors });
    if !rest.has_ended() {
        let before = rest.0;
        parts.eyring = rest.take::<Eyring>().and_then(Eyring::domain);
        if parts.eyring.is_none() {
            rest.0 = before;
            let heated: Heated = rest.take()?;
            parts.heat = Some(heated.with(Some(rest.take()?)));
        }
    }
    rest.has_ended().then_some(parts)
}
