//! Motion of the boundary B after a step, (D.16)–(D.18).

use super::reach::BEFORE;
use super::{Front, TURNS};
use crate::solver::discrete::grid::dot;
use crate::solver::reduced::operators::part::Moved;
use crate::solver::reduced::operators::sampled_system::SampledSystem;
use crate::solver::reduced::sums::row_times;

/// Pressure that counts as negative, and as negligible, in a transient contact. Transient bases are of fewer
/// contacts, and smaller pressures behind the contact matter.
const LITTLE: f64 = 1e-5;

impl Front {
    /// Moves B after a step, of which the share `omega` was taken. The contribution of gradients to the multiplier λ is
    /// neglected: it is small where P ends, and vanishes with the step.
    pub(super) fn follow(
        &mut self,
        system: &mut SampledSystem,
        (scale, omega): (f64, f64),
        coefficients: &[f64],
    ) -> Moved {
        if self.idle || self.held {
            return Moved::Still;
        }
        let SampledSystem { nodes, stencils, geometry, step_fields: step, fields, load_row, lift, transient, .. } =
            system;
        let (s, strides, shift) = (self.cut.len(), *transient, system.step.rhs[system.modes]);
        let turns = if strides { TURNS } else { self.turns };
        let first_row = self.rows.len();
        self.passing.clear();
        for line in &mut self.lines {
            if line.turns >= turns {
                continue;
            }
            let at = |k: usize| &self.nodes[line.first + k];
            let (stride, first, end) = if strides {
                // Behind the last significant pressure there may be no modes that show B a negative pressure.
                let little = |k: &usize| fields[at(*k).place].abs() < LITTLE;
                (line.stride, 1, line.front - (1..line.front).rev().take_while(little).count())
            } else {
                (1, line.front.saturating_sub(BEFORE), line.front)
            };
            let least = if strides { -LITTLE } else { self.negative };
            let pressure = |k: usize| {
                let looked_at = strides || at(k).place < self.own;
                if looked_at { fields[at(k).place] } else { row_times(&self.modes, line.first + k, coefficients) }
            };
            let negative = (first..end).find(|&k| pressure(k) < least).filter(|_| line.front > 1);
            // (D.16): λ after the step.
            let multiplier = |k: usize| {
                let own = first_row + line.first + k;
                let row = nodes.row(&geometry[own].scaled(scale), 0.0, stencils[own]);
                let ends = stencils[own].iter().zip(row.d_p).zip(row.d_h);
                let change = ends.map(|((&node, a), b)| a * step[node] + b * (scale * step[s + node] + shift));
                -(row.value + omega * change.sum::<f64>())
            };
            let front = match negative {
                Some(first) => first.max(end.saturating_sub(stride)),
                None => {
                    // If more flows into these nodes than the gap holds, the liquid fills them.
                    let mut inflow = 0.0;
                    let filled = |&k: &usize| {
                        inflow += at(k).weight * multiplier(k);
                        inflow < 0.0
                    };
                    line.front + (line.front..line.count.min(line.front + stride)).take_while(filled).count()
                }
            };
            if front == line.front {
                continue;
            }
            let down = front > line.front;
            let turned = line.down.is_some_and(|was| was != down);
            line.turns += u8::from(turned);
            line.stride = if turned { (line.stride / 4).max(1) } else { 2 * line.stride };
            line.down = Some(down);
            let passing = line.front.min(front)..line.front.max(front);
            self.passing.extend(passing.map(|k| (line.first + k, down)));
            line.front = front;
        }
        if self.passing.is_empty() {
            return Moved::Still;
        }
        let modes = load_row.len();
        let (pressure, rest) = fields.split_at_mut(s);
        let deformation = &mut rest[..s];
        for &(k, carries) in &self.passing {
            let (passed, own) = (&self.nodes[k], &self.modes[k * modes..][..modes]);
            let (value, sign) = (dot(own, coefficients), if carries { 1.0 } else { -1.0 });
            pressure[passed.place] = if carries { value } else { 0.0 };
            self.cut[passed.place] = !carries;
            let bends = &self.bends[k * s..][..self.own];
            deformation.iter_mut().zip(bends).for_each(|(out, bend)| *out += sign * value * f64::from(*bend));
            for ((lift, load), v) in lift.iter_mut().zip(&mut *load_row).zip(own) {
                *lift += sign * passed.zero * v;
                *load += sign * passed.weight * v;
            }
        }
        self.look_near(system);
        self.find_bending(coefficients);
        let mut fields = std::mem::take(&mut system.fields);
        self.spread_near(system, coefficients, &mut fields);
        system.fields = fields;
        if self.passing.iter().any(|(k, _)| self.nodes[*k].sampled) { Moved::PastRows } else { Moved::BetweenRows }
    }
}
