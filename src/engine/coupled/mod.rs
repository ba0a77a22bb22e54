//! Contact in a co-simulation: one reduced model with inputs that change and outputs that follow.
//!
//! [`Coupled`] needs neither the embedded models nor a bench, so that a library with it stays small. Its results are
//! bitwise those of `solve --method reduced`. Each contact is solved from a cold start, so that a result depends only
//! on the inputs. [`InTime`] is the equivalent for transient models, whose state advances. [`fmu`] exports both as
//! Functional Mock-up Units.

mod approach;
mod derivative;
mod error;
pub mod fmu;
mod in_time;

pub use derivative::{Derivative, Input};
pub use error::CoupledError;
pub use in_time::{InTime, InTimeState};

use self::approach::Reach;
use self::derivative::Neighbourhood;
use self::error::{check, check_sliding};
use super::answer::{Solver, answer};
use crate::scene::{Answer, ContactResult, ContactSpec, Grid, Method, ModelSource, Request, Words};
use crate::solver::full::{ContactSolver, Problem, Start};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::engineering::Extent;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::Roughness;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use crate::solver::warning::Warning;
use std::f64::consts::PI;
use std::sync::Arc;

/// Input that presses the bodies together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// Load: \[N/m\] for a line contact, \[N\] for a point contact.
    Load,
    /// Approach of both bodies \[m\], see [`Outputs::approach_m`]; negative for separated bodies. The load is an output.
    Approach,
}

/// Inputs of a contact in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Reduced radius R \[m\].
    pub radius_m: f64,
    /// Radius ratio R_y/R of a point contact; 1 for a circular contact and a line contact.
    pub radius_ratio: f64,
    /// Mean entrainment speed u_m \[m/s\].
    pub speed_m_per_s: f64,
    /// Slide-to-roll ratio.
    pub slide_to_roll_ratio: f64,
    /// Load \[N/m\] or \[N\]. Not used if an approach is given.
    pub load: f64,
    /// Approach \[m\], if it is an input.
    pub approach_m: f64,
    /// Reduced modulus E′ \[Pa\].
    pub modulus_pa: f64,
    /// Viscosity at ambient pressure η₀ \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    pub alpha_per_pa: f64,
    /// Composite rms roughness σ \[m\]. Not used if the model is of smooth surfaces.
    pub roughness_m: f64,
}

/// Outputs of a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// Load \[N/m\] or \[N\].
    pub load: f64,
    /// Approach of both bodies \[m\]: change of the distance between points far from the contact since the undeformed
    /// bodies touched. In a line contact, the points are at the distance [`Outputs::approach_reference_m`].
    pub approach_m: f64,
    /// Reference distance for the approach of a line contact, its radius R \[m\]. NaN for a point contact, whose
    /// elastic deformation vanishes far from the contact.
    pub approach_reference_m: f64,
    /// Half width a of the dry contact \[m\].
    pub half_width_m: f64,
    /// Central film thickness h_c \[m\].
    pub h_c_m: f64,
    /// Minimum film thickness h_min \[m\].
    pub h_min_m: f64,
    /// Friction coefficient, positive for a positive slide-to-roll ratio.
    pub friction_coefficient: f64,
    /// Friction force: coefficient times load \[N/m\] or \[N\].
    pub friction_force: f64,
    /// Maximum Hertzian pressure \[Pa\].
    pub hertz_pressure_pa: f64,
    /// 99 % empirical bounds of the relative errors of h_c, h_min and friction; NaN if not available.
    pub error_bounds: [f64; 3],
    /// Ratio h_min/σ of the minimum film thickness to the roughness; NaN for smooth surfaces.
    pub film_ratio_min: f64,
    /// Share of the load that asperities carry, 0…1; NaN for smooth surfaces.
    pub asperity_load_share: f64,
    /// True if the contact is inside the trained range.
    pub trained: bool,
    /// True if the full solver was used because the model has no solution.
    pub full: bool,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

impl Outputs {
    /// Converts a result; `None` without a solution.
    fn of(result: ContactResult) -> Option<Self> {
        let ContactResult { point, scalars, traction, reduced, mixed, warnings, .. } = result;
        let (scalars, friction_coefficient, scale) = (scalars?, traction?, point.film_scale_m());
        let error = reduced.as_ref().and_then(|facts| facts.error);
        let bounds = error.map_or([None; 3], |error| [Some(error.h_c), Some(error.h_min), error.traction]);
        let half_width_m = point.hertz().half_width_m;
        Some(Self {
            load: point.load,
            approach_m: approach(&point, scalars.h_0 * scale, half_width_m),
            approach_reference_m: approach_reference(&point),
            half_width_m,
            h_c_m: scalars.h_c * scale,
            h_min_m: scalars.h_min * scale,
            friction_coefficient,
            friction_force: friction_coefficient * point.load,
            hertz_pressure_pa: point.hertz().pressure_pa,
            error_bounds: bounds.map(|error| error.map_or(f64::NAN, |error| error.bound)),
            film_ratio_min: mixed.map_or(f64::NAN, |mixed| mixed.film_ratio_min),
            asperity_load_share: mixed.map_or(f64::NAN, |mixed| mixed.asperity_load_share),
            trained: reduced.as_ref().is_some_and(|facts| facts.trained),
            full: reduced.is_none(),
            warnings,
        })
    }

