//! Functions of FMI 3.0 for co-simulation. The standard defines their names and behaviour.
//!
//! What both versions of the standard have in common is in `component`, with what a simulation promises. `absent` has
//! the functions for types that units do not have, `other_kinds` those for model exchange, scheduled execution, clocks
//! and events.

#![allow(non_snake_case, reason = "the names are the standard's")]
#![allow(clippy::missing_safety_doc, reason = "what a caller promises is in the standard, the same for all of them")]
#![allow(missing_docs, reason = "the standard documents them")]

mod absent;
mod other_kinds;

use crate::border::{Refused, slice, slice_mut, text_of};
use crate::component::{
    accept, exit_initialisation, free, free_state, get_state, instantiate, read_state, refuse, reset, set_reals,
    set_start, set_state, state_size, with, write_state,
};
use crate::instance::Instance;
use crate::log::{Log, Logger, Logger3, OK};
use ehl_explorer::engine::coupled::fmu::{FIRST_TRUTH, TIME};
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::PathBuf;

#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: *mut c_void,
    _on: bool,
    _count: usize,
    _categories: *const *const c_char,
) -> c_int {
    // Warnings and errors are always logged; there are no other messages.
    unsafe { accept(instance) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    event_mode: bool,
    _early_return: bool,
    _intermediate: *const c_uint,
    _intermediate_count: usize,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _intermediate_update: *const c_void,
) -> *mut c_void {
    // SAFETY: strings belong to the simulation and are used only within this call.
    let (log, token, resources) =
        unsafe { (Log::new(name, logger.map(Logger::Three), environment), text_of(token), text_of(resources)) };
    instantiate(log, token, || {
        if event_mode {
            return Err("this unit has no event mode".into());
        }
        Ok(PathBuf::from(resources.ok_or("the path of the resources is missing")?))
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    unsafe { free(instance) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> c_int {
    unsafe { set_start(instance, start) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: *mut c_void) -> c_int {
    unsafe { exit_initialisation(instance) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: *mut c_void) -> c_int {
    unsafe { accept(instance) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: *mut c_void) -> c_int {
    unsafe { reset(instance) }
}

/// Refuses lists of different length. All variables are scalars.
fn check_scalars(references: &[c_uint], values: usize) -> Result<(), Refused> {
    let references = references.len();
    if references == values {
        return Ok(());
    }
    Err(format!("there are {references} scalar variables, but {values} values for them").into())
}

/// Returns the value of a real variable, or the time.
fn real(instance: &mut Instance, reference: c_uint) -> Result<f64, Refused> {
    if reference as usize == TIME { Ok(instance.state.time) } else { instance.real(reference) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *mut f64,
    size: usize,
) -> c_int {
    unsafe {
        let (references, values) = (slice(references, count), slice_mut(values, size));
        with(instance, |instance| {
            check_scalars(references, values.len())?;
            for (reference, value) in references.iter().zip(values) {
                *value = real(instance, *reference)?;
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *const f64,
    size: usize,
) -> c_int {
    unsafe {
        let (references, values) = (slice(references, count), slice(values, size));
        match check_scalars(references, values.len()) {
            Ok(()) => set_reals(instance, references, values),
            Err(Refused(sentence)) => refuse(instance, &sentence),
        }
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBoolean(
    instance: *mut c_void,
    references: *const c_uint,
    count: usize,
    values: *mut bool,
    size: usize,
) -> c_int {
    unsafe {
        let references = slice(references, count);
        with(instance, |instance| {
            check_scalars(references, size)?;
            for (k, reference) in references.iter().enumerate() {
                let own = (*reference as usize).checked_sub(FIRST_TRUTH).map(|own| instance.truth(own));
                let value = own.ok_or_else(|| format!("there is no Boolean variable {reference}"))??;
                // SAFETY: the simulation has room for `size` values, which may be uninitialised.
                values.add(k).write(value);
            }
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: *mut c_void, kept: *mut *mut c_void) -> c_int {
    unsafe { get_state(instance, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: *mut c_void, kept: *mut c_void) -> c_int {
    unsafe { set_state(instance, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: *mut c_void, kept: *mut *mut c_void) -> c_int {
    unsafe { free_state(instance, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: *mut c_void,
    kept: *mut c_void,
    size: *mut usize,
) -> c_int {
    unsafe { state_size(instance, kept, size) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: *mut c_void,
    kept: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> c_int {
    unsafe { write_state(instance, kept, bytes, size) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: *mut c_void,
    bytes: *const u8,
    size: usize,
    kept: *mut *mut c_void,
) -> c_int {
    unsafe { read_state(instance, bytes, size, kept) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: *mut c_void,
    unknowns: *const c_uint,
    unknown_count: usize,
    knowns: *const c_uint,
    known_count: usize,
    seed: *const f64,
    seed_size: usize,
    sensitivity: *mut f64,
    sensitivity_size: usize,
) -> c_int {
    unsafe {
        let (unknowns, knowns) = (slice(unknowns, unknown_count), slice(knowns, known_count));
        let (seed, sensitivity) = (slice(seed, seed_size), slice_mut(sensitivity, sensitivity_size));
        with(instance, |instance| {
            instance.directional((unknowns, knowns), seed, sensitivity)?;
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: *mut c_void,
    unknowns: *const c_uint,
    unknown_count: usize,
    knowns: *const c_uint,
    known_count: usize,
    seed: *const f64,
    seed_size: usize,
    sensitivity: *mut f64,
    sensitivity_size: usize,
) -> c_int {
    unsafe {
        let (unknowns, knowns) = (slice(unknowns, unknown_count), slice(knowns, known_count));
        let (seed, sensitivity) = (slice(seed, seed_size), slice_mut(sensitivity, sensitivity_size));
        with(instance, |instance| {
            instance.adjoint((unknowns, knowns), seed, sensitivity)?;
            Ok(OK)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    time: f64,
    step: f64,
    _no_set_before: bool,
    events: *mut bool,
    terminate: *mut bool,
    early_return: *mut bool,
    last_time: *mut f64,
) -> c_int {
    unsafe {
        // SAFETY: these locations belong to the simulation and may be uninitialised. A discarded step does not end the
        // simulation; other steps may follow.
        for flag in [events, terminate, early_return] {
            if !flag.is_null() {
                flag.write(false);
            }
        }
        let status = with(instance, |instance| instance.step(time, step));
        with(instance, |instance| {
            if !last_time.is_null() {
                last_time.write(instance.state.time);
            }
            Ok(status)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: *mut c_void,
    _references: *const c_uint,
    _count: usize,
    _orders: *const i32,
    _values: *mut f64,
    _size: usize,
) -> c_int {
    unsafe { refuse(instance, "no derivatives of outputs by the time are known") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    instance: *mut c_void,
    _reference: c_uint,
    _count: *mut usize,
) -> c_int {
    unsafe { refuse(instance, DEPENDENCIES) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    instance: *mut c_void,
    _dependent: c_uint,
    _elements: *mut usize,
    _independents: *mut c_uint,
    _elements_of_independents: *mut usize,
    _kinds: *mut c_int,
    _count: usize,
) -> c_int {
    unsafe { refuse(instance, DEPENDENCIES) }
}

/// Reason for refusing dependencies of elements of arrays.
const DEPENDENCIES: &str = "all variables are scalars: the model description has their dependencies";
