//! Asperities of rough line contacts. The modes are those of the total pressure P = P_h + P_a(H), of which the film
//! carries P_h and the asperities P_a. The rows are those of P_h.
//!
//! Cavitation is a complementarity condition for P_h, with one boundary B: a column of nodes. Behind B the film carries
//! nothing, so that P_h is zero in the fluxes, and the rows are replaced by −100 P_h, of either sign. B moves up if P_h
//! is negative in front of it. It moves down as long as the sum of the multipliers λ behind it is negative, because
//! more lubricant then flows in than the gap holds. Both are decided on the nodes around B, whether their rows are
//! sampled or not.

use super::case::{Case, Start, State};
use super::front::reach;
use super::part::{Flow, Kind, Moved, Part, Setting, Step};
use super::readings::Readings;
use super::sampled_system::{RowState, SampledSystem};
use crate::solver::discrete::reynolds::{CENTER, RowGeometry, STENCIL};
use crate::solver::discrete::rough::{Asperities, RoughNodes};
use crate::solver::physics::surfaces::AsperityTable;
use crate::solver::reduced::sums::row_times;
use std::ops::Range;

/// Part of the operators of line contacts with rough surfaces.
pub(super) const KIND: Kind = Kind {
    nodes: |window, flow, nodes| {
        if flow == Flow::Rough {
            reach::each_near(window, |unknown| nodes.at_times.extend(window.grid.row(unknown).0));
        }
    },
    make: |Setting { window, flow, .. }, system| {
        if flow != Flow::Rough {
            return None;
        }
        let mut rows = Vec::new();
        reach::each_near(window, |unknown| {
            let (stencil, geometry) = window.grid.row(unknown);
            let (node, places) = (window.grid.node(unknown), stencil.map(|node| system.support.place(node)));
            rows.push(NearRow { node, weight: window.grid.weights()[node], places, geometry });
        });
        let first = rows.first()?.node;
        let weights = window.grid.weights();
        let places = system.support.len();
        system.seen.push(system.support.own..system.support.own);
        Some(Box::new(OnAsperities {
            rough: None,
            first,
            front: first,
            down: None,
            turns: 0,
            open: system.support.places.iter().map(|place| weights[place.node] > 0.0).collect(),
            carried: vec![Asperities::default(); places],
            rows,
        }))
    },
};

/// Factor of P_h in the rows behind the boundary.
const HELD: f64 = 100.0;
/// Film pressure that counts as negative. Smaller negative pressures are errors of the basis.
const NEGATIVE: f64 = -1e-6;
/// Number of direction changes after which the boundary stays where it is.
const TURNS: u8 = 4;
/// Number of nodes in front of the boundary and behind it that are evaluated, and that it may pass at once.
const AROUND: usize = 9;
/// Largest changes of P and of P_h in one step.
const LARGEST_STEPS: (f64, f64) = (0.3, 0.6);
/// Largest reduction of the film thickness in one step, relative to H + 4σ, and the smallest such length in units of σ.
const FILM_LOSS: f64 = 0.8;
const ASPERITY_HEIGHT: f64 = 4.0;
const LEAST_FILM: f64 = 0.25;

/// Asperities with the cavitation boundary.
struct OnAsperities {
    /// Nodes of the film, with the table of the contact's asperity law; `None` before the first contact.
    rough: Option<RoughNodes>,
    /// Column of the first row that the boundary may pass.
    first: usize,
    /// Column of the boundary: the first cavitated one.
    front: usize,
    /// Last direction of the boundary, and number of direction changes.
    down: Option<bool>,
    turns: u8,
    /// False at the ends of the domain, where P_h is prescribed and asperities carry nothing.
    open: Vec<bool>,
    /// Asperity pressure at the places of the support.
    carried: Vec<Asperities>,
    /// Rows that the boundary may pass, column by column.
    rows: Vec<NearRow>,
}

/// Row that the boundary may pass.
struct NearRow {
    node: usize,
    weight: f64,
    places: [usize; STENCIL],
    geometry: RowGeometry,
}

