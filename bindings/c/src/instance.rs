//! Instance of a Functional Mock-up Unit (FMU) of one contact. It stores the inputs and computes outputs, steps and
//! derivatives by the reduced model in the resources of the unit.

use crate::border::Refused;
use crate::log::{Log, OK, WARNING};
use crate::state::{Kept, State};
use ehl_explorer::engine::SavedModel;
use ehl_explorer::engine::coupled::fmu::{
    MODEL, Output, REALS, Real, Role, TRUTHS, first_inputs, identity, pressed_of,
};
use ehl_explorer::engine::coupled::{Coupled, Derivative, InTime, Inputs, Outputs, Pressed};
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::reduced::transient::TrajectoryModel;
use std::ffi::{c_int, c_uint};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Solver of the contact.
enum Contact {
    /// Steady contact, solved independently at each step.
    Stationary(Box<Coupled>),
    /// Transient contact, advanced by each step.
    InTime(Box<InTime>),
}

/// Accepted difference between the start of a step and the current time: first number times the step size plus second
/// number times the start of the step.
const ROUNDING: (f64, f64) = (1e-6, 1e-12);

/// Value of [`Instance::warned`] before the first outputs.
const NOT_WARNED: (bool, usize) = (false, 0);

/// Unit: the solver of its contact, and its variables.
pub struct Unit {
    contact: Contact,
    /// Causality of each real variable, by value reference; `None` for variables that the unit does not have.
    roles: Vec<Option<Role>>,
    /// Start values of the inputs.
    first: Inputs,
}

impl Unit {
    /// Loads a unit from the folder of its resources. `identity` is the GUID in its model description.
    ///
    /// # Errors
    /// If the model cannot be read, has another identity, or is refused.
    pub fn of(identity: Option<&str>, resources: &Path) -> Result<Self, Refused> {
        let path = resources.join(MODEL.trim_start_matches("resources/"));
        let bytes = std::fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let pressed = identity.and_then(|identity| pressed_of(identity, &bytes)).ok_or_else(|| {
            format!("{} is not the model that this unit was made of; export it again", path.display())
        })?;
        let model = shared(&bytes)?;
        let first = first_inputs(&model, pressed)?;
        let roles = REALS.iter().map(|real| real.role(&model, pressed)).collect();
        let contact = match model {
            SavedModel::Stationary(model) => Contact::Stationary(Box::new(Coupled::new(model, pressed)?)),
            SavedModel::InTime(model) => Contact::InTime(Box::new(InTime::new(model))),
        };
        Ok(Self { contact, roles, first })
    }
}

/// Instance of a unit.
pub struct Instance {
    pub log: Log,
    unit: Unit,
    pub state: State,
    /// For the last outputs: true if the full solver was used, and the number of warnings. Warnings are logged only if
    /// these two have changed.
    warned: (bool, usize),
}

/// Weak reference to a model that instances share. The model is freed with the last of them.
enum SharedModel {
    Stationary(Weak<ReducedModel>),
    InTime(Weak<TrajectoryModel>),
}

impl SharedModel {
    fn upgrade(&self) -> Option<SavedModel> {
        match self {
            Self::Stationary(model) => model.upgrade().map(SavedModel::Stationary),
            Self::InTime(model) => model.upgrade().map(SavedModel::InTime),
        }
    }
}

/// Shared models. Each has the identity of its unit with the load as input.
static MODELS: Mutex<Vec<(String, SharedModel)>> = Mutex::new(Vec::new());

/// Decodes a model, or returns the one that another instance already uses.
fn shared(bytes: &[u8]) -> Result<SavedModel, Refused> {
    let name = identity(bytes, Pressed::Load);
    let mut models = MODELS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(model) = models.iter().find(|(own, _)| *own == name).and_then(|(_, model)| model.upgrade()) {
        return Ok(model);
    }
    let model = SavedModel::from_bytes(bytes)?;
    let weak = match &model {
        SavedModel::Stationary(model) => SharedModel::Stationary(Arc::downgrade(model)),
        SavedModel::InTime(model) => SharedModel::InTime(Arc::downgrade(model)),
    };
    models.retain(|(_, model)| model.upgrade().is_some());
    models.push((name, weak));
    Ok(model)
}

impl Instance {
    /// Returns an instance before its initialisation.
    pub fn new(log: Log, unit: Unit) -> Self {
        Self { log, state: State::first(unit.first), unit, warned: NOT_WARNED }
    }

