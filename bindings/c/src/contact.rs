//! Contact solved by a reduced model, for C.

use crate::border::{Refused, guarded, text_of, write_message};
use ehl_explorer::engine::coupled::{Coupled, Inputs, Outputs, Pressed};
use ehl_explorer::engine::model_file;
use std::ffi::c_char;
use std::path::Path;
use std::sync::Arc;

/// Success.
pub const EHL_OK: i32 = 0;
/// Success with a warning in the message, such as a contact outside the trained range.
pub const EHL_WARNING: i32 = 1;
/// Refused. The message contains the reason, and nothing has changed.
pub const EHL_REFUSED: i32 = 2;

/// Contact solved by a reduced model. Each may be used by one thread at a time; different ones are independent.
pub struct EhlContact(Coupled);

/// Inputs of a contact.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct EhlInputs {
    /// Reduced radius R in the rolling direction, m.
    pub radius: f64,
    /// Radius across over R; 1 for a circular or line contact.
    pub radius_ratio: f64,
    /// Mean entrainment speed, m/s.
    pub speed: f64,
    /// Slide-to-roll ratio: sliding speed over mean entrainment speed.
    pub srr: f64,
    /// Load, N/m for a line contact, N for a point contact. Ignored if the approach is given.
    pub load: f64,
    /// Approach of the bodies since first contact, m; negative for separated bodies. Ignored if the load is given.
    pub approach: f64,
    /// Reduced modulus E', Pa.
    pub modulus: f64,
    /// Viscosity at ambient pressure, Pa s.
    pub viscosity: f64,
    /// Pressure-viscosity coefficient, 1/Pa. Ignored if the lubricant determines it.
    pub alpha: f64,
    /// Composite rms roughness, m. Ignored if the model is of smooth surfaces.
    pub roughness: f64,
}

/// Outputs of a contact.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct EhlOutputs {
    /// Load, N/m or N.
    pub load: f64,
    /// Approach of the bodies since first contact, m. For a line contact, measured at the distance approach_reference.
    pub approach: f64,
    /// Central film thickness, m.
    pub h_c_m: f64,
    /// Minimum film thickness, m.
    pub h_min_m: f64,
    /// Traction coefficient: friction force over load.
    pub traction: f64,
    /// Friction force, N/m or N.
    pub friction_force: f64,
    /// Maximum Hertzian pressure, Pa.
    pub hertz_p_h_pa: f64,
    /// 99 % empirical bound of the relative error of the central film thickness; NaN if not available.
    pub h_c_error_bound: f64,
    /// 99 % empirical bound of the relative error of the minimum film thickness; NaN if not available.
    pub h_min_error_bound: f64,
    /// 99 % empirical bound of the relative error of the traction coefficient; NaN if not available.
    pub traction_error_bound: f64,
    /// Half width of the dry contact, m.
    pub hertz_a_m: f64,
    /// Reference distance for the approach of a line contact: its radius, m. NaN for a point contact.
    pub approach_reference: f64,
    /// Minimum film thickness over roughness; NaN for smooth surfaces.
    pub film_ratio_min: f64,
    /// Share of the load that asperities carry; NaN for smooth surfaces.
    pub asperity_load_share: f64,
    /// 1 if the contact is inside the trained range, else 0.
    pub trained: i32,
    /// 1 if the full solver was used, else 0.
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
            roughness_m: given.roughness,
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
            roughness: own.roughness_m,
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
            film_ratio_min: own.film_ratio_min,
            asperity_load_share: own.asperity_load_share,
            trained: i32::from(own.trained),
            full: i32::from(own.full),
        }
    }
}

/// Reads a reduced model (.rom) and returns a contact solved by it. `by_approach` is 1 if the approach is given, 0 if
/// the load is given. If `first` is not null, it receives inputs near the middle of the trained range. If the model is
/// refused, returns null and writes a sentence to `message`, a buffer of `length` bytes or null. Free the contact with
/// `ehl_contact_free`.
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
        // SAFETY: guaranteed by the caller.
        let path = unsafe { text_of(path) }.ok_or("the path is not UTF-8 text")?;
        let model = Arc::new(model_file::read(Path::new(path))?);
        let pressed = if by_approach == 0 { Pressed::Load } else { Pressed::Approach };
        let contact = Coupled::new(Arc::clone(&model), pressed)?;
        let inputs = if first.is_null() { None } else { Coupled::first_inputs(&model) };
        Ok((contact, inputs))
    });
    match made {
        Ok((contact, inputs)) => {
            if let Some(inputs) = inputs {
                // SAFETY: it is not null, and writable as guaranteed by the caller.
                unsafe { first.write(inputs.into()) };
            }
            // SAFETY: guaranteed by the caller.
            unsafe { write_message(message, length, "") };
            Box::into_raw(Box::new(EhlContact(contact)))
        }
        Err(Refused(sentence)) => {
            // SAFETY: guaranteed by the caller.
            unsafe { write_message(message, length, &sentence) };
            std::ptr::null_mut()
        }
    }
}

/// Solves a contact and returns `EHL_OK`, `EHL_WARNING` or `EHL_REFUSED`. `message`, a buffer of `length` bytes or
/// null, receives the warning or the reason, cut off if it is too long. Outputs are written unless the contact is
/// refused.
///
/// # Safety
/// `contact` was returned by `ehl_contact_read` and is not used by another thread at the same time; `inputs` is
/// readable, `outputs` writable, `message` null or writable for `length` bytes.
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
        // SAFETY: they are not null; the rest is guaranteed by the caller.
        let (contact, inputs) = unsafe { (&mut *contact, inputs.read()) };
        Ok(contact.0.solve(&inputs.into())?)
    });
    match solved {
        Ok(solved) => {
            // SAFETY: it is not null, and writable as guaranteed by the caller; so is the message.
            unsafe {
                outputs.write((&solved).into());
                write_message(message, length, &solved.warning());
            }
            if solved.warnings.is_empty() { EHL_OK } else { EHL_WARNING }
        }
        Err(Refused(sentence)) => {
            // SAFETY: guaranteed by the caller.
            unsafe { write_message(message, length, &sentence) };
            EHL_REFUSED
        }
    }
}

/// Frees a contact. Null is ignored.
///
/// # Safety
/// `contact` was returned by `ehl_contact_read` and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ehl_contact_free(contact: *mut EhlContact) {
    if !contact.is_null() {
        // SAFETY: it was made by `Box::into_raw`; the rest is guaranteed by the caller.
        drop(unsafe { Box::from_raw(contact) });
    }
}
