//! A contact by a reduced model, for C.

use crate::border::{Refused, guarded, text_of, write_message};
use ehl_explorer::engine::coupled::{Coupled, Inputs, Outputs, Pressed};
use ehl_explorer::engine::model_file;
use std::ffi::c_char;
use std::path::Path;
use std::sync::Arc;

/// Done.
pub const EHL_OK: i32 = 0;
/// Done; the message says what a reader must know, such as a contact beyond the trained range.
pub const EHL_WARNING: i32 = 1;
/// Refused; the message says why, and nothing has changed.
pub const EHL_REFUSED: i32 = 2;

/// A contact by a reduced model. Each belongs to one thread at a time; different ones are independent.
pub struct EhlContact(Coupled);

/// What a contact is driven by.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct EhlInputs {
    /// Reduced radius R in the rolling direction, m.
    pub radius: f64,
    /// Radius across over R; 1 for a circle or a line.
    pub radius_ratio: f64,
    /// Mean entrainment speed, m/s.
    pub speed: f64,
    /// Sliding speed over mean speed.
    pub srr: f64,
    /// Load, N/m of a line contact and N of a point contact; the first guess where an approach is given.
    pub load: f64,
    /// Approach of the bodies since they touched, m; not read where the load is given.
    pub approach: f64,
    /// Reduced modulus E', Pa.
    pub modulus: f64,
    /// Viscosity at ambient pressure, Pa s.
    pub viscosity: f64,
    /// Pressure-viscosity coefficient, 1/Pa; not read where the lubricant determines it.
    pub alpha: f64,
}

/// What follows.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct EhlOutputs {
    /// Load, N/m or N.
    pub load: f64,
    /// Approach of the bodies since they touched, m; of a line contact at the distance approach_reference.
    pub approach: f64,
    /// Central film thickness, m.
    pub h_c_m: f64,
    /// Minimum film thickness, m.
    pub h_min_m: f64,
    /// Traction coefficient: friction over load.
    pub traction: f64,
    /// Friction, N/m or N.
    pub friction_force: f64,
    /// Largest pressure of the dry contact, Pa.
    pub hertz_p_h_pa: f64,
    /// Relative error of the central film thickness in 99 of 100 contacts at most; not a number where unknown.
    pub h_c_error_bound: f64,
    /// The same of the minimum film thickness.
    pub h_min_error_bound: f64,
    /// The same of the traction coefficient.
    pub traction_error_bound: f64,
    /// Half width of the dry contact, m.
    pub hertz_a_m: f64,
    /// Distance from a line contact at which its approach is measured: its radius, m; not a number for a point contact.
    pub approach_reference: f64,
    /// 1 where the model was trained for the contact, else 0.
    pub trained: i32,
    /// 1 where the full solver took over, else 0.
    pub full: i32,
}

impl From<EhlInputs> for Inputs {
    fn from(given: EhlInputs) -> Self {
        Self {
            radius_m: given.radius,
            radius_ratio: given.radius_ratio,
            speed_m_per_s: given.speed,
            slide_to_roll_ratio: given.srr,
            load: given.load,
            approach_m: given.approach,
            modulus_pa: given.modulus,
            viscosity_pa_s: given.viscosity,
            alpha_per_pa: given.alpha,
        }
    }
}

impl From<Inputs> for EhlInputs {
    fn from(own: Inputs) -> Self {
        Self {
            radius: own.radius_m,
            radius_ratio: own.radius_ratio,
            speed: own.speed_m_per_s,
            srr: own.slide_to_roll_ratio,
            load: own.load,
            approach: own.approach_m,
            modulus: own.modulus_pa,
            viscosity: own.viscosity_pa_s,
            alpha: own.alpha_per_pa,
        }
    }
}

