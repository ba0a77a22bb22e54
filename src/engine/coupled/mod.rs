//! A contact as a part of another program's simulation: one reduced model, inputs that change, outputs that follow.
//!
//! [`Coupled`] needs neither the models of the program nor a bench, so that a library with it stays small. What it
//! answers is what `solve --method reduced` answers, to the last bit; each contact is solved afresh, so that an answer
//! hangs on its inputs only. [`InTime`] is the same for models in time, whose state advances. [`fmu`] is what the Functional Mock-up Interface calls such a part.

pub mod fmu;
mod in_time;

pub use in_time::{InTime, InTimeState};

use crate::solver::full::point::resolution_warning;
use crate::solver::full::{ContactSolver, Problem, Solution, Start};
use crate::solver::limits::Number;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::physics::lubricant::{Lubricant, Sliding};
use crate::solver::reduced::{ErrorEstimate, Online, ReducedModel, ReducedOptions, Trust};
use std::sync::Arc;

/// How close the load's logarithm is sought when an approach is given.
const LOAD_FOUND: f64 = 1e-13;
/// Solves at most to find it.
const MOST_SOLVES: usize = 80;
/// What a load is multiplied by while none is known beyond the wanted one.
const WIDER: f64 = 2.0;

/// What presses the bodies together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// A load \[N/m\] of a line contact, \[N\] of a point contact.
    Load,
    /// The approach of two points far inside both bodies \[m\], of a point contact; the load follows.
    Approach,
}

/// What a contact is driven by. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Reduced radius R \[m\].
    pub radius_m: f64,
    /// R_y/R of a point contact; 1 of a circle, and of a line contact.
    pub radius_ratio: f64,
    /// Mean entrainment speed u_m \[m/s\].
    pub speed_m_per_s: f64,
    /// Slide-to-roll ratio.
    pub slide_to_roll_ratio: f64,
    /// Load \[N/m\] or \[N\]; where an approach is given the one from which it is sought.
    pub load: f64,
    /// Approach \[m\], where that is given.
    pub approach_m: f64,
    /// Reduced modulus E′ \[Pa\].
    pub modulus_pa: f64,
    /// Viscosity at ambient pressure η₀ \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    pub alpha_per_pa: f64,
}

/// What follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// The load \[N/m\] or \[N\].
    pub load: f64,
    /// The approach \[m\]; not a number for a line contact, whose approach hangs on its bodies.
    pub approach_m: f64,
    /// Central film \[m\].
    pub h_c_m: f64,
    /// Smallest film \[m\].
    pub h_min_m: f64,
    /// Friction coefficient, positive for a positive slide-to-roll ratio.
    pub friction_coefficient: f64,
    /// Friction force: coefficient times load.
    pub friction_force: f64,
    /// Largest pressure of the dry contact \[Pa\].
    pub hertz_pressure_pa: f64,
    /// Bounds on the relative errors of h_c, h_min and friction that hold in 99 of 100 contacts; not a number where none
    /// is known.
    pub error_bounds: [f64; 3],
    /// Whether the model was trained for the contact.
    pub trained: bool,
    /// Whether the full solver took over, where the model has no solution.
    pub full: bool,
    /// What a reader must know, one sentence each.
    pub warnings: Vec<String>,
}

/// A model with all work space; one for each thread.
pub struct Coupled {
    model: Arc<ReducedModel>,
    online: Online,
    full: Option<ContactSolver>,
    lubricant: Lubricant,
    pressed: Pressed,
}

impl Coupled {
    /// A contact by a model, of the lubricant that the model was trained with.
    ///
    /// # Errors
    /// With a sentence where the model has no window, or an approach is wanted of a line contact.
    pub fn new(model: Arc<ReducedModel>, pressed: Pressed) -> Result<Self, String> {
        if model.windows.is_empty() {
            return Err(format!("the reduced model `{}` holds no window", model.title));
        }
        if pressed == Pressed::Approach && model.contact() == ContactKind::Line {
            return Err(
                "the approach of a line contact hangs on the size of its bodies; give its load instead".to_owned()
            );
        }
        let online = Online::new(Arc::clone(&model), ReducedOptions::default());
        let lubricant = model.domain.lubricant;
        Ok(Self { model, online, full: None, lubricant, pressed })
    }

