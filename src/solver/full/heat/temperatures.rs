//! Temperatures of a solved thermal contact.

use super::spike::spike;
use crate::solver::discrete::heat::{HeatBalance, Lines, MovingSource, POINTS, Profile, Spread, WarmFilm};
use crate::solver::full::problem::Problem;
use crate::solver::physics::lubricant::{LimitingStress, ScaledHeat};
use crate::solver::warning::{ENDURED_K, Warning};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Temperature rises above the inlet temperature at one position, or the maxima over a film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rises {
    /// Rise at mid-film \[K\].
    pub mid_film_k: f64,
    /// Rises of the surfaces of both bodies \[K\].
    pub surfaces_k: [f64; 2],
}

/// Relative heat loss above which a warning is given: in a line contact, and in a point contact, whose cells are
/// larger.
const LARGEST_RESIDUAL: [f64; 2] = [3e-3, 1e-2];

/// Temperatures of a thermal contact. Arrays are ordered like those of the solution: over X and, fastest, over Y.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Temperatures {
    /// Abscissae X, those of the nodes of the solution.
    pub x: Vec<f64>,
    /// Ordinates in units of a, the last of them on the axis; only 0 in a line contact.
    pub y: Vec<f64>,
    /// Rises T − T₀ at these nodes \[K\], from body 1 to body 2 at [Lobatto's
    /// points](crate::solver::discrete::heat::ACROSS).
    pub rise_k: Vec<Profile>,
    /// Film thickness H at these nodes.
    pub thickness: Vec<f64>,
    /// τ̄_m, mid-film shear stress divided by η₀u_mR/a², at the nodes of the solution, without a limit. Positive if
    /// body 2 is faster.
    pub shear_stress: Vec<f64>,
    /// Mid-film shear stress \[Pa\], limited by the limiting stress if there is one; zero without pressure.
    pub mid_stress_pa: Vec<f64>,
    /// Rises at X = 0.
    pub central: Rises,
    /// Maximum rises in the pressurised film.
    pub largest: Rises,
    /// Maximum rises in the pressurised film outside the pressure spike.
    pub outside_spike: Rises,
    /// Maximum rises in the pressure spike, a needle that is much narrower than the contact. `None` without a spike.
    pub in_spike: Option<Rises>,
    /// Heat sources and sinks.
    pub balance: HeatBalance,
    /// Temperature at the inlet \[K\].
    pub inlet_k: f64,
    /// Abscissae of the stations of the march, and the surface-heating operator there, for a solve that starts from
    /// here.
    #[serde(skip)]
    pub(super) stations: Vec<f64>,
    #[serde(skip)]
    pub(super) source: Arc<MovingSource>,
}

/// Returns the mid-film shear stress \[Pa\] for a given τ̄_m, limited by the limiting stress if there is one; zero
/// without pressure.
pub(in crate::solver) fn mid_stress_pa(problem: &Problem, heat: &ScaledHeat, stress: f64, pressure: f64) -> f64 {
    if pressure <= 0.0 {
        return 0.0;
    }
    let felt = stress * heat.stress_scale_pa;
    let carried = |limit: LimitingStress| limit.carried(felt.abs(), pressure * problem.fluid.hertz_pressure_pa());
    let carried = problem.lubricant.limiting_stress.map_or(f64::INFINITY, carried);
    carried.min(felt.abs()).copysign(felt)
}

/// Node arrays of a thermal contact: X, Y in units of a, P, H and τ̄_m.
pub(in crate::solver) struct NodeArrays<'a> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    /// First column of nodes with a film.
    pub first: usize,
    pub pressure: &'a [f64],
    pub film: &'a [f64],
    pub stress: &'a [f64],
}

impl Rises {
    /// Returns the rises of a profile.
    pub fn of(rise_k: &Profile) -> Self {
        Self { mid_film_k: rise_k[POINTS / 2], surfaces_k: [rise_k[0], rise_k[POINTS - 1]] }
    }

    /// Returns the rises at X = 0 (and Y = 0) of marched lines.
    pub(in crate::solver) fn central(lines: &Lines, inlet_k: f64) -> Self {
        let centre = Spread::new(lines.x(), &lines.y, std::iter::once((0.0, 0.0)));
        let rise_k = centre.profiles(lines).next().map(|theta| theta.map(|theta| inlet_k * theta));
        rise_k.as_ref().map(Self::of).unwrap_or_default()
    }

