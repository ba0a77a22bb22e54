//! Functions of FMI 2.0 for co-simulation. The standard defines their names and behaviour.
//!
//! An instance stores the inputs and the outputs of the last evaluation. [`State`] is its complete state, except for
//! the model, which instances share, and for a transient contact. [`Kept`] includes the latter.

#![allow(non_snake_case, reason = "the names are the standard's")]
#![allow(clippy::missing_safety_doc, reason = "what a caller promises is in the standard, the same for all of them")]
#![allow(missing_docs, reason = "the standard documents them")]

use crate::border::{Refused, guarded, text_of};
use crate::instance::{Contact, DISCARD, ERROR, FmiCallbacks, Instance, Kept, OK, State, TOLD, say, shared, truth};
use ehl_explorer::engine::SavedModel;
use ehl_explorer::engine::coupled::fmu::{IDENTIFIER, MODEL, REALS, first_inputs, pressed_of};
use ehl_explorer::engine::coupled::{Coupled, InTime};
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::path::PathBuf;

/// `fmi2CoSimulation`.
const CO_SIMULATION: c_int = 1;

/// Returns the folder that a file URI refers to.
fn folder_of(uri: &str) -> Option<PathBuf> {
    let path = uri.strip_prefix("file:").unwrap_or(uri);
    let path = match path.strip_prefix("//") {
        // The path follows a host name, which is usually empty.
        Some(rest) => rest.get(rest.find('/')?..)?,
        None => path,
    };
    let mut bytes = Vec::new();
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => {
                let digits = [rest.next()?, rest.next()?];
                u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?
            }
            byte => byte,
        });
    }
    let path = String::from_utf8(bytes).ok()?;
    // Windows: `/C:/…`.
    let drive = path.strip_prefix('/').filter(|path| path.as_bytes().get(1) == Some(&b':')).map(str::to_owned);
    Some(PathBuf::from(drive.unwrap_or(path)))
}

/// Calls a function with an instance. An error is logged, the instance is restored, and the status is "discard".
unsafe fn with(component: *mut c_void, work: impl FnOnce(&mut Instance) -> Result<c_int, Refused>) -> c_int {
    // SAFETY: a component is null or was made by `fmi2Instantiate`, and is used by one thread at a time.
    let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else { return ERROR };
    let before = instance.state.clone();
    match guarded(|| work(instance)) {
        Ok(status) => status,
        Err(Refused(sentence)) => {
            instance.state = before;
            instance.say(DISCARD, &sentence)
        }
    }
}

/// Returns values passed by the simulation; empty if the pointer is null.
unsafe fn slice<'a, T>(pointer: *const T, length: usize) -> &'a [T] {
    if pointer.is_null() {
        return &[];
    }
    // SAFETY: guaranteed by the simulation.
    unsafe { std::slice::from_raw_parts(pointer, length) }
}

