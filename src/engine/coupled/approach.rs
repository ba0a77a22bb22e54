//! Load of a contact at a given approach of its bodies: a force element for multibody programs.
//!
//! Within the trained loads, a search varies the load w until the solved contact has the given approach δ. Beyond the
//! smallest and the largest trained load, w follows a power law that continues value and slope there. Bodies may thus
//! separate, fall back and press harder than trained.
//!
//! - A wide gap (rigid bodies, constant viscosity) carries w ∝ s^(−n) at the separation s, with n = 1 for a line
//!   contact and 1/2 for a point contact.
//! - A heavily loaded contact carries w ∝ δ^(3/2) for a point contact (Hertz), and nearly w ∝ δ^(10/9) for a line
//!   contact (Palmgren).
//!
//! The load depends on the current inputs only. Over a closed cycle the element does no work.

use super::{Coupled, CoupledError, Inputs, Outputs, error::check};
use crate::solver::full::Problem;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::Trust;
use crate::solver::warning::Warning;
use std::f64::consts::TAU;

/// Tolerance of the approach in the search, relative to the larger of the approaches at both ends.
const APPROACH_TOLERANCE: f64 = 1e-13;
/// Maximum number of solves of the search.
const MOST_SOLVES: usize = 60;
/// Number of intervals into which the loads of the model's range of M are divided. Whether the model is trained is
/// checked at the ends of these intervals.
const INTERVALS: usize = 200;
/// Number of bisections by which each end of the trained loads is located between two of these loads.
const BISECTIONS: usize = 45;
/// Relative difference of the two loads from which the slope at an end is computed.
const LOAD_DIFFERENCE: f64 = 1e-2;

/// Hertzian pressure of the contact with which the search for the trained loads begins \[Pa\].
const USUAL_PRESSURE: f64 = 5e8;

/// Trained loads of a contact with given inputs, and the solutions at both ends.
pub(super) struct Reach {
    /// Inputs for which it was computed. Their approach is 0 and their load a usual one, because it depends on neither.
    inputs: Inputs,
    /// Contacts under the smallest and under the largest trained load.
    ends: [End; 2],
}

/// Contact under the smallest or under the largest trained load.
#[derive(Clone)]
pub(super) struct End {
    /// Load w \[N/m\] or \[N\].
    pub load: f64,
    /// Approach δ \[m\].
    approach_m: f64,
    /// w/(dw/dδ): load divided by its derivative with respect to the approach \[m\].
    pub length_m: f64,
    /// All outputs of the contact.
    outputs: Outputs,
}

/// Side of the trained loads.
#[derive(Clone, Copy)]
enum Side {
    /// Smallest trained load.
    Low,
    /// Largest trained load.
    High,
}

impl Side {
    /// Selects the value of this side.
    fn of<T>(self, [low, high]: [T; 2]) -> T {
        match self {
            Self::Low => low,
            Self::High => high,
        }
    }
}

impl Reach {
    /// Returns the end beyond which an approach \[m\] lies. `None` if the approach lies between both ends.
    fn beyond(&self, wanted: f64) -> Option<(Side, &End)> {
        let [low, high] = &self.ends;
        if wanted <= low.approach_m {
            return Some((Side::Low, low));
        }
        (wanted >= high.approach_m).then_some((Side::High, high))
    }
}

/// End of the trained loads beyond which an approach lies.
pub(super) struct Beyond {
    pub end: End,
    /// Factor from the load of the end to the second load from which its slope is computed.
    pub inwards: f64,
    side: Side,
}

/// Factors from the smallest and from the largest trained load to the second load from which the slope is computed.
const INWARDS: [f64; 2] = [1.0 + LOAD_DIFFERENCE, 1.0 / (1.0 + LOAD_DIFFERENCE)];

/// Returns the exponents of the power laws beyond the smallest and beyond the largest trained load: that of the
/// separation in a wide gap, and that of the approach of a heavily loaded contact.
fn exponents(kind: ContactKind) -> [f64; 2] {
    if kind.is_line() { [-1.0, 10.0 / 9.0] } else { [-0.5, 1.5] }
}

/// Returns the load with a Hertzian pressure of about [`USUAL_PRESSURE`]. The load of the inputs is not used.
fn usual_load(inputs: &Inputs, kind: ContactKind) -> f64 {
    let (radius, modulus) = (inputs.radius_m, inputs.modulus_pa);
    if kind.is_line() {
        TAU * radius * USUAL_PRESSURE.powi(2) / modulus
    } else {
        20.0 * radius.powi(2) * USUAL_PRESSURE.powi(3) / modulus.powi(2)
    }
}

