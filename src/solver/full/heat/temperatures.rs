//! The temperatures of a solved contact.

use super::Coupled;
use crate::solver::discrete::grid::{INLET, cubic};
use crate::solver::discrete::heat::{HeatBalance, March, MovingSource, POINTS, Profile, WarmFilm};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::discrete::space::LineSpace;
use crate::solver::full::solution::Problem;
use crate::solver::full::system::System;
use crate::solver::physics::lubricant::{LimitingStress, ScaledHeat};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Rises above the inlet's temperature at one place, or the largest of a film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rises {
    /// At mid-film \[K\].
    pub mid_film_k: f64,
    /// Of the surfaces of both bodies \[K\].
    pub surfaces_k: [f64; 2],
}

/// Temperature \[K\] above which lubricants decompose: 300 °C.
const ENDURED_K: f64 = 573.0;

/// Heat that is lost without a word, relative.
const LARGEST_RESIDUAL: f64 = 3e-3;

/// The temperatures of a contact with heat.
#[derive(Clone, Debug, PartialEq)]
pub struct Temperatures {
    /// Abscissae X, those of the nodes of the solution.
    pub x: Vec<f64>,
    /// T − T₀ there \[K\], from body 1 to body 2 at [Lobatto's points](crate::solver::discrete::heat::ACROSS).
    pub rise_k: Vec<Profile>,
    /// H there.
    pub thickness: Vec<f64>,
    /// τ̄_m, the stress at mid-film over η₀u_mR/a², at the nodes of the solution, as it is without a limit; positive where
    /// the film moves faster the farther it is from body 1.
    pub shear_stress: Vec<f64>,
    /// Shear stress at mid-film \[Pa\] at the nodes of the solution, positive where body 1 pulls; zero where the film is
    /// ruptured.
    pub mid_stress_pa: Vec<f64>,
    /// At X = 0.
    pub central: Rises,
    /// The largest under pressure.
    pub largest: Rises,
    /// Where heat comes from and goes to.
    pub balance: HeatBalance,
    /// Temperature at the inlet \[K\].
    pub inlet_k: f64,
    /// Abscissae of the stations of the march, and how surfaces warm there, for whoever goes on from here.
    pub(super) stations: Vec<f64>,
    pub(super) source: Arc<MovingSource>,
}

/// Shear stress at mid-film \[Pa\] of a film whose τ̄_m is given, positive where body 1 pulls, cut where the lubricant has a
/// limit; zero where no pressure is.
pub(in crate::solver) fn mid_stress_pa(problem: &Problem, heat: &ScaledHeat, stress: f64, pressure: f64) -> f64 {
    if pressure <= 0.0 {
        return 0.0;
    }
    let felt = -stress * heat.stress_scale_pa;
    let carried = |limit: LimitingStress| limit.carried(felt.abs(), pressure * problem.fluid.hertz_pressure_pa());
    let carried = problem.lubricant.limiting_stress.map_or(f64::INFINITY, carried);
    carried.min(felt.abs()).copysign(felt)
}

/// Node arrays of a contact with heat: X, P, H and τ̄_m.
pub(in crate::solver) struct NodeArrays<'a> {
    pub x: &'a [f64],
    pub pressure: &'a [f64],
    pub film: &'a [f64],
    pub stress: &'a [f64],
}

impl Rises {
    /// Those of a profile.
    pub(in crate::solver) fn of(rise_k: &Profile) -> Self {
        Self { mid_film_k: rise_k[POINTS / 2], surfaces_k: [rise_k[0], rise_k[POINTS - 1]] }
    }

    /// How far another rise at mid-film is from this one, relative to that; to a kelvin where that is less.
    pub fn difference(&self, other: &Self) -> f64 {
        (self.mid_film_k - other.mid_film_k).abs() / other.mid_film_k.abs().max(1.0)
    }

