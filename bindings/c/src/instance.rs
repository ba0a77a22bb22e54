//! Instance of a unit: inputs, outputs, and states that can be saved.

use crate::border::Refused;
use ehl_explorer::engine::SavedModel;
use ehl_explorer::engine::coupled::fmu::{REALS, Real, Role, TRUTHS, Truth, identity};
use ehl_explorer::engine::coupled::{Coupled, InTime, InTimeState, Inputs, Outputs, Pressed};
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::reduced::transient::TrajectoryModel;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// `fmi2OK`.
pub const OK: c_int = 0;
/// `fmi2Warning`.
pub const WARNING: c_int = 1;
/// `fmi2Discard`.
pub const DISCARD: c_int = 2;
/// `fmi2Error`.
pub const ERROR: c_int = 3;

/// `fmi2CallbackLogger`.
pub type Logger = unsafe extern "C" fn(
    *mut c_void,
    *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
    ...
);

/// `fmi2CallbackFunctions`.
#[repr(C)]
pub struct FmiCallbacks {
    pub logger: Option<Logger>,
    allocate_memory: *const c_void,
    free_memory: *const c_void,
    step_finished: *const c_void,
    pub environment: *mut c_void,
}

/// Changing data of an instance, except for the transient contact.
#[derive(Clone)]
pub struct State {
    pub time: f64,
    pub inputs: Inputs,
    /// Outputs for the inputs; `None` if the inputs have changed since. For a transient contact, the outputs at the end
    /// of the last step, also if inputs have been set since.
    pub outputs: Option<Outputs>,
    /// True after the initialisation. A transient contact then changes only by steps.
    pub stepping: bool,
}

/// Saved state of an instance.
pub struct Kept {
    state: State,
    /// State of a transient contact that has started.
    contact: Option<InTimeState>,
}

/// Solver of an instance.
pub enum Contact {
    /// Steady contact, solved independently at each step.
    Stationary(Box<Coupled>),
    /// Transient contact, advanced by each step.
    InTime(Box<InTime>),
}

/// Accepted difference between a communication point and the current time, relative to the step and to the time.
const ROUNDING: (f64, f64) = (1e-6, 1e-12);

/// Value of [`Instance::told`] for a contact without warnings.
pub const TOLD: (bool, usize) = (false, 0);

pub struct Instance {
    pub name: CString,
    pub logger: Option<Logger>,
    pub environment: *mut c_void,
    pub contact: Contact,
    /// Causality of each real variable; `None` for variables that the unit does not have.
    pub roles: Vec<Option<Role>>,
    pub first: Inputs,
    pub state: State,
    /// Use of the full solver and number of warnings in the last log message. A message is written only if they change.
    pub told: (bool, usize),
}

/// Model shared by instances, freed with the last of them.
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

/// Shared models, by the identity of their units.
static MODELS: Mutex<Vec<(String, SharedModel)>> = Mutex::new(Vec::new());

pub fn shared(bytes: &[u8]) -> Result<SavedModel, Refused> {
    let name = identity(bytes, Pressed::Load);
    let mut models = MODELS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(model) = models.iter().find(|(own, _)| *own == name).and_then(|(_, model)| model.upgrade()) {
        return Ok(model);
    }
    let model = SavedModel::from_bytes(bytes)?;
    let lent = match &model {
        SavedModel::Stationary(model) => SharedModel::Stationary(Arc::downgrade(model)),
        SavedModel::InTime(model) => SharedModel::InTime(Arc::downgrade(model)),
    };
    models.retain(|(_, model)| model.upgrade().is_some());
    models.push((name, lent));
    Ok(model)
}

/// Sends a message to the simulation's logger.
pub fn say(logger: Option<Logger>, environment: *mut c_void, name: &CString, status: c_int, sentence: &str) {
    let Some(logger) = logger else { return };
    let category = if status == WARNING { c"logStatusWarning" } else { c"logStatusError" };
    // The message is a `printf` format.
    let Ok(message) = CString::new(sentence.replace('%', "%%").replace('\0', " ")) else { return };
    // SAFETY: the logger and its environment come from the simulation; the strings end with zeros and outlive the call.
    unsafe { logger(environment, name.as_ptr(), status, category.as_ptr(), message.as_ptr()) };
}

impl Instance {
    pub fn in_time(&self) -> bool {
        matches!(self.contact, Contact::InTime(_))
    }

    pub fn say(&self, status: c_int, sentence: &str) -> c_int {
        say(self.logger, self.environment, &self.name, status, sentence);
        status
    }