impl End {
    /// Creates the end with these outputs. `inner` are the outputs under `inwards` times its load.
    ///
    /// # Errors
    /// If the approach does not increase with the load.
    pub fn of(outputs: Outputs, inner: &Outputs, inwards: f64) -> Result<Self, CoupledError> {
        // ln w is closer to a straight line than w.
        let length_m = (inner.approach_m - outputs.approach_m) / inwards.ln();
        if !(length_m.is_finite() && length_m > 0.0) {
            return Err(CoupledError::NoLoad(outputs.approach_m));
        }
        Ok(Self { load: outputs.load, approach_m: outputs.approach_m, length_m, outputs })
    }

    /// Extrapolates the outputs to an approach beyond this end by the power law of the load with the given exponent.
    fn beyond(&self, wanted: f64, exponent: f64, kind: ContactKind) -> Outputs {
        let excess = wanted - self.approach_m;
        let ratio = (1.0 + excess / (exponent * self.length_m)).powf(exponent);
        let hertz_ratio = kind.hertz_root(ratio);
        // If the bodies separate, the film thickness grows by the same distance.
        let opening = (-excess).max(0.0);
        let mut outputs = self.outputs.clone();
        outputs.load *= ratio;
        outputs.friction_force *= ratio;
        outputs.half_width_m *= hertz_ratio;
        outputs.hertz_pressure_pa *= hertz_ratio;
        outputs.approach_m = wanted;
        outputs.film_ratio_min += opening * outputs.film_ratio_min / outputs.h_min_m;
        outputs.h_c_m += opening;
        outputs.h_min_m += opening;
        outputs.error_bounds = [f64::NAN; 3];
        outputs.trained = false;
        outputs.warnings.push(Warning::LoadExtrapolated { load: outputs.load, last: self.load });
        outputs
    }
}

impl Beyond {
    /// Returns the outputs at an approach beyond `end`, which is this end for the same or for slightly changed inputs.
    pub fn outputs(&self, end: &End, wanted: f64, kind: ContactKind) -> Outputs {
        end.beyond(wanted, self.side.of(exponents(kind)), kind)
    }
}

impl Coupled {
    /// Returns the outputs at the approach of the inputs.
    ///
    /// # Errors
    /// If the approach is not finite, or if no load with this approach is found.
    pub(super) fn approached(&mut self, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        check("approach", inputs.approach_m, " m", ("", |_| true))?;
        let reach = self.take_reach(inputs)?;
        let found = self.within(&reach, inputs);
        self.reach = Some(reach);
        found
    }

    /// Returns the end of the trained loads beyond which the approach of the inputs lies. `None` if the approach lies
    /// between both ends.
    pub(super) fn beyond(&mut self, inputs: &Inputs) -> Result<Option<Beyond>, CoupledError> {
        let reach = self.take_reach(inputs)?;
        let found = reach.beyond(inputs.approach_m);
        let found = found.map(|(side, end)| Beyond { end: end.clone(), inwards: side.of(INWARDS), side });
        self.reach = Some(reach);
        Ok(found)
    }

    /// Returns the trained load at this end for other inputs.
    pub(super) fn load_of(&self, beyond: &Beyond, inputs: &Inputs) -> Result<f64, CoupledError> {
        let (low, high) = self.trained_loads(&self.given(inputs))?;
        Ok(beyond.side.of([low, high]))
    }

    /// Returns the inputs with the approach 0 and a usual load. The trained loads depend on all other inputs only.
    fn given(&self, inputs: &Inputs) -> Inputs {
        Inputs { approach_m: 0.0, load: usual_load(inputs, self.model.contact()), ..*inputs }
    }

    /// Returns the trained loads for some inputs. Takes the stored ones out of `self`, or computes them if they belong
    /// to other inputs.
    fn take_reach(&mut self, inputs: &Inputs) -> Result<Reach, CoupledError> {
        let given = self.given(inputs);
        match self.reach.take() {
            Some(reach) if reach.inputs == given => Ok(reach),
            _ => self.reach(&given),
        }
    }

    /// Computes the trained loads and solves the contacts at both ends.
    fn reach(&mut self, given: &Inputs) -> Result<Reach, CoupledError> {
        let (low, high) = self.trained_loads(given)?;
        let mut end = |load: f64, inwards: f64| {
            let (outputs, inner) = (self.under(given, load)?, self.under(given, load * inwards)?);
            End::of(outputs, &inner, inwards)
        };
        Ok(Reach { inputs: *given, ends: [end(low, INWARDS[0])?, end(high, INWARDS[1])?] })
    }