/// Returns the output values of the simulation; empty if the pointer is null.
unsafe fn slice_mut<'a, T>(pointer: *mut T, length: usize) -> &'a mut [T] {
    if pointer.is_null() {
        return &mut [];
    }
    // SAFETY: guaranteed by the simulation.
    unsafe { std::slice::from_raw_parts_mut(pointer, length) }
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    component: *mut c_void,
    _on: c_int,
    _categories: usize,
    _names: *const *const c_char,
) -> c_int {
    // Warnings and errors are always logged; there are no other messages.
    unsafe { with(component, |_| Ok(OK)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    callbacks: *const FmiCallbacks,
    _visible: c_int,
    _logging: c_int,
) -> *mut c_void {
    // SAFETY: strings and callbacks belong to the simulation and are used only within this call.
    let (name, guid, resources, callbacks) =
        unsafe { (text_of(name), text_of(guid), text_of(resources), callbacks.as_ref()) };
    let name = CString::new(name.unwrap_or(IDENTIFIER)).unwrap_or_default();
    let (logger, environment) =
        callbacks.map_or((None, std::ptr::null_mut()), |callbacks| (callbacks.logger, callbacks.environment));
    let made = guarded(|| {
        if kind != CO_SIMULATION {
            return Err("this unit is for co-simulation only".into());
        }
        let folder = resources.and_then(folder_of).ok_or("the location of the resources is not a file URI")?;
        let path = folder.join(MODEL.trim_start_matches("resources/"));
        let bytes = std::fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let pressed = guid.and_then(|guid| pressed_of(guid, &bytes)).ok_or_else(|| {
            format!("{} is not the model that this unit was made of; export it again", path.display())
        })?;
        let model = shared(&bytes)?;
        let first = first_inputs(&model, pressed)?;
        let roles = REALS.iter().map(|real| real.role(&model, pressed)).collect();
        let contact = match model {
            SavedModel::Stationary(model) => Contact::Stationary(Box::new(Coupled::new(model, pressed)?)),
            SavedModel::InTime(model) => Contact::InTime(Box::new(InTime::new(model))),
        };
        Ok((contact, roles, first))
    });
    match made {
        Ok((contact, roles, first)) => {
            let state = State { time: 0.0, inputs: first, outputs: None, stepping: false };
            let instance = Instance { name, logger, environment, contact, roles, first, state, told: TOLD };
            Box::into_raw(Box::new(instance)).cast()
        }
        Err(Refused(sentence)) => {
            say(logger, environment, &name, ERROR, &sentence);
            std::ptr::null_mut()
        }
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: *mut c_void) {
    if !component.is_null() {
        // SAFETY: `fmi2Instantiate` made it, and it is not used any more.
        drop(unsafe { Box::from_raw(component.cast::<Instance>()) });
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: *mut c_void,
    _tolerance_defined: c_int,
    _tolerance: f64,
    start: f64,
    _stop_defined: c_int,
    _stop: f64,
) -> c_int {
    unsafe {
        with(component, |instance| {
            instance.state.time = start;
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(component: *mut c_void) -> c_int {
    unsafe { with(component, |_| Ok(OK)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(component: *mut c_void) -> c_int {
    unsafe {
        with(component, |instance| {
            let status = instance.follow()?;
            instance.state.stepping = true;
            Ok(status)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(component: *mut c_void) -> c_int {
    unsafe { with(component, |_| Ok(OK)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(component: *mut c_void) -> c_int {
    unsafe {
        with(component, |instance| {
            instance.state = State { time: 0.0, inputs: instance.first, outputs: None, stepping: false };
            instance.told = TOLD;
            if let Contact::InTime(contact) = &mut instance.contact {
                contact.reset();
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    component: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *mut f64,
) -> c_int {
    let (references, values) = unsafe { (slice(references, count), slice_mut(values, count)) };
    unsafe {
        with(component, |instance| {
            for (reference, value) in references.iter().zip(values) {
                *value = instance.real(*reference)?;
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    component: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *const f64,
) -> c_int {
    let (references, values) = unsafe { (slice(references, count), slice(values, count)) };
    unsafe {
        with(component, |instance| {
            references.iter().zip(values).try_for_each(|(reference, value)| instance.set_real(*reference, *value))?;
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    component: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *mut c_int,
) -> c_int {
    let (references, values) = unsafe { (slice(references, count), slice_mut(values, count)) };
    unsafe {
        with(component, |instance| {
            instance.follow()?;
            for (reference, value) in references.iter().zip(values) {
                let (_, _, get) = truth(*reference)?;
                *value = c_int::from(instance.state.outputs.as_ref().is_some_and(get));
            }
            Ok(OK)
        })
    }
}

/// Refuses access to variables of a type that the unit does not have.
unsafe fn none_of(component: *mut c_void, count: usize, what: &str) -> c_int {
    unsafe { with(component, |_| if count == 0 { Ok(OK) } else { Err(format!("there are no {what}").into()) }) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *const c_int,
) -> c_int {
    unsafe { none_of(component, count, "Boolean variables that can be set") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *mut c_int,
) -> c_int {
    unsafe { none_of(component, count, "integer variables") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *const c_int,
) -> c_int {
    unsafe { none_of(component, count, "integer variables") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *mut *const c_char,
) -> c_int {
    unsafe { none_of(component, count, "text variables") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *const *const c_char,
) -> c_int {
    unsafe { none_of(component, count, "text variables") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(component: *mut c_void, kept: *mut *mut c_void) -> c_int {
    unsafe {
        with(component, |instance| {
            // SAFETY: the location belongs to the simulation; a state in it was made here.
            let place = kept.as_mut().ok_or("the pointer for the state is null")?;
            match place.cast::<Kept>().as_mut() {
                Some(kept) => *kept = instance.kept(),
                None => *place = Box::into_raw(Box::new(instance.kept())).cast(),
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(component: *mut c_void, kept: *mut c_void) -> c_int {
    unsafe {
        with(component, |instance| {
            // SAFETY: a state is null or was made by `fmi2GetFMUstate`.
            instance.come_back(kept.cast::<Kept>().as_ref().ok_or("there is no state")?)?;
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: *mut c_void, kept: *mut *mut c_void) -> c_int {
    unsafe {
        with(component, |_| {
            // SAFETY: the location is null, empty, or holds a state made by `fmi2GetFMUstate`.
            if let Some(place) = kept.as_mut()
                && !place.is_null()
            {
                drop(Box::from_raw(place.cast::<Kept>()));
                *place = std::ptr::null_mut();
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    component: *mut c_void,
    kept: *mut c_void,
    size: *mut usize,
) -> c_int {
    unsafe {
        with(component, |instance| {
            // SAFETY: a state is null or was made by `fmi2GetFMUstate`; the location belongs to the simulation.
            let written = kept.cast::<Kept>().as_ref().ok_or("there is no state")?.written(instance.in_time())?;
            *size.as_mut().ok_or("there is no place for the size")? = written.len();
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: *mut c_void,
    kept: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> c_int {
    unsafe {
        with(component, |instance| {
            // SAFETY: a state is null or was made by `fmi2GetFMUstate`; the bytes belong to the simulation.
            let written = kept.cast::<Kept>().as_ref().ok_or("there is no state")?.written(instance.in_time())?;
            let place = slice_mut(bytes, size).get_mut(..written.len());
            place.ok_or("the buffer for the state is too small")?.copy_from_slice(&written);
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: *mut c_void,
    bytes: *const u8,
    size: usize,
    kept: *mut *mut c_void,
) -> c_int {
    unsafe {
        with(component, |instance| {
            let read = Kept::read(slice(bytes, size), instance.in_time())?;
            // SAFETY: the location belongs to the simulation.
            *kept.as_mut().ok_or("the pointer for the state is null")? = Box::into_raw(Box::new(read)).cast();
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    component: *mut c_void,
    _unknowns: *const c_uint,
    _unknown_count: usize,
    _knowns: *const c_uint,
    _known_count: usize,
    _known_changes: *const f64,
    _unknown_changes: *mut f64,
) -> c_int {
    unsafe { with(component, |_| Err("this unit provides no directional derivatives".into())) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _orders: *const c_int,
    _values: *const f64,
) -> c_int {
    unsafe { none_of(component, count, "inputs whose derivatives can be set") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    component: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _orders: *const c_int,
    _values: *mut f64,
) -> c_int {
    unsafe { none_of(component, count, "outputs whose derivatives are known") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(component: *mut c_void, time: f64, step: f64, _no_set_before: c_int) -> c_int {
    unsafe {
        with(component, |instance| {
            if !(time.is_finite() && step.is_finite() && step >= 0.0) {
                return Err(format!("a step of {step} at time {time} cannot be taken").into());
            }
            instance.step(time, step)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(component: *mut c_void) -> c_int {
    unsafe { with(component, |_| Err("no step is under way: each is done when it returns".into())) }
}

/// Refuses status requests, since no step is ever pending.
unsafe fn no_status(component: *mut c_void) -> c_int {
    unsafe { with(component, |_| Err("no step is under way".into())) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(component: *mut c_void, _kind: c_int, _value: *mut c_int) -> c_int {
    unsafe { no_status(component) }
}

/// `fmi2LastSuccessfulTime`.
const LAST_TIME: c_int = 2;

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(component: *mut c_void, kind: c_int, value: *mut f64) -> c_int {
    unsafe {
        with(component, |instance| match value.as_mut() {
            Some(value) if kind == LAST_TIME => {
                *value = instance.state.time;
                Ok(OK)
            }
            _ => Err("only the last successful time is known".into()),
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(component: *mut c_void, _kind: c_int, _value: *mut c_int) -> c_int {
    unsafe { no_status(component) }
}

/// `fmi2Terminated`.
const TERMINATED: c_int = 3;

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(component: *mut c_void, kind: c_int, value: *mut c_int) -> c_int {
    unsafe {
        with(component, |_| match value.as_mut() {
            // A discarded step does not end the simulation; other steps may follow.
            Some(value) if kind == TERMINATED => {
                *value = 0;
                Ok(OK)
            }
            _ => Err("only whether the simulation has to end is known".into()),
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    component: *mut c_void,
    _kind: c_int,
    _value: *mut *const c_char,
) -> c_int {
    unsafe { no_status(component) }
}
