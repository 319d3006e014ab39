//! Memory of the host: its arrays and strings as slices and texts, checked as far as that is possible.

use std::ffi::{CStr, c_char};
use std::str::Utf8Error;
use std::{ptr, slice};

use super::super::state::Ending;

/// Why an argument cannot be used; follows the name of the argument in a message.
#[derive(Debug, thiserror::Error)]
pub(super) enum Flaw {
    #[error("is null")]
    Null,
    #[error("is not aligned for its type, or its length is larger than the address space")]
    NoArray,
    #[error("is not valid UTF-8: {0}")]
    NotUtf8(#[from] Utf8Error),
    #[error("cannot be used: string {0} {1}")]
    Entry(usize, Box<Flaw>),
}

/// Whether an array can lie there. Without entries there is nothing to check: the standard allows null then.
fn check<T>(start: *const T, length: usize) -> Result<(), Flaw> {
    if length == 0 {
        Ok(())
    } else if start.is_null() {
        Err(Flaw::Null)
    } else if !start.is_aligned() || length > isize::MAX.unsigned_abs() / size_of::<T>() {
        Err(Flaw::NoArray)
    } else {
        Ok(())
    }
}

/// The array of a host.
///
/// # Safety
/// A pointer that is not null must be valid for `length` reads until the C function returns.
pub(super) unsafe fn input<'a, T>(start: *const T, length: usize) -> Result<&'a [T], Flaw> {
    check(start, length)?;
    if length == 0 {
        return Ok(&[]);
    }
    // SAFETY: by the contract of this function; null, alignment and size were checked.
    Ok(unsafe { slice::from_raw_parts(start, length) })
}

/// The structure of a host, copied, since it is the host's again after the call; `None` for null.
///
/// # Safety
/// A pointer that is not null must be valid for one read.
pub(super) unsafe fn copied<T: Copy>(start: *const T) -> Option<T> {
    // SAFETY: by the contract of this function.
    unsafe { input(start, 1) }.ok()?.first().copied()
}

/// The string of a host.
///
/// # Safety
/// A pointer that is not null must point to a zero-terminated string that lives until the C function returns.
pub(super) unsafe fn text<'a>(start: *const c_char) -> Result<&'a str, Flaw> {
    if start.is_null() {
        return Err(Flaw::Null);
    }
    // SAFETY: by the contract of this function; null was excluded.
    Ok(unsafe { CStr::from_ptr(start) }.to_str()?)
}

/// The strings of a host.
///
/// # Safety
/// That of [`input`] for the array, and that of [`text`] for each entry.
pub(super) unsafe fn texts<'a>(start: *const *const c_char, length: usize) -> Result<Vec<&'a str>, Flaw> {
    // SAFETY: by the contract of this function.
    let strings = unsafe { input(start, length) }?;
    let read = |(number, &string): (usize, &*const c_char)| {
        // SAFETY: by the contract of this function.
        unsafe { text(string) }.map_err(|flaw| Flaw::Entry(number, Box::new(flaw)))
    };
    (1..).zip(strings).map(read).collect()
}

/// The array of a host to which values are written.
///
/// It is a pointer and not a slice, because the handle of an FMU state is input and output at once, and because nothing
/// forbids a host to let other arrays overlap. Inputs must not be used after the output is written.
pub(super) struct Output<T> {
    start: *mut T,
    length: usize,
}

/// The array to which a host wants values to be written.
///
/// # Safety
/// A pointer that is not null must be valid for `length` writes until the C function returns, and so long the [`Output`] may
/// be used.
pub(super) unsafe fn output<T>(start: *mut T, length: usize) -> Result<Output<T>, Flaw> {
    check(start, length)?;
    Ok(Output { start, length })
}

impl<T: Copy> Output<T> {
    /// Writes the values with which a call succeeded, no more than there is room for; after a failure writes nothing.
    pub(super) fn write(self, values: Result<Vec<T>, Ending>) -> Ending {
        match values {
            Ok(values) => {
                let length = values.len().min(self.length);
                if length > 0 {
                    // SAFETY: `output` has checked null, alignment and size, and its caller stands for the rest; the vector
                    // is our own, so that the two do not overlap.
                    unsafe { ptr::copy_nonoverlapping(values.as_ptr(), self.start, length) };
                }
                Ending::Ok
            }
            Err(ending) => ending,
        }
    }

    /// Writes one value if a call has succeeded.
    pub(super) fn write_one(self, value: T, ending: Ending) -> Ending {
        self.write(if ending == Ending::Ok { Ok(vec![value]) } else { Err(ending) })
    }
}