    /// Returns the smallest and the largest load for which the model is trained. If there are several intervals of
    /// trained loads, they are those of the lowest one. If there is none, they are the ends of the model's range of M,
    /// the Moes load number.
    fn trained_loads(&self, given: &Inputs) -> Result<(f64, f64), CoupledError> {
        let kind = self.model.contact();
        let own = self.request(given, given.load)?.point.moes().m;
        let range =
            self.model.domain.space.interval(Quantity::M, kind).ok_or(CoupledError::NoLoad(given.approach_m))?;
        // M is proportional to the load.
        let [low, high] = [range.0, range.1].map(|m| given.load * m / own);
        let load = |k: f64| low * (high / low).powf(k / INTERVALS as f64);
        let trained = |k: f64| {
            let problem = self.request(given, load(k)).ok();
            let problem = problem.and_then(|request| Problem::new(&request.point, request.lubricant).ok());
            problem.is_some_and(|problem| self.model.trust(&problem) == Trust::Trained)
        };
        let inside: Vec<bool> = (0..=INTERVALS).map(|k| trained(k as f64)).collect();
        let Some(first) = inside.iter().position(|inside| *inside) else { return Ok((low, high)) };
        let last = first + inside.iter().skip(first).take_while(|inside| **inside).count() - 1;
        let end = |mut inner: f64, mut outer: f64| {
            if !(0.0..=INTERVALS as f64).contains(&outer) {
                return load(inner);
            }
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (inner + outer);
                if trained(middle) { inner = middle } else { outer = middle }
            }
            load(inner)
        };
        Ok((end(first as f64, first as f64 - 1.0), end(last as f64, last as f64 + 1.0)))
    }

    /// Returns the outputs at the approach of the inputs, given the trained loads. Between these it searches the load
    /// by the Illinois variant of regula falsi: if an end point is retained twice in a row, its value is halved.
    fn within(&mut self, reach: &Reach, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        let (wanted, kind) = (inputs.approach_m, self.model.contact());
        let exponents = exponents(kind);
        if let Some((side, end)) = reach.beyond(wanted) {
            return Ok(end.beyond(wanted, side.of(exponents), kind));
        }
        let ([low, high], [_, closing]) = (&reach.ends, exponents);
        // The approach is nearly a linear function of this power of the load.
        let place = |end: &End| (end.load.powf(1.0 / closing), end.approach_m - wanted);
        let (mut a, mut b) = (place(low), place(high));
        let tolerance = APPROACH_TOLERANCE * low.approach_m.abs().max(high.approach_m.abs());
        for _ in 0..MOST_SOLVES {
            let between = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
            let outputs = self.under(inputs, between.powf(closing))?;
            let next = (between, outputs.approach_m - wanted);
            let stays = between == a.0 || between == b.0;
            if next.1.abs() <= tolerance || stays {
                return Ok(outputs);
            }
            if next.1 * b.1 < 0.0 {
                a = b;
            } else {
                a.1 *= 0.5;
            }
            b = next;
        }
        Err(CoupledError::NoLoad(wanted))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Pressed;
    use super::*;
    use crate::engine::embedded;
    use std::sync::Arc;

    /// Returns the force element of an embedded model, its first inputs, and the trained loads for these inputs.
    fn unit(which: &str) -> (Coupled, Inputs, (f64, f64)) {
        let model = embedded(which).unwrap();
        let inputs = Coupled::first_inputs(&model).unwrap();
        let unit = Coupled::new(Arc::clone(&model), Pressed::Approach).unwrap();
        let given = Inputs { load: usual_load(&inputs, model.contact()), approach_m: 0.0, ..inputs };
        let loads = unit.trained_loads(&given).unwrap();
        (unit, inputs, loads)
    }

    #[test]
    fn the_load_rises_smoothly_with_the_approach_from_an_open_gap_to_beyond_the_training() {
        for which in ["point", "line"] {
            let (mut unit, inputs, loads) = unit(which);
            assert!(loads.1 > 5.0 * loads.0, "{which}: {loads:?}");
            let under = |unit: &mut Coupled, approach_m: f64| unit.solve(&Inputs { approach_m, ..inputs }).unwrap();
            under(&mut unit, 0.0);
            let ends = unit.reach.as_ref().unwrap().ends.each_ref().map(|end| (end.approach_m, end.load, end.length_m));
            for (end, load, length) in ends {
                // Value and slope agree on both sides of an end.
                let step = 0.01 * length;
                let [before, at, after] = [-step, 0.0, step].map(|by| under(&mut unit, end + by).load);
                assert!((at / load - 1.0).abs() < 1e-9, "{which}: {at} against {load}");
                let (left, right) = (at - before, after - at);
                assert!((left / right - 1.0).abs() < 0.1, "{which}: slopes {left:e} and {right:e}");
            }
            let span = ends[1].0 - ends[0].0;
            let approaches = (0..=60).map(|k| ends[0].0 + span * (f64::from(k) / 40.0 - 0.25));
            let loads: Vec<f64> = approaches.map(|approach_m| under(&mut unit, approach_m).load).collect();
            assert!(loads.windows(2).all(|pair| pair[1] > pair[0]), "{which}: {loads:?}");
            // In a wide gap the load follows the power law of rigid bodies.
            let [wide, wider] = [1e3, 4e3].map(|times| under(&mut unit, ends[0].0 - times * ends[0].2));
            let wanted = if which == "line" { 4.0 } else { 2.0 };
            assert!((wide.load / wider.load / wanted - 1.0).abs() < 0.01, "{which}: {} {}", wide.load, wider.load);
            assert!(!wide.trained && wide.h_min_m > 100.0 * ends[0].2 && !wide.warnings.is_empty());
            assert!(unit.solve(&Inputs { approach_m: f64::NAN, ..inputs }).is_err());
        }
    }

    #[test]
    fn the_load_does_not_depend_on_what_was_asked_before() {
        let (mut unit, inputs, _) = unit("point");
        let wanted = Inputs { approach_m: 0.8 * inputs.approach_m, ..inputs };
        let first = unit.solve(&wanted).unwrap();
        unit.solve(&Inputs { speed_m_per_s: 1.1 * inputs.speed_m_per_s, load: 2.0 * inputs.load, ..wanted }).unwrap();
        let again = unit.solve(&Inputs { load: 0.3 * inputs.load, ..wanted }).unwrap();
        // Compared as text, because outputs that this model does not have are NaN.
        assert_eq!(format!("{again:?}"), format!("{first:?}"));
    }

    /// Lets a mass hit the contact and bounce off. Returns the work of the contact over the closed cycle, the largest
    /// potential energy and the largest load.
    fn impact(
        unit: &mut Coupled,
        inputs: &Inputs,
        (mass, speed, start, step): (f64, f64, f64, f64),
    ) -> (f64, f64, f64) {
        let mut load = |approach_m: f64| unit.solve(&Inputs { approach_m, ..*inputs }).unwrap().load;
        let (mut approach, mut velocity) = (start, speed);
        let mut force = load(approach);
        let (mut work, mut energy, mut largest) = (0.0, 0.0f64, force);
        // Verlet's method. The work is that of Simpson's rule over each step.
        while approach >= start {
            let before = (approach, force);
            approach += step * (velocity - 0.5 * step * force / mass);
            let middle = load(0.5 * (before.0 + approach));
            force = load(approach);
            velocity -= 0.5 * step * (before.1 + force) / mass;
            work += (approach - before.0) * (before.1 + 4.0 * middle + force) / 6.0;
            energy = energy.max(work);
            largest = largest.max(force);
        }
        // Work of the short way back to the start, by the trapezoidal rule.
        work += (start - approach) * 0.5 * (force + load(start));
        (work, energy, largest)
    }

    #[test]
    fn masses_bounce_off_without_work_over_the_cycle() {
        let count = if std::env::var_os("EHL_LONG").is_some() { 500 } else { 1 };
        let mut random = fastrand::Rng::with_seed(7);
        for which in ["point", "line"] {
            let (mut unit, inputs, loads) = unit(which);
            let low = unit
                .solve(&Inputs { approach_m: 0.0, ..inputs })
                .map(|_| unit.reach.as_ref().unwrap().ends[0].approach_m);
            let low = low.unwrap();
            let length = unit.reach.as_ref().unwrap().ends[1].approach_m - low;
            for _ in 0..count {
                // The work up to the largest trained load is about 2/5 (point contact) or 1/2 (line contact) of load ×
                // length. The kinetic energy is of this size.
                let energy = (0.05 + 0.6 * random.f64()) * loads.1 * length;
                let mass = 10f64.powf(-2.0 + 2.0 * random.f64());
                let speed = (2.0 * energy / mass).sqrt();
                let step = 0.007 * length / speed;
                let (work, energy, largest) = impact(&mut unit, &inputs, (mass, speed, low - 0.5 * length, step));
                assert!(work.abs() <= 1e-6 * energy, "{which}: {:e} of the peak energy", work / energy);
                assert!(largest > 0.02 * loads.1);
            }
        }
    }
}