    fn or_larger(self, other: Self) -> Self {
        Self {
            mid_film_k: self.mid_film_k.max(other.mid_film_k),
            surfaces_k: [0, 1].map(|side| self.surfaces_k[side].max(other.surfaces_k[side])),
        }
    }
}

impl Temperatures {
    /// The film that has them at given nodes.
    pub(in crate::solver::full) fn film(&self, nodes: &[f64]) -> WarmFilm {
        let mut film = WarmFilm::default();
        film.spread(nodes, &self.x, |i| self.rise_k[i].map(|rise| rise / self.inlet_k));
        film
    }

    /// The rises at the nodes, in their order.
    pub fn rises(&self) -> impl Iterator<Item = Rises> + '_ {
        self.rise_k.iter().map(Rises::of)
    }

    /// A sentence where the film is hotter than oils endure.
    pub fn too_hot(&self) -> Option<String> {
        let hottest = self.inlet_k + self.rise_k.iter().flatten().fold(0.0f64, |hottest, rise| hottest.max(*rise));
        (hottest > ENDURED_K).then(|| {
            format!(
                "the film reaches {hottest:.0} K: above {ENDURED_K} K oils decompose, and no law of viscosity was \
                 measured"
            )
        })
    }

    /// That sentence, and one where heat is lost between the stations.
    pub fn warnings(&self) -> impl Iterator<Item = String> {
        let residual = self.balance.residual().abs();
        let lossy = (residual > LARGEST_RESIDUAL).then(|| {
            format!(
                "{:.1} % of the heat that is made goes nowhere: the grid is too coarse for this film's temperatures",
                100.0 * residual
            )
        });
        self.too_hot().into_iter().chain(lossy)
    }

    /// Those of a state.
    pub(super) fn of(coupled: &Coupled, system: &System<LineSpace>, problem: &Problem, heat: &ScaledHeat) -> Self {
        let Coupled { march, states, .. } = coupled;
        let stress = system.warm.as_ref().map_or(&[][..], |warm| &warm.stress);
        let fields = NodeArrays { x: &system.space.grid.x, pressure: &system.pressure, film: &system.film, stress };
        Self::marched(march, states, &fields, (problem, heat))
    }

    /// Those of a march through given states at its stations, at the nodes of a contact.
    pub(in crate::solver) fn marched(
        march: &March,
        states: &[NodeState],
        fields: &NodeArrays<'_>,
        (problem, heat): (&Problem, &ScaledHeat),
    ) -> Self {
        let inlet_k = heat.heat.inlet_temperature;
        let x = fields.x[INLET..].to_vec();
        let at = |x: f64| -> Profile {
            let (first, weights) = cubic(&march.x, x);
            let near = &march.stations[first..];
            std::array::from_fn(|j| inlet_k * weights.iter().zip(near).map(|(w, own)| w * own.theta[j]).sum::<f64>())
        };
        let rise_k: Vec<Profile> = x.iter().map(|x| at(*x)).collect();
        let loaded = march.stations.iter().zip(states).filter(|(_, state)| state.pressure > 0.0);
        let largest = loaded.fold(Rises::default(), |largest, (own, _)| {
            largest.or_larger(Rises::of(&own.theta.map(|theta| inlet_k * theta)))
        });
        let mid_stress_pa = fields
            .stress
            .iter()
            .zip(fields.pressure)
            .map(|(stress, &pressure)| mid_stress_pa(problem, heat, *stress, pressure));
        Self {
            x,
            thickness: fields.film[INLET..].to_vec(),
            mid_stress_pa: mid_stress_pa.collect(),
            shear_stress: fields.stress.to_vec(),
            central: Rises::of(&at(0.0)),
            largest,
            balance: problem.course(states).map_or_else(HeatBalance::default, |course| march.balance(&course)),
            inlet_k,
            stations: march.x.clone(),
            source: Arc::clone(&march.source),
            rise_k,
        }
    }
}