    /// Computes the outputs if the inputs have changed. The status is "warning" if there are warnings.
    pub fn follow(&mut self) -> Result<c_int, Refused> {
        if self.state.outputs.is_none() {
            let inputs = &self.state.inputs;
            let outputs = match &mut self.contact {
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

    /// Stores outputs, and logs their warnings if they are new.
    fn take(&mut self, outputs: Outputs) {
        let now = (outputs.full, outputs.warnings.len());
        let news = now != self.told && !outputs.warnings.is_empty();
        let sentence = format!("at time {}: {}", self.state.time, outputs.warning());
        self.told = now;
        self.state.outputs = Some(outputs);
        if news {
            self.say(WARNING, &sentence);
        }
    }

    /// Takes a step. A transient contact advances to the inputs at the end of the step.
    pub fn step(&mut self, time: f64, step: f64) -> Result<c_int, Refused> {
        let Contact::InTime(contact) = &mut self.contact else {
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
        let contact = match &self.contact {
            Contact::Stationary(_) => None,
            Contact::InTime(contact) => contact.state(),
        };
        Kept { state: self.state.clone(), contact }
    }

    /// Restores a saved state.
    pub fn come_back(&mut self, kept: &Kept) -> Result<(), Refused> {
        match (&mut self.contact, &kept.contact) {
            (Contact::Stationary(_), None) => {}
            (Contact::InTime(contact), Some(state)) => contact.restore(state)?,
            (Contact::InTime(contact), None) => contact.reset(),
            (Contact::Stationary(_), Some(_)) => return Err("this is not a state of this unit".into()),
        }
        self.state = kept.state.clone();
        Ok(())
    }

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
        let role = self.roles.get(place).copied().flatten().ok_or_else(none)?;
        Ok((REALS.get(place).ok_or_else(none)?, role))
    }

    pub fn set_real(&mut self, reference: c_uint, value: f64) -> Result<(), Refused> {
        let mut inputs = self.state.inputs;
        let (real, role) = self.variable(reference)?;
        real.set(role, &mut inputs, value)?;
        if inputs != self.state.inputs {
            self.state.inputs = inputs;
            // Later inputs do not change the outputs of a transient contact at the end of a step.
            if !(self.state.stepping && matches!(self.contact, Contact::InTime(_))) {
                self.state.outputs = None;
            }
        }
        Ok(())
    }
}

pub fn truth(reference: c_uint) -> Result<&'static Truth, Refused> {
    TRUTHS.get(reference as usize).ok_or_else(|| format!("there is no Boolean variable {reference}").into())
}

/// Format identifiers at the beginning of a serialised state, for steady and transient contacts.
const FORMS: [&[u8; 8]; 2] = [b"EHLFMU01", b"EHLFMU02"];
/// Number of numbers in a serialised state: time and inputs. Outputs are computed from them. For a transient contact,
/// they are followed by the end-of-initialisation flag and the state of the contact, if it has started.
const NUMBERS: usize = 10;

impl Kept {
    pub fn written(&self, in_time: bool) -> Result<Vec<u8>, Refused> {
        let i = &self.state.inputs;
        let numbers: [f64; NUMBERS] = [
            self.state.time,
            i.radius_m,
            i.radius_ratio,
            i.speed_m_per_s,
            i.slide_to_roll_ratio,
            i.load,
            i.approach_m,
            i.modulus_pa,
            i.viscosity_pa_s,
            i.alpha_per_pa,
        ];
        let form = FORMS[usize::from(in_time)];
        let mut written: Vec<u8> = form.iter().copied().chain(numbers.into_iter().flat_map(f64::to_le_bytes)).collect();
        if in_time {
            written.push(u8::from(self.state.stepping));
            if let Some(contact) = &self.contact {
                written.extend(contact.to_bytes()?);
            }
        }
        Ok(written)
    }

    pub fn read(bytes: &[u8], in_time: bool) -> Result<Self, Refused> {
        let none = "this is not a state of this unit";
        let (body, rest) = bytes
            .strip_prefix(FORMS[usize::from(in_time)])
            .and_then(|body| body.split_at_checked(8 * NUMBERS))
            .ok_or(none)?;
        let (stepping, contact) = match (rest.split_first(), in_time) {
            (None, false) => (true, None),
            (Some((stepping, [])), true) => (*stepping != 0, None),
            (Some((stepping, contact)), true) => (*stepping != 0, Some(InTimeState::from_bytes(contact)?)),
            _ => return Err(none.into()),
        };
        let mut numbers = [0.0; NUMBERS];
        for (number, bytes) in numbers.iter_mut().zip(body.as_chunks().0) {
            *number = f64::from_le_bytes(*bytes);
        }
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err("the state holds a number that is not finite".into());
        }
        let [
            time,
            radius_m,
            radius_ratio,
            speed_m_per_s,
            slide_to_roll_ratio,
            load,
            approach_m,
            modulus_pa,
            viscosity_pa_s,
            alpha_per_pa,
        ] = numbers;
        let inputs = Inputs {
            radius_m,
            radius_ratio,
            speed_m_per_s,
            slide_to_roll_ratio,
            load,
            approach_m,
            modulus_pa,
            viscosity_pa_s,
            alpha_per_pa,
        };
        Ok(Self { state: State { time, inputs, outputs: None, stepping }, contact })
    }
}