    /// Returns to the state before the initialisation.
    pub fn reset(&mut self) {
        self.state = State::first(self.unit.first);
        self.warned = NOT_WARNED;
        if let Contact::InTime(contact) = &mut self.unit.contact {
            contact.reset();
        }
    }

    /// Returns true for a transient contact.
    pub fn in_time(&self) -> bool {
        matches!(self.unit.contact, Contact::InTime(_))
    }

    /// Ends the initialisation. Computes the outputs and returns the status of [`Self::follow`].
    pub fn exit_initialisation(&mut self) -> Result<c_int, Refused> {
        let status = self.follow()?;
        self.state.stepping = true;
        Ok(status)
    }

    /// Computes the outputs if the stored ones are out of date. Returns [`WARNING`] if they have warnings, else [`OK`].
    pub fn follow(&mut self) -> Result<c_int, Refused> {
        if self.state.outputs.is_none() {
            let inputs = &self.state.inputs;
            let outputs = match &mut self.unit.contact {
                Contact::Stationary(contact) => {
                    let outputs = contact.solve(inputs)?.of_training()?;
                    // The load found is the start value of the next search.
                    self.state.inputs.load = outputs.load;
                    outputs
                }
                Contact::InTime(contact) if self.state.stepping && contact.has_begun() => contact.outputs(inputs)?,
                Contact::InTime(contact) => contact.begin(inputs)?,
            };
            self.take(outputs);
        }
        let warned = self.state.outputs.as_ref().is_some_and(|outputs| !outputs.warnings.is_empty());
        Ok(if warned { WARNING } else { OK })
    }

    /// Stores outputs. Logs their warnings if these have changed, see `warned`.
    fn take(&mut self, outputs: Outputs) {
        let now = (outputs.full, outputs.warnings.len());
        let is_new = now != self.warned && !outputs.warnings.is_empty();
        let sentence = format!("at time {}: {}", self.state.time, outputs.warning());
        self.warned = now;
        self.state.outputs = Some(outputs);
        if is_new {
            self.log.say(WARNING, &sentence);
        }
    }

    /// Takes a step from `time` to `time + step` \[s\]. For a transient contact, the inputs hold at the end of the
    /// step.
    pub fn step(&mut self, time: f64, step: f64) -> Result<c_int, Refused> {
        if !(time.is_finite() && step.is_finite() && step >= 0.0) {
            return Err(format!("a step of {step} at time {time} cannot be taken").into());
        }
        let Contact::InTime(contact) = &mut self.unit.contact else {
            self.state.time = time + step;
            return self.follow();
        };
        let (present, room) = (self.state.time, ROUNDING.0 * step + ROUNDING.1 * time.abs());
        if (time - present).abs() > room {
            return Err(
                format!("a transient contact continues from its present time {present}, not from {time}").into()
            );
        }
        if !contact.has_begun() {
            contact.begin(&self.state.inputs)?;
        }
        self.state.stepping = true;
        if step > 0.0 {
            let outputs = contact.advance(step, &self.state.inputs)?;
            self.state.time = time + step;
            self.take(outputs);
        }
        self.follow()
    }

    /// Returns the state to save.
    pub fn kept(&self) -> Kept {
        let contact = match &self.unit.contact {
            Contact::Stationary(_) => None,
            Contact::InTime(contact) => contact.state(),
        };
        Kept { state: self.state.clone(), contact }
    }

    /// Restores a saved state.
    pub fn come_back(&mut self, kept: &Kept) -> Result<(), Refused> {
        match (&mut self.unit.contact, &kept.contact) {
            (Contact::Stationary(_), None) => {}
            (Contact::InTime(contact), Some(state)) => contact.restore(state)?,
            (Contact::InTime(contact), None) => contact.reset(),
            (Contact::Stationary(_), Some(_)) => return Err("this is not a state of this unit".into()),
        }
        self.state = kept.state.clone();
        Ok(())
    }

    /// Returns the value of a real variable. Computes the outputs first if it needs them.
    pub fn real(&mut self, reference: c_uint) -> Result<f64, Refused> {
        let (real, role) = self.variable(reference)?;
        if let Some(value) = real.value(role, &self.state.inputs, self.state.outputs.as_ref()) {
            return Ok(value);
        }
        self.follow()?;
        Ok(real.value(role, &self.state.inputs, self.state.outputs.as_ref()).unwrap_or(f64::NAN))
    }