    /// What presses the bodies together.
    pub fn pressed(&self) -> Pressed {
        self.pressed
    }

    /// Inputs in the midst of what a model was trained for, from which a simulation may begin.
    pub fn first_inputs(model: &Arc<ReducedModel>) -> Option<Inputs> {
        let window = model.windows.get(model.windows.len() / 2)?;
        let points = || window.snapshots.iter().map(|snapshot| snapshot.point);
        // Some models are trained a little beyond what they declare.
        let inside = |point: &OperatingPoint| {
            let problem = Problem::new(point, model.domain.lubricant);
            problem.is_ok_and(|problem| model.trust(&problem) == Trust::Trained)
        };
        let middle = window.snapshots.len() / 2;
        let point = points().skip(middle).chain(points()).find(inside).or_else(|| points().next())?;
        let mut own = Self::new(Arc::clone(model), Pressed::Load).ok()?;
        let inputs = Inputs {
            radius_m: point.radius_m,
            radius_ratio: point.radius_ratio(),
            speed_m_per_s: point.speed_m_per_s,
            slide_to_roll_ratio: point.sliding.slide_to_roll_ratio,
            load: point.load,
            approach_m: 0.0,
            modulus_pa: point.modulus_pa,
            viscosity_pa_s: point.viscosity_pa_s,
            alpha_per_pa: own.lubricant.own_coefficient().unwrap_or(point.alpha_per_pa),
        };
        let approach_m = own.solve(&inputs).ok()?.approach_m;
        Some(Inputs { approach_m: if approach_m.is_finite() { approach_m } else { 0.0 }, ..inputs })
    }

    /// The outputs of some inputs.
    ///
    /// # Errors
    /// With a sentence where an input makes no sense, or neither the model nor the full solver has a solution.
    pub fn solve(&mut self, inputs: &Inputs) -> Result<Outputs, String> {
        match self.pressed {
            Pressed::Load => self.under(inputs, inputs.load),
            Pressed::Approach => self.approached(inputs),
        }
    }

    /// The outputs under a load.
    fn under(&mut self, inputs: &Inputs, load: f64) -> Result<Outputs, String> {
        let point = self.point(inputs, load)?;
        let problem = Problem::new(&point, self.lubricant).map_err(|error| error.to_string())?;
        self.online.forget();
        let mut warnings = Vec::new();
        let reduced = match self.online.solve(&point, self.lubricant) {
            Ok(solved) => {
                let fields = self.online.reconstruct(&solved).map_err(|error| error.to_string())?;
                Some((fields.of_problem(problem), solved))
            }
            Err(why) if why.without_solution().is_some() => {
                warnings.extend([why.to_string(), "the full solver took over".to_owned()]);
                None
            }
            Err(refused) => return Err(refused.to_string()),
        };
        let full = reduced.is_none();
        let mut bounds = [f64::NAN; 3];
        let trust = self.model.trust(&problem);
        let trained = !full && trust == Trust::Trained;
        let (solution, friction_coefficient) = match reduced {
            Some((solution, solved)) => {
                if let Trust::Outside(why) = trust {
                    warnings.push(why.to_string());
                }
                if let Some(ErrorEstimate { h_c, h_min, traction, .. }) = solved.error {
                    bounds =
                        [Some(h_c), Some(h_min), traction].map(|error| error.map_or(f64::NAN, |error| error.bound));
                }
                let traction = solved.traction.unwrap_or_else(|| solution.traction_coefficient());
                (solution, traction)
            }
            None => {
                let solution = self.in_full(&point)?;
                let traction = solution.traction_coefficient();
                (solution, traction)
            }
        };
        let (scalars, scale) = (solution.scalars, point.film_scale_m());
        warnings.extend(resolution_warning(&solution));
        let hertz_pressure_pa = point.hertz().pressure_pa;
        if hertz_pressure_pa > PLAUSIBLE_HERTZ_PRESSURE_PA {
            let pressure = hertz_pressure_pa / 1e9;
            warnings.push(format!("the Hertzian pressure of {pressure:.3} GPa exceeds 3.2 GPa: no real contact"));
        }
        warnings.extend(problem.doubts_traction(friction_coefficient, &scalars).map(|doubt| doubt.to_string()));
        let line = point.kind == ContactKind::Line;
        Ok(Outputs {
            load,
            approach_m: if line { f64::NAN } else { -scalars.h_0 * scale },
            h_c_m: scalars.h_c * scale,
            h_min_m: scalars.h_min * scale,
            friction_coefficient,
            friction_force: friction_coefficient * load,
            hertz_pressure_pa,
            error_bounds: bounds,
            trained,
            full,
            warnings,
        })
    }