    /// Returns the warnings as one sentence.
    pub fn warning(&self) -> String {
        Warning::joined(&self.warnings)
    }

    /// Refuses outputs of a contact outside the trained range.
    ///
    /// # Errors
    /// With the same reason as in other interfaces.
    pub fn of_training(self) -> Result<Self, CoupledError> {
        let is_outside = |warning: &&Warning| matches!(warning, Warning::OutsideTrainedRange { .. });
        let outside: Vec<Warning> = self.warnings.iter().filter(is_outside).cloned().collect();
        if outside.is_empty() { Ok(self) } else { Err(CoupledError::Untrained(outside)) }
    }
}

/// Returns the approach of both bodies \[m\] for a separation h₀ \[m\] of their rigid surfaces. It is zero if the
/// undeformed bodies touch.
///
/// The potential ln(|x − s|/d) of a line load contains a length d, on which h₀ depends. For h₀ it is `length_m`, such
/// as the half width of (2.27), which changes with the load. For the approach it is [`approach_reference`].
fn approach(point: &OperatingPoint, separation_m: f64, length_m: f64) -> f64 {
    let elastic = if point.kind.is_line() {
        4.0 * point.load / (PI * point.modulus_pa) * (length_m / approach_reference(point)).ln()
    } else {
        0.0
    };
    -separation_m - elastic
}

/// Returns the reference distance for the approach of a line contact: R \[m\], independent of the load.
fn approach_reference(point: &OperatingPoint) -> f64 {
    if point.kind.is_line() { point.radius_m } else { f64::NAN }
}

impl Inputs {
    /// All inputs zero.
    const NONE: Self = Self::from_numbers([0.0; Self::COUNT]);

    /// Number of inputs.
    pub const COUNT: usize = 10;

    /// Returns the inputs of a contact with smooth surfaces. Their approach is 0.
    fn of(point: &OperatingPoint) -> Self {
        Self {
            radius_m: point.radius_m,
            radius_ratio: point.radius_ratio(),
            speed_m_per_s: point.speed_m_per_s,
            slide_to_roll_ratio: point.sliding.slide_to_roll_ratio,
            load: point.load,
            approach_m: 0.0,
            modulus_pa: point.modulus_pa,
            viscosity_pa_s: point.viscosity_pa_s,
            alpha_per_pa: point.alpha_per_pa,
            roughness_m: 0.0,
        }
    }

    /// Returns all inputs in the order of their declaration.
    pub fn numbers(&self) -> [f64; Self::COUNT] {
        [
            self.radius_m,
            self.radius_ratio,
            self.speed_m_per_s,
            self.slide_to_roll_ratio,
            self.load,
            self.approach_m,
            self.modulus_pa,
            self.viscosity_pa_s,
            self.alpha_per_pa,
            self.roughness_m,
        ]
    }

    /// Returns the inputs with these [numbers](Self::numbers).
    pub const fn from_numbers(numbers: [f64; Self::COUNT]) -> Self {
        Self {
            radius_m: numbers[0],
            radius_ratio: numbers[1],
            speed_m_per_s: numbers[2],
            slide_to_roll_ratio: numbers[3],
            load: numbers[4],
            approach_m: numbers[5],
            modulus_pa: numbers[6],
            viscosity_pa_s: numbers[7],
            alpha_per_pa: numbers[8],
            roughness_m: numbers[9],
        }
    }

    /// Returns the contact that the inputs define under a load.
    fn stated(&self, kind: ContactKind, load: f64) -> ContactSpec {
        let ellipse = kind.is_point() && self.radius_ratio != 1.0;
        ContactSpec {
            contact: Some(kind),
            radius: Some(self.radius_m),
            radius_y: ellipse.then_some(self.radius_m * self.radius_ratio),
            speed: Some(self.speed_m_per_s),
            load: Some(load),
            modulus: Some(self.modulus_pa),
            viscosity: Some(self.viscosity_pa_s),
            alpha: Some(self.alpha_per_pa),
            srr: Some(self.slide_to_roll_ratio),
            ..ContactSpec::default()
        }
    }
}

/// Reduced model with work space. Use one per thread.
pub struct Coupled {
    model: Arc<ReducedModel>,
    online: Online,
    full: Option<ContactSolver>,
    lubricant: Lubricant,
    pressed: Pressed,
    /// Trained loads of the last inputs, if an approach is given.
    reach: Option<Reach>,
    neighbourhood: Neighbourhood,
}

