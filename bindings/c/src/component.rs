//! Functions on instances that both versions of the standard have, under different names.
//!
//! An instance of the simulation is a pointer, which is null or was made by [`instantiate`] and not freed. One thread at
//! a time uses it. A state is null or was made here for the same library. Other pointers are null, or point to as many
//! values as the standard says.

#![allow(clippy::missing_safety_doc, reason = "what a caller promises is in the standard, and above")]

use crate::border::{Refused, guarded, slice, slice_mut};
use crate::instance::{Instance, Unit};
use crate::log::{DISCARD, ERROR, Log, OK};
use crate::state::Kept;
use std::ffi::{c_int, c_uint, c_void};
use std::path::PathBuf;

/// Makes an instance, or returns null and sends the reason to the log.
pub fn instantiate(
    log: Log,
    identity: Option<&str>,
    resources: impl FnOnce() -> Result<PathBuf, Refused>,
) -> *mut c_void {
    match guarded(|| Unit::of(identity, &resources()?)) {
        Ok(unit) => Box::into_raw(Box::new(Instance::new(log, unit))).cast(),
        Err(Refused(sentence)) => {
            log.say(ERROR, &sentence);
            std::ptr::null_mut()
        }
    }
}

/// Calls a function with an instance. An error is logged, the instance is restored, and the status is "discard".
pub unsafe fn with(component: *mut c_void, work: impl FnOnce(&mut Instance) -> Result<c_int, Refused>) -> c_int {
    // SAFETY: an instance is null or was made by `instantiate`, and is used by one thread at a time.
    let Some(instance) = (unsafe { component.cast::<Instance>().as_mut() }) else { return ERROR };
    let before = instance.state.clone();
    match guarded(|| work(instance)) {
        Ok(status) => status,
        Err(Refused(sentence)) => {
            instance.state = before;
            instance.log.say(DISCARD, &sentence)
        }
    }
}

/// Accepts a call without effect.
pub unsafe fn accept(component: *mut c_void) -> c_int {
    // SAFETY: as for `with`.
    unsafe { with(component, |_| Ok(OK)) }
}

/// Refuses a call.
pub unsafe fn refuse(component: *mut c_void, sentence: &str) -> c_int {
    // SAFETY: as for `with`.
    unsafe { with(component, |_| Err(sentence.into())) }
}

/// Refuses access to variables of a type that the unit does not have.
pub unsafe fn none_of(component: *mut c_void, count: usize, what: &str) -> c_int {
    // SAFETY: as for `with`.
    unsafe { with(component, |_| if count == 0 { Ok(OK) } else { Err(format!("there are no {what}").into()) }) }
}

/// Frees an instance.
pub unsafe fn free(component: *mut c_void) {
    if !component.is_null() {
        // SAFETY: `instantiate` made it, and it is not used any more.
        drop(unsafe { Box::from_raw(component.cast::<Instance>()) });
    }
}

/// Begins the initialisation at a time.
pub unsafe fn set_start(component: *mut c_void, start: f64) -> c_int {
    // SAFETY: as for `with`.
    unsafe {
        with(component, |instance| {
            instance.state.time = start;
            Ok(OK)
        })
    }
}

/// Ends the initialisation.
pub unsafe fn exit_initialisation(component: *mut c_void) -> c_int {
    // SAFETY: as for `with`.
    unsafe { with(component, Instance::exit_initialisation) }
}

/// Returns to the state before the initialisation.
pub unsafe fn reset(component: *mut c_void) -> c_int {
    // SAFETY: as for `with`.
    unsafe {
        with(component, |instance| {
            instance.reset();
            Ok(OK)
        })
    }
}

/// Sets real variables.
pub unsafe fn set_reals(component: *mut c_void, references: &[c_uint], values: &[f64]) -> c_int {
    // SAFETY: as for `with`.
    unsafe {
        with(component, |instance| {
            references.iter().zip(values).try_for_each(|(reference, value)| instance.set_real(*reference, *value))?;
            Ok(OK)
        })
    }
}

/// Saves the state at a location, in which the simulation has null or a state made here.
pub unsafe fn get_state(component: *mut c_void, kept: *mut *mut c_void) -> c_int {
    // SAFETY: as for `with`; the location belongs to the simulation, and a state in it was made here.
    unsafe {
        with(component, |instance| {
            let place = kept.as_mut().ok_or("the pointer for the state is null")?;
            match place.cast::<Kept>().as_mut() {
                Some(kept) => *kept = instance.kept(),
                None => *place = Box::into_raw(Box::new(instance.kept())).cast(),
            }
            Ok(OK)
        })
    }
}

/// Restores a state.
pub unsafe fn set_state(component: *mut c_void, kept: *mut c_void) -> c_int {
    // SAFETY: as for `with`; a state is null or was made by `get_state`.
    unsafe {
        with(component, |instance| {
            instance.come_back(kept.cast::<Kept>().as_ref().ok_or("there is no state")?)?;
            Ok(OK)
        })
    }
}

/// Frees the state at a location.
pub unsafe fn free_state(component: *mut c_void, kept: *mut *mut c_void) -> c_int {
    // SAFETY: as for `with`; the location is null, empty, or holds a state made by `get_state`.
    unsafe {
        with(component, |_| {
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

/// Writes the number of bytes of a serialised state.
pub unsafe fn state_size(component: *mut c_void, kept: *mut c_void, size: *mut usize) -> c_int {
    // SAFETY: as for `with`; a state is null or was made by `get_state`; the location belongs to the simulation.
    unsafe {
        with(component, |instance| {
            let written = kept.cast::<Kept>().as_ref().ok_or("there is no state")?.written(instance.in_time())?;
            *size.as_mut().ok_or("there is no place for the size")? = written.len();
            Ok(OK)
        })
    }
}

/// Serialises a state into a buffer.
pub unsafe fn write_state(component: *mut c_void, kept: *mut c_void, bytes: *mut u8, size: usize) -> c_int {
    // SAFETY: as for `with`; a state is null or was made by `get_state`; the bytes belong to the simulation.
    unsafe {
        with(component, |instance| {
            let written = kept.cast::<Kept>().as_ref().ok_or("there is no state")?.written(instance.in_time())?;
            let place = slice_mut(bytes, size).get_mut(..written.len());
            place.ok_or("the buffer for the state is too small")?.copy_from_slice(&written);
            Ok(OK)
        })
    }
}

/// Reads a serialised state.
pub unsafe fn read_state(component: *mut c_void, bytes: *const u8, size: usize, kept: *mut *mut c_void) -> c_int {
    // SAFETY: as for `with`; bytes and location belong to the simulation.
    unsafe {
        with(component, |instance| {
            let read = Kept::read(slice(bytes, size), instance.in_time())?;
            *kept.as_mut().ok_or("the pointer for the state is null")? = Box::into_raw(Box::new(read)).cast();
            Ok(OK)
        })
    }
}
