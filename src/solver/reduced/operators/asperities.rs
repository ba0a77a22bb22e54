//! Asperities of rough contacts. The modes are those of the total pressure P = P_h + P_a(H), of which the film
//! carries P_h and the asperities P_a. The rows are those of P_h.
//!
//! Cavitation is a complementarity condition for P_h, with one boundary B: a column of nodes on each line along X. Behind
//! B the film carries nothing, so that P_h is zero in the fluxes, and the rows are replaced by −100 P_h, of either sign.
//! B moves up along a line if P_h is negative in front of it. It moves down as long as the sum of the multipliers λ
//! behind it is negative, because more lubricant then flows in than the gap holds. Both are decided on the nodes around
//! B, whether their rows are sampled or not.

use super::case::{Case, Start, State};
use super::front::reach;
use super::part::{Flow, Kind, Moved, Part, Setting, Step};
use super::readings::Readings;
use super::sampled_system::{RowState, SampledSystem};
use super::support::{Place, Support};
use crate::solver::discrete::reynolds::{CENTER, RowGeometry, STENCIL};
use crate::solver::discrete::rough::{Asperities, RoughNodes};
use crate::solver::physics::surfaces::AsperityTable;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::sums::row_times;
use std::ops::Range;

/// Part of the operators of contacts with rough surfaces.
pub(super) const KIND: Kind = Kind {
    nodes: |window, flow, nodes| {
        if flow == Flow::Rough {
            reach::each_near(window, |_, unknown| nodes.at_times.extend(window.grid.row(unknown).0));
        }
    },
    make: |Setting { window, flow, .. }, system| {
        if flow != Flow::Rough {
            return None;
        }
        let on = OnAsperities::new(window, system)?;
        system.seen.resize(1 + system.support.across, system.support.own..system.support.own);
        Some(Box::new(on))
    },
};

/// Factor of P_h in the rows behind the boundary.
const HELD: f64 = 100.0;
/// Film pressure that counts as negative, for a line and for a plane. Smaller negative pressures are errors of the basis.
const NEGATIVE: [f64; 2] = [-1e-6, -1e-4];
/// Number of direction changes after which the boundary of a line stays where it is.
const TURNS: u8 = 4;
/// Number of nodes in front of the boundary and behind it that are evaluated, and that it may pass at once, for a line
/// and for each line of a plane.
const AROUND: [usize; 2] = [9, 4];
/// Number of further nodes that the rows of these nodes use.
const REACH: usize = 3;
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
    /// The boundary, line by line.
    lines: Vec<Line>,
    /// Rows that it may pass, line by line.
    rows: Vec<NearRow>,
    /// Number of nodes across that do not belong to a line: the outer edge of a plane.
    edge: usize,
    /// Film pressure that counts as negative, and number of nodes around the boundary that are evaluated.
    negative: f64,
    around: usize,
    /// False at the ends of the domain, where P_h is prescribed and asperities carry nothing.
    open: Vec<bool>,
    /// Line and column of the places of the support.
    at: Vec<(usize, usize)>,
    /// Asperity pressure at the places of the support.
    carried: Vec<Asperities>,
    /// Work space: columns to which the boundary moves.
    moved: Vec<usize>,
}

/// Line of unknowns along X with its part of the boundary.
struct Line {
    /// Column of the first row that the boundary may pass, index of this row, and number of these rows.
    column: usize,
    first: usize,
    count: usize,
    /// Column of the boundary: the first cavitated one.
    front: usize,
    /// Last direction of the boundary, and number of direction changes.
    down: Option<bool>,
    turns: u8,
}

/// Row that the boundary may pass.
struct NearRow {
    column: usize,
    weight: f64,
    places: [usize; STENCIL],
    geometry: RowGeometry,
}

impl OnAsperities {
    /// Creates the part of a local model over its rows; `None` if it has no solutions.
    fn new(window: &Window, system: &SampledSystem) -> Option<Self> {
        let (grid, weights, support) = (&window.grid, window.grid.weights(), &system.support);
        let (mut lines, mut rows): (Vec<Line>, Vec<NearRow>) = (Vec::new(), Vec::new());
        reach::each_near(window, |line, unknown| {
            let (stencil, geometry) = grid.row(unknown);
            let node = grid.node(unknown);
            let (column, places) = (grid.line_and_column(node).1, stencil.map(|node| support.place(node)));
            if line == lines.len() {
                lines.push(Line { column, first: rows.len(), count: 0, front: column, down: None, turns: 0 });
            }
            lines.iter_mut().last().into_iter().for_each(|line| line.count += 1);
            rows.push(NearRow { column, weight: weights[node], places, geometry });
        });
        if lines.len() != grid.lines() {
            return None;
        }
        let (edge, plane) = (support.across - lines.len(), usize::from(grid.kind().is_point()));
        let at = |place: &Place| ((place.node % support.across).saturating_sub(edge), place.node / support.across);
        Some(Self {
            rough: None,
            edge,
            negative: NEGATIVE[plane],
            around: AROUND[plane],
            open: support.places.iter().map(|place| weights[place.node] > 0.0).collect(),
            at: support.places.iter().map(at).collect(),
            carried: vec![Asperities::default(); support.len()],
            moved: Vec::with_capacity(lines.len()),
            lines,
            rows,
        })
    }