    /// The contact that inputs describe under a load.
    fn point(&self, inputs: &Inputs, load: f64) -> Result<OperatingPoint, String> {
        let kind = self.model.contact();
        let quantities = [
            inputs.radius_m,
            inputs.speed_m_per_s,
            load,
            inputs.modulus_pa,
            inputs.viscosity_pa_s,
            self.lubricant.own_coefficient().unwrap_or(inputs.alpha_per_pa),
        ];
        let sliding = Sliding { slide_to_roll_ratio: inputs.slide_to_roll_ratio, newtonian_plateau_ratio: None };
        let mut point = OperatingPoint::from_quantities(kind, quantities, sliding);
        if kind == ContactKind::Point && inputs.radius_ratio != 1.0 {
            point.radius_y_m = Some(inputs.radius_m * inputs.radius_ratio);
        }
        let srr = inputs.slide_to_roll_ratio;
        if !(srr.is_finite() && srr.abs() <= 10.0) {
            return Err(format!(
                "the slide-to-roll ratio is {}, but must be a finite number between -10 and 10",
                Number(srr)
            ));
        }
        point.check().map_err(|error| error.to_string())?;
        Ok(point)
    }

    /// The full solution on the model's grid.
    fn in_full(&mut self, point: &OperatingPoint) -> Result<Solution, String> {
        let grid = &self.model.window_at(point).grid;
        let solver = match self.full.take() {
            Some(solver) if solver.grid_spec() == grid.spec() => solver,
            _ => ContactSolver::on(grid),
        };
        let solver = self.full.insert(solver);
        let solution = solver.solve(point, self.lubricant, Start::Cold, &()).map_err(|error| error.to_string())?;
        if solution.converged() {
            return Ok(solution);
        }
        Err(format!(
            "neither the reduced model nor the full solver has a solution here: the full solver {}",
            solution.report.termination.describe()
        ))
    }

    /// The outputs at the wanted approach: the load is sought between two that give a smaller and a larger one.
    fn approached(&mut self, inputs: &Inputs) -> Result<Outputs, String> {
        let wanted = inputs.approach_m;
        if !(wanted.is_finite() && wanted > 0.0) {
            return Err(format!("the approach is {} m, but must be a finite number above zero", Number(wanted)));
        }
        let mut solves = 0;
        let mut miss = |own: &mut Self, load: f64| {
            solves += 1;
            if solves > MOST_SOLVES {
                return Err(format!("no load was found that gives an approach of {} m", Number(wanted)));
            }
            let outputs = own.under(inputs, load)?;
            Ok((load.ln(), outputs.approach_m / wanted - 1.0, outputs))
        };
        let first = miss(self, inputs.load)?;
        if first.1 == 0.0 {
            return Ok(first.2);
        }
        let factor = if first.1 < 0.0 { WIDER } else { 1.0 / WIDER };
        let mut near = first;
        let mut far = miss(self, near.0.exp() * factor)?;
        while far.1 * near.1 > 0.0 {
            near = far;
            far = miss(self, near.0.exp() * factor)?;
        }
        // Regula falsi in its Illinois form: an end that stays twice counts half.
        let (mut a, mut b) = ((near.0, near.1), (far.0, far.1));
        let mut best = if near.1.abs() < far.1.abs() { near } else { far };
        while (b.0 - a.0).abs() > LOAD_FOUND && best.1.abs() > LOAD_FOUND {
            let between = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
            let next = miss(self, between.exp())?;
            let place = (next.0, next.1);
            if next.1.abs() < best.1.abs() {
                best = next;
            } else if place.0 == b.0 || place.0 == a.0 {
                break;
            }
            if place.1 * b.1 < 0.0 {
                a = b;
            } else {
                a.1 *= 0.5;
            }
            b = place;
        }
        Ok(best.2)
    }
}
