//! Functions for model exchange, scheduled execution, events and structural parameters, which units do not support.

use crate::component::{instantiate, refuse};
use crate::log::{Log, Logger, Logger3};
use std::ffi::{c_char, c_int, c_uint, c_void};

/// Reasons for a refusal.
const KIND: &str = "this unit is for co-simulation only";
const EVENTS: &str = "this unit has no event mode";
const STRUCTURE: &str = "this unit has no structural parameters";

/// Refuses an instance of another kind, and sends the reason to the log.
unsafe fn refuse_kind(name: *const c_char, environment: *mut c_void, logger: Option<Logger3>) -> *mut c_void {
    // SAFETY: the name belongs to the simulation.
    let log = unsafe { Log::new(name, logger.map(Logger::Three), environment) };
    instantiate(log, None, || Err(KIND.into()))
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger3>,
) -> *mut c_void {
    unsafe { refuse_kind(name, environment, logger) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _clock_update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> *mut c_void {
    unsafe { refuse_kind(name, environment, logger) }
}

/// Declares a function without arguments that is refused.
macro_rules! refused {
    ($name:ident, $why:expr) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void) -> c_int {
            unsafe { refuse(instance, $why) }
        }
    };
}

refused!(fmi3EnterEventMode, EVENTS);
refused!(fmi3EnterStepMode, EVENTS);
refused!(fmi3EvaluateDiscreteStates, EVENTS);
refused!(fmi3EnterConfigurationMode, STRUCTURE);
refused!(fmi3ExitConfigurationMode, STRUCTURE);
refused!(fmi3EnterContinuousTimeMode, KIND);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: *mut c_void,
    _need_update: *mut bool,
    _terminate: *mut bool,
    _nominals_changed: *mut bool,
    _values_changed: *mut bool,
    _next_event_defined: *mut bool,
    _next_event: *mut f64,
) -> c_int {
    unsafe { refuse(instance, EVENTS) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: *mut c_void,
    _no_set_before: bool,
    _enter_event_mode: *mut bool,
    _terminate: *mut bool,
) -> c_int {
    unsafe { refuse(instance, KIND) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: *mut c_void, _time: f64) -> c_int {
    unsafe { refuse(instance, KIND) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(instance: *mut c_void, _states: *const f64, _count: usize) -> c_int {
    unsafe { refuse(instance, KIND) }
}

/// Declares a function that reads an array of model exchange.
macro_rules! no_array {
    ($name:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void, _values: *mut f64, _count: usize) -> c_int {
            unsafe { refuse(instance, KIND) }
        }
    };
}

no_array!(fmi3GetContinuousStateDerivatives);
no_array!(fmi3GetEventIndicators);
no_array!(fmi3GetContinuousStates);
no_array!(fmi3GetNominalsOfContinuousStates);

/// Declares a function that reads a number of model exchange.
macro_rules! no_number {
    ($name:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void, _count: *mut usize) -> c_int {
            unsafe { refuse(instance, KIND) }
        }
    };
}

no_number!(fmi3GetNumberOfEventIndicators);
no_number!(fmi3GetNumberOfContinuousStates);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ActivateModelPartition(instance: *mut c_void, _clock: c_uint, _time: f64) -> c_int {
    unsafe { refuse(instance, KIND) }
}
