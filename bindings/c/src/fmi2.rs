//! Functions of FMI 2.0 for co-simulation. The standard defines their names and behaviour.
//!
//! What both versions of the standard have in common is in `component`, with what a simulation promises.

#![allow(non_snake_case, reason = "the names are the standard's")]
#![allow(clippy::missing_safety_doc, reason = "what a caller promises is in the standard, the same for all of them")]
#![allow(missing_docs, reason = "the standard documents them")]

use crate::border::{slice, slice_mut, text_of};
use crate::component::{
    accept, exit_initialisation, free, free_state, get_state, instantiate, none_of, read_state, refuse, reset,
    set_reals, set_start, set_state, state_size, with, write_state,
};
use crate::log::{Log, Logger, Logger2, OK};
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::PathBuf;

/// `fmi2CoSimulation`.
const CO_SIMULATION: c_int = 1;

/// `fmi2CallbackFunctions`.
#[repr(C)]
pub struct FmiCallbacks {
    logger: Option<Logger2>,
    allocate_memory: *const c_void,
    free_memory: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

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
    unsafe { accept(component) }
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
    let (guid, resources, callbacks) = unsafe { (text_of(guid), text_of(resources), callbacks.as_ref()) };
    let (logger, environment) =
        callbacks.map_or((None, std::ptr::null_mut()), |callbacks| (callbacks.logger, callbacks.environment));
    // SAFETY: as above.
    let log = unsafe { Log::new(name, logger.map(Logger::Two), environment) };
    instantiate(log, guid, || {
        if kind != CO_SIMULATION {
            return Err("this unit is for co-simulation only".into());
        }
        Ok(resources.and_then(folder_of).ok_or("the location of the resources is not a file URI")?)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: *mut c_void) {
    unsafe { free(component) }
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
    unsafe { set_start(component, start) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(component: *mut c_void) -> c_int {
    unsafe { accept(component) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(component: *mut c_void) -> c_int {
    unsafe { exit_initialisation(component) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(component: *mut c_void) -> c_int {
    unsafe { accept(component) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(component: *mut c_void) -> c_int {
    unsafe { reset(component) }
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
    unsafe { set_reals(component, slice(references, count), slice(values, count)) }
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
            for (reference, value) in references.iter().zip(values) {
                *value = c_int::from(instance.truth(*reference as usize)?);
            }
            Ok(OK)
        })
    }
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
    unsafe { get_state(component, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(component: *mut c_void, kept: *mut c_void) -> c_int {
    unsafe { set_state(component, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: *mut c_void, kept: *mut *mut c_void) -> c_int {
    unsafe { free_state(component, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    component: *mut c_void,
    kept: *mut c_void,
    size: *mut usize,
) -> c_int {
    unsafe { state_size(component, kept, size) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: *mut c_void,
    kept: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> c_int {
    unsafe { write_state(component, kept, bytes, size) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: *mut c_void,
    bytes: *const u8,
    size: usize,
    kept: *mut *mut c_void,
) -> c_int {
    unsafe { read_state(component, bytes, size, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    component: *mut c_void,
    unknowns: *const c_uint,
    unknown_count: usize,
    knowns: *const c_uint,
    known_count: usize,
    known_changes: *const f64,
    unknown_changes: *mut f64,
) -> c_int {
    unsafe {
        let (unknowns, knowns) = (slice(unknowns, unknown_count), slice(knowns, known_count));
        let (seed, sensitivity) = (slice(known_changes, known_count), slice_mut(unknown_changes, unknown_count));
        with(component, |instance| {
            instance.directional((unknowns, knowns), seed, sensitivity)?;
            Ok(OK)
        })
    }
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
    unsafe { with(component, |instance| instance.step(time, step)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(component: *mut c_void) -> c_int {
    unsafe { refuse(component, "no step is under way: each is done when it returns") }
}

/// Refuses status requests, since no step is ever pending.
unsafe fn no_status(component: *mut c_void) -> c_int {
    unsafe { refuse(component, "no step is under way") }
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