    /// Returns a real variable of this unit and its causality.
    fn variable(&self, reference: c_uint) -> Result<(&'static Real, Role), Refused> {
        let (place, none) = (reference as usize, || format!("there is no real variable {reference}"));
        let role = self.unit.roles.get(place).copied().flatten().ok_or_else(none)?;
        Ok((REALS.get(place).ok_or_else(none)?, role))
    }

    /// Sets a real variable.
    pub fn set_real(&mut self, reference: c_uint, value: f64) -> Result<(), Refused> {
        let mut inputs = self.state.inputs;
        let (real, role) = self.variable(reference)?;
        real.set(role, &mut inputs, value)?;
        if inputs != self.state.inputs {
            self.state.inputs = inputs;
            // The outputs of a transient contact at the end of a step do not depend on inputs that are set later.
            if !(self.state.stepping && self.in_time()) {
                self.state.outputs = None;
            }
        }
        Ok(())
    }

    /// Returns the value of a boolean variable. `reference` is its value reference in FMI 2.
    pub fn truth(&mut self, reference: usize) -> Result<bool, Refused> {
        self.follow()?;
        let (_, _, get) = TRUTHS.get(reference).ok_or_else(|| format!("there is no Boolean variable {reference}"))?;
        Ok(self.state.outputs.as_ref().is_some_and(get))
    }

    /// Computes Σ seed · ∂unknown/∂known over the knowns, for each unknown. `seed` has one value per known,
    /// `sensitivity` one per unknown. Unknowns are outputs; knowns are inputs and parameters.
    pub fn directional(
        &mut self,
        (unknowns, knowns): (&[c_uint], &[c_uint]),
        seed: &[f64],
        sensitivity: &mut [f64],
    ) -> Result<(), Refused> {
        check_lengths("known", knowns, seed)?;
        check_lengths("unknown", unknowns, sensitivity)?;
        let outputs = self.unknowns(unknowns)?;
        let mut sums = vec![0.0; outputs.len()];
        for (known, seed) in knowns.iter().zip(seed).filter(|(_, seed)| **seed != 0.0) {
            let derivative = self.derivative(*known)?;
            sums.iter_mut().zip(&outputs).for_each(|(sum, output)| *sum += seed * derivative.of(output));
        }
        sensitivity.copy_from_slice(&sums);
        Ok(())
    }

    /// Computes Σ seed · ∂unknown/∂known over the unknowns, for each known. `seed` has one value per unknown,
    /// `sensitivity` one per known.
    pub fn adjoint(
        &mut self,
        (unknowns, knowns): (&[c_uint], &[c_uint]),
        seed: &[f64],
        sensitivity: &mut [f64],
    ) -> Result<(), Refused> {
        check_lengths("unknown", unknowns, seed)?;
        check_lengths("known", knowns, sensitivity)?;
        let outputs = self.unknowns(unknowns)?;
        let mut sums = Vec::new();
        for known in knowns {
            let derivative = self.derivative(*known)?;
            let parts = outputs.iter().zip(seed).filter(|(_, seed)| **seed != 0.0);
            sums.push(parts.map(|(output, seed)| seed * derivative.of(output)).sum::<f64>());
        }
        sensitivity.copy_from_slice(&sums);
        Ok(())
    }

    /// Returns one function per output, which reads its value. Refuses variables that are not outputs.
    fn unknowns(&self, references: &[c_uint]) -> Result<Vec<Output>, Refused> {
        let output = |reference: &c_uint| {
            let (real, role) = self.variable(*reference)?;
            Ok(real
                .output(role)
                .ok_or_else(|| format!("`{}` is no output; derivatives are those of outputs", real.name))?)
        };
        references.iter().map(output).collect()
    }

    /// Returns the derivative of all outputs by an input or a parameter.
    fn derivative(&mut self, known: c_uint) -> Result<Derivative, Refused> {
        let (real, role) = self.variable(known)?;
        let by = real
            .input(role)
            .ok_or_else(|| format!("`{}` is an output; derivatives are those by inputs and parameters", real.name))?;
        self.follow()?;
        match (&mut self.unit.contact, &self.state.outputs) {
            (Contact::Stationary(contact), Some(outputs)) => Ok(contact.derivative(&self.state.inputs, outputs, by)?),
            _ => Err("a transient unit provides no derivatives".into()),
        }
    }
}

/// Refuses lists of different length. `what` names the variables in the message.
fn check_lengths(what: &str, variables: &[c_uint], values: &[f64]) -> Result<(), Refused> {
    let (variables, values) = (variables.len(), values.len());
    if variables == values {
        return Ok(());
    }
    Err(format!("there are {variables} {what}s, but {values} values for them").into())
}
