//! Arrays and texts of a C caller, read and written with null, alignment and length checked.

use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::{ptr, slice};

use super::super::bindings::{fmi2FMUstate, fmi2String, fmi2ValueReference};
use super::super::instance::Instance;
use super::super::registry;
use super::super::state::Ending;
use super::super::value::Value;

pub(super) const NO_ARRAY: &str = "an array is null or not aligned";

pub(super) fn pointer(handle: usize) -> *mut c_void {
    ptr::without_provenance_mut(handle)
}

/// The array of a C caller; a length of zero may come with null.
///
/// # Safety
/// A pointer that is not null must be valid for `length` reads until the function that took it returns.
pub(super) unsafe fn array<'a, T>(start: *const T, length: usize) -> Option<&'a [T]> {
    if length == 0 {
        return Some(&[]);
    }
    let usable =
        !start.is_null() && start.is_aligned() && length <= isize::MAX.unsigned_abs() / size_of::<T>();
    // SAFETY: by the contract of this function; null, alignment and size were checked.
    usable.then(|| unsafe { slice::from_raw_parts(start, length) })
}

/// The text of a C caller, or `None` for null.
///
/// # Safety
/// A pointer that is not null must point to a zero-terminated string that lives until the caller returns.
pub(super) unsafe fn text<'a>(start: fmi2String) -> Option<Cow<'a, str>> {
    // SAFETY: by the contract of this function.
    (!start.is_null()).then(|| unsafe { CStr::from_ptr(start) }.to_string_lossy())
}

/// Writes `values` to the array of a C caller.
///
/// # Safety
/// A pointer that is not null must be valid for as many writes as there are `values`.
pub(super) unsafe fn write<T>(instance: &Instance, values: &[T], target: *mut T) -> Ending {
    if values.is_empty() {
        return Ending::Ok;
    }
    if target.is_null() || !target.is_aligned() {
        return instance.refuse(NO_ARRAY);
    }
    // SAFETY: by the contract of this function; ours and the host's memory do not overlap.
    unsafe { ptr::copy_nonoverlapping(values.as_ptr(), target, values.len()) };
    Ending::Ok
}

/// Writes the values of an answer.
///
/// # Safety
/// As [`write`].
pub(super) unsafe fn answer<T>(
    instance: &Instance,
    values: Result<Vec<T>, Ending>,
    target: *mut T,
) -> Ending {
    match values {
        // SAFETY: by the contract of this function.
        Ok(values) => unsafe { write(instance, &values, target) },
        Err(ending) => ending,
    }
}

/// # Safety
/// As [`array`] for `references` and [`write`] for `target`.
pub(super) unsafe fn get<T>(
    instance: &mut Instance,
    references: Option<&[fmi2ValueReference]>,
    kind: &str,
    read: fn(Value) -> Option<T>,
    target: *mut T,
) -> Ending {
    let Some(references) = references else { return instance.refuse(NO_ARRAY) };
    match instance.get(references, kind, read) {
        // SAFETY: by the contract of this function.
        Ok(values) => unsafe { write(instance, &values, target) },
        Err(ending) => ending,
    }
}

/// Puts a state of the instance behind the host's pointer: a new one, or another one in the place of a known one.
///
/// # Safety
/// A pointer that is not null must be valid for one read and one write.
pub(super) unsafe fn keep(
    instance: &mut Instance,
    state: *mut fmi2FMUstate,
    fill: impl FnOnce(&mut Instance, usize) -> Ending,
) -> Ending {
    // SAFETY: by the contract of this function.
    let Some([known]) = (unsafe { array(state, 1) }) else {
        return instance.refuse("the pointer to the FMU state is null");
    };
    let handle = if known.is_null() { registry::new_handle() } else { known.addr() };
    if !known.is_null() && !instance.has_saved(handle) {
        return instance.refuse("this FMU state is not, or no longer, one of this instance");
    }
    match fill(instance, handle) {
        // SAFETY: by the contract of this function.
        Ending::Ok => unsafe { write(instance, &[pointer(handle)], state) },
        refused => refused,
    }
}

pub(super) fn set<T: Copy>(
    instance: &mut Instance,
    references: Option<&[fmi2ValueReference]>,
    values: Option<&[T]>,
    value: fn(T) -> Value,
) -> Ending {
    match (references, values) {
        (Some(references), Some(values)) => {
            instance.set(references, values.iter().map(|&given| value(given)))
        }
        _ => instance.refuse(NO_ARRAY),
    }
}