impl OnAsperities {
    /// Returns true if the film carries a pressure at a place.
    fn is_film(&self, system: &SampledSystem, place: usize) -> bool {
        self.open[place] && system.support.places[place].node < self.front
    }

    /// Returns the places around the boundary that the sampled equations do not use.
    fn near(&self, system: &SampledSystem) -> Range<usize> {
        let asked = &system.support.places[system.support.own..];
        let place = |node: usize| system.support.own + asked.partition_point(|place| place.node < node);
        place(self.front.saturating_sub(AROUND + 3))..place(self.front + AROUND + 3)
    }

    /// Determines the states of the rows and the places to evaluate.
    fn look_near(&self, system: &mut SampledSystem) {
        let near = self.near(system);
        let SampledSystem { row_states, stencils, support, seen, .. } = system;
        for (state, stencil) in row_states.iter_mut().zip(&*stencils) {
            let cavitated = support.places[stencil[CENTER]].node >= self.front;
            *state = if cavitated { RowState::Held } else { RowState::Full };
        }
        if let Some(last) = seen.last_mut() {
            *last = near;
        }
    }

    /// Returns the rows of the boundary's neighbourhood, from a column on.
    fn rows_from(&self, column: usize) -> &[NearRow] {
        self.rows.get(column.saturating_sub(self.first)..).unwrap_or_default()
    }

    /// Returns the column to which the boundary moves after a step of which the share `omega` was taken.
    fn moved(&self, system: &SampledSystem, case: &Case<'_>, omega: f64) -> usize {
        let (Some(rough), Some(nodes)) = (case.problem.rough, &self.rough) else { return self.front };
        let places = system.support.len();
        let shift = system.step.rhs[system.modes];
        let (steps, bends) = system.step_fields.split_at(places);
        let rise = |place: usize| case.scale * bends[place] + shift;
        // P_h after the step.
        let film_pressure = |row: &NearRow| {
            let place = row.places[CENTER];
            let film = system.films[place] + omega * rise(place);
            system.fields[place] - rough.asperity_pressure(nodes.table(), film).0
        };
        let before = self.rows_from(self.front.saturating_sub(AROUND).max(self.first));
        let mut before = before.iter().take_while(|row| row.node < self.front);
        if let Some(row) = before.find(|row| film_pressure(row) < NEGATIVE) {
            return row.node;
        }
        // λ after the step.
        let multiplier = |row: &NearRow| {
            let own = system.nodes.row(&row.geometry.scaled(case.scale), 0.0, row.places);
            let mut value = own.value;
            for ((&place, by_pressure), by_film) in row.places.iter().zip(own.d_p).zip(own.d_h) {
                let film = rise(place);
                let pressure = steps[place] - self.carried[place].slope * film;
                let by_pressure = if self.is_film(system, place) { by_pressure } else { 0.0 };
                value += omega * (by_pressure * pressure + by_film * film);
            }
            -value
        };
        let mut inflow = 0.0;
        let filled = |row: &&NearRow| {
            inflow += row.weight * multiplier(row);
            inflow < 0.0
        };
        self.front + self.rows_from(self.front).iter().take(AROUND).take_while(filled).count()
    }

    /// Computes P and K P of the coefficients at the places around the boundary.
    fn spread_near(&self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        let (pressure, deformation) = fields.split_at_mut(system.support.len());
        for place in system.seen.last().cloned().unwrap_or_default() {
            pressure[place] = row_times(&system.basis.values, place, coefficients);
            deformation[place] = row_times(&system.basis.deformations, place, coefficients);
        }
    }
}

impl Part for OnAsperities {
    fn begin(&mut self, system: &mut SampledSystem, case: &Case<'_>, start: &Start<'_>) {
        let places = system.support.len();
        self.rough = case.problem.rough.as_ref().map(|rough| match self.rough.take() {
            Some(nodes) if rough.fits(nodes.table()) => nodes,
            _ => RoughNodes::new(rough, places),
        });
        let last = self.rows.last().map_or(self.first, |row| row.node);
        let front = start.fronts.and_then(|fronts| fronts.first()).copied().unwrap_or(last);
        let turns = if start.held { TURNS } else { 0 };
        (self.front, self.down, self.turns) = (front.clamp(self.first, last), None, turns);
        self.look_near(system);
    }