    /// Returns the difference of the mid-film rises, relative to the other one, or to 1 K if that is smaller.
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
    /// Returns the thermal film with these temperatures at given nodes.
    pub(in crate::solver::full) fn film(&self, nodes: &[f64]) -> WarmFilm {
        let mut film = WarmFilm::default();
        let lines = self.y.len();
        let theta = |line: usize, i: usize| self.rise_k[i * lines + line].map(|rise| rise / self.inlet_k);
        film.spread_lines(nodes, &self.x, lines, theta);
        film
    }

    /// Returns T − T₀ along the line nearest to an ordinate in units of a.
    pub(super) fn line_at(&self, y: f64) -> impl Iterator<Item = Profile> + '_ {
        let lines = self.y.len();
        let apart = |line: &usize| (self.y[*line] - y).abs();
        let nearest = (0..lines).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0);
        self.rise_k.iter().skip(nearest).step_by(lines).copied()
    }

    /// Returns the rises along the axis Y = 0, in the order of `x`.
    pub fn along_axis(&self) -> impl Iterator<Item = &Profile> {
        let lines = self.y.len();
        self.rise_k.iter().skip(lines - 1).step_by(lines)
    }

    /// Returns H along the axis Y = 0, in the order of `x`.
    pub fn film_along_axis(&self) -> impl Iterator<Item = f64> + '_ {
        let lines = self.y.len();
        self.thickness.iter().skip(lines - 1).step_by(lines).copied()
    }

    /// Returns the rises at the nodes, in their order.
    pub fn rises(&self) -> impl Iterator<Item = Rises> + '_ {
        self.rise_k.iter().map(Rises::of)
    }

    /// Returns a warning if the film is hotter than lubricants endure.
    pub fn too_hot(&self) -> Option<Warning> {
        let hottest = self.inlet_k + self.rise_k.iter().flatten().fold(0.0f64, |hottest, rise| hottest.max(*rise));
        (hottest > ENDURED_K).then_some(Warning::TooHot { temperature_k: hottest })
    }

    /// Returns a warning if too much heat is lost between the stations.
    pub fn heat_lost(&self) -> Option<Warning> {
        let share = self.balance.residual().abs();
        let most = LARGEST_RESIDUAL[usize::from(self.y.len() > 1)];
        (share > most).then_some(Warning::HeatLost { share })
    }

    /// Creates the temperatures from lines marched through given states at their stations. `theta` holds the
    /// dimensionless rises θ at the nodes of the contact.
    pub(in crate::solver) fn marched(
        lines: &Lines,
        theta: &[Profile],
        fields: &NodeArrays<'_>,
        (problem, heat): (&Problem, &ScaledHeat),
    ) -> Self {
        let inlet_k = heat.heat.inlet_temperature;
        let x = fields.x[fields.first..].to_vec();
        let kelvin = |theta: Profile| theta.map(|theta| inlet_k * theta);
        let (mut outside_spike, mut in_spike) = (Rises::default(), None::<Rises>);
        for line in &lines.lines {
            let pressure: Vec<f64> = line.states.iter().map(|state| state.pressure).collect();
            let needle = spike(lines.x(), &pressure).unwrap_or_default();
            let loaded = line.march.stations.iter().zip(&pressure).enumerate().filter(|(_, (_, p))| **p > 0.0);
            for (i, (station, _)) in loaded {
                let rises = Rises::of(&kelvin(station.theta));
                if needle.contains(&i) {
                    in_spike = Some(in_spike.unwrap_or_default().or_larger(rises));
                } else {
                    outside_spike = outside_spike.or_larger(rises);
                }
            }
        }
        let largest = outside_spike.or_larger(in_spike.unwrap_or_default());
        let balance = problem.course(&[]).map(|course| lines.balance(&course)).unwrap_or_default();
        let mid_stress_pa = fields
            .stress
            .iter()
            .zip(fields.pressure)
            .map(|(stress, &pressure)| mid_stress_pa(problem, heat, *stress, pressure));
        Self {
            x,
            y: fields.y.to_vec(),
            thickness: fields.film[fields.first * fields.y.len()..].to_vec(),
            mid_stress_pa: mid_stress_pa.collect(),
            shear_stress: fields.stress.to_vec(),
            central: Rises::central(lines, inlet_k),
            largest,
            outside_spike,
            in_spike,
            balance,
            inlet_k,
            stations: lines.x().to_vec(),
            source: lines.source(),
            rise_k: theta.iter().copied().map(kelvin).collect(),
        }
    }
}