impl Coupled {
    /// Returns a contact solved by a model, with the lubricant that the model was trained with.
    ///
    /// # Errors
    /// If the model contains no local model.
    pub fn new(model: Arc<ReducedModel>, pressed: Pressed) -> Result<Self, CoupledError> {
        if model.windows.is_empty() {
            return Err(CoupledError::NoWindow(model.title.clone()));
        }
        let online = Online::new(Arc::clone(&model), ReducedOptions::default());
        let lubricant = model.domain.lubricant;
        let (full, reach, neighbourhood) = (None, None, Neighbourhood::default());
        Ok(Self { model, online, full, lubricant, pressed, reach, neighbourhood })
    }

    /// Returns which input presses the bodies together.
    pub fn pressed(&self) -> Pressed {
        self.pressed
    }

    /// Returns inputs near the middle of the trained range, as start values of a simulation.
    pub fn first_inputs(model: &Arc<ReducedModel>) -> Option<Inputs> {
        let window = model.windows.get(model.windows.len() / 2)?;
        let points = || window.snapshots.iter().map(|snapshot| snapshot.point);
        // Some models have snapshots slightly outside their declared range.
        let inside = |point: &OperatingPoint| {
            let problem = Problem::new(point, model.domain.lubricant);
            problem.is_ok_and(|problem| model.trust(&problem) == Trust::Trained)
        };
        let middle = window.snapshots.len() / 2;
        let point = points().skip(middle).chain(points()).find(inside).or_else(|| points().next())?;
        let mut own = Self::new(Arc::clone(model), Pressed::Load).ok()?;
        let inputs = Inputs {
            alpha_per_pa: own.lubricant.own_coefficient().unwrap_or(point.alpha_per_pa),
            roughness_m: own.lubricant.roughness.map_or(0.0, |rough| rough.sigma),
            ..Inputs::of(&point)
        };
        let approach_m = own.solve(&inputs).ok()?.approach_m;
        Some(Inputs { approach_m, ..inputs })
    }

    /// Returns the outputs for some inputs.
    ///
    /// # Errors
    /// If an input is out of range, or if neither the model nor the full solver has a solution.
    pub fn solve(&mut self, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        match self.pressed {
            Pressed::Load => self.under(inputs, inputs.load),
            Pressed::Approach => self.approached(inputs),
        }
    }

    /// Returns the outputs under a load.
    fn under(&mut self, inputs: &Inputs, load: f64) -> Result<Outputs, CoupledError> {
        let request = self.request(inputs, load)?;
        self.online.forget();
        let reduced = answer(&request, Solver::Reduced(&mut self.online), &())?;
        let answered = if reduced.result.converged { reduced } else { self.in_full(request)?.in_place_of(reduced) };
        let why = answered.result.warning();
        Outputs::of(answered.result).ok_or(CoupledError::NoSolution(why))
    }

    /// Returns the request for inputs under a load.
    fn request(&self, inputs: &Inputs, load: f64) -> Result<Request, CoupledError> {
        check_sliding(inputs.slide_to_roll_ratio)?;
        let lubricant = self.lubricant_of(inputs)?;
        let alpha = lubricant.own_coefficient().is_none().then_some(inputs.alpha_per_pa);
        let stated = ContactSpec { alpha, ..inputs.stated(self.model.contact(), load) };
        let point =
            stated.operating_point(&lubricant).map_err(|why| CoupledError::Stated(why.in_words(Words::Variables)))?;
        let (grid, grid_model, method) = (Grid::Model, ModelSource::Embedded, Method::EMBEDDED);
        Ok(Request { point, lubricant, grid, grid_model, method, extent: Extent::default() })
    }

    /// Returns the lubricant of the model between surfaces with the roughness of the inputs.
    fn lubricant_of(&self, inputs: &Inputs) -> Result<Lubricant, CoupledError> {
        let Some(trained) = self.lubricant.roughness else { return Ok(self.lubricant) };
        check(
            "roughness",
            inputs.roughness_m,
            " m",
            (" above zero and at most 0.001 m", |sigma| sigma > 0.0 && sigma <= 1e-3),
        )?;
        let roughness = Some(Roughness { sigma: inputs.roughness_m, ..trained });
        Ok(Lubricant { roughness, ..self.lubricant })
    }

    /// Solves in full on the model's grid.
    fn in_full(&mut self, request: Request) -> Result<Answer, CoupledError> {
        let grid = &self.model.window_at(&request.point).grid;
        let solver = match self.full.take() {
            Some(solver) if solver.grid_spec() == grid.spec() => solver,
            _ => ContactSolver::on(grid),
        };
        let solver = Solver::Full(self.full.insert(solver), Start::Cold);
        let request = Request { method: Method::Full, ..request };
        let full = answer(&request, solver, &())?;
        if full.result.converged {
            return Ok(full);
        }
        Err(CoupledError::NoSolution(full.result.warning()))
    }
}