    /// Returns true if a place lies in front of the boundary.
    fn is_before(&self, place: usize) -> bool {
        let (line, column) = self.at[place];
        column < self.lines[line].front
    }

    /// Returns true if the film carries a pressure at a place.
    fn is_film(&self, place: usize) -> bool {
        self.open[place] && self.is_before(place)
    }

    /// Returns the places around the boundary that the sampled equations do not use, on one line of nodes across: those
    /// of the rows around the boundary of this line and of its neighbours.
    fn near(&self, support: &Support, across: usize) -> Range<usize> {
        let (mut from, mut to) = (usize::MAX, 0);
        let own = across.checked_sub(self.edge);
        let beside = [own.and_then(|own| own.checked_sub(1)), own, Some(across + 1 - self.edge)];
        for (k, line) in beside.into_iter().enumerate() {
            let Some(line) = line.and_then(|line| self.lines.get(line)) else { continue };
            let reach = self.around + if k == 1 { REACH } else { 0 };
            from = from.min(line.front.saturating_sub(reach));
            to = to.max(line.front + reach);
        }
        support.asked(across, from)..support.asked(across, to.max(from))
    }

    /// Determines the states of the rows and the places to evaluate.
    fn look_near(&self, system: &mut SampledSystem) {
        let SampledSystem { row_states, stencils, support, seen, .. } = system;
        for (state, stencil) in row_states.iter_mut().zip(&*stencils) {
            *state = if self.is_before(stencil[CENTER]) { RowState::Full } else { RowState::Held };
        }
        seen[1..].iter_mut().enumerate().for_each(|(across, near)| *near = self.near(support, across));
    }

    /// Returns the column to which the boundary of a line moves after a step of which the share `omega` was taken.
    fn after(&self, line: &Line, system: &SampledSystem, case: &Case<'_>, omega: f64) -> usize {
        let (Some(rough), Some(nodes)) = (case.problem.rough, &self.rough) else { return line.front };
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
        let rows = &self.rows[line.first..line.first + line.count];
        let rows_from = |column: usize| rows.get(column.saturating_sub(line.column)..).unwrap_or_default();
        let before = rows_from(line.front.saturating_sub(self.around).max(line.column));
        let mut before = before.iter().take_while(|row| row.column < line.front);
        if let Some(row) = before.find(|row| film_pressure(row) < self.negative) {
            return row.column;
        }
        // λ after the step.
        let multiplier = |row: &NearRow| {
            let own = system.nodes.row(&row.geometry.scaled(case.scale), 0.0, row.places);
            let mut value = own.value;
            for ((&place, by_pressure), by_film) in row.places.iter().zip(own.d_p).zip(own.d_h) {
                let film = rise(place);
                let pressure = steps[place] - self.carried[place].slope * film;
                let by_pressure = if self.is_film(place) { by_pressure } else { 0.0 };
                value += omega * (by_pressure * pressure + by_film * film);
            }
            -value
        };
        let mut inflow = 0.0;
        let filled = |row: &&NearRow| {
            inflow += row.weight * multiplier(row);
            inflow < 0.0
        };
        line.front + rows_from(line.front).iter().take(self.around).take_while(filled).count()
    }

    /// Computes P and K P of the coefficients at the places around the boundary.
    fn spread_near(&self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        let (pressure, deformation) = fields.split_at_mut(system.support.len());
        for place in system.seen[1..].iter().flat_map(Range::clone) {
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
        let turns = if start.held { TURNS } else { 0 };
        for (k, line) in self.lines.iter_mut().enumerate() {
            let last = line.column + line.count.saturating_sub(1);
            let front = start.fronts.and_then(|fronts| fronts.get(k)).copied().unwrap_or(last);
            (line.front, line.down, line.turns) = (front.clamp(line.column, last), None, turns);
        }
        self.look_near(system);
    }

    fn spread(&mut self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        self.spread_near(system, coefficients, fields);
    }

    fn nodes(&mut self, system: &mut SampledSystem, case: &Case<'_>, _: State<'_>) -> bool {
        let Some(laws) = case.problem.rough_laws() else { return false };
        let Self { rough, carried, open, at, lines, .. } = self;
        let Some(rough) = rough else { return false };
        let SampledSystem { seen, fields, films, nodes, .. } = system;
        for k in seen.iter().flat_map(Range::clone) {
            let (line, column) = at[k];
            let cavitated = !open[k] || column >= lines[line].front;
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
                if self.is_film(place) {
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
        let mut moved = std::mem::take(&mut self.moved);
        moved.clear();
        moved.extend(self.lines.iter().map(|line| match line.turns {
            TURNS.. => line.front,
            _ => self.after(line, system, case, step.omega),
        }));
        let mut still = true;
        for (line, front) in self.lines.iter_mut().zip(&moved).filter(|(line, front)| line.front != **front) {
            let down = *front > line.front;
            line.turns += u8::from(line.down.is_some_and(|was| was != down));
            (line.down, line.front, still) = (Some(down), *front, false);
        }
        self.moved = moved;
        if still {
            return Moved::Still;
        }
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
        readings.fronts.extend(self.lines.iter().map(|line| line.front));
    }
}