    fn spread(&mut self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        self.spread_near(system, coefficients, fields);
    }

    fn nodes(&mut self, system: &mut SampledSystem, case: &Case<'_>, _: State<'_>) -> bool {
        let Some(laws) = case.problem.rough_laws() else { return false };
        let Self { rough, carried, open, front, .. } = self;
        let Some(rough) = rough else { return false };
        let SampledSystem { seen, fields, films, nodes, support, .. } = system;
        for k in seen.iter().flat_map(Range::clone) {
            let cavitated = !open[k] || support.places[k].node >= *front;
            carried[k] = rough.evaluate_one(laws, (k, cavitated), (fields[k], films[k]), nodes);
        }
        true
    }

    fn rows(&mut self, system: &mut SampledSystem, case: &Case<'_>, sloping: bool) -> f64 {
        let SampledSystem { row_states, row_weights, stencils, fields, values, by_pressure, by_film, .. } = system;
        let mut sum = 0.0;
        for (r, _) in row_states.iter().enumerate().filter(|(_, state)| **state == RowState::Held) {
            let place = stencils[r][CENTER];
            values[r] = -HELD * (fields[place] - self.carried[place].pressure);
            sum += row_weights[r] * case.scale * values[r] * values[r];
            if sloping {
                (by_pressure[r], by_film[r]) = ([0.0; STENCIL], [0.0; STENCIL]);
                (by_pressure[r][CENTER], by_film[r][CENTER]) = (-HELD, HELD * self.carried[place].slope);
            }
        }
        sum
    }

    /// Replaces the derivatives by P_h and H by those by P and H.
    fn slopes(&mut self, system: &mut SampledSystem) {
        for r in 0..system.row_states.len() {
            if system.row_states[r] == RowState::Held {
                continue;
            }
            for m in 0..STENCIL {
                let place = system.stencils[r][m];
                if self.is_film(system, place) {
                    system.by_film[r][m] -= system.by_pressure[r][m] * self.carried[place].slope;
                } else {
                    system.by_pressure[r][m] = 0.0;
                }
            }
        }
    }

    fn longest_step(&self, system: &SampledSystem, case: &Case<'_>) -> Option<f64> {
        let sigma = case.problem.rough?.sigma;
        let (steps, bends) = system.step_fields.split_at(system.support.len());
        let shift = system.step.rhs[system.modes];
        let mut longest: f64 = 1.0;
        for k in system.seen.iter().flat_map(Range::clone) {
            let change = case.scale * bends[k] + shift;
            let of_film = steps[k] - self.carried[k].slope * change;
            longest = longest.min(LARGEST_STEPS.0 / steps[k].abs()).min(LARGEST_STEPS.1 / of_film.abs());
            let room = FILM_LOSS * (system.films[k] + ASPERITY_HEIGHT * sigma).max(LEAST_FILM * sigma);
            if change < -room {
                longest = longest.min(-room / change);
            }
        }
        Some(longest)
    }

    fn settle(
        &mut self,
        system: &mut SampledSystem,
        case: &Case<'_>,
        step: Step,
        (coefficients, _): (&mut [f64], &mut f64),
    ) -> Moved {
        if self.turns >= TURNS {
            return Moved::Still;
        }
        let front = self.moved(system, case, step.omega);
        if front == self.front {
            return Moved::Still;
        }
        let down = front > self.front;
        self.turns += u8::from(self.down.is_some_and(|was| was != down));
        self.down = Some(down);
        self.front = front;
        self.look_near(system);
        let mut fields = std::mem::take(&mut system.fields);
        self.spread_near(system, coefficients, &mut fields);
        system.fields = fields;
        Moved::PastRows
    }

    fn asperity_table(&self) -> Option<&AsperityTable> {
        self.rough.as_ref().map(RoughNodes::table)
    }

    fn read(&mut self, _: &SampledSystem, _: &Case<'_>, _: State<'_>, readings: &mut Readings) {
        readings.fronts.push(self.front);
    }
}