impl From<&Outputs> for EhlOutputs {
    fn from(own: &Outputs) -> Self {
        let [h_c_error_bound, h_min_error_bound, traction_error_bound] = own.error_bounds;
        Self {
            load: own.load,
            approach: own.approach_m,
            h_c_m: own.h_c_m,
            h_min_m: own.h_min_m,
            traction: own.friction_coefficient,
            friction_force: own.friction_force,
            hertz_p_h_pa: own.hertz_pressure_pa,
            h_c_error_bound,
            h_min_error_bound,
            traction_error_bound,
            hertz_a_m: own.half_width_m,
            approach_reference: own.approach_reference_m,
            trained: i32::from(own.trained),
            full: i32::from(own.full),
        }
    }
}

/// Reads a reduced model (.rom) and makes a contact of it; `by_approach` is 1 where the approach is given and not the
/// load. `first`, where it is not null, gets inputs in the midst of what the model was trained for. Null where it is
/// refused; then `message`, a buffer of `length` bytes or null, holds a sentence. Free it with `ehl_contact_free`.
///
/// # Safety
/// `path` is a string that ends with a zero, `first` null or writable, `message` null or writable for `length` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ehl_contact_read(
    path: *const c_char,
    by_approach: i32,
    first: *mut EhlInputs,
    message: *mut c_char,
    length: usize,
) -> *mut EhlContact {
    let made = guarded(|| {
        // SAFETY: the caller's promise.
        let path = unsafe { text_of(path) }.ok_or("the path is no UTF-8 text")?;
        let model = Arc::new(model_file::read(Path::new(path))?);
        let pressed = if by_approach == 0 { Pressed::Load } else { Pressed::Approach };
        let contact = Coupled::new(Arc::clone(&model), pressed)?;
        let inputs = if first.is_null() { None } else { Coupled::first_inputs(&model) };
        Ok((contact, inputs))
    });
    match made {
        Ok((contact, inputs)) => {
            if let Some(inputs) = inputs {
                // SAFETY: it is not null, and writable by the caller's promise.
                unsafe { first.write(inputs.into()) };
            }
            // SAFETY: the caller's promise.
            unsafe { write_message(message, length, "") };
            Box::into_raw(Box::new(EhlContact(contact)))
        }
        Err(Refused(sentence)) => {
            // SAFETY: the caller's promise.
            unsafe { write_message(message, length, &sentence) };
            std::ptr::null_mut()
        }
    }
}

/// Solves a contact. `EHL_OK`, `EHL_WARNING` or `EHL_REFUSED`; `message`, a buffer of `length` bytes or null, holds what is
/// to be said, as far as it fits. Outputs are written unless it is refused.
///
/// # Safety
/// `contact` comes from `ehl_contact_read` and no other thread uses it meanwhile; `inputs` is readable, `outputs` writable,
/// `message` null or writable for `length` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ehl_contact_solve(
    contact: *mut EhlContact,
    inputs: *const EhlInputs,
    outputs: *mut EhlOutputs,
    message: *mut c_char,
    length: usize,
) -> i32 {
    let solved = guarded(|| {
        if contact.is_null() || inputs.is_null() || outputs.is_null() {
            return Err("contact, inputs and outputs must not be null".into());
        }
        // SAFETY: they are not null; the rest is the caller's promise.
        let (contact, inputs) = unsafe { (&mut *contact, inputs.read()) };
        Ok(contact.0.solve(&inputs.into())?)
    });
    match solved {
        Ok(solved) => {
            // SAFETY: it is not null, and writable by the caller's promise; so is the message.
            unsafe {
                outputs.write((&solved).into());
                write_message(message, length, &solved.warning());
            }
            if solved.warnings.is_empty() { EHL_OK } else { EHL_WARNING }
        }
        Err(Refused(sentence)) => {
            // SAFETY: the caller's promise.
            unsafe { write_message(message, length, &sentence) };
            EHL_REFUSED
        }
    }
}

/// Frees a contact; null is nothing to be freed.
///
/// # Safety
/// `contact` comes from `ehl_contact_read` and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ehl_contact_free(contact: *mut EhlContact) {
    if !contact.is_null() {
        // SAFETY: it was made by `Box::into_raw`; the rest is the caller's promise.
        drop(unsafe { Box::from_raw(contact) });
    }
}
