//! Variables of types that units do not have.

use crate::component::none_of;
use std::ffi::{c_char, c_int, c_uint, c_void};

/// Declares the functions that get and set variables of one type.
macro_rules! absent {
    ($what:literal, $kind:ty: $get:ident, $set:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get(
            instance: *mut c_void,
            _references: *const c_uint,
            count: usize,
            _values: *mut $kind,
            _size: usize,
        ) -> c_int {
            unsafe { none_of(instance, count, $what) }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set(
            instance: *mut c_void,
            _references: *const c_uint,
            count: usize,
            _values: *const $kind,
            _size: usize,
        ) -> c_int {
            unsafe { none_of(instance, count, $what) }
        }
    };
}

absent!("variables of type Float32", f32: fmi3GetFloat32, fmi3SetFloat32);
absent!("variables of type Int8", i8: fmi3GetInt8, fmi3SetInt8);
absent!("variables of type UInt8", u8: fmi3GetUInt8, fmi3SetUInt8);
absent!("variables of type Int16", i16: fmi3GetInt16, fmi3SetInt16);
absent!("variables of type UInt16", u16: fmi3GetUInt16, fmi3SetUInt16);
absent!("variables of type Int32", i32: fmi3GetInt32, fmi3SetInt32);
absent!("variables of type UInt32", u32: fmi3GetUInt32, fmi3SetUInt32);
absent!("variables of type Int64", i64: fmi3GetInt64, fmi3SetInt64);
absent!("variables of type UInt64", u64: fmi3GetUInt64, fmi3SetUInt64);
absent!("text variables", *const c_char: fmi3GetString, fmi3SetString);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBoolean(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *const bool,
    _size: usize,
) -> c_int {
    unsafe { none_of(instance, count, "Boolean variables that can be set") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBinary(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _sizes: *mut usize,
    _values: *mut *const u8,
    _size: usize,
) -> c_int {
    unsafe { none_of(instance, count, "binary variables") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBinary(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _sizes: *const usize,
    _values: *const *const u8,
    _size: usize,
) -> c_int {
    unsafe { none_of(instance, count, "binary variables") }
}

/// What units do not have, for all functions of clocks.
const CLOCKS: &str = "clocks";

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetClock(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *mut bool,
) -> c_int {
    unsafe { none_of(instance, count, CLOCKS) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetClock(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _values: *const bool,
) -> c_int {
    unsafe { none_of(instance, count, CLOCKS) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalDecimal(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _intervals: *mut f64,
    _qualifiers: *mut c_int,
) -> c_int {
    unsafe { none_of(instance, count, CLOCKS) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalFraction(
    instance: *mut c_void,
    _references: *const c_uint,
    count: usize,
    _counters: *mut u64,
    _resolutions: *mut u64,
    _qualifiers: *mut c_int,
) -> c_int {
    unsafe { none_of(instance, count, CLOCKS) }
}

/// Declares a function that gets or sets decimal times of clocks.
macro_rules! clock_decimal {
    ($name:ident, $values:ty) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: *mut c_void,
            _references: *const c_uint,
            count: usize,
            _values: $values,
        ) -> c_int {
            unsafe { none_of(instance, count, CLOCKS) }
        }
    };
}

clock_decimal!(fmi3GetShiftDecimal, *mut f64);
clock_decimal!(fmi3SetIntervalDecimal, *const f64);
clock_decimal!(fmi3SetShiftDecimal, *const f64);

/// Declares a function that gets or sets times of clocks as fractions.
macro_rules! clock_fraction {
    ($name:ident, $values:ty) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: *mut c_void,
            _references: *const c_uint,
            count: usize,
            _counters: $values,
            _resolutions: $values,
        ) -> c_int {
            unsafe { none_of(instance, count, CLOCKS) }
        }
    };
}

clock_fraction!(fmi3GetShiftFraction, *mut u64);
clock_fraction!(fmi3SetIntervalFraction, *const u64);
clock_fraction!(fmi3SetShiftFraction, *const u64);
